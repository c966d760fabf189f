"""Air and ozone of tables: columns against raw rows, order, units, levels above and below."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import import_table, load_planet
from airlight.physics.constants import BOLTZMANN, DOBSON_UNIT
from airlight.planets import Medium, Planet
from airlight.planets.matter.absorbers import OzoneAbsorption
from airlight.planets.matter.profiles import Layers, Sounding

TABLES = Path(__file__).parents[2] / "examples" / "tables"
NM = (400.0, 550.0, 700.0)


def rayleigh_depths(planet: Planet) -> np.ndarray:
    column = planet.constituents[0].profile.column(planet.thickness)
    return np.asarray(planet.constituents[0].scattering_coefficients(NM, column)) * column


def standard_air() -> Layers:
    profile = load_planet("earth").constituents[0].profile
    assert isinstance(profile, Layers)
    return profile


def test_afgl_layout_of_the_standard_atmosphere_scatters_as_the_preset() -> None:
    # Both are the U.S. Standard Atmosphere, 1976; levels 1 to 5 km apart are interpolated in log.
    made = import_table("atmosphere", TABLES / "afgl-layout.dat").planet
    assert_allclose(rayleigh_depths(made), rayleigh_depths(load_planet("earth")), rtol=1e-3)


def test_ozone_column_is_that_of_the_rows() -> None:
    # Trapezoid over the raw rows of the file, read here by NumPy.
    z, _, _, _, o3, *_ = np.loadtxt(TABLES / "afgl-layout.dat").T
    raw = np.trapezoid(1e6 * o3[::-1], 1e3 * z[::-1]) / DOBSON_UNIT
    made = import_table("atmosphere", TABLES / "afgl-layout.dat").planet
    ozone = made.constituents[2].absorption
    assert isinstance(ozone, OzoneAbsorption)
    assert_allclose(ozone.column / DOBSON_UNIT, raw, rtol=1e-3)
    depth = Medium.from_planet(made, NM)  # the absorption is spread over the profile, so it is kept
    assert depth.wavelengths.size == 3


@pytest.mark.parametrize("step", [1, -1])
def test_thousands_of_noisy_rows_keep_their_column_within_the_stated_error(step: int) -> None:
    # A radiosonde's random errors, 0.15 K and 0.03 %, on the standard atmosphere, either way up.
    chance = np.random.default_rng(7)
    h = np.linspace(0.0, 32e3, 4000)
    air = standard_air().air
    temperature = air.temperature(h) + chance.normal(0.0, 0.15, h.size)
    pressure = 101325.0 * air.pressure_ratio(h) * (1 + chance.normal(0.0, 1e-5, h.size))
    rows = {
        "altitude [km]": 1e-3 * h[::step],
        "pressure [hPa]": 1e-2 * pressure[::step],
        "temperature [°C]": temperature[::step] - 273.15,
    }
    made = import_table("atmosphere", rows)
    profile = made.planet.constituents[0].profile
    assert isinstance(profile, Sounding)
    assert len(profile.temperatures) < 260
    raw = np.trapezoid(pressure / temperature, h) / (pressure[0] / temperature[0])
    stated = re.search(r"the column within ([\d.e-]+) %", " ".join(made.notes))
    assert stated is not None
    assert float(stated[1]) < 0.2
    column = profile.column(32e3) * profile.pressures[0] / profile.temperatures[0]
    raw *= pressure[0] / temperature[0]
    assert abs(column / raw - 1.0) <= 1e-2 * float(stated[1]) + 2e-5  # five digits of temperature


def test_wyoming_layout_counts_from_the_ground_and_goes_on_above() -> None:
    # Blank cells and the level below the ground are left out; the station is at 345 m, 972.5 hPa.
    made = import_table("atmosphere", TABLES / "radiosonde-layout.txt", ground_altitude="345 m")
    profile = made.planet.constituents[0].profile
    assert isinstance(profile, Sounding)
    assert profile.altitudes is not None
    assert profile.pressures is not None
    assert profile.altitudes[0] == 0.0
    assert_allclose(profile.pressures[0], 97250.0)
    assert profile.altitudes[-1] == 100e3
    # Air at rest: optical depth goes with the pressure at the ground, gravity 0.1 % less with h.
    ratio = rayleigh_depths(made.planet) / rayleigh_depths(load_planet("earth"))
    assert_allclose(ratio, 972.5 / 1013.25, rtol=2e-3)


def test_ozonesonde_in_millipascal_has_the_number_density_of_an_ideal_gas() -> None:
    # p = n k T by hand at the maximum; above the balloon the preset's ozone, scaled there.
    made = import_table("atmosphere", TABLES / "ozonesonde-layout.csv")
    lines = (TABLES / "ozonesonde-layout.csv").read_text().splitlines()
    cells = [one.split(",") for one in lines if one.count(",") == 5 and one[0].isdigit()]
    rows = np.array([[float(one[k]) for k in (2, 3, 5)] for one in cells])
    n = 1e-3 * rows[:, 0] / (BOLTZMANN * (rows[:, 1] + 273.15))
    inside = np.trapezoid(n, rows[:, 2]) / DOBSON_UNIT
    stated = re.search(r"ozone: ([\d.]+) DU in the table", " ".join(made.notes))
    assert stated is not None
    assert_allclose(float(stated[1]), inside, rtol=1e-4)
    ozone = made.planet.constituents[2].absorption
    assert isinstance(ozone, OzoneAbsorption)
    assert_allclose(ozone.column / DOBSON_UNIT, 340.4, rtol=5e-3)  # that of the whole AFGL table


def test_rounded_pressures_a_few_metres_apart_leave_a_density_that_decreases() -> None:
    # 0.1 hPa is 0.2 % of the pressure at 20 km, more than the density decreases in 10 m.
    h = np.arange(0.0, 25e3, 10.0)
    air = standard_air().air
    pressure = np.round(1013.25 * air.pressure_ratio(h), 1) - 1e-6 * np.arange(h.size)
    temperature = air.temperature(h) + np.random.default_rng(3).normal(0.0, 0.1, h.size)
    rows = {"z [m]": h, "p [hPa]": pressure, "T [K]": temperature}
    assert (np.diff(pressure / temperature) > 0.0).any()
    made = import_table("atmosphere", rows)
    stated = re.search(r"changed by up to ([\d.]+) %", " ".join(made.notes))
    assert stated is not None
    profile = made.planet.constituents[0].profile
    assert isinstance(profile, Sounding)
    assert profile.altitudes is not None
    kept = np.array(profile.altitudes) <= h[-1]
    density = (np.array(profile.pressures) / profile.temperatures)[kept]
    assert (np.diff(density) < 0.0).all()
    exact = 101325.0 * air.pressure_ratio(h) / air.temperature(h)
    assert_allclose(density, np.interp(np.array(profile.altitudes)[kept], h, exact), rtol=1e-2)
    assert 0.0 < float(stated[1]) < 1.0  # a step of 0.1 hPa at 25 km is 0.4 %


def test_pressures_alone_are_placed_by_the_hypsometric_equation() -> None:
    # The standard atmosphere's own altitudes, whose gravity falls by 0.5 % up to 16 km.
    h = np.linspace(0.0, 16e3, 60)
    air = standard_air().air
    rows = {
        "pressure [Pa]": 101325.0 * air.pressure_ratio(h),
        "temperature [K]": air.temperature(h),
    }
    profile = import_table("atmosphere", rows).planet.constituents[0].profile
    assert isinstance(profile, Sounding)
    assert profile.altitudes is not None
    below = np.array(profile.altitudes)[np.array(profile.altitudes) < 17e3]
    assert_allclose(below[-1], 16e3, rtol=4e-3)


def test_mixing_ratio_times_air_is_a_number_density() -> None:
    # 10 ppmv of air in layers of one pressure ratio.
    rows = {"z [km]": [0.0, 40.0, 60.0], "p [hPa]": [1000.0, 3.0, 0.2], "T [K]": [250.0] * 3}
    one = import_table("atmosphere", rows | {"o3 [ppmv]": [0.0, 10.0, 0.0]})
    n = 1e-5 * 300.0 / (BOLTZMANN * 250.0)
    other = import_table("atmosphere", rows | {"o3 [cm-3]": [0.0, 1e-6 * n, 0.0]})
    for made in (one, other):
        ozone = made.planet.constituents[2].absorption
        assert isinstance(ozone, OzoneAbsorption)
        assert_allclose(ozone.column, 30e3 * n, rtol=1e-5)
