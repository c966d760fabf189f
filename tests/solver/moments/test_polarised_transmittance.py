"""Polarised light that particles scatter onwards, beyond the degree of its moments."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose
from scipy.special import eval_jacobi

from airlight import load_planet, solve
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.validation.planets import with_point_star


def test_the_forward_part_is_the_element_of_degree_five() -> None:
    # d⁵₂₂ by SciPy's Jacobi polynomial, over Gauss's points; F₃₃ over F₁₁ by Rayleigh's law.
    g = 0.65
    nu, weights = np.polynomial.legendre.leggauss(400)
    phase = (1.0 - g * g) / (4.0 * np.pi * (1.0 + g * g - 2.0 * g * nu) ** 1.5)
    both = phase * (1.0 + 2.0 * nu / (1.0 + nu * nu))
    fifth = (0.5 * (1.0 + nu)) ** 2 * eval_jacobi(3, 0, 4, nu)
    expected = np.pi * weights @ (both * fifth)
    found = HenyeyGreenstein(asymmetry=g).polarising_moments([550.0])
    assert_allclose(found[0, 3], expected, rtol=2e-3)


def test_particles_keep_the_polarisation_of_a_twilight_sky() -> None:
    # Vector histories, 65 536 and more a line: Q/I with a noise of 0.001 to 0.007. Without light
    # scattered onwards the first line was 0.029, 0.037 and 0.036 below, without odd moments the
    # second, straight down from 1 km, 0.010, 0.019 and 0.029.
    earth = with_point_star(load_planet("earth"))
    light = solve(earth, [680.0, 550.0, 440.0], cache=False).radiance(
        altitude=[0.0, 1000.0], sun_zenith=[92.0, 88.0], view_zenith=[80.0, 180.0],
        azimuth=[90.0, 0.0], stokes=True,
    )  # fmt: skip
    degree = (light.sel(stokes="Q") / light.sel(stokes="I")).values
    assert_allclose(degree[0], [0.6958, 0.7114, 0.6409], rtol=0, atol=0.02)
    assert_allclose(degree[1], [-0.0601, -0.0621, -0.0546], rtol=0, atol=0.008)
