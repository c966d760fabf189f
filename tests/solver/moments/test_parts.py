"""Radiance split by order, constituent and ground."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.planets import load_planet
from airlight.solver import solve
from airlight.solver.moments.radiance_parts import Parts, radiance_parts
from airlight.solver.moments.solution import MomentsSolution

LOOKS = [0.0, 40.0, 85.0, 89.9, 95.0, 120.0, 180.0]


def solved(overrides: dict[str, object]) -> MomentsSolution:
    return solve(load_planet("earth-atmosphere-plus", overrides), quality="preview")


def taken_apart(solution: MomentsSolution, altitude: float, sun: float) -> tuple[Parts, np.ndarray]:
    lines, _ = solution.lines_of_sight(
        altitude=altitude, sun_zenith=sun, view_zenith=LOOKS, azimuth=30.0
    )
    return radiance_parts(solution, lines), solution.relative_radiance(lines)


@pytest.mark.parametrize(("altitude", "sun"), [(0.0, 60.0), (35e3, 89.0), (400e3, 95.0)])
def test_parts_sum_to_the_whole(altitude: float, sun: float) -> None:
    # Every photon seen was scattered once or more, by something. Float32 sums of some dozen
    # points: 2e-6.
    solution = solved({})
    parts, whole = taken_apart(solution, altitude, sun)
    assert_allclose(parts.total, whole, rtol=2e-6, atol=1e-9 * whole.max())


def test_black_ground_sends_nothing_and_clear_air_scatters_nothing() -> None:
    # Albedo 0 reflects nothing; ozone alone does not scatter.
    parts, whole = taken_apart(solved({"ground.albedo": 0.0}), 2e3, 60.0)
    assert_array_equal(parts.ground_star, 0.0)
    assert_array_equal(parts.ground_sky, 0.0)
    assert_array_equal(parts.scattered_once[:, 2], 0.0)  # ozone
    assert (parts.scattered_once[:, :2] > 0.0).all()
    assert (whole > 0.0).all()


def test_looking_up_shows_no_ground() -> None:
    # Lines above the horizon leave the air.
    parts, _ = taken_apart(solved({}), 2e3, 60.0)
    assert_array_equal(parts.ground_star[:4], 0.0)
    assert_array_equal(parts.ground_sky[:4], 0.0)
    assert (parts.ground_star[4:] > 0.0).all()
    assert (parts.ground_sky[4:] > 0.0).all()
