"""Packed arrays of the kernels: flat float32, wavelengths in whole groups of eight lanes."""

from __future__ import annotations

from functools import cache
from math import expm1, sqrt
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, kernel, vectorized
from airlight.kernel.lanes import HALF_LANES, LANES
from airlight.kernel.threads import run_blocks
from airlight.solvers.moments.harmonics import EVEN, POLARISED, moment_count
from airlight.solvers.moments.levels import THICK, fill_levels, refine

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Lower limit of the mean radiance, over its largest value, so that its root exists.
_FLOOR: Final = 1e-20
#: Lower limit of the mean radiance itself. [1]
_DARKEST: Final = 1e-30
#: Width of dusk in sun elevation, over the horizon's dip.
_DUSK: Final = 0.3


def filled(values: NDArray[Any]) -> NDArray[Any]:
    """Wavelengths (..., w) in whole groups of eight lanes.

    Lanes without a wavelength repeat the last, so that they compute nothing exceptional; where only
    four are used the others repeat these.
    """
    missing = -values.shape[-1] % HALF_LANES
    values = np.concatenate([values, np.repeat(values[..., -1:], missing, axis=-1)], axis=-1)
    if values.shape[-1] % LANES:
        values = np.concatenate([values, values[..., -HALF_LANES:]], axis=-1)
    return values


def pack(values: FloatArray) -> Float32Array:
    """Pack wavelengths on the last axis as flat float32 in whole groups of eight lanes."""
    return np.ascontiguousarray(filled(values), dtype=np.float32).reshape(-1)


def pack_rational(values: Float32Array, scale_from: Float32Array) -> Float32Array:
    """Pack (..., k, 8) values for interpolation as ratios: (s, value·s) with s = 1/sqrt(scale).

    See the head of ``sweep``; ``scale_from`` has shape (..., 8) and is positive.
    """
    scale = 1.0 / np.sqrt(scale_from)[..., None, :]
    packed = np.concatenate([scale, values * scale], axis=-2)
    return np.asarray(packed, np.float32).reshape(-1)


@kernel
def rational_scale(mean, highest, level):
    """Factor s of a node, by which its moments are multiplied for interpolation.

    Parameters
    ----------
    mean, highest : float
        Mean radiance at the node, positive, and the largest at any radius under the same sun.
    level : float
        From ``level_weights``: 0 for 1/sqrt(mean), 1 for the same at all radii. [1]
    """
    return 1.0 / sqrt(mean * (highest / mean) ** level)


def positive(values: Float32Array) -> Float32Array:
    """Values (..., 8) with a floor far below the visible."""
    floor = vectorized(floor_below)(values.max(axis=tuple(range(values.ndim - 1))))
    return np.asarray(np.maximum(values, floor), np.float32)


@kernel
def floor_below(brightest):
    """Positive floor of values whose largest is ``brightest``. [1]"""
    return max(_FLOOR * brightest, _DARKEST)


def pack_light(
    field: Float32Array,
    sky: Float32Array,
    level: Float32Array,
    refinement: int,
    *,
    narrow: bool = False,
    out: Float32Array | None = None,
) -> tuple[Float32Array, Float32Array]:
    """Pack moments (r, s, k, w) and irradiances (r, s, w) for the kernels.

    Parameters
    ----------
    field, sky : array
        Values at the radii that gather light.
    level : array, shape (s, w)
        From ``level_weights``: where 1, s is the same at all radii, so that the moments are linear
        between two of them; where 0 they are interpolated as ratios.
    refinement : int
        See ``levels.refine``. Irradiances of only one radius stay as they are.
    narrow : bool
        Whether moments of four wavelengths are packed in pairs, for ``sweep_radius_narrow``.
    out : array, optional
        Earlier result for moments of the same shape, which receives them.
    """
    mean = positive(field[:, :, 0])
    received = positive(sky)
    if received.shape[0] > 1:
        received = refine(received[:, :, None], received, level, refinement)[:, :, 0]
    radii, sun_angles, terms, lanes = field.shape
    # One moment of eight wavelengths is a register, or two of four: see ``first_register``.
    order = np.arange(1 + terms)
    if narrow:
        order, lanes = pair_order(terms), HALF_LANES
    shape = ((radii - 1) * refinement + 1, sun_angles, order.size, lanes)
    packed = np.empty(shape, np.float32) if out is None else out.reshape(shape)

    def under(sun: int) -> None:
        _pack_sun(field[:, sun], mean[:, sun], level[sun], refinement, order, packed[:, sun])

    run_blocks(under, sun_angles)
    return packed.reshape(-1), pack_rational(received[..., None, :], received)


