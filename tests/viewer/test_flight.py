"""Free flight: positions reached, under a sun fixed in space."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.scene.directions import direction
from airlight.scene.flight import looked, risen, sun_dragged
from airlight.scene.observer import planet_frame
from airlight.scene.sun_time import sun_at, time_of
from airlight.viewer.navigation.flight import Flight, flown
from airlight.viewer.navigation.viewpoints import home_view
from airlight.viewer.parameters.view_parameters import DEFAULTS
from airlight.viewer.session.session import Session

RADIUS = 6.371e6


def start(**values: float) -> dict[str, float]:
    view = dict(DEFAULTS) | {f"view.{name}": value for name, value in values.items()}
    return view  # type: ignore[return-value]


def sun_of(view: dict[str, float]) -> np.ndarray:
    """Direction of the sun in the planet's frame."""
    place = (view["view.latitude"], view["view.longitude"], view["view.sun_azimuth"])
    return planet_frame(*place) @ direction(view["view.sun_zenith"], 0.0)


def place_of(view: dict[str, float]) -> np.ndarray:
    return planet_frame(view["view.latitude"], view["view.longitude"], 0.0)[:, 2]


def go(view: dict[str, float], steps: int, *where: float) -> dict[str, float]:
    for _ in range(steps):
        view = {**view, **flown(view, *where, 0.02, RADIUS)}
    return view


@pytest.mark.parametrize("heading", [0.0, 37.0, 90.0, 200.0])
@pytest.mark.parametrize("altitude", [1.0, 4e5, 1e8, 1e12])
def test_the_sun_keeps_its_direction_in_space(heading: float, altitude: float) -> None:
    # Moving the observer does not move the sun. Rounding of a few hundred rotations.
    view = start(latitude=40.0, longitude=170.0, heading=heading, altitude=altitude)
    end = go(view, 300, 0.3, 1.0, 0.1)
    assert_allclose(sun_of(end), sun_of(view), rtol=0.0, atol=1e-11)


def test_flying_on_around_the_planet_leads_back() -> None:
    # A great circle closes after 2 pi; heading and the sun come back too.
    altitude = 4e5
    view = start(latitude=20.0, longitude=30.0, heading=70.0, altitude=altitude, look_zenith=90.0)
    whole = 2.0 * math.pi * (RADIUS + altitude)
    seconds = whole / (0.8 * (altitude + 5.0)) / 1000
    end = view
    for _ in range(1000):
        end = {**end, **flown(end, 0.0, 1.0, 0.0, seconds, RADIUS)}
    for path in view:
        if isinstance(view[path], float):
            assert_allclose(end[path], view[path], rtol=0.0, atol=1e-6, err_msg=path)


def test_over_the_pole_the_heading_turns_round_and_the_path_goes_on() -> None:
    # North over the pole is south on the other side, 180 degrees of longitude away.
    view = start(latitude=89.0, longitude=10.0, heading=0.0, altitude=1e5, look_zenith=90.0)
    end = view
    while end["view.latitude"] >= 89.0:
        end = {**end, **flown(end, 0.0, 1.0, 0.0, 0.02, RADIUS)}
    assert_allclose(end["view.longitude"], -170.0, atol=1e-9)
    assert_allclose(end["view.heading"], 180.0, atol=1e-9)


def test_it_never_gets_below_the_ground_nor_beyond_the_farthest() -> None:
    # 1 m and 1e12 m are the limits, for any line of sight and any time.
    down = go(start(look_zenith=180.0, altitude=3.0), 500, 0.0, 1.0, -1.0)
    assert down["view.altitude"] == 1.0
    up = go(start(look_zenith=180.0, altitude=3.0), 5000, 0.0, -1.0, 1.0)
    assert up["view.altitude"] == 1e12
    assert risen(up["view.altitude"], 5.0) == 1e12
    assert risen(down["view.altitude"], -50.0) == 1.0


def test_speed_is_in_proportion_to_the_distance_to_the_ground() -> None:
    # Ten times as high, ten times as fast: the path is the angle times the distance to the centre.
    ways = []
    for altitude in (1e4, 1e5):
        view = start(altitude=altitude, look_zenith=90.0)
        end = {**view, **flown(view, 0.0, 1.0, 0.0, 1e-3, RADIUS)}
        turn = np.linalg.norm(place_of(end) - place_of(view))
        ways.append(turn * (RADIUS + altitude))
    # 5 m are added to each distance
    assert_allclose(ways[1] / ways[0], 10.0, rtol=1e-3)


def test_climbing_in_small_steps_or_one_is_the_same() -> None:
    # The speed grows with the altitude: an exponential, exact for any step; and so is the tilt.
    view = start(look_zenith=80.0, altitude=1e6)
    one = flown(view, 0.0, 0.0, 1.0, 1.0, RADIUS)
    many = go(view, 50, 0.0, 0.0, 1.0)
    for path, value in one.items():
        assert_allclose(many[path], value, rtol=1e-12)


