"""Scattering and absorption coefficients of a constituent, in all the forms of a planet file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ConflictError, ParameterError
from airlight.planets.matter.absorbers import ABSORBERS
from airlight.planets.matter.gases import SCATTERERS
from airlight.planets.matter.matter import Absorber, Scatterer
from airlight.planets.matter.profiles import Profile
from airlight.planets.matter.state_keys import ALBEDO, DEPTH
from airlight.planets.parameters import MISSING, one_of, parameters
from airlight.planets.schema.field import Field, FileTable, Wavelengths
from airlight.planets.schema.toml_table import TomlTable
from airlight.planets.spectral import PerWavelength, Spectral, power_law_at, spectral_at

FloatArray = npt.NDArray[np.float64]


def _beside(scattering: npt.ArrayLike, albedo: npt.ArrayLike) -> FloatArray:
    """Absorption by scattering and single-scattering albedo; infinite at albedo 0."""
    part, whole = np.broadcast_arrays(np.asarray(scattering, float), np.asarray(albedo, float))
    infinite = np.where(part > 0.0, np.inf, 0.0)
    known = (part > 0.0) & (whole > 0.0)
    return np.asarray(np.divide(part * (1.0 - whole), whole, out=infinite, where=known))


#: Formulas by name; of extinction e, scattering s and single-scattering albedo a.
FORMULAS: Final[dict[str, Callable[..., Any]]] = {
    "e a": lambda extinction, albedo: extinction * albedo,
    "e (1 - a)": lambda extinction, albedo: extinction * (1.0 - albedo),
    "s (1 - a)/a": _beside,
    "e - s": lambda extinction, scattering: np.maximum(extinction - scattering, 0.0),
}


@parameters
class DerivedSpectrum(PerWavelength):
    """Positive spectrum by a formula of other spectra, at any wavelength.

    Parameters
    ----------
    wavelengths, values : tuple of float
        See ``PerWavelength``; the values are those of the formula. [nm]
    formula : str
        Name from ``FORMULAS`` of a function of the spectra, then of the fractions.
    fractions : tuple of float or PerWavelength
        Numbers with linear interpolation between wavelengths, such as albedos.
    """

    formula: Annotated[str, one_of(*FORMULAS)]
    spectra: tuple[Any, ...]
    fractions: tuple[Any, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        if not np.allclose(self.values, self.at_power_law(self.wavelengths), rtol=1e-9, atol=0.0):
            raise ParameterError("values", self.values, "those of its formula, or a PerWavelength")

    def at_power_law(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Value at wavelengths within ``limits`` [nm], shape (...), by the formula."""
        spectra = [power_law_at(one, wavelengths) for one in self.spectra]
        fractions = [spectral_at(one, wavelengths) for one in self.fractions]
        return np.asarray(FORMULAS[self.formula](*spectra, *fractions))


#: Largest coefficient: a mean free path of a metre. [m⁻¹]
LARGEST_COEFFICIENT: Final = 1.0


def _coefficients_alone(constituent: FileTable) -> bool:
    """Whether an omitted absorption is 0, as no other key determines it."""
    others = ("extinction", "single_scattering_albedo", "optical_depth", "absorption")
    return not any(name in constituent for name in others)


