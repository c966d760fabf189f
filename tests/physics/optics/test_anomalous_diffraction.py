import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.kernel import vectorized
from airlight.physics.optics.anomalous_diffraction import (
    absorption_efficiency,
    cross_sections,
    efficiencies,
    extinction_efficiency,
)
from airlight.physics.optics.size_distribution import gamma_sizes, single_size

absorption = vectorized(absorption_efficiency)
extinction = vectorized(extinction_efficiency)


def _by_rays(z):
    # van de Hulst's own integral over the disc, 4 ∫ (1 - e^{-z sin t}) cos t sin t dt, which has no
    # cancellation: the second method.
    x, w = np.polynomial.legendre.leggauss(200)
    t = 0.25 * np.pi * (x + 1)
    values = -np.expm1(-z * np.sin(t)) * np.cos(t) * np.sin(t)
    return 4 * 0.25 * np.pi * (w @ values)


@pytest.mark.parametrize(
    ("nm", "k", "q_ext", "albedo"),
    [(680, 0.001, 1.949, 0.980), (550, 0.006, 1.977, 0.874), (440, 0.013, 2.098, 0.748)],
)
def test_dust_of_mars_in_anomalous_diffraction(nm, k, q_ext, albedo):
    # The dust check of the specification; half the last printed digit.
    ext, sca = efficiencies(1.6e-6, nm, 1.52 + 1j * k)
    assert_allclose(ext, q_ext, rtol=0, atol=5e-4)
    assert_allclose(sca / ext, albedo, rtol=0, atol=5e-4)


@pytest.mark.parametrize("ratio", [0.0, 0.01, 0.3, 3.0])
@pytest.mark.parametrize("rho", [1e-6, 1e-3, 0.04, 0.0499, 0.0501, 0.3, 4.0, 30.0])
def test_extinction_is_the_integral_over_rays(rho, ratio):
    # Second method; 1e-9 is what is left of the closed form's digits just above its limit.
    expected = _by_rays(rho * (ratio + 1j)).real
    assert_allclose(extinction(rho, rho * ratio), expected, rtol=1e-9)


@pytest.mark.parametrize("rho", [0.0, -0.3])
@pytest.mark.parametrize("damping", [0.0499, 2.0])
def test_index_of_one_and_below(rho, damping):
    assert_allclose(extinction(rho, damping), _by_rays(damping + 1j * rho).real, rtol=1e-9)


@pytest.mark.parametrize("w", [1e-8, 1e-3, 0.0499, 0.0501, 1.0, 20.0])
def test_absorption_is_the_integral_over_rays(w):
    # Second method; 1e-10 is what is left of the closed form's digits just above its limit.
    assert_allclose(absorption(w), 0.5 * _by_rays(w).real, rtol=1e-10)


def test_large_spheres_extinguish_twice_what_they_shade():
    # The exact limit: what is blocked, and as much again diffracted.
    assert_allclose(extinction(1e5, 0.0), 2.0, rtol=5e-5)
    assert_allclose(absorption(1e6), 1.0, rtol=1e-5)


def test_single_scattering_albedo_never_exceeds_one():
    # By construction: Q_sca = Q_ext - Q_abs, Q_abs never negative.
    rho, ratio = np.meshgrid(np.geomspace(1e-3, 1e3, 61), np.geomspace(1e-6, 10, 41))
    ext, absorbed = extinction(rho, rho * ratio), absorption(2 * rho * ratio)
    assert (absorbed >= 0).all()
    assert (ext >= absorbed).all()


def test_a_distribution_is_the_sum_of_its_sizes():
    # Eq. 18 of the OpenSpace paper reduces to its Eq. 20 for one radius, and is linear.
    index, nm = 1.52 + 0.006j, 550.0
    one = np.array(cross_sections(single_size(1.6e-6), nm, index))
    assert_allclose(one, np.pi * 1.6e-6**2 * np.array(efficiencies(1.6e-6, nm, index)), rtol=1e-14)
    sizes = gamma_sizes(1.6e-6, 0.3, 50)
    parts = np.array([cross_sections(single_size(r), nm, index) for r in sizes.radii])
    assert_allclose(cross_sections(sizes, nm, index), sizes.weights @ parts, rtol=1e-12)
