"""One ``[[constituents]]`` table of a planet file: profile, coefficients, phase function."""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from airlight.errors import ParameterError
from airlight.optics.gas_absorption import ozone_profile_afgl1986
from airlight.optics.rayleigh import scale_height
from airlight.planets.matter.gas_mixture import GasMixture
from airlight.planets.matter.matter import Matter
from airlight.planets.matter.phases import (
    CornetteShanks,
    DoubleHenyeyGreenstein,
    HenyeyGreenstein,
    PhaseFunction,
    Rayleigh,
    TabulatedPhase,
)
from airlight.planets.matter.profiles import (
    Exponential,
    Layer,
    Layered,
    Profile,
    Tabulated,
    Tent,
    Uniform,
)
from airlight.planets.planet import Constituent
from airlight.planets.reading.absorption_reader import read_absorption
from airlight.planets.reading.coefficient_reader import COEFFICIENT_KEYS, read_coefficients
from airlight.planets.reading.gas_reader import read_gas
from airlight.planets.reading.particle_reader import (
    read_literal_turbidity,
    read_particles,
    read_turbidity,
)
from airlight.planets.reading.toml_section import Section, quantity_list
from airlight.planets.spectral import Spectral

Wavelengths = tuple[float, ...] | None

#: The table of densities that comes with the package, by name.
OZONE_TABLE: Final = "ozone-afgl1986-us-standard"


def read_constituent(section: Section, thickness: float) -> Constituent:
    """A constituent from its table.

    Parameters
    ----------
    section : Section
    thickness : float
        Of the shell, over which optical depths are spread. [m]
    """
    name = section.text("name", "a name of its own")
    wavelengths = section.wavelengths()
    matter = _matter(section, wavelengths)
    profile = _profile_of(section, matter)
    phase_function = None
    if "phase_function" in section:
        phase_function = _phase(
            section.section("phase_function", "a table such as { kind = 'rayleigh' }"), wavelengths
        )
    if matter is None:
        scattering, absorption = read_coefficients(section, wavelengths, profile, thickness)
    else:
        scattering, absorption = 0.0, read_absorption(section, wavelengths)
    section.finish()
    with section.blamed():
        return Constituent(
            name=name,
            profile=profile,
            scattering=scattering,
            absorption=absorption,
            phase_function=phase_function,
            matter=matter,
        )


# --- matter -----------------------------------------------------------------------------------

#: Keys that say what a constituent is made of, instead of its coefficients, and their readers.
_MATTER: Final[dict[str, Callable[[Section, Wavelengths], Matter]]] = {
    "gas": read_gas,
    "particles": read_particles,
    "turbidity": read_turbidity,
    "turbidity_literal": read_literal_turbidity,
}


def _matter(section: Section, wavelengths: Wavelengths) -> Matter | None:
    """What the constituent is made of, if it says so; beside it only absorption is given."""
    given = [key for key in _MATTER if key in section]
    if not given:
        return None
    for key in (*given[1:], *COEFFICIENT_KEYS):
        if key != "absorption" and key in section:
            raise ParameterError(
                section.name_of(key), section.raw(key), f"none beside {given[0]!r}"
            )
    return _MATTER[given[0]](section, wavelengths)


def _profile_of(section: Section, matter: Matter | None) -> Profile:
    """The profile given, or the exponential that temperature and gravity give to a gas."""
    if isinstance(matter, GasMixture) and "profile" not in section:
        with section.blamed(), Section({}, section.name_of("gas")).blamed():
            return Exponential(scale_height=matter.scale_height)
    return _profile(section.section("profile", "a table such as { kind = 'exponential', … }"))


# --- profiles ---------------------------------------------------------------------------------


def _exponential(section: Section) -> Profile:
    value = section.required("scale_height", "a length such as '8 km'")
    if not isinstance(value, dict):
        height = section.number("scale_height", "m", "8 km")
        section.finish()
        return Exponential(scale_height=height)
    bulk = section.section("scale_height", "a length such as '8 km'")
    temperature = _positive(bulk, "temperature", "K", "288.15 K")
    molar_mass = _positive(bulk, "molar_mass", "kg/mol", "28.9644 g/mol")
    gravity = _positive(bulk, "gravity", "m/s^2", "9.80665 m/s^2")
    bulk.finish()
    section.finish()
    return Exponential(scale_height=scale_height(temperature, molar_mass, gravity))


def _positive(section: Section, key: str, unit: str, example: str) -> float:
    value = section.number(key, unit, example)
    if not 1e-30 < value < 1e30:
        raise ParameterError(section.name_of(key), value, f"more than 0, such as {example!r}")
    return value


