"""Attributes of results: planet, version, solver and settings, by the CF conventions."""

from __future__ import annotations

from functools import cache
from importlib import metadata
from typing import TYPE_CHECKING, Final

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Conventions of attributes, units and standard names. https://cfconventions.org
CONVENTIONS: Final = "CF-1.10"


def provenance(planet: Planet | None, solver: str, settings: str) -> dict[str, str]:
    """Attributes of a result, independent of time and machine.

    Parameters
    ----------
    planet : Planet or None
        Planet of the solution; None for a medium without one.
    solver, settings : str
        Fields ``provenance`` and ``settings`` of its report.

    Returns
    -------
    dict of str to str
        ``Conventions``, ``source``, ``planet``, ``version``, ``solver``, ``settings``.
    """
    return {
        "planet": "unnamed" if planet is None else planet.name,
        "solver": solver,
        "settings": settings,
        **software(),
    }


def software() -> dict[str, str]:
    """Attributes that all results of this version have in common."""
    return {"version": version(), "source": f"airlight {version()}", "Conventions": CONVENTIONS}


@cache
def version() -> str:
    """Version of the running airlight."""
    try:
        return metadata.version("airlight")
    except metadata.PackageNotFoundError:
        return "unknown"
