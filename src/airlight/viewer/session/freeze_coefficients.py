"""A constituent given by what it is made of, frozen to coefficients: the standard form."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.planets.matter.profiles import Exponential
from airlight.planets.planet import Planet
from airlight.planets.reading.coefficient_reader import COEFFICIENTS
from airlight.planets.reading.tables import MATTER
from airlight.planets.schema.measures import text_of
from airlight.viewer.parameters.nested_tables import Tables, put

FloatArray = npt.NDArray[np.float64]

#: Where coefficients are given, besides the planet's own wavelengths: the ends and the middle of
#: what is seen, as far as the planet is known there. [nm]
WAVELENGTHS: Final = (360.0, 440.0, 550.0, 680.0, 830.0)
#: Keys that say what a constituent is made of.
_MADE_OF: Final = tuple(one.keyword for one in MATTER)
#: Those that a frozen constituent has otherwise.
_REPLACED: Final = (*_MADE_OF, *COEFFICIENTS, "wavelengths", "phase_function", "amount")


def is_advanced(constituent: Tables) -> bool:
    """Whether a constituent's table says what it is made of, rather than coefficients."""
    forms = (constituent.get(key) for key in ("scattering", "absorption"))
    return any(key in constituent for key in _MADE_OF) or any(
        isinstance(one, dict) for one in forms
    )


def as_standard(tables: Tables, planet: Planet, index: int) -> Tables:
    """The tables with one constituent given by its coefficients at a few wavelengths.

    Coefficients are linear between the wavelengths, those of gases times λ⁴. Particles get one
    smooth lobe (Henyey-Greenstein) of their mean cosine, whose glow around the star is weaker than
    theirs; phase functions of few parameters are kept.

    Parameters
    ----------
    tables : dict
        Of the planet's file; not changed.
    planet : Planet
        What the reader made of them.
    index : int
        Of the constituent.

    Returns
    -------
    dict

    Raises
    ------
    ParameterError
        If the constituent is given by coefficients already.
    """
    old = tables["constituents"][index]
    one = planet.constituents[index]
    if not is_advanced(old):
        raise ParameterError("constituent", one.name, "one that is given by its composition")
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
    return put(tables, f"constituents[{index}]", new)


def _wavelengths(planet: Planet) -> FloatArray:
    """Those that the coefficients are given at, ascending. [nm]"""
    low, high = planet.wavelength_limits
    inside = [min(max(nm, low), high) for nm in WAVELENGTHS]
    return np.unique([*inside, *(planet.own_wavelengths or ())])


def _per_km(values: FloatArray) -> Any:
    """One text if all are the same, else one for each wavelength."""
    texts = [text_of(float(f"{1e3 * value:.7g}"), "/km") for value in values]
    return texts[0] if len(set(texts)) == 1 else texts
