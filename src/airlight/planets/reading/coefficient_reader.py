"""The coefficients of one constituent: the keys of a planet file that give them, in every form."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Final

from airlight.errors import ParameterError
from airlight.optics.rayleigh import number_density_from_mass
from airlight.planets.matter.gases import GASES, GasScattering, RefractiveScattering
from airlight.planets.matter.profiles import Profile
from airlight.planets.parameters import MISSING
from airlight.planets.planet import LARGEST_COEFFICIENT
from airlight.planets.reading.absorption_reader import Absorption, read_absorption
from airlight.planets.reading.toml_section import Section
from airlight.planets.spectral import PerWavelength, Spectral, check_spectral

Wavelengths = tuple[float, ...] | None
Scattering = Spectral | GasScattering | RefractiveScattering

#: The sets of keys that say what a constituent scatters and absorbs.
_FORMS: Final = (
    ("scattering",),
    ("absorption",),
    ("absorption", "scattering"),
    ("extinction", "scattering"),
    ("scattering", "single_scattering_albedo"),
    ("extinction", "single_scattering_albedo"),
    ("optical_depth", "single_scattering_albedo"),
)
#: Every key of a constituent that gives a coefficient.
COEFFICIENT_KEYS: Final = (
    "scattering",
    "absorption",
    "extinction",
    "single_scattering_albedo",
    "optical_depth",
)


def read_coefficients(
    section: Section,
    wavelengths: Wavelengths,
    profile: Profile,
    thickness: float,
) -> tuple[Scattering, Absorption]:
    """Scattering and absorption coefficients at relative density 1.

    Parameters
    ----------
    section : Section
        The constituent's table.
    wavelengths : tuple of float or None
        Those that its lists belong to. [nm]
    profile : Profile
        Over whose column an optical depth is spread.
    thickness : float
        Of the shell. [m]

    Returns
    -------
    scattering, absorption
        As ``Constituent`` takes them. [m⁻¹]
    """
    given = tuple(sorted(key for key in COEFFICIENT_KEYS if key in section))
    if given not in {tuple(sorted(form)) for form in _FORMS}:
        forms = "; ".join(" + ".join(form) for form in _FORMS)
        shown: Any = ", ".join(given) if given else MISSING
        raise ParameterError(section.name_of("scattering"), shown, f"one of these sets: {forms}")
    gas = isinstance(section.raw("scattering"), dict)
    if gas and "absorption" not in given and len(given) > 1:
        raise ParameterError(
            section.name_of(given[0]), section.raw(given[0]), "none beside a gas that scatters"
        )
    if "optical_depth" in given or "extinction" in given:
        return _from_extinction(section, given, wavelengths, profile, thickness)
    scattering = _scattering(section, wavelengths) if "scattering" in given else 0.0
    if "single_scattering_albedo" in given:
        albedo = _fraction(section, wavelengths)
        assert isinstance(scattering, (float, PerWavelength))
        return scattering, _combined(
            _absorption_beside, wavelengths, section, "absorption", scattering, albedo
        )
    return scattering, read_absorption(section, wavelengths)


def _from_extinction(
    section: Section,
    given: tuple[str, ...],
    wavelengths: Wavelengths,
    profile: Profile,
    thickness: float,
) -> tuple[Spectral, Spectral]:
    if "optical_depth" in given:
        depth = section.spectral("optical_depth", "1", "0.05", wavelengths)
        check_spectral(depth, section.name_of("optical_depth"), 0.0, 1e4)
        column = _column(section, profile, thickness)
        extinction = _combined(lambda x: x / column, wavelengths, section, "extinction", depth)
    else:
        extinction = section.spectral("extinction", "1/m", "4.44e-6 /m", wavelengths)
        check_spectral(extinction, section.name_of("extinction"), 0.0, LARGEST_COEFFICIENT, "/m")
    if "single_scattering_albedo" in given:
        albedo = _fraction(section, wavelengths)
        return (
            _combined(lambda e, a: e * a, wavelengths, section, "scattering", extinction, albedo),
            _combined(
                lambda e, a: e * (1.0 - a), wavelengths, section, "absorption", extinction, albedo
            ),
        )
    scattering = section.spectral("scattering", "1/m", "3.996e-6 /m", wavelengths)
    check_spectral(scattering, section.name_of("scattering"), 0.0, LARGEST_COEFFICIENT, "/m")
    pairs = zip(_listed(extinction, wavelengths), _listed(scattering, wavelengths), strict=True)
    for e, s in pairs:
        if s > e:
            raise ParameterError(
                section.name_of("extinction"), e, f"at least the scattering, {s:g} /m"
            )
    return scattering, _combined(
        lambda e, s: e - s, wavelengths, section, "absorption", extinction, scattering
    )


def _column(section: Section, profile: Profile, thickness: float) -> float:
    with section.blamed():
        column = profile.column(thickness)
    if not column > 0.0:
        raise ParameterError(
            section.name_of("profile"), profile, "one that is not 0 everywhere in the shell"
        )
    return column


def _fraction(section: Section, wavelengths: Wavelengths) -> Spectral:
    key = "single_scattering_albedo"
    albedo = section.spectral(key, "1", "0.9", wavelengths)
    return check_spectral(albedo, section.name_of(key), 0.0, 1.0)


def _absorption_beside(scattering: float, albedo: float) -> float:
    """Absorption of what scatters this much with this albedo; infinite at albedo 0."""
    if scattering == 0.0:
        return 0.0
    return scattering * (1.0 - albedo) / albedo if albedo > 0.0 else math.inf


def _listed(value: Spectral, wavelengths: Wavelengths) -> tuple[float, ...]:
    if isinstance(value, PerWavelength):
        return value.values
    return (value,) * len(wavelengths or (0.0,))


def _combined(
    formula: Callable[..., float],
    wavelengths: Wavelengths,
    section: Section,
    key: str,
    *values: Spectral,
) -> Spectral:
    """A formula applied at each wavelength, or once if no value depends on it."""
    lists = [_listed(value, wavelengths) for value in values]
    results = tuple(formula(*items) for items in zip(*lists, strict=True))
    for result in results:
        if not 0.0 <= result <= LARGEST_COEFFICIENT:
            raise ParameterError(
                section.name_of(key), result, f"0 to {LARGEST_COEFFICIENT:g} /m, as implied"
            )
    if any(isinstance(value, PerWavelength) for value in values):
        assert wavelengths is not None
        return PerWavelength(wavelengths=wavelengths, values=results)
    return results[0]


# --- gases ------------------------------------------------------------------------------------


def _scattering(section: Section, wavelengths: Wavelengths) -> Scattering:
    if not isinstance(section.raw("scattering"), dict):
        return section.spectral("scattering", "1/m", "5.802e-6 /m", wavelengths)
    gas = section.section("scattering", "a coefficient or a table such as { rayleigh = 'air', … }")
    state: dict[str, Any] = {
        "temperature": gas.optional_number("temperature", "K"),
        "pressure": gas.optional_number("pressure", "Pa"),
        "number_density": _number_density(gas),
    }
    if "rayleigh" in gas:
        name = gas.choice("rayleigh", tuple(GASES))
        gas.finish()
        with gas.blamed():
            return GasScattering(gas=name, **state)  # type: ignore[arg-type]
    state["refractivity"] = gas.spectral("refractivity", "1", "2.78e-4", wavelengths)
    state["ground_number_density"] = gas.optional_number("ground_number_density", "1/m^3")
    for key, example in (("king_factor", "1.049"), ("depolarisation", "0.035")):
        if key in gas:
            state[key] = gas.spectral(key, "1", example, wavelengths)
    gas.finish()
    with gas.blamed():
        return RefractiveScattering(**state)


def _number_density(gas: Section) -> float | None:
    """Molecules per volume, given or from mass density and molar mass. [m⁻³]"""
    if "mass_density" not in gas and "molar_mass" not in gas:
        return gas.optional_number("number_density", "1/m^3")
    mass_density = gas.number("mass_density", "kg/m^3", "1.225 kg/m^3")
    molar_mass = gas.number("molar_mass", "kg/mol", "28.9644 g/mol")
    if not 1e-4 <= molar_mass <= 1.0:
        raise ParameterError(gas.name_of("molar_mass"), molar_mass, "1e-4 to 1 kg/mol")
    if "number_density" in gas:
        raise ParameterError(
            gas.name_of("number_density"), gas.raw("number_density"), "none beside a mass_density"
        )
    if not 0.0 < mass_density < 1e6:
        raise ParameterError(
            gas.name_of("mass_density"), mass_density, "more than 0, to 1e6 kg/m^3"
        )
    return number_density_from_mass(mass_density, molar_mass)
