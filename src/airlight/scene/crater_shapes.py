"""Shapes of craters: slopes, shadows, what a line of sight meets, and rays; not data.

Slopes are those of a bowl with the depth and rim of a fresh crater (Pike 1977, in Impact and
Explosion Cratering, 489), which ages to a shallow one without rim, as by diffusion (Fassett &
Thomson 2014, JGR Planets 119, 2255). Wide ones have level floors, terraces and central peaks, and
are shallower (Pike 1980, Icarus 43, 1). Fresh bowls are in the shadow of their rims, and near rims
hide what is behind them. Soil of fresh ones is brighter, in rays. Wind fills those of bodies with
air.
"""

from __future__ import annotations

from math import log2, pi, sin, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import plane_noise
from airlight.geometry.vectors import Vec3, dot, scaled
from airlight.kernel import kernel

#: Depth below the rim's foot and height of the rim of a fresh crater over its diameter. [1]
DEPTH: Final = 0.16
RIM: Final = 0.036
#: Radius at which the rim's slope ends, over the crater's. [1]
EJECTA: Final = 1.6
#: Diameters between which craters get level floors [m], and radius of the floor, over the crater's,
#: of those wider; radius and steepest slope of their peaks, and contrast of three terraces, by eye.
SIMPLE: Final = 10e3
COMPLEX: Final = 22e3
FLOOR: Final = 0.5
PEAK: Final = 0.18
STEEP: Final = 0.5
TERRACED: Final = 0.3
#: Radius at which bright soil ends [cell], change of the reflectance in the middle of a fresh
#: crater, whose soil is immature, contrast of its rays [1], and
#: diameter below which all of it fades [m], by eye.
REACH: Final = 0.48
BRIGHT: Final = 0.8
RAYS: Final = 0.8
RAYED: Final = 100.0
#: Radius of the floors of craters that wind fills, and the freshness of the profile of the
#: freshest and its power for others, by eye. [1]
FILLED: Final = 0.6
SHALLOW: Final = 0.9
WORN: Final = 0.33
#: Octaves of lumps of walls and ejecta, cells of the coarsest in a radius, ratio of successive
#: ones, and slope over that of the noise; share of it on floors; share of the radius by which they
#: move terraces, and ratio of the slopes of successive ones; all by eye. [1]
LUMPS: Final = 3
LUMP: Final = 2.1
FINER: Final = 2.3
ROUGH: Final = 0.08
SMOOTH: Final = 0.35
BROKEN: Final = 0.4
FADING: Final = 0.65
#: Longest axis of a pixel on walls, which face the observer, over its width, by eye. [1]
WALL: Final = 2.0
#: Width over the radius of the rim of a crater that is worn down, by eye. [1]
ROUNDED: Final = 0.6


class Crater(NamedTuple):
    """Crater of a cell.

    Attributes
    ----------
    radius : float
        Radius. [cell]
    fresh : float
        Freshness, from 0 to 1, of which small values are the most. [1]
    along, across : float
        Numbers that ``shuffled`` makes its second harmonics.
    """

    radius: float
    fresh: float
    along: float
    across: float


@kernel
def level_floor(diameter):
    """Radius of the level floor of a crater over its radius. [1]

    Parameters
    ----------
    diameter : float
        Diameter. [m]

    Examples
    --------
    >>> level_floor(5e3), level_floor(22e3)
    (0.0, 0.5)
    """
    if diameter <= SIMPLE:
        return 0.0
    return FLOOR * min(log2(diameter / SIMPLE) / log2(COMPLEX / SIMPLE), 1.0)


