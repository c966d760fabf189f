"""Valleys, fields and dunes between the resolution of maps and the texture of land, from above.

Decoration: smooth relief of cells of two texels of the map (15 km on Earth) and, at each half of
that size, gullies: waves across the slope of all coarser relief, whose crests run down it and meet
as spurs and valleys do. Waves of a cell have a phase of their own and are blended with those of its
neighbours at the same amplitude (phasor noise, Tricard et al. 2019, ACM Trans. Graph. 38(4), 57).
Valleys are brighter than what is between them: sediment in deserts, fields among woods. Plains have
fields, patches of one tone with edges.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.geometry.gradient_noise import (
    in_period,
    lattice_value,
    noise_gradient,
    quintic,
    shuffled,
    smooth_noise,
)
from airlight.geometry.vectors import Vec3, cross, dot, plus, scaled
from airlight.kernel import kernel
from airlight.scene.cloud_grain import turning_place
from airlight.scene.hills import COARSEST, lattice_place

#: Number of octaves of gullies, from cells of a texel on; cells of the smooth relief.
OCTAVES: Final = 7
SMOOTH: Final = 2.0 * COARSEST
#: Slope of the smooth relief over its noise's, waves in a cell, their slope over that of the noise,
#: and ratios of the slope and of the tone from an octave to the next finer one, by eye. [1]
GENTLE: Final = 0.5
WAVES: Final = 0.9
STEEP: Final = 0.4
FALL: Final = 0.75
PALER: Final = 0.8
#: Slope of coarser relief over that of the noise from which on gullies are fully cut. [1]
CUT: Final = 0.3
#: Square of the amplitude below which waves of opposite phases cancel. [1]
CANCELLED: Final = 0.02
#: Mean of the cube of how low a place is between crests, of 40 000 places. [1]
NARROW: Final = 0.291
#: Number of sizes of fields, the largest of half a texel, ratio of their contrasts, least width of
#: their edges, and displacement of the largest by coarser noise, by eye. [1], [cell]
SIZES: Final = 4
SMALLER: Final = 0.95
EDGE: Final = 0.15
TURNED: Final = 1.0
#: Number of sizes of dunes, the widest of a quarter of a texel, length over width, shift by the
#: smooth relief, over its cells, cells of seas of sand, and noise from which on there are and from
#: which on all is dunes, by eye. [1]
DUNES: Final = 3
DRAWN: Final = 16.0
BENT: Final = 0.16
SEAS: Final = 16.0 * COARSEST
SHORE: Final = 0.0
INLAND: Final = 0.35


class Phasor(NamedTuple):
    """Complex number. [1]"""

    real: float
    imaginary: float


class Valleys(NamedTuple):
    """Valleys at a place.

    Attributes
    ----------
    height : float
        Noise of the smooth relief, -1 to 1. [1]
    ascent : float
        Tangent of the ascent along a horizontal direction. [1]
    tone : float
        Sum over octaves of how much of the place is the bottom of a valley, of mean 0. [1]
    """

    height: float
    ascent: float
    tone: float


@kernel
def rotated(a, b):
    """Product of two complex numbers. [1]

    Examples
    --------
    >>> rotated(Phasor(0.0, 1.0), Phasor(0.0, 1.0))
    Phasor(real=-1.0, imaginary=0.0)
    """
    return Phasor(
        a.real * b.real - a.imaginary * b.imaginary, a.real * b.imaginary + a.imaginary * b.real
    )


@kernel
def lattice_phasor(column, k):
    """Pseudorandom point of a square whose corners are 1, i, -1 and -i: phases of all quarters. [1]

    Parameters
    ----------
    column, k : float
        Arguments of ``lattice_value``.
    """
    value = lattice_value(column, k)
    real = 1.0 - 2.0 * abs(value)
    imaginary = 1.0 - abs(real)
    return Phasor(real, imaginary if value > 0.0 else -imaginary)


@kernel
def gullies(x, y, z, across):
    """Wave along a direction, -1 to 1, and its slope, which leaves the blend of cells out. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    across : Vec3
        Direction. [1]
    """
    i, j, k = np.floor(x), np.floor(y), np.floor(z)
    x, y, z = x - i, y - j, z - k
    u, v, w = quintic(x), quintic(y), quintic(z)
    i, j, k = in_period(i), in_period(j), in_period(k)
    far, high = in_period(j + 1.0), in_period(k + 1.0)
    left, right = shuffled(i), shuffled(in_period(i + 1.0))
    turn = 2.0 * pi * WAVES
    angle = turn * (x * across.x + y * across.y + z * across.z)
    first = Phasor(cos(angle), sin(angle))
    beside = Phasor(cos(turn * across.x), -sin(turn * across.x))
    behind = Phasor(cos(turn * across.y), -sin(turn * across.y))
    above = Phasor(cos(turn * across.z), -sin(turn * across.z))
    real, imaginary = 0.0, 0.0
    for row in range(2):
        column, part = j, 1.0 - v
        wave = first
        if row == 1:
            column, part = far, v
            wave = rotated(first, behind)
        near, beyond = shuffled(left + column), shuffled(right + column)
        for layer in range(2):
            level, share = k, part * (1.0 - w)
            here = wave
            if layer == 1:
                level, share = high, part * w
                here = rotated(wave, above)
            a = rotated(lattice_phasor(near, level), here)
            b = rotated(lattice_phasor(beyond, level), rotated(here, beside))
            real += share * (a.real + (b.real - a.real) * u)
            imaginary += share * (a.imaginary + (b.imaginary - a.imaginary) * u)
    size = 1.0 / sqrt(real * real + imaginary * imaginary + CANCELLED)
    return size * real, -turn * size * imaginary


@kernel
def valleys(finest, footprint, whole, up, way, slope, steep):
    """``Valleys`` at a place.

    Parameters
    ----------
    finest, footprint, whole :
        Arguments of ``hills``.
    up, way : Vec3
        Vertical, and horizontal direction of the ascent. [1]
    slope : Vec3
        Horizontal gradient of the map's heights, whose light is not of the valleys. [1]
    steep : float
        Height of the relief over its cells. [1]
    """
    height, ascent, tone, scale = 0.0, 0.0, 0.0, COARSEST
    shown = min(0.6 * SMOOTH / footprint - 1.0, 1.0)
    if shown > 0.0:
        at = lattice_place(finest, whole, SMOOTH)
        height, x, y, z = noise_gradient(at.x, at.y, at.z)
        rise = Vec3(x, y, z)
        rise = scaled(plus(rise, scaled(up, -dot(rise, up))), shown * GENTLE * steep)
        slope = plus(slope, rise)
        ascent = dot(rise, way)
    cut, wave, pale = max(CUT * steep, 1e-6), STEEP * steep, 1.0
    for _octave in range(OCTAVES):
        shown = min(0.6 * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            length = max(sqrt(dot(slope, slope)), 1e-6)
            across = scaled(cross(up, slope), 1.0 / length)
            at = lattice_place(finest, whole, scale)
            crest, growth = gullies(at.x, at.y, at.z, across)
            shown *= min(length / cut, 1.0)
            growth *= shown * wave
            slope = plus(slope, scaled(across, growth))
            ascent += growth * dot(across, way)
            low = 0.5 - 0.5 * crest
            tone += pale * shown * (low * low * low - NARROW)
        wave *= FALL
        pale *= PALER
        scale *= 0.5
    return Valleys(height, ascent, tone)


@kernel
def patch_noise(x, y, z, edge):
    """Value noise of patches of one tone, with edges between them. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    edge : float
        Width of edges, at most 1. [cell]
    """
    i, j, k = np.floor(x), np.floor(y), np.floor(z)
    u = min(max((x - i - 0.5) / edge + 0.5, 0.0), 1.0)
    v = min(max((y - j - 0.5) / edge + 0.5, 0.0), 1.0)
    w = min(max((z - k - 0.5) / edge + 0.5, 0.0), 1.0)
    i, j, k = in_period(i), in_period(j), in_period(k)
    far, high = in_period(j + 1.0), in_period(k + 1.0)
    left, right = shuffled(i), shuffled(in_period(i + 1.0))
    total = 0.0
    for row in range(2):
        column, part = j, 1.0 - v
        if row == 1:
            column, part = far, v
        near, beyond = shuffled(left + column), shuffled(right + column)
        a, b = lattice_value(near, k), lattice_value(beyond, k)
        c, d = lattice_value(near, high), lattice_value(beyond, high)
        low, above = a + (b - a) * u, c + (d - c) * u
        total += part * (low + (above - low) * w)
    return total


@kernel
def farmland(finest, footprint, whole, bend):
    """Tone of fields of several sizes, its variance, and their hue: sums of mean 0. [1]

    Parameters
    ----------
    finest, footprint, whole :
        Arguments of ``hills``.
    bend : float
        Noise of coarser cells, which turns the lines of the lattice. [1]
    """
    tone, variance, hue, scale, loud = 0.0, 0.0, 0.0, 0.5 * COARSEST, 1.0
    turn = TURNED * bend
    for _size in range(SIZES):
        shown = loud * min(0.6 * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            at = lattice_place(finest, whole, scale)
            edge = min(max(2.0 * footprint / scale, EDGE), 1.0)
            here = shown * patch_noise(at.x + turn, at.y - turn, at.z + 0.5 * turn, edge)
            tone += here
            even = 1.0 - edge / 3.0
            variance += shown * shown * even * even * even / 3.0
            hue = here - hue
        loud *= SMALLER
        scale *= 0.5
        turn = -turn
    return tone, variance, hue


@kernel
def dunes(finest, footprint, whole, bend):
    """Tone of dunes in seas of sand, which run roughly along the axis of the planet, of mean 0. [1]

    Linear dunes of the Sahara and of Arabia are a kilometre or two apart and tens of them long,
    and run mostly from north to south. Smooth relief bends them.

    Parameters
    ----------
    finest, footprint, whole, bend :
        Arguments of ``farmland``.
    """
    x, _ = turning_place(whole.x, finest.x, SEAS)
    y, _ = turning_place(whole.y, finest.y, SEAS)
    z, _ = turning_place(whole.z, finest.z, SEAS)
    sea = smooth_noise(x + 0.1 * bend, y - 0.1 * bend, z + 0.1 * bend)
    inland = min(max((sea - SHORE) / (INLAND - SHORE), 0.0), 1.0)
    tone, scale = 0.0, 0.25 * COARSEST
    for _size in range(DUNES):
        shown = min(0.6 * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            at = lattice_place(finest, whole, scale)
            along = lattice_place(finest, whole, DRAWN * scale)
            bent = BENT * bend * (SMOOTH / scale)
            tone += shown * smooth_noise(at.x + bent, at.y - bent, along.z)
        scale *= 0.5
    return inland * tone
