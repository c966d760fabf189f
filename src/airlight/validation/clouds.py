"""Suite ``clouds``: three-dimensional clouds against I3RC, Mitsuba and Monte Carlo; their cost."""

from __future__ import annotations

from airlight.validation.box_cost import box_cost
from airlight.validation.boxes import box_consensus
from airlight.validation.cloudy_pictures import cloudy_pictures
from airlight.validation.finite_cloud_light import PIXEL_ERROR, finite_cloud_light
from airlight.validation.monte_carlo_consensus import (
    COLUMN_ERROR,
    MEAN_ERROR,
    monte_carlo_consensus,
)
from airlight.validation.suite import Suite, SuiteRun
from airlight.validation.uniform_cloud import uniform_cloud


def clouds(run: SuiteRun) -> Suite:
    """Comparison of the light of cloud fields with the consensus of I3RC and with Mitsuba.

    Parameters
    ----------
    run : SuiteRun
    """
    sections = [
        box_consensus(run),
        monte_carlo_consensus(run),
        finite_cloud_light(run),
        uniform_cloud(run),
        cloudy_pictures(run),
        box_cost(run),
    ]
    thresholds = [threshold for section, _ in sections for threshold in section]
    met = sum(threshold.passed for threshold in thresholds)
    return Suite(
        summary=(
            "A step cloud and a field from a cloud radar, periodic and infinite in one direction, "
            "as in the Intercomparison of 3D Radiation Codes, whose consensus is the mean of many "
            "Monte Carlo and discrete-ordinate codes; a finite cloud over a plane by Mitsuba 3; a "
            "uniform field in one dimension; pixels of pictures past cumuli in spherical air "
            "beside Monte Carlo; and the cost of a box: "
            f"{met} of {len(thresholds)} thresholds are met. Light is unpolarised; there are no "
            "gases but beside cumuli."
        ),
        thresholds=thresholds,
        parts=[part for _, parts in sections for part in parts],
        settings=[
            "I3RC phase I, cases 1 and 2, all experiments with published results",
            (
                "Monte Carlo: radius of the planet times 1000, point star, seed 1, standard error "
                f"{100 * MEAN_ERROR:g} % of means, {100 * COLUMN_ERROR:g} % of columns, "
                f"{100 * PIXEL_ERROR:g} % of pixels"
            ),
        ],
    )
