"""Places of worlds by name: cities, landing sites, summits."""

from __future__ import annotations

import difflib
import unicodedata
from functools import cache
from importlib.resources import files
from typing import Final, NamedTuple

from airlight.errors import ParameterError

#: World of the cities.
_EARTH: Final = "earth"
#: Number of names that an error suggests, and their least similarity. [1]
_SUGGESTED: Final = 3
_SIMILAR: Final = 0.6


class NamedPlace(NamedTuple):
    """Place of a world.

    Attributes
    ----------
    name : str
        Name.
    latitude, longitude : float
        Coordinates, positive north and east. [deg]
    altitude : float or None
        Altitude above the sphere of the ground, of summits and basins. [m]
    menu : bool
        Whether menus list it.
    others : tuple of str
        Other names.
    """

    name: str
    latitude: float
    longitude: float
    altitude: float | None = None
    menu: bool = False
    others: tuple[str, ...] = ()


def _rows(name: str) -> list[list[str]]:
    """Cells of a table of the package, below its comments and headings."""
    text = files("airlight.geometry.ephemeris").joinpath(f"data/{name}").read_text("utf-8")
    lines = [line for line in text.splitlines() if line and not line.startswith("#")]
    return [line.split(",") for line in lines[1:]]


@cache
def known_places() -> dict[str, tuple[NamedPlace, ...]]:
    """Landing sites, summits and places of menus, by the name of their world."""
    found: dict[str, list[NamedPlace]] = {}
    for body, name, latitude, longitude, altitude, menu, others in _rows("places.csv"):
        place = NamedPlace(
            name=name,
            latitude=float(latitude),
            longitude=float(longitude),
            altitude=float(altitude) if altitude else None,
            menu=menu == "1",
            others=tuple(others.split(";")) if others else (),
        )
        found.setdefault(body, []).append(place)
    return {body: tuple(places) for body, places in found.items()}


@cache
def _index(body: str) -> dict[str, NamedPlace]:
    """Places of a world by plain name; the first of several, which is the largest city."""
    found: dict[str, NamedPlace] = {}
    for place in known_places().get(body, ()):
        for name in (place.name, *place.others):
            found.setdefault(plain_name(name), place)
    if body == _EARTH:
        for name, country, latitude, longitude in _rows("cities.csv"):
            place = NamedPlace(f"{name} ({country})", float(latitude), float(longitude))
            found.setdefault(plain_name(name), place)
            found.setdefault(plain_name(f"{name} {country}"), place)
    return found


def plain_name(name: str) -> str:
    """Name without accents, case, punctuation and doubled spaces.

    Examples
    --------
    >>> plain_name("São  Paulo"), plain_name("Chang'e 4")
    ('sao paulo', 'change 4')
    """
    letters = unicodedata.normalize("NFKD", name.casefold().replace("-", " "))
    return " ".join("".join(c for c in letters if c.isalnum() or c.isspace()).split())


def find_place(name: str, body: str | None = None, field: str = "at") -> NamedPlace:
    """Place of a world by its name, whatever its case and accents.

    Parameters
    ----------
    name : str
        Name; of several cities the largest, or the one of a country whose code follows:
        ``"London CA"``.
    body : str, optional
        World, as ``World.name``; by default any.
    field : str
        Field named in the error.

    Raises
    ------
    ParameterError
        If there is no such place: the closest names, or the world that has it.

    Examples
    --------
    >>> find_place("dead sea")[:4]
    ('Dead Sea', 31.5, 35.5, -430.0)
    >>> find_place("Gale", "earth")
    Traceback (most recent call last):
    ...
    airlight.errors.ParameterError: at is 'Gale'; allowed: a place on earth: this one is on mars
    """
    plain = plain_name(name)
    worlds = tuple(known_places()) if body is None else (body,)
    for world in worlds:
        if plain in _index(world):
            return _index(world)[plain]
    for world in known_places():
        if plain in _index(world):
            allowed = f"a place on {body}: this one is on {world}"
            raise ParameterError(field, name, allowed)
    near: dict[str, None] = {}
    for world in worlds:
        close = difflib.get_close_matches(plain[:60], _index(world), _SUGGESTED, _SIMILAR)
        near |= dict.fromkeys(_index(world)[one].name for one in close)
    form = "LAT,LON such as 59.33N,18.07E, or the name of a place"
    hint = f" (did you mean {', '.join(map(repr, near))}?)" if near else ""
    raise ParameterError(field, name, f"{form}{hint}")
