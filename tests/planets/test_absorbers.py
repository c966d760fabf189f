"""Absorbers: coefficients from cross-sections, columns and refractive indices."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.constants import DOBSON_UNIT
from airlight.physics.optics.gas_absorption import small_particle_absorption
from airlight.planets import Constituent, Medium
from airlight.planets.matter.absorbers import (
    CrossSectionAbsorption,
    OzoneAbsorption,
    SmallParticleAbsorption,
)
from airlight.planets.matter.profiles import Exponential, Tent
from airlight.planets.planet import Planet
from airlight.planets.spectral import PerWavelength
from airlight.planets.star import Star

NM = np.array([680.0, 550.0, 440.0])
#: Ozone at 293 K, the golden values of the physics text. [m²]
OZONE = (1.368e-25, 3.314e-25, 1.360e-26)


@pytest.mark.parametrize("cross_section", ["ozone-293k", OZONE])
def test_a_column_has_its_golden_optical_depth_however_it_is_given(cross_section):
    # 345 DU: 0.0127, 0.0307, 0.0013, half the last digit, for the named table and for the list
    if not isinstance(cross_section, str):
        cross_section = PerWavelength(wavelengths=tuple(NM), values=cross_section)
    layer = CrossSectionAbsorption(cross_section=cross_section, column=345.0 * DOBSON_UNIT)
    for profile in (Tent(center=25e3, half_width=15e3), Exponential(scale_height=7e3)):
        column = profile.column(1e5)
        depth = layer.coefficients(NM, column) * column
        assert_allclose(depth, [0.0127, 0.0307, 0.0013], rtol=0, atol=5e-5)
        own = OzoneAbsorption(column=345.0 * DOBSON_UNIT).coefficients(NM, column)
        assert_allclose(own * column, depth, rtol=1e-12)


def test_oxygen_is_equations_13_and_14_of_openspace():
    # β(h) = σ N₀ 0.2095 exp(-h/H), computed by hand at 0, 8 and 24 km
    sigma = np.array([1e-29, 2e-29, 3e-29])
    oxygen = Constituent(
        name="oxygen",
        profile=Exponential(scale_height=8e3),
        absorption=CrossSectionAbsorption(
            cross_section=PerWavelength(wavelengths=tuple(NM), values=tuple(sigma)),
            number_density=2.547e25,
            fraction=0.2095,
        ),
    )
    planet = Planet(
        name="Test",
        bottom_radius=6.36e6,
        top_radius=6.46e6,
        star=Star(irradiance=1.0, angular_radius=0.27),
        constituents=(oxygen,),
    )
    medium = Medium.from_planet(planet, tuple(NM))
    altitudes = np.array([0.0, 8e3, 24e3])
    found = medium.density.at(altitudes)[0][:, None] * medium.absorption[0]
    expected = sigma * 2.547e25 * 0.2095 * np.exp(-altitudes / 8e3)[:, None]
    assert_allclose(found, expected, rtol=1e-12)


@pytest.mark.parametrize("index", [1.5 + 0.1j, 1.75 + 0.44j, 1.33 + 1e-3j, 2.0 + 1.0j])
def test_tiny_particles_absorb_as_exact_mie_theory_says(index):
    # miepython at x = 2πr/λ = 0.01: the small-particle limit errs by about x² to 1.2 x²
    miepython = pytest.importorskip("miepython")
    x = 0.01
    extinction, scattering, *_ = miepython.efficiencies_mx(index.conjugate(), x)
    radius = x * 550e-9 / (2.0 * np.pi)
    exact = (extinction - scattering) * np.pi * radius**2 * 1e9
    found = small_particle_absorption(550.0, radius, 1e9, index.real, index.imag)
    assert_allclose(found, exact, rtol=4e-4)


def test_tiny_particles_without_imaginary_index_absorb_nothing():
    # k = 0: Im of a real number
    clear = SmallParticleAbsorption(radius=1e-8, number_density=1e9, real=1.5, imaginary=0.0)
    assert_allclose(clear.coefficients(NM, 1.0), 0.0, rtol=0, atol=0)


def test_tiny_particles_are_known_above_their_circumference_only():
    # x = 2πr/λ < 1: 2π · 100 nm = 628 nm
    big = SmallParticleAbsorption(radius=1e-7, number_density=1e9, real=1.5, imaginary=0.1)
    assert_allclose(big.limits[0], 628.3185, rtol=1e-6)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: CrossSectionAbsorption(cross_section=1e-25), "column is missing"),
        (
            lambda: CrossSectionAbsorption(cross_section=1e-25, column=1.0, number_density=1.0),
            "column is 1.0",
        ),
        (
            lambda: CrossSectionAbsorption(cross_section=1e-25, column=1.0, fraction=0.5),
            "fraction",
        ),
        (
            lambda: CrossSectionAbsorption(cross_section=1e-25, number_density=1.0, fraction=2.0),
            "fraction",
        ),
        (lambda: CrossSectionAbsorption(cross_section=-1e-25, column=1.0), "cross_section"),
        (lambda: CrossSectionAbsorption(cross_section="astm-g173", column=1.0), "cross_section"),
        (lambda: CrossSectionAbsorption(cross_section="ozon", column=1.0), "cross_section"),
        (
            lambda: SmallParticleAbsorption(radius=1e-8, number_density=1, real=1, imaginary=-0.1),
            "imaginary",
        ),
        (
            lambda: SmallParticleAbsorption(radius=0.0, number_density=1, real=1, imaginary=0.1),
            "radius",
        ),
    ],
)
def test_what_cannot_be_is_refused_by_name_in_one_line(make, field):
    with pytest.raises(ParameterError) as caught:
        make()
    assert str(caught.value).startswith(field)
    assert "\n" not in str(caught.value)
