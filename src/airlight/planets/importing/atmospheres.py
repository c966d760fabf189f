"""Air and ozone of a planet from a table of pressure, temperature and gases over altitude."""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import isotonic_regression

from airlight.errors import FileError, ParameterError, warn
from airlight.physics.constants import BOLTZMANN, DOBSON_UNIT
from airlight.physics.data_tables.data_table import DataColumn, DataTable, Quantity
from airlight.physics.data_tables.headings import conversion
from airlight.physics.optics.density_profile import DensitySegments
from airlight.physics.optics.hydrostatic import mass_per_length, thickness_between
from airlight.physics.spectra.ozone import COLDEST, WARMEST
from airlight.planets.importing.planet_tables import PlanetTables, numbers_text
from airlight.planets.importing.thinning import monotone, tabulated_between, thinned
from airlight.planets.matter.absorbers import OzoneAbsorption
from airlight.planets.matter.profiles import Sounding
from airlight.planets.matter.profiles.layers import Layers

if TYPE_CHECKING:
    from airlight.planets.constituent import Constituent
    from airlight.planets.planet import Planet

FloatArray = NDArray[np.float64]

ALTITUDE: Final = Quantity(
    name="altitude",
    unit="m",
    names=("z", "alt", "height", "hght", "geopotentialheight", "gpheight", "zaltitude", "h"),
    low=-1e4,
    high=1e9,
    units="km, m",
)
PRESSURE: Final = Quantity(
    name="pressure",
    unit="Pa",
    names=("p", "pres", "press", "airpressure"),
    low=0.0,
    high=1e10,
    above=True,
    units="hPa, mbar, Pa",
)
TEMPERATURE: Final = Quantity(
    name="temperature",
    unit="K",
    names=("t", "temp", "airtemperature"),
    low=1.0,
    high=1e5,
    units="K, °C",
)
AIR: Final = Quantity(
    name="air",
    unit="1/m^3",
    names=("airdensity", "airnumberdensity", "n", "numberdensity"),
    low=0.0,
    high=1e29,
    units="cm-3, m-3",
)
OZONE: Final = Quantity(
    name="ozone",
    unit="1",
    names=("o3", "xo3", "o3partialpressure", "ozonepartialpressure", "po3", "o3vmr", "ozonevmr"),
    low=0.0,
    units="cm-3, ppmv, mPa",
)
#: Units of ozone: number density, partial pressure, mole fraction.
_OZONE_UNITS: Final = ("1/m^3", "Pa", "1")
#: Numbers for what was not measured. [1]
_ABSENT: Final = (-999.0, -9999.0, -99.9, -999.9, -999.99, -9999.9, 9000.0, 99999.0)
#: Tolerances of thinning: of the logarithm of the density, and of ozone over its largest value. [1]
_TOLERANCE: Final = 2e-3
_OZONE_TOLERANCE: Final = 5e-3
#: Least decrease of the logarithm of the density from row to row. [1]
_DECREASE: Final = 1e-5
#: Difference of a column of air from p/(kT) that is warned of. [1]
_AIR_TOLERANCE: Final = 0.01
#: Share of the pressure at the lowest row below which nothing is added above the highest. [1]
_NEGLIGIBLE: Final = 1e-5
#: Steps of the rows added above the highest. [m]
_STEP: Final = 2500.0
#: Dry air of the U.S. Standard Atmosphere, 1976, Table 3.
_DRY_AIR: Final = {"N2": 0.78084, "O2": 0.209476, "Ar": 0.00934, "CO2": 0.000314}
#: Molar mass of dry air [kg mol⁻¹] and standard gravity [m s⁻²], for altitudes from pressures.
_AIR_MASS: Final = 28.9644e-3
_GRAVITY: Final = 9.80665


@dataclass(frozen=True, eq=False)
class AirLevels:
    """State of air at levels, upwards.

    Attributes
    ----------
    altitudes, pressures, temperatures : array, shape (n,)
        Altitude above the ground [m], pressure [Pa], temperature. [K]
    rows : array of int, shape (n,)
        Row of the table.
    """

    altitudes: FloatArray
    pressures: FloatArray
    temperatures: FloatArray
    rows: NDArray[np.intp]

    @property
    def densities(self) -> FloatArray:
        """Number density. [m⁻³]"""
        return self.pressures / (BOLTZMANN * self.temperatures)


