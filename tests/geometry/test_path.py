"""Points along a ray: they add up to its length, see the right radii and integrate the air."""

from __future__ import annotations

from itertools import pairwise
from math import exp, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import quad

from airlight.geometry.path import (
    MAX_EDGES,
    place_edges,
    place_nodes,
    ray_length,
    shadow_edges,
)
from airlight.geometry.quadrature import gauss_legendre
from airlight.geometry.shell import horizon_cosine, radius_along
from airlight.kernel import vectorized

BOTTOM, TOP = 6360e3, 6460e3

#: Start altitude [m], cosine of the zenith angle, share of the ray's length.
RAYS = [
    (0.0, 1.0, 1.0), (0.0, 0.5, 1.0), (0.0, 0.0, 1.0), (0.0, 1e-4, 1.0), (30e3, 0.0, 1.0),
    (30e3, -0.05, 1.0), (30e3, -0.0967, 1.0), (30e3, -0.0968, 1.0), (30e3, -1.0, 1.0),
    (100e3, -0.1745, 1.0), (100e3, -0.17, 0.3), (100e3, -0.17, 0.5), (100e3, -0.17, 0.7),
    (100e3, -1.0, 1.0), (1e3, -0.01, 0.4), (50e3, 0.3, 0.01),
]  # fmt: skip


