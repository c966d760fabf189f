"""Planets of the package: each agrees with its sources, each number is cited."""

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
        "early-earth",
        "earth",
        "earth-hazy",
        "earth-volcanic",
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
        "exoplanet",
        "jupiter",
        "mars",
        "mars-openspace",
        "mars-rayleigh",
        "mars-standard",
        "mercury",
        "moon",
        "neptune",
        "pluto",
        "saturn",
        "titan",
        "triton",
        "uranus",
        "venus",
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


COLORED = ("early-earth", "earth", "earth-hazy", "earth-volcanic")
COLORED += ("exoplanet", "mars", "titan", "venus")
COLORED += ("jupiter", "mercury", "moon", "neptune", "pluto", "saturn", "triton", "uranus")


@pytest.mark.parametrize("name", COLORED)
def test_planets_of_their_own_cover_the_visible(name):
    low, high = load_planet(name).wavelength_limits
    assert low <= 380.0
    assert high >= 730.0


def test_earth_is_the_reference_of_the_golden_tables():
    medium = medium_of("earth")
    # 15 °C, Peck-Reeder, Bates: measured air; the preset is composed of its gases, each measured
    # elsewhere, which agree with it to 0.2 %
    assert_allclose(1e6 * medium.scattering[0], [4.848, 11.487, 28.710], rtol=2e-3)
    # 8454.0 m: U.S. 1976's density over that at the ground, by trapezoids of 0.25 m
    assert_allclose(medium.columns[0], 8454.0, rtol=5e-5)
    # ozone at 345 DU: the golden 0.0127, 0.0307, 0.0013 at 293 K times the measured ratios of
    # 223 K, of the 1 nm means of doi:10.5281/zenodo.5793207
    ozone = medium.vertical_optical_depth[2]
    cold = np.array([0.0127, 0.0307, 0.0013]) * [0.9642, 0.9950, 0.9728]
    assert_allclose(ozone, cold, rtol=0, atol=1e-4)
    # King factor of air at 550 nm, 1.0488 (Bates 1984): γ = δ/(2-δ), g_2 = (1-γ)/(10(1+2γ)). Bates
    # weights the gases by their number; by what they scatter it is 1.0469, and g_2 0.2 % more
    delta = 6.0 * 0.0488 / (3.0 + 7.0 * 1.0488)
    gamma = delta / (2.0 - delta)
    expected = 0.1 * (1.0 - gamma) / (1.0 + 2.0 * gamma)
    assert_allclose(medium.phase_moments(2)[0, 1, 2], expected, rtol=3e-3)


def test_earths_aerosol_is_opac_continental_clean():
    # Hess et al. 1998, Table 4: 0.026 /km, 0.064, 0.972, 0.709, Ångström 1.10 and 1.42
    medium = medium_of("earth", [350.0, 500.0, 550.0, 800.0])
    assert_allclose(medium.extinction[1, 2], 0.026e-3, rtol=0, atol=0.5e-6)
    assert_allclose(medium.vertical_optical_depth[1, 2], 0.064, rtol=1e-12)
    assert_allclose(medium.single_scattering_albedo[1], 0.972, rtol=1e-12)
    assert_allclose(medium.phase_moments(1)[1, :, 1], 0.709, rtol=0, atol=5e-4)
    depth = medium.vertical_optical_depth[1]
    # the list's digits
    assert_allclose(np.log(depth[0] / depth[1]) / np.log(500.0 / 350.0), 1.10, rtol=0, atol=3e-3)
    assert_allclose(np.log(depth[1] / depth[3]) / np.log(800.0 / 500.0), 1.42, rtol=0, atol=3e-3)


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


