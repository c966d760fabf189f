"""The gamut step: hue and lightness held, soft edge, wide primaries."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.image.gamut import (
    KNEE,
    PRIMARIES,
    RGB_TO_P3,
    amount_of_share,
    in_gamut,
    share_at,
    softened,
)
from airlight.image.natural import natural_shown
from airlight.image.oklab import cone_roots_of, lightness_of, rgb_to_oklab

RGB_OF = {"srgb": np.eye(3), "display-p3": np.linalg.inv(RGB_TO_P3)}
COLORS = np.random.default_rng(5).uniform(-0.2, 1.2, (2000, 3))


def lab_of(rgb: np.ndarray, primaries: str = "srgb") -> np.ndarray:
    return rgb_to_oklab(rgb @ RGB_OF[primaries].T)


def test_p3_s_matrix_is_the_published_one():
    # CSS Color 4, section 10.8 (sample code), linear sRGB to linear Display P3: six decimals
    # differ in the fourth for our seven-decimal matrix of sRGB.
    published = [
        [0.822462, 0.177538, 0.0],
        [0.033194, 0.966806, 0.0],
        [0.017083, 0.072397, 0.910520],
    ]
    assert_allclose(RGB_TO_P3, published, atol=2e-4)
    assert_allclose(RGB_TO_P3.sum(axis=1), 1.0, atol=1e-12)


@pytest.mark.parametrize("primaries", PRIMARIES)
def test_hue_and_lightness_are_held(primaries):
    lab = rgb_to_oklab(COLORS)
    lit = (lab[:, 0] > 0.2) & (lab[:, 0] < 0.97)
    seen = in_gamut(COLORS, primaries)
    assert seen.min() >= 0.0
    assert seen.max() <= 1.0
    shown = lab_of(seen, primaries)
    assert_allclose(shown[lit, 0], lab[lit, 0], atol=5e-3)
    chroma = np.hypot(shown[:, 1], shown[:, 2])
    held = lit & (chroma > 0.03)
    angles = [np.arctan2(one[held, 2], one[held, 1]) for one in (shown, lab)]
    assert np.abs(np.sin(angles[0] - angles[1])).max() < np.sin(np.radians(1.0))


def test_the_wide_gamut_keeps_more_chroma():
    red = np.array([[1.0, -0.15, -0.05]]) * 0.5
    chroma = [float(np.hypot(*lab_of(in_gamut(red, name), name)[0, 1:])) for name in PRIMARIES]
    assert chroma[1] > 1.1 * chroma[0]


def test_light_has_no_white():
    bright = COLORS[:500] * 40.0
    seen = in_gamut(bright, bounded=False)
    assert seen.min() >= 0.0
    assert seen.max() > 30.0
    inside = bright.min(axis=1) > 0.25 * bright.max(axis=1)
    assert inside.any()
    assert_array_equal(seen[inside], bright[inside])


def test_the_step_is_smooth_from_grey_to_far_beyond():
    # up to where a cone would respond negatively, which no light does
    amounts = np.linspace(0.0, 2.0, 600)[:, None]
    line = 0.3 + amounts * np.array([[0.3, -0.1, -0.2]])
    steps = np.diff(in_gamut(line), axis=0)
    # no jump, and no kink but the knee's own: steps change by little from one to the next
    assert np.abs(steps).max() < 1.1 * np.abs(steps[0]).max()
    assert np.abs(np.diff(steps, axis=0)).max() < 0.05 * np.abs(steps[0]).max()
    assert KNEE < 1.0


def test_the_wanted_share_is_reached_by_every_color():
    # also where it does not grow with the chroma all the way, as on the line to a deep blue
    for color in [(1.127, 0.106, 115.3), (0.895, 0.0007, 95.5), *COLORS[:300].tolist()]:
        long, medium, short = cone_roots_of(*color)
        lightness = lightness_of(long, medium, short)
        if lightness < 0.1:
            continue
        roots = (long - lightness, medium - lightness, short - lightness)
        share, _ = share_at(0, lightness, 0.0, *roots, 1.0)
        if share > KNEE:
            wanted = softened(share)
            amount = amount_of_share(0, lightness, 0.0, *roots, wanted, wanted / share, 1.0)
            assert 0.0 < amount < 1.0
            assert_allclose(share_at(0, lightness, 0.0, *roots, amount)[0], wanted, rtol=1e-9)


def test_natural_for_p3_is_natural_where_both_gamuts_reach():
    color = (0.1, 0.12, 0.15)
    wide, narrow = (natural_shown(which, 1.2, *color) for which in (1, 0))
    assert_allclose(wide, RGB_TO_P3 @ narrow, rtol=1e-9)


def test_unknown_primaries_are_refused():
    with pytest.raises(ParameterError, match=r"^primaries is .adobe."):
        in_gamut(COLORS, "adobe")
