"""The key ``absorption`` of a constituent: a coefficient, a gas that absorbs, tiny particles."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.optics.gas_absorption import column_from_dobson
from airlight.planets.matter.absorbers import (
    CrossSectionAbsorption,
    OzoneAbsorption,
    SmallParticleAbsorption,
)
from airlight.planets.matter.matter import Absorber
from airlight.planets.reading.toml_section import Section, spectral_of, suggestion
from airlight.planets.spectral import PerWavelength, Spectral
from airlight.units import quantity

Wavelengths = tuple[float, ...] | None
Absorption = Spectral | Absorber


def read_absorption(section: Section, wavelengths: Wavelengths) -> Absorption:
    """Absorption of a constituent, 0 if none is given.

    Parameters
    ----------
    section : Section
        The constituent's table.
    wavelengths : tuple of float or None
        Those that its lists belong to. [nm]

    Returns
    -------
    float, PerWavelength or Absorber
        As ``Constituent`` takes it. [m⁻¹]
    """
    if "absorption" not in section:
        return 0.0
    if not isinstance(section.raw("absorption"), dict):
        return section.spectral("absorption", "1/m", "0.65e-6 /m", wavelengths)
    table = section.section("absorption", "a coefficient or a table such as { ozone = '345 DU' }")
    for key, read in _KINDS.items():
        if key in table:
            absorber = read(table, wavelengths)
            table.finish()
            with table.blamed():
                return absorber()
    raise ParameterError(f"a key of {table.path}", ", ".join(table.names)[:60], ", ".join(_KINDS))


def _ozone(table: Section, wavelengths: Wavelengths) -> Callable[[], Absorber]:
    column = _column(table, "ozone")
    return lambda: OzoneAbsorption(column=column)


def _cross_section(table: Section, wavelengths: Wavelengths) -> Callable[[], Absorber]:
    values: dict[str, Any] = {"cross_section": _cross_section_values(table, wavelengths)}
    if "column" in table:
        values["column"] = _column(table, "column")
    for key, unit in (("number_density", "1/m^3"), ("fraction", "1")):
        if key in table:
            values[key] = table.number(key, unit, "1")
    return lambda: CrossSectionAbsorption(**values)


def _cross_section_values(table: Section, wavelengths: Wavelengths) -> Any:
    """The name of a table, or the numbers of a file or a list. [m²]"""
    allowed = "a table's name, a path to a CSV file, or such as '1.4e-21 cm^2'"
    value = table.required("cross_section", allowed)
    field = table.name_of("cross_section")
    if not isinstance(value, str):
        return spectral_of(value, "m^2", field, wavelengths)
    from airlight.spectra.tables import spectrum_names

    if value in spectrum_names():
        return value
    if value.endswith(".csv"):
        return _from_file(table, value, field)
    if value[:1].isalpha():
        raise ParameterError(field, value, suggestion(value, spectrum_names()))
    return spectral_of(value, "m^2", field, wavelengths)


def _from_file(table: Section, name: str, field: str) -> PerWavelength:
    from airlight.spectra.tables import read_spectrum_file

    spectrum = read_spectrum_file(table.beside(name))
    unit = quantity(f"1 {spectrum.unit}", "m^2", f"unit of {field}")
    if spectrum.values.ndim != 1:
        raise ParameterError(field, spectrum.columns, "a table with one column of values")
    with table.blamed():
        return PerWavelength(
            wavelengths=tuple(spectrum.wavelengths.tolist()),
            values=tuple((unit * spectrum.values).tolist()),
        )


def _small_particles(table: Section, wavelengths: Wavelengths) -> Callable[[], Absorber]:
    particles = table.section("small_particles", "a table with radius, number_density and index")
    radius = particles.number("radius", "m", "10 nm")
    number_density = particles.number("number_density", "1/m^3", "1e9 /m^3")
    index = particles.section("index", "a table such as { real = 1.5, imaginary = 0.1 }")
    parts = {key: index.spectral(key, "1", "1.5", wavelengths) for key in ("real", "imaginary")}
    index.finish()
    particles.finish()

    def absorber() -> Absorber:
        with particles.blamed():
            return SmallParticleAbsorption(radius=radius, number_density=number_density, **parts)

    return absorber


#: By the key that tells them apart.
_KINDS: Final[dict[str, Callable[[Section, Wavelengths], Callable[[], Absorber]]]] = {
    "ozone": _ozone,
    "cross_section": _cross_section,
    "small_particles": _small_particles,
}


def _column(table: Section, key: str) -> float:
    return column_of_gas(table.required(key, "a column such as '345 DU'"), table.name_of(key))


def column_of_gas(value: Any, field: str) -> float:
    """Molecules above an area, from a text such as ``345 DU`` or ``9.3e22 /m^2``. [m⁻²]

    Examples
    --------
    >>> f"{column_of_gas('345 DU', 'ozone'):.3e}"
    '9.269e+22'
    """
    if isinstance(value, str) and (match := re.fullmatch(r"\s*(\S{1,40}?)\s*DU\s*", value)):
        return column_from_dobson(quantity(match[1], "1", field))
    return quantity(value, "1/m^2", field)
