"""Light on surfaces of known slope, against irradiances by other ways."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import ParameterError
from airlight.engines.composition import Placement, compose
from airlight.engines.composition.relight import SurroundingLight
from airlight.solver.moments.solution import MomentsSolution

from .views import looking


def received(solution: MomentsSolution, altitude: float, sun: float, normals) -> np.ndarray:
    n = np.atleast_2d(np.asarray(normals, float))
    r = np.full(len(n), solution.medium.bottom_radius + altitude)
    mu_s = np.full(len(n), np.cos(np.radians(sun)))
    return SurroundingLight(solution).irradiance(r, mu_s, n, np.ones(len(n)))


@pytest.mark.parametrize(("sun", "bar"), [(20.0, 0.02), (65.0, 0.02), (88.0, 0.02), (94.0, 0.06)])
def test_a_level_surface_receives_the_sky_s_quadrature(
    earth: MomentsSolution, sun: float, bar: float
) -> None:
    # E = ∫ L cos dω over the sky, dense at the horizon, and the solver's level light of the star
    x, w = np.polynomial.legendre.leggauss(60)
    z, weight = (0.5 * (x + 1.0)) ** 2, 0.5 * w * (x + 1.0)
    around = (np.arange(48) + 0.5) * 180.0 / 48
    light = earth.radiance(
        altitude=1000.0, sun_zenith=sun, view_zenith=np.degrees(np.arccos(z))[:, None],
        azimuth=around,
    )  # fmt: skip
    sky = 2.0 * np.pi * np.einsum("zal,z->l", np.asarray(light), weight * z) / 48
    star = np.asarray(earth.irradiance(altitude=1000.0, sun_zenith=sun)["direct"])
    got = received(earth, 1000.0, sun, [0.0, 0.0, 1.0])[0]
    # the disc's rim alone lights a level surface when the sun is low: 0.5 % of its light at 88°
    assert_allclose(got, (sky + star) / earth.lights[0].irradiance, rtol=bar)


def test_a_slope_receives_the_quadrature_of_its_half_sphere(earth: MomentsSolution) -> None:
    # E = ∫ L max(n·ω, 0) dω by 100 000 directions
    sun, size = 60.0, (220, 440)
    z = 1.0 - (np.arange(size[0]) + 0.5) * 2.0 / size[0]
    around = (np.arange(size[1]) + 0.5) * 2.0 * np.pi / size[1]
    up, turn = (one.ravel() for one in np.meshgrid(z, around, indexing="ij"))
    light = earth.radiance(
        altitude=100.0, sun_zenith=sun, view_zenith=np.degrees(np.arccos(up)),
        azimuth=np.degrees(np.minimum(turn, 2.0 * np.pi - turn)),
    )  # fmt: skip
    light = np.asarray(light) / earth.lights[0].irradiance
    flat = np.sqrt(1.0 - up**2)
    ways = np.stack([flat * np.cos(turn), flat * np.sin(turn), up], axis=-1)
    normals = np.array([[0, 0, 1], [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0.6, 0, 0.8], [0, 0, -1]])
    star = earth.relative_normal_irradiance(
        np.array([earth.medium.bottom_radius + 100.0]), np.array([0.5])
    )
    to_sun = np.array([np.sqrt(0.75), 0.0, 0.5])
    got = received(earth, 100.0, sun, normals)
    for n, one in zip(normals, got, strict=True):
        sky = (light * np.maximum(ways @ n, 0.0)[:, None]).sum(axis=0) * 4.0 * np.pi / up.size
        wanted = sky + star[0] * max(n @ to_sun, 0.0)
        assert_allclose(one, wanted, rtol=0.03)


def test_the_star_s_share_follows_slope_and_shadow(earth: MomentsSolution) -> None:
    # a high sun's beam on a level surface is that on a facing one times the cosine
    r, mu_s = np.array([earth.medium.bottom_radius]), np.array([0.7])
    assert_allclose(
        0.7 * earth.relative_normal_irradiance(r, mu_s),
        earth.relative_direct_irradiance(r, mu_s), rtol=1e-4,
    )  # fmt: skip
    light = SurroundingLight(earth)
    toward = np.array([[np.sqrt(1.0 - 0.49), 0.0, 0.7]])
    whole, none = (light.irradiance(r, mu_s, toward, np.array([one])) for one in (1.0, 0.0))
    assert_allclose(whole - none, earth.relative_normal_irradiance(r, mu_s), rtol=1e-6)


def test_a_relit_picture_has_the_ground_s_light(earth: MomentsSolution) -> None:
    # a level grey surface at the camera's feet: albedo · E / π, nothing of the given colours
    camera, place = looking(1.0, -60.0, size=(8, 6)), Placement(sun_zenith=50.0)
    shape = (6, 8, 3)
    normals = np.broadcast_to([0.0, 0.0, 2.0], shape)
    got = compose(
        np.full(shape, 7.0), np.full((6, 8), 1.0), camera, earth, place, white=None,
        albedo=np.full(shape, 0.3), normals=normals,
    ).rgb  # fmt: skip
    light = earth.irradiance(altitude=0.0, sun_zenith=50.0)
    spectrum = np.asarray(light["direct"] + light["diffuse"]) / earth.lights[0].irradiance
    wanted = 0.3 / np.pi * spectrum @ earth.lights[0].colors()
    assert_allclose(got, np.broadcast_to(wanted, shape), rtol=0.03)
    with pytest.raises(ParameterError, match="requires albedo and normals"):
        compose(np.zeros(shape), np.ones((6, 8)), camera, earth, place, normals=normals)