@pytest.mark.parametrize("look_zenith", [60.0, 95.0, 109.0, 150.0, 180.0])
def test_the_wheel_turned_out_keeps_the_planet_in_the_picture(look_zenith: float) -> None:
    # Far away its centre nears the middle, and the wheel turned back leads to the first view.
    session = Session("earth-atmosphere-plus")
    session.move({"view.altitude": 4e5, "view.look_zenith": look_zenith})
    flight = Flight(session)
    for _ in range(12):
        flight.wheel(-1.0)
        assert not flight.planet_hidden or look_zenith == 60.0
    far = session.view
    assert far["view.altitude"] > 1e10
    assert 180.0 - far["view.look_zenith"] < 0.05
    for _ in range(12):
        flight.wheel(1.0)
    assert_allclose(session.view["view.altitude"], 4e5, rtol=1e-9)
    assert_allclose(session.view["view.look_zenith"], look_zenith, rtol=1e-9)


def test_a_planet_seen_whole_follows_the_pointer() -> None:
    # Dragged to the right by the angle of a point's distance, the point below moves there: seen
    # north up the observer goes west, by drag times altitude over radius.
    session = Session("earth-atmosphere-plus")
    session.move({"view.altitude": 1.5e7, "view.look_zenith": 180.0, "view.heading": 0.0,
                  "view.latitude": 0.0, "view.longitude": 30.0})  # fmt: skip
    before, flight = dict(session.view), Flight(session)
    flight.look(0.01, 0.0)
    radius = flight.bottom_radius
    wanted = 0.01 * float(before["view.field_of_view"]) * 1.5e7 / radius
    assert_allclose(30.0 - float(session.view["view.longitude"]), wanted, rtol=1e-9)
    assert session.view["view.look_zenith"] == 180.0
    assert_allclose(sun_of(session.view), sun_of(before), atol=1e-12)  # type: ignore[arg-type]


def test_a_planet_that_is_a_dot_does_not_spin() -> None:
    # Across the whole picture half a turn, however far away.
    session = Session("earth-atmosphere-plus")
    session.move({"view.altitude": 1e12, "view.look_zenith": 180.0, "view.heading": 0.0,
                  "view.latitude": 0.0, "view.longitude": 30.0})  # fmt: skip
    Flight(session).look(0.1, 0.0)
    assert_allclose(session.view["view.longitude"], 30.0 - 18.0, atol=1e-9)


def test_a_far_planet_is_found_again() -> None:
    session = Session("earth-atmosphere-plus")
    session.move({"view.altitude": 1e9, "view.look_zenith": 90.0})
    assert Flight(session).planet_hidden
    session.change_view("home", home_view(session))
    assert not Flight(session).planet_hidden
    assert session.view["view.look_zenith"] == 180.0


def test_looking_straight_down_ahead_is_down() -> None:
    # The line of sight leads to the ground: sideways there is only rounding.
    view = start(look_zenith=180.0, altitude=1e6)
    end = flown(view, 0.0, 1.0, 0.0, 1.0, RADIUS)
    assert end["view.altitude"] < 1e6
    assert_allclose(
        end.get("view.latitude", view["view.latitude"]), view["view.latitude"], atol=1e-9
    )


def test_time_and_place_of_the_sun_are_each_others_inverse() -> None:
    # A round trip; at the poles and for a sun in the zenith an angle is arbitrary.
    for latitude in (-70.0, 0.0, 35.0):
        for declination in (-23.0, 5.0, 60.0):
            for hour in (0.5, 6.0, 11.0, 18.5, 23.0):
                zenith, azimuth = sun_at(latitude, declination, hour)
                assert_allclose(time_of(latitude, zenith, azimuth), (declination, hour), atol=1e-9)


def test_the_sun_is_highest_at_noon_by_latitude_less_declination() -> None:
    # Geometry of the sphere: 52 - 20 = 32 degrees from the zenith, in the south.
    assert_allclose(sun_at(52.0, 20.0, 12.0), (32.0, 180.0), atol=1e-12)
    assert_allclose(sun_at(52.0, 20.0, 0.0), (180.0 - 52.0 - 20.0, 0.0), atol=1e-12)


def test_the_sun_dragged_over_the_zenith_comes_down_the_other_side() -> None:
    # 10 degrees beyond the zenith is 10 degrees on the opposite bearing.
    assert sun_dragged(20.0, 90.0, 0.0, -30.0) == (10.0, 270.0)


def test_the_mouse_turns_the_picture_by_as_much_as_it_moves() -> None:
    # Level, 10 degrees to the right are 10 degrees of the compass; the zenith is the end.
    assert_allclose(looked(90.0, 180.0, 10.0, 0.0), (90.0, 190.0))
    assert looked(90.0, 180.0, 0.0, -100.0)[0] == 0.0


def test_keys_fly_while_they_are_held() -> None:
    # W is ahead, initially south; other keys are left to the host.
    session = Session("earth-atmosphere-plus")
    flight = Flight(session)
    assert not flight.press("x")
    assert not flight.step(0.1)
    assert flight.press("W")
    before = session.versions
    assert flight.step(0.1)
    assert session.value("view.latitude") < DEFAULTS["view.latitude"]
    assert session.versions.view > before.view
    assert session.versions.planet == before.planet
    assert flight.step(0.1)
    flight.release("w")
    assert not flight.moving
    # a held key is one undo step
    session.undo()
    assert session.value("view.latitude") == DEFAULTS["view.latitude"]
    assert not session.can_undo
