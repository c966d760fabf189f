"""Solver dispatch of a planet to CPU or GPU, shared by command line, window and notebook.

A hardware GPU solves up to four wavelengths in optically thin or moderately thick atmospheres. The
CPU solves everything else: thick atmospheres, more wavelengths or constituents, and all cases on a
software GPU, which is slower than the CPU on the same cores. Solutions of presets are stored on
disk; those of edits are not, as edits rarely recur.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight import solver
from airlight.errors import ConvergenceError
from airlight.kernel.threads import Cancel, Progress
from airlight.physics.units import values_in
from airlight.planets.medium import Medium
from airlight.planets.omitted_absorption_bands import warn_of_omitted_bands
from airlight.planets.picture_wavelengths import picture_wavelengths, texel_wavelengths
from airlight.planets.without_clouds import check_clear
from airlight.render.rendering_gpu import Choice, fits
from airlight.scene.local_ground import local_ground
from airlight.solver.moments.settings import MomentsSettings, settings_for

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.render.gpu.device.device import Device
    from airlight.scene.system import System
    from airlight.solver.moments.solution import MomentsSolution


class PlanetSolver(Protocol):
    """Signature of a session's solver."""

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
    quality: str | MomentsSettings = "default",
    *,
    polarisation: bool = True,
    device: Device | None = None,
    cache: bool = True,
    around: tuple[float, float, float] | None = None,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """Solve a planet for rendering, on the GPU where that is faster.

    Parameters
    ----------
    wavelengths : array, shape (nl,), optional
        Wavelengths; by default ``picture_wavelengths``. [nm]
    quality : str or MomentsSettings
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether transfer is vectorial, as for ``airlight.solve``.
    device : Device, optional
        GPU from ``open_device``; by default the CPU solves.
    cache : bool
        Whether the CPU reads and stores solutions on disk.
    around : (float, float, float), optional
        Latitude and longitude [deg] and altitude [m] of an observer, with whose local ground the
        planet is solved, see ``airlight.local_ground``; by default with its mean.

    Raises
    ------
    ConflictError
        If the planet has three-dimensional clouds.
    """
    check_clear(planet)
    if wavelengths is None:
        chosen = picture_wavelengths if device is None else texel_wavelengths
        wavelengths = chosen(planet)
    nm = values_in(wavelengths, "nm", "wavelengths")
    if around is not None:
        latitude, longitude, altitude = around
        planet = local_ground(planet, latitude=latitude, longitude=longitude, altitude=altitude)
    if device is not None and not device.software and fits(planet, nm.size):
        from airlight.render.gpu.solver.solver import ThickAir, solve_on

        medium = Medium.from_planet(planet, nm, progress=progress, cancel=cancel)
        warn_of_omitted_bands(planet, nm)
        try:
            settings = settings_for(quality)
            settings = settings if polarisation else replace(settings, polarisation=False)
            solution = solve_on(device, medium, settings, progress=progress, cancel=cancel)
        except (ThickAir, ConvergenceError):
            pass
        else:
            return solution.of(planet)
    return solver.solve(
        planet,
        nm,
        quality,
        polarisation=polarisation,
        cache=cache,
        progress=progress,
        cancel=cancel,
    )


def live_solver(
    choice: Choice = "auto",
    device: Device | None = None,
    keeps: Callable[[], bool] = lambda: False,
) -> PlanetSolver:
    """Solver for the edits of a session.

    Parameters
    ----------
    choice : "auto", "cpu" or "gpu"
        ``cpu`` ignores the GPU; a software GPU does not solve.
    device : Device, optional
        GPU from ``open_device``, if any.
    keeps : callable
        Whether the current solution is read from and stored on disk.
    """
    gpu = None if choice == "cpu" else device

    def solve(*arguments: Any, **options: Any) -> MomentsSolution:
        return solve_planet(*arguments, device=gpu, cache=keeps(), **options)

    return solve


def solve_planets(
    system: System, wavelengths: Sequence[float], quality: str = "default", **options: Any
) -> dict[str, MomentsSolution]:
    """Solutions of the planets of a scene by name, with the ground below the observer.

    Parameters
    ----------
    system : System
        Bodies and observer.
    wavelengths, quality :
        See ``solve_planet``.
    **options
        Further arguments of ``solve_planet``.
    """
    return {
        name: solve_planet(
            planet.without_clouds,
            tuple(wavelengths),
            quality,
            around=system.place_above(system.body(name)),
            **options,
        )
        for name, planet in system.planets.items()
    }
