"""Convergence of the iteration: acceleration weights, remaining error, Anderson step.

Formulas of a node or a wavelength, and loops over a field, are emitted for the page, too.
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

#: Mean radiance below this fraction of its maximum is dark, and ignored by the iteration.
DARK: Final = 1e-6
#: In optically thick media the tolerance is relative above this fraction of the largest mean
#: radiance, and absolute below.
DIM: Final = 5e-2
#: The accelerated iterate is used only above this fraction of the swept one.
LEAST: Final = 0.1
#: Fraction of the largest mean radiance below which lateral transport dominates, at small and at
#: large transport optical depth; and the depth above which it increases. [1]
SHALLOW_THRESHOLD: Final = 1e-4
DEEP_THRESHOLD: Final = 2e-2
TRANSPORT_DEPTH_SCALE: Final = 5.0
#: Limits of the estimated ratio of successive changes. [1]
SHRINKAGE: Final = 0.3
STALLED: Final = 0.75
#: Number of sweeps over which that ratio is measured.
BACK: Final = 2


def acceleration_weights(mean: Float32Array, lateral_threshold: FloatArray) -> Float32Array:
    """Weights of synthetic acceleration, shape (r, s, 8). [1]

    Small on the night side of optically thick media, where lateral transport dominates.
    """
    most = np.maximum(mean.max(axis=(0, 1)), 1e-30).astype(float)
    relative, column = mean / most, mean.max(axis=0) / most
    return np.asarray(
        acceleration_weight(np.maximum(relative * column, 0.0), lateral_threshold), np.float32
    )


def lateral_threshold_of(transport, thick):
    """Fraction of the largest mean radiance below which lateral transport dominates. [1]

    Parameters
    ----------
    transport : float
        Vertical transport optical depth of a wavelength. [1]
    thick : float
        Weight of optically thick media, from ``optically_thick_weight``. [1]
    """
    depth_ratio = max(transport / TRANSPORT_DEPTH_SCALE, 1.0)
    return thick * min(SHALLOW_THRESHOLD * depth_ratio**3, DEEP_THRESHOLD)


def acceleration_weight(bright, lateral_threshold):
    """Weight of synthetic acceleration at a node. [1]

    Parameters
    ----------
    bright : float or array
        Mean radiance at the node times the largest at any radius for the same sun angle, both over
        the largest at any node. [1]
    lateral_threshold : float or array
        Fraction of the largest mean radiance below which lateral transport dominates. [1]
    """
    return bright / (bright + lateral_threshold * lateral_threshold + 1e-30)


@kernel
def count_at(mean, brightest, thick):
    """Weight of a relative change at a node: small on the night side of thick media. [1]

    Parameters
    ----------
    mean, brightest : float
        Mean radiance at the node, and the largest at any node.
    thick : float
        Exponent, from 0 (relative changes) to 1 (absolute changes). [1]
    """
    return min(max(mean / (DIM * brightest), 1e-30), 1.0) ** thick


@compiled_loop
def counted_changes(before, after, thick, night, brightest, changes, largest):
    """Relative changes of mean radiances (r, n, w), weighted by ``count_at``.

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
        Receives the largest change; 0 before. NaN propagates. [1]
    """
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
    """Accelerated iterate, or the swept one where the former is negative or far below it."""
    field, sky = field.copy(), sky.copy()
    replace_unsound(field, swept_field, is_positive(field[:, :, 0], swept_field[:, :, 0]))
    replace_unsound(sky[:, :, None], swept_sky[:, :, None], is_positive(sky, swept_sky))
    return field, sky


def is_positive(accelerated, swept):
    """Whether an accelerated mean radiance, or array of such, is not far below the swept one."""
    return accelerated > LEAST * swept


def clip_to_first_order(light: Float32Array, least: Float32Array) -> None:
    """Replace moments (r, s, k, 8) by ``least``, or 0, where their mean radiance is below.

    Radiance is not negative, but its truncated expansion may be where it nearly vanishes.
    """
    sound = light[:, :, 0] >= least[:, :, 0]
    if not sound.all():
        replace_unsound(light, np.where(least[:, :, :1] > 0.0, least, np.float32(0.0)), sound)


@compiled_loop
def replace_unsound(light, other, sound):
    """Replace moments (r, s, k, 8) by ``other`` where ``sound`` (r, s, 8) is false."""
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

    ρ is the convergence rate: the ratio of successive changes over the last steps.

    Parameters
    ----------
    last, before : float
        Size of the last change, and of the change ``steps`` before it.
    steps : int
        0 without an earlier change: ρ = 1/2 is assumed.
    """
    ratio = 0.5
    if steps > 0 and before > 0.0:
        ratio = last / before
    if steps > 1:
        ratio = ratio ** (1.0 / steps)
    ratio = min(max(ratio, SHRINKAGE), STALLED)
    return ratio / (1.0 - ratio)


def tail_steps(residuals):
    """Number of steps over which the convergence rate is measured, from that of residuals."""
    return min(residuals, BACK + 1) - 1


def estimated_tail(residuals: deque[FloatArray]) -> FloatArray:
    """Geometric tail from the norms of the residuals (n, w) of up to two steps, shape (w,). [1]"""
    sizes = [np.sqrt(np.square(one).sum(axis=0)) for one in residuals]
    steps = tail_steps(len(sizes))
    return np.asarray(vectorized(geometric_tail)(sizes[-1], sizes[-1 - steps], steps))


def anderson_step(
    iterates: deque[Light], weights: Float32Array, damping: Float32Array, mixed: Light
) -> None:
    """Anderson step: weighted combination of iterates, per wavelength.

    Parameters
    ----------
    iterates : deque of Light
        Recent iterates, the latest last.
    weights : array, shape (iterates, 8)
        Weights of the iterates. [1]
    damping : array, shape (r, s, 8)
        Weights from ``acceleration_weights``. [1]
    mixed : Light
        Receives the next guess; not one of the iterates.
    """
    for part, last in enumerate(iterates[-1]):
        shape = (*last.shape[:2], -1, last.shape[-1])
        total, latest = mixed[part].reshape(shape), last.reshape(shape)
        total[:] = 0.0
        for iterate, weight in zip(iterates, weights, strict=True):
            add_weighted(total, iterate[part].reshape(shape), weight)
        damp_towards(total, latest, damping)
        # Where it is dark, or the combination is far from the latest iterate, keep the latter.
        replace_unsound(total, latest, _is_near(total[:, :, 0], latest[:, :, 0]))


@compiled_loop
def add_weighted(total, light, weight):
    """Add moments (r, s, k, 8) times weights of the wavelengths (8,)."""
    for i in range(total.shape[0]):
        for j in range(total.shape[1]):
            for k in range(total.shape[2]):
                for lane in range(total.shape[3]):
                    total[i, j, k, lane] += light[i, j, k, lane] * weight[lane]


@compiled_loop
def damp_towards(mixed, last, damping):
    """Damp the mixed moments (r, s, k, 8) towards the last ones by ``damping`` (r, s, 8)."""
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
    """Whether a mixed mean radiance is within a factor of two of the computed one, if not dark.

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
