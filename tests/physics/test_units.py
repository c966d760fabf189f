"""Texts with units: the usual ones without pint, and always what pint says; quantities."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pint
import pytest
import xarray
from numpy.testing import assert_allclose

from airlight import units
from airlight.errors import ParameterError

GIVEN = [
    "m", "km", "cm", "mm", "um", "µm", "μm", "nm", "au", "rad", "deg", "K", "Pa", "hPa", "bar",
    "mbar", "/m", "/km", "1/m", "1 / m", "/cm^3", "1/m^3", "m^2", "cm**2", "m^-1", "g/mol",
    "kg/m^3", "m/s^2", "m s^-2", "W/m^2/nm", "W/m^2 nm", "W m^-2 nm^-1", "W*m**-2/um",
    "kg m^-1 s^-2", "K/km", "/m km", "m^2 /g",
]  # fmt: skip
ASKED = ["m", "1/m", "deg", "1", "nm", "1/m^3", "m^2", "1/m^2", "kg/mol", "kg/m^3", "K", "Pa",
         "W/m^2/nm", "m/s^2"]  # fmt: skip


def by_pint(given: str, asked: str) -> float | None:
    """What pint makes of it, None where it refuses."""
    registry = units._registry()
    source = registry.parse_expression("1" + given if given.startswith("/") else given)
    target = registry.parse_expression({"deg": "degree", "nm": "nanometer"}.get(asked, asked))
    try:
        return float((source / target).to("dimensionless").magnitude)
    except Exception:
        return None


def test_usual_units_are_pints() -> None:
    # A second method, with every pair that fits and every pair that does not.
    met = 0
    for given, asked in itertools.product(GIVEN, ASKED):
        expected = by_pint(given, asked)
        usual, target = units._usual(given), units._usual(asked)
        assert usual is not None
        assert target is not None
        if expected is None:
            assert usual[1] != target[1]
            with pytest.raises(ParameterError):
                units.quantity(f"2 {given}", asked)
        else:
            assert_allclose(units.quantity(f"2 {given}", asked), 2.0 * expected, rtol=1e-15)
            met += 1
    assert met == 46


@pytest.mark.parametrize(("text", "metres"), [("2 mile", 3218.688), ("1 Å", 1e-10), ("3 dm", 0.3)])
def test_other_units_are_read_by_pint(text: str, metres: float) -> None:
    # definitions of the units
    assert units._usual(text[2:]) is None
    assert_allclose(units.quantity(text, "m"), metres, rtol=1e-14)


@pytest.mark.parametrize("text", ["2 m2", "2 m-1", "2 m^", "2 mm/", "2 metre per s", "2 kmm"])
def test_what_pint_refuses_as_a_length_is_refused(text: str) -> None:
    with pytest.raises(ParameterError):
        units.quantity(text, "m")


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("1.5 R_earth", "the unit 'R_earth' is not known"),
        ("1.5 parsnip", "the unit 'parsnip' is not known"),
        ("5 kg", "'kg' is a unit of something else"),
    ],
)
def test_a_unit_that_is_not_known_or_of_something_else_is_named(text: str, words: str) -> None:
    with pytest.raises(ParameterError) as caught:
        units.quantity(text, "m", "radius")
    assert words in str(caught.value)
    assert "with a unit such as 'm'" in str(caught.value)


@pytest.mark.parametrize("number", [5, 5.0, "5", "-1e3", 1e-300])
def test_a_number_without_a_unit_is_refused_where_there_is_a_unit(number: float | str) -> None:
    with pytest.raises(ParameterError, match="a number with its unit, such as"):
        units.quantity(number, "Pa", "pressure")
    assert units.quantity(number, "1") == float(number)
    assert units.quantity(number, "Pa", bare=True) == float(number)


def test_zero_needs_no_unit() -> None:
    assert units.quantities([0, "0", "0.0", "5 km"], "m") == [0.0, 0.0, 0.0, 5000.0]


# --- quantities and labelled arrays -----------------------------------------------------------


class Astropy:
    """Quantity with the interface of astropy's: ``unit``, ``value``, ``to``."""

    def __init__(self, value: Any, unit: str) -> None:
        self.value, self.unit = value, unit

    def to(self, unit: str) -> Astropy:
        factors = {("km", "m"): 1e3, ("Angstrom", "nm"): 0.1, ("rad", "deg"): 180.0 / math.pi}
        if (self.unit, unit) not in factors:
            raise TypeError(f"{self.unit!r} and {unit!r} are not convertible")
        return Astropy(np.multiply(self.value, factors[self.unit, unit]), unit)

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        return np.asarray(self.value, dtype)  # the unit is lost here, without a warning


