"""Light after a sweep: what the inverse along the vertical adds, and the image that follows.

Everything at one radius is done at once, on all cores: the arrays of a solve are larger than the
caches next to a processor, and whole-array operations would pass them a dozen times.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.threads import run_blocks
from airlight.solvers.moments.convergence import LEAST, Light
from airlight.solvers.moments.harmonics import POLARISED

Float32Array = NDArray[np.float32]


def sum_orders(swept: Light, first: Light, before: Light, more: Light) -> None:
    """Add the first order to a sweep, in place, and find the change that it makes.

    Parameters
    ----------
    swept, first, before : two arrays, shapes (r, s, k, 8), (r, s, 8)
        Moments and irradiances of the sweep, of the first order, and of the light that was swept.
    more : two arrays
        Receives the sum less the light that was swept.
    """

    def at(i: int) -> None:
        for one, other, old, new in zip(swept, first, before, more, strict=True):
            _sum(one[i].reshape(-1), other[i].reshape(-1), old[i].reshape(-1), new[i].reshape(-1))

    run_blocks(at, swept[0].shape[0])


@compiled_loop
def _sum(swept, first, before, more):
    """Add flat ``first`` to ``swept``, and take ``before`` from it."""
    for n in range(swept.size):
        swept[n] += first[n]
        more[n] = swept[n] - before[n]


def image(
    light: Light, more: Light, all_more: Light | None, swept: Light, trusted: Float32Array,
    further: Float32Array, step: float,
) -> Light:  # fmt: skip
    """Light with the change by a sweep and, where that is trusted, by all further ones.

    Parameters
    ----------
    light, more, swept : two arrays, shapes (r, s, k, 8), (r, s, 8)
        Light that was swept, the change by the sweep, and the light after it.
    all_more : two arrays, or None
        Change by all sweeps; None for orders one by one.
    trusted : array, shape (r, s, 8)
        Part of what further sweeps add that is taken. [1]
    further : array, shape (5,)
        Factors of the changes of polarised moments, which that does not complete. [1]
    step : float
        Part of the change that is taken. [1]

    Returns
    -------
    two arrays
        The image; the light after the sweep where that is far above it, in the dark.
    """
    out = np.empty_like(light[0]), np.empty_like(light[1])
    every = more if all_more is None else all_more
    factors = further if all_more is not None else np.ones_like(further)

    def at(i: int) -> None:
        _complete(
            light[0][i], more[0][i], every[0][i], swept[0][i], trusted[i], factors,
            np.float32(step), out[0][i],
        )  # fmt: skip
        _complete(
            light[1][i][:, None], more[1][i][:, None], every[1][i][:, None], swept[1][i][:, None],
            trusted[i], factors[:0], np.float32(step), out[1][i][:, None],
        )  # fmt: skip

    run_blocks(at, light[0].shape[0])
    return out


@compiled_loop
def _complete(light, more, every, swept, trusted, further, step, out):
    """Fill ``out`` (s, k, 8) with ``image`` at one radius; all arrays but two are like it.

    ``trusted`` has shape (s, 8); ``further`` has the factors of the last moments.
    """
    terms, lanes = light.shape[1], light.shape[2]
    for j in range(light.shape[0]):
        for k in range(terms):
            factor = step
            if k >= terms - further.size:
                factor = step * further[k - terms + further.size]
            for lane in range(lanes):
                change = more[j, k, lane]
                change += trusted[j, lane] * (every[j, k, lane] - change)
                out[j, k, lane] = light[j, k, lane] + factor * change
        for lane in range(lanes):
            if not out[j, 0, lane] > np.float32(LEAST) * swept[j, 0, lane]:
                for k in range(terms):
                    out[j, k, lane] = swept[j, k, lane]


def steering(before: Float32Array, after: Float32Array) -> tuple[Float32Array, Float32Array]:
    """Values (r, s·6, 8) whose relative change steers the iteration.

    Mean radiances, and mean radiances that differ by the change of each polarised moment: the
    inverse along the vertical does not complete those, so they are the last to converge.

    Parameters
    ----------
    before, after : array, shape (r, s, k, 8)
        Moments of a guess and of its image.
    """
    radii, suns, terms, lanes = after.shape
    earlier = np.empty((radii, suns, 1 + POLARISED, lanes), np.float32)
    mean = np.empty_like(earlier)
    _steer(before, after, terms - POLARISED, earlier, mean)
    shape = (radii, -1, lanes)
    return earlier.reshape(shape), mean.reshape(shape)


@compiled_loop
def _steer(before, after, polarised, earlier, mean):
    """Fill ``steering``; ``polarised`` is the index of the first polarised moment."""
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
