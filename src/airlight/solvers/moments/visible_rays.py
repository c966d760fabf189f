"""Rays as eight wavelengths need them: no points out of sight, and no light lost on the way."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, exponential, load, maximum, minimum, splat, store
from airlight.solvers.moments.rays import Rays
from airlight.solvers.moments.sweep import Air, optical_depth

Float32Array = NDArray[np.float32]

#: Optical depth beyond which a point is not seen: 1e-6 of its light comes through. [1]
_OUT_OF_SIGHT: Final = 14.0
#: What ``Rays`` holds for each point.
_ALONG: Final = ("radius", "mu_along", "turn", "amount", "column")
#: A ray's sum may be off by so much at most; more is a ray without points that count.
MOST: Final = 0.5


def rays_in_sight(rays: Rays, air: Air) -> tuple[Rays, Float32Array]:
    """The points that any of eight wavelengths sees, and what makes the sum over them exact.

    Parameters
    ----------
    rays : Rays
        For all wavelengths.
    air : Air
        Of eight of them.

    Returns
    -------
    rays : Rays
        With fewer points.
    share : array, shape (r·a·8,)
        1 - exp(-τ) of the whole ray over the quadrature's sum of exp(-τ) dτ: with that factor a
        source that is the same everywhere is kept as it is, and no light is lost. [1]
    """
    extinction = air.extinction.astype(float).reshape(-1, LANES)
    constituents = extinction.shape[0]
    before = rays.column[:, :constituents] @ extinction
    seen = before.min(axis=1) < _OUT_OF_SIGHT
    counts = np.diff(rays.start, axis=1)
    owner = np.repeat(np.arange(counts.size), counts.ravel())[seen]
    kept = np.bincount(owner, minlength=counts.size).reshape(counts.shape)
    starts = np.concatenate([[0], np.cumsum(kept.ravel())])
    begin, end = starts[:-1].reshape(counts.shape), starts[1:].reshape(counts.shape)
    along = {name: getattr(rays, name)[seen] for name in _ALONG}
    start = np.concatenate([begin, end[:, -1:]], axis=1)
    in_sight = rays._replace(start=start, **along)
    share = np.empty(counts.size * LANES, np.float32)
    _fill_shares(
        starts,
        np.ascontiguousarray(in_sight.column[:, :constituents]).reshape(-1),
        in_sight.amount,
        np.ascontiguousarray(rays.total[..., :constituents]).reshape(-1),
        air.extinction,
        share,
    )
    return in_sight, share


@inlined
def emitted(tau):
    """1 - exp(-τ) of eight wavelengths, of as many digits where τ is small. [1]"""
    thin = minimum(tau, 0.05)
    # The series' next term is at most 5e-8 of the first.
    series = thin * (1.0 - thin * (0.5 - thin * (0.16666667 - thin * 0.041666667)))
    # Exactly nothing beyond where τ is small, however an exponential rounds.
    rest = tau - thin
    beyond = minimum(maximum(1.0 - exponential(0.0 - rest), 0.0), rest)
    return series + exponential(0.0 - thin) * beyond


@inlined
def ray_share(first, points, columns, amounts, total, extinction, constituents):
    """What makes the sum over a ray's points exact, see ``rays_in_sight``. [1]

    Parameters
    ----------
    first, points : int
        The ray's points.
    columns : array, shape (p·nc,)
        From the start of the ray to its points. [m]
    amounts : array, shape (p, nc)
        As in ``Rays``. [m]
    total : lanes
        Optical depth of the whole ray. [1]
    extinction : array, shape (nc·8,)
        [m⁻¹]
    constituents : int
    """
    light = splat(0.0)
    for k in range(points):
        before = optical_depth(columns, (first + k) * constituents, extinction, constituents)
        step = splat(0.0)
        for c in range(constituents):
            step = step + load(extinction, LANES * c) * np.float32(amounts[first + k, c])
        light = light + exponential(0.0 - before) * step
    share = emitted(total) / maximum(light, 1e-30)
    return minimum(maximum(share, 1.0 - MOST), 1.0 + MOST)


@compiled_loop
def _fill_shares(starts, columns, amounts, totals, extinction, out):
    constituents = extinction.size // LANES
    for ray in range(starts.size - 1):
        first = starts[ray]
        total = optical_depth(totals, ray * constituents, extinction, constituents)
        share = ray_share(
            first,
            starts[ray + 1] - first,
            columns,
            amounts,
            total,
            extinction,
            constituents,
        )
        store(out, LANES * ray, share)
