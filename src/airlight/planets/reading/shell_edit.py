"""Edit of the ground radius with unchanged thickness of the shell."""

from __future__ import annotations

from typing import Any, Final

from airlight.errors import ParameterError
from airlight.planets.reading.nested_tables import Tables, get, put
from airlight.planets.schema.measures import number_in, text_of
from airlight.planets.shell import LARGEST_RATIO, LEAST_THICKNESS

#: Paths of the radii.
BOTTOM: Final = "shell.bottom_radius"
TOP: Final = "shell.top_radius"


def lifted(tables: Tables, before: Tables) -> Tables:
    """Move the top of the shell with the ground.

    Parameters
    ----------
    tables : dict
        Tables of a planet file with an edited ``shell.bottom_radius``; not modified.
    before : dict
        Tables before the edit.

    Returns
    -------
    dict
        Tables with unchanged thickness of the shell; unchanged tables if a radius is invalid.

    Examples
    --------
    >>> before = {"shell": {"bottom_radius": "6360 km", "top_radius": "6460 km"}}
    >>> lifted({"shell": {"bottom_radius": "1e6 m", "top_radius": "6460 km"}}, before)["shell"]
    {'bottom_radius': '1e6 m', 'top_radius': '1100 km'}
    """
    bottom, old, top = (
        _km(get(*one)) for one in ((tables, BOTTOM), (before, BOTTOM), (before, TOP))
    )
    if bottom is None or old is None or top is None or not (bottom > 0.0 and top > old > 0.0):
        return tables
    thickness = top - old
    least, most = thickness / (LARGEST_RATIO - 1.0), thickness / LEAST_THICKNESS
    if not least <= bottom <= most:
        allowed = f"{least:.6g} to {most:.6g} km, with an atmosphere {thickness:.6g} km thick"
        raise ParameterError(BOTTOM, get(tables, BOTTOM), allowed)
    return put(tables, TOP, text_of(float(f"{bottom + thickness:.14g}"), "km"))


def _km(value: Any) -> float | None:
    """Radius; None if invalid. [km]"""
    try:
        return None if value is None else number_in(value, "km", "m", BOTTOM)
    except ParameterError:
        return None
