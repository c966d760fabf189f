"""Free parameters of a planet: numbers of its file, optical depths, columns and albedo.

``NAME.optical_depth``, ``NAME.angstrom`` and ``NAME.column`` of a constituent, and
``ground.albedo``, do not depend on the form in the file.
"""

from __future__ import annotations

import difflib
import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.physics.spectra.power_law import power_law
from airlight.physics.units import quantities
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.planets.reading.declared_keys import key_at
from airlight.planets.reading.nested_tables import Tables, get, joined, put
from airlight.planets.reading.shell_edit import BOTTOM, lifted
from airlight.planets.schema.field import Field
from airlight.planets.schema.measures import number_in, text_of
from airlight.studies.fit.angstrom import COEFFICIENTS, angstrom_refused, exponent_of, tilted
from airlight.studies.fit.parameter import FitParameter

FloatArray = NDArray[np.float64]
#: Function that puts a value of the parameter into the tables.
Write = Callable[[Tables, float], Tables]

#: Wavelength of optical depths and of the ground's albedo. [nm]
AT: Final = 550.0
#: Columns of ozone on Earth: 73 DU in the hole of 1994 (NASA Ozone Watch), 600 in spring. [DU]
EARTH_OZONE: Final = (50.0, 700.0)
#: Largest optical depth: that of the densest smoke and the thickest dust cloud. [1]
_DEEPEST: Final = 30.0
#: Range of exponents: negative for coarse dust, 4 for molecules. [1]
_EXPONENTS: Final = (-2.0, 4.5)


@dataclass(frozen=True, kw_only=True)
class FreeParameter:
    """Free parameter and how its value enters the planet's tables.

    Attributes
    ----------
    parameter : FitParameter
    write : callable
        ``write(tables, value)``: copy of the tables with that value.
    order : int
        Order of writing, ascending.
    """

    parameter: FitParameter
    write: Write
    order: int = 1


def free_parameter(
    name: str, tables: Tables, planet: Planet, wavelengths: FloatArray
) -> FreeParameter:
    """Free parameter by its name.

    Parameters
    ----------
    name : str
        ``aerosol.optical_depth`` (at 550 nm), ``aerosol.angstrom`` (exponent from 440 to 870 nm),
        ``ozone.column``, ``ground.albedo`` (at 550 nm), or the path of any number of the file:
        ``aerosol.profile.scale_height``.
    tables : dict
        Tables of the planet's file, from ``spelled_out``.
    planet : Planet
        Planet of these tables.
    wavelengths : array, shape (nl,)
        Wavelengths of the data, for new spectral lists. [nm]
    """
    if name == "ground.albedo":
        return _albedo(name, tables, planet)
    index, rest = _constituent(tables, name)
    if index is not None and rest == "optical_depth":
        return _depth(name, tables, planet, index)
    if index is not None and rest == "angstrom":
        return _angstrom(name, tables, planet, index, wavelengths)
    if index is not None and rest == "column":
        path = _column_path(tables, index)
        if path is not None:
            found = _number(name, path, tables)
            ozone = planet.body == "earth" and path.endswith(".ozone")
            return _within(found, EARTH_OZONE) if ozone else found
    path = name if index is None else joined(f"constituents[{index}]", rest)
    if not rest and index is not None:
        raise _unknown(name, tables)
    try:
        key = key_at(tables, path)
    except ParameterError:
        raise _unknown(name, tables) from None
    if key.kind != "number" or isinstance(get(tables, path), dict):
        raise _unknown(name, tables)
    if isinstance(get(tables, path), list):
        first = joined(name, 0)
        raise ParameterError("free", name, f"a number, not a list: an item such as {first}")
    return _number(name, path, tables)


def free_names(tables: Tables) -> list[str]:
    """Names for ``free_parameter`` of a planet."""
    found = ["ground.albedo"]
    for one in tables.get("constituents", []):
        found += [f"{one.get('name')}.{rest}" for rest in ("optical_depth", "angstrom", "column")]
    return [*found, *(name for name in _numbers(tables) if name not in found)]


