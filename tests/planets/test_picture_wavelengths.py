"""Wavelengths at which a planet is computed for a picture."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight import load_planet
from airlight.errors import ParameterError
from airlight.image.four_wavelengths import CHOSEN
from airlight.planets.picture_wavelengths import COUNTS, picture_wavelengths


@pytest.fixture(scope="module")
def earth():
    return load_planet("earth")


@pytest.mark.parametrize("word", list(COUNTS))
def test_few_are_chosen_for_their_colours_and_many_evenly_spaced(earth, word):
    # The chosen wavelengths are in color.four_wavelengths, with reasons; even ones have one step.
    nm = picture_wavelengths(earth, word)
    assert nm.size == COUNTS[word]
    if nm.size in CHOSEN:
        assert_array_equal(nm, CHOSEN[nm.size])
    else:
        assert np.ptp(np.diff(nm)) < 1e-9


@pytest.mark.parametrize("word", list(COUNTS))
def test_no_more_than_fit_are_given(earth, word):
    # A page holds three or four: the number nearest to the requested one.
    assert picture_wavelengths(earth, word, most=4).size == min(COUNTS[word], 4)


def test_without_a_word_a_still_picture_has_sixteen_and_a_device_four(earth):
    assert picture_wavelengths(earth).size == 16
    assert_array_equal(picture_wavelengths(earth, most=4), CHOSEN[4])


def test_a_number_means_evenly_spaced_ones(earth):
    # Three are the classical red, green and blue of the three-wavelength mode, not the chosen.
    assert_array_equal(picture_wavelengths(earth, 3), [680.0, 550.0, 440.0])
    assert picture_wavelengths(earth, 9).size == 9


def test_an_unknown_word_is_refused(earth):
    with pytest.raises(ParameterError, match="five"):
        picture_wavelengths(earth, "five")
