"""A planet's light by the GPU where it can, by the CPU where it cannot."""

from __future__ import annotations

from numpy.typing import ArrayLike

from airlight.errors import ConvergenceError
from airlight.gpu.device.device import Device
from airlight.gpu.solver.planning import ThickAir
from airlight.gpu.solver.solver import solve_on
from airlight.kernel.threads import Cancel, Progress
from airlight.pixels.shown import MOST_CONSTITUENTS, WAVELENGTHS
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.solvers.moments import solution as cpu
from airlight.solvers.moments.settings import Settings, settings_for
from airlight.solvers.moments.solution import MomentsSolution


def solve_planet(
    device: Device,
    planet: Planet,
    wavelengths: ArrayLike,
    quality: str | Settings = "default",
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """As ``airlight.solve`` without its cache, on a device where that is quicker.

    The CPU solves what the shaders have no room for, thick air, and everything where the device is
    software: there the passes would share the processor that solves by itself more quickly.

    Parameters
    ----------
    device : Device
        From ``open_device``.
    planet : Planet
    wavelengths : array, shape (nl,)
        [nm]
    quality : str or Settings
        As for ``airlight.solve``.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    settings = settings_for(quality)
    medium = Medium.from_planet(planet, wavelengths, progress=progress, cancel=cancel)
    solution = None
    if not device.software and fits(medium):
        try:
            solution = solve_on(device, medium, settings, progress=progress, cancel=cancel)
        except (ThickAir, ConvergenceError):
            solution = None
    if solution is None:
        solution = cpu.solve(medium, settings, cache=False, progress=progress, cancel=cancel)
    solution.planet = planet
    return solution


def fits(medium: Medium) -> bool:
    """Whether the shaders have room for a medium: one more constituent where light is bent.

    Parameters
    ----------
    medium : Medium
    """
    constituents = len(medium.names) + bool(medium.refractivity.any())
    return medium.wavelengths.size <= WAVELENGTHS and constituents <= MOST_CONSTITUENTS
