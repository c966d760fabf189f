"""Who solves a planet: one policy for command line, window, notebook and page.

A graphics device solves where it is a real one and has room: at most four wavelengths, clear or
dusty air. The processor solves all else: thick air, many wavelengths and constituents, and
everything where the device is software, which would share the processor that solves by itself more
quickly. Edits are many, and few come back: what is solved for them is not kept on disk.
"""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight import solvers
from airlight.errors import ConvergenceError, ParameterError
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.planets.picture_wavelengths import LIVE, picture_wavelengths
from airlight.planets.planet import Planet
from airlight.solvers.moments.settings import Settings, settings_for

if TYPE_CHECKING:
    from airlight.gpu.device.device import Device
    from airlight.solvers.moments.solution import MomentsSolution

#: Who is asked to compute.
Processor = Literal["auto", "gpu", "cpu"]


class PlanetSolver(Protocol):
    """What solves for a session: ``solver(planet, wavelengths, quality, progress=, cancel=)``."""

    def __call__(
        self,
        planet: Planet,
        wavelengths: NDArray[np.float64],
        quality: str,
        *,
        progress: Progress,
        cancel: Cancel,
    ) -> MomentsSolution:
        """The solution."""


def solve_planet(
    planet: Planet,
    wavelengths: ArrayLike | None = None,
    quality: str | Settings = "default",
    *,
    device: Device | None = None,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """Solve a planet for pictures, on a device where that is quicker.

    Parameters
    ----------
    planet : Planet
    wavelengths : array, shape (nl,), optional
        ``picture_wavelengths`` without it. [nm]
    quality : str or Settings
        As for ``airlight.solve``.
    device : Device, optional
        From ``open_device``; without it the processor solves.
    cache : bool
        Whether the processor looks for the solution on disk first, and leaves it there.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    MomentsSolution

    Raises
    ------
    ParameterError
        If a wavelength is outside what the planet's file covers, or there is no such quality.
    ConvergenceError
        If the orders of scattering do not converge on the processor either.
    """
    if wavelengths is None:
        wavelengths = picture_wavelengths(planet, most=None if device is None else LIVE)
    nm = np.asarray(wavelengths, float)
    if device is not None and not device.software and fits(planet, nm.size):
        from airlight.gpu.solver.planning import ThickAir
        from airlight.gpu.solver.solver import solve_on

        medium = Medium.from_planet(planet, nm, progress=progress, cancel=cancel)
        try:
            solution = solve_on(
                device, medium, settings_for(quality), progress=progress, cancel=cancel
            )
        except (ThickAir, ConvergenceError):
            pass
        else:
            solution.planet = planet
            return solution
    return solvers.solve(planet, nm, quality, cache=cache, progress=progress, cancel=cancel)


def live_solver(processor: Processor = "auto", device: Device | None = None) -> PlanetSolver:
    """What solves the edits of a session.

    Parameters
    ----------
    processor : str
        ``cpu`` leaves a device alone; ``auto`` and ``gpu`` take it where it is a real one.
    device : Device, optional
        At hand.
    """
    return partial(solve_planet, device=None if processor == "cpu" else device, cache=False)


def fits(planet: Planet, wavelengths: int) -> bool:
    """Whether the shaders have room for a planet at so many wavelengths.

    Parameters
    ----------
    planet : Planet
    wavelengths : int
    """
    try:
        check_room(planet, wavelengths)
    except ParameterError:
        return False
    return True


def check_room(planet: Planet, wavelengths: int) -> None:
    """Refuse what the shaders have no room for.

    Parameters
    ----------
    planet : Planet
    wavelengths : int
        How many.

    Raises
    ------
    ParameterError
        If there are too many wavelengths or constituents.
    """
    from airlight.pixels.shown import MOST_CONSTITUENTS, WAVELENGTHS

    if wavelengths > WAVELENGTHS:
        raise ParameterError("--wavelengths", wavelengths, f"at most {WAVELENGTHS} on the GPU")
    constituents = len(planet.constituents) + (planet.refraction != "none")  # "bending" is one
    if constituents > MOST_CONSTITUENTS:
        allowed = f"at most {MOST_CONSTITUENTS} on the GPU"
        raise ParameterError("constituents", constituents, allowed)
