"""Errors of a sky: none of the solution's own light, and those that are put in."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.baking.air_light import AirLight, lines_of_sight
from airlight.engines.targets.sky_errors import half_losses, sky_errors, sky_positions
from airlight.planets import load_planet
from airlight.solver.tables.layout import Positions

COUNT = 200


@pytest.fixture(scope="module")
def air(solved: Callable[..., Any]) -> AirLight:
    return AirLight(solved(load_planet("earth-atmosphere-plus"), (550.0,), quality="preview"))


def test_the_solution_s_own_light_has_no_error(air: AirLight) -> None:
    medium = air.solution.medium
    light = medium.lights[0].irradiance

    def own(positions: Positions) -> Any:
        return air(lines_of_sight(positions, medium)) * light

    rows = sky_errors(air.solution, own, count=COUNT)
    assert [row.name for row in rows] == ["sky", "air before the ground", "sky in twilight"]
    assert max(row.largest for row in rows) < 1e-12
    brighter = sky_errors(air.solution, lambda one: 1.25 * own(one), count=COUNT)
    assert_allclose(brighter[0].median, 0.25, rtol=1e-12)  # the air is all light of the sky


def test_half_of_the_views_are_near_the_sun(air: AirLight) -> None:
    positions = sky_positions(air.solution.medium, 4000)
    away = np.degrees(np.arccos(positions.nu))
    assert (away < 60.0).mean() > 0.5
    assert 0.15 < (away < 5.0).mean() < 0.35
    assert positions.mu_s.min() > np.cos(np.radians(96.1))
    # view, sun and zenith make a spherical triangle
    spread = np.sqrt((1.0 - positions.mu**2) * (1.0 - positions.mu_s**2))
    assert (np.abs(positions.nu - positions.mu * positions.mu_s) <= spread + 1e-9).all()


def test_values_that_become_zero_in_half_precision_are_counted() -> None:
    notes = half_losses({"light": np.array([1.0, 1e-9, 0.0, 1e-7])})
    assert notes == (
        "light: 1 of 4 values (25 %) are below 3e-8, where half floats end, and become 0",
    )
    assert half_losses({"light": np.array([1.0, 0.0])}) == ()
