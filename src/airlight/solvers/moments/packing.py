"""Arrays as the kernels read them: flat float32, wavelengths in whole groups of eight lanes."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import LANES

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Mean radiance never falls below this part of its largest value, so that its root exists.
_FLOOR: Final = 1e-20


def pack(values: FloatArray) -> Float32Array:
    """Wavelengths on the last axis to flat float32 in whole groups of eight lanes.

    Lanes without a wavelength repeat the last one, so that they compute nothing strange.
    """
    missing = -values.shape[-1] % LANES
    padded = np.concatenate([values, np.repeat(values[..., -1:], missing, axis=-1)], axis=-1)
    return np.ascontiguousarray(padded, dtype=np.float32).reshape(-1)


def as_ratios(values: Float32Array, scale_from: Float32Array) -> Float32Array:
    """Pack (..., k, 8) values for interpolation as ratios: (s, value·s) with s = 1/sqrt(scale).

    See the head of ``sweep``; ``scale_from`` has shape (..., 8) and is positive.
    """
    scale = 1.0 / np.sqrt(scale_from)[..., None, :]
    packed = np.concatenate([scale, values * scale], axis=-2)
    return np.asarray(packed, np.float32).reshape(-1)


def positive(values: Float32Array) -> Float32Array:
    """Values (..., 8) with a floor far below anything that can be seen."""
    axes = tuple(range(values.ndim - 1))
    floor = np.maximum(values.max(axis=axes) * np.float32(_FLOOR), np.float32(1e-30))
    return np.asarray(np.maximum(values, floor), np.float32)


def pack_light(field: Float32Array, sky: Float32Array) -> tuple[Float32Array, Float32Array]:
    """Moments (r, s, k, 8) and irradiances (..., s, 8) as the kernels read them."""
    mean = positive(field[:, :, 0])
    whole = field.copy()
    whole[:, :, 0] = mean
    received = positive(sky)
    return as_ratios(whole, mean), as_ratios(received[..., None, :], received)
