"""Decoration of land below the resolution of its maps, seen from above its hills."""

from __future__ import annotations

from math import cos, pi, sqrt
from typing import Final

from airlight.geometry.vectors import Vec3, cross, dot, plus, scaled
from airlight.kernel import inlined
from airlight.render.pixels.relief import height_at
from airlight.scene.ground_place import latitude_longitude
from airlight.scene.valleys import farmland, valleys

#: Slope of the map's heights from which on land is rugged; height over cells of the smooth relief
#: in plains, and its ratio to the slope of rugged land, by eye. [1]
RUGGED: Final = 0.018
PLAIN: Final = 0.0025
MOUNTAIN: Final = 5.3
#: Contrast of valleys and of fields over that of the grain of the map, by eye. [1]
VALLEYS: Final = 1.2
FIELDS: Final = 2.0
#: Contrast of valleys in plains over that in rugged land. [1]
SMOOTH: Final = 0.12
#: Change of the ratio of red to green by fields. [1]
HUE: Final = 0.2
#: Green reflectances of closed woods, which have few fields, and of fields. [1]
WOODED: Final = 0.03
TILLED: Final = 0.06
#: Least share of fields on land that is not of crops. [1]
WILD: Final = 0.25
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
    """Ascent towards the star [1], and changes of reflectance and hue of valleys and fields.

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
    tilled = min(max((color[1] - WOODED) / (TILLED - WOODED), WILD), 1.0)
    tilled *= uneven * (1.0 - rough) * (1.0 - snow)
    field, hue = farmland(finest, blur, view.whole, found.height)
    tone += FIELDS * tilled * (WILD + (1.0 - WILD) * leaf) * field
    return found.ascent, tone, HUE * tilled * leaf * hue
