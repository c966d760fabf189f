"""Venus: sunlight at the ground.

* Tomasko et al. (1979), Preliminary results of the solar flux radiometer experiment aboard the
  Pioneer Venus multiprobe mission, Science 203, 795: 0.4 to 1.0 µm; with the sun 67° from the
  zenith some 15 W m⁻² are absorbed by a dark ground. Later the same authors had the sun at 65.7°
  (Tomasko et al. 1985, Advances in Space Research 5, 71).
* Titov, Bullock, Crisp, Renno, Taylor & Zasova (2007), Radiation in the atmosphere of Venus, in
  Exploring Venus as a terrestrial planet, AGU Geophysical Monograph 176, section 1: 2.6 % of the
  sunlight reach the ground, global mean.
* Avduevsky et al. (1973), Venera 8: measurements of solar illumination through the atmosphere of
  Venus, J. Atmos. Sci. 30, 1215: some 1.5 % of what falls on the top; the sun was 5.5° high
  (Roscosmos).
* Kopp & Lean (2011), A new, lower value of total solar irradiance, Geophysical Research Letters 38,
  L01706: 1360.8 W m⁻².
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.planets import load_planet
from airlight.solvers import Solution
from airlight.spectra.sun import solar_irradiance
from airlight.validation.published.row import Row, Section, Solve
from airlight.validation.published.twilight import between, ground_light
from airlight.validation.suite import Bar

FloatArray = NDArray[np.float64]

#: Zenith angle of the sun where Pioneer's and Venera 8's probes fell. [deg]
PIONEER, VENERA_8 = 67.0, 84.5
#: Sunlight of all wavelengths at 1 au. [W m⁻²]
TOTAL: Final = 1360.8
#: Difference from Pioneer's flux that is aimed at. [%]
AIM: Final = 30.0
#: Wavelengths of Pioneer's radiometer. [nm]
_BAND: Final = np.arange(400.0, 1001.0)
_WAVELENGTHS: Final = tuple(float(nm) for nm in range(400, 1001, 50))
#: Quadrature points over the sun's zenith cosine.
_SUNS: Final = 6


def band_flux(solution: Solution, share: FloatArray) -> float:
    """Flux between 400 and 1000 nm of light given over the sun's. [W m⁻²]

    Parameters
    ----------
    solution : Solution
        Solution under the sun's spectrum at any distance.
    share : array, shape (nl,)
        Irradiance over that of the sun outside the air, positive. [1]
    """
    nm = solution.wavelengths
    nearer = float(np.mean(solution.lights[0].irradiance / solar_irradiance(nm)))
    spectrum = solar_irradiance(_BAND) * nearer
    return float(np.trapezoid(between(nm, share, _BAND) * spectrum, _BAND))


def ground_flux(solution: Solution, sun_zenith: float) -> float:
    """Flux on level ground between 400 and 1000 nm, the sun at a zenith angle [deg]. [W m⁻²]"""
    return band_flux(solution, ground_light(solution, 90.0 - sun_zenith))


def global_mean(solution: Solution) -> float:
    """Flux on the ground between 400 and 1000 nm, mean over the sphere. [W m⁻²]"""
    rule = gauss_legendre(_SUNS)
    zenith = np.degrees(np.arccos(rule.nodes))
    flux = np.array([ground_flux(solution, float(one)) for one in zenith])
    # Half of the sphere is lit; each zenith cosine has the same area.
    return float(0.5 * rule.weights @ flux)


def venus(solve: Solve, quality: object = "preview") -> Section:
    """Fluxes at the ground beside those of the probes.

    Parameters
    ----------
    solve : callable
        See ``row.Solve``.
    quality : str or Settings
    """
    planet = load_planet("venus")
    solution = solve(planet, _WAVELENGTHS, quality)
    top = band_flux(solution, np.ones(len(_WAVELENGTHS)))
    all_light = TOTAL * top / float(np.trapezoid(solar_irradiance(_BAND), _BAND))
    kept = 1.0 - np.asarray(solution.medium.ground_albedo)
    pioneer = Row(
        what="Pioneer Venus: flux absorbed by the ground, sun 23°", unit="W m⁻²", published=15.0,
        ours=band_flux(solution, ground_light(solution, 90.0 - PIONEER) * kept),
        stated="some 15", source="Tomasko et al. (1979)",
    )  # fmt: skip
    rows = [
        pioneer,
        Row(
            what="sunlight that reaches the ground, global mean", unit="%", published=2.6,
            ours=100.0 * global_mean(solution) / (0.25 * all_light),
            source="Titov et al. (2007)",
        ),
        Row(
            what="Venera 8: share of the light on the top, sun 5.5°", unit="%", published=1.5,
            ours=100.0
            * ground_flux(solution, VENERA_8)
            / (top * float(np.cos(np.radians(VENERA_8)))),
            source="Avduevsky et al. (1973)",
        ),
    ]  # fmt: skip
    aim = Bar(
        name="Pioneer Venus: difference of the flux at the ground", got=pioneer.percent,
        allowed=AIM, unit="%", source="the aim; the source states no error",
    )  # fmt: skip
    return Section(
        title="Sunlight at the ground of Venus", rows=rows, aims=[aim],
        note="Ours from 400 to 1000 nm, without the gases near the ground that absorb more blue "
        "and without the bands of carbon dioxide and water: too bright by these and by whatever "
        "the clouds absorb beyond the unknown absorber. Nothing is fitted.",
    )  # fmt: skip
