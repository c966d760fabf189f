"""Texture of land: means of reflectance and of sunlight remain, contrast and slopes are stated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.scene.ground_detail import STEP, WHOLE_PERIOD, finest_cell
from airlight.scene.land_texture import (
    COARSEST,
    CONTRAST,
    HIGHEST,
    OCTAVES,
    SLOPE,
    STEEPEST,
    land_texture,
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
