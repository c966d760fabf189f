"""Craters of airless bodies between some texels of maps and a metre; they are not data.

In equilibrium, where new craters erase old ones, the number per area of those wider than D is
c D^-2; the c of the lunar maria is 0.079 (Trask 1966, JPL Tech. Rep. 32-800, 252: 10^10.9 D^-2 per
10^6 km², D in metres). Beyond a diameter it falls as D^-3, near the production of new ones
(Neukum, Ivanov & Hartmann 2001, Space Sci. Rev. 96, 55): on the maria some 300 m, in the highlands
tens of kilometres (Hartmann 1984, Icarus 60, 56). Each cell of a lattice has at most one crater, of
the diameters between those of the next finer and its own lattice; cells are on the face of a cube,
distances on the ground. Slopes are those of a bowl with the depth and rim of a fresh crater (Pike
1977, in Impact and Explosion Cratering, 489), which ages to a shallow one without rim, as by
diffusion (Fassett & Thomson 2014, JGR Planets 119, 2255); old ones are the most. Wide ones have
level floors, terraces and central peaks, and are shallower (Pike 1980, Icarus 43, 1). Fresh bowls
are in the shadow of their rims, and near rims hide what is behind them. Soil of fresh ones is
brighter, in rays. Seen from above, mean sunlight and mean reflectance remain.
"""

from __future__ import annotations

from math import floor, log2, pi, sin, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import in_period, plane_noise, shuffled
from airlight.geometry.vectors import Vec3, dot
from airlight.kernel import kernel
from airlight.scene.ground_detail import along_lattice

#: Number of lattices, and cells of the coarsest over the finest of ``ground_detail``: with the
#: packaged map of the Moon 57 km, so that craters are at most 34 km wide.
LATTICES: Final = 18
COARSEST: Final = 1048576.0
#: Diameter of the widest crater of a lattice, twice that of the narrowest. [cell]
WIDEST: Final = 0.6
#: Diameters above which craters are fewer than in equilibrium, on maria and in highlands, and green
#: reflectances of both in the packaged map. [m], [1]
MARE: Final = 300.0
HIGHLAND: Final = 2e4
DARK: Final = 0.065
LIGHT: Final = 0.095
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
TERRACED: Final = 0.5
#: Largest tangent of the star's zenith angle: rims shade one another below. [1]
LOWEST: Final = 6.0
#: Share of craters that are shallower, as if flooded. [1]
FLOODED: Final = 0.25
#: Least width of a pixel for craters over its longer axis, by eye: at a grazing angle they are seen
#: as ellipses. [1]
FLATTENED: Final = 0.3
#: Least cosine of the zenith angle of a line of sight that meets bowls as deep as they are. [1]
FLATTEST: Final = 0.05
#: Largest share of the radius by which a rim is out of round, by eye. [1]
UNROUND: Final = 0.12
#: Radius at which bright soil ends [cell], change of the reflectance in the middle of a fresh
#: crater, whose soil is immature, contrast of its rays, their width over the distance [1], and
#: diameter below which all of it fades [m], by eye; mean change over cells with a crater, with that
#: of the cube of the freshness [1].
REACH: Final = 0.48
WIDER: Final = EJECTA * (1.0 + 1.4143 * UNROUND)
BRIGHT: Final = 0.6
RAYS: Final = 0.8
RAY: Final = 2.5
RAYED: Final = 100.0
MEAN: Final = BRIGHT * pi * REACH**2 / 3.0 / 10.0 * (1.0 - 0.75 * FLOODED)


class Crater(NamedTuple):
    """Crater of a cell.

    Attributes
    ----------
    x, y : float
        Centre, from the corner of the cell. [cell]
    radius : float
        Radius; 0 without a crater. [cell]
    fresh : float
        Freshness, from 0 to 1, of which small values are the most. [1]
    along, across : float
        Numbers that ``shuffled`` makes its second harmonics.
    """

    x: float
    y: float
    radius: float
    fresh: float
    along: float
    across: float


class Cratered(NamedTuple):
    """Craters at a place.

    Attributes
    ----------
    light : float
        Direct light over that of level ground, of mean 1. [1]
    tone : float
        Change of the reflectance by ejecta, of mean 0. [1]
    """

    light: float
    tone: float


@kernel
def crater_of(i, j, lattice, share):
    """``Crater`` of a cell.

    Parameters
    ----------
    i, j : float
        Cell, modulo the period of noise.
    lattice : int
        Number of the lattice, below ``LATTICES``.
    share : float
        Share of cells with a crater. [1]
    """
    column = shuffled(i + 20.0 * lattice)
    number = shuffled(column + j)
    first = shuffled(number + column)
    second = shuffled(first + j)
    third = shuffled(second + number)
    radius = 0.0
    if number < 289.0 * share:
        # the inverse of D^-2 between both diameters
        radius = 0.5 * WIDEST / sqrt(1.0 + 3.0 * shuffled(third + i) / 288.0)
    even = third / 288.0
    fresh = even * even * even
    # where the share varies, no crater ends suddenly
    fresh *= min(max(289.0 * share - number, 0.0) / (FLOODED * 289.0 * share), 1.0)
    return Crater(first / 289.0, second / 289.0, radius, fresh, third + column, third + second)


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
    return min(max(lower / (4.0 * blur + 0.02), 0.0), 1.0)


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
def highland(green):
    """Share of highlands, 0 to 1, by a map's reflectance. [1]

    Examples
    --------
    >>> highland(0.05), round(highland(0.08), 9), highland(0.12)
    (0.0, 0.5, 1.0)
    """
    return min(max((green - DARK) / (LIGHT - DARK), 0.0), 1.0)


