"""Scenes by place and time: directions on the ground's map, and the light of that day."""

from __future__ import annotations

from datetime import UTC, datetime

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet
from airlight.errors import ParameterError
from airlight.geometry.ephemeris.instant import days_of
from airlight.geometry.ephemeris.sky import Place, moon_seen
from airlight.geometry.ephemeris.sun_vector import solar_point
from airlight.physics.constants import ASTRONOMICAL_UNIT
from airlight.planets.medium import Medium
from airlight.scene.apparent_sun import apparent_altitude, apparent_zenith
from airlight.solver.refracted_geometry import RefractedGeometry

TIME = datetime(2026, 6, 21, 14, 10, tzinfo=UTC)


@pytest.mark.parametrize("name", ["earth", "mars-rayleigh", "titan"])
def test_sun_of_a_scene_stands_above_the_point_below_it(name: str) -> None:
    # two ways to the same vector of the planet's frame: by the scene's angles, and directly
    planet = load_planet(name)
    scene = Scene.at(planet, latitude=-33.0, longitude=70.0, time=TIME)
    point = solar_point(planet.world, days_of(TIME))
    latitude, longitude = np.radians([point.latitude, point.longitude])
    flat = np.cos(latitude)
    expected = [flat * np.cos(longitude), flat * np.sin(longitude), np.sin(latitude)]
    # 0.0024° of parallax on Earth
    assert_allclose(scene.ground_frame @ scene.sun_direction, expected, rtol=0, atol=5e-5)


def test_camera_looks_where_it_is_told() -> None:
    earth = load_planet("earth")
    where = {"latitude": 59.33, "longitude": 18.07, "time": TIME}
    sun = Scene.at(earth, **where, look_at="sun")
    assert sun.camera.look_azimuth == 0.0
    # a law, far from the horizon: (n - 1)(1 - H/R) tan z, with 2.777e-4 (Peck & Reeder 1972)
    lift = 57.2 / 3600.0 * np.tan(np.radians(sun.sun_zenith))
    assert sun.camera.look_zenith == pytest.approx(sun.sun_zenith - lift, abs=1.0 / 3600.0)
    moon = Scene.at(earth, **where, look_at="moon", camera=Camera(width=8, height=6))
    seen = moon_seen(Place(latitude=59.33, longitude=18.07, altitude=2.0), TIME)
    north, west, up = moon.ground_frame.T @ moon.ground_frame @ moon.camera.axes[2]
    east_north_up = seen.direction
    # local frame: x to the sun's bearing, y left of it
    turn = np.radians(moon.sun_azimuth)
    along = east_north_up[1] * np.cos(turn) + east_north_up[0] * np.sin(turn)
    left = east_north_up[1] * np.sin(turn) - east_north_up[0] * np.cos(turn)
    assert np.arctan2(west, north) == pytest.approx(np.arctan2(left, along), abs=1e-9)
    lift = np.degrees(np.arcsin(up) - np.arcsin(east_north_up[2]))
    assert lift == pytest.approx(57.2 / 3600.0 * np.sqrt(1.0 - up**2) / up, abs=2.0 / 3600.0)
    assert moon.camera.width == 8


def test_scene_says_its_time() -> None:
    scene = Scene.at(load_planet("earth"), latitude=0.0, longitude=0.0, time="2026-06-21T12:00Z")
    assert scene.metadata()["time"] == "2026-06-21T12:00:00Z"
    assert "time" not in Scene().metadata()


def test_planet_that_is_no_known_world_is_refused() -> None:
    with pytest.raises(ParameterError, match="body is missing; allowed: one of earth, mars, titan"):
        Scene.at(load_planet("exoplanet"), latitude=0.0, longitude=0.0, time=TIME)


def test_light_of_a_day_follows_the_distance() -> None:
    # perihelion 2026-01-03 17:16 UTC, 0.9833020 au; aphelion 2026-07-06 17:30, 1.0166441 au (USNO)
    earth = load_planet("earth")
    near = earth.lit_at(datetime(2026, 1, 3, 17, 16, tzinfo=UTC)).star
    far = earth.lit_at(datetime(2026, 7, 6, 17, 30, tzinfo=UTC)).star
    # centres of sun and Earth, by a truncated theory: 1e-5
    assert near.distance == pytest.approx(0.9833020 * ASTRONOMICAL_UNIT, rel=1e-5)
    assert far.distance == pytest.approx(1.0166441 * ASTRONOMICAL_UNIT, rel=1e-5)
    ratio = near.irradiances([550.0]) / far.irradiances([550.0])
    assert_allclose(ratio, (1.0166441 / 0.9833020) ** 2, rtol=5e-5)
    # the sun's radius over its distance, to three digits
    assert near.angular_radius_degrees == pytest.approx(0.2665 / 0.98330, abs=5.1e-4)


