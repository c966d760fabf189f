"""Reflection of land: reciprocity, energy, and the law's formula."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.quadrature import gauss_legendre
from airlight.physics.optics.rpv import LOWEST, land_diffuse, land_direct, unsaturated


def turned(mu_s: float, mu_r: float, azimuth: float) -> float:
    """Cosine between the line of sight and the direction to the star; the azimuth is 0 for both
    on the same side, where the phase angle is least. [1]"""
    sines = np.sqrt((1.0 - mu_s**2) * (1.0 - mu_r**2))
    return float(-mu_s * mu_r - sines * np.cos(azimuth))


def directional_albedo(mu_s: float) -> float:
    """Share of a beam that is reflected over the albedo, by quadrature. [1]"""
    mu, weights = gauss_legendre(48).as_tuple()[:2]
    turns = (np.arange(32) + 0.5) * np.pi / 32.0
    rows = [
        np.mean([land_direct(mu_s, one, turned(mu_s, one, phi)) for phi in turns]) for one in mu
    ]
    return float(2.0 * mu * weights @ rows)


@pytest.mark.parametrize(("mu_s", "mu_r"), [(0.9, 0.2), (0.05, 0.6), (0.4, 1.0)])
def test_it_is_reciprocal(mu_s: float, mu_r: float) -> None:
    # Helmholtz: the phase angle is common, and both cosines are exchanged.
    nu = turned(mu_s, mu_r, 0.7)
    assert land_direct(mu_s, mu_r, nu) == land_direct(mu_r, mu_s, nu)


def test_its_bihemispherical_albedo_is_the_given_one() -> None:
    # Second method: a sum over both hemispheres.
    mu, weights = gauss_legendre(24).as_tuple()[:2]
    total = 2.0 * mu * weights @ [directional_albedo(one) for one in mu]
    assert_allclose(total, 1.0, rtol=2e-3)
    assert_allclose(2.0 * mu * weights @ [land_diffuse(one) for one in mu], 1.0, rtol=2e-3)


@pytest.mark.parametrize("mu", [0.02, 0.1, 0.3, 0.6, 1.0])
def test_the_diffuse_law_is_the_directional_albedo(mu: float) -> None:
    # By reciprocity; the root is a fit, within 6 %.
    assert_allclose(land_diffuse(mu), directional_albedo(mu), rtol=0.06)


def test_land_reflects_no_more_than_it_receives() -> None:
    # The largest directional albedo, at grazing incidence, at any reflectance.
    most = directional_albedo(LOWEST)
    for albedo in np.linspace(0.0, 1.0, 21):
        assert albedo * unsaturated(most, albedo) <= 1.0


def test_it_is_the_published_formula() -> None:
    # Rahman et al. (1993), eqs. 3 to 5, relative to another direction: the norm cancels.
    def formula(mu_s: float, mu_r: float, nu: float) -> float:
        lobe = (1.0 - 0.01) / (1.0 - 2.0 * 0.1 * -nu + 0.01) ** 1.5
        return float((mu_s * mu_r * (mu_s + mu_r)) ** (0.75 - 1.0) * lobe)

    places = [(0.2, 0.3, 0.8), (0.9, 0.15, -0.5)]
    seen, wanted = ([law(*one) for one in places] for law in (land_direct, formula))
    assert_allclose(seen[0] / seen[1], wanted[0] / wanted[1], rtol=1e-12)
