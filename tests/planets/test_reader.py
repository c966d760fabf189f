"""Planet files: their meaning, and one clear line for every error in them."""

from __future__ import annotations

import copy
import os
import re
import tomllib

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import AirlightError, FileError, ParameterError
from airlight.planets import Medium, load_planet, replace
from airlight.planets.reading.reader import read_planet, read_tables

NM = (680.0, 550.0, 440.0)
AIR = """wavelengths = "680, 550, 440 nm"
scattering = ["5.802e-6 /m", "13.558e-6 /m", "33.1e-6 /m"]"""


def medium_of(text, wavelengths=NM):
    return Medium.from_planet(read_planet(text, "test.toml"), wavelengths)


def replaced(text, old, new):
    assert text.count(old) >= 1
    return text.replace(old, new, 1)


def degrees(angles):
    """Angles as a list of a planet file. [deg]"""
    return [f"{angle} deg" for angle in angles.tolist()]


def test_the_file_of_the_format_means_what_it_says(good):
    # every number as it stands in the text, converted by hand
    medium = medium_of(good)
    assert (medium.bottom_radius, medium.top_radius) == (6.36e6, 6.46e6)
    assert medium.names == ("air", "aerosol", "ozone")
    assert_allclose(medium.scattering[0], [5.802e-6, 13.558e-6, 33.1e-6], rtol=1e-12)
    assert_allclose(medium.scattering[1], 3.996e-6, rtol=1e-12)
    assert_allclose(medium.absorption[1], 0.444e-6, rtol=1e-12)
    assert_allclose(medium.absorption[2], [0.65e-6, 1.881e-6, 0.085e-6], rtol=1e-12)
    assert_allclose(medium.ground_albedo, 0.1, rtol=0, atol=0)
    assert_allclose(medium.solar_irradiance, 1.0, rtol=0, atol=0)
    assert_allclose(np.degrees(medium.star_angular_radius), 0.2678, rtol=1e-12)
    assert_allclose(medium.density.columns, [7999.9702, 1200.0, 15000.0], rtol=0, atol=5e-5)


def test_units_may_be_any_of_their_kind(good):
    other = good.replace('"6360 km"', '"6360000 m"').replace('"8 km"', '"8000 m"')
    other = other.replace('"5.802e-6 /m"', '"5.802e-3 /km"').replace(
        '"0.2678 deg"', f'"{np.radians(0.2678)!r} rad"'.replace("np.float64(", "").replace(")", "")
    )
    first, second = medium_of(good), medium_of(other)
    assert_allclose(second.scattering, first.scattering, rtol=1e-12)
    assert_allclose(second.star_angular_radius, first.star_angular_radius, rtol=1e-12)


@pytest.mark.parametrize(
    "given",
    [
        'extinction = "4.44e-6 /m"\nscattering = "3.996e-6 /m"',
        'extinction = "4.44e-6 /m"\nsingle_scattering_albedo = 0.9',
        'scattering = "3.996e-6 /m"\nsingle_scattering_albedo = 0.9',
        "optical_depth = 0.005328\nsingle_scattering_albedo = 0.9",
    ],
)
def test_the_same_aerosol_can_be_given_in_five_ways(good, given):
    # 4.44e-6 · 0.9 = 3.996e-6; 4.44e-6 /m · 1200 m = 0.005328
    text = good.replace('scattering = "3.996e-6 /m"\nabsorption = "0.444e-6 /m"', given)
    medium = medium_of(text)
    assert_allclose(medium.scattering[1], 3.996e-6, rtol=1e-9)
    assert_allclose(medium.absorption[1], 0.444e-6, rtol=1e-9)


def test_scale_height_and_density_follow_from_bulk_parameters(good):
    # US Standard Atmosphere 1976: H = 8434.5 m (its R* differs in the sixth digit), 1.225 kg/m³
    bulk = '{ temperature = "288.15 K", molar_mass = "28.9644 g/mol", gravity = "9.80665 m/s^2" }'
    text = good.replace('scale_height = "8 km"', f"scale_height = {bulk}")
    old = f'{AIR}\nphase_function = {{ kind = "rayleigh" }}'
    by_mass = '{ rayleigh = "air", mass_density = "1.225 kg/m^3", molar_mass = "28.9644 g/mol" }'
    medium = medium_of(replaced(text, old, f"scattering = {by_mass}"))
    assert_allclose(medium.density.columns[0], 8434.5, rtol=5e-5)
    assert_allclose(1e6 * medium.scattering[0], [4.848, 11.487, 28.710], rtol=2e-4)


