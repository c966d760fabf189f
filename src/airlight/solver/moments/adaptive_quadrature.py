"""Adaptive quadrature of rays through optically thick media: few points in faint panels.

Panels of a ray end at layer boundaries, wherever its radiance originates. A panel that contributes
a hundredth of the radiance needs a hundredth of the relative precision: it gets fewer
Gauss-Legendre points, to which its integrand is interpolated.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel.lanes import LANES
from airlight.solver.moments.ray_optics import ScaledOptics
from airlight.solver.moments.rays import Rays

FloatArray = NDArray[np.float64]

#: Smallest fraction of the ray's radiance from a panel, and the panel's number of points.
POINTS: Final = ((0.3, 8), (0.03, 5), (1e-3, 3), (0.0, 2))


def adaptive_quadrature(rays: Rays, air: ScaledOptics, nodes: int) -> Rays:
    """Rays with fewer points in faint panels.

    Parameters
    ----------
    air : ScaledOptics
        Optics of eight wavelengths; the most demanding one decides.
    nodes : int
        Largest number of points of a panel.
    """
    extinction = air.extinction.astype(float)
    constituents = extinction.shape[0]
    per_ray = np.diff(rays.start, axis=1).ravel() // nodes
    owner = np.repeat(np.arange(per_ray.size), per_ray)
    column, amount = rays.column[:, :constituents], rays.amount[:, :constituents]
    seen = np.exp(-(column @ extinction)) * (amount @ extinction)
    panels = seen.reshape(-1, nodes, LANES).sum(axis=1)
    whole = np.zeros((per_ray.size, LANES))
    np.add.at(whole, owner, panels)
    part = (panels / np.maximum(whole[owner], 1e-300)).max(axis=1)
    counts = np.full(part.size, nodes)
    for least, count in reversed(POINTS):
        counts[part >= least] = min(count, nodes)
    first = np.concatenate([[0], np.cumsum(counts)])
    along = {
        name: np.empty((first[-1], *getattr(rays, name).shape[1:]))
        for name in ("radius", "mu_along", "turn", "amount", "column")
    }
    given = gauss_legendre(nodes)
    for count in np.unique(counts):
        which = np.flatnonzero(counts == count)
        rule = gauss_legendre(int(count))
        between = _between(given.nodes, given.weights, rule.nodes)
        at = first[which][:, None] + np.arange(count)
        for name, values in along.items():
            old = getattr(rays, name).reshape(part.size, nodes, -1)[which]
            if count == nodes:
                new = old
            elif name == "amount":
                new = np.maximum(between @ (old / given.weights[:, None]), 0.0)
                new = new * rule.weights[:, None]
            else:
                new = between @ old
            values[at] = new.reshape(*at.shape, *values.shape[1:])
    ends = np.concatenate([[0], np.cumsum(per_ray)])
    rows, angles = rays.mu.shape
    begin = first[ends[:-1]].reshape(rows, angles)
    last = first[ends[1:]].reshape(rows, angles)[:, -1:]
    np.clip(along["mu_along"], -1.0, 1.0, out=along["mu_along"])
    return rays._replace(start=np.concatenate([begin, last], axis=1), **along)


def _between(nodes: FloatArray, weights: FloatArray, points: FloatArray) -> FloatArray:
    """Matrix of polynomial interpolation from n nodes to m others, shape (m, n). [1]"""
    degrees = np.arange(nodes.size)
    analysis = (2 * degrees[:, None] + 1) * weights
    analysis = analysis * legvander(2.0 * nodes - 1.0, nodes.size - 1).T
    return np.asarray(legvander(2.0 * points - 1.0, nodes.size - 1) @ analysis)
