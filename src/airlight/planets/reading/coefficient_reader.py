"""Reader of the coefficients of a constituent, in all their forms."""

from __future__ import annotations

from typing import Any, Final

from airlight.errors import ConflictError, ParameterError
from airlight.planets.constituent import LARGEST_COEFFICIENT, Constituent
from airlight.planets.derived_spectrum import FORMULAS, DerivedSpectrum
from airlight.planets.matter.absorbers import ABSORBERS
from airlight.planets.matter.gases import SCATTERERS
from airlight.planets.matter.matter import Absorber, Scatterer
from airlight.planets.matter.profiles import Profile
from airlight.planets.parameters import MISSING
from airlight.planets.reading.coefficient_keys import ALBEDO, DEPTH, EXTINCTION
from airlight.planets.schema.field import Field, Wavelengths
from airlight.planets.schema.toml_model import fields_of
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import PerWavelength, Spectral

_SCATTERING = fields_of(Constituent)["scattering"]
_ABSORPTION = fields_of(Constituent)["absorption"]

#: Sets of keys that determine the scattering and absorption of a constituent.
_FORMS: Final = (
    ("scattering",),
    ("absorption",),
    ("absorption", "scattering"),
    ("extinction", "scattering"),
    ("scattering", "single_scattering_albedo"),
    ("extinction", "single_scattering_albedo"),
    ("optical_depth", "single_scattering_albedo"),
)
#: All keys of a constituent that give a coefficient.
COEFFICIENTS: Final = tuple(dict.fromkeys(name for form in _FORMS for name in form))


def read_coefficients(
    section: TomlTable,
    wavelengths: Wavelengths,
    profile: Profile,
    thickness: float,
) -> tuple[Spectral | Scatterer, Spectral | Absorber]:
    """Read scattering and absorption coefficients at relative density 1.

    Parameters
    ----------
    section : TomlTable
        Table of the constituent.
    wavelengths : tuple of float or None
        Wavelengths that its lists belong to. [nm]
    profile : Profile
        Density profile, for coefficients from an optical depth.
    thickness : float
        Thickness of the shell. [m]

    Returns
    -------
    scattering, absorption
        Coefficients as ``Constituent`` takes them. [m⁻¹]
    """
    given = tuple(sorted(key for key in COEFFICIENTS if key in section))
    if given not in {tuple(sorted(form)) for form in _FORMS}:
        forms = "; ".join(" + ".join(form) for form in _FORMS)
        shown: Any = ", ".join(given) if given else MISSING
        raise ParameterError(section.name_of("scattering"), shown, f"one of these sets: {forms}")
    gas = isinstance(section.raw("scattering"), dict)
    if gas and "absorption" not in given and len(given) > 1:
        name = section.name_of(given[0])
        raise ConflictError(name, "cannot be combined with a scattering gas")
    if "optical_depth" in given or "extinction" in given:
        return _from_extinction(section, given, wavelengths, profile, thickness)
    scattering = read_scattering(section, wavelengths) if "scattering" in given else 0.0
    if "single_scattering_albedo" in given:
        albedo = _given(ALBEDO, section, wavelengths)
        assert isinstance(scattering, (float, PerWavelength))
        return scattering, _combined(
            "s (1 - a)/a", wavelengths, section, "absorption", (scattering,), (albedo,)
        )
    return scattering, read_absorption(section, wavelengths)


def read_scattering(section: TomlTable, wavelengths: Wavelengths) -> Spectral | Scatterer:
    """Read the key ``scattering``: a coefficient [m⁻¹], or molecules."""
    if not isinstance(section.raw("scattering"), dict):
        return section.spectral("scattering", "1/m", _SCATTERING.example, wavelengths)
    allowed = "a coefficient or a table such as { rayleigh = 'air', … }"
    return SCATTERERS.read(section.section("scattering", allowed), wavelengths)


