"""The solver of boxes of cloud against the consensus of I3RC."""

from __future__ import annotations

from time import process_time
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.solver.boxes.light import BoxLight
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.boxes.solve import solve_box
from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure
from airlight.validation.i3rc import DIRECTIONS, EXPERIMENTS, Experiment
from airlight.validation.suite import (
    Part,
    ReportPicture,
    ReportTable,
    SuiteRun,
    Threshold,
    cells,
)

FloatArray = NDArray[np.float64]

#: Largest root mean square difference over the mean, and largest difference of the means, by
#: quality. [%]
LIMITS: Final = {"default": (5.0, 2.0), "preview": (10.0, 4.0)}
#: Largest error of the energy balance over the incident energy. [%]
ENERGY: Final = 0.5
#: Lines of sight across a column.
_ACROSS: Final = 3
#: Experiment of the picture of columns.
_SHOWN: Final = (2, 2)
#: Source of the thresholds.
_SOURCE: Final = "I3RC consensus (Cahalan et al. 2005)"


class BoxResult(NamedTuple):
    """Solution of an experiment beside its consensus.

    Attributes
    ----------
    experiment, quality : Experiment, str
    seconds, energy : float
        CPU time [s], and error of the energy balance [%].
    values : dict
        Results of ``compared``.
    """

    experiment: Experiment
    quality: str
    seconds: float
    energy: float
    values: dict[str, FloatArray]

    @property
    def errors(self) -> dict[str, tuple[float, float]]:
        """``differences`` by quantity."""
        known = self.experiment.results
        return {name: differences(one, known[name]) for name, one in self.values.items()}


def compared(experiment: Experiment, solution: BoxSolution) -> dict[str, FloatArray]:
    """Quantities of an experiment as its consensus has them, shape (columns,). [1]

    Absorption is left out: the solver keeps that of the whole box.
    """
    field, cosine = experiment.field, experiment.towards[2]
    columns = field.extinction.shape[0]
    east = field.west + (np.arange(_ACROSS * columns) + 0.5) * field.spacing[0] / _ACROSS
    found = {
        "R": np.asarray(solution.up[:, 0, 0], float) / cosine,
        "T": np.asarray((solution.down + solution.direct)[:, 0, 0], float) / cosine,
    }
    for name, light in DIRECTIONS.items():
        looking = -np.array(light)
        altitude = field.top if looking[2] < 0.0 else field.base
        origins = np.stack([east, np.zeros_like(east), np.full_like(east, altitude)], axis=1)
        radiance = solution.radiance(origins, looking[None])[:, 0]
        found[name] = np.pi / cosine * radiance.reshape(columns, _ACROSS).mean(axis=1)
    return {name: one for name, one in found.items() if name in experiment.results}


def differences(found: FloatArray, expected: FloatArray) -> tuple[float, float]:
    """Root mean square difference and difference of the means, over the expected mean. [%]"""
    off = 100.0 * (found - expected) / expected.mean()
    return float(np.sqrt(np.mean(off**2))), float(off.mean())


def box_result(experiment: Experiment, quality: str, run: SuiteRun) -> BoxResult:
    """Solution of an experiment."""
    light = BoxLight(towards=experiment.towards, albedo=np.array([experiment.ground_albedo]))
    started = process_time()
    solution = solve_box(
        experiment.field,
        experiment.optics,
        light,
        quality=quality,
        cache=False,
        cancel=run.cancel,
    )
    seconds = process_time() - started
    energy = 100.0 * abs(solution.report.energy[0])
    return BoxResult(experiment, quality, seconds, energy, compared(experiment, solution))


def box_consensus(run: SuiteRun) -> tuple[list[Threshold], list[Part]]:
    """Thresholds, table and pictures of all experiments, at two qualities."""
    results = []
    for done, experiment in enumerate(EXPERIMENTS):
        run.step(done, len(EXPERIMENTS), f"boxes, {experiment}")
        results += [box_result(experiment, quality, run) for quality in LIMITS]
    thresholds = []
    for quality, (spread, mean) in LIMITS.items():
        own = [one for one in results if one.quality == quality]
        off = np.abs([error for one in own for error in one.errors.values()])
        start, worst = f"boxes, {quality} quality, ", off.max(axis=0)
        thresholds += [
            Threshold(
                f"{start}largest root mean square difference", worst[0], spread, "%", _SOURCE
            ),
            Threshold(f"{start}largest difference of a mean", worst[1], mean, "%", _SOURCE),
            Threshold(
                f"{start}energy", max(one.energy for one in own), ENERGY, "%", "conservation"
            ),
        ]
    parts: list[Part] = [_table(results), _time_against_error(results)]
    shown = [one for one in results if (one.experiment.case, one.experiment.number) == _SHOWN]
    return thresholds, [*parts, _columns(shown)] if shown else parts


def _table(results: list[BoxResult]) -> ReportTable:
    return ReportTable(
        title="Solver of boxes and the I3RC consensus",
        columns=cells(
            "experiment | quantity | quality | root mean square [% of the mean] | mean [%] | "
            "CPU time of the experiment [s]"
        ),
        rows=[
            cells(
                f"{one.experiment} | {name} | {one.quality} | {spread:.1f} | {mean:+.1f} | "
                f"{one.seconds:.1f}"
            )
            for one in results
            for name, (spread, mean) in one.errors.items()
        ],
        note="R, T: irradiances up and down; Iu, I601, I602, Id: radiances to the nadir, at 60° "
        "and to the zenith, in all columns. The first time contains compilation.",
    )


def _time_against_error(results: list[BoxResult]) -> ReportPicture:
    title = "Boxes: error against CPU time, I3RC"
    figure = new_figure(title, size=(7.0, 4.2))
    axes = figure.subplots()
    for color, (quality, (limit, _)) in zip(PALETTE, LIMITS.items(), strict=False):
        own = [one for one in results if one.quality == quality]
        for marker, case in (("o", 1), ("s", 2)):
            some = [one for one in own if one.experiment.case == case]
            axes.plot(
                [one.seconds for one in some],
                [np.mean([spread for spread, _ in one.errors.values()]) for one in some],
                marker,
                color=color,
                label=f"{quality}, case {case}",
            )
        axes.axhline(limit, color=color, linewidth=0.8, linestyle="--")
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlabel("CPU time [s]")
    axes.set_ylabel("root mean square difference [% of the mean]")
    axes.legend(fontsize=8)
    grid(axes)
    caption = (
        "Each point is an experiment: mean over its quantities. Dashed: target of the largest."
    )
    return ReportPicture.from_figure(figure, title=title, caption=caption)


def _columns(results: list[BoxResult]) -> ReportPicture:
    experiment = results[0].experiment
    title = f"Boxes: light by column, I3RC {experiment}"
    figure = new_figure(title, size=(9.0, 4.6))
    east = 1e-3 * experiment.field.spacing[0] * np.arange(experiment.field.extinction.shape[0])
    names = list(results[0].values)[:2]
    for axes, name in zip(figure.subplots(2, 1, sharex=True), names, strict=True):
        axes.plot(east, experiment.results[name], color=GREY, linewidth=2.0, label="consensus")
        for color, one in zip(PALETTE, results, strict=False):
            axes.plot(east, one.values[name], color=color, linewidth=0.8, label=one.quality)
        axes.set_ylabel(name)
        grid(axes)
    axes.set_xlabel("distance [km]")
    axes.legend(fontsize=8, ncols=3)
    caption = "Quantities as in the table, over the irradiance of the sun on a horizontal plane."
    return ReportPicture.from_figure(figure, title=title, caption=caption)
