"""Lines and spheroids against roots of the distance, numerical normals and textbook latitudes."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq, minimize, minimize_scalar

from airlight.geometry.spheroid import (
    beside_shadow,
    height_above_limb,
    lowest_point,
    spheroid_point,
    stretched,
)
from airlight.geometry.vectors import Vec3

FLATTENING, EYE = 0.098, 5.0
#: Direction of the north pole in the observer's frame. [1]
POLE = Vec3(0.48, 0.64, 0.6)
NORTH = np.array(POLE)


def excess(point):
    """(x² + y²) + z²/(1 - f)² - 1 in the frame of the spheroid of radius 1."""
    north = point @ NORTH
    return point @ point - north**2 + (north / (1.0 - FLATTENING)) ** 2 - 1.0


def ray(x, y):
    way = np.array([x, y, -1.0])
    return way / np.linalg.norm(way)


def gradient(point):
    step = 1e-6
    slope = [excess(point + step * one) - excess(point - step * one) for one in np.eye(3)]
    return np.array(slope) / np.linalg.norm(slope)


@pytest.mark.parametrize(("x", "y"), [(0.0, 0.0), (0.1, 0.05), (-0.12, 0.09), (0.02, -0.17)])
def test_a_line_meets_the_spheroid_where_its_equation_is_zero(x, y):
    way = ray(x, y)
    near = minimize_scalar(lambda t: excess(np.array([0.0, 0.0, EYE]) + t * way), (4.0, 6.0)).x
    point = np.array([0.0, 0.0, EYE])
    distance = brentq(lambda t: excess(point + t * way), 1.0, near, xtol=1e-14)
    found = lowest_point(Vec3(*way), EYE, POLE, FLATTENING, 1.0)
    assert_allclose(found.distance, distance, rtol=1e-10)
    assert_allclose(np.array(found.normal), gradient(point + distance * way), atol=1e-9)
    assert found.altitude == 0.0


@pytest.mark.parametrize("angle", np.linspace(0.0, 2.0 * np.pi, 7)[:-1])
def test_a_line_past_the_limb_is_horizontal_at_its_lowest_point(angle):
    # the altitude is that over the foot of the normal, found by minimising
    way, point = ray(0.207 * np.cos(angle), 0.207 * np.sin(angle)), np.array([0.0, 0.0, EYE])
    found = lowest_point(Vec3(*way), EYE, POLE, FLATTENING, 1.0)
    place = point + found.distance * way
    assert found.altitude > 0.0
    assert_allclose(np.array(found.normal) @ way, 0.0, atol=1e-12)

    def away(normal):
        foot = spheroid_point(Vec3(*unit(normal)), POLE, FLATTENING, 1.0)
        return np.linalg.norm(place - np.array(foot))

    nearest = minimize(away, np.array(found.normal), tol=1e-10).fun
    # similar spheroids are not parallel: second order in the altitude, below 2 % at 4 % of radius
    assert_allclose(found.altitude, nearest, rtol=0.02)


def unit(a):
    return a / np.linalg.norm(a)


def test_the_limb_separates_lines_that_meet_the_spheroid():
    for angle in np.linspace(0.0, 2.0 * np.pi, 9):
        for size in (0.15, 0.17, 0.19, 0.2, 0.21, 0.25):
            way = Vec3(*ray(size * np.cos(angle), size * np.sin(angle)))
            above = height_above_limb(way, EYE, POLE, FLATTENING, 1.0)
            assert (above > 0.0) == (lowest_point(way, EYE, POLE, FLATTENING, 1.0).altitude > 0.0)


def test_a_point_with_a_normal_lies_on_the_spheroid_at_the_geodetic_latitude():
    # tan(planetocentric) = (1 - f)² tan(planetographic): Archinal et al. (2018), section 2
    for latitude in (-70.0, 0.0, 30.0, 45.0, 89.0):
        f = np.radians(latitude)
        point = spheroid_point(
            Vec3(np.cos(f), 0.0, np.sin(f)), Vec3(0.0, 0.0, 1.0), FLATTENING, 1.0
        )
        assert_allclose(point.z / point.x, (1.0 - FLATTENING) ** 2 * np.tan(f), rtol=1e-12)
        assert_allclose(point.x**2 + (point.z / (1.0 - FLATTENING)) ** 2, 1.0, rtol=1e-12)


@pytest.mark.parametrize("away", [-0.01, 0.01])
def test_a_shadow_ends_where_the_line_to_the_star_touches_the_spheroid(away):
    # from a point of the limb, moved along its normal and away from the star
    star = unit(np.array([0.3, -0.5, 0.8]))
    for angle in np.linspace(0.0, 2.0 * np.pi, 5)[:-1]:
        x = unit(np.cross(star, NORTH))
        normal = np.cos(angle) * x + np.sin(angle) * np.cross(star, x)
        limb = np.array(spheroid_point(Vec3(*normal), POLE, FLATTENING, 1.0))
        point = limb + away * normal - 2.0 * star
        found = beside_shadow(Vec3(*point), Vec3(*star), POLE, FLATTENING, 1.0)
        assert_allclose(found, -away, rtol=0.02)  # first order in the distance
        seen = is_hidden(point, star)
        assert (found > 0.0) == seen


def is_hidden(point, star):
    """Whether the line from a point to the star meets the spheroid."""
    return min(excess(point + t * star) for t in np.linspace(0.0, 4.0, 20001)) < 0.0


def test_a_sphere_is_not_stretched():
    assert stretched(Vec3(1.0, 2.0, 3.0), POLE, 0.0) == Vec3(1.0, 2.0, 3.0)
