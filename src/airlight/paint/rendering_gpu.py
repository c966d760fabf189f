"""Device that solves and renders, and the reason if it is not the requested one.

A still picture leaves a software GPU out unless it is requested by name. Live pictures take one,
since the CPU finishes them (``Renderer``), and solves in its place (``solve_planet``).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from airlight.gpu.device.device import Device
    from airlight.planets.planet import Planet

#: Requested renderer.
Choice = Literal["auto", "cpu", "gpu"]


def live_gpu(choice: Choice, device: Device | None) -> Device | None:
    """Device for the pictures and solutions of a session, or None for the CPU.

    Parameters
    ----------
    choice : "auto", "cpu" or "gpu"
        ``cpu`` ignores a GPU, the others take it.
    device : Device or None
        Open device, if any.
    """
    return None if choice == "cpu" else device


def any_gpu() -> Device | None:
    """Device of this machine, opened, or None if there is none."""
    from airlight.gpu.device.device import NoDevice, open_device

    try:
        return open_device()
    except NoDevice:
        return None


def rendering_gpu(
    choice: Choice,
    planet: Planet,
    wavelengths: int,
    width: int,
    refused: Callable[[str], None] | None = None,
) -> Device | None:
    """Device that can render a still picture, or None for the CPU.

    Parameters
    ----------
    choice : "auto", "cpu" or "gpu"
        ``auto`` takes no software GPU, and falls back silently; ``gpu`` takes either.
    planet : Planet
        Planet whose constituents the shaders must hold.
    wavelengths : int
        Number of wavelengths.
    width : int
        Width of the picture. [pixel]
    refused : callable, optional
        Receives the reason, one line, where ``gpu`` has to leave the work to the CPU.
    """
    if choice == "cpu":
        return None
    from airlight.errors import ParameterError
    from airlight.gpu.device.device import NoDevice, open_device
    from airlight.paint.capacity import check_planet

    try:
        check_planet(planet, wavelengths)
        device = open_device()
        widest = device.device.limits["max-texture-dimension-2d"]
        if width > widest:
            raise ParameterError("--size", width, f"at most {widest} pixels in a row on the GPU")
    except (NoDevice, ParameterError) as reason:
        if choice == "gpu" and refused is not None:
            refused(str(reason))
        return None
    return None if choice == "auto" and device.software else device
