"""Kernels of the solver passes that do not depend on the order of scattering: ray optics.

Each kernel here and in ``light``, ``packing`` and ``mixing`` computes one element of a texture by
functions of ``solver.moments``. ``index`` is that of the texel for a result of four wavelengths,
and that of the component for a scalar result; its axes are given as "Texels (radius, direction)" or
"Numbers (radius, lane)", the last running fastest.

``sizes`` and ``tables`` are those of the module ``tables``, ``first_point`` is the first point of
the current radius range; every other argument is the result of an earlier pass, see ``passes``.
"""

from __future__ import annotations

import numpy as np

from airlight.kernel import inlined
from airlight.kernel.lanes import INVERSE_PI, exponential, splat
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.reflection import diffuse_reflectance
from airlight.render.gpu.solver.ray_sums import depth_in_row
from airlight.solver.moments.harmonics import (
    EVEN,
    POLARISED,
    degree_of,
    legendre_function,
    polarised_function,
)
from airlight.solver.moments.opaque_culling import ray_norm
from airlight.solver.moments.ray_optics import (
    mu_r_at_end,
    optical_depth,
    polarised_transmittance_ratio,
    strength_of,
    transmittance_ray,
)


@inlined
def strength(index, sizes, tables):
    """Quadrature weight of a constituent at a ray point times the transmittance from there. [m]

    Texels (point, constituent), the last of a point its ``polarised_transmittance_ratio``. [1]
    """
    point, c = index // (sizes.constituents + 1), index % (sizes.constituents + 1)
    if c == sizes.constituents:
        return polarised_transmittance_ratio(
            tables.column, point * sizes.constituents, tables.polarised_moments, sizes.constituents
        )
    depth = optical_depth(
        tables.column, point * sizes.constituents, tables.extinction, sizes.constituents
    )
    return exponential(0.0 - depth) * np.float32(tables.amount[point, c])


@inlined
def factor(index, sizes, tables):
    """Coefficient of one moment in the source of a ray point. [1]

    Texels (point, moment); even polarised moments by β₁, which couples them to the radiance moments
    of degree 2; then β₁, α₂ and α₃, for Q and U.
    """
    point, part = index // (sizes.terms + 1), index % (sizes.terms + 1)
    harmonics = sizes.terms - POLARISED
    coupled = harmonics + EVEN
    depth = optical_depth(
        tables.column, point * sizes.constituents, tables.extinction, sizes.constituents
    )
    transmittance = exponential(0.0 - depth)
    if part >= coupled:  # β₁, α₂ and α₃
        transmittance = transmittance * polarised_transmittance_ratio(
            tables.column, point * sizes.constituents, tables.polarised_moments, sizes.constituents
        )
        return transmittance * strength_of(
            tables.polarised_moments, tables.amount, point, part - coupled, sizes.constituents
        )
    l, m = 2, part - harmonics
    if part < harmonics:
        l = degree_of(part)
        m = part - l * (l + 1) // 2
        transmittance = transmittance * strength_of(
            tables.moments, tables.amount, point, l, sizes.constituents
        )
    else:
        transmittance = transmittance * strength_of(
            tables.polarised_moments, tables.amount, point, 0, sizes.constituents
        )
    function = legendre_function(
        tables.mu_along[point], l, m, tables.harmonic, tables.ahead, tables.back
    )
    return transmittance * np.float32(function)


@inlined
def share(index, sizes, tables):
    """Normalisation factor of the quadrature along a ray, see ``opaque_culling.ray_norm``. [1]

    Texels (radius, direction).
    """
    i, a = index // sizes.angles, index % sizes.angles
    first = int(tables.start[i, a])
    total = optical_depth(
        tables.total, index * sizes.constituents, tables.extinction, sizes.constituents
    )
    return ray_norm(
        first,
        int(tables.start[i, a + 1]) - first,
        tables.column,
        tables.amount,
        total,
        tables.extinction,
        sizes.constituents,
    )


@inlined
def transmittance(index, sizes, tables):
    """Transmittance of a ray that ends on the ground. [1]

    Texels (radius, direction); zero for rays that miss the ground.
    """
    if index % sizes.angles >= sizes.angles // 2:
        return splat(0.0)
    return transmittance_ray(
        tables.extinction,
        tables.total,
        index * sizes.constituents,
        sizes.constituents,
    )


@inlined
def bounce(index, sizes, tables, throughs):
    """Attenuated ground radiance of a ray per ground irradiance. [sr⁻¹]

    Texels (radius, direction); zero for rays that miss the ground.
    """
    i, a = index // sizes.angles, index % sizes.angles
    if a >= sizes.angles // 2:
        return splat(0.0)
    factor = diffuse_reflectance(tables.ground, 0, mu_r_at_end(tables.end, i, a, tables.mu[i, a]))
    return factor * INVERSE_PI * throughs[index]


@inlined
def projection(index, sizes, tables):
    """Quadrature weight of a direction in one moment. [1]

    Scalars (radius, direction, harmonic, and the five ``polarised_functions``), and after them
    (radius, direction): weight in the irradiance from above.
    """
    rays, width = sizes.radii * sizes.angles, sizes.terms
    if index >= rays * width:
        ray = index - rays * width
        return tables.flux[ray // sizes.angles, ray % sizes.angles]
    ray, term = index // width, index % width
    i, a = ray // sizes.angles, ray % sizes.angles
    which = term - (sizes.terms - POLARISED)
    if which >= 0:
        even, _ = polarised_function(tables.mu[i, a], which)
        _, odd = polarised_function(tables.mu[i, a], which - EVEN + 1)
        return tables.weight[i, a] * (even if which < EVEN else odd)
    l = degree_of(term)
    m = term - l * (l + 1) // 2
    function = legendre_function(tables.mu[i, a], l, m, tables.harmonic, tables.ahead, tables.back)
    return tables.weight[i, a] * function


@inlined
def depth(index, sizes, tables, first_point):
    """Optical depth from a ray point to the top of the shell. [1]

    Texels (point, direction); the ground, then the points of one radius range.
    """
    local, place = index // sizes.directions, index % sizes.directions
    q, x = sizes.bottom, 0.0
    if local > 0:
        q = tables.radius[first_point + local - 1]
        x = node_value(q, sizes.bottom, sizes.top, tables.first_nodes, tables.column_rows)
    return depth_in_row(
        tables.ratios,
        x,
        q,
        place,
        sizes.bottom,
        sizes.top,
        tables.extinction,
        sizes.constituents,
    )
