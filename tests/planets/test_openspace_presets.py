"""The presets after the OpenSpace paper: Table 1 put right, and the variations of its Fig 1."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import Medium, load_planet, replace
from airlight.planets.comparison import compare

NM = (680.0, 550.0, 440.0)
ADVANCED = "earth-openspace-advanced"
VARIATIONS = (
    "earth-openspace-dust",
    "earth-openspace-depolarisation",
    "earth-openspace-refractive",
    "earth-openspace-dense",
)


def medium_of(name):
    return Medium.from_planet(load_planet(name), NM)


def test_advanced_air_is_table_1_with_n_and_n_of_one_state():
    medium, planet = medium_of(ADVANCED), load_planet(ADVANCED)
    gas = planet.constituents[0].matter
    # Table 1 prints N = 2.68731e19 cm⁻³, 0.02 % above today's constant, and H_R = 7.99575 km
    assert_allclose(gas.number_density, 2.68731e25, rtol=3e-4)
    assert_allclose(planet.constituents[0].profile.scale_height, 7995.75, rtol=0, atol=1.0)
    # the standard mode's 5.1768, 12.2588, 30.5964 with f(0.0279)/f(0.035) for its depolarisation;
    # the digits of n leave 2e-4
    king = [(6 + 3 * d) / (6 - 7 * d) for d in (0.0279, 0.035)]
    expected = np.array([5.1768, 12.2588, 30.5964]) * king[0] / king[1]
    assert_allclose(1e6 * medium.scattering[0], expected, rtol=4e-4)
    # OS Eq 11 by hand at 550 nm with n of 0 °C, n - 1 = 2.7783e-4 · 288.15/273.15
    n = 1.0 + 2.7783e-4 * 288.15 / 273.15
    beta = 8 * np.pi**3 * (n**2 - 1) ** 2 / (3 * 2.68678e25 * 550e-9**4) * king[0]
    # the limit n → 1: 4e-4 above
    assert_allclose(medium.scattering[0, 1], beta, rtol=6e-4)


def test_advanced_haze_is_eq_17_at_turbidity_2():
    # 1.064e-4 /m at 550 nm: half the last digit; the albedo of the standard mode
    medium = medium_of(ADVANCED)
    assert_allclose(medium.scattering[1, 1], 1.064e-4, rtol=0, atol=5e-8)
    assert_allclose(medium.single_scattering_albedo[1], 0.9, rtol=1e-5)
    # g₁ = 0.85 with all the weight: plain Henyey-Greenstein
    assert_allclose(medium.phase_moments(2)[1, :, 1:], [[0.85, 0.7225]] * 3, rtol=1e-9)
    # ozone of 345 DU: 0.0127, 0.0307, 0.0013
    depth = medium.vertical_optical_depth
    assert_allclose(depth[2], [0.0127, 0.0307, 0.0013], rtol=0, atol=5e-5)
    # the standard mode is the same Earth: its gas within 1.5 % of optical depth
    assert_allclose(depth[0], medium_of("earth-openspace").vertical_optical_depth[0], rtol=0.015)


@pytest.mark.parametrize(
    ("name", "constituent", "factors"),
    [
        # six times the particles: six times the optical depth of the haze
        ("earth-openspace-dust", 1, (6.0, 6.0, 6.0)),
        # f(δ) = (6+3δ)/(6-7δ): 3 at 0.5, 1.0481 at 0.0279
        ("earth-openspace-depolarisation", 0, (3.0 / (6.0837 / 5.8047),) * 3),
        # (n-1)²: a quarter at 680 nm, nothing elsewhere
        ("earth-openspace-refractive", 0, (0.25, 1.0, 1.0)),
        # twice the molecules
        ("earth-openspace-dense", 0, (2.0, 2.0, 2.0)),
    ],
)
def test_each_variation_of_fig_1_changes_one_optical_depth_by_its_law(name, constituent, factors):
    before, after = medium_of(ADVANCED), medium_of(name)
    ratio = after.vertical_optical_depth / before.vertical_optical_depth
    # n² - 1 is not quite 2(n - 1), absorption is written in six digits: 2e-4
    assert_allclose(ratio[constituent], factors, rtol=2e-4)
    others = [i for i in range(3) if i != constituent]
    assert_allclose(ratio[others], 1.0, rtol=1e-12)
    assert_allclose(after.columns, before.columns, rtol=1e-5)


@pytest.mark.parametrize("name", VARIATIONS)
def test_a_variation_differs_from_its_earth_in_one_constituent_only(name):
    first, second = load_planet(ADVANCED), load_planet(name)
    parts = {row.part for row in compare(first, second)}
    assert parts in ({"air", "all"}, {"aerosol", "all"})
    same = replace(second, name=first.name, description=first.description)
    assert sum(a != b for a, b in zip(first.constituents, same.constituents, strict=True)) == 1


def test_depolarisation_is_held_where_rods_are():
    # 20 x 0.0279 = 0.558; γ = δ/(2-δ) = 1/3: p ∝ (1+3γ) + (1-γ)ν² = 2 + 2ν²/3
    medium = medium_of("earth-openspace-depolarisation")
    ratio = medium.phase_function(1.0)[0] / medium.phase_function(0.0)[0]
    assert_allclose(ratio, 4.0 / 3.0, rtol=1e-12)


def test_mars_of_the_paper_is_table_1_put_right():
    medium, planet = medium_of("mars-openspace"), load_planet("mars-openspace")
    # carbon dioxide at 2.8e23 m⁻³: half the last digit of 0.1397, 0.3317, 0.8304
    assert_allclose(1e6 * medium.scattering[0], [0.1397, 0.3317, 0.8304], rtol=0, atol=5e-5)
    # H ≈ 11 km = RT/(Mg)
    assert_allclose(planet.constituents[0].profile.scale_height, 11e3, rtol=0.02)
    # dust by anomalous diffraction: Q_ext 1.949, 1.977, 2.098, albedo .980, .874, .748
    dust = medium.vertical_optical_depth[1]
    assert_allclose(dust / dust[1] * 1.977, [1.949, 1.977, 2.098], rtol=0, atol=1e-3)
    assert_allclose(medium.single_scattering_albedo[1], [0.980, 0.874, 0.748], rtol=0, atol=5e-4)
    # OpenSpace's own extinction, 53.61771e-3/0.98979 per km, at 550 nm
    assert_allclose(medium.extinction[1, 1], 53.61771e-6 / 0.98979, rtol=1e-4)
    # two lobes: 0.743 · 0.889 + 0.257 · 0.094
    assert_allclose(medium.phase_moments(1)[1, :, 1], 0.743 * 0.889 + 0.257 * 0.094, rtol=1e-9)
    assert_allclose(medium.phase_moments(1)[..., 0], 1.0, rtol=1e-12)


def test_mars_without_dust_is_carbon_dioxide_alone():
    planet, medium = load_planet("mars-rayleigh"), medium_of("mars-rayleigh")
    assert [one.name for one in planet.constituents] == ["carbon dioxide"]
    # 610 Pa, 215 K: 2.05e23 m⁻³
    assert_allclose(planet.constituents[0].matter.number_density, 2.05e23, rtol=0, atol=5e20)
    # 0.1023, 0.2429, 0.6081 with δ = 0.09; the measured King factor is 1 to 2 % less
    golden = np.array([0.1023, 0.2429, 0.6081])
    assert_allclose(1e6 * medium.scattering[0], golden, rtol=0.025)
    assert np.all(1e6 * medium.scattering[0] < golden)
    # λ⁻⁴ and the dispersion of the gas: blue stronger by a factor of 5.98 than red
    ratio = medium.scattering[0, 2] / medium.scattering[0, 0]
    assert_allclose(ratio, golden[2] / golden[0], rtol=0.01)


@pytest.mark.parametrize(
    ("name", "part", "cited"),
    [
        ("earth-openspace", "air", 12.2588e-6 * 7995.75),  # OS Table 1
        ("earth-openspace", "aerosol", 4.0e-5 / 0.9 * 1200.0),  # OS Table 1
        (ADVANCED, "ozone", 0.0307),  # 345 DU at 550 nm
        (ADVANCED, "aerosol", 1.064e-4 / 0.9 * 1200.0),  # OS Eq 17 at T = 2
        ("earth-openspace-dust", "aerosol", 6.0 * 1.064e-4 / 0.9 * 1200.0),  # OS Fig 1
        ("mars-openspace", "carbon dioxide", 0.3317e-6 * 10.9e3),  # OS Table 1 put right
        ("mars-openspace", "dust", 53.61771e-6 / 0.98979 * 11.1e3),  # OpenSpace's own
        ("mars-rayleigh", "carbon dioxide", 0.2429e-6 * 10.9e3),
    ],
)
def test_optical_depths_at_550_nm_are_those_cited(name, part, cited):
    medium = medium_of(name)
    depth = medium.vertical_optical_depth[medium.names.index(part), 1]
    print(f"{name:28s} {part:16s} {depth:.5f}, cited {cited:.5f}")
    # King factors and shells of finite height: 2.5 %
    assert_allclose(depth, cited, rtol=0.025)


def test_the_page_of_these_presets_prints_their_optical_depths():
    # docs/presets-openspace.md: every number of the column "here" to its last digit
    page = Path(__file__).parents[2] / "docs" / "presets-openspace.md"
    rows = re.findall(
        r"^\| `([\w-]+)` \| ([\w ]+?)(?: at (\d+) nm)? \| ([\d.]+) \|",
        page.read_text(encoding="utf-8"),
        flags=re.M,
    )
    assert len(rows) == 12
    for name, part, nm, printed in rows:
        planet = load_planet(name)
        medium = Medium.from_planet(planet, [float(nm or 550)])
        depth = medium.vertical_optical_depth[medium.names.index(part), 0]
        digits = len(printed.partition(".")[2])
        assert_allclose(depth, float(printed), rtol=0, atol=0.5001 * 10.0**-digits, err_msg=name)
