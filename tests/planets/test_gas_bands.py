"""Bands of gases: the tables against other sources, as constituents, and what is left out."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Medium, Planet, load_planet
from airlight.physics.spectra.tables import read_spectrum
from airlight.planets import replace
from airlight.planets.gas_bands import AIRMASS, PAIR_DENSITY, omitted_bands
from airlight.planets.matter.absorbers import CrossSectionAbsorption
from airlight.planets.matter.gas_mixture import GasMixture

DOCS = Path(__file__).parents[2] / "docs"
PRESET = Path(str(__import__("airlight").__file__)).parent / "planets" / "presets" / "earth.toml"
#: Oxygen above the standard atmosphere's ground: a fifth of p/(mg). [m⁻²]
OXYGEN = 0.209476 * 101_325.0 / (9.80665 * 0.0289644 / 6.02214076e23)
#: Integral of the standard atmosphere's squared density over that at the ground, by trapezoids of
#: 0.25 m over its Tables' layers; one exponential of 8434.5 m has half of that, 4217 m. [m]
SQUARED = 4637.0


def through(table: str, column: float, wavelengths: np.ndarray) -> np.ndarray:
    return np.exp(-AIRMASS * column * read_spectrum(table).at(wavelengths))


def standard_sunlight() -> tuple[np.ndarray, np.ndarray]:
    """Wavelengths [nm] and direct sunlight at airmass 1.5 over that outside the air."""
    spectra = pytest.importorskip("pvlib.spectrum").get_reference_spectra()
    nm = spectra.index.to_numpy()
    return nm, (spectra["direct"] / spectra["extraterrestrial"]).to_numpy()


def dip(nm: np.ndarray, light: np.ndarray, centre: float, core: float, *edges: float) -> float:
    """Mean of the core of a band over the line between the means of two edges, 4 nm wide."""

    def mean(middle: float, half: float) -> float:
        inside = (nm >= middle - half) & (nm <= middle + half)
        return float(np.trapezoid(light[inside], nm[inside]) / np.ptp(nm[inside]))

    low, high = (mean(edge, 2.0) for edge in edges)
    part = (centre - edges[0]) / (edges[1] - edges[0])
    return mean(centre, core) / (low + part * (high - low))


@pytest.mark.parametrize(
    ("centre", "edges", "within"), [(764.0, (754.0, 776.0), 0.06), (689.0, (680.0, 710.0), 0.02)]
)
def test_oxygen_s_bands_are_those_of_the_standard_sunlight(
    centre: float, edges: tuple[float, float], within: float
) -> None:
    # A second method: ASTM G173's direct sunlight at airmass 1.5, by SMARTS, whose band model of
    # the A band is coarser than lines: 4 % deeper.
    ours = float(through("oxygen-bands", OXYGEN, np.array([centre]))[0])
    assert_allclose(ours, dip(*standard_sunlight(), centre, 5.0, *edges), rtol=within)


def test_oxygen_s_pairs_are_those_of_the_standard_sunlight() -> None:
    # The same at 477 nm, where neither water nor lines of oxygen are near.
    nm = np.arange(460.0, 496.0)
    light = through("oxygen-pairs", PAIR_DENSITY * SQUARED, nm)
    ours = dip(nm, light, 477.0, 3.0, 465.0, 490.0)
    assert_allclose(ours, dip(*standard_sunlight(), 477.0, 3.0, 465.0, 490.0), rtol=0.005)


def test_water_s_bands_have_the_coefficients_of_bird_and_riordan() -> None:
    # Eq. 2-8 of the report with its own coefficients at four wavelengths, 1.42 cm of water
    spectrl2 = pytest.importorskip("pvlib.spectrum.spectrl2")
    known = spectrl2._SPECTRL2_COEFFS
    nm = np.array([593.0, 690.0, 816.0, 937.0])
    amount = np.interp(nm, known["wavelength"], known["water_vapor_absorption"]) * 1.42 * AIRMASS
    expected = np.exp(-0.2385 * amount / (1.0 + 20.07 * amount) ** 0.45)
    column = 1.42e4 / 18.01528 * 6.02214076e23
    assert_allclose(through("water-vapour-bands", column, nm), expected, rtol=1e-4)


def documented() -> str:
    """Constituents of docs/planets.md with the Earth's bands."""
    page = (DOCS / "planets.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"```toml\n(.*?)```", page, flags=re.DOTALL)
    return str(block)


@pytest.fixture(scope="module")
def banded(tmp_path_factory: pytest.TempPathFactory) -> Planet:
    file = tmp_path_factory.mktemp("planets") / "bands.toml"
    file.write_text(PRESET.read_text(encoding="utf-8") + "\n" + documented(), encoding="utf-8")
    return load_planet(str(file))


def test_the_constituents_of_the_page_take_what_the_tables_say(banded: Planet) -> None:
    # The vertical depth is column times cross-section, for the pairs with the squared density.
    nm = np.array([764.0, 724.0, 689.0, 577.0])
    medium = Medium.from_planet(banded, nm)
    depth = dict(zip(medium.names, medium.vertical_optical_depth, strict=True))
    for name, table, column in (
        ("oxygen", "oxygen-bands", OXYGEN),
        ("water vapour", "water-vapour-bands", 1.42e4 / 18.01528 * 6.02214076e23),
        ("pairs of oxygen", "oxygen-pairs", PAIR_DENSITY * SQUARED),
    ):
        expected = through(table, column, nm)
        assert_allclose(np.exp(-AIRMASS * depth[name]), expected, rtol=3e-3, err_msg=name)


def test_what_a_planet_has_is_not_left_out(banded: Planet) -> None:
    assert omitted_bands(banded, [764.0]) == ()
    omitted = omitted_bands(load_planet("earth"), [764.0, 577.0])
    assert [one.name for one in omitted] == ["O2", "H2O", "O2-O2"]
    bands, _, pairs = omitted
    assert_allclose(1.0 - bands.loss[0], through("oxygen-bands", OXYGEN, np.array([764.0]))[0],
                    rtol=3e-3)  # fmt: skip
    expected = through("oxygen-pairs", PAIR_DENSITY * SQUARED, np.array([577.0]))[0]
    assert_allclose(1.0 - pairs.loss[1], expected, rtol=1e-3)
    assert (bands.wavelength, pairs.wavelength) == (764.0, 578.0)


def test_a_gas_without_a_table_is_named_and_thin_gas_is_not() -> None:
    earth = load_planet("earth")
    air = earth.constituents[0]
    assert isinstance(air.matter, GasMixture)
    ammonia = replace(air, matter=replace(air.matter, composition={"N2": 0.9, "NH3": 0.1}))
    (omitted,) = omitted_bands(replace(earth, constituents=(ammonia,)), [647.0])
    assert str(omitted) == "bands of NH3: no table of them"
    assert omitted_bands(load_planet("mars"), [764.0]) == ()  # 0.16 % of 6 hPa


def test_the_earth_has_its_gases_even_where_its_air_is_coefficients() -> None:
    # The U.S. Standard Atmosphere's columns, as the mixture of ``earth`` has them.
    mixed, given = (omitted_bands(load_planet(name), [764.0, 577.0])
                    for name in ("earth", "earth-bruneton"))  # fmt: skip
    for one, other in zip(mixed, given, strict=True):
        assert one.name == other.name
        assert_allclose(other.loss, one.loss, rtol=3e-3, atol=1e-12)


def test_methane_s_bands_are_karkoschka_s() -> None:
    # Karkoschka (1998) as read twice over: optical depths of 2.80 km-amagat at 620, 730 and 790 nm
    loschmidt = 101_325.0 / (1.380649e-23 * 273.15)
    sigma = read_spectrum("methane-bands").at([620.0, 730.0, 790.0, 390.0])
    assert_allclose(2.80e3 * loschmidt * sigma, [1.269, 7.128, 1.985, 0.0], rtol=5e-4)


def test_titan_has_the_methane_of_its_gas() -> None:
    # 3.5 % of its molecules; the mean of 5.65 and 1.48 % over the column, Niemann et al. (2010)
    titan = load_planet("titan")
    *others, methane = titan.constituents
    air = others[0]
    assert isinstance(air.matter, GasMixture)
    assert isinstance(methane.absorption, CrossSectionAbsorption)
    share = dict(air.matter.composition)["CH4"]
    gas = air.matter.number_density * air.profile.column(titan.thickness)
    assert_allclose(methane.absorption.column, share * gas, rtol=0.01)
    assert omitted_bands(titan, [730.0]) == ()
    (omitted,) = omitted_bands(replace(titan, constituents=tuple(others)), [730.0])
    assert omitted.loss[0] > 0.999
    (methane_of_old,) = omitted_bands(load_planet("early-earth"), [730.0])
    assert methane_of_old.name == "CH4"
    assert methane_of_old.wavelength == 730.0
