"""Time against error: this package and SASKTRAN 2 on the same polarised sky, side by side.

    python benchmarks/peers.py                           # all of it, and a table
    python benchmarks/peers.py --plot docs/images/peers.png
    python benchmarks/peers.py --only moments            # cases whose name begins so

The sky is ``airlight.validation.polarised.round_air``: round Rayleigh air of optical depths 0.1 and
0.5 under three elevations of the star, nine lines of sight each, three Stokes parameters. Each
case runs in a process of its own, after a small call that compiles or loads it, with its memory
limited to ``LIMIT``. The error of I is the median over the 54 values, with the quartiles as its
bars, against the moments solver's ``fine``, and beside it against SASKTRAN's own best values in
``validation/data``: the two differ by what one of them errs.
SASKTRAN solves for each star elevation anew, the moments solver once for all.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

#: Largest address space of a case. [byte]
LIMIT = 9_000_000_000
#: Directions of a source point and columns by star elevation of SASKTRAN 2.
SASKTRAN = ((26, 1), (50, 1), (110, 1), (110, 3), (194, 3), (434, 3))
#: Qualities of ours, and the one that they are judged by.
QUALITIES, REFERENCE = ("preview", "default"), "fine"
#: Runs in the new process: the case as JSON.
CHILD = f"""
import json, resource, sys, time
sys.path[:0] = sys.argv[2:]
case = json.loads(sys.argv[1])
resource.setrlimit(resource.RLIMIT_AS, ({LIMIT}, {LIMIT}))
import peers
call = peers.call_of(case)
call(True)
began, clock = time.process_time(), time.perf_counter()
values = call(False)
print(json.dumps([time.process_time() - began, time.perf_counter() - clock,
                  resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024, values.tolist()]))
