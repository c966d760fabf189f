"""Rays with fewer points in dim panels have the light of the rays with all of them."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.testing import assert_allclose, assert_array_less

from airlight import load_planet
from airlight.planets.medium import Medium
from airlight.solver.moments.adaptive_quadrature import POINTS, adaptive_quadrature
from airlight.solver.moments.rays import Rays
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.setup import Setup
from airlight.solver.refracted_geometry import RefractedGeometry


def test_few_points_in_dim_panels_change_no_ray_by_a_thousandth() -> None:
    # Second method: all points. The source rises towards the top of the air and turns with the
    # star's place on the way, as the light of a low sun does.
    medium = Medium.from_planet(load_planet("titan"), [680.0, 550.0, 440.0])
    setup = Setup(geometry=RefractedGeometry.of(medium), settings=settings_for("preview"))
    air = setup.optics.air(slice(0, 3))
    extinction = air.extinction.astype(float)
    count = extinction.shape[0]

    def light(rays: Rays) -> np.ndarray:
        depth = rays.column[:, :count] @ extinction
        height = (rays.radius - medium.bottom_radius) / medium.thickness
        source = (0.2 + height) * (1.0 + 0.5 * np.sin(rays.turn[:, 1] + rays.mu_along))
        part = np.exp(-depth) * (rays.amount[:, :count] @ extinction) * source[:, None]
        return np.array(
            [part[first:last].sum(axis=0) for row in rays.start for first, last in pairwise(row)]
        )

    few = adaptive_quadrature(setup.rays, air, setup.ray_nodes)
    assert few.radius.size < 0.6 * setup.rays.radius.size
    most, total = light(setup.rays), light(few)
    # of eight rays in 2944, along the dim gap under the detached haze, by 0.67 %
    assert_allclose(total, most, rtol=1e-2, atol=1e-6)
    assert_array_less(np.median(abs(total / np.maximum(most, 1e-9) - 1.0)), 1e-3)
    # The points stay inside the shell, in order, and with air that is not negative.
    assert few.start[-1, -1] == few.radius.size == few.column.shape[0]
    assert few.amount.min() >= 0.0
    assert few.radius.min() >= medium.bottom_radius * (1.0 - 1e-12)
    assert few.radius.max() <= medium.top_radius * (1.0 + 1e-12)


def test_points_fall_with_the_part_of_the_light() -> None:
    least, points = zip(*POINTS, strict=True)
    assert list(least) == sorted(least, reverse=True)
    assert list(points) == sorted(points, reverse=True)
    assert least[-1] == 0.0