def test_air_from_its_refractivity_matches_the_first_atmosphere_plus_notes(good):
    # AP1 1.6 with corrected digits: (6.55, 17.3, 23.0)e-6 at 650, 510, 475 nm
    gas = (
        'scattering = { refractivity = 3e-4, number_density = "2.545e25 /m^3", king_factor = 1.0 }'
    )
    medium = medium_of(replaced(good, AIR, gas), [650.0, 510.0, 475.0])
    assert np.all(np.abs(1e6 * medium.scattering[0] - [6.55, 17.3, 23.0]) < [5e-3, 5e-2, 5e-2])


EVEN_TABLE = (
    '{ kind = "tabulated", angles = "0, 90, 180 deg", values = [0.0795775, 0.0795775, 0.0795775], '
)
WRONG = [
    # old text, new text, field named, something of the allowed range
    ('"6360 km"', '"-6360 km"', "shell.bottom_radius", "more than 0 m"),
    ('"6460 km"', '"6360 km"', "shell.top_radius", "more than bottom_radius"),
    ('"6460 km"', '"1e9 km"', "top_radius", "to 63600000 m"),
    ('"6360 km"', '"6360 kg"', "shell.bottom_radius", "'m'"),
    ('"6360 km"', '"nan km"', "shell.bottom_radius", "'m'"),
    ('"6360 km"', '"1e999 km"', "shell.bottom_radius", "'m'"),
    ('"6360 km"', "nan", "shell.bottom_radius", "'m'"),
    ('"6360 km"', "true", "shell.bottom_radius", "'m'"),
    ('bottom_radius = "6360 km"', "", "shell.bottom_radius is missing", "6360 km"),
    ("bottom_radius", "botom_radius", "shell.bottom_radius is missing", "6360 km"),
    ("albedo = 0.1", "albedo = 1.1", "ground.albedo", "0 to 1"),
    ("albedo = 0.1", "albedo = -0.1", "ground.albedo", "0 to 1"),
    ("albedo = 0.1", "albedo = [0.1, 0.2]", "ground.albedo", "list of wavelengths"),
    ("albedo = 0.1", 'albedo = "grass"', "ground.albedo", "0 to 1"),
    ("albedo = 0.1", 'albedo = "cie-1931"', "ground.albedo", "0 to 1"),
    (
        "albedo = 0.1",
        "albedo = 0.1\ncloud_optical_depth = 1e4",
        "ground.cloud_optical_depth is",
        "0 to",
    ),
    ("albedo = 0.1", "albedo = 0.1\ncloud_optical_depth = -0.1", "cloud_optical_depth", "0 to"),
    ("albedo = 0.1", "albedo = 0.1\ncloud_albedo = 0.6", "cloud_albedo", ""),
    ("albedo = 0.1", "albedo = 0.1\ncloud_altitude = '-1 m'", "ground.cloud_altitude", "0 to"),
    ("albedo = 0.1", "albedo = 0.1\ncloud_altitude = '101 km'", "cloud_altitude", "100000 m"),
    ("albedo = 0.1", "albedo = 0.1\ncloud_altitude = '4 kg'", "ground.cloud_altitude", "'m'"),
    ("albedo = 0.1", "albedo = 0.1\nclouds = 3", "ground.clouds", "picture of clouds"),
    ("albedo = 0.1", "albedo = 0.1\nalbeda = 0.1", "a key of ground is 'albeda'", "'albedo'?"),
    ('irradiance = "1 W/m^2/nm"', "", "star.light is missing", "spectrum, irradiance, temperature"),
    ('irradiance = "1 W/m^2/nm"', 'spectrum = "astm"', "star.spectrum", "astm-g173"),
    ('irradiance = "1 W/m^2/nm"', 'irradiance = "-1 W/m^2/nm"', "star.irradiance", "0 to"),
    (
        'irradiance = "1 W/m^2/nm"',
        'temperature = "5772 K"',
        "star.temperature requires",
        "distance",
    ),
    ('angular_radius = "0.2678 deg"', "", "star.angular_radius is missing", "deg"),
    ('"0.2678 deg"', '"-1 deg"', "star.angular_radius", "0 to 30 deg"),
    ('name = "ozone"', 'name = "air"', "constituents[2].name", "a unique name"),
    (
        'scale_height = "8 km"',
        'scale_height = "0 km"',
        "constituents[0].profile.scale_height",
        "1 to",
    ),
    (
        'kind = "exponential"',
        'kind = "exponentail"',
        "constituents[0].profile.kind",
        "'exponential'?",
    ),
    ('"tent", center', '"tent", centre', "constituents[2].profile.center is missing", "25 km"),
    (
        '"680, 550, 440 nm"',
        '"680, 550, 550 nm"',
        "constituents[0].wavelengths",
        "each wavelength once",
    ),
    ('"680, 550, 440 nm"', '"680, 550, -440 nm"', "constituents[0].", "10 to 1e+06 nm"),
    ('"680, 550, 440 nm"', '"680, 550 nm"', "constituents[0].scattering", "2 values"),
    ('"5.802e-6 /m"', '"-5.802e-6 /m"', "constituents[0].scattering[0]", "0 to 1 /m"),
    ('"5.802e-6 /m"', '"5.802e6 /m"', "constituents[0].scattering[0]", "0 to 1 /m"),
    ('"5.802e-6 /m"', '"5.802e-6 m"', "constituents[0].scattering[0]", "1/m"),
    ('"5.802e-6 /m"', '""', "constituents[0].scattering[0]", "1/m"),
    ('"rayleigh" }', '"rayleigh", depolarisation = 0.6 }', "depolarisation", "0 to 0.5"),
    ("asymmetry = 0.8", "asymmetry = 1.0", "constituents[1].phase_function.asymmetry", "0.999"),
    ("asymmetry = 0.8", "asymmetry = -1.5", "constituents[1].phase_function.asymmetry", "0.999"),
    (
        "asymmetry = 0.8",
        'asymmetry = "0.8 m"',
        "constituents[1].phase_function.asymmetry",
        "finite",
    ),
    ("asymmetry = 0.8", "assymetry = 0.8", "asymmetry is missing", "0.8"),
    (
        'phase_function = { kind = "rayleigh" }',
        "",
        "constituents[0].phase_function is required",
        "",
    ),
    ('absorption = "0.444e-6 /m"', "single_scattering_albedo = 1.2", "albedo", "0 to 1"),
    ('absorption = "0.444e-6 /m"', "single_scattering_albedo = 0", "absorption", "as implied"),
    (
        'absorption = "0.444e-6 /m"',
        'extinction = "3e-6 /m"',
        "extinction",
        "at least the scattering",
    ),
    ('absorption = "0.444e-6 /m"', "optical_depth = 0.1", "constituents[1].scattering", "sets"),
    ('scattering = "3.996e-6 /m"', 'extinction = "1e-6 /m"', "constituents[1].scattering", "sets"),
    (
        'profile = { kind = "tent"',
        'profil = { kind = "tent"',
        "constituents[2].profile is missing",
        "",
    ),
    (
        "[[constituents]]",
        "[[constituentss]]",
        "a key of the file is 'constituentss'",
        "'constituents'?",
    ),
    ('name = "Test"', 'name = ""', "name", "1 to 60 letters"),
    ('name = "Test"', 'name = ["Test"]', "name", ""),
    (
        'name = "Test"',
        'name = "Test"\nwavelengths = "680, 990 nm"',
        "wavelengths is 990.0",
        "430 to 690",
    ),
    (
        'scattering = "3.996e-6 /m"',
        'scattering = { rayleigh = "air", temperature = "273.15 K" }',
        "constituents[1].scattering.temperature",
        "requires pressure",
    ),
    (
        'scattering = "3.996e-6 /m"',
        (
            'scattering = { refractivity = 4.5e-4, number_density = "2.8e23 /m^3", '
            'temperature = "273.15 K", pressure = "101325 Pa" }'
        ),
        "constituents[1].scattering.number_density",
        "the same state",
    ),
    (
        'scattering = "3.996e-6 /m"',
        'scattering = { rayleigh = "argon", number_density = "2.8e23 /m^3" }',
        "constituents[1].scattering.rayleigh",
        "air, co2",
    ),
    (
        'absorption = "0.444e-6 /m"',
        'absorption = { ozone = "-3 DU" }',
        "constituents[1].absorption",
        "/m^2",
    ),
    (
        '{ kind = "tent", center = "25 km", half_width = "15 km" }',
        '{ kind = "tabulated", altitudes = "0, 20, 10 km", densities = [1, 1, 1] }',
        "constituents[2].profile.altitudes[2]",
        "more than the previous value",
    ),
    (
        '{ kind = "tent", center = "25 km", half_width = "15 km" }',
        '{ kind = "tabulated", altitudes = "0, 10 km", densities = [1, 1, 1] }',
        "constituents[2].profile.densities",
        "one for each of 2 altitudes",
    ),
    (
        '{ kind = "tent", center = "25 km", half_width = "15 km" }',
        '{ kind = "tabulated", altitudes = "0, 10 km", densities = [1, -1] }',
        "constituents[2].profile.densities[1]",
        "0 to",
    ),
    (
        '{ kind = "tent", center = "25 km", half_width = "15 km" }',
        '{ kind = "layered", layers = [] }',
        "constituents[2].profile.layers",
        "1 to 1000 layers",
    ),
    (
        '{ kind = "cornette-shanks", asymmetry = 0.8 }',
        '{ kind = "tabulated", angles = "0, 90, 180 deg", values = [0.16, 0.16, 0.16] }',
        "integral of values[0] is 2.01",
        "1 within 0.001",
    ),
    (
        '{ kind = "cornette-shanks", asymmetry = 0.8 }',
        '{ kind = "tabulated", angles = "0, 90, 170 deg", values = [0.08, 0.08, 0.08] }',
        "angles",
        "from 0 to 180 deg",
    ),
    (
        '{ kind = "cornette-shanks", asymmetry = 0.8 }',
        EVEN_TABLE + "f12 = [0, -0.5] }",
        "f12[0] is 2",
        "as many numbers as angles, 3",
    ),
    (
        '{ kind = "cornette-shanks", asymmetry = 0.8 }',
        EVEN_TABLE + "f12 = [0, -1.5, 0] }",
        "f12[0][1] is -1.5",
        "-1 to 1",
    ),
    (
        '{ kind = "cornette-shanks", asymmetry = 0.8 }',
        EVEN_TABLE + "f12 = [0, -0.9, 0], f33 = [1, 0.9, -1] }",
        "f12² + f33² + f34² is 1.62",
        "at most 1 at every angle",
    ),
]


