"""Edges of detailed ground between the texels of the map, coasts, shallow water, and rivers."""

from __future__ import annotations

from math import pi, sqrt
from typing import Final, NamedTuple

from airlight.image.texels import CHANNELS
from airlight.kernel import inlined, kernel
from airlight.scene.ground_detail import edged, moved_coast, sharper_share, shoal
from airlight.scene.ground_place import map_color

#: Channel of the share of water in the map.
WATER: Final = 3
#: Reflectance of shallow water over that of the land beside it, green or blue, and red, by eye. [1]
SHALLOW: Final = 0.12
SHALLOW_RED: Final = 0.03
#: Growth of the width of edges with the share of water beside them. [texel]
COASTAL: Final = 2.0
#: Red reflectance over blue from which on land counts as arid; how arid land is on both sides of a
#: river and around it at most in its valley, and share of that of the sides there; level of the map
#: of what is around; blue over green of rocks, which are no valleys; and half of the width of the
#: river, 440 m on Earth: by eye. [1], [2 texels]
TAN: Final = 1.2
ARID: Final = 0.09
GREEN: Final = 0.14
GREENER: Final = 0.9
AROUND: Final = 3.0
GREY: Final = 0.62
RIVER: Final = 0.03
#: Elements of ``color`` that are filled later: values beside a place, and extremes of them.
_BESIDE: Final = 12
_LEAST: Final = _BESIDE + CHANNELS
_MOST: Final = _LEAST + CHANNELS


class MapSpot(NamedTuple):
    """Place in a map.

    Attributes
    ----------
    latitude, longitude : float
        Coordinates at which the map is read. [rad]
    width : float
        Width of the pixel, at most 1. [texel]
    river : float
        Share of a river in the pixel. [1]
    """

    latitude: float
    longitude: float
    width: float
    river: float


@kernel
def river_share(here, north, east, south, west, width):
    """Share of a pixel in the river of a green valley between deserts. [1]

    Decoration: the river runs where the valley is the greenest across it, from whose place the
    slope over the curvature is the distance.

    Parameters
    ----------
    here, north, east, south, west : float
        Results of ``arid_at`` there and a texel of its level away. [1]
    width : float
        Width of the pixel. [texel]

    Examples
    --------
    >>> river_share(0.05, 0.2, 0.06, 0.2, 0.06, 0.05), river_share(0.1, 0.1, 0.1, 0.1, 0.1, 0.05)
    (1.0, 0.0)
    """
    up, over = north + south - 2.0 * here, east + west - 2.0 * here
    slope, sides = north - south, min(north, south)
    if over > up:
        slope, sides = east - west, min(east, west)
    bend = max(up, over)
    if sides < ARID or here > GREENER * sides:
        return 0.0
    # across a valley that does not run along a texel's side
    distance = 0.5 * abs(slope) / bend * sqrt(bend / (bend + max(min(up, over), 0.0)))
    fed = min((GREENER * sides - here) / (0.2 * sides), 1.0)
    inside = min(max((RIVER - distance) / width + 0.5, 0.0), min(2.0 * RIVER / width, 1.0))
    return fed * inside


@inlined
def edged_color(spot, view, color):
    """Colours with edges between texels, in the first three of ``color``. [1]

    They change from that of the least red to that of the reddest texel beside: each channel by
    itself would have edges of other hues. Not at coasts, where the land's colour comes from the
    difference of both.

    Parameters
    ----------
    spot, view, color :
        Arguments of ``detailed_land``.
    """
    wet = color[WATER]
    for c in range(WATER):
        color[_LEAST + c] = color[c]
        color[_MOST + c] = color[c]
    for step in range(4):
        beside = pi / view.map_rows if step < 2 else -pi / view.map_rows
        north = beside if step == 0 or step == 2 else 0.0
        map_color(
            view.texels, view.map_rows, view.map_columns, view.map_levels,
            spot.latitude + north, spot.longitude + beside - north, 0.0, color, _BESIDE,
        )  # fmt: skip
        wet = max(wet, color[_BESIDE + WATER])
        dark, bright = color[_BESIDE] < color[_LEAST], color[_BESIDE] > color[_MOST]
        for c in range(WATER):
            if dark:
                color[_LEAST + c] = color[_BESIDE + c]
            if bright:
                color[_MOST + c] = color[_BESIDE + c]
    red, width = color[0], max(spot.width, min(COASTAL * wet, 1.0))
    span = max(color[_MOST] - color[_LEAST], 1e-6)
    share = (edged(red, color[_LEAST], color[_MOST], width) - red) / span
    for c in range(WATER):
        color[c] = max(color[c] + share * (color[_MOST + c] - color[_LEAST + c]), 0.0)


@inlined
def arid_at(latitude, longitude, level, view, color):
    """Red reflectance of a level of the map less ``TAN`` times the blue one. [1]

    Parameters
    ----------
    latitude, longitude : float
        Coordinates. [rad]
    level : float
        Level of the map.
    view, color :
        Arguments of ``detailed_land``.
    """
    map_color(
        view.texels, view.map_rows, view.map_columns, view.map_levels,
        latitude, longitude, level, color, _BESIDE,
    )  # fmt: skip
    return color[_BESIDE] - TAN * color[_BESIDE + 2]


@inlined
def river(spot, view, color):
    """Share of a pixel in a river, whose valley is seen between texels of twice the size. [1]

    Parameters
    ----------
    spot, view, color :
        Arguments of ``detailed_land``.
    """
    lat, lon, around, found = spot.latitude, spot.longitude, 0.0, 0.0
    grey = color[2] > GREY * color[1]
    if color[WATER] <= 0.0 and not grey and color[0] - TAN * color[2] < GREEN:
        around = arid_at(lat, lon, AROUND, view, color)
    if around > ARID:
        step = 2.0 * pi / view.map_rows
        here = arid_at(lat, lon, 1.0, view, color)
        north = arid_at(lat + step, lon, 1.0, view, color)
        east = arid_at(lat, lon + step, 1.0, view, color)
        south = arid_at(lat - step, lon, 1.0, view, color)
        west = arid_at(lat, lon - step, 1.0, view, color)
        found = river_share(here, north, east, south, west, 0.5 * spot.width)
    return found


@inlined
def land_and_water(red, green, blue, share, shore, spot, view, color):
    """Colours of a pixel of land and water, into the first four values of ``color``. [1]

    Parameters
    ----------
    red, green, blue : float
        Reflectance of the land. [1]
    share : float
        Share of water of the map. [1]
    shore : float
        Displacement of the coast. [texel]
    spot, view, color :
        Arguments of ``detailed_land``.
    """
    coast, width = moved_coast(share, shore), spot.width
    wet, shallow = sharper_share(coast, width), (1.0 - width) * shoal(coast)
    wet = max(wet, spot.river)
    color[0] = red + wet * (view.water.x + SHALLOW_RED * shallow * red - red)
    color[1] = green + wet * (view.water.y + SHALLOW * shallow * green - green)
    color[2] = blue + wet * (view.water.z + SHALLOW * shallow * blue - blue)
    color[WATER] = wet
