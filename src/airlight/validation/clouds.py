"""The suite ``clouds``: three-dimensional clouds against the consensus of I3RC."""

from __future__ import annotations

from airlight.validation.boxes import box_consensus
from airlight.validation.monte_carlo_consensus import (
    COLUMN_ERROR,
    MEAN_ERROR,
    monte_carlo_consensus,
)
from airlight.validation.suite import Suite, SuiteRun


def clouds(run: SuiteRun) -> Suite:
    """Comparison of the light of cloud fields with the consensus of I3RC, phase I.

    Parameters
    ----------
    run : SuiteRun
    """
    of_boxes, boxes = box_consensus(run)
    of_histories, histories = monte_carlo_consensus(run)
    thresholds = [*of_boxes, *of_histories]
    met = sum(threshold.passed for threshold in thresholds)
    return Suite(
        summary=(
            "A step cloud and a field from a cloud radar, periodic and infinite in one direction, "
            "as in the Intercomparison of 3D Radiation Codes, whose consensus is the mean of many "
            f"Monte Carlo and discrete-ordinate codes: {met} of {len(thresholds)} thresholds are "
            "met. Light is unpolarised; there are no gases."
        ),
        thresholds=thresholds,
        parts=[boxes, histories],
        settings=[
            "I3RC phase I, cases 1 and 2, all experiments with published results",
            (
                "Monte Carlo: radius of the planet times 1000, point star, seed 1, standard error "
                f"{100 * MEAN_ERROR:g} % of means, {100 * COLUMN_ERROR:g} % of columns"
            ),
        ],
    )
