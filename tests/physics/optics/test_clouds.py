"""Flat layer of clouds: where lines cross it, and that light is shared out without loss or gain."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.optics.clouds import (
    LayerPassage,
    layer_distance,
    layer_passage,
    layer_reflectance,
    mean_reflected,
    node_before,
    plane_albedo,
    under_sky,
    under_star,
)
from airlight.physics.optics.droplet_layer import droplet_layer

BOTTOM = 6.36e6
GREEN = np.array([550.0])
#: Reflectance factors of a sea: of the star, of the sky, and of light that goes on diffusely.
SEA = (4.0, 0.3, 0.07)


@pytest.mark.parametrize("altitude", [1.0, 4e3, 1e5])
def test_a_line_ends_on_the_sphere_of_the_layer(altitude: float) -> None:
    # The law of cosines; near the vertical and for level lines.
    for cosine in (0.0, 1e-3, 0.05, 0.5, 1.0):
        s = layer_distance(cosine, BOTTOM, altitude)
        # (R + h)² - R² by the line's own parts, without the squares' cancellation
        assert_allclose(s * (s + 2.0 * BOTTOM * cosine), altitude * (2.0 * BOTTOM + altitude),
                        rtol=1e-12)  # fmt: skip


def test_a_steep_line_is_that_of_a_flat_layer_and_none_runs_off() -> None:
    # h/μ where the sphere is flat; from below the horizon as from the horizon.
    assert_allclose(layer_distance(0.5, BOTTOM, 10.0), 20.0, rtol=1e-5)
    assert layer_distance(-0.3, BOTTOM, 4e3) == layer_distance(0.0, BOTTOM, 4e3)
    assert layer_distance(0.0, BOTTOM, 0.0) == 0.0


def passage(seen: float, shaded: float, depth: float = 10.0) -> LayerPassage:
    """Light that passes a layer at some cosines."""
    return layer_passage(0.5, 0.7, seen, shaded, droplet_layer(depth, GREEN))


def test_without_cover_nothing_changes() -> None:
    # The ground's own factors, exactly, whatever a cloud would reflect.
    clear = passage(0.0, 0.0)
    assert under_star(clear, 0.9, *SEA) == SEA[0]
    assert under_sky(clear, *SEA[1:]) == SEA[1]


def test_what_a_cover_does_not_reflect_it_lets_through() -> None:
    # Conservation on both ways; the direct part is Beer's law of the scaled depth.
    layer = droplet_layer(3.0, GREEN)
    for seen, shaded in itertools.product((0.0, 0.3, 1.0), repeat=2):
        found = layer_passage(0.5, 0.7, seen, shaded, layer)
        star = found.star_direct + found.star_diffuse
        assert_allclose(star, 1.0 - shaded * plane_albedo(0.5, layer), rtol=1e-12)
        view = found.view_direct + found.view_diffuse
        assert_allclose(view, 1.0 - found.seen_albedo, rtol=1e-12)
        beam = 1.0 - shaded + shaded * np.exp(-layer.layer_depth / 0.5)
        assert_allclose(found.star_direct, beam, rtol=1e-12)


def test_light_goes_back_and_forth_between_cloud_and_ground() -> None:
    # The sum over bounces, term by term: Lambert ground a, transmittances t, spherical albedo s.
    layer, ground = droplet_layer(10.0, GREEN), 0.6
    found = layer_passage(0.5, 0.7, 1.0, 1.0, layer)
    star, view = (1.0 - plane_albedo(x, layer) for x in (0.5, 0.7))
    bounces = sum(ground * (ground * layer.layer_albedo) ** k for k in range(80))
    direct = under_star(found, 0.4, ground, ground, ground)
    assert_allclose(direct, 0.4 + star * view * bounces, rtol=1e-12)
    sky = under_sky(found, ground, ground)
    through = 1.0 - layer.layer_albedo
    assert_allclose(sky, 1.0 - view + through * view * bounces, rtol=1e-12)


def test_light_below_full_cover_is_diffuse() -> None:
    # Below a thick cover the sea has no glint of the star: 40 of direct light change nothing.
    dense = passage(0.0, 1.0, 30.0)
    assert_allclose(under_star(dense, 0.0, 40.0, 0.3, 0.1), under_star(dense, 0.0, 0.0, 0.3, 0.1),
                    rtol=1e-9)  # fmt: skip


def test_nodes_are_met_and_ends_are_held() -> None:
    assert node_before(0.5, 5) == (2, 0.0)
    assert node_before(1.5, 5) == (3, 1.0)
    assert node_before(-1.0, 5) == (0, 0.0)
    layer = droplet_layer(10.0, GREEN)
    assert plane_albedo(1.0, layer) == layer.layer_plane[-1]


def test_clouds_without_azimuth_have_the_layer_s_albedos() -> None:
    # The definition of the solver's clouds: 2 ∫ A A'/s μ dμ is A, linear between the nodes.
    layer = droplet_layer(10.0, GREEN)
    nodes, weights = np.polynomial.legendre.leggauss(400)
    nodes = 0.5 * (nodes + 1.0)
    factors = [mean_reflected(layer_passage(0.3, x, 1.0, 1.0, layer), layer) for x in nodes]
    assert_allclose((weights * nodes) @ factors, plane_albedo(0.3, layer), rtol=1e-3)


def test_scattering_angle_and_azimuth_follow_from_the_cosines() -> None:
    # ν = -1 is light that goes back to the star; light that goes on is brighter.
    layer = droplet_layer(10.0, GREEN)
    assert layer_reflectance(0.6, 0.6, -1.0, layer).angle == 1.0
    assert (
        layer_reflectance(0.6, 0.6, 0.28, layer).multiple
        > layer_reflectance(0.6, 0.6, -1.0, layer).multiple
    )
