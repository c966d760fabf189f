"""Which device draws the picture of ``airlight render``, and why it is not the one asked for."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from airlight.gpu.device.device import Device
    from airlight.planets.planet import Planet

#: What ``--device`` takes.
Choice = Literal["auto", "cpu", "gpu"]
#: The picture's ``device`` where there is no other.
PROCESSOR = "processor"


def device_for(choice: Choice, planet: Planet, count: int, width: int) -> Device | None:
    """The GPU that can draw a picture, or None for the processor.

    Parameters
    ----------
    choice : "auto", "cpu" or "gpu"
        ``auto`` takes no GPU in software, and says nothing where there is no other; ``gpu`` takes
        either, and says on the standard error stream why it has to leave the work to the processor.
    planet : Planet
        Whose constituents the shaders must have room for.
    count : int
        Of wavelengths.
    width : int
        Of the picture. [pixel]
    """
    if choice == "cpu":
        return None
    from airlight.errors import ParameterError
    from airlight.gpu.device.device import NoDevice, open_device
    from airlight.gpu.solve_planet import check_room

    try:
        check_room(planet, count)
        device = open_device()
        widest = device.device.limits["max-texture-dimension-2d"]
        if width > widest:
            raise ParameterError("--size", width, f"at most {widest} pixels in a row on the GPU")
    except (NoDevice, ParameterError) as reason:
        if choice == "gpu":
            print(f"airlight: the processor renders instead: {reason}", file=sys.stderr)
        return None
    return None if choice == "auto" and device.software else device
