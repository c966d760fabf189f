"""Glare: energy, law, second method, resolution."""

from __future__ import annotations

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import ParameterError
from airlight.image.display import to_display
from airlight.image.glare import COARSEST, FINEST, TOTAL, Glare, glare_share

#: Angle of a pixel of a picture 1280 pixels and 60° wide. [rad]
ANGLE = 2.0 * math.tan(math.radians(30.0)) / 1280


def point(height: int, width: int, row: int, column: int) -> np.ndarray:
    """Picture of one bright pixel."""
    rgb = np.zeros((height, width, 3), np.float32)
    rgb[row, column] = 1.0
    return rgb


def spread(rgb: np.ndarray, angle: float, amount: float = 1.0) -> np.ndarray:
    """Red light behind the lens."""
    return Glare(rgb, angle, amount).rows(0, rgb.shape[0])[..., 0].astype(float)


def angles_from(shape: tuple[int, int], row: float, column: float, angle: float) -> np.ndarray:
    """Angle of each pixel from a point of the picture. [rad]"""
    y, x = np.indices(shape)
    return np.asarray(np.hypot(y - row, x - column) * angle)


@pytest.mark.parametrize(("height", "width"), [(720, 1280), (360, 641), (97, 63), (5, 9)])
def test_no_light_is_lost(height: int, width: int) -> None:
    # The law; float32 over some ten levels, and odd sizes, which mirror half a texel too much.
    rgb = point(height, width, height // 2, width // 3)
    assert_allclose(spread(rgb, ANGLE).sum(), 1.0, rtol=1e-3)


def test_a_uniform_picture_has_no_glare_to_be_seen() -> None:
    # weights of each step add up to 1, at the edges too
    rgb = np.full((123, 77, 3), 3.0, np.float32)
    assert_allclose(spread(rgb, ANGLE, 4.0), 3.0, rtol=1e-6)


def test_without_an_amount_or_an_angle_nothing_changes() -> None:
    rgb = np.random.default_rng(1).random((20, 30, 3), np.float32)
    for lens in (Glare(rgb, ANGLE, 0.0), Glare(rgb, 0.0)):
        assert lens.none
        assert_array_equal(lens.rows(0, 20), rgb)
    assert_array_equal(to_display(rgb), to_display(rgb, glare=0.0, pixel_angle=ANGLE))


def test_glare_falls_with_the_square_of_the_angle() -> None:
    # The law that the shares stand for, with its ends: the mean over a ring against the mixture of
    # Gaussians, one for each octave, that it tends to for many levels: within 8 %, since levels
    # are an octave apart and a picture of 7000 pixels still ends. A single Gaussian would miss by
    # factors.
    angle = 0.25 * ANGLE
    size = 3001
    rgb = point(size, size, 1444, 1511)
    got = spread(rgb, angle)
    from_point = angles_from((size, size), 1444, 1511, angle)
    scale = np.geomspace(1e-6, 10.0, 4000)
    end = 1.0 / (1.0 / COARSEST**2 + 1.0 / (0.25 * size * angle) ** 2)
    weight = TOTAL / math.log(COARSEST / FINEST) * np.log(scale[1] / scale[0])
    weight = weight * scale**2 / (scale**2 + FINEST**2) * end / (scale**2 + end)
    for degrees in (0.1, 0.2, 0.5, 1.0, 2.0):
        theta = math.radians(degrees)
        ring = np.abs(from_point / theta - 1.0) < 0.03
        sigma = scale / 1.06
        law = (weight * np.exp(-0.5 * (theta / sigma) ** 2) / (2.0 * math.pi * sigma**2)).sum()
        assert_allclose(got[ring].mean() / angle**2, law, rtol=0.08, err_msg=f"{degrees}°")
    # and that is the law of the square itself, between the ends
    middle = math.radians(0.5)
    square = TOTAL / (2.0 * math.pi * math.log(COARSEST / FINEST) * middle**2)
    assert_allclose(got[np.abs(from_point / middle - 1.0) < 0.03].mean() / angle**2, square,
                    rtol=0.2)  # fmt: skip


def test_the_pyramid_is_a_convolution_with_its_own_spread() -> None:
    # A second method: the fast Fourier transform, with the spread of one point. The pyramid's
    # spread depends a little on where a point lies between its texels: 10 % of the glow.
    rng = np.random.default_rng(3)
    size = 256
    rgb = np.zeros((size, size, 3), np.float32)
    places = rng.integers(64, 192, (40, 2))
    rgb[places[:, 0], places[:, 1]] = rng.uniform(0.5, 2.0, 40)[:, None]
    kernel = spread(point(size, size, 128, 128), ANGLE)
    kernel[128, 128] = 0.0
    transform = np.fft.rfft2(np.fft.ifftshift(kernel), (size, size))
    wanted = np.fft.irfft2(np.fft.rfft2(rgb[..., 0].astype(float)) * transform, (size, size))
    got = spread(rgb, ANGLE)
    dark = rgb[..., 0] == 0.0
    middle = np.zeros_like(dark)
    middle[48:208, 48:208] = True
    error = np.abs(got - wanted)[dark & middle] / wanted[dark & middle]
    assert np.quantile(error, 0.95) < 0.1


@pytest.mark.parametrize("place", [(0.5, 0.5), (0.31, 0.62)])
def test_glare_is_centred_on_its_source(place: tuple[float, float]) -> None:
    # Every step keeps the first moments of the light, so the centre is the source's wherever it
    # lies between the texels; a hundredth of the glow's radius, for the mirrored edges.
    height, width = 601, 801
    row, column = int(place[0] * height), int(place[1] * width)
    got = spread(point(height, width, row, column), ANGLE)
    got[row, column] = 0.0
    near = angles_from((height, width), row, column, ANGLE) < math.radians(4.0)
    y, x = np.indices((height, width))
    for axis, centre in ((y, row), (x, column)):
        mean = (got * axis)[near].sum() / got[near].sum()
        assert abs(mean - centre) * ANGLE < math.radians(0.04)


def test_glare_hardly_depends_on_the_resolution() -> None:
    # The same sun, 1.5° wide, at 320, 640 and 960 pixels for 60°: the glow per irradiance, within
    # a few per cent from 2° on.
    found = []
    for width in (320, 640, 960):
        height, angle = width * 9 // 16, 2.0 * math.tan(math.radians(30.0)) / width
        there = (0.43 * height, 0.57 * width)
        theta = angles_from((height, width), there[0] - 0.5, there[1] - 0.5, angle)
        sun = (theta < math.radians(0.75)).astype(np.float32)
        got = spread(np.repeat(sun[..., None], 3, axis=2), angle) / (sun.sum() * angle**2)
        rings = [np.abs(np.degrees(theta) - d) < 0.1 * d for d in (2.0, 3.0, 5.0, 8.0)]
        found.append([got[ring].mean() for ring in rings])
    assert_allclose(found[0], found[2], rtol=0.06)
    assert_allclose(found[1], found[2], rtol=0.06)


def test_beyond_the_circle_of_a_dome_there_is_no_glare() -> None:
    # a law: where the picture shows nothing nothing is added; within it glare is as without circle
    picture = np.zeros((30, 40, 3), np.float32)
    picture[15, 5] = 1e6
    across = 2 * np.arange(40) + 1 - 40
    down = 2 * np.arange(30) + 1 - 30
    beyond = across**2 + down[:, None] ** 2 > 30**2
    free = Glare(picture, 0.02).rows(0, 30)
    assert free[beyond].max() > 0.0
    parts = ((0, 7), (7, 30))
    dome = np.concatenate([Glare(picture, 0.02, 1.0, (40, 30)).rows(*one) for one in parts])
    assert_array_equal(dome[beyond], picture[beyond])
    assert_array_equal(dome[~beyond], free[~beyond])


def test_the_circle_of_a_dome_s_window_is_that_of_the_whole_dome() -> None:
    # a law: a window of a dome of 400 pixels ends at the dome's circle, not at one of its own
    window = np.full((20, 30, 3), 1.0, np.float32)
    window[10, 15] = 1e6
    across = 2 * (np.arange(30) + 40) + 1 - 400
    down = 2 * (np.arange(20) + 60) + 1 - 400
    beyond = across**2 + down[:, None] ** 2 > 400**2
    assert 0 < beyond.sum() < beyond.size
    free = Glare(window, 0.02).rows(0, 20)
    dome = Glare(window, 0.02, 1.0, (400, 400), (40, 60)).rows(0, 20)
    assert_array_equal(dome[beyond], window[beyond])
    assert_array_equal(dome[~beyond], free[~beyond])


def test_shares_add_up_to_the_total() -> None:
    # the integral over all octaves: ln(θ₁/θ₀) / ln 2 of them
    for angle in (1e-4, 1.37e-4, 1.9e-4):
        total = sum(glare_share(k, angle, 1e9) for k in range(-12, 20))
        assert_allclose(total, TOTAL, rtol=1e-3)


def test_light_that_is_no_number_spreads_none() -> None:
    # one wrong pixel must not blacken the picture; it stays what it was, black or white
    rgb = np.full((64, 64, 3), 0.2, np.float32)
    wanted = to_display(rgb, 0.0, pixel_angle=ANGLE)
    for wrong, level in ((np.nan, 0), (np.inf, 255)):
        rgb[30, 30] = wrong
        picture = to_display(rgb, 0.0, pixel_angle=ANGLE)
        assert_array_equal(picture[30, 30], level)
        picture[30, 30] = wanted[30, 30]
        assert np.abs(picture.astype(int) - wanted).max() <= 1


@pytest.mark.parametrize("amount", [-0.1, 10.5, math.nan, "much"])
def test_other_amounts_are_refused(amount: object) -> None:
    with pytest.raises(ParameterError, match=r"glare is .*; allowed: 0 to 10"):
        Glare(np.zeros((2, 2, 3), np.float32), ANGLE, amount)  # type: ignore[arg-type]
