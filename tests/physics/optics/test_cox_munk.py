"""The sea's facets: their statistics, and the light that they mirror."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.special import erfc
from scipy.stats import norm

from airlight.kernel import vectorized
from airlight.physics.optics.cox_munk import (
    SEA_WATER,
    facing_normal,
    facing_slope,
    glint_factor,
    hidden_slopes,
    mean_mirrored,
    mean_square_slope,
    mirrored_by,
    mirrored_cosine,
    mirrored_fraction,
    steepest_mirror,
)
from airlight.physics.optics.fresnel import fresnel_reflectances

WINDS = [0.5, 2.0, 5.0, 10.0, 25.0]
COSINES = [0.005, 0.05, 0.2, 0.5, 0.9]


def hidden(cosine, slope):
    """Smith's ratio of hidden to visible facets with its error function, from the definition."""
    v = cosine / (slope * np.sqrt(np.maximum(1.0 - cosine**2, 1e-300)))
    return 0.5 * (np.exp(-(v**2)) / (v * np.sqrt(np.pi)) - erfc(v))


@pytest.mark.parametrize("wind", WINDS)
def test_facets_cover_the_projected_area(wind):
    # Geometry: the facets that face a line have the area of the sea across it and of those hidden.
    slope = float(np.sqrt(mean_square_slope(wind)))
    cosine = np.array([1e-3, *COSINES])
    along = np.linspace(-4.0, 4.0, 4001) * slope
    weight = np.exp(-((along / slope) ** 2)) * 0.002 / np.sqrt(np.pi)
    facing = np.maximum(cosine[:, None] + along * np.sqrt(1.0 - cosine[:, None] ** 2), 0.0) @ weight
    # Walter's fraction is within 0.35 % of Smith's; the sum meets the kink to 1e-3.
    assert_allclose(cosine + vectorized(hidden_slopes)(cosine, slope), facing, rtol=6e-3)
    assert_allclose(cosine * (1.0 + hidden(cosine, slope)), facing, rtol=2e-3)


def by_facets(cosine, wind, count=400_000):
    """Light mirrored by random facets, and the cosine where the sky has its mean."""
    slope = float(np.sqrt(mean_square_slope(wind)))
    random = np.random.default_rng(12)
    tilt = random.normal(scale=slope / np.sqrt(2.0), size=(2, count))
    normal = np.stack([-tilt[0], -tilt[1], np.ones(count)]) / np.sqrt(1.0 + (tilt**2).sum(axis=0))
    eye = np.array([np.sqrt(1.0 - cosine**2), 0.0, cosine])
    facing = np.maximum(eye @ normal, 0.0)
    sky = 2.0 * facing * normal - eye[:, None]
    up = np.maximum(sky[2], 1e-12)
    lit = 1.0 / (1.0 + hidden(cosine, slope) + hidden(np.minimum(up, 1.0 - 1e-12), slope))
    angles = np.linspace(0.0, 1.0, 2001)
    smooth = [sum(fresnel_reflectances(SEA_WATER, each)) / 2.0 for each in angles]
    mirrored = np.interp(facing, angles, smooth)
    share = np.where(sky[2] > 0.0, mirrored * lit * facing / (normal[2] * cosine), 0.0)
    return share.mean(), share.sum() / np.sum(share / (up + 0.1)) - 0.1


@pytest.mark.parametrize("wind", WINDS)
@pytest.mark.parametrize("cosine", COSINES)
def test_a_beam_is_mirrored_as_by_random_facets(cosine, wind):
    # A second method. Fits of 2.1 % and 0.012; Walter's fraction adds 0.4 %, the noise 0.5 %.
    share, up = by_facets(cosine, wind)
    assert_allclose(mirrored_fraction(cosine, wind), share, rtol=0.03)
    assert_allclose(mirrored_cosine(cosine, wind), up + (1.0 - up) * cosine**8, atol=0.016)


@pytest.mark.parametrize("wind", [2.0, 10.0])
@pytest.mark.parametrize("cosine", [0.1, 0.5, 1.0])
def test_the_glint_s_integral_is_the_mirrored_fraction(cosine, wind):
    # π ∫ BRDF mu dω over all stars, and the fit of 2.1 %.
    nodes, weights = np.polynomial.legendre.leggauss(200)
    mu, turn = 0.5 * (nodes[:, None] + 1.0), (np.arange(360) + 0.5) * np.pi / 360.0
    nu = -(mu * cosine + np.sqrt((1.0 - mu**2) * (1.0 - cosine**2)) * np.cos(turn))
    factor = vectorized(glint_factor)(mu, cosine, nu, wind)
    total = np.sum(weights * mu[:, 0] * factor.mean(axis=1))
    assert_allclose(mirrored_fraction(cosine, wind), total, rtol=0.022)


@pytest.mark.parametrize("wind", WINDS)
def test_the_mean_of_the_sky_is_that_of_its_beams(wind):
    # 2 ∫ fraction mu dmu; both are fits.
    nodes, weights = np.polynomial.legendre.leggauss(64)
    mu = 0.5 * (nodes + 1.0)
    beams = np.sum(weights * mu * vectorized(mirrored_fraction)(mu, wind))
    assert_allclose(mean_mirrored(wind), beams, rtol=0.02)


