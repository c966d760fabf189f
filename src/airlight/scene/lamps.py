r"""Procedural lamps below the resolution of the map of city lights; they are not data.

Octaves of noise, each a quarter of the previous scale, from a map texel down. The first two divide
the light of a texel between towns and dark land, as clouds and gaps (``grained_cover``), and have
main roads, where noise vanishes, and bright quarters; then follow streets, and the finest cells,
115 m on Earth, have a lamp each. Every factor has the mean 1, and they are independent, so that the
map keeps its mean. Factors finer than two pixels are 1, with a fade between two and four; those of
cells over 150 times as large as a pixel fade, and all of them where lines of sight are less steep
than 6°, as houses hide what is between the lamps.
"""

from __future__ import annotations

from math import floor, pi, sqrt
from typing import Final

from airlight.geometry.gradient_noise import (
    GRADIENT_DEVIATION,
    PERIOD,
    gradient_noise,
    in_period,
    lattice_value,
    shuffled,
)
from airlight.kernel import inlined, kernel
from airlight.scene.ground_detail import OCTAVES, STEP, grained_cover

#: Octave of streets, and of lamps, the last. Before it are main roads and quarters.
_STREETS: Final = 2
_LAMPS: Final = 3
#: Noise w at the edges of main roads and of streets, whose middle is where noise vanishes; and
#: means of their light, (1 - |n|/w)³ over the noise n, of 2 million places. [1]
_ROAD: Final = 0.5 * GRADIENT_DEVIATION
_ROAD_MEAN: Final = 0.0892
_STREET: Final = 2.5 * GRADIENT_DEVIATION
_STREET_MEAN: Final = 0.4019
#: Share of the light of a town that its main roads have, and of the rest that bright quarters. [1]
_ON_ROADS: Final = 0.15
_IN_QUARTERS: Final = 0.7
#: Radius of a lamp over its cell, its distance from the middle at most along each axis, and mean of
#: (1 - d²/R²)² over the cell, 4π R³ 8/105. [1]
_LAMP: Final = 0.35
_ASIDE: Final = 0.15
_LAMP_MEAN: Final = 32.0 * pi * _LAMP**3 / 105.0
#: Mean of the sixth powers of the 289 values from 0 to 1. [1]
_SIXTH: Final = 0.144099
#: Displacement of quarters per noise of main roads, against rows. [cell]
_BENDING: Final = 5.0
#: Reciprocal of the width of the edges of towns, in standard deviations of the coarsest noise. [1]
_TOWN_EDGE: Final = 1.3
#: Ratio of the contrast of towns in an octave to that in the next coarser one. [1]
_TOWN_FALL: Final = 0.5
#: Share of the ground that is lit in the brightest towns. [1]
_BUILT: Final = 0.5
#: Largest cell over a pixel of which the pattern is not fainter. [1]
_NEAREST: Final = 150.0
#: Reciprocal of the cosine of the zenith angle from which on the pattern is not fainter. [1]
_STEEP: Final = 10.0
#: Displacement of towns over that of coasts. [1]
BENT: Final = 4.0
#: Distance to other noise. [cell]
_APART: Final = 57.0


@kernel
def lamp_bump(x, y, z):
    """Light of the lamp of a cell at a place, of mean 1; few lamps are bright.

    Parameters
    ----------
    x, y, z : float
        Coordinates, in cells. [1]
    """
    i, j, k = float(floor(x)), float(floor(y)), float(floor(z))
    column, height = shuffled(shuffled(in_period(i)) + in_period(j)), in_period(k)
    own = shuffled(column + height)
    dx = x - i - 0.5 - _ASIDE * lattice_value(own, 0.0)
    dy = y - j - 0.5 - _ASIDE * lattice_value(own, 1.0)
    dz = z - k - 0.5 - _ASIDE * lattice_value(own, 2.0)
    inside = 1.0 - (dx * dx + dy * dy + dz * dz) / (_LAMP * _LAMP)
    if inside <= 0.0:
        return 0.0
    own *= own * own / 288.0**3
    return own * own * inside * inside / (_SIXTH * _LAMP_MEAN)


@kernel
def along_lines(noise, edge, mean):
    """Light of streets where noise vanishes, of mean 1."""
    near = 1.0 - min(abs(noise) / edge, 1.0)
    return near * near * near / mean


@inlined
def lamps_at(lamps, width, cosine, place, footprint, cell, whole, part):
    """Light of lamps at a place, whose mean is that of the map. [1]

    A texel of little light has a small town, and dark land around it: share of the ground that is
    lit, and brightness there, rise as the square root of the light.

    Parameters
    ----------
    lamps : float
        Light of the map, above 0. [1]
    width : float
        Argument of ``grained_cover``. [texel]
    cosine : float
        Cosine of the zenith angle of the line of sight. [1]
    place, footprint, cell, whole, part :
        Arguments of ``ground_detail``; footprint from ``texture_footprint``.
    """
    factor, bend, scale = 1.0, 0.0, STEP ** (OCTAVES - 1)
    town, variance, steep = 0.0, 0.0, min(_STEEP * cosine, 1.0)
    for octave in range(_LAMPS + 1):
        shown = min(0.5 * cell * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            shown *= steep * min(_NEAREST * footprint / (cell * scale), 1.0)
            period = float(PERIOD * scale)
            # as in ground_detail: integers stay exact in single precision
            x = (whole.x - period * floor(whole.x / period)) / scale
            y = (whole.y - period * floor(whole.y / period)) / scale
            z = (whole.z - period * floor(whole.z / period)) / scale
            x += (part.x + place.x / cell) / scale
            y += (part.y + place.y / cell) / scale
            z += (part.z + place.z / cell) / scale
            if octave < _STREETS:
                part_of_town = shown * _TOWN_FALL**octave
                town += part_of_town * gradient_noise(x, y, z)
                variance += part_of_town * part_of_town
            own = 0.0
            if octave == 0:
                bend = gradient_noise(x + _APART, y, z)  # other than that of towns
                own = 1.0 + _ON_ROADS * (along_lines(bend, _ROAD, _ROAD_MEAN) - 1.0)
                bend *= _BENDING
            elif octave == _STREETS:
                own = along_lines(gradient_noise(x, y, z), _STREET, _STREET_MEAN)
            else:
                own = lamp_bump(x + bend, y - bend, z + bend)
                bend = 0.0
                if octave < _STREETS:
                    own = 1.0 + _IN_QUARTERS * (own - 1.0)
            factor *= 1.0 + shown * (own - 1.0)
        scale = scale // STEP
    town /= -GRADIENT_DEVIATION  # towns are where noise is low
    bright = sqrt(min(max(lamps, 0.0), 1.0))
    lit = grained_cover(_BUILT * bright, width, town, variance, _TOWN_EDGE)
    return bright * lit * factor / _BUILT
