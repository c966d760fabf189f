"""Point where a line of sight meets the ground, and the colour of the map there.

All functions work on numbers and flat arrays, for the renderer and for the shader.
"""

from __future__ import annotations

from math import atan2, cos, floor, log2, pi, sin, sqrt
from typing import NamedTuple

from airlight.geometry.vectors import plus, scaled
from airlight.image.texels import CHANNELS, channel_of
from airlight.kernel import inlined, kernel
from airlight.scene.map_levels import level_place


@kernel
def moved_on(end, ray, cosine, angle, bottom):
    """True ground intersection of a refracted line, from that in optical radius.

    The end moves along the ground in the horizontal direction of the line.

    Parameters
    ----------
    end : Vec3
        End of the straight line, on the ground. [m]
    ray : Vec3
        Unit vector along the line, away from the observer. [1]
    cosine : float
        Cosine of the angle between the line and the vertical at its end, 0 to 1. [1]
    angle : float
        Angle of refraction of the line. [rad]
    bottom : float
        Radius of the ground. [m]

    Returns
    -------
    Vec3
        True end, at the same distance from the centre. [m]

    Examples
    --------
    >>> from airlight.geometry.vectors import Vec3
    >>> moved_on(Vec3(0.0, 0.0, 2.0), Vec3(1.0, 0.0, 0.0), 0.0, 0.5 * pi, 2.0).x  # a quarter turn
    2.0
    """
    if angle == 0.0:
        return end
    sine = sqrt(max((1.0 - cosine) * (1.0 + cosine), 1e-18))
    keep = cos(angle) + sin(angle) * cosine / sine
    away = sin(angle) * bottom / sine
    return plus(scaled(end, keep), scaled(ray, away))


@kernel
def latitude_longitude(point):
    """Geocentric latitude and longitude of a point in the planet's frame. [rad]

    Parameters
    ----------
    point : Vec3
        Coordinates towards latitude 0 and longitude 0, towards latitude 0 and 90° east, and towards
        the north pole; any unit. [m]

    Examples
    --------
    >>> from airlight.geometry.vectors import Vec3
    >>> latitude_longitude(Vec3(0.0, -1.0, 0.0))  # 90° west
    (0.0, -1.5707963267948966)
    """
    level = sqrt(point.x * point.x + point.y * point.y)
    return atan2(point.z, level), atan2(point.y, point.x)


@kernel
def map_level(pixel_angle, reach, cosine, bottom, rows):
    """Mip level whose texels match the footprint of a pixel on the ground.

    The footprint is an ellipse; its size is the geometric mean of its axes.

    Parameters
    ----------
    pixel_angle : float
        Angle of a pixel of the picture. [rad]
    reach : float
        Distance from the observer to the ground. [m]
    cosine : float
        Cosine of the angle between line of sight and vertical there. [1]
    rows : float
        Number of rows of the full map.

    Returns
    -------
    float
        Level: 0 where the sizes are equal, one more for each halving; negative where the map is too
        coarse. [1]

    Examples
    --------
    >>> map_level(1e-3, 2000.0 * pi, 1.0, 1000.0, 1000.0)  # twice as large as the map's pixels
    1.0
    """
    footprint = pixel_angle * reach / (bottom * sqrt(max(cosine, 0.05)))
    return log2(max(footprint * rows / pi, 1e-6))


class MapCell(NamedTuple):
    """Four texels around a place, and its position between them.

    Attributes
    ----------
    upper_west, upper_east, lower_west, lower_east : int
        Indices among the texels of all mip levels.
    right, down : float
        Position from the west and from the north, 0 to 1. [1]
    """

    upper_west: int
    upper_east: int
    lower_west: int
    lower_east: int
    right: float
    down: float


