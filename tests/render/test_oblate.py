"""Oblate planets in pictures against exact geometry, the spherical limit and numerical columns."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

import airlight
from airlight import Camera, Scene
from airlight.planets import load_planet, replace
from airlight.planets.rings import Ring
from airlight.render import render
from airlight.render.pixels.ring_shine import HOURS, LATITUDES, ring_shine
from airlight.render.through_air import AirAround
from airlight.scene.projections.projected import projected_rays

NM = (680.0, 550.0, 440.0)
AIR = load_planet("earth-atmosphere-plus", {"ground.albedo": "0.9"})
#: The same air, so thin that the ground has all light.
BARE = replace(AIR, constituents=(replace(AIR.constituents[0], scattering=1e-12),))
#: Air with one exponential profile.
EVEN = replace(AIR, constituents=(replace(AIR.constituents[0], scattering=5e-6),))
R, FLATTENING = AIR.bottom_radius, 0.098
POLAR = R * (1.0 - FLATTENING)
RING = Ring(inner_radius=8.2e6, outer_radius=13e6, optical_depth=0.6, exponent=0.0)


def solved(planet, **values):
    return airlight.solve(replace(planet, **values), NM, quality="preview")


@pytest.fixture(scope="module")
def oblate():
    return solved(BARE, flattening=FLATTENING)


def scene(latitude=25.0, side=60, width=13.0, sun_zenith=70.0):
    camera = Camera(look_zenith=180.0, width=side, height=side, field_of_view=width)
    return Scene(
        altitude=6e7, latitude=latitude, sun_zenith=sun_zenith, sun_azimuth=130.0, camera=camera
    ).north_up()


def lines(one):
    """Eye, directions of pixel centres and star, in the planet's frame."""
    camera, turn = one.camera, one.ground_frame
    x, y = np.arange(camera.width) + 0.5, np.arange(camera.height) + 0.5
    size = camera.width, camera.height, np.radians(camera.field_of_view)
    seen = projected_rays(camera.projection, x, y, *size) @ camera.axes @ turn.T
    return (R + one.altitude) * turn[:, 2], seen, turn @ one.sun_direction


def nearest(eye, rays, polar=POLAR):
    """Least of the spheroid's quadratic form along lines, 1 on its surface, and the distance."""
    form = np.array([1.0 / R, 1.0 / R, 1.0 / polar])
    a, b = rays * form, eye * form
    square, mixed = np.sum(a * a, axis=-1), np.sum(a * b, axis=-1)
    least = b @ b - mixed**2 / square
    way = (-mixed - np.sqrt(np.maximum(mixed**2 - square * (b @ b - 1.0), 0.0))) / square
    return least, way


def test_the_silhouette_is_that_of_the_spheroid_within_a_pixel(oblate):
    # a pixel is lit or dark as its centre; those within one pixel of the edge are left out
    lit = scene(side=120, sun_zenith=0.0)
    picture = render(oblate, lit, disc=False).rgb[..., 1] > 0.0
    eye, rays, _ = lines(lit)
    least, _ = nearest(eye, rays)
    inside = least < 1.0
    pixel = np.hypot(*np.gradient(np.sqrt(least)))
    sure = np.abs(np.sqrt(least) - 1.0) > pixel + AIR.thickness / R
    assert 500 < (inside & sure).sum() < inside.sum()
    assert picture[inside & sure].all()
    assert not picture[~inside & sure].any()
    rows, columns = (np.flatnonzero(picture.any(axis=k)).size for k in (1, 0))
    assert rows < 0.96 * columns


def test_the_ground_has_the_light_of_its_own_normal(oblate):
    # Lambert: A μ₀/π, with the geodetic zenith angle of the star; single precision
    one = scene()
    eye, rays, star = lines(one)
    least, way = nearest(eye, rays)
    ground = eye + way[..., None] * rays
    normal = ground / np.array([R, R, POLAR]) ** 2
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    rise = normal @ star
    frame = render(oblate, one, disc=False)
    light = frame.rgb[..., 1]
    sure = (least < 0.9) & (np.abs(rise) > 0.02)
    day = light[sure & (rise > 0.0)] / rise[sure & (rise > 0.0)]
    assert day.size > 300
    assert_allclose(day / np.median(day), 1.0, rtol=2e-3)
    assert light[sure & (rise < 0.0)].max() < 1e-6 * light.max()  # of the thin air


def test_a_sphere_is_the_limit_of_an_oblate_planet():
    # with air, rings, ringshine and the sun's disc behind the limb; single precision of the light
    whole, almost = (solved(AIR, rings=(RING,), flattening=f) for f in (0.0, 1e-12))
    one = scene(width=26.0, side=48)
    for polariser in (None, 30.0):
        camera = replace(one.camera, polariser=polariser)
        seen = replace(one, camera=camera)
        wanted, found = (render(s, seen).rgb for s in (whole, almost))
        assert_allclose(found, wanted, rtol=1e-4, atol=1e-5 * wanted.max())


