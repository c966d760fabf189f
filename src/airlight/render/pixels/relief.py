"""Sunlight on the slopes of the ground, and shadows of mountains, by a map of heights.

Decoration of pictures: air and solver have a smooth sphere. The slope is that along the azimuth of
the star, which alone changes direct light to first order; heights further along it give the
shadow.
"""

from __future__ import annotations

from math import pi, sqrt
from typing import Final

from airlight.kernel import inlined, kernel
from airlight.render.pixels.star_azimuth import star_azimuth
from airlight.scene.ground_place import map_value

#: Height of a map value of 1: NASA's picture of the Earth's topography ends there. [m]
HIGHEST: Final = 6400.0
#: Channel of the heights in the overlay.
CHANNEL: Final = 1
#: Number of places towards the star at which mountains are looked for, each twice as far.
TAPS: Final = 4
#: Sine of the star's elevation below which slopes count as at it: there the level ground's direct
#: light, by which they are divided, vanishes. [1]
LOWEST: Final = 0.06
#: Largest factor of direct light. [1]
BRIGHTEST: Final = 2.5
#: Tangent of the elevation of the steepest skyline of the map. [1]
STEEPEST: Final = 0.35
#: Width of the edge of a shadow, in tangents of elevation: the sun's disc, and heights that are
#: known at distances of texels. [1]
EDGE: Final = 0.02


@kernel
def slope_light(mu_s, slope):
    """Direct irradiance of a slope over that of level ground. [1]

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle. [1]
    slope : float
        Tangent of the ascent towards the star's azimuth. [1]

    Examples
    --------
    >>> slope_light(1.0, 0.3), round(slope_light(0.5, -0.1), 4)  # 1 + 0.1 tan 60°
    (1.0, 1.1732)
    """
    sine = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0))
    return min(max(1.0 - slope * sine / max(mu_s, LOWEST), 0.0), BRIGHTEST)


@kernel
def unshaded(elevation, skyline):
    """Share of the star that is above a skyline, from the tangents of their elevations. [1]

    Examples
    --------
    >>> unshaded(0.1, 0.0), unshaded(0.1, 0.1), unshaded(0.0, 0.1)
    (1.0, 0.5, 0.0)
    """
    part = min(max(0.5 + (elevation - skyline) / EDGE, 0.0), 1.0)
    return part * part * (3.0 - 2.0 * part)


@inlined
def height_at(latitude, longitude, level, view):
    """Height of the ground. [m]

    Parameters
    ----------
    latitude, longitude : float
        Geocentric coordinates. [rad]
    level : int
        Mip level of the overlay.
    view : ViewUniforms
        Camera with its maps.
    """
    return HIGHEST * map_value(
        view.over_texels, view.over_rows, view.over_columns, level, latitude, longitude, CHANNEL
    )


@inlined
def relief_light(end, latitude, longitude, level, observer, frame):
    """Direct light of the ground with its relief over that of a smooth sphere. [1]

    Parameters
    ----------
    end : Vec3
        End of the line of sight on the ground, from the centre, in the observer's frame. [m]
    latitude, longitude : float
        Its coordinates. [rad]
    level : float
        Level of the overlay. [1]
    observer, frame : Observer, FrameTables
        Observer, and what the pixels read.
    """
    view, bottom = frame.camera, frame.tables.bottom
    star = star_azimuth(end, latitude, longitude, bottom, observer)
    if star.mu_s <= 0.0 or star.sine < 1e-3:
        return 1.0
    north, east = star.north, star.east
    which = int(min(max(level, 0.0), view.over_levels - 1.0))
    angle = pi / view.over_rows * 2.0**which
    length = angle * bottom
    behind = height_at(latitude - angle * north, longitude - angle * east, which, view)
    other = height_at(latitude + angle * north, longitude + angle * east, which, view)
    light = slope_light(star.mu_s, (other - behind) / (2.0 * length))
    elevation = star.mu_s / star.sine
    if elevation < STEEPEST:
        here = height_at(latitude, longitude, which, view)
        # the sphere falls away below the tangent
        skyline = (other - here) / length - 0.5 * angle
        for _tap in range(TAPS - 1):
            angle *= 2.0
            length *= 2.0
            other = height_at(latitude + angle * north, longitude + angle * east, which, view)
            skyline = max(skyline, (other - here) / length - 0.5 * angle)
        light *= unshaded(elevation, skyline)
    return light
