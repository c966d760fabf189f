"""Peak memory of whole processes that each do one thing.

The peak is the resident set's, from ``getrusage``, which on Linux counts the process that forked
it as well: a small one in between keeps pytest's own memory out. Compiled code is read from the
cache, since the compiler itself takes hundreds of MiB. The first row is the package with its
compiled code and the smallest solve.

Run with ``pytest benchmarks/bench_memory.py``.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from typing import Any

import pytest

SETUP = """
import resource, sys
from airlight import Camera, Scene, load_planet, render, solve
from airlight.image.spectral import default_wavelengths
from airlight.engines.baking.bake import bake
earth, rgb = load_planet("earth"), (680.0, 550.0, 440.0)
VIEW = Scene(camera=Camera(width=1280, height=720), altitude=400e3)
sixteen = default_wavelengths(16, *earth.wavelength_limits)
"""
PEAK = """
unit = 1 if sys.platform == "darwin" else 1024
print(unit * resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""
PREVIEW = 'solve(earth, rgb, "preview", cache=False)'
#: What is done, and the same small: it compiles what is not compiled yet, in a process before.
WORK = {
    "nothing but imports and a preview": (PREVIEW, PREVIEW),
    "solve, 3 wavelengths, default": ("solve(earth, rgb, cache=False)", PREVIEW),
    "solve, 16 wavelengths, default": ("solve(earth, sixteen, cache=False)", PREVIEW),
    "frame, 1280 x 720, 16 wavelengths, with its solve": (
        "render(solve(earth, sixteen, cache=False), VIEW)",
        f"render({PREVIEW}, Scene(camera=Camera(width=8, height=8)))",
    ),
    "bake, 8 x 16 x 8 x 4, with its solve": (
        "bake(solve(earth, rgb, cache=False), size=(8, 16, 8, 4), points=256)",
        f"bake({PREVIEW}, size=(4, 4, 4, 2), points=8)",
    ),
    "solve, direct, 3 wavelengths, default": (
        'solve(earth, rgb, solver="direct", cache=False)',
        'solve(earth, rgb, "preview", solver="direct", cache=False)',
    ),
}


BETWEEN = "import subprocess, sys; sys.exit(subprocess.call(sys.argv[1:]))"


def peak_of(code: str) -> float:
    """Peak resident set of a process of its own. [MiB]"""
    done = subprocess.run(
        [sys.executable, "-I", "-c", BETWEEN, sys.executable, "-P", "-c", SETUP + code + PEAK],
        check=True,
        capture_output=True,
        text=True,
    )
    return int(done.stdout.split()[-1]) / 2**20


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=[pytest.mark.slow] if "direct" in name else []) for name in WORK],
)
@pytest.mark.benchmark(group="whole processes, for their memory")
def test_peak_memory(benchmark: Any, name: str, tell: Callable[[str], None]) -> None:
    pytest.importorskip("resource", reason="there is no getrusage on this system")
    work, small = WORK[name]
    peak_of(small)
    peak = benchmark.pedantic(peak_of, (work,), rounds=1)
    benchmark.extra_info["peak MiB"] = peak
    tell(f"peak memory: {name}: {peak:.0f} MiB")
