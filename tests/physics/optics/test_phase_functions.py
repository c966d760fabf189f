"""Phase functions keep energy, have the published shapes and the known moments."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.kernel import vectorized
from airlight.physics.optics import phase_functions as phases
from airlight.physics.optics.legendre import legendre_moments, phase_integral

NU = np.linspace(-1.0, 1.0, 41)
ASYMMETRIES = (-0.95, -0.5, 0.0, 0.3, 0.8, 0.95, 0.98, 0.999)


def of(formula, *parameters):
    several = vectorized(formula)
    return lambda nu: several(nu, *parameters)


@pytest.mark.parametrize("g", ASYMMETRIES)
def test_particle_phase_functions_integrate_to_one(g):
    # a law: what is scattered goes somewhere
    for formula in (phases.henyey_greenstein, phases.cornette_shanks):
        assert_allclose(phase_integral(of(formula, g)), 1.0, rtol=1e-10)
    both = of(phases.double_henyey_greenstein, g, -0.3, 0.7)
    assert_allclose(phase_integral(both), 1.0, rtol=1e-10)


@pytest.mark.parametrize("delta", [0.0, 0.0279, 0.035, 0.09, 0.5])
def test_rayleigh_integrates_to_one_at_any_depolarisation(delta):
    assert_allclose(phase_integral(of(phases.rayleigh, delta)), 1.0, rtol=1e-13)


def test_modified_rayleigh_makes_twelve_percent_of_light():
    # 0.8 · 1.4: the cosine averages to 0
    assert_allclose(phase_integral(of(phases.rayleigh_modified)), 1.12, rtol=1e-13)


def test_chandrasekhar_at_0_035_is_penndorf():
    # OS Eq 10, Penndorf 1957: 0.7629 (1 + 0.932 cos²), to half the last printed digit
    unit = 4.0 * np.pi * vectorized(phases.rayleigh)(NU, 0.035)
    constant, slope = unit[20], unit[-1] - unit[20]
    assert_allclose(constant, 0.7629, rtol=0, atol=5e-5)
    assert_allclose(slope / constant, 0.932, rtol=0, atol=5e-4)


def test_rayleigh_without_depolarisation_is_the_textbook_one():
    expected = 3.0 / (16.0 * np.pi) * (1.0 + NU**2)
    assert_allclose(vectorized(phases.rayleigh)(NU, 0.0), expected, rtol=1e-14)


def test_cornette_shanks_has_the_published_mean_cosine():
    # Cornette & Shanks 1992: 3g(4+g²)/(5(2+g²)), 0.8436 at g = 0.8
    mean = legendre_moments(of(phases.cornette_shanks, 0.8), 1)[1]
    assert_allclose(mean, 0.8436, rtol=0, atol=5e-5)
    for g in (-0.9, 0.2, 0.76):
        mean = legendre_moments(of(phases.cornette_shanks, g), 1)[1]
        assert_allclose(mean, 3 * g * (4 + g * g) / (5 * (2 + g * g)), rtol=1e-12)


@pytest.mark.parametrize("g", ASYMMETRIES)
def test_henyey_greenstein_moments_are_powers_of_g(g):
    # Henyey & Greenstein's expansion: g_l = g^l
    moments = legendre_moments(of(phases.henyey_greenstein, g), 64)
    assert_allclose(moments, g ** np.arange(65), rtol=0, atol=1e-10)


@pytest.mark.parametrize("delta", [0.0, 0.035, 0.3])
def test_rayleigh_second_moment_is_a_tenth_times_its_anisotropy(delta):
    # Chandrasekhar: g_2 = (1-γ)/(10 (1+2γ)), all other moments beyond g_0 vanish
    gamma = delta / (2.0 - delta)
    moments = legendre_moments(of(phases.rayleigh, delta), 6)
    expected = [1.0, 0.0, 0.1 * (1.0 - gamma) / (1.0 + 2.0 * gamma), 0.0, 0.0, 0.0, 0.0]
    assert_allclose(moments, expected, rtol=0, atol=1e-13)


def test_double_henyey_greenstein_moments_are_mixed_powers():
    g1, g2, alpha = 0.889, 0.094, 0.743
    moments = legendre_moments(of(phases.double_henyey_greenstein, g1, g2, alpha), 20)
    l = np.arange(21)
    assert_allclose(moments, alpha * g1**l + (1.0 - alpha) * g2**l, rtol=0, atol=1e-12)


def test_moments_of_several_phase_functions_come_together():
    stacked = legendre_moments(
        lambda nu: vectorized(phases.henyey_greenstein)(nu, np.array([[0.1], [0.7]])), 4
    )
    assert_allclose(stacked, np.array([[0.1], [0.7]]) ** np.arange(5), rtol=0, atol=1e-12)


def test_moments_rebuild_the_phase_function():
    # p(ν) = Σ (2l+1)/4π g_l P_l(ν), a second way to the same function
    moments = legendre_moments(of(phases.cornette_shanks, 0.5), 60)
    series = (2.0 * np.arange(61) + 1.0) / (4.0 * np.pi) * moments
    rebuilt = np.polynomial.legendre.legval(NU, series)
    assert_allclose(rebuilt, vectorized(phases.cornette_shanks)(NU, 0.5), rtol=1e-9)
