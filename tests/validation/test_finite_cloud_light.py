"""A finite cloud over a plane against the radiances of Mitsuba 3."""

from __future__ import annotations

import numpy as np
import pytest

from airlight.validation.boxes import differences
from airlight.validation.finite_cloud import SUN, VIEWS, reference
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
    radiance, error = traced(cloud_over_plane(0.1), VIEWS[0])
    both = 100.0 * np.sqrt(np.sum(error**2 + known_error[0] ** 2)) / known[0].sum()
    assert abs(differences(radiance, known[0])[1]) < HISTORIES_LIMIT + 3.0 * both
