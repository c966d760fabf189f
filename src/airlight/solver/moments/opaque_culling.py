"""Culling of ray points at optical depths that are opaque at eight wavelengths."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, exponential, lane_view, maximum, minimum, splat
from airlight.solver.moments.ray_optics import ScaledOptics, optical_depth
from airlight.solver.moments.rays import Rays

Float32Array = NDArray[np.float32]

#: Optical depth beyond which points are culled: the transmittance is 1e-6. [1]
_OPAQUE: Final = 14.0
#: Arrays of ``Rays`` with a row for each point.
_ALONG: Final = ("radius", "mu_along", "turn", "amount", "column")
#: Largest correction of a ray's sum; a larger one indicates a ray without significant points.
MOST: Final = 0.5


def cull_opaque(rays: Rays, air: ScaledOptics) -> tuple[Rays, Float32Array]:
    """Rays without points that are opaque at all eight wavelengths, and normalisation factors.

    Returns
    -------
    rays : Rays
        Rays with fewer points.
    norm : array, shape (r, a, 8)
        1 - exp(-τ) of the whole ray over the quadrature's sum of exp(-τ) dτ: with this factor the
        sum is exact for a constant source function, and energy is conserved. [1]
    """
    extinction = air.extinction.astype(float)
    constituents = extinction.shape[0]
    before = rays.column[:, :constituents] @ extinction
    seen = before.min(axis=1) < _OPAQUE
    counts = np.diff(rays.start, axis=1)
    owner = np.repeat(np.arange(counts.size), counts.ravel())[seen]
    kept = np.bincount(owner, minlength=counts.size).reshape(counts.shape)
    starts = np.concatenate([[0], np.cumsum(kept.ravel())])
    begin, end = starts[:-1].reshape(counts.shape), starts[1:].reshape(counts.shape)
    along = {name: getattr(rays, name)[seen] for name in _ALONG}
    start = np.concatenate([begin, end[:, -1:]], axis=1)
    near = rays._replace(start=start, **along)
    norm = np.empty((counts.size, LANES), np.float32)
    norms_into(
        starts,
        np.ascontiguousarray(near.column[:, :constituents]).reshape(-1),
        near.amount,
        np.ascontiguousarray(rays.total[..., :constituents]).reshape(-1),
        air.extinction,
        norm,
    )
    return near, norm.reshape(*counts.shape, LANES)


@inlined
def emitted(tau):
    """1 - exp(-τ) of eight wavelengths, accurate also for small τ. [1]"""
    thin = minimum(tau, 0.05)
    # The series' next term is at most 5e-8 of the first.
    series = thin * (1.0 - thin * (0.5 - thin * (0.16666667 - thin * 0.041666667)))
    # Exactly 0 beyond where τ is small, however an exponential rounds.
    rest = tau - thin
    beyond = minimum(maximum(1.0 - exponential(0.0 - rest), 0.0), rest)
    return series + exponential(0.0 - thin) * beyond


@inlined
def ray_norm(first, points, columns, amounts, total, extinction, constituents):
    """Normalisation factor that makes a ray's sum exact for a constant source function. [1]

    Parameters
    ----------
    first, points : int
        Index of the ray's first point, and number of its points.
    columns : array, shape (p·nc,)
        Columns from the start of the ray to its points. [m]
    amounts : array, shape (p, nc)
        Amounts as in ``Rays``. [m]
    total : lanes
        Optical depth of the whole ray. [1]
    extinction : lanes, shape (nc,)
        Extinction coefficients. [m⁻¹]
    """
    light = splat(0.0)
    for k in range(points):
        before = optical_depth(columns, (first + k) * constituents, extinction, constituents)
        step = splat(0.0)
        for c in range(constituents):
            step = step + extinction[c] * np.float32(amounts[first + k, c])
        light = light + exponential(0.0 - before) * step
    norm = emitted(total) / maximum(light, 1e-30)
    return minimum(maximum(norm, 1.0 - MOST), 1.0 + MOST)


@compiled_loop
def norms_into(starts, columns, amounts, totals, extinction, out):
    """Fill ``out`` with ``ray_norm`` of all rays."""
    extinction, shares = lane_view(extinction), lane_view(out)
    constituents = extinction.shape[0]
    for ray in range(starts.size - 1):
        first = starts[ray]
        total = optical_depth(totals, ray * constituents, extinction, constituents)
        points = starts[ray + 1] - first
        shares[ray] = ray_norm(first, points, columns, amounts, total, extinction, constituents)
