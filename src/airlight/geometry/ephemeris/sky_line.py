"""Text line with sun and moon at a place and time."""

from __future__ import annotations

from datetime import datetime

from airlight.geometry.ephemeris.instant import days_of, universal_time
from airlight.geometry.ephemeris.place_text import written_place
from airlight.geometry.ephemeris.sky import Place, moon_after, sun_after
from airlight.geometry.ephemeris.solar_time import true_solar_time
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.physics.constants import ASTRONOMICAL_UNIT


def sky_line(place: Place, time: datetime, *, seen: float | None = None) -> str:
    """Line with place, time, altitude and bearing of sun and moon, and the moon's phase.

    Parameters
    ----------
    place, time :
        As for ``sun_seen``.
    seen : float, optional
        Apparent altitude of the sun, with refraction. [deg]

    Examples
    --------
    >>> from datetime import UTC
    >>> landing = datetime(2012, 8, 6, 5, 18, tzinfo=UTC)  # of Curiosity
    >>> sky_line(Place(body="mars", latitude=-4.59, longitude=137.44), landing)
    'mars 4.5900°S 137.4400°E  2012-08-06T05:18:00Z  sun +33.72°, bearing 287.7°, 1.5361 au,
     Ls 150.7°, solar time 15:36'
    """
    days = days_of(time)
    sun = sun_after(place, days)
    apparent = "" if seen is None else f" (seen at {seen:+.2f}°)"
    line = (
        f"{place.body} {written_place(place.latitude, place.longitude)}  {universal_time(time)}  "
        f"sun {sun.altitude:+.2f}°{apparent}, bearing {sun.azimuth:.1f}°, "
        f"{sun.distance / ASTRONOMICAL_UNIT:.4f} au"
    )
    if place.world.has_moon:
        moon = moon_after(place, days)
        phase = f"{100.0 * moon.lit:.0f} % lit, {'waxing' if moon.waxing else 'waning'}"
        return f"{line}  moon {moon.altitude:+.2f}°, bearing {moon.azimuth:.1f}°, {phase}"
    season = solar_point(place.world, days).solar_longitude
    minutes = round(60.0 * true_solar_time(place.world, place.longitude, days)) % 1440
    return f"{line}, Ls {season:.1f}°, solar time {minutes // 60:02d}:{minutes % 60:02d}"
