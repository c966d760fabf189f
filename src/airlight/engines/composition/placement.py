"""Placement of a scene on a planet: origin, orientation and sun."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.engines.composition.pinhole import Pinhole
from airlight.errors import ParameterError
from airlight.physics.units import Measure, Measured, measured
from airlight.scene import Camera, Scene
from airlight.scene.compass import bearing
from airlight.scene.directions import camera_angles
from airlight.scene.limits import HIGHEST_ALTITUDE, within
from airlight.scene.observer import planet_frame

FloatArray = NDArray[np.float64]

#: Names of a scene's vertical axis.
UPS: Final = ("z", "y")
#: Keys of the block ``airlight`` of a camera's file, and the fields they fill.
KEYS: Final = {
    "lat": "latitude",
    "lon": "longitude",
    "alt": "altitude",
    "heading": "heading",
    "metres_per_unit": "metres_per_unit",
    "up": "up",
    "sun_zenith": "sun_zenith",
    "sun_azimuth": "sun_azimuth",
}
#: Smallest altitude of a camera that counts as being on the ground. [m]
_BELOW: Final = -1e-3


@dataclass(frozen=True, kw_only=True)
class Placement:
    """Position and orientation of a scene on a planet, with the direction of the sun.

    Parameters
    ----------
    latitude, longitude : float
        Coordinates of the point below the origin, north and east positive. [deg]
    altitude : float
        Altitude of the origin above the planet's ground. [m]
    heading : float
        Compass bearing of the scene's +Y (-Z where Y is up): 0 north, 90 east, or a point of the
        compass such as ``NE``. [deg]
    metres_per_unit : float
        Length of the scene's unit. [m]
    up : str
        Vertical axis of the scene: ``z`` (Blender) or ``y`` (glTF, Maya, Houdini).
    sun_zenith, sun_azimuth : float
        Zenith angle and compass bearing of the sun at the origin. [deg]

    Raises
    ------
    ParameterError
        With the field, the value and the allowed range.

    Examples
    --------
    >>> Placement(heading=90.0).to_east_north_up.round(12) @ [0.0, 1.0, 0.0] + 0.0  # +Y is east
    array([1., 0., 0.])
    """

    latitude: Measured[float] = measured(0.0)
    longitude: Measured[float] = measured(0.0)
    altitude: Measured[float] = measured(0.0)
    heading: Measured[float] = measured(0.0)
    metres_per_unit: Measured[float] = measured(1.0)
    up: str = "z"
    sun_zenith: Measured[float] = measured(60.0)
    sun_azimuth: Measured[float] = measured(180.0)

    def __post_init__(self) -> None:
        if self.up not in UPS:
            raise ParameterError("up", self.up, " or ".join(UPS))
        for name, low, high, unit in (
            ("latitude", -90.0, 90.0, "deg"),
            ("longitude", -360.0, 360.0, "deg"),
            ("altitude", -HIGHEST_ALTITUDE, HIGHEST_ALTITUDE, "m"),
            ("metres_per_unit", 1e-9, 1e12, "m"),
            ("sun_zenith", 0.0, 180.0, "deg"),
        ):
            object.__setattr__(self, name, within(name, getattr(self, name), low, high, unit))
        for name in ("heading", "sun_azimuth"):
            object.__setattr__(self, name, bearing(getattr(self, name), name))

    @classmethod
    def from_block(cls, block: dict[str, Any], **given: Measure | None) -> Placement:
        """Placement from the block ``airlight`` of a camera file.

        Parameters
        ----------
        block : dict
            Values by the names of ``KEYS``; ``planet`` is ignored.
        **given : float or str
            Overrides of the block, if not None.

        Raises
        ------
        ParameterError
            If a key is unknown, or a value out of range.
        """
        for key in block:
            if key not in KEYS and key != "planet":
                raise ParameterError(f"airlight.{key}", block[key], f"planet, {', '.join(KEYS)}")
        values = {KEYS[key]: value for key, value in block.items() if key in KEYS}
        values |= {name: value for name, value in given.items() if value is not None}
        try:
            return cls(**values)
        except ParameterError as error:
            named = {field: key for key, field in KEYS.items()}
            if error.field in named and given.get(error.field) is None:
                field = f"airlight.{named[error.field]}"
                raise error.named(field) from None
            raise

    @property
    def to_east_north_up(self) -> FloatArray:
        """Rotation from scene axes to east, north, up at the origin, shape (3, 3). [1]"""
        turn = math.radians(self.heading)
        cosine, sine = math.cos(turn), math.sin(turn)
        level = np.array([[cosine, sine, 0.0], [-sine, cosine, 0.0], [0.0, 0.0, 1.0]])
        if self.up == "z":
            return level
        upright = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
        return np.asarray(level @ upright)

    @property
    def sun(self) -> FloatArray:
        """Unit vector towards the sun in ENU at the origin, shape (3,). [1]"""
        flat, turn = math.sin(math.radians(self.sun_zenith)), math.radians(self.sun_azimuth)
        up = math.cos(math.radians(self.sun_zenith))
        return np.array([flat * math.sin(turn), flat * math.cos(turn), up])


@dataclass(frozen=True, eq=False)
class PinholeView:
    """Pinhole camera on a planet.

    Attributes
    ----------
    scene : Scene
        Scene with a camera that covers the image, with square pixels of width ``1 / focal_x``.
    left, top, stretch : float
        Position of the image in the frame: column x and row y of the image are at ``left + x`` and
        ``top + stretch·y``. [pixel]
    axes : array, shape (3, 3)
        Right, up and forward of the camera in the observer's local frame, as rows. [1]
    """

    scene: Scene
    left: float
    top: float
    stretch: float
    axes: FloatArray


def pinhole_view(camera: Pinhole, place: Placement, bottom_radius: float) -> PinholeView:
    """Pinhole camera of a scene placed on a planet.

    Positions are float64, relative to the ground below the origin, which preserves millimetres.

    Parameters
    ----------
    place : Placement
        Place of the scene's origin.
    bottom_radius : float
        Radius of the ground. [m]

    Returns
    -------
    PinholeView
        View, with the direction of the sun at the camera.
    """
    east, north, rise = place.metres_per_unit * (place.to_east_north_up @ camera.position)
    high = place.altitude + rise
    from_centre = np.array([east, north, bottom_radius + high])
    r = float(np.linalg.norm(from_centre))
    # h = (r² - R²)/(r + R), in which r² - R² does not cancel
    altitude = (east**2 + north**2 + high * (2.0 * bottom_radius + high)) / (r + bottom_radius)
    if altitude < _BELOW:
        allowed = "0 m or above: raise the altitude of the scene's origin"
        raise ParameterError("camera's altitude", f"{altitude:.6g} m", allowed)
    up = from_centre / r
    axes = camera.axes @ place.to_east_north_up.T  # rows: east, north, up at the origin
    # frame of the observer: x level towards the sun, z up
    sun = place.sun
    level = sun - (sun @ up) * up
    if np.linalg.norm(level) < 1e-9:
        level = np.array([0.0, 1.0, 0.0]) - up[1] * up
    x = level / np.linalg.norm(level)
    frame = np.array([x, np.cross(up, x), up])
    local = axes @ frame.T
    latitude, longitude, bearing = _coordinates(place, up, sun)
    # a symmetric picture around the principal point that contains the whole picture
    centre_x, centre_y = camera.centre
    stretch = camera.focal_x / camera.focal_y
    wide = 2.0 * max(centre_x, camera.width - centre_x)
    tall = 2.0 * stretch * max(centre_y, camera.height - centre_y)
    width, height = max(1, math.ceil(wide)), max(1, math.ceil(tall))
    zenith, azimuth, roll = camera_angles(local)
    seen = Camera(
        width=width,
        height=height,
        look_zenith=zenith,
        look_azimuth=azimuth,
        roll=roll,
        field_of_view=math.degrees(2.0 * math.atan(0.5 * width / camera.focal_x)),
    )
    scene = Scene(
        camera=seen,
        altitude=max(altitude, 0.0),
        sun_zenith=math.degrees(math.atan2(float(np.linalg.norm(np.cross(sun, up))), sun @ up)),
        latitude=latitude,
        longitude=longitude,
        sun_azimuth=bearing,
    )
    return PinholeView(
        scene=scene,
        left=0.5 * width - centre_x,
        top=0.5 * height - stretch * centre_y,
        stretch=stretch,
        axes=scene.camera.axes,
    )


def _coordinates(place: Placement, up: FloatArray, sun: FloatArray) -> tuple[float, float, float]:
    """Latitude and longitude of the camera, and bearing of the sun there. [deg]"""

    def turned(vector: FloatArray) -> FloatArray:
        # local frames of a star in the north have x to the north and y to the west
        return np.array([vector[1], -vector[0], vector[2]])

    to_planet = planet_frame(place.latitude, place.longitude, 0.0)
    x, y, z = to_planet @ turned(up)
    latitude = math.degrees(math.atan2(z, math.hypot(x, y)))
    longitude = math.degrees(math.atan2(y, x))
    north, west, _ = planet_frame(latitude, longitude, 0.0).T @ to_planet @ turned(sun)
    return latitude, longitude, math.degrees(math.atan2(-west, north))
