"""Sun and moon against JPL's ephemeris DE421, by skyfield."""

from __future__ import annotations

import math
from datetime import UTC, datetime, timedelta
from typing import Any

import numpy as np
import pytest

from airlight.geometry.ephemeris.instant import days_of
from airlight.geometry.ephemeris.sky import Place, moon_seen, sub_lunar_point, sun_seen
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.geometry.ephemeris.world import world_named

PLACES = [
    (59.33, 18.07),
    (0.0, -78.5),
    (-33.9, 151.2),
    (78.2, 15.6),
    (-77.8, 166.7),
    (40.0, -105.0),
]
#: The bar of the specification. [deg] Measured: 0.0030.
ALMANAC = 0.01


@pytest.mark.parametrize(("name", "seen"), [("sun", sun_seen), ("moon", moon_seen)])
def test_sun_and_moon_stand_where_the_almanac_has_them(
    almanac: tuple[Any, Any], name: str, seen: Any
) -> None:
    from skyfield.api import wgs84

    bodies, scale = almanac
    rng = np.random.default_rng(1)
    worst, farthest = 0.0, 0.0
    for latitude, longitude in PLACES:
        for day in rng.uniform(0.0, 18_900.0, 12):
            time = datetime(1975, 1, 1, tzinfo=UTC) + timedelta(days=float(day))
            observer = bodies["earth"] + wgs84.latlon(latitude, longitude)
            apparent = observer.at(scale.from_datetime(time)).observe(bodies[name]).apparent()
            altitude, azimuth, distance = apparent.altaz()
            up, turn = altitude.radians, azimuth.radians
            theirs = [math.cos(up) * math.sin(turn), math.cos(up) * math.cos(turn), math.sin(up)]
            ours = seen(Place(latitude=latitude, longitude=longitude), time)
            worst = max(worst, math.degrees(float(np.linalg.norm(ours.direction - theirs))))
            farthest = max(farthest, abs(ours.distance / distance.m - 1.0))
    assert worst < ALMANAC
    assert farthest < 3e-4  # of the moon: observers are 6400 km nearer or farther, 0.017


def test_moon_is_as_lit_as_in_the_almanac(almanac: tuple[Any, Any]) -> None:
    bodies, scale = almanac
    for day in range(0, 30, 3):
        time = datetime(2026, 6, 1, tzinfo=UTC) + timedelta(days=day)
        moment = scale.from_datetime(time)
        ours = moon_seen(Place(latitude=0.0, longitude=0.0), time)
        moon = bodies["earth"].at(moment).observe(bodies["moon"])
        to_sun = bodies["sun"].at(moment).position.au - bodies["moon"].at(moment).position.au
        to_earth = -moon.position.au
        cosine = to_sun @ to_earth / np.linalg.norm(to_sun) / np.linalg.norm(to_earth)
        assert abs(ours.phase_angle - math.degrees(math.acos(cosine))) < 0.02
        assert abs(ours.lit - 0.5 * (1.0 + cosine)) < 2e-4


def test_body_stands_in_the_zenith_of_the_point_below_it() -> None:
    time = datetime(2026, 6, 21, 20, 10, tzinfo=UTC)
    point = solar_point(world_named("earth"), days_of(time))
    overhead = sun_seen(Place(latitude=point.latitude, longitude=point.longitude), time)
    # 0.0024° of parallax vanish there
    assert overhead.altitude > 89.99
    latitude, longitude = sub_lunar_point(time)
    moon = moon_seen(Place(latitude=latitude, longitude=longitude), time)
    # geographic less geocentric vertical, 0.19° at most, times the ratio of the radii: 1/60
    assert moon.altitude > 89.99


def test_saturn_of_titan_s_seasons_is_the_almanac_s(almanac: tuple[Any, Any]) -> None:
    # Titan's pole and prime meridian (IAU) with DE421's Saturn: a second position, the same spin
    bodies, scale = almanac
    titan = world_named("titan")
    assert titan.spin is not None
    for year in (1980, 1995, 2009, 2017, 2025):
        time = datetime(year, 8, 11, tzinfo=UTC)
        moment = scale.from_datetime(time)
        place = bodies["saturn barycenter"].at(moment) - bodies["sun"].at(moment)
        sun = -place.position.au / np.linalg.norm(place.position.au)
        ra, dec = math.radians(titan.spin.right_ascension), math.radians(titan.spin.declination)
        pole = [math.cos(dec) * math.cos(ra), math.cos(dec) * math.sin(ra), math.sin(dec)]
        node = [-math.sin(ra), math.cos(ra), 0.0]
        along = math.degrees(math.atan2(sun @ np.cross(pole, node), sun @ node))
        days = moment.tdb - 2451545.0
        longitude = math.remainder(along - titan.spin.meridian - titan.spin.rate * days, 360.0)
        ours = solar_point(titan, days_of(time))
        # 0.05° between Titan and Saturn seen from the sun
        assert abs(ours.latitude - math.degrees(math.asin(sun @ pole))) < 0.06
        assert abs(math.remainder(ours.longitude - longitude, 360.0)) < 0.06
