"""Exponential sums: transmittances of band models, of mixtures, and of grey absorption."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.optics.band_transmission import TABLES, band_transmittance
from airlight.physics.optics.exponential_sums import (
    MULTIPLES,
    ExponentialSum,
    divided,
    exponential_sum,
)
from airlight.physics.spectra.tables import read_spectrum

#: Columns of the U.S. Standard Atmosphere, 1976. [m⁻²]
COLUMNS = {"H2O": 4.737e26, "O2": 4.5e28, "CO2": 7.108e25, "CH4": 3.549e23}


@pytest.mark.parametrize("formula", TABLES)
def test_the_sum_of_a_band_transmits_what_its_table_does(formula: str) -> None:
    # The definition of a k-distribution, over a factor of 600 in the amount of the gas and in bands
    # of 10 nm from 565 to 2495 nm; the tolerance of the fit is 0.003 (T + 0.02).
    largest = 0
    for centre in np.arange(565.0, 2500.0, 10.0):
        true = band_transmittance(TABLES[formula], centre, 10.0, COLUMNS[formula] * MULTIPLES)
        found = exponential_sum(true)
        assert_allclose(found.at(MULTIPLES), true, atol=0.0031)
        assert_allclose(found.weights.sum(), 1.0, rtol=1e-12)
        assert (found.weights > 0.0).all()
        assert (found.rates >= 0.0).all()
        largest = max(largest, found.rates.size)
    assert largest <= 8


def test_a_lone_table_row_is_the_optical_depth_of_the_table() -> None:
    # Band of one nanometre around a row, for a column of the headings: the entry itself.
    oxygen = read_spectrum("oxygen-transmission")
    row = int(np.argmin(np.abs(oxygen.wavelengths - 762.0)))
    columns = np.array([float(one) for one in oxygen.columns])
    found = band_transmittance("oxygen-transmission", 762.0, 1.0, columns)
    assert_allclose(-np.log(found), oxygen.values[row], rtol=1e-10)


def test_oxygen_s_bands_are_those_of_the_lines_at_seven_air_masses() -> None:
    # Line by line, builders/oxygen.py, in the notes of oxygen-bands.csv: means over 10 nm.
    air = np.array([0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0])
    lines = {
        689.0: (0.946, 0.922, 0.904, 0.890, 0.866, 0.831, 0.773),
        764.0: (0.738, 0.651, 0.594, 0.553, 0.496, 0.428, 0.344),
    }
    for centre, true in lines.items():
        found = band_transmittance("oxygen-transmission", centre, 10.0, COLUMNS["O2"] * air)
        assert_allclose(found, true, atol=0.003)  # interpolation between columns


def test_grey_absorption_is_a_single_term() -> None:
    # Beer's law needs no more.
    for depth in (1e-4, 0.3, 20.0):
        found = exponential_sum(np.exp(-depth * MULTIPLES))
        assert found.rates.size == 1
        assert_allclose(found.rates, depth, rtol=1e-9)


def test_no_absorption_is_a_single_term_without_depth() -> None:
    found = exponential_sum(np.ones(MULTIPLES.size))
    assert_allclose(found.rates, [0.0], atol=1e-12)


def test_the_parts_of_gases_have_the_rates_of_the_sum() -> None:
    # Two gases whose lines overlap at random: transmittances multiply, optical depths add up.
    water = exponential_sum(
        band_transmittance(TABLES["H2O"], 2005.0, 10.0, COLUMNS["H2O"] * MULTIPLES)
    )
    dioxide = exponential_sum(
        band_transmittance(TABLES["CO2"], 2005.0, 10.0, COLUMNS["CO2"] * MULTIPLES)
    )
    total = exponential_sum(water.at(MULTIPLES) * dioxide.at(MULTIPLES))
    parts = divided(total, [water, dioxide])
    assert_allclose(parts.sum(axis=0), total.rates, rtol=1e-12, atol=1e-15)
    assert (parts >= 0.0).all()


def test_a_lone_gas_has_all_of_the_rates() -> None:
    one = ExponentialSum(np.array([0.4, 0.6]), np.array([0.0, 2.0]))
    assert_allclose(divided(one, [one]), [one.rates], rtol=1e-12)
