"""Programs that read environment maps, with their axis conventions.

Maps are defined in ENU: x east, y north, z up. A program has its own axes and its own mapping from
directions to image coordinates. All latitude-longitude mappings show the sky from inside and differ
only in the bearing of the image centre.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, ParameterError

FloatArray = NDArray[np.float64]

_EAST: Final = (1.0, 0.0, 0.0)
_NORTH: Final = (0.0, 1.0, 0.0)
_UP: Final = (0.0, 0.0, 1.0)
_SOUTH: Final = (0.0, -1.0, 0.0)

Axes = tuple[tuple[float, float, float], ...]
#: z up: x east, y north.
Z_UP: Final[Axes] = (_EAST, _NORTH, _UP)
#: y up, right-handed: x east, z south, so that a camera of such programs, which looks along -z,
#: faces north.
Y_UP: Final[Axes] = (_EAST, _UP, _SOUTH)
#: y up, left-handed: x east, z north.
Y_UP_LEFT_HANDED: Final[Axes] = (_EAST, _UP, _NORTH)


@dataclass(frozen=True, kw_only=True)
class Consumer:
    """Program that reads an environment map, with its axis convention.

    Attributes
    ----------
    name : str
        Name on the command line.
    title : str
        Name of the program and of its component that reads the map.
    projection : str
        Projection of the map: a name in ``PROJECTIONS``.
    axes : tuple of three vectors
        The program's x, y and z in ENU. [1]
    centre : float
        Bearing of the image centre or, if the centre is the zenith, of the middle of the bottom
        edge. [deg]
    tilt : float
        Zenith angle of the image centre of a dome. [deg]
    keeps_halves : bool
        Whether the program stores maps in half floats, whatever the file format.
    rows_reach_poles : bool
        Whether the first and the last row are at the poles, not half a texel from them.
    """

    name: str
    title: str
    projection: str = "equirectangular"
    axes: Axes
    centre: float
    tilt: float | None = None
    keeps_halves: bool = False
    rows_reach_poles: bool = False

    def direction(self, enu: FloatArray) -> FloatArray:
        """Directions in the program's axes from ENU, shape (..., 3). [1]"""
        return np.asarray(enu @ np.array(self.axes).T)

    @property
    def handedness(self) -> str:
        """Handedness of the axes: ``right`` or ``left``."""
        return "right" if np.linalg.det(np.array(self.axes)) > 0.0 else "left"

    @property
    def look_zenith(self) -> float:
        """Zenith angle of the camera that renders its map. [deg]"""
        return 90.0 if self.tilt is None else self.tilt

    def with_up(self, up: str) -> Consumer:
        """USD convention with another up axis.

        Parameters
        ----------
        up : str
            ``y`` or ``z``.
        """
        if self.name != "usd":
            raise ConflictError("up", "requires usd")
        if up not in ("y", "z"):
            raise ParameterError("up", up, "y or z")
        return replace(self, axes=Y_UP if up == "y" else Z_UP)

    def facing(self, front: float, tilt: float) -> Consumer:
        """Dome convention with another front bearing.

        Parameters
        ----------
        front : float
            Bearing at the bottom edge, -360 to 360. [deg]
        tilt : float
            Tilt of the dome towards its front, 0 to 90. [deg]
        """
        if self.tilt is None:
            raise ConflictError("front", "requires a dome")
        for name, value, low in (("front", front, -360.0), ("tilt", tilt, 0.0)):
            high = 360.0 if name == "front" else 90.0
            if not low <= value <= high:
                raise ParameterError(name, value, f"{low:g} to {high:g} deg")
        return replace(self, centre=math.fmod(front, 360.0), tilt=tilt)


#: Programs by name. Formulas: Unity's shader Skybox/Panoramic, Godot's PanoramaSkyMaterial,
#: three.js's equirectUv, and for USD OpenEXR's latitude-longitude maps (Technical Introduction to
#: OpenEXR, "Environment Maps"); Blender and Mitsuba were verified by rendering.
CONSUMERS: Final[dict[str, Consumer]] = {
    one.name: one
    for one in (
        Consumer(
            name="blender", title="Blender, environment texture of the world", axes=Z_UP,
            centre=90.0,
        ),
        Consumer(
            name="mitsuba", title="Mitsuba 3, envmap", axes=Y_UP, centre=180.0,
            rows_reach_poles=True,
        ),
        Consumer(name="usd", title="USD, DomeLight", axes=Y_UP, centre=180.0),
        Consumer(
            name="godot", title="Godot 4, PanoramaSkyMaterial", axes=Y_UP, centre=180.0,
            keeps_halves=True,
        ),
        Consumer(
            name="three", title="three.js, EquirectangularReflectionMapping", axes=Y_UP,
            centre=90.0, keeps_halves=True,
        ),
        Consumer(
            name="unity", title="Unity, Skybox/Panoramic", axes=Y_UP_LEFT_HANDED, centre=90.0,
            keeps_halves=True,
        ),
        Consumer(
            name="pbrt", title="PBRT 4, infinite light", projection="octahedral", axes=Z_UP,
            centre=0.0,
        ),
        Consumer(
            name="dome", title="fulldome, dome master", projection="fisheye", axes=Z_UP,
            centre=180.0, tilt=0.0,
        ),
    )
}  # fmt: skip


def consumer_named(name: str) -> Consumer:
    """Convention by name.

    Examples
    --------
    >>> consumer_named("mitsuba").direction(np.array([0.0, 1.0, 0.0])) + 0.0  # north
    array([ 0.,  0., -1.])
    """
    if name not in CONSUMERS:
        raise ParameterError("for", name, ", ".join(CONSUMERS))
    return CONSUMERS[name]
