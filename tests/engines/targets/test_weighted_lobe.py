"""Weighted lobe: exact where the phase function is one, and better than one lobe elsewhere."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from airlight.engines.targets.fits.weighted_lobe import fit_weighted_lobe, hat_functions
from airlight.kernel import vectorized
from airlight.physics.optics.phase_functions import (
    cornette_shanks,
    double_henyey_greenstein,
    rayleigh,
)

lobe: Any = vectorized(cornette_shanks)
even: Any = vectorized(rayleigh)
double: Any = vectorized(double_henyey_greenstein)


def test_shares_of_the_texels_add_up_to_one() -> None:
    nu = np.linspace(-1.0, 1.0, 101)
    assert_allclose(hat_functions(nu, 8).sum(axis=-1), 1.0, rtol=1e-14)
    assert_allclose(hat_functions(nu, 8) @ np.linspace(-1.0, 1.0, 8), nu, atol=1e-14)


def test_a_lobe_is_fitted_by_itself() -> None:
    # Weights 1 and 0 are the exact solution.
    fit = fit_weighted_lobe(("a",), lambda k, nu: lobe(nu, 0.71)[:, None], np.ones((1, 1)), 8)
    assert_allclose(fit.g, 0.71, atol=2e-3)
    assert_allclose(fit.lobe + fit.smooth, 1.0, atol=0.05)
    assert fit.fitted[0].errors["largest, relative"] < 2e-3


def test_two_kinds_keep_their_phase_functions_under_one_lobe() -> None:
    def phases(k: int, nu: np.ndarray) -> np.ndarray:
        return double(nu, 0.7, -0.3, 0.9)[:, None] if k else even(nu, 0.0)[:, None]

    fit = fit_weighted_lobe(("gas", "dust"), phases, np.ones((2, 1)), 8)
    for one in fit.fitted:
        alone = next(value for name, value in one.errors.items() if "without weights" in name)
        assert one.errors["root mean square, relative"] < 0.05 < alone
    nu = np.cos(np.radians([3.0, 30.0, 100.0, 170.0]))
    hats = hat_functions(nu, 8)
    for k in (0, 1):
        made = hats @ fit.lobe[k, 0] * lobe(nu, fit.g) + hats @ fit.smooth[k, 0] * even(nu, 0.0)
        assert_allclose(made, phases(k, nu)[:, 0], rtol=0.1)


def test_one_row_of_weights_serves_wavelengths_that_differ_by_a_factor() -> None:
    # What a texture of red alone can hold: the same row, brighter or dimmer.
    def phases(k: int, nu: np.ndarray) -> np.ndarray:
        return np.stack([double(nu, 0.8, -0.3, w) for w in (0.95, 0.9, 0.8)], axis=-1)

    fit = fit_weighted_lobe(("dust",), phases, np.ones((1, 3)), 8, one_row=True)
    row = fit.lobe[0] / fit.lobe[0][:, -1:]
    assert_allclose(row, np.broadcast_to(row[0], row.shape), atol=1e-9)
    assert (np.diff(fit.lobe[0][:, -1]) < 0.0).all()  # less forward, dimmer
    assert fit.fitted[0].errors["root mean square, relative"] < 0.05


def test_air_without_particles_has_no_lobe() -> None:
    fit = fit_weighted_lobe((), lambda k, nu: nu, np.zeros((0, 3)), 8)
    assert (fit.g, fit.lobe.shape, fit.fitted) == (0.0, (0, 3, 8), ())
