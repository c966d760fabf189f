"""Successive orders to convergence, eight wavelengths at a time."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments.between_wavelengths import Corrections, panels
from airlight.solvers.moments.completing import image, steering, sum_orders
from airlight.solvers.moments.convergence import Light, at_least, completed_or_swept, mix, trust
from airlight.solvers.moments.energy_balance import energy_error
from airlight.solvers.moments.first_order import first_order_radius, first_order_radius_of_few
from airlight.solvers.moments.grid import Grid
from airlight.solvers.moments.harmonics import EVEN, POLARISED
from airlight.solvers.moments.light_degrees import light_degrees
from airlight.solvers.moments.limits import check_limits
from airlight.solvers.moments.packing import pack_light
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.setup import Block, Setup
from airlight.solvers.moments.stopping import Iteration, Stopping
from airlight.solvers.moments.sweep import sweep_radius, sweep_radius_of_few
from airlight.solvers.moments.vertical_coupling import Wandering

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Sum of an order's polarised moments and of all that follow, over that order: the inverse along
#: the vertical does not complete these. In molecular air each order has 0.3 of the even ones of the
#: order before, and no odd ones; found by the changes that 1.2 to 1.6, and 1 to 1.4, leave. [1]
FURTHER: Final = np.array([1.37] * EVEN + [1.1] * (POLARISED - EVEN), np.float32)


class Way(NamedTuple):
    """How a sweep is completed by the inverse along the vertical.

    Attributes
    ----------
    note : str
        Line in a report; empty for the usual way.
    wider : float
        Factor of the light's spread sideways. [1]
    part : float
        Part of the completion that is taken; 0 for plain orders. [1]
    step : float
        Part of the change that is taken. Backward peaks send light to and fro, so that orders
        change it by turns; halves of them do not. [1]
    """

    note: str
    wider: float
    part: float
    step: float


#: Usual way, and those that follow, one after the other, where the light ceases to converge.
WAYS: Final = (
    Way("", 1.0, 1.0, 1.0),
    Way("orders of scattering strayed and were damped", 2.0, 0.7, 1.0),
    Way("orders of scattering strayed and were summed one by one", 1.0, 0.0, 0.5),
)


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
    energy : array, shape (nl,)
        Light that the solution makes or loses, from ``energy_error``. [1]
    way : int
        Index among ``WAYS`` of the way in which the sweeps were completed at the end.
    """

    degree: int
    grid: Grid
    parts: int
    field: Float32Array
    sky: Float32Array
    columns: FloatArray
    sweeps: int
    residual: FloatArray
    energy: FloatArray
    way: int = 0


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
    ParameterError
        If the air is deeper than ``check_limits`` allows.
    ConvergenceError
        If the tolerance is not reached within ``settings.max_sweeps``.
    Cancelled
        If ``cancel`` returned True.
    """
    setup = Setup(paths=paths, settings=settings)
    check_limits(setup.optics)
    count = setup.medium.wavelengths.size
    radii = setup.gathering.radii.size
    field = np.empty((radii, settings.suns, setup.terms, count), np.float32)
    sky = np.empty((radii, settings.suns, count), np.float32)
    residual = np.empty(count)
    most = hardest = 0
    done = 0
    for panel in panels(setup.medium.wavelengths, clear=setup.parts == 1):
        corrections = Corrections()
        for number, which in enumerate(panel):
            block = setup.block(which)
            helped = corrections if len(panel) > 1 else None
            last = number == len(panel) - 1
            result = _iterate(block, _Watch(progress, block, done), cancel, helped, last)
            field[..., which], sky[..., which], residual[which], sweeps, way = result
            most, hardest, done = max(most, sweeps), max(hardest, way), done + block.used
    return Moments(
        degree=setup.degree, grid=setup.grid, parts=setup.parts, field=field, sky=sky,
        columns=setup.table.values, sweeps=most, residual=residual,
        energy=energy_error(setup, field), way=hardest,
    )  # fmt: skip


def gather(
    block: Block,
    kernel: Callable[..., None],
    *light: NDArray[Any],
    cancel: Cancel | None = None,
    out: Light | None = None,
) -> Light:
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
    out : Light, optional
        Arrays that receive the result.

    Returns
    -------
    moments, sky : array, shapes (r, s, k, 8), (r, s, 8)
    """
    setup = block.setup
    radii = block.rays.mu.shape[0]
    moments, sky = _arrays(block) if out is None else out

    def radius(i: int) -> None:
        kernel(
            i, setup.grid, block.rays, block.share, setup.azimuths, block.air, setup.expansion,
            *light, moments[i].reshape(-1), sky[i].reshape(-1),
        )  # fmt: skip

    run_blocks(radius, radii, cancel=cancel)
    return moments, sky


