"""Exposure and the way to 8 bits."""

from __future__ import annotations

import tracemalloc

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.image import display
from airlight.image.display import to_display
from airlight.image.dither import dither_noise, dither_place
from airlight.image.encoding import srgb_decode, srgb_encode
from airlight.image.gamut import PRIMARIES, RGB_TO_P3, in_gamut
from airlight.image.natural import natural
from airlight.image.tone_maps import TONE_MAPS, tone_map_named

PICTURE = np.random.default_rng(3).lognormal(size=(37, 53, 3)).astype(np.float32)


def test_one_ev_doubles_the_light():
    assert_array_equal(to_display(2.0 * PICTURE, -1.0), to_display(PICTURE, 0.0))


@pytest.mark.parametrize("primaries", PRIMARIES)
@pytest.mark.parametrize("name", TONE_MAPS)
def test_display_is_exposure_gamut_tone_map_gamut_encoding(name, primaries):
    # The definition, written out by the array functions in float64, rounded to the nearest.
    light = (PICTURE.astype(float) - 0.2) * 2.0**-1.5
    if name == "natural":
        shown = natural(light) if primaries == "srgb" else None
    else:
        curved = tone_map_named(name).forward(in_gamut(light, bounded=False))
        beyond = curved.max(axis=-1, keepdims=True) > 1.0
        shown = np.where(beyond, in_gamut(curved, soft=False), curved)
        shown = shown @ RGB_TO_P3.T if primaries == "display-p3" else shown
    if shown is not None:
        seen = to_display(PICTURE - 0.2, -1.5, name, primaries=primaries, dither=False)
        assert np.abs(seen - 255.0 * srgb_encode(shown)).max() < 0.501


def test_dither_keeps_means_and_hides_contours():
    # a gradient of one step over 256 pixels: its mean is kept where rounding alone shows a step
    shown = np.linspace(100.0, 101.0, 256)[None, :, None] / 255.0 * np.ones((256, 1, 3))
    light = srgb_decode(shown)
    plain = to_display(light, 0.0, style="soft", dither=False)
    seen = to_display(light, 0.0, style="soft")
    assert len(np.unique(plain)) == 2
    blocks = (seen - 255.0 * shown).reshape(8, 32, 8, 32, 3).mean(axis=(1, 3))
    assert np.abs(blocks).max() < 0.02
    # variance of rounding 1/12 and of the triangle 1/6, whatever the value is
    assert_allclose((seen - 255.0 * shown).var(axis=(0, 2)), 0.25, atol=0.06)
    assert_array_equal(seen, to_display(light, 0.0, style="soft"))


def test_dither_is_blue_and_has_no_beats():
    # Power over that of white noise, by the Fourier transform; a lattice has its power in peaks,
    # which become visible beats where a picture is scaled.
    places = [[dither_place(x + 0.5, y + 0.5) for x in range(128)] for y in range(128)]
    noise = np.array([[dither_noise(place) for place in row] for row in places])
    noise = np.moveaxis(noise, 2, 0)
    assert_allclose(noise.mean(axis=(1, 2)), 0.0, atol=2e-3)
    assert_allclose(noise.var(axis=(1, 2)), 1.0 / 6.0, rtol=0.01)
    frequency = np.fft.fftfreq(128)
    radius = np.hypot(frequency[:, None], frequency)
    for one in noise:
        power = np.abs(np.fft.fft2(one)) ** 2 / one.size / one.var()
        assert power[(radius > 0.0) & (radius < 1.0 / 16.0)].mean() < 0.05
        assert power[(radius > 0.0) & (radius < 1.0 / 8.0)].mean() < 0.15
        assert power[radius > 0.5].mean() > 1.5
        assert power.max() < 40.0  # of white noise 10, of a lattice 1e4
    # channels cancel in part: half of the luminance noise of equal ones, 1/6
    assert np.tensordot([0.2126, 0.7152, 0.0722], noise, 1).var() < 0.5 / 6.0


def test_black_and_white_stay_clean():
    ends = np.concatenate([np.zeros((8, 64, 3)), np.full((8, 64, 3), 1e9)])
    assert set(np.unique(to_display(ends, 0.0))) == {0, 255}


def test_sixteen_bits_are_the_same_picture_in_finer_steps():
    fine = to_display(PICTURE, -1.0, bits=16, dither=False)
    assert fine.dtype == np.uint16
    assert np.abs(fine / 257.0 - to_display(PICTURE, -1.0, dither=False)).max() <= 0.5 + 1e-3


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


def test_memory_beside_the_picture_is_small():
    # 4 096 x 1 024 pixels: 12.6 MB out.
    picture = np.ones((4096, 1024, 3), dtype=np.float32)
    to_display(picture[:2], 0.0)
    tracemalloc.start()
    try:
        to_display(picture, 0.0)
        peak = tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()
    assert peak < 14e6


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


@pytest.mark.parametrize(("field", "value"), [("primaries", "adobe"), ("bits", 12)])
def test_a_display_that_does_not_exist_is_refused(field, value):
    with pytest.raises(ParameterError, match=f"^{field} is"):
        to_display(PICTURE, 0.0, **{field: value})
