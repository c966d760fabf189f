"""Successive orders to convergence, eight wavelengths at a time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from math import acos, log, pi
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError
from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.planets.medium import Medium
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments.convergence import (
    Light,
    counts,
    mix,
    or_at_least,
    relative_change,
    trust,
    what_follows,
)
from airlight.solvers.moments.first_order import first_order_radius
from airlight.solvers.moments.grid import Grid, make_grid
from airlight.solvers.moments.harmonics import Harmonics, coefficient_count, harmonics
from airlight.solvers.moments.levels import FEW_NODES
from airlight.solvers.moments.packing import filled, level_weights, pack_light, thickness
from airlight.solvers.moments.rays import Rays, trace_rays
from airlight.solvers.moments.reduced_optics import (
    choose_degree,
    column_rows,
    make_air,
    optical_depths,
    panel_ends,
    scattering_depth,
    transport_depth,
)
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.sweep import Air, Azimuths, sweep_radius
from airlight.solvers.moments.vertical_coupling import Wandering
from airlight.solvers.moments.visible_rays import rays_in_sight
from airlight.tables.column_ratios import mean_density_ratios
from airlight.tables.columns import ColumnTable

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Mean radiance below this part of its largest value comes from the side rather than from above
#: and below: where the transport depth is small, where it is large, and the depth between.
_SIDELIT: Final = (1e-4, 2e-2)
_WANDERS: Final = 5.0

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
    parts : int
        Light is gathered at the first of so many radii of the grid.
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
    parts: int
    field: Float32Array
    sky: Float32Array
    columns: FloatArray
    sweeps: int
    residual: FloatArray


def grid_for(medium: Medium, settings: Settings) -> tuple[Grid, int]:
    """The grid on which a medium is solved; light is gathered at one of so many of its radii."""
    depths = optical_depths(medium, choose_degree(medium, settings))
    return make_grid(medium.bottom_radius, medium.top_radius, settings.radii, settings.suns, depths)


def weights_of_levels(grid: Grid, depth: FloatArray) -> Float32Array:
    """``level_weights`` of a grid's suns, for vertical scattering depths (w,), shape (s, w)."""
    dip = acos(grid.bottom_radius / grid.top_radius)
    return level_weights(grid.sun_cosines, dip, depth)


def even_azimuths(degree: int, count: int) -> Azimuths:
    """Midpoints of ``count`` even steps over half a turn."""
    phi = (np.arange(count) + 0.5) * (pi / count)
    multiples = np.cos(np.arange(degree + 1)[:, None] * phi) * (2.0 * pi / count)
    return Azimuths(np.cos(phi), multiples.astype(np.float32))


