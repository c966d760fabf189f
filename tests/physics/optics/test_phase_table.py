import numpy as np
from numpy.testing import assert_allclose

from airlight.physics.optics import phase_table
from airlight.physics.optics.mie import scattering, scattering_angles
from airlight.physics.optics.size_distribution import gamma_sizes


def test_moments_of_a_fine_table_are_those_of_its_function():
    # Henyey-Greenstein's moments are g^l; a table of 0.1° steps is off by its curvature, 1e-5.
    g = 0.85
    angles = np.linspace(0, 180, 1801)
    mu = np.cos(np.radians(angles))
    row = (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * mu) ** 1.5)
    moments = phase_table.moments(angles, row[None], 60)[0]
    assert_allclose(moments, g ** np.arange(61), rtol=0, atol=2e-5)


def test_a_table_of_three_angles_is_integrated_exactly():
    # Second method: the trapezoid rule with 200 000 points on the same interpolation.
    angles, rows = np.array([0.0, 20.0, 180.0]), np.array([[2.0, 0.05, 0.01]])
    theta = np.linspace(0, 180, 200001)
    values = phase_table.interpolated(angles, rows, theta)[:, 0]
    radians = np.radians(theta)
    for l in (0, 1, 7):
        polynomial = np.polynomial.legendre.Legendre.basis(l)(np.cos(radians))
        expected = 2 * np.pi * np.trapezoid(values * np.sin(radians) * polynomial, radians)
        assert_allclose(phase_table.moments(angles, rows, l)[0, l], expected, rtol=0, atol=1e-8)


def test_zeros_are_joined_by_straight_lines():
    # Half-way between 0 and 1 is 1/2, where a logarithm has no middle.
    values = phase_table.interpolated(
        np.array([0.0, 90.0, 180.0]), np.array([[0.0, 1.0, 4.0]]), [45, 135]
    )
    assert_allclose(values[:, 0], [0.5, 2.0], rtol=1e-12)


def test_mie_table_has_the_moments_of_the_series():
    # Second method: Gauss-Legendre on the series itself, exact for its polynomials.
    sizes, index = gamma_sizes(1.6e-6, 0.3, 60), 1.52 + 0.006j
    angles = scattering_angles(50.0)
    table = scattering(sizes, 550.0, index, angles).phase
    mu, w = np.polynomial.legendre.leggauss(500)
    exact = scattering(sizes, 550.0, index, np.degrees(np.arccos(mu))).phase
    expected = 2 * np.pi * np.polynomial.legendre.legvander(mu, 64).T @ (w * exact)
    moments = phase_table.moments(angles, table[None], 64)[0]
    # 629 angles joined by straight lines in the logarithm: 1e-4.
    assert_allclose(moments, expected, rtol=0, atol=2e-4)
