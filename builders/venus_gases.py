"""Print what carbon dioxide and water vapour absorb on Venus, as ``venus.toml`` has it.

Run with ``python builders/venus_gases.py FOLDER`` where PythonicDISORT is installed (the extra
``dev``). FOLDER has ``Wolf_HITRAN2016_solar_38_CO2.dat`` and ``Wolf_HITRAN2016_solar_38_H2O.dat``
from ``CLIMA/DATA`` of https://github.com/VirtualPlanetaryLaboratory/atmos (commit 54934f68): eight
coefficients with weights for each of 38 intervals of the spectrum, eight temperatures up to 600 K
and pressures up to 100 bar, by E. T. Wolf with HELIOS-K (Grimm & Heng 2015, ApJ 808, 182) from
HITRAN 2016 (Gordon et al. 2017, JQSRT 203, 3). Lines of carbon dioxide reach 500 cm^-1 and are
sub-Lorentzian (Perrin & Hartmann 1989, JQSRT 42, 311), those of water 25 cm^-1.

A mean over lines obeys no Beer's law, and a planet file has one coefficient at a wavelength. The
one printed lets through to the ground what the sum over the eight lets through, below the clouds
and in the air of the preset, with the sun at 67 degrees from the zenith; each gas is fitted alone.
What both together let through is printed beside the sum over all sixty-four pairs.
"""

from __future__ import annotations

import sys
from itertools import pairwise
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from airlight.planets import Medium, load_planet, replace
from disort import Layers, ground, layers

FloatArray = NDArray[np.float64]

FILES = {gas: f"Wolf_HITRAN2016_solar_38_{gas}.dat" for gas in ("CO2", "H2O")}
#: Ends of the intervals 11 to 20. [cm^-1]
ENDS = (
    17649.0,
    16528.0,
    16000.0,
    15000.0,
    14470.0,
    13300.0,
    12790.0,
    11870.0,
    11220.0,
    10400.0,
    9650.0,
)
FIRST = 11
#: Temperatures [K] read at each pressure [bar]: those of Venus (Seiff et al. 1985), within 600 K.
#: The mean of the logarithms is taken where there are two.
STATES = {0.1: (300.0,), 1.0: (350.0,), 10.0: (400.0, 600.0), 100.0: (600.0,)}
#: Constituent of water vapour, and that of the air, which has the bands of carbon dioxide.
WATER, AIR = "water vapour", "air"
SUN, STREAMS, LAYERS = 67.0, 16, 200
GRAVITY, MASS, PASCALS = 8.87, 43.45 * 1.66053907e-27, 1e5  # m/s^2, kg, Pa/bar


def read(path: Path) -> tuple[FloatArray, dict[tuple[int, float, float], FloatArray]]:
    """Weights (8,), and coefficients (8,) [m^2] by interval, temperature [K] and pressure [bar]."""
    weights, found, head = [], {}, []
    for line in path.read_text(encoding="utf-8").splitlines():
        numbers = [] if line.startswith(("#", "!", "Q")) else [float(x) for x in line.split()]
        if len(numbers) == 2:
            weights.append(numbers[0])
        elif len(numbers) == 1:
            head = [*head[-1:], numbers[0]]
        elif len(numbers) == 9:
            found[int(head[0]), head[1], numbers[0]] = 1e-4 * np.array(numbers[1:])
    return np.array(weights), found


def by_pressure(
    found: dict[tuple[int, float, float], FloatArray], interval: int, pressure: FloatArray
) -> FloatArray:
    """Coefficients at pressures [bar], shape (8, n); none in an interval without lines. [m^2]"""
    if (interval, 600.0, 100.0) not in found:
        return np.zeros((8, pressure.size))
    known = np.array([
        np.mean([np.log(found[interval, t, p]) for t in ts], axis=0) for p, ts in STATES.items()
    ])  # fmt: skip
    at = np.log(np.clip(pressure, *list(STATES)[:: len(STATES) - 1]))
    return np.exp([np.interp(at, np.log(list(STATES)), one) for one in known.T])