def _tent(section: Section) -> Profile:
    center = section.number("center", "m", "25 km")
    half_width = section.number("half_width", "m", "15 km")
    section.finish()
    return Tent(center=center, half_width=half_width)


def _layered(section: Section) -> Profile:
    layers = []
    for part in section.sections("layers", "a list of tables such as [{ constant_term = 1 }]"):
        values = {
            "width": part.optional_number("width", "m"),
            "exp_term": part.optional_number("exp_term", "1"),
            "exp_scale": part.optional_number("exp_scale", "1/m"),
            "linear_term": part.optional_number("linear_term", "1/m"),
            "constant_term": part.optional_number("constant_term", "1"),
        }
        part.finish()
        with part.blamed():
            layers.append(Layer(**{key: x for key, x in values.items() if x is not None}))
    section.finish()
    return Layered(layers=tuple(layers))


def _tabulated(section: Section) -> Profile:
    if "table" in section:
        section.choice("table", (OZONE_TABLE,))
        section.finish()
        altitudes, densities = ozone_profile_afgl1986()
        relative = densities / densities.max()
        return Tabulated(altitudes=tuple(altitudes.tolist()), densities=tuple(relative.tolist()))
    altitudes_given = section.numbers("altitudes", "m", "0, 10, 20 km")
    densities_given = section.numbers("densities", "1", "1, 0.3, 0.1")
    section.finish()
    return Tabulated(altitudes=altitudes_given, densities=densities_given)


def _uniform(section: Section) -> Profile:
    section.finish()
    return Uniform()


_PROFILES: Final[dict[str, Callable[[Section], Profile]]] = {
    "exponential": _exponential,
    "tent": _tent,
    "layered": _layered,
    "tabulated": _tabulated,
    "uniform": _uniform,
}


def _profile(section: Section) -> Profile:
    read = _PROFILES[section.choice("kind", tuple(_PROFILES))]
    with section.blamed():
        return read(section)


# --- phase functions --------------------------------------------------------------------------


def _rayleigh(section: Section, wavelengths: Wavelengths) -> PhaseFunction:
    delta: Spectral = 0.0
    if "depolarisation" in section:
        delta = section.spectral("depolarisation", "1", "0.035", wavelengths)
    section.finish()
    return Rayleigh(depolarisation=delta)


def _cornette_shanks(section: Section, wavelengths: Wavelengths) -> PhaseFunction:
    asymmetry = section.spectral("asymmetry", "1", "0.8", wavelengths)
    section.finish()
    return CornetteShanks(asymmetry=asymmetry)


def _henyey_greenstein(section: Section, wavelengths: Wavelengths) -> PhaseFunction:
    asymmetry = section.spectral("asymmetry", "1", "0.8", wavelengths)
    section.finish()
    return HenyeyGreenstein(asymmetry=asymmetry)


def _double_henyey_greenstein(section: Section, wavelengths: Wavelengths) -> PhaseFunction:
    first = section.spectral("asymmetry_1", "1", "0.889", wavelengths)
    second = section.spectral("asymmetry_2", "1", "0.094", wavelengths)
    weight = section.spectral("weight", "1", "0.743", wavelengths)
    section.finish()
    return DoubleHenyeyGreenstein(asymmetry_1=first, asymmetry_2=second, weight=weight)


def _tabulated_phase(section: Section, wavelengths: Wavelengths) -> PhaseFunction:
    angles = section.numbers("angles", "deg", "0, 90, 180 deg")
    values = section.required("values", "a list of numbers in /sr, or one list per wavelength")
    field = section.name_of("values")
    section.finish()
    if isinstance(values, list) and values and all(isinstance(row, list) for row in values):
        if wavelengths is None:
            raise ParameterError(field, len(values), "one list, or wavelengths for the lists")
        rows = [quantity_list(row, "1/sr", f"{field}[{i}]") for i, row in enumerate(values)]
        return TabulatedPhase(angles=angles, rows=tuple(rows), wavelengths=wavelengths)
    return TabulatedPhase(angles=angles, rows=(quantity_list(values, "1/sr", field),))


_PHASES: Final[dict[str, Callable[[Section, Wavelengths], PhaseFunction]]] = {
    "rayleigh": _rayleigh,
    "cornette-shanks": _cornette_shanks,
    "henyey-greenstein": _henyey_greenstein,
    "double-henyey-greenstein": _double_henyey_greenstein,
    "tabulated": _tabulated_phase,
}


def _phase(section: Section, wavelengths: Wavelengths) -> PhaseFunction:
    read = _PHASES[section.choice("kind", tuple(_PHASES))]
    with section.blamed():
        return read(section, wavelengths)
