"""The law of water: its glint, its foam and the light from below keep the energy."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.optics.cox_munk import mean_mirrored
from airlight.optics.reflection import Reflection, law_number
from airlight.optics.water import FOAM, foam_share, largest_albedo, sky_share, star_share

WINDS = [0.5, 5.0, 12.0, 25.0]
NODES, WEIGHTS = np.polynomial.legendre.leggauss(96)
NODES, WEIGHTS = 0.5 * (NODES + 1.0), 0.5 * WEIGHTS
TURNS = (np.arange(180) + 0.5) * np.pi / 180.0


def sea(wind):
    return Reflection(1.0, law_number("water"), wet=True, wind=wind)


def under_all_stars(wind, leaving):
    """Both parts of the light of a uniform sky, star by star."""
    total = np.zeros(2)
    for mu, weight in zip(NODES, WEIGHTS, strict=True):
        nu = -(mu * leaving + np.sqrt((1.0 - mu**2) * (1.0 - leaving**2)) * np.cos(TURNS))
        shares = np.mean([star_share(sea(wind), mu, leaving, each) for each in nu], axis=0)
        total += 2.0 * weight * mu * shares
    return total


@pytest.mark.parametrize("wind", [5.0, 12.0])
@pytest.mark.parametrize("leaving", [0.2, 0.7])
def test_the_sky_s_shares_are_the_mean_of_the_star_s(leaving, wind):
    # A uniform sky is stars everywhere, each weighted by its cosine; the fits meet it to 2.1 %.
    matte, gloss = under_all_stars(wind, leaving)
    below, mirrored = sky_share(sea(wind), leaving)
    assert_allclose(below, matte, rtol=0.005)
    assert_allclose(mirrored, gloss, rtol=0.022)


@pytest.mark.parametrize("wind", WINDS)
def test_under_a_uniform_sky_the_albedo_comes_back_from_below(wind):
    # The albedo's definition, of what foam leaves free; the rest is mirrored and foam's.
    both = np.array([sky_share(sea(wind), x) for x in NODES])
    matte, gloss = 2.0 * (WEIGHTS * NODES) @ both
    foam = foam_share(wind)
    assert_allclose(matte, 1.0 - foam, rtol=2e-3)
    assert_allclose(gloss, (1.0 - foam) * mean_mirrored(wind) + foam * FOAM, rtol=0.02)


@pytest.mark.parametrize("wind", WINDS)
def test_no_sea_reflects_more_than_arrives(wind):
    factors = [sky_share(sea(wind), x) for x in np.linspace(0.0, 1.0, 65)]
    assert max(matte * largest_albedo(sea(wind)) + gloss for matte, gloss in factors) <= 1.0
    assert min(min(each) for each in factors) > 0.0


def test_a_dark_sea_reflects_as_is_measured():
    # Payne (1972), J. Atmos. Sci. 29, 959: 0.061 under overcast; of it 0.005 come from below, and
    # wind makes it less.
    matte, gloss = 2.0 * (WEIGHTS * NODES) @ np.array([sky_share(sea(4.0), x) for x in NODES])
    assert_allclose(0.005 * matte + gloss, 0.061, atol=0.005)


def test_storms_whiten_the_sea():
    # Monahan & O'Muircheartaigh (1980): a tenth of the sea is white at 19.4 m/s.
    assert_allclose(foam_share(19.4), 0.1, rtol=0.01)
