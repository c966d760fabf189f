"""The key ``gas`` of a constituent: a mixture by composition and state."""

from __future__ import annotations

from typing import Any

from airlight.errors import ParameterError
from airlight.optics.molecules import MOLECULES
from airlight.planets.matter.gas_mixture import GasMixture
from airlight.planets.reading.toml_section import Section, suggestion

Wavelengths = tuple[float, ...] | None

#: Numbers of the table, the unit of each, and the field of ``GasMixture`` that it becomes.
_NUMBERS = (
    ("temperature", "K", "temperature"),
    ("pressure", "Pa", "pressure"),
    ("number_density", "1/m^3", "reference_density"),
    ("gravity", "m/s^2", "gravity"),
    ("refractivity_temperature", "K", "refractivity_temperature"),
    ("refractivity_pressure", "Pa", "refractivity_pressure"),
)


def read_gas(constituent: Section, wavelengths: Wavelengths) -> GasMixture:
    """A gas from the table ``gas`` of a constituent.

    Parameters
    ----------
    constituent : Section
    wavelengths : tuple of float or None
        Those that the constituent's lists belong to. [nm]
    """
    section = constituent.section("gas", "a table such as { composition = { N2 = 0.79, … }, … }")
    fields: dict[str, Any] = {"composition": _composition(section)}
    for key, unit, field in _NUMBERS:
        value = section.optional_number(key, unit)
        if value is not None:
            fields[field] = value
    for key, example in (("depolarisation", "0.035"), ("refractivity", "2.78e-4")):
        if key in section:
            fields[key] = section.spectral(key, "1", example, wavelengths)
    section.finish()
    try:
        with section.blamed():
            return GasMixture(**fields)
    except ParameterError as error:
        field = error.field.replace("reference_density", "number_density")
        raise ParameterError(field, error.value, error.allowed) from None


def _composition(section: Section) -> tuple[tuple[str, float], ...]:
    """Formula and fraction of each gas; a misspelt formula gets the nearest suggested."""
    table = section.section("composition", "a table such as { N2 = 0.79, O2 = 0.21 }")
    fractions = []
    for name in table.names:
        if name not in MOLECULES:
            allowed = suggestion(name, tuple(MOLECULES))
            raise ParameterError(f"a gas of {table.path}", name, allowed)
        fractions.append((name, table.number(name, "1", "0.79")))
    return tuple(fractions)
