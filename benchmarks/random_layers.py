"""Random thin layers on three planets, against Monte Carlo.

    python benchmarks/random_layers.py --count 200 --error 0.005 --quality default preview

Layers: a tent, a slab with ramps, fog, a bell curve or haze at the top of the shell, 10 m to 5 km
thick, at 0 to 90 km, optical depth 0.01 to 30, scattering or absorbing, in gas over a grey ground,
of Earth, Mars and a planet of 500 km. Six lines of sight each, from 2 m and from 400 km, sun 0 to
88 degrees. Prints one line a layer, then median, 95 % and largest of |difference| and of what two
standard errors of the Monte Carlo do not explain, over radiances above 1e-6 of the star's
irradiance. Reference radiances are kept in ``--keep FOLDER``.
"""

from __future__ import annotations

import argparse
import json
import time
from pathlib import Path
from typing import Any

import numpy as np

import airlight
from airlight.planets import Constituent, Planet
from airlight.planets.ground import Ground
from airlight.planets.matter.phases import HenyeyGreenstein, Rayleigh
from airlight.planets.matter.profiles import Exponential, Tabulated, Tent
from airlight.planets.star import Star
from airlight.solver.montecarlo.settings import MonteCarloSettings

#: Radius of the ground, thickness of the shell, scale height of the gas [m], its scattering at the
#: ground [/m], and albedo.
WORLDS = {
    "earth": (6371e3, 100e3, 8e3, 1.2e-5, 0.1),
    "mars": (3390e3, 100e3, 11e3, 4e-7, 0.2),
    "small": (500e3, 60e3, 6e3, 1e-5, 0.3),
}
KINDS = ("tent", "slab", "fog", "bell", "top")
#: Radiance below which a difference does not count, over the star's irradiance. [1/sr]
LEAST = 1e-6


def curve(altitudes: list[float], densities: list[float], top: float) -> Tabulated:
    """Profile through some points, 0 below and above."""
    h, d = np.array(altitudes), np.array(densities)
    inside = (h > 0.0) & (h < top)
    h, d = h[inside], d[inside]
    step = 0.3 * float(np.diff(h).mean())
    ends = [0.0, float(h[0]) - step, *h.tolist(), float(h[-1]) + step, top]
    values = [1e-30, 1e-30, *d.tolist(), 1e-30, 1e-30]
    keep = [k for k, at in enumerate(ends) if k == 0 or ends[k - 1] < at <= top]
    return Tabulated(
        altitudes=tuple(ends[k] for k in keep), densities=tuple(values[k] for k in keep)
    )


def layer(rng: np.random.Generator, kind: str, top: float) -> tuple[Any, dict[str, Any]]:
    """Profile of one layer, and what describes it; lengths in metres."""
    thick = float(np.exp(rng.uniform(np.log(10.0), np.log(5e3))))
    z = float(rng.uniform(0.0, min(90e3, 0.9 * top)))
    if kind == "fog":
        return Exponential(scale_height=max(thick / 4.0, 2.5)), {"thick": thick, "altitude": 0.0}
    if kind == "top":
        z = top - thick
    if kind == "tent":
        z = max(z, 0.5 * thick + 1.0)
        return Tent(center=z, half_width=0.5 * thick), {"thick": thick, "altitude": z}
    if kind == "bell":
        z = max(z, thick + 1.0)
        h = z + np.linspace(-3.0, 3.0, 25) * thick / 5.0
        densities = np.exp(-0.5 * ((h - z) / (thick / 5.0)) ** 2)
        return curve(h.tolist(), densities.tolist(), top), {"thick": thick, "altitude": z}
    ramp = 0.1 * thick
    h = z + np.array([0.01, 0.5, 1.0]) * ramp
    inner = [*h.tolist(), *(z + thick - (h - z))[::-1].tolist()]
    return curve(inner, [0.01, 0.5, 1.0, 1.0, 0.5, 0.01], top), {"thick": thick, "altitude": z}


