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
    SPACING,
    STEEPEST,
    land_texture,
    row_before,
    seen_row,
    texture_light,
)

CELL = finest_cell(6371e3, 2700)


def textures(count: int, footprint: float, leaf: float = 1.0, rows: bool = False) -> np.ndarray:
    """Texture at random places, shape (count, 4); seen from above, or in rows."""
    random = np.random.default_rng(1)
    found = []
    for _ in range(count):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        part, way = Vec3(*random.uniform(size=3)), random.normal(size=3)
        way /= np.linalg.norm(way)
        longer = 1e9 if rows else footprint
        found.append(land_texture(part, part, footprint, longer, whole, Vec3(*way), leaf, 0.0))
    return np.array(found)


@pytest.mark.parametrize("leaf", [0.0, 1.0])
def test_texture_keeps_the_mean_and_has_its_contrast(leaf: float) -> None:
    # Independent octaves: variances add. The mean of 1200 places is known to 3 standard errors. The
    # noise of plants has fewer tops than that of stones, by which contrasts are stated.
    found = textures(1200, 1e-3, leaf)
    deviations = found.std(axis=0)
    assert np.all(np.abs(found.mean(axis=0)) < 3.0 * deviations / math.sqrt(1200.0))
    part = (1.0 - leaf) * 0.6 + leaf * (0.4005 + 0.2 * (0.542 - 0.4005)) / 0.542
    assert_allclose(deviations[0], part * CONTRAST * math.sqrt(OCTAVES), rtol=0.1)
    # cells up to HIGHEST have slopes
    sloping = round(math.log(HIGHEST * STEP ** (OCTAVES - 1) / COARSEST, STEP)) + 1
    assert_allclose(deviations[2], SLOPE * math.sqrt(sloping), rtol=0.35)


def test_nothing_is_shown_of_cells_finer_than_a_pixel() -> None:
    assert np.all(textures(3, 0.81 * COARSEST) == 0.0)
    assert np.all(textures(3, 0.4 * COARSEST)[:, 0] != 0.0)


def test_rows_have_the_texture_of_the_ground() -> None:
    # Where both are at the same place, whichever shows an octave has the same noise of it.
    assert_allclose(textures(40, 2.0, rows=True), textures(40, 2.0), atol=1e-12)


def test_rows_hide_the_ground_behind_them() -> None:
    # Geometry: a row stands before the place it hides, no farther than one row and its ragged edge,
    # and the line of sight meets it as high as it still is above the level ground.
    random = np.random.default_rng(5)
    zero, up, width, altitude = Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0), 2e-3, 1.8
    for distance in 10.0 ** random.uniform(0.8, 2.5, 200):
        dip = altitude / distance
        place = Vec3(distance, 0.0, 0.0)
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        row = seen_row(place, altitude, width, CELL, 1.0, whole, zero, up)
        near = row.x * CELL
        widest = max(width, SPACING * dip)
        assert near <= distance * (1.0 + 1e-12)
        assert altitude / near - dip < 2.1 * widest
        assert_allclose(row.z * CELL, 0.5 * altitude * (1.0 - near / distance), atol=1e-9)
        assert 0.0 < row_before(dip, width) - dip <= 1.03 * widest


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
