"""Radial grid of the moments, and interpolation between its radii.

In optically thin media the radii are even in the distance to the horizon (Bruneton's mapping). In
thick ones more radii follow the optical depth: steps grow from a small fraction of a mean free path
at top and bottom, where radiance has boundary layers, to two mean free paths inside, in the
diffusion regime, where it is linear in depth.

Linear interpolation underestimates a concave function, equivalent to spurious absorption in each
step. By day in thick media the moments are therefore interpolated between radii by the cubic
through four of them. Rays interpolate linearly between the levels of the refined table; these are
shifted so that the mean over a step is that of the cubic, for deep inside a gain of 1e-4 per
scattering accumulates to several per cent. As the cubics are functions of the level index, the
index has to be a smooth function of depth. At night radiance falls e-fold between radii; rational
interpolation keeps it positive.
"""

from __future__ import annotations

from itertools import pairwise
from math import exp
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, kernel, vectorized
from airlight.kernel.threads import run_blocks
from airlight.physics.optics.layer_edges import ThinLayer

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Scattering optical depth about which radii begin to follow the optical depth. [1]
THICK: Final = 1.5
#: Step in optical depth at top and bottom, its growth with the depth from there, and largest step,
#: for a grid of 24 radii. [1]
_FIRST_STEP: Final = 0.15
_GROWTH: Final = 0.2
_LAST_STEP: Final = 2.0
#: Sharpness of the transition from growing to largest steps: a kink there lost 0.2 % of energy.
_BEND: Final = 4.0
#: Number of steps of that grid.
_STEPS: Final = 23
#: Fraction of the thin grid's radii that thick media do not need.
_SPARED: Final = 0.25
#: Largest number of steps that follow the optical depth of the medium, or of its thin layers, over
#: that of the thin grid.
_MOST: Final = 4.0
#: Number of steps of that grid in a thin layer, in addition to those that follow optical depth.
_LAYER_STEPS: Final = 8.0
#: Number of panel ends of a ray through optically thick media.
_CUTS: Final = 12
#: Points of a panel where a ray has many panels.
FEW_NODES: Final = 8
#: Refinement in thick media: levels per step between radii, and the thickness above which it is
#: applied.
_PARTS: Final = 3
_REFINED: Final = 0.5
#: Relative deviations of the cubic from the straight line: it is fully used up to the first, and
#: not from the second on.
_CALM: Final = 0.1
_LEAP: Final = 0.2
#: Smallest mean radiance that is not treated as 0. [1]
_LEAST: Final = 1e-30


class Depths(NamedTuple):
    """Vertical optical depths above the ground, at ascending altitudes.

    Attributes
    ----------
    altitude : array, shape (n,)
        Altitudes. [m]
    scattering : array, shape (n,)
        Scaled scattering optical depth at the wavelength of strongest scattering, from 0. [1]
    layers : tuple of ThinLayer
        Geometrically thin layers.
    """

    altitude: FloatArray
    scattering: FloatArray
    layers: tuple[ThinLayer, ...] = ()

    @property
    def diffusion_length(self) -> float:
        """Lateral diffusion length: half of the altitude range with 90 % of the depth. [m]"""
        total = self.scattering[-1]
        low, high = np.interp([0.05 * total, 0.95 * total], self.scattering, self.altitude)
        return 0.5 * float(high - low)


class RadialGrid(NamedTuple):
    """Radial grid: levels of the field, every ``refinement``-th of them a radius of the sweep.

    Attributes
    ----------
    altitudes : array, shape (n,)
        Altitudes of the levels. [m]
    row : array, shape (m,)
        Fractional level at each altitude of ``Depths``. [1]
    refinement : int
        Number of levels per step between radii of the sweep.
    """

    altitudes: FloatArray
    row: FloatArray
    refinement: int


def radial_grid(even: FloatArray, depths: Depths, count: int) -> RadialGrid:
    """Radial grid of a shell.

    Parameters
    ----------
    even : array, shape (m,)
        Coordinate, 0 to 1, in which the levels of a thin medium are even. [1]
    depths : Depths
        Optical depths at the same altitudes.
    count : int
        Number of levels in an optically thin medium.
    """
    total = depths.scattering[-1]
    thick = 1.0 - exp(-((total / THICK) ** 2))
    coordinate = (count - 1) * (1.0 - _SPARED * thick) * even
    if total > 0.0:
        follows = thick * (count - 1) / _STEPS * _steps(depths.scattering)
        most = _MOST * (count - 1)
        # For depths below 1e-9 ``thick``, and with it ``follows``, is 0.
        coordinate = coordinate + follows * (most / follows[-1] if follows[-1] > most else 1.0)
    refinement = _PARTS if thick > _REFINED else 1
    if depths.layers:
        row = refinement * _layered(coordinate, depths, count)
    else:
        row = coordinate * (refinement * max(count - 1, round(coordinate[-1])) / coordinate[-1])
    steps = round(row[-1])
    altitudes = np.interp(np.arange(steps + 1, dtype=float), row, depths.altitude)
    altitudes[0], altitudes[-1] = depths.altitude[0], depths.altitude[-1]
    return RadialGrid(altitudes, row, refinement)


