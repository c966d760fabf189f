"""When the iteration has arrived, how far a guess is trusted, and what the next one is.

Everything here sees the light at all radii and suns, eight wavelengths at a time.
"""

from __future__ import annotations

from collections import deque
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import kernel, vectorized
from airlight.kernel.lanes import LANES
from airlight.solvers.moments.acceleration import mixing_weights

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


def trust(mean: Float32Array, sidelit: FloatArray) -> Float32Array:
    """Where the light along the vertical tells what further sweeps would add, shape (r, s, 8).

    In the night of thick air it does not: there light comes from the side.
    """
    most = np.maximum(mean.max(axis=(0, 1)), 1e-30).astype(float)
    here, column = mean / most, mean.max(axis=0) / most
    bright = np.maximum(here * column, 0.0)
    return np.asarray(bright / (bright + np.square(sidelit) + 1e-30), np.float32)


def counts(mean: Float32Array, thick: FloatArray) -> FloatArray:
    """How much a relative change counts, shape (r, s, 8): less in the night of thick air."""
    bright = np.maximum(mean / (DIM * mean.max(axis=(0, 1))), 1e-30).astype(float)
    return np.asarray(np.minimum(bright, 1.0) ** thick)


def or_at_least(
    field: Float32Array, sky: Float32Array, swept_field: Float32Array, swept_sky: Float32Array
) -> Light:
    """A finished guess, or what was swept where that is far below it: in the dark."""
    sound = field[:, :, 0] > _LEAST * swept_field[:, :, 0]
    field = np.where(sound[:, :, None], field, swept_field)
    return field, np.where(sky > _LEAST * swept_sky, sky, swept_sky)


def relative_change(before: Float32Array, after: Float32Array) -> FloatArray:
    """Relative change of the mean radiance where it is not dark, else 0; shape (r, s, 8)."""
    old, new = before.astype(float), after.astype(float)
    bright = new > DARK * new.max(axis=(0, 1))
    return np.asarray(np.where(bright, (new - old) / np.where(bright, new, 1.0), 0.0))


def what_follows(residuals: deque[FloatArray]) -> FloatArray:
    """All later changes together over the last one, ρ/(1 - ρ), per lane. [1]

    ρ is by how much the changes shrank with the last two sweeps, each.
    """
    sizes = [np.sqrt(np.square(one).sum(axis=0)) for one in residuals]
    before = sizes[-min(len(sizes), 3)]
    steps = max(min(len(sizes), 3) - 1, 1)
    ratio = np.divide(sizes[-1], before, out=np.full_like(sizes[-1], 0.5), where=before > 0.0)
    if len(sizes) == 1:
        ratio[:] = 0.5
    ratio = np.clip(ratio ** (1.0 / steps), SHRINKAGE, STALLED)
    return np.asarray(ratio / (1.0 - ratio))


def mix(
    images: deque[Light], residuals: deque[FloatArray], used: int, trust: Float32Array
) -> Light:
    """The next guess: for each wavelength its own combination of the last images."""
    weights = np.zeros((len(images), LANES), np.float32)
    weights[-1] = 1.0
    for lane in range(used):
        weights[:, lane] = mixing_weights(np.stack([one[:, lane] for one in residuals]))
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
