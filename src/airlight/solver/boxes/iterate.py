"""Iteration of a box for four wavelengths: sweeps and the diffusion that accelerates them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ConvergenceError, warn
from airlight.kernel.lanes import HALF_LANES, LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solver.boxes.beam import centred, mean_beam_row
from airlight.solver.boxes.cell_balance import in_chunks
from airlight.solver.boxes.directions import (
    SIGNS,
    degrees,
    directions,
    harmonics,
    term_count,
)
from airlight.solver.boxes.linear import solve_linear
from airlight.solver.boxes.problem import (
    BoxProblem,
    across_column,
    begin,
    four_wide,
    half_range,
    in_pairs,
    lost_light,
    sweep_directions,
)
from airlight.solver.boxes.rebalance import (
    BalanceCells,
    add_currents,
    coefficients_for,
    correct,
)
from airlight.solver.boxes.settings import BoxSettings
from airlight.solver.boxes.stopping import change_of, remaining_error
from airlight.solver.boxes.sweep import SweepCells, SweepLight, sweep_level

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Limits of the factor by which an iteration multiplies the light of a cell.
_FACTORS: Final = (np.float32(0.3), np.float32(3.0))
#: Numbers of a level up to which another thread costs more time than it saves.
_FEW: Final = 200_000
#: Change after the last sweep above which a solution is refused [1], and over the tolerance, above
#: which there is a warning.
_REJECTED: Final = 0.08
_UNCONVERGED: Final = 10.0
#: Scaled optical depth of a level above which light below it may be wrong by more than a tenth. [1]
_COARSE: Final = 6.0
#: Sweeps after which a growing change damps acceleration, by a factor, down to the least.
_SETTLED: Final = 3
_DAMPING: Final = np.float32(0.7)
_LEAST_RELAXATION: Final = np.float32(0.2)
#: Least irradiance of the beam over the largest. [1]
_DARK: Final = 1e-12
#: Sweeps that progress expects after the present one.
_REMAINING: Final = 6
#: √(4π): mean radiance times 4π over the moment of degree 0. [1]
_ROOT: Final = float(np.sqrt(4.0 * np.pi))


@dataclass(frozen=True, eq=False)
class BoxLevels:
    """Light of a box at four wavelengths, of which the first are asked for.

    Attributes
    ----------
    moments : array of float32, shape (levels, ny, nx, terms, 4)
        Moments of the diffuse radiance. [1]
    beam : array of float32, shape (levels, ny, nx, 4)
        Mean transmittance of the beam. [1]
    down, direct, up : array of float32, shape (ny, nx, 4)
        Diffuse and direct irradiance of the ground, and irradiance upwards at the top. [1]
    sides : array of float32, shape (2, 4, levels, ny, pairs, 8)
        Light that leaves at the sides. [sr⁻¹]
    residual, energy : array, shape (4,)
        Last relative change, and energy balance error over the incident energy. [1]
    absorbed : array, shape (4,)
        Energy absorbed inside over the area. [1]
    sweeps : int
        Number of sweeps.
    """

    moments: Float32Array
    beam: Float32Array
    down: Float32Array
    direct: Float32Array
    up: Float32Array
    sides: Float32Array
    residual: FloatArray
    energy: FloatArray
    absorbed: FloatArray
    sweeps: int


class BoxIteration:
    """Iteration for four wavelengths.

    Parameters
    ----------
    problem : BoxProblem
    settings : BoxSettings
    sides : tuple of two arrays, shapes (2, 4, levels, ny or 1, pairs, 8), optional
        Light that enters at sides that are not periodic, along x and (nx or 1) along y. [sr⁻¹]
    start : array, shape (levels, ny, nx, terms, 4), optional
        Moments to begin with, of any degree; by default those of diffusion. [1]
    """

    def __init__(
        self,
        problem: BoxProblem,
        settings: BoxSettings,
        sides: tuple[Float32Array, Float32Array] | None = None,
        start: Float32Array | None = None,
    ) -> None:
        grid, optics = problem.grid, problem.optics
        self.problem, self.settings, self.boundary = problem, settings, sides
        self.start = start
        levels, ny, nx = grid.extinction.shape
        self.thickness = np.asarray(np.diff(grid.edges), np.float32)
        self.ways = directions(settings.zenith_angles, settings.azimuths)
        self.pairs = sweep_directions(self.ways, grid, settings.degree, problem.towards)
        self.shares = half_range(self.ways, settings.degree)
        self.cosine = max(problem.towards[2], 0.0)
        self.ground = four_wide(problem.ground)
        self._mean_beam()
        self.cells = SweepCells(
            grid.extinction,
            self.beam,
            self.lit,
            four_wide(optics.cloud),
            four_wide(optics.cloud_source),
            four_wide(optics.air),
            four_wide(optics.air_source),
            degrees(settings.degree),
            self.thickness,
            grid.flat,
        )
        terms, pairs = term_count(settings.degree), self.pairs.slopes.shape[0]

        def zeros(*shape: int) -> Float32Array:
            return np.zeros(shape, np.float32)

        self.light = SweepLight(
            (zeros(levels, ny, nx, terms, HALF_LANES), zeros(levels, ny, nx, terms, HALF_LANES)),
            zeros(2, 4, ny, nx, pairs, LANES),
            zeros(2, 4, levels, ny, pairs, LANES),
            zeros(2, 4, levels, nx, pairs, LANES),
            (
                zeros(levels, ny, nx + 1, HALF_LANES),
                zeros(levels, ny + 1, nx, HALF_LANES),
                zeros(2, levels + 1, ny, nx, HALF_LANES),
            ),
            zeros(2, 4, ny, nx, pairs, LANES),
        )
        self.down = np.zeros_like(self.direct)
        self.relaxation = np.float32(1.0)
        self._balance_cells()
        self._incident()

    def _mean_beam(self) -> None:
        """Mean transmittance of the beam, and the light that it gives to the cloud."""
        grid, optics, depths = self.problem.grid, self.problem.optics, self.problem.beam_depth
        levels, ny, nx = grid.extinction.shape
        self.beam = np.zeros((levels, ny, nx, HALF_LANES), np.float32)
        self.lit = np.zeros_like(self.beam)
        self.direct = np.zeros((ny, nx, HALF_LANES), np.float32)
        clear = self.problem.direct
        if not clear.any():
            return
        given = four_wide(-np.log(np.maximum(clear, _DARK * clear.max()))), four_wide(optics.cloud)
        across = across_column(grid, self.settings.beam_points)
        offset = np.zeros((levels, ny, nx, 3, HALF_LANES), np.float32)
        out = self.beam, offset, self.direct
        run_blocks(lambda y: mean_beam_row(y, depths[y], given, across, out), ny)
        self.direct *= np.float32(self.cosine)
        if grid.periodic and self.cosine > 0.0:
            self.beam *= lost_light(self.problem, self.thickness, self.beam, self.direct)
        amounts = (grid.extinction * self.thickness[:, None, None])[..., None] * self.beam
        amounts = centred(amounts, grid.extinction, offset, grid.periodic)
        self.lit[...] = amounts / self.thickness[:, None, None, None]

    def _balance_cells(self) -> None:
        grid, cells = self.problem.grid, self.cells
        amount = grid.extinction[..., None]
        total = amount * cells.cloud + cells.air[:, None, None]
        scattering = amount * cells.cloud_source[0] + cells.air_source[:, None, None, 0]
        forward = amount * cells.cloud_source[1] + cells.air_source[:, None, None, 1]
        self.gain = self.lit * cells.cloud_source[0]
        self.gain += self.beam * cells.air_source[:, None, None, 0]
        self.balanced = BalanceCells(
            total,
            total - forward,
            np.maximum(total - scattering, 0.0),
            grid.widths,
            self.thickness,
            grid.periodic,
            grid.flat,
            self.ground,
        )

    def _incident(self) -> None:
        """Light that enters from outside and leaves the ground for the first time."""
        vectors, weights = self.ways
        sky = four_wide(self.problem.sky)
        self.sky = in_pairs(sky)
        self.entering = np.einsum("onw,on->w", sky, weights[0] * -vectors[0, ..., 2])
        self.gain[-1] += self.entering / self.thickness[-1]
        self.gain[0] += self.ground * self.direct / self.thickness[0]
        if self.boundary is None:
            return
        light = self.light
        light.sides[...] = self.boundary[0]
        grid = self.problem.grid
        for axis, octants in ((0, ((0, 2), (1, 3))), (1, ((0, 1), (2, 3)))):
            given = self.boundary[axis]
            values = given.reshape(*given.shape[:4], -1, HALF_LANES)
            for last, some in enumerate(octants):
                flux = np.abs(vectors[:, some, :, axis]) * weights[:, some]
                inside = np.einsum("hokndw,hod->knw", values[:, some], flux) / grid.widths[axis]
                at = (slice(None),) * (2 - axis) + (-last,)
                self.gain[at] += inside.astype(np.float32)

    def phi(self) -> Float32Array:
        """Mean radiance times 4π of the cells, shape (levels, ny, nx, 4). [1]"""
        before, after = self.light.moments
        return (before[..., 0, :] + after[..., 0, :]) * np.float32(_ROOT)

    def guess(self) -> None:
        """Fill the moments with the light of diffusion."""
        phi = np.zeros_like(self.beam)
        coefficients = coefficients_for(self.balanced, self.light.currents, phi, first=True)
        phi = solve_linear(coefficients, self.thickness, self._gain_of_diffusion(), phi)
        np.maximum(phi, 0.0, out=phi)
        in_chunks(
            lambda a, b: correct(
                a, b, self.balanced, coefficients, phi, self.light.moments, self.shares
            ),
            len(self.thickness),
            self.problem.grid.extinction.size,
        )
        direction = -np.array(self.problem.towards)
        currents = np.einsum("hti,i->ht", self.shares[:, :, 1:], direction).astype(np.float32)
        forward = self._scattered_forward()
        given = forward, currents, self.light.moments
        in_chunks(lambda a, b: add_currents(a, b, *given), len(forward), forward.size // 4)
        if self.problem.grid.periodic:
            self._fill_sides()

    def _scattered_forward(self) -> Float32Array:
        """Net current in the beam's direction by its anisotropic scattering, of diffusion. [1]"""
        grid, cells = self.problem.grid, self.cells
        forward = grid.extinction[..., None] * cells.cloud_source[1]
        forward += cells.air_source[:, None, None, 1]
        forward *= self.beam
        least = 1.0 / np.float32(grid.edges[-1] - grid.edges[0])
        return np.asarray(forward / np.maximum(self.balanced.transport, least))

    def _gain_of_diffusion(self) -> Float32Array:
        """Gain of cells without the divergence of currents by forward scattering. [m⁻¹]"""
        gain = self.gain.copy()
        for axis, (current, width) in enumerate(self._beam_currents(self._scattered_forward())):
            gain -= (current - np.roll(current, 1, axis=axis)) / width
        return np.asarray(gain)

    def _beam_currents(self, forward: Float32Array) -> list[tuple[Float32Array, Any]]:
        """Net currents by forward scattering through upper faces, and cell widths. [1], [m]"""
        grid, towards = self.problem.grid, self.problem.towards
        found = []
        widths = (self.thickness[:, None, None, None], grid.widths[1], grid.widths[0])
        for axis, width in enumerate(widths):
            current = np.float32(-0.5 * towards[2 - axis]) * forward
            current += np.roll(current, -1, axis=axis)
            if axis == 0 or not grid.periodic:
                current.swapaxes(0, axis)[-1] = 0.0
            found.append((current, width))
        return found

    def _fill_sides(self) -> None:
        """Fill the light that enters at the sides with that of the guess."""
        light = self.light
        before, after = (moments[..., :4, :] for moments in light.moments)
        vectors, _ = self.ways
        functions = harmonics(vectors, 1)
        for octant, (x, y) in enumerate(SIGNS):
            for faces, cells in (
                (light.sides, (slice(None), slice(None), -1 if x > 0 else 0)),
                (light.fronts, (slice(None), -1 if y > 0 else 0)),
            ):
                found = np.einsum(
                    "hdt,kitw->hkidw", functions[:, octant], before[cells] + after[cells]
                )
                faces[:, octant] = in_pairs(np.maximum(found, 0.0))

    def sweep(
        self, *, progress: Progress | None = None, cancel: Cancel | None = None, done: int = 0
    ) -> None:
        """Replace the light by that of one sweep, and its currents.

        Parameters
        ----------
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``.
        done : int
            Number of sweeps before.
        """
        light = self.light
        levels, periodic = len(self.thickness), self.problem.grid.periodic
        for current in light.currents:
            current[:] = 0.0
        if not periodic and self.boundary is not None:
            light.fronts[...] = self.boundary[1]
        elif not periodic:
            light.fronts[...] = 0.0
        light.heads[0] = self.sky[:, None, None]
        reflected = self.ground * (self.direct + self.down) / np.float32(np.pi)
        light.heads[1] = np.concatenate([reflected, reflected], axis=-1)[None, :, :, None]

        def one(step: int, hemisphere: int) -> None:
            level = step if hemisphere else levels - 1 - step
            sweep_level(level, hemisphere, periodic, self.cells, self.pairs, light)

        def both(step: int, _: int) -> None:
            one(step, 0)
            one(step, 1)

        together = light.heads[0].size > _FEW
        total = levels * (done + 1 + _REMAINING)
        for step in range(levels):
            if cancel is not None and cancel():
                raise Cancelled("cancelled")
            if progress is not None:
                progress(levels * done + step, total, f"light of clouds, sweep {done + 1}")
            if together and 2 * step != levels - 1:
                run_blocks(partial(one, step), 2)
            else:
                run_blocks(partial(both, step), 1)
        self.down = -light.currents[2][0, 0]

    def rebalance(self) -> None:
        """Multiply the light of cells so that their energy is balanced."""
        light, phi = self.light, self.phi()
        coefficients = coefficients_for(self.balanced, light.currents, phi, first=False)
        better = solve_linear(coefficients, self.thickness, self.gain, phi)
        change = np.clip(better, _FACTORS[0] * phi, _FACTORS[1] * phi) - phi
        change *= self.relaxation
        in_chunks(
            lambda a, b: correct(
                a, b, self.balanced, coefficients, change, light.moments, self.shares
            ),
            len(self.thickness),
            self.problem.grid.extinction.size,
        )
        factor = better[0] / np.maximum(phi[0], np.float32(1e-20))
        self.down *= np.clip(factor, _FACTORS[0], _FACTORS[1])

    def run(self, *, progress: Progress | None = None, cancel: Cancel | None = None) -> BoxLevels:
        """Light after convergence, or after the largest number of sweeps.

        Raises
        ------
        ConvergenceError
            If it still changes by more than 8 %.

        Warns
        -----
        AirlightWarning
            If it still changes by more than ten times the tolerance, or levels are too thick.
        """
        if self.start is None:
            self.guess()
        else:
            self.down = begin(self.start, self.ways, self.settings.degree, self.light.moments)
            self.start = None
        phi = self.phi()
        change = np.full(HALF_LANES, np.inf)
        sweeps, error = 0, np.inf
        while sweeps < self.settings.max_sweeps and not error <= self.settings.tolerance:
            self.sweep(progress=progress, cancel=cancel, done=sweeps)
            self.rebalance()
            before, phi = phi, self.phi()
            earlier, change = change, change_of(before, phi)
            error = remaining_error(float(earlier.max()), float(change.max()))
            sweeps += 1
            if sweeps > _SETTLED and change.max() > earlier.max():  # in optically thick cells
                self.relaxation = max(_DAMPING * self.relaxation, _LEAST_RELAXATION)
        if not change.max() <= _UNCONVERGED * self.settings.tolerance:
            message = (
                f"the light of clouds still changes by {100.0 * change.max():.2g} % after {sweeps} "
                f"sweeps; cells have optical depths up to {self._thickest():.3g}"
            )
            if not change.max() <= _REJECTED:
                raise ConvergenceError(message)
            warn(message)
        if self._thickest_level() > _COARSE:
            warn(
                f"levels of clouds have scaled optical depths up to {self._thickest_level():.3g}: "
                "light that passes them may be wrong by more than a tenth; up to "
                f"{_COARSE:g} it is not: divide the field into more levels"
            )
        return self._levels(change, sweeps)

    def _thickest_level(self) -> float:
        """Largest scaled optical depth of a level in all but a fiftieth of its columns. [1]"""
        total = self.balanced.total.max(axis=3).reshape(len(self.thickness), -1)
        return float((np.quantile(total, 0.98, axis=1) * self.thickness).max())

    def _thickest(self) -> float:
        """Largest scaled optical depth across a cell. [1]"""
        steps = np.maximum(self.thickness, np.float32(max(self.problem.grid.widths)))
        return float((self.balanced.total.max(axis=(1, 2, 3)) * steps).max())

    def _levels(self, change: FloatArray, sweeps: int) -> BoxLevels:
        light = self.light
        before, after = light.moments
        up = light.currents[2][1, -1]
        inside = (self.balanced.absorption * (self.phi() + self.beam)).mean(axis=(1, 2))
        absorbed = np.asarray(self.thickness, np.float64) @ inside
        before += after
        taken = (self.balanced.total * self.beam).mean(axis=(1, 2))
        beam = np.asarray(self.thickness, np.float64) @ taken + self.direct.mean(axis=(0, 1))
        if self.problem.curvature == 0.0:
            beam = self.cosine * four_wide(self.problem.direct)[-1]
        given = beam + self.entering
        incident = np.maximum(given, 1e-30)
        ground = (1.0 - self.ground) * (self.down + self.direct).mean(axis=(0, 1))
        energy = (up.mean(axis=(0, 1)) + ground + absorbed - given) / incident
        return BoxLevels(
            before, self.beam, self.down, self.direct, up, light.sides, change, energy, absorbed,
            sweeps,
        )  # fmt: skip
