"""Star catalogue, Milky Way and zodiacal light for the browser: ``web/drawing/star_sky.js``."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.ephemeris.sky import Place, horizon_axes
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.geometry.ephemeris.world import WORLDS
from airlight.planets.light_source import LightSource
from airlight.render.star_points import sun_distance
from airlight.scene.system.milky_way import BRIGHTEST, map_codes, tenth_magnitude
from airlight.scene.system.stars import stars
from airlight.scene.system.zodiacal_light import ECLIPTIC_POLE, zodiacal_table
from airlight.viewer.browser.package import as_jpeg
from airlight.viewer.browser.tables_text import as_text, rounded

#: Mantissa bits of directions, within two seconds of arc, and of light; quality of the map's JPEG.
_DIGITS: Final = 16
_LIGHT_DIGITS: Final = 8
_QUALITY: Final = 90
#: Number of positions of the sun in a year.
_DAYS: Final = 128
#: First days of the years of views without and with a date, since 2000-01-01 12:00 UTC: that of
#: ``horizon_axes_by_sun``, and the one about 2026, as axes precess.
_FIRST: Final = (0.0, 9497.0)


def star_sky(source: LightSource) -> dict[str, Any]:
    """Star catalogue and Milky Way: directions, linear sRGB [W m⁻²], and the map in S10.

    Parameters
    ----------
    source : LightSource
        Light with the colour-matching functions at the wavelengths of the picture.
    """
    weights = source.colors() / source.irradiance[:, None]
    picture = map_codes()
    light = stars().irradiances(source.wavelengths) @ weights
    return {
        "directions": as_text(rounded(stars().directions.astype(np.float32), _DIGITS), 3),
        "light": as_text(rounded(light.astype(np.float32), _LIGHT_DIGITS), 3),
        "color": _short(tenth_magnitude(source.wavelengths) @ weights),
        "map": {
            "image": as_jpeg(picture, _QUALITY),
            "rows": picture.shape[0],
            "columns": picture.shape[1],
            "brightest": BRIGHTEST,
        },
    }


def planet_sky(source: LightSource, body: str | None) -> dict[str, Any] | None:
    """``star_sky`` with zodiacal light and two ``years`` of a world; None for an unknown one.

    The second is that of views with a date. A year has its length and its first day, since
    2000-01-01 12:00 UTC [day], the ``pole`` of the world, and directions of the sun in even steps,
    in the frame of the J2000 equator.

    Parameters
    ----------
    source : LightSource
        Light of the planet's star.
    body : str or None
        Celestial body of the planet, from ``WORLDS``.
    """
    if body not in WORLDS:
        return None
    longitudes, latitudes, brightness = zodiacal_table(sun_distance(source))
    return {
        **star_sky(source),
        "zodiacal": {
            "longitudes": longitudes.tolist(),
            "latitudes": latitudes.tolist(),
            "brightness": [_short(row) for row in brightness],
            "pole": list(ECLIPTIC_POLE),
        },
        "years": [_year(body, first) for first in _FIRST],
    }


def _year(body: str, first: float) -> dict[str, Any]:
    """See ``planet_sky``."""
    length = WORLDS[body].year
    suns = [_sun(body, first + length * k / _DAYS) for k in range(_DAYS)]
    north = Place(body=body, latitude=90.0, longitude=0.0)
    pole = horizon_axes(north, first + 0.5 * length)[2]
    return {
        "first": first,
        "length": length,
        "pole": _short(pole),
        "suns": [_short(one) for one in suns],
    }


def _sun(body: str, days: float) -> NDArray[np.float64]:
    """Direction of the sun in the frame of the J2000 equator. [1]"""
    point = solar_point(WORLDS[body], days)
    place = Place(body=body, latitude=0.0, longitude=point.longitude)
    _, north, up = horizon_axes(place, days)
    height = math.radians(point.latitude)
    return np.asarray(math.cos(height) * up + math.sin(height) * north)


def _short(values: NDArray[np.float64]) -> list[float]:
    return [float(f"{x:.9g}") for x in values]
