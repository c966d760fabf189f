"""The colour of one wavelength, with its three normalizations."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.image.spectral_color import wavelength_color
from airlight.image.xyz import chromaticity, rgb_to_xyz
from airlight.physics.spectra.color_matching import cie_1931

VISIBLE = np.arange(360.0, 831.0, 5.0)


def test_without_normalization_it_is_the_matching_functions():
    assert_allclose(rgb_to_xyz(wavelength_color(VISIBLE)), cie_1931().at(VISIBLE), atol=1e-14)


def test_sum_normalization_makes_the_tristimulus_values_add_to_one():
    assert_allclose(rgb_to_xyz(wavelength_color(VISIBLE, "sum")).sum(axis=-1), 1.0, rtol=1e-12)


def test_peak_normalization_makes_the_largest_channel_one():
    assert_allclose(wavelength_color(VISIBLE, "peak").max(axis=-1), 1.0, rtol=1e-15)


@pytest.mark.parametrize("normalization", ["sum", "peak"])
def test_normalization_keeps_the_chromaticity(normalization):
    plain = chromaticity(rgb_to_xyz(wavelength_color(VISIBLE)))
    assert_allclose(chromaticity(rgb_to_xyz(wavelength_color(VISIBLE, normalization))), plain)


def test_spectral_locus_has_the_printed_chromaticities():
    # CIE 15, table T.3: 450, 520 and 700 nm.
    printed = [[0.15664, 0.01771], [0.07430, 0.83380], [0.73469, 0.26531]]
    locus = chromaticity(rgb_to_xyz(wavelength_color([450.0, 520.0, 700.0], "sum")))
    assert_allclose(locus, printed, rtol=0, atol=1.1e-5)


def test_pure_wavelengths_lie_outside_srgb():
    assert np.all(wavelength_color(np.arange(400.0, 700.0, 5.0)).min(axis=-1) < 0.0)


def test_other_normalizations_and_wavelengths_are_refused():
    with pytest.raises(ParameterError, match="normalization is 'max'"):
        wavelength_color(550.0, "max")
    with pytest.raises(ParameterError, match="350 to 840 nm"):
        wavelength_color(1000.0)