def _unknown(name: str, tables: Tables) -> ParameterError:
    known = free_names(tables)
    near = difflib.get_close_matches(name[:100], known, n=3, cutoff=0.5)
    allowed = " or ".join(map(repr, near)) if near else ", ".join(known[:12])
    return ParameterError("free", name, f"the path of a number, such as {allowed}")


def _numbers(tables: Tables) -> Iterator[str]:
    """Paths of all numbers of a file, constituents by name."""
    for key, value in tables.items():
        if key == "constituents":
            for i, one in enumerate(value):
                inside = _below(f"constituents[{i}]", one, tables)
                start = f"constituents[{i}]"
                yield from (f"{one.get('name')}{path[len(start) :]}" for path in inside)
        else:
            yield from _below(key, value, tables)


def _below(path: str, value: Any, tables: Tables) -> Iterator[str]:
    if isinstance(value, dict):
        for key, item in value.items():
            yield from _below(joined(path, key), item, tables)
    elif isinstance(value, list):
        for k, item in enumerate(value):
            yield from _below(joined(path, k), item, tables)
    elif isinstance(value, (int, float, str)) and not isinstance(value, bool):
        try:
            _number(path, path, tables)
        except ParameterError:
            return
        yield path


def _constituent(tables: Tables, name: str) -> tuple[int | None, str]:
    """Index of the constituent that a name begins with, and the rest of the name."""
    listed = tables.get("constituents", [])
    longest = sorted(enumerate(listed), key=lambda one: -len(str(one[1].get("name", ""))))
    for index, one in longest:
        own = str(one.get("name", ""))
        if (own and name.startswith((f"{own}.", f"{own}["))) or (own and name == own):
            return index, name[len(own) :].removeprefix(".")
    return None, name


def _number(name: str, path: str, tables: Tables) -> FreeParameter:
    """Parameter that is a number of the file, with its declared range."""
    key = key_at(tables, path)
    if key.kind != "number":
        raise ParameterError("free", name, "the path of a number")
    given = get(tables, path)
    if given is None:
        given = key.left_out
    if given is None:
        raise ParameterError("free", name, "a number in the planet's file")
    start = number_in(given, key.shown_unit, key.unit, path)
    low, high = _limits(key, start)
    unit, step = key.shown_unit, _least_step(key, start)
    parameter = FitParameter(name=name, unit=unit, start=start, low=low, high=high, least_step=step)

    def write(tables: Tables, value: float) -> Tables:
        changed = put(tables, path, text_of(value, unit))
        return lifted(changed, tables) if path == BOTTOM else changed

    return FreeParameter(parameter=parameter, write=write)


def _within(found: FreeParameter, limits: tuple[float, float]) -> FreeParameter:
    """Parameter with narrower bounds, widened to its start."""
    one = found.parameter
    low, high = min(limits[0], one.start), max(limits[1], one.start)
    return replace(found, parameter=replace(one, low=max(low, one.low), high=min(high, one.high)))


def _limits(key: Field, start: float) -> tuple[float, float]:
    low, high = key.limits
    reach = 1e3 * max(abs(start), 1e-6)
    low = low if math.isfinite(low) else start - reach
    high = high if math.isfinite(high) else start + reach
    inside = 1e-6 * (high - low) if key.open_ends else 0.0
    return min(low + inside, start), max(high - inside, start)


def _least_step(key: Field, start: float) -> float:
    low, high = key.ends
    if key.scale == "log" or not math.isfinite(high - low):
        return 5e-3 * abs(start) if start else 1e-3 * (low if math.isfinite(low) and low else 1.0)
    step = 2e-3 * (high - low)
    return min(step, 0.05 * abs(start)) if start else step


# --- what one says of air and ground ----------------------------------------------------------


