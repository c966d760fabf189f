"""Errata of Table 1 of the OpenSpace paper."""

from __future__ import annotations

from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.constants import BOLTZMANN
from airlight.kernel import vectorized
from airlight.optics.anomalous_diffraction import efficiencies
from airlight.optics.legendre import legendre_moments
from airlight.optics.phase_functions import double_henyey_greenstein
from airlight.optics.rayleigh import (
    cross_section,
    king_factor_from_depolarisation,
    number_density,
    scale_height,
)
from airlight.optics.refractive_index import (
    AIR_TEMPERATURE,
    CO2_TEMPERATURE,
    STANDARD_PRESSURE,
    air_refractivity_peck1972,
    co2_refractivity_bideau_mehu1973,
)
from airlight.planets import Medium, load_planet
from airlight.validation.errata.erratum import Erratum, floats
from airlight.validation.errata.openspace import LOBES, PRINTED_LOBES

FloatArray = npt.NDArray[np.float64]

#: The wavelengths of the paper. [nm]
WAVELENGTHS: Final = (680.0, 550.0, 440.0)
_AT: Final = "at 680, 550, 440 nm"

#: Depolarisation of the Earth's air in the standard mode (Penndorf) and of carbon dioxide.
AIR_DEPOLARISATION: Final = 0.035
CO2_DEPOLARISATION: Final = 0.09
#: Refractivity of air at 440 nm and of carbon dioxide at 680, 550 and 440 nm, as printed.
PRINTED_AIR: Final = 2.8276e-4
PRINTED_CO2: Final = (4.4661e-4, 4.5019e-4, 4.5558e-4)
#: Number density on Mars as printed, and in its proper unit. [m⁻³]
PRINTED_MARS_DENSITY: Final = 2.8e35
MARS_DENSITY: Final = 2.8e23
#: Rayleigh coefficients of Mars, as printed. [m⁻¹]
PRINTED_MARS: Final = (1.2871e-3, 3.0560e-3, 7.6406e-3)
#: State of the air at the ground of Mars: NASA's Mars fact sheet, as in the preset ``mars``.
_MARS_TEMPERATURE: Final = 215.0
_MARS_MOLAR_MASS: Final = 43.34e-3
_MARS_GRAVITY: Final = 3.73
#: Dust of Mars: radius [m], index, and the paper's K.
DUST_RADIUS: Final = 1.6e-6
DUST_INDEX: Final = (1.52 + 0.001j, 1.52 + 0.006j, 1.52 + 0.013j)
PRINTED_K: Final = (0.31, 0.16, 0.27)
#: Extinction of the dust in OpenSpace's assets, 53.61771e-3/0.98979 per km. [m⁻¹]
OPENSPACE_DUST: Final = 53.61771e-6 / 0.98979


def openspace_table() -> list[Erratum]:
    """The rows of Table 1."""
    return [
        _earth_extinction(),
        _earth_index(),
        _mars_rayleigh(),
        _mars_density(),
        _mars_index(),
        _dust_index(),
        _dust_lobes(),
        _mars_height(),
        _dust_albedo(),
    ]


def literal_turbidity(turbidity: float, factors: tuple[float, ...]) -> FloatArray:
    """Scattering coefficient of OS Eq 17 as printed, for v = 4, read in m⁻¹, shape (nl,).

    Parameters
    ----------
    turbidity : float
        T. [1]
    factors : tuple of float
        K at 680, 550 and 440 nm. [1]

    Examples
    --------
    >>> f"{literal_turbidity(2.0, (0.0096, 0.0092, 0.0089))[1]:.3e}"
    '1.064e-04'
    """
    concentration = (0.65 * turbidity - 0.65) * 1e-16
    wavenumber = 2.0 * np.pi / (1e-9 * np.array(WAVELENGTHS))
    return np.asarray(0.434 * concentration * np.pi * wavenumber**2 * np.array(factors))


def _earth_extinction() -> Erratum:
    medium = Medium.from_planet(load_planet("earth-openspace"), [550.0])
    scattering = float(medium.scattering[1, 0])
    return Erratum(
        source="OS Table 1, Earth",
        printed="β_ext = 0.1 β_sca",
        here="absorption is 0.1 of scattering/0.9",
        quantity="single-scattering albedo of the aerosol",
        as_printed=(scattering / (0.1 * scattering),),
        as_here=floats(medium.single_scattering_albedo[1]),
        remark="more would be scattered than is met",
    )


def _earth_index() -> Erratum:
    blue = WAVELENGTHS[2]
    density = number_density(AIR_TEMPERATURE, STANDARD_PRESSURE)
    factor = king_factor_from_depolarisation(AIR_DEPOLARISATION)

    def values(refractivity: float) -> tuple[float, ...]:
        sigma = float(cross_section(blue, refractivity, density, factor))
        return (1.0 + refractivity, 1e6 * density * sigma)

    own = float(air_refractivity_peck1972(blue))
    violet = float(air_refractivity_peck1972(400.0))
    return Erratum(
        source="OS Table 1, Earth",
        printed="m(440) = 1.00028276",
        here="1.00028091",
        quantity="m(440), β_R(440) at 15 °C [1e-6 m⁻¹]",
        as_printed=values(PRINTED_AIR),
        as_here=values(own),
        remark=f"the printed one is that of 400 nm, {1.0 + violet:.8f}",
    )


