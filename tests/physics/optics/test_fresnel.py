"""Reflection by a smooth surface: Fresnel's formulas at angles where laws give the answer."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.optics.fresnel import fresnel_amplitudes, fresnel_reflectances

COSINES = np.linspace(0.01, 1.0, 40)
INDICES = [1.0003, 1.34, 1.5, 2.4]


@pytest.mark.parametrize("n", INDICES)
def test_straight_on_both_polarisations_are_alike(n):
    # Fresnel: ((n - 1)/(n + 1))².
    assert_allclose(fresnel_reflectances(n, 1.0), [((n - 1.0) / (n + 1.0)) ** 2] * 2, rtol=1e-12)


@pytest.mark.parametrize("n", INDICES)
def test_at_brewster_s_angle_one_polarisation_is_not_reflected(n):
    # Brewster: tan i = n; the sign changes there.
    brewster = 1.0 / np.sqrt(1.0 + n * n)
    assert_allclose(fresnel_amplitudes(n, brewster)[1], 0.0, atol=1e-15)
    assert (
        fresnel_amplitudes(n, 1.01 * brewster)[1] > 0.0 > fresnel_amplitudes(n, 0.99 * brewster)[1]
    )


@pytest.mark.parametrize("n", INDICES)
def test_a_grazing_beam_is_mirrored(n):
    # Half of the phase is lost by both polarisations.
    assert_allclose(fresnel_amplitudes(n, 0.0), [-1.0, -1.0], rtol=1e-12)


@pytest.mark.parametrize("n", INDICES)
def test_what_is_not_reflected_goes_through(n):
    # Energy, with Fresnel's amplitudes of transmitted light, Born & Wolf eq. 1.5.20: the beam is
    # n cos t/cos i times as wide and dense.
    inside = np.sqrt(1.0 - (1.0 - COSINES**2) / n**2)
    across = 2.0 * COSINES / (COSINES + n * inside)
    along = 2.0 * COSINES / (n * COSINES + inside)
    reflected = np.transpose([fresnel_reflectances(n, each) for each in COSINES])
    for amplitude, share in zip((across, along), reflected, strict=True):
        assert_allclose(share + n * inside / COSINES * amplitude**2, 1.0, rtol=1e-12)


def test_amplitudes_are_those_of_the_angles():
    # Fresnel's law of sines and of tangents.
    angle = np.arccos(COSINES[:-1])
    bent = np.arcsin(np.sin(angle) / 1.34)
    r_s, r_p = np.transpose([fresnel_amplitudes(1.34, each) for each in COSINES[:-1]])
    assert_allclose(r_s, -np.sin(angle - bent) / np.sin(angle + bent), rtol=1e-10)
    assert_allclose(r_p, np.tan(angle - bent) / np.tan(angle + bent), rtol=1e-10, atol=1e-12)
