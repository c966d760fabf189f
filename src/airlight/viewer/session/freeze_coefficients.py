"""Conversion of a constituent's composition to fixed coefficients, the standard form."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.planets.constituent import MATTER
from airlight.planets.matter.coefficients import COEFFICIENTS
from airlight.planets.matter.profiles import Exponential
from airlight.planets.planet import Planet
from airlight.planets.reading.nested_tables import Tables, put
from airlight.planets.schema.measures import text_of

FloatArray = npt.NDArray[np.float64]

#: Wavelengths of the coefficients besides those of the planet: the ends and the middle of the
#: visible range, clipped to the planet's limits. [nm]
WAVELENGTHS: Final = (360.0, 440.0, 550.0, 680.0, 830.0)
#: Keys of a constituent's composition.
_MADE_OF: Final = tuple(one.keyword for one in MATTER)
#: Keys replaced by the conversion.
_REPLACED: Final = (*_MADE_OF, *COEFFICIENTS, "wavelengths", "phase_function", "amount")


def is_advanced(constituent: Tables) -> bool:
    """Whether a constituent's table holds a composition rather than coefficients."""
    forms = (constituent.get(key) for key in ("scattering", "absorption"))
    return any(key in constituent for key in _MADE_OF) or any(
        isinstance(one, dict) for one in forms
    )


def freeze_coefficients(tables: Tables, planet: Planet, index: int) -> Tables:
    """Copy of the tables with one constituent's coefficients at a few wavelengths.

    Coefficients follow power laws between the wavelengths. Particles get a Henyey-Greenstein phase
    function of their mean cosine, with a weaker aureole; analytic phase functions are unchanged.
    Refraction is removed unless another gas refracts.

    Parameters
    ----------
    tables : dict
        Tables of the planet's file; not modified.
    planet : Planet
        Planet read from the tables.
    """
    old = tables["constituents"][index]
    one = planet.constituents[index]
    if not is_advanced(old):
        raise ParameterError("constituent", one.name, "a constituent with a composition")
    nm = _wavelengths(planet)
    scattering = one.scattering_coefficients(nm, planet.thickness)
    absorption = one.absorption_coefficients(nm, planet.thickness)
    new: Tables = {key: value for key, value in old.items() if key not in _REPLACED}
    if "profile" not in new:
        assert isinstance(one.profile, Exponential)  # of a gas, from its gravity
        height = float(f"{1e-3 * one.profile.scale_height:.9g}")
        new["profile"] = {"kind": "exponential", "scale_height": text_of(height, "km")}
    new["wavelengths"] = [text_of(float(one_nm), "nm") for one_nm in nm]
    if scattering.any():
        new["scattering"] = _per_km(scattering)
        new["phase_function"] = one.phase_function_at(nm).frozen(nm)
    if absorption.any() or not scattering.any():
        new["absorption"] = _per_km(absorption)
    frozen = put(tables, f"constituents[{index}]", new)
    others = (other for k, other in enumerate(planet.constituents) if k != index)
    if planet.refraction != "none" and not any(other.bends for other in others):
        frozen = put(frozen, "refraction", "none")  # coefficients have no refractivity
    return frozen


def _wavelengths(planet: Planet) -> FloatArray:
    """Wavelengths of the coefficients, ascending. [nm]"""
    low, high = planet.wavelength_limits
    inside = [min(max(nm, low), high) for nm in WAVELENGTHS]
    return np.unique([*inside, *(planet.default_wavelengths or ())])


def _per_km(values: FloatArray) -> Any:
    """Coefficients as texts per km: a single text if all are equal, else one per wavelength."""
    texts = [text_of(float(f"{1e3 * value:.7g}"), "/km") for value in values]
    return texts[0] if len(set(texts)) == 1 else texts
