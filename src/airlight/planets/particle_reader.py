"""Particles and turbidity of a constituent in a planet file."""

from __future__ import annotations

from typing import Any, Final

from airlight.errors import ParameterError
from airlight.optics.index_table import index_names
from airlight.planets.matter import Matter
from airlight.planets.parameters import MISSING
from airlight.planets.particle_index import GivenIndex, MixedIndex, ParticleIndex, TableIndex
from airlight.planets.particle_sizes import GammaSizes, LogNormalSizes, ParticleSizes, SingleSize
from airlight.planets.particles import Particles
from airlight.planets.toml_section import Section
from airlight.planets.turbidity import LiteralTurbidity, Turbidity

Wavelengths = tuple[float, ...] | None

_METHODS: Final = ("mie", "anomalous-diffraction")
#: The keys of a constituent that say what scatters; one at most.
PARTICLE_KEYS: Final = ("particles", "turbidity", "turbidity_literal")


def read_particle_matter(section: Section, wavelengths: Wavelengths) -> Matter | None:
    """The particles of a constituent, or None if it has no key for any.

    Parameters
    ----------
    section : Section
        The constituent's table.
    wavelengths : tuple of float or None
        Those that its lists belong to. [nm]
    """
    given = [key for key in PARTICLE_KEYS if key in section]
    if not given:
        return None
    if len(given) > 1:
        raise ParameterError(section.name_of(given[1]), "given", f"none beside {given[0]}")
    part = section.section(given[0], f"a table [{given[0]}]")
    has_phase = "phase_function" in section
    if given[0] == "particles":
        particles = _particles(part, wavelengths)
        if particles.method != "mie" and not has_phase:
            raise ParameterError(
                section.name_of("phase_function"),
                MISSING,
                "one, since anomalous diffraction has none of its own",
            )
        return particles
    if not has_phase:
        raise ParameterError(
            section.name_of("phase_function"), MISSING, "one, since turbidity has none of its own"
        )
    return _turbidity(part) if given[0] == "turbidity" else _literal(part)


def _particles(section: Section, wavelengths: Wavelengths) -> Particles:
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
        return Particles(**values)


def _index(section: Section, key: str, wavelengths: Wavelengths) -> ParticleIndex:
    value = section.required(key, "the name of a table, or a table such as { real = 1.5, … }")
    if isinstance(value, str):
        name = value if value in index_names() else str(section.folder / value)
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


def _turbidity(section: Section) -> Turbidity:
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
    with section.blamed():
        return Turbidity(**{key: value for key, value in values.items() if value is not None})


def _literal(section: Section) -> LiteralTurbidity:
    turbidity = section.number("turbidity", "1", "2")
    junge = section.optional_number("junge", "1")
    section.finish()
    with section.blamed():
        return LiteralTurbidity(turbidity=turbidity, **({} if junge is None else {"junge": junge}))