def nodes_of_rays(settings: Settings, parts: int, ends: FloatArray) -> int:
    """Points a panel of the sweeps' rays, whose panels end at ``ends``."""
    if parts > 1:
        return min(settings.nodes, FEW_NODES)
    if ends.size:  # several panels a leg need fewer points each
        return max(FEW_NODES, 3 * settings.nodes // 5)
    return settings.nodes


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
    grid, parts = grid_for(medium, settings)
    gathering = grid._replace(radii=grid.radii[::parts])
    strongest = medium.extinction.max(axis=1)
    ends = panel_ends(medium, grid, parts)
    sweeper = Sweeper(
        grid=grid,
        parts=parts,
        rays=trace_rays(
            gathering,
            medium.density,
            strongest,
            settings.zenith_angles,
            nodes_of_rays(settings, parts, ends),
            bend=paths.bend,
            ends=ends,
        ),
        azimuths=even_azimuths(degree, max(settings.azimuths, 3 * degree // 4)),
        expansion=harmonics(degree),
        cancel=cancel,
    )
    table = ColumnTable.build(
        medium.bottom_radius,
        medium.top_radius,
        medium.density,
        (column_rows(medium, settings), settings.column_directions),
    )
    ratios = mean_density_ratios(table)
    wide = optical_depths(medium, degree).reach
    depth, transport = scattering_depth(medium, degree), transport_depth(medium)
    count = medium.wavelengths.size
    radii = gathering.radii.size
    field = np.empty((radii, settings.suns, coefficient_count(degree), count), np.float32)
    sky = np.empty((radii, settings.suns, count), np.float32)
    residual = np.empty(count)
    most = 0
    for first in range(0, count, LANES):
        block = slice(first, min(first + LANES, count))
        air = make_air(medium, degree, block)
        watch = _Watch(progress, settings.tolerance, block, medium.wavelengths)
        level = filled(weights_of_levels(grid, depth[block]))
        thick = filled(thickness(depth[block]))
        low, high = _SIDELIT
        wanders = np.maximum(filled(transport[block]) / _WANDERS, 1.0)
        sidelit = thick * np.minimum(low * wanders**3, high)
        # A layer of transport depth τ loses π²/(3τ²) of its light by a scattering: diffusion.
        reach = (wide, 6.0 / pi**2 * wide * float(transport[block].max()))
        rays, share = rays_in_sight(sweeper.rays, air)
        sight = replace(
            sweeper, rays=rays, share=share, level=level, reach=reach, thick=thick, sidelit=sidelit
        )
        result = _iterate(sight, air, (ratios, paths.lift), settings, watch)
        field[..., block], sky[..., block], residual[block], sweeps = result
        most = max(most, sweeps)
    return Moments(
        degree=degree, grid=grid, parts=parts, field=field, sky=sky, columns=table.values,
        sweeps=most, residual=residual,
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Sweeper:
    """All that a sweep needs beside the optics and the light itself.

    ``share`` is that of ``rays_in_sight``, ``level`` of ``level_weights``, ``reach`` of
    ``Wandering``; ``thick``, from 0 to 1, and ``sidelit`` say per lane where the tolerance becomes
    absolute and where light comes from the side: all of eight wavelengths.
    """

    grid: Grid
    parts: int
    rays: Rays
    azimuths: Azimuths
    expansion: Harmonics
    cancel: Cancel | None
    share: Float32Array = field(default_factory=lambda: np.empty(0, np.float32))
    level: Float32Array = field(default_factory=lambda: np.empty(0, np.float32))
    reach: tuple[float, float] = (0.0, 0.0)
    thick: FloatArray = field(default_factory=lambda: np.empty(0, float))
    sidelit: FloatArray = field(default_factory=lambda: np.empty(0, float))

    def gather(
        self, kernel: Callable[..., None], air: Air, *light: NDArray[Any]
    ) -> tuple[Float32Array, Float32Array]:
        """Run ``first_order_radius`` or ``sweep_radius`` at every radius, on all cores.

        Returns
        -------
        moments, sky : array, shapes (r, s, k, 8), (r, s, 8)
        """
        radii, suns = self.rays.mu.shape[0], self.grid.sun_cosines.size
        moments = np.empty(
            (radii, suns, coefficient_count(self.expansion.degree), LANES), np.float32
        )
        sky = np.empty((radii, suns, LANES), np.float32)

        def radius(i: int) -> None:
            kernel(
                i, self.grid, self.rays, self.share, self.azimuths, air, self.expansion, *light,
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
    wandering = Wandering(
        sweeper.grid,
        sweeper.rays,
        sweeper.share,
        air,
        sweeper.expansion,
        sweeper.parts,
        sweeper.reach,
        sweeper.cancel,
    )
    field, sky = wandering.finish(first_field, first_sky)
    field, sky = or_at_least(field, sky, first_field, first_sky)
    images: deque[Light] = deque(maxlen=_MEMORY)
    residuals: deque[FloatArray] = deque(maxlen=_MEMORY)
    for sweep in range(1, settings.max_sweeps + 1):
        packed = pack_light(field, sky[:1], sweeper.level, sweeper.parts)
        swept_field, swept_sky = sweeper.gather(sweep_radius, air, *packed)
        swept_field += first_field
        swept_sky += first_sky
        more_field, more_sky = wandering.finish(swept_field - field, swept_sky - sky)
        trusted = trust(swept_field[:, :, 0], sweeper.sidelit)
        more_field = swept_field - field + trusted[:, :, None] * (more_field - swept_field + field)
        more_sky = swept_sky - sky + trusted * (more_sky - swept_sky + sky)
        new_field, new_sky = or_at_least(field + more_field, sky + more_sky, swept_field, swept_sky)
        change = relative_change(field[:, :, 0], new_field[:, :, 0])
        change *= counts(new_field[:, :, 0], sweeper.thick)
        images.append((new_field, new_sky))
        residuals.append(change.reshape(-1, LANES))
        largest = np.abs(change).max(axis=(0, 1))[:used] * what_follows(residuals)[:used]
        watch.report(float(largest.max()))
        field, sky = mix(images, residuals, used, trusted)
        if largest.max() <= settings.tolerance and sweep > 1:
            return field[..., :used], sky[..., :used], largest, sweep
    raise ConvergenceError(
        f"after {settings.max_sweeps} sweeps the last still changed the light by "
        f"{largest.max():.1e}, more than the tolerance {settings.tolerance:g}"
    )
