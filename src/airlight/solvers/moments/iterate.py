"""Successive orders to convergence, eight wavelengths at a time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments.convergence import Light, completed_or_swept, mix, trust
from airlight.solvers.moments.first_order import first_order_radius
from airlight.solvers.moments.grid import Grid
from airlight.solvers.moments.harmonics import POLARISED
from airlight.solvers.moments.packing import pack_light
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.setup import Block, Setup
from airlight.solvers.moments.stopping import Iteration, Stopping
from airlight.solvers.moments.sweep import sweep_radius
from airlight.solvers.moments.vertical_coupling import Wandering

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Sum of an order's polarised moments and of all that follow, over that order: the inverse along
#: the vertical does not complete these. In molecular air each order has 0.3 of the one before;
#: found by the sweeps that 1 to 1.7 take. [1]
FURTHER: Final = np.float32(1.4)


@dataclass(frozen=True, kw_only=True)
class Moments:
    """Result of the iteration, per irradiance of the star.

    Attributes
    ----------
    degree : int
        Degree of the harmonics.
    grid : Grid
        Nodes of the field.
    parts : int
        Step, in radii of the grid, between those at which light is gathered.
    field : array, shape (r, s, k, nl)
        Moments of the radiance of all scattered and reflected light. [1]
    sky : array, shape (r, s, nl)
        Irradiance of a level surface by scattered light from above. [1]
    columns : array, shape (radii, directions, nc)
        Columns of a ``ColumnTable``. [m]
    sweeps : int
        Number of orders of scattering that were computed one by one (the rest is extrapolated).
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
        Light paths of a medium with any number of wavelengths and constituents.
    settings : Settings
        Grid sizes and tolerance.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Raises
    ------
    ConvergenceError
        If the tolerance is not reached within ``settings.max_sweeps``.
    Cancelled
        If ``cancel`` returned True.
    """
    setup = Setup(paths=paths, settings=settings)
    count = setup.medium.wavelengths.size
    radii = setup.gathering.radii.size
    field = np.empty((radii, settings.suns, setup.terms, count), np.float32)
    sky = np.empty((radii, settings.suns, count), np.float32)
    residual = np.empty(count)
    most = 0
    for first in range(0, count, LANES):
        which = slice(first, min(first + LANES, count))
        block = setup.block(which)
        result = _iterate(block, _Watch(progress, block), cancel)
        field[..., which], sky[..., which], residual[which], sweeps = result
        most = max(most, sweeps)
    return Moments(
        degree=setup.degree, grid=setup.grid, parts=setup.parts, field=field, sky=sky,
        columns=setup.table.values, sweeps=most, residual=residual,
    )  # fmt: skip


def gather(
    block: Block, kernel: Callable[..., None], *light: NDArray[Any], cancel: Cancel | None = None
) -> tuple[Float32Array, Float32Array]:
    """Run ``first_order_radius`` or ``sweep_radius`` at every radius, on all cores.

    Parameters
    ----------
    block : Block
        Set-up from ``Setup.block``.
    kernel : callable
        One of these two functions.
    *light : array
        Arrays that it reads beside the set-up.
    cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    moments, sky : array, shapes (r, s, k, 8), (r, s, 8)
    """
    setup = block.setup
    radii, suns = block.rays.mu.shape[0], setup.grid.sun_cosines.size
    moments = np.empty((radii, suns, setup.terms, LANES), np.float32)
    sky = np.empty((radii, suns, LANES), np.float32)

    def radius(i: int) -> None:
        kernel(
            i, setup.grid, block.rays, block.share, setup.azimuths, block.air, setup.expansion,
            *light, moments[i].reshape(-1), sky[i].reshape(-1),
        )  # fmt: skip

    run_blocks(radius, radii, cancel=cancel)
    return moments, sky


@dataclass(frozen=True)
class _Watch:
    """Reporter of the progress of one block of wavelengths."""

    progress: Progress | None
    block: Block

    def report(self, iteration: Iteration | None = None) -> None:
        """Report progress over all wavelengths; this block's share is 0 without an iteration."""
        if self.progress is None:
            return
        which, wavelengths = self.block.which, self.block.setup.medium.wavelengths
        nm = wavelengths[which]
        share = 0.0 if iteration is None else iteration.share
        still = 1.0 if iteration is None else float(iteration.to_come.max())
        self.progress(
            round(100 * (which.start + share * nm.size)),
            100 * wavelengths.size,
            f"orders of scattering, {nm[0]:g} to {nm[-1]:g} nm: still to come {still:.1e}",
        )


def _iterate(
    block: Block, watch: _Watch, cancel: Cancel | None
) -> tuple[Float32Array, Float32Array, FloatArray, int]:
    """Solve one block of wavelengths: sum of all orders, its residual and number of sweeps."""
    setup, used = block.setup, block.used
    watch.report()
    first_field, first_sky = gather(
        block, first_order_radius, setup.ratios, setup.paths.lift, cancel=cancel
    )
    if not (first_field[:, :, 0] > 0.0).any():
        return first_field[..., :used], first_sky[..., :used], np.zeros(used), 0
    wandering = Wandering(block, cancel)
    field, sky = wandering.finish(first_field, first_sky)
    field, sky = completed_or_swept(field, sky, first_field, first_sky)
    iteration = Iteration(Stopping.of_sweeps(setup.settings), block.thick, used)
    images: deque[Light] = deque(maxlen=iteration.stopping.images)
    while iteration.goes_on():
        packed = pack_light(field, sky[:1], block.level, setup.parts)
        swept_field, swept_sky = gather(block, sweep_radius, *packed, cancel=cancel)
        swept_field += first_field
        swept_sky += first_sky
        more_field, more_sky = wandering.finish(swept_field - field, swept_sky - sky)
        trusted = trust(swept_field[:, :, 0], block.sidelit)
        more_field = swept_field - field + trusted[:, :, None] * (more_field - swept_field + field)
        more_sky = swept_sky - sky + trusted * (more_sky - swept_sky + sky)
        more_field[:, :, -POLARISED:] *= FURTHER
        images.append(
            completed_or_swept(field + more_field, sky + more_sky, swept_field, swept_sky)
        )
        iteration.judge(*_steering(field, images[-1][0]))
        watch.report(iteration)
        field, sky = mix(images, iteration.weights().astype(np.float32), trusted)
    return field[..., :used], sky[..., :used], iteration.to_come, iteration.sweeps


def _steering(before: Float32Array, after: Float32Array) -> tuple[Float32Array, Float32Array]:
    """Values (r, 4s, 8) whose relative change steers the iteration.

    Mean radiances, and mean radiances that differ by the change of each polarised moment: the
    inverse along the vertical does not complete those, so they are the last to converge.
    """
    which = [0, *range(-POLARISED, 0)]
    mean = np.repeat(after[:, :, :1], len(which), axis=2)
    earlier = mean - (after[:, :, which] - before[:, :, which])
    shape = (mean.shape[0], -1, LANES)
    return earlier.reshape(shape), mean.reshape(shape)