def gas_columns(medium: Medium, air: Layers, name: str) -> FloatArray:
    """Molecules of a constituent above a square metre of each layer, by its absorption of 1 m^2."""
    index = list(medium.names).index(name)
    z = np.linspace(0.0, medium.thickness, 80_001)
    density = medium.density.at(z)[index]
    column = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(z))])
    return -np.diff(np.interp(air.edges, z, column))


def one_coefficient(
    air: Layers, albedo: float, columns: FloatArray, kept: float, free: float
) -> float:
    """Cross-section that lets through as much as is kept; 0 where nothing is lost. [m^2]"""
    if kept >= 0.9999 * free:
        return 0.0

    def beyond(logarithm: float) -> float:
        return ground(air, SUN, albedo, np.exp(logarithm) * columns) - kept

    return float(np.exp(brentq(beyond, np.log(1e-35), np.log(1e-25))))


def main() -> None:
    """Print wavelengths, cross-sections and how good they are."""
    folder = Path(sys.argv[1])
    tables = {gas: read(folder / name) for gas, name in FILES.items()}
    venus = load_planet("venus")
    by_name = {c.name: c for c in venus.constituents}
    gases = {"CO2": by_name[AIR].absorption, "H2O": by_name[WATER].absorption}
    profiles = {"CO2": AIR, "H2O": WATER}
    bare = replace(venus, constituents=tuple(
        replace(c, absorption=0.0) if c.name in (WATER, AIR) else c for c in venus.constituents
    ))  # fmt: skip
    centres = [0.5 * (1e7 / a + 1e7 / b) for a, b in pairwise(ENDS)]
    medium = Medium.from_planet(bare, centres)
    print("interval: light without, with CO2, H2O, both (by one each); cross-sections [m^2]")
    lists: dict[str, list[str]] = {gas: [] for gas in FILES}
    for w in range(len(centres)):
        interval = FIRST + w
        air = layers(medium, LAYERS, STREAMS, w)
        albedo = float(np.ravel(medium.ground_albedo)[w])
        columns = {
            gas: one.number_density * one.fraction * gas_columns(medium, air, profiles[gas])
            for gas, one in gases.items()
        }
        number = columns["CO2"] / gases["CO2"].fraction
        pressure = (np.cumsum(number) - 0.5 * number) * MASS * GRAVITY / PASCALS
        free = ground(air, SUN, albedo)
        depths, kept, one = {}, {}, {}
        for gas, (weights, found) in tables.items():
            depths[gas] = by_pressure(found, interval, pressure) * columns[gas]
            kept[gas] = weights @ [ground(air, SUN, albedo, x) for x in depths[gas]]
            one[gas] = one_coefficient(air, albedo, columns[gas], kept[gas], free)
            lists[gas].append(f'"{1e4 * one[gas]:.4g} cm^2"')
        both = sum(
            wa * wb * ground(air, SUN, albedo, a + b)
            for wa, a in zip(tables["CO2"][0], depths["CO2"], strict=True)
            for wb, b in zip(tables["H2O"][0], depths["H2O"], strict=True)
        )
        ours = ground(air, SUN, albedo, sum(one[gas] * columns[gas] for gas in FILES))
        print(
            f"{interval}: {1e7 / ENDS[w]:.1f} to {1e7 / ENDS[w + 1]:.1f} nm: {free:.4f}, "
            + ", ".join(f"{kept[gas] / free:.3f}" for gas in FILES)
            + f", {both / free:.3f} ({ours / free:.3f}); {one['CO2']:.3e}, {one['H2O']:.3e}",
            flush=True,
        )
    print([f"{1e7 / end:.2f}" for end in ENDS])
    for gas, numbers in lists.items():
        print(gas, ", ".join(numbers))


if __name__ == "__main__":
    main()