def _mars_coefficients(density: float, refractivities: npt.ArrayLike) -> FloatArray:
    """Rayleigh coefficients of Table 1's carbon dioxide at a density, in 1e-6 m⁻¹."""
    measured = number_density(CO2_TEMPERATURE, STANDARD_PRESSURE)
    factor = king_factor_from_depolarisation(CO2_DEPOLARISATION)
    sigma = cross_section(WAVELENGTHS, refractivities, measured, factor)
    return np.asarray(1e6 * density * sigma)


def _mars_rayleigh() -> Erratum:
    here = _mars_coefficients(MARS_DENSITY, co2_refractivity_bideau_mehu1973(WAVELENGTHS))
    ratio = 1e6 * PRINTED_MARS[1] / here[1]
    return Erratum(
        source="OS Table 1, Mars",
        printed="β_R = (1.2871, 3.0560, 7.6406)e-3",
        here="n and N of the same state",
        quantity=f"β_R {_AT}, N = 2.8e23 m⁻³",
        unit="1e-6 m⁻¹",
        as_printed=floats(1e6 * value for value in PRINTED_MARS),
        as_here=floats(here),
        remark=f"{ratio:.0f} times too large at 550 nm: n of 0 °C and 1 atm with N of Mars",
    )


def _mars_density() -> Erratum:
    return Erratum(
        source="OS Table 1, Mars",
        printed="N = 2.8e29 cm⁻³, ρ_CO₂ = 2.8e23 mol m⁻³",
        here="2.8e17 cm⁻³ = 2.8e23 m⁻³, molecules",
        quantity="pressure at 215 K",
        unit="Pa",
        as_printed=(PRINTED_MARS_DENSITY * BOLTZMANN * _MARS_TEMPERATURE,),
        as_here=(MARS_DENSITY * BOLTZMANN * _MARS_TEMPERATURE,),
    )


def _mars_index() -> Erratum:
    own = co2_refractivity_bideau_mehu1973(WAVELENGTHS)
    sides = [_mars_coefficients(MARS_DENSITY, values)[2] for values in (PRINTED_CO2, own)]
    return Erratum(
        source="OS Table 1, Mars",
        printed="n_CO₂(440) = 1.00045558",
        here="1.00045588",
        quantity="n_CO₂(440), β_R(440) [1e-6 m⁻¹]",
        as_printed=floats([1.0 + PRINTED_CO2[2], sides[0]]),
        as_here=floats([1.0 + own[2], sides[1]]),
    )


def _dust_efficiencies() -> tuple[FloatArray, FloatArray]:
    """Extinction and scattering of the dust by anomalous diffraction, shape (nl,)."""
    pairs = [
        efficiencies(DUST_RADIUS, nm, index)
        for nm, index in zip(WAVELENGTHS, DUST_INDEX, strict=True)
    ]
    extinction, scattering = np.array([floats(pair) for pair in pairs]).T
    return extinction, scattering


def _dust_index() -> Erratum:
    extinction, scattering = _dust_efficiencies()
    return Erratum(
        source="OS Table 1, Mars",
        printed="n = 1.52, m = (.001i, .006i, .013i), both in nm",
        here="m = 1.52, k = (.001, .006, .013), dimensionless",
        quantity=f"Q_ext and albedo by Eq 19 {_AT}, r = 1.6 µm",
        as_here=floats([*extinction, *(scattering / extinction)]),
        remark="with a real part of 0 the formulas have no value",
    )


def _dust_lobes() -> Erratum:
    lobes = vectorized(double_henyey_greenstein)

    def cosine(lobe: tuple[float, float, float]) -> float:
        return float(legendre_moments(lambda nu: lobes(nu, *lobe), 1)[1])

    return Erratum(
        source="OS Table 1, Mars",
        printed="g₁ (.03, .4, .67), g₂ (.094, .89, .099), α (.743, .04, .01)",
        here="g₁ .889, g₂ .094, α .743, or exact Mie",
        quantity=f"mean cosine {_AT}",
        as_printed=floats(cosine(lobe) for lobe in PRINTED_LOBES),
        as_here=(cosine(LOBES),) * len(PRINTED_LOBES),
        remark="rows and columns shuffled",
    )


def _mars_height() -> Erratum:
    height = scale_height(_MARS_TEMPERATURE, _MARS_MOLAR_MASS, _MARS_GRAVITY)
    return Erratum(
        source="OS Table 1, Mars",
        printed="H_R = 8 km",
        here="RT/(Mg)",
        quantity="scale height at 215 K",
        unit="km",
        as_printed=(8.0,),
        as_here=(1e-3 * height,),
        remark="8 km is the Earth's",
    )


def _dust_albedo() -> Erratum:
    extinction, scattering = _dust_efficiencies()
    printed = literal_turbidity(2.0, PRINTED_K) / OPENSPACE_DUST
    return Erratum(
        source="OS Table 1, Mars",
        printed="T in [2, 10], K = (.31, .16, .27)",
        here="Q_sca by anomalous diffraction or Mie",
        quantity=f"single-scattering albedo {_AT}, Eq 17 at T = 2 over OpenSpace's extinction",
        as_printed=floats(printed),
        as_here=floats(scattering / extinction),
    )