def import_atmosphere(planet: PlanetTables, table: DataTable, ground_altitude: float = 0.0) -> None:
    """Replace the air of a planet, and its ozone if the table has some.

    Parameters
    ----------
    planet : PlanetTables
        Tables of the planet file, changed in place.
    table : DataTable
        Rows in either order.
    ground_altitude : float
        Altitude in the table of the planet's ground; rows below it are left out. [m]
    """
    levels = _levels(table, ground_altitude, planet)
    if levels.altitudes.size < 2:
        raise FileError(table.source, "has fewer than two rows above the ground")
    _check_air(table, levels)
    base = planet.base
    _write_air(planet, table, levels, base)
    column = table.find(OZONE)
    if column is not None:
        _write_ozone(planet, table, column, levels, base)
    known = (ALTITUDE, PRESSURE, TEMPERATURE, AIR, OZONE)
    others = [
        one.heading.name
        for one in table.columns
        if not any(quantity.names_column(one.heading) for quantity in known)
    ]
    if others:
        planet.notes.append(f"not used: {', '.join(others)}")


def _levels(table: DataTable, ground: float, planet: PlanetTables) -> AirLevels:
    """Checked rows that have pressure and temperature, upwards."""
    needed = [table.required(one) for one in (PRESSURE, TEMPERATURE)]
    table.check_lists(PRESSURE, TEMPERATURE, ALTITUDE, AIR, OZONE)
    height = table.find(ALTITUDE)
    needed += [] if height is None else [height]
    kept = ~np.any([one.missing(_ABSENT) for one in needed], axis=0)
    part = table.where(kept)
    pressure, temperature = part.numbers(PRESSURE), part.numbers(TEMPERATURE)
    rows = np.flatnonzero(kept)
    if pressure.size < 2:
        raise FileError(table.source, "has fewer than two rows with pressure and temperature")
    if height is None:
        order = np.arange(pressure.size)[:: 1 if pressure[0] >= pressure[-1] else -1]
        altitude = _hypsometric(pressure[order], temperature[order])
        planet.notes.append("altitudes follow from pressures and temperatures of dry air at rest")
    else:
        altitude = part.numbers(ALTITUDE)
        order = np.arange(altitude.size)[:: 1 if altitude[0] <= altitude[-1] else -1]
        altitude = altitude[order] - ground
    pressure, temperature, rows = pressure[order], temperature[order], rows[order]
    again = np.append(False, (np.diff(altitude) == 0.0) | (np.diff(pressure) == 0.0))
    if again.any():
        planet.notes.append(f"{again.sum()} rows at the altitude or pressure of another left out")
    altitude, pressure, temperature, rows = (
        one[~again] for one in (altitude, pressure, temperature, rows)
    )
    _check_order(table, "altitude", altitude, rows, 1.0, "m")
    _check_order(table, "pressure", pressure, rows, -1.0, "Pa")
    above = altitude >= 0.0
    below = int((~above).sum())
    if below:
        planet.notes.append(f"{below} rows below the ground left out")
    return AirLevels(altitude[above], pressure[above], temperature[above], rows[above])


def _check_order(
    table: DataTable, name: str, values: FloatArray, rows: NDArray[np.intp], sign: float, unit: str
) -> None:
    """Raise an error for the first row that turns back."""
    wrong = sign * np.diff(values) <= 0.0
    if wrong.any():
        k = int(np.argmax(wrong)) + 1
        word = "more" if sign > 0.0 else "less"
        allowed = f"{word} than the {values[k - 1]:g} {unit} of the row below: monotonic rows"
        raise ParameterError(
            f"{table.place(int(rows[k]))}, {name}", f"{values[k]:g} {unit}", allowed, table.source
        )


def _hypsometric(pressure: FloatArray, temperature: FloatArray) -> FloatArray:
    """Altitudes above the first row. [m]"""
    weight = mass_per_length(_AIR_MASS, _GRAVITY)
    steps = [
        thickness_between(weight, *pair, high / low) if high < low else 0.0
        for pair, (low, high) in zip(
            itertools.pairwise(temperature.tolist()),
            itertools.pairwise(pressure.tolist()),
            strict=True,
        )
    ]
    return np.array([0.0, *itertools.accumulate(steps)])


def _check_air(table: DataTable, levels: AirLevels) -> None:
    """Warn of a column of air that is not p/(kT)."""
    if table.find(AIR) is None:
        return
    given = table.numbers(AIR)[levels.rows]
    off = np.abs(given / levels.densities - 1.0)
    if off.max() > _AIR_TOLERANCE:
        k = int(off.argmax())
        at = f"{levels.altitudes[k] / 1e3:g} km"
        percent = f"{100.0 * off[k]:.2g} %"
        warn(f"{table.source}: air is off p/(kT) by {percent} at {at}; p/(kT) is used")


