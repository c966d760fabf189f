"""Horizon, targets and the frame of the planet."""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.scene.directions import direction
from airlight.scene.observer import horizon_zenith, look_at, planet_frame

ROUNDING = 1e-14
EARTH = 6360e3


@given(altitude=st.floats(0.0, 1e12))
def test_line_to_the_horizon_touches_the_ground(altitude: float) -> None:
    # the nearest distance of the line to the centre is (R + h) sin(zenith): the ground's radius
    zenith = horizon_zenith(altitude, EARTH)
    off_nadir = math.radians(180.0 - zenith)
    # near 180° a degree has 180 ε of rounding, spread over R/(R + h)
    tolerance = 1e-12 + 1e-13 * altitude / EARTH
    assert_allclose((EARTH + altitude) * math.sin(off_nadir) / EARTH, 1.0, rtol=tolerance)


def test_dip_from_low_heights_keeps_its_digits() -> None:
    # sqrt(2h/R) is the dip's limit for small heights, next term relative 5/12 · h/R
    height = 1e-6
    dip = math.radians(horizon_zenith(height, EARTH) - 90.0)
    # the 90° take the last digits: half an ulp of 90° is 7e-15 deg
    assert_allclose(dip, math.sqrt(2.0 * height / EARTH), rtol=1e-8)


def test_targets_are_where_their_names_say() -> None:
    where = {"altitude": 0.0, "sun_zenith": 80.0, "bottom_radius": EARTH}
    assert look_at("horizon", **where) == (90.0, 0.0)
    assert look_at("sun", **where) == (80.0, 0.0)
    assert look_at("zenith", **where) == (0.0, 0.0)
    # as on a map, north is up, whose azimuth from a sun in the east-south-east is -112.5°
    assert look_at("nadir", **where, sun_azimuth="ESE") == (180.0, -112.5)


def test_an_unknown_target_is_refused() -> None:
    with pytest.raises(ParameterError, match="look_at is 'moon'; allowed: horizon, nadir"):
        look_at("moon", altitude=0.0, sun_zenith=0.0, bottom_radius=EARTH)


@given(
    latitude=st.floats(-90.0, 90.0),
    longitude=st.floats(-360.0, 360.0),
    bearing=st.floats(-360.0, 360.0),
)
def test_planet_frame_is_a_rotation(latitude: float, longitude: float, bearing: float) -> None:
    frame = planet_frame(latitude, longitude, bearing)
    assert_allclose(frame @ frame.T, np.eye(3), atol=ROUNDING)
    assert_allclose(np.linalg.det(frame), 1.0, atol=ROUNDING)


def test_sun_setting_in_the_west_is_above_longitude_minus_90() -> None:
    # at latitude and longitude 0 with the sun on the western horizon it is noon at 90° west
    frame = planet_frame(0.0, 0.0, 270.0)
    subsolar = frame @ direction(90.0, 0.0)
    longitude = math.degrees(math.atan2(subsolar[1], subsolar[0]))
    assert_allclose(longitude, -90.0, atol=1e-12)


@pytest.mark.parametrize("latitude", [-60.0, 0.0, 45.0])
def test_facing_a_northern_sun_east_is_on_the_right(latitude: float) -> None:
    frame = planet_frame(latitude, 10.0, 0.0)
    north_pole = np.array([0.0, 0.0, 1.0])
    # the pole's elevation is the latitude
    assert_allclose(frame.T @ north_pole, direction(90.0 - latitude, 0.0), atol=ROUNDING)
    east = np.array([-math.sin(math.radians(10.0)), math.cos(math.radians(10.0)), 0.0])
    assert_allclose(frame @ direction(90.0, 90.0), east, atol=ROUNDING)


def test_bearings_are_angles_from_the_sun_s_side() -> None:
    # the sun in the south-west: north-west is 90° to its right
    where = {"altitude": 0.0, "sun_zenith": 80.0, "bottom_radius": EARTH, "sun_azimuth": 225.0}
    assert look_at("NW", **where) == (90.0, 90.0)
    assert look_at("315°/20", **where) == (70.0, 90.0)
    assert look_at("-45", **where) == (90.0, 90.0)
    assert look_at("sun", **where) == (80.0, 0.0)
    assert look_at("moon", moon=(60.0, 180.0), **where) == (60.0, -45.0)


def test_bearing_without_elevation_is_on_the_horizon() -> None:
    zenith, _ = look_at("E", altitude=400e3, sun_zenith=80.0, bottom_radius=EARTH)
    assert zenith == horizon_zenith(400e3, EARTH)


@pytest.mark.parametrize("word", ["NNN", "361", "NE/91", "NE/", "", "north"])
def test_what_is_no_bearing_is_refused(word: str) -> None:
    with pytest.raises(ParameterError, match="a bearing such as NE"):
        look_at(word, altitude=0.0, sun_zenith=0.0, bottom_radius=EARTH)
