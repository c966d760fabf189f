"""Procedural noise on the ground below the resolution of its map; it is not data.

Eight octaves of value noise, each a quarter of the previous scale, from a quarter of a map texel to
about 10 cm. They vary the reflectance by about 10 % without changing its mean. Scales below two
pixels are omitted, with a fade between two and four. Coordinates are relative to the point below
the observer, for single precision.
"""

from __future__ import annotations

from math import floor
from typing import Final

from airlight.kernel import kernel

#: Number of octaves of noise, and ratio between their sizes.
OCTAVES: Final = 8
STEP: Final = 4
#: Period of the noise in cells of each size.
PERIOD: Final = 256
#: Period of the finest cells, a multiple of all others' periods.
WHOLE_PERIOD: Final = PERIOD * STEP ** (OCTAVES - 1)
#: Largest contribution of one octave; its standard deviation is a third of it. [1]
AMPLITUDE: Final = 0.12
#: Rows of the map that defines the cells where the planet has none.
NOMINAL_ROWS: Final = 1024
#: Options: the map alone, or with its detail.
GROUNDS: Final = ("plain", "detailed")


@kernel
def finest_cell(radius, rows):
    """Size of the finest noise cells. [m]

    Parameters
    ----------
    radius : float
        Radius of the ground. [m]
    rows : float
        Number of rows of its map.
    """
    return 3.141592653589793 * radius / (rows * float(STEP**OCTAVES))


@kernel
def lattice_origin(component, radius, cell):
    """Lattice coordinate of the point below the observer along one axis: integer and fraction.

    Parameters
    ----------
    component : float
        Component of the unit vector from the planet's centre to that point. [1]
    cell : float
        Size of the finest cells. [m]

    Returns
    -------
    whole, part : float
        Index of the cell, modulo the period, and fraction before the point. [1]

    Examples
    --------
    >>> lattice_origin(-0.5, 5.0, 2.0)  # -1.25 cells, of a period of 4194304
    (4194302.0, 0.75)
    """
    place = component * radius / cell
    whole = floor(place)
    return float(whole % WHOLE_PERIOD), place - whole


@kernel
def below_289(number):
    """Positive integer modulo 289, as a float; exact despite rounded quotients.

    Drivers compute integer remainders lane by lane; SwiftShader then needed ten gigabytes to
    compile.

    Examples
    --------
    >>> below_289(289.0), below_289(83231.0)
    (0.0, 288.0)
    """
    return number - 289.0 * float(floor((number + 0.5) / 289.0))


@kernel
def shuffled(number):
    """Permutation polynomial modulo 289, on integers as floats.

    McEwan, Sheets, Gustavson and Richardson (2012), J. Graphics Tools 16, 85, section 3.

    Examples
    --------
    >>> shuffled(1.0), sorted(shuffled(float(n)) for n in range(289)) == list(range(289))
    (35.0, True)
    """
    return below_289(below_289(34.0 * number + 1.0) * number)


@kernel
def lattice_value(column, k):
    """Pseudorandom value of a lattice point, -1 to 1, mean 0. [1]

    Parameters
    ----------
    column : float
        Permuted indices along two axes, 0 to 288.
    k : float
        Index along the third axis, 0 to 255.
    """
    return shuffled(column + k) / 144.0 - 1.0


@kernel
def quintic(part):
    """Quintic fade 6t⁵ - 15t⁴ + 10t³, with two continuous derivatives. [1]"""
    return part * part * part * (part * (part * 6.0 - 15.0) + 10.0)


@kernel
def in_period(number):
    """Integer modulo the period, as a float."""
    return number - PERIOD * float(floor(number / PERIOD))


@kernel
def smooth_noise(x, y, z):
    """Value noise, interpolated between lattice points. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    """
    i, j, k = float(floor(x)), float(floor(y)), float(floor(z))
    u, v, w = quintic(x - i), quintic(y - j), quintic(z - k)
    i, j, k = in_period(i), in_period(j), in_period(k)
    far, high = in_period(j + 1.0), in_period(k + 1.0)
    left, right = shuffled(i), shuffled(in_period(i + 1.0))
    near_left, near_right = shuffled(left + j), shuffled(right + j)
    far_left, far_right = shuffled(left + far), shuffled(right + far)
    a = lattice_value(near_left, k) * (1.0 - u) + lattice_value(near_right, k) * u
    b = lattice_value(far_left, k) * (1.0 - u) + lattice_value(far_right, k) * u
    c = lattice_value(near_left, high) * (1.0 - u) + lattice_value(near_right, high) * u
    d = lattice_value(far_left, high) * (1.0 - u) + lattice_value(far_right, high) * u
    return (a * (1.0 - v) + b * v) * (1.0 - w) + (c * (1.0 - v) + d * v) * w


@kernel
def ground_detail(place, footprint, cell, whole, part):
    """Relative variation of the ground's reflectance, mean 0. [1]

    Parameters
    ----------
    place : Vec3
        Ground position relative to the point below the observer, in the planet's frame. [m]
    footprint : float
        Longer axis of the pixel footprint. [m]
    whole, part : Vec3
        Results of ``lattice_origin`` along each axis.
    """
    total, scale = 0.0, 1
    for _octave in range(OCTAVES):
        shown = min(0.5 * cell * scale / footprint - 1.0, 1.0)
        if shown > 0.0:
            period = float(PERIOD * scale)
            # The cell numbers are integers and stay exact; the remainder is small where this octave
            # is shown.
            total += shown * smooth_noise(
                (whole.x - period * floor(whole.x / period)) / scale
                + (part.x + place.x / cell) / scale,
                (whole.y - period * floor(whole.y / period)) / scale
                + (part.y + place.y / cell) / scale,
                (whole.z - period * floor(whole.z / period)) / scale
                + (part.z + place.z / cell) / scale,
            )
        scale *= STEP
    return AMPLITUDE * total