# --- air --------------------------------------------------------------------------------------


def _decreasing(levels: AirLevels) -> tuple[AirLevels, float]:
    """Levels whose density decreases upwards, and the largest relative change. [1]

    The density nearest to that of the rows in the mean square of its logarithm, by other
    temperatures: rows a few metres apart may have a density that increases by rounding alone.
    """
    least = _DECREASE * np.arange(levels.altitudes.size)
    logs = np.log(levels.densities) + least
    change = isotonic_regression(logs, increasing=False).x - logs
    if not change.any():
        return levels, 0.0
    error = float(np.abs(np.expm1(change)).max())
    return replace(levels, temperatures=levels.temperatures * np.exp(-change)), error


def _write_air(planet: PlanetTables, table: DataTable, levels: AirLevels, base: Planet) -> None:
    levels, changed = _decreasing(levels)
    if changed:
        planet.notes.append(
            f"air: densities changed by up to {percent_text(changed)} to decrease upwards"
        )
    kept, error = thinned(
        levels.altitudes, np.log(levels.densities), _TOLERANCE, interpolation=monotone
    )
    h, p, t = (one[kept] for one in (levels.altitudes, levels.pressures, levels.temperatures))
    place, name = planet.constituent_of("air", gas=True)
    added = _above(h[-1], float(p[-1]), base, name, float(p[0]))
    comments = [f"{planet.source}: {kept.size} of {levels.altitudes.size} rows"]
    if added is not None:
        h, p, t = (np.concatenate(pair) for pair in zip((h, p, t), added, strict=True))
        comments.append(f"from {added[0][0] / 1e3:.4g} km up by {base.name}")
    profile = {
        "kind": "sounding",
        "altitudes": numbers_text(h / 1e3, "km", 7),
        "pressures": numbers_text(p / 1e2, "hPa", 7),
        "temperatures": numbers_text(t, "K", 7 if changed else 5),
    }
    state = {"temperature": f"{t[0]:.5g} K", "pressure": f"{p[0] / 1e2:.6g} hPa"}
    gas = dict(place.get("gas") or {"composition": _DRY_AIR})
    for key in ("number_density", "gravity"):
        gas.pop(key, None)
    planet.matter(place, {"gas": {**gas, **state}, "profile": profile})
    planet.comment(f"{name}.profile", "; ".join(comments))
    planet.notes.append(
        f"air: {kept.size} of {levels.altitudes.size} rows kept; densities between them within"
        f" {percent_text(error)}, the column within {percent_text(_column_error(levels, kept))}"
        " of the rows' trapezoid"
    )
    if added is not None:
        share = 100.0 * levels.pressures[-1] / levels.pressures[0]
        planet.notes.append(
            f"air: the {share:.2g} % above {levels.altitudes[-1] / 1e3:.4g} km follow {base.name}"
        )


def _column_error(levels: AirLevels, kept: NDArray[np.intp]) -> float:
    """Relative difference of the column of the kept rows from the trapezoid of all. [1]"""
    h, n = levels.altitudes, levels.densities / levels.densities[0]
    profile = Sounding(
        altitudes=tuple((h - h[0])[kept]),
        pressures=tuple(levels.pressures[kept]),
        temperatures=tuple(levels.temperatures[kept]),
    )
    return abs(profile.column(float(h[-1] - h[0])) / float(np.trapezoid(n, h)) - 1.0)


def _above(
    top: float, pressure: float, base: Planet, name: str, ground: float
) -> tuple[FloatArray, FloatArray, FloatArray] | None:
    """Levels of the base planet's air above the highest row, scaled to its pressure."""
    own = next((one for one in base.constituents if one.name == name), None)
    profile = None if own is None else own.profile
    air = profile.air if isinstance(profile, (Layers, Sounding)) else None
    if pressure < _NEGLIGIBLE * ground or top + _STEP >= base.thickness:
        return None
    h = np.append(np.arange(top + _STEP, base.thickness, _STEP), base.thickness)
    if air is not None:
        ratio = air.pressure_ratio(h) / air.pressure_ratio(top)
        return h, pressure * ratio, air.temperature(h)
    if isinstance(profile, Sounding):
        assert profile.altitudes is not None
        assert profile.pressures is not None
        logs = np.interp(np.append(top, h), profile.altitudes, np.log(profile.pressures))
        warmth = np.interp(h, profile.altitudes, profile.temperatures)
        inside = h <= profile.altitudes[-1]
        if inside.any():
            return h[inside], pressure * np.exp(logs[1:] - logs[0])[inside], warmth[inside]
    return None


