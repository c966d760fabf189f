"""Milky Way: integrated light of the stars fainter than the catalogue, and zodiacal light."""

from __future__ import annotations

import math
from functools import cache, lru_cache
from importlib import resources
from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.scene.system.stars import black_body_irradiances
from airlight.scene.system.zodiacal_light import zodiacal_light

FloatArray = npt.NDArray[np.float64]

#: Brightness of the largest value of the map, in S10: stars of V = 10 per square degree.
BRIGHTEST: Final = 1200.0
#: Colour B - V of the light: Mattila (1980), Astronomy & Astrophysics Supplement 39, 53, 0.7 to
#: 0.9 over the sky; zodiacal light has 0.73, sunlight reddened by Leinert et al. (1998), eq. 22.
#: [mag]
_COLOR: Final = 0.8
_TENTH: Final = 10.0
#: A square degree. [sr]
_SQUARE_DEGREE: Final = (math.pi / 180.0) ** 2


class Sun(NamedTuple):
    """The sun that an observer's zodiacal light surrounds.

    Attributes
    ----------
    x, y, z : float
        Its direction in the frame of the J2000 equator. [1]
    distance : float
        Its distance. [au]
    """

    x: float
    y: float
    z: float
    distance: float


def milky_way_radiance(
    directions: FloatArray, wavelengths: npt.ArrayLike, sun: Sun | None = None
) -> FloatArray:
    """Spectral radiance outside the atmosphere, shape (n, nl). [W m⁻² sr⁻¹ nm⁻¹]

    Integrated starlight of published brightness with the structure of a photographed panorama; see
    ``scene/system/data/SOURCES.md``. Starlight that dust scatters away from the Milky Way, up to as
    much, is left out.

    Parameters
    ----------
    directions : array, shape (n, 3)
        Unit vectors in the frame of the J2000 equator. [1]
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]
    sun : Sun, optional
        The sun, for zodiacal light; without it there is none.

    Examples
    --------
    >>> pole = milky_way_radiance(galactic_axes()[2:], [550.0])
    >>> f"{pole[0, 0]:.1e}"  # 24.2 mag per square second of arc
    '3.3e-10'
    """
    return np.asarray(starlight(directions, sun)[:, None] * tenth_magnitude(wavelengths))


def tenth_magnitude(wavelengths: npt.ArrayLike) -> FloatArray:
    """Spectral radiance of 1 S10, shape (nl,). [W m⁻² sr⁻¹ nm⁻¹]"""
    star = black_body_irradiances(np.array([_TENTH]), np.array([_COLOR]), wavelengths)
    return np.asarray(star[0] / _SQUARE_DEGREE)


def starlight(directions: FloatArray, sun: Sun | None = None) -> FloatArray:
    """Brightness of the light, bilinear, in S10, shape (n,).

    Parameters
    ----------
    directions, sun :
        Arguments of ``milky_way_radiance``.
    """
    picture = _picture() if sun is None else _with_zodiacal_light(sun)
    rows, columns = picture.shape
    y = (0.5 - np.arcsin(np.clip(directions[:, 2], -1.0, 1.0)) / math.pi) * rows - 0.5
    turn = 0.25 - np.arctan2(directions[:, 1], directions[:, 0]) / (2.0 * math.pi)
    x = turn * columns - 0.5
    row = np.clip(np.floor(y), 0, rows - 2).astype(np.intp)
    left = np.floor(x).astype(np.intp)
    down, across = np.clip(y - row, 0.0, 1.0), x - left
    west, east = left % columns, (left + 1) % columns
    upper = picture[row, west] * (1.0 - across) + picture[row, east] * across
    lower = picture[row + 1, west] * (1.0 - across) + picture[row + 1, east] * across
    return np.asarray(upper * (1.0 - down) + lower * down)


@cache
def galactic_axes() -> FloatArray:
    """Galactic axes in the frame of the J2000 equator, as rows: centre, l = 90°, pole. [1]

    References
    ----------
    Hipparcos catalogue (ESA 1997, SP-1200), volume 1, section 1.5.3.
    """
    pole, centre = (
        np.array(
            [
                math.cos(d) * math.cos(a),
                math.cos(d) * math.sin(a),
                math.sin(d),
            ]
        )
        for a, d in (np.radians((192.85948, 27.12825)), np.radians((266.40499, -28.93617)))
    )
    return np.stack([centre, np.cross(pole, centre), pole])


@cache
def map_codes() -> npt.NDArray[np.uint8]:
    """Map, shape (rows, columns): 255 times the root of the brightness over ``BRIGHTEST``.

    Right ascension is to the left, from 90°.
    """
    from PIL import Image

    file = resources.files("airlight.scene.system") / "data" / "milky-way.png"
    with resources.as_file(file) as path, Image.open(path) as picture:
        return np.asarray(picture, np.uint8)


@cache
def _picture() -> FloatArray:
    """Brightness in S10, shape (rows, columns)."""
    return np.asarray(BRIGHTEST * (map_codes() / 255.0) ** 2)


@lru_cache(maxsize=2)
def _with_zodiacal_light(sun: Sun) -> FloatArray:
    """``_picture`` with zodiacal light, in S10."""
    rows, columns = _picture().shape
    declination = math.pi * (0.5 - (np.arange(rows) + 0.5) / rows)
    ascension = 2.0 * math.pi * (0.25 - (np.arange(columns) + 0.5) / columns)
    flat = np.cos(declination)[:, None]
    places = np.stack(
        np.broadcast_arrays(
            flat * np.cos(ascension), flat * np.sin(ascension), np.sin(declination)[:, None]
        ),
        axis=-1,
    )
    light = zodiacal_light(places.reshape(-1, 3), np.array(sun[:3]), sun.distance)
    return np.asarray(_picture() + light.reshape(rows, columns))
