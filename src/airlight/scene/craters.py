"""Craters of airless bodies between some texels of maps and a metre; they are not data.

In equilibrium, where new craters erase old ones, the number per area of those wider than D is
c D^-2; the c of the lunar maria is 0.079 (Trask 1966, JPL Tech. Rep. 32-800, 252: 10^10.9 D^-2 per
10^6 km², D in metres). Beyond a diameter it falls as D^-3, near the production of new ones
(Neukum, Ivanov & Hartmann 2001, Space Sci. Rev. 96, 55): on the maria some 300 m, in the highlands
tens of kilometres (Hartmann 1984, Icarus 60, 56). Each cell of a lattice has at most one crater, of
the diameters between those of the next finer and its own lattice; cells are on the face of a
cube, distances on the ground. Old ones, which are shallow, are the most: half of those of the Moon
narrower than 250 m have less than 0.6 of the depth of fresh ones (Stopar et al. 2017, Icarus 298,
34). Seen from above, mean sunlight and mean reflectance remain.
"""

from __future__ import annotations

from math import floor, pi, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import in_period, plane_noise, shuffled
from airlight.geometry.vectors import Vec3, dot
from airlight.kernel import kernel
from airlight.scene.crater_shapes import BRIGHT, RAYED, REACH, Crater, crater_tone, pit_light
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
#: Mip level of the map whose reflectance separates highlands from maria; its texels are as wide as
#: large craters. [1]
REGIONAL: Final = 3.0
#: Largest tangent of the star's zenith angle: rims shade one another below. [1]
LOWEST: Final = 6.0
#: Share of craters that are shallower, as if flooded. [1]
FLOODED: Final = 0.25
#: Largest share of the radius by which a rim is out of round, by eye. [1]
UNROUND: Final = 0.09
#: Cells of noise in a radian of the rim, as lobes and as rays, and share of the radius by which the
#: former move it, by eye. [1]
LOBES: Final = 1.4
STREAKS: Final = 4.0
SCALLOPED: Final = 0.06
#: Change of the reflectance of walls by streaks of talus, by eye. [1]
STREAKED: Final = 0.35
#: Cells of a lattice per cell of the noise by which craters are in clusters, of secondary ones as
#: well, and change of their number with it, by eye. [1]
CLUSTER: Final = 4.0
CLUSTERED: Final = 1.8
#: Least freshness of those that are counted, by eye. [1]
FAINT: Final = 0.14
NEWER: Final = 1.0 - FAINT
#: Mean change of the reflectance by a crater over its cell, with the mean of the fourth power of
#: the freshness, FAINT + NEWER t³ for t from 0 to 1. [1]
MEAN: Final = (
    FAINT**4 + FAINT**3 * NEWER + 6.0 / 7.0 * FAINT**2 * NEWER**2
    + 0.4 * FAINT * NEWER**3 + NEWER**4 / 13.0
) * BRIGHT * pi * REACH**2 / 3.0 * (1.0 - 0.8 * FLOODED)  # fmt: skip
#: Least width of a pixel for craters over its longer axis, by eye: at a grazing angle they are seen
#: as ellipses. [1]
FLATTENED: Final = 0.5
#: Least cosine of the zenith angle of a line of sight that meets bowls as deep as they are. [1]
FLATTEST: Final = 0.05
#: Of craters that wind fills: power of the diameter, below that at which craters are in
#: equilibrium, by which they are fewer: on Mars some 400 000 are wider than 1 km, 2 000 than 50 km
#: (Robbins & Hynek 2012, JGR 117, E05004) [1]; and diameter above which maps have them [m].
ERODED: Final = 0.8
LARGEST: Final = 4e4
#: Largest change of the reflectance of their floors, where wind leaves dark sand or bright dust,
#: and width of its edge over the radius, by eye. [1]
SANDY: Final = 0.3
SHORE: Final = 0.35
#: Width of the narrowest craters that are shown. [pixel]
NARROWEST: Final = 2.2
#: Share of cells below which a lattice is left out. [1]
RARE: Final = 2e-3


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
def crater_of(column, number, first, second, share):
    """``Crater`` of a cell that has one.

    Parameters
    ----------
    column, number : float
        Numbers that ``shuffled`` makes of the column and of the cell; the cell has a crater if the
        second is below 289 times ``share``.
    first, second : float
        Numbers of its centre, 0 to 288. [cell/289]
    share : float
        Share of cells with a crater. [1]
    """
    third = shuffled(second + column)
    # the inverse of D^-2 between both diameters
    radius = 0.5 * WIDEST / sqrt(1.0 + 3.0 * shuffled(third + number) / 288.0)
    even = third / 288.0
    # where the share varies, no crater ends suddenly
    fresh = (FAINT + NEWER * even * even * even) * min(
        (289.0 * share - number) / (FLOODED * 289.0 * share), 1.0
    )
    return Crater(radius, fresh, third + first, third + second)


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
def crater_share(diameter, density, high, weathered):
    """Craters of a lattice per cell, on level ground. [1]

    Parameters
    ----------
    diameter : float
        That of its narrowest craters. [m]
    density, high, weathered :
        Arguments of ``craters``.

    Examples
    --------
    >>> [round(crater_share(diameter, 0.1, 0.0, False), 3) for diameter in (100.0, 600.0)]
    [0.833, 0.417]
    """
    several = density * 3.0 / (WIDEST * WIDEST)
    if weathered:
        if diameter > LARGEST:
            return 0.0
        return several * min((diameter / HIGHLAND) ** ERODED, 1.0)
    return several * min(MARE * (HIGHLAND / MARE) ** high / diameter, 1.0)


