"""A finite cloud over a plane against the radiances of Mitsuba 3."""

from __future__ import annotations

import numpy as np
import pytest

from airlight.solver.montecarlo.cloudy_air import Areas
from airlight.validation.boxes import differences
from airlight.validation.finite_cloud import HALF_WIDTH, SUN, VIEWS, reference
from airlight.validation.finite_cloud_light import (
    BOXES_LIMIT,
    HISTORIES_LIMIT,
    box_pixels,
    boxed,
    cloud_over_plane,
    pixel_areas,
    traced,
)


def test_areas_of_a_slanted_view_have_the_pixels_cross_sections() -> None:
    for view in VIEWS:
        areas, _ = pixel_areas(view)
        cross_section = areas.width * areas.length * abs(view.along[2])
        assert cross_section == pytest.approx(200.0**2)
        assert np.unique(np.round(areas.north, 6)).size == 6
    assert np.linalg.norm(SUN) == pytest.approx(1.0)


@pytest.mark.slow
def test_boxes_have_the_means_of_the_views() -> None:
    solution, (known, _) = boxed(), reference()
    for number, view in enumerate(VIEWS):
        off = differences(box_pixels(solution, view), known[number])[1]
        assert abs(off) < BOXES_LIMIT, view.name


@pytest.mark.slow
def test_monte_carlo_has_the_mean_of_the_view_from_above() -> None:
    known, known_error = reference()
    cloud = cloud_over_plane(0.004)
    whole = Areas.at(0.0, 0.0, 2.0 * HALF_WIDTH, 2.0 * HALF_WIDTH)
    found = traced(cloud, VIEWS[0], whole)
    error = np.hypot(float(found.total_error[0, 0]), np.sqrt(np.sum(known_error[0] ** 2)) / 36)
    expected = known[0].mean()
    off = float(found.total[0, 0]) - expected
    assert abs(off) < 0.01 * HISTORIES_LIMIT * expected + 3.0 * error
