"""The suite ``clouds``: three-dimensional clouds against the consensus of I3RC."""

from __future__ import annotations

from airlight.validation.boxes import box_consensus
from airlight.validation.suite import Suite, SuiteRun


def clouds(run: SuiteRun) -> Suite:
    """Comparison of the light of cloud fields with the consensus of I3RC, phase I.

    Parameters
    ----------
    run : SuiteRun
    """
    thresholds, table = box_consensus(run)
    met = sum(threshold.passed for threshold in thresholds)
    return Suite(
        summary=(
            "A step cloud and a field from a cloud radar, periodic and infinite in one direction, "
            "as in the Intercomparison of 3D Radiation Codes, whose consensus is the mean of many "
            f"Monte Carlo and discrete-ordinate codes: {met} of {len(thresholds)} thresholds are "
            "met. Light is unpolarised; there are no gases."
        ),
        thresholds=thresholds,
        parts=[table],
        settings=["I3RC phase I, cases 1 and 2, all experiments with published results"],
    )
