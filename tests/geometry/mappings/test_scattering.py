"""Bruneton's mappings of scattered light and irradiance: there and back, on any planet."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from airlight.geometry.mappings import irradiance
from airlight.geometry.mappings.scattering import (
    angle_coordinate,
    angle_from_coordinate,
    cosine_from_view,
    lowest_sun_cosine,
    possible_angle,
    sun_coordinate,
    sun_from_coordinate,
    view_coordinate,
    view_from_index,
    view_index,
)
from airlight.geometry.shell import distance_to_bottom, distance_to_top, horizon_cosine
from airlight.kernel import vectorized

#: Earth, Mars, Titan, a shell as thick as its planet, and a small planet with 1 km. [m]
SHELLS = [(6360e3, 6460e3), (3389.5e3, 3509.5e3), (2575e3, 3175e3), (1e6, 2e6), (1e5, 1.01e5)]
parametrize_shells = pytest.mark.parametrize(("bottom", "top"), SHELLS)


@parametrize_shells
@pytest.mark.parametrize("to_ground", [True, False])
def test_views_go_there_and_back_on_both_sides_of_the_horizon(
    bottom: float, top: float, to_ground: bool
) -> None:
    # mu → x → mu. Near the vertical mu moves little where x moves much, so mu is compared.
    x = np.linspace(0.0, 1.0, 201)[:, None]
    r = np.linspace(bottom, top, 40)[1 if to_ground else 0 : 40 if to_ground else 39]
    mu = vectorized(cosine_from_view)(x, to_ground, r, bottom, top)
    slope = np.diff(mu, axis=0)
    assert (slope > 0.0).all() if to_ground else (slope < 0.0).all()
    back = vectorized(cosine_from_view)(
        vectorized(view_coordinate)(r, mu, to_ground, bottom, top), to_ground, r, bottom, top
    )
    assert_allclose(back, mu, rtol=0, atol=1e-12)


@parametrize_shells
def test_ends_of_the_halves_are_the_vertical_and_the_horizon(bottom: float, top: float) -> None:
    # By definition, at every radius, ground and top included.
    r = np.linspace(bottom, top, 12)
    horizon = vectorized(horizon_cosine)(r, bottom)
    to_mu, to_x = vectorized(cosine_from_view), vectorized(view_coordinate)
    # On the ground the lower half has length 0 and keeps straight down only.
    assert_allclose(to_mu(0.0, True, r, bottom, top), -1.0, rtol=0, atol=1e-12)
    assert_allclose(to_mu(1.0, True, r[1:], bottom, top), horizon[1:], rtol=0, atol=1e-12)
    assert_allclose(to_mu(0.0, False, r, bottom, top), 1.0, rtol=0, atol=1e-12)
    assert_allclose(to_mu(1.0, False, r, bottom, top), horizon, rtol=0, atol=1e-9)
    assert_allclose(to_x(r, -1.0, True, bottom, top), 0.0, atol=1e-12)
    assert_allclose(to_x(r, 1.0, False, bottom, top), 0.0, atol=1e-12)
    assert_allclose(to_x(r, horizon, False, bottom, top), 1.0, rtol=0, atol=1e-9)
    # chord(horizon) is √ of a rounding: 1e-8 of the radius.
    assert_allclose(to_x(r[1:], horizon[1:], True, bottom, top), 1.0, rtol=0, atol=1e-5)


@parametrize_shells
def test_view_coordinate_is_the_distance_to_what_ends_the_view(bottom: float, top: float) -> None:
    # The definition of Bruneton & Neyret (2008), section 4.
    r = bottom + 0.4 * (top - bottom)
    rho, tangent = np.sqrt(r**2 - bottom**2), np.sqrt(top**2 - bottom**2)
    horizon = horizon_cosine(r, bottom)
    down, up = np.linspace(-1.0, horizon - 1e-6, 50), np.linspace(horizon + 1e-6, 1.0, 50)
    d = vectorized(distance_to_bottom)(r, down, bottom)
    expected = (d - (r - bottom)) / (rho - (r - bottom))
    actual = vectorized(view_coordinate)(r, down, True, bottom, top)
    assert_allclose(actual, expected, rtol=0, atol=1e-9)
    d = vectorized(distance_to_top)(r, up, top)
    expected = (d - (top - r)) / (rho + tangent - (top - r))
    actual = vectorized(view_coordinate)(r, up, False, bottom, top)
    assert_allclose(actual, expected, rtol=0, atol=1e-9)


@pytest.mark.parametrize("n", [8, 128])
def test_places_of_the_two_halves_do_not_meet(n: int) -> None:
    # Bruneton's order: horizon, straight down | straight up, horizon.
    assert (view_index(1.0, True, n), view_index(0.0, True, n)) == (0.0, n // 2 - 1.0)
    assert (view_index(0.0, False, n), view_index(1.0, False, n)) == (n // 2, n - 1.0)
    for k in range(n):
        x, to_ground = view_from_index(k, n)
        assert to_ground == (k < n // 2)
        assert_allclose(view_index(x, to_ground, n), k, rtol=0, atol=1e-13 * n)


@parametrize_shells
def test_sun_goes_there_and_back(bottom: float, top: float) -> None:
    # mu_s → x → mu_s, and both ends.
    lowest = lowest_sun_cosine(bottom, top)
    x = np.linspace(0.0, 1.0, 1001)
    mu_s = vectorized(sun_from_coordinate)(x, lowest, bottom, top)
    assert (np.diff(mu_s) > 0.0).all()
    assert_allclose(mu_s[[0, -1]], [lowest, 1.0], rtol=0, atol=1e-12)
    # Straight up the distance moves as the square of the angle: 1e-16 in mu_s is 1e-15 in x.
    back = vectorized(sun_coordinate)(mu_s, lowest, bottom, top)
    assert_allclose(back, x, rtol=0, atol=1e-11)
    assert sun_coordinate(max(lowest - 0.1, -1.0), lowest, bottom, top) <= 1e-12


@parametrize_shells
def test_beyond_the_lowest_sun_no_view_from_the_top_meets_lit_air(
    bottom: float, top: float
) -> None:
    # Walk along the tangent line from the top, towards the sun, to the other end of the shell:
    # there the sun must stand below the horizon.
    lowest = lowest_sun_cosine(bottom, top)
    if lowest == -1.0:
        # The sun is straight down at worst; three dips are more than a right angle.
        assert 3.0 * np.arccos(bottom / top) >= 0.5 * np.pi
        return
    dip = np.arccos(bottom / top)
    # Two dips on round the planet the star stands two dips higher in the sky.
    there = np.sin(np.arcsin(lowest) + 2.0 * dip)
    assert_allclose(there, horizon_cosine(top, bottom), rtol=0, atol=1e-9)


def test_the_limit_of_earth_is_below_the_constants_made_for_it() -> None:
    # -0.2 and -0.15 in the well-known programs cut twilight off; -0.3 is asked for.
    assert lowest_sun_cosine(6360e3, 6460e3) < -0.3


@given(nu=st.floats(-1.0, 1.0), mu=st.floats(-1.0, 1.0), mu_s=st.floats(-1.0, 1.0))
def test_possible_angles_lie_between_azimuth_0_and_180(nu: float, mu: float, mu_s: float) -> None:
    # cos(θ - θ_s) and cos(θ + θ_s) bound what the azimuth can do.
    theta, theta_s = np.arccos(mu), np.arccos(mu_s)
    held = possible_angle(nu, mu, mu_s)
    low, high = np.cos(theta + theta_s), np.cos(theta - theta_s)
    assert low - 1e-15 * 8 <= held <= high + 1e-15 * 8
    if low < nu < high:
        assert_allclose(held, nu, rtol=0, atol=1e-15)


@given(value=st.floats(-1.0, 1.0))
def test_linear_coordinates_go_there_and_back(value: float) -> None:
    # Inverses; adding 1 keeps 16 digits behind the point.
    assert_allclose(angle_from_coordinate(angle_coordinate(value)), value, rtol=0, atol=2.3e-16)
    back = irradiance.sun_from_coordinate(irradiance.sun_coordinate(value))
    assert_allclose(back, value, rtol=0, atol=2.3e-16)


@parametrize_shells
def test_irradiance_radius_goes_there_and_back(bottom: float, top: float) -> None:
    # Linear in altitude, exact at both ends.
    x = np.linspace(0.0, 1.0, 101)
    r = vectorized(irradiance.radius_from_coordinate)(x, bottom, top)
    assert_allclose(r[[0, -1]], [bottom, top], rtol=0, atol=0)
    back = vectorized(irradiance.radius_coordinate)(r, bottom, top)
    # r keeps 1e-16 of the radius, up to 1e-14 of a thin shell.
    assert_allclose(back, x, rtol=0, atol=1e-13)
