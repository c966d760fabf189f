"""Air at rest in layers, against the U.S. Standard Atmosphere, 1976, and exact limits."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.constants import GAS_CONSTANT
from airlight.physics.optics.density_profile import DensitySegments, row_column
from airlight.physics.optics.hydrostatic import (
    PIECE_TOLERANCE,
    HydrostaticLayers,
    mass_per_length,
    thickness_between,
    thickness_of_layer,
)

#: U.S. Standard Atmosphere, 1976, Tables 2 and 4; its gas constant is 8.31432 J/(mol K).
WEIGHT = 28.9644e-3 * 9.80665 / 8.31432
BASES = np.array([0.0, 11e3, 20e3, 32e3, 47e3, 51e3, 71e3, 84852.0])
RATES = np.array([6.5e-3, 0.0, -1e-3, -2.8e-3, 0.0, 2.8e-3, 2e-3, 0.0])
RADIUS = 6356766.0


@pytest.fixture(scope="module")
def standard() -> HydrostaticLayers:
    return HydrostaticLayers.stacked(BASES, 288.15, RATES, WEIGHT, RADIUS)


@pytest.mark.parametrize(
    ("altitude", "temperature", "pressure", "density"),
    # U.S. Standard Atmosphere, 1976, Table I, geometric altitude: km, K, mb, kg/m^3
    [
        (5.0, 255.676, 5.4048e2, 7.3643e-1),
        (11.0, 216.774, 2.2699e2, 3.6480e-1),
        (20.0, 216.650, 5.5293e1, 8.8910e-2),
        (32.0, 228.490, 8.8906e0, 1.3555e-2),
        (40.0, 250.350, 2.8714e0, 3.9957e-3),
        (47.4, 270.650, 1.1022e0, 1.4187e-3),
        (50.0, 270.650, 7.9779e-1, 1.0269e-3),
        (60.0, 247.021, 2.1958e-1, 3.0968e-4),
        (70.0, 219.585, 5.2209e-2, 8.2829e-5),
        (75.0, 208.399, 2.3881e-2, 3.9921e-5),
        (80.0, 198.639, 1.0524e-2, 1.8458e-5),
        (85.0, 188.893, 4.4568e-3, 8.2196e-6),
    ],
)
def test_table_1_of_the_standard_atmosphere(standard, altitude, temperature, pressure, density):
    # The last printed digit: the table's pressures are cut off rather than rounded (at 11 km the
    # formula of the same book gives 226.9993 mb), and it prints kinetic temperatures, which are
    # 0.01 % below the molecular-scale ones of its formulas at 85 km.
    h = 1e3 * altitude
    assert_allclose(standard.temperature(h), temperature, rtol=0, atol=1e-3)
    for value, printed in (
        (1013.25 * standard.pressure_ratio(h), pressure),
        (101325.0 * 28.9644e-3 / (8.31432 * 288.15) * standard.density_ratio(h), density),
    ):
        digit = 10.0 ** (np.floor(np.log10(printed)) - 4)
        assert_allclose(value, printed, rtol=0, atol=digit)


@pytest.mark.parametrize(
    ("base", "temperature", "pressure"),
    # The same standard at the bases of its layers: geopotential km, K, Pa
    [
        (11.0, 216.65, 22632.06),
        (20.0, 216.65, 5474.889),
        (32.0, 228.65, 868.0187),
        (47.0, 270.65, 110.9063),
        (51.0, 270.65, 66.93887),
        (71.0, 214.65, 3.956420),
        (80.0, 196.65, 0.8862800),
    ],
)
def test_bases_of_the_standard_atmosphere(standard, base, temperature, pressure):
    # six digits
    h = standard.geometric(1e3 * base)
    assert_allclose(standard.geopotential(h), 1e3 * base, rtol=1e-12)
    assert_allclose(standard.temperature(h), temperature, rtol=1e-9)
    assert_allclose(101325.0 * standard.pressure_ratio(h), pressure, rtol=2e-6)
    density = 1.225 * standard.density_ratio(h)
    assert_allclose(density, pressure / (287.05287 * temperature), rtol=5e-6)


def test_isothermal_air_is_exactly_exponential():
    # The exact limit: one segment, exp(-h/H) with H = RT/(Mg).
    weight = mass_per_length(44.0e-3, 3.71)
    air = HydrostaticLayers.stacked([0.0], 210.0, [0.0], weight)
    edges, rows = air.row(120e3)
    height = GAS_CONSTANT * 210.0 / (44.0e-3 * 3.71)
    assert_allclose(edges, [0.0, 120e3], rtol=0, atol=0)
    assert_allclose(rows, [[1.0, -1.0 / height, 0.0, 0.0]], rtol=1e-12)
    # cut in two by a base that changes nothing
    twice = HydrostaticLayers.stacked([0.0, 30e3], 210.0, [0.0, 0.0], weight)
    assert_allclose(twice.density_ratio([10e3, 50e3]), np.exp([-10e3 / height, -50e3 / height]))


def test_column_carries_the_pressure_of_the_ground(standard):
    # p(0) - p(top) = g ∫ rho dh under constant gravity: a law. The pieces may be heavier by their
    # tolerance.
    level = HydrostaticLayers.stacked(BASES, 288.15, RATES, WEIGHT)
    column = row_column(level.row(100e3))
    carried = 1.0 - float(level.pressure_ratio(100e3))
    assert_allclose(column * WEIGHT / 288.15, carried, rtol=PIECE_TOLERANCE)
    # Falling gravity takes 2 H/r of the weight: the column is heavier by about 0.24 %.
    more = row_column(standard.row(100e3)) / column
    assert_allclose(more - 1.0, 2.0 * 7.6e3 / RADIUS, rtol=0.05)


def test_segments_follow_the_density_between_their_edges(standard):
    # The pieces' own tolerance, at altitudes between all of their edges.
    row = standard.row(100e3)
    h = np.linspace(0.0, 100e3, 7001)
    found = DensitySegments.from_rows([row]).at(h)[0]
    assert_allclose(found, standard.density_ratio(h), rtol=1.1 * PIECE_TOLERANCE)
    assert row[0].size < 200


def test_density_balances_pressure_and_weight(standard):
    # d ln p/dh = -M g(h)/(R T): the law of which the layers are solutions, by differences.
    h = np.array([3e3, 15e3, 25e3, 40e3, 49e3, 60e3, 80e3, 95e3])
    step = 1.0
    slope = np.log(standard.pressure_ratio(h + step) / standard.pressure_ratio(h - step)) / 2.0
    weight = WEIGHT * (RADIUS / (RADIUS + h)) ** 2
    assert_allclose(slope, -weight / standard.temperature(h), rtol=1e-6)


@pytest.mark.parametrize("rate", [6.5e-3, 0.0, -2.8e-3])
def test_hypsometric_equation_inverts_the_pressure(rate):
    # A round trip, and the same thickness from the temperatures of both ends.
    air = HydrostaticLayers.stacked([0.0], 250.0, [rate], WEIGHT)
    ratio = float(air.pressure_ratio(7e3))
    assert_allclose(thickness_of_layer(WEIGHT, 250.0, rate, ratio), 7e3, rtol=1e-12)
    top = float(air.temperature(7e3))
    assert_allclose(thickness_between(WEIGHT, 250.0, top, ratio), 7e3, rtol=1e-12)


def test_air_colder_than_nothing_is_refused():
    air = HydrostaticLayers.stacked([0.0, 10e3], 288.15, [6.5e-3, 6.5e-3], WEIGHT)
    with pytest.raises(ParameterError, match=r"lapse_rates\[1\] is 0.0065; .* at least 1 K"):
        air.row(100e3)


def test_air_that_ends_far_below_the_top_has_finite_pieces():
    # Under 200 times the gravity nothing of the density is left in double precision at the top,
    # exp(-1094); below, pieces keep their tolerance. The law for a constant lapse rate.
    air = HydrostaticLayers.stacked([0.0], 288.15, [6.5e-3], 200.0 * WEIGHT)
    with np.errstate(all="raise", under="ignore"):
        edges, rows = air.row(40e3)
    assert np.isfinite(rows).all()
    assert rows[-1, 0] == 0.0
    h = np.linspace(0.0, 2e3, 101)
    wanted = (1.0 - 6.5e-3 * h / 288.15) ** (200.0 * WEIGHT / 6.5e-3 - 1.0)
    found = DensitySegments.from_rows([(edges, rows)]).at(h)[0]
    assert_allclose(found, wanted, rtol=0.02)
