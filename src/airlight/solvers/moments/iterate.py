"""Successive orders to convergence, eight wavelengths at a time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from math import log, pi
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.optics.layer_edges import layer_edges
from airlight.planets.medium import Medium
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments.acceleration import mixing_weights
from airlight.solvers.moments.air import choose_degree, make_air
from airlight.solvers.moments.first_order import first_order_radius
from airlight.solvers.moments.grid import Grid, make_grid
from airlight.solvers.moments.harmonics import Harmonics, coefficient_count, harmonics
from airlight.solvers.moments.packing import pack_light
from airlight.solvers.moments.rays import Rays, trace_rays
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.sweep import Air, Azimuths, sweep_radius
from airlight.tables.column_ratios import mean_density_ratios
from airlight.tables.columns import ColumnTable, density_table

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Mean radiance below this part of its largest value is dark: it neither steers nor stops.
_DARK: Final = 1e-6


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
        Largest relative change of the mean radiance that all further sweeps would make. [1]
    """

    degree: int
    grid: Grid
    field: Float32Array
    sky: Float32Array
    columns: FloatArray
    sweeps: int
    residual: FloatArray


def grid_for(medium: Medium, settings: Settings) -> Grid:
    """The grid on which a medium is solved."""
    table = density_table(medium.density, medium.thickness)
    altitude = medium.thickness * np.linspace(0.0, 1.0, table.shape[0]) ** 2
    scattering = table @ medium.scattering.max(axis=1)
    steps = 0.5 * (scattering[1:] + scattering[:-1]) * np.diff(altitude)
    depth = np.concatenate([[0.0], np.cumsum(steps)])
    return make_grid(medium.bottom_radius, medium.top_radius, settings.radii, settings.suns, depth)


def even_azimuths(degree: int, count: int) -> Azimuths:
    """Midpoints of ``count`` even steps over half a turn."""
    phi = (np.arange(count) + 0.5) * (pi / count)
    multiples = np.cos(np.arange(degree + 1)[:, None] * phi) * (2.0 * pi / count)
    return Azimuths(np.cos(phi), multiples.astype(np.float32))