def _layered(coordinate: FloatArray, depths: Depths, count: int) -> FloatArray:
    """Fractional index of the radius, with radii at the boundaries of thin layers.

    Parameters
    ----------
    coordinate : array, shape (m,)
        Fractional index without thin layers.
    """
    altitude, depth = depths.altitude, depths.scattering
    ends = sorted({end for layer in depths.layers for end in layer})
    bounds = [0, *(int(np.abs(altitude - end).argmin()) for end in ends), altitude.size - 1]
    row = np.zeros(altitude.size)
    segments = list(pairwise(sorted(set(bounds))))
    within: dict[int, FloatArray] = {}
    for low, high in segments:
        middle = 0.5 * (altitude[low] + altitude[high])
        if any(layer.bottom < middle < layer.top for layer in depths.layers):
            within[low] = depth[low : high + 1] - depth[low]
    per_step = (count - 1) / _STEPS
    followed = {low: per_step * _steps(inner) for low, inner in within.items()}
    total = sum(float(steps[-1]) for steps in followed.values())
    bound = min(1.0, _MOST * (count - 1) / max(total, 1e-300))
    for low, high in segments:
        span = slice(low, high + 1)
        along = coordinate[span] - coordinate[low]
        if low in within:
            even = within[low] / max(within[low][-1], 1e-300)
            along = along + bound * followed[low] + _LAYER_STEPS * per_step * even
        row[span] = row[low] + along * (max(round(along[-1]), 1) / max(along[-1], 1e-300))
    return row


def panel_cuts(altitudes: FloatArray, refinement: int) -> FloatArray:
    """Altitudes of panel ends in optically thick media, inside the shell; none in thin ones. [m]

    A cloud is not a smooth function of altitude: the optical depth of a ray that crosses it in one
    panel would be wrong.
    """
    if refinement == 1:
        return np.empty(0)
    chosen = np.linspace(0, altitudes.size - 1, _CUTS + 2).round().astype(int)
    return np.asarray(altitudes[chosen][1:-1])


def refine(
    values: Float32Array, scale: Float32Array, level: Float32Array, refinement: int
) -> Float32Array:
    """Interpolate moments from the radii of the sweep to all levels.

    Parameters
    ----------
    values : array, shape (r, s, k, w)
        Moments.
    scale : array, shape (r, s, w)
        Positive moments of degree 0.
    level : array, shape (s, w)
        1 for a cubic from radius to radius, 0 for ratios.
    refinement : int
        Number from ``RadialGrid``.

    Returns
    -------
    array, shape ((r - 1)·refinement + 1, s, k, w)
    """
    if refinement == 1:
        return values
    out = np.empty(((values.shape[0] - 1) * refinement + 1, *values.shape[1:]), np.float32)

    def under(sun: int) -> None:
        between = np.empty((out.shape[0], *values.shape[2:]), np.float32)
        moments = np.ascontiguousarray(values[:, sun])
        fill_levels(moments, np.ascontiguousarray(scale[:, sun]), level[sun], refinement, between)
        out[:, sun] = between

    run_blocks(under, values.shape[1])
    return out


@compiled_loop
def fill_levels(values, scale, level, refinement, out):
    """``refine`` for one sun angle.

    Parameters
    ----------
    values : array, shape (r, k, w)
        Moments; the first decides how smooth they are.
    scale : array, shape (r, w)
        Positive moments of degree 0.
    level : array, shape (w,)
        1 for a cubic from radius to radius, 0 for ratios.
    refinement : int
        Number from ``RadialGrid``, more than 1.
    out : array, shape ((r - 1)·refinement + 1, k, w)
        Receives the moments at all levels.
    """
    radii, terms, lanes = values.shape
    # The level beyond each end continues the parabola through the last three.
    first, last = np.empty((terms, lanes), np.float32), np.empty((terms, lanes), np.float32)
    three, count = np.float32(3.0), np.float32(refinement)
    for k in range(terms):
        for w in range(lanes):
            first[k, w] = three * (values[0, k, w] - values[1, k, w]) + values[2, k, w]
            last[k, w] = three * (values[-1, k, w] - values[-2, k, w]) + values[-3, k, w]
    blend = np.empty(lanes, np.float32)
    root = 1.0 / np.sqrt(scale)
    out[out.shape[0] - 1] = values[radii - 1]
    for i in range(radii - 1):
        below, above = first, last
        if i > 0:
            below = values[i - 1]
        if i < radii - 2:
            above = values[i + 2]
        near, far = values[i], values[i + 1]
        at = i * refinement
        out[at] = near
        for part in range(1, refinement):
            x = np.float32(part / refinement)
            for w in range(lanes):
                bend = cubic_bend(x, below[0, w], near[0, w], far[0, w], above[0, w], count)
                blend[w] = smoothness(x, near[0, w], far[0, w], bend)
            for k in range(terms):
                for w in range(lanes):
                    bend = cubic_bend(x, below[k, w], near[k, w], far[k, w], above[k, w], count)
                    out[at + part, k, w] = between_levels(
                        x,
                        near[k, w],
                        far[k, w],
                        blend[w] * bend,
                        root[i, w],
                        root[i + 1, w],
                        level[w],
                    )


