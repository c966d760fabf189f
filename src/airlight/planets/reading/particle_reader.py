"""Particles and turbidity of a constituent in a planet file."""

from __future__ import annotations

from typing import Any, Final

from airlight.errors import ParameterError
from airlight.optics.index_table import index_names
from airlight.planets.matter.particle_index import GivenIndex, MixedIndex, ParticleIndex, TableIndex
from airlight.planets.matter.particle_sizes import (
    GammaSizes,
    LogNormalSizes,
    ParticleSizes,
    SingleSize,
)
from airlight.planets.matter.particles import Particles
from airlight.planets.matter.turbidity import LiteralTurbidity, Turbidity
from airlight.planets.parameters import MISSING
from airlight.planets.reading.toml_section import Section

Wavelengths = tuple[float, ...] | None

_METHODS: Final = ("mie", "anomalous-diffraction")


def read_particles(constituent: Section, wavelengths: Wavelengths) -> Particles:
    """Particles from the table ``particles`` of a constituent.

    Parameters
    ----------
    constituent : Section
    wavelengths : tuple of float or None
        Those that the constituent's lists belong to. [nm]
    """
    section = constituent.section("particles", "a table such as { index = 'water', … }")
    values: dict[str, Any] = {
        "index": _index(section, "index", wavelengths),
        "sizes": _sizes(section.section("sizes", "a table such as { kind = 'gamma', … }")),
        "optical_depth": section.optional_number("optical_depth", "1"),
        "number_density": section.optional_number("number_density", "1/m^3"),
    }
    if "method" in section:
        values["method"] = section.choice("method", _METHODS)
    if "at" in section:
        values["at"] = section.number("at", "nm", "550 nm")
    section.finish()
    with section.blamed():
        particles = Particles(**values)
    if particles.method != "mie":
        _need_phase(constituent, "anomalous diffraction")
    return particles


def _need_phase(constituent: Section, what: str) -> None:
    if "phase_function" not in constituent:
        raise ParameterError(
            constituent.name_of("phase_function"), MISSING, f"one, since {what} has none of its own"
        )


def _index(section: Section, key: str, wavelengths: Wavelengths) -> ParticleIndex:
    value = section.required(key, "the name of a table, or a table such as { real = 1.5, … }")
    if isinstance(value, str):
        name = value if value in index_names() else str(section.beside(value))
        with section.blamed():
            return TableIndex(table=name if name.endswith(".csv") else value)
    part = section.section(key, "the name of a table, or a table such as { real = 1.5, … }")
    if "matrix" in part:
        matrix = _index(part, "matrix", wavelengths)
        inclusions = _index(part, "inclusions", wavelengths)
        fraction = part.number("fraction", "1", "0.02")
        part.finish()
        with part.blamed():
            return MixedIndex(matrix=matrix, inclusions=inclusions, fraction=fraction)  # type: ignore[arg-type]
    given = {"real": part.spectral("real", "1", "1.52", wavelengths)}
    if "imaginary" in part:
        given["imaginary"] = part.spectral("imaginary", "1", "0.006", wavelengths)
    part.finish()
    with part.blamed():
        return GivenIndex(**given)


def _sizes(section: Section) -> ParticleSizes:
    kind = section.choice("kind", ("gamma", "log-normal", "single"))
    if kind == "gamma":
        radius = section.number("effective_radius", "m", "1.6 um")
        variance = section.number("effective_variance", "1", "0.3")
        section.finish()
        with section.blamed():
            return GammaSizes(effective_radius=radius, effective_variance=variance)
    if kind == "log-normal":
        radius = section.number("median_radius", "m", "0.5 um")
        deviation = section.number("geometric_deviation", "1", "1.6")
        section.finish()
        with section.blamed():
            return LogNormalSizes(median_radius=radius, geometric_deviation=deviation)
    radius = section.number("radius", "m", "1.6 um")
    section.finish()
    with section.blamed():
        return SingleSize(radius=radius)


def read_turbidity(constituent: Section, wavelengths: Wavelengths) -> Turbidity:
    """A haze from the table ``turbidity`` of a constituent; no lists, so no wavelengths."""
    section = constituent.section("turbidity", "a table such as { optical_depth = 0.1, … }")
    keys = (
        "turbidity",
        "rayleigh_optical_depth",
        "optical_depth",
        "junge",
        "angstrom",
        "single_scattering_albedo",
    )
    values = {key: section.optional_number(key, "1") for key in keys}
    section.finish()
    _need_phase(constituent, "turbidity")
    with section.blamed():
        return Turbidity(**{key: value for key, value in values.items() if value is not None})


def read_literal_turbidity(constituent: Section, wavelengths: Wavelengths) -> LiteralTurbidity:
    """OpenSpace's haze from the table ``turbidity_literal``; no lists, so no wavelengths."""
    section = constituent.section("turbidity_literal", "a table such as { turbidity = 2 }")
    turbidity = section.number("turbidity", "1", "2")
    junge = section.optional_number("junge", "1")
    section.finish()
    _need_phase(constituent, "turbidity")
    with section.blamed():
        return LiteralTurbidity(turbidity=turbidity, **({} if junge is None else {"junge": junge}))
