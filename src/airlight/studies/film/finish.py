"""Finish of a frame: display settings and file format."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from airlight.render.picture import write_picture
from airlight.scene.frame import Frame


@dataclass(frozen=True, kw_only=True)
class Finish:
    """File format and display settings of a film.

    Attributes
    ----------
    suffix : str
        ``.png`` or ``.exr``.
    tone_map, encoding, primaries : str
        Names of ``airlight.image``.
    bits : int
        Bits per channel of a PNG, 8 or 16.
    glare : float
        Amount of glare. [1]
    """

    suffix: str = ".png"
    tone_map: str = "natural"
    encoding: str = "srgb"
    primaries: str = "srgb"
    bits: int = 8
    glare: float = 1.0


def finished(
    frame: Frame, finish: Finish, exposure: float, eye: bool, metadata: Mapping[str, str]
) -> bytes:
    """Bytes of a frame's file.

    Parameters
    ----------
    finish : Finish
        Format and display.
    exposure : float
        Exposure of a PNG. [EV]
    eye : bool
        Whether mesopic vision of the dark-adapted eye is simulated.
    metadata : mapping
        Metadata for the header, without computation times, so that equal frames are equal files.
    """
    inherited = {name: text for name, text in frame.metadata.items() if name != "solver"}
    plain = Frame(
        rgb=frame.rgb, **frame.lens, scene=frame.scene,
        star_radius=frame.star_radius,
    )  # fmt: skip
    with tempfile.TemporaryDirectory(prefix="airlight-") as folder:
        path = Path(folder) / f"frame{finish.suffix}"
        write_picture(
            path, plain, {**inherited, **metadata}, exposure=exposure, tone_map=finish.tone_map,
            encoding=finish.encoding, primaries=finish.primaries, eye=eye, bits=finish.bits,
            glare=finish.glare,
        )  # fmt: skip
        return path.read_bytes()