# --- ozone ------------------------------------------------------------------------------------


def _write_ozone(
    planet: PlanetTables, table: DataTable, column: DataColumn, levels: AirLevels, base: Planet
) -> None:
    h, n, warmth = _ozone(table, column, levels)
    if h.size < 2 or not n.max() > 0.0:
        raise FileError(table.source, "has fewer than two rows with ozone")
    within = float(np.trapezoid(n, h)) / DOBSON_UNIT
    place, name = planet.constituent_of("ozone")
    kept, error = thinned(h, n / n.max(), _OZONE_TOLERANCE, interpolation=tabulated_between)
    altitudes, densities, above = h[kept], n[kept], 0.0
    own = next((one for one in base.constituents if one.name == name), None)
    if own is not None and n[-1] > 0.01 * n.max() and h[-1] + _STEP < base.thickness:
        more = np.append(np.arange(h[-1] + _STEP, base.thickness, _STEP), base.thickness)
        rest = _ozone_above(own, float(h[-1]), float(n[-1]), more, base.thickness)
        above = float(np.trapezoid(np.append(n[-1], rest), np.append(h[-1], more))) / DOBSON_UNIT
        altitudes, densities = np.append(altitudes, more), np.append(densities, rest)
    total = within + above
    profile = {
        "kind": "tabulated",
        "altitudes": numbers_text(altitudes / 1e3, "km", 7),
        "densities": [float(f"{one:.5g}") for one in densities / n.max()],
    }
    mean = float(np.trapezoid(n * warmth, h) / np.trapezoid(n, h))
    mean = min(max(mean, COLDEST), WARMEST)
    absorption = {"ozone": f"{total:.6g} DU", "temperature": f"{mean:.4g} K"}
    planet.matter(place, {"profile": profile, "absorption": absorption})
    planet.comment(f"{name}.profile", f"{planet.source}: {kept.size} of {h.size} rows")
    line = f"ozone: {within:.5g} DU in the table, {kept.size} of {h.size} rows kept within"
    line += f" {percent_text(error)} of the largest density; cross-section at {mean:.4g} K"
    if above:
        line += f"; {above:.4g} DU above {h[-1] / 1e3:.4g} km follow {base.name}"
    planet.notes.append(line)


def _ozone_above(
    own: Constituent, top: float, density: float, altitudes: FloatArray, thickness: float
) -> FloatArray:
    """Number densities of the base planet's ozone at altitudes above a table's top [m]. [m⁻³]

    Scaled to the density at the top if that lies above the layer's maximum.
    """
    row = own.profile.row(thickness)
    fine = np.linspace(0.0, thickness, 400)
    segments = DensitySegments.from_rows([row])
    shape = segments.at(altitudes)[0]
    at_top = float(segments.at(np.array([top]))[0, 0])
    if top > fine[segments.at(fine)[0].argmax()] and at_top > 0.0:
        return np.asarray(shape * density / at_top)
    column = own.absorption.column if isinstance(own.absorption, OzoneAbsorption) else 0.0
    return np.asarray(shape * column / own.profile.column(thickness))


def _ozone(
    table: DataTable, column: DataColumn, levels: AirLevels
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Altitudes [m], number densities [m⁻³] and temperatures [K] of the rows with ozone."""
    target = next((one for one in _OZONE_UNITS if _converts(column.heading.unit, one)), "1/m^3")
    wanted = replace(OZONE, unit=target)
    part = table.where(levels.rows)
    there = ~column.missing(_ABSENT)[levels.rows]
    part = part.where(there)
    values = part.numbers(wanted)
    h, air, warmth = (
        one[there] for one in (levels.altitudes, levels.densities, levels.temperatures)
    )
    if target == "Pa":
        values = values / (BOLTZMANN * warmth)
    elif target == "1":
        values = values * air
    return h, values, warmth


def _converts(unit: str, target: str) -> bool:
    """Whether a unit is one of the kind."""
    try:
        return bool(unit) and conversion(unit, target)[0] > 0.0
    except ParameterError:
        return False


def percent_text(share: float) -> str:
    """Error in per cent, rounded up to two digits."""
    if not share > 1e-6:
        return "1e-4 %"
    digits = 10.0 ** (math.floor(math.log10(share)) - 1)
    return f"{100.0 * math.ceil(share / digits) * digits:.2g} %"