@compiled_loop
def _pack_sun(field, mean, level, refinement, order, out):
    """Pack the moments under one sun, for all levels.

    Parameters
    ----------
    field : array, shape (r, k, w)
        Moments at the radii that gather light.
    mean : array, shape (r, w)
        Those of degree 0, positive.
    level, refinement :
        Of this sun, as in ``pack_light``.
    order : array, shape (n,)
        What stands at each place of a node: 0 for s, 1 + k for M·s of moment k, more for nothing.
    out : array, shape (levels, n, w)
        Receives them.
    """
    radii, terms, width = field.shape
    levels, lanes = out.shape[0], out.shape[2]
    given = np.empty((radii, terms, width), np.float32)
    for i in range(radii):
        given[i] = field[i]
        given[i, 0] = mean[i]
    whole = given
    if refinement > 1:
        whole = np.empty((levels, terms, width), np.float32)
        # A copy: the loop takes contiguous arrays.
        fill_levels(given, mean.copy(), level, refinement, whole)
    scale = np.empty(width, np.float32)
    highest = np.zeros(width, np.float32)
    for i in range(levels):
        for w in range(width):
            highest[w] = max(highest[w], whole[i, 0, w])
    for i in range(levels):
        for w in range(width):
            scale[w] = rational_scale(whole[i, 0, w], highest[w], level[w])
        for n in range(order.size):
            moment = order[n] - 1
            if moment < 0:
                for w in range(lanes):
                    out[i, n, w] = scale[w]
            elif moment < terms:
                for w in range(lanes):
                    out[i, n, w] = scale[w] * whole[i, moment, w]
            else:
                for w in range(lanes):
                    out[i, n, w] = 0.0


@cache
def pair_order(count: int) -> NDArray[np.int64]:
    """Indices of what the halves of the registers hold, of a node with ``count`` moments.

    Index 0 is that of the factor s, count + 1 that of an empty half.
    """
    degree = next(n for n in range(count) if moment_count(n) == count)
    order = [0, 0]
    for l in range(degree + 1):
        start = 1 + l * (l + 1) // 2
        order += [*range(start, start + l + 1), *[count + 1] * (1 - l % 2)]
    even, odd = count + 1 - POLARISED, count + 1 - POLARISED + EVEN
    empty = count + 1
    return np.array([*order, even, even + 1, even + 2, empty, empty, odd, odd + 1, empty])


def level_weights(sun_cosines: FloatArray, dip: float, depth: FloatArray) -> Float32Array:
    """Weight of interpolation linear between radii: 1 where thick air is in full light.

    By day the light inside thick air is a linear function of depth, and its slope is the flux: as
    ratios it would be underestimated between radii, as if some were absorbed in each step. At night
    it falls e-fold from one radius to the next, and only ratios keep it positive and smooth.

    Parameters
    ----------
    sun_cosines : array, shape (s,)
        Sun cosines. [1]
    dip : float
        Dip of the horizon, seen from the top of the shell. [rad]
    depth : array, shape (w,)
        Vertical scattering optical depth. [1]

    Returns
    -------
    array, shape (s, w)
        Weights from 0 to 1. [1]
    """
    day = day_weight(sun_cosines, dip)
    return np.asarray(vectorized(level_weight)(day[:, None], depth), np.float32)


def day_weight(sun_cosines: FloatArray, dip: float) -> FloatArray:
    """Weight of day: 0 at night, 1 by day, smooth through dusk. [1]

    Parameters
    ----------
    sun_cosines : array, shape (s,)
        Sun cosines. [1]
    dip : float
        Dip of the horizon, seen from the top of the shell. [rad]
    """
    height = np.clip(0.5 + np.arcsin(sun_cosines) / (_DUSK * dip), 0.0, 1.0)
    return np.asarray(height * height * (3.0 - 2.0 * height))


@kernel
def level_weight(day, depth):
    """``level_weights`` of one sun elevation and wavelength. [1]

    Parameters
    ----------
    day : float
        From ``day_weight``. [1]
    depth : float
        Vertical scattering optical depth. [1]
    """
    return day * optically_thick_weight(depth)


@kernel
def optically_thick_weight(depth):
    """Weight of optically thick air by its vertical scattering depth: 0 clear, 1 thick. [1]"""
    return -expm1(-((depth / THICK) ** 4))


def optically_thick_weights(depth: FloatArray) -> FloatArray:
    """``optically_thick_weight`` of several depths. [1]"""
    return np.asarray(vectorized(optically_thick_weight)(depth))
