r"""Procedural lamps below the resolution of the map of city lights; they are not data.

Lattices of places, each a quarter of the previous one, from four map texels down: regions, towns,
villages, quarters and blocks. A place lies at random in its cell, with a core, suburbs and a share
of light by the law of rank and size (Zipf 1949), and has roads to its neighbours. Light of a
lattice over its mean, divided between places, roads and the ground between them, is a factor; dark
land has nearly all light in places. Each place and each road has its own light whatever its width,
so that factors have the mean 1, and the lattices are independent: the map keeps its mean. Places
and roads are at least as wide as a pixel. Lattices fade between cells of four and of two pixels,
those of cells over 150 times as large as a pixel, and all where lines of sight are less steep than
1° to 5°, as houses hide what is between the lamps.
"""

from __future__ import annotations

from math import cos, floor, pi, sin, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import in_period, lattice_value, shuffled
from airlight.kernel import kernel

#: Number of lattices, ratio between their cells, and cells of the coarsest per texel. [1]
_LATTICES: Final = 5
_STEP: Final = 4.0
_COARSEST: Final = 0.25
#: Largest distance of a place from the middle of its cell, along each axis. [cell]
_ASIDE: Final = 0.35
#: Rank of the largest place among those of a cell, over all; and mean of the reciprocals of rank
#: of the 289 hashed values. [1]
_LARGEST: Final = 0.02
_PLACE_MEAN: Final = sum(1.0 / (k / 288.0 + _LARGEST) for k in range(289)) / 289.0
#: Radii of core, town and suburbs of the largest places, and shares of the light of the former two.
#: [cell], [1]
_CORE: Final = 0.14
_TOWN: Final = 0.4
_SUBURBS: Final = 1.1
_IN_CORE: Final = 0.3
_IN_TOWN: Final = 0.4
#: Half of the width of roads, and the largest of wide pixels. [cell]
_ROAD: Final = 0.05
_WIDEST: Final = 0.15
#: Mean of the fourth powers of the 289 hashed values from 0 to 1: few roads are bright. [1]
_ROAD_MEAN: Final = sum((k / 288.0) ** 4 for k in range(289)) / 289.0
#: Share of a lattice's light that is between its places and roads, in the brightest towns; and of
#: the coarsest lattice, in addition, in dark land, where the map knows better. [1]
_BETWEEN: Final = 0.4
#: Share of the rest that is on the roads of the coarsest lattice, and its increase per lattice. [1]
_ON_ROADS: Final = 0.06
_MORE_ROADS: Final = 0.12
#: Amplitude of the waves that turn the rows of a lattice, and their wavenumber: eight cells. [1]
_WAVE: Final = 0.4
_WAVENUMBER: Final = 0.25 * pi
#: Largest cell over a pixel of which the pattern is not fainter. [1]
_NEAREST: Final = 150.0
#: Cosines of zenith angles between which the pattern appears. [1]
_GRAZING: Final = 0.02
_STEEP: Final = 0.08
#: Height of houses, from which on an observer sees all lamps. [m]
ROOFS: Final = 12.0
#: Displacement of towns over that of coasts. [1]
BENT: Final = 4.0


class LitPlace(NamedTuple):
    """Place of a lattice.

    Attributes
    ----------
    x, y : float
        Coordinates. [cell]
    own : float
        Hashed value, 0 to 288.
    """

    x: float
    y: float
    own: float


@kernel
def lit_place(i, j, lattice):
    """``LitPlace`` of a cell of a lattice."""
    own = shuffled(shuffled(shuffled(in_period(i)) + in_period(j)) + 17.0 * lattice)
    x = i + 0.5 + _ASIDE * lattice_value(own, 1.0)
    return LitPlace(x, j + 0.5 + _ASIDE * lattice_value(own, 2.0), own)


@kernel
def round_light(square, radius):
    """Light (1 - d²/R²)³ of a disc, of integral 1 over the plane; d² is ``square``. [1]"""
    inside = max(1.0 - square / (radius * radius), 0.0)
    return inside * inside * inside * (4.0 / pi) / (radius * radius)


