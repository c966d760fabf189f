"""Table ``[view]`` of a film file: observer, sun and camera."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from airlight.errors import ConflictError
from airlight.planets.parameters import parameters
from airlight.planets.planet import Planet
from airlight.planets.schema.field import key
from airlight.planets.schema.toml_model import TomlModel
from airlight.render.star_points import check_stars
from airlight.scene import Camera, Scene
from airlight.scene.projections import PROJECTIONS
from airlight.scene.projections.orthographic import disc_extent
from airlight.scene.scene_fields import (
    ALTITUDE,
    EXTENT,
    FIELD_OF_VIEW,
    GROUND,
    LATITUDE,
    LONGITUDE,
    LOOK_AZIMUTH,
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
    roll : float
        Clockwise rotation of the camera. [deg]
    polariser : float, optional
        Axis of a polarising filter, counterclockwise from the camera's up. [deg]
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
    roll: float = key(ROLL, default=0.0)
    polariser: float | None = key(POLARISER, default=None)
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
            for name in ("look_zenith", "look_azimuth"):
                if getattr(self, name) is not None:
                    raise ConflictError(name, "cannot be combined with look_at")

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
            extent=extent,
        )
        upright = parallel and self.look_azimuth is None and self.look_at is None
        standing = parallel and self.altitude == type(self).altitude
        altitude = 0.0 if standing else self.altitude
        given = (self.look_zenith, self.look_azimuth) != (None, None)
        target = self.look_at
        if target is None and not given and self.projection == "perspective":
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
        return scene.north_up() if upright else scene
