"""Altitude nodes: found without a search, and fine enough for any layer."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_less

from airlight.physics.optics.altitude_nodes import (
    CELLS,
    altitude_node,
    altitude_nodes,
    node_altitudes,
)
from airlight.physics.optics.density_profile import (
    DensitySegments,
    LayerTerms,
    exponential,
    layered,
    tent,
    uniform,
)
from airlight.solver.tables.columns import density_table

TOP = 1e5
PROFILES = {
    "tent of 5 m at 90 km": tent(90e3, 5.0, TOP),
    "tent of 100 m at 10 km": tent(10e3, 100.0, TOP),
    "fog of 3 m": exponential(3.0, TOP),
    "slab of 10 m": layered(
        [LayerTerms(width=50e3), LayerTerms(width=10.0, constant_term=1.0), LayerTerms()], TOP
    ),
    "uniform": uniform(TOP),
}


@pytest.mark.parametrize("name", PROFILES)
def test_the_column_between_nodes_is_that_of_the_profile(name: str) -> None:
    # The exact column has a closed form; the trapezoid over the nodes errs by less than 0.3 %.
    density = DensitySegments.from_rows([exponential(8e3, TOP), PROFILES[name]])
    values, altitude = density_table(density), density.node_altitudes
    column = np.trapezoid(values, altitude, axis=0)
    assert_allclose(column, density.columns, rtol=3e-3)


@pytest.mark.parametrize("name", PROFILES)
def test_an_altitude_is_found_between_its_nodes(name: str) -> None:
    # Inverse: node and fraction, linear in the square root of altitude, give the altitude back.
    density = DensitySegments.from_rows([PROFILES[name]])
    first, altitude = density.first_nodes, density.node_altitudes
    assert_array_less(0.0, np.diff(altitude))
    assert altitude[0] == 0.0
    assert altitude[-1] == TOP
    rng = np.random.default_rng(3)
    for height in [0.0, TOP, 50e3, 90e3, *(TOP * rng.random(200) ** 2)]:
        node, fraction = altitude_node(6371e3 + height, 6371e3, TOP, first)
        assert 0.0 <= fraction <= 1.0
        root = np.sqrt(altitude[node]) * (1.0 - fraction) + np.sqrt(altitude[node + 1]) * fraction
        assert_allclose(root**2, height, atol=2e-6)


def test_smooth_profiles_have_the_cells_alone() -> None:
    # By definition: scale heights of 1.2 and 8 km change by less than 3 % within a cell.
    density = DensitySegments.from_rows([exponential(8e3, TOP), exponential(1.2e3, TOP)])
    first = altitude_nodes(density.edges, density.coefficients)
    assert_allclose(first, np.arange(CELLS + 1.0))
    assert_allclose(node_altitudes(first, TOP), TOP * np.linspace(0.0, 1.0, CELLS + 1) ** 2)
