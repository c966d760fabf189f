"""Texture of land: means of reflectance and of sunlight remain, contrast and slopes are stated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.gradient_noise import PERIOD, smooth_noise
from airlight.geometry.vectors import Vec3
from airlight.scene.ground_detail import STEP, WHOLE_PERIOD, finest_cell
from airlight.scene.land_texture import (
    COARSEST,
    CONTRAST,
    GRAZING,
    HIGHEST,
    LEVELS,
    OCTAVES,
    SLOPE,
    STEEPEST,
    TALL,
    land_texture,
    met_height,
    texture_light,
)

CELL = finest_cell(6371e3, 2700)
NO_LEAN = Vec3(0.0, 0.0, 0.0)


def textures(count: int, footprint: float, lean: Vec3 = NO_LEAN) -> np.ndarray:
    """Texture at random places, shape (count, 3)."""
    random = np.random.default_rng(1)
    found = []
    for _ in range(count):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        part, way = Vec3(*random.uniform(size=3)), random.normal(size=3)
        way /= np.linalg.norm(way)
        found.append(
            land_texture(Vec3(0.0, 0.0, 0.0), footprint, CELL, whole, part, Vec3(*way), lean)
        )
    return np.array(found)


def test_texture_keeps_the_mean_and_has_its_contrast() -> None:
    # Independent octaves: variances add. The mean of 1200 places is known to 3 standard errors.
    found = textures(1200, 1e-4)
    deviations = found.std(axis=0)
    assert np.all(np.abs(found.mean(axis=0)) < 3.0 * deviations / math.sqrt(1200.0))
    assert_allclose(deviations[0], CONTRAST * math.sqrt(OCTAVES), rtol=0.1)
    # cells up to HIGHEST have slopes
    sloping = round(math.log(HIGHEST * STEP ** (OCTAVES - 1) / COARSEST, STEP)) + 1
    assert_allclose(deviations[2], SLOPE * math.sqrt(sloping), rtol=0.1)


def test_nothing_is_shown_of_cells_finer_than_two_footprints() -> None:
    assert np.all(textures(3, 0.51 * COARSEST * CELL) == 0.0)
    assert np.all(textures(3, 0.4 * COARSEST * CELL)[:, 0] != 0.0)


def test_heights_before_a_place_hide_it_alone() -> None:
    # From above nothing is displaced; at a grazing angle the same noise is seen elsewhere.
    level, leaning = textures(60, 1e-4), textures(60, 1e-4, Vec3(8.0, 0.0, 0.0))
    assert np.any(leaning != level)
    assert_allclose(leaning.std(axis=0), level.std(axis=0), rtol=0.35)


def test_what_stands_out_hides_what_is_behind_it_and_keeps_the_mean() -> None:
    # The law: a line of sight ends at the first height above it, looked for from the observer in a
    # hundred steps; the found one is between its own steps. Of the reflectance what stands out
    # shows its tops: 2 % at the most grazing angle.
    lean, tallest = Vec3(1.0 / GRAZING, 0.0, 0.0), TALL
    random = np.random.default_rng(5)
    fine, missed = np.linspace(TALL, 0.0, 101), 0
    for place in random.uniform(0.0, PERIOD, (300, 3)):
        found = met_height(*place, lean, tallest)
        heights = [
            TALL * max(smooth_noise(place[0] + one * lean.x, place[1], place[2]), 0.0)
            for one in fine
        ]
        first = fine[np.argmax(np.array(heights) >= fine)]
        assert 0.0 <= found <= TALL
        missed += abs(found - first) > TALL / LEVELS
    assert missed < 0.1 * 300
    tones = textures(4000, 1e-4, lean)[:, 0]
    assert abs(tones.mean()) < 0.02 + 3.0 * tones.std() / math.sqrt(4000.0)


@pytest.mark.parametrize("zenith", [0.0, 35.0, 80.0, 85.0, 89.0])
def test_slopes_receive_what_the_level_ground_does(zenith: float) -> None:
    # To first order 1 - ascent tan θ, and for opposite slopes the mean is 1 at all angles.
    mu_s = math.cos(math.radians(zenith))
    slopes = np.linspace(-STEEPEST, STEEPEST, 41)
    light = np.array([texture_light(mu_s, slope) for slope in slopes])
    assert_allclose(light.mean(), 1.0, atol=1e-9)
    assert light.min() >= 0.0
    if zenith <= 35.0:
        assert_allclose(
            texture_light(mu_s, 0.01), 1.0 - 0.01 * math.tan(math.radians(zenith)), atol=4e-4
        )