@kernel
def craters(place, whole, up, way, width, cell, density, high, ray, weathered):
    """``Cratered`` of a place.

    Parameters
    ----------
    place, whole : Vec3
        Place and lattice point, ``faced``. [finest cell]
    up, way : Vec3
        Vertical, and horizontal direction towards the star, times the tangent of its zenith angle,
        at most ``LOWEST``; ``faced``. [1]
    width : float
        Width of the pixel across the line of sight. [finest cell]
    cell : float
        Size of the finest cells. [m]
    density : float
        c of the module. [1]
    high : float
        Share of highlands. [1]
    ray : Vec3
        Horizontal direction away from the observer, times the tangent of the zenith angle of the
        line of sight, ``faced``. [1]
    weathered : bool
        Whether wind fills craters, which have level floors and no rays.
    """
    light, tone, scale = 1.0, 0.0, COARSEST
    narrowest = 0.5 * WIDEST
    longer = width * sqrt(1.0 + dot(ray, ray))
    footprint = max(sqrt(width * longer), FLATTENED * longer)
    tilt_x, tilt_y = up.x / up.z, up.y / up.z
    for lattice in range(LATTICES):
        shown = min(narrowest * scale / (NARROWEST * footprint) - 1.0, 1.0)
        share = 0.0
        if shown > 0.0:
            share = crater_share(narrowest * scale * cell, density, high, weathered)
            share /= max(abs(up.z), 0.5)
        if share > RARE:
            dense, _slope_x, _slope_y = plane_noise(
                along_lattice(whole.x, place.x, 1.0 / (CLUSTER * scale)) + lattice,
                along_lattice(whole.y, place.y, 1.0 / (CLUSTER * scale)),
            )
            share = min(share * max(1.0 + CLUSTERED * dense, 0.1), 1.0)
            young = 0.0
            if not weathered:
                young = shown * min(narrowest * scale * cell / RAYED, 1.0)
            tone -= young * share * MEAN
            x = along_lattice(whole.x, place.x, 1.0 / scale)
            y = along_lattice(whole.y, place.y, 1.0 / scale)
            corner_x, corner_y = floor(x - 0.5), floor(y - 0.5)
            x -= corner_x
            y -= corner_y
            for neighbour in range(4):
                i = neighbour - 2.0 * (neighbour // 2)
                j = 1.0 * (neighbour // 2)
                column = shuffled(in_period(corner_x + i) + 20.0 * lattice)
                number = shuffled(column + in_period(corner_y + j))
                if number < 289.0 * share:
                    first = shuffled(number + column)
                    at_x = x - i - first / 289.0
                    if abs(at_x) < REACH:
                        second = shuffled(first + number)
                        at_y = y - j - second / 289.0
                        away = Vec3(at_x, at_y, -(at_x * tilt_x + at_y * tilt_y))
                        square = dot(away, away)
                        if square < REACH * REACH and square > 1e-12:
                            one = crater_of(column, number, first, second, share)
                            distance = sqrt(square)
                            bulge = shuffled(one.along) / 144.0 - 1.0
                            bulge *= at_x * at_x - at_y * at_y
                            diagonal = shuffled(one.across) / 144.0 - 1.0
                            bulge += 2.0 * diagonal * at_x * at_y
                            turn_x, turn_y = at_x / distance, at_y / distance
                            lobe, _slope_x, _slope_y = plane_noise(
                                one.along + LOBES * turn_x, one.across + LOBES * turn_y
                            )
                            streak, _slope_x, _slope_y = plane_noise(
                                one.across + STREAKS * turn_x, one.along + STREAKS * turn_y
                            )
                            radius = 1.0 + UNROUND * bulge / square
                            radius += SCALLOPED * (lobe + 0.4 * streak)
                            radius *= one.radius
                            within = distance / radius
                            seen = pit_light(
                                away, distance, Crater(radius, one.fresh, one.along, one.across),
                                way, ray, width / scale, scale * cell, weathered,
                            )  # fmt: skip
                            light *= 1.0 + shown * (seen - 1.0)
                            bright = one.fresh * one.fresh
                            bright *= young * BRIGHT * bright
                            if weathered and within < 1.0:
                                edge = min((1.0 - within) / SHORE, 1.0)
                                tone += shown * SANDY * diagonal * edge
                            if within < 1.0:
                                tone += shown * STREAKED * one.fresh * streak * within * within
                            if bright > 0.03:
                                tone += bright * crater_tone(distance, within, streak)
        scale *= 0.5
    return Cratered(light, tone)
