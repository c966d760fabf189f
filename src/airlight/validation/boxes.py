"""The solver of boxes of cloud against the consensus of I3RC."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.solver.boxes.light import BoxLight
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.boxes.solve import solve_box
from airlight.validation.i3rc import DIRECTIONS, EXPERIMENTS, Experiment
from airlight.validation.suite import ReportTable, SuiteRun, Threshold, cells

FloatArray = NDArray[np.float64]

#: Largest root mean square difference over the mean, and largest difference of the means, by
#: quality. [%]
LIMITS: Final = {"default": (5.0, 2.0), "preview": (10.0, 4.0)}
#: Largest error of the energy balance over the incident energy. [%]
ENERGY: Final = 0.5
#: Lines of sight across a column.
_ACROSS: Final = 3


def compared(experiment: Experiment, solution: BoxSolution) -> dict[str, FloatArray]:
    """Quantities of an experiment as its consensus has them, shape (columns,). [1]

    Absorption is left out: the solver keeps that of the whole box.
    """
    field, cosine = experiment.field, experiment.towards[2]
    columns = field.extinction.shape[0]
    east = field.west + (np.arange(_ACROSS * columns) + 0.5) * field.spacing[0] / _ACROSS
    found = {
        "R": solution.up[:, 0, 0] / cosine,
        "T": (solution.down + solution.direct)[:, 0, 0] / cosine,
    }
    for name, light in DIRECTIONS.items():
        looking = -np.array(light)
        altitude = field.top if looking[2] < 0.0 else field.base
        origins = np.stack([east, np.zeros_like(east), np.full_like(east, altitude)], axis=1)
        radiance = solution.radiance(origins, looking[None])[:, 0]
        found[name] = np.pi / cosine * radiance.reshape(columns, _ACROSS).mean(axis=1)
    return found


def differences(found: FloatArray, expected: FloatArray) -> tuple[float, float]:
    """Root mean square difference and difference of the means, over the expected mean. [%]"""
    off = 100.0 * (found - expected) / expected.mean()
    return float(np.sqrt(np.mean(off**2))), float(off.mean())


def box_consensus(run: SuiteRun) -> tuple[list[Threshold], ReportTable]:
    """Thresholds and table of all experiments, at qualities ``default`` and ``preview``."""
    rows, worst = [], {quality: [0.0, 0.0, 0.0] for quality in LIMITS}
    for done, experiment in enumerate(EXPERIMENTS):
        run.step(done, len(EXPERIMENTS), f"boxes, {experiment}")
        light = BoxLight(towards=experiment.towards, albedo=np.array([experiment.ground_albedo]))
        for quality, largest in worst.items():
            solution = solve_box(
                experiment.field,
                experiment.optics,
                light,
                quality=quality,
                cache=False,
                cancel=run.cancel,
            )
            largest[2] = max(largest[2], 100.0 * abs(solution.report.energy[0]))
            values = compared(experiment, solution)
            for name, expected in experiment.results.items():
                if name not in values:
                    continue
                spread, mean = differences(values[name], expected)
                largest[0], largest[1] = max(largest[0], spread), max(largest[1], abs(mean))
                rows.append(
                    cells(f"{experiment} | {name} | {quality} | {spread:.1f} | {mean:+.1f}")
                )
    source = "I3RC consensus (Cahalan et al. 2005)"
    thresholds = []
    for quality, (spread, mean, energy) in worst.items():
        start = f"boxes, {quality} quality, "
        limits = LIMITS[quality]
        thresholds += [
            Threshold(
                f"{start}largest root mean square difference", spread, limits[0], "%", source
            ),
            Threshold(f"{start}largest difference of a mean", mean, limits[1], "%", source),
            Threshold(f"{start}energy", energy, ENERGY, "%", "conservation"),
        ]
    table = ReportTable(
        title="Solver of boxes and the I3RC consensus",
        columns=cells(
            "experiment | quantity | quality | root mean square [% of the mean] | mean [%]"
        ),
        rows=rows,
        note="R, T: irradiances up and down; Iu, I601, I602, Id: radiances to the nadir, at 60° "
        "and to the zenith, in all columns.",
    )
    return thresholds, table
