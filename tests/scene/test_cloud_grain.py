"""Texture of the flat cloud layer: cover of the map, broad spectrum, no seams."""

from __future__ import annotations

import numpy as np
import pytest

from airlight.geometry.gradient_noise import GRADIENT_DEVIATION, gradient_noise
from airlight.geometry.vectors import Vec3
from airlight.render.pixels.ground_clouds import HEAPED, tops_light
from airlight.scene.cloud_grain import (
    COARSEST,
    EDGE,
    FALL,
    FOLDED,
    FOLDED_DEVIATION,
    GATHERED,
    GROUPS,
    GROWING,
    OCTAVES,
    OPEN,
    PUFFED,
    ROUGHEST,
    SMALL,
    SMOOTH,
    SMOOTHEST,
    SPREAD,
    WARPED,
    WISPS,
    CloudGrain,
    cloud_grain,
    turning_place,
    veil_grain,
)
from airlight.scene.ground_detail import WHOLE_PERIOD, above_threshold, finest_cell, grained_cover

CELL = finest_cell(6371e3, 2048)
#: Width of a texel. [m]
TEXEL = 65536.0 * CELL
WHOLE, PART = Vec3(3e6, 5e6, 7e6), Vec3(0.1, 0.2, 0.3)
WAY = Vec3(0.48, -0.6, 0.64)


def grain_at(place: np.ndarray, footprint: float, cover: float = 0.5) -> CloudGrain:
    """Texture at a place. [m]"""
    grain: CloudGrain = cloud_grain(
        Vec3(*place), footprint, cover, CELL, WHOLE, PART, WAY, EDGE, True
    )
    return grain


@pytest.mark.parametrize("footprint", [10.0, 300.0, 1500.0, 3000.0])
def test_clouds_between_texels_have_the_cover_of_the_map(footprint: float) -> None:
    # Noise that is not quite normal errs by 2 %, the mean of 4000 places by 0.7 %.
    places = np.random.default_rng(9).uniform(-60.0, 60.0, (4000, 3)) * TEXEL
    for cover in (0.05, 0.2, 0.5, 0.8, 0.95):
        grains = [grain_at(place, footprint, cover) for place in places]
        covers = [grained_cover(cover, 0.05, *one[:3]) for one in grains]
        assert abs(np.mean(covers) - cover) < 0.03
        assert 0.0 <= min(covers) < max(covers) <= 1.0
        noise, variance, *_ = np.transpose(grains)
        # octaves are taken as independent, but displace one another
        assert noise.var() == pytest.approx(variance.mean(), rel=0.2)


def differences(distances: np.ndarray) -> np.ndarray:
    """Mean squares of the differences of noise over distances, over twice its variance. [1]"""
    random = np.random.default_rng(3)
    places, squares = random.uniform(-60.0, 60.0, (3000, 3)) * TEXEL, []
    noise = np.array([grain_at(place, 1.0).noise for place in places])
    for distance in distances:
        way = random.normal(size=places.shape)
        way *= distance / np.linalg.norm(way, axis=1, keepdims=True)
        there = [grain_at(place, 1.0).noise for place in places + way]
        squares.append(np.mean((there - noise) ** 2) / (2.0 * noise.var()))
    return np.array(squares)


def test_no_scale_of_the_texture_prevails() -> None:
    """Mean squares of differences grow as the distance to 2/3, the law of a k^-5/3 spectrum."""
    distances = TEXEL * 0.5 ** np.arange(5)
    slope = np.polyfit(np.log(distances), np.log(differences(distances)), 1)[0]
    assert slope == pytest.approx(2.0 / 3.0, abs=0.15)


def test_clouds_gather_in_groups_of_several_texels() -> None:
    # Noise without correlation has 1; that of octaves below two texels has it at three of them.
    near, far = differences(TEXEL * np.array([3.0, 30.0]))
    assert near < 0.9
    assert far == pytest.approx(1.0, abs=0.06)


def test_clouds_have_gaps_thin_edges_and_thick_cores() -> None:
    # Clouds of one thickness with sharp edges would have few places between gaps and full cover.
    places = np.random.default_rng(6).uniform(-60.0, 60.0, (2000, 3)) * TEXEL
    grains = [grain_at(at, 300.0, 0.3) for at in places]
    covers = np.array([grained_cover(0.3, 0.05, *one[:3]) for one in grains])
    sharp = covers[np.array([one.edge for one in grains]) > EDGE]
    assert np.mean(sharp < 0.1) > 0.35
    assert np.mean((sharp > 0.2) & (sharp < 0.8)) > 0.3
    assert np.mean(sharp > 0.9) > 0.025


