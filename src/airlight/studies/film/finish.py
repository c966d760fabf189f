"""Finish of a frame: exposure, display settings and file format."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import Literal

from airlight.render.picture import write_picture
from airlight.scene.frame import Frame


@dataclass(frozen=True, kw_only=True)
class Finish:
    """File format and display settings of a film; but for the suffix those of ``write_picture``.

    Attributes
    ----------
    suffix : str
        ``.png`` or ``.exr``.
    exposure : float, "auto" or "locked"
        ``auto`` meters three frames per second and smooths the result; ``locked`` applies the
        metering of the first frame to all frames. [EV]
    eye : bool, optional
        Whether mesopic vision of the dark-adapted eye is simulated; by default where the exposure
        is metered.
    tone_map, encoding, primaries : str
        Names of ``airlight.image``.
    bits : int
        Bits per channel of a PNG, 8 or 16.
    glare : float
        Amount of glare. [1]
    """

    suffix: str = ".png"
    exposure: float | Literal["auto", "locked"] = "auto"
    eye: bool | None = None
    tone_map: str = "natural"
    encoding: str = "srgb"
    primaries: str = "srgb"
    bits: int = 8
    glare: float = 1.0


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
    display = asdict(finish)
    with tempfile.TemporaryDirectory(prefix="airlight-") as folder:
        path = Path(folder) / f"frame{display.pop('suffix')}"
        write_picture(path, plain, {**inherited, **metadata}, **display)
        return path.read_bytes()
