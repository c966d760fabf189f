"""How far a guess is trusted, how much of it still changes, and what the next one is.

Everything here sees the light at all radii and suns, some wavelengths at a time. What concerns one
node or one wavelength is a kernel, so that a page runs the same; when to stop is in ``stopping``.
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

#: Mean radiance below this part of its largest value is dark: it neither steers nor stops.
DARK: Final = 1e-6
#: In thick air the tolerance is relative for mean radiances above this part of the largest one,
#: and absolute below.
DIM: Final = 5e-2
#: Finished light below this part of the swept one is none.
_LEAST: Final = 0.1
#: The shrinkage of a sweep is taken to be no better than this.
SHRINKAGE: Final = 0.3
STALLED: Final = 0.75
#: It is measured over so many sweeps.
BACK: Final = 2


def trust(mean: Float32Array, sidelit: FloatArray) -> Float32Array:
    """Where the light along the vertical tells what further sweeps would add, shape (r, s, 8).

    In the night of thick air it does not: there light comes from the side.
    """
    most = np.maximum(mean.max(axis=(0, 1)), 1e-30).astype(float)
    here, column = mean / most, mean.max(axis=0) / most
    bright = np.maximum(here * column, 0.0)
    return np.asarray(bright / (bright + np.square(sidelit) + 1e-30), np.float32)


@kernel
def count_at(mean, brightest, thick):
    """How much a relative change counts at a node: less in the night of thick air. [1]

    Parameters
    ----------
    mean, brightest : float
        Mean radiance there, and the largest at any node.
    thick : float
        Exponent, from 0 (each change counts alike) to 1 (by the light itself). [1]
    """
    return min(max(mean / (DIM * brightest), 1e-30), 1.0) ** thick


def counts(mean: Float32Array, thick: FloatArray) -> FloatArray:
    """``count_at`` of mean radiances (r, s, w)."""
    light = mean.astype(float)
    return np.asarray(vectorized(count_at)(light, light.max(axis=(0, 1)), thick))


def or_at_least(
    field: Float32Array, sky: Float32Array, swept_field: Float32Array, swept_sky: Float32Array
) -> Light:
    """A finished guess, or what was swept where that is far below it: in the dark."""
    sound = field[:, :, 0] > _LEAST * swept_field[:, :, 0]
    field = np.where(sound[:, :, None], field, swept_field)
    return field, np.where(sky > _LEAST * swept_sky, sky, swept_sky)


@kernel
def change_at(before, after, brightest):
    """Relative change of a node's mean radiance where it is not dark, else 0. [1]

    Parameters
    ----------
    before, after : float
        Mean radiance of a guess and of its image.
    brightest : float
        The image's largest at any node.
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
    """All later changes together over the last one, ρ/(1 - ρ). [1]

    ρ is by how much the changes shrank with each of the last steps.

    Parameters
    ----------
    last, before : float
        Size of the last change, and of the one so many steps before it.
    steps : int
        0 where there is none before: a half is assumed.
    """
    ratio = 0.5
    if steps > 0 and before > 0.0:
        ratio = last / before
    if steps > 1:
        ratio = ratio ** (1.0 / steps)
    ratio = min(max(ratio, SHRINKAGE), STALLED)
    return ratio / (1.0 - ratio)


def what_follows(residuals: deque[FloatArray]) -> FloatArray:
    """``rest_after`` the last one of residuals (n, w), from up to two steps before it."""
    sizes = [np.sqrt(np.square(one).sum(axis=0)) for one in residuals]
    steps = min(len(sizes), BACK + 1) - 1
    return np.asarray(vectorized(rest_after)(sizes[-1], sizes[-1 - steps], steps))


def mix(images: deque[Light], weights: Float32Array, trust: Float32Array) -> Light:
    """The next guess: for each wavelength its own combination of the last images.

    Parameters
    ----------
    images : deque of Light
        The latest last.
    weights : array, shape (images, 8)
        Of the images. [1]
    trust : array, shape (r, s, 8)
        From ``trust``. [1]
    """
    last_field, last_sky = images[-1]
    field = np.zeros_like(last_field)
    sky = np.zeros_like(last_sky)
    for (one_field, one_sky), weight in zip(images, weights, strict=True):
        field += one_field * weight
        sky += one_sky * weight
    field = last_field + trust[:, :, None] * (field - last_field)
    sky = last_sky + trust * (sky - last_sky)
    # In the dark, and where it leaps, the combination means nothing: keep what was computed.
    sound = _is_near(field[:, :, 0], last_field[:, :, 0])
    field = np.where(sound[:, :, None], field, last_field)
    return field, np.where(_is_near(sky, last_sky), sky, last_sky)


@kernel
def is_near(mixed, computed, brightest):
    """Whether a mixed mean radiance is within a factor of two of a computed one that is not dark.

    Parameters
    ----------
    mixed, computed : float
        At one node.
    brightest : float
        The largest computed one at any node.
    """
    lit = computed > DARK * brightest
    return lit and mixed > 0.5 * computed and mixed < 2.0 * computed


def _is_near(mixed: Float32Array, computed: Float32Array) -> NDArray[np.bool_]:
    brightest = computed.max(axis=(0, 1))
    return np.asarray(vectorized(is_near)(mixed, computed, brightest), bool)