class Unyt(np.ndarray):
    """Array with the interface of unyt's: NumPy's with ``units``, ``value`` and ``to``."""

    units: str

    @classmethod
    def of(cls, value: Any, units: str) -> Unyt:
        made = np.asarray(value, float).view(cls)
        made.units = units
        return made

    @property
    def value(self) -> Any:
        return self.view(np.ndarray)

    def to(self, units: str) -> Unyt:
        return Unyt.of(Astropy(self.view(np.ndarray), self.units).to(units).value, units)


def astropy_quantity(value: Any, unit: str) -> Any:
    return pytest.importorskip("astropy.units").Quantity(value, unit)


def unyt_quantity(value: Any, unit: str) -> Any:
    return pytest.importorskip("unyt").unyt_array(value, {"Angstrom": "angstrom"}.get(unit, unit))


def pint_quantity(value: Any, unit: str) -> Any:
    return pint.UnitRegistry().Quantity(value, {"Angstrom": "angstrom"}.get(unit, unit))


MAKERS = [pint_quantity, Astropy, Unyt.of, astropy_quantity, unyt_quantity]
#: Definitions: a kilometre, an ångström, and 180° to π.
CONVERSIONS = [
    (400.0, "km", "m", 4e5),
    ([5500.0, 6000.0], "Angstrom", "nm", [550.0, 600.0]),
    (math.pi / 3.0, "rad", "deg", 60.0),
    ([[0.0], [math.pi]], "rad", "deg", [[0.0], [180.0]]),
]


@pytest.mark.filterwarnings("ignore")
@pytest.mark.parametrize("maker", MAKERS)
@pytest.mark.parametrize(("value", "unit", "asked", "expected"), CONVERSIONS)
def test_quantities_of_every_package_are_converted(
    maker: Any, value: Any, unit: str, asked: str, expected: Any
) -> None:
    found = units.values_in(maker(value, unit), asked, "x")
    assert type(found) is np.ndarray
    assert_allclose(found, expected, rtol=1e-14)


@pytest.mark.parametrize("maker", MAKERS)
@pytest.mark.parametrize(("unit", "asked"), [("km", "deg"), ("rad", "m"), ("Angstrom", "1/m")])
def test_a_quantity_of_another_dimension_is_refused_in_one_line(
    maker: Any, unit: str, asked: str
) -> None:
    for value in (1.0, [1.0, 2.0]):
        with pytest.raises(ParameterError, match="is a unit of something else") as caught:
            units.values_in(maker(value, unit), asked, "altitude")
        assert str(caught.value).startswith("altitude is ")
        assert "\n" not in str(caught.value)


def test_wavenumbers_energies_and_frequencies_are_no_wavelengths() -> None:
    # they are not proportional to a wavelength, and a list of them is in another order
    registry = pint.UnitRegistry()
    for unit in ("1/cm", "eV", "THz"):
        for value in (registry.Quantity([18000.0], unit), f"2 {unit}"):
            with pytest.raises(ParameterError, match=r"wavelengths is .* something else"):
                units.values_in(value, "nm", "wavelengths")