def case(seed: int) -> tuple[dict[str, Any], Planet, dict[str, list[float]]]:
    """Description, planet and lines of sight."""
    rng = np.random.default_rng(seed)
    name = tuple(WORLDS)[seed % len(WORLDS)]
    radius, top, height, gas, albedo = WORLDS[name]
    kind = str(rng.choice(KINDS))
    profile, about = layer(rng, kind, top)
    depth = float(np.exp(rng.uniform(np.log(0.01), np.log(30.0))))
    kept = float(rng.choice([1.0, 0.95, 0.5, 0.0], p=[0.4, 0.3, 0.15, 0.15]))
    g = float(rng.choice([0.0, 0.6, 0.8, 0.85])) if kept > 0.0 else 0.0
    strength = depth / profile.column(top)
    planet = Planet(
        name=name, bottom_radius=radius, top_radius=radius + top, ground=Ground(albedo=albedo),
        star=Star(irradiance=1.0, angular_radius=0.0047), default_wavelengths=(550.0,),
        constituents=(
            Constituent(
                name="gas", profile=Exponential(scale_height=height), scattering=gas,
                phase_function=Rayleigh(),
            ),
            Constituent(
                name="layer", profile=profile, scattering=strength * kept,
                absorption=strength * (1.0 - kept), phase_function=HenyeyGreenstein(asymmetry=g),
            ),
        ),
    )  # fmt: skip
    lines: list[tuple[float, float, float, float]] = []
    for sun in (float(rng.uniform(0.0, 60.0)), float(rng.uniform(60.0, 88.0))):
        azimuth = float(rng.uniform(0.0, 180.0))
        down = 180.0 - float(rng.uniform(0.0, 20.0 if name == "small" else 40.0))
        views = ((2.0, rng.uniform(0.0, 75.0)), (2.0, rng.uniform(75.0, 89.0)), (400e3, down))
        lines += [(eye, sun, float(view), azimuth) for eye, view in views]
    names = ("altitude", "sun_zenith", "view_zenith", "azimuth")
    where = {one: [line[k] for line in lines] for k, one in enumerate(names)}
    about |= {"planet": name, "kind": kind, "depth": depth, "albedo": kept, "g": g}
    return about, planet, where


def reference(
    seed: int, planet: Planet, where: dict[str, list[float]], error: float, folder: Path | None
) -> tuple[np.ndarray, np.ndarray]:
    """Radiances by Monte Carlo and their standard errors."""
    file = None if folder is None else folder / f"layer-{seed}-{error:g}.npz"
    if file is not None and file.exists():
        stored = np.load(file)
        return stored["radiance"], stored["error"]
    settings = MonteCarloSettings(relative_error=error, most_histories=400_000, polarisation=False)
    solution = airlight.solve(planet, quality=settings, solver="montecarlo", polarisation=False)
    got = solution.estimate(**where)
    radiance, noise = got.radiance.values[..., 0], got.standard_error.values[..., 0]
    if file is not None:
        np.savez(file, radiance=radiance, error=noise)
    return radiance, noise


def main() -> None:
    """Compare and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--error", type=float, default=0.005, help="of the Monte Carlo")
    parser.add_argument("--quality", nargs="+", default=["default", "preview"])
    parser.add_argument("--keep", type=Path, help="folder of reference radiances")
    given = parser.parse_args()
    if given.keep is not None:
        given.keep.mkdir(parents=True, exist_ok=True)
    found: dict[str, list[tuple[float, float]]] = {one: [] for one in given.quality}
    for seed in range(given.first, given.first + given.count):
        try:
            about, planet, where = case(seed)
        except airlight.ParameterError as error:  # denser than a planet may be
            print(json.dumps({"seed": seed, "rejected": str(error)}), flush=True)
            continue
        radiance, noise = reference(seed, planet, where, given.error, given.keep)
        counts = radiance > LEAST
        for quality in given.quality:
            started = time.process_time()
            solution = airlight.solve(planet, quality=quality, polarisation=False, cache=False)
            seconds = time.process_time() - started
            got = solution.radiance(**where).values[..., 0]
            off, sigma = 100.0 * (got / radiance - 1.0)[counts], 100.0 * (noise / radiance)[counts]
            found[quality] += list(zip(off.tolist(), sigma.tolist(), strict=True))
            row = {
                "seed": seed, **about, "quality": quality, "cpu": round(seconds, 2),
                "energy": round(100.0 * solution.report.energy[0], 2),
                "off": off.round(2).tolist(), "error": sigma.round(2).tolist(),
            }  # fmt: skip
            print(json.dumps(row), flush=True)
    for quality, rows in found.items():
        off, sigma = np.abs(np.array(rows)).T
        beyond = np.maximum(off - 2.0 * sigma, 0.0)
        print(
            f"{quality}: {off.size} radiances, |difference| median {np.median(off):.2f} %, 95 % "
            f"{np.quantile(off, 0.95):.2f} %, largest {off.max():.2f} %; beyond two standard "
            f"errors 95 % {np.quantile(beyond, 0.95):.2f} %, largest {beyond.max():.2f} %"
        )


if __name__ == "__main__":
    main()
