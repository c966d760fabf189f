"""Source function at a point of a ray, from the moments of the radiance there."""

from __future__ import annotations

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, load, pair, splat
from airlight.solvers.moments.harmonics import EVEN


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
def contracted(factors, first, field, low, high, f, m, degree, narrow):
    """Moments of order m times scattering strengths, summed over degrees, between two radii.

    Parameters
    ----------
    factors : array
        Strength of each degree times Legendre function, in the order of ``first_register`` from
        ``first`` on.
    first : int
        Index of the first factor, in lanes.
    field : array
        Field as in ``sweep_radius``.
    low, high : int
        Index of the nodes of the lower and the upper radius, in lanes.
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
        at = LANES * (1 + index)
        factor = load(factors, first + LANES * index)
        below = below + factor * load(field, low + at)
        above = above + factor * load(field, high + at)
    return (np.float32(1.0) - f) * below + f * above


@inlined
def coupled_moments(field, low, high, f, m, degree, narrow):
    """Coupled moments of degree 2 and order m, times s: of I, and even polarised one.

    Arguments as for ``contracted``.
    """
    g = np.float32(1.0) - f
    bright = LANES * (1 + first_register(2, narrow) + m)
    at = LANES * (1 + first_register(degree + 1, narrow) + m)
    return (
        g * load(field, low + bright) + f * load(field, high + bright),
        g * load(field, low + at) + f * load(field, high + at),
    )


@inlined
def odd_moment(field, low, high, f, m, degree, narrow):
    """Odd polarised moment of degree 2 and order m, times s; arguments as for ``contracted``.

    m is 1 or 2; if ``narrow``, 0 for order 1, in the second half, and 1 for order 2, in the first.
    """
    place = first_register(degree + 1, narrow) + EVEN - 1 + m
    if narrow:
        place = first_register(degree + 1, narrow) + 2 + m
    at = LANES * (1 + place)
    return (np.float32(1.0) - f) * load(field, low + at) + f * load(field, high + at)


@inlined
def source_at_point(
    rows, low, high, f, step, sine, wide, degree, bright, polarised, narrow
):  # fmt: skip
    """Contribution of multiple scattering at a point to I, Q and U of its ray. [1]

    Parameters
    ----------
    rows : array
        For each node the factor s; then A_m s from ``contracted``, in the order of
        ``first_register``; then the azimuthal components Q_0 s, Q_1 s, Q_2 s, U_1 s and U_2 s; if
        ``narrow`` in three registers: Q_0 and Q_1, Q_2, U_2 and U_1.
    low, high : int
        Index of the nodes of the lower and the higher sun angle, in lanes.
    f : float32
        Weight of the higher sun angle. [1]
    step, sine : float32
        Cosine and sine of the azimuth between ray and star. [1]
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
    g = np.float32(1.0) - f
    one, two = np.float32(1.0), np.float32(2.0)
    scale = splat(1.0) / (g * load(rows, low) + f * load(rows, high))
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
                at = LANES * (1 + m)
                below = below + cosines * load(rows, low + at)
                above = above + cosines * load(rows, high + at)
                later = by * cosines - earlier
                earlier = cosines
                cosines = later
        else:
            below, above = load(rows, low + LANES), load(rows, high + LANES)
            before, multiple = one, step
            for m in range(1, wide):
                at = LANES * (1 + m)
                below = below + multiple * load(rows, low + at)
                above = above + multiple * load(rows, high + at)
                following = two * step * multiple - before
                before = multiple
                multiple = following
        radiance = (g * below + f * above) * scale
    if polarised:
        at = LANES * (1 + last)
        even = g * load(rows, low + at) + f * load(rows, high + at)
        at = at + LANES
        once = g * load(rows, low + at) + f * load(rows, high + at)
        at = at + LANES
        twice = g * load(rows, low + at) + f * load(rows, high + at)
        if narrow:
            stokes_q = even * pair(one, step) + once * double
            stokes_u = twice * pair(two * sine * step, sine)
        else:
            stokes_q = even + once * step + twice * double
            at = at + LANES
            once = g * load(rows, low + at) + f * load(rows, high + at)
            at = at + LANES
            twice = g * load(rows, low + at) + f * load(rows, high + at)
            stokes_u = once * sine + twice * (two * sine * step)
        stokes_q, stokes_u = stokes_q * scale, stokes_u * scale
    return radiance, stokes_q, stokes_u
