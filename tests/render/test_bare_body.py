"""Lines of sight that meet a body without air."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.vectors import Vec3
from airlight.kernel import vectorized
from airlight.render.pixels.bare_body import sphere_distance
from airlight.render.pixels.bare_ground import crater_light
from airlight.render.pixels.bare_relief import HIGHEST, relief_met, relief_shown


def test_a_line_meets_a_sphere_where_a_point_of_it_has_unit_distance() -> None:
    # Near the ground and far away: the end of the line is on the sphere, on the observer's side.
    for distance in (1.0 + 1e-6, 1.5, 3.0, 60.0):
        angle = np.linspace(0.0, 1.0, 50) * np.arcsin(1.0 / distance) * 0.999
        along, across = distance * np.cos(angle), distance * np.sin(angle)
        power = (distance - 1.0) * (distance + 1.0)
        length = np.asarray(vectorized(sphere_distance)(along, across, power))
        assert_allclose((along - length) ** 2 + across**2, 1.0, rtol=1e-9)
        assert (length <= along).all()
        missed = vectorized(sphere_distance)(distance * np.array([-1.0]), 0.0, power)
        assert_array_equal(missed, -1.0)
    assert sphere_distance(3.0, 1.001, 9.002) == -1.0


def test_only_near_ground_has_craters_of_mean_light() -> None:
    # Half a texel of the map, π/1024 wide, is the widest pixel with craters. Seen from above their
    # mean is 1 within three standard errors and 1 % for hills, whose steepest slopes are limited.
    random = np.random.default_rng(6)
    places = random.normal(size=(4000, 3))
    places /= np.linalg.norm(places, axis=1, keepdims=True)
    sideways = np.cross(places, [0.0, 0.6, 0.8])
    sideways /= np.linalg.norm(sideways, axis=1, keepdims=True)
    lights = 0.5 * places + 0.75**0.5 * sideways

    def found(width: float) -> np.ndarray:
        return np.array(
            [
                crater_light(
                    Vec3(*one), Vec3(*-one), Vec3(*light), 1.0, width, 0.1, 0.079, 1.7374e6, 1024.0
                )
                for one, light in zip(places, lights, strict=True)
            ]
        )

    near = found(1e-4)
    assert near.std() > 0.05
    assert abs(near.mean() - 1.0) < 0.01 + 3.0 * near.std() / np.sqrt(near.size)
    assert_array_equal(found(0.51 * np.pi / 1024.0), 1.0)


def test_relief_rises_over_the_limb_and_covers_pixels_by_parts() -> None:
    # 110 km above the Moon lines 5 km above and below its limb miss and meet it; between, the
    # share of covered pixels falls with the height. The place is within the greatest height.
    radius, rows, pixel = 1.7374e6, 1536.0, 1e-4
    reach = 1.0 + 110e3 / radius
    power = (reach - 1.0) * (reach + 1.0)
    assert relief_shown(power, radius, pixel) == 1.0
    covers = []
    for height in (-6e3, -1e3, 0.0, 1e3, 6e3):
        sine = (1.0 + height / radius) / reach
        cosine, found = (1.0 - sine * sine) ** 0.5, []
        for angle in np.linspace(0.0, 2.0 * np.pi, 200):
            ray = Vec3(cosine, sine * np.cos(angle), sine * np.sin(angle))
            centre = Vec3(reach, 0.0, 0.0)
            met = relief_met(ray, centre, power, radius, rows, pixel, 1.0)
            assert met == relief_met(ray, centre, power, radius, rows, pixel, 1.0)
            assert np.isfinite(met).all()
            found.append(met.cover)
            if met.length >= 0.0:
                end = np.array(ray) * met.length - np.array(centre)
                assert abs(np.linalg.norm(end) - 1.0) * radius < HIGHEST + 200.0
        covers.append(np.mean(found))
    assert covers[0] == 1.0
    assert covers[-1] == 0.0
    assert covers == sorted(covers, reverse=True)


def test_a_distant_body_is_a_sphere() -> None:
    # From the Earth a pixel is as wide as the highest mountains.
    assert relief_shown(221.0**2, 1.7374e6, 2e-5) == 0.0
