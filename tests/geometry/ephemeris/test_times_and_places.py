"""Places and times as text: events of a day, zones, solar time, seasons, and what is refused."""

from __future__ import annotations

from datetime import UTC, date, datetime, timedelta
from typing import Any

import pytest

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.instant import days_of
from airlight.geometry.ephemeris.place_text import read_place
from airlight.geometry.ephemeris.sky import Place, moon_seen, sun_seen
from airlight.geometry.ephemeris.solar_time import true_solar_time
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.geometry.ephemeris.time_text import read_time

STOCKHOLM = Place(latitude=59.33, longitude=18.07)
SVALBARD = Place(latitude=78.2, longitude=15.6)
GALE = Place(body="mars", latitude=-4.59, longitude=137.44)


@pytest.mark.parametrize(
    ("text", "place"),
    [
        ("59.33N,18.07E", (59.33, 18.07, None)),
        (" 59.33 , 18.07 ", (59.33, 18.07, None)),
        ("33.9°s, 151.2°w, 35 km", (-33.9, -151.2, "35 km")),
        ("-4.59,-222.56", (-4.59, -222.56, None)),
    ],
)
def test_places_are_read(text: str, place: tuple[float, float, str | None]) -> None:
    assert read_place(text) == place


@pytest.mark.parametrize(
    "text", ["59", "18E,59N", "-59N,18E", "91,0", "0,361", "59,18,400", "a,b", "1,2,3km,4"]
)
def test_what_is_no_place_is_refused(text: str) -> None:
    with pytest.raises(ParameterError, match="at is"):
        read_place(text)


@pytest.mark.parametrize(
    ("place", "word", "published"),
    [
        # U.S. Naval Observatory, Rise/Set/Transit times: Greenwich and Washington, to the minute
        (Place(latitude=51.48, longitude=0.0), "2026-06-21 sunset", "2026-06-21T20:21"),
        (Place(latitude=51.48, longitude=0.0), "2026-06-21 sunrise", "2026-06-21T03:43"),
        (Place(latitude=51.48, longitude=0.0), "2026-12-21 sunset", "2026-12-21T15:53"),
        (Place(latitude=51.48, longitude=0.0), "2026-12-21 sunrise", "2026-12-21T08:04"),
    ],
)
def test_rise_and_set_are_those_of_almanacs(place: Place, word: str, published: str) -> None:
    moment = read_time(word, place)
    expected = datetime.fromisoformat(published + ":00+00:00")
    assert abs((moment - expected).total_seconds()) <= 60.0


def test_rise_and_set_agree_with_skyfield(almanac: tuple[Any, Any]) -> None:
    from skyfield.almanac import find_risings, find_settings
    from skyfield.api import wgs84

    bodies, scale = almanac
    for latitude, longitude in ((59.33, 18.07), (-33.9, 151.2), (52.0, -20.0)):
        place = Place(latitude=latitude, longitude=longitude)
        observer = bodies["earth"] + wgs84.latlon(latitude, longitude)
        for body in ("sun", "moon"):
            for word, find in (("rise", find_risings), ("set", find_settings)):
                ours = read_time(f"2026-03-11 {body}{word}", place, zone="UTC")
                start, end = scale.utc(2026, 3, 11), scale.utc(2026, 3, 12)
                found, _ = find(observer, bodies[body], start, end)
                # the moon's radius as skyfield takes it differs by 0.001°
                assert abs((found[0].utc_datetime() - ours).total_seconds()) < 5.0


@pytest.mark.parametrize(
    ("word", "altitude", "rises"),
    [
        ("civil-dawn", -6.0, True),
        ("civil-dusk", -6.0, False),
        ("nautical-dusk", -12.0, False),
        ("astronomical-dawn", -18.0, True),
    ],
)
def test_dusk_and_dawn_are_altitudes_of_the_sun(word: str, altitude: float, rises: bool) -> None:
    moment = read_time(f"2026-03-20 {word}", STOCKHOLM, zone="Europe/Stockholm")
    sun = sun_seen(STOCKHOLM, moment)
    assert sun.altitude == pytest.approx(altitude, abs=1e-4)
    assert (sun.azimuth < 180.0) == rises
    assert moment.date() == date(2026, 3, 20)


def test_noon_is_the_sun_in_the_south() -> None:
    sun = sun_seen(STOCKHOLM, read_time("2026-02-11 noon", STOCKHOLM))
    assert sun.azimuth == pytest.approx(180.0, abs=2e-3)


def test_moonset_has_the_limb_on_the_almanac_s_horizon() -> None:
    moon = moon_seen(STOCKHOLM, read_time("2026-06-21 moonset", STOCKHOLM))
    assert moon.altitude == pytest.approx(-34.0 / 60.0 - moon.angular_radius, abs=1e-4)


