"""Resolved waves of the sea: their statistics, and what a footprint leaves of them."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.vectors import Vec3
from airlight.physics.optics.cox_munk import mean_square_slope
from airlight.scene.ground_detail import finest_cell, lattice_origin
from airlight.scene.sea_waves import (
    COARSEST,
    SHARE,
    peak_wavenumber,
    resolved,
    sea_slopes,
    triad_products,
    wave,
)

RADIUS = 6.36e6
CELL = finest_cell(RADIUS, 2700.0)


def slopes(wind, footprint, latitude=0.6, longitude=-2.2, count=1000):
    """Slopes at random places within 2 km of a point, and their share of the variance."""
    up = np.array([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude),
                   np.sin(latitude)])  # fmt: skip
    east = np.array([-np.sin(longitude), np.cos(longitude), 0.0])
    north = np.cross(up, east)
    origin = [lattice_origin(float(one), RADIUS, CELL) for one in up]
    whole, part = (Vec3(*(one[k] for one in origin)) for k in range(2))
    random = np.random.default_rng(5)
    places = random.uniform(-2e3, 2e3, (count, 2)) @ np.array([east, north])
    found = [sea_slopes(Vec3(*one), Vec3(*east), Vec3(*north), footprint, wind, CELL, whole, part)
             for one in places]  # fmt: skip
    return np.array(found)


@pytest.mark.parametrize(("wind", "footprint"), [(2.0, 0.05), (6.0, 0.5), (15.0, 3.0)])
def test_resolved_and_other_slopes_have_cox_and_munk_s_variance(wind, footprint):
    # What is said to be resolved is in the slopes, evenly in all directions: the rest of the
    # variance is the share that stays statistical. A thousand places leave an error of 4.5 %.
    found = slopes(wind, footprint)
    share, each = found[0, 2], 0.5 * mean_square_slope(wind)
    assert 0.1 < share < 0.8
    assert_allclose(found[:, :2].var(axis=0), share * each, rtol=0.14)
    assert abs(np.mean(found[:, 0] * found[:, 1])) < 0.14 * share * each
    assert_allclose(found[:, 2], share, rtol=1e-12)


@pytest.mark.parametrize("wind", [0.5, 5.0, 25.0])
def test_all_waves_together_are_the_sea(wind):
    # The steps of ln k leave an error of half a step of two in an octave.
    assert_allclose(slopes(wind, 1e-4, count=2)[:, 2], SHARE, atol=0.06)
    assert_allclose(slopes(wind, COARSEST / peak_wavenumber(wind), count=2), 0.0, atol=1e-12)


def test_slopes_are_normal():
    # Cox & Munk's distribution: many independent waves. Kurtosis 3, of 1000 places 0.16.
    found = slopes(8.0, 0.2)[:, 0]
    assert abs(np.mean(found**4) / np.mean(found**2) ** 2 - 3.0) < 0.5


def test_waves_of_two_pixels_are_gone():
    # Nyquist: waves of two pixels would alias.
    assert resolved(np.pi / 0.3, 0.3) < 0.1
    assert resolved(0.01, 0.3) > 0.999


def test_triads_are_orthogonal_and_a_wave_is_a_sine():
    for which, length in enumerate((7.0, 11.0)):
        rows = np.array([tuple(triad_products(which, Vec3(*one))) for one in np.eye(3)])
        assert_allclose(rows @ rows.T, length**2 * np.eye(3), atol=1e-12)
    turns = np.linspace(-3.0, 3.0, 301)
    assert_allclose([wave(x) for x in turns], np.sin(2.0 * np.pi * turns), atol=1.2e-3)
