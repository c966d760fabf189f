import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.optics import size_distribution as sd

GAMMA = [(1.6e-6, 0.3), (1.05e-6, 0.07), (1.0e-5, 0.1), (5e-7, 0.45)]
LOG_NORMAL = [(3.5e-7, 1.6), (1e-7, 2.2), (1.05e-6, 1.29)]


def _integral(density, low, high, power):
    # An independent rule: the trapezoid in ln r, which converges faster than any power here.
    log_r = np.linspace(np.log(low), np.log(high), 20001)
    r = np.exp(log_r)
    return np.trapezoid(density(r) * r ** (power + 1), log_r)


@pytest.mark.parametrize(("a", "b"), GAMMA)
def test_gamma_distribution_has_the_radius_and_variance_that_name_it(a, b):
    # Their definitions (Hansen & Travis 1974, eqs. 2.53, 2.54), from integrals of the density.
    area, radius, square = (
        _integral(lambda r: sd.gamma_density(r, a, b), a * 1e-9, a * 60, p) for p in (2, 3, 4)
    )
    assert_allclose(radius / area, a, rtol=1e-8)
    assert_allclose(square / area / a**2 - 1, b, rtol=1e-7)


@pytest.mark.parametrize("power", [0, 2, 3, 4])
@pytest.mark.parametrize(("a", "b"), GAMMA[:3])
def test_gamma_moments_are_those_of_its_density(a, b, power):
    # Two methods; power 0 says that there is one particle.
    expected = _integral(lambda r: sd.gamma_density(r, a, b), a * 1e-12, a * 60, power)
    assert_allclose(sd.gamma_moment(power, a, b), expected, rtol=1e-7)


@pytest.mark.parametrize("power", [0, 2, 3, 4])
@pytest.mark.parametrize(("median", "deviation"), LOG_NORMAL)
def test_log_normal_moments_are_those_of_its_density(median, deviation, power):
    # Two methods; power 0 says that there is one particle.
    def density(r):
        return sd.log_normal_density(r, median, deviation)

    expected = _integral(density, median * 1e-5, median * 1e5, power)
    assert_allclose(sd.log_normal_moment(power, median, deviation), expected, rtol=1e-9)


@pytest.mark.parametrize("power", [2, 3, 4])
@pytest.mark.parametrize(("a", "b"), GAMMA)
def test_nodes_of_a_gamma_distribution_carry_its_areas(a, b, power):
    # Exact moments; 2e-6 of area and of forward light is left out on purpose.
    sizes = sd.gamma_sizes(a, b, 400)
    assert_allclose(sizes.weights @ sizes.radii**power, sd.gamma_moment(power, a, b), rtol=2.5e-6)


@pytest.mark.parametrize("power", [2, 3, 4])
@pytest.mark.parametrize(("median", "deviation"), LOG_NORMAL)
def test_nodes_of_a_log_normal_distribution_carry_its_areas(median, deviation, power):
    # Exact moments; 2e-6 of area and of forward light is left out on purpose.
    sizes = sd.log_normal_sizes(median, deviation, 400)
    exact = sd.log_normal_moment(power, median, deviation)
    assert_allclose(sizes.weights @ sizes.radii**power, exact, rtol=2.5e-6)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: sd.gamma_sizes(1e-6, 0.5, 10), "effective_variance"),
        (lambda: sd.gamma_sizes(1e-6, 0.0, 10), "effective_variance"),
        (lambda: sd.gamma_moment(2, 1e-6, 1e-308), "effective_variance"),
        (lambda: sd.gamma_sizes(0.0, 0.1, 10), "effective_radius"),
        (lambda: sd.gamma_density(1e-6, 1e-6, 0.7), "effective_variance"),
        (lambda: sd.log_normal_sizes(1e-6, 0.9, 10), "geometric_deviation"),
        (lambda: sd.log_normal_sizes(-1e-6, 1.5, 10), "median_radius"),
        (lambda: sd.single_size(0.0), "radius"),
    ],
)
def test_sizes_that_cannot_be_are_refused_by_name(make, field):
    # The specification: b below 1/2, σ_g above 1, radii above 0.
    with pytest.raises(ParameterError, match=f"^{field} is .*; allowed: more than"):
        make()
