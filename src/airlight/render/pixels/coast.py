"""Coasts of detailed ground: a line finer than the texels of the map, and shallow water."""

from __future__ import annotations

from typing import Final, NamedTuple

from airlight.kernel import inlined
from airlight.scene.ground_detail import moved_coast, sharper_share, shoal
from airlight.scene.ground_place import map_value

#: Channel of the share of water in the map.
WATER: Final = 3
#: Reflectance of shallow water over that of the land beside it, green or blue, and red, by eye. [1]
SHALLOW: Final = 0.12
SHALLOW_RED: Final = 0.03


class MapSpot(NamedTuple):
    """Place in a map.

    Attributes
    ----------
    latitude, longitude : float
        Coordinates at which the map is read. [rad]
    width : float
        Width of the pixel, at most 1. [texel]
    """

    latitude: float
    longitude: float
    width: float


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
    coast, width = share, spot.width
    if width < 1.0 and share > 0.0:
        # without the edges between the colours of texels
        even = map_value(
            view.texels, view.map_rows, view.map_columns, 0, spot.latitude, spot.longitude, WATER
        )
        coast += (1.0 - width) * (even - coast)
    coast = moved_coast(coast, shore)
    wet, shallow = sharper_share(coast, width), (1.0 - width) * shoal(coast)
    color[0] = red + wet * (view.water.x + SHALLOW_RED * shallow * red - red)
    color[1] = green + wet * (view.water.y + SHALLOW * shallow * green - green)
    color[2] = blue + wet * (view.water.z + SHALLOW * shallow * blue - blue)
    color[WATER] = wet
