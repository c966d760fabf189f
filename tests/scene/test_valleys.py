"""Valleys and fields from above: means of light and reflectance, where gullies run, edges."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.gradient_noise import PERIOD
from airlight.geometry.vectors import Vec3
from airlight.scene.ground_detail import WHOLE_PERIOD
from airlight.scene.hills import COARSEST
from airlight.scene.valleys import (
    EDGE,
    OCTAVES,
    PALER,
    SMOOTH,
    Phasor,
    Valleys,
    dunes,
    farmland,
    gullies,
    lattice_phasor,
    patch_noise,
    rotated,
    valleys,
)


def directions(random: np.random.Generator) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertical and two horizontal directions, of right angles."""
    return tuple(np.linalg.qr(random.normal(size=(3, 3)))[0].T)


def places(count: int, footprint: float, steep: float = 0.05) -> np.ndarray:
    """``Valleys``, and ``farmland``, at random places on random slopes, shape (count, 6)."""
    random, found = np.random.default_rng(1), []
    for _ in range(count):
        up, way, other = directions(random)
        slope = 0.02 * (random.normal() * way + random.normal() * other)
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        part = Vec3(*random.uniform(size=3))
        seen = valleys(part, footprint, whole, Vec3(*up), Vec3(*way), Vec3(*slope), steep)
        found.append((*seen, *farmland(part, footprint, whole, seen.height)))
    return np.array(found)


@pytest.mark.parametrize("footprint", [20.0, 4000.0])
def test_valleys_and_fields_keep_mean_light_and_mean_reflectance(footprint: float) -> None:
    # Ascents and tones are changes to first order: 3 standard errors of 6000 places, and of the
    # tone of six octaves the error of its fitted constant.
    found = places(6000, footprint)
    tones, stated = found[:, 3], found[0, 4]
    assert tones.var() == pytest.approx(stated, rel=0.15)
    found = np.delete(found, 4, axis=1)
    errors = 3.0 * found.std(axis=0) / math.sqrt(6000.0)
    errors[2] += 6.0 * 0.002
    assert np.all(np.abs(found.mean(axis=0)) < errors)
    assert np.all(found.std(axis=0)[:3] > 0.02)


def test_gullies_are_waves_across_their_direction() -> None:
    # Central differences along the direction are the slope but for the blend of cells, and are
    # larger than those along the crests.
    random, step, found = np.random.default_rng(2), 1e-4, []
    for place in random.uniform(0.0, PERIOD, (600, 3)):
        _up, across, along = directions(random)
        wave, slope = gullies(*place, Vec3(*across))
        assert abs(wave) <= 1.0
        grown = [
            (gullies(*(place + step * way), Vec3(*across))[0] - wave) / step
            for way in (across, along)
        ]
        found.append((slope, *grown))
    slope, by_difference, beside = np.transpose(found)
    assert np.corrcoef(slope, by_difference)[0, 1] > 0.85
    assert np.std(by_difference) > 1.7 * np.std(beside)


def test_gullies_run_down_the_slope_of_the_map() -> None:
    """Of a slope far steeper than the relief: tones change across it more than along it."""
    random, changes, step = np.random.default_rng(3), [], 0.02 * COARSEST
    for _ in range(500):
        up, down, across = directions(random)
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))

        def tone(
            place: np.ndarray, whole: Vec3 = whole, up: np.ndarray = up, down: np.ndarray = down
        ) -> float:
            seen: Valleys = valleys(
                Vec3(*place), 0.2 * COARSEST, whole, Vec3(*up), Vec3(*down), Vec3(*down), 0.01
            )
            return seen.tone

        here = tone(np.zeros(3))
        changes.append([tone(step * way) - here for way in (across, down)])
    across, along = np.sqrt(np.mean(np.square(changes), axis=0))
    assert across > 1.7 * along


def test_nothing_is_shown_of_cells_below_two_pixels() -> None:
    assert np.all(places(5, 0.61 * SMOOTH) == 0.0)
    assert np.all(places(5, 0.4 * SMOOTH)[:, 0] != 0.0)


def test_fields_are_even_between_their_edges() -> None:
    # A cell has edges of a share EDGE of its width along each of three axes.
    random = np.random.default_rng(4)
    even = [
        patch_noise(*place, EDGE) == patch_noise(*(place + 1e-4), EDGE)
        for place in random.uniform(0.0, PERIOD, (3000, 3))
    ]
    assert_allclose(np.mean(even), (1.0 - EDGE) ** 3, atol=0.04)


def test_phases_of_cells_are_of_all_quarters_and_products_turn() -> None:
    # Complex numbers of Python are the second method.
    random = np.random.default_rng(5)
    for a, b in random.normal(size=(20, 2, 2)):
        assert_allclose(
            complex(*rotated(Phasor(*a), Phasor(*b))), complex(*a) * complex(*b), atol=1e-12
        )
    phases = [
        complex(*lattice_phasor(float(column), float(k)))
        for column, k in random.integers(0, 256, (4000, 2))
    ]
    assert_allclose(np.mean(phases), 0.0, atol=0.04)
    assert_allclose([abs(one.real) + abs(one.imag) for one in phases], 1.0, atol=1e-12)


def test_wide_valleys_are_more_conspicuous_than_narrow_ones() -> None:
    # Pixels of 0.3 texels show gullies in cells of a texel and none below. Octaves whose contrast
    # falls to PALER have the share 1 - PALER² of the variance in the first; equal ones, 1/OCTAVES.
    wide, narrow = places(3000, 0.3 * COARSEST)[:, 2], places(3000, 20.0)[:, 2]
    share = np.var(wide) / np.var(narrow)
    assert share > 1.5 / OCTAVES
    assert_allclose(share, 1.0 - PALER**2, atol=0.1)


def test_dunes_run_from_north_to_south_and_keep_the_mean() -> None:
    # The mean of 4000 places within 3 standard errors.
    random, tones, changes = np.random.default_rng(6), [], []
    for _ in range(4000):
        whole = Vec3(*np.floor(random.uniform(0.0, WHOLE_PERIOD, 3)))
        here, *beside = (
            dunes(Vec3(*(0.02 * COARSEST * way)), 20.0, whole, 0.3)
            for way in np.vstack([np.zeros(3), np.eye(3)])
        )
        tones.append(here)
        changes.append(np.array(beside) - here)
    assert 0.2 < np.mean(np.array(tones) == 0.0) < 0.7  # beyond the seas of sand
    assert abs(np.mean(tones)) < 3.0 * np.std(tones) / math.sqrt(4000.0)
    east, _, north = np.std(changes, axis=0)
    assert east > 5.0 * north
    assert dunes(Vec3(0.0, 0.0, 0.0), COARSEST, Vec3(5.0, 6.0, 7.0), 0.0) == 0.0