#: Coefficients at relative density 1.
SCATTERING: Final = Field(
    name="scattering",
    help="How much light it scatters on a kilometre of way, where its profile is 1.",
    unit="1/m",
    range=(0.0, LARGEST_COEFFICIENT),
    shown="/km",
    slider=(1e-7, 1.0),
    scale="log",
    spectral=True,
    per="wavelengths",
    example="5.802e-6 /m",
    table=SCATTERERS,
    prefix="scattering",
)
ABSORPTION: Final = replace(
    SCATTERING,
    name="absorption",
    help="How much light it swallows on a kilometre of way, where its profile is 1.",
    example="0.65e-6 /m",
    table=ABSORBERS,
    prefix="absorption",
    offered=_coefficients_alone,
)
#: Coefficients in other forms, in the order in which an editor shows them.
OTHER_FORMS: Final = (
    replace(
        SCATTERING,
        name="extinction",
        help="Scattering and absorption together, where its profile is 1.",
        note="Not below the scattering.",
        example="4.44e-6 /m",
        table=None,
        prefix="",
    ),
    replace(ALBEDO, name="single_scattering_albedo", spectral=True, per="wavelengths"),
    replace(
        DEPTH,
        name="optical_depth",
        spectral=True,
        per="wavelengths",
        note="Divided by the profile's column when the file is read.",
    ),
)

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
    table: TomlTable, wavelengths: Wavelengths, values: Mapping[str, Any]
) -> dict[str, Spectral | Scatterer | Absorber]:
    """Scattering and absorption at relative density 1, from any form. [m⁻¹]

    Parameters
    ----------
    table : TomlTable
        Table of the constituent.
    wavelengths : tuple of float or None
        Wavelengths that its lists belong to. [nm]
    values : mapping
        Values of its fields; an optical depth is spread over the column of ``profile``.
    """
    given = tuple(sorted(key for key in COEFFICIENTS if key in table))
    if given not in {tuple(sorted(form)) for form in _FORMS}:
        forms = "; ".join(" + ".join(form) for form in _FORMS)
        shown: Any = ", ".join(given) if given else MISSING
        raise ParameterError(table.name_of("scattering"), shown, f"one of these sets: {forms}")
    scattering = values.get("scattering", 0.0)
    if isinstance(scattering, Scatterer) and "absorption" not in given and len(given) > 1:
        raise ConflictError(table.name_of(given[0]), "cannot be combined with a scattering gas")
    extinction, albedo, depth = (
        key.checked(key.read_from(table, wavelengths), table.name_of(key.name))
        if key.name in given
        else None
        for key in OTHER_FORMS
    )
    if depth is not None:
        extinction = _over(depth, _column(table, values["profile"]), table)

    def part(key: str, formula: str, *spectra: Spectral) -> Spectral:
        fractions = () if albedo is None else (albedo,)
        return _combined(formula, wavelengths, table.name_of(key), spectra, fractions)

    if extinction is not None and albedo is not None:
        return {
            "scattering": part("scattering", "e a", extinction),
            "absorption": part("absorption", "e (1 - a)", extinction),
        }
    if albedo is not None:
        return {"absorption": part("absorption", "s (1 - a)/a", scattering)}
    if extinction is not None:
        SCATTERING.checked(scattering, table.name_of("scattering"))
        for e, s in zip(*(_listed(x, wavelengths) for x in (extinction, scattering)), strict=True):
            if s > e:
                allowed = f"at least the scattering, {s:g} /m"
                raise ParameterError(table.name_of("extinction"), e, allowed)
        return {"absorption": part("absorption", "e - s", extinction, scattering)}
    return {}


def _column(table: TomlTable, profile: Profile) -> float:
    assert table.thickness is not None
    with table.prefix_errors():
        column = profile.column(table.thickness)
    if not column > 0.0:
        raise ParameterError(table.name_of("profile"), profile, "a density above 0 in the shell")
    return column


def _over(depth: Spectral, column: float, table: TomlTable) -> Spectral:
    """Extinction at relative density 1, from an optical depth. [m⁻¹]"""
    field = table.name_of("extinction")
    values = [_in_range(one / column, field) for one in _listed(depth, None)]
    if isinstance(depth, PerWavelength):
        return PerWavelength(wavelengths=depth.wavelengths, values=tuple(values))
    return values[0]


def _listed(value: Spectral, wavelengths: Wavelengths) -> tuple[float, ...]:
    if isinstance(value, PerWavelength):
        return value.values
    return (value,) * len(wavelengths or (0.0,))


def _in_range(value: float, field: str) -> float:
    if not 0.0 <= value <= LARGEST_COEFFICIENT:
        raise ParameterError(field, value, f"0 to {LARGEST_COEFFICIENT:g} /m, as implied")
    return value


def _combined(
    formula: str,
    wavelengths: Wavelengths,
    field: str,
    spectra: tuple[Spectral, ...],
    fractions: tuple[Spectral, ...],
) -> Spectral:
    """Coefficient by a formula of spectra, then fractions, at every wavelength."""
    lists = [_listed(value, wavelengths) for value in (*spectra, *fractions)]
    results = tuple(
        _in_range(float(FORMULAS[formula](*items)), field) for items in zip(*lists, strict=True)
    )
    if any(isinstance(value, PerWavelength) for value in (*spectra, *fractions)):
        assert wavelengths is not None
        return DerivedSpectrum(
            wavelengths=wavelengths,
            values=results,
            formula=formula,
            spectra=spectra,
            fractions=fractions,
        )
    return results[0]
