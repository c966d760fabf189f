"""The eye in the dark: day vision above, rods below, and no step between."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.image.eye import PHOTOPIC, SCOTOPIC, mesopic, rod_share
from airlight.image.oklab import rgb_to_oklab
from airlight.image.xyz import chromaticity, luminance, rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY

COLORS = np.random.default_rng(6).uniform(0.02, 1.0, (300, 3))


def at(luminance_: float, colors: np.ndarray = COLORS) -> np.ndarray:
    """Colours of that luminance. [cd m⁻²]"""
    return colors * (luminance_ / LUMINOUS_EFFICACY / luminance(colors))[:, None]


def test_above_ten_candelas_nothing_changes():
    for bright in (10.0, 100.0, 1e4):
        assert_array_equal(mesopic(at(bright)), at(bright))


def test_in_the_dark_there_is_one_hue():
    seen = mesopic(at(1e-3))
    assert_allclose(seen / seen[:, :1], np.ones((300, 1)) * seen[0] / seen[0, 0], rtol=1e-9)
    # x = y = 0.25
    assert_allclose(chromaticity(rgb_to_xyz(seen)), 0.25, atol=1e-6)


def test_a_grey_stays_as_bright_and_red_darkens():
    for bright in (1e-3, 0.1, 1.0):
        grey = at(bright, np.ones((1, 3)))
        assert_allclose(luminance(mesopic(grey)), luminance(grey), rtol=2e-3)
        red, blue = at(bright, np.array([[1.0, 0.05, 0.02], [0.1, 0.2, 1.0]]))
        assert luminance(mesopic(red)) < 0.95 * luminance(red)
        assert luminance(mesopic(blue)) > 1.05 * luminance(blue)


def test_rods_see_alone_below_and_not_at_all_above():
    share = [rod_share(one) for one in (1e-4, SCOTOPIC, 0.2, PHOTOPIC, 1e3)]
    assert share[0] == share[1] == 1.0
    assert share[3] == share[4] == 0.0
    # halfway on the logarithmic scale
    assert_allclose(rod_share(np.sqrt(SCOTOPIC * PHOTOPIC)), 0.5, rtol=1e-12)


def test_brightness_rises_and_nothing_jumps():
    steps = np.geomspace(1e-3, 20.0, 2000)
    for color in COLORS[:40]:
        path = mesopic(color * (steps / LUMINOUS_EFFICACY / luminance(color))[:, None])
        bright = luminance(path)
        assert np.all(np.diff(bright) > 0.0)
        # in perceived terms, after an exposure that holds the luminance
        lab = rgb_to_oklab(path / luminance(path)[:, None])
        assert np.abs(np.diff(lab, axis=0)).max() < 5e-3