def _arrays(block: Block) -> Light:
    """Arrays of moments and irradiances, with any contents."""
    setup = block.setup
    shape = block.rays.mu.shape[0], setup.grid.sun_cosines.size
    return (
        np.empty((*shape, setup.terms, LANES), np.float32),
        np.empty((*shape, LANES), np.float32),
    )


@dataclass(frozen=True)
class _Watch:
    """Reporter of the progress of one block of wavelengths."""

    progress: Progress | None
    block: Block
    done: int  # wavelengths of the blocks before

    def report(self, iteration: Iteration | None = None) -> None:
        """Report progress over all wavelengths; this block's share is 0 without an iteration."""
        if self.progress is None:
            return
        which, wavelengths = self.block.which, self.block.setup.medium.wavelengths
        nm = wavelengths[which]
        share = 0.0 if iteration is None else iteration.share
        still = 1.0 if iteration is None else float(iteration.to_come.max())
        self.progress(
            round(100 * (self.done + share * nm.size)),
            100 * wavelengths.size,
            f"orders of scattering, {nm[0]:g} to {nm[-1]:g} nm: still to come {still:.1e}",
        )


def _iterate(
    block: Block,
    watch: _Watch,
    cancel: Cancel | None,
    corrections: Corrections | None = None,
    last: bool = False,
) -> tuple[Float32Array, Float32Array, FloatArray, int, int]:
    """Solve one block of wavelengths: sum of all orders, its residual, number of sweeps and way.

    ``corrections`` are of wavelengths near it, and receive its own unless it is the ``last``.
    """
    setup, used = block.setup, block.used
    once, sweep = first_order_radius, sweep_radius
    if block.few:
        once, sweep = first_order_radius_of_few, sweep_radius_of_few
    watch.report()
    first_field, first_sky = gather(
        block, once, setup.column_rows, setup.star_ratios, setup.paths.lift, cancel=cancel
    )
    if not (first_field[:, :, 0] > 0.0).any():
        return first_field[..., :used], first_sky[..., :used], np.zeros(used), 0, 0
    wandering = Wandering(block, cancel)
    guess = completed_or_swept(*wandering.finish(first_field, first_sky), first_field, first_sky)
    light, least = guess, 2
    nm = setup.medium.wavelengths[block.which]
    between = None if corrections is None else corrections.corrected(nm, guess)
    if between is not None:
        light, least = completed_or_swept(*between, first_field, first_sky), 1
    iteration = Iteration(Stopping.of_sweeps(setup.settings), block.thick, used, least=least)
    if corrections is not None and between is not None:
        iteration.foresee(corrections.expected(nm, guess))
    degrees = light_degrees(block, light[0]) if setup.parts > 1 else block.all_degrees
    images: deque[Light] = deque(maxlen=iteration.stopping.images)
    best, at, way = light, 0, WAYS[0]
    # Each sweep uses the arrays of the one before: the system clears new memory page by page.
    swept, more, mixed = _arrays(block), _arrays(block), _arrays(block)
    packed: tuple[Float32Array | None, Float32Array | None] = None, None
    while iteration.goes_on():
        if iteration.strays and at + 1 < len(WAYS):
            light, at = best, at + 1
            way = WAYS[at]
            wandering.widen(way.wider)
            images.clear()
            iteration.restart(accelerated=way.part > 0.0)
        packed = pack_light(
            light[0], light[1][:1], block.level, setup.parts, few=block.few, out=packed[0]
        )
        gather(block, sweep, *packed, degrees, cancel=cancel, out=swept)
        sum_orders(swept, (first_field, first_sky), light, more)
        mean = swept[0][:, :, 0]
        trusted = way.part * trust(mean, block.sidelit)
        all_more = wandering.finish(*more, (mean, swept[1])) if way.part > 0.0 else None
        images.append(image(light, more, all_more, swept, trusted, FURTHER, way.step))
        iteration.judge(*steering(light[0], images[-1][0]))
        watch.report(iteration)
        if corrections is not None and iteration.sweeps == 1:
            corrections.check(nm, iteration.to_come)
        if iteration.best:
            best = images[-1]
        mix(images, iteration.weights().astype(np.float32), trusted, mixed)
        light = mixed
    if iteration.sweeps == 0:
        watch.report(iteration)
    elif corrections is not None and not last:
        corrections.add(nm, guess, light)
    field, sky = light
    at_least(field, first_field)
    return field[..., :used], sky[..., :used], iteration.to_come, iteration.sweeps, at
