"""Flat layer of clouds: where lines cross it, and that light is shared out without loss or gain."""

from __future__ import annotations

import itertools

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.physics.optics.clouds import GroundFactors, layer_distance, under_clouds

BOTTOM = 6.36e6
#: Shares of a ground: white Lambert, black, and one with specular and mirrored light.
WHITE = GroundFactors(1.0, 0.0, 1.0, 0.0, 0.0)
SEA = GroundFactors(0.7, 4.0, 0.8, 0.02, 0.3)


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


@pytest.mark.parametrize("shares", [WHITE, SEA])
def test_without_cover_nothing_changes(shares: GroundFactors) -> None:
    assert under_clouds(0.0, 0.0, 0.6, shares) == shares


def test_full_cover_is_a_lambert_surface_whatever_is_below() -> None:
    # The definition of the cover, in star and sky alike.
    for shaded in (0.0, 0.4, 1.0):
        assert under_clouds(1.0, shaded, 0.6, SEA) == (0.0, 0.6, 0.0, 0.6, 0.0)


def test_starlight_is_reflected_let_through_or_passes_beside() -> None:
    # Conservation: what white ground below an unseen cover sends back, and what the cover keeps
    # above it, is all light; by uniform light from above the layer nothing exceeds 1.
    for shaded, albedo in itertools.product((0.0, 0.3, 1.0), (0.0, 0.6, 1.0)):
        star = under_clouds(0.0, shaded, albedo, WHITE)
        assert_allclose(star[0] + star[1] + shaded * albedo, 1.0, rtol=1e-15)
        for seen in (0.0, 0.5, 1.0):
            star_diffuse, star_specular, sky_diffuse, sky_specular, _ = under_clouds(
                seen, shaded, albedo, WHITE
            )
            assert max(star_diffuse + star_specular, sky_diffuse + sky_specular) <= 1.0 + 1e-15


def test_light_below_full_cover_is_diffuse() -> None:
    # The sea below full cover has no glint of the star: it mirrors what comes through, as it does
    # a uniform sky.
    albedo = 0.6
    star_diffuse, star_specular, *_ = under_clouds(0.0, 1.0, albedo, SEA)
    assert_allclose([star_diffuse, star_specular], [0.4 * 0.8, 0.4 * (0.02 + 0.3)])


def test_the_mean_over_places_is_near_the_solver_s_ground() -> None:
    # Covers of line of sight and starlight that know nothing of each other: c A + (1 - c) a, less
    # the light c (1 - c) A a that goes back and forth.
    mean, cloud, ground = 0.4, 0.6, 0.15
    covers = np.random.default_rng(5).uniform(0.0, 2.0 * mean, (20_000, 2))
    found = [under_clouds(*pair, cloud, WHITE)[:2] for pair in covers]
    seen = np.mean([diffuse * ground + specular for diffuse, specular in found])
    solver = mean * cloud + (1.0 - mean) * ground
    missing = mean * (1.0 - mean) * cloud * ground
    # standard error of the mean: 0.23 · 0.45 / √20000
    assert_allclose(seen, solver - missing, atol=3e-3)
    assert missing < 0.025
