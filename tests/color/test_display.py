"""Exposure and the way to 8 bits."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.color import display
from airlight.color.display import to_display
from airlight.color.encoding import srgb_encode
from airlight.color.exposure import automatic_exposure, exposure_factor
from airlight.color.tone_maps import TONE_MAPS, tone_map_named
from airlight.errors import ParameterError

PICTURE = np.random.default_rng(3).lognormal(size=(37, 53, 3)).astype(np.float32)


def test_one_ev_doubles_the_light():
    assert exposure_factor(0.0) == 1.0
    assert_allclose(exposure_factor(1.5) / exposure_factor(0.5), 2.0, rtol=1e-15)
    assert_array_equal(to_display(2.0 * PICTURE, -1.0), to_display(PICTURE, 0.0))


@pytest.mark.parametrize("name", TONE_MAPS)
def test_automatic_exposure_shows_the_log_average_as_middle_grey(name):
    # A uniform picture of any strength becomes 18 per cent grey, with every tone map.
    for strength in (1e-8, 1.0, 1e6):
        grey = np.full((4, 4, 3), strength)
        shown = tone_map_named(name).forward(grey * exposure_factor(automatic_exposure(grey, name)))
        assert_allclose(shown, 0.18, rtol=1e-3)
    picture = to_display(np.full((2, 2, 3), 7.0), "auto", name)
    assert_array_equal(picture, round(255.0 * float(srgb_encode(0.18))))


def test_automatic_exposure_is_the_geometric_mean():
    two = np.ones((1, 2, 3)) * np.array([1.0, 4.0])[None, :, None]
    difference = automatic_exposure(two) - automatic_exposure(np.full((1, 2, 3), 2.0))
    assert_allclose(difference, 0.0, atol=1e-12)


def test_black_space_does_not_change_the_automatic_exposure():
    planet = np.random.default_rng(4).uniform(1.0, 5.0, size=(20, 20, 3))
    space = np.full((200, 20, 3), 1e-9)
    space[::2] = 0.0
    both = automatic_exposure(np.concatenate([planet, space]))
    assert_allclose(both, automatic_exposure(planet), atol=1e-12)


def test_automatic_exposure_of_odd_pictures_is_a_number():
    assert automatic_exposure(np.zeros((3, 3, 3))) == 0.0
    odd = np.ones((3, 3, 3), dtype=np.float32)
    odd[0, 0] = np.nan
    odd[1, 1] = np.inf
    odd[2, 2] = -1.0
    assert_allclose(automatic_exposure(odd), automatic_exposure(np.ones((3, 3, 3))), atol=1e-6)


def test_a_large_picture_is_sampled_evenly():
    # Every second row and column of 2400 x 2400: a smooth picture's mean hardly changes.
    ramp = np.linspace(1.0, 3.0, 2400, dtype=np.float32)
    large = np.broadcast_to(ramp[:, None, None], (2400, 2400, 3))
    small = np.broadcast_to(ramp[::8, None, None], (300, 2, 3))
    assert_allclose(automatic_exposure(large), automatic_exposure(small), atol=5e-3)


def test_display_is_exposure_then_tone_map_then_encoding():
    # The definition, written out for one picture in float64, rounded to the nearest.
    shown = 255.0 * srgb_encode(tone_map_named("hable").forward(PICTURE.astype(float) * 2.0**-2.5))
    difference = to_display(PICTURE) - shown
    assert np.abs(difference).max() < 0.501


def test_ends_of_the_scale_are_black_and_white():
    light = np.array([[[0.0, -5.0, np.nan], [1e9, np.inf, 3e38]]], dtype=np.float32)
    for name in ("exponential", "hable"):
        assert_array_equal(to_display(light, 0.0, name), [[[0, 0, 0], [255, 255, 255]]])
    for name in TONE_MAPS:
        assert_array_equal(to_display(np.full((1, 1, 3), 1e9), 0.0, name), 255)


def test_blocks_of_rows_make_no_difference(monkeypatch):
    whole = to_display(PICTURE, "auto", "agx", "gamma")
    monkeypatch.setattr(display, "_BLOCK", 100)
    assert_array_equal(to_display(PICTURE, "auto", "agx", "gamma"), whole)


def test_memory_is_bounded_by_a_block():
    # 4 096 x 1 024 pixels: 12.6 MB out; one block of 262 144 pixels needs about 50 MB beside it.
    picture = np.ones((4096, 1024, 3), dtype=np.float32)
    to_display(picture[:2])
    tracemalloc.start()
    try:
        to_display(picture)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 70e6


@pytest.mark.parametrize(
    ("arguments", "field"),
    [
        ((PICTURE, "automatic"), "exposure"),
        ((PICTURE, float("nan")), "exposure"),
        ((PICTURE, 1e6), "exposure"),
        ((PICTURE, 0.0, "none"), "tone_map"),
        ((PICTURE, 0.0, "hable", "none"), "encoding"),
        ((PICTURE[..., :2],), "rgb"),
    ],
)
def test_what_cannot_be_displayed_is_refused(arguments, field):
    with pytest.raises(ParameterError, match=f"^{field} is"):
        to_display(*arguments)
