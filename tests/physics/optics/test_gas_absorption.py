"""Ozone: columns in Dobson units and the optical depth they make."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose

from airlight.physics.optics.density_profile import row_column, tent
from airlight.physics.optics.gas_absorption import (
    column_from_dobson,
    dobson_from_column,
    ozone_profile_afgl1986,
    reference_coefficient,
    small_particle_absorption,
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


def test_the_ozone_profile_is_the_printed_table():
    # AFGL U.S. Standard, Table 1f: 1e11 per cm³ at km, every printed digit
    printed = """0 6.78 · 5 5.78 · 10 11.3 · 15 26.4 · 20 47.7 · 22 49.0 · 25 42.7 · 30 25.1
        · 35 13.8 · 40 6.07 · 45 2.15 · 50 0.662 · 60 0.0707 · 70 0.00517"""
    table = np.array([row.split() for row in printed.split("·")], dtype=np.float64)
    altitudes, densities = ozone_profile_afgl1986()
    assert_allclose(altitudes, 1e3 * table[:, 0], rtol=0)
    assert_allclose(densities, 1e17 * table[:, 1], rtol=1e-12)


def test_absorption_of_tiny_particles_is_proportional_to_their_volume_and_number():
    # r³ N/λ with the refractive index held: β(2r) = 8 β(r), β(λ/2) = 2 β(λ)
    once = small_particle_absorption(600.0, 1e-9, 1e9, 1.5, 0.1)
    assert_allclose(small_particle_absorption(600.0, 2e-9, 1e9, 1.5, 0.1), 8.0 * once, rtol=1e-12)
    assert_allclose(small_particle_absorption(300.0, 1e-9, 1e9, 1.5, 0.1), 2.0 * once, rtol=1e-12)
    assert np.all(small_particle_absorption([300.0, 900.0], 1e-9, 1e9, [1.3, 3.0], 5.0) > 0.0)
