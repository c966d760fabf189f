"""Slicks and gusts on the sea: they texture the glint and leave its mean."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet, solve
from airlight.geometry.vectors import Vec3
from airlight.physics.optics.cox_munk import glint_factor, mean_square_slope, mirror_slope
from airlight.render import render
from airlight.scene.ground_detail import finest_cell
from airlight.scene.slicks import CONTRAST, FALL, OCTAVES, SKEWNESS, slick_glint, slick_roughness

CELL = finest_cell(6371e3, 2048)
WHOLE, PART = Vec3(3e6, 5e6, 7e6), Vec3(0.1, 0.2, 0.3)


def roughness(footprint: float, count: int = 20_000) -> np.ndarray:
    """Logarithms of the local mean-square slope and their variances at random places."""
    places = np.random.default_rng(1).uniform(-3e6, 3e6, (count, 3))
    return np.array([slick_roughness(Vec3(*p), footprint, CELL, WHOLE, PART) for p in places])


def test_roughness_has_mean_0_and_the_variance_that_it_states() -> None:
    rougher, variance = roughness(100.0).T
    shares = CONTRAST * FALL ** np.arange(OCTAVES)
    third = SKEWNESS * np.sum(shares**3)  # whose skewness takes g²/18 of the variance
    stated = np.sum(shares**2) - third**2 / (18.0 * np.sum(shares**2) ** 2)
    assert_allclose(variance, stated)
    assert_allclose(rougher.mean(), 0.0, atol=0.01)
    assert_allclose(rougher.var(), variance[0], rtol=0.05)
    assert not roughness(1e6, 10).any()  # below the size of a pixel


def test_the_glint_keeps_its_mean_over_places() -> None:
    # Noise that is not quite normal errs as the facet's slope grows.
    rougher, variance = roughness(100.0).T
    for steep, within in ((0.0, 0.01), (1.0, 0.01), (3.0, 0.02), (6.0, 0.04)):
        found = [slick_glint(steep, one, variance[0]) for one in rougher]
        assert_allclose(np.mean(found), 1.0, atol=within)
        assert np.std(found) > 0.02


def test_the_glint_of_a_place_is_that_of_its_wind() -> None:
    # But for masking and Fresnel's share, equal at facets of one slope
    calm, windy = 5.0, 6.0
    rougher = np.log(mean_square_slope(windy) / mean_square_slope(calm))
    mu_s, mu_r, nu = 0.9, 0.95, -0.8
    steep = mirror_slope(mu_s, mu_r, nu) / mean_square_slope(calm)
    ratio = glint_factor(mu_s, mu_r, nu, windy) / glint_factor(mu_s, mu_r, nu, calm)
    assert_allclose(slick_glint(steep, rougher, 0.0), ratio, rtol=1e-6)


@pytest.mark.slow
def test_a_picture_of_the_sea_has_slicks_and_the_light_of_an_even_sea() -> None:
    sea = {"ground.law": "water", "ground.wind": "6 m/s", "ground.albedo": 0.02}
    solution = solve(load_planet("earth-atmosphere-plus", sea), (680.0, 550.0, 440.0), "preview")
    camera = Camera(width=96, height=96, field_of_view=60.0, look_zenith=140.0)
    pictures = [
        render(solution, Scene(altitude=400e3, sun_zenith=40.0, camera=camera, ground=ground)).rgb[
            ..., 1
        ]
        for ground in ("plain", "detailed")
    ]
    even, slick = (np.asarray(one, float) for one in pictures)
    assert_allclose(slick.mean(), even.mean(), rtol=0.02)
    assert np.abs(slick / even - 1.0).max() > 0.1