def test_sun_on_the_horizon_is_lifted_as_in_almanacs() -> None:
    earth = load_planet("earth")
    # 34' where it is seen on the horizon, for an air of 10 °C; this one has 15 °C: 33'
    lift = apparent_altitude(earth, 0.0, 90.0 + 33.0 / 60.0)
    assert lift == pytest.approx(0.0, abs=2.5 / 60.0)
    assert apparent_altitude(earth, 0.0, 95.0) is None
    assert apparent_altitude(earth, 200e3, 60.0) is None
    assert apparent_altitude(load_planet("mars-rayleigh"), 0.0, 60.0) is None


def test_apparent_zenith_angles_are_those_of_almanacs() -> None:
    # Bennett (1982), J. Inst. Navigation 35, 255, for 10 °C and 1010 hPa, accurate to 0.07'; this
    # air of 15 °C has 2 % less
    earth = load_planet("earth")
    for altitude in (0.5, 2.0, 5.0, 10.0, 30.0, 60.0):
        minutes = 1.0 / np.tan(np.radians(altitude + 7.31 / (altitude + 4.4)))
        seen = 90.0 - apparent_zenith(earth, 0.0, 90.0 - altitude + minutes / 60.0)
        assert seen == pytest.approx(altitude, abs=(0.04 * minutes + 0.1) / 60.0)
    assert apparent_zenith(load_planet("mars-rayleigh"), 0.0, 60.0) == 60.0


@pytest.mark.parametrize("altitude", [0.0, 12e3, 90e3, 110e3, 400e3, 3.84e8])
def test_a_body_behind_the_limb_is_seen_where_its_ray_leads(altitude: float) -> None:
    # a second method: the star's table inside the air; outside, a ray that grazes the ground is
    # bent as much as two from the ground to space, and one that misses the air goes straight
    earth = load_planet("earth")
    geometry = RefractedGeometry.of(Medium.from_planet(earth, [550.0]))
    assert geometry.shell is not None
    r = earth.bottom_radius + altitude
    x = float(geometry.optical_radius(np.array(r)))
    horizon = 180.0 - np.degrees(np.arcsin(geometry.shell.bottom / x))
    if altitude > earth.thickness:
        lift = np.degrees(geometry.max_refraction)
        above = 180.0 - np.degrees(np.arcsin(earth.top_radius / r))
        assert_allclose(apparent_zenith(earth, altitude, above), above, atol=1e-4)
    else:
        lift = np.degrees(
            float(
                geometry.refraction_angle(
                    np.array([x]),
                    np.array([-np.sqrt(1.0 - (geometry.shell.bottom / x) ** 2) + 1e-12]),
                )[0]
            )
        )
        for one in (20.0, 85.0, horizon - 0.02):
            seen = apparent_altitude(earth, altitude, one)
            assert seen is not None
            assert_allclose(apparent_zenith(earth, altitude, one), 90.0 - seen, atol=2e-3)
    assert_allclose(apparent_zenith(earth, altitude, horizon + 0.999999 * lift), horizon, atol=2e-3)
    # no leap as it sets, and its true place once it is far below
    near = np.array([apparent_zenith(earth, altitude, horizon + lift + d) for d in (-1e-4, 1e-4)])
    assert abs(np.diff(near)[0]) < 2e-3
    assert (
        apparent_zenith(earth, altitude, horizon + 5.0 * lift + 0.01) == horizon + 5.0 * lift + 0.01
    )


def test_clouds_leave_the_apparent_sun_where_it_is() -> None:
    clear = load_planet("earth")
    cloudy = load_planet("earth", {"clouds": [{"kind": "cumulus"}]})
    seen = [Scene(sun_zenith=89.5).aimed("sun", planet).camera for planet in (clear, cloudy)]
    assert seen[0] == seen[1]
    assert seen[0].look_zenith < 89.3  # refracted
