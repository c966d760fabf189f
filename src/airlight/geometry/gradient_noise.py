"""Value noise and gradient noise on a periodic lattice; also of lanes of places.

Value noise of a plane has its slopes beside it.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.geometry.vectors import Vec3
from airlight.kernel import kernel

#: Period of the noise in cells of each size.
PERIOD: Final = 256
#: Standard deviation of one octave: 1/√3 on the lattice, times (181/231)^1.5 between its points, as
#: 181/231 is the mean of u² + (1 - u)² over a cell for the quintic fade u. [1]
DEVIATION: Final = 0.4005
#: The same of ``gradient_noise``, the mean of 2 million places. [1]
GRADIENT_DEVIATION: Final = 0.1344
#: The same of ``plane_noise``, (1/√3)(181/231), and of its slope along an axis: the quintic's slope
#: has the mean square 10/7, differences of lattice values 2/3, and their mean across 181/231. [1]
PLANE_DEVIATION: Final = 0.4524
SLOPE_DEVIATION: Final = 0.8638


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
    return number - 289.0 * np.floor((number + 0.5) * (1.0 / 289.0))


@kernel
def shuffled(number):
    """Permutation polynomial modulo 289, of integers from 0 to 577 as floats.

    McEwan, Sheets, Gustavson and Richardson (2012), J. Graphics Tools 16, 85, section 3.

    Examples
    --------
    >>> shuffled(1.0), sorted(shuffled(float(n)) for n in range(289)) == list(range(289))
    (35.0, True)
    """
    rest = below_289(number)
    # (34 · 288 + 1) · 288 is exact in single precision, and its quotient within 0.0008
    return below_289((34.0 * rest + 1.0) * rest)


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
    return number - PERIOD * np.floor(number * (1.0 / PERIOD))


@kernel
def smooth_noise(x, y, z):
    """Value noise, interpolated between lattice points. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    """
    i, j, k = np.floor(x), np.floor(y), np.floor(z)
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
def noise_gradient(x, y, z):
    """Result of ``smooth_noise``, and its slopes along the axes. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    """
    i, j, k = np.floor(x), np.floor(y), np.floor(z)
    x, y, z = x - i, y - j, z - k
    u, v, w = quintic(x), quintic(y), quintic(z)
    i, j, k = in_period(i), in_period(j), in_period(k)
    far, high = in_period(j + 1.0), in_period(k + 1.0)
    left, right = shuffled(i), shuffled(in_period(i + 1.0))
    value, across = 0.0, 0.0
    low, above = 0.0, 0.0
    for row in range(2):
        column, part, steep = j, 1.0 - v, -1.0
        if row == 1:
            column, part, steep = far, v, 1.0
        near, beyond = shuffled(left + column), shuffled(right + column)
        a, b = lattice_value(near, k), lattice_value(beyond, k)
        c, d = lattice_value(near, high), lattice_value(beyond, high)
        bottom, top = a + (b - a) * u, c + (d - c) * u
        value += steep * (bottom + (top - bottom) * w)
        across += part * ((b - a) * (1.0 - w) + (d - c) * w)
        low += part * bottom
        above += part * top
    steepness_x = 30.0 * x * x * (1.0 - x) * (1.0 - x)
    steepness_y = 30.0 * y * y * (1.0 - y) * (1.0 - y)
    steepness_z = 30.0 * z * z * (1.0 - z) * (1.0 - z)
    found = low + (above - low) * w
    return found, steepness_x * across, steepness_y * value, steepness_z * (above - low)


@kernel
def sloping_noise(x, y, z, way):
    """Result of ``smooth_noise``, and its slope along a direction. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    way : Vec3
        Direction. [1]
    """
    value, slope_x, slope_y, slope_z = noise_gradient(x, y, z)
    return value, way.x * slope_x + way.y * slope_y + way.z * slope_z


@kernel
def plane_noise(x, y):
    """Value noise of a plane, and its slopes along both axes. [1]

    Parameters
    ----------
    x, y : float
        Position. [cell]
    """
    i, j = np.floor(x), np.floor(y)
    x, y = x - i, y - j
    u, v = quintic(x), quintic(y)
    i, j = in_period(i), in_period(j)
    left, right, far = shuffled(i), shuffled(in_period(i + 1.0)), in_period(j + 1.0)
    a, b = lattice_value(left, j), lattice_value(right, j)
    c, d = lattice_value(left, far), lattice_value(right, far)
    twist = a - b - c + d
    slope_x = 30.0 * x * x * (1.0 - x) * (1.0 - x) * (b - a + twist * v)
    slope_y = 30.0 * y * y * (1.0 - y) * (1.0 - y) * (c - a + twist * u)
    return a + (b - a) * u + (c - a) * v + twist * u * v, slope_x, slope_y


@kernel
def corner_slope(column, k, x, y, z):
    """Height of a slope through a lattice point, in one of 49 directions. [1]

    Octahedral map of 7 × 7 directions (McEwan et al. 2012, section 4), not normalised.

    Parameters
    ----------
    column, k : float
        Arguments of ``lattice_value``.
    x, y, z : float
        Position from the point. [cell]
    """
    value = shuffled(column + k)
    value -= 49.0 * np.floor((value + 0.5) * (1.0 / 49.0))
    row = np.floor((value + 0.5) * (1.0 / 7.0))
    # centres of cells of the map, so that directions balance
    a, b = (row - 3.0) * (2.0 / 7.0), (value - 7.0 * row - 3.0) * (2.0 / 7.0)
    c = 1.0 - abs(a) - abs(b)
    fold = 0.5 * (abs(c) - c)
    # towards zero: the floor is 0 or -1
    a -= fold * (1.0 + 2.0 * np.floor(a))
    b -= fold * (1.0 + 2.0 * np.floor(b))
    return a * x + b * y + c * z


@kernel
def sloping_gradient_noise(x, y, z, way):
    """Gradient noise, and its slope along a direction; ``gradient_noise`` is without slope. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    way : Vec3
        Direction. [1]
    """
    i, j, k = np.floor(x), np.floor(y), np.floor(z)
    x, y, z = x - i, y - j, z - k
    u, v, w = quintic(x), quintic(y), quintic(z)
    rise_x = way.x * 30.0 * x * x * (1.0 - x) * (1.0 - x)
    rise_y = way.y * 30.0 * y * y * (1.0 - y) * (1.0 - y)
    rise_z = way.z * 30.0 * z * z * (1.0 - z) * (1.0 - z)
    i, j, k = in_period(i), in_period(j), in_period(k)
    far, high = in_period(j + 1.0), in_period(k + 1.0)
    left, right = shuffled(i), shuffled(in_period(i + 1.0))
    total, slope = 0.0 * x, 0.0 * x
    for corner in range(4):
        column, start, height, share, more = left, j, y, 1.0 - v, 0.0 - rise_y
        if corner > 1:
            start, height, share, more = far, y - 1.0, v, rise_y
        across, part, wider = x, 1.0 - u, 0.0 - rise_x
        if corner - 2 * (corner // 2) == 1:
            column, across, part, wider = right, x - 1.0, u, rise_x
        column = shuffled(column + start)
        low = corner_slope(column, k, across, height, z)
        above = corner_slope(column, high, across, height, z - 1.0)
        level = low + (above - low) * w
        low_slope = corner_slope(column, k, way.x, way.y, way.z)
        high_slope = corner_slope(column, high, way.x, way.y, way.z)
        growth = low_slope + (high_slope - low_slope) * w + (above - low) * rise_z
        total += share * part * level
        slope += share * part * growth + (more * part + share * wider) * level
    return total, slope


@kernel
def gradient_noise(x, y, z):
    """Gradient noise (Perlin 2002, ACM Trans. Graph. 21, 681), 0 at lattice points. [1]

    Parameters
    ----------
    x, y, z : float
        Position. [cell]
    """
    value, _ = sloping_gradient_noise(x, y, z, Vec3(0.0, 0.0, 0.0))
    return value
