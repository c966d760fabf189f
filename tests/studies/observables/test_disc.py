"""Light of the whole disc: Lambert's sphere, thin Rayleigh gas, and what goes in comes out."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose
from spheres import HEIGHT, RADIUS, sphere

from airlight.errors import Cancelled
from airlight.solver.moments.solution import MomentsSolution
from airlight.studies.observables.disc import (
    disc_points,
    disc_reflectance,
    disc_stokes,
    spherical_albedo,
)
from airlight.studies.observables.distant_lines import disc_lines
from airlight.studies.observables.transit import transit

Solved = Callable[..., MomentsSolution]
GREEN = (550.0,)


@pytest.mark.parametrize("phase", [0.0, 1e-6, 40.0, 90.0, 135.0, 175.0, 180.0])
def test_points_cover_the_disc(phase: float) -> None:
    made = disc_points(1.0, 1.02, np.radians(phase))
    assert (made.area > 0.0).all()
    assert_allclose(made.area.sum(), np.pi * 1.02**2, rtol=1e-12)
    assert made.impact.max() < 1.02
    assert ((made.position >= -np.pi / 2) & (made.position <= np.pi)).all()


def test_lines_of_the_disc_are_those_of_an_observer_far_away(solved: Solved) -> None:
    # second way: the public door, from a million radii away
    solution = solved(sphere(0.1, 0.3), GREEN, "preview")
    top, far = solution.medium.top_radius, 1e6 * solution.medium.top_radius
    b, turn = np.array([0.1, 0.6, 0.99, 1.005]) * RADIUS, np.radians([10.0, 80.0, 120.0, 170.0])
    for phase in (0.0, 50.0, 130.0):
        lines = disc_lines(b, turn, np.radians(phase), RADIUS, top)
        public = solution.radiance(
            altitude=far - RADIUS, sun_zenith=phase,
            view_zenith=180.0 - np.degrees(np.arcsin(b / far)), azimuth=np.degrees(turn),
        )  # fmt: skip
        assert_allclose(solution.relative_radiance(lines), public.values, rtol=2e-4, atol=1e-9)


def test_a_lambert_sphere_has_two_thirds_of_its_albedo_and_lamberts_phase_law(
    solved: Solved,
) -> None:
    # Russell (1916): p = 2/3 A, Φ = (sin α + (π - α) cos α) / π; Bond albedo A
    solution = solved(sphere(0.0, 0.45), GREEN, "preview")
    angles = np.array([0.0, 20.0, 60.0, 90.0, 120.0, 150.0, 175.0])
    alpha = np.radians(angles)
    law = (np.sin(alpha) + (np.pi - alpha) * np.cos(alpha)) / np.pi
    values, errors = disc_reflectance(solution, angles, RADIUS)
    assert_allclose(values[:, 0], 0.45 * 2.0 / 3.0 * law, rtol=1e-6)
    assert errors.max() < 1e-5
    albedo, _ = spherical_albedo(solution, RADIUS)
    assert_allclose(albedo, 0.45, rtol=1e-4)


def test_thin_gas_over_black_ground_shines_by_rayleighs_phase_function(solved: Solved) -> None:
    # Optically thin at the limb too: light per irradiance is the number of molecules that are seen,
    # times σ p(α). At phase 0 those are the half of each shell that faces the observer, and what
    # looks out beside the ground's disc behind it; p(180°) = 3/(8π)
    depth = 1e-6
    values, _ = disc_reflectance(solved(sphere(depth, 0.0), GREEN, "preview"), np.zeros(1), RADIUS)
    r = np.linspace(RADIUS, RADIUS + 120e3, 200_001)
    seen = 2.0 * np.pi * r**2 * (1.0 + np.sqrt(1.0 - (RADIUS / r) ** 2))
    density = depth / HEIGHT * np.exp((RADIUS - r) / HEIGHT)
    number = np.trapezoid(density * seen, r) / RADIUS**2
    assert_allclose(values, number * 3.0 / (8.0 * np.pi), rtol=1e-3)


def test_thin_gas_is_polarised_as_its_molecules_are(solved: Solved) -> None:
    # single scattering: every point of the disc has the same degree and plane, sin²α/(1 + cos²α)
    # of Rayleigh's matrix, across the plane of star, planet and observer
    solution = solved(sphere(1e-6, 0.0), GREEN, "preview")
    angles = np.array([0.0, 30.0, 60.0, 90.0, 120.0, 150.0])
    values, _ = disc_stokes(solution, angles, RADIUS)
    alpha = np.radians(angles)
    law = np.sin(alpha) ** 2 / (1.0 + np.cos(alpha) ** 2)
    assert_allclose(values[:, 1, 0] / values[:, 0, 0], law, atol=2e-4)


def test_conservative_planets_send_all_light_back(
    solved: Solved, tell: Callable[[str], None]
) -> None:
    # Energy: on white ground under gas that absorbs nothing, what is scattered is all that does
    # not pass through: ∫ 2π b (1 - T) db, which is the transit's effective disc. `default` keeps
    # 99.89 % at depth 0.5.
    for depth in (0.05, 0.5):
        solution = solved(sphere(depth, 1.0), GREEN, "default")
        out, error = spherical_albedo(solution, RADIUS)
        taken = (transit(solution).radius / RADIUS) ** 2
        tell(f"depth {depth}: sent back {out[0] / taken[0]:.5f}, quadrature {error[0]:.1e}")
        assert_allclose(out, taken, rtol=2e-3)
        assert error.max() < 1e-3


def test_the_disc_can_be_cancelled_and_reports_its_progress(solved: Solved) -> None:
    solution = solved(sphere(0.0, 0.45), GREEN, "preview")
    said: list[tuple[int, int, str]] = []
    disc_reflectance(
        solution, np.array([0.0, 90.0]), RADIUS, progress=lambda *one: said.append(one)
    )
    assert [one[:2] for one in said] == [(0, 2), (1, 2), (2, 2)]
    with pytest.raises(Cancelled):
        disc_reflectance(solution, np.zeros(1), RADIUS, cancel=lambda: True)
