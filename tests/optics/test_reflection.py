"""The ground as all solvers ask it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet
from airlight.kernel import compiled_loop, vectorized
from airlight.kernel.lanes import LANES, load, store
from airlight.optics.reflection import (
    LAWS,
    Reflection,
    leaving_cosine,
    sky_factor,
    star_factor,
    star_factors,
)
from airlight.planets.medium import Medium

ALBEDO = np.linspace(0.05, 0.9, LANES)
DIRECTIONS = [(1.0, 1.0, 1.0), (0.2, 0.9, 0.1), (0.9, 0.05, -0.4), (0.0, 0.0, 0.7)]


@compiled_loop
def both(ground, mu_s, leaving, nu, out):
    store(out, 0, star_factor(ground, 0, mu_s, leaving, nu))
    store(out, LANES, sky_factor(ground, 0, leaving))


@compiled_loop
def one(ground, mu_s, leaving, nu):
    return star_factor(ground, 0, mu_s, leaving, nu), sky_factor(ground, 0, leaving)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_lambert_is_as_bright_as_its_albedo_from_everywhere(direction):
    # Lambert's law: radiance albedo·E/π in all directions, in starlight as under a sky.
    out = np.empty(2 * LANES, np.float32)
    both(Reflection(LAWS["lambert"], ALBEDO.astype(np.float32)), *direction, out)
    assert_array_equal(out, np.tile(ALBEDO.astype(np.float32), 2))


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_one_wavelength_is_what_its_lane_is(direction):
    # Monte Carlo and the direct solver ask in double precision, by the same functions.
    for albedo in ALBEDO:
        assert one(Reflection(LAWS["lambert"], albedo), *direction) == (albedo, albedo)


def test_the_medium_s_ground_has_its_albedo_at_every_wavelength():
    medium = Medium.from_planet(load_planet("earth"), [450.0, 550.0, 650.0])
    mu_s, leaving, nu = np.array(DIRECTIONS).T.copy()
    out = np.empty((4, 3))
    star_factors(medium.ground, mu_s, leaving, nu, out)
    assert_array_equal(out, np.tile(medium.ground_albedo, (4, 1)))


def test_a_number_is_loaded_as_it_is():
    # In double precision, wherever the index points.
    @compiled_loop
    def loaded(value, at):
        return load(value, at)

    assert loaded(1.0 / 3.0, 8) == 1.0 / 3.0


def test_light_leaves_the_ground_at_the_angle_of_the_vector_that_it_is():
    # The point where the line meets the sphere, its vertical, and the line turned round.
    bottom, r = 6.36e6, 6.36e6 + np.array([0.0, 10.0, 8e3, 4e5])[:, None]
    horizon = -np.sqrt((r - bottom) * (r + bottom)) / r
    mu = -1.0 + (horizon + 1.0) * np.array([0.0, 0.3, 0.8, 0.97])
    along = -r * mu - np.sqrt((r * mu) ** 2 - (r - bottom) * (r + bottom))
    end = np.stack([along * np.sqrt(1.0 - mu * mu), r + along * mu])
    backwards = np.stack([-np.sqrt(1.0 - mu * mu), -mu])
    expected = (end * backwards).sum(axis=0) / bottom
    assert_allclose(vectorized(leaving_cosine)(r, mu, bottom), expected, atol=1e-7)
