"""Finish of a frame: exposure, display settings and file format."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Literal

from airlight.image.display_settings import DisplaySettings
from airlight.render.picture import write_picture
from airlight.scene.frame import Frame


@dataclass(frozen=True, kw_only=True)
class Finish(DisplaySettings):
    """File format, exposure and display settings of a film.

    Attributes
    ----------
    suffix : str
        ``.png`` or ``.exr``.
    exposure : float, "auto" or "locked"
        ``auto`` meters three frames per second and smooths the result; ``locked`` applies the
        metering of the first frame to all frames. [EV]
    """

    suffix: str = ".png"
    exposure: float | Literal["auto", "locked"] = "auto"


def finished(frame: Frame, finish: Finish, metadata: Mapping[str, str]) -> bytes:
    """Bytes of a frame's file.

    Parameters
    ----------
    finish : Finish
        Format and display, with the frame's own exposure.
    metadata : mapping
        Metadata for the header, without computation times, so that equal frames are equal files.
    """
    inherited = {name: text for name, text in frame.metadata.items() if name != "solver"}
    plain = replace(frame, polarised=None, metadata={})
    with tempfile.TemporaryDirectory(prefix="airlight-") as folder:
        path = Path(folder) / f"frame{finish.suffix}"
        texts = {**inherited, **metadata}
        write_picture(path, plain, texts, exposure=finish.exposure, settings=finish)
        return path.read_bytes()
