"""Successive orders to convergence, eight wavelengths at a time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from math import log, pi
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.planets.medium import Medium
from airlight.solvers.moments.acceleration import mixing_weights
from airlight.solvers.moments.air import choose_degree, make_air
from airlight.solvers.moments.first_order import first_order_radius
from airlight.solvers.moments.grid import Grid, make_grid
from airlight.solvers.moments.harmonics import coefficient_count, harmonics
from airlight.solvers.moments.rays import trace_rays
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.sweep import Azimuths, sweep_radius
from airlight.tables.columns import ColumnTable

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Mean radiance below this part of its largest value is dark: it neither steers nor stops.
_DARK: Final = 1e-6
#: Mean radiance never falls below this part of its largest value, so that its root exists.
_FLOOR: Final = 1e-20


#: How many images the acceleration combines.
_MEMORY: Final = 7


@dataclass(frozen=True, kw_only=True)
class Moments:
    """What the iteration arrives at, per irradiance of the star.

    Attributes
    ----------
    degree : int
        Of the harmonics.
    grid : Grid
        The nodes.
    field : array, shape (r, s, k, nl)
        Moments of the radiance of all scattered and reflected light. [1]
    sky : array, shape (r, s, nl)
        Irradiance of a level surface by scattered light from above. [1]
    columns : array, shape (radii, directions, nc)
        Of a ``ColumnTable``. [m]
    sweeps : int
        Orders of scattering that were computed one by one (the rest is extrapolated).
    residual : array, shape (nl,)
        Largest relative change of the mean radiance by the last sweep. [1]
    """

    degree: int
    grid: Grid
    field: Float32Array
    sky: Float32Array
    columns: FloatArray
    sweeps: int
    residual: FloatArray


def even_azimuths(degree: int, count: int) -> Azimuths:
    """Midpoints of ``count`` even steps over half a turn."""
    phi = (np.arange(count) + 0.5) * (pi / count)
    multiples = np.cos(np.arange(degree + 1)[:, None] * phi) * (2.0 * pi / count)
    return Azimuths(np.cos(phi), multiples.astype(np.float32))


def as_ratios(values: Float32Array, scale_from: Float32Array) -> Float32Array:
    """Pack (..., k, 8) values for interpolation as ratios: (s, value·s) with s = 1/sqrt(scale).

    See the head of ``sweep``; ``scale_from`` has shape (..., 8) and is positive.
    """
    scale = 1.0 / np.sqrt(scale_from)[..., None, :]
    return np.concatenate([scale, values * scale], axis=-2).astype(np.float32).reshape(-1)


def positive(values: Float32Array) -> Float32Array:
    """Values (..., 8) with a floor far below anything that can be seen."""
    axes = tuple(range(values.ndim - 1))
    floor = np.maximum(values.max(axis=axes) * np.float32(_FLOOR), np.float32(1e-30))
    return np.maximum(values, floor)


def pack_light(field: Float32Array, sky: Float32Array) -> tuple[Float32Array, Float32Array]:
    """Moments (r, s, k, 8) and irradiances (..., s, 8) as the kernels read them."""
    mean = positive(field[:, :, 0])
    whole = field.copy()
    whole[:, :, 0] = mean
    received = positive(sky)
    return as_ratios(whole, mean), as_ratios(received[..., None, :], received)


def solve_moments(
    medium: Medium,
    settings: Settings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Moments:
    """Solve for the moments of the radiance at every wavelength of a medium.

    Parameters
    ----------
    medium : Medium
        Any number of wavelengths and constituents.
    settings : Settings
        Grid sizes and tolerance.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Raises
    ------
    ConvergenceError
        If the tolerance is not reached within ``settings.max_sweeps``.
    Cancelled
        If ``cancel`` said so.
    """
    degree = choose_degree(medium, settings)
    grid = make_grid(medium.bottom_radius, medium.top_radius, settings.radii, settings.suns)
    rays = trace_rays(grid, medium.density, settings.zenith_angles, settings.nodes)
    columns = ColumnTable.build(medium.bottom_radius, medium.top_radius, medium.density).values
    azimuths = even_azimuths(degree, max(settings.azimuths, 3 * degree // 4))
    expansion = harmonics(degree)
    count = medium.wavelengths.size
    shape = (settings.radii, settings.suns, coefficient_count(degree))
    field = np.empty((*shape, count), np.float32)
    sky = np.empty((settings.radii, settings.suns, count), np.float32)
    residual = np.empty(count)
    most = 0
    blocks = range(0, count, LANES)
    for number, first in enumerate(blocks):
        block = slice(first, min(first + LANES, count))
        used = block.stop - block.start
        air = make_air(medium, degree, block)

        def gather(kernel: Callable[..., None], *light: NDArray[np.floating]) -> tuple[Float32Array, Float32Array]:
            out = np.empty((*shape, LANES), np.float32)
            above = np.empty((settings.radii, settings.suns, LANES), np.float32)
            run_blocks(
                lambda i: kernel(
                    i, grid, rays, azimuths, air, expansion, *light,
                    out[i].reshape(-1), above[i].reshape(-1),
                ),
                settings.radii,
                cancel=cancel,
            )
            return out, above

        def report(change: float) -> None:
            if progress is None:
                return
            share = 1.0 if change <= settings.tolerance else log(min(change, 1.0)) / log(settings.tolerance)
            nm = medium.wavelengths[block]
            progress(
                round(100 * (number + min(share, 1.0))),
                100 * len(blocks),
                f"orders of scattering, {nm[0]:g} to {nm[-1]:g} nm: last change {change:.1e}",
            )

        report(1.0)
        result = _iterate(gather, columns, settings, used, report)
        field[..., block], sky[..., block], residual[block], sweeps = result
        most = max(most, sweeps)
    return Moments(
        degree=degree, grid=grid, field=field, sky=sky, columns=columns, sweeps=most,
        residual=residual,
    )


def _iterate(
    gather: Callable[..., tuple[Float32Array, Float32Array]],
    columns: FloatArray,
    settings: Settings,
    used: int,
    report: Callable[[float], None],
) -> tuple[Float32Array, Float32Array, FloatArray, int]:
    """One block of wavelengths: the sum of all orders, its residual and the number of sweeps."""
    first_field, first_sky = gather(first_order_radius, columns)
    if not (first_field[:, :, 0] > 0.0).any():
        return first_field[..., :used], first_sky[..., :used], np.zeros(used), 0
    field, sky = first_field, first_sky
    images: deque[Light] = deque(maxlen=_MEMORY)
    residuals: deque[FloatArray] = deque(maxlen=_MEMORY)
    for sweep in range(1, settings.max_sweeps + 1):
        new_field, new_sky = gather(sweep_radius, *pack_light(field, sky[0]))
        new_field += first_field
        new_sky += first_sky
        change = _relative_change(field[:, :, 0], new_field[:, :, 0])
        largest = np.abs(change).max(axis=(0, 1))[:used]
        report(float(largest.max()))
        images.append((new_field, new_sky))
        residuals.append(change.reshape(-1, LANES))
        field, sky = _mix(images, residuals, used)
        if largest.max() <= settings.tolerance:
            return field[..., :used], sky[..., :used], largest, sweep
    raise ConvergenceError(
        f"after {settings.max_sweeps} sweeps the last still changed the light by "
        f"{largest.max():.1e}, more than the tolerance {settings.tolerance:g}"
    )


def _relative_change(before: Float32Array, after: Float32Array) -> FloatArray:
    """Relative change of the mean radiance where it is not dark, else 0; shape (r, s, 8)."""
    old, new = before.astype(float), after.astype(float)
    bright = new > _DARK * new.max(axis=(0, 1))
    return np.asarray(np.where(bright, (new - old) / np.where(bright, new, 1.0), 0.0))


Light = tuple[Float32Array, Float32Array]


def _mix(images: deque[Light], residuals: deque[FloatArray], used: int) -> Light:
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
    # In the dark, and where it leaps, the combination means nothing: keep what was computed.
    sound = _is_near(field[:, :, 0], last_field[:, :, 0])
    field = np.where(sound[:, :, None], field, last_field)
    return field, np.where(_is_near(sky, last_sky), sky, last_sky)


def _is_near(mixed: Float32Array, computed: Float32Array) -> NDArray[np.bool_]:
    """Whether a mixed value is within a factor of two of a computed one that is not dark."""
    lit = computed > _DARK * computed.max(axis=(0, 1))
    return np.asarray(lit & (mixed > 0.5 * computed) & (mixed < 2.0 * computed))
