"""Edges between the colours of a map, finer than its texels."""

from __future__ import annotations

from math import pi
from typing import NamedTuple

import numpy as np
import pytest

from airlight.render.pixels.coast import RIVER, MapSpot, edged_color, river_share
from airlight.scene.ground_place import map_color

ROWS = 16


class View(NamedTuple):
    """The part of ``ViewUniforms`` that is read."""

    texels: np.ndarray
    map_rows: int
    map_columns: int
    map_levels: int


def profile(water: int) -> tuple[np.ndarray, np.ndarray]:
    """Red across an edge of dark to bright land, interpolated and with edges. [1]"""
    texels = np.zeros((ROWS, 2 * ROWS, 4), np.uint8)
    texels[:, ROWS:] = (200, 180, 150, 0)
    texels[..., 3] = water
    view = View(texels.ravel(), ROWS, 2 * ROWS, 1)
    found = []
    for longitude in np.linspace(-0.5, 0.5, 201) * pi / ROWS:
        color = np.zeros(25)
        map_color(view.texels, ROWS, 2 * ROWS, 1, 0.0, longitude, 0.0, color, 0)
        before = color[0]
        edged_color(MapSpot(0.0, longitude, 0.05, 0.0), view, color)
        found.append((before, color[0]))
    interpolated, sharp = np.transpose(found)
    return interpolated, sharp


def test_an_edge_of_fields_is_less_than_half_a_texel_wide() -> None:
    # Interpolation rises evenly over a texel: a tenth to nine tenths over four fifths of it. The
    # mean over the texel is that of its two colours by both.
    interpolated, sharp = profile(water=0)
    levels = (sharp - sharp.min()) / (sharp.max() - sharp.min())
    assert np.mean((levels > 0.1) & (levels < 0.9)) < 0.5
    assert sharp.mean() == pytest.approx(interpolated.mean(), rel=1e-3)
    assert np.ptp(sharp) == pytest.approx(np.ptp(interpolated))


def test_land_beside_water_has_no_edges() -> None:
    interpolated, sharp = profile(water=160)
    np.testing.assert_allclose(sharp, interpolated, rtol=1e-12)


def test_edges_go_from_the_colour_of_one_texel_to_that_of_another() -> None:
    # Not from channel to channel: among texels of many hues these would be colours of none.
    chance = np.random.default_rng(5)
    texels = chance.integers(20, 200, (ROWS, 2 * ROWS, 4)).astype(np.uint8)
    texels[..., 3] = 0
    view = View(texels.ravel(), ROWS, 2 * ROWS, 1)
    step = pi / ROWS
    for latitude, longitude in chance.uniform(-1.0, 1.0, (40, 2)):
        beside = []
        for north, east in ((0, 0), (1, 0), (0, 1), (-1, 0), (0, -1)):
            color = np.zeros(25)
            place = latitude + north * step, longitude + east * step
            map_color(view.texels, ROWS, 2 * ROWS, 1, *place, 0.0, color, 0)
            beside.append(color[:3].copy())
        edged_color(
            MapSpot(latitude, longitude, 0.05, 0.0), view, color := np.append(beside[0], [0.0] * 22)
        )
        change = color[:3] - beside[0]
        ways = [one - other for one in beside for other in beside if one is not other]
        assert min(np.linalg.norm(np.cross(change, way)) for way in ways) < 1e-9


@pytest.mark.parametrize("turn", [0.0, 0.2, 0.5 * pi])
def test_a_river_runs_in_the_middle_of_a_green_valley_between_deserts(turn: float) -> None:
    # A parabola across a straight valley, whose least value is known.
    def arid(east: float, north: float) -> float:
        across = np.cos(turn) * east + np.sin(turn) * north
        return float(0.05 + 0.15 * across * across)

    def share(east: float, north: float, width: float) -> float:
        steps = ((0.0, 0.0), (0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0))
        found: float = river_share(*(arid(east + x, north + y) for x, y in steps), width)
        return found

    width, places = 0.01, np.linspace(-0.3, 0.3, 601)
    shares = [share(np.cos(turn) * at, np.sin(turn) * at, width) for at in places]
    assert share(0.0, 0.0, width) == 1.0
    # half of the river's width on both sides, but for the twist between texels
    assert np.mean(shares) * 0.6 == pytest.approx(2.0 * RIVER, rel=0.2)
    assert share(0.0, 0.0, 1.0) == pytest.approx(2.0 * RIVER)


def test_neither_woods_nor_deserts_nor_coasts_have_rivers() -> None:
    assert river_share(0.02, 0.05, 0.02, 0.05, 0.02, 0.1) == 0.0
    assert river_share(0.25, 0.26, 0.25, 0.26, 0.25, 0.1) == 0.0
    assert river_share(0.2, 0.2, 0.2, 0.2, 0.2, 0.1) == 0.0