def test_a_quantity_without_dimension_is_no_angle_but_a_number() -> None:
    # 60 may mean degrees or radians; an albedo of 0.3 has one meaning
    plain = pint.UnitRegistry().Quantity(60.0, "")
    with pytest.raises(ParameterError, match="not a unit of an angle"):
        units.values_in(plain, "deg", "azimuth")
    assert units.values_in(plain, "1") == 60.0


def test_a_temperature_in_celsius_is_converted_with_its_offset() -> None:
    # definition: 0 °C is 273.15 K
    celsius = pint.UnitRegistry().Quantity(15.0, "degC")
    assert_allclose(units.quantity(celsius, "K"), 288.15, rtol=1e-15)


@pytest.mark.parametrize(
    ("given", "asked", "factor"),
    [
        ("km", "m", 1e3),
        ("degrees_north", "deg", 1.0),
        ("degree", "deg", 1.0),
        ("radians", "deg", 180.0 / math.pi),
        ("W m-2 um-1", "W/m^2/nm", 1e-3),
        ("micrometer", "nm", 1e3),
        ("1", "1", 1.0),
        (None, "m", 1.0),
        ("", "m", 1.0),
    ],
)
def test_the_attribute_units_of_a_labelled_array_counts(
    given: str | None, asked: str, factor: float
) -> None:
    # definitions, with the spellings of the CF conventions
    attributes = {} if given is None else {"units": given}
    array = xarray.DataArray([1.0, 2.5], dims="x", attrs=attributes)
    assert_allclose(units.values_in(array, asked), factor * array.values, rtol=1e-14)


def test_a_labelled_array_of_something_else_is_refused() -> None:
    array = xarray.DataArray([1.0], dims="x", attrs={"units": "s"})
    with pytest.raises(ParameterError, match=r"units of altitude is '1 s'; .*something else"):
        units.values_in(array, "m", "altitude")


def test_lists_may_mix_numbers_texts_and_quantities() -> None:
    found = units.values_in([1.0, "2 km", Astropy(3.0, "km"), np.float32(4.0)], "m")
    assert_allclose(found, [1.0, 2000.0, 3000.0, 4.0], rtol=1e-15)
    objects = np.array([Astropy(3.0, "km"), 5], dtype=object)
    assert_allclose(units.values_in(objects, "m"), [3000.0, 5.0], rtol=1e-15)


@pytest.mark.parametrize(
    ("text", "unit", "expected"),
    [
        ("0:80:40", "deg", [0.0, 40.0, 80.0]),
        ("0:1:0.5 rad", "deg", [0.0, 90.0 / math.pi, 180.0 / math.pi]),
        ("0.4:0.6:0.1 um", "nm", [400.0, 500.0, 600.0]),
        ("1, 2.5 km", "m", [1000.0, 2500.0]),
    ],
)
def test_ranges_and_lists_are_read_from_text(text: str, unit: str, expected: list[float]) -> None:
    assert_allclose(units.values_in(text, unit), expected, rtol=1e-11)


@pytest.mark.parametrize(
    "value",
    [True, [True], np.array([True]), None, {}, "far", "60", [1.0, [2.0]], 1j, 10**400,
     np.timedelta64(5, "s"), b"5 m"],
)  # fmt: skip
def test_what_is_no_number_is_refused(value: Any) -> None:
    with pytest.raises(ParameterError, match=r"^height is "):
        units.values_in(value, "m", "height")


def test_plain_arrays_keep_shape_and_values() -> None:
    for value in (3, 3.5, [[1, 2], [3, 4]], range(4), np.arange(4, dtype=np.int16), []):
        assert_allclose(units.values_in(value, "m"), np.asarray(value, float), rtol=0)


def test_a_variable_of_xarray_has_units_too() -> None:
    # as a labelled array, without coordinates
    variable = xarray.Variable("x", [1.0, 2.0], {"units": "km"})
    assert_allclose(units.values_in(variable, "m"), [1000.0, 2000.0], rtol=0)