def test_mars_has_the_dust_of_its_orbiters_and_of_exact_mie():
    # Wolff et al. (2009): albedo 0.973, 0.967, 0.888, 0.777 at 680, 650, 550 and 440 nm, for grains
    # of 1.5 µm, by T-matrix; half of one hundredth for the spheres of 1.6 µm and as much for what
    # was read between two wavelengths of a table
    medium = medium_of("mars", [680.0, 650.0, 550.0, 440.0])
    albedo = medium.single_scattering_albedo[1]
    assert_allclose(albedo, [0.9731, 0.9669, 0.8879, 0.7768], rtol=0, atol=0.01)
    # gamma(1.6 µm, 0.3), exact Mie with 1.52 + ik, k = .001, .006, .013: ⟨Q⟩ 2.440, 2.370, 2.310;
    # g .718, .774, .834. What is absorbed moves extinction by 0.3 %, and less absorption leaves
    # more light that has passed through the grains, aside
    medium = medium_of("mars")
    dust = medium.vertical_optical_depth[1]
    assert_allclose(dust[1], 0.5, rtol=1e-12)
    assert_allclose(dust / dust[1], np.array([2.440, 2.370, 2.310]) / 2.370, rtol=3e-3)
    cosines = medium.phase_moments(1)[1, :, 1]
    assert_allclose(cosines[0], 0.718, rtol=0, atol=0.005)
    assert np.all(cosines[1:] < [0.774, 0.834])
    assert np.all(np.diff(cosines) > 0.0)
    # Rayleigh on Mars: (0.1023, 0.2429, 0.6081)e-6 of pure CO₂ with δ = 0.09; 2 % less with Alms's
    # King factor, 3 % less with 5 % of lighter molecules that scatter 0.4 times as much
    assert_allclose(1e6 * medium.scattering[0], [0.1023, 0.2429, 0.6081], rtol=0.055)
    # sunlight at 1.524 au, and a ground that reddens
    sun = medium_of("earth").solar_irradiance
    assert_allclose(medium.solar_irradiance, sun / 1.524**2, rtol=1e-12)
    assert_allclose(np.degrees(medium.star_angular_radius), 0.2665 / 1.524, rtol=2e-4)
    assert np.all(np.diff(medium.ground_albedo) < 0.0)


def test_mars_by_coefficients_has_the_printed_optics_of_dust():
    # gamma(1.6 µm, 0.3), exact Mie: ⟨Q⟩ 2.440, 2.370, 2.310; albedo .970, .839, .702;
    # g .718, .774, .834: the file's lists, and half the last printed digit of a ratio
    medium = medium_of("mars-standard")
    dust = medium.vertical_optical_depth[1]
    assert_allclose(dust / dust[1], np.array([2.440, 2.370, 2.310]) / 2.370, rtol=0, atol=2e-4)
    assert_allclose(medium.single_scattering_albedo[1], [0.970, 0.839, 0.702], rtol=1e-12)
    assert_allclose(medium.phase_moments(1)[1, :, 1], [0.718, 0.774, 0.834], rtol=0, atol=1e-9)
    # Rayleigh on Mars: (0.1023, 0.2429, 0.6081)e-6 with δ = 0.09, 2 % less with Alms's King factor
    assert_allclose(1e6 * medium.scattering[0], [0.1023, 0.2429, 0.6081], rtol=0.025)


@pytest.mark.slow
def test_hazy_earth_has_the_optics_of_opac():
    # Hess et al. 1998, Table 4, continental polluted: 0.175 /km, 0.892, 0.698, Ångström 1.13 and
    # 1.45; OPAC 3.1 prints 0.1746, 0.8925, 0.6977. Half the last printed digit
    medium = medium_of("earth-hazy", [350.0, 500.0, 550.0, 800.0])
    chosen = [medium.names.index(name) for name in ("water-soluble", "insoluble", "soot")]
    extinction = medium.extinction[chosen]
    scattering = medium.scattering[chosen]
    cosines = medium.phase_moments(1)[chosen, :, 1]
    total = extinction.sum(axis=0)
    assert_allclose(total[2], 0.1746e-3, rtol=0, atol=0.0005e-3)
    assert_allclose(scattering.sum(axis=0)[2] / total[2], 0.8925, rtol=0, atol=5e-4)
    mean = (scattering * cosines).sum(axis=0) / scattering.sum(axis=0)
    assert_allclose(mean[2], 0.6977, rtol=0, atol=5e-4)
    assert_allclose(np.log(total[0] / total[1]) / np.log(500.0 / 350.0), 1.13, rtol=0, atol=5e-3)
    assert_allclose(np.log(total[1] / total[3]) / np.log(800.0 / 500.0), 1.45, rtol=0, atol=5e-3)


def test_hazy_earth_has_the_stratosphere_of_earth():
    hazy, clean = load_planet("earth-hazy"), load_planet("earth")
    assert hazy.constituents[-1] == clean.constituents[-1]
    assert hazy.constituents[-1].name == "stratospheric aerosol"


