"""Examples of docs/planet-files.md work as shown."""

from __future__ import annotations

import re
import runpy
from pathlib import Path

import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.physics.optics.index_table import index_names, read_index
from airlight.physics.optics.molecules import MOLECULES
from airlight.planets import Medium
from airlight.planets.matter.gases import GasScattering
from airlight.planets.matter.profiles import PROFILES, Tent
from airlight.planets.reading.reader import read_planet

BUILDER = runpy.run_path(str(Path(__file__).parents[2] / "builders" / "file_keys.py"))
PAGE = (Path(__file__).parents[2] / "docs" / "planet-files.md").read_text(encoding="utf-8")


def blocks(language: str) -> list[str]:
    return re.findall(rf"```{language}\n(.*?)```", PAGE, flags=re.DOTALL)


def test_the_whole_file_of_the_page_is_read():
    text, *_ = blocks("toml")
    planet = read_planet(text, "page.toml")
    assert Medium.from_planet(planet, planet.wavelengths).names == ("air", "aerosol", "ozone")


def test_the_python_of_the_page_runs():
    (code,) = blocks("python")
    names: dict[str, object] = {}
    exec(code, names)
    assert names["dusty"].ground.albedo == 0.3


def test_the_gas_of_the_page_scatters_what_the_page_says():
    # the numbers printed on the page, and their difference from named air
    whole, gas, _ = blocks("toml")
    start = whole.index('profile = { kind = "exponential", scale_height = "8 km" }')
    stop = whole.index("[[constituents]]", start)
    planet = read_planet(whole[:start] + gas + whole[stop:], "page.toml")
    scattering = Medium.from_planet(planet, (680.0, 550.0, 440.0)).scattering[0]
    assert_allclose(1e6 * scattering, [4.855, 11.495, 28.708], rtol=0, atol=5e-4)
    named = GasScattering(gas="air", temperature=288.15, pressure=101_325.0)
    percent = 100.0 * (scattering / named.coefficients([680.0, 550.0, 440.0]) - 1.0)
    assert_allclose(percent, [0.16, 0.07, -0.01], rtol=0, atol=5e-3)


def test_the_page_names_every_gas_with_its_limits():
    for name, gas in MOLECULES.items():
        assert f"| `{name}` | {gas.limits[0]:.0f}–{int(gas.limits[1])} |" in PAGE, name


def test_the_particles_of_the_page_are_read():
    # the block of the page instead of the aerosol's coefficients
    whole, _, dust = blocks("toml")
    start = whole.index('scattering = "3.996e-6 /m"')
    stop = whole.index("[[constituents]]", start)
    planet = read_planet(whole[:start] + dust + whole[stop:], "page.toml")
    depth = Medium.from_planet(planet, [550.0]).vertical_optical_depth[1, 0]
    assert_allclose(depth, 0.5, rtol=1e-9)


def test_the_page_names_every_index_with_its_limits():
    for name in index_names():
        table = read_index(name)
        first, last = (5 * round(nm / 5) for nm in table.wavelengths[[0, -1]])
        assert f'| `"{name}"` | {first:.0f}–{last:.0f} |' in PAGE, name


def test_the_page_names_every_absorber():
    from airlight.planets.matter.absorbers import ABSORBERS

    for kind in ABSORBERS.keywords:
        assert f"`{kind}" in PAGE


def test_the_page_names_every_kind():
    from airlight.planets.matter.phases import PHASES

    for kind in (*PHASES.keywords, *PROFILES.keywords):
        assert f'`"{kind}"`' in PAGE


def test_the_tables_of_the_page_are_those_of_the_declarations():
    # written by builders/file_keys.py; every kind of table has its block but one, whose
    # keys are the names of gases
    kinds = re.findall(r"<!-- keys: (\w+) -->", PAGE)
    assert sorted(kinds) == sorted(BUILDER["PAGES"]["planet-files.md"])
    assert BUILDER["filled"]("planet-files.md") == PAGE
    clouds = (BUILDER["DOCS"] / "clouds.md").read_text(encoding="utf-8")
    assert BUILDER["filled"]("clouds.md") == clouds


def test_a_range_of_a_declaration_is_the_one_that_is_checked_and_printed():
    # one number in three uses: the class, the file, the page
    assert "| `half_width` | 0.001 to 1e6 km | required |" in BUILDER["key_table"](
        "profile", PROFILES
    )
    (key,) = [one for one in PROFILES.declared({"kind": "tent"}) if one.name == "half_width"]
    assert key.range == (1.0, 1e9)
    with pytest.raises(ParameterError, match=r"half_width is 0\.5; allowed: 1 to 1e\+09 m"):
        Tent(center=0.0, half_width=0.5)
