"""Trust in a guess of the light, its remaining change, and the next guess.

These functions take the light at all radii and suns, some wavelengths at a time. Formulas of one
node or one wavelength are kernels, so that a page runs the same; when to stop is in ``stopping``.
"""

from __future__ import annotations

from collections import deque
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import kernel, vectorized

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
#: Moments (r, s, k, 8) and irradiances (r, s, 8).
Light = tuple[Float32Array, Float32Array]

#: Mean radiance below this part of its largest value is dark: it does not affect the iteration.
DARK: Final = 1e-6
#: In thick air the tolerance is relative for mean radiances above this part of the largest one,
#: and absolute below.
DIM: Final = 5e-2
#: Light completed by the inverse counts only above this part of the swept light.
_LEAST: Final = 0.1
#: Lower limit of the estimated ratio of successive changes.
SHRINKAGE: Final = 0.3
STALLED: Final = 0.75
#: Number of sweeps over which that ratio is measured.
BACK: Final = 2


def trust(mean: Float32Array, sidelit: FloatArray) -> Float32Array:
    """Weight of the solution along the vertical as an estimate of further sweeps, shape (r, s, 8).

    It is small in the night of thick air: there light comes from the side.
    """
    most = np.maximum(mean.max(axis=(0, 1)), 1e-30).astype(float)
    here, column = mean / most, mean.max(axis=0) / most
    bright = np.maximum(here * column, 0.0)
    return np.asarray(bright / (bright + np.square(sidelit) + 1e-30), np.float32)


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


def counts(mean: Float32Array, thick: FloatArray) -> FloatArray:
    """``count_at`` of mean radiances (r, s, w)."""
    light = mean.astype(float)
    return np.asarray(vectorized(count_at)(light, light.max(axis=(0, 1)), thick))


def completed_or_swept(
    field: Float32Array, sky: Float32Array, swept_field: Float32Array, swept_sky: Float32Array
) -> Light:
    """Completed guess, or the swept light where the guess is far below it: in the dark."""
    sound = field[:, :, 0] > _LEAST * swept_field[:, :, 0]
    field = np.where(sound[:, :, None], field, swept_field)
    return field, np.where(sky > _LEAST * swept_sky, sky, swept_sky)


@kernel
def change_at(before, after, brightest):
    """Relative change of a node's mean radiance where it is not dark, otherwise 0. [1]

    Parameters
    ----------
    before, after : float
        Mean radiance of a guess and of its image.
    brightest : float
        Largest mean radiance of the image at any node.
    """
    if after > DARK * brightest:
        return (after - before) / after
    return 0.0


def relative_change(before: Float32Array, after: Float32Array) -> FloatArray:
    """``change_at`` of mean radiances (r, s, w)."""
    old, new = before.astype(float), after.astype(float)
    return np.asarray(vectorized(change_at)(old, new, new.max(axis=(0, 1))))


@kernel
def rest_after(last, before, steps):
    """Sum of all later changes over the last change, ρ/(1 - ρ). [1]

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


def remaining_change(residuals: deque[FloatArray]) -> FloatArray:
    """``rest_after`` the last of residuals (n, w), from up to two steps before it."""
    sizes = [np.sqrt(np.square(one).sum(axis=0)) for one in residuals]
    steps = min(len(sizes), BACK + 1) - 1
    return np.asarray(vectorized(rest_after)(sizes[-1], sizes[-1 - steps], steps))


def mix(images: deque[Light], weights: Float32Array, trust: Float32Array) -> Light:
    """Next guess: for each wavelength its own combination of the last images.

    Parameters
    ----------
    images : deque of Light
        Last images of the light, the latest last.
    weights : array, shape (images, 8)
        Weights of the images. [1]
    trust : array, shape (r, s, 8)
        Weights from ``trust``. [1]
    """
    last_field, last_sky = images[-1]
    field = np.zeros_like(last_field)
    sky = np.zeros_like(last_sky)
    for (one_field, one_sky), weight in zip(images, weights, strict=True):
        field += one_field * weight
        sky += one_sky * weight
    field = last_field + trust[:, :, None] * (field - last_field)
    sky = last_sky + trust * (sky - last_sky)
    # In the dark, and where the combination leaps, it means nothing: keep the computed light.
    sound = _is_near(field[:, :, 0], last_field[:, :, 0])
    field = np.where(sound[:, :, None], field, last_field)
    return field, np.where(_is_near(sky, last_sky), sky, last_sky)


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