@pytest.mark.parametrize(("old", "new", "field", "allowed"), WRONG)
def test_each_mistake_gives_one_line_with_file_field_value_and_range(
    good, old, new, field, allowed
):
    with pytest.raises(ParameterError) as caught:
        medium_of(replaced(good, old, new))
    line = str(caught.value)
    assert "\n" not in line
    assert field in line
    assert allowed in line
    assert line.startswith("test.toml: ")


def test_an_optical_depth_beyond_reason_is_refused(good):
    text = replaced(good, '"3.996e-6 /m"', '"1 /m"').replace('"1.2 km"', '"80 km"')
    with pytest.raises(ParameterError, match="vertical optical depth") as caught:
        medium_of(text)
    assert "10000" in str(caught.value)


def test_coefficients_follow_power_laws_and_stop_ten_nanometres_beyond(good):
    # ozone: the geometric mean between 550 and 440 nm; Rayleigh: λ⁻⁴ beyond 680 nm
    medium = medium_of(good, [np.sqrt(550.0 * 440.0), 690.0, 430.0])
    assert_allclose(medium.absorption[2, 0], np.sqrt(1.881e-6 * 0.085e-6), rtol=1e-12)
    assert_allclose(medium.absorption[2, 1:], [0.65e-6, 0.085e-6], rtol=1e-12)
    assert_allclose(medium.scattering[0, 1], 5.802e-6 * (680.0 / 690.0) ** 4, rtol=1e-12)
    assert_allclose(medium.scattering[0, 2], 33.1e-6 * (440.0 / 430.0) ** 4, rtol=1e-12)
    with pytest.raises(ParameterError, match=r"691.0; allowed: 430 to 690 nm, for 'ozone'"):
        medium_of(good, [691.0])


