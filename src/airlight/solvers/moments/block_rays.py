"""Rays as eight wavelengths need them: no points out of sight, and no light lost on the way."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import LANES
from airlight.solvers.moments.rays import Rays
from airlight.solvers.moments.sweep import Air

Float32Array = NDArray[np.float32]

#: Optical depth beyond which a point is not seen: 1e-6 of its light comes through. [1]
_OUT_OF_SIGHT: Final = 14.0
#: What ``Rays`` holds for each point.
_ALONG: Final = ("radius", "mu_along", "turn", "amount", "column")
#: A ray's sum may be off by so much at most; more is a ray without points that count.
_MOST: Final = 0.5


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
    light = np.exp(-before[seen]) * (rays.amount[seen, :constituents] @ extinction)
    total = np.zeros((counts.size, LANES))
    for lane in range(LANES):
        total[:, lane] = np.bincount(owner, weights=light[:, lane], minlength=counts.size)
    whole = -np.expm1(-(rays.total[..., :constituents].reshape(counts.size, -1) @ extinction))
    share = np.divide(whole, total, out=np.ones_like(whole), where=total > 0.0)
    share = np.clip(share, 1.0 - _MOST, 1.0 + _MOST)
    kept = np.bincount(owner, minlength=counts.size).reshape(counts.shape)
    starts = np.concatenate([[0], np.cumsum(kept.ravel())])
    begin, end = starts[:-1].reshape(counts.shape), starts[1:].reshape(counts.shape)
    along = {name: getattr(rays, name)[seen] for name in _ALONG}
    start = np.concatenate([begin, end[:, -1:]], axis=1)
    return rays._replace(start=start, **along), share.astype(np.float32).reshape(-1)