def test_the_texture_has_no_seam_where_its_lattice_repeats() -> None:
    step = Vec3(2.0, 0.0, 0.0)
    below = cloud_grain(
        step, 1.0, 0.5, 1.0, Vec3(float(WHOLE_PERIOD - 4), 5e6, 7e6), PART, WAY, EDGE, True
    )
    above = cloud_grain(step, 1.0, 0.5, 1.0, Vec3(0.0, 5e6, 7e6), PART, WAY, EDGE, True)
    # 4 cells of the finest lattice apart, of which the finest octave shown has 1024
    assert above == pytest.approx(below, rel=0.05, abs=0.05)


def test_footprints_wider_than_the_octaves_see_no_texture() -> None:
    assert grain_at(np.array([1e3, 2e3, 3e3]), 4.0 * TEXEL)[:2] == (0.0, 0.0)
    assert OCTAVES == 10


def ascent_by_differences(place: np.ndarray, footprint: float) -> float:
    """``CloudGrain.ascent`` for half cover, by differences of noise. [m⁻¹]"""
    total, ascent, step, edge = 0.0, 0.0, 0.01, grain_at(place, footprint).edge
    fall = FALL * np.clip((edge / EDGE) ** 0.25, SMOOTHEST, ROUGHEST)
    steps = np.array([0.0, step, -step])[:, None] * np.array(WAY)
    for octave in range(OCTAVES):
        scale = COARSEST * 0.5**octave
        folded, plain, shown = PUFFED, OPEN, fall**octave
        if octave < GROUPS:
            folded, plain = GATHERED, SPREAD
        else:
            shown *= min((SMALL + GROWING * 0.5) * 2.0 ** (octave - GROUPS), 1.0)
        shown *= max(min(0.5 * CELL * scale / footprint - 1.0, 1.0), 0.0)
        heights, moved = [], (WARPED + WISPS * max(1.0 - edge / EDGE, 0.0)) * total
        for point in np.array(PART) + (place + steps) / CELL:
            at = [turning_place(*one, scale)[0] for one in zip(WHOLE, point, strict=True)]
            noise = gradient_noise(at[0] + moved, at[1] - moved, at[2] + moved)
            puffs = (abs(noise) - FOLDED) / FOLDED_DEVIATION
            heights.append(folded * puffs + plain * noise / GRADIENT_DEVIATION)
            if len(heights) == 1:
                total += shown * heights[0]
        if octave >= GROUPS:
            smooth = SMOOTH ** (octave - GROUPS)
            ascent += shown * smooth * (heights[1] - heights[2]) / (2.0 * step)
    return ascent


def test_tops_ascend_as_noise_grows() -> None:
    # The central difference over 20 mm errs by rounding, but where noise is folded within it.
    places = np.random.default_rng(4).uniform(-60.0, 60.0, (300, 3)) * TEXEL
    off = [abs(grain_at(one, 300.0).ascent - ascent_by_differences(one, 300.0)) for one in places]
    assert np.quantile(off, 0.98) < 1e-7  # slopes are of the order of 1e-4


@pytest.mark.parametrize("mu_s", [0.9, 0.5, 0.1])
def test_slopes_of_tops_do_not_change_the_mean_light(mu_s: float) -> None:
    # As many slopes ascend towards the star as away from it: 6000 places, whose light varies by a
    # quarter and whose clouds cover a part, err by 0.5 %; 1.5 %, three of these, are allowed.
    light, seen = [], []
    for place in np.random.default_rng(5).uniform(-60.0, 60.0, (6000, 3)) * TEXEL:
        grain = grain_at(place, 300.0)
        cover = grained_cover(0.5, 0.05, *grain[:3])
        light.append(cover * tops_light(mu_s, HEAPED * grain.ascent))
        seen.append(cover)
    assert np.std(np.array(light) / np.array(seen)) > 0.03
    assert np.sum(light) == pytest.approx(np.sum(seen), rel=0.015)


def test_veils_are_drawn_out_along_parallels_and_have_the_cover_that_is_asked_for() -> None:
    # The mean of 4000 places errs by 2.5 % of a cover of 0.1, in the tail by more: by as much as
    # the noise is not normal there.
    places = np.random.default_rng(8).uniform(-300.0, 300.0, (4000, 3)) * TEXEL

    def veil(place: np.ndarray) -> tuple[float, float]:
        found: tuple[float, float] = veil_grain(Vec3(*place), 300.0, CELL, WHOLE, PART)
        return found

    veils = np.array([veil(place) for place in places])
    noise, variance = veils.T
    assert noise.mean() == pytest.approx(0.0, abs=0.1)
    assert noise.var() == pytest.approx(variance[0], rel=0.1)
    for cover, part in ((0.02, 0.12), (0.1, 0.08), (0.3, 0.05)):
        covers = [above_threshold(cover, 1.0, *one) for one in veils]
        assert np.mean(covers) == pytest.approx(cover, rel=part)
    east, north = (
        np.std([veil(place + 0.1 * TEXEL * way)[0] for place in places[:500]] - noise[:500])
        for way in (np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    )
    assert north > 3.0 * east
