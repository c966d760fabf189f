"""Texture of the flat cloud layer: cover of the map, broad spectrum, no seams."""

from __future__ import annotations

import numpy as np
import pytest

from airlight.geometry.vectors import Vec3
from airlight.scene.cloud_grain import OCTAVES, CloudGrain, cloud_grain
from airlight.scene.ground_detail import WHOLE_PERIOD, finest_cell, grained_cover

CELL = finest_cell(6371e3, 2048)
#: Width of a texel. [m]
TEXEL = 65536.0 * CELL
WHOLE, PART = Vec3(3e6, 5e6, 7e6), Vec3(0.1, 0.2, 0.3)


def grain_at(place: np.ndarray, footprint: float) -> CloudGrain:
    """Texture at a place. [m]"""
    return cloud_grain(Vec3(*place), footprint, 0.5, CELL, WHOLE, PART)


@pytest.mark.parametrize("footprint", [10.0, 300.0, 1500.0])
def test_clouds_between_texels_have_the_cover_of_the_map(footprint: float) -> None:
    # The logistic function and noise that is not quite normal err by 2 %, the mean of 4000 places
    # by 0.7 %.
    places = np.random.default_rng(9).uniform(-60.0, 60.0, (4000, 3)) * TEXEL
    grains = [grain_at(place, footprint) for place in places]
    for cover in (0.05, 0.2, 0.5, 0.8, 0.95):
        covers = [grained_cover(cover, 0.05, *one) for one in grains]
        assert abs(np.mean(covers) - cover) < 0.03
        assert 0.0 <= min(covers) < max(covers) <= 1.0
    noise, variance, _ = np.transpose(grains)
    assert noise.var() == pytest.approx(variance.mean(), rel=0.15)


def test_no_scale_of_the_texture_prevails() -> None:
    """Mean squares of differences grow as the distance to 2/3, the law of a k^-5/3 spectrum."""
    random = np.random.default_rng(3)
    places = random.uniform(-60.0, 60.0, (3000, 3)) * TEXEL
    noise = np.array([grain_at(place, 1.0).noise for place in places])
    distances = TEXEL * 0.5 ** np.arange(5)
    squares = []
    for distance in distances:
        way = random.normal(size=places.shape)
        way *= distance / np.linalg.norm(way, axis=1, keepdims=True)
        there = [grain_at(place, 1.0).noise for place in places + way]
        squares.append(np.mean((there - noise) ** 2))
    slope = np.polyfit(np.log(distances), np.log(squares), 1)[0]
    assert slope == pytest.approx(2.0 / 3.0, abs=0.15)


def test_the_texture_has_no_seam_where_its_lattice_repeats() -> None:
    step = Vec3(2.0, 0.0, 0.0)
    below = cloud_grain(step, 1.0, 0.5, 1.0, Vec3(float(WHOLE_PERIOD - 4), 5e6, 7e6), PART)
    above = cloud_grain(step, 1.0, 0.5, 1.0, Vec3(0.0, 5e6, 7e6), PART)
    # 4 cells of the finest lattice apart, of which the finest octave shown has 1024
    assert above == pytest.approx(below, rel=0.05, abs=0.05)


def test_footprints_wider_than_the_octaves_see_no_texture() -> None:
    assert grain_at(np.array([1e3, 2e3, 3e3]), TEXEL)[:2] == (0.0, 0.0)
    assert OCTAVES == 8
