"""Sun and Moon of a session by its date and time."""

from __future__ import annotations

from datetime import UTC, datetime, timedelta

import pytest

from airlight.geometry.ephemeris.sky import Place, moon_seen, sun_seen
from airlight.viewer.navigation.flight import Flight
from airlight.viewer.session.session import Session

STOCKHOLM = {"view.latitude": 59.33, "view.longitude": 18.07}
PLACE = Place(latitude=59.33, longitude=18.07)
EVENING = datetime(2026, 6, 21, 20, 10, tzinfo=UTC)


def dated(body: str = "earth") -> Session:
    """Session with the sun of the evening of 21 June 2026 over Stockholm's coordinates."""
    session = Session(body)
    session.move(STOCKHOLM)
    session.set("view.day", 172.0)
    session.set("view.hour", 20.0 + 10.0 / 60.0)
    return session


def sun_of(session: Session) -> tuple[float, float]:
    """Altitude and bearing of the sun. [deg]"""
    view = session.view
    return 90.0 - float(view["view.sun_zenith"]), float(view["view.sun_azimuth"])


def test_date_sets_the_sun_where_the_ephemeris_has_it() -> None:
    session = dated()
    assert session.value("view.clock") is True
    seen = sun_seen(PLACE, EVENING)
    # the formula's bound, and 0.0024° of parallax
    assert sun_of(session) == pytest.approx((seen.altitude, seen.azimuth), abs=0.015)


def test_sun_follows_the_place_while_it_goes_by_the_date() -> None:
    session = dated()
    session.set("view.longitude", -58.0)
    session.set("view.latitude", -34.0)
    seen = sun_seen(Place(latitude=-34.0, longitude=-58.0), EVENING)
    assert sun_of(session) == pytest.approx((seen.altitude, seen.azimuth), abs=0.015)


@pytest.mark.parametrize("path", ["view.sun_zenith", "view.sun_azimuth"])
def test_sun_moved_by_hand_leaves_the_date(path: str) -> None:
    session = dated()
    session.set(path, 77.0)
    assert session.value("view.clock") is False
    assert session.value(path) == 77.0
    session.set("view.longitude", 100.0)
    assert session.value(path) == 77.0


def test_undo_brings_back_sun_and_switch() -> None:
    session = Session("earth")
    before = dict(session.view)
    session.set("view.hour", 3.0)
    assert sun_of(session) != (90.0 - before["view.sun_zenith"], before["view.sun_azimuth"])
    session.undo()
    assert dict(session.view) == before
    session.redo()
    assert session.value("view.clock") is True
    assert session.value("view.hour") == 3.0


def test_time_passes_over_the_end_of_the_year() -> None:
    session = dated()
    session.set("view.day", 365.0)
    session.set("view.hour", 23.0)
    flight = Flight(session)
    for _ in range(8):
        flight.pass_time(0.25)
    assert [session.value(f"view.{name}") for name in ("year", "day", "hour")] == [2027, 1, 1]
    seen = sun_seen(PLACE, datetime(2027, 1, 1, 1, tzinfo=UTC))
    assert sun_of(session) == pytest.approx((seen.altitude, seen.azimuth), abs=0.015)


def test_time_passes_by_the_sun_without_a_date() -> None:
    session = Session("earth")
    declination, hour = Flight(session).time
    Flight(session).pass_time(1.5)
    after = Flight(session).time
    assert after == pytest.approx((declination, hour + 1.5))
    assert session.value("view.clock") is False


def test_mars_has_the_sun_of_its_own_date() -> None:
    session = dated("mars")
    seen = sun_seen(Place(body="mars", latitude=59.33, longitude=18.07), EVENING)
    assert sun_of(session) == pytest.approx((seen.altitude, seen.azimuth), abs=0.07)
    session.open("earth")
    seen = sun_seen(PLACE, EVENING)
    assert sun_of(session) == pytest.approx((seen.altitude, seen.azimuth), abs=0.015)


def test_a_sun_shared_with_another_body_is_not_by_the_date() -> None:
    # A link to Mars under the Earth's sun had that of Mars' own date when it was opened.
    session = dated("earth")
    session.store_b()
    session.swap()
    assert session.view["view.clock"] is True
    session.open("mars")
    sun = sun_of(session)
    session.swap()
    assert sun_of(session) == sun
    assert session.view["view.clock"] is False
    other = Session("mars")
    other.from_state(session.to_state())
    assert sun_of(other) == pytest.approx(sun, abs=1e-5)


