"""Sun and moon in the sky of a place: direction, distance, size, phase."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.instant import days_of, ephemeris_time
from airlight.geometry.ephemeris.sun_vector import SolarPoint, meridian_axes, solar_point
from airlight.geometry.ephemeris.world import World, world_named
from airlight.physics.constants import ASTRONOMICAL_UNIT, SOLAR_RADIUS
from airlight.physics.units import Measured, measured, quantity

#: Days of a year and a half at which the sun's declination is computed.
_DAYS: Final = 150
#: Mean radius of the moon. [m] Archinal et al. (2018), Table 5.
MOON_RADIUS: Final = 1737.4e3


@dataclass(frozen=True, kw_only=True)
class Place:
    """Place on a world.

    Parameters
    ----------
    body : str
        Name of the world, from ``WORLDS``.
    latitude : float
        Latitude, north positive, -90 to 90: on Earth geographic, elsewhere planetocentric. [deg]
    longitude : float
        Longitude, east positive, -360 to 360. [deg]
    altitude : float
        Altitude above the ground, for the Moon's parallax. [m]

    Raises
    ------
    ParameterError
        With the field, the value and the allowed range.
    """

    body: str = "earth"
    latitude: float
    longitude: float
    altitude: Measured[float] = measured(0.0)

    def __post_init__(self) -> None:
        world_named(self.body)
        for name, limit in (("latitude", 90.0), ("longitude", 360.0)):
            allowed = f"{-limit:g} to {limit:g} deg"
            value = quantity(getattr(self, name), "deg", name, bare=True, allowed=allowed)
            if not -limit <= value <= limit:
                raise ParameterError(name, value, allowed)
            object.__setattr__(self, name, value)
        bare = not isinstance(self.altitude, str)
        object.__setattr__(self, "altitude", quantity(self.altitude, "m", "altitude", bare=bare))

    @property
    def world(self) -> World:
        """World of the place."""
        return world_named(self.body)


@dataclass(frozen=True, kw_only=True)
class Sighting:
    """Disc in the sky of a place, without refraction.

    Attributes
    ----------
    altitude : float
        True altitude of its centre above the horizontal, -90 to 90. [deg]
    azimuth : float
        Compass bearing, 0 north and 90 east, 0 to 360. [deg]
    distance : float
        Distance of its centre. [m]
    radius : float
        Radius of the body. [m]
    """

    altitude: float
    azimuth: float
    distance: float
    radius: float

    @property
    def zenith(self) -> float:
        """True zenith angle. [deg]"""
        return 90.0 - self.altitude

    @property
    def angular_radius(self) -> float:
        """Angular radius of its disc. [deg]"""
        return math.degrees(math.asin(self.radius / self.distance))

    @property
    def direction(self) -> NDArray[np.float64]:
        """Unit vector east, north, up; shape (3,). [1]"""
        up, turn = math.radians(self.altitude), math.radians(self.azimuth)
        flat = math.cos(up)
        return np.array([flat * math.sin(turn), flat * math.cos(turn), math.sin(up)])


@dataclass(frozen=True, kw_only=True)
class MoonSighting(Sighting):
    """Moon in the sky of a place on Earth.

    Attributes
    ----------
    phase_angle : float
        Angle between sun and Earth, seen from the Moon: 0 full, 180 new. [deg]
    lit : float
        Illuminated fraction of its disc. [1]
    waxing : bool
        Whether the illuminated fraction increases.
    north : float
        Position angle of its north, clockwise from the zenith. [deg]
    near_latitude, near_longitude : float
        Selenographic coordinates of the centre of its disc, with libration and parallax; north and
        east positive. [deg]
    """

    phase_angle: float
    lit: float
    waxing: bool
    north: float
    near_latitude: float
    near_longitude: float


def sun_seen(place: Place, time: datetime) -> Sighting:
    """Sun in the sky of a place.

    Parameters
    ----------
    place : Place
        Place on any of the worlds.
    time : datetime
        Instant with its zone, in local time without light travel.

    Returns
    -------
    Sighting
        Apparent position (aberration, parallax on Earth) without refraction; on Earth within 0.01°
        of JPL's DE421 from 1975 to 2026.

    Raises
    ------
    ParameterError
        If the time has no zone or lies outside the years 1700 to 2199.

    Examples
    --------
    >>> from datetime import UTC
    >>> noon = sun_seen(Place(latitude=0.0, longitude=0.0), datetime(2026, 3, 20, 12, tzinfo=UTC))
    >>> f"{noon.altitude:.1f}"  # the equinox; the clock is 7.5 minutes ahead of the sun
    '88.1'
    """
    return sun_after(place, days_of(time))


def sun_after(place: Place, days: float) -> Sighting:
    """Sun some days after 2000-01-01 12:00 UTC; as ``sun_seen``."""
    if place.body == "earth":
        from astronomy import Body

        return Sighting(**_seen_from_earth(Body.Sun, place, days), radius=SOLAR_RADIUS)
    point = solar_point(place.world, days)
    altitude, azimuth = _horizontal(place, point)
    return Sighting(
        altitude=altitude, azimuth=azimuth, distance=point.distance, radius=SOLAR_RADIUS
    )


def moon_seen(place: Place, time: datetime) -> MoonSighting:
    """Topocentric Moon in the sky of a place on Earth.

    Parameters
    ----------
    place, time :
        As for ``sun_seen``.

    Raises
    ------
    ParameterError
        If the place is not on Earth, or the time is out of range.
    """
    return moon_after(place, days_of(time))


def moon_after(place: Place, days: float) -> MoonSighting:
    """Moon some days after 2000-01-01 12:00 UTC; as ``moon_seen``."""
    if not place.world.has_moon:
        raise ParameterError("body", place.body, "earth")
    from astronomy import Body, Illumination, MoonPhase

    time = ephemeris_time(days)
    light = Illumination(Body.Moon, time)
    seen = Sighting(**_seen_from_earth(Body.Moon, place, days), radius=MOON_RADIUS)
    north, near_latitude, near_longitude = _face_of_the_moon(place, days, seen)
    return MoonSighting(
        altitude=seen.altitude,
        azimuth=seen.azimuth,
        distance=seen.distance,
        radius=seen.radius,
        phase_angle=light.phase_angle,
        lit=light.phase_fraction,
        waxing=MoonPhase(time) < 180.0,
        north=north,
        near_latitude=near_latitude,
        near_longitude=near_longitude,
    )


def _face_of_the_moon(place: Place, days: float, seen: Sighting) -> tuple[float, float, float]:
    """Fields ``north``, ``near_latitude`` and ``near_longitude`` of ``MoonSighting``. [deg]"""
    from astronomy import Body, RotationAxis

    axis = RotationAxis(Body.Moon, ephemeris_time(days))
    local = horizon_axes(place, days)
    pole = np.array([axis.north.x, axis.north.y, axis.north.z])
    node = np.array([-pole[1], pole[0], 0.0]) / math.hypot(pole[0], pole[1])
    spin = math.radians(axis.spin)
    meridian = math.cos(spin) * node + math.sin(spin) * np.cross(pole, node)
    sight, up = seen.direction @ local, local[2]
    right = np.cross(sight, up)
    right /= max(float(np.linalg.norm(right)), 1e-12)
    north = math.atan2(pole @ right, pole @ np.cross(right, sight))
    latitude = math.asin(min(max(-float(pole @ sight), -1.0), 1.0))
    longitude = math.atan2(-np.cross(pole, meridian) @ sight, -meridian @ sight)
    return math.degrees(north), math.degrees(latitude), math.degrees(longitude)


def horizon_axes(place: Place, days: float) -> NDArray[np.float64]:
    """Axes of a place in the frame of the J2000 equator: east, north, up, shape (3, 3).

    Parameters
    ----------
    place : Place
        Place on any of the worlds.
    days : float
        Days since 2000-01-01 12:00 UTC.

    Returns
    -------
    array, shape (3, 3)
        Unit vectors as rows, on Earth with precession and nutation; aberration, up to 0.006°, is
        neglected.

    Examples
    --------
    >>> axes = horizon_axes(Place(latitude=90.0, longitude=0.0), 0.0)  # J2000 itself
    >>> f"{axes[2, 2]:.6f}"  # the pole is in the zenith
    '1.000000'
    """
    if place.body != "earth":
        latitude = math.radians(place.latitude)
        out, east, pole = meridian_axes(place.world, days, place.longitude)
        up = math.cos(latitude) * out + math.sin(latitude) * pole
        return np.stack([east, np.cross(up, east), up])
    from astronomy import Observer, Rotation_EQJ_HOR

    observer = Observer(place.latitude, place.longitude, place.altitude)
    north, west, up = np.array(Rotation_EQJ_HOR(ephemeris_time(days), observer).rot).T
    return np.stack([-west, north, up])


def horizon_axes_by_sun(place: Place, sun_zenith: float, sun_azimuth: float) -> NDArray[np.float64]:
    """Axes of a place as ``horizon_axes``, at an instant given by the sun's position in its sky.

    The sun's declination determines the day, between the northern winter and summer solstice or,
    for impossible declinations, a solstice; the hour angle determines the hour.

    Parameters
    ----------
    place : Place
        Place on any of the worlds; its longitude is ignored.
    sun_zenith, sun_azimuth : float
        Zenith angle and compass bearing of the sun. [deg]

    Examples
    --------
    >>> axes = horizon_axes_by_sun(Place(latitude=90.0, longitude=0.0), 90.0, 180.0)  # the equinox
    >>> (-axes[1]).round(2) + 0.0  # the sun stands in Aries: in the south, whence axes count
    array([1., 0., 0.])
    """
    latitude, zenith = math.radians(place.latitude), math.radians(sun_zenith)
    turn, flat = math.radians(sun_azimuth), math.sin(zenith)
    north, east, up = flat * math.cos(turn), flat * math.sin(turn), math.cos(zenith)
    pole = math.sin(latitude) * up + math.cos(latitude) * north
    declination = math.degrees(math.asin(min(max(pole, -1.0), 1.0)))
    eastward = math.degrees(math.atan2(east, math.cos(latitude) * up - math.sin(latitude) * north))
    days = np.linspace(0.0, 1.5 * place.world.year, _DAYS)
    points = [solar_point(place.world, float(one)) for one in days]
    tilts = np.array([one.latitude for one in points])
    first = int(np.argmin(tilts[: 2 * _DAYS // 3]))
    last = first + int(np.argmax(tilts[first : first + _DAYS // 2]))
    rising = slice(first, last + 1)
    day = float(np.interp(declination, tilts[rising], days[rising]))
    below = solar_point(place.world, day).longitude
    longitude = math.remainder(below - eastward, 360.0)
    return horizon_axes(replace(place, longitude=longitude), day)


def sub_solar_point(body: str, time: datetime) -> SolarPoint:
    """Point of a world with the sun in its zenith, the sun's distance, and the season Ls.

    Parameters
    ----------
    body : str
        Name of the world.
    time : datetime
        Instant with its zone.

    Raises
    ------
    ParameterError
        If the world is unknown, or the time is out of range.

    Examples
    --------
    >>> from datetime import UTC
    >>> point = sub_solar_point("earth", datetime(2026, 6, 21, 12, tzinfo=UTC))
    >>> f"{point.latitude:.2f} {point.solar_longitude:.1f}"
    '23.44 90.1'
    """
    return solar_point(world_named(body), days_of(time))


def sub_lunar_point(time: datetime) -> tuple[float, float]:
    """Latitude and longitude of the point of Earth with the Moon in its zenith. [deg]

    Examples
    --------
    >>> from datetime import UTC
    >>> latitude, longitude = sub_lunar_point(datetime(2026, 1, 3, 10, tzinfo=UTC))
    >>> f"{latitude:.0f}"  # a full moon in winter stands high
    '27'
    """
    from astronomy import Body, GeoVector, RotateVector, Rotation_EQJ_EQD, SiderealTime

    moment = ephemeris_time(days_of(time))
    vector = RotateVector(Rotation_EQJ_EQD(moment), GeoVector(Body.Moon, moment, aberration=True))
    east = math.degrees(math.atan2(vector.y, vector.x)) - 15.0 * SiderealTime(moment)
    latitude = math.degrees(math.atan2(vector.z, math.hypot(vector.x, vector.y)))
    return latitude, math.remainder(east, 360.0)


def _seen_from_earth(body: object, place: Place, days: float) -> dict[str, float]:
    """Altitude, azimuth and distance of a body without refraction. [deg], [m]"""
    from astronomy import Equator, Horizon, Observer, Refraction

    time = ephemeris_time(days)
    observer = Observer(place.latitude, place.longitude, place.altitude)
    apparent = Equator(body, time, observer, ofdate=True, aberration=True)
    seen = Horizon(time, observer, apparent.ra, apparent.dec, Refraction.Airless)
    return {
        "altitude": seen.altitude,
        "azimuth": seen.azimuth % 360.0,
        "distance": apparent.dist * ASTRONOMICAL_UNIT,
    }


def _horizontal(place: Place, point: SolarPoint) -> tuple[float, float]:
    """Altitude and bearing of an object in the zenith of a point of the world. [deg]"""
    latitude, turn = math.radians(place.latitude), math.radians(point.longitude - place.longitude)
    tilt = math.radians(point.latitude)
    out, east, pole = (
        math.cos(tilt) * math.cos(turn),
        math.cos(tilt) * math.sin(turn),
        math.sin(tilt),
    )
    up = math.cos(latitude) * out + math.sin(latitude) * pole
    north = math.cos(latitude) * pole - math.sin(latitude) * out
    altitude = math.degrees(math.atan2(up, math.hypot(north, east)))
    return altitude, math.degrees(math.atan2(east, north)) % 360.0
