"""Tone maps against their published numbers, their inverses and each other's sources."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.image.agx import _INSET, _OUTSET, agx, agx_curve
from airlight.image.floating import each
from airlight.image.gamut import in_gamut
from airlight.image.tone_maps import (
    TONE_MAPS,
    exponential,
    hable,
    reinhard,
    reinhard_extended,
    reinhard_extended_inverse,
    shown_light,
    tone_map_named,
)
from airlight.image.xyz import luminance

GREYS = np.concatenate([[0.0], np.geomspace(1e-4, 5.0, 200)])[:, None] * np.ones(3)
#: Light that no map clips: within the darkest and brightest that each holds, no pure hue.
LIGHT = np.random.default_rng(2).uniform(0.05, 2.0, size=(300, 3))


@pytest.mark.parametrize("name", TONE_MAPS)
def test_inverse_gives_the_light_back(name):
    tone_map = tone_map_named(name)
    # Newton's method leaves 1e-12 of the chroma at the gamut's soft edge, whose inverse, a
    # logarithm of the rest, amplifies it a thousandfold
    assert_allclose(tone_map.inverse(tone_map.forward(LIGHT)), LIGHT, rtol=4e-9)


@pytest.mark.parametrize("name", TONE_MAPS)
def test_brighter_light_is_never_shown_darker(name):
    shown = tone_map_named(name).forward(GREYS)
    assert np.all(np.diff(shown, axis=0) >= 0.0)
    assert np.all(np.diff(shown[80:150], axis=0) > 0.0)


@pytest.mark.parametrize("name", TONE_MAPS)
def test_black_is_black(name):
    # AgX's darkest stop is its black; all others start at 0.
    assert_allclose(tone_map_named(name).forward(np.zeros(3)), 0.0, atol=1e-12)


@pytest.mark.parametrize("name", TONE_MAPS)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_no_light_gives_a_nan_or_a_negative(name, dtype):
    extremes = np.array([-np.inf, -1.0, -0.0, 0.0, 1e-38, 1e-5, 1.0, 1e5, 3e38, np.inf, np.nan])
    colors = np.stack(np.meshgrid(extremes, extremes, extremes), axis=-1).astype(dtype)
    tone_map = tone_map_named(name)
    for function in (tone_map.forward, tone_map.inverse):
        shown = function(colors)
        assert shown.dtype == dtype
        assert shown.shape == colors.shape
        assert not np.isnan(shown).any()
    shown = tone_map.forward(colors)
    assert np.all(shown >= 0.0)
    assert np.all(np.isfinite(shown))


@pytest.mark.parametrize("name", TONE_MAPS)
def test_float32_follows_float64(name):
    forward = tone_map_named(name).forward
    assert_allclose(forward(LIGHT.astype(np.float32)), forward(LIGHT), rtol=3e-6)


def test_hable_of_one_is_the_published_number():
    # Golden numbers: Hable(1) = 0.4929, and white from W/bias = 5.6 on.
    assert_allclose(hable(np.ones(3)), 0.4929, rtol=0, atol=5e-5)
    assert_allclose(hable(np.array([5.6, 7.0, np.inf])), 1.0, rtol=1e-14)


def test_exponential_of_one():
    assert_allclose(exponential(np.ones(3)), 1.0 - 1.0 / np.e, rtol=1e-15)


@pytest.mark.parametrize("function", [reinhard, reinhard_extended])
def test_reinhard_works_on_luminance_and_keeps_the_hue(function):
    # Equations 3 and 4 of Reinhard et al. (2002), white 4.
    bright = luminance(LIGHT)
    factor = {reinhard: 1.0, reinhard_extended: 1.0 + bright / 16.0}[function] / (1.0 + bright)
    assert_allclose(luminance(function(LIGHT)), bright * factor, rtol=1e-12)
    assert_allclose(function(LIGHT) / LIGHT, factor[:, None] * np.ones(3), rtol=1e-12)


def test_reinhard_extended_shows_its_white_point_as_white():
    for white in (0.5, 1.0, 4.0, 100.0):
        # The luminance of (1, 1, 1) is 1 to the matrix's seven decimals.
        assert_allclose(reinhard_extended(np.full(3, white), white=white), 1.0, rtol=1e-7)
        assert_allclose(reinhard_extended_inverse(np.ones(3), white=white), white, rtol=1e-6)
    with pytest.raises(ParameterError, match=r"^white is"):
        reinhard_extended(np.ones(3), white=0.0)


def test_aces_shows_the_three_points_of_its_tone_scale():
    # The ACES 1.0 output transform for 48 cd/m² shows 0.18 at 4.8 cd/m², 6.5 stops above it at
    # 48 and 6.5 below at 0.02 cd/m². Hill's fit errs by 6 per cent, 4 per cent and 0.0005.
    scene = 0.18 * 2.0 ** np.array([-6.5, 0.0, 6.5])
    shown = TONE_MAPS["aces"].forward(scene[:, None] * np.ones(3))
    assert_allclose(shown[0], 0.02 / 48.0, atol=6e-4)
    assert_allclose(shown[1], 0.1, rtol=0.07)
    assert_allclose(shown[2], 1.0, rtol=0.05)


def test_aces_is_the_published_fit():
    # ACES.hlsl of BakingLab, its two matrices and RRTAndODTFit, for one orange.
    into = [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]]
    out = [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605]]
    out += [[-0.00327, -0.07276, 1.07602]]
    v = np.array(into) @ [1.2, 0.5, 0.1]
    fit = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081)
    assert_allclose(TONE_MAPS["aces"].forward([1.2, 0.5, 0.1]), np.array(out) @ fit, rtol=1e-12)


def test_aces_and_agx_keep_grey_grey():
    # Each row of the matrices adds to 1: ACES's to 1e-5, AgX's to 1.4e-4.
    for name, tolerance in (("aces", 5e-5), ("agx", 1e-3)):
        shown = TONE_MAPS[name].forward(GREYS)
        assert_allclose(shown, shown[:, :1] * np.ones(3), rtol=tolerance, atol=1e-5)


def test_agx_agrees_with_wrensch_s_polynomial():
    # Wrensch (2023), "Minimal AgX Implementation": a sixth-order fit to Sobotka's curve, from log₂
    # position to display value, whose root mean square error he gives as 0.0019.
    x = np.linspace(0.0, 1.0, 1001)
    polynomial = np.polyval([15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232], x)
    sigmoid = each(agx_curve, 0.18 * 2.0 ** (16.5 * x - 10.0))
    assert_allclose(sigmoid, polynomial, atol=0.006)


def test_agx_holds_sixteen_and_a_half_stops_around_middle_grey():
    # Sobotka's curve: grey to 0.5 with slope 2, ends at 0 and 1 exactly.
    step = 1e-4
    stops = np.array([-10.0, 0.0, 6.5, step, -step])
    values = each(agx_curve, 0.18 * 2.0**stops)
    assert_allclose(values[:3], [0.0, 0.5, 1.0], rtol=1e-12, atol=1e-12)
    assert_allclose((values[3] - values[4]) / (2.0 * step / 16.5), 2.0, rtol=1e-6)


def test_agx_turns_bright_colours_white():
    # What it is for: a very bright pure red loses its saturation, where Hable keeps it.
    red = np.array([1000.0, 1.0, 1.0])
    assert agx(red).min() > 0.5
    assert hable(0.01 * red).min() < 0.05


def test_an_unknown_tone_map_is_refused():
    with pytest.raises(ParameterError, match="allowed: natural, exponential, hable"):
        tone_map_named("filmic")


def test_integers_are_taken_as_numbers():
    assert_array_equal(hable([1, 1, 1]), hable([1.0, 1.0, 1.0]))


def test_agx_is_its_curve_between_inset_and_outset():
    # The steps one by one, by NumPy's matrices.
    inset = np.array(_INSET)
    shaped = each(agx_curve, LIGHT @ inset.T)
    shown = np.clip(shaped @ np.linalg.inv(inset).T, 0.0, 1.0) ** 2.2
    assert_allclose(agx(LIGHT), shown, rtol=1e-12)
    assert_allclose(_OUTSET @ inset, np.eye(3), rtol=0.0, atol=1e-15)


@pytest.mark.parametrize("which", range(len(TONE_MAPS)), ids=list(TONE_MAPS))
def test_a_tone_map_s_number_is_its_place(which):
    # The same formula by another way: to rounding, for colours that no gamut step changes.
    forward = list(TONE_MAPS.values())[which].forward
    kept = [color for color in LIGHT[:60] if np.ptp(in_gamut(color, bounded=False) - color) == 0.0]
    assert len(kept) > 20
    for color in kept:
        if forward(color).max() <= 1.0:
            assert_allclose(shown_light(which, 0, 0, *color), forward(color), rtol=1e-12)


def test_arrays_that_are_no_colours_are_refused():
    for name in ("reinhard", "aces", "agx"):
        with pytest.raises(ParameterError, match=r"^rgb is \(4, 2\)"):
            tone_map_named(name).forward(np.ones((4, 2)))
