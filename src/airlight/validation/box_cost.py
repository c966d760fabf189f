"""Cost of the solver of boxes: CPU time and memory of a process that solves one."""

from __future__ import annotations

import sys
from pathlib import Path
from subprocess import PIPE
from time import process_time
from typing import Final

import numpy as np

from airlight.child_processes import start_python
from airlight.clouds.planet_clouds import Box, clouds_of
from airlight.planets import load_planet
from airlight.solver.boxes.light import BoxLight
from airlight.solver.boxes.solve import solve_box
from airlight.validation.suite import Part, ReportTable, SuiteRun, Threshold, cells

#: Largest wall time on two cores [s] by quality, and largest memory [GB].
SECONDS: Final = {"default": 15.0, "preview": 3.0}
MEMORY: Final = 1.0
CORES: Final = 2
WAVELENGTHS: Final = (450.0, 550.0, 650.0)
#: Columns along each side, and their width [m].
_COLUMNS, _WIDTH = 128, 100.0
_SUN_ZENITH: Final = 50.0
_PROGRAM: Final = "from airlight.validation.box_cost import solved; print(*solved({!r}))"


def solved(quality: str) -> tuple[float, float]:
    """CPU time [s] of a solution after another, and largest memory of this process [GB]."""
    planet = load_planet("earth", {"clouds": [{"kind": "cumulus"}]})
    box = Box(size=_COLUMNS * _WIDTH, spacing=_WIDTH)
    ((field, optics),) = clouds_of(planet, WAVELENGTHS, box)
    assert field.extinction.shape == (_COLUMNS, _COLUMNS, 32)
    sun = np.radians(_SUN_ZENITH)
    light = BoxLight(
        towards=(float(np.sin(sun)), 0.0, float(np.cos(sun))),
        albedo=np.full(len(WAVELENGTHS), 0.06),
        ground=0.0,
    )
    # compiled code first
    few = np.ascontiguousarray(field.extinction[:8, :8])
    small = type(field)(extinction=few, spacing=field.spacing, base=field.base, beyond="periodic")
    solve_box(small, optics, light, quality=quality, cache=False)
    started = process_time()
    solve_box(field, optics, light, quality=quality, cache=False)
    seconds = process_time() - started
    return seconds, 1e-9 * _largest_memory()


def _largest_memory() -> float:
    """Largest resident memory of this program. [byte]"""
    status = Path("/proc/self/status")
    if status.exists():  # ``ru_maxrss`` is not less than that of the process that started this one
        (line,) = (one for one in status.read_text().splitlines() if one.startswith("VmHWM"))
        return 1024.0 * float(line.split()[1])
    import resource  # not on Windows

    return (1.0 if sys.platform == "darwin" else 1024.0) * resource.getrusage(
        resource.RUSAGE_SELF
    ).ru_maxrss


def box_cost(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and table of a box of 128 × 128 × 32 cells at three wavelengths."""
    thresholds, rows = [], []
    for number, (quality, limit) in enumerate(SECONDS.items()):
        run.step(number, len(SECONDS), f"cost of a box, {quality}")
        process = start_python(_PROGRAM.format(quality), stdout=PIPE)
        seconds, memory = (float(one) for one in process.communicate()[0].split())
        name = f"box of 128 × 128 × 32 cells, {quality} quality: "
        thresholds += [
            Threshold(f"{name}CPU time over {CORES} cores", seconds / CORES, limit, "s", "target"),
            Threshold(f"{name}memory of the process", memory, MEMORY, "GB", "target"),
        ]
        rows.append(cells(f"{quality} | {seconds:.1f} | {memory:.2f}"))
    table = ReportTable(
        title="Cost of a box of 128 × 128 × 32 cells, cumulus, three wavelengths",
        columns=cells("quality | CPU time [s] | memory of the process [GB]"),
        rows=rows,
        note=f"Sun at {_SUN_ZENITH:g}°, compiled code loaded before. The target is a wall time on "
        f"{CORES} cores: CPU time over {CORES} is its lower limit.",
    )
    return thresholds, [table]
