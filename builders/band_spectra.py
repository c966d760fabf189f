"""Remake ``docs/images/planets/earth-bands.png``: bands of gases beside G173 and spectrl2.

Run with ``python builders/band_spectra.py``; it needs pvlib and matplotlib. It prints the largest
differences in bands of 10 nm.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import matplotlib as mpl
import numpy as np
from numpy.typing import NDArray
from pvlib.spectrum import get_reference_spectra, spectrl2

from airlight import Plane, Scene, irradiance, load_planet, solve
from airlight.planets import Planet

mpl.use("Agg")
import matplotlib.pyplot as plt

FloatArray = NDArray[np.float64]

FILE = Path(__file__).parents[1] / "docs" / "images" / "planets" / "earth-bands.png"
CENTRES = np.arange(355.0, 1000.0, 10.0)
AIR_MASSES = (1.0, 2.0, 5.0)
#: Sun, tilt and turbidity of ASTM G173. [deg], [1]
ZENITH, TILT, TURBIDITY = 48.19, 37.0, 0.084


def standard_planet() -> Planet:
    """``earth`` with the aerosol and the carbon dioxide of G173, 0.084 at 500 nm and 370 ppm."""
    earth = load_planet("earth")
    factors = {"aerosol": 1.035, "carbon dioxide": 370.0 / 330.0}
    constituents, gases = (
        tuple(replace(one, amount=factors.get(one.name, 1.0)) for one in parts)
        for parts in (earth.constituents, earth.gases)
    )
    return replace(earth, constituents=constituents, gases=gases)


def band_means(nm: FloatArray, values: FloatArray) -> FloatArray:
    """Means over the bands of values at wavelengths."""
    inside = 5.0 * (2.0 * (np.arange(200) + 0.5) / 200.0 - 1.0)
    return np.asarray(np.interp(CENTRES[:, None] + inside, nm, values).mean(axis=1))


def bird_riordan(air_mass: float) -> FloatArray:
    """Direct normal irradiance of spectrl2 over that outside the air, at its wavelengths."""
    found = spectrl2(
        apparent_zenith=float(np.degrees(np.arccos(1.0 / air_mass))),
        aoi=0.0,
        surface_tilt=0.0,
        ground_albedo=0.2,
        surface_pressure=101325.0,
        relative_airmass=air_mass,
        precipitable_water=1.42,
        ozone=0.345,
        aerosol_turbidity_500nm=TURBIDITY,
        dayofyear=94,
        alpha=1.3,
    )
    ratio = (found["dni"] / found["dni_extra"]).ravel()
    return np.stack([np.asarray(found["wavelength"], float), ratio])


def main() -> None:
    """Solve, draw and print."""
    planet = standard_planet()
    solution = solve(planet, CENTRES, "preview", bandwidth=10.0)
    scene = Scene(altitude=0.0, sun_zenith=ZENITH, sun_azimuth=180.0)
    plane = Plane(tilt=TILT, azimuth=180.0)
    ours = irradiance(solution, scene, plane=plane, spectral=True)
    known = get_reference_spectra()
    nm = known.index.to_numpy()
    means = {one: band_means(nm, known[one].to_numpy()) for one in known.columns}
    flat = {one: means[one] / means["extraterrestrial"] for one in ("direct", "global")}
    sun = ours["extraterrestrial"].to_numpy()
    pairs = {
        "direct": (ours["dni"].to_numpy() / sun, flat["direct"]),
        "global": (ours["poa"].to_numpy() / sun, flat["global"]),
    }
    figure, (top, bottom) = plt.subplots(
        2, 1, figsize=(8.0, 7.0), sharex=True, layout="constrained"
    )
    for name, color in (("global", "C1"), ("direct", "C0")):
        top.plot(CENTRES, flat[name] * sun, color=color, lw=3.0, alpha=0.35, label=f"G173, {name}")
        top.plot(CENTRES, pairs[name][0] * sun, color=color, lw=1.2, label=f"airlight, {name}")
        error = 100.0 * (pairs[name][0] / pairs[name][1] - 1.0)
        bottom.plot(CENTRES, error, color=color, lw=1.5, label=f"over G173, {name}")
        worst = np.argsort(-np.abs(error))[:12]
        print(name, ", ".join(f"{CENTRES[k]:g}: {error[k]:+.1f} %" for k in np.sort(worst)))
    for air_mass, color in zip(AIR_MASSES, ("C2", "C3", "C4"), strict=True):
        zenith = float(np.degrees(np.arccos(1.0 / air_mass)))
        direct = solution.transmittance(altitude=0.0, view_zenith=zenith).to_numpy()
        ratio = band_means(*bird_riordan(air_mass))
        error = 100.0 * (direct / ratio - 1.0)
        name = f"over spectrl2, direct, air mass {air_mass:g}"
        bottom.plot(CENTRES, error, color=color, lw=0.8, label=name)
        worst = np.argsort(-np.abs(error))[:12]
        print(name, ", ".join(f"{CENTRES[k]:g}: {error[k]:+.1f} %" for k in np.sort(worst)))
    top.set_ylabel("irradiance [W m$^{-2}$ nm$^{-1}$]")
    top.legend()
    bottom.set_ylabel("difference [%]")
    bottom.set_xlabel("wavelength [nm], bands of 10 nm")
    bottom.set_ylim(-30.0, 30.0)
    bottom.grid(alpha=0.3)
    bottom.legend(fontsize=8)
    figure.savefig(FILE, dpi=100)


if __name__ == "__main__":
    main()
