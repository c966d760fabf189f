"""Next iterate after a sweep, with synthetic acceleration and over-relaxation.

Loops run over one radius at a time, as the arrays exceed the caches.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES
from airlight.kernel.threads import run_blocks
from airlight.solver.moments.convergence import LEAST, Light
from airlight.solver.moments.harmonics import POLARISED

Float32Array = NDArray[np.float32]


def add_first_order(swept: Light, first: Light, before: Light, residual: Light) -> None:
    """Add the first order to a sweep, in place, and compute the residual.

    Parameters
    ----------
    swept, first, before : two arrays, shapes (r, s, k, 8), (r, s, 8)
        Moments and irradiances of the sweep, of the first order, and of the previous iterate.
    residual : two arrays
        Receives the sum of sweep and first order, less the previous iterate.
    """

    def at(i: int) -> None:
        for one, other, old, new in zip(swept, first, before, residual, strict=True):
            _add_orders(
                one[i].reshape(-1), other[i].reshape(-1), old[i].reshape(-1), new[i].reshape(-1)
            )

    run_blocks(at, swept[0].shape[0])


@compiled_loop
def _add_orders(swept, first, before, residual):
    """Add ``first`` to ``swept``; ``residual`` receives the sum less ``before``; all flat."""
    for n in range(swept.size):
        swept[n] += first[n]
        residual[n] = swept[n] - before[n]


def next_iterate(
    light: Light,
    residual: Light,
    accelerated_residual: Light | None,
    swept: Light,
    weight: Float32Array,
    over_relaxation: Float32Array,
    relaxation: float,
) -> Light:
    """Previous iterate plus the accelerated residual, weighted by ``weight``.

    Parameters
    ----------
    light, residual, swept : two arrays, shapes (r, s, k, 8), (r, s, 8)
        Previous iterate, its residual, and the iterate after the sweep.
    accelerated_residual : two arrays, or None
        Residual after ``SyntheticAcceleration.apply``; None for plain successive orders.
    weight : array, shape (r, s, 8)
        Weight of the accelerated residual, from ``acceleration_weights``. [1]
    over_relaxation : array, shape (5,)
        Over-relaxation factors of the polarised moments; 1 for plain successive orders. [1]
    relaxation : float
        Relaxation factor of all moments. [1]

    Returns
    -------
    two arrays
        Next iterate; that after the sweep where the accelerated one is negative or far below it.
    """
    out = np.empty_like(light[0]), np.empty_like(light[1])
    accelerated = residual if accelerated_residual is None else accelerated_residual
    factors = over_relaxation if accelerated_residual is not None else np.ones_like(over_relaxation)

    def at(i: int) -> None:
        for part, over in ((0, factors), (1, factors[:0])):
            fields = (one[part][i] for one in (light, residual, accelerated, swept, out))
            *given, found = (one.reshape(one.shape[0], -1, LANES) for one in fields)
            accelerate_nodes(*given, weight[i], over, np.float32(relaxation), found)

    run_blocks(at, light[0].shape[0])
    return out


@compiled_loop
def accelerate_nodes(light, residual, accelerated, swept, weight, over_relaxation, relaxation, out):
    """Fill ``out`` (s, k, 8) with ``next_iterate`` at one radius.

    ``weight`` has shape (s, 8), ``over_relaxation`` the factors of the last moments; the other
    arrays have the shape of ``out``.
    """
    terms, lanes = light.shape[1], light.shape[2]
    for j in range(light.shape[0]):
        for k in range(terms):
            factor = relaxation
            if k >= terms - over_relaxation.size:
                factor = relaxation * over_relaxation[k - terms + over_relaxation.size]
            for lane in range(lanes):
                change = residual[j, k, lane]
                change += weight[j, lane] * (accelerated[j, k, lane] - change)
                out[j, k, lane] = light[j, k, lane] + factor * change
        for lane in range(lanes):
            if not out[j, 0, lane] > np.float32(LEAST) * swept[j, 0, lane]:
                for k in range(terms):
                    out[j, k, lane] = swept[j, k, lane]


def convergence_quantities(
    before: Float32Array, after: Float32Array
) -> tuple[Float32Array, Float32Array]:
    """Quantities (r, s·6, 8) whose relative change measures convergence.

    Mean radiances, and mean radiances plus the change of each polarised moment, which are not
    accelerated and converge last.

    Parameters
    ----------
    before, after : array, shape (r, s, k, 8)
        Moments of a guess and of its iterate.
    """
    radii, sun_angles, terms, lanes = after.shape
    earlier = np.empty((radii, sun_angles, 1 + POLARISED, lanes), np.float32)
    mean = np.empty_like(earlier)
    fill_quantities(before, after, terms - POLARISED, earlier, mean)
    shape = (radii, -1, lanes)
    return earlier.reshape(shape), mean.reshape(shape)


@compiled_loop
def fill_quantities(before, after, polarised, earlier, mean):
    """Fill ``convergence_quantities``; ``polarised`` is the index of the first polarised moment."""
    for i in range(after.shape[0]):
        for j in range(after.shape[1]):
            for n in range(mean.shape[2]):
                k = 0
                if n > 0:
                    k = polarised + n - 1
                for lane in range(after.shape[3]):
                    light = after[i, j, 0, lane]
                    mean[i, j, n, lane] = light
                    change = after[i, j, k, lane] - before[i, j, k, lane]
                    earlier[i, j, n, lane] = light - change
