"""Reflection by the ground, as all solvers use it."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import load_planet
from airlight.kernel import compiled_loop, vectorized
from airlight.kernel.lanes import LANES, load, store
from airlight.physics.optics.droplet_layer import droplet_layer
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
    mean_albedo,
    mean_direct_reflectance,
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
    return mean_direct_reflectance(ground, 0, mu_s, mu_r, nu), diffuse_reflectance(ground, 0, mu_r)


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
def test_clouds_are_a_fraction_of_the_ground(law):
    # The definition of the mean: 1 - c of the law, c of the layer above it; lanes and double
    # precision alike, and exactly the law where there are no clouds.
    nm = np.linspace(400.0, 700.0, LANES)
    layer = droplet_layer(12.0, nm)
    plain = Reflection(ALBEDO.copy(), law_number(law), layer=layer)
    lines = np.array(DIRECTIONS).T.copy()
    found = {}
    for cover in (0.0, 0.25, 1.0):
        ground = plain._replace(cover=cover)
        out = np.empty((2, len(DIRECTIONS), LANES))
        direct_reflectances(ground, *lines, out[0])
        diffuse_reflectances(ground, lines[1], out[1])
        found[cover] = out
        lanes = np.empty(2 * LANES, np.float32)
        single = ground._replace(
            albedo=ALBEDO.astype(np.float32),
            layer=layer._replace(layer_phase=layer.layer_phase.astype(np.float32)),
        )
        for k, direction in enumerate(DIRECTIONS):
            both(single, *direction, lanes)
            assert_allclose(out[:, k].ravel(), lanes, rtol=1e-4, atol=1e-6)
    assert_allclose(found[0.25], 0.75 * found[0.0] + 0.25 * found[1.0], rtol=1e-12, atol=1e-12)


def test_the_mean_albedo_is_that_under_a_uniform_sky():
    # The definition, 2 ∫ R' μ dμ of Lambert ground below a third of clouds; linear between nodes.
    ground = Reflection(
        ALBEDO.copy(), cover=1.0 / 3.0, layer=droplet_layer(12.0, 600.0 + 0 * ALBEDO)
    )
    out = np.empty((NODES.size, LANES))
    diffuse_reflectances(ground, NODES.copy(), out)
    assert_allclose(2.0 * (WEIGHTS * NODES) @ out, mean_albedo(ground), rtol=1e-3)
