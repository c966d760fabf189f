"""What temperatures measured over altitude change in the light of Mars, from noon to night.

``python benchmarks/mars_air.py`` prints the table of docs/planets.md, a minute: light of the
zenith, of the sky 2° above the horizon below the sun, and of the level ground, over the same with
air and dust in one exponential each, as preset ``mars`` had them before; then with dust that ends
(Conrath 1975), and with bent light.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight import Planet, solve
from airlight.planets import load_planet, replace
from airlight.planets.matter.profiles import Exponential, Sounding, Tabulated
from airlight.solver.solution import Solution
from airlight.validation.published.twilight import ground_light, zenith_light

FloatArray = NDArray[np.float64]

#: Altitudes of the sun. [deg]
ALTITUDES: Final = (60.0, 10.0, 0.0, -4.0, -8.0, -12.0)
#: Wavelengths. [nm]
WAVELENGTHS: Final = (680.0, 550.0, 440.0)
#: Scale heights of the gas at 215 K, 3.73 m/s², and of the dust, of the exponentials. [m]
GAS: Final = 11.02e3
DUST: Final = 11e3
#: Conrath's parameter of the dust's end, as climate models have it (Forget et al. 1999).
CONRATH: Final = 0.007


def variants() -> dict[str, Planet]:
    """``mars`` in exponentials, as it is, with dust that ends, and with bent light."""
    mars = load_planet("mars")
    air, dust = mars.constituents
    exponential = (
        replace(air, profile=Exponential(scale_height=GAS)),
        replace(dust, profile=Exponential(scale_height=DUST)),
    )
    return {
        "exponentials": replace(mars, constituents=exponential),
        "measured temperatures": mars,
        "dust that ends": replace(mars, constituents=(air, replace(dust, profile=ending(mars)))),
        "bent light": replace(mars, refraction="bouguer"),
    }


def ending(mars: Planet) -> Tabulated:
    """Density of dust whose share of the gas is exp(ν(1 - p₀/p)) (Conrath 1975, Icarus 24, 36)."""
    gas = mars.constituents[0].profile
    assert isinstance(gas, Sounding)
    assert gas.air is not None
    altitudes = np.arange(0.0, 80e3, 2e3)
    share = np.exp(CONRATH * (1.0 - 1.0 / gas.air.pressure_ratio(altitudes)))
    densities = gas.air.density_ratio(altitudes) * share
    return Tabulated(altitudes=tuple(altitudes.tolist()), densities=tuple(densities.tolist()))


def light(solution: Solution, altitude: float) -> FloatArray:
    """Zenith, horizon [sr⁻¹] and level ground [1] over the sun's light, shape (3, nl)."""
    low = solution.radiance(altitude=0.0, sun_zenith=90.0 - altitude, view_zenith=88.0, azimuth=0.0)
    return np.array([
        zenith_light(solution, altitude),
        np.asarray(low) / solution.lights[0].irradiance,
        ground_light(solution, altitude),
    ])  # fmt: skip


def main() -> None:
    """Solve and print."""
    solved = {name: solve(one, WAVELENGTHS, "default") for name, one in variants().items()}
    for name, one in solved.items():
        print(f"{name}: {one.report}")
    first = next(iter(solved.values()))
    for name, one in list(solved.items())[1:]:
        print(f"\n{name}: zenith, 2° above the horizon, ground; {WAVELENGTHS} nm\n")
        for altitude in ALTITUDES:
            base, now = light(first, altitude), light(one, altitude)
            row = [" ".join(f"{x:.3f}" for x in part) for part in now / base]
            row += [" ".join(f"{x:.2e}" for x in part) for part in base]
            print(f"| {altitude:g}° | " + " | ".join(row) + " |")


if __name__ == "__main__":
    main()
