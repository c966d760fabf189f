"""USD layer with the map on a dome light and its separate lights."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.environment.consumers import Z_UP

if TYPE_CHECKING:
    from airlight.engines.environment.environment_map import EnvironmentMap

_HEAD: Final = """#usda 1.0
(
    defaultPrim = "Sky"
    doc = {doc}
    metersPerUnit = 1
    upAxis = "{up}"
)

def Xform "Sky" (
    prepend variantSets = "dome"
    variants = {{
        string dome = "DomeLight"
    }}
)
{{
    variantSet "dome" = {{
        "DomeLight" {{
            def DomeLight "Dome"
            {{
{dome}
            }}
        }}
        "DomeLight_1" {{
            def DomeLight_1 "Dome"
            {{
{dome}
                uniform token poleAxis = "Y"
            }}
        }}
    }}
{lights}}}
"""
_DOME: Final = """                float inputs:intensity = {intensity:.9g}
                asset inputs:texture:file = {name}
                token inputs:texture:format = "latlong"{turned}"""
#: The picture's pole, which is y in both schemas, to z.
_TURNED: Final = """
                float xformOp:rotateX = 90
                uniform token[] xformOpOrder = ["xformOp:rotateX"]"""
_LIGHT: Final = """
    def DistantLight "{name}"
    {{
        float inputs:angle = {angle:.9g}
        color3f inputs:color = ({color})
        float inputs:intensity = {intensity:.9g}
        bool inputs:normalize = 1
        matrix4d xformOp:transform = ( {rows}, (0, 0, 0, 1) )
        uniform token[] xformOpOrder = ["xformOp:transform"]
    }}
"""


def usd_scene(made: EnvironmentMap, name: str, scale: float) -> str:
    """Text of a ``.usda`` layer: y up, x east, z south; or z up, x east, y north.

    The dome's intensity compensates the scale, so that its radiances, and the irradiances of the
    normalised distant lights, are in the units of the map (W m⁻² sr⁻¹; times 683 in nits). The
    variant ``DomeLight_1`` has an explicit pole axis, but older programs do not support it.

    Parameters
    ----------
    made : EnvironmentMap
        Map for ``usd``.
    name : str
        Name of its file, in the folder of the layer.
    scale : float
        Ratio of the file's numbers to radiances. [1]

    References
    ----------
    OpenUSD, UsdLux: DomeLight, DomeLight_1, DistantLight, and "Quantities".
    """
    lights = ""
    for number, one in enumerate(made.discs if made.sun == "light" else ()):
        peak = float(one.irradiance.max())
        lights += _LIGHT.format(
            name="Sun" if number == 0 else f"Light{number + 1}",
            angle=one.angular_diameter,
            color=", ".join(f"{value:.9g}" for value in (one.irradiance / peak).round(9)),
            intensity=peak,
            rows=", ".join(
                "(" + ", ".join(f"{value:.9g}" for value in (*(row.round(12) + 0.0), 0.0)) + ")"
                for row in axes_towards(made.consumer.direction(one.direction))
            ),
        )
    z_up = made.consumer.axes == Z_UP
    axes = "x east, y north, z up" if z_up else "x east, y up, z south"
    doc = f"Sky of {made.frame.metadata.get('planet', 'a planet')}: {axes}. Radiance "
    doc += "in W m-2 sr-1, linear sRGB weighted by CIE 1931; times 683 in nits."
    dome = _DOME.format(
        intensity=1.0 / scale, name=_asset(f"./{name}"), turned=_TURNED if z_up else ""
    )
    return _HEAD.format(doc=_text(doc), dome=dome, lights=lights, up="Z" if z_up else "Y")


def _asset(path: str) -> str:
    r"""Path of an asset in delimiters that it does not contain.

    Examples
    --------
    >>> print(_asset("./sky.exr"), _asset("./sky@2x.exr"))
    @./sky.exr@ @@@./sky@2x.exr@@@
    """
    return "@@@" + path.replace("@@@", r"\@@@") + "@@@" if "@" in path else f"@{path}@"


def _text(text: str) -> str:
    """Text in quotation marks."""
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def axes_towards(direction: NDArray[np.float64]) -> NDArray[np.float64]:
    """Right-handed axes as rows, the third along a direction, shape (3, 3). [1]

    In these axes, a light along -z comes from that direction.

    Parameters
    ----------
    direction : array, shape (3,)
        Unit vector.

    Examples
    --------
    >>> axes_towards(np.array([0.0, 0.0, 1.0]))
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]])
    """
    beside = np.array([0.0, 1.0, 0.0]) if abs(direction[1]) < 0.9 else np.array([0.0, 0.0, -1.0])
    x = np.cross(beside, direction)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(direction, x), direction])
