"""Odd moments of polarised light, B₂₁ and B₂₂, which particles keep and molecules do not."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets.matter.phases import HenyeyGreenstein, PhaseFunction, Rayleigh
from airlight.solver.moments.harmonics import polarised_function
from airlight.solver.montecarlo.stokes import plane_turn, scatter, start_axis

Vector = tuple[float, float, float]


def direction(mu: float, phi: float) -> Vector:
    """Unit vector of a line of sight."""
    sine = (1.0 - mu * mu) ** 0.5
    return sine * cos(phi), sine * sin(phi), mu


def ratio(law: PhaseFunction, nu: float) -> float:
    """F₃₃ over F₁₁ by Rayleigh's law, which both phase functions have. [1]"""
    return 2.0 * nu / (1.0 + nu * nu)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("odd", [False, True])
@pytest.mark.parametrize("law", [HenyeyGreenstein(asymmetry=0.5), Rayleigh()], ids=["HG", "air"])
def test_a_harmonic_of_degree_two_is_scattered_into_itself(
    law: PhaseFunction, odd: bool, order: int
) -> None:
    # Q and U of one harmonic, scattered once by full phase matrices that are turned as histories
    # turn them, integrated over the sphere by Gauss's rule.
    seen_mu, seen_phi = 0.35, 0.8
    out = direction(seen_mu, seen_phi)
    nodes, weights = np.polynomial.legendre.leggauss(24)
    turns = 48
    found = np.zeros(3)
    for mu, weight in zip(nodes, weights, strict=True):
        along, across = polarised_function(mu, order)
        if odd:
            along, across = across, along
        for phi in (np.arange(turns) + 0.5) * (2.0 * pi / turns):
            arriving = direction(mu, phi)
            nu = float(np.dot(out, arriving))
            product = np.zeros((3, 4))
            product[[0, 1, 2], [0, 1, 2]] = 1.0
            cosine, sine, *normal = plane_turn(*out, *arriving, *start_axis(*out))
            f11 = float(law.values(nu, [550.0])[0])
            f12 = float(law.phase_f12(nu, [550.0])[0]) / f11
            f33 = ratio(law, nu)
            scatter(product, cosine, sine, f12, 1.0, f33, 0.0, f33)
            # The scattering plane's axis of the light that arrives: its normal × the direction.
            axis = np.cross(normal, arriving)
            down = np.array(start_axis(*arriving))
            c, s = float(axis @ down), float(axis @ np.cross(arriving, down))
            q, u = along * cos(order * phi), across * sin(order * phi)
            turned = np.array(
                [0.0, q * (c * c - s * s) + 2.0 * u * c * s, u * (c * c - s * s) - 2.0 * q * c * s,
                 0.0]
            )  # fmt: skip
            found += weight * (2.0 * pi / turns) * f11 * (product @ turned)
    beta_1, even, kept, _ = law.polarising_moments([550.0])[0]
    along, across = polarised_function(seen_mu, order)
    if odd:
        along, across = across, along
    part = kept if odd else even
    expected = [part * along * cos(order * seen_phi), part * across * sin(order * seen_phi)]
    assert_allclose(found[1:], expected, rtol=0, atol=2e-3 * abs(even))
    # Even light alone turns into brightness, of the harmonic of degree 2 without spin.
    sine = (1.0 - seen_mu**2) ** 0.5
    plain = (15.0 / (4.0 * pi)) ** 0.5 * sine * (seen_mu if order == 1 else 0.5 * sine)
    bright = 0.0 if odd else beta_1 * plain * cos(order * seen_phi)
    assert_allclose(found[0], bright, rtol=0, atol=1e-6)