def test_rayleigh_alone_is_known_at_any_wavelength(good):
    # λ⁻⁴ beyond the given wavelengths, a power law between them: the geometric mean
    air = good[: good.index('[[constituents]]\nname = "aerosol"')]
    medium = medium_of(air, [300.0, np.sqrt(550.0 * 680.0), 2000.0])
    blue, red = 33.1 * (440.0 / 300.0) ** 4, 5.802 * (680.0 / 2000.0) ** 4
    expected = [1e-6 * blue, 1e-6 * np.sqrt(13.558 * 5.802), 1e-6 * red]
    assert_allclose(medium.scattering[0], expected, rtol=1e-12)


@pytest.mark.parametrize("wavelengths", [[], [550.0, 550.0], [np.nan], [[550.0]], ["red"], None])
def test_wavelengths_that_are_none_are_refused(good, wavelengths):
    with pytest.raises(ParameterError, match="wavelengths"):
        medium_of(good, wavelengths)


def test_a_tabulated_phase_function_keeps_its_values_and_its_integral(good):
    # Henyey-Greenstein tabulated at 1° steps: its moments are g^l
    angles = np.arange(181.0)
    g = 0.5
    rows = (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * np.cos(np.radians(angles))) ** 1.5)
    table = f'{{ kind = "tabulated", angles = {degrees(angles)}, values = {rows.tolist()} }}'
    medium = medium_of(
        replaced(good, '{ kind = "cornette-shanks", asymmetry = 0.8 }', table), [550.0]
    )
    assert_allclose(medium.phase_moments(3)[1, 0], g ** np.arange(4), rtol=0, atol=1e-4)
    nodes = np.cos(np.radians(angles[1:-1]))
    assert_allclose(medium.phase_function(nodes)[:, 1, 0], rows[1:-1], rtol=1e-9)