def _depth(name: str, tables: Tables, planet: Planet, index: int) -> FreeParameter:
    """Vertical optical depth of a constituent at 550 nm."""
    start = _depth_at(planet, index, AT)
    if not start > 0.0:
        raise ParameterError("free", name, "a constituent that has an optical depth at 550 nm")
    path = f"constituents[{index}]"
    amount = _plain(tables, f"{path}.amount", 1.0)
    given = {key: get(tables, f"{path}.{key}") for key in COEFFICIENTS}
    given = {key: one for key, one in given.items() if one is not None}
    by_amount = not given or any(isinstance(one, dict) for one in given.values())
    high = min(_DEEPEST, 100.0 * start / amount) if by_amount else _DEEPEST
    parameter = FitParameter(
        name=name, start=start, low=0.0, high=high, least_step=min(0.002, 0.05 * start)
    )

    def write(tables: Tables, value: float) -> Tables:
        if by_amount:
            return put(tables, f"{path}.amount", amount * value / start)
        share = value / start
        if "optical_depth" in given:
            share = value / (amount * value_at(tables, path, "optical_depth", AT))
        for key in given:
            listed = get(tables, f"{path}.{key}")
            tables = put(tables, f"{path}.{key}", _times(listed, share, COEFFICIENTS[key]))
        return tables

    return FreeParameter(parameter=parameter, write=write)


def _depth_at(planet: Planet, index: int, nm: float) -> float:
    low, high = planet.wavelength_limits
    medium = Medium.from_planet(planet, [min(max(nm, low), high)])
    return float(medium.vertical_optical_depth[index, 0])


def _angstrom(
    name: str, tables: Tables, planet: Planet, index: int, wavelengths: FloatArray
) -> FreeParameter:
    """Ångström exponent of a constituent's optical depth."""
    refused = angstrom_refused(tables["constituents"][index])
    if refused:
        raise ParameterError("free", name, refused)
    start = exponent_of(planet, index)
    low, high = _EXPONENTS
    parameter = FitParameter(
        name=name, start=start, low=min(low, start), high=max(high, start), least_step=0.05
    )
    path = f"constituents[{index}]"
    limits = planet.wavelength_limits

    def write(tables: Tables, value: float) -> Tables:
        table = tilted(get(tables, path), value - start, wavelengths, limits)
        return put(tables, path, table)

    return FreeParameter(parameter=parameter, write=write, order=0)


def _column_path(tables: Tables, index: int) -> str | None:
    """Path of the column of a constituent's gas."""
    for path in (f"constituents[{index}].absorption.{key}" for key in ("ozone", "column")):
        if get(tables, path) is not None:
            return path
    return None


def _albedo(name: str, tables: Tables, planet: Planet) -> FreeParameter:
    """Albedo of the ground at 550 nm; a list or a table is scaled."""
    given = get(tables, name)
    if isinstance(given, (int, float)) or (
        isinstance(given, str) and not given[:1].isalpha() and "," not in given
    ):
        brightness = _plain(tables, "ground.brightness", 1.0)
        if brightness == 1.0:
            return _number(name, name, tables)
    low, high = planet.wavelength_limits
    start = float(planet.ground.albedos([min(max(AT, low), high)])[0])
    if not start > 0.0:
        raise ParameterError("free", name, "a ground that reflects at 550 nm")
    brightness = _plain(tables, "ground.brightness", 1.0)
    high = min(1.0, 100.0 * start / brightness)
    parameter = FitParameter(name=name, start=start, low=0.0, high=high, least_step=0.005)

    def write(tables: Tables, value: float) -> Tables:
        return put(tables, "ground.brightness", brightness * value / start)

    return FreeParameter(parameter=parameter, write=write)


def _plain(tables: Tables, path: str, default: float) -> float:
    given = get(tables, path)
    return default if given is None else number_in(given, "1", "1", path)


def _times(listed: Any, share: float, unit: str) -> Any:
    numbers = quantities(listed, unit, "value")
    found = [text_of(one * share, unit.removeprefix("1") or "1") for one in numbers]
    return found if isinstance(listed, list) else found[0]


def value_at(tables: Mapping[str, Any], path: str, key: str, nm: float) -> float:
    """Value of a positive spectrum, one or a list, at a wavelength, see ``spectra.power_law``."""
    given = get(dict(tables), f"{path}.{key}")
    values = quantities(given, "1", key)
    if len(values) == 1:
        return values[0]
    at = quantities(get(dict(tables), f"{path}.wavelengths"), "nm", "wavelengths")
    return float(power_law(nm, at, values))
