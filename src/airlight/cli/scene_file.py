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
    wavelengths: str | None,
    quality: str,
    samples: int | None,
    *,
    cache: bool,
    beside: Mapping[str, object],
) -> Frame:
    """Draw a scene, with progress on the standard error stream.

    Parameters
    ----------
    name : str
        Preset or scene file.
    size, wavelengths, quality, samples, cache :
        Options of ``airlight render``.
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
    first = next(iter(system.planets.values()), None)
    nm = None
    if wavelengths is not None:
        if first is None:
            raise ParameterError("--wavelengths", wavelengths, "none for a scene without air")
        nm = options.wavelengths(wavelengths, first)
    with shown_progress() as report:
        return paint_system(
            system, width=columns, height=rows, wavelengths=nm, quality=quality,
            samples=samples, cache=cache, progress=report,
        )  # fmt: skip
