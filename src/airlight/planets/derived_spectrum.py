"""Positive spectra derived from others, such as scattering from an optical depth."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated, Any, Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.planets.parameters import one_of, parameters
from airlight.planets.spectral import PerWavelength, power_law_at, spectral_at

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
