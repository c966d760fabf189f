"""Gases by composition and absorbers in planet files."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import AirlightError, FileError
from airlight.planets import Medium, load_planet
from airlight.planets.reading.reader import read_planet

NM = (680.0, 550.0, 440.0)


def medium_of(text):
    return Medium.from_planet(read_planet(text, "test.toml"), NM)


def test_a_file_by_composition_means_what_it_says(composed):
    # air: the golden reference Earth within 0.3 %, exponential with RT/(Mg) = 8434 m; ozone: the
    # golden optical depths at 345 DU; oxygen: 2.547e25 · 0.2095 · 1e-29 m² and so on
    medium = medium_of(composed)
    assert_allclose(1e6 * medium.scattering[0], [4.848, 11.487, 28.710], rtol=3e-3)
    assert_allclose(medium.columns[0], 8434.0, rtol=1e-4)
    assert_allclose(medium.vertical_optical_depth[1], [0.0127, 0.0307, 0.0013], rtol=0, atol=5e-5)
    expected = 2.547e25 * 0.2095 * np.array([1e-29, 2e-29, 3e-29])
    assert_allclose(medium.absorption[2], expected, rtol=1e-12)
    assert np.all(medium.absorption[3] > 0.0)
    assert_allclose(medium.scattering[1:], 0.0, rtol=0, atol=0)


def test_a_gas_takes_a_profile_an_absorption_and_a_phase_function(composed):
    # with a profile no gravity is needed; 1e-6 /m comes on top; Rayleigh with δ = 0 has a second
    # moment of 1/10
    text = composed.replace(', gravity = "9.80665 m/s^2"', "").replace(
        'name = "air"',
        'name = "air"\nprofile = { kind = "uniform" }\nabsorption = "1e-6 /m"\n'
        'phase_function = { kind = "rayleigh" }',
    )
    medium = medium_of(text)
    assert_allclose(medium.columns[0], 1e5, rtol=1e-12)
    assert_allclose(medium.absorption[0], 1e-6, rtol=1e-12)
    assert_allclose(medium.phase_moments(2)[0, :, 2], 0.1, rtol=1e-6)


def test_the_state_may_be_a_number_density(composed):
    # p/(k T) by hand
    density = 101_325.0 / (1.380649e-23 * 288.15)
    text = composed.replace('pressure = "101325 Pa"', f'number_density = "{density!r} /m^3"')
    assert_allclose(medium_of(text).scattering[0], medium_of(composed).scattering[0], rtol=1e-12)


def test_lists_of_a_gas_belong_to_the_wavelengths_of_the_constituent(composed):
    # δ = 0.035 is F = 1.0608: against the composition's own 1.0461, 1.0469, 1.0483
    text = composed.replace(
        "gas = {", 'wavelengths = "680, 550, 440 nm"\ngas = { depolarisation = [0.035, 0.035, 0.0],'
    )
    ratio = medium_of(text).scattering[0] / medium_of(composed).scattering[0]
    assert_allclose(ratio, [1.0608 / 1.0461, 1.0608 / 1.0469, 1.0 / 1.0483], rtol=1e-4)


TABLE = """# quantity: absorption cross-section
# unit: cm^2
# source: made up for this test
wavelength_nm,cross_section
400,1e-25
600,2e-25
700,3e-25
"""


def test_a_table_beside_the_planet_file_is_read(composed, tmp_path):
    # power laws between rows, in cm², with exponents ln 1.5 / ln(7/6) and ln 2 / ln 1.5
    text = composed.replace('"ozone-293k"', '"tables/own.csv"')
    (tmp_path / "tables").mkdir()
    (tmp_path / "tables" / "own.csv").write_text(TABLE)
    (tmp_path / "planet.toml").write_text(text)
    planet = load_planet(tmp_path / "planet.toml")
    depth = Medium.from_planet(planet, NM).vertical_optical_depth[1]
    steep, flat = np.log(1.5) / np.log(7.0 / 6.0), np.log(2.0) / np.log(1.5)
    sigma = 1e-29 * np.array([2.0 * (680 / 600) ** steep, (550 / 400) ** flat, (440 / 400) ** flat])
    assert_allclose(depth, 345.0 * 2.686780111e20 * sigma, rtol=1e-8)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (None, "cannot be read: No such file"),
        ("", "has no header"),
        (TABLE.replace("# unit: cm^2\n", ""), "no line '# unit"),
        (TABLE.replace("# source: made up for this test\n", ""), "no line '# source"),
        (TABLE.replace("2e-25", "much"), "is 'much'; allowed: a finite number"),
        (TABLE.replace("2e-25", "nan"), "is 'nan'; allowed: a finite number"),
        (TABLE.replace("600,", "800,"), "do not ascend"),
        (TABLE.replace("cm^2", "m"), "unit of"),
        (TABLE.replace("e-25", "e-25,1"), "3 cells"),
        ("\xff", "is not UTF-8 text"),
        ("x" * 4_000_001, "is too large"),
    ],
)
def test_tables_that_are_none_give_one_line(composed, tmp_path, content, reason):
    text = composed.replace('"ozone-293k"', '"own.csv"')
    if content is not None:
        (tmp_path / "own.csv").write_bytes(content.encode("latin-1"))
    (tmp_path / "planet.toml").write_text(text)
    with pytest.raises(AirlightError) as caught:
        load_planet(tmp_path / "planet.toml")
    assert reason in str(caught.value)
    assert "\n" not in str(caught.value)


def test_folders_and_names_that_are_none_give_one_line(composed):
    for name in ("/.csv", "a\\u0000b.csv", "x" * 300 + ".csv"):
        with pytest.raises(FileError):
            read_planet(composed.replace("ozone-293k", name), "test.toml")


WRONG = [
    # old text, new text, field named, something of the allowed range
    ("N2 = ", "N3 = ", "constituents[0].gas.composition is 'N3'", "NH3"),
    ("N2 = 0.78084", "N2 = 0.5", "constituents[0].gas.composition", "1 within 1 %"),
    ("N2 = 0.78084", "N2 = -0.78084", "constituents[0].gas.composition.N2", "0 to 1"),
    ("N2 = 0.78084", 'N2 = "some"', "constituents[0].gas.composition.N2", "number"),
    ('"288.15 K"', '"288.15 m"', "constituents[0].gas.temperature", "'K'"),
    ('"288.15 K"', '"0 K"', "constituents[0].gas.temperature", "1 to"),
    ('pressure = "101325 Pa", ', "", "constituents[0].gas.number_density is missing", "pressure"),
    (
        'pressure = "101325 Pa"',
        'number_density = "1 /m^3"',
        "constituents[0].gas.number_density",
        "1e+10 to",
    ),
    (', gravity = "9.80665 m/s^2"', "", "constituents[0].gas.gravity is required", "scale height"),
    ("gravity", "gravty", "constituents[0].gas is 'gravty'", "'gravity'?"),
    (
        "gas = {",
        "gas = { depolarisation = 0.7,",
        "constituents[0].gas.depolarisation",
        "linear mol",
    ),
    (
        "gas = {",
        'scattering = "1e-6 /m"\ngas = {',
        "constituents[0].scattering",
        "combined with gas",
    ),
    ('"ozone-293k"', '"ozone-193k"', "constituents[1].absorption.cross_section", "'ozone-293k'?"),
    ('"ozone-293k"', '"astm-g173"', "constituents[1].absorption.cross_section", "ozone-293k"),
    ('"ozone-293k"', '"1e-25 m"', "constituents[1].absorption.cross_section", "'m^2'"),
    (', column = "345 DU"', "", "constituents[1].absorption.column is missing", "number_density"),
    ('"345 DU"', '"345 kg"', "constituents[1].absorption.column", "'1/m^2'"),
    ("cross_section = [", "cross_sektion = [", "constituents[2].absorption", "cross_section"),
    ("fraction = 0.2095", "fraction = 2", "constituents[2].absorption.fraction", "0 to 1"),
    ("imaginary = 0.44", "imaginary = -1", "small_particles.imaginary", "0 to 20"),
    ('radius = "10 nm"', 'radius = "1 um"', "wavelengths", "common wavelength"),
]


@pytest.mark.parametrize(("old", "new", "field", "allowed"), WRONG)
def test_every_mistake_is_one_line_with_field_and_allowed_range(composed, old, new, field, allowed):
    assert composed.count(old) >= 1
    with pytest.raises(AirlightError) as caught:
        medium_of(composed.replace(old, new, 1))
    line = str(caught.value)
    assert field in line
    assert allowed in line
    assert "\n" not in line