def test_the_shadow_of_rings_falls_where_the_spheroid_has_it():
    # Beer's law on the way from the ground of the spheroid to the star
    one = scene()
    dark = replace(RING, single_scattering_albedo=0.0)
    free, shaded = (
        render(solved(BARE, rings=rings, flattening=FLATTENING), one, disc=False).rgb[..., 1]
        for rings in ((), (dark,))
    )
    eye, rays, star = lines(one)
    least, way = nearest(eye, rays)
    ground = eye + way[..., None] * rays
    before = eye - eye[2] / rays[..., 2:] * rays
    hidden = (eye[2] / rays[..., 2] < 0.0) & (np.linalg.norm(before, axis=-1) < 1.05 * 13e6)
    hidden &= (np.linalg.norm(before, axis=-1) > 0.95 * 8.2e6) & (-eye[2] / rays[..., 2] < way)
    to_star = -ground[..., 2] / star[2]
    radius = np.linalg.norm(ground + to_star[..., None] * star, axis=-1)
    expected = np.where(
        (to_star > 0.0) & (radius > 8.2e6) & (radius < 13e6), np.exp(-0.6 / abs(star[2])), 1.0
    )
    normal = ground / np.array([R, R, POLAR]) ** 2
    slant = -np.sum(normal * rays, axis=-1) / np.linalg.norm(normal, axis=-1)
    pixel = one.camera.pixel_angle * way / np.maximum(slant, 0.2) / abs(star[2])
    edge = np.minimum(np.abs(radius - 8.2e6), np.abs(radius - 13e6)) < 2e5 + pixel  # penumbra
    sure = (least < 0.9) & (free > 0.02 * free.max()) & ~edge & ~hidden
    assert (expected[sure] < 1.0).sum() > 50
    assert_allclose(shaded[sure] / free[sure], expected[sure], rtol=2e-3)


def test_the_planet_hides_its_rings_from_the_star_as_a_spheroid():
    # the spheroid's quadratic form on the line to the star; bright rings seen from the north
    one = scene(latitude=70.0, width=26.0, side=80)
    bright = replace(RING, single_scattering_albedo=1.0)
    rgb = render(solved(BARE, rings=(bright,), flattening=FLATTENING), one, disc=False).rgb[..., 1]
    eye, rays, star = lines(one)
    point = eye - eye[2] / rays[..., 2:] * rays
    radius = np.linalg.norm(point, axis=-1)
    form = np.array([1.0 / R, 1.0 / R, 1.0 / POLAR])
    a, b = star * form, point * form
    least = np.sum(b * b, axis=-1) - (b @ a) ** 2 / (a @ a)
    dark = (point @ star < 0.0) & (least < 1.0)
    seen, _ = nearest(eye, rays)
    sure = (radius > 8.3e6) & (radius < 12.8e6) & (seen > 1.05) & (np.abs(least - 1.0) > 0.08)
    assert (sure & dark).sum() > 30
    assert not rgb[sure & dark].any()
    assert (rgb[sure & ~dark] > 0.0).all()


def test_ringshine_falls_on_the_spheroid():
    # L = ϖ τ / 4π |slope| of thin isotropic rings, by another rule, at a point whose normal is at
    # 45° S and which is nearer to the plane than on a sphere. 1 %: some thousand points
    star = np.array([np.cos(0.4), 0.0, np.sin(0.4)])
    thin = replace(RING, optical_depth=1e-3, single_scattering_albedo=1.0)
    tables = solved(AIR, rings=(thin,)).tables
    row = LATITUDES // 4
    node = row * HOURS + HOURS - 1  # at midnight
    latitude = np.pi * (row / (LATITUDES - 1) - 0.5)
    up = np.array([-np.cos(latitude), 0.0, np.sin(latitude)])
    r, angle = np.meshgrid(
        np.linspace(8.2e6, 13e6, 1201), np.linspace(0.0, 2.0 * np.pi, 2400, endpoint=False)
    )
    point = np.stack([r * np.cos(angle), r * np.sin(angle), 0.0 * r], axis=-1)
    form, found = np.array([1.0 / R, 1.0 / R, 1.0 / POLAR]), []
    place = up / np.linalg.norm(up / form) / form**2
    least = np.sum((point * form) ** 2, axis=-1) - (point * form @ (star * form)) ** 2 / (
        np.sum((star * form) ** 2)
    )
    away = point - place
    distance = np.linalg.norm(away, axis=-1)
    rise = away @ up / distance
    light = ~((point @ star < 0.0) & (least < 1.0)) * (rise > 0.0)
    integrand = 1e-3 / (4.0 * np.pi) * light * rise * r / distance**2
    wanted = np.trapezoid(integrand.sum(axis=0) * 2.0 * np.pi / 2400, r[0])
    for flattening in (FLATTENING, 0.0):
        shine = ring_shine(tables, float(star[2]), flattening)
        found.append(shine.irradiance[node, 0] * (shine.directions[node] @ up))
    assert_allclose(found[0], wanted, rtol=0.01)
    assert abs(found[1] / wanted - 1.0) > 0.05


