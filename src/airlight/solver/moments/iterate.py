"""Fixed-point iteration of the source function, eight wavelengths at a time.

Each sweep is one order of scattering; synthetic acceleration adds further orders in the
plane-parallel approximation, and Anderson acceleration combines recent iterates.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solver.moments.active_degrees import active_degrees
from airlight.solver.moments.convergence import (
    Light,
    acceleration_weights,
    anderson_step,
    clip_to_first_order,
    positivity_fixup,
)
from airlight.solver.moments.energy_balance import energy_error
from airlight.solver.moments.first_order import first_order_radius, first_order_radius_narrow
from airlight.solver.moments.fixed_point import Backend, iterate
from airlight.solver.moments.grid import MomentsGrid
from airlight.solver.moments.harmonics import EVEN, POLARISED
from airlight.solver.moments.iterate_update import (
    add_first_order,
    convergence_quantities,
    next_iterate,
)
from airlight.solver.moments.limits import check_limits
from airlight.solver.moments.packing import pack_light
from airlight.solver.moments.settings import MomentsSettings
from airlight.solver.moments.setup import Setup, WavelengthBatch
from airlight.solver.moments.spectral_initial_guess import SpectralGuess, wavelength_batches
from airlight.solver.moments.stopping import SWEEP_ITERATES, Iteration, Stopping
from airlight.solver.moments.sweep import sweep_radius, sweep_radius_narrow
from airlight.solver.moments.synthetic_acceleration import SyntheticAcceleration
from airlight.solver.refracted_geometry import RefractedGeometry

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Over-relaxation factors of the polarised moments, which synthetic acceleration omits. For
#: Rayleigh scattering even ones decay by 0.3 per order, and odd ones vanish; the factors minimise
#: the residual among 1.2 to 1.6 and 1 to 1.4. [1]
POLARISED_OVER_RELAXATION: Final = np.array([1.37] * EVEN + [1.1] * (POLARISED - EVEN), np.float32)


class IterationScheme(NamedTuple):
    """Parameters of the iteration.

    Attributes
    ----------
    note : str
        Line in a report; empty for the default scheme.
    lateral_scale : float
        Factor of the lateral diffusion length. [1]
    acceleration : float
        Weight of synthetic acceleration; 0 for plain successive orders. [1]
    relaxation : float
        Relaxation factor; 0.5 damps the alternation of orders with backward peaks. [1]
    """

    note: str
    lateral_scale: float
    acceleration: float
    relaxation: float


#: Default scheme, and fallbacks, in this order, if the iteration diverges.
FALLBACK_SCHEMES: Final = (
    IterationScheme("", 1.0, 1.0, 1.0),
    IterationScheme("iteration diverged; restarted with damping 0.7", 2.0, 0.7, 1.0),
    IterationScheme("iteration diverged; fell back to plain successive orders", 1.0, 0.0, 0.5),
)


@dataclass(frozen=True, kw_only=True)
class Moments:
    """Result of the iteration, per irradiance of the star.

    Attributes
    ----------
    degree : int
        Degree of the harmonics.
    grid : MomentsGrid
        Nodes of the field.
    refinement : int
        Number of levels of the grid per radius of the sweep.
    field : array, shape (r, s, k, nl)
        Moments of the diffuse radiance. [1]
    sky : array, shape (r, s, nl)
        Diffuse horizontal irradiance from above. [1]
    columns : array, shape (radii, directions, nc)
        Columns of a ``ColumnTable``. [m]
    sweeps : int
        Number of sweeps.
    residual : array, shape (nl,)
        Estimated largest relative change of the mean radiance by further sweeps. [1]
    energy : array, shape (nl,)
        Energy balance error, from ``energy_error``. [1]
    scheme : int
        Index of the last scheme in ``FALLBACK_SCHEMES``.
    """

    degree: int
    grid: MomentsGrid
    refinement: int
    field: Float32Array
    sky: Float32Array
    columns: FloatArray
    sweeps: int
    residual: FloatArray
    energy: FloatArray
    scheme: int = 0


def solve_moments(
    geometry: RefractedGeometry,
    settings: MomentsSettings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Moments:
    """Moments of the radiance at all wavelengths of a medium.

    Parameters
    ----------
    geometry : RefractedGeometry
        Refracted geometry of a medium with any number of wavelengths and constituents.
    settings : MomentsSettings
        Grid sizes and tolerance.

    Raises
    ------
    ParameterError
        If the medium exceeds the limits of ``check_limits``.
    ConvergenceError
        If the tolerance is not reached within ``settings.max_sweeps``.
    """
    setup = Setup(geometry=geometry, settings=settings)
    check_limits(setup.optics)
    count = setup.medium.wavelengths.size
    radii = setup.gathering.radii.size
    field = np.empty((radii, settings.sun_angles, setup.terms, count), np.float32)
    sky = np.empty((radii, settings.sun_angles, count), np.float32)
    residual = np.empty(count)
    most = hardest = 0
    done = 0
    for group in wavelength_batches(setup.medium.wavelengths, clear=setup.refinement == 1):
        guesses = SpectralGuess()
        for number, which in enumerate(group):
            batch = setup.batch(which)
            helped = guesses if len(group) > 1 else None
            last = number == len(group) - 1
            result = _iterate(batch, _Watch(progress, batch, done), cancel, helped, last)
            field[..., which], sky[..., which], residual[which], sweeps, scheme = result
            most, hardest, done = max(most, sweeps), max(hardest, scheme), done + batch.used
    return Moments(
        degree=setup.degree, grid=setup.grid, refinement=setup.refinement, field=field, sky=sky,
        columns=setup.table.values, sweeps=most, residual=residual,
        energy=energy_error(setup, field), scheme=hardest,
    )  # fmt: skip


def gather(
    batch: WavelengthBatch,
    kernel: Callable[..., None],
    *light: NDArray[Any],
    cancel: Cancel | None = None,
    out: Light | None = None,
) -> Light:
    """Moments at all radii by ``first_order_radius`` or ``sweep_radius``, on all cores.

    Parameters
    ----------
    batch : WavelengthBatch
        Set-up from ``Setup.batch``.
    kernel : callable
        One of these functions.
    *light : array
        Its arguments after the set-up.
    out : Light, optional
        Arrays for the result.

    Returns
    -------
    moments, sky : array, shapes (r, s, k, 8), (r, s, 8)
    """
    tables = batch.sweep_tables
    radii = batch.rays.mu.shape[0]
    moments, sky = _arrays(batch) if out is None else out

    def radius(i: int) -> None:
        kernel(i, tables, *light, moments[i], sky[i])

    run_blocks(radius, radii, cancel=cancel)
    return moments, sky


def _arrays(batch: WavelengthBatch) -> Light:
    """Uninitialised arrays of moments and irradiances."""
    setup = batch.setup
    shape = batch.rays.mu.shape[0], setup.grid.sun_cosines.size
    return (
        np.empty((*shape, setup.terms, LANES), np.float32),
        np.empty((*shape, LANES), np.float32),
    )


@dataclass(frozen=True)
class _Watch:
    """Progress reporter of one batch of wavelengths."""

    progress: Progress | None
    batch: WavelengthBatch
    done: int  # wavelengths of the batches before

    def report(self, iteration: Iteration | None = None) -> None:
        """Report progress over all wavelengths."""
        if self.progress is None:
            return
        which, wavelengths = self.batch.which, self.batch.setup.medium.wavelengths
        nm = wavelengths[which]
        fraction = 0.0 if iteration is None else iteration.progress
        still = 1.0 if iteration is None else float(iteration.remaining_error.max())
        self.progress(
            round(100 * (self.done + fraction * nm.size)),
            100 * wavelengths.size,
            f"orders of scattering, {nm[0]:g} to {nm[-1]:g} nm: remaining error {still:.1e}",
        )


class _Sweeps(Backend):
    """Sweeps of one batch of wavelengths on the CPU, with synthetic acceleration.

    Parameters
    ----------
    batch : WavelengthBatch
        Set-up of the sweeps.
    first, light : two arrays, shapes (r, s, k, 8), (r, s, 8)
        First order, and initial guess.
    synthetic : SyntheticAcceleration
        Acceleration of the residual.
    """

    def __init__(
        self,
        batch: WavelengthBatch,
        first: Light,
        light: Light,
        synthetic: SyntheticAcceleration,
        cancel: Cancel | None,
    ) -> None:
        setup = batch.setup
        self.batch, self.first, self.light, self.best = batch, first, light, light
        self.synthetic, self.cancel = synthetic, cancel
        self.degrees = batch.all_degrees
        if setup.refinement > 1:
            self.degrees = active_degrees(batch, light[0])
        self.scheme = 0
        self._iterates: deque[Light] = deque(maxlen=SWEEP_ITERATES)
        # Arrays are reused between sweeps: the system would clear new memory page by page.
        self._swept, self._residual, self._mixed = (_arrays(batch) for _ in range(3))
        self._packed: Float32Array | None = None

    def fall_back(self) -> bool | None:
        """Restart from the best iterate with the next of ``FALLBACK_SCHEMES``."""
        if self.scheme + 1 >= len(FALLBACK_SCHEMES):
            return None
        self.light, self.scheme = self.best, self.scheme + 1
        scheme = FALLBACK_SCHEMES[self.scheme]
        self.synthetic.set_lateral_scale(scheme.lateral_scale)
        self._iterates.clear()
        return scheme.acceleration > 0.0

    def sweep(self) -> None:
        """Compute the next iterate: a sweep of the guess, and its accelerated residual."""
        batch, light, swept = self.batch, self.light, self._swept
        level, refinement = batch.level, batch.setup.refinement
        packed = pack_light(
            light[0], light[1][:1], level, refinement, narrow=batch.narrow, out=self._packed
        )
        self._packed = packed[0]
        loop = sweep_radius_narrow if batch.narrow else sweep_radius
        gather(batch, loop, *packed, self.degrees, cancel=self.cancel, out=swept)
        add_first_order(swept, self.first, light, self._residual)
        mean, scheme = swept[0][:, :, 0], FALLBACK_SCHEMES[self.scheme]
        self._weight = scheme.acceleration * acceleration_weights(mean, batch.lateral_threshold)
        accelerated = None
        if scheme.acceleration > 0.0:
            accelerated = self.synthetic.apply(*self._residual, (mean, swept[1]))
        fields = light, self._residual, accelerated, swept
        factors = self._weight, POLARISED_OVER_RELAXATION, scheme.relaxation
        self._iterates.append(next_iterate(*fields, *factors))

    def reduce(self) -> tuple[Float32Array, Float32Array]:
        """Mean radiances, and their sums with the changes of the polarised moments."""
        return convergence_quantities(self.light[0], self._iterates[-1][0])

    def combine(self, weights: FloatArray, *, best: bool) -> None:
        """Compute the next guess, damped by the acceleration weights."""
        if best:
            self.best = self._iterates[-1]
        anderson_step(self._iterates, weights.astype(np.float32), self._weight, self._mixed)
        self.light = self._mixed


def _iterate(
    batch: WavelengthBatch,
    watch: _Watch,
    cancel: Cancel | None,
    spectral_guess: SpectralGuess | None = None,
    last: bool = False,
) -> tuple[Float32Array, Float32Array, FloatArray, int, int]:
    """Solution of one batch of wavelengths: moments, residual, number of sweeps and scheme.

    ``spectral_guess`` has corrections of other batches, and receives those of this unless ``last``.
    """
    setup, used = batch.setup, batch.used
    watch.report()
    loop = first_order_radius_narrow if batch.narrow else first_order_radius
    tables = setup.column_rows, setup.star_ratios, setup.geometry.refraction_table
    first_field, first_sky = first = gather(batch, loop, *tables, cancel=cancel)
    if not (first_field[:, :, 0] > 0.0).any():
        return first_field[..., :used], first_sky[..., :used], np.zeros(used), 0, 0
    synthetic = SyntheticAcceleration(batch, cancel)
    guess = positivity_fixup(*synthetic.apply(*first), *first)
    light, least = guess, 2
    nm = setup.medium.wavelengths[batch.which]
    between = None if spectral_guess is None else spectral_guess.corrected(nm, guess)
    if between is not None:
        light, least = positivity_fixup(*between, *first), 1
    iteration = Iteration(Stopping.of_sweeps(setup.settings), batch.thick, used, least=least)
    if spectral_guess is not None and between is not None:
        iteration.set_prediction(spectral_guess.expected(nm, guess))

    def report(state: Iteration) -> None:
        watch.report(state)
        if spectral_guess is not None and state.sweeps == 1:
            spectral_guess.check(nm, state.remaining_error)

    sweeps = _Sweeps(batch, first, light, synthetic, cancel)
    iterate(sweeps, iteration, report=report, cancel=cancel)
    if iteration.sweeps == 0:
        watch.report(iteration)
    elif spectral_guess is not None and not last:
        spectral_guess.add(nm, guess, sweeps.light)
    field, sky = sweeps.light
    clip_to_first_order(field, first_field)
    residual = iteration.remaining_error
    return field[..., :used], sky[..., :used], residual, iteration.sweeps, sweeps.scheme
