"""Reflectance from colour: it has the colour, and nothing smoother has it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.image.spectral import default_wavelengths, rgb_weights, sun_color
from airlight.image.upsampling import reflectance_basis
from airlight.image.xyz import XYZ_TO_RGB
from airlight.physics.spectra.color_matching import cie_1931
from airlight.physics.spectra.sun import solar_irradiance

EYE = np.arange(360.0, 831.0)
COLORS = np.array([[0.9, 0.5, 0.2], [0.05, 0.1, 0.02], [0.01, 0.03, 0.09], [1.0, 0.0, 0.0]])


def test_white_and_grey_reflect_alike_at_every_wavelength():
    basis = reflectance_basis(np.arange(300.0, 901.0, 7.0))
    assert_allclose(basis.sum(axis=1), 1.0, rtol=1e-11)
    assert_allclose(basis @ np.full(3, 0.25), 0.25, rtol=1e-11)


def test_reflectance_has_the_colour_under_the_sun():
    # Integrated at 1 nm by the trapezoid, over the sun's own colour.
    light = (reflectance_basis(EYE) @ COLORS.T) * solar_irradiance(EYE)[:, None]
    xyz = np.trapezoid(light[:, None, :] * cie_1931().values[:, :, None], EYE, axis=0)
    assert_allclose((XYZ_TO_RGB @ xyz).T / sun_color(), COLORS, atol=1e-10)


def test_sixteen_wavelengths_keep_the_colour():
    # The way a renderer goes: reflectance at the solution's wavelengths, then their weights.
    at = default_wavelengths()
    radiance = (reflectance_basis(at) @ COLORS.T).T * solar_irradiance(at)
    assert_allclose(radiance @ rgb_weights(at) / sun_color(), COLORS, atol=0.004)


def test_no_reflectance_of_the_same_colour_is_less_steep():
    # Any change that keeps the three colour integrals adds to the sum of squared slopes.
    basis = reflectance_basis(EYE)
    trapezoid = np.ones(471)
    trapezoid[[0, -1]] = 0.5
    seen = (cie_1931().values @ XYZ_TO_RGB.T) * (solar_irradiance(EYE) * trapezoid)[:, None]
    orthogonal = np.linalg.qr(seen)[0]
    generator = np.random.default_rng(5)
    for color in COLORS:
        best = basis @ color
        for _ in range(20):
            change = np.cumsum(generator.normal(size=471)) * 1e-3
            change -= orthogonal @ (orthogonal.T @ change)
            steeper = np.sum(np.diff(best + change) ** 2)
            assert steeper > np.sum(np.diff(best) ** 2)


def test_colours_of_the_earth_stay_physical():
    # Sand, forest and sea of the Blue Marble need no clamping.
    reflectance = reflectance_basis(EYE) @ COLORS[:3].T
    assert reflectance.min() > 0.0
    assert reflectance.max() < 1.0


@pytest.mark.parametrize("wavelengths", [550.0, [0.0], [np.nan, 550.0]])
def test_what_is_no_wavelength_is_refused(wavelengths):
    with pytest.raises(ParameterError, match=r"^wavelengths is"):
        reflectance_basis(wavelengths)
