"""Choice of the GPU for solving and rendering, with the reason of a fallback to the CPU.

Still frames use a software GPU only on request. Live frames use it, as the CPU renders their final
frame (``LiveRenderer``) and solves (``solve_planet``).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Final, Literal

from airlight.errors import ParameterError
from airlight.render.pixels.capacity import check_capacity

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.render.clouds.clouds_around import CloudsAround
    from airlight.render.gpu.device.device import Device
    from airlight.scene import Scene

#: Largest altitude of pictures with clouds, by eye: from 3 km a GPU in software agrees with the
#: CPU, from 400 km it is 4 % too dark. [m]
_HIGHEST: Final = 24e3
#: Cells of a box with those of its levels of detail, over its own. [1]
_WITH_LEVELS: Final = 4.0 / 3.0
#: Requested device.
Choice = Literal["auto", "cpu", "gpu"]


def any_gpu() -> Device | None:
    """Open GPU of this machine; None without one."""
    from airlight.render.gpu.device.device import NoDevice, open_device

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
    """GPU that can render a still frame; None for the CPU.

    Parameters
    ----------
    choice : "auto", "cpu" or "gpu"
        ``auto`` ignores software GPUs and falls back silently; ``gpu`` accepts both.
    planet : Planet
        Planet whose constituents the shaders must hold.
    width : int
        Width of the frame. [pixel]
    refused : callable, optional
        Receives one line with the reason when ``gpu`` falls back to the CPU.
    """
    if choice == "cpu":
        return None
    from airlight.render.gpu.device.device import NoDevice, open_device

    try:
        _check_planet(planet, wavelengths)
        device = open_device()
        widest = device.device.limits["max-texture-dimension-2d"]
        if width > widest:
            raise ParameterError("width", width, f"at most {widest} pixels on this GPU")
    except (NoDevice, ParameterError) as reason:
        if choice == "gpu" and refused is not None:
            refused(str(reason))
        return None
    return None if choice == "auto" and device.software else device


def check_clouds(clouds: CloudsAround, scene: Scene) -> None:
    """Raise if the GPU cannot draw clouds: behind a filter, from high above, or in large boxes.

    Parameters
    ----------
    clouds, scene : CloudsAround, Scene
        Clouds and observer.
    """
    if scene.altitude > _HIGHEST:
        allowed = f"at most {_HIGHEST:g} m for clouds on the GPU"
        raise ParameterError("observer.altitude", scene.altitude, allowed)
    if scene.camera.polariser is not None:
        allowed = "none with clouds on the GPU"
        raise ParameterError("camera.polariser", scene.camera.polariser, allowed)
    from airlight.render.clouds.cloud_light import coarse_field
    from airlight.render.gpu.device.flat import MAX_ROWS
    from airlight.render.gpu.emit.shader_types import PACKED_WIDTH
    from airlight.solver.boxes.directions import term_count
    from airlight.solver.boxes.settings import settings_for

    terms = term_count(settings_for(clouds.quality).stored_degree)
    cells = sum(coarse_field(deck.field).extinction.size for deck in clouds.decks)
    most = MAX_ROWS * PACKED_WIDTH // terms
    if _WITH_LEVELS * cells > most:
        raise ParameterError("clouds", f"a light of {cells} cells", f"at most {most} on the GPU")


def fits(planet: Planet, wavelengths: int) -> bool:
    """Whether the constituents of a planet and a number of wavelengths fit the shaders."""
    try:
        _check_planet(planet, wavelengths)
    except ParameterError:
        return False
    return True


def _check_planet(planet: Planet, wavelengths: int) -> None:
    """Raise if the constituents of a planet or the wavelengths do not fit the shaders."""
    constituents = len(planet.constituents) + (planet.refraction != "none")  # "refraction" is one
    check_capacity(wavelengths, constituents)
