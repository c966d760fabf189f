"""Numbers at wavelengths of bands that are left out come with a warning, in every interface."""

from __future__ import annotations

import re
import warnings
from pathlib import Path

import numpy as np
import pytest

import airlight
from airlight import AirlightWarning, load_planet
from airlight.cli.app import main
from airlight.physics.spectra.tables import read_spectrum
from airlight.planets import replace
from airlight.planets.omitted_absorption_bands import warn_of_omitted_bands
from airlight.planets.picture_wavelengths import picture_wavelengths, texel_wavelengths
from airlight.studies.sweep import Grid, sweep

DOCS = Path(__file__).parents[2] / "docs"
PRESET = Path(str(airlight.__file__)).parent / "planets" / "presets" / "earth.toml"
#: A planet that says nothing of its world.
NAMED = """
name = "Named"
shell = { bottom_radius = "6371 km", top_radius = "6471 km" }
ground = { albedo = 0.1 }
star = { spectrum = "astm-g173", angular_radius = "0.2665 deg" }
[[constituents]]
name = "air"
profile = { kind = "exponential", scale_height = "8434.5 m" }
scattering = { rayleigh = "air", temperature = "288.15 K", pressure = "101325 Pa" }
"""


def lost(table: str, column: float, nm: float) -> int:
    """Per cent of direct light at airmass 1.5, by Beer's law with the standard air's column."""
    return round(-100.0 * np.expm1(-1.5 * column * float(read_spectrum(table).at(nm))))


@pytest.mark.parametrize(
    ("nm", "gas", "size"),
    [
        (761.0, "O2", lost("oxygen-bands", 4.50e28, 761.0)),
        (689.0, "O2", lost("oxygen-bands", 4.50e28, 689.0)),
        (577.0, "O2-O2", lost("oxygen-pairs", 5.3354e24 * 4637.0, 577.0)),
        # 14.2 mm of water, the column of the U.S. Standard Atmosphere, 1976
        (720.0, "H2O", lost("water-vapour-bands", 4.747e26, 720.0)),
        (820.0, "H2O", lost("water-vapour-bands", 4.747e26, 820.0)),
        (940.0, "H2O", lost("water-vapour-bands", 4.747e26, 940.0)),
    ],
)
@pytest.mark.parametrize("name", ["earth", "earth-hazy"])
def test_gas_wavelength_and_size_of_a_band_are_named(
    name: str, nm: float, gas: str, size: int
) -> None:
    # The tables by Beer's law.
    words = re.escape(f"bands of {gas} are omitted: up to {size} %") + f".*at {nm:g} nm"
    with pytest.warns(AirlightWarning, match=words) as caught:
        warn_of_omitted_bands(load_planet(name), [550.0, nm])
    assert len(caught) == 1
    assert caught[0].filename == __file__


def test_air_by_its_name_has_oxygen(tmp_path: Path) -> None:
    # The same column as the mixture's: 101 325 Pa over 288.15 K, 8434.5 m of it.
    file = tmp_path / "named.toml"
    file.write_text(NAMED, encoding="utf-8")
    with pytest.warns(AirlightWarning, match=r"Named: absorption bands of O2 .* 37 % .* at 761 nm"):
        warn_of_omitted_bands(load_planet(file), [761.0])


def test_solve_warns_before_it_computes() -> None:
    # The order: a callback that cancels at once comes too late to silence it.
    with pytest.warns(AirlightWarning, match="O2 are omitted"), pytest.raises(airlight.Cancelled):
        airlight.solve("earth", [761.0], "preview", cache=False, cancel=lambda: True)


def test_the_command_line_says_it_once(capsys: pytest.CaptureFixture[str]) -> None:
    # One line for one planet, whatever the number of solves.
    where = ["--sun-zenith", "30", "--quality", "preview", "--wavelengths", "761"]
    assert main(["radiance", "earth", "--view-zenith", "30", *where]) == 0
    lines = capsys.readouterr().err.splitlines()
    (line,) = [line for line in lines if "O2" in line]
    assert line == (
        "airlight: Earth: absorption bands of O2 are omitted: up to 37 % of direct light at "
        "airmass 1.5, "
        "at 761 nm; a bandwidth counts them"
    )


def test_a_sweep_warns_in_the_process_that_asks(tmp_path: Path) -> None:
    # Workers have no reader.
    grid = Grid(planets=["earth"], sun_zenith=[0], view_zenith=[0], wavelengths=[940.0])
    with pytest.warns(AirlightWarning, match="H2O are omitted"):
        sweep(grid, tmp_path / "band.zarr", quality="preview", workers=1)


@pytest.mark.parametrize("name", airlight.planet_names())
def test_pictures_of_every_preset_are_silent(name: str) -> None:
    # A colour has 0.3 % of its light in the bands of the Earth.
    planet = load_planet(name)
    sets = [picture_wavelengths(planet, count) for count in (None, 3, 8, 12, 20, 24, 40)]
    sets += [texel_wavelengths(planet, word) for word in ("three", "four")]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for nm in [*sets, sets[1][::-1]]:
            warn_of_omitted_bands(planet, nm)


def test_wavelengths_between_the_bands_and_planets_with_them_are_silent(tmp_path: Path) -> None:
    # The page's constituents have the bands; so does an absorber by another cross-section.
    text = (DOCS / "planets.md").read_text(encoding="utf-8")
    bands = re.findall(r"```toml\n(.*?)```", text, flags=re.DOTALL)[0]
    file = tmp_path / "bands.toml"
    file.write_text(PRESET.read_text(encoding="utf-8") + "\n" + bands, encoding="utf-8")
    planet = load_planet(file)
    own = replace(
        planet.constituents[-1],
        absorption=replace(planet.constituents[-1].absorption, cross_section=1e-26),
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        warn_of_omitted_bands(load_planet("earth"), [360.0, 440.0, 500.0, 670.0, 780.0, 870.0])
        for one in (planet, replace(planet, constituents=(*planet.constituents[:-1], own))):
            warn_of_omitted_bands(one, [577.0, 689.0, 720.0, 761.0, 820.0, 940.0])
