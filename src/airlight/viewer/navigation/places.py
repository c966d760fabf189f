"""Named places of worlds, for a menu.

Cities are the principal locations of the tz database (``zone.tab``, public domain), exact to a
minute of arc; on Mars the sites where NASA's missions landed, and on Titan that of Huygens.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple


class NamedPlace(NamedTuple):
    """Place of a menu: name, and latitude and longitude, positive north and east. [deg]"""

    name: str
    latitude: float
    longitude: float

    @property
    def view(self) -> dict[str, float]:
        """Its values of a view, by path."""
        return {"view.latitude": self.latitude, "view.longitude": self.longitude}


#: Places by the key ``body`` of a planet.
PLACES: Final[Mapping[str, tuple[NamedPlace, ...]]] = {
    "earth": (
        NamedPlace("Longyearbyen", 78.0, 16.0),
        NamedPlace("Reykjavik", 64.15, -21.85),
        NamedPlace("Stockholm", 59.33, 18.05),
        NamedPlace("Berlin", 52.5, 13.37),
        NamedPlace("London", 51.51, -0.13),
        NamedPlace("New York", 40.71, -74.01),
        NamedPlace("Denver", 39.74, -104.98),
        NamedPlace("Tokyo", 35.65, 139.74),
        NamedPlace("Cairo", 30.05, 31.25),
        NamedPlace("Kathmandu", 27.72, 85.32),
        NamedPlace("Honolulu", 21.31, -157.86),
        NamedPlace("Singapore", 1.28, 103.85),
        NamedPlace("Nairobi", -1.28, 36.82),
        NamedPlace("La Paz", -16.5, -68.15),
        NamedPlace("Sydney", -33.87, 151.22),
        NamedPlace("McMurdo", -77.83, 166.6),
    ),
    "mars": (
        NamedPlace("Gale: Curiosity", -4.59, 137.44),
        NamedPlace("Jezero: Perseverance", 18.44, 77.45),
        NamedPlace("Meridiani: Opportunity", -1.95, -5.53),
        NamedPlace("Gusev: Spirit", -14.57, 175.48),
        NamedPlace("Ares: Pathfinder", 19.1, -33.25),
        NamedPlace("the north: Phoenix", 68.22, -125.75),
    ),
    "titan": (NamedPlace("Huygens", -10.3, 167.7),),
}


def places_of(body: object) -> tuple[NamedPlace, ...]:
    """Places of a world; none of another.

    Parameters
    ----------
    body : object
        Key ``body`` of a planet; None if it is no known world.

    Examples
    --------
    >>> places_of("titan")[0].view
    {'view.latitude': -10.3, 'view.longitude': 167.7}
    """
    return PLACES.get(str(body), ())
