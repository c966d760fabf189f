"""Mars against Mars24's worked examples, Titan against Saturn's published seasons."""

from __future__ import annotations

import math
from datetime import UTC, datetime

import pytest

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.instant import days_of, time_at
from airlight.geometry.ephemeris.sky import Place, sun_seen
from airlight.geometry.ephemeris.solar_time import time_of_season, true_solar_time
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.geometry.ephemeris.world import world_named
from airlight.physics.constants import ASTRONOMICAL_UNIT

MARS, TITAN = world_named("mars"), world_named("titan")

#: Schmunk, Mars24 Sunclock: Algorithm and Worked Examples (NASA GISS), after Allison & McEwen
#: (2000): time, longitude east, Ls, local true solar time. Their series is good to 0.01° in Ls.
EXAMPLES = [
    (datetime(2000, 1, 6, tzinfo=UTC), 0.0, 277.18758, 23.0 + 38.0 / 60.0 + 54.0 / 3600.0),
    (datetime(2004, 1, 3, 13, 46, 31, tzinfo=UTC), -184.702, 327.32416, 0.0),
]


@pytest.mark.parametrize(("time", "longitude", "season", "hour"), EXAMPLES)
def test_mars_keeps_the_time_of_mars24(
    time: datetime, longitude: float, season: float, hour: float
) -> None:
    days = days_of(time)
    point = solar_point(MARS, days)
    assert abs(point.solar_longitude - season) < 0.01
    shown = true_solar_time(MARS, longitude, days)
    # 2.5 s of a sol: 0.01° of rotation
    assert abs((shown - hour + 12.0) % 24.0 - 12.0) < 0.01 / 15.0
    # Mars24, eq. D-2: the series of the heliocentric distance over the mean anomaly
    anomaly = math.radians(19.3871 + 0.52402073 * (days + 64.184 / 86400.0))
    terms = (1.00436, -0.09309, -0.004336, -0.00031, -0.00003)
    distance = 1.52367934 * sum(term * math.cos(k * anomaly) for k, term in enumerate(terms))
    assert point.distance == pytest.approx(distance * ASTRONOMICAL_UNIT, rel=2e-4)


def test_declination_of_the_sun_on_mars_follows_its_season() -> None:
    # Allison & McEwen (2000), eq. 20: the sine of 25.19° is 0.42565
    for season in (0.0, 45.0, 90.0, 200.0, 270.0):
        days = time_of_season(MARS, season, 0.0)
        expected = math.degrees(math.asin(0.42565 * math.sin(math.radians(season))))
        assert abs(solar_point(MARS, days).latitude - expected) < 0.01


@pytest.mark.parametrize(
    ("season", "after", "date"),
    [
        # Mars years 24 and 36 begin at Ls 0: Clancy et al. (2000); Piqueux et al. (2015), Table 2
        (0.0, datetime(1998, 1, 1, tzinfo=UTC), "1998-07-14"),
        (0.0, datetime(2020, 12, 1, tzinfo=UTC), "2021-02-07"),
    ],
)
def test_mars_years_begin_when_they_are_published_to(
    season: float, after: datetime, date: str
) -> None:
    assert time_at(time_of_season(MARS, season, days_of(after))).date().isoformat() == date


@pytest.mark.parametrize(
    ("time", "latitude"),
    [(datetime(2009, 8, 11, tzinfo=UTC), 0.0), (datetime(2017, 5, 24, tzinfo=UTC), 26.73)],
)
def test_titan_has_the_seasons_of_saturn(time: datetime, latitude: float) -> None:
    # Equinox and northern solstice of Saturn (NASA, Cassini mission); Titan's equator is within
    # 0.3° of Saturn's, whose obliquity is 26.73°
    assert abs(solar_point(TITAN, days_of(time)).latitude - latitude) < 0.3


def test_sun_of_huygens_stood_where_the_probe_saw_it() -> None:
    # Landing 2005-01-14 11:38 UTC at 10.3° S, 167.7° E (Lebreton et al. 2005, Nature 438, 758);
    # the solar zenith angle of the descent is published as 34° to 35°
    place = Place(body="titan", latitude=-10.3, longitude=167.7)
    sun = sun_seen(place, datetime(2005, 1, 14, 11, 38, tzinfo=UTC))
    assert 33.0 < sun.zenith < 36.0


def test_other_worlds_have_no_known_moon() -> None:
    from airlight.geometry.ephemeris.sky import moon_seen

    with pytest.raises(ParameterError, match="body is 'mars'; allowed: earth"):
        moon_seen(Place(body="mars", latitude=0.0, longitude=0.0), datetime.now(UTC))


@pytest.mark.parametrize(
    ("body", "time", "latitude", "within"),
    [
        # equinox of Saturn, 6 May 2025, and of Uranus, 7 December 2007 (NASA)
        ("saturn", datetime(2025, 5, 6, tzinfo=UTC), 0.0, 0.1),
        ("uranus", datetime(2007, 12, 7, tzinfo=UTC), 0.0, 0.2),
        # New Horizons: the sun over 51.6 N when it passed Pluto
        ("pluto", datetime(2015, 7, 14, 12, tzinfo=UTC), 51.6, 0.3),
        # a year of Mercury, whose axis is upright to 0.034 deg (Archinal et al. 2018)
        ("mercury", datetime(2026, 2, 1, tzinfo=UTC), 0.0, 0.04),
    ],
)
def test_the_sun_stands_where_missions_say(
    body: str, time: datetime, latitude: float, within: float
) -> None:
    assert abs(solar_point(world_named(body), days_of(time)).latitude - latitude) < within


def test_at_full_moon_the_sun_is_over_the_near_side() -> None:
    # Full moon of 3 January 2026, 10:03 UTC: the moon's longitudes are from the mean Earth, off
    # which the sun then is by the libration and the moon's latitude, below 8 deg
    point = solar_point(world_named("moon"), days_of(datetime(2026, 1, 3, 10, 3, tzinfo=UTC)))
    assert abs(point.longitude) < 8.0
    assert abs(point.latitude) < 1.6


@pytest.mark.parametrize("name", ["mercury", "venus", "jupiter", "saturn", "uranus", "pluto"])
def test_a_solar_day_brings_the_sun_back(name: str) -> None:
    # NASA's days; Mercury's differ by its eccentric orbit, whose period is half of its day's
    world = world_named(name)
    first, next_ = (solar_point(world, k * world.solar_day).longitude for k in (0.0, 2.0))
    assert abs(math.remainder(next_ - first, 360.0)) < 2.0
