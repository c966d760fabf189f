"""``--projection orthographic``: disc of a distant planet, and the options that it excludes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Final

from airlight.cli import options
from airlight.errors import ConflictError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Projection whose field of view is a length, and whose camera is far away.
ORTHOGRAPHIC: Final = "orthographic"


def check(projection: str, given: Mapping[str, str | None], at: str | None) -> bool:
    """Whether lines of sight are parallel.

    Parameters
    ----------
    projection : str
        Name of the projection.
    given : mapping
        Options that place or direct a camera, and their texts.
    at : str or None
        Text of ``--at``, which may hold an altitude.

    Raises
    ------
    ParameterError
        If they are parallel, and one of the options is given.
    """
    if at is not None and at.count(",") > 1:
        given = {**given, "--at": at}
    for option, text in given.items():
        if projection == ORTHOGRAPHIC and text is not None:
            what = "an altitude in --at" if option == "--at" else option
            raise ConflictError(f"--projection {projection}", f"takes no {what}")
    return projection == ORTHOGRAPHIC


def extent(fov: str | None, planet: Planet, columns: int, rows: int) -> float:
    """Length from left to right of the picture, by ``--fov``; by default the whole disc. [m]"""
    from airlight.scene.projections.orthographic import disc_extent

    if fov is None:
        return disc_extent(planet.top_radius, columns, rows)
    return options.length(fov, "--fov")