@kernel
def map_cell(rows, columns, level, latitude, longitude):
    """``MapCell`` of a place in a mip level.

    Parameters
    ----------
    rows, columns : int
        Size of the full map.
    level : int
        Existing level.
    latitude, longitude : float
        Geocentric coordinates. [rad]
    """
    start, height, width = level_place(rows, columns, level)
    y = min(max((0.5 - latitude / pi) * height - 0.5, 0.0), height - 1.0)
    x = (0.5 + longitude / (2.0 * pi)) * width - 0.5
    top = min(int(y), max(height - 2, 0))
    west = floor(x)
    down, right = y - top, x - west
    bottom = min(top + 1, height - 1)
    east = (west + 1) % width
    west = (west + width) % width
    upper = start + width * top
    lower = start + width * bottom
    return MapCell(upper + west, upper + east, lower + west, lower + east, right, down)


@inlined
def map_color(texels, rows, columns, levels, latitude, longitude, level, out, at):
    """Trilinear interpolation of a map between texels and mip levels.

    Parameters
    ----------
    texels : array of uint8, flat
        Texels of ``airlight.image.texels`` of all mip levels, one level after another.
    rows, columns, levels : int
        Size of the full map, and number of levels.
    latitude, longitude : float
        Geocentric coordinates. [rad]
    level : float
        Level; 0 is the full map, 1 its half; clamped to the existing levels. [1]
    out : array, shape (at + 4,)
        Receives the linear values from index ``at`` on: for a ground map, sRGB reflectance and
        water fraction. [1]
    at : int
        Constant: index of the first of them.
    """
    level = min(max(level, 0.0), levels - 1.0)
    first = min(int(level), max(levels - 2, 0))
    for c in range(CHANNELS):
        out[at + c] = 0.0
    for step in range(2):
        which = min(first + step, levels - 1)
        part = (level - first) if step == 1 else 1.0 - (level - first)
        if part <= 0.0:
            continue
        cell = map_cell(rows, columns, which, latitude, longitude)
        upper, lower = part * (1.0 - cell.down), part * cell.down
        add_texel(texels, cell.upper_west, upper * (1.0 - cell.right), out, at)
        add_texel(texels, cell.upper_east, upper * cell.right, out, at)
        add_texel(texels, cell.lower_west, lower * (1.0 - cell.right), out, at)
        add_texel(texels, cell.lower_east, lower * cell.right, out, at)


@inlined
def map_channel(texels, rows, columns, levels, latitude, longitude, level, channel):
    """Trilinear interpolation of one channel of a map, as by ``map_color``. [1]

    Parameters
    ----------
    texels, rows, columns, levels, latitude, longitude, level :
        Arguments of ``map_color``.
    channel : int
        0 to 2 for the colours, 3 for alpha.
    """
    level = min(max(level, 0.0), levels - 1.0)
    first = min(int(level), max(levels - 2, 0))
    part = level - first
    value = 0.0
    if part < 1.0:
        near = map_value(texels, rows, columns, first, latitude, longitude, channel)
        value += (1.0 - part) * near
    if part > 0.0:
        far = map_value(texels, rows, columns, first + 1, latitude, longitude, channel)
        value += part * far
    return value


@inlined
def map_value(texels, rows, columns, level, latitude, longitude, channel):
    """Bilinear interpolation of one channel of a mip level.

    Parameters
    ----------
    texels, rows, columns, latitude, longitude :
        Arguments of ``map_color``.
    level : int
        Existing level.
    channel : int
        0 to 2 for the colours, 3 for alpha.

    Returns
    -------
    float
        Linear value. [1]
    """
    cell = map_cell(rows, columns, level, latitude, longitude)
    above = channel_of(texels, cell.upper_west, channel) * (1.0 - cell.right)
    above += channel_of(texels, cell.upper_east, channel) * cell.right
    below = channel_of(texels, cell.lower_west, channel) * (1.0 - cell.right)
    below += channel_of(texels, cell.lower_east, channel) * cell.right
    return above * (1.0 - cell.down) + below * cell.down


@inlined
def add_texel(texels, texel, weight, out, at):
    """Add a texel times its weight to four elements of ``out``, from index ``at`` on. [1]"""
    out[at + 0] += weight * channel_of(texels, texel, 0)
    out[at + 1] += weight * channel_of(texels, texel, 1)
    out[at + 2] += weight * channel_of(texels, texel, 2)
    out[at + 3] += weight * channel_of(texels, texel, 3)
