"""Factors of three wavelengths: the published ones of sunlight, and the planet's own skies."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.testing import assert_allclose

from airlight.engines.targets.fits.sky_colour import channel_factors, fit_sky_colour
from airlight.image.spectral import EYE
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets import load_planet

NM = np.array([680.0, 550.0, 440.0])


def test_factors_of_sunlight_are_those_of_three_atmosphere() -> None:
    # AtmosphereParameters.ts of @takram/three-atmosphere 0.19.1, from means of the sun over 10 nm.
    sun = (98242.786222, 69954.398112, 66475.012354)
    sky = (114974.916437, 71305.954816, 65310.548555)
    for power, published in ((0.0, sun), (-3.0, sky)):
        found = LUMINOUS_EFFICACY * channel_factors(NM, solar_irradiance(EYE), power)
        assert_allclose(found, published, rtol=0.045)


def test_a_sky_of_dust_is_nearer_by_its_own_factors(solved: Callable[..., Any]) -> None:
    # The power -3 errs by 5 on Mars, whose sky is redder than sunlight.
    colour = fit_sky_colour(solved(load_planet("mars"), tuple(NM), quality="preview"))
    assert colour.fitted[0].errors["delta E 2000, median"] < 1.0
    assert colour.fitted[0].errors["delta E 2000, largest"] < 3.0
    # A white plate in full sunlight has the sun's colour whatever the sky's.
    assert_allclose(colour.sun / colour.sun[1], (1.401, 1.0, 0.983), rtol=0.01)
