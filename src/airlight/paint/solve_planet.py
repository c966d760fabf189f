"""Choice of the solver of a planet: one policy for command line, window, notebook and page.

A GPU solves if it is a hardware GPU and has the capacity: at most four wavelengths,
clear or dusty air. The CPU solves all other cases: thick air, many wavelengths and constituents,
and everything where the GPU is software, which would share the CPU, whose own solver is faster.
Edits are many, and few recur: their solutions are not stored on disk, those of presets are.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight import solvers
from airlight.errors import ConvergenceError
from airlight.kernel.threads import Cancel, Progress
from airlight.paint.capacity import fits
from airlight.paint.rendering_gpu import Choice, live_gpu
from airlight.planets.medium import Medium
from airlight.planets.missing_bands import warn_of_missing_bands
from airlight.planets.picture_wavelengths import picture_wavelengths, texel_wavelengths
from airlight.planets.planet import Planet
from airlight.solvers.moments.settings import Settings, settings_for
from airlight.units import values_in

if TYPE_CHECKING:
    from airlight.gpu.device.device import Device
    from airlight.solvers.moments.solution import MomentsSolution


class PlanetSolver(Protocol):
    """Solver of a session: ``solver(planet, wavelengths, quality, progress=, cancel=)``."""

    def __call__(
        self,
        planet: Planet,
        wavelengths: NDArray[np.float64],
        quality: str,
        *,
        progress: Progress,
        cancel: Cancel,
    ) -> MomentsSolution:
        """Solve a planet at these wavelengths and quality."""


def solve_planet(
    planet: Planet,
    wavelengths: ArrayLike | None = None,
    quality: str | Settings = "default",
    *,
    polarisation: bool = True,
    device: Device | None = None,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """Solve a planet for pictures, on a GPU where that is faster.

    Parameters
    ----------
    planet : Planet
        Planet to solve.
    wavelengths : array, shape (nl,), optional
        Wavelengths; by default ``picture_wavelengths``. [nm]
    quality : str or Settings
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether light is polarised, as for ``airlight.solve``.
    device : Device, optional
        Device from ``open_device``; without it the CPU solves.
    cache : bool
        Whether the CPU looks for the solution on disk first, and stores it there.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    MomentsSolution
        Solution from the GPU or the CPU.

    Raises
    ------
    ParameterError
        If a wavelength is outside the range of the planet's file, or the quality is unknown.
    ConvergenceError
        If the orders of scattering do not converge on the CPU either.
    """
    if wavelengths is None:
        chosen = picture_wavelengths if device is None else texel_wavelengths
        wavelengths = chosen(planet)
    nm = values_in(wavelengths, "nm", "wavelengths")
    if device is not None and not device.software and fits(planet, nm.size):
        from airlight.gpu.solver.solver import ThickAir, solve_on

        medium = Medium.from_planet(planet, nm, progress=progress, cancel=cancel)
        warn_of_missing_bands(planet, nm)
        try:
            settings = settings_for(quality)
            settings = settings if polarisation else replace(settings, polarisation=False)
            solution = solve_on(device, medium, settings, progress=progress, cancel=cancel)
        except (ThickAir, ConvergenceError):
            pass
        else:
            return solution.of(planet)
    return solvers.solve(
        planet, nm, quality, polarisation=polarisation, cache=cache, progress=progress,
        cancel=cancel,
    )  # fmt: skip


def live_solver(
    choice: Choice = "auto",
    device: Device | None = None,
    keeps: Callable[[], bool] = lambda: False,
) -> PlanetSolver:
    """Make the solver for the edits of a session.

    Parameters
    ----------
    choice : "auto", "cpu" or "gpu"
        Device as for ``live_gpu``; it solves if it is a hardware GPU.
    device : Device, optional
        Device from ``open_device``, if any.
    keeps : callable
        Whether the solution of a planet is looked for on disk, and stored there: asked each time.
    """
    drawing = live_gpu(choice, device)

    def solve(*arguments: Any, **options: Any) -> MomentsSolution:
        return solve_planet(*arguments, device=drawing, cache=keeps(), **options)

    return solve
