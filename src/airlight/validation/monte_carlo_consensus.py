"""Monte Carlo through cloud fields against the consensus of I3RC."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from airlight.solver.montecarlo.cloudy_air import Areas
from airlight.validation.i3rc import EXPERIMENTS, Experiment
from airlight.validation.i3rc_monte_carlo import cloudy_experiment, every, result
from airlight.validation.suite import Cell, Part, ReportTable, SuiteRun, Threshold

#: Targets of the mean and of each column, beside three standard errors. [%]
MEAN_TARGET: Final = 1.0
COLUMN_TARGET: Final = 2.0
#: Standard errors of the mean over the field and of a column. [1]
MEAN_ERROR: Final = 0.005
COLUMN_ERROR: Final = 0.05
#: Every such column is computed, by case.
STEPS: Final = {1: 8, 2: 80}


def monte_carlo_consensus(
    run: SuiteRun, experiments: Sequence[Experiment] = EXPERIMENTS
) -> tuple[list[Threshold], list[Part]]:
    """Thresholds and table of Monte Carlo results beside the consensus of I3RC.

    Radius of the planet times 1000, no gases, point star, scalar transfer, seed 1.

    Parameters
    ----------
    run : SuiteRun
        Run of the suite.
    experiments : sequence of Experiment, optional
        Experiments to compare instead of all.
    """
    thresholds: list[Threshold] = []
    rows: list[list[Cell]] = []
    for done, experiment in enumerate(experiments):
        run.step(done, len(experiments), str(experiment))
        means = cloudy_experiment(experiment, MEAN_ERROR, run)
        columns = cloudy_experiment(experiment, COLUMN_ERROR, run)
        step = STEPS[experiment.case]
        for quantity, known in experiment.results.items():
            if quantity == "A":
                continue
            mean = result(means, experiment, quantity, Areas.box(experiment.field))
            got = result(
                columns, experiment, quantity, every(Areas.columns(experiment.field), step)
            )
            expected, picked = float(known.mean()), known[::step]
            off = 100.0 * (float(mean.value[0]) / expected - 1.0)
            error = 100.0 * float(mean.error[0]) / expected
            far = np.abs(got.value - picked)
            outside = far > 3.0 * got.error + 0.01 * COLUMN_TARGET * picked
            name = f"{experiment}, {quantity}"
            source = "Cahalan et al. (2005)"
            limit = MEAN_TARGET + 3.0 * error
            thresholds.append(Threshold(f"{name}: mean", abs(off), limit, "%", source))
            thresholds.append(
                Threshold(f"{name}: columns outside", float(outside.sum()), 0.0, "", source)
            )
            rms = 100.0 * float(np.sqrt(np.mean(far**2))) / expected
            rows.append(
                [
                    name,
                    f"{expected:.4f}",
                    f"{off:+.2f} ± {error:.2f}",
                    f"{picked.size}",
                    f"{rms:.2f}",
                    f"{100.0 * float(np.median(got.error / got.value)):.2f}",
                    f"{mean.histories + got.histories:.2g}",
                ]
            )
    table = ReportTable(
        title="Monte Carlo and the consensus of I3RC",
        columns=[
            "experiment",
            "mean of the consensus",
            "difference of the mean [%]",
            "columns",
            "root mean square of the columns, of the mean [%]",
            "standard error of a column [%]",
            "histories",
        ],
        rows=rows,
        note="R and T are irradiances over that of the sun, the others radiances times π "
        "over that; the mean is over the whole field, columns are every "
        f"{STEPS[1]}th of case 1 and every {STEPS[2]}th of case 2.",
    )
    return thresholds, [table]
