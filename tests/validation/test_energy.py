"""The energy suite: fluxes of light that is known, balances that hold, and one that must not."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import Medium
from airlight.solver import Solution, solve
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.report import Report
from airlight.validation.planets import flat_earth, furnace, round_earth
from airlight.validation.reference_earth import WAVELENGTHS
from airlight.validation.suite import SuiteRun

pytest.importorskip("matplotlib")

from airlight.validation.energy import energy, flat_balance, level_fluxes, net_gain, pieces
from airlight.validation.order_convergence import order_shares


class Even(Solution):
    """Light of radiance 1 from everywhere, on a real planet."""

    report = Report(solver="even", settings="", sweeps=1, residual=(0.0,), seconds=0.0)

    def __init__(self) -> None:
        self.medium = Medium.from_planet(round_earth(), WAVELENGTHS)
        self.highest_order = 3

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> np.ndarray:
        share = 1.0 if order is None else 0.75 * 0.25 ** (order - 1)
        return np.full((lines.r.size, 3), share)

    def relative_sky_irradiance(self, r: np.ndarray, mu_s: np.ndarray) -> np.ndarray:
        return np.full((r.size, 3), np.pi)

    relative_direct_irradiance = relative_sky_irradiance


@pytest.mark.parametrize("altitude", [0.0, 30e3, 100e3])
def test_even_light_has_the_fluxes_of_a_sphere(altitude: float) -> None:
    # ∫ cosθ dω over a half sphere is π, ∫ dω over the whole is 4π; the rules integrate
    # polynomials in mu of degree 15 a piece.
    flux = level_fluxes(Even(), altitude, np.array([-0.5, 0.7]))
    for got, expected in ((flux.down, np.pi), (flux.up, np.pi), (flux.scalar, 4.0 * np.pi)):
        assert_allclose(got, np.full((2, 3), expected), rtol=1e-12)


def test_pieces_integrate_a_polynomial_exactly() -> None:
    # Gauss-Legendre with n points: degree 2n - 1. ∫ x⁵ from -1 to 2 is 63/6.
    x, w = pieces([-1.0, 0.5, 2.0], 3)
    assert_allclose(w @ x**5, 63.0 / 6.0, rtol=1e-13)


def test_a_white_furnace_balances_and_an_earth_that_absorbs_does_not() -> None:
    # A law, and its reverse: through the ground of an absorbing Earth more enters than leaves.
    white, earth = (
        solve(planet, WAVELENGTHS, cache=False) for planet in (furnace(1.0), round_earth())
    )
    assert_allclose(net_gain(white, 2e3), 0.0, atol=5e-3)
    assert (net_gain(earth, 0.0) < -0.5).all()


def test_the_furnace_absorbs_nothing_and_the_flat_earth_is_the_round_one() -> None:
    medium = Medium.from_planet(furnace(1.0), WAVELENGTHS)
    assert_allclose(medium.absorption, 0.0, atol=0)
    assert_allclose(medium.ground_albedo, 1.0, atol=0)
    flat, curved = (Medium.from_planet(p, WAVELENGTHS) for p in (flat_earth(), round_earth()))
    assert_allclose(flat.vertical_optical_depth, curved.vertical_optical_depth, rtol=1e-12)
    assert_allclose(flat.bottom_radius, 1000.0 * curved.bottom_radius)


def test_shares_of_the_orders_are_those_of_a_known_series() -> None:
    # 3/4 (1 + 1/4 + 1/16 …) = 1, by construction.
    where = {"altitude": np.zeros(2), "sun_zenith": np.zeros(2), "view_zenith": np.zeros(2)}
    shares = order_shares(Even(), {**where, "azimuth": np.zeros(2)})
    assert_allclose(shares, [[0.75] * 2, [0.1875] * 2, [0.046875] * 2], rtol=1e-12)


@pytest.mark.slow
def test_a_flat_earth_balances_at_default_quality() -> None:
    # Conservation of energy where air and ground absorb, and reciprocity; the report's thresholds.
    thresholds, parts = flat_balance(SuiteRun())
    assert [threshold.name for threshold in thresholds if not threshold.passed] == []
    assert (len(thresholds), len(parts)) == (2, 3)


@pytest.mark.validation
def test_all_balances_hold_at_default_quality() -> None:
    # As above, of furnaces and of a round Earth too.
    suite = energy(SuiteRun(), order_solvers=())
    assert [threshold.name for threshold in suite.thresholds if not threshold.passed] == []
    assert len(suite.thresholds) == 5
