"""Errata of the formulas of the OpenSpace paper."""

from __future__ import annotations

from typing import Any, Final

import numpy as np
import numpy.typing as npt

from airlight.kernel import vectorized
from airlight.optics.air_mass import air_mass_pickering2002
from airlight.optics.density_profile import row_column
from airlight.optics.legendre import phase_integral
from airlight.optics.phase_functions import double_henyey_greenstein, henyey_greenstein
from airlight.optics.rayleigh import king_factor_from_depolarisation
from airlight.optics.size_distribution import gamma_density
from airlight.planets import Medium, load_planet
from airlight.planets.matter.gas_mixture import LARGEST_DEPOLARISATION
from airlight.validation.errata.erratum import Erratum, floats

FloatArray = npt.NDArray[np.float64]

#: Two lobes of the dust of Mars, g₁, g₂ and α, and the three columns that Table 1 prints for it.
LOBES: Final = (0.889, 0.094, 0.743)
PRINTED_LOBES: Final = ((0.03, 0.094, 0.743), (0.4, 0.89, 0.04), (0.67, 0.099, 0.01))
#: Depolarisation of air in Table 1, and the factor by which Fig 1 raises it.
DEPOLARISATION: Final = 0.0279
FACTOR: Final = 20.0


def openspace() -> list[Erratum]:
    """The rows of the equations and of Fig 1."""
    return [
        _oxygen(),
        _sizes(),
        _two_lobes(),
        _particle_height(),
        _pickering(),
        _polarizability(),
    ]


def _oxygen() -> Erratum:
    height, thickness = 8e3, 100e3

    def column(sign: float) -> float:
        edges, terms = np.array([0.0, thickness]), np.array([[1.0, sign / height, 0.0, 0.0]])
        return 1e-3 * row_column((edges, terms))

    return Erratum(
        source="OS Eq 14",
        printed="e^{+h/H}",
        here="e^{-h/H}",
        quantity="column of oxygen over its density at the ground, H = 8 km, 100 km high",
        unit="km",
        as_printed=(column(1.0),),
        as_here=(column(-1.0),),
        remark="the gas would thicken upwards",
    )


def _sizes() -> Erratum:
    radius, variance = 1.6e-6, 0.3
    radii = np.array([radius, 5e-6, 10e-6])
    here = gamma_density(radii, radius, variance)
    printed = here * np.exp(2.0 * radii / (radius * variance))
    return Erratum(
        source="OS Eq 19, N(r)",
        printed="e^{+r/(ab)}",
        here="e^{-r/(ab)}",
        quantity="N(5 µm)/N(1.6 µm), N(10 µm)/N(1.6 µm) for a = 1.6 µm, b = 0.3",
        as_printed=floats(printed[1:] / printed[0]),
        as_here=floats(here[1:] / here[0]),
        remark="as printed the number of particles has no end",
    )


def printed_two_lobes(nu: Any, g1: float, g2: float, alpha: float) -> FloatArray:
    """OS Eq 16 as printed, with 1 + g₁² in both numerators. [sr⁻¹]

    Parameters
    ----------
    nu : array, shape (...)
        Cosine of the scattering angle. [1]
    g1, g2, alpha : float
        [1]
    """
    lobe = vectorized(henyey_greenstein)
    first = (1.0 + g1 * g1) / (1.0 - g1 * g1) * lobe(nu, g1)
    second = (1.0 + g1 * g1) / (1.0 - g2 * g2) * lobe(nu, g2)
    return np.asarray(alpha * first + (1.0 - alpha) * second)


def _two_lobes() -> Erratum:
    sets = (LOBES, *PRINTED_LOBES)
    here = vectorized(double_henyey_greenstein)
    return Erratum(
        source="OS Eq 16",
        printed="(1+g₁²) twice",
        here="(1-g₁²), (1-g₂²)",
        quantity="integral over the sphere, for g₁ 0.889, g₂ 0.094, α 0.743 and for the three "
        "columns of Table 1",
        as_printed=floats(
            phase_integral(lambda nu, s=s: printed_two_lobes(nu, *s))  # type: ignore[misc]
            for s in sets
        ),
        as_here=floats(
            phase_integral(lambda nu, s=s: here(nu, *s))  # type: ignore[misc]
            for s in sets
        ),
        remark="every scattering would make light",
    )


def _particle_height() -> Erratum:
    planet = load_planet("earth-openspace")
    medium = Medium.from_planet(planet, [550.0])
    extinction = medium.extinction[1, 0]
    return Erratum(
        source="OS Eq 18",
        printed="e^{-h/H_R}",
        here="the scale height of the particles",
        quantity="vertical optical depth of the Earth's aerosol",
        as_printed=(float(extinction * medium.columns[0]),),
        as_here=(float(extinction * medium.columns[1]),),
    )


def _pickering() -> Erratum:
    altitudes = np.array([0.0, 1.0, 5.0, 10.0])

    lift = 244.0 / (165.0 + 47.0 * altitudes) ** 1.1
    return Erratum(
        source="OS Eq 21",
        printed="244/(165+47h)^{1.1}",
        here="244/(165+47h^{1.1}), degrees",
        quantity="air mass at altitudes 0°, 1°, 5°, 10°",
        as_printed=floats(1.0 / np.sin(np.radians(altitudes + lift))),
        as_here=floats(air_mass_pickering2002(altitudes)),
        remark="and it is a ratio of columns, no length of a path",
    )


def _polarizability() -> Erratum:
    raised = FACTOR * DEPOLARISATION
    largest = min(raised, LARGEST_DEPOLARISATION)
    # Above 6/7 the King factor is negative: 20 x 0.035 = 0.7 comes near.
    return Erratum(
        source="OS Fig 1",
        printed='20 x "polarizability", δ = 0.558',
        here="δ is a depolarisation factor, held at 0.5",
        quantity="King factor f(δ)",
        as_printed=floats([king_factor_from_depolarisation(raised)]),
        as_here=floats([king_factor_from_depolarisation(largest)]),
        remark=f"f is singular at 6/7 = {6 / 7:.3f}; rods, the least round molecules, have 0.5",
    )
