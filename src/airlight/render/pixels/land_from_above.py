"""Decoration of land below the resolution of its maps, seen from above its hills."""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import Final

from airlight.geometry.vectors import Vec3, cross, dot, plus, scaled
from airlight.kernel import inlined
from airlight.render.pixels.relief import height_at
from airlight.scene.ground_detail import above_threshold
from airlight.scene.ground_place import latitude_longitude, map_value
from airlight.scene.valleys import dunes, farmland, valleys

#: Slope of the map's heights from which on land is rugged; height over cells of the smooth relief
#: in plains, and its ratio to the slope of rugged land, by eye. [1]
RUGGED: Final = 0.018
PLAIN: Final = 0.0025
MOUNTAIN: Final = 5.3
#: Contrast of valleys and of fields over that of the grain of the map, by eye. [1]
VALLEYS: Final = 1.2
FIELDS: Final = 2.6
#: What bare land adds to the contrast of valleys: their sediment is bright. [1]
WADIS: Final = 0.7
#: Contrast of sheets of sand and gravel in bare plains over that of the grain of the map, and of
#: valleys in plains over that in rugged land, by eye. [1]
SHEETS: Final = 0.55
SMOOTH: Final = 0.15
#: Changes of the ratio of red to green by fields, alike and unlike their tone: ripe and bare ones
#: are bright. By eye. [1]
RIPE: Final = 0.06
HUE: Final = 0.08
#: Share of fields that rugged land lacks. [1]
STEEPER: Final = 0.7
#: Share of built land over the map's light of cities, its limits, and reciprocal of the width of
#: its edges, by eye. [1]
LAMPS: Final = 0.7
LEAST_TOWN: Final = 0.02
LARGEST_TOWN: Final = 0.6
SHARP: Final = 4.0
#: Contrast of built land over that of the grain of the map, and change of the ratio of red to green
#: by it on green land. [1]
BUILT: Final = 3.0
BUILT_HUE: Final = 0.25
#: Green reflectances of closed woods, which have few fields, and of fields. [1]
WOODED: Final = 0.03
TILLED: Final = 0.06
#: Least share of fields on land that is not of crops. [1]
WILD: Final = 0.25
#: Red reflectances of stones and of sand with dunes, and contrast of these, by eye. [1]
STONY: Final = 0.32
SANDY: Final = 0.45
HEAPED: Final = 1.1
#: What snow takes from the contrast of valleys. [1]
SNOWED: Final = 0.6


@inlined
def map_slope(place, bottom, view):
    """Horizontal gradient of the map's heights. [1]

    Parameters
    ----------
    place : Vec3
        Place from the centre, in the planet's frame, over the radius. [1]
    bottom : float
        Radius of the ground. [m]
    view : ViewUniforms
        Camera with its map of heights.
    """
    latitude, longitude = latitude_longitude(place)
    angle = pi / view.over_rows
    here = height_at(latitude, longitude, 0, view)
    north = height_at(latitude + angle, longitude, 0, view) - here
    parallel = max(cos(latitude), 0.05)
    east = height_at(latitude, longitude + angle / parallel, 0, view) - here
    level = max(sqrt(place.x * place.x + place.y * place.y), 1e-6)
    eastwards = Vec3(-place.y / level, place.x / level, 0.0)
    upwards = scaled(cross(place, eastwards), north / (angle * bottom))
    return plus(upwards, scaled(eastwards, east / (angle * bottom)))


@inlined
def land_from_above(place, finest, blur, way, uneven, leaf, snow, frame, color):
    """Ascent towards the star [1], and changes of reflectance and hue by valleys, fields and towns.

    Parameters
    ----------
    place : Vec3
        Place from the centre, in the planet's frame, over the radius. [1]
    finest, blur : Vec3, float
        Place from the observer's lattice point, and size of the pixel. [finest cell]
    way : Vec3
        Horizontal direction towards the star. [1]
    uneven, leaf, snow : float
        Contrast of the land over that of dark land, shares of green plants and of snow. [1]
    frame, color :
        Arguments of ``detailed_land``.

    Returns
    -------
    ascent, tone, hue : float
        Tangent; change of the reflectance over ``LOUD`` times the grain; change of red over green.
    """
    view = frame.camera
    slope = map_slope(place, frame.tables.bottom, view)
    length = sqrt(dot(slope, slope))
    rough = min(length / RUGGED, 1.0)
    steep = PLAIN + MOUNTAIN * length * rough
    found = valleys(finest, blur, view.whole, place, way, slope, steep)
    tone = VALLEYS * (SMOOTH + (1.0 - SMOOTH) * rough) * (1.0 - SNOWED * snow) * found.tone
    tone *= 1.0 + WADIS * (1.0 - leaf) * max(0.3 + found.height, 0.0)
    tone += SHEETS * (1.0 - leaf) * (1.0 - snow) * (1.0 - rough) * found.height
    tilled = min(max((color[1] - WOODED) / (TILLED - WOODED), WILD), 1.0)
    tilled *= uneven * (1.0 - STEEPER * rough) * (1.0 - snow)
    field, variance, hue = farmland(finest, blur, view.whole, found.height)
    tone += FIELDS * tilled * leaf * field
    hue = tilled * leaf * (HUE * hue + RIPE * field)
    sandy = min(max((color[0] - STONY) / (SANDY - STONY), 0.0), 1.0)
    sandy *= (1.0 - rough) * (1.0 - snow) * (1.0 - leaf)
    if sandy > 0.0:
        tone += HEAPED * sandy * dunes(finest, blur, view.whole, found.height)
    latitude, longitude = latitude_longitude(place)
    town = LAMPS * map_value(
        view.over_texels, view.over_rows, view.over_columns, 0, latitude, longitude, 0
    )
    if town > LEAST_TOWN and variance > 0.0:
        town = min(town, LARGEST_TOWN)
        built = above_threshold(town, SHARP, field, variance) - town
        tone += BUILT * built * (1.0 - snow)
        hue += BUILT_HUE * leaf * built
    return found.ascent, tone, hue
