"""Natural tone map: hue, paling, gamut, gradients; OKLab's published numbers."""

from __future__ import annotations

from itertools import product

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.image.gamut import KNEE, gamut_share, to_white
from airlight.image.natural import (
    SHOULDER,
    STYLES,
    natural,
    natural_curve,
    natural_inverse,
)
from airlight.image.oklab import RGB_TO_CONES, ROOTS_TO_LAB, oklab_to_rgb, rgb_to_oklab
from airlight.image.xyz import rgb_to_xyz, xyz_to_rgb
from airlight.kernel.cube_root import cube_root
from airlight.physics.spectra.color_matching import cie_1931

#: Ottosson's table: XYZ and OKLab, to three decimals.
PUBLISHED = [
    ((0.950, 1.000, 1.089), (1.000, 0.000, 0.000)),
    ((1.000, 0.000, 0.000), (0.450, 1.236, -0.019)),
    ((0.000, 1.000, 0.000), (0.922, -0.671, 0.263)),
    ((0.000, 0.000, 1.000), (0.153, -1.415, -0.449)),
]
#: Red of a star on the horizon, of blood, of sodium, of sky, violet beyond sRGB. [1]
COLORS = np.array(
    [
        [1.0, 0.06, -0.03],
        [0.8, 0.02, 0.01],
        [1.0, 0.45, -0.05],
        [0.15, 0.3, 0.8],
        [0.2, -0.1, 1.0],
        [-0.2, 0.6, 0.7],
    ]
)


def hue(rgb: np.ndarray) -> np.ndarray:
    lab = rgb_to_oklab(rgb)
    return np.degrees(np.arctan2(lab[..., 2], lab[..., 1]))


def chroma(rgb: np.ndarray) -> np.ndarray:
    lab = rgb_to_oklab(rgb)
    return np.hypot(lab[..., 1], lab[..., 2])