def test_a_tabulated_phase_matrix_is_the_one_of_the_file(good):
    # Rayleigh's law as a table, by F12 alone: its values at every cosine, and its closed form of
    # degree 2, by which the moments couple; parabolas between 0.5° are straight to 1e-5.
    angles = np.arange(0.0, 180.5, 0.5)
    nu = np.cos(np.radians(angles))
    values = 3.0 / (16.0 * np.pi) * (1.0 + nu**2)
    f12 = -(1.0 - nu**2) / (1.0 + nu**2)
    table = (
        f'{{ kind = "tabulated", angles = {degrees(angles)}, values = {values.tolist()}, '
        f"f12 = {f12.tolist()} }}"
    )
    phase = '{ kind = "cornette-shanks", asymmetry = 0.8 }'
    medium = medium_of(replaced(good, phase, table), [550.0])
    law = medium_of(replaced(good, phase, '{ kind = "rayleigh" }'), [550.0])
    between = np.linspace(-0.99, 0.99, 40)
    assert_allclose(medium.phase_f12(between)[:, 1], law.phase_f12(between)[:, 1], atol=2e-6)
    assert_allclose(medium.polarising_moments()[1], law.polarising_moments()[1], atol=2e-5)
    row = medium.constituents[1].phase_function_at(np.array([550.0])).sampled(550.0)[0]
    assert_allclose(row.ratios[1], 2.0 * nu / (1.0 + nu**2), atol=1e-12)


def test_tabulated_phase_functions_are_mixed_linearly_between_wavelengths(good):
    # two moments known: isotropic (g_1 = 0) and 1 + ν (g_1 = 1/3)
    angles = np.arange(0.0, 181.0, 1.0)
    iso = np.full(181, 1.0 / (4.0 * np.pi))
    skew = (1.0 + np.cos(np.radians(angles))) / (4.0 * np.pi)
    values = [iso.tolist(), np.abs(skew).tolist()]
    table = f'{{ kind = "tabulated", angles = {degrees(angles)}, values = {values} }}'
    text = replaced(good, '{ kind = "cornette-shanks", asymmetry = 0.8 }', table)
    text = replaced(text, 'name = "aerosol"', 'name = "aerosol"\nwavelengths = "500, 600 nm"')
    medium = medium_of(text, [500.0, 550.0, 600.0])
    assert_allclose(medium.phase_moments(1)[1, :, 1], [0.0, 1.0 / 6.0, 1.0 / 3.0], atol=2e-4)


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"", "name is missing"),
        (b"\xff\xfe\x00", "not UTF-8"),
        (b"name = ", "not TOML"),
        (b"x = " + b"[" * 5000, "not TOML"),
        (b"x = " + b"9" * 6000, "not TOML"),
        (b"\x00", "not TOML"),
        (b"a = 1\n" * 700_000, "larger than"),
    ],
)
def test_files_that_are_no_planet_files_give_one_line(tmp_path, content, reason):
    file = tmp_path / "planet.toml"
    file.write_bytes(content)
    with pytest.raises(AirlightError) as caught:
        load_planet(file)
    line = str(caught.value)
    assert "planet.toml" in line
    assert reason in line
    assert "\n" not in line