def test_pinatubos_droplets_dim_all_colours_alike():
    # Russell et al. 1996: effective radii of 0.5 µm make the optical depth flat from 0.4 to 0.7 µm
    medium = medium_of("earth-volcanic", [400.0, 550.0, 700.0])
    acid = medium.names.index("sulphuric acid")
    assert_allclose(medium.vertical_optical_depth[acid], 0.15, rtol=0.1)
    assert_allclose(medium.single_scattering_albedo[acid], 1.0, rtol=0, atol=1e-4)


def test_the_young_sun_had_four_fifths_of_todays_light():
    # Gough 1981: 1/(1 + 0.4·2.7/4.57) = 0.809; the file's 1.111 au make 0.810
    young = medium_of("early-earth").solar_irradiance / medium_of("earth").solar_irradiance
    assert_allclose(young, 1.0 / (1.0 + 0.4 * 2.7 / 4.57), rtol=2e-3)


def test_trappist_1e_gets_two_thirds_of_earths_light_and_hardly_any_blue():
    # Agol et al. 2021: 0.646 of the solar constant, all wavelengths together; σT⁴(R/d)²
    planet = load_planet("exoplanet")
    star = planet.star
    total = 5.670374e-8 * star.temperature**4 * (star.radius / star.distance) ** 2
    assert_allclose(total / 1361.0, 0.646, rtol=0.01)
    medium = medium_of("exoplanet")
    blue_to_red = medium.solar_irradiance[2] / medium.solar_irradiance[0]
    # Wien: exp(-c₂/T·(1/440 nm - 1/680 nm)) times (680/440)⁵, with c₂ 0.014388 m K
    wien = np.exp(-0.014388 / 2566.0 * (1.0 / 440e-9 - 1.0 / 680e-9)) * (680.0 / 440.0) ** 5
    assert_allclose(blue_to_red, wien, rtol=1e-3)


def test_titans_haze_is_the_probes():
    # Tomasko et al. 2008, Table 2 at 491 and 600 nm; laws of the optical depth at 550 nm
    medium = medium_of("titan", [491.0, 550.0, 600.0])
    haze = slice(1, 4)
    expected = [1.012e7 * 550**-2.339, 2.029e4 * 550**-1.409, 6.270e2 * 550**-0.9706]
    # 1 %: straight lines between seven wavelengths
    assert_allclose(medium.vertical_optical_depth[haze, 1], expected, rtol=0.01)
    albedo = medium.single_scattering_albedo[haze]
    assert_allclose(albedo[:, 0], [0.8700, 0.9450, 0.9752], rtol=0, atol=5e-5)
    assert_allclose(albedo[:, 2], [0.9195, 0.9813, 0.9750], rtol=0, atol=5e-5)
    # law: the layers follow each other without gap, and without a step of more than a third
    above, between, below = (medium.extinction[i, 1] for i in (1, 2, 3))
    assert_allclose([above / between, between / below], 1.0, rtol=0, atol=1.0 / 3.0)
    assert_allclose(medium.density.at([29e3, 31e3, 79e3, 81e3])[haze].sum(axis=0), 1.0, rtol=0.02)


def test_titans_detached_haze_is_cassinis():
    # Seignovert et al. (2021), limb of image N1551888681 at 338 nm, optically thin: light goes with
    # the haze along the ray, I/F 0.0137 at 499 km, 0.0082 at 464 km, 0.0151 at 444 km. And the top
    # of the shell is no edge.
    medium = medium_of("titan", [355.0])

    def along(altitude):
        lowest = medium.bottom_radius + 1e3 * altitude
        s = np.linspace(0.0, np.sqrt(medium.top_radius**2 - lowest**2), 20001)
        density = medium.density.at(np.hypot(lowest, s) - medium.bottom_radius)[1]
        return 2.0 * medium.extinction[1, 0] * np.trapezoid(density, s)

    layer, gap, below, top = (along(altitude) for altitude in (499.0, 464.0, 444.0, 590.0))
    # a fifth is the images' spread around the limb
    assert_allclose([layer / gap, below / layer], [0.0137 / 0.0082, 0.0151 / 0.0137], rtol=0.2)
    assert top < 1e-3
