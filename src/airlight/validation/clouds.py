"""The suite ``clouds``: three-dimensional clouds against I3RC and Mitsuba."""

from __future__ import annotations

from airlight.validation.boxes import box_consensus
from airlight.validation.cloudy_pictures import cloudy_pictures
from airlight.validation.finite_cloud_light import PIXEL_ERROR, finite_cloud_light
from airlight.validation.monte_carlo_consensus import (
    COLUMN_ERROR,
    MEAN_ERROR,
    monte_carlo_consensus,
)
from airlight.validation.suite import Suite, SuiteRun


def clouds(run: SuiteRun) -> Suite:
    """Comparison of the light of cloud fields with the consensus of I3RC and with Mitsuba.

    Parameters
    ----------
    run : SuiteRun
    """
    of_boxes, boxes = box_consensus(run)
    of_histories, histories = monte_carlo_consensus(run)
    of_finite, finite = finite_cloud_light(run)
    of_pictures, pictures = cloudy_pictures(run)
    thresholds = [*of_boxes, *of_histories, *of_finite, *of_pictures]
    met = sum(threshold.passed for threshold in thresholds)
    return Suite(
        summary=(
            "A step cloud and a field from a cloud radar, periodic and infinite in one direction, "
            "as in the Intercomparison of 3D Radiation Codes, whose consensus is the mean of many "
            "Monte Carlo and discrete-ordinate codes; a finite cloud over a plane by Mitsuba 3; "
            "and pixels of pictures past cumuli in spherical air beside Monte Carlo: "
            f"{met} of {len(thresholds)} thresholds are met. Light is unpolarised; there are no "
            "gases but in the last."
        ),
        thresholds=thresholds,
        parts=[boxes, histories, finite, pictures],
        settings=[
            "I3RC phase I, cases 1 and 2, all experiments with published results",
            (
                "Monte Carlo: radius of the planet times 1000, point star, seed 1, standard error "
                f"{100 * MEAN_ERROR:g} % of means, {100 * COLUMN_ERROR:g} % of columns, "
                f"{100 * PIXEL_ERROR:g} % of pixels"
            ),
        ],
    )
