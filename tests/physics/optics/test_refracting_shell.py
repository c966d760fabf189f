"""Profiles by optical radius: columns are kept, and light that follows the ground is refused."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import DensitySegments, exponential, tent, uniform
from airlight.physics.optics.refracting_shell import RefractingShell

BOTTOM, THICK = 6371e3, 100e3
ROWS = [exponential(8434.0, THICK), tent(25e3, 15e3, THICK), uniform(THICK)]
NO_TENT = np.array([2.78e-4, 0.0, 0.0])


def shell(rows: list, refractivity: np.ndarray) -> RefractingShell:
    return RefractingShell.build(
        DensitySegments.from_rows(rows), refractivity, BOTTOM, BOTTOM + THICK
    )


def test_vertical_columns_are_those_of_the_profiles() -> None:
    # A vertical ray is not bent: ∫ ρ (dr/dx) dx = ∫ ρ dr. Pieces of the profile err by 5e-5.
    profiles = DensitySegments.from_rows(ROWS)
    assert_allclose(shell(ROWS, NO_TENT).density.columns[:3], profiles.columns, rtol=5e-5)


def test_optical_radius_is_the_radius_times_the_index() -> None:
    # The definition, with the top as vacuum: at the ground (n0 - 1)(1 - e^(-100/8.434)).
    found = shell(ROWS, NO_TENT)
    excess = 2.78e-4 * -np.expm1(-THICK / 8434.0)
    assert_allclose(found.bottom, BOTTOM * (1.0 + excess), rtol=1e-13)
    assert found.top == BOTTOM + THICK


def test_true_length_of_a_vertical_ray_is_the_shell_s_height() -> None:
    # The same integral of dr/dx alone.
    assert_allclose(shell(ROWS, NO_TENT).length.columns[0], THICK, rtol=5e-5)


def test_light_that_would_follow_the_ground_is_refused() -> None:
    # n0 - 1 above H/(R + H): d(n r)/dr < 0 at the ground. Venus is such a planet.
    with pytest.raises(ParameterError, match=r"refraction is 'bouguer'.*rays would be ducted"):
        shell(ROWS, np.array([1.4e-3, 0.0, 0.0]))


def test_refractivity_that_grows_with_height_is_refused() -> None:
    # The lower half of a tent: the bending would change its sign.
    with pytest.raises(ParameterError, match=r"increases with height at"):
        shell(ROWS, np.array([0.0, 1e-5, 0.0]))