@kernel
def cubic_bend(x, below, near, far, above, refinement):
    """Cubic through four levels minus the straight line, at x between the middle two.

    Corrected for the trapezoidal error of straight lines between the levels x = 1/n, 2/n, … of the
    refinement n: a twelfth of each second difference, subtracted at the levels inside the step, so
    that the mean is that of the cubic.

    Parameters
    ----------
    x : float
        Position between the middle levels, 0 to 1. [1]
    below, near, far, above : float
        Moment at the four levels.
    refinement : float
        Number from ``RadialGrid``, more than 1. [1]
    """
    y = 1.0 - x
    first = 2.0 * near - below - far
    second = 2.0 * far - above - near
    evened = (y * first + x * second) / (12.0 * refinement * (refinement - 1.0))
    return (x * y / 6.0) * ((1.0 + y) * first + (1.0 + x) * second) + evened


@kernel
def smoothness(x, near, far, bend):
    """Weight of the cubic, from the variation of the mean radiance: 0 where it is steep. [1]

    Continuous, since a binary choice could alternate between sweeps and prevent convergence.
    """
    mean = max((1.0 - x) * near + x * far, _LEAST)
    part = min(max((_LEAP - abs(bend) / mean) / (_LEAP - _CALM), 0.0), 1.0)
    return part * part * (3.0 - 2.0 * part)


@kernel
def between_levels(x, near, far, bend, near_scale, far_scale, level):
    """Moment at x between two levels.

    Parameters
    ----------
    x : float
        Position between the levels, 0 to 1. [1]
    bend : float
        Value of ``cubic_bend``, times ``smoothness``.
    near_scale, far_scale : float
        1/sqrt of the mean radiance at the levels.
    level : float
        1 for the cubic, 0 for ratios. [1]
    """
    y = 1.0 - x
    ratio = (y * near * near_scale + x * far * far_scale) / (y * near_scale + x * far_scale)
    return ratio + level * (y * near + x * far + bend - ratio)


def finer_weights(count: int, refinement: int) -> FloatArray:
    """Matrix of the cubics of ``refine``, shape ((count - 1)·refinement + 1, count). [1]"""
    unit = np.eye(count)
    out = np.empty(((count - 1) * refinement + 1, count))
    out[::refinement] = unit
    for part in range(1, refinement):
        x = part / refinement
        out[part::refinement] = (1.0 - x) * unit[:-1] + x * unit[1:] + _bend(unit, x, refinement)
    return out


def _bend(values: NDArray[Any], x: float, refinement: int) -> NDArray[Any]:
    """``cubic_bend`` at x between adjacent levels."""
    # The level beyond each end continues the parabola through the last three.
    first = 3 * (values[:1] - values[1:2]) + values[2:3]
    last = 3 * (values[-1:] - values[-2:-1]) + values[-3:-2]
    below, above = np.concatenate([first, values[:-2]]), np.concatenate([values[2:], last])
    return np.asarray(
        vectorized(cubic_bend)(
            values.dtype.type(x),
            below,
            values[:-1],
            values[1:],
            above,
            values.dtype.type(refinement),
        )
    )


def _steps(depth: FloatArray) -> FloatArray:
    """Integral ∫ dτ/step(τ), with steps that grow from both ends; τ ascends from 0."""

    def beyond_least(near: FloatArray) -> FloatArray:
        growing = 1.0 / (_FIRST_STEP + _GROWTH * near)
        return np.asarray((growing**_BEND + least**_BEND) ** (1.0 / _BEND) - least)

    least = 1.0 / _LAST_STEP
    density = least + beyond_least(depth) + beyond_least(depth[-1] - depth)
    steps = 0.5 * (density[1:] + density[:-1]) * np.diff(depth)
    return np.concatenate([[0.0], np.cumsum(steps)])
