"""Relief in pictures: light on slopes, and the shadow of a ridge."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.vectors import Vec3
from airlight.render.pixels.relief import HIGHEST, relief_light, slope_light, unshaded

BOTTOM = 6371e3
ROWS, COLUMNS = 1024, 2048


@pytest.mark.parametrize("elevation", [20.0, 45.0, 80.0])
def test_a_slope_is_lit_by_the_cosine_of_its_normal(elevation: float) -> None:
    # Lambert's law: n·s over that of level ground, on an area seen from above, which is larger than
    # its projection by 1/n_z.
    star = np.array([math.cos(math.radians(elevation)), 0.0, math.sin(math.radians(elevation))])
    for slope in (-0.3, -0.05, 0.1, 0.3):
        normal = np.array([-slope, 0.2, 1.0]) / math.sqrt(slope**2 + 0.2**2 + 1.0)
        wanted = max(normal @ star, 0.0) / normal[2] / star[2]
        assert_allclose(slope_light(star[2], slope), min(wanted, 2.5), rtol=1e-12)


def test_half_of_the_star_is_seen_above_a_skyline_through_its_middle() -> None:
    assert unshaded(0.2, 0.2) == 0.5
    assert_allclose(unshaded(0.2, 0.196) + unshaded(0.2, 0.204), 1.0, rtol=1e-12)


class Observer(NamedTuple):
    sun_x: float
    sun_z: float
    ground_x: Vec3
    ground_y: Vec3
    ground_z: Vec3


class Heights(NamedTuple):
    over_texels: np.ndarray
    over_rows: int
    over_columns: int
    over_levels: int


class Sphere(NamedTuple):
    bottom: float


class Frame(NamedTuple):
    camera: Heights
    tables: Sphere


def ridge(longitude: float) -> np.ndarray:
    """Flat texels with a ridge of full height along a meridian, two texels wide."""
    texels = np.zeros((ROWS, COLUMNS, 4), np.uint8)
    at = round((longitude + 180.0) / 360.0 * COLUMNS)
    texels[:, at - 1 : at + 1, 1] = 255
    return texels.reshape(-1)


def light_at(longitude: float, elevation: float) -> float:
    """Factor on the equator west of a ridge at 10° E, with the star in the east."""
    sine, cosine = math.sin(math.radians(elevation)), math.cos(math.radians(elevation))
    # an observer above the place: z up, x to the east, y to the north of the planet's frame
    east, up = math.radians(longitude) + 0.5 * math.pi, math.radians(longitude)
    x, z = ([math.cos(a), math.sin(a)] for a in (east, up))
    axes = Vec3(x[0], 0.0, z[0]), Vec3(x[1], 0.0, z[1]), Vec3(0.0, 1.0, 0.0)
    observer = Observer(cosine, sine, *axes)
    frame = Frame(Heights(ridge(10.0), ROWS, COLUMNS, 1), Sphere(BOTTOM))
    return float(relief_light(Vec3(0.0, 0.0, BOTTOM), 0.0, up, 0.0, observer, frame))


def test_a_ridge_shades_what_is_behind_it() -> None:
    # Geometry: seen from a distance d the ridge of 6400 m is at atan(h/d - d/2R): 4 texels (78 km)
    # away at 4.35°, which shades a star at 3° and not at 6°; before and on the ridge there is none.
    texel = 360.0 / COLUMNS
    distance = 4.0 * math.radians(texel) * BOTTOM
    skyline = math.degrees(math.atan(HIGHEST / distance - 0.5 * distance / BOTTOM))
    assert 4.0 < skyline < 4.7
    behind, before = 10.0 - 4.0 * texel, 10.0 + 6.0 * texel
    assert light_at(behind, 3.0) == 0.0
    assert_allclose(light_at(behind, 6.0), 1.0, rtol=1e-12)
    assert_allclose(light_at(before, 3.0), 1.0, rtol=1e-12)
    # the side that faces the star is brighter than level ground
    assert light_at(10.0 + 1.5 * texel, 30.0) > 1.0
    assert_array_equal(light_at(10.0, -1.0), 1.0)  # by night there is nothing to shade
