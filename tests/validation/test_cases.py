"""The grid of cases: what it covers, and that its geometry is that of vectors in space."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import load_planet
from airlight.validation.cases import CASES, Case, at_observer, geometry

RADII = (6360e3, 6460e3)


def along(case: Case, bottom: float, top: float) -> tuple[float, float, float, float]:
    """Sun zenith and azimuth at the place looked at, by vectors; lowest altitude; observer's r."""
    altitude, sun_zenith, view_zenith, azimuth = at_observer(case, bottom, top)
    v, s, a = np.radians([view_zenith, sun_zenith, azimuth])
    eye = np.array([0.0, 0.0, bottom + altitude])
    view = np.array([np.sin(v), 0.0, np.cos(v)])
    sun = np.array([np.sin(s) * np.cos(a), np.sin(s) * np.sin(a), np.cos(s)])
    way = -eye @ view
    lowest = eye + way * view
    height = np.linalg.norm(lowest) - bottom
    if way <= 0.0 or altitude == 0.0 or (case.kind == "angle" and height >= 0.0):
        place = eye
    elif height < 0.0:
        place = eye + (way - np.sqrt(bottom**2 - lowest @ lowest)) * view
    else:
        place = lowest
    up = place / np.linalg.norm(place)
    level_view, level_sun = view - (view @ up) * up, sun - (sun @ up) * up
    cosine = (
        level_view @ level_sun / (np.linalg.norm(level_view) * np.linalg.norm(level_sun) + 1e-30)
    )
    return (
        float(np.degrees(np.arccos(np.clip(sun @ up, -1.0, 1.0)))),
        float(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0)))),
        float(height),
        float(bottom + altitude),
    )


@pytest.mark.parametrize("case", CASES, ids=str)
def test_the_sun_stands_where_the_case_says_at_the_place_looked_at(case):
    # A second method: vectors in space, to the rounding of an arc cosine.
    sun, azimuth, height, _ = along(case, *RADII)
    assert_allclose(sun, case.sun, atol=1e-5)
    if case.kind == "limb":
        assert_allclose(height, case.view, atol=1e-2)
    if case.sun > 0.0 and case.view not in (0.0, 180.0):
        assert_allclose(azimuth, case.azimuth, atol=1e-3)


def test_the_grid_covers_ground_to_space_and_noon_to_night():
    # What the comparison promises: at least 40 lines of sight, all observers, suns and views.
    assert len(CASES) >= 40
    assert len(set(CASES)) == len(CASES)
    observers = {case.observer for case in CASES}
    assert observers == {0.0, 1e3, 10e3, 30e3, "top", 400e3, 500e3}
    assert {0, 30, 60, 80, 85, 88, 90, 92, 94, 96} == {case.sun for case in CASES}
    assert {0.0, 90.0, 180.0} == {case.azimuth for case in CASES}
    limbs = {case.view for case in CASES if case.kind == "limb"}
    assert min(limbs) <= 5e3
    assert max(limbs) >= 60e3
    views = {case.view for case in CASES if case.kind == "angle"}
    assert {0.0, 90.0, 180.0} <= views


@pytest.mark.parametrize("planet", ["earth-atmosphere-plus", "mars-standard"])
def test_arguments_are_what_a_solution_takes(planet):
    where = geometry(load_planet(planet))
    assert set(where) == {"altitude", "sun_zenith", "view_zenith", "azimuth"}
    for name, values in where.items():
        assert values.shape == (len(CASES),), name
        assert np.isfinite(values).all(), name
    assert where["sun_zenith"].min() >= 0.0
    assert where["sun_zenith"].max() <= 180.0
