"""Packed arrays of the kernels: float32, wavelengths last, in whole groups of eight lanes."""

from __future__ import annotations

from functools import cache
from math import expm1, sqrt
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, kernel, vectorized
from airlight.kernel.lanes import HALF_LANES, LANES
from airlight.kernel.threads import run_blocks
from airlight.solver.moments.harmonics import EVEN, POLARISED, moment_count
from airlight.solver.moments.levels import THICK, fill_levels, refine

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Lower limit of the mean radiance over its maximum, so that its root exists.
_FLOOR: Final = 1e-20
#: Lower limit of the mean radiance itself. [1]
_DARKEST: Final = 1e-30
#: Width of dusk in sun elevation, over the dip of the horizon.
_DUSK: Final = 0.3


def filled(values: NDArray[Any]) -> NDArray[Any]:
    """Wavelengths (..., w) padded to groups of eight lanes.

    Padding repeats the last wavelength, so that no lane raises floating-point exceptions; with at
    most four wavelengths the upper half repeats the lower.
    """
    missing = -values.shape[-1] % HALF_LANES
    values = np.concatenate([values, np.repeat(values[..., -1:], missing, axis=-1)], axis=-1)
    if values.shape[-1] % LANES:
        values = np.concatenate([values, values[..., -HALF_LANES:]], axis=-1)
    return values


def pack(values: FloatArray) -> Float32Array:
    """Pack wavelengths on the last axis as float32 in whole groups of eight lanes."""
    return np.ascontiguousarray(filled(values), dtype=np.float32)


def pack_rational(values: Float32Array, scale_from: Float32Array) -> Float32Array:
    """Values (..., k, 8) packed for rational interpolation: (s, value·s) with s = 1/sqrt(scale).

    Shape (..., 1 + k, 8), see the head of ``sweep``; ``scale_from`` has shape (..., 8) and is
    positive.
    """
    scale = 1.0 / np.sqrt(scale_from)[..., None, :]
    packed = np.concatenate([scale, values * scale], axis=-2)
    return np.asarray(packed, np.float32)


@kernel
def rational_scale(mean, highest, level):
    """Factor s of a node in rational interpolation.

    Parameters
    ----------
    mean, highest : float
        Mean radiance at the node, positive, and the largest at any radius for the same sun angle.
    level : float
        From ``level_weights``: 0 for s = 1/sqrt(mean), 1 for the same s at all radii. [1]
    """
    return 1.0 / sqrt(mean * (highest / mean) ** level)


def positive(values: Float32Array) -> Float32Array:
    """Values (..., 8) with a positive floor, by ``floor_below``."""
    floor = vectorized(floor_below)(values.max(axis=tuple(range(values.ndim - 1))))
    return np.asarray(np.maximum(values, floor), np.float32)


@kernel
def floor_below(brightest):
    """Positive floor of values whose maximum is ``brightest``. [1]"""
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
    """Moments (r, s, k, w) and irradiances (r, s, w) packed for the kernels.

    Parameters
    ----------
    field, sky : array
        Values at the radii of the sweep.
    level : array, shape (s, w)
        From ``level_weights``: 1 for linear interpolation between radii (s independent of radius),
        0 for rational interpolation.
    refinement : int
        See ``levels.refine``. Irradiances of a single radius are not refined.
    narrow : bool
        Whether moments of four wavelengths are packed in pairs, for ``sweep_radius_narrow``.
    out : array, optional
        Earlier result for moments of the same shape, to be overwritten.
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
    if narrow:
        packed = packed.reshape(*shape[:2], -1, LANES)
    return packed, pack_rational(received[..., None, :], received)


@compiled_loop
def _pack_sun(field, mean, level, refinement, order, out):
    """Packed moments of one sun angle, for all levels.

    Parameters
    ----------
    field : array, shape (r, k, w)
        Moments at the radii of the sweep.
    mean : array, shape (r, w)
        Moments of degree 0, positive.
    level, refinement :
        For this sun angle, as in ``pack_light``.
    order : array, shape (n,)
        Content of each element of a node: 0 for s, 1 + k for M·s of moment k, more for padding.
    out : array, shape (levels, n, w)
        Receives the packed moments.
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
    """Order of the half registers of a node with ``count`` moments.

    0 is the factor s, count + 1 an empty half.
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
    """Weight of linear interpolation between radii: 1 in optically thick media by day.

    There radiance is linear in depth, with the flux as its slope, and rational interpolation would
    underestimate it between radii, equivalent to spurious absorption. At night radiance falls
    e-fold between radii, and only rational interpolation keeps it positive and smooth.

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
    """Weight of day: 0 at night, 1 by day, smooth through dusk. [1]"""
    height = np.clip(0.5 + np.arcsin(sun_cosines) / (_DUSK * dip), 0.0, 1.0)
    return np.asarray(height * height * (3.0 - 2.0 * height))


@kernel
def level_weight(day, depth):
    """``level_weights`` for one sun elevation and wavelength. [1]

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
    """Weight of optically thick media, 0 to 1, from the vertical scattering depth. [1]"""
    return -expm1(-((depth / THICK) ** 4))


def optically_thick_weights(depth: FloatArray) -> FloatArray:
    """``optically_thick_weight`` of an array of depths. [1]"""
    return np.asarray(vectorized(optically_thick_weight)(depth))