@pytest.mark.parametrize("wind", WINDS)
def test_from_overhead_the_sea_mirrors_as_smooth_water(wind):
    # Fresnel's reflectance is stationary there; the fit's 2.1 %.
    smooth = fresnel_reflectances(SEA_WATER, 1.0)[0]
    assert_allclose(mirrored_fraction(1.0, wind), smooth, rtol=0.03)


def test_the_glint_is_brightest_where_a_level_mirror_shows_the_star():
    # Of a star 50° high, nearly: the tilt of the brightest facets is 0.5° (Fresnel prefers more).
    mu_s = np.sin(np.radians(50.0))
    height = np.radians(np.arange(20.0, 80.0, 0.25))
    nu = -(mu_s * np.sin(height) - np.cos(np.radians(50.0)) * np.cos(height))
    factor = vectorized(glint_factor)(mu_s, np.sin(height), nu, 1.0) * np.sin(height)
    assert abs(np.degrees(height[factor.argmax()]) - 50.0) < 2.0


def test_half_the_glitter_s_slopes_are_within_the_median():
    # Cox & Munk: slopes are Gaussian, so half of them are below s √ln 2, and there the density is
    # half of the greatest. Star and observer overhead and turned apart by twice the tilt.
    tilt = np.arctan(np.sqrt(mean_square_slope(5.0) * np.log(2.0)))
    mu = np.cos(2.0 * tilt)
    ratio = glint_factor(mu, 1.0, -mu, 5.0) / glint_factor(1.0, 1.0, -1.0, 5.0)
    shades = np.cos(tilt) ** -4 / mu * fresnel_reflectances(SEA_WATER, np.cos(tilt))[0]
    parallel = fresnel_reflectances(SEA_WATER, np.cos(tilt))
    shades *= 0.5 * sum(parallel) / parallel[0] / fresnel_reflectances(SEA_WATER, 1.0)[0]
    assert_allclose(ratio, 0.5 * shades, rtol=1e-9)


def test_light_takes_the_same_way_back_from_the_facets():
    # Helmholtz; directions at random, also on opposite sides.
    random = np.random.default_rng(3)
    mu, turn = random.uniform(0.003, 1.0, (2, 200)), random.uniform(0.0, np.pi, 200)
    nu = -(mu[0] * mu[1] + np.sqrt((1.0 - mu[0] ** 2) * (1.0 - mu[1] ** 2)) * np.cos(turn))
    there = vectorized(glint_factor)(mu[0], mu[1], nu, 5.0)
    assert_allclose(vectorized(glint_factor)(mu[1], mu[0], nu, 5.0), there, rtol=1e-12)


@pytest.mark.parametrize("limit", [0.0, 0.5, 2.0, 8.0])
def test_normal_variables_become_visible_slopes(limit):
    # Their density is (A + x) φ(x), whose mean over its integral is Φ/(A Φ + φ) and mean square
    # (A Φ + 2 φ)/(A Φ + φ).
    normal = np.linspace(-5.0, 5.0, 1001)
    weight = norm.pdf(normal) * 0.01
    slope = vectorized(facing_slope)(normal, limit)
    area = limit * norm.cdf(limit) + norm.pdf(limit)
    assert np.all(np.diff(slope) > 0.0)
    assert slope.min() > -limit
    assert_allclose(slope @ weight, norm.cdf(limit) / area, atol=0.04)
    square = (limit * norm.cdf(limit) + 2.0 * norm.pdf(limit)) / area
    assert_allclose(slope**2 @ weight, square, rtol=0.05)
    inner = slope[(normal > -2.0) & (normal < 4.0)]
    back = vectorized(facing_slope)(vectorized(facing_normal)(inner, limit), limit)
    assert_allclose(back, inner, atol=1e-9)


@pytest.mark.parametrize("cosine", [0.05, 0.4, 0.9])
def test_a_facet_mirrors_by_the_law_of_reflection(cosine):
    # Snell: the facet's normal halves the angle; Fresnel: both shares are its reflectance.
    sine = np.sqrt(1.0 - cosine**2)
    for along in np.linspace(steepest_mirror(cosine) + 0.01, 0.5, 7):
        for across in (-0.3, 0.0, 0.2):
            normal = np.array([-along, -across, 1.0]) / np.sqrt(1.0 + along**2 + across**2)
            eye = np.array([-sine, 0.0, cosine])
            share, rest, *ray = mirrored_by(along, across, cosine, 5.0, 0.0)
            facing = eye @ normal
            smooth = np.mean(fresnel_reflectances(SEA_WATER, facing))
            assert_allclose(share + rest, smooth, rtol=1e-12)
            if share > 0.0:
                assert_allclose(ray, 2.0 * facing * normal - eye, atol=1e-12)


def test_the_steepest_mirror_shows_the_horizon():
    for cosine in (0.1, 0.5, 0.9):
        edge = steepest_mirror(cosine)
        assert mirrored_by(edge - 1e-3, 0.0, cosine, 5.0, 0.0)[0] == 0.0
        assert 0.0 < mirrored_by(edge + 1e-3, 0.0, cosine, 5.0, 0.0)[4] < 4e-3
