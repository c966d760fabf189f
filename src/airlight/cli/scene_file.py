"""Pictures of scene files on the command line."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from airlight.cli import options
from airlight.cli.progress import shown_progress
from airlight.errors import ParameterError

if TYPE_CHECKING:
    from airlight.scene.frame import Frame


def painted(
    name: str,
    size: str | None,
    crop: str | None,
    wavelengths: str | None,
    quality: str,
    samples: int | None,
    *,
    whole: bool,
    cache: bool,
    beside: Mapping[str, object],
) -> tuple[Frame, tuple[int, int, int, int] | None]:
    """Draw a scene, with progress on the standard error stream; and its window.

    Parameters
    ----------
    name : str
        Preset or scene file.
    size, crop, wavelengths, quality, samples, cache :
        Options of ``airlight render``.
    whole : bool
        Whether the whole picture is drawn, also of a window.
    beside : mapping
        Options that a scene file answers itself, which must be left out.

    Raises
    ------
    ParameterError
        If one of them is given.
    """
    from airlight.paint.paint_system import paint_system
    from airlight.system import load_system

    for option, value in beside.items():
        if value:
            raise ParameterError(option, value, "none beside a scene file, which says it")
    system = load_system(name)
    columns, rows = options.picture_size(size, system.view.projection)
    window = options.crop(crop, columns, rows)
    first = next(iter(system.planets.values()), None)
    nm = None
    if wavelengths is not None:
        if first is None:
            raise ParameterError("--wavelengths", wavelengths, "none for a scene without air")
        nm = options.wavelengths(wavelengths, first)
    with shown_progress() as report:
        frame = paint_system(
            system, width=columns, height=rows, wavelengths=nm, quality=quality,
            samples=samples, crop=None if whole else window, cache=cache, progress=report,
        )  # fmt: skip
    return frame, window
