"""Hapke's law: reciprocity, energy, closed forms, and Chandrasekhar's functions."""

from __future__ import annotations

from math import cos, pi, radians

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.optics.hapke import (
    MOON,
    REGOLITHS,
    Regolith,
    brdf_diffuse,
    directional_albedo,
    grain_phase,
    hapke_reflectance,
    multiple_scattering,
    reflectances,
    regolith,
)
from airlight.physics.optics.reflection import Reflection

#: Directions all over the hemisphere.
RANDOM = np.random.default_rng(1)
MU_S, MU_R = RANDOM.uniform(0.02, 1.0, (2, 300))
COSINE = MU_S * MU_R + np.sqrt((1.0 - MU_S**2) * (1.0 - MU_R**2)) * np.cos(
    RANDOM.uniform(0.0, pi, 300)
)
#: Gauss-Legendre over [0, 1].
NODES, WEIGHTS = (
    0.5 * (x + shift)
    for x, shift in zip(np.polynomial.legendre.leggauss(48), (1.0, 0.0), strict=True)
)


@pytest.mark.parametrize("name", REGOLITHS)
def test_light_takes_the_same_way_back(name: str) -> None:
    # Helmholtz: swapping sun and observer swaps Hapke's two cases of shadowing.
    factor = reflectances(regolith(*REGOLITHS[name]))
    assert_allclose(factor(MU_S, MU_R, COSINE), factor(MU_R, MU_S, COSINE), rtol=1e-12)


def test_level_ground_without_a_surge_has_the_closed_form() -> None:
    # Hapke (1981), eq. 16: w/4 [p + H H - 1]/(μ₀ + μ); isotropic grains, and w → 0 as Seeliger's.
    ground = regolith(0.5, 0.0, 0.0, 0.0, 0.05, 0.0)
    high, low = (multiple_scattering(mu, 0.5) for mu in (0.9, 0.3))
    expected = 0.25 * 0.5 * high * low / (0.9 + 0.3)
    assert_allclose(hapke_reflectance(0.9, 0.3, 0.1, ground), expected, rtol=1e-12)
    dark = regolith(1e-6, 0.0, 0.0, 0.0, 0.05, 0.0)
    assert_allclose(hapke_reflectance(0.9, 0.3, 0.1, dark) / 1e-6, 0.25 / 1.2, rtol=1e-5)


def test_slight_roughness_is_level_ground() -> None:
    # θ̄ → 0: the effective cosines become the true ones and S 1, except at grazing angles.
    level, rough = (regolith(0.4, 0.2, 0.3, 1.0, 0.06, angle) for angle in (0.0, 0.02))
    high = (MU_S > 0.1) & (MU_R > 0.1)
    directions = MU_S[high], MU_R[high], COSINE[high]
    assert_allclose(reflectances(rough)(*directions), reflectances(level)(*directions), rtol=2e-3)


@pytest.mark.parametrize("grain_albedo", [0.3, 0.8, 0.95])
def test_the_h_function_solves_chandrasekhar_s_equation(grain_albedo: float) -> None:
    # 1/H(μ) = √(1 - w) + w/2 ∫ x H(x)/(μ + x) dx (Chandrasekhar 1960, Radiative Transfer, eq. V.31
    # with its integral), by iteration; Hapke's approximation errs by less than 1 %.
    exact = np.ones_like(NODES)
    for _ in range(300):
        kernel = (WEIGHTS * NODES * exact) / (NODES[:, None] + NODES)
        exact = 1.0 / (np.sqrt(1.0 - grain_albedo) + 0.5 * grain_albedo * kernel.sum(axis=1))
    found = [multiple_scattering(mu, grain_albedo) for mu in NODES]
    assert_allclose(found, exact, rtol=1e-2)


def test_grains_scatter_all_light() -> None:
    # The mean of the phase function over the sphere is 1.
    mu = 2.0 * NODES - 1.0
    mean = sum(w * grain_phase(x, 0.4, 0.3) for x, w in zip(mu, WEIGHTS, strict=True))
    assert_allclose(mean, 1.0, rtol=1e-10)


def test_the_surge_is_half_at_twice_the_width() -> None:
    # B₀/(1 + tan(g/2)/h): B₀ at opposition, half of it where tan(g/2) = h. Isotropic grains.
    def surge(angle: float) -> float:
        strong, none = (
            hapke_reflectance(0.8, 0.8, cos(angle), regolith(0.2, 0.0, 0.0, b, 0.06, 0.0))
            for b in (1.5, 0.0)
        )
        return (strong - none) * 4.0 * 1.6 / 0.2

    assert_allclose([surge(0.0), surge(2.0 * np.arctan(0.06))], [1.5, 0.75], rtol=1e-6)


@pytest.mark.parametrize("name", REGOLITHS)
def test_the_fit_of_the_sky_is_the_integral(name: str) -> None:
    # Second method: a finer quadrature in other coordinates, midpoints in angle and azimuth.
    ground = regolith(*REGOLITHS[name])
    emergent = (np.arange(120) + 0.5) / 120 * 0.5 * pi
    azimuth = (np.arange(240) + 0.5) / 240 * pi
    for mu in (0.1, 0.5, 0.9):
        cosines = np.cos(emergent)[:, None]
        cosine = mu * cosines + np.sqrt((1 - mu * mu) * (1 - cosines**2)) * np.cos(azimuth)
        factor = reflectances(ground)(np.full_like(cosine, mu), cosines + 0.0 * cosine, cosine)
        total = (factor.mean(axis=1) * np.sin(2.0 * emergent)).mean() * 0.5 * pi
        found = brdf_diffuse(Reflection(1.0, regolith=ground), mu)[0]
        assert_allclose(found, total * ground.scale, rtol=5e-3)


def test_no_regolith_reflects_more_than_arrives() -> None:
    # Directional albedos: of white grains without a surge, within H's 1 %; of the published ones.
    mu = np.linspace(0.01, 1.0, 12)
    assert directional_albedo(mu, regolith(1.0, 0.0, 0.0, 0.0, 0.05, 0.0)).max() < 1.0
    for values in REGOLITHS.values():
        assert directional_albedo(mu, regolith(*values)).max() < 1.0


def test_the_moon_s_constants_are_its_parameters() -> None:
    # Those of the default ground, which imports read without a quadrature.
    assert_allclose(MOON, regolith(*REGOLITHS["moon"]), rtol=1e-9)
    assert isinstance(MOON, Regolith)
    assert_allclose(MOON.slope, np.tan(radians(23.4)), rtol=1e-12)
