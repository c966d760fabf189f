"""Analytic phase functions: Rayleigh, and particles with one or two lobes."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.kernel import vectorized
from airlight.physics.optics import phase_functions
from airlight.physics.optics.phase_functions import INV_4PI
from airlight.physics.optics.phase_matrix import anisotropy
from airlight.planets.matter.phases.phase_function import FormulaPhase
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import Field, always, key
from airlight.planets.spectral import Spectral

FloatArray = npt.NDArray[np.float64]

#: Largest ``|g|``: beyond, the forward lobe is narrower than the sun's disc.
LARGEST_ASYMMETRY: Final = 0.999
#: Default asymmetry parameter of a new phase function of particles.
INITIAL_ASYMMETRY: Final = 0.7


#: Mean cosine of a lobe, or its equivalent.
ASYMMETRY: Final = Field(
    label="asymmetry g",
    help="1 is all forward, 0 even, -1 all backward.",
    range=(-LARGEST_ASYMMETRY, LARGEST_ASYMMETRY),
    slider=(-0.99, 0.99),
    example="0.8",
    initial=INITIAL_ASYMMETRY,
)


@parameters
class Rayleigh(FormulaPhase):
    """Rayleigh phase function, of molecules and particles much smaller than the wavelength.

    Parameters
    ----------
    depolarisation : float or PerWavelength
        Depolarisation factor δ, 0 to 0.5. [1]
    """

    keyword = "rayleigh"
    molecular = True
    formula = staticmethod(phase_functions.rayleigh)

    depolarisation: Spectral = key(
        help="Depolarisation ratio of the molecules; 0 for isotropic ones.",
        range=(0.0, 0.5),
        example="0.035",
        offered=always,
        default=0.0,
    )

    def polarising_moments(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """See ``PhaseFunction``; in closed form."""
        part = vectorized(anisotropy)(self.parameters_at(np.atleast_1d(wavelengths))[0])
        none = np.zeros_like(part)
        return np.stack([-np.sqrt(6.0) / 10.0 * part, 0.6 * part, none, none], axis=-1)

    def phase_f12(self, nu: npt.ArrayLike, wavelengths: npt.ArrayLike) -> FloatArray:
        """Element F₁₂ of the phase matrix, shape of nu (...) and (nl,) to (..., nl). [sr⁻¹]"""
        cosines = np.asarray(nu, dtype=np.float64)[..., None]
        part = vectorized(anisotropy)(self.parameters_at(wavelengths)[0])
        return np.asarray(-0.75 * INV_4PI * part * (1.0 - cosines**2))


@parameters
class HenyeyGreenstein(FormulaPhase):
    """Henyey-Greenstein phase function.

    Parameters
    ----------
    asymmetry : float or PerWavelength
        g, the mean cosine, -0.999 to 0.999. [1]
    """

    keyword = "henyey-greenstein"
    formula = staticmethod(phase_functions.henyey_greenstein)

    asymmetry: Spectral = key(ASYMMETRY)


@parameters
class CornetteShanks(FormulaPhase):
    """Cornette-Shanks phase function, which tends to Rayleigh's as g tends to 0.

    Parameters
    ----------
    asymmetry : float or PerWavelength
        g, positive forward, -0.999 to 0.999; not exactly the mean cosine. [1]
    """

    keyword = "cornette-shanks"
    formula = staticmethod(phase_functions.cornette_shanks)

    asymmetry: Spectral = key(ASYMMETRY, note="The mean cosine is 3g(4+g²)/(5(2+g²)).")


@parameters
class DoubleHenyeyGreenstein(FormulaPhase):
    """Sum of two lobes: weight·HG(asymmetry_1) + (1 - weight)·HG(asymmetry_2).

    Parameters
    ----------
    asymmetry_1, asymmetry_2 : float or PerWavelength
        Mean cosine of each lobe, -0.999 to 0.999. [1]
    weight : float or PerWavelength
        Fraction of the first lobe, 0 to 1. [1]
    """

    keyword = "double-henyey-greenstein"
    formula = staticmethod(phase_functions.double_henyey_greenstein)

    asymmetry_1: Spectral = key(
        ASYMMETRY,
        label="asymmetry of the first lobe",
        help="1 is all forward, -1 backward.",
        initial=0.85,
        example="0.889",
    )
    asymmetry_2: Spectral = key(
        ASYMMETRY,
        label="asymmetry of the second lobe",
        help="1 is all forward, -1 backward.",
        initial=-0.2,
        example="0.094",
    )
    weight: Spectral = key(
        label="weight of the first lobe",
        help="Weight of the first lobe; the second has the remainder.",
        range=(0.0, 1.0),
        example="0.743",
        initial=0.9,
    )
