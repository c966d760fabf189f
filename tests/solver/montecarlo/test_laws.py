"""Monte Carlo radiances against closed forms, the exact first order, and the balance of fluxes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal, assert_array_less

from airlight import solve
from airlight.geometry.quadrature import gauss_legendre
from airlight.planets import Planet
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential, Tent, Uniform
from airlight.solver.montecarlo.settings import MonteCarloSettings

SAMPLED = MonteCarloSettings(relative_error=0.004, exact_first_order=False)


@pytest.mark.parametrize(
    "disc",
    [
        0.0,
        pytest.param(0.27, marks=pytest.mark.validation),
        pytest.param(1.0, marks=pytest.mark.slow),
    ],
)
@pytest.mark.parametrize(
    "profile", [Exponential(scale_height=8e3), Tent(center=25e3, half_width=15e3)]
)
def test_sampled_first_order_is_the_exact_one(
    disc: float, profile: Exponential | Tent, one_air: Callable[..., Planet],
    tell: Callable[[str], None],
) -> None:  # fmt: skip
    # A second method: quadrature. Daylight, a star that sets, twilight seen from the ground and
    # from space, a view of the ground; 3 standard errors of each, fixed seed. Quadrature
    # averages light and phase function over the disc apart: for a disc four times the sun's that is
    # half set, this may come to 1 % (the disc's radius in radians, times the slope of ln p).
    planet = one_air(depth=0.2, profile=profile, albedo=0.3, disc=disc)
    solution = solve(planet, [550.0], SAMPLED, solver="montecarlo")
    altitude = np.array([0.0, 0.0, 0.0, 0.0, 500e3, 20e3, 0.0])
    sun = np.array([30.0, 70.0, 90.1, 93.0, 95.0, 60.0, 88.0])
    view = np.array([20.0, 85.0, 60.0, 80.0, 110.5, 130.0, 5.0])
    lines, _ = solution.lines_of_sight(
        altitude=altitude, sun_zenith=sun, view_zenith=view, azimuth=40.0
    )
    got = solution.trace(lines, order=1)
    exact = solution.first_order(lines)[:, 0, 0]
    value, error = got.parts[:, 0, 0], got.part_errors[:, 0, 0]
    for k in range(sun.size):
        tell(
            f"sampled order 1, disc {disc:g}°, sun {sun[k]:g}° view {view[k]:g}°: {value[k]:.3e}"
            f" for {exact[k]:.3e}, {(value[k] - exact[k]) / max(error[k], 1e-99):+.1f} errors"
        )
    assert (exact[:3] > 0.0).all()
    assert_array_less(error, 0.02 * exact + 1e-12)
    flat = 1e-2 if disc > 0.5 else 0.0
    assert_array_less(np.abs(value - exact), 3.0 * error + flat * exact + 1e-12)


def test_light_through_uniform_absorbing_air_obeys_beer(one_air: Callable[..., Planet]) -> None:
    # Air that scatters nothing: the lit ground through e^{-β L}, for a slanted view and star.
    # Relative error asked 0.2 %; 3 standard errors.
    absorbing = one_air(depth=0.0, absorption=1e-5, albedo=0.5, profile=Uniform(), thickness=50e3)
    settings = MonteCarloSettings(relative_error=0.002, exact_first_order=False)
    solution = solve(absorbing, [550.0], settings, solver="montecarlo")
    bottom, top = absorbing.bottom_radius, absorbing.top_radius
    data = solution.estimate(altitude=50e3, sun_zenith=40.0, view_zenith=180.0)
    mu_s = np.cos(np.radians(40.0))
    way = np.sqrt((bottom * mu_s) ** 2 + (top - bottom) * (top + bottom)) - bottom * mu_s
    expected = 0.5 / np.pi * mu_s * np.exp(-1e-5 * (50e3 + way))
    error = data["standard_error"].values
    assert_array_less(error, 0.0021 * expected)
    assert_allclose(data["radiance"].values, expected, rtol=0, atol=3.0 * error[0])
    # through the exact first order the same, without noise
    exact = solve(absorbing, [550.0], solver="montecarlo")
    got = exact.radiance(altitude=50e3, sun_zenith=40.0, view_zenith=180.0)
    assert_allclose(got.values, expected, rtol=1e-6)


def test_thin_air_scatters_once(one_air: Callable[..., Planet]) -> None:
    # The limit of small depth τ: radiance p(ν) τ/µ, and order 2 smaller by a factor of about τ.
    depth = 1e-5
    planet = one_air(depth=depth, profile=Uniform(), thickness=8e3, bottom=1e9)
    solution = solve(planet, [550.0], SAMPLED, solver="montecarlo")
    data = solution.estimate(altitude=0.0, sun_zenith=60.0, view_zenith=40.0, azimuth=180.0)
    nu = np.cos(np.radians(100.0))
    expected = 3.0 / (16.0 * np.pi) * (1.0 + nu * nu) * depth / np.cos(np.radians(40.0))
    error = float(data["standard_error"].values[0])
    assert error < 0.0041 * expected
    assert_allclose(data["radiance"].values, expected, rtol=3e-5, atol=3.0 * error)
    second = float(data["order_radiance"].sel(order=2).values[0])
    assert 0.0 < second < 100.0 * depth * expected


@pytest.mark.slow
@pytest.mark.parametrize(
    ("albedo", "phase"),
    [
        pytest.param(1.0, Rayleigh(), marks=pytest.mark.validation),
        (0.3, HenyeyGreenstein(asymmetry=0.7)),
    ],
)
def test_conservative_air_returns_what_the_ground_does_not_take(
    albedo: float, phase: Rayleigh | HenyeyGreenstein, one_air: Callable[..., Planet],
    tell: Callable[[str], None],
) -> None:  # fmt: skip
    # Energy: nothing absorbs but the ground, and a planet so large that its air is flat (curvature
    # changes fluxes by 1e-5): µ_s = upward flux at the top + (1 - albedo)·(direct + diffuse) below.
    planet = one_air(depth=1.5, phase=phase, albedo=albedo, bottom=1e10)
    solution = solve(planet, [550.0], MonteCarloSettings(relative_error=0.015), solver="montecarlo")
    mu_s = np.cos(np.radians(50.0))
    rule = gauss_legendre(6)
    mu, weight = rule.nodes, rule.weights * rule.nodes
    around = (np.arange(5) + 0.5) * 36.0
    views, azimuths = np.meshgrid(180.0 - np.degrees(np.arccos(mu)), around, indexing="ij")
    data = solution.estimate(altitude=100e3, sun_zenith=50.0, view_zenith=views, azimuth=azimuths)
    share = 2.0 * np.pi * weight[:, None] / around.size
    up = float((share * data["radiance"].values[..., 0]).sum())
    noise = float(np.sqrt(np.square(share * data["standard_error"].values[..., 0]).sum()))
    below = solution.irradiance(altitude=0.0, sun_zenith=50.0)
    taken = (1.0 - albedo) * float(below["direct"].values[0] + below["diffuse"].values[0])
    noise = float(np.hypot(noise, (1.0 - albedo) * 0.015 * below["diffuse"].values[0]))
    tell(f"energy, albedo {albedo}, {phase}: {(up + taken) / mu_s:.5f} ± {noise / mu_s:.5f}")
    assert noise < 0.01 * mu_s
    # 3 standard errors; five azimuths and a six-point rule are good to 1e-3 of the flux
    assert_allclose(up + taken, mu_s, rtol=0, atol=3.0 * noise + 1e-3 * mu_s)


@pytest.mark.slow
def test_places_drawn_in_light_change_the_noise_only(
    reference_earth: Callable[..., Planet], monkeypatch: pytest.MonkeyPatch
) -> None:
    # The same expectation by two ways of drawing, in twilight; 3.5 combined standard errors, and
    # the noise per history must fall: that is what it is for.
    from airlight.solver.montecarlo import estimate

    planet = reference_earth(albedo=0.1)
    settings = MonteCarloSettings(relative_error=1e-6, most_histories=200_000)
    where = {"altitude": 0.0, "sun_zenith": [93.0, 95.0], "view_zenith": [80.0, 20.0]}
    results = []
    for share in (0.0, 0.5):
        monkeypatch.setattr(estimate, "_SUN_SAMPLING_FRACTION", share)
        results.append(
            solve(planet, [440.0], settings, solver="montecarlo").estimate(**where, azimuth=150.0)
        )
    plain, lit = results
    combined = np.hypot(plain["standard_error"], lit["standard_error"]).values
    assert_array_less(np.abs(plain["radiance"] - lit["radiance"]).values, 3.5 * combined)
    assert_array_less(lit["standard_error"].values, 0.8 * plain["standard_error"].values)


def test_light_that_grazes_a_cloud_of_many_depths_is_finite(
    one_air: Callable[..., Planet], monkeypatch: pytest.MonkeyPatch
) -> None:
    # Half a thousand optical depths that absorb nothing: radiance from above lies between 0 and
    # that of a white Lambert ground, and the histories end although nothing absorbs.
    planet = one_air(depth=500.0, profile=Exponential(scale_height=8e3))
    from airlight.solver.montecarlo import estimate

    monkeypatch.setattr(estimate, "BLOCK", 256)
    settings = MonteCarloSettings(relative_error=0.1, most_histories=1_000)
    data = solve(planet, [550.0], settings, solver="montecarlo").estimate(
        altitude=100e3, sun_zenith=30.0, view_zenith=150.0, azimuth=90.0
    )
    radiance = float(data["radiance"].values[0])
    assert 0.5 * np.cos(np.radians(30.0)) / np.pi < radiance < 1.5 / np.pi


def test_night_far_from_the_terminator_is_dark(one_air: Callable[..., Planet]) -> None:
    # The star in the nadir: no light is found, and that is said rather than an error of 0.
    solution = solve(one_air(depth=0.1), [550.0], "preview", solver="montecarlo")
    data = solution.estimate(altitude=0.0, sun_zenith=180.0, view_zenith=0.0)
    assert_array_equal(data["radiance"].values, 0.0)
    assert not data["reached"].values.any()
    assert "NOT within" in str(solution.report)


@pytest.mark.slow
def test_light_that_is_scattered_thousands_of_times_is_not_cut_off(
    one_air: Callable[..., Planet], tell: Callable[[str], None]
) -> None:
    # Flat conservative air of depth τ that scatters evenly, a star overhead, a black ground: the
    # flux below is u(1)·4/(3(τ + 1.4209)), u(1) = √3/4·H(1) with H(1) = 2.9078 (Chandrasekhar 1960,
    # table XI). Four million histories that ended by 1/20 an event from the hundredth on: 1e-6.
    depth = 45.0
    planet = one_air(
        depth=depth, profile=Uniform(), phase=HenyeyGreenstein(asymmetry=0.0), bottom=1e10,
        thickness=8e3,
    )  # fmt: skip
    settings = MonteCarloSettings(relative_error=0.03, polarisation=False, exact_first_order=False)
    solution = solve(planet, [550.0], settings, solver="montecarlo", polarisation=False)
    got = float(solution.irradiance(altitude=0.0, sun_zenith=0.0)["diffuse"].values[0])
    expected = 0.25 * np.sqrt(3.0) * 2.9078 * 4.0 / (3.0 * (depth + 1.4209))
    tell(f"light below air of depth {depth:g}: {got:.4e} for {expected:.4e}")
    assert solution.report.unreached == 0
    assert_allclose(got, expected, rtol=0.09)  # three standard errors
