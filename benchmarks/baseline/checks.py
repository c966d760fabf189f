"""Whether a baseline gives the right numbers: what does not is not worth timing.

Each takes something with ``columns``, ``look_up`` and ``gather``: the module ``plain``, or
``compiled.Classic``.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from baseline import work

#: A table that is made in no time.
SMALL = (6, 16, 8, 4)


def columns_are_golden(baseline: Any) -> None:
    """The golden table of columns, converged by its source to 1e-13."""
    rays, expected = work.golden_rays()
    # The trapezoid of the vertical through the aerosol errs by (dx / H)² / 12: 100 km / 500 is a
    # sixth of 1.2 km. A column of less than 1 cm counts as none.
    assert_allclose(baseline.columns(*rays, work.AIR, 500), expected, rtol=2.5e-3, atol=0.01)
    assert_allclose(baseline.columns(*rays, work.AIR, 20_000), expected, rtol=2e-6, atol=0.01)


def look_ups_are_the_tables(baseline: Any) -> None:
    """``Table.look_up``, a second method for the same interpolation of the same float32 values."""
    table, positions = work.first_order(SMALL), work.positions(2000)
    got = baseline.look_up(table.values, positions, table.layout.grid)
    expected = table.look_up(positions.r, positions.mu, positions.mu_s, positions.nu)
    # float64 on both sides; the horizon's square roots lose half of the digits at most
    assert_allclose(got, expected, rtol=1e-6, atol=1e-9 * expected.max())


def gathers_are_exact_in_even_light(baseline: Any) -> None:
    """A law: twice Rayleigh's phase function is (1 + P2(nu) / 20) / 4π, by the addition theorem."""
    table, positions = work.first_order(SMALL), work.positions(20, lit_air=True)
    scattering = work.whole_air().scattering[0]
    ones = np.ones_like(table.values)
    legendre = 1.5 * positions.nu**2 - 0.5
    density = np.exp(-(positions.r - work.BOTTOM) / work.AIR[1])
    expected = (1.0 + legendre / 20.0) / (4.0 * np.pi) * density
    expected = expected[:, None] * scattering
    # The midpoint rule errs by (step of the zenith angle)² / 24 times the integrand at the poles
    # over its mean, at most (3/2)²: both phase functions at their largest.
    for directions in (work.DIRECTIONS, (64, 128)):
        error = (np.pi / directions[0]) ** 2 / 24.0 * 2.25
        got = baseline.gather(
            ones, positions, table.layout.grid, scattering, work.AIR[1], directions
        )  # fmt: skip
        assert_allclose(got, expected, rtol=error)
