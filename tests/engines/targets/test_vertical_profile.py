"""Fits of densities by an exponential and by a tent."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets.fits.vertical_profile import (
    VerticalProfile,
    fit_exponential,
    fit_tent,
)
from airlight.errors import ParameterError
from airlight.planets.matter.profiles import Exponential, Tent

SHELL = 100e3
RADIUS = 6.371e6


def sampled(density):
    return VerticalProfile.sampled(density, SHELL, RADIUS)


@pytest.mark.parametrize("height", [1.2e3, 8e3, 30e3])
def test_exponential_is_found_again(height):
    air = sampled(lambda h: 3.0 * np.exp(-h / height))
    fit = fit_exponential(air)
    assert_allclose(fit.scale_height, height, rtol=1e-4)
    assert max(abs(one) for one in air.errors(fit).values()) < 1e-4


@pytest.mark.parametrize(("center", "width"), [(25e3, 15e3), (18e3, 6e3)])
def test_tent_is_found_again(center, width):
    ozone = sampled(lambda h: 2.0 * np.maximum(0.0, 1.0 - np.abs(h - center) / width))
    fit = fit_tent(ozone)
    assert_allclose([fit.center, fit.half_width], [center, width], rtol=1e-3)


def test_column_above_an_exponential_is_the_closed_form():
    air = sampled(lambda h: np.exp(-h / 8e3))
    exact = (np.exp(-air.altitudes / 8e3) - np.exp(-SHELL / 8e3)) / -np.expm1(-SHELL / 8e3)
    assert_allclose(air.above, exact, atol=1e-6)


def test_exponential_of_two_layers_lies_between_them_and_is_the_best_of_its_kind():
    # A second method: no other scale height has a smaller squared error of the columns.
    air = sampled(lambda h: 0.9 * np.exp(-h / 2.5e3) / 2.5e3 + 0.1 * np.exp(-h / 20e3) / 20e3)
    best = fit_exponential(air).scale_height
    assert 2.5e3 < best < 20e3

    def error(height):
        fit = air.of(Exponential(scale_height=height))
        return np.trapezoid((fit.above - air.above) ** 2, air.altitudes)

    assert error(best) < min(error(0.97 * best), error(1.03 * best))


def test_air_mass_of_a_thin_shell_is_that_of_a_sphere():
    # A shell of air at one altitude: 1/cos of the angle at which the line crosses it.
    high = sampled(lambda h: np.where(np.abs(h - 50e3) < 200.0, 1.0, 0.0))
    sine = RADIUS / (RADIUS + 50e3) * np.sin(np.radians(88.0))
    assert_allclose(high.air_mass(88.0), 1.0 / np.sqrt(1.0 - sine**2), rtol=1e-4)


def test_air_in_a_tent_at_the_ground_is_fitted_by_a_tent():
    low = sampled(lambda h: np.maximum(0.0, 1.0 - h / 10e3))
    fit = fit_tent(low)
    assert isinstance(fit, Tent)
    assert max(abs(one) for one in low.errors(fit).values()) < 5e-3


def test_nothing_is_refused():
    with pytest.raises(ParameterError, match="above 0"):
        sampled(np.zeros_like)
