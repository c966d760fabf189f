"""Craters of airless bodies between some texels of maps and a metre; they are not data.

In equilibrium, where new craters erase old ones, the number per area of those wider than D is
c D^-2; the c of the lunar maria is 0.079 (Trask 1966, JPL Tech. Rep. 32-800, 252: 10^10.9 D^-2 per
10^6 km², D in metres). Beyond ``TURN`` it falls as D^-3, near the production of new ones (Neukum,
Ivanov & Hartmann 2001, Space Sci. Rev. 96, 55). Each cell of a lattice has at most one crater, of
the diameters between those of the next finer and its own lattice; cells are on the face of a cube,
distances on the ground. The slope towards the star is that of a bowl with the depth and rim of a
fresh crater (Pike 1977, in Impact and Explosion Cratering, 489), which ages to a shallow one
without rim, as by diffusion (Fassett & Thomson 2014, JGR Planets 119, 2255); old ones are the most.
Soil of fresh ones is brighter. Mean sunlight and mean reflectance remain.
"""

from __future__ import annotations

from math import floor, log, pi, sqrt
from typing import Final, NamedTuple

from airlight.geometry.gradient_noise import in_period, shuffled
from airlight.geometry.vectors import Vec3, dot
from airlight.kernel import kernel
from airlight.scene.ground_detail import along_lattice

#: Number of lattices, and cells of the coarsest over the finest of ``ground_detail``: with the
#: packaged map of the Moon 43 km, so that craters are at most 25 km wide; those above some 15 km
#: have no flat floors here.
LATTICES: Final = 17
COARSEST: Final = 524288.0
#: Diameter of the widest crater of a lattice, twice that of the narrowest. [cell]
WIDEST: Final = 0.6
#: Diameter above which craters are fewer than in equilibrium, between the maria's, some 300 m, and
#: that of the highlands, which have it up to tens of kilometres (Hartmann 1984, Icarus 60, 56). By
#: eye. [m]
TURN: Final = 4000.0
#: Depth below the rim's foot and height of the rim of a fresh crater over its diameter. [1]
DEPTH: Final = 0.16
RIM: Final = 0.036
#: Radius at which ejecta end, over the crater's. [1]
EJECTA: Final = 1.6
#: Steepest slope, towards which steep ones are compressed. [1]
STEEPEST: Final = 0.45
#: Largest share of the radius by which a rim is out of round, and growth of freshness with an even
#: variable from 0, by eye. [1]
UNROUND: Final = 0.12
YOUNG: Final = 0.3
#: Change of the reflectance in the middle of a fresh crater, whose soil is immature, by eye; its
#: mean over cells with a crater: π/2 ``BRIGHT`` and the means of the squares of ``EJECTA`` radii,
#: W² ln 4 / 12, and of the freshness. [1]
BRIGHT: Final = 0.35
MEAN: Final = (
    0.5 * pi * BRIGHT * EJECTA**2 * WIDEST**2 * log(4.0) / 12.0
    * (YOUNG**2 / 3.0 + YOUNG * (1.0 - YOUNG) / 2.0 + (1.0 - YOUNG) ** 2 / 5.0)
)  # fmt: skip


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
        Second harmonic of the radius, over ``UNROUND``. [1]
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
    ascent : float
        Tangent of the ascent towards the star. [1]
    tone : float
        Change of the reflectance by ejecta, of mean 0. [1]
    """

    ascent: float
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
    fresh = even * (YOUNG + (1.0 - YOUNG) * even)
    along, across = shuffled(third + column) / 144.0 - 1.0, shuffled(third + second) / 144.0 - 1.0
    return Crater(first / 289.0, second / 289.0, radius, fresh, along, across)


@kernel
def crater_slope(distance, fresh):
    """Slope of a crater away from its centre. [1]

    Of a fresh one a parabola with rim and ejecta; of an old one, with the depth z and the ratio t
    of the distance to ``EJECTA``, that of -z (1 - t²)³.

    Parameters
    ----------
    distance : float
        Distance from the centre over the radius. [1]
    fresh : float
        Freshness; the depth of an old crater is in proportion to it. [1]

    Examples
    --------
    >>> crater_slope(0.0, 1.0), round(crater_slope(0.5, 1.0), 3), abs(crater_slope(2.0, 1.0))
    (0.0, 0.392, 0.0)
    """
    left = max(1.0 - distance * distance / (EJECTA * EJECTA), 0.0)
    worn = 12.0 * DEPTH / (EJECTA * EJECTA) * distance * left * left
    sharp = 4.0 * (DEPTH + RIM) * distance
    if distance > 1.0:
        left = max((EJECTA - distance) / (EJECTA - 1.0), 0.0)
        sharp = -6.0 * RIM * left / (distance * distance * distance * distance)
    return fresh * (fresh * sharp + (1.0 - fresh) * worn)


@kernel
def craters(place, whole, up, way, footprint, cell, density):
    """``Cratered`` of a place.

    Parameters
    ----------
    place, whole : Vec3
        Place and lattice point, ``faced``. [finest cell]
    up, way : Vec3
        Vertical, and horizontal direction towards the star, ``faced``. [1]
    footprint : float
        Width of the pixel: craters narrower than two of it are left out. [finest cell]
    cell : float
        Size of the finest cells. [m]
    density : float
        c of the module. [1]
    """
    ascent, tone, scale = 0.0, 0.0, COARSEST
    narrowest = 0.5 * WIDEST
    several = density * 3.0 / (WIDEST * WIDEST) / max(abs(up.z), 0.5)
    tilt_x, tilt_y = up.x / up.z, up.y / up.z
    for lattice in range(LATTICES):
        shown = min(0.5 * narrowest * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            share = min(several * min(TURN / (narrowest * scale * cell), 1.0), 1.0)
            tone -= shown * share * MEAN
            x = along_lattice(whole.x, place.x, 1.0 / scale)
            y = along_lattice(whole.y, place.y, 1.0 / scale)
            corner_x, corner_y = floor(x - 0.5), floor(y - 0.5)
            for neighbour in range(4):
                i = corner_x + (neighbour - 2 * (neighbour // 2))
                j = corner_y + (neighbour // 2)
                one = crater_of(in_period(i), in_period(j), lattice, share)
                if one.radius > 0.0:
                    at_x, at_y = x - i - one.x, y - j - one.y
                    away = Vec3(at_x, at_y, -(at_x * tilt_x + at_y * tilt_y))
                    square = dot(away, away)
                    distance = sqrt(square)
                    bulge = one.along * (at_x * at_x - at_y * at_y) + 2.0 * one.across * at_x * at_y
                    wider = 1.0 + UNROUND * bulge / max(square, 1e-12)
                    within = distance / (wider * one.radius)
                    if within < EJECTA and distance > 1e-6:
                        half = 0.5 * footprint / (scale * one.radius)
                        steep = 0.5 * crater_slope(max(within - half, 0.0), one.fresh)
                        steep += 0.5 * crater_slope(within + half, one.fresh)
                        ascent += shown * steep * dot(away, way) / distance
                        thin = 1.0 - within * within / (EJECTA * EJECTA)
                        tone += shown * BRIGHT * one.fresh * one.fresh * thin
        scale *= 0.5
    ascent /= sqrt(1.0 + ascent * ascent / (STEEPEST * STEEPEST))
    return Cratered(ascent, tone)
