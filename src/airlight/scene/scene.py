"""Scene: an observer, a sun and a camera."""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace
from datetime import datetime
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError, ParameterError
from airlight.geometry.ephemeris.instant import universal_time
from airlight.physics.units import Measure, Measured, measured, quantity
from airlight.scene.camera import Camera
from airlight.scene.compass import bearing
from airlight.scene.ground_detail import GROUNDS
from airlight.scene.light_position import LightPosition
from airlight.scene.limits import HIGHEST_ALTITUDE
from airlight.scene.observer import look_at as angles_of
from airlight.scene.observer import planet_frame
from airlight.scene.scene_fields import (
    ALTITUDE,
    LATITUDE,
    LONGITUDE,
    SUN_ZENITH,
    within_range,
)

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.planets.reading.reader import PlanetLike

#: Altitude of an observer on the ground, the default of scenes and commands. [m]
STANDING: Final = 2.0
_NUMBERS: Final = {
    "altitude": ALTITUDE,
    "sun_zenith": SUN_ZENITH,
    "latitude": LATITUDE,
    "longitude": LONGITUDE,
}


@dataclass(frozen=True, kw_only=True)
class Scene:
    """Observer, camera and direction of the sun; the planet comes with the solution.

    The defaults are those of the command line.

    Lengths and angles are numbers, text with a unit such as ``altitude="400 km"``, or quantities of
    pint, astropy or unyt.

    Parameters
    ----------
    camera : Camera
        Camera.
    altitude : float
        Altitude of the observer, up to 1e12, also outside the atmosphere. Below 0, down to the
        deepest basin of the planet, the observer stands on the basin's floor, see
        ``stands_on_floor``. An orthographic camera is at 1e12. [m]
    sun_zenith : float
        Zenith angle of the sun at the observer, 0 to 180. [deg]
    latitude, longitude : float
        Coordinates of the point below the observer, north and east positive; they position the map
        of the ground. [deg]
    sun_azimuth : float
        Compass bearing of the sun, 0 north and 90 east, or a point of the compass such as ``SW``;
        only the map of the ground depends on it. [deg]
    ground : str
        ``plain``, the map or the albedo alone, or ``detailed``, with procedural noise below the
        map's resolution.
    time : datetime, optional
        Instant of the scene, as metadata only; ``Scene.at`` positions sun and Moon by it.
    secondary_lights : tuple of LightPosition
        Lights other than the sun: a ``MoonLight``, a second star as ``StarLight``, or any other.

    Raises
    ------
    ParameterError
        With the field, the value and the allowed range.

    Examples
    --------
    >>> Scene(altitude=400e3, sun_zenith=90.0).sun_direction.round(12) + 0.0
    array([1., 0., 0.])
    """

    camera: Camera = field(default_factory=Camera)
    altitude: Measured[float] = measured(STANDING)
    sun_zenith: Measured[float] = measured(60.0)
    latitude: Measured[float] = measured(0.0)
    longitude: Measured[float] = measured(0.0)
    sun_azimuth: Measured[float] = measured(180.0)
    ground: str = "plain"
    time: datetime | None = None
    secondary_lights: tuple[LightPosition, ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.camera, Camera):
            raise ParameterError("scene.camera", self.camera, "a Camera")
        if self.ground not in GROUNDS:
            raise ParameterError("scene.ground", self.ground, ", ".join(GROUNDS))
        secondary_lights = tuple(self.secondary_lights)
        if not all(isinstance(one, LightPosition) for one in secondary_lights):
            raise ParameterError(
                "scene.secondary_lights", secondary_lights, "lights such as MoonLight"
            )
        object.__setattr__(self, "secondary_lights", secondary_lights)
        for name, declared in _NUMBERS.items():
            value = within_range(f"scene.{name}", getattr(self, name), declared)
            object.__setattr__(self, name, value)
        azimuth = bearing(self.sun_azimuth, "scene.sun_azimuth")
        object.__setattr__(self, "sun_azimuth", azimuth)
        if self.camera.parallel:
            if self.altitude not in (0.0, STANDING, HIGHEST_ALTITUDE):
                raise ConflictError("scene.altitude", "does not apply to an orthographic camera")
            object.__setattr__(self, "altitude", HIGHEST_ALTITUDE)

    @classmethod
    def at(
        cls,
        planet: PlanetLike,
        *,
        latitude: Measure,
        longitude: Measure,
        time: datetime | str,
        zone: str | None = None,
        season: Measure | None = None,
        altitude: Measure = STANDING,
        look_at: str | None = None,
        camera: Camera | None = None,
        ground: str = "plain",
    ) -> Scene:
        """Scene at a place and time, with sun and, on Earth, Moon by ephemeris.

        Parameters
        ----------
        planet : Planet, str, Path or Solution
            Planet whose ``body`` is known, see ``load_planet``. Its light at that time is
            ``planet.lit_at(scene.time)``.
        latitude, longitude : float
            Place, north and east positive: on Earth geographic, elsewhere planetocentric. [deg]
        time : datetime or str
            Instant with its zone, or a text such as ``"2026-06-21T22:10+02:00"`` or
            ``"2026-06-21 sunset"``; see ``airlight.geometry.ephemeris.time_text.read_time``.
        zone, season : optional
            Zone and longitude Ls of the sun [deg] that a text refers to; see ``read_time``.
        altitude : float, optional
            Altitude of the observer, 2 by default. [m]
        look_at : str, optional
            Target of the camera: ``sun`` or ``moon`` at their apparent positions, a compass
            bearing, or another target of ``look_at``; by default the camera's own angles, with
            azimuth 0 on the sun's side.
        camera : Camera, optional
            Camera.
        ground : str
            ``plain`` or ``detailed``.

        Raises
        ------
        ParameterError
            If the planet has no ``body``, or a value is invalid.

        Examples
        --------
        >>> from airlight.planets import load_planet
        >>> scene = Scene.at(
        ...     load_planet("earth"), latitude=59.33, longitude=18.07,
        ...     time="2026-06-21T22:10+02:00", look_at="N")
        >>> f"{scene.sun_zenith:.2f} {scene.sun_azimuth:.1f} {scene.camera.look_azimuth:.1f}"
        '90.97 323.9 36.1'
        """
        from airlight.geometry.ephemeris.instant import days_of
        from airlight.geometry.ephemeris.sky import Place, moon_after, sun_after
        from airlight.geometry.ephemeris.time_text import read_time
        from airlight.planets.reading.reader import load_planet
        from airlight.scene.moon_light import MoonLight

        planet = load_planet(planet)
        place = Place(
            body=planet.world.name,
            latitude=quantity(latitude, "deg", "latitude", bare=True),
            longitude=quantity(longitude, "deg", "longitude", bare=True),
            altitude=altitude,
        )
        altitude = place.altitude
        moment = read_time(time, place, zone=zone, season=season) if isinstance(time, str) else time
        days = days_of(moment)
        sun = sun_after(place, days)
        moon = moon_after(place, days) if place.world.has_moon else None
        scene = cls(
            camera=camera if camera is not None else Camera(),
            altitude=altitude,
            sun_zenith=sun.zenith,
            sun_azimuth=sun.azimuth,
            latitude=place.latitude,
            longitude=place.longitude,
            ground=ground,
            time=moment,
            secondary_lights=() if moon is None else (MoonLight.seen(moon, sun.azimuth),),
        )
        return scene if look_at is None else scene.aimed(look_at, planet)

    def aimed(self, target: str, planet: Planet) -> Scene:
        """Scene whose camera looks at a target.

        Parameters
        ----------
        target : str
            Target of ``look_at``; ``moon`` by the scene's time.
        planet : Planet
            Planet, whose ground is the horizon and whose atmosphere refracts.

        Raises
        ------
        ParameterError
            If the target is unknown.
        """
        from airlight.geometry.ephemeris.sky import Place, moon_seen

        moon = None
        if target == "moon" and self.time is not None and planet.world.has_moon:
            place = Place(
                body=planet.world.name,
                latitude=self.latitude,
                longitude=self.longitude,
                altitude=self.altitude,
            )
            seen = moon_seen(place, self.time)
            moon = seen.zenith, seen.azimuth
        zenith, azimuth = angles_of(
            target,
            altitude=max(self.altitude, 0.0),
            sun_zenith=self.sun_zenith,
            bottom_radius=planet.bottom_radius,
            sun_azimuth=self.sun_azimuth,
            moon=moon,
            planet=planet,
        )
        camera = replace(self.camera, look_zenith=zenith, look_azimuth=azimuth)
        return replace(self, camera=camera)

    @property
    def lights(self) -> tuple[LightPosition, ...]:
        """All lights: the sun, at azimuth 0, then the secondary lights."""
        sun = LightPosition(zenith=self.sun_zenith)
        return (sun, *(one.relative_to(sun) for one in self.secondary_lights))

    def with_light(self, light: LightPosition) -> Scene:
        """Single-light scene in the frame of that light, at azimuth 0.

        Parameters
        ----------
        light : LightPosition
            Light of the scene, or any other.

        Examples
        --------
        >>> turned = Scene().with_light(LightPosition(zenith=30.0, azimuth=90.0))
        >>> turned.sun_zenith, turned.camera.look_azimuth, turned.sun_azimuth
        (30.0, -90.0, -90.0)
        """
        if light.azimuth == 0.0 and light.zenith == self.sun_zenith and not self.secondary_lights:
            return self
        return replace(
            self,
            secondary_lights=(),
            sun_zenith=light.zenith,
            sun_azimuth=math.remainder(self.sun_azimuth + light.azimuth, 360.0),
            camera=replace(
                self.camera,
                look_azimuth=math.remainder(self.camera.look_azimuth - light.azimuth, 360.0),
            ),
        )

    def on_basin_floor(self, planet: Planet) -> tuple[Planet, Scene]:
        """Planet with its ground lowered to an observer at negative altitude, and the scene there.

        Both are unchanged for altitudes of 0 or more.

        Parameters
        ----------
        planet : Planet

        Raises
        ------
        ParameterError
            If the altitude is below the planet's deepest basin.

        Examples
        --------
        >>> from airlight.planets import load_planet
        >>> planet, scene = Scene(altitude=-7e3).on_basin_floor(load_planet("mars"))
        >>> planet.bottom_radius, scene.altitude
        (3382498.0, 2.0)
        """
        if self.altitude >= 0.0:
            return planet, self
        from airlight.planets.lowered_ground import stands_on_floor

        planet, height = stands_on_floor(planet, self.altitude)
        return planet, replace(self, altitude=height)

    def north_up(self) -> Scene:
        """Scene of a nadir-looking camera with north up.

        Examples
        --------
        >>> camera = Camera(look_zenith=180.0)
        >>> Scene(camera=camera, sun_azimuth=105.0).north_up().camera.look_azimuth
        -105.0
        """
        north = math.remainder(-self.sun_azimuth, 360.0)
        return replace(self, camera=replace(self.camera, look_azimuth=north))

    @property
    def place(self) -> tuple[float, float, float]:
        """Latitude and longitude [deg], and altitude [m], of the observer."""
        return self.latitude, self.longitude, self.altitude

    @property
    def sun_direction(self) -> NDArray[np.float64]:
        """Unit vector towards the sun in the local frame, shape (3,). [1]"""
        return LightPosition(zenith=self.sun_zenith).direction

    @property
    def ground_frame(self) -> NDArray[np.float64]:
        """Rotation from the local to the planet's frame, shape (3, 3): ``planet = m @ local``."""
        return planet_frame(self.latitude, self.longitude, self.sun_azimuth)

    def metadata(self) -> dict[str, str]:
        """Metadata for file headers, with units.

        Examples
        --------
        >>> Scene(altitude=400e3).metadata()["altitude"]
        '400000 m'
        """
        camera = self.camera
        moment = {} if self.time is None else {"time": universal_time(self.time)}
        angle = camera.polariser
        behind = {} if angle is None else {"polariser": f"{angle:.10g} deg"}
        if camera.dehaze > 0.0:
            behind["dehaze"] = f"{camera.dehaze:g}"
        window = {} if camera.crop is None else {"crop": ",".join(map(str, camera.crop))}
        secondary_lights = {
            f"light_{k}": one.metadata() for k, one in enumerate(self.secondary_lights, start=2)
        }
        return {
            **moment,
            **secondary_lights,
            "altitude": f"{self.altitude:.10g} m",
            "sun_zenith": f"{self.sun_zenith:.10g} deg",
            "latitude": f"{self.latitude:.10g} deg",
            "longitude": f"{self.longitude:.10g} deg",
            "sun_azimuth": f"{self.sun_azimuth:.10g} deg",
            "ground": self.ground,
            "projection": camera.projection,
            "size": f"{camera.width}x{camera.height}",
            "field_of_view": f"{camera.field_of_view:.10g} deg",
            "look": f"{camera.look_zenith:.10g},{camera.look_azimuth:.10g} deg",
            "roll": f"{camera.roll:.10g} deg",
            **behind,
            **window,
        }