def gap(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    return np.abs((first - second + 180.0) % 360.0 - 180.0)


@pytest.mark.parametrize(("xyz", "lab"), PUBLISHED)
def test_oklab_s_matrices_give_the_published_table(xyz, lab):
    # of colours of no light too, whose cones respond negatively: the table takes signed roots
    cones = RGB_TO_CONES @ xyz_to_rgb(xyz)
    assert_allclose(ROOTS_TO_LAB @ np.cbrt(cones), lab, atol=2e-3)


def test_oklab_of_the_primaries():
    # Ottosson's demonstration page and CSS Color 4, section 9.3: red, green, blue.
    assert_allclose(
        rgb_to_oklab(np.eye(3)),
        [[0.62796, 0.22486, 0.12585], [0.86644, -0.23389, 0.17950], [0.45201, -0.03246, -0.31153]],
        atol=2e-5,
    )


def test_oklab_back_and_forth():
    colors = np.random.default_rng(1).uniform(0.0, 2.0, (200, 3))
    assert_allclose(oklab_to_rgb(rgb_to_oklab(colors)), colors, atol=1e-12)


def test_the_cube_root_is_one():
    values = np.geomspace(1e-60, 1e60, 2001)
    assert_allclose([cube_root(x) ** 3 for x in values], values, rtol=1e-13)
    assert cube_root(0.0) == cube_root(-8.0) == cube_root(float("nan")) == 0.0


@pytest.mark.parametrize("contrast", STYLES.values())
@pytest.mark.parametrize("stops", [-6.0, -3.0, -1.0, 0.0, 1.0, 2.0])
def test_hue_is_held_while_there_is_chroma(stops, contrast):
    shown = natural(COLORS * 2.0**stops, contrast)
    held = chroma(shown) > 0.01
    assert held.any()
    # 8° is the bar; only rounding and the last clip of the gamut's soft edge remain
    assert gap(hue(shown), hue(COLORS))[held].max() < 0.5


@pytest.mark.parametrize("contrast", STYLES.values())
def test_a_red_sun_pales_to_white_instead_of_turning_yellow(contrast):
    stops = np.linspace(-4.0, 12.0, 200)
    shown = natural(np.array([1.0, 0.06, -0.03]) * 2.0 ** stops[:, None], contrast)
    assert_allclose(shown[-1], 1.0, atol=0.01)
    strong = chroma(shown) > 0.03
    assert gap(hue(shown[strong]), hue(COLORS[0])).max() < 0.5
    lab = rgb_to_oklab(shown)
    assert np.diff(lab[:, 0]).min() > -1e-3
    after = chroma(shown)[np.argmax(chroma(shown)) :]
    assert np.diff(after).max() < 1e-9


def test_every_color_of_the_spectrum_is_shown_within_the_gamut_at_its_hue():
    wavelengths = np.arange(430.0, 680.0, 5.0)
    light = xyz_to_rgb(cie_1931().at(wavelengths))
    for stops, contrast in product((-4.0, -1.0, 1.0), STYLES.values()):
        exposed = light * 2.0**stops
        shown = natural(exposed, contrast)
        assert shown.min() >= 0.0
        assert shown.max() <= 1.0
        # responses of cones that are negative in sRGB's matrix count as 0: not those hues
        seen = (chroma(shown) > 0.02) & (chroma(oklab_to_rgb(rgb_to_oklab(exposed))) > 0.0)
        assert gap(hue(shown), hue(exposed))[seen].max() < 8.0


def test_dim_colors_within_the_gamut_are_unchanged():
    colors = np.random.default_rng(3).uniform(0.05, 0.2, (500, 3))
    lab = rgb_to_oklab(colors)
    grey = lab[:, 0] ** 3
    share = [gamut_share(y, to_white(y, True), *c) for y, c in zip(grey, colors, strict=True)]
    kept = np.array(share) < KNEE
    assert kept.mean() > 0.5
    assert np.all(lab[kept, 0] ** 3 < SHOULDER)
    assert_array_equal(natural(colors, contrast=1.0)[kept], colors[kept])


def test_gradients_stay_gradients():
    # From grey to far beyond the gamut: every step shows, and no step jumps.
    lab = np.stack(
        [np.full(400, 0.6), np.linspace(0.0, 0.5, 400), np.linspace(0.0, 0.25, 400)], axis=-1
    )
    shown = natural(oklab_to_rgb(lab), contrast=1.0)
    steps = np.diff(chroma(shown))
    assert steps.min() > -1e-9
    assert steps.max() < 1.2 * steps[0]
    assert_allclose(rgb_to_oklab(shown)[:, 0], 0.6, atol=2e-3)


@pytest.mark.parametrize("contrast", STYLES.values())
def test_the_inverse_reaches_beyond_the_gamut(contrast):
    exposed = COLORS[:4] * 0.3
    found = natural_inverse(natural(exposed, contrast), contrast)
    assert_allclose(found, exposed, rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("contrast", STYLES.values())
def test_contrast_is_the_largest_slope_and_leaves_the_sun_its_size(contrast):
    # by differences of logarithms, where the curve is defined by it; the glow of a sun ends where
    # the shown light is 0.95, which contrast moves by less than a tenth of a stop
    light = np.geomspace(1e-5, 10.0, 2000)
    shown = np.array([natural_curve(float(x), contrast) for x in light])
    slopes = np.diff(np.log(shown)) / np.diff(np.log(light))
    assert_allclose(slopes.max(), contrast, rtol=1e-3)
    assert slopes.min() > 0.0
    assert np.abs(np.diff(slopes)).max() < 0.02 * contrast  # no edge in a gradient
    bright = [np.log2(np.interp(0.95, shown, light)), np.log2(0.25 + 0.75 * np.log(15.0))]
    assert abs(bright[0] - bright[1]) < 0.1
    assert_allclose(natural_curve(SHOULDER, contrast), SHOULDER)


def test_luminance_of_a_grey_follows_the_curve():
    greys = np.geomspace(1e-3, 20.0, 50)[:, None] * np.ones(3)
    shown = natural(greys, contrast=1.0)
    assert_allclose(shown, shown[:, :1] * np.ones(3), rtol=1e-9)
    y = rgb_to_xyz(shown)[:, 1]
    dim = greys[:, 0] <= SHOULDER
    assert_allclose(y[dim], greys[dim, 0], rtol=1e-6)
    assert np.all(y[~dim] < greys[~dim, 0])
    assert np.all(np.diff(y) > 0.0)
