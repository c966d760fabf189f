"""Segments stand for the profiles they were made from, and their columns are exact."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_less
from scipy.integrate import quad

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import (
    DensitySegments,
    LayerTerms,
    exponential,
    layered,
    relative_density,
    row_column,
    tent,
    uniform,
)
from airlight.physics.optics.gas_absorption import dobson_from_column, ozone_profile_afgl1986
from airlight.physics.optics.tabulated_profile import tabulated

THICKNESS = 100e3


def at(row, altitudes):
    return DensitySegments.from_rows([row]).at(altitudes)[0]


def test_exponential_and_tent_reproduce_their_formulas():
    # the definitions of physics.md, section 2
    h = np.linspace(0.0, THICKNESS, 1001)
    assert_allclose(at(exponential(8e3, THICKNESS), h), np.exp(-h / 8e3), rtol=1e-14)
    expected = np.maximum(0.0, 1.0 - np.abs(h - 25e3) / 15e3)
    assert_allclose(at(tent(25e3, 15e3, THICKNESS), h), expected, rtol=0, atol=1e-15)
    assert_allclose(at(uniform(THICKNESS), h), 1.0, rtol=0, atol=0)


@pytest.mark.parametrize(
    ("row", "golden", "half_last_digit"),
    [
        (exponential(8e3, THICKNESS), 7999.9702, 5e-5),
        (exponential(1.2e3, THICKNESS), 1200.0, 5e-5),
        (tent(25e3, 15e3, THICKNESS), 15000.0, 1e-9),
    ],
)
def test_vertical_columns_match_the_golden_table(row, golden, half_last_digit):
    # "ground zenith" of the golden columns: 8 km (1 - exp(-12.5)), and so on
    assert_allclose(row_column(row), golden, rtol=0, atol=half_last_digit)


@pytest.mark.parametrize(
    ("center", "half_width"), [(25e3, 15e3), (5e3, 15e3), (95e3, 15e3), (50e3, 200e3), (2e5, 1e4)]
)
def test_tents_cut_off_by_ground_or_top_keep_their_column(center, half_width):
    # a second method: adaptive quadrature of the definition
    def density(h):
        return max(0.0, 1.0 - abs(h - center) / half_width)

    corners = [h for h in (center - half_width, center, center + half_width) if 0 < h < THICKNESS]
    expected, _ = quad(density, 0.0, THICKNESS, points=corners or None)
    assert_allclose(row_column(tent(center, half_width, THICKNESS)), expected, rtol=1e-9, atol=1e-9)


def test_two_layers_make_the_tent_of_ozone():
    # Bruneton 2017 writes the tent 25 km, 15 km as two linear layers clamped to [0, 1]
    layers = [
        LayerTerms(width=25e3, linear_term=1.0 / 15e3, constant_term=-2.0 / 3.0),
        LayerTerms(linear_term=-1.0 / 15e3, constant_term=8.0 / 3.0),
    ]
    h = np.linspace(0.0, THICKNESS, 777)
    assert_allclose(
        at(layered(layers, THICKNESS), h), at(tent(25e3, 15e3, THICKNESS), h), rtol=0, atol=1e-12
    )


@pytest.mark.parametrize(
    "terms",
    [
        LayerTerms(exp_term=1.0, exp_scale=-1.0 / 1200.0),
        LayerTerms(exp_term=3.0, exp_scale=-1.0 / 8e3, constant_term=-0.5),
        LayerTerms(exp_term=1.0, exp_scale=1.0 / 3e4, linear_term=-1e-4, constant_term=0.2),
        LayerTerms(exp_term=-1.0, exp_scale=1.0 / 3e4, linear_term=1e-4, constant_term=0.3),
        LayerTerms(constant_term=7.0),
        LayerTerms(constant_term=-7.0),
    ],
)
def test_layers_are_clamped_to_zero_and_one_wherever_they_cross_them(terms):
    # the definition, evaluated point by point
    h = np.linspace(0.0, THICKNESS, 5001)
    unclamped = (
        terms.exp_term * np.exp(terms.exp_scale * h) + terms.linear_term * h + terms.constant_term
    )
    row = layered([terms], THICKNESS)
    assert_allclose(at(row, h), np.clip(unclamped, 0.0, 1.0), rtol=0, atol=1e-10)
    expected = np.trapezoid(np.clip(unclamped, 0.0, 1.0), h)
    # trapezoid with 20 m steps: (20 m / 1200 m)²/12 of error at the steepest
    assert_allclose(row_column(row), expected, rtol=3e-5, atol=1e-6)


def test_layers_that_would_lose_their_digits_are_refused():
    with pytest.raises(ParameterError, match=r"layers\[0\]\.exp_scale"):
        layered([LayerTerms(exp_term=1.0, exp_scale=1.0)], THICKNESS)
    with pytest.raises(ParameterError, match=r"layers\[0\]\.linear_term"):
        layered([LayerTerms(linear_term=1e3)], THICKNESS)


def test_a_table_of_an_exponential_is_that_exponential_everywhere():
    # the cubic through a straight line (the logarithm) is that line, inside and beyond the table
    nodes = np.array([5e3, 12e3, 13e3, 40e3])
    h = np.linspace(0.0, THICKNESS, 500)
    row = tabulated(nodes, np.exp(-nodes / 8e3), THICKNESS)
    assert_allclose(at(row, h), np.exp(-h / 8e3), rtol=1e-12)


def test_tables_meet_their_own_values_and_stay_between_neighbours():
    # interpolation, and a monotone cubic does not overshoot
    altitudes, densities = ozone_profile_afgl1986()
    row = tabulated(altitudes, densities / densities.max(), THICKNESS)
    assert_allclose(at(row, altitudes), densities / densities.max(), rtol=1e-12)
    for k in range(len(altitudes) - 1):
        inside = at(row, np.linspace(altitudes[k], altitudes[k + 1], 50))
        low, high = sorted(densities[k : k + 2] / densities.max())
        assert_array_less(inside, high * (1.0 + 1e-9))
        assert_array_less(low * (1.0 - 1e-9), inside)


def test_exponential_pieces_follow_the_cubic_within_half_a_percent():
    # a second method: SciPy's PCHIP through the logarithms, at points between the pieces' ends
    from scipy.interpolate import PchipInterpolator

    altitudes, densities = ozone_profile_afgl1986()
    h = np.linspace(0.0, 70e3, 4001)
    curve = np.exp(PchipInterpolator(altitudes, np.log(densities))(h))
    assert_allclose(
        at(tabulated(altitudes, densities / 1e18, THICKNESS), h), curve / 1e18, rtol=5e-3
    )


def test_zeros_in_a_table_end_it_and_nothing_grows_upwards_beyond_it():
    row = tabulated([10e3, 20e3, 30e3, 40e3, 50e3], [0.0, 1.0, 0.0, 0.0, 1.0], THICKNESS)
    found = at(row, [0.0, 5e3, 15e3, 20e3, 25e3, 35e3, 45e3, 50e3, 99e3])
    assert_allclose(found, [0, 0, 0.5, 1.0, 0.5, 0, 0.5, 1.0, 1.0], rtol=0, atol=1e-12)
    rising = tabulated([0.0, 1e3, 2e3], [1.0, 2.0, 8.0], THICKNESS)
    assert_allclose(at(rising, [3e3, 99e3]), 8.0, rtol=1e-12)


def test_a_table_that_would_explode_towards_the_ground_is_refused():
    with pytest.raises(ParameterError, match=r"altitudes\[0\]"):
        tabulated([50e3, 51e3], [1.0, 1e-3], THICKNESS)


def test_a_table_is_cut_off_at_the_top_of_the_shell():
    row = tabulated([0.0, 50e3, 200e3], [1.0, 0.5, 0.1], 80e3)
    assert_allclose(row[0][-1], 80e3, rtol=0, atol=0)
    assert np.all(np.diff(row[0]) > 0.0)


def test_afgl_ozone_adds_up_to_345_dobson_units():
    # Anderson et al. 1986 state 345 DU for this profile; a table with 14 rows and log-cubic
    # interpolation cannot be asked for more than 1 %
    altitudes, densities = ozone_profile_afgl1986()
    column = row_column(tabulated(altitudes, densities / 1e18, THICKNESS)) * 1e18
    assert_allclose(dobson_from_column(column), 345.0, rtol=0.01)


def test_padding_and_points_outside_the_shell_change_nothing():
    rows = [uniform(THICKNESS), tent(25e3, 15e3, THICKNESS), exponential(8e3, THICKNESS)]
    segments = DensitySegments.from_rows(rows)
    h = np.array([-1e-6, 0.0, 99_999.999, THICKNESS, THICKNESS + 1e-3])
    expected = [at(row, h) for row in rows]
    assert_allclose(segments.at(h), expected, rtol=0, atol=0)
    assert_allclose(segments.at(THICKNESS)[2], np.exp(-12.5), rtol=1e-12)
    assert_allclose(segments.columns, [row_column(row) for row in rows], rtol=1e-14)


def test_lookup_works_from_compiled_code():
    from airlight.kernel import compiled_loop

    @compiled_loop
    def sum_of(segment_edges, coefficients):
        total = 0.0
        for k in range(11):
            total += relative_density(k * 1e4, segment_edges, coefficients)
        return total

    segments = DensitySegments.from_rows([tent(25e3, 15e3, THICKNESS)])
    total = sum_of(segments.edges[0], segments.coefficients[0])
    assert_allclose(total, 2.0 / 3.0 + 2.0 / 3.0, rtol=1e-12)  # at 20 and 30 km
