"""Axes of the table of gathered light: coordinates of nodes, and cells of points."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Medium, load_planet
from airlight.geometry.shell import horizon_cosine
from airlight.solver.direct.gather import extrapolate_linearly
from airlight.solver.direct.layout import (
    angle_cell,
    angle_of,
    layout_for,
    radius_cell,
    radius_of,
    sun_cell,
    sun_of,
    view_cell,
    view_of,
)
from airlight.solver.direct.settings import MAPPINGS, DirectSettings


@pytest.fixture(params=[(name, planet) for name in MAPPINGS for planet in ("earth", "mars")])
def axes(request):
    mapping, planet = request.param
    flat = mapping not in ("angle", "bruneton")
    settings = DirectSettings(
        mapping=mapping, views=16, sun_angles=20, scatter_angles=1 if flat else 9
    )
    return layout_for(Medium.from_planet(load_planet(planet), [550.0]), settings)


def place(cell: tuple[int, int, float]) -> float:
    return cell[0] + cell[2] * (cell[1] - cell[0])


def test_every_node_falls_on_itself(axes) -> None:
    # A mapping and its inverse; both ends of both halves included.
    radii = [place(radius_cell(radius_of(i, axes), axes)) for i in range(axes.radii)]
    assert_allclose(radii, np.arange(axes.radii), atol=1e-6)
    suns = [place(sun_cell(sun_of(k, axes), axes)) for k in range(axes.sun_angles)]
    assert_allclose(suns, np.arange(axes.sun_angles), atol=1e-6)
    angles = [place(angle_cell(angle_of(m, axes), axes)) for m in range(axes.angles)]
    assert_allclose(angles, np.arange(axes.angles), atol=1e-6)
    for i in range(1, axes.radii):  # on the ground itself all views downwards are one
        r = radius_of(i, axes)
        nodes = [view_of(j, r, axes) for j in range(axes.views)]
        views = np.array([place(view_cell(r, mu, axes)) for mu in nodes])
        # The horizon itself may be taken for either half's end.
        sure = np.abs(np.array(nodes) - horizon_cosine(r, axes.bottom)) > 1e-9
        assert_allclose(views[sure], np.arange(axes.views)[sure], atol=1e-4)


def test_planes_of_the_shell_are_exact(axes) -> None:
    assert radius_of(0, axes) == axes.bottom
    assert radius_of(axes.radii - 1, axes) == axes.top


def test_continuation_makes_interpolation_right_at_the_end_of_what_can_be() -> None:
    # A straight line, possible only from 2.4 to 6.3: nodes outside hold the ends.
    line = 3.0 - 0.7 * np.arange(10.0)
    held = np.interp(np.clip(np.arange(10.0), 2.4, 6.3), np.arange(10.0), line)[:, None]
    extrapolate_linearly(held, 2.4, 6.3)
    for end in (2.4, 6.3):
        assert_allclose(np.interp(end, np.arange(10.0), held[:, 0]), 3.0 - 0.7 * end, atol=1e-12)
