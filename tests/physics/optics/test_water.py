"""The law of water: its glint, its foam and the light from below keep the energy."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.optics.cox_munk import mean_mirrored
from airlight.physics.optics.reflection import Reflection, law_number
from airlight.physics.optics.water import (
    FOAM,
    brdf_diffuse,
    brdf_direct,
    foam_fraction,
    largest_albedo,
)

WINDS = [0.5, 5.0, 12.0, 25.0]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(96)
NODES, WEIGHTS = 0.5 * (NODES + 1.0), 0.5 * WEIGHTS
TURNS = (np.arange(180) + 0.5) * np.pi / 180.0


def sea(wind):
    return Reflection(1.0, law_number("water"), wet=True, wind=wind)


def under_all_stars(wind, mu_r):
    """Both parts of the light of a uniform sky, star by star."""
    total = np.zeros(2)
    for mu, weight in zip(NODES, WEIGHTS, strict=True):
        nu = -(mu * mu_r + np.sqrt((1.0 - mu**2) * (1.0 - mu_r**2)) * np.cos(TURNS))
        shares = np.mean([brdf_direct(sea(wind), mu, mu_r, each) for each in nu], axis=0)
        total += 2.0 * weight * mu * shares
    return total


@pytest.mark.parametrize("wind", [5.0, 12.0])
@pytest.mark.parametrize("mu_r", [0.2, 0.7])
def test_the_sky_s_shares_are_the_mean_of_the_star_s(mu_r, wind):
    # A uniform sky is stars everywhere, each weighted by its cosine; the fits meet it to 2.1 %.
    diffuse, specular = under_all_stars(wind, mu_r)
    below, mirrored = brdf_diffuse(sea(wind), mu_r)
    assert_allclose(below, diffuse, rtol=0.005)
    assert_allclose(mirrored, specular, rtol=0.022)


@pytest.mark.parametrize("wind", WINDS)
def test_under_a_uniform_sky_the_albedo_comes_back_from_below(wind):
    # The albedo's definition, of what foam leaves free; the rest is mirrored and foam's.
    both = np.array([brdf_diffuse(sea(wind), x) for x in NODES])
    diffuse, specular = 2.0 * (WEIGHTS * NODES) @ both
    foam = foam_fraction(wind)
    assert_allclose(diffuse, 1.0 - foam, rtol=2e-3)
    assert_allclose(specular, (1.0 - foam) * mean_mirrored(wind) + foam * FOAM, rtol=0.02)


@pytest.mark.parametrize("wind", WINDS)
def test_no_sea_reflects_more_than_arrives(wind):
    factors = [brdf_diffuse(sea(wind), x) for x in np.linspace(0.0, 1.0, 65)]
    assert (
        max(diffuse * largest_albedo(sea(wind)) + specular for diffuse, specular in factors) <= 1.0
    )
    assert min(min(each) for each in factors) > 0.0


def test_a_dark_sea_reflects_as_is_measured():
    # Payne (1972), J. Atmos. Sci. 29, 959: 0.061 under overcast; of it 0.005 come from below, and
    # wind makes it less.
    diffuse, specular = (
        2.0 * (WEIGHTS * NODES) @ np.array([brdf_diffuse(sea(4.0), x) for x in NODES])
    )
    assert_allclose(0.005 * diffuse + specular, 0.061, atol=0.005)


def test_storms_whiten_the_sea():
    # Monahan & O'Muircheartaigh (1980): a tenth of the sea is white at 19.4 m/s.
    assert_allclose(foam_fraction(19.4), 0.1, rtol=0.01)
