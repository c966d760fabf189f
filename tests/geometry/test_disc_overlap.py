"""The visible part of a limb-darkened disc, against published tables, closed forms and sampling."""

from __future__ import annotations

from math import acos, pi, sqrt

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.geometry.disc_overlap import visible_light
from airlight.physics.spectra.limb_darkening import solar_darkening

#: 1 - 0.6 (1 - μ), of mean 0.8: the law of the published maps.
LINEAR = np.array([[0.4, 0.6]]) / 0.8
SUN = 0.2658


@pytest.mark.parametrize(
    ("occluder", "values"),
    [
        # Read out of CosmoScout's eclipse maps (CC0, Schneegans et al. 2022,
        # doi:10.1111/cgf.14676) of a body without air: an Earth at the Moon's distance, and a disc
        # of 1.012 suns; the separation as a share of the sum of the radii.
        (0.94966, {0.6: 0.0357, 0.65: 0.1377, 0.7: 0.2748, 0.8: 0.5862, 0.9: 0.8611}),
        (1.012 * SUN, {0.1: 0.0885, 0.3: 0.3381, 0.5: 0.5973, 0.7: 0.8215, 0.9: 0.9708}),
    ],
)
def test_published_maps_of_airless_bodies(occluder: float, values: dict[float, float]) -> None:
    for share, published in values.items():
        got = visible_light(SUN, [share * (SUN + occluder)], [occluder], darkening=LINEAR)
        assert_allclose(got, published, atol=1e-3)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.9])
def test_equal_uniform_discs_leave_all_but_the_lens(share: float) -> None:
    # Closed form of the plane: the area common to two unit circles.
    d = 2.0 * share
    lens = 2.0 * acos(0.5 * d) - 0.5 * d * sqrt(4.0 - d * d)
    got = visible_light(0.01, [0.01 * d], [0.01])
    assert_allclose(got, 1.0 - lens / pi, rtol=1e-6)


def test_an_annular_eclipse_leaves_the_ring_of_the_law() -> None:
    # Closed form: concentric, ∫ 2 μ L dμ from 0 to the cosine at the occluder's edge.
    law, ratio = solar_darkening([550.0]), 0.9
    edge = sqrt(1.0 - ratio**2)
    ring = sum(2.0 * a / (k + 2.0) * edge ** (k + 2) for k, a in enumerate(law[0]))
    assert_allclose(visible_light(0.01, [0.0], [0.009], darkening=law), ring, rtol=1e-6)


def test_occluders_that_overlap_are_not_counted_twice() -> None:
    # Second method: points of the disc, evenly by area, on a plane.
    rng = np.random.default_rng(1)
    rho, turn = np.sqrt(rng.random(400_000)), 2.0 * pi * rng.random(400_000)
    x, y = rho * np.cos(turn), rho * np.sin(turn)
    places = [(0.6, 20.0, 0.7), (0.9, 60.0, 0.5), (1.1, 350.0, 0.4)]
    hidden = np.zeros(x.size, bool)
    for d, angle, radius in places:
        a = np.radians(angle)
        hidden |= np.hypot(x - d * np.cos(a), y - d * np.sin(a)) < radius
    d, angle, radius = np.array(places).T
    got = visible_light(0.01, 0.01 * d, 0.01 * radius, position=angle)
    assert_allclose(got, 1.0 - hidden.mean(), atol=3e-3)


def test_a_large_occluder_is_a_circle_on_the_sphere() -> None:
    # From low orbit a planet covers more than a hemisphere's half: its edge through the centre
    # leaves half of a small star.
    assert_allclose(visible_light(0.01, [70.0], [70.0]), 0.5, atol=2e-4)


def test_limits() -> None:
    assert visible_light(0.25, [1.0], [0.5])[0] == pytest.approx(1.0, abs=1e-12)
    assert visible_light(0.25, [0.1], [0.5])[0] == 0.0
    assert visible_light(0.0, [0.6], [0.5])[0] == 1.0
    assert visible_light(0.0, [0.4], [0.5])[0] == 0.0


@pytest.mark.parametrize(
    ("star", "separation", "radius", "field"),
    [(100.0, 1.0, 1.0, "star_radius"), (1.0, -1.0, 1.0, "separation"), (1.0, 1.0, 200.0, "radius")],
)
def test_angles_out_of_range(star: float, separation: float, radius: float, field: str) -> None:
    with pytest.raises(ParameterError, match=rf"{field} is .* deg"):
        visible_light(star, [separation], [radius])
    with pytest.raises(ParameterError, match=r"occluders is 17; allowed: at most 16"):
        visible_light(1.0, np.ones(17), np.ones(17))
