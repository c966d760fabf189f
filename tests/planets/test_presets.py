"""The planets that ship: each is what its sources say, each number is cited."""

from __future__ import annotations

import re
from importlib import resources

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import Medium, load_planet, planet_names

NM = (680.0, 550.0, 440.0)


def medium_of(name, wavelengths=NM):
    return Medium.from_planet(load_planet(name), wavelengths)


def test_all_presets_of_the_plan_are_there():
    assert set(planet_names()) >= {
        "earth",
        "earth-atmosphere-plus",
        "earth-atmosphere-plus-literal",
        "earth-atmosphere-plus-2025",
        "earth-bruneton",
        "earth-openspace",
        "earth-openspace-advanced",
        "earth-openspace-dense",
        "earth-openspace-depolarisation",
        "earth-openspace-dust",
        "earth-openspace-refractive",
        "mars",
        "mars-openspace",
        "mars-rayleigh",
    }


@pytest.mark.parametrize("name", planet_names())
def test_every_number_of_a_preset_is_cited(name):
    # each line with a digit has a comment after it, or one on the lines just above it
    text = (resources.files("airlight.planets") / "presets" / f"{name}.toml").read_text("utf-8")
    lines = text.splitlines()
    for index, line in enumerate(lines):
        value = line.split("#")[0]
        if not re.search(r"\d", value) or value.startswith(("name", "description")):
            continue
        near = lines[max(0, index - 4) : index + 3]
        assert any("#" in other for other in near), f"{name}: {line}"


@pytest.mark.parametrize("name", planet_names())
def test_presets_are_physical_at_their_own_wavelengths(name):
    planet = load_planet(name)
    medium = Medium.from_planet(planet, planet.wavelengths)
    assert np.all(medium.single_scattering_albedo <= 1.0)
    assert np.all(medium.vertical_optical_depth > 0.0)
    moments = medium.phase_moments(2)
    scatters = medium.scattering.max(axis=1) > 0.0
    assert_allclose(moments[scatters][..., 0], 1.0, rtol=0, atol=1e-12)
    assert_allclose(moments[~scatters], 0.0, rtol=0, atol=0)


@pytest.mark.parametrize("name", ["earth", "mars"])
def test_earth_and_mars_cover_the_visible(name):
    low, high = load_planet(name).wavelength_limits
    assert low <= 380.0
    assert high >= 730.0


def test_earth_is_the_reference_of_the_golden_tables():
    medium = medium_of("earth")
    # 15 °C, Peck-Reeder, Bates: half the last printed digit
    assert_allclose(1e6 * medium.scattering[0], [4.848, 11.487, 28.710], rtol=0, atol=5e-4)
    # H 8434 m
    assert_allclose(medium.columns[0], 8434.0 * (1.0 - np.exp(-1e5 / 8434.0)), rtol=1e-12)
    # ozone at 345 DU: half the last printed digit
    ozone = medium.vertical_optical_depth[2]
    assert_allclose(ozone, [0.0127, 0.0307, 0.0013], rtol=0, atol=5e-5)
    # King factor of air at 550 nm, 1.0488 (Bates 1984): γ = δ/(2-δ), g_2 = (1-γ)/(10(1+2γ))
    delta = 6.0 * 0.0488 / (3.0 + 7.0 * 1.0488)
    gamma = delta / (2.0 - delta)
    expected = 0.1 * (1.0 - gamma) / (1.0 + 2.0 * gamma)
    assert_allclose(medium.phase_moments(2)[0, 1, 2], expected, rtol=1e-4)


def test_earths_aerosol_is_opac_continental_clean():
    # Hess et al. 1998, Table 4: 0.026 /km, 0.064, 0.972, 0.709, Ångström 1.10 and 1.42
    medium = medium_of("earth", [350.0, 500.0, 550.0, 800.0])
    assert_allclose(medium.extinction[1, 2], 0.026e-3, rtol=0, atol=0.5e-6)
    assert_allclose(medium.vertical_optical_depth[1, 2], 0.064, rtol=1e-12)
    assert_allclose(medium.single_scattering_albedo[1], 0.972, rtol=1e-12)
    assert_allclose(medium.phase_moments(1)[1, :, 1], 0.709, rtol=0, atol=5e-4)
    depth = medium.vertical_optical_depth[1]
    # linear between a dozen wavelengths: 1 % of the exponent's curve
    assert_allclose(np.log(depth[0] / depth[1]) / np.log(500.0 / 350.0), 1.10, rtol=0, atol=0.02)
    assert_allclose(np.log(depth[1] / depth[3]) / np.log(800.0 / 500.0), 1.42, rtol=0, atol=0.02)