def test_the_night_side_has_the_light_of_the_rings_and_not_their_shadow():
    # Lambert on both sides: A E/π, at the node of the table at 45° S and midnight, and at the pole
    # in the sun; linear in between, and little is scattered
    bright = replace(RING, single_scattering_albedo=1.0)
    solution = solved(BARE, rings=(bright,), flattening=FLATTENING)
    star = np.array([np.cos(0.4), 0.0, np.sin(0.4)])
    node = LATITUDES // 4 * HOURS + HOURS - 1
    up = np.array([-np.sqrt(0.5), 0.0, -np.sqrt(0.5)])
    shine = ring_shine(solution.tables, float(star[2]), FLATTENING)
    below = np.degrees(np.arctan((1.0 - FLATTENING) ** 2))
    camera = Camera(look_zenith=180.0, width=1, height=1, field_of_view=0.01)
    light = []
    for latitude, bearing in ((-below, 180.0), (90.0, 0.0)):
        f = np.radians(latitude)
        rise = star @ np.array([-np.cos(f), 0.0, np.sin(f)])
        one = Scene(
            altitude=2e5,
            latitude=latitude,
            sun_zenith=np.degrees(np.arccos(rise)),
            sun_azimuth=bearing,
            camera=camera,
        )
        light.append(render(solution, one, disc=False).rgb[0, 0, 1])
    wanted = shine.irradiance[node, 0] * (shine.directions[node] @ up) / star[2]
    assert_allclose(light[0] / light[1], wanted, rtol=0.02)


@pytest.mark.parametrize("place", ["pole", "equator", "equator from the pole"])
def test_columns_at_the_limb_are_those_of_the_spheroid(place):
    # the transmittance of exponential air along the line in the spheroid, by quadrature over the
    # geodetic altitude; 0.5 %: curvature changes along the line
    solution = solved(EVEN, flattening=FLATTENING)
    pole = np.array([0.0, 0.0, 1.0] if place == "equator from the pole" else [1.0, 0.0, 0.0])
    half, side = (POLAR, pole) if place == "pole" else (R, np.array([0.0, 1.0, 0.0]))
    eye = np.array([0.0, 0.0, 3.0 * R])
    depth = POLAR if place == "equator from the pole" else R
    way = tangent(half + 2e4, depth + 2e4, 3.0 * R, side)
    air = AirAround(solution=solution, altitude=2.0 * R, pole=pole)
    through, _ = air.behind(way[None, :])
    t = np.linspace(2.0 * R, 4.0 * R, 400001)
    altitude = geodetic_altitude(eye + t[:, None] * way, pole)
    density = np.where(altitude < AIR.thickness, np.exp(-altitude / 8e3), 0.0)
    wanted = np.trapezoid(density, t) * solution.geometry.medium.extinction[0]
    assert altitude.min() > 1e4
    assert_allclose(-np.log(through[0]), wanted, rtol=5e-3)


def tangent(half, depth, distance, side):
    """Line from above the middle of an ellipse that touches it."""
    # x = half cos a, z = depth sin a with sin a = depth/distance
    sine = depth / distance
    point = half * np.sqrt(1.0 - sine**2) * side + np.array([0.0, 0.0, depth * sine])
    way = point - np.array([0.0, 0.0, distance])
    return way / np.linalg.norm(way)


def geodetic_altitude(points, pole):
    """Altitude over the spheroid, by Bowring's method."""
    north = points @ pole
    level = np.linalg.norm(points - north[:, None] * pole, axis=1)
    square = 1.0 - (1.0 - FLATTENING) ** 2
    angle = np.arctan2(north, level * (1.0 - FLATTENING))
    for _ in range(5):
        latitude = np.arctan2(
            north + square / (1.0 - square) * POLAR * np.sin(angle) ** 3,
            level - square * R * np.cos(angle) ** 3,
        )
        angle = np.arctan2((1.0 - FLATTENING) * np.sin(latitude), np.cos(latitude))
    size = np.hypot(level - R * np.cos(angle), north - POLAR * np.sin(angle))
    return size * np.sign((level / R) ** 2 + (north / POLAR) ** 2 - 1.0)