def nodes_of(
    altitude: float, mu: float, share: float, *, count: int, panels: int,
    cuts: tuple[float, float] = (0.0, 0.0),
) -> tuple[float, float, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:  # fmt: skip
    """Start radius, length, edges, and the nodes' distances, radii and weights."""
    r = BOTTOM + altitude
    length = share * ray_length(r, mu, BOTTOM, TOP)
    edges = np.empty(MAX_EDGES)
    number = place_edges(r, mu, length, panels, *cuts, edges)
    rule = gauss_legendre(count)
    distance, radius, weight = np.empty((3, (number - 1) * count))
    written = place_nodes(r, mu, edges, number, rule.nodes, rule.weights, distance, radius, weight)
    assert written == distance.size
    return r, length, edges[:number], distance, radius, weight


@pytest.mark.parametrize(("altitude", "mu", "share"), RAYS)
def test_weights_add_up_to_the_length_and_nodes_stand_where_they_say(
    altitude: float, mu: float, share: float
) -> None:
    # ∫ ds over the ray is its length; the radius at a distance follows from the law of cosines.
    # Next to the tangent point a rounding of 1e-9 m in radius is one of 0.1 m in distance.
    r, length, edges, distance, radius, weight = nodes_of(altitude, mu, share, count=24, panels=3)
    assert_allclose(weight.sum(), length, rtol=0, atol=0.5)
    assert (weight >= 0.0).all()
    assert (np.diff(distance) > 0.0).all()
    assert edges[0] == 0.0
    assert_allclose(edges[-1], length, rtol=0)
    assert (np.diff(edges) >= 0.0).all()
    assert_allclose(radius, vectorized(radius_along)(r, mu, distance), rtol=0, atol=1e-4)


@pytest.mark.parametrize(("altitude", "mu", "share"), RAYS)
@pytest.mark.parametrize("scale_height", [8000.0, 1200.0])
def test_sixteen_points_a_leg_integrate_exponential_air(
    altitude: float, mu: float, share: float, scale_height: float
) -> None:
    # Second method: adaptive quadrature in distance. The module promises 1e-5 with 16 points.
    r, length, _, distance, radius, weight = nodes_of(altitude, mu, share, count=16, panels=1)
    del distance

    def density(s: float) -> float:
        return exp(-(sqrt(r * r + s * s + 2.0 * r * s * mu) - BOTTOM) / scale_height)

    nearest = min(max(-r * mu, 0.0), length)
    near = (nearest - 2e5, nearest - 3e4, nearest, nearest + 3e4, nearest + 2e5)
    cuts = sorted({0.0, length, *(p for p in near if 0.0 < p < length)})
    truth = sum(
        quad(density, a, b, epsabs=1e-9, epsrel=1e-10, limit=200)[0] for a, b in pairwise(cuts)
    )
    assert_allclose(weight @ np.exp(-(radius - BOTTOM) / scale_height), truth, rtol=1e-5)


def test_cuts_become_edges_and_change_no_integral() -> None:
    # A sum over parts is the sum over the whole.
    _, length, _, _, radius, weight = nodes_of(100e3, -0.17, 1.0, count=24, panels=2)
    cuts = (0.31 * length, 0.77 * length)
    _, _, edges, distance, cut_radius, cut_weight = nodes_of(
        100e3, -0.17, 1.0, count=24, panels=2, cuts=cuts
    )
    assert np.isin(cuts, edges).all()
    assert (np.diff(distance) > 0.0).all()
    assert_allclose(
        cut_weight @ np.exp(-(cut_radius - BOTTOM) / 8e3),
        weight @ np.exp(-(radius - BOTTOM) / 8e3), rtol=1e-7,
    )  # fmt: skip


def test_a_stretch_of_no_length_has_no_points() -> None:
    _, _, edges, distance, _, _ = nodes_of(10e3, 0.3, 0.0, count=8, panels=2)
    assert edges.size == 1
    assert distance.size == 0


def test_rays_just_off_the_horizontal_are_integrated_as_well_as_others() -> None:
    # A ray in exponential air, as a sum over its two halves: the level ray through its lowest
    # point, less the stretch before the start (second method: 200 points from the tangent point).
    for mu in np.logspace(-6, -0.5, 40):
        start, length, _, _, radius, weight = nodes_of(0.0, mu, 1.0, count=16, panels=1)
        lowest = start * sqrt((1.0 - mu) * (1.0 + mu))
        y_first, y_last = sqrt(max(start - lowest, 0.0)), sqrt(TOP - lowest)
        rule = gauss_legendre(200)
        y = y_first + (y_last - y_first) * rule.nodes
        ds = 2.0 * (lowest + y * y) / np.sqrt(2.0 * lowest + y * y) * (y_last - y_first)
        truth = (rule.weights * ds) @ np.exp(-(lowest + y * y - BOTTOM) / 8e3)
        assert_allclose(weight @ np.exp(-(radius - BOTTOM) / 8e3), truth, rtol=1e-5)
        assert_allclose(weight.sum(), length, rtol=1e-5)


def test_shadow_edges_are_where_the_shadow_is_entered_and_left() -> None:
    # Brute force by the shadow's definition: behind the planet, and closer to its axis than R.
    rng = np.random.default_rng(4)
    cut = 0
    for _ in range(3000):
        r = BOTTOM + 100e3 * rng.random()
        mu = rng.uniform(-0.3, 1.0)
        mu_s = np.cos(np.radians(rng.uniform(60.0, 125.0)))
        phi = rng.uniform(0.0, np.pi)
        sine, sun_sine = sqrt(1 - mu * mu), sqrt(1 - mu_s * mu_s)
        nu = mu * mu_s + sine * sun_sine * np.cos(phi)
        length = ray_length(r, mu, BOTTOM, TOP)
        s = np.linspace(0.0, length, 4001)[1:-1]
        view = np.array([sine * np.cos(phi), sine * np.sin(phi), mu])
        sun = np.array([sun_sine, 0.0, mu_s])
        at = np.array([0.0, 0.0, r])[:, None] + view[:, None] * s
        along = sun @ at
        axis = np.sqrt(np.maximum((at * at).sum(0) - along * along, 0.0))
        dark = (along < 0.0) & (axis < BOTTOM)
        first, second = shadow_edges(r, mu, mu_s, nu, BOTTOM)
        inside = (s > first) & (s < second)
        # Samples within a step of an edge, or within a metre of the shadow's side, may differ.
        sure = (
            (np.abs(s - first) > 1.0) & (np.abs(s - second) > 1.0) & (np.abs(axis - BOTTOM) > 0.01)
        )
        assert (inside == dark)[sure].all(), (r, mu, mu_s, nu)
        cut += bool(dark.any() and not dark.all())
    assert cut > 150  # the claim was put to the test


def test_rays_that_point_at_the_sun_or_away_from_it_are_not_cut() -> None:
    # Along the shadow's axis a ray is inside or outside all the way; nothing is divided by 0.
    for nu in (1.0, -1.0):
        assert shadow_edges(BOTTOM, 0.3, 0.3 * nu, nu, BOTTOM) == (0.0, 0.0)


def test_ray_length_is_continuous_at_the_ground_and_jumps_at_the_horizon() -> None:
    # Below the horizon a ray ends at the tangent point, above it goes on as far again and more.
    r = BOTTOM + 10e3
    horizon = horizon_cosine(r, BOTTOM)
    tangent = sqrt((r - BOTTOM) * (r + BOTTOM))
    # The chord next to the tangent is √(2 R² dmu ...): 1e-12 in mu are some 100 m of distance.
    assert_allclose(ray_length(r, horizon - 1e-12, BOTTOM, TOP), tangent, rtol=5e-3)
    beyond = sqrt((TOP - BOTTOM) * (TOP + BOTTOM))
    assert_allclose(ray_length(r, horizon + 1e-12, BOTTOM, TOP), tangent + beyond, rtol=1e-9)