@kernel
def craters(place, whole, up, way, footprint, cell, density, high, ray):
    """``Cratered`` of a place.

    Parameters
    ----------
    place, whole : Vec3
        Place and lattice point, ``faced``. [finest cell]
    up, way : Vec3
        Vertical, and horizontal direction towards the star, times the tangent of its zenith angle,
        at most ``LOWEST``; ``faced``. [1]
    footprint : float
        Width of the pixel: craters narrower than three of it are left out. [finest cell]
    cell : float
        Size of the finest cells. [m]
    density : float
        c of the module. [1]
    high : float
        Share of highlands. [1]
    ray : Vec3
        Horizontal direction away from the observer, times the tangent of the zenith angle of the
        line of sight, ``faced``. [1]
    """
    light, tone, scale = 1.0, 0.0, COARSEST
    narrowest = 0.5 * WIDEST
    several = density * 3.0 / (WIDEST * WIDEST) / max(abs(up.z), 0.5)
    tangent, flat = sqrt(dot(way, way)), dot(ray, ray)
    turn = MARE * (HIGHLAND / MARE) ** high
    tilt_x, tilt_y = up.x / up.z, up.y / up.z
    for lattice in range(LATTICES):
        shown = min(narrowest * scale / (3.0 * footprint) - 1.0, 1.0)
        if shown > 0.0:
            share = min(several * min(turn / (narrowest * scale * cell), 1.0), 1.0)
            young = shown * min(narrowest * scale * cell / RAYED, 1.0)
            tone -= young * share * MEAN
            x = along_lattice(whole.x, place.x, 1.0 / scale)
            y = along_lattice(whole.y, place.y, 1.0 / scale)
            corner_x, corner_y = floor(x - 0.5), floor(y - 0.5)
            for neighbour in range(4):
                i = corner_x + (neighbour - 2 * (neighbour // 2))
                j = corner_y + (neighbour // 2)
                one = crater_of(in_period(i), in_period(j), lattice, share)
                at_x, at_y = x - i - one.x, y - j - one.y
                away = Vec3(at_x, at_y, -(at_x * tilt_x + at_y * tilt_y))
                square = dot(away, away)
                bright = young * BRIGHT * one.fresh * one.fresh * one.fresh
                reach = REACH if bright > 0.05 else min(WIDER * one.radius, REACH)
                if one.radius > 0.0 and square < reach * reach and square > 1e-12:
                    if square < one.radius * one.radius and flat > 0.0:
                        inverse = 1.0 / one.radius
                        edge = (one.radius - sqrt(square)) * scale / footprint
                        met = sunk(
                            dot(away, ray) * inverse, flat, square * inverse * inverse, one.fresh
                        )
                        met *= one.radius * min(edge, 1.0)
                        at_x, at_y = at_x + met * ray.x, at_y + met * ray.y
                        away = Vec3(at_x, at_y, -(at_x * tilt_x + at_y * tilt_y))
                        square = max(dot(away, away), 1e-12)
                    distance = sqrt(square)
                    bulge = (shuffled(one.along) / 144.0 - 1.0) * (at_x * at_x - at_y * at_y)
                    bulge += (shuffled(one.across) / 72.0 - 2.0) * at_x * at_y
                    radius = (1.0 + UNROUND * bulge / square) * one.radius
                    within = distance / radius
                    if within < EJECTA:
                        blur = footprint / (scale * one.radius)
                        level = level_floor(2.0 * one.radius * scale * cell)
                        steep = 0.5 * crater_slope(max(within - 0.5 * blur, 0.0), one.fresh, level)
                        steep += 0.5 * crater_slope(within + 0.5 * blur, one.fresh, level)
                        towards = dot(away, way)
                        dark = shadowed(
                            towards / radius, within * within, one.fresh, level, tangent, blur
                        )
                        facing = max(1.0 - steep * towards / distance, 0.0)
                        light *= 1.0 + shown * (facing * (1.0 - dark) - 1.0)
                    thin = 1.0 - square / (REACH * REACH)
                    if bright > 0.05 and thin > 0.0:
                        streak, _growth_x, _growth_y = plane_noise(
                            99.0 * one.x + RAY * at_x / distance,
                            99.0 * one.y + RAY * at_y / distance,
                        )
                        tone += bright * thin * thin * (1.0 + RAYS * streak * min(within, 1.0))
        scale *= 0.5
    return Cratered(light, tone)
