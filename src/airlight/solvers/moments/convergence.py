"""Convergence of the iteration: acceleration weights, remaining error, Anderson step.

These functions take the field at all radii and sun angles, for one batch of wavelengths. Formulas
of a single node or wavelength are kernels, which the browser shares; ``stopping`` has the stopping
rule.
"""

from __future__ import annotations

from collections import deque
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, kernel, vectorized

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
#: Moments (r, s, k, 8) and irradiances (r, s, 8).
Light = tuple[Float32Array, Float32Array]

#: Mean radiance below this part of its largest value is dark: it does not affect the iteration.
DARK: Final = 1e-6
#: In thick air the tolerance is relative for mean radiances above this part of the largest one,
#: and absolute below.
DIM: Final = 5e-2
#: Accelerated light counts only above this fraction of the swept light.
LEAST: Final = 0.1
#: Limits of the estimated ratio of successive changes. [1]
SHRINKAGE: Final = 0.3
STALLED: Final = 0.75
#: Number of sweeps over which that ratio is measured.
BACK: Final = 2


def acceleration_weights(mean: Float32Array, lateral_threshold: FloatArray) -> Float32Array:
    """Weights of synthetic acceleration, shape (r, s, 8). [1]

    They are small in the night of thick air, where lateral transport dominates.
    """
    most = np.maximum(mean.max(axis=(0, 1)), 1e-30).astype(float)
    relative, column = mean / most, mean.max(axis=0) / most
    return np.asarray(
        acceleration_weight(np.maximum(relative * column, 0.0), lateral_threshold), np.float32
    )


def acceleration_weight(bright, lateral_threshold):
    """Weight of synthetic acceleration at a node. [1]

    Parameters
    ----------
    bright : float or array
        Mean radiance at the node times the largest at any radius under the same sun, both over the
        largest at any node. [1]
    lateral_threshold : float or array
        Fraction of the largest mean radiance below which lateral transport dominates. [1]
    """
    return bright / (bright + lateral_threshold * lateral_threshold + 1e-30)


@kernel
def count_at(mean, brightest, thick):
    """Weight of a relative change at a node: smaller in the night of thick air. [1]

    Parameters
    ----------
    mean, brightest : float
        Mean radiance at the node, and the largest at any node.
    thick : float
        Exponent, from 0 (all changes count alike) to 1 (in proportion to the light itself). [1]
    """
    return min(max(mean / (DIM * brightest), 1e-30), 1.0) ** thick


@compiled_loop
def counted_changes(before, after, thick, night, brightest, changes, largest):
    """Changes of mean radiances (r, n, w), counted as ``count_at`` says.

    Parameters
    ----------
    before, after : array, shape (r, n, w)
        Mean radiances of a guess and of its iterate.
    thick : array, shape (w,)
        Exponent of ``count_at``. [1]
    night : float
        Factor of that exponent for the largest change. [1]
    brightest : array, shape (w,)
        Largest mean radiances of the iterate.
    changes : array, shape (r·n, w)
        Receives the changes. [1]
    largest : array, shape (w,)
        Receives the largest; NaN stays NaN. [1]
    """
    largest[:] = 0.0
    for i in range(after.shape[0]):
        for j in range(after.shape[1]):
            n = i * after.shape[1] + j
            for lane in range(after.shape[2]):
                mean = float(after[i, j, lane])
                change = change_at(float(before[i, j, lane]), mean, brightest[lane])
                counted = change
                if thick[lane] > 0.0:
                    counted = change * count_at(mean, brightest[lane], night * thick[lane])
                    change = change * count_at(mean, brightest[lane], thick[lane])
                changes[n, lane] = change
                known = largest[lane]
                if known == known and not abs(counted) <= known:  # NaN stays NaN
                    largest[lane] = abs(counted)


def positivity_fixup(
    field: Float32Array, sky: Float32Array, swept_field: Float32Array, swept_sky: Float32Array
) -> Light:
    """Accelerated light, or the swept light where the former is far below it or negative."""
    field, sky = field.copy(), sky.copy()
    _replace(field, swept_field, field[:, :, 0] > LEAST * swept_field[:, :, 0])
    _replace(sky[:, :, None], swept_sky[:, :, None], sky > LEAST * swept_sky)
    return field, sky


def clip_to_first_order(light: Float32Array, least: Float32Array) -> None:
    """Replace moments (r, s, k, 8) by ``least``, or 0, where their mean is below.

    No light is negative, but a sum of few harmonics may be where there is almost none.
    """
    sound = light[:, :, 0] >= least[:, :, 0]
    if not sound.all():
        _replace(light, np.where(least[:, :, :1] > 0.0, least, np.float32(0.0)), sound)


