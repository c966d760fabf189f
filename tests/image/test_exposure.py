"""Exposure: given, of a camera, and measured on the picture."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.image.camera_exposure import camera_exposure
from airlight.image.exposure import automatic_exposure, eased, exposure_factor
from airlight.image.xyz import luminance
from airlight.physics.constants import LUMINOUS_EFFICACY

#: A sunlit sky and ground of some 3000 cd/m². [W m⁻² sr⁻¹]
DAY = np.random.default_rng(3).lognormal(1.5, 0.5, size=(37, 53, 3))


def shown(luminance: float) -> float:
    """Light as which a uniform grey of a luminance [cd m⁻²] is shown. [1]"""
    grey = np.full((4, 4, 3), luminance / LUMINOUS_EFFICACY)
    return float(grey[0, 0, 0] * exposure_factor(automatic_exposure(grey)))


def test_one_ev_doubles_the_light():
    assert exposure_factor(0.0) == 1.0
    assert_allclose(exposure_factor(1.5) / exposure_factor(0.5), 2.0, rtol=1e-15)


def test_by_day_the_picture_does_not_depend_on_the_light():
    for factor in (1.0, 4.0, 100.0):
        change = automatic_exposure(factor * DAY) - automatic_exposure(DAY)
        assert_allclose(change, -math.log2(factor), atol=5e-3)


@pytest.mark.parametrize(
    ("sky", "luminance", "low", "high"),
    [
        # shown light of typical skies; 0.0313 of light is a value of 50 of 255, 0.009 one of 25
        ("noon", 5000.0, 0.41, 0.425),
        ("sunset", 500.0, 0.39, 0.425),
        ("end of civil twilight", 3.0, 0.15, 0.30),
        ("full moon", 0.01, 0.02, 0.06),
        ("airglow alone", 2e-4, 0.005, 0.015),
        ("less than a night", 1e-6, 0.0, 1e-4),
    ],
)
def test_skies_are_shown_as_an_adapted_eye_sees_them(sky, luminance, low, high):
    assert low < shown(luminance) < high, sky


def test_darker_skies_are_never_shown_brighter():
    seen = [shown(one) for one in np.geomspace(1e-7, 1e5, 200)]
    assert np.all(np.diff(seen) >= -1e-12)
    # nothing jumps: a fifteenth of a decade changes it by no more than the light itself
    assert np.all(np.diff(np.log2(seen)) < 1.01 * np.log2(10.0) * 12.0 / 199.0)


def test_highlights_are_protected():
    # a tenth of the picture is eight times as bright: it decides
    plain = np.full((40, 40, 3), 5.0)
    lit = plain.copy()
    lit[:4] *= 8.0
    assert_allclose(40.0 * exposure_factor(automatic_exposure(lit)), 1.8, rtol=1e-2)
    # forty times as bright it lowers the key by 2.5 EV: its white is not worth more
    lit[:4] = 200.0
    key = lit[:, :, 0].ravel()
    key = np.exp2(np.log2(np.sort(key)[400:1280]).mean())
    assert_allclose(automatic_exposure(lit), math.log2(0.42 / key) - 2.5, atol=0.01)
    # a hundredth of the picture does not decide
    few = plain.copy()
    few[0, :16] *= 40.0
    assert_allclose(automatic_exposure(few), automatic_exposure(plain), atol=0.1)


def test_a_blue_aureole_keeps_its_colour_and_a_warm_one_is_bright():
    # Around the low sun of Mars, in a tan sky, a fiftieth of the picture may exceed 1.1, so that
    # blue is left in the rest; the same aureole in the colour of its sky, or warmer, is a highlight
    # as any other, which 0.6 EV more show.
    across = np.linspace(0.0, 1.0, 64)
    glow = 4.0 + 40.0 * np.exp(-0.5 * (across / 0.1) ** 2)
    tan = np.broadcast_to(glow[None, :, None] * np.array([1.3, 1.0, 0.6]), (32, 64, 3)).copy()
    blue, red = tan.copy(), tan.copy()
    blue[:, :16] *= np.array([0.6, 1.0, 2.6])
    red[:, :16] *= np.array([1.1, 1.0, 0.5])
    cool, plain, warm = (automatic_exposure(one) for one in (blue, tan, red))
    bright = np.sort(luminance(blue).ravel())[-41]  # the 2 % are 41 of 2048 pixels
    assert_allclose(bright * exposure_factor(cool), 1.1, rtol=0.02)
    assert plain - cool > 0.6
    assert warm - cool > 0.6
    # a blue sky over brown ground is not an aureole: the key decides as before
    field = np.full((32, 64, 3), 2.0) * np.array([0.8, 1.0, 1.8])
    field[16:] = np.array([1.2, 0.8, 0.4])
    grey = np.repeat(luminance(field)[..., None], 3, axis=2)
    assert_allclose(automatic_exposure(field), automatic_exposure(grey), atol=0.02)


def test_white_is_shown_as_white_and_soil_is_not():
    # incident metering: a surface of the reflectance ρ that faces the star is shown as ρ where that
    # is brighter than the key, so that snow and the clouds of Venus are not grey
    def shown_as(reflectance: float) -> float:
        picture = np.full((8, 8, 3), reflectance * 60.0)
        return float(60.0 * reflectance * exposure_factor(automatic_exposure(picture, white=60.0)))

    assert_allclose([shown_as(0.9), shown_as(0.7)], [0.9, 0.7], rtol=1e-9)
    # soil, sea and sky are between what "sunny 16" shows, their reflectance, and the key
    for reflectance in (0.3, 0.18, 0.1, 0.05):
        assert reflectance <= shown_as(reflectance) < 0.42
    assert shown_as(0.08) < 0.25
    # where white is 250 times as bright as the picture, light is less: it is shown as dusk is
    assert_allclose(shown_as(0.004), shown(0.004 * 60.0 * LUMINOUS_EFFICACY), rtol=1e-2)


def test_the_exposure_rises_as_the_light_falls_without_a_leap():
    # a law: half the light may not be shown by less exposure, nor by more than one and a half stops
    light = 60.0 * 2.0 ** np.linspace(0.0, -14.0, 281)
    found = [automatic_exposure(np.full((4, 4, 3), one), white=60.0) for one in light]
    steps = np.diff(found) / 0.05
    assert np.all(steps > -1e-9)
    assert np.all(steps < 1.5)


def test_a_saturated_red_counts_more_than_its_luminance():
    # the sky at a setting sun has 2.4 times its luminance in red; shown as a grey sky it would be
    # 1.0 there, of which glare leaves no room
    grey = np.full((8, 8, 3), 3.0)
    red = 3.0 * np.ones((8, 8, 1)) * np.array([2.4, 0.66, 0.25])
    assert abs(luminance(red[0, 0]) - 3.0) < 0.05
    assert_allclose(automatic_exposure(grey), math.log2(0.42 / 3.0), atol=0.01)
    shown_red = 7.2 * exposure_factor(automatic_exposure(red))
    assert 0.55 < shown_red < 0.7


@pytest.mark.parametrize(("times", "darker"), [(1, 0.5**0.5), (9, 0.5)])
def test_black_space_makes_a_dark_picture_at_most_a_stop_darker(times, darker):
    # neither its depth of black nor how much of it there is decides beyond that
    space = np.full((37, times * 53, 3), 1e-9)
    space[::2] = 0.0
    both = automatic_exposure(np.concatenate([DAY, space], axis=1))
    assert_allclose(both, automatic_exposure(DAY) + np.log2(darker), atol=1e-9)


def test_weights_count_pixels():
    doubled = np.concatenate([DAY, DAY[:10]])
    weights = np.ones(DAY.shape[:2])
    weights[:10] = 2.0
    assert_allclose(automatic_exposure(DAY, weights), automatic_exposure(doubled), atol=1e-9)
    weights[:10] = 0.0
    assert_allclose(automatic_exposure(DAY, weights), automatic_exposure(DAY[10:]), atol=1e-9)


def test_the_exposure_of_odd_pictures_is_a_number():
    night = automatic_exposure(np.full((3, 3, 3), 1e-12))
    assert_allclose(automatic_exposure(np.zeros((3, 3, 3))), night, atol=1e-9)
    odd = np.ones((3, 3, 3), dtype=np.float32)
    odd[0, 0] = np.nan
    odd[1, 1] = np.inf
    odd[2, 2] = -1.0
    # less than nothing is black: one of the seven pixels that have a light
    even = automatic_exposure(np.ones((3, 3, 3))) + np.log2(6.0 / 7.0) / 2.0
    assert_allclose(automatic_exposure(odd), even, atol=1e-6)


def test_a_large_picture_is_sampled_evenly():
    ramp = np.linspace(1.0, 3.0, 2400, dtype=np.float32)
    large = np.broadcast_to(ramp[:, None, None], (2400, 2400, 3))
    small = np.broadcast_to(ramp[::8, None, None], (300, 2, 3))
    assert_allclose(automatic_exposure(large), automatic_exposure(small), atol=1e-2)


def test_a_camera_s_exposure_saturates_where_iso_12232_says():
    # H = q L t / N² = 78 / S lx s, worked by hand: L = 78 · 64 · 250 / (100 · 0.65)
    saturating = 78.0 * 64.0 * 250.0 / (100.0 * 0.65)
    factor = exposure_factor(camera_exposure(iso=100.0, aperture=8.0, shutter=1.0 / 250.0))
    assert_allclose(factor * saturating / LUMINOUS_EFFICACY, 1.0, rtol=1e-12)
    with pytest.raises(ParameterError, match=r"^shutter is 0"):
        camera_exposure(100.0, 8.0, 0.0)


def test_the_exposure_eases_towards_the_wanted_one():
    assert eased(2.0, -1.0, 0.0, 0.4) == 2.0
    assert_allclose(eased(2.0, -1.0, 0.4, 0.4), -1.0 + 3.0 / math.e, rtol=1e-12)
    # two steps are one
    halfway = eased(2.0, -1.0, 0.1, 0.4)
    assert_allclose(eased(halfway, -1.0, 0.3, 0.4), eased(2.0, -1.0, 0.4, 0.4), rtol=1e-12)
    assert eased(2.0, -1.0, 0.1, 0.0) == -1.0


def test_towns_by_night_are_not_drowned_in_white() -> None:
    # From orbit photographers expose the lamps of towns: with them on a fiftieth of a picture of
    # dark ground, whose night alone would be exposed 2 EV longer, towns of 0.05 cd/m² are near
    # white, as with ISO 12 800, f/1.4 and 1/4 s, which saturate at 0.07 cd/m² (ISO 12232)
    ground = np.full((100, 100, 3), 3e-4 / 683.0)
    towns = ground.copy()
    towns[40:50, 30:50] = 0.05 / 683.0
    alone, lit = (automatic_exposure(one, white=40.0) for one in (ground, towns))
    assert 1.5 < alone - lit < 2.5  # 2 EV, and what the highlights take
    assert abs(lit - camera_exposure(iso=12_800, aperture=1.4, shutter=0.25)) < 1.5
    # the same by full moon and at dusk is no long exposure: only what is white limits it
    assert automatic_exposure(300.0 * ground) - automatic_exposure(300.0 * towns) < 1.0