def test_a_planet_opened_as_b_leaves_the_sun_of_a() -> None:
    session = dated("earth")
    sun = sun_of(session)
    session.open_as_b("mars")
    assert (session.showing, session.planet_name_other) == ("A", "Mars")
    assert sun_of(session) == sun
    assert session.view["view.clock"] is True


def test_planet_without_a_body_has_no_date() -> None:
    session = Session("venus")
    before = sun_of(session)
    assert not {one.path for one in session.parameters} & {"view.clock", "view.hour"}
    session.move({"view.hour": 3.0}, gesture="any")
    session.change_view("any", {"view.clock": True})
    assert session.view["view.clock"] is False
    assert sun_of(session) == before


def test_flight_keeps_the_sun_of_the_date() -> None:
    session = dated()
    flight = Flight(session)
    flight.press("w")
    for _ in range(5):
        flight.step(1.0 / 30.0)
    flight.release()
    latitude, longitude = (float(session.view[f"view.{one}"]) for one in ("latitude", "longitude"))
    assert session.value("view.clock") is True
    seen = sun_seen(Place(latitude=latitude, longitude=longitude), EVENING + timedelta())
    assert sun_of(session) == pytest.approx((seen.altitude, seen.azimuth), abs=0.015)


def test_state_keeps_the_date() -> None:
    session = dated()
    other = Session("earth")
    other.from_state(session.to_state())
    assert other.value("view.clock") is True
    assert other.value("view.hour") == pytest.approx(20.0 + 10.0 / 60.0, abs=1e-6)
    assert sun_of(other) == pytest.approx(sun_of(session), abs=1e-5)


def test_reset_goes_back_to_the_first_sun() -> None:
    session = Session("earth")
    first = dict(session.view)
    session.set("view.hour", 3.0)
    session.reset()
    assert dict(session.view) == first


def moon_of(session: Session) -> tuple[float, float]:
    """Altitude and bearing of the second light. [deg]"""
    view = session.view
    return 90.0 - float(view["view.second_zenith"]), float(view["view.second_azimuth"])


def test_date_sets_the_moon_where_the_ephemeris_has_it() -> None:
    session = dated()
    assert session.value("view.second_light") == "moon"
    seen = moon_seen(PLACE, EVENING)
    # 0.09° at most, and more in bearing than on the sky
    assert moon_of(session) == pytest.approx((seen.altitude, seen.azimuth), abs=0.15)
    # the half Moon of that evening; of the Earth's centre, 1° from the place's
    assert session.value("view.moon_phase") == pytest.approx(seen.phase_angle, abs=1.2)
    (moon,) = session.scene.secondary_lights
    assert moon.zenith == session.value("view.second_zenith")
    bearing = (moon.azimuth + float(session.view["view.sun_azimuth"])) % 360.0
    assert bearing == pytest.approx(moon_of(session)[1])


def test_moon_moved_by_hand_leaves_the_date_and_the_sun_does_not() -> None:
    session = dated()
    sun = sun_of(session)
    session.set("view.second_zenith", 20.0)
    assert session.value("view.moon_by_date") is False
    assert session.value("view.clock") is True
    session.set("view.hour", 21.0)
    assert session.value("view.second_zenith") == 20.0
    assert sun_of(session) != sun
    session.set("view.moon_by_date", True)
    assert session.value("view.second_zenith") != 20.0


def test_moon_is_switched_off_by_one_choice() -> None:
    session = dated()
    session.set("view.second_light", "none")
    session.set("view.hour", 21.0)
    assert session.value("view.second_light") == "none"
    assert session.scene.secondary_lights == ()


def test_a_moved_moon_shines_and_a_temperature_makes_a_second_sun() -> None:
    session = Session("mars")
    session.set("view.second_zenith", 40.0)
    assert session.value("view.second_light") == "moon"
    session.undo()
    assert session.value("view.second_light") == "none"
    session.set("view.second_temperature", 4000.0)
    (star,) = session.scene.secondary_lights
    assert star.star.temperature == 4000.0
    assert star.star.angular_radius_degrees == pytest.approx(0.259)


def test_mars_has_no_moon_by_date() -> None:
    session = dated()
    session.open("mars")
    assert session.value("view.clock") is True
    assert session.value("view.second_light") == "none"
    session.open("earth")
    assert session.value("view.second_light") == "moon"