def test_midnight_sun_is_one_clear_line() -> None:
    with pytest.raises(ParameterError) as caught:
        read_time("2026-06-21 sunset", SVALBARD)
    line = str(caught.value)
    assert "\n" not in line
    assert "78.2000°N 15.6000°E on that day the sun stays between 11." in line
    with pytest.raises(ParameterError, match="the sun stays between -35"):
        read_time("2026-12-21 sunrise", SVALBARD)


def test_sun_that_sets_for_minutes_is_found() -> None:
    # Shorter than the time between two samples: the first day without a sunset has no minute
    # before midnight with the upper limb below the horizon of almanacs
    place = Place(latitude=65.8, longitude=0.0)
    for day in range(5, 20):
        try:
            last = read_time(f"2026-06-{day:02d} sunset", place)
        except ParameterError:
            break
    assert sun_seen(place, last).altitude == pytest.approx(-0.8295, abs=2e-3)
    midnight = datetime(2026, 6, day, tzinfo=UTC)
    minutes = [midnight + timedelta(minutes=k) for k in range(1400, 1440)]
    assert min(sun_seen(place, minute).altitude for minute in minutes) > -0.8295


def test_times_in_zones_are_one_instant() -> None:
    instant = datetime(2026, 6, 21, 20, 10, tzinfo=UTC)
    for text, zone in (
        ("2026-06-21T22:10+02:00", None),
        ("2026-06-21T20:10Z", None),
        ("2026-06-21 22:10", "Europe/Stockholm"),
        ("2026-06-21T22:10:00", "Europe/Stockholm"),
    ):
        assert read_time(text, STOCKHOLM, zone=zone) == instant


def test_word_without_a_date_is_today_s() -> None:
    moment = read_time("noon", STOCKHOLM, today=date(2026, 6, 21))
    assert moment.date() == date(2026, 6, 21)


@pytest.mark.parametrize(
    ("text", "zone", "reason"),
    [
        ("2026-06-21T22:10", None, "allowed: a time with its zone"),
        ("2026-06-21T22:10Z", "Europe/Stockholm", "cannot be combined with another zone"),
        ("2026-06-21 22:10", "Europe/Stokholm", "an IANA zone"),
        ("2026-03-29 02:30", "Europe/Stockholm", "times that exist in Europe/Stockholm"),
        ("2026-13-01 sunset", None, "a date of the calendar"),
        ("tomorrow", None, "sunrise, sunset"),
        ("2026-06-21 25:00", "solar", "hours 0 to 23"),
        ("1500-06-21T12:00Z", None, "the years 1700 to 2199"),
    ],
)
def test_what_is_no_time_is_refused(text: str, zone: str | None, reason: str) -> None:
    with pytest.raises(ParameterError) as caught:
        read_time(text, STOCKHOLM, zone=zone)
    assert reason in str(caught.value)


def test_solar_time_of_mars_is_kept_at_its_season() -> None:
    moment = days_of(read_time("14:30", GALE, season=250.0))
    assert true_solar_time(GALE.world, GALE.longitude, moment) == pytest.approx(14.5, abs=1e-4)
    # within half a sol of the passage: 0.33° of Ls at most
    assert abs(solar_point(GALE.world, moment).solar_longitude - 250.0) < 0.35


def test_sunset_of_mars_follows_the_season_after_a_date() -> None:
    moment = read_time("2020-01-01 sunset", GALE, season=90.0)
    assert datetime(2020, 1, 1, tzinfo=UTC) < moment < datetime(2021, 12, 1, tzinfo=UTC)
    sun = sun_seen(GALE, moment)
    assert sun.altitude == pytest.approx(-sun.angular_radius, abs=1e-4)
    assert sun.azimuth > 180.0


@pytest.mark.parametrize(("half", "other"), [("morning", False), ("evening", True)])
@pytest.mark.parametrize("elevation", [-8.0, 5.0, 30.0])
def test_sun_has_the_elevation_that_was_asked_for(half: str, other: bool, elevation: float) -> None:
    # The place of the sun is a second formula for what the search has found; 0.01° is 3 s
    place = Place(latitude=47.0, longitude=8.0)
    when = read_time(f"2026-04-10 {half} {elevation:g}deg", place)
    assert abs(sun_seen(place, when).altitude - elevation) < 0.01
    assert (when > read_time("2026-04-10 noon", place)) is other
    with pytest.raises(ParameterError, match="the sun stays between"):
        read_time(f"2026-04-10 {half} 80deg", place)
