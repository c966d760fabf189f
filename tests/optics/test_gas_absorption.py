"""Ozone: columns in Dobson units and the optical depth they make."""

from __future__ import annotations

from numpy.testing import assert_allclose

from airlight.optics.density_profile import row_column, tent
from airlight.optics.gas_absorption import (
    column_from_dobson,
    dobson_from_column,
    reference_coefficient,
)


def test_a_dobson_unit_is_ten_micrometres_of_gas():
    # definition; the Loschmidt constant of CODATA 2018 is 2.686780111e25 per m³
    assert_allclose(column_from_dobson(1.0), 2.686780111e20, rtol=1e-9)
    assert_allclose(dobson_from_column(column_from_dobson(345.0)), 345.0, rtol=1e-15)


def test_345_dobson_units_have_the_golden_optical_depths():
    # cross-sections 1.368e-21, 3.314e-21, 1.360e-22 cm²: (0.0127, 0.0307, 0.0013)
    sigma = [1.368e-25, 3.314e-25, 1.360e-26]
    column = row_column(tent(25e3, 15e3, 100e3))
    depth = reference_coefficient(column_from_dobson(345.0), column, sigma) * column
    assert_allclose(depth, [0.0127, 0.0307, 0.0013], rtol=0, atol=5e-5)