"""


def call_of(case: dict[str, Any]) -> Any:
    """``call(small)``: I of all values of the reference sky, or of few of them. [sr⁻¹]"""
    if case["solver"] == "sasktran":
        return lambda small: sasktran(case["rays"], case["columns"], small)
    return lambda small: moments(case["quality"], case["device"], small)


def sasktran(rays: int, columns: int, small: bool) -> Any:
    sys.path.insert(0, str(Path(__file__).parents[1] / "builders"))
    import polarised_sky
    from airlight.validation.polarised.round_air import SUNS, reference_sky

    suns = SUNS[:1] if small else SUNS
    fineness = polarised_sky.Fineness(6 if small else rays, columns, 0)
    found = {sun: polarised_sky.sky(sun, fineness)[..., 0] for sun in suns}
    if small:
        return np.zeros(1)
    sky = reference_sky()
    picked = np.empty(sky.depth.size)
    for sun, values in found.items():
        for depth, row in zip((0.1, 0.5), values, strict=True):
            picked[(sky.sun == sun) & (sky.depth == depth)] = row
    return picked


def moments(quality: str, device: str, small: bool) -> Any:
    from airlight import solve
    from airlight.solver.moments.settings import settings_for
    from airlight.validation.polarised.round_air import reference_sky, round_rayleigh

    sky = reference_sky()
    settings = settings_for("preview" if small else quality)
    solve_by = solve if device == "processor" else on_device()
    got = np.empty(sky.depth.size)
    for depth in np.unique(sky.depth):
        rows = sky.depth == depth
        solution = solve_by(round_rayleigh(float(depth)), (550.0,), settings, cache=False)
        got[rows] = solution.radiance(
            altitude=0.0, sun_zenith=sky.sun[rows], view_zenith=sky.zenith[rows],
            azimuth=sky.azimuth[rows],
        ).values[:, 0]  # fmt: skip
    return got


def on_device() -> Any:
    """``solve`` by the passes of a graphics device."""
    from airlight.planets.medium import Medium
    from airlight.render.gpu.device.device import open_device
    from airlight.render.gpu.solver.solver import solve_on

    device = open_device()
    return lambda planet, nm, settings, cache: solve_on(
        device, Medium.from_planet(planet, nm), settings
    )


def cases() -> dict[str, dict[str, Any]]:
    """Cases by name, the reference first."""
    found: dict[str, dict[str, Any]] = {}
    for quality in (REFERENCE, *QUALITIES):
        found[f"moments {quality}"] = {
            "solver": "moments", "quality": quality, "device": "processor",
        }  # fmt: skip
    for quality in ("preview", "default"):
        found[f"moments {quality}, device"] = {
            "solver": "moments", "quality": quality, "device": "device",
        }  # fmt: skip
    for rays, columns in SASKTRAN:
        found[f"SASKTRAN {rays} x {columns}"] = {
            "solver": "sasktran", "rays": rays, "columns": columns,
        }  # fmt: skip
    return found


def measured(case: dict[str, Any]) -> tuple[float, float, float, Any] | str:
    """CPU time, wall time [s], peak memory [MiB], values; or why there are none."""
    words = [json.dumps(case), str(Path(__file__).parent)]
    done = subprocess.run(
        [sys.executable, "-P", "-c", CHILD, *words], capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines()
        return lines[-1] if lines else f"exit status {done.returncode}"
    processor, clock, peak, values = json.loads(done.stdout.splitlines()[-1])
    return processor, clock, peak, np.array(values)


def quartiles(values: Any, truth: Any) -> Any:
    """Quartiles of the error. [%]"""
    return np.percentile(100.0 * np.abs(values / truth - 1.0), (25.0, 50.0, 75.0))


def draw(results: dict[str, tuple[float, Any]], path: Path, load: float) -> None:
    from airlight.studies.plots.figure import grid, new_figure, write_figure

    figure = new_figure(
        "Time against error: a polarised Rayleigh sky, optical depths 0.1 and 0.5",
        "Error of I against fine: median and quartiles of 54 lines of sight. The best of both\n"
        f"differ by 0.13 %. CPU time of both cores, at a load of {load:.0f}",
    )
    axes = figure.subplots()
    kinds = {"moments": ("airlight, processor", "o"), "device": ("airlight, lavapipe", "s"),
             "SASKTRAN": ("SASKTRAN 2, successive orders", "^")}  # fmt: skip
    for kind, (label, marker) in kinds.items():
        names = [n for n in results if ("device" if "device" in n else n.split()[0]) == kind]
        if not names:
            continue
        x = [results[name][0] for name in names]
        low, middle, high = np.array([results[name][1] for name in names]).T
        axes.errorbar(x, middle, (middle - low, high - middle), fmt=marker + "-", label=label,
                      capsize=3, linewidth=1.2)  # fmt: skip
        for name, at, error in zip(names, x, middle, strict=True):
            word = name.removeprefix("SASKTRAN ").removeprefix("moments ").removesuffix(", device")
            axes.annotate(word.replace(" x ", " × "), (at, error), (6, 5),
                          textcoords="offset points", fontsize=8)  # fmt: skip
    axes.set(xscale="log", yscale="log", xlabel="CPU time [s]", ylabel="error of I [%]")
    axes.legend(frameon=False)
    grid(axes)
    with path.open("wb") as file:
        write_figure(figure, file)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="cases whose name begins so")
    parser.add_argument("--plot", type=Path)
    asked = parser.parse_args()
    from airlight.validation.polarised.round_air import reference_sky

    theirs = reference_sky().stokes[:, 0]
    results: dict[str, tuple[float, Any]] = {}
    truth: Any = None
    print("| case | processor | clock | peak | error: median (quartiles) | against theirs | load |")
    print("|---|---|---|---|---|---|---|")
    for name, case in cases().items():
        if not name.startswith(asked.only) and REFERENCE not in name:
            continue
        found = measured(case)
        if isinstance(found, str):
            print(f"| {name} | not run: {found} |", flush=True)
            continue
        processor, clock, peak, values = found
        truth = values if truth is None else truth
        low, middle, high = quartiles(values, truth)
        print(
            f"| {name} | {processor:.2f} s | {clock:.2f} s | {peak:.0f} MiB "
            f"| {middle:.3f} ({low:.3f} to {high:.3f}) % | {quartiles(values, theirs)[1]:.3f} % "
            f"| {os.getloadavg()[0]:.1f} |",
            flush=True,
        )
        if REFERENCE not in name:
            results[name] = processor, quartiles(values, truth)
    if asked.plot is not None:
        draw(results, asked.plot, os.getloadavg()[0])


if __name__ == "__main__":
    main()
