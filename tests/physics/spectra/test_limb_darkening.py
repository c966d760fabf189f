"""Limb darkening: means, the measured sun, and a grey atmosphere as the second method."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.spectra.limb_darkening import UNIFORM, black_body_darkening, solar_darkening

VISIBLE = np.arange(300.0, 1101.0, 12.5)
MU = np.linspace(0.0, 1.0, 201)


def profile(law: np.ndarray) -> np.ndarray:
    return law @ MU ** np.arange(law.shape[1])[:, None]


@pytest.mark.parametrize("law", [solar_darkening(VISIBLE), black_body_darkening(VISIBLE, 3300.0),
                                 np.array([UNIFORM])])  # fmt: skip
def test_the_mean_of_the_disc_is_one(law: np.ndarray) -> None:
    weight = np.full(MU.size, MU[1])
    weight[[0, -1]] *= 0.5
    assert_allclose(profile(law) @ (2.0 * MU * weight), 1.0, rtol=1e-4)


def test_the_sun_is_darkened_by_six_tenths() -> None:
    # The textbook's linear law of the visual sun, L = 1 - 0.6 (1 - μ), of mean 1 - 0.6/3.
    assert_allclose(1.0 / solar_darkening([550.0]).sum(axis=1), 0.8, atol=0.01)


def test_darkening_is_stronger_in_blue_and_monotonic() -> None:
    law = solar_darkening(np.arange(425.0, 1100.0, 25.0))
    rim = law[:, 0] / law.sum(axis=1)
    assert np.all(np.diff(rim) > 0.0)
    assert np.all(np.diff(profile(law), axis=1) > 0.0)
    assert np.all(profile(solar_darkening(VISIBLE)) > 0.0)


@pytest.mark.parametrize("nm", [450.0, 550.0, 650.0, 800.0])
def test_a_grey_atmosphere_is_close_to_the_sun(nm: float) -> None:
    radius = np.array([0.0, 0.5, 0.8, 0.9, 0.95, 0.98])
    powers = np.sqrt(1.0 - radius**2)[:, None] ** np.arange(6)
    sun = powers @ solar_darkening([nm])[0]
    grey = powers @ black_body_darkening([nm], 5772.0)[0]
    assert_allclose(grey, sun, rtol=0.05)


@pytest.mark.parametrize("temperature", [100.0, 3000.0, 1e6])
def test_no_star_has_a_negative_rim(temperature: float) -> None:
    law = black_body_darkening([380.0, 550.0, 780.0], temperature)
    assert np.all(profile(law) > -1e-3)


def test_a_temperature_must_be_one() -> None:
    with pytest.raises(ParameterError, match=r"temperature is 0.0; allowed: above 0 K"):
        black_body_darkening([550.0], 0.0)
