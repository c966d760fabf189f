"""Observer and camera of a scene."""

from __future__ import annotations

from airlight.errors import ConflictError, ParameterError
from airlight.planets.parameters import MISSING, parameters
from airlight.planets.schema.field import key
from airlight.planets.schema.toml_model import TomlModel
from airlight.scene.camera import Camera
from airlight.scene.limits import HIGHEST_ALTITUDE
from airlight.scene.scene_fields import (
    ALTITUDE,
    DEHAZE,
    FIELD_OF_VIEW,
    LATITUDE,
    LONGITUDE,
    LOOK_BEARING,
    LOOK_ZENITH,
    NEAR_PROJECTION,
    POLARISER,
    ROLL,
)
from airlight.scene.system.vectors import POSITION, unit


@parameters
class SceneObserver(TomlModel):
    """Position of the observer: above a body, or free.

    Parameters
    ----------
    body : str, optional
        Name of the body that ``latitude``, ``longitude`` and ``altitude`` refer to.
    latitude, longitude : float
        Planetocentric coordinates, north and east positive. [deg]
    altitude : float
        Altitude above the ground. [m]
    position : tuple of float, optional
        Coordinates in the frame of the scene, instead of a body. [m]
    """

    body: str | None = key(
        label="body",
        help="Body above which the observer is.",
        kind="text",
        range=(1, 60),
        example="earth",
        default=None,
    )
    latitude: float = key(LATITUDE, help="Planetocentric latitude, north positive.", default=0.0)
    longitude: float = key(LONGITUDE, help="Planetocentric longitude, east positive.", default=0.0)
    altitude: float = key(ALTITUDE, range=(0.0, HIGHEST_ALTITUDE), default=2.0)
    position: tuple[float, ...] | None = key(POSITION, default=None)

    def __post_init__(self) -> None:
        if (self.body is None) == (self.position is None):
            given = MISSING if self.body is None else "body and position"
            raise ParameterError("body", given, "one of body and position")
        if self.position is not None and len(self.position) != 3:
            raise ParameterError("position", self.position, "three lengths")


@parameters
class View(TomlModel):
    """Orientation and projection of the camera.

    Parameters
    ----------
    look_at : str, optional
        Name of the body or star at the centre of the frame.
    look_zenith, look_bearing : float, optional
        Zenith angle and compass bearing, for an observer above a body. [deg]
    direction : tuple of float, optional
        Direction in the frame of the scene.
    up : tuple of float, optional
        Direction that is up in the frame; by default the zenith of an observer above a body, else
        z.
    roll : float
        Clockwise rotation of the camera about its line of sight. [deg]
    polariser : float, optional
        Axis of a polarising filter, counterclockwise from the camera's up. [deg]
    dehaze : float
        Fraction of the haze that pictures from space leave out, see ``Camera``. [1]
    field_of_view : float, optional
        Angle as for ``Camera``. [deg]
    """

    look_at: str | None = key(
        label="look at",
        help="Body or star at the centre of the picture.",
        kind="text",
        range=(1, 60),
        example="moon",
        default=None,
    )
    look_zenith: float | None = key(LOOK_ZENITH, default=None)
    look_bearing: float | None = key(LOOK_BEARING, default=None)
    direction: tuple[float, ...] | None = key(
        label="direction",
        help="Direction of the line of sight.",
        range=(-1e12, 1e12),
        listed=True,
        example="[1, 0, 0]",
        default=None,
    )
    up: tuple[float, ...] | None = key(
        label="up",
        help="Direction that is up in the picture.",
        range=(-1e12, 1e12),
        listed=True,
        example="[0, 0, 1]",
        default=None,
    )
    roll: float = key(ROLL, default=0.0)
    polariser: float | None = key(POLARISER, default=None)
    dehaze: float = key(DEHAZE, default=0.0)
    projection: str = key(NEAR_PROJECTION, default="perspective")
    field_of_view: float | None = key(FIELD_OF_VIEW, default=None)

    def __post_init__(self) -> None:
        ways = {
            "look_at": self.look_at is not None,
            "direction": self.direction is not None,
            "look_zenith and look_bearing": self.look_zenith is not None
            or self.look_bearing is not None,
        }
        given = [name for name, there in ways.items() if there]
        if len(given) != 1:
            shown = " and ".join(given) if given else MISSING
            raise ParameterError("look_at", shown, f"one of {', '.join(ways)}")
        if given[0].startswith("look_zenith"):
            for name, other in (("look_zenith", "look_bearing"), ("look_bearing", "look_zenith")):
                if getattr(self, name) is None:
                    raise ConflictError(other, f"requires {name}")
        if self.direction is not None:
            unit(self.direction, "direction")
        if self.up is not None:
            unit(self.up, "up")

    def camera(self, width: int, height: int, crop: tuple[int, int, int, int] | None) -> Camera:
        """Camera of a frame's size [pixel], oriented by ``System.camera_axes``."""
        return Camera(
            projection=self.projection,
            width=width,
            height=height,
            polariser=self.polariser,
            dehaze=self.dehaze,
            field_of_view=self.field_of_view,
            crop=crop,
        )