def read_absorption(section: TomlTable, wavelengths: Wavelengths) -> Spectral | Absorber:
    """Read the key ``absorption``: a coefficient [m⁻¹], an absorber, or 0 if absent."""
    if "absorption" not in section:
        return 0.0
    if not isinstance(section.raw("absorption"), dict):
        return section.spectral("absorption", "1/m", _ABSORPTION.example, wavelengths)
    allowed = "a coefficient or a table such as { ozone = '345 DU' }"
    return ABSORBERS.read(section.section("absorption", allowed), wavelengths)


def _from_extinction(
    section: TomlTable,
    given: tuple[str, ...],
    wavelengths: Wavelengths,
    profile: Profile,
    thickness: float,
) -> tuple[Spectral, Spectral]:
    if "optical_depth" in given:
        depth = _given(DEPTH, section, wavelengths)
        column = _column(section, profile, thickness)
        extinction = _over(depth, column, section)
    else:
        extinction = _given(EXTINCTION, section, wavelengths)
    if "single_scattering_albedo" in given:
        albedo = _given(ALBEDO, section, wavelengths)
        parts = (extinction,), (albedo,)
        return (
            _combined("e a", wavelengths, section, "scattering", *parts),
            _combined("e (1 - a)", wavelengths, section, "absorption", *parts),
        )
    scattering = _given(_SCATTERING, section, wavelengths)
    pairs = zip(_listed(extinction, wavelengths), _listed(scattering, wavelengths), strict=True)
    for e, s in pairs:
        if s > e:
            raise ParameterError(
                section.name_of("extinction"), e, f"at least the scattering, {s:g} /m"
            )
    return scattering, _combined(
        "e - s", wavelengths, section, "absorption", (extinction, scattering)
    )


def _column(section: TomlTable, profile: Profile, thickness: float) -> float:
    with section.prefix_errors():
        column = profile.column(thickness)
    if not column > 0.0:
        raise ParameterError(section.name_of("profile"), profile, "a density above 0 in the shell")
    return column


def _given(key: Field, section: TomlTable, wavelengths: Wavelengths) -> Spectral:
    """Value of a key that is present, within its range."""
    value: Spectral = key.checked(key.read_from(section, wavelengths), section.name_of(key.name))
    return value


def _over(depth: Spectral, column: float, section: TomlTable) -> Spectral:
    """Extinction at relative density 1, from an optical depth. [m⁻¹]"""
    values = [_in_range(one / column, section, "extinction") for one in _listed(depth, None)]
    if isinstance(depth, PerWavelength):
        return PerWavelength(wavelengths=depth.wavelengths, values=tuple(values))
    return values[0]


def _listed(value: Spectral, wavelengths: Wavelengths) -> tuple[float, ...]:
    if isinstance(value, PerWavelength):
        return value.values
    return (value,) * len(wavelengths or (0.0,))


def _in_range(value: float, section: TomlTable, key: str) -> float:
    if not 0.0 <= value <= LARGEST_COEFFICIENT:
        allowed = f"0 to {LARGEST_COEFFICIENT:g} /m, as implied"
        raise ParameterError(section.name_of(key), value, allowed)
    return value


def _combined(
    formula: str,
    wavelengths: Wavelengths,
    section: TomlTable,
    key: str,
    spectra: tuple[Spectral, ...],
    fractions: tuple[Spectral, ...] = (),
) -> Spectral:
    """Coefficient by a formula of spectra, then fractions, at every wavelength."""
    lists = [_listed(value, wavelengths) for value in (*spectra, *fractions)]
    results = tuple(
        _in_range(float(FORMULAS[formula](*items)), section, key)
        for items in zip(*lists, strict=True)
    )
    if any(isinstance(value, PerWavelength) for value in (*spectra, *fractions)):
        assert wavelengths is not None
        return DerivedSpectrum(wavelengths=wavelengths, values=results, formula=formula,
                       spectra=spectra, fractions=fractions)  # fmt: skip
    return results[0]
