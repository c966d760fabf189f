"""Table ``[view]`` of a film file: observer, sun and camera."""

from __future__ import annotations

from datetime import datetime
from typing import Any

import numpy as np

from airlight.errors import ConflictError
from airlight.planets.parameters import parameters, replace
from airlight.planets.planet import Planet
from airlight.planets.schema.field import key
from airlight.planets.schema.toml_model import TomlModel
from airlight.render.star_points import check_stars
from airlight.scene import Camera, Scene
from airlight.scene.directions import camera_angles, camera_axes
from airlight.scene.projections import PROJECTIONS
from airlight.scene.projections.orthographic import disc_extent
from airlight.scene.scene_fields import (
    ALTITUDE,
    DEHAZE,
    EXTENT,
    FIELD_OF_VIEW,
    GROUND,
    LATITUDE,
    LONGITUDE,
    LOOK_AZIMUTH,
    LOOK_BEARING,
    LOOK_ZENITH,
    POLARISER,
    PROJECTION,
    ROLL,
    SUN_AZIMUTH,
    SUN_ZENITH,
)


@parameters
class PlanetView(TomlModel):
    """Observer, sun and camera of a single-planet film.

    Parameters
    ----------
    latitude, longitude : float
        Coordinates of the observer, north and east positive. [deg]
    altitude : float
        Altitude of the observer. [m]
    sun_zenith, sun_azimuth : float, optional
        Zenith angle and compass bearing of the sun, for films without a clock. [deg]
    look_at : str, optional
        Target as for ``airlight.scene.look_at``; ``horizon`` by default.
    look_zenith, look_azimuth : float, optional
        Alternative to ``look_at``: zenith angle, and azimuth from the sun's side. [deg]
    look_bearing : float, optional
        Compass bearing, alternative to ``look_azimuth``. [deg]
    dome_tilt : float, optional
        Tilt of a dome whose front is the line of sight: the camera looks higher by its complement.
        [deg]
    roll : float
        Clockwise rotation of the camera. [deg]
    polariser : float, optional
        Axis of a polarising filter, counterclockwise from the camera's up. [deg]
    dehaze : float
        Fraction of the haze that pictures from space leave out, see ``Camera``. [1]
    field_of_view : float, optional
        Angle as for ``Camera``. [deg]
    extent : float, optional
        Length from left to right for an orthographic camera, by default the whole disc. [m]
    ground : str
        ``plain`` or ``detailed``.
    stars : bool
        Whether the star catalogue is rendered.
    """

    latitude: float = key(LATITUDE, default=25.0)
    longitude: float = key(LONGITUDE, default=30.0)
    altitude: float = key(
        ALTITUDE,
        note="Below 0, down to the planet's deepest basin, on the floor of a basin. Not for"
        " `orthographic`.",
        default=2.0,
    )
    sun_zenith: float | None = key(
        SUN_ZENITH, note="Beyond 90 deg it has set; 72 deg without a time.", default=None
    )
    sun_azimuth: float | None = key(SUN_AZIMUTH, note="105 deg without a time.", default=None)
    look_at: str | None = key(
        label="look at",
        help="`horizon`, `zenith`, `nadir`, `sun`, `moon` by time, or"
        " a bearing: `NE`, `315/20`; default: the horizon below the sun.",
        kind="text",
        range=(1, 40),
        example="W",
        default=None,
    )
    look_zenith: float | None = key(LOOK_ZENITH, default=None)
    look_azimuth: float | None = key(LOOK_AZIMUTH, default=None)
    look_bearing: float | None = key(LOOK_BEARING, label="look bearing", default=None)
    dome_tilt: float | None = key(
        label="dome tilt",
        help="Tilt of a dome whose front is the line of sight: 0 looks 90 deg higher.",
        unit="deg",
        range=(0.0, 90.0),
        example="20 deg",
        default=None,
    )
    roll: float = key(ROLL, default=0.0)
    polariser: float | None = key(POLARISER, default=None)
    dehaze: float = key(DEHAZE, default=DEHAZE.initial)
    projection: str = key(PROJECTION, default="perspective")
    field_of_view: float | None = key(FIELD_OF_VIEW, default=None)
    extent: float | None = key(EXTENT, default=None)
    ground: str = key(GROUND, default="detailed")
    stars: bool = key(
        label="stars",
        help="Stars to magnitude 6.5, by time or by the position of the sun.",
        kind="switch",
        default=False,
    )

    def __post_init__(self) -> None:
        if self.look_at is not None:
            for name in ("look_zenith", "look_azimuth", "look_bearing"):
                if getattr(self, name) is not None:
                    raise ConflictError(name, "cannot be combined with look_at")
        if self.look_azimuth is not None and self.look_bearing is not None:
            raise ConflictError("look_bearing", "cannot be combined with look_azimuth")

    def scene(self, planet: Planet, time: datetime | None, width: int, height: int) -> Scene:
        """Scene of the view.

        Parameters
        ----------
        time : datetime, optional
            Instant that determines the position of the sun.
        width, height : int
            Size of the frame. [pixel]
        """
        parallel, extent = PROJECTIONS[self.projection].parallel, self.extent
        if parallel and extent is None:
            extent = disc_extent(planet.top_radius, width, height)
        if self.stars:
            check_stars(planet.body, self.projection)
        camera = Camera(
            projection=self.projection,
            width=width,
            height=height,
            roll=self.roll,
            field_of_view=self.field_of_view,
            look_zenith=self.look_zenith,
            look_azimuth=self.look_azimuth or 0.0,
            polariser=self.polariser,
            dehaze=self.dehaze,
            extent=extent,
        )
        looks = (self.look_zenith, self.look_azimuth, self.look_bearing)
        upright = parallel and looks[1:] == (None, None) and self.look_at is None
        standing = parallel and self.altitude == type(self).altitude
        altitude = 0.0 if standing else self.altitude
        target = self.look_at
        if target is None and looks == (None, None, None) and self.projection == "perspective":
            target = "horizon"
        place: dict[str, Any] = {
            "latitude": self.latitude,
            "longitude": self.longitude,
            "altitude": altitude,
            "camera": camera,
            "ground": self.ground,
        }
        if time is not None:
            for name in ("sun_zenith", "sun_azimuth"):
                if getattr(self, name) is not None:
                    raise ConflictError(name, "cannot be combined with a time")
            scene = Scene.at(planet, time=time, **place)
        else:
            sun_zenith = 72.0 if self.sun_zenith is None else self.sun_zenith
            sun_azimuth = 105.0 if self.sun_azimuth is None else self.sun_azimuth
            scene = Scene(sun_zenith=sun_zenith, sun_azimuth=sun_azimuth, **place)
        if target is not None:
            scene = scene.aimed(target, planet)
        if self.look_bearing is not None:
            turn = (self.look_bearing - scene.sun_azimuth) % 360.0
            scene = replace(scene, camera=replace(scene.camera, look_azimuth=turn))
        if self.dome_tilt is not None:
            scene = replace(scene, camera=_pitched(scene.camera, 90.0 - self.dome_tilt))
        return scene.north_up() if upright else scene


def _pitched(camera: Camera, angle: float) -> Camera:
    """Camera that looks higher by an angle [deg] about its own horizontal axis."""
    right, up, forward = camera_axes(camera.look_zenith or 0.0, camera.look_azimuth, camera.roll)
    sine, cosine = np.sin(np.radians(angle)), np.cos(np.radians(angle))
    axes = np.stack([right, cosine * up - sine * forward, cosine * forward + sine * up])
    zenith, azimuth, roll = camera_angles(axes)
    return replace(camera, look_zenith=zenith, look_azimuth=azimuth % 360.0, roll=roll)
