"""Free parameters: each name finds its number, and writing a value gives a planet that has it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.planets import Medium, Planet
from airlight.planets.reading.declared_keys import spelled_out
from airlight.planets.reading.nested_tables import Tables
from airlight.planets.reading.reader import nested_tables, planet_text, read_tables
from airlight.studies.fit.angstrom import exponent_of
from airlight.studies.fit.free_parameters import free_names, free_parameter

NM = np.array([440.0, 550.0, 680.0])

HAZY = """
name = "Haze"
[shell]
bottom_radius = "6371 km"
top_radius = "6471 km"
[ground]
wavelengths = "400, 550, 900 nm"
albedo = [0.05, 0.1, 0.4]
[star]
spectrum = "astm-g173"
angular_radius = "0.2665 deg"
[[constituents]]
name = "haze"
profile = { kind = "exponential", scale_height = "2 km" }
wavelengths = "300, 440, 550, 870, 1000 nm"
optical_depth = [0.3, 0.2, 0.15, 0.08, 0.06]
single_scattering_albedo = 0.9
phase_function = { kind = "cornette-shanks", asymmetry = 0.7 }
[[constituents]]
name = "ozone"
profile = { kind = "tent", center = "25 km", half_width = "15 km" }
absorption = { ozone = "300 DU" }
"""


def tables_of(name: str) -> tuple[Tables, Planet]:
    text = HAZY if name == "haze" else planet_text(name)[0]
    tables = spelled_out(nested_tables(text, "test.toml"))
    return tables, read_tables(tables, "test.toml")


def depth(planet: Planet, name: str, nm: float = 550.0) -> float:
    medium = Medium.from_planet(planet, [nm])
    return float(medium.vertical_optical_depth[medium.names.index(name), 0])


@pytest.mark.parametrize(
    ("preset", "name"),
    [("haze", "haze"), ("earth-atmosphere-plus", "aerosol"), ("haze", "ozone")],
)
def test_optical_depth_is_that_of_the_planet(preset: str, name: str) -> None:
    # However the file gives it: the medium, which solvers read, has the value that was written.
    tables, planet = tables_of(preset)
    free = free_parameter(f"{name}.optical_depth", tables, planet, NM)
    assert_allclose(free.parameter.start, depth(planet, name), rtol=1e-12)
    value = 2.5 * free.parameter.start
    assert_allclose(depth(read_tables(free.write(tables, value), "x"), name), value, rtol=1e-9)


@pytest.mark.parametrize(
    ("preset", "name"), [("haze", "haze"), ("earth-atmosphere-plus", "aerosol")]
)
def test_exponent_and_optical_depth_are_both_met(preset: str, name: str) -> None:
    # A list keeps its curvature and its value at 550 nm; one value becomes a list of 17, linear
    # between them: within 1 % of the exponent.
    tables, planet = tables_of(preset)
    tilt = free_parameter(f"{name}.angstrom", tables, planet, NM)
    amount = free_parameter(f"{name}.optical_depth", tables, planet, NM)
    assert tilt.order < amount.order
    written = amount.write(tilt.write(tables, 1.7), 0.3)
    got = read_tables(written, "x")
    index = [one.name for one in got.constituents].index(name)
    assert_allclose(exponent_of(got, index), 1.7, rtol=0.01)
    assert_allclose(depth(got, name), 0.3, rtol=1e-3)


def test_exponent_of_a_power_law_is_its_own() -> None:
    # A law: from 440 to 870 nm of the list, ln(0.2/0.08)/ln(870/440).
    _, planet = tables_of("haze")
    assert_allclose(exponent_of(planet, 0), np.log(0.2 / 0.08) / np.log(870 / 440), rtol=1e-9)


def test_column_and_ground_are_written_in_what_the_file_has() -> None:
    # 300 DU in the file; a list of albedos is scaled by the brightness.
    tables, planet = tables_of("haze")
    column = free_parameter("ozone.column", tables, planet, NM)
    assert (column.parameter.start, column.parameter.unit) == (300.0, "DU")
    thicker = read_tables(column.write(tables, 450.0), "x")
    assert_allclose(depth(thicker, "ozone") / depth(planet, "ozone"), 1.5, rtol=1e-9)
    ground = free_parameter("ground.albedo", tables, planet, NM)
    assert_allclose(ground.parameter.start, 0.1)
    brighter = read_tables(ground.write(tables, 0.2), "x")
    assert_allclose(brighter.ground.albedos([400.0, 550.0, 900.0]), [0.1, 0.2, 0.8])


def test_ozone_of_the_earth_has_the_bounds_of_what_was_measured() -> None:
    # 73 to some 600 DU were; another planet may have none.
    tables, planet = tables_of("earth")
    earth = free_parameter("ozone.column", tables, planet, NM).parameter
    assert (earth.low, earth.start, earth.high) == (50.0, 345.0, 700.0)
    assert free_parameter("ozone.column", *tables_of("haze"), NM).parameter.low == 0.0


def test_number_of_the_file_has_its_declared_unit_and_range() -> None:
    # As docs/planet-files.md says: scale heights in km, albedos from 0 to 1.
    tables, planet = tables_of("haze")
    height = free_parameter("haze.profile.scale_height", tables, planet, NM)
    assert (height.parameter.start, height.parameter.unit) == (2.0, "km")
    assert height.write(tables, 3.0)["constituents"][0]["profile"]["scale_height"] == "3 km"
    albedo = free_parameter("haze.single_scattering_albedo", tables, planet, NM).parameter
    assert (albedo.low, albedo.high, albedo.start) == (0.0, 1.0, 0.9)
    item = free_parameter("haze.optical_depth[2]", tables, planet, NM)
    assert item.write(tables, 0.5)["constituents"][0]["optical_depth"][2] == 0.5


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("haze.optical_deph", "'haze.optical_depth'"),
        ("hase.angstrom", "'haze.angstrom'"),
        ("ground.albdo", "'ground.albedo'"),
        ("haze", "the path of a number"),
        ("name", "the path of a number"),
        ("ozone.angstrom", "given by coefficients"),
        ("haze.wavelengths", "a number, not a list"),
    ],
)
def test_unknown_names_are_refused_with_the_nearest(name: str, said: str) -> None:
    # One line with the value and what would do.
    tables, planet = tables_of("haze")
    with pytest.raises(ParameterError) as caught:
        free_parameter(name, tables, planet, NM)
    assert said in str(caught.value)
    assert repr(name) in str(caught.value)


def test_every_listed_name_is_found() -> None:
    # What an error offers must work.
    for preset in ("haze", "earth-atmosphere-plus"):
        tables, planet = tables_of(preset)
        for name in free_names(tables):
            if not name.endswith((".angstrom", ".column")):
                one = free_parameter(name, tables, planet, NM).parameter
                assert one.low <= one.start <= one.high
