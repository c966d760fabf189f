"""Means of solutions over columns."""

from dataclasses import replace

import numpy as np
import pytest

import airlight
from airlight.errors import ParameterError
from airlight.solver.independent_columns import IndependentColumns, SolvedColumn


@pytest.fixture(scope="module")
def clear():
    return airlight.solve("earth-atmosphere-plus", quality="preview", polarisation=False)


@pytest.fixture(scope="module")
def hazy():
    planet = airlight.load_planet("earth-atmosphere-plus")
    thick = [
        replace(one, amount=20.0 if one.name == "aerosol" else 1.0) for one in planet.constituents
    ]
    planet = replace(planet, constituents=tuple(thick))
    return airlight.solve(planet, quality="preview", polarisation=False)


def test_every_quantity_is_the_mean_of_the_columns(clear, hazy):
    mean = IndependentColumns([SolvedColumn(0.7, clear), SolvedColumn(0.3, hazy)])
    sight = {"altitude": "1 km", "sun_zenith": 60.0, "view_zenith": [30.0, 120.0]}
    asked = [
        lambda one: one.radiance(**sight),
        lambda one: one.transmittance(altitude=0.0, view_zenith=[0.0, 80.0]),
        lambda one: one.irradiance(altitude=0.0, sun_zenith=50.0)["direct"],
        lambda one: one.irradiance(altitude=0.0, sun_zenith=50.0)["diffuse"],
    ]
    for of in asked:
        np.testing.assert_allclose(of(mean), 0.7 * of(clear) + 0.3 * of(hazy), rtol=1e-6)
        assert of(mean).dims == of(clear).dims


def test_a_column_that_is_everything_is_the_mean(clear):
    alone = IndependentColumns([SolvedColumn(1.0, clear)])
    sight = {"altitude": 0.0, "sun_zenith": 30.0, "view_zenith": 45.0}
    np.testing.assert_allclose(alone.radiance(**sight), clear.radiance(**sight), rtol=1e-12)
    assert "1 independent column" in alone.report.note


def test_fractions_that_are_no_cover_are_rejected(clear):
    with pytest.raises(ParameterError, match="whose sum is 1"):
        IndependentColumns([SolvedColumn(0.5, clear), SolvedColumn(0.4, clear)])


def test_another_shell_is_rejected(clear):
    other = airlight.solve("mars", quality="preview", wavelengths=[550.0], polarisation=False)
    with pytest.raises(ParameterError, match="shell"):
        IndependentColumns([SolvedColumn(0.5, clear), SolvedColumn(0.5, other)])
