"""Reflection by the ground, as all solvers use it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet
from airlight.kernel import compiled_loop, vectorized
from airlight.kernel.lanes import LANES, load, store
from airlight.physics.optics.reflection import (
    LAWS,
    Reflection,
    cos_reflected,
    diffuse_reflectance,
    diffuse_reflectances,
    direct_reflectance,
    direct_reflectances,
    largest_albedo,
    law_number,
)
from airlight.planets.ground import Ground
from airlight.planets.medium import Medium

ALBEDO = np.linspace(0.05, 0.9, LANES)
DIRECTIONS = [(1.0, 1.0, 1.0), (0.2, 0.9, 0.1), (0.9, 0.05, -0.4), (0.0, 0.0, 0.7)]


@compiled_loop
def both(ground, mu_s, mu_r, nu, out):
    store(out, 0, direct_reflectance(ground, 0, mu_s, mu_r, nu))
    store(out, LANES, diffuse_reflectance(ground, 0, mu_r))


@compiled_loop
def one(ground, mu_s, mu_r, nu):
    return direct_reflectance(ground, 0, mu_s, mu_r, nu), diffuse_reflectance(ground, 0, mu_r)


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_lambert_is_as_bright_as_its_albedo_from_everywhere(direction):
    # Lambert's law: radiance albedo·E/π in all directions, in starlight as under a sky.
    out = np.empty(2 * LANES, np.float32)
    both(Reflection(ALBEDO.astype(np.float32)), *direction, out)
    assert_array_equal(out, np.tile(ALBEDO.astype(np.float32), 2))


@pytest.mark.parametrize("direction", DIRECTIONS)
def test_one_wavelength_is_what_its_lane_is(direction):
    # Monte Carlo and the direct solver ask in double precision, by the same functions.
    for albedo in ALBEDO:
        assert one(Reflection(albedo), *direction) == (albedo, albedo)


def test_the_medium_s_ground_has_its_albedo_at_every_wavelength():
    medium = Medium.from_planet(load_planet("earth"), [450.0, 550.0, 650.0])
    mu_s, mu_r, nu = np.array(DIRECTIONS).T.copy()
    out = np.empty((4, 3))
    direct_reflectances(medium.ground, mu_s, mu_r, nu, out)
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
    assert_allclose(vectorized(cos_reflected)(r, mu, bottom), expected, atol=1e-7)


#: Laws whose light all has the albedo's colour, and none of whose depends on azimuth; ``water``
#: and ``hapke`` have tests of their own.
MATTE = [name for name in LAWS if name not in ("water", "hapke")]
#: Gauss-Legendre over [0, 1].
NODES, WEIGHTS = (
    0.5 * (x + shift)
    for x, shift in zip(np.polynomial.legendre.leggauss(64), (1.0, 0.0), strict=True)
)


def shares(law, mu_s, mu_r):
    """Both factors of a ground of albedo 1 without azimuth."""
    ground = Reflection(1.0, law_number(law))
    stars = np.empty((mu_s.size, mu_r.size))
    for i, mu in enumerate(mu_s):
        for j, cosine in enumerate(mu_r):
            stars[i, j] = one(ground, mu, cosine, 0.0)[0]
    return stars, np.array([one(ground, 1.0, cosine, 0.0)[1] for cosine in mu_r])


@pytest.mark.parametrize("law", MATTE)
def test_the_sky_s_factor_is_the_mean_of_the_star_s(law):
    # A uniform sky is stars everywhere, each weighted by its cosine: 2 ∫ factor mu dmu; the laws
    # here do not depend on azimuth. Gauss's rule meets 1/(mu + mu') to 1e-4 at these cosines.
    mu_r = np.array([0.1, 0.4, 1.0])
    stars, sky = shares(law, NODES, mu_r)
    assert_allclose(2.0 * (WEIGHTS * NODES) @ stars, sky, rtol=1e-4)


@pytest.mark.parametrize("law", MATTE)
def test_under_a_uniform_sky_the_ground_reflects_its_albedo(law):
    # The albedo's definition; of the whole hemisphere, 2 ∫ diffuse_reflectance mu dmu.
    _, sky = shares(law, NODES[:1], NODES)
    assert_allclose(2.0 * np.sum(WEIGHTS * NODES * sky), 1.0, rtol=1e-6)


@pytest.mark.parametrize("law", LAWS)
def test_light_takes_the_same_way_back(law):
    # Helmholtz: the factor is symmetric.
    stars, _ = shares(law, NODES, NODES)
    assert_allclose(stars, stars.T, rtol=1e-6)


def test_no_ground_reflects_more_than_arrives():
    # The largest albedo of each law sends back at most all of a level beam.
    for name in LAWS:
        white = Reflection(1.0, law_number(name))
        ground = white._replace(albedo=largest_albedo(white))
        assert max(one(ground, 1.0, x, 0.0)[1] for x in np.linspace(0.0, 1.0, 33)) < 1.0 + 1e-6
    rock = Ground(albedo=0.9, law="lommel-seeliger")
    assert_allclose(rock.albedos([550.0]), largest_albedo(rock.reflection))


def test_arrays_of_lines_are_the_single_ones():
    ground = Reflection(ALBEDO.copy(), law_number("lommel-seeliger"))
    mu_s, mu_r, nu = np.array(DIRECTIONS).T.copy()
    stars, skies = np.empty((4, LANES)), np.empty((4, LANES))
    direct_reflectances(ground, mu_s, mu_r, nu, stars)
    diffuse_reflectances(ground, mu_r, skies)
    out = np.empty(2 * LANES, np.float32)
    for k, direction in enumerate(DIRECTIONS):
        both(ground._replace(albedo=ALBEDO.astype(np.float32)), *direction, out)
        assert_allclose(np.concatenate([stars[k], skies[k]]), out, rtol=1e-5)


@pytest.mark.parametrize("law", LAWS)
def test_clouds_are_a_share_of_lambert_ground(law):
    # The definition of the mean: (1 - c) of the law, c of the albedo of clouds; lanes and single
    # wavelengths alike, and exactly the one or the other at the ends.
    plain = Reflection(0.3, law_number(law))
    for direction in DIRECTIONS:
        clear = np.array(one(plain, *direction))
        for cover in (0.0, 0.25, 1.0):
            ground = plain._replace(cover=cover, cloud_albedo=0.8)
            expected = (1.0 - cover) * clear + cover * 0.8
            # factors of lanes are rounded to single precision
            assert_allclose(one(ground, *direction), expected, rtol=0 if cover == 0.0 else 1e-7)
            out = np.empty((2, 1, 1))
            lines = (np.array([x]) for x in direction)
            arrays = ground._replace(albedo=np.array([0.3]))
            mu_s, mu_r, nu = lines
            direct_reflectances(arrays, mu_s, mu_r, nu, out[0])
            diffuse_reflectances(arrays, mu_r, out[1])
            assert_allclose(out.ravel(), expected, rtol=1e-6)
