"""Planets made in Python: checked when they are made, varied with ``replace``."""

from __future__ import annotations

import dataclasses
import pickle

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.constants import ASTRONOMICAL_UNIT, SOLAR_RADIUS
from airlight.planets import Constituent, Ground, Medium, Planet, Star, load_planet, replace
from airlight.planets.matter.absorbers import OzoneAbsorption
from airlight.planets.matter.gases import GasScattering, RefractiveScattering
from airlight.planets.matter.phases import (
    CornetteShanks,
    DoubleHenyeyGreenstein,
    HenyeyGreenstein,
    Rayleigh,
    TabulatedPhase,
)
from airlight.planets.matter.profiles import Exponential, Layer, Layered, Tabulated, Tent, Uniform
from airlight.planets.spectral import PerWavelength

AIR = Constituent(
    name="air",
    profile=Exponential(scale_height=8e3),
    scattering=PerWavelength(wavelengths=(680.0, 550.0, 440.0), values=(5.8e-6, 13.6e-6, 33.1e-6)),
    phase_function=Rayleigh(),
)
SUN = Star(irradiance=1.0, angular_radius=0.27)
EARTH = Planet(name="Test", bottom_radius=6.36e6, top_radius=6.46e6, star=SUN, constituents=(AIR,))


def test_parameter_objects_are_frozen_and_keyword_only():
    with pytest.raises(dataclasses.FrozenInstanceError):
        EARTH.bottom_radius = 1.0
    with pytest.raises(ParameterError):
        Exponential(8e3)


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: Exponential(scale_height=-1.0), "scale_height"),
        (lambda: Exponential(scale_height="8 km"), "scale_height"),
        (lambda: Exponential(scale_height=True), "scale_height"),
        (lambda: Exponential(scale_height=float("nan")), "scale_height"),
        (lambda: Exponential(), "scale_height"),
        (lambda: Exponential(scale_height=8e3, width=3.0), "width"),
        (lambda: Tent(center=-1.0, half_width=1e3), "center"),
        (lambda: Layered(layers=()), "layers"),
        (lambda: Layered(layers=(Layer(), Layer())), "layers[0].width"),
        (lambda: Tabulated(altitudes=(0.0, 0.0), densities=(1.0, 1.0)), "altitudes[1]"),
        (lambda: Tabulated(altitudes=(0.0,), densities=(1.0,)), "altitudes"),
        (lambda: HenyeyGreenstein(asymmetry=1.0), "asymmetry"),
        (lambda: CornetteShanks(asymmetry=-1.0), "asymmetry"),
        (
            lambda: DoubleHenyeyGreenstein(asymmetry_1=0.9, asymmetry_2=0.1, weight=1.5),
            "weight",
        ),
        (lambda: Rayleigh(depolarisation=0.6), "depolarisation"),
        (
            lambda: HenyeyGreenstein(asymmetry=PerWavelength(wavelengths=(1e3,), values=(1.0,))),
            "asymmetry[0]",
        ),
        (lambda: PerWavelength(wavelengths=(500.0, 500.0), values=(1.0, 1.0)), "wavelengths"),
        (lambda: PerWavelength(wavelengths=(500.0, 600.0), values=(1.0,)), "values"),
        (lambda: TabulatedPhase(angles=(0.0, 90.0, 180.0), rows=((1.0, 1.0, 1.0),)), "integral"),
        (lambda: Ground(albedo=1.01), "albedo"),
        (lambda: Star(spectrum="astm-g173", irradiance=1.0), "light"),
        (lambda: Star(irradiance=1.0), "angular_radius"),
        (lambda: Star(temperature=5772.0, radius=7e8), "temperature requires distance"),
        (lambda: Star(temperature=5772.0, radius=7e8, distance=8e8), "radius"),
        (lambda: GasScattering(gas="argon", number_density=1e25), "gas"),
        (lambda: GasScattering(gas="air"), "number_density"),
        (lambda: GasScattering(gas="air", pressure=1e5), "pressure requires temperature"),
        (
            lambda: RefractiveScattering(
                refractivity=3e-4, number_density=2.8e23, temperature=273.15, pressure=101325.0
            ),
            "number_density",
        ),
        (lambda: OzoneAbsorption(column=-1.0), "column"),
        (lambda: replace(AIR, phase_function=None), "phase_function"),
        (lambda: replace(AIR, scattering=-1e-6), "scattering"),
        (lambda: replace(AIR, scattering="much"), "scattering"),
        (lambda: replace(AIR, profile=3), "profile"),
        (lambda: replace(AIR, colour="blue"), "field of Constituent"),
        (lambda: replace(EARTH, top_radius=6.36e6), "top_radius"),
        (lambda: replace(EARTH, constituents=()), "constituents"),
        (lambda: replace(EARTH, constituents=(AIR, AIR)), "constituents[1].name"),
        (lambda: replace(EARTH, default_wavelengths=(-5.0,)), "default_wavelengths[0]"),
        (lambda: replace(3, x=1), "instance"),
    ],
)
def test_what_cannot_be_is_refused_by_name_in_one_line(make, field):
    with pytest.raises(ParameterError) as caught:
        make()
    assert str(caught.value).startswith(field)
    assert "\n" not in str(caught.value)


