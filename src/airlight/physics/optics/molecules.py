"""Scattering properties of gases."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.physics.optics import (
    compound_refractivity,
    element_refractivity,
    king_factor,
    refractive_index,
)
from airlight.physics.optics.rayleigh import cross_section, number_density

FloatArray = npt.NDArray[np.float64]
Spectrum = Callable[[npt.ArrayLike], FloatArray]


def constant_king_factor(wavelengths: npt.ArrayLike, value: float = 1.0) -> FloatArray:
    """King factor independent of wavelength [nm], shape (...). [1]"""
    return np.full(np.shape(wavelengths), value)


@dataclass(frozen=True, kw_only=True)
class Molecule:
    """Scattering properties of a gas.

    Parameters
    ----------
    molar_mass : float
        Molar mass. [kg mol⁻¹]
    refractivities : callable
        n - 1 at the temperature and pressure below, as a function of wavelength in nm. [1]
    temperature, pressure : float
        State of the gas at which the refractivity was measured. [K], [Pa]
    king_factors : callable
        King factor as a function of wavelength in nm. [1]
    limits : tuple of float
        Wavelength range of both. [nm]
    """

    name: str
    molar_mass: float
    refractivities: Spectrum
    temperature: float
    pressure: float = refractive_index.STANDARD_PRESSURE
    king_factors: Spectrum = constant_king_factor
    limits: tuple[float, float]

    @property
    def number_density(self) -> float:
        """Number density of the state at which the refractivity was measured. [m⁻³]"""
        return number_density(self.temperature, self.pressure)

    def cross_sections(self, wavelengths: npt.ArrayLike) -> FloatArray:
        """Rayleigh cross-section of one molecule.

        Parameters
        ----------
        wavelengths : array, shape (...)
            Wavelengths. [nm]

        Returns
        -------
        array, shape (...)
            Cross-sections. [m²]

        Raises
        ------
        ParameterError
            If a wavelength is outside the limits.

        Examples
        --------
        >>> f"{MOLECULES['Ar'].cross_sections(532.0):.2e}"
        '4.57e-31'
        """
        return cross_section(
            wavelengths,
            self.refractivities(wavelengths),
            self.number_density,
            self.king_factors(wavelengths),
        )


#: Temperatures 0, 15 and 20 °C. [K]
_AT_0, _AT_15, _AT_20 = 273.15, 288.15, 293.15

#: Gases by formula. Molar masses: CIAAW (2021) conventional atomic weights.
#: King factors: N₂, O₂ Bates (1984); CO₂, N₂O Alms et al. (1975); H₂, NH₃ Hohm (1993); CO from the
#: depolarisation 0.0048 of polarised light in Sneep & Ubachs (2005), F = (3+6ρ)/(3-4ρ); H₂O from
#: δ = 3e-4, Murphy (1977), J. Chem. Phys. 67, 5831; SO₂ from Bogaard et al. (1978), J. Chem. Soc.
#: Faraday Trans. 1 74, 3008; atoms and the tetrahedral CH₄ are isotropic, F = 1.
MOLECULES: Final[dict[str, Molecule]] = {
    "N2": Molecule(
        name="nitrogen",
        molar_mass=28.014e-3,
        refractivities=element_refractivity.n2_refractivity_bates1984,
        temperature=_AT_0,
        king_factors=king_factor.king_factor_n2_bates1984,
        limits=element_refractivity.N2_RANGE,
    ),
    "O2": Molecule(
        name="oxygen",
        molar_mass=31.998e-3,
        refractivities=element_refractivity.o2_refractivity_bates1984,
        temperature=_AT_0,
        king_factors=king_factor.king_factor_o2_bates1984,
        limits=element_refractivity.O2_RANGE,
    ),
    "Ar": Molecule(
        name="argon",
        molar_mass=39.95e-3,
        refractivities=element_refractivity.ar_refractivity_peck1964,
        temperature=_AT_0,
        limits=element_refractivity.AR_RANGE,
    ),
    "CO2": Molecule(
        name="carbon dioxide",
        molar_mass=44.009e-3,
        refractivities=refractive_index.co2_refractivity_bideau_mehu1973,
        temperature=refractive_index.CO2_TEMPERATURE,
        king_factors=king_factor.king_factor_co2_alms1975,
        limits=refractive_index.CO2_RANGE,
    ),
    "CH4": Molecule(
        name="methane",
        molar_mass=16.043e-3,
        refractivities=compound_refractivity.ch4_refractivity_he2021,
        temperature=_AT_15,
        limits=compound_refractivity.CH4_RANGE,
    ),
    "H2": Molecule(
        name="hydrogen",
        molar_mass=2.016e-3,
        refractivities=element_refractivity.h2_refractivity_peck1977,
        temperature=_AT_0,
        king_factors=king_factor.king_factor_h2_hohm1993,
        limits=element_refractivity.H2_RANGE,
    ),
    "He": Molecule(
        name="helium",
        molar_mass=4.0026e-3,
        refractivities=element_refractivity.he_refractivity_mansfield1969,
        temperature=_AT_0,
        limits=element_refractivity.HE_RANGE,
    ),
    "H2O": Molecule(
        name="water vapour",
        molar_mass=18.015e-3,
        refractivities=compound_refractivity.h2o_refractivity_ciddor1996,
        temperature=_AT_20,
        pressure=1333.0,
        king_factors=partial(constant_king_factor, value=1.0005),
        limits=compound_refractivity.H2O_RANGE,
    ),
    "SO2": Molecule(
        name="sulphur dioxide",
        molar_mass=64.06e-3,
        refractivities=compound_refractivity.so2_refractivity_static,
        temperature=_AT_0,
        king_factors=partial(constant_king_factor, value=1.0626),
        limits=compound_refractivity.SO2_RANGE,
    ),
    "CO": Molecule(
        name="carbon monoxide",
        molar_mass=28.010e-3,
        refractivities=compound_refractivity.co_refractivity_sneep2005,
        temperature=_AT_15,
        king_factors=partial(constant_king_factor, value=1.0161),
        limits=compound_refractivity.CO_RANGE,
    ),
    "N2O": Molecule(
        name="nitrous oxide",
        molar_mass=44.013e-3,
        refractivities=compound_refractivity.n2o_refractivity_he2021,
        temperature=_AT_15,
        king_factors=king_factor.king_factor_n2o_alms1975,
        limits=compound_refractivity.N2O_RANGE,
    ),
    "NH3": Molecule(
        name="ammonia",
        molar_mass=17.031e-3,
        refractivities=compound_refractivity.nh3_refractivity_cuthbertson1914,
        temperature=_AT_0,
        king_factors=king_factor.king_factor_nh3_hohm1993,
        limits=compound_refractivity.NH3_RANGE,
    ),
}
