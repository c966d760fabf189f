"""Light of the air below and above a mean layer of clouds."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from airlight import load_planet
from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics, droplets
from airlight.render.clouds.cloud_deck import CloudDeck
from airlight.render.clouds.mean_layer import mean_layer
from airlight.render.solve_planet import solve_planet

NM = np.array([440.0, 500.0, 560.0, 620.0, 680.0])
SOLVED = NM[[0, 1, 3, 4]]


@cache
def droplet_optics():
    return CloudOptics.of_particles(droplets(10e-6, 0.1), SOLVED)


def optics(_):
    """As ``CloudDeck`` asks, at ``SOLVED``."""
    return droplet_optics()


@pytest.fixture(scope="module")
def air():
    return solve_planet(load_planet("earth-atmosphere-plus"), NM, "preview", polarisation=False)


def layer(air, columns, depth=10.0, seen=optics, base=1000.0, similar=None):
    """Mean layer of columns of an optical depth, of four."""
    cells = np.zeros((4, 4, 8), np.float32)
    cells[:columns] = depth / 400.0
    field = CloudField(extinction=cells, spacing=(100.0, 100.0, 50.0), base=base)
    return mean_layer(air, [CloudDeck(field, seen)], similar=similar)


@pytest.fixture(scope="module")
def overcast(air):
    return layer(air, 4)


def test_a_field_without_clouds_has_no_layer(air):
    assert layer(air, 4, depth=1e-6) is None
    assert layer(air, 0) is None


def test_a_similar_layer_lends_its_columns_for_any_cover(air, overcast):
    # exact for another cover; not taken for other altitudes or optical depths
    r, mu_s = np.array([air.medium.bottom_radius]), np.array([0.7])
    lent = layer(air, 2, base=1200.0, similar=overcast)
    assert [one.solution for one in lent.columns] == [one.solution for one in overcast.columns]
    full = overcast.sky_ratio(r, mu_s)
    np.testing.assert_allclose(lent.sky_ratio(r, mu_s), 0.5 * (1.0 + full), rtol=1e-6)
    # the error of the lent light, as of a first light
    own = layer(air, 2, base=1200.0).sky_ratio(r, mu_s)
    np.testing.assert_allclose(lent.sky_ratio(r, mu_s), own, rtol=0.02)
    for other in (layer(air, 2, base=3000.0, similar=lent), layer(air, 2, 20.0, similar=lent)):
        assert other.columns[1].solution is not overcast.columns[1].solution


def test_light_is_the_mean_of_independent_columns(air, overcast):
    """Linear in the cover, between clear sky and overcast."""
    r, mu_s = np.array([air.medium.bottom_radius]), np.array([0.7])
    full = overcast.sky_ratio(r, mu_s)
    half = layer(air, 2).sky_ratio(r, mu_s)
    np.testing.assert_allclose(half, 0.5 * (1.0 + full), rtol=1e-6)
    clear, cloudy = (one.solution.relative_sky_irradiance(r, mu_s) for one in overcast.columns)
    np.testing.assert_allclose(full[:, [0, 1, 3, 4]], cloudy / clear, rtol=1e-6)


def test_between_solved_wavelengths_the_ratio_is_linear(overcast):
    np.testing.assert_allclose(overcast.weights.sum(axis=0), 1.0, rtol=1e-12)
    np.testing.assert_allclose(SOLVED @ overcast.weights, NM, rtol=1e-12)


def test_the_light_of_a_dark_sky_is_a_number(overcast):
    assert np.isfinite(overcast.ratio([np.zeros((1, 4))] * 2)).all()


def test_tables_of_the_air_have_no_cloud_but_its_light(overcast):
    """Air over a level path has the same transmittance below either sky."""
    clear, below = overcast.air
    assert below.scaled_extinction[-1].max() == 0.0
    count = clear.constituents
    np.testing.assert_allclose(below.extinction[:count], clear.extinction, rtol=1e-6)
    assert below.field.shape != clear.field.shape


def test_air_above_a_bright_cloud_receives_more_light(air, overcast):
    """Above an overcast of optical depth 10, which reflects half, but not below a black one."""
    r, mu_s = np.array([air.medium.bottom_radius + 2e3]), np.array([0.7])
    assert np.all(overcast.sky_ratio(r, mu_s) > 1.2)
    black = replace(droplet_optics(), albedo=np.zeros(4))
    dark = layer(air, 4, seen=lambda _: black)
    assert np.all(dark.sky_ratio(r, mu_s) < 1.0)


def test_kinds_overlap_at_random(air):
    """Four columns of two kinds, each of half a cover, with fractions of a quarter."""
    cells = np.zeros((4, 4, 8), np.float32)
    cells[:2] = 0.01
    decks = [
        CloudDeck(CloudField(extinction=cells, spacing=(100.0, 100.0, 50.0), base=base), optics)
        for base in (1000.0, 5000.0)
    ]
    found = mean_layer(air, decks)
    assert [one.fraction for one in found.columns] == [0.25] * 4
    names = [one.solution.medium.names for one in found.columns]
    assert [len(one) - len(names[0]) for one in names] == [0, 1, 1, 2]