def test_atmosphere_plus_presets_differ_by_the_misprint_only():
    right, literal = medium_of("earth-atmosphere-plus"), medium_of("earth-atmosphere-plus-literal")
    assert_allclose(right.scattering, literal.scattering, rtol=0, atol=0)
    assert_allclose(right.single_scattering_albedo[1], 0.9, rtol=1e-12)
    assert_allclose(literal.extinction[1], 8.396e-6, rtol=1e-12)  # golden single scattering's
    assert right.fingerprint() != literal.fingerprint()


def test_atmosphere_plus_has_the_golden_zenith_transmittance():
    # golden columns, "ground zenith": 0.940359 0.867616 0.762310
    depth = medium_of("earth-atmosphere-plus").vertical_optical_depth.sum(axis=0)
    assert_allclose(np.exp(-depth), [0.940359, 0.867616, 0.762310], rtol=0, atol=5e-7)


def test_first_atmosphere_plus_notes_are_as_printed():
    planet = load_planet("earth-atmosphere-plus-2025")
    assert planet.wavelengths == (650.0, 510.0, 475.0)
    assert (planet.bottom_radius, planet.top_radius) == (6.371e6, 6.471e6)
    medium = Medium.from_planet(planet, planet.wavelengths)
    assert_allclose(1e6 * medium.scattering[0], [6.55, 17.3, 23.0], rtol=1e-12)
    assert_allclose(medium.extinction[1], 2e-6 / 0.9, rtol=1e-12)
    # the forward lobe is forward: 3g(4+g²)/(5(2+g²)) at g = 0.85
    assert_allclose(medium.phase_moments(1)[1, 0, 1], 2.55 * 4.7225 / (5 * 2.7225), rtol=1e-9)


def test_bruneton_is_what_the_header_of_its_radiances_says():
    medium = medium_of("earth-bruneton")
    assert (medium.bottom_radius, medium.top_radius) == (6.36e6, 6.42e6)
    assert_allclose(medium.solar_irradiance, [1.474, 1.8504, 1.91198], rtol=1e-12)
    assert_allclose(medium.scattering[0], [5.802e-6, 13.558e-6, 33.1e-6], rtol=1e-12)
    assert_allclose(medium.extinction[1], 4.44e-6, rtol=1e-12)
    assert_allclose(medium.star_angular_radius, 0.004675, rtol=1e-12)
    h = np.linspace(0.0, 60e3, 301)
    air, aerosol, ozone = medium.density.at(h)
    assert_allclose(air, np.exp(-h / 8e3), rtol=1e-12)
    assert_allclose(aerosol, np.exp(-0.833333e-3 * h), rtol=1e-12)
    assert_allclose(ozone, np.maximum(0.0, 1.0 - np.abs(h - 25e3) / 15e3), rtol=0, atol=1e-12)


def test_openspace_is_table_1_put_right():
    medium = medium_of("earth-openspace")
    assert_allclose(1e6 * medium.scattering[0], [5.1771, 12.2590, 30.5967], rtol=1e-12)
    assert_allclose(medium.single_scattering_albedo[1], 0.9, rtol=1e-12)
    assert_allclose(medium.absorption[1], 0.1 * 4.0e-5 / 0.9, rtol=1e-12)
    # Penndorf at ν = 0: 0.7629/4π
    assert_allclose(4 * np.pi * medium.phase_function(0.0)[0, 0], 0.7629, rtol=0, atol=5e-5)


def test_mars_has_the_dust_of_the_golden_check():
    # gamma(1.6 µm, 0.3), exact Mie: ⟨Q⟩ 2.440, 2.370, 2.310; albedo .970, .839, .702;
    # g .718, .774, .834
    medium = medium_of("mars")
    dust = medium.vertical_optical_depth[1]
    assert_allclose(dust[1], 0.5, rtol=1e-12)
    assert_allclose(dust / dust[1], np.array([2.440, 2.370, 2.310]) / 2.370, rtol=0, atol=2e-4)
    assert_allclose(medium.single_scattering_albedo[1], [0.970, 0.839, 0.702], rtol=1e-12)
    assert_allclose(medium.phase_moments(1)[1, :, 1], [0.718, 0.774, 0.834], rtol=0, atol=1e-9)
    # Rayleigh on Mars: (0.1023, 0.2429, 0.6081)e-6 with δ = 0.09, 2 % less with Alms's King factor
    assert_allclose(1e6 * medium.scattering[0], [0.1023, 0.2429, 0.6081], rtol=0.025)
    # sunlight at 1.524 au, and a ground that reddens
    sun = medium_of("earth").solar_irradiance
    assert_allclose(medium.solar_irradiance, sun / 1.524**2, rtol=1e-12)
    assert_allclose(np.degrees(medium.star_angular_radius), 0.2665 / 1.524, rtol=2e-4)
    assert np.all(np.diff(medium.ground_albedo) < 0.0)