def test_missing_files_folders_and_devices_give_one_line(tmp_path):
    for path in (tmp_path / "none.toml", tmp_path, tmp_path / "a\0b.toml", tmp_path / ("x" * 300)):
        with pytest.raises(FileError):
            load_planet(path)
    if hasattr(os, "mkfifo"):
        os.mkfifo(tmp_path / "pipe.toml")
        with pytest.raises(FileError, match="not a regular file"):
            load_planet(tmp_path / "pipe.toml")


def test_a_misspelt_planet_gets_the_nearest_name():
    with pytest.raises(ParameterError, match=re.escape("did you mean 'earth-bruneton'?")):
        load_planet("earth-brunetton")
    for strange in ("", "charon", "x" * 5000, 3, None):
        with pytest.raises(ParameterError, match="planet"):
            load_planet(strange)


def test_files_with_windows_line_ends_and_a_byte_order_mark_are_read(good, tmp_path):
    file = tmp_path / "planet.toml"
    file.write_bytes(b"\xef\xbb\xbf" + good.replace("\n", "\r\n").encode())
    assert load_planet(str(file)).name == "Test"


def test_tables_are_read_as_their_text_is(good):
    # two ways to the same planet; the tables are not changed
    tables = tomllib.loads(good)
    before = copy.deepcopy(tables)
    assert read_tables(tables, "test.toml") == read_planet(good, "test.toml")
    assert tables == before


def test_the_medium_that_the_reader_made_is_the_one_that_is_solved(good):
    # sampled once for reader and solver; another planet or wavelength is sampled anew
    planet = read_tables(tomllib.loads(good), "test.toml", wavelengths=lambda planet: [600.0])
    medium = Medium.from_planet(planet, [600.0])
    assert len(planet.media) == 1
    assert Medium.from_planet(planet, [600.0]) is medium
    assert Medium.from_planet(planet, [601.0]) is not medium
    higher = replace(planet, top_radius=6.47e6)
    assert Medium.from_planet(higher, [600.0]).top_radius == 6.47e6


def test_a_key_of_a_constituent_is_one_declaration(good):
    # a second class with one more declared field: reader, range, unit and list of keys follow
    from airlight.planets.constituent import Constituent
    from airlight.planets.parameters import parameters
    from airlight.planets.schema.field import key
    from airlight.planets.schema.toml_table import TomlTable

    @parameters
    class Glowing(Constituent):
        glow: float = key(
            label="glow", help="-", unit="m", range=(0.0, 1e4), example="1 km", default=0.0
        )

    table = tomllib.loads(good)["constituents"][0]
    for given, expected in (({}, 0.0), ({"glow": "2 km"}, 2000.0)):
        read = Glowing.read(TomlTable({**table, **given}, "constituents[0]", thickness=1e5))
        assert read.glow == expected
    with pytest.raises(ParameterError, match=r"constituents\[0\]\.glow is 20000.0; allowed: 0 to"):
        Glowing.read(TomlTable({**table, "glow": "20 km"}, "constituents[0]", thickness=1e5))
    assert "glow" in [one.name for one in Glowing.declared()]


def test_an_unknown_key_of_the_shell_hides_no_error_of_the_air(good):
    tables = tomllib.loads(good)
    tables["shell"]["colour"] = 1
    tables["constituents"][0]["profile"] = {"kind": "tent", "altitude": "20 km"}
    with pytest.raises(ParameterError) as refused:
        read_tables(tables, "test.toml")
    for one in ("a key of shell is 'colour'", "constituents[0].profile.center is missing"):
        assert one in str(refused.value)
    assert "also: a key of constituents[0].profile is 'altitude'" in str(refused.value)
