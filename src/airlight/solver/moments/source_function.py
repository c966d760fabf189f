"""Source function at a point of a ray, from the moments of the radiance there."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import pair, splat
from airlight.solver.moments.harmonics import EVEN


class StarNode(NamedTuple):
    """Star at a point of a ray, between two sun elevations of the grid.

    Attributes
    ----------
    sun, f : int, float
        Index of the lower elevation, and weight of the higher. [1]
    step, sine : float
        Cosine and sine of the azimuth between ray and star. [1]
    """

    sun: int
    f: float
    step: float
    sine: float


@inlined
def first_register(l, narrow):
    """Index of the first register with moments of degree l. [1]

    A register has one moment of eight wavelengths, or if ``narrow`` two of four wavelengths: those
    of m = 0 and 1, of 2 and 3, and so on; the last of an even degree has one.
    """
    index = l * (l + 1) // 2
    if narrow:
        index = ((l + 1) // 2) * ((l + 2) // 2)
    return index


@inlined
def contracted(factors, point, field, level, sun, f, m, degree, narrow):
    """Moments of order m times scattering strengths, summed over degrees, between two radii.

    Parameters
    ----------
    factors : lanes, shape (points, n)
        Strength of each degree times Legendre function, in the order of ``first_register``.
    field : lanes, shape (r, s, 1 + k)
        Field as in ``sweep_radius``.
    level, sun : int
        Indices of the lower radius and of the sun.
    f : float32
        Weight of the upper radius. [1]
    m, degree : int
        Order of these moments, or index of their pair; and highest degree.
    narrow : bool
        See ``first_register``; a constant.
    """
    below, above = splat(0.0), splat(0.0)
    lowest = m
    if narrow:
        lowest = 2 * m
    for l in range(lowest, degree + 1):
        index = first_register(l, narrow) + m
        factor = factors[point, index]
        below = below + factor * field[level, sun, 1 + index]
        above = above + factor * field[level + 1, sun, 1 + index]
    return (np.float32(1.0) - f) * below + f * above


@inlined
def coupled_moments(field, level, sun, f, m, degree, narrow):
    """Coupled moments of degree 2 and order m, times s: of I, and even polarised one.

    Arguments as for ``contracted``.
    """
    g = np.float32(1.0) - f
    bright = 1 + first_register(2, narrow) + m
    even = 1 + first_register(degree + 1, narrow) + m
    return (
        g * field[level, sun, bright] + f * field[level + 1, sun, bright],
        g * field[level, sun, even] + f * field[level + 1, sun, even],
    )


@inlined
def odd_moment(field, level, sun, f, m, degree, narrow):
    """Odd polarised moment of degree 2 and order m, times s; arguments as for ``contracted``.

    m is 1 or 2; if ``narrow``, 0 for order 1, in the second half, and 1 for order 2, in the first.
    """
    place = first_register(degree + 1, narrow) + EVEN + m
    if narrow:
        place = first_register(degree + 1, narrow) + 3 + m
    return (np.float32(1.0) - f) * field[level, sun, place] + f * field[level + 1, sun, place]


@inlined
def source_at_point(rows, point, star, wide, degree, bright, polarised, narrow):
    """Contribution of multiple scattering at a point to I, Q and U of its ray. [1]

    Parameters
    ----------
    rows : lanes, shape (points, s, n)
        For each node the factor s; then A_m s from ``contracted``, in the order of
        ``first_register``; then the azimuthal components Q_0 s, Q_1 s, Q_2 s, U_1 s and U_2 s; if
        ``narrow`` in three registers: Q_0 and Q_1, Q_2, U_2 and U_1.
    point : int
        Index of the point.
    star : StarNode
        Star at the point, in single precision.
    wide : int
        Number of registers of A_m to be summed; for a steep ray the others vanish.
    degree : int
        Highest degree.
    bright, polarised : bool
        Whether to compute I, and Q and U; constants. The others are 0.
    narrow : bool
        See ``first_register``; a constant. The halves of the results are then to be added, see
        ``folded``.
    """
    sun, f, step, sine = star
    g = np.float32(1.0) - f
    one, two = np.float32(1.0), np.float32(2.0)
    high = sun + 1
    scale = splat(1.0) / (g * rows[point, sun, 0] + f * rows[point, high, 0])
    radiance, stokes_q, stokes_u = splat(0.0), splat(0.0), splat(0.0)
    double = two * step * step - one
    last = degree + 1
    if narrow:
        last = degree // 2 + 1
    if bright:
        below, above = splat(0.0), splat(0.0)
        if narrow:
            # cos mφ and cos (m + 1)φ, by steps of two
            cosines, earlier, by = pair(one, step), pair(double, step), splat(two * double)
            for m in range(wide):
                below = below + cosines * rows[point, sun, 1 + m]
                above = above + cosines * rows[point, high, 1 + m]
                later = by * cosines - earlier
                earlier = cosines
                cosines = later
        else:
            below, above = rows[point, sun, 1], rows[point, high, 1]
            before, multiple = one, step
            for m in range(1, wide):
                below = below + multiple * rows[point, sun, 1 + m]
                above = above + multiple * rows[point, high, 1 + m]
                following = two * step * multiple - before
                before = multiple
                multiple = following
        radiance = (g * below + f * above) * scale
    if polarised:
        even = g * rows[point, sun, 1 + last] + f * rows[point, high, 1 + last]
        once = g * rows[point, sun, 2 + last] + f * rows[point, high, 2 + last]
        twice = g * rows[point, sun, 3 + last] + f * rows[point, high, 3 + last]
        if narrow:
            stokes_q = even * pair(one, step) + once * double
            stokes_u = twice * pair(two * sine * step, sine)
        else:
            stokes_q = even + once * step + twice * double
            once = g * rows[point, sun, 4 + last] + f * rows[point, high, 4 + last]
            twice = g * rows[point, sun, 5 + last] + f * rows[point, high, 5 + last]
            stokes_u = once * sine + twice * (two * sine * step)
        stokes_q, stokes_u = stokes_q * scale, stokes_u * scale
    return radiance, stokes_q, stokes_u
