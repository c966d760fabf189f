"""Polarised light of histories: closed forms, symmetries and the corrected Coulson tables."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal, assert_array_less

from airlight import ParameterError, load_planet, solve
from airlight.planets import Planet
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.solver.montecarlo.settings import MonteCarloSettings

ALL_SAMPLED = MonteCarloSettings(relative_error=0.003, exact_first_order=False)
#: Lines of sight all over the sky, on both sides of the star, and from space.
LINES: dict[str, Any] = {
    "altitude": [0.0, 0.0, 0.0, 0.0, 400e3],
    "sun_zenith": [50.0, 50.0, 80.0, 10.0, 40.0],
    "view_zenith": [60.0, 60.0, 30.0, 85.0, 170.0],
    "azimuth": [100.0, -100.0, 170.0, 20.0, 60.0],
}


def directions(zenith: Any, azimuth: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Unit vector of a direction, and its e_θ and e_φ, each of shape (3, n)."""
    theta, phi = np.radians(zenith), np.radians(azimuth)
    phi = np.broadcast_to(phi, np.shape(theta))
    sine, cosine, zero = np.sin(theta), np.cos(theta), np.zeros_like(theta)
    return (
        np.array([sine * np.cos(phi), sine * np.sin(phi), cosine]),
        np.array([cosine * np.cos(phi), cosine * np.sin(phi), -sine]),
        np.array([-np.sin(phi), np.cos(phi), zero]),
    )


@pytest.mark.parametrize("exact", [True, False])
@pytest.mark.parametrize("depolarisation", [0.0, 0.1])
def test_light_scattered_once_swings_across_the_plane_of_star_and_line(
    exact: bool, depolarisation: float, one_air: Callable[..., Planet]
) -> None:
    # Closed form of thin air: degree of polarisation Δ sin²Θ / (Δ(1 + cos²Θ) + 4(1-Δ)/3), along
    # view x star; 4 standard errors, and for the exact first order the other orders' 2e-5.
    planet = one_air(depth=1e-5, phase=Rayleigh(depolarisation=depolarisation))
    settings = MonteCarloSettings(relative_error=0.01, exact_first_order=exact)
    data = solve(planet, [550.0], settings, solver="montecarlo").estimate(**LINES, stokes=True)
    assert data["stokes_radiance"].dims == ("case", "stokes", "wavelength")
    assert data["stokes"].values.tolist() == ["I", "Q", "U"]
    found = data["stokes_radiance"].values[..., 0]
    errors = data["stokes_standard_error"].values[..., 0]
    view, along, aside = directions(LINES["view_zenith"], LINES["azimuth"])
    star, _, _ = directions(LINES["sun_zenith"], 0.0)
    nu = (view * star).sum(axis=0)
    part = (1.0 - depolarisation) / (1.0 + 0.5 * depolarisation)
    degree = part * (1.0 - nu**2) / (part * (1.0 + nu**2) + 4.0 * (1.0 - part) / 3.0)
    swing = np.cross(view.T, star.T).T
    angle = np.arctan2((swing * aside).sum(axis=0), (swing * along).sum(axis=0))
    for row, expected in ((1, np.cos(2.0 * angle)), (2, np.sin(2.0 * angle))):
        off = np.abs(found[:, row] - degree * expected * found[:, 0])
        assert_array_less(off, 4.0 * np.hypot(errors[:, row], errors[:, 0]) + 1e-4 * found[:, 0])
    assert (errors[:, 0] < 0.011 * found[:, 0]).all()


def test_q_is_even_and_u_is_odd_across_the_star_s_meridian(one_air: Callable[..., Planet]) -> None:
    # Mirror symmetry. In the meridian itself U is 0, here of all orders within 4 standard errors.
    solution = solve(one_air(depth=0.5, albedo=0.2), [550.0], ALL_SAMPLED, solver="montecarlo")
    where: dict[str, Any] = {"altitude": 0.0, "sun_zenith": 60.0, "view_zenith": 40.0}
    left, right, ahead, behind = (
        solution.estimate(**where, azimuth=azimuth, stokes=True)
        for azimuth in (-70.0, 70.0, 0.0, 180.0)
    )
    a, b = (one["stokes_radiance"].values[:, 0] for one in (left, right))
    assert_array_equal(a * [1.0, 1.0, -1.0], b)
    assert abs(b[2]) > 0.1 * b[0]
    for one in (ahead, behind):
        u = one["stokes_radiance"].values[2, 0]
        assert abs(u) < 4.0 * one["stokes_standard_error"].values[2, 0]


def test_the_zenith_has_one_polarisation_in_every_frame(one_air: Callable[..., Planet]) -> None:
    # At the zenith the azimuth only names the axes: Q = q cos 2φ, U = -q sin 2φ, |q| as large as
    # just beside it.
    solution = solve(one_air(depth=0.3), [550.0], ALL_SAMPLED, solver="montecarlo")
    azimuth = np.array([0.0, 30.0, 45.0, 90.0, -60.0])
    found = solution.radiance(
        altitude=0.0, sun_zenith=70.0, view_zenith=0.0, azimuth=azimuth, stokes=True
    ).values[..., 0]
    near = solution.radiance(
        altitude=0.0, sun_zenith=70.0, view_zenith=0.1, azimuth=azimuth, stokes=True
    ).values[..., 0]
    assert found[0, 1] < 0.0  # across the meridian of the star
    # 0.3 % of noise, of both
    assert_allclose(found, near, rtol=0, atol=0.015 * found[0, 0])
    assert_allclose(np.hypot(found[:, 1], found[:, 2]), -found[0, 1], rtol=1e-3)


def test_air_that_does_not_polarise_is_scalar(one_air: Callable[..., Planet]) -> None:
    # F12 = 0 from the start and for ever: I, histories and all, is that of scalar transfer.
    planet = one_air(depth=0.5, albedo=0.3, phase=HenyeyGreenstein(asymmetry=0.5))
    settings = MonteCarloSettings(relative_error=0.01)
    vector = solve(planet, [550.0], settings, solver="montecarlo")
    scalar = solve(planet, [550.0], settings, solver="montecarlo", polarisation=False)
    found = vector.radiance(**LINES, stokes=True).values
    assert_allclose(found[:, 0], scalar.radiance(**LINES).values, rtol=1e-12)
    assert_array_equal(found[:, 1:], 0.0)


def test_scalar_transfer_has_no_stokes_parameters() -> None:
    # One clear line, from every solver; the direct one says in its report that it is scalar.
    earth = load_planet("earth-atmosphere-plus")
    scalar = solve(earth, [550.0], "preview", solver="montecarlo", polarisation=False)
    assert not scalar.polarised
    for ask in (scalar.radiance, scalar.estimate):
        with pytest.raises(
            ParameterError, match=r"stokes is True; allowed: a solution with polarised"
        ):
            ask(altitude=0.0, sun_zenith=60.0, view_zenith=0.0, stokes=True)
    vector = solve(earth, [550.0], "preview", solver="montecarlo")
    lines, _ = vector.lines_of_sight(altitude=0.0, sun_zenith=60.0, view_zenith=30.0)
    assert_allclose(vector.relative_stokes(lines, order=1), vector.first_order(lines), rtol=1e-12)
    with pytest.raises(ParameterError, match="order is 2; allowed: 1, or all orders together"):
        vector.relative_stokes(lines, order=2)
