"""Texts with units: the usual ones without pint, and always what pint says."""

from __future__ import annotations

import itertools

import pytest
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
