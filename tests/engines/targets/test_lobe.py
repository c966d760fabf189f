"""Fits of phase functions by one lobe."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets.fits.lobe import (
    CORNETTE_SHANKS,
    HENYEY_GREENSTEIN,
    fit_lobe,
    g_of_cornette_shanks,
    mean_cosine_of_cornette_shanks,
    particles_lobe,
)
from airlight.errors import ParameterError
from airlight.kernel import vectorized
from airlight.physics.optics.legendre import legendre_moments
from airlight.physics.optics.phase_functions import cornette_shanks, henyey_greenstein
from airlight.planets import load_planet, replace
from airlight.planets.matter.phases import CornetteShanks, DoubleHenyeyGreenstein
from airlight.planets.medium import Medium

NM = [680.0, 550.0, 440.0]


@pytest.mark.parametrize("g", [-0.9, -0.3, 0.0, 0.5, 0.95])
def test_mean_cosine_is_that_of_the_integral(g):
    lobe = vectorized(cornette_shanks)
    first = legendre_moments(lambda nu: lobe(nu, g), 1)[1]
    assert_allclose(mean_cosine_of_cornette_shanks(g), first, atol=1e-12)
    assert_allclose(g_of_cornette_shanks(first), g, atol=1e-9)


def test_own_formula_is_found_without_error():
    planet = load_planet("earth-bruneton")  # one aerosol, Cornette-Shanks of g = 0.8
    lobe = particles_lobe(Medium.from_planet(planet, NM), CORNETTE_SHANKS)
    assert_allclose(lobe.g, 0.8, atol=1e-9)
    assert_allclose([lobe.scatter, lobe.largest, lobe.forward], [0.0, 1.0, 1.0], atol=1e-7)


def test_weights_are_scattering_optical_depths():
    planet = load_planet("earth-bruneton")
    aerosol = planet.constituents[1]
    second = replace(
        aerosol, name="second", scattering=2.0 * aerosol.scattering, absorption=0.0,
        phase_function=CornetteShanks(asymmetry=0.3),
    )  # fmt: skip
    both = replace(planet, constituents=(*planet.constituents, second))
    lobe = particles_lobe(Medium.from_planet(both, NM), HENYEY_GREENSTEIN)
    cosines = [mean_cosine_of_cornette_shanks(g) for g in (0.8, 0.3)]
    assert_allclose(lobe.g, (cosines[0] + 2.0 * cosines[1]) / 3.0, rtol=1e-6)


def test_molecules_alone_have_no_lobe():
    planet = load_planet("mars-rayleigh")
    assert particles_lobe(Medium.from_planet(planet, NM), CORNETTE_SHANKS) is None


@pytest.mark.parametrize("form", [CORNETTE_SHANKS, HENYEY_GREENSTEIN])
def test_two_lobes_are_fitted_by_one_of_their_mean_cosine(form):
    # Mean cosine 0.743·0.889 + 0.257·0.094 in closed form.
    phase = DoubleHenyeyGreenstein(asymmetry_1=0.889, asymmetry_2=0.094, weight=0.743)
    mean = 0.743 * 0.889 + 0.257 * 0.094
    lobe = fit_lobe(lambda nu: phase.values(nu, NM), np.full(3, mean), form)
    first = legendre_moments(lambda nu: lobe.values(nu), 1)[1]
    assert_allclose(first, mean, atol=1e-9)
    # The largest factor is found between nodes of half a thousandth of the sphere.
    angle = np.radians(np.linspace(10.0, 180.0, 500))
    factor = np.abs(np.log(lobe.values(np.cos(angle)) / phase.values(np.cos(angle), NM)[:, 0]))
    assert_allclose(lobe.largest, np.exp(factor.max()), rtol=1e-2)
    assert 0.0 < lobe.scatter < np.log(lobe.largest)


def test_mean_cosine_that_no_lobe_has_is_refused():
    sharp = vectorized(henyey_greenstein)
    with pytest.raises(ParameterError, match="mean cosine"):
        fit_lobe(lambda nu: sharp(nu, 0.9995)[:, None], [0.9995], HENYEY_GREENSTEIN)