@compiled_loop
def _replace(light, other, sound):
    """Replace moments (r, s, k, 8) by others where they are not ``sound`` (r, s, 8)."""
    for i in range(light.shape[0]):
        for j in range(light.shape[1]):
            for lane in range(light.shape[3]):
                if not sound[i, j, lane]:
                    for k in range(light.shape[2]):
                        light[i, j, k, lane] = other[i, j, k, lane]


@kernel
def change_at(before, after, brightest):
    """Relative change of a node's mean radiance where it is not dark, otherwise 0. [1]

    Parameters
    ----------
    before, after : float
        Mean radiance of a guess and of its iterate.
    brightest : float
        Largest mean radiance of the iterate at any node.
    """
    if after > DARK * brightest:
        return (after - before) / after
    return 0.0


@kernel
def geometric_tail(last, before, steps):
    """Tail of the geometric series of changes over the last change, ρ/(1 - ρ). [1]

    ρ is the ratio by which the changes shrank in each of the last steps.

    Parameters
    ----------
    last, before : float
        Size of the last change, and of the change ``steps`` before it.
    steps : int
        0 where there is no earlier change: a ratio of one half is assumed.
    """
    ratio = 0.5
    if steps > 0 and before > 0.0:
        ratio = last / before
    if steps > 1:
        ratio = ratio ** (1.0 / steps)
    ratio = min(max(ratio, SHRINKAGE), STALLED)
    return ratio / (1.0 - ratio)


def estimated_tail(residuals: deque[FloatArray]) -> FloatArray:
    """``geometric_tail`` of the residuals (n, w), by norm, over up to two steps, shape (w,). [1]"""
    sizes = [np.sqrt(np.square(one).sum(axis=0)) for one in residuals]
    steps = min(len(sizes), BACK + 1) - 1
    return np.asarray(vectorized(geometric_tail)(sizes[-1], sizes[-1 - steps], steps))


def anderson_step(
    iterates: deque[Light], weights: Float32Array, damping: Float32Array, mixed: Light
) -> None:
    """Next guess by Anderson acceleration: each wavelength has its own combination of iterates.

    Parameters
    ----------
    iterates : deque of Light
        Last iterates of the light, the latest last.
    weights : array, shape (iterates, 8)
        Weights of the iterates. [1]
    damping : array, shape (r, s, 8)
        Weights from ``acceleration_weights``. [1]
    mixed : Light
        Receives the guess; none of the iterates.
    """
    for part, last in enumerate(iterates[-1]):
        shape = (*last.shape[:2], -1, last.shape[-1])
        total, latest = mixed[part].reshape(shape), last.reshape(shape)
        total[:] = 0.0
        for iterate, weight in zip(iterates, weights, strict=True):
            _add(total, iterate[part].reshape(shape), weight)
        _approach(total, latest, damping)
        # In the dark, and where the combination is far off, keep the latest iterate.
        _replace(total, latest, _is_near(total[:, :, 0], latest[:, :, 0]))


@compiled_loop
def _add(total, light, weight):
    """Add moments (r, s, k, 8) times the weight of each wavelength (8,)."""
    for i in range(total.shape[0]):
        for j in range(total.shape[1]):
            for k in range(total.shape[2]):
                for lane in range(total.shape[3]):
                    total[i, j, k, lane] += light[i, j, k, lane] * weight[lane]


@compiled_loop
def _approach(mixed, last, damping):
    """Interpolate from the last moments (r, s, k, 8) to the mixed ones by ``damping`` (r, s, 8)."""
    for i in range(mixed.shape[0]):
        for j in range(mixed.shape[1]):
            for k in range(mixed.shape[2]):
                for lane in range(mixed.shape[3]):
                    known = last[i, j, k, lane]
                    mixed[i, j, k, lane] = known + damping[i, j, lane] * (
                        mixed[i, j, k, lane] - known
                    )


@kernel
def is_near(mixed, computed, brightest):
    """Whether a mixed mean radiance is within a factor of two of a computed one that is not dark.

    Parameters
    ----------
    mixed, computed : float
        Mean radiances at one node.
    brightest : float
        Largest computed mean radiance at any node.
    """
    lit = computed > DARK * brightest
    return lit and mixed > 0.5 * computed and mixed < 2.0 * computed


def _is_near(mixed: Float32Array, computed: Float32Array) -> NDArray[np.bool_]:
    brightest = computed.max(axis=(0, 1))
    return np.asarray(vectorized(is_near)(mixed, computed, brightest), bool)
