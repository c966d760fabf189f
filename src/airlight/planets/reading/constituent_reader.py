"""Reader of a ``[[constituents]]`` table: profile, coefficients, phase function."""

from __future__ import annotations

from airlight.errors import ConflictError
from airlight.planets.constituent import Constituent
from airlight.planets.matter.matter import Matter
from airlight.planets.matter.phases import PHASES
from airlight.planets.matter.profiles import PROFILES, Exponential, Profile
from airlight.planets.reading.coefficient_reader import (
    COEFFICIENTS,
    read_absorption,
    read_coefficients,
)
from airlight.planets.reading.tables import MATTER
from airlight.planets.schema.field import Wavelengths
from airlight.planets.schema.toml_table import TomlTable


def read_constituent(section: TomlTable, thickness: float) -> Constituent:
    """Read a constituent from its table.

    Parameters
    ----------
    thickness : float
        Thickness of the shell. [m]
    """
    name = section.text("name", "a name of its own")
    wavelengths = section.wavelengths()
    matter = _matter(section, wavelengths)
    profile = _profile_of(section, matter)
    phase_function = None
    if "phase_function" in section:
        phase_function = PHASES.read(
            section.section("phase_function", "a table such as { kind = 'rayleigh' }"), wavelengths
        )
    if matter is None:
        scattering, absorption = read_coefficients(section, wavelengths, profile, thickness)
    else:
        scattering, absorption = 0.0, read_absorption(section, wavelengths)
    amount = section.number("amount", "1", "2") if "amount" in section else 1.0
    section.finish()
    with section.prefix_errors():
        return Constituent(
            name=name,
            amount=amount,
            profile=profile,
            scattering=scattering,
            absorption=absorption,
            phase_function=phase_function,
            matter=matter,
        )


def _matter(section: TomlTable, wavelengths: Wavelengths) -> Matter | None:
    """Matter of the constituent, if given; only absorption can be combined with it."""
    given = [kind for kind in MATTER if kind.keyword in section]
    if not given:
        return None
    kind = given[0]
    for name in (*(other.keyword for other in given[1:]), *COEFFICIENTS):
        if name != "absorption" and name in section:
            raise ConflictError(section.name_of(name), f"cannot be combined with {kind.keyword}")
    table = section.section(kind.keyword, f"a table such as {kind.example}")
    matter = kind.read(table, wavelengths)
    if matter.needs_phase and "phase_function" not in section:
        name = section.name_of("phase_function")
        raise ConflictError(name, f"is required for {matter.needs_phase}")
    return matter


def _profile_of(section: TomlTable, matter: Matter | None) -> Profile:
    """Explicit profile, or the exponential by temperature and gravity of a gas."""
    if matter is not None and "profile" not in section:
        with (
            section.prefix_errors(),
            TomlTable({}, section.name_of(matter.keyword)).prefix_errors(),
        ):
            height = matter.own_scale_height()
            if height is not None:
                return Exponential(scale_height=height)
    allowed = "a table such as { kind = 'exponential', … }"
    return PROFILES.read(section.section("profile", allowed))