@kernel
def place_light(x, y, narrow, blur, place):
    """Light of a place, whose mean over places and over a cell is 1.

    Parameters
    ----------
    x, y : float
        Coordinates. [cell]
    narrow : float
        Width over height of a cell. [1]
    blur : float
        Least radius, that of a pixel over the height of a cell. [1]
    place : LitPlace
        Place.
    """
    dx, dy = narrow * (x - place.x), y - place.y
    square, rank = dx * dx + dy * dy, place.own / 288.0 + _LARGEST
    size = narrow * (0.35 + 0.65 * sqrt(_LARGEST / rank))
    light = _IN_CORE * round_light(square, max(_CORE * size, blur))
    light += _IN_TOWN * round_light(square, max(_TOWN * size, blur))
    light += (1.0 - _IN_CORE - _IN_TOWN) * round_light(square, max(_SUBURBS * size, blur))
    return light * narrow / (rank * _PLACE_MEAN)


@kernel
def road_light(x, y, narrow, width, start, end, value):
    """Light of a road between two places, whose mean over roads and over a cell is 1.

    Parameters
    ----------
    x, y, narrow :
        Arguments of ``place_light``.
    width : float
        Half of its width. [cell]
    start, end : LitPlace
        Places.
    value : float
        Hashed value, 0 to 288.
    """
    along_x, along_y = narrow * (end.x - start.x), end.y - start.y
    dx, dy = narrow * (x - start.x), y - start.y
    square = along_x * along_x + along_y * along_y
    part = (dx * along_x + dy * along_y) / square
    if part < 0.0 or part > 1.0:
        return 0.0
    length = sqrt(square)
    away = (dx * along_y - dy * along_x) / (length * width)
    inside = max(1.0 - away * away, 0.0)
    value *= value / 288.0**2
    return value * value * inside * inside * narrow * (15.0 / 16.0) / (width * length * _ROAD_MEAN)


@kernel
def lattice_light(x, y, narrow, blur, lattice, on_roads):
    """Light of places and roads of a lattice, of mean 1.

    Parameters
    ----------
    x, y, narrow, blur :
        Arguments of ``place_light``.
    lattice : float
        Number of the lattice.
    on_roads : float
        Share of roads. [1]
    """
    i, j = float(floor(x)), float(floor(y))
    places = 0.0
    for corner in range(9):
        row = corner // 3
        place = lit_place(i + (corner - 3 * row) - 1.0, j + row - 1.0, lattice)
        places += place_light(x, y, narrow, blur, place)
    own = lit_place(i, j, lattice)
    west, east = lit_place(i - 1.0, j, lattice), lit_place(i + 1.0, j, lattice)
    south, north = lit_place(i, j - 1.0, lattice), lit_place(i, j + 1.0, lattice)
    width = min(max(_ROAD, blur), _WIDEST * narrow)
    roads = road_light(x, y, narrow, width, west, own, shuffled(west.own + 3.0))
    roads += road_light(x, y, narrow, width, own, east, shuffled(own.own + 3.0))
    roads += road_light(x, y, narrow, width, south, own, shuffled(south.own + 4.0))
    roads += road_light(x, y, narrow, width, own, north, shuffled(own.own + 4.0))
    return (1.0 - on_roads) * places + 0.5 * on_roads * roads


@kernel
def lamps_at(lamps, cosine, latitude, longitude, footprint, texel, rows):
    """Light of lamps at a place, whose mean is that of the map. [1]

    Parameters
    ----------
    lamps : float
        Light of the map, above 0. [1]
    cosine : float
        Cosine of the zenith angle of the line of sight. [1]
    latitude, longitude : float
        Place. [rad]
    footprint : float
        Width of the pixel's footprint, from ``texture_footprint``. [m]
    texel : float
        Height of a texel. [m]
    rows : float
        Number of rows of the map.
    """
    factor, scale, narrow = 1.0, _COARSEST, max(cos(latitude), 0.2)
    bright = sqrt(min(lamps, 1.0))
    steep = min(max((cosine - _GRAZING) / (_STEEP - _GRAZING), 0.0), 1.0)
    contrast = (1.0 - _BETWEEN) * bright
    for lattice in range(_LATTICES):
        blur = footprint * scale / texel
        shown = min(0.5 / blur - 1.0, 1.0)
        if shown > 0.0:
            shown *= steep * min(_NEAREST * blur, 1.0) * contrast
            x, y = longitude * rows / pi * scale, (latitude + 0.5 * pi) * rows / pi * scale
            # waves across the axes leave areas as they are
            x += _WAVE * sin(_WAVENUMBER * y)
            y += _WAVE * sin(_WAVENUMBER * x)
            on_roads = _ON_ROADS + _MORE_ROADS * lattice
            light = lattice_light(x, y, narrow, blur, float(lattice), on_roads)
            factor *= 1.0 + shown * (light - 1.0)
        scale *= _STEP
        contrast = 1.0 - _BETWEEN * bright
    return lamps * factor
