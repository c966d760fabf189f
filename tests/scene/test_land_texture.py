"""Texture of land: means of reflectance and of sunlight remain, contrast and slopes are stated."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.scene.ground_detail import STEP, WHOLE_PERIOD, finest_cell
from airlight.scene.land_texture import (
    COARSE,
    COARSEST,
    CONTRAST,
    DRAWN,
    FINER,
    HIGHEST,
    OCTAVES,
    SLOPE,
    SPACING,
    STEEPEST,
    face_of,
    faced,
    land_texture,
    row_before,
    seen_row,
    texture_light,
)

CELL = finest_cell(6371e3, 2700)


def textures(
    count: int,
    footprint: float,
    leaf: float = 1.0,
    rows: bool = False,
    snow: float = 0.0,
    rough: float = 0.0,
) -> np.ndarray:
    """Texture at random places, shape (count, 4); seen from above, or in rows."""
    random = np.random.default_rng(1)
    found = []
    for _ in range(count):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        part, way = Vec3(*random.uniform(size=3)), random.normal(size=3)
        way /= np.linalg.norm(way)
        longer = 1e9 if rows else footprint
        found.append(
            land_texture(part, part, footprint, longer, whole, Vec3(*way), leaf, snow, True, rough)
        )
    return np.array(found)


@pytest.mark.parametrize(("leaf", "snow"), [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
def test_texture_keeps_the_mean(leaf: float, snow: float) -> None:
    # The mean of 1200 places is known to 3 standard errors.
    found = textures(1200, 1e-3, leaf, snow=snow)
    assert np.all(np.abs(found.mean(axis=0)) < 3.0 * found.std(axis=0) / math.sqrt(1200.0))


@pytest.mark.parametrize("rough", [-1.0, 1.0])
def test_mounds_and_pits_keep_the_mean_and_have_slopes(rough: float) -> None:
    # Slopes of a height that is a function of noise; 5° to 20°.
    even, uneven = textures(3000, 1e-3, 0.0), textures(3000, 1e-3, 0.0, rough=rough)
    assert np.all(np.abs(uneven.mean(axis=0)) < 3.0 * uneven.std(axis=0) / math.sqrt(3000.0))
    added = uneven[:, 2] - even[:, 2]
    assert 0.08 < added.std() < 0.4


def test_plants_have_the_stated_contrast_and_slopes() -> None:
    # Independent octaves: variances add. Cells up to HIGHEST have slopes. Directions are of space,
    # of which the plane has two thirds.
    deviations = textures(1200, 1e-3).std(axis=0)
    octaves = np.arange(OCTAVES)
    loud = COARSE + FINER * octaves
    assert_allclose(deviations[0], CONTRAST * np.linalg.norm(loud), rtol=0.1)
    sloping = loud[COARSEST / float(STEP) ** octaves <= HIGHEST]
    wanted = SLOPE * math.sqrt(2.0 / 3.0) * np.linalg.norm(sloping)
    assert_allclose(deviations[2], wanted, rtol=0.1)


def test_waves_of_sand_have_a_direction_and_sastrugi_have_another() -> None:
    # Squares of slopes along both axes of the face: waves cross the second, and sastrugi are drawn
    # out along the first by DRAWN. Waves alone would have sqrt(π² + (5 x 0.86/4)²)/(5 x 0.86/8),
    # 6.2; noise without a direction is between them.
    random = np.random.default_rng(6)
    for leaf, snow, low, high in (
        (0.0, 0.0, 2.0, 6.2),
        (0.0, 1.0, 0.85 * DRAWN, 1.15 * DRAWN),
        (1.0, 0.0, 0.85, 1.15),
    ):
        squares = np.zeros(2)
        for _ in range(800):
            whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
            part = Vec3(*random.uniform(size=3))
            for axis, way in enumerate((Vec3(1.0, 0.0, 0.0), Vec3(0.0, 1.0, 0.0))):
                found = land_texture(part, part, 1e-3, 1e-3, whole, way, leaf, snow, True, 0.0)
                squares[axis] += found.ascent**2
        ratio = math.sqrt(squares[1] / squares[0])
        assert low < ratio < high


def test_faces_keep_lengths_and_have_the_vertical_across() -> None:
    for up in np.random.default_rng(7).normal(size=(50, 3)):
        turned = faced(Vec3(*up), face_of(Vec3(*up)))
        assert_allclose(np.linalg.norm(turned), np.linalg.norm(up))
        assert abs(turned.z) == np.abs(up).max()


def test_nothing_is_shown_of_cells_finer_than_a_pixel() -> None:
    assert np.all(textures(3, 0.81 * COARSEST) == 0.0)
    assert np.all(textures(3, 0.4 * COARSEST)[:, 0] != 0.0)


def test_rows_have_the_texture_of_the_ground() -> None:
    # Where both are at the same place, whichever shows an octave has the same noise of it.
    assert_allclose(textures(40, 2.0, rows=True), textures(40, 2.0), atol=1e-12)


def test_rows_hide_the_ground_behind_them() -> None:
    # Geometry: a row stands before the place it hides, no farther than one row and its ragged edge,
    # and is read half as far beyond its foot as the line of sight is above it there.
    random = np.random.default_rng(5)
    zero, width, altitude = Vec3(0.0, 0.0, 0.0), 2e-3, 1.8
    for distance in 10.0 ** random.uniform(0.8, 2.5, 200):
        dip = altitude / distance
        place = Vec3(distance, 0.0, 0.0)
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        row = seen_row(place, altitude, width, CELL, 1.0, whole, zero)
        near = (row.x * CELL - 0.5 * altitude) / (1.0 - 0.5 * dip)
        widest = max(width, SPACING * dip)
        assert near <= distance * (1.0 + 1e-12)
        assert altitude / near - dip < 2.1 * widest
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