@kernel
def crater_slope(distance, fresh, level):
    """Slope of a crater away from its centre. [1]

    Of a fresh one a parabola from the floor to the rim, and ejecta; of an old one, with the depth z
    and the ratio t of the distance to ``EJECTA``, that of -z (1 - t²)³.

    Parameters
    ----------
    distance : float
        Distance from the centre over the radius. [1]
    fresh : float
        Freshness; the depth of an old crater is in proportion to it. [1]
    level : float
        Result of ``level_floor``. [1]

    Examples
    --------
    >>> crater_slope(0.0, 1.0, 0.0), round(crater_slope(0.5, 1.0, 0.0), 3)
    (0.0, 0.392)
    >>> crater_slope(0.4, 1.0, 0.5), abs(crater_slope(2.0, 1.0, 0.0))
    (0.0, 0.0)
    """
    left = max(1.0 - distance * distance / (EJECTA * EJECTA), 0.0)
    worn = (1.0 - level) * 12.0 * DEPTH / (EJECTA * EJECTA) * distance * left * left
    wall = max(distance - level, 0.0) / (1.0 - level)
    sharp = 4.0 * (DEPTH + RIM) * wall
    if distance > 1.0:
        left = max((EJECTA - distance) / (EJECTA - 1.0), 0.0)
        sharp = -6.0 * RIM * left / (distance * distance * distance * distance)
    elif level > 0.0:
        sharp *= 1.0 + TERRACED * level / FLOOR * sin(6.0 * pi * wall)
        if distance < PEAK:
            sharp -= STEEP * level / FLOOR * sin(pi / PEAK * distance)
    return fresh * (fresh * sharp + (1.0 - fresh) * worn)


@kernel
def shadowed(towards, square, fresh, level, tangent, blur):
    """Share of a place within the rim of a crater to which the rim casts its shadow. [1]

    The line towards the star leaves the circle of the rim after s = √(b² + 1 - r²) - b; the
    place lies in shadow if it is lower than s over the tangent of the star's zenith angle.

    Parameters
    ----------
    towards, square : float
        Component b of the place towards the star, times ``tangent``, and the square of its distance
        r from the centre, over the radius and its square. [1]
    fresh, level, tangent : float
        Freshness, ``level_floor``, and tangent of the star's zenith angle. [1]
    blur : float
        Width of the pixel over the radius. [1]

    Examples
    --------
    >>> shadowed(2.5, 0.25, 1.0, 0.0, 5.0, 0.01), shadowed(-0.5, 0.25, 1.0, 0.0, 1.0, 0.01)
    (1.0, 0.0)
    """
    # no wall is steeper than the line
    if square >= 1.0 or 4.0 * (DEPTH + RIM) * fresh * fresh * tangent <= 1.0:
        return 0.0
    wall = max(sqrt(square) - level, 0.0) / (1.0 - level)
    deep = 2.0 * (DEPTH + RIM) * (1.0 - level) * (1.0 - wall * wall) * fresh * fresh
    along = towards / tangent
    lower = tangent * deep - sqrt(along * along + 1.0 - square) + along
    # nearer to the rim the penumbra is narrower
    return min(max(lower / ((4.0 * blur + 0.05) * (1.0 - square)), 0.0), 1.0)


@kernel
def sunk(along, flat, square, fresh):
    """Depth over the radius at which a line of sight meets a bowl. [1]

    With the tangent f of the line's zenith angle, k h² f² + (2 k b + 1) h = k (1 - r²) for a depth
    k (1 - r²). Of an old one k has half of its depth, which lies outside.

    Parameters
    ----------
    along, flat : float
        Component b away from the observer of the place at which the line passes the rim's level,
        times f, over the radius; and f². [1]
    square : float
        Square of the distance r of that place from the centre, over that of the radius. [1]
    fresh : float
        Freshness. [1]

    Examples
    --------
    >>> round(sunk(0.0, 0.0, 0.0, 1.0), 3), round(sunk(0.0, 25.0, 0.0, 1.0), 3)
    (0.392, 0.155)
    """
    deep = fresh * (DEPTH + (DEPTH + 2.0 * RIM) * fresh)
    middle = 1.0 + 2.0 * deep * along
    root = sqrt(middle * middle + 4.0 * deep * deep * flat * (1.0 - square))
    return 2.0 * deep * (1.0 - square) / max(middle + root, 1e-6)


