"""Light of a flat layer of particles against its limits, reciprocity and energy."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import vectorized
from airlight.physics.optics.ring_layer import (
    power_law_norm,
    ring_phase,
    single_scattering_layer,
)

LAYER = vectorized(single_scattering_layer)


@pytest.mark.parametrize(("exponent", "dust"), [(0.0, 0.0), (3.092, 0.0), (3.092, 0.4)])
def test_phase_functions_of_rings_integrate_to_one(exponent, dust):
    # a law; the quadrature is exact to rounding for these smooth functions
    rule = gauss_legendre(200)
    nu = 2.0 * rule.nodes - 1.0
    values = vectorized(ring_phase)(nu, exponent, power_law_norm(exponent), dust, 0.5)
    assert_allclose(4.0 * np.pi * np.sum(rule.weights * values), 1.0, rtol=1e-5)


def test_large_particles_scatter_backward():
    # (π - α)ⁿ is largest at a phase angle α of 0, where the scattering angle is π
    norm = power_law_norm(3.092)
    assert ring_phase(-1.0, 3.092, norm, 0.0, 0.0) > 50.0 * ring_phase(0.9, 3.092, norm, 0.0, 0.0)


@pytest.mark.parametrize("depth", [1e-3, 0.1, 0.5, 2.0, 30.0])
@pytest.mark.parametrize(("mu", "mu_s"), [(0.9, 0.3), (0.2, 0.7), (0.5, 0.4999)])
def test_layer_follows_chandrasekhar(depth, mu, mu_s):
    # the formulas as they are printed; the last pair loses four digits in their difference
    lit = mu_s / (mu + mu_s) * (1.0 - np.exp(-depth * (1.0 / mu + 1.0 / mu_s)))
    other = mu_s / (mu - mu_s) * (np.exp(-depth / mu) - np.exp(-depth / mu_s))
    assert_allclose(LAYER(depth, mu, mu_s), lit, rtol=1e-6)
    assert_allclose(LAYER(depth, -mu, mu_s), other, rtol=1e-6)


def test_layer_has_its_limits():
    # thin: τ/μ on both sides; thick: μ₀/(μ + μ₀) and nothing; straight through: τ/μ e^(-τ/μ)
    assert_allclose(LAYER(1e-7, np.array([0.4, -0.4]), 0.3), 1e-7 / 0.4, rtol=1e-6)
    assert_allclose(LAYER(500.0, np.array([0.4, -0.4]), 0.3), [3.0 / 7.0, 0.0], atol=1e-12)
    assert_allclose(LAYER(0.7, -0.3, 0.3), 0.7 / 0.3 * np.exp(-0.7 / 0.3), rtol=1e-12)


def test_layer_is_reciprocal():
    # light and line of sight exchanged: L μ / E μ₀ ... the same scattered fraction per normal area
    for sign in (1.0, -1.0):
        there, back = LAYER(0.8, sign * 0.6, 0.25) * 0.6, LAYER(0.8, sign * 0.25, 0.6) * 0.25
        assert_allclose(there, back, rtol=1e-12)


@pytest.mark.parametrize("depth", [1e-4, 0.3, 3.0])
def test_layer_scatters_no_more_than_it_intercepts(depth):
    # isotropic particles of albedo 1 scatter what is intercepted; some of it is lost on its way
    rule, mu_s = gauss_legendre(400), 0.4
    flux = sum(
        2.0 * np.pi * np.sum(rule.weights * rule.nodes * LAYER(depth, side * rule.nodes, mu_s))
        for side in (1.0, -1.0)
    ) / (4.0 * np.pi)
    intercepted = mu_s * (1.0 - np.exp(-depth / mu_s))
    assert flux < intercepted
    if depth < 1e-3:
        assert_allclose(flux, intercepted, rtol=2e-3)  # of second order, τ ln τ