def solve_moments(
    paths: LightPaths,
    settings: Settings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Moments:
    """Solve for the moments of the radiance at every wavelength of a medium.

    Parameters
    ----------
    paths : LightPaths
        Of a medium with any number of wavelengths and constituents.
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
    medium = paths.medium
    degree = choose_degree(medium, settings)
    grid = grid_for(medium, settings)
    strongest = medium.extinction.max(axis=1)
    sweeper = Sweeper(
        grid=grid,
        rays=trace_rays(
            grid,
            medium.density,
            strongest,
            settings.zenith_angles,
            settings.nodes,
            bend=paths.bend,
            layers=layer_edges(medium.density, medium.scattering.max(axis=1)),
        ),
        azimuths=even_azimuths(degree, max(settings.azimuths, 3 * degree // 4)),
        expansion=harmonics(degree),
        cancel=cancel,
    )
    table = ColumnTable.build(
        medium.bottom_radius,
        medium.top_radius,
        medium.density,
        (settings.column_radii, settings.column_directions),
    )
    ratios = mean_density_ratios(table)
    count = medium.wavelengths.size
    field = np.empty((settings.radii, settings.suns, coefficient_count(degree), count), np.float32)
    sky = np.empty((settings.radii, settings.suns, count), np.float32)
    residual = np.empty(count)
    most = 0
    for first in range(0, count, LANES):
        block = slice(first, min(first + LANES, count))
        air = make_air(medium, degree, block)
        watch = _Watch(progress, settings.tolerance, block, medium.wavelengths)
        result = _iterate(sweeper, air, (ratios, paths.lift), settings, watch)
        field[..., block], sky[..., block], residual[block], sweeps = result
        most = max(most, sweeps)
    return Moments(
        degree=degree, grid=grid, field=field, sky=sky, columns=table.values, sweeps=most,
        residual=residual,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Sweeper:
    """All that a sweep needs beside the optics and the light itself."""

    grid: Grid
    rays: Rays
    azimuths: Azimuths
    expansion: Harmonics
    cancel: Cancel | None

    def gather(
        self, kernel: Callable[..., None], air: Air, *light: NDArray[Any]
    ) -> tuple[Float32Array, Float32Array]:
        """Run ``first_order_radius`` or ``sweep_radius`` at every radius, on all cores.

        Returns
        -------
        moments, sky : array, shapes (r, s, k, 8), (r, s, 8)
        """
        radii, suns = self.grid.radii.size, self.grid.sun_cosines.size
        moments = np.empty(
            (radii, suns, coefficient_count(self.expansion.degree), LANES), np.float32
        )
        sky = np.empty((radii, suns, LANES), np.float32)

        def radius(i: int) -> None:
            kernel(
                i, self.grid, self.rays, self.azimuths, air, self.expansion, *light,
                moments[i].reshape(-1), sky[i].reshape(-1),
            )  # fmt: skip

        run_blocks(radius, radii, cancel=self.cancel)
        return moments, sky


@dataclass(frozen=True)
class _Watch:
    """Tells how far the iteration of one block of wavelengths has come."""

    progress: Progress | None
    tolerance: float
    block: slice
    wavelengths: FloatArray

    def report(self, change: float) -> None:
        """Progress runs from 0 at a change of 1 to 100 at the tolerance, by its logarithm."""
        if self.progress is None:
            return
        share = 1.0
        if change > self.tolerance:
            share = log(min(change, 1.0)) / log(self.tolerance)
        count = self.wavelengths.size
        nm = self.wavelengths[self.block]
        width = self.block.stop - self.block.start
        self.progress(
            round(100 * (self.block.start + share * width)),
            100 * count,
            f"orders of scattering, {nm[0]:g} to {nm[-1]:g} nm: still to come {change:.1e}",
        )


def _iterate(
    sweeper: Sweeper,
    air: Air,
    star: tuple[FloatArray, FloatArray],
    settings: Settings,
    watch: _Watch,
) -> tuple[Float32Array, Float32Array, FloatArray, int]:
    """One block of wavelengths: the sum of all orders, its residual and the number of sweeps."""
    used = watch.block.stop - watch.block.start
    watch.report(1.0)
    first_field, first_sky = sweeper.gather(first_order_radius, air, *star)
    if not (first_field[:, :, 0] > 0.0).any():
        return first_field[..., :used], first_sky[..., :used], np.zeros(used), 0
    field, sky = first_field, first_sky
    images: deque[Light] = deque(maxlen=_MEMORY)
    residuals: deque[FloatArray] = deque(maxlen=_MEMORY)
    for sweep in range(1, settings.max_sweeps + 1):
        new_field, new_sky = sweeper.gather(sweep_radius, air, *pack_light(field, sky[0]))
        new_field += first_field
        new_sky += first_sky
        change = _relative_change(field[:, :, 0], new_field[:, :, 0])
        images.append((new_field, new_sky))
        residuals.append(change.reshape(-1, LANES))
        largest = np.abs(change).max(axis=(0, 1))[:used] * _what_follows(images, residuals)[:used]
        watch.report(float(largest.max()))
        field, sky = _mix(images, residuals, used)
        if largest.max() <= settings.tolerance and sweep > 1:
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


def _what_follows(images: deque[Light], residuals: deque[FloatArray]) -> FloatArray:
    """All later changes together over the last one, ρ/(1 - ρ), per lane. [1]

    ρ, by which one more sweep shrinks a difference, is the largest seen between the last images
    and the guesses they came from; in thick air it is close to 1, and a small change is no sign
    that the sum is near.
    """
    ratio = np.full(LANES, 0.5)
    means = [one[0][:, :, 0].reshape(-1, LANES).astype(float) for one in images]
    for k in range(1, len(means)):
        step = means[k] - means[k - 1]
        # The guess is its image less the residual, which is relative to the image.
        guess = step - (residuals[k] * means[k] - residuals[k - 1] * means[k - 1])
        size = np.sqrt(np.square(guess).sum(axis=0))
        shrunk = np.sqrt(np.square(step).sum(axis=0))
        seen = np.divide(shrunk, size, out=np.zeros(LANES), where=size > 1e-9 * means[k].max())
        ratio = np.maximum(ratio, np.minimum(seen, 0.9999))
    return np.asarray(ratio / (1.0 - ratio))


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
