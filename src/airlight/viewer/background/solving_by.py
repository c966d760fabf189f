"""Who solves for a window, and at which wavelengths."""

from __future__ import annotations

from typing import Literal

import numpy as np
from numpy.typing import NDArray

from airlight.color.four_wavelengths import CHOSEN, few_wavelengths
from airlight.errors import ConvergenceError, ParameterError
from airlight.gpu.device.device import Device
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.solvers.moments.settings import settings_for
from airlight.solvers.moments.solution import MomentsSolution
from airlight.viewer.background.solving import COUNTS, Solver, evenly_spaced, solve_on_cpu

FloatArray = NDArray[np.float64]


def shown_wavelengths(planet: Planet, count: str) -> FloatArray:
    """Wavelengths of a picture by a word: few are chosen for their colours, many evenly spaced.

    Parameters
    ----------
    planet : Planet
        Known between its limits.
    count : str
        One of ``COUNTS``.

    Returns
    -------
    array, shape (n,)
        [nm]
    """
    if COUNTS[count] in CHOSEN:
        return few_wavelengths(COUNTS[count], *planet.wavelength_limits)
    return evenly_spaced(planet, count)


def solver_by(choice: Literal["auto", "gpu", "cpu"], device: Device) -> Solver:
    """The solver for a device: its own if it is a GPU, else the processor's.

    What the GPU has no room for (many wavelengths, many constituents, thick air) the processor
    solves.
    """
    if choice == "cpu" or device.software:
        return solve_on_cpu

    def solve(
        planet: Planet,
        wavelengths: FloatArray,
        quality: str,
        *,
        progress: Progress,
        cancel: Cancel,
    ) -> MomentsSolution:
        from airlight.gpu.solver.planning import ThickAir
        from airlight.gpu.solver.solver import solve_on

        medium = Medium.from_planet(planet, wavelengths, progress=progress, cancel=cancel)
        try:
            solution = solve_on(
                device, medium, settings_for(quality), progress=progress, cancel=cancel
            )
        except (ParameterError, ThickAir, ConvergenceError):
            processor: MomentsSolution = solve_on_cpu(
                planet, wavelengths, quality, progress=progress, cancel=cancel
            )
            return processor
        solution.planet = planet
        return solution

    return solve
