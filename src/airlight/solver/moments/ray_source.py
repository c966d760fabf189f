"""Source function at the points of a ray, for each sun elevation.

It depends on the ray's zenith cosine at the point and on the moments at two radii, not on the
azimuth. The factors of a point, strengths times Legendre functions, are therefore computed once and
contracted with the moments for four sun elevations at a time, to minimise loads.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import exponential, pair, splat
from airlight.solver.moments.harmonics import (
    EVEN,
    POLARISED,
    legendre_functions,
    polarised_functions,
)
from airlight.solver.moments.ray_optics import (
    optical_depth,
    polarised_transmittance_ratio,
    strength_of,
)
from airlight.solver.moments.source_function import coupled_moments, first_register, odd_moment

#: Coupling coefficients of a point per order, in registers.
_COUPLINGS = 7


class LevelPoint(NamedTuple):
    """Point of a ray between two radii.

    Attributes
    ----------
    k : int
        Index of the point among those in work.
    row, f : int, float
        Index of the radius below, and fraction of the step above it.
    wide : int
        Number of registers of orders m to be computed.
    highest : int
        Highest active degree.
    """

    k: int
    row: int
    f: float
    wide: int
    highest: int


@inlined
def order_registers(degree, narrow):
    """Numbers of registers of a point: orders m of I, coupled moments, and Q and U.

    Returns
    -------
    wide, orders, sent : int
    """
    wide, orders, sent = degree + 1, EVEN, POLARISED
    if narrow:
        wide, orders, sent = degree // 2 + 1, 2, 3
    return wide, orders, sent


@inlined
def registers_of(orders, narrow):
    """Number of registers of the first ``orders`` orders m."""
    if narrow:
        return (orders + 1) // 2
    return orders


@inlined
def factor_count(degree, narrow):
    """Number of registers of the factors of a point."""
    _, orders, _ = order_registers(degree, narrow)
    return first_register(degree + 1, narrow) + _COUPLINGS * orders


@inlined
def fill_factors(point, rays, air, expansion, highest, functions, k, factors, narrow):
    """Factors of the moments in the source function at a point of a ray.

    Parameters
    ----------
    point : int
        Index of the point among all.
    rays, air, expansion :
        Arrays of ``sweep_radius``, without reference counts.
    highest : int
        Highest active degree at this point.
    functions : array
        Workspace for the Legendre functions.
    k : int
        Index of the point in ``factors``.
    factors : lanes, shape (points, n)
        Receives strengths times Legendre functions in the order of ``first_register``, and seven
        factors of the moments of degree 2 for each coupled order.
    narrow : bool
        See ``first_register``; a constant.
    """
    extinction, moments, polarised_moments = air
    mu_along, amounts, depths = rays
    degree = expansion.degree
    constituents = amounts.shape[1]
    legendre_functions(mu_along[point], expansion, functions)
    transmittance = exponential(0.0 - optical_depth(depths[point], 0, extinction, constituents))
    for l in range(highest + 1):
        strength = strength_of(moments, amounts, point, l, constituents) * transmittance
        index = l * (l + 1) // 2
        at = first_register(l, narrow)
        if narrow:
            for m in range(0, l, 2):
                both = pair(np.float32(functions[index + m]), np.float32(functions[index + m + 1]))
                factors[k, at + m // 2] = strength * both
            if l % 2 == 0:
                both = pair(np.float32(functions[index + l]), np.float32(0.0))
                factors[k, at + l // 2] = strength * both
        else:
            for m in range(l + 1):
                factors[k, at + m] = strength * np.float32(functions[index + m])
    beta_1 = transmittance * strength_of(polarised_moments, amounts, point, 0, constituents)
    polarised_ratio = polarised_transmittance_ratio(
        depths[point], 0, polarised_moments, constituents
    )
    through = polarised_ratio * transmittance
    alpha_2 = through * strength_of(polarised_moments, amounts, point, 1, constituents)
    alpha_3 = through * strength_of(polarised_moments, amounts, point, 2, constituents)
    turned = polarised_ratio * beta_1
    # The Legendre functions of degree 2.
    second_0, second_1, second_2 = functions[3], functions[4], functions[5]
    a0, a1, a2, b1, b2 = polarised_functions(mu_along[point])
    at = first_register(degree + 1, narrow)
    _, orders, _ = order_registers(degree, narrow)
    for m in range(orders):
        second = pair(np.float32(second_0), np.float32(second_1))
        even = pair(np.float32(a0), np.float32(a1))
        odd = pair(np.float32(0.0), np.float32(b1))
        if narrow:
            if m == 1:
                second = pair(np.float32(second_2), np.float32(0.0))
                even = pair(np.float32(a2), np.float32(0.0))
                odd = pair(np.float32(b2), np.float32(0.0))
        else:
            second, even, odd = splat(second_0), splat(a0), splat(0.0)
            if m == 1:
                second, even, odd = splat(second_1), splat(a1), splat(b1)
            if m == 2:
                second, even, odd = splat(second_2), splat(a2), splat(b2)
        factors[k, at] = beta_1 * second
        factors[k, at + 1] = even * turned
        factors[k, at + 2] = even * alpha_2
        factors[k, at + 3] = odd * alpha_3
        factors[k, at + 4] = odd * turned
        factors[k, at + 5] = odd * alpha_2
        factors[k, at + 6] = even * alpha_3
        at = at + _COUPLINGS


@inlined
def source_four_suns(point, factors, sun_angles, field, start, degree, rows, narrow):
    """Source function at a point of a ray, for four sun angles.

    Parameters
    ----------
    point : LevelPoint
        Point of the ray.
    factors : lanes, shape (points, n)
        Factors from ``fill_factors``.
    field : lanes, shape (r, s, 1 + k)
        As in ``sweep_radius``.
    start : int
        Index of the first sun angle; indices beyond the last are clamped.
    degree : int
        Highest degree of the moments.
    rows : lanes, shape (points, s, n)
        Receives a node of ``source_at_point`` for each sun angle.
    """
    k, row, f, wide, highest = point
    all_wide, orders, _ = order_registers(degree, narrow)
    registers = first_register(degree + 1, narrow)
    g = np.float32(1.0) - f
    last = sun_angles - 1
    second, third, fourth = min(start + 1, last), min(start + 2, last), min(start + 3, last)
    for m in range(wide):
        one, two, three, four = splat(0.0), splat(0.0), splat(0.0), splat(0.0)
        above_1, above_2, above_3, above_4 = splat(0.0), splat(0.0), splat(0.0), splat(0.0)
        lowest = m
        if narrow:
            lowest = 2 * m
        for l in range(lowest, highest + 1):
            index = first_register(l, narrow) + m
            factor = factors[k, index]
            one = one + factor * field[row, start, 1 + index]
            two = two + factor * field[row, second, 1 + index]
            three = three + factor * field[row, third, 1 + index]
            four = four + factor * field[row, fourth, 1 + index]
            above_1 = above_1 + factor * field[row + 1, start, 1 + index]
            above_2 = above_2 + factor * field[row + 1, second, 1 + index]
            above_3 = above_3 + factor * field[row + 1, third, 1 + index]
            above_4 = above_4 + factor * field[row + 1, fourth, 1 + index]
        rows[k, start, 1 + m] = g * one + f * above_1
        rows[k, second, 1 + m] = g * two + f * above_2
        rows[k, third, 1 + m] = g * three + f * above_3
        rows[k, fourth, 1 + m] = g * four + f * above_4
    for j in range(start, fourth + 1):
        rows[k, j, 0] = g * field[row, j, 0] + f * field[row + 1, j, 0]
        for m in range(orders):
            moment, coupled = coupled_moments(field, row, j, f, m, degree, narrow)
            by = registers + _COUPLINGS * m
            if m < wide:
                rows[k, j, 1 + m] += factors[k, by] * coupled
            point_q = factors[k, by + 1] * moment + factors[k, by + 2] * coupled
            point_u = factors[k, by + 4] * moment + factors[k, by + 5] * coupled
            if narrow or m > 0:
                turned = odd_moment(field, row, j, f, m, degree, narrow)
                point_q = point_q + factors[k, by + 3] * turned
                point_u = point_u + factors[k, by + 6] * turned
            sent = 1 + all_wide
            rows[k, j, sent + m] = point_q
            if narrow:  # U_1 in the second half, U_2 in the first
                if m == 1:
                    point_u = point_u + rows[k, j, sent + 2]
                rows[k, j, sent + 2] = point_u
            elif m > 0:
                rows[k, j, sent + EVEN - 1 + m] = point_u


@inlined
def by_level(levels, count, most, order):
    """Counting sort of points by the index of the radius below them.

    Parameters
    ----------
    levels : array, shape (n,)
        Index of that radius.
    count, most : int
        Number of points, and of radii.
    order : array, shape (n,)
        Receives the indices.
    """
    ends = np.zeros(most + 1, np.int64)
    for k in range(count):
        ends[levels[k] + 1] += 1
    for row in range(most):
        ends[row + 1] += ends[row]
    for k in range(count):
        at = ends[levels[k]]
        order[at] = k
        ends[levels[k]] = at + 1
