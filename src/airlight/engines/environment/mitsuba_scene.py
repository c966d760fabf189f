"""Mitsuba scene with the map and its separate lights."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final
from xml.sax.saxutils import quoteattr

if TYPE_CHECKING:
    from airlight.engines.environment.environment_map import EnvironmentMap

_MAP: Final = """<scene version="3.0.0">
    <!-- x east, y up, z south. Radiance in W m-2 sr-1, linear sRGB weighted by CIE 1931. -->
    <emitter type="envmap">
        <string name="filename" value={name}/>
        <float name="scale" value="{scale:.9g}"/>
    </emitter>
{lights}</scene>
"""
_LIGHT: Final = """    <emitter type="directional">
        <vector name="direction" value="{direction}"/>
        <rgb name="irradiance" value="{irradiance}"/>
    </emitter>
"""


def mitsuba_scene(made: EnvironmentMap, name: str, scale: float) -> str:
    """Text of an ``.xml`` scene to load or include: y up, x east, z south.

    Parameters
    ----------
    made : EnvironmentMap
        Map for ``mitsuba``.
    name : str
        Name of its file, in the folder of the scene.
    scale : float
        Ratio of the file's numbers to radiances, compensated by the emitter. [1]
    """
    lights = "".join(
        _LIGHT.format(
            direction=", ".join(
                f"{v:.9g}" for v in (-made.consumer.direction(one.direction)).round(12) + 0.0
            ),
            irradiance=", ".join(f"{v:.9g}" for v in one.irradiance.round(12)),
        )
        for one in (made.discs if made.sun == "light" else ())
    )
    escaped = name.replace("$", r"\$")  # which begins a parameter of the scene
    return _MAP.format(name=quoteattr(escaped), scale=1.0 / scale, lights=lights)
