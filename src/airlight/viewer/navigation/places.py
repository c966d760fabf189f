"""Places of worlds for a menu, from the gazetteer."""

from __future__ import annotations

from typing import Any

from airlight.geometry.ephemeris.gazetteer import NamedPlace, known_places


def places_of(body: object) -> tuple[NamedPlace, ...]:
    """Places of a world for a menu; none of another.

    Parameters
    ----------
    body : object
        Key ``body`` of a planet; None if it is no known world.

    Examples
    --------
    >>> view_of(places_of("titan")[0])
    {'view.latitude': -10.3, 'view.longitude': 167.7}
    """
    return tuple(one for one in known_places().get(str(body), ()) if one.menu)


def menu_name(place: NamedPlace) -> str:
    """Name of a place in a menu, with the first of its other names.

    Examples
    --------
    >>> menu_name(places_of("mars")[0])
    'Gale: Curiosity'
    """
    return ": ".join([place.name, *place.others[:1]])


def view_of(place: NamedPlace) -> dict[str, Any]:
    """Values of a view at a place, by path. [deg]"""
    return {"view.latitude": place.latitude, "view.longitude": place.longitude}