@kernel
def lumps(x, y, blur, crater, way):
    """Height of the coarsest lumps, of mean 0, and ascent of all along a direction. [1]

    Parameters
    ----------
    x, y, blur : float
        Place from the centre and width of the pixel over the radius. [1]
    crater : Crater
        Crater.
    way : Vec3
        Direction. [1]
    """
    height, ascent, cells, loud = 0.0, 0.0, LUMP, 1.0
    for octave in range(LUMPS):
        shown = min(1.0 / (blur * cells) - 1.0, 1.0)
        if shown > 0.0:
            value, slope_x, slope_y = plane_noise(
                crater.along + cells * x, crater.across + cells * y
            )
            if octave == 0:
                height = shown * value
            ascent += loud * shown * (slope_x * way.x + slope_y * way.y)
        cells *= FINER
        loud *= FADING
    return height, ascent


@kernel
def pit_light(away, distance, crater, way, ray, width, cell, weathered):
    """Direct light of a place in a crater over that of level ground. [1]

    A pixel on the rim has the light of both sides of it.

    Thickness of ejecta is as (r/R)^-3 (McGetchin, Settle & Head 1973, EPSL 20, 226).

    Parameters
    ----------
    away, distance : Vec3, float
        Place from the centre, and its distance, up to ``REACH``. [cell]
    crater : Crater
        Crater.
    way, ray, weathered :
        Arguments of ``craters``.
    width : float
        Width of the pixel across the line of sight. [cell]
    cell : float
        Size of a cell. [m]
    """
    radius, depth = crater.radius, crater.fresh
    within, inverse, flat = distance / radius, 1.0 / distance, dot(ray, ray)
    level, rough = level_floor(2.0 * radius * cell), ROUGH * depth * depth
    if weathered:
        level, depth = FILLED, SHALLOW * depth**WORN
    stretched = dot(away, ray) * inverse
    sharp = width * sqrt(1.0 + stretched * stretched) / radius
    blur = sharp + ROUNDED * (1.0 - depth) * (1.0 - depth)
    inside = min(max(0.5 + (1.0 - within) / blur, 0.0), 1.0)
    towards = dot(away, way) * inverse
    light = 0.0
    if inside < 1.0:
        slope = crater_slope(max(within, 1.0 + 0.25 * blur), depth, level) * towards
        thin = 1.0 - distance * distance / (REACH * REACH)
        thin *= rough / (within * within * within)
        if thin > 0.01:
            height, ascent = lumps(away.x / radius, away.y / radius, sharp, crater, way)
            slope += thin * ascent
        light = (1.0 - inside) * max(1.0 - slope, 0.0)
    if inside > 0.0:
        part = min(within, 1.0 - min(0.25 * blur, 0.5))
        if flat > 0.0:
            scaled_part = part * inverse
            met = sunk(stretched * part, flat, part * part, depth)
            away = Vec3(
                scaled_part * away.x + met * ray.x,
                scaled_part * away.y + met * ray.y,
                scaled_part * away.z + met * ray.z,
            )
            part = max(sqrt(dot(away, away)), 1e-6)
            towards = dot(away, way) / part
        else:
            away = scaled(away, part * inverse)
        ascent = 0.0
        towards_star, square = towards * part, part * part
        if rough > 0.01:
            height, ascent = lumps(away.x, away.y, sharp, crater, way)
            ascent *= rough * (SMOOTH + (1.0 - SMOOTH) * min(part, 1.0))
            # the rim stays where it is
            part *= 1.0 + BROKEN * height * max(1.0 - part, 0.0)
        slope = crater_slope(min(part, 1.0), depth, level) * towards + ascent
        sharp = min(sharp, WALL * width / radius)
        dark = shadowed(towards_star, square, depth, level, sqrt(dot(way, way)), sharp)
        light += inside * (1.0 - dark) * max(1.0 - slope, 0.0)
    return light


@kernel
def crater_tone(distance, within, streak):
    """Change of the reflectance by the rays of a crater, over ``BRIGHT``. [1]

    Parameters
    ----------
    distance : float
        Distance from the centre. [cell]
    within : float
        The same over the radius. [1]
    streak : float
        Noise of the direction, of mean 0. [1]
    """
    thin = 1.0 - distance * distance / (REACH * REACH)
    if thin <= 0.0:
        return 0.0
    return thin * thin * (1.0 + RAYS * streak * min(within, 1.0))