def test_parts_without_a_common_wavelength_are_refused():
    red = Constituent(
        name="red",
        profile=Uniform(),
        absorption=PerWavelength(wavelengths=(680.0,), values=(1e-6,)),
    )
    blue = replace(red, name="blue", absorption=PerWavelength(wavelengths=(440.0,), values=(1e-6,)))
    with pytest.raises(ParameterError, match="common wavelength"):
        replace(EARTH, constituents=(red, blue))


def test_replace_changes_one_field_and_the_fingerprint():
    thinner = replace(EARTH, constituents=(replace(AIR, profile=Exponential(scale_height=7e3)),))
    assert thinner.bottom_radius == EARTH.bottom_radius
    media = [Medium.from_planet(planet, [550.0]) for planet in (EARTH, thinner, EARTH)]
    prints = [medium.fingerprint() for medium in media]
    assert prints[0] == prints[2]
    assert prints[0] != prints[1]
    assert_allclose(media[1].columns, 7e3, rtol=1e-5)


@pytest.mark.parametrize(
    "change",
    [
        {"bottom_radius": 6.361e6},
        {"top_radius": 6.461e6},
        {"ground": Ground(albedo=0.2)},
        {"star": Star(irradiance=2.0, angular_radius=0.27)},
        {"star": Star(irradiance=1.0, angular_radius=0.28)},
        {"constituents": (replace(AIR, absorption=1e-9),)},
        {"constituents": (replace(AIR, phase_function=Rayleigh(depolarisation=0.01)),)},
    ],
)
def test_every_change_of_the_planet_changes_the_fingerprint(change):
    before = Medium.from_planet(EARTH, [550.0]).fingerprint()
    assert Medium.from_planet(replace(EARTH, **change), [550.0]).fingerprint() != before


def test_appearance_is_no_input_of_a_solution():
    # town lights are seen and light no air
    ground = Ground(albedo=0.1, map="earth", lights="earth")
    media = [
        Medium.from_planet(replace(EARTH, ground=one), [550.0])
        for one in (ground, replace(ground, lights=None))
    ]
    assert len({medium.fingerprint() for medium in media}) == 1
    assert [medium.surface.lights for medium in media] == ["earth", None]


def test_a_fingerprint_outlives_the_process():
    # the same arrays in another process: what pickling gives
    medium = Medium.from_planet(EARTH, [550.0])
    assert pickle.loads(pickle.dumps(medium)).fingerprint() == medium.fingerprint()
    assert len(medium.fingerprint()) == 64


def test_own_wavelengths_are_named_or_usual_or_those_of_the_first_part():
    assert EARTH.wavelengths == (680.0, 550.0, 440.0)
    assert replace(EARTH, default_wavelengths=(600.0, 500.0)).wavelengths == (600.0, 500.0)
    narrow = PerWavelength(wavelengths=(650.0, 510.0, 475.0), values=(1e-6, 2e-6, 3e-6))
    haze = Constituent(name="haze", profile=Uniform(), absorption=narrow)
    assert replace(EARTH, constituents=(haze,)).wavelengths == (650.0, 510.0, 475.0)


def test_black_body_and_measured_sun_agree_over_the_visible():
    # Planck at 5772 K against ASTM G-173: the solar constant is shared, but the real sun has
    # moved 6 % of this band's light there from the ultraviolet, which its lines absorb
    hot = Star(temperature=5772.0, radius=SOLAR_RADIUS, distance=ASTRONOMICAL_UNIT)
    nm = np.arange(400.0, 700.0)
    measured = Star(spectrum="astm-g173").irradiances(nm).mean()
    assert_allclose(hot.irradiances(nm).mean(), measured, rtol=0.07)
    assert_allclose(hot.angular_radius_degrees, 0.2665, rtol=0, atol=5e-5)


def test_sunlight_falls_with_the_square_of_the_distance():
    near, far = (Star(spectrum="astm-g173", distance=k * ASTRONOMICAL_UNIT) for k in (1, 2))
    assert_allclose(near.irradiances([550.0]) / far.irradiances([550.0]), 4.0, rtol=1e-12)
    assert_allclose(near.angular_radius_degrees / far.angular_radius_degrees, 2.0, rtol=1e-4)


def test_phase_table_holds_the_phase_functions_on_its_grid():
    medium = Medium.from_planet(load_planet("earth-atmosphere-plus"), [680.0, 440.0])
    assert medium.phase_table.shape == (3, 2, 4097)
    u = np.linspace(0.0, 1.0, 4097)
    assert_allclose(
        medium.phase_table, np.moveaxis(medium.phase_function(1.0 - 2.0 * u * u), 0, -1), rtol=0
    )
    # its own integral, 2π ∫ p 4u du, by Simpson's rule
    from scipy.integrate import simpson

    integrals = simpson(2.0 * np.pi * 4.0 * u * medium.phase_table, x=u)
    assert_allclose(integrals, [[1.0, 1.0], [1.0, 1.0], [0.0, 0.0]], rtol=0, atol=1e-9)
    assert not medium.phase_table.flags.writeable
