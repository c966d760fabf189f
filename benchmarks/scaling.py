"""Cost of a solve and of a picture against what they are made of, and the slopes.

    python benchmarks/scaling.py                    # everything, some minutes
    python benchmarks/scaling.py wavelengths pixels

CPU time of one call and peak resident set of a process of its own, whose compiled code is
there and whose solution is not kept. The slope is that of the logarithms between two neighbouring
sizes: 1 where cost grows in proportion, 0 where it does not grow.

``wavelengths``: solves of Earth, ``default``, over the visible. ``constituents``: of a gas and thin
clouds of one kind, three wavelengths. ``radii`` and ``sun_angles``: nodes of the solver's grid,
Earth, three wavelengths. ``pixels``: dome masters of Earth from the ground, from the sky-view LUT.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from itertools import pairwise
from math import log

#: What is varied, and its sizes.
SIZES = {
    "wavelengths": (3, 8, 16, 64, 128, 400),
    "constituents": (1, 2, 4, 8, 16),
    "radii": (12, 24, 48),
    "sun_angles": (28, 56, 112),
    "pixels": (320**2, 1024**2, 2048**2, 4096**2, 8192**2),
}
#: Runs in the new process: what is varied, its size.
CHILD = """
import json, resource, sys, time
from dataclasses import replace
from airlight import Camera, Scene, load_planet, render, solve
from airlight.image.spectral import default_wavelengths
from airlight.planets import Constituent
from airlight.planets.matter.phases import HenyeyGreenstein
from airlight.planets.matter.profiles import Exponential
from airlight.solver.moments.settings import QUALITIES

what, size = sys.argv[1], int(sys.argv[2])
planet, rgb, quality = load_planet("earth"), (680.0, 550.0, 440.0), QUALITIES["default"]
nm = rgb
if what == "wavelengths" and size > 3:
    nm = tuple(default_wavelengths(size, *planet.wavelength_limits))
if what == "constituents":
    clouds = tuple(
        Constituent(name=f"cloud {k}", profile=Exponential(scale_height=1000.0 + 100.0 * k),
                    scattering=1e-6, absorption=1e-7,
                    phase_function=HenyeyGreenstein(asymmetry=0.6))
        for k in range(size - 1)
    )
    planet = replace(planet, constituents=(planet.constituents[0], *clouds))
if what in ("radii", "sun_angles"):
    quality = replace(quality, **{what: size})
call = lambda: solve(planet, nm, quality, cache=False)
solve(planet, rgb, "preview", cache=False)  # compiled code is loaded
if what == "pixels":
    solution = solve(planet, rgb)
    width = round(size**0.5)
    dome = lambda n: Scene(altitude=2.0, sun_zenith=60.0,
                           camera=Camera(projection="fisheye", width=n, height=n))
    render(solution, dome(320))
    call = lambda: render(solution, dome(width))
began, clock = time.process_time(), time.perf_counter()
call()
unit = 1 if sys.platform == "darwin" else 1024
print(json.dumps([time.process_time() - began, time.perf_counter() - clock,
                  unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss]))
"""


def measured(what: str, size: int) -> tuple[float, float, float]:
    """CPU time, wall time [s] and peak memory [MiB] of one process."""
    done = subprocess.run(
        [sys.executable, "-P", "-c", CHILD, what, str(size)],
        check=True,
        stdout=subprocess.PIPE,
        text=True,
    )
    processor, clock, peak = json.loads(done.stdout.splitlines()[-1])
    return processor, clock, peak / 2**20


def slope(first: tuple[int, float], second: tuple[int, float]) -> float:
    """Slope of the logarithms between two sizes. [1]"""
    return log(second[1] / first[1]) / log(second[0] / first[0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", nargs="*", choices=[*SIZES, []], help="what is varied")
    asked = parser.parse_args().what or list(SIZES)
    for what in asked:
        print(f"\n| {what} | processor | clock | slope | peak | load |\n|---|---|---|---|---|---|")
        times = []
        for size in SIZES[what]:
            processor, clock, peak = measured(what, size)
            times.append((size, processor))
            grown = [slope(one, other) for one, other in pairwise(times)][-1:]
            print(
                f"| {size} | {processor:.2f} s | {clock:.2f} s "
                f"| {grown[0] if grown else float('nan'):.2f} | {peak:.0f} MiB "
                f"| {os.getloadavg()[0]:.1f} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
