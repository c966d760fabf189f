"""Rings in pictures against geometry, Beer's law, Monte Carlo and a second integral."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import brentq

import airlight
from airlight import Camera, Scene
from airlight.errors import AirlightWarning, ParameterError
from airlight.geometry.occulted_star import OccultedStar
from airlight.geometry.vectors import Vec3
from airlight.planets import load_planet, replace
from airlight.planets.rings import Ring
from airlight.render import render
from airlight.render.pixels.ring_shine import HOURS, LATITUDES, ring_shine
from airlight.render.through_air import AirAround
from airlight.scene.projections.projected import projected_rays
from airlight.scene.system import load_system
from airlight.solver.montecarlo.eclipse import eclipsed_estimate
from airlight.solver.tables.ring_shadow import RingShadow, ring_shades, ring_tables
from airlight.studies.observables.irradiance import irradiance

#: Thin air above bright ground, which has most of the light.
PLANET = load_planet("earth-atmosphere-plus", {"ground.albedo": "0.9"})
R = PLANET.bottom_radius
INNER, OUTER, DEPTH = 8.2e6, 13e6, 0.6
#: Elevation of the star above the rings. [rad]
RISE = np.radians(26.5)
SUN = np.array([np.cos(RISE), 0.0, np.sin(RISE)])


def solved(rings=(), wavelengths=(680.0, 550.0, 440.0)):
    return airlight.solve(replace(PLANET, rings=rings), wavelengths, quality="preview")


def ring(**values):
    return Ring(**({"inner_radius": INNER, "outer_radius": OUTER, "optical_depth": DEPTH} | values))


@pytest.fixture(scope="module")
def bare():
    return solved()


@pytest.fixture(scope="module")
def black():
    """Planet with rings that reflect nothing."""
    return solved((ring(single_scattering_albedo=0.0),))


@pytest.fixture(scope="module")
def bright():
    return solved((ring(single_scattering_albedo=1.0, exponent=0.0),))


def scene(latitude, altitude, hour=0.0, **camera):
    """Scene above a point whose longitude is so many degrees east of noon; north is up."""
    f, h = np.radians(latitude), np.radians(hour)
    up = np.array([np.cos(f) * np.cos(h), np.cos(f) * np.sin(h), np.sin(f)])
    east, north = np.array([-np.sin(h), np.cos(h), 0.0]), np.array([0.0, 0.0, 1.0])
    north = north - (north @ up) * up
    north /= np.linalg.norm(north)
    made = Scene(
        altitude=altitude,
        latitude=latitude,
        sun_zenith=np.degrees(np.arccos(SUN @ up)),
        sun_azimuth=np.degrees(np.arctan2(SUN @ east, SUN @ north)),
        camera=Camera(**({"look_zenith": 180.0} | camera)),
    )
    return made.north_up()


def lines(one):
    """Eye and directions of the pixels of a scene at noon or hour 0, in the frame of the rings."""
    camera = one.camera
    x, y = np.arange(camera.width) + 0.5, np.arange(camera.height) + 0.5
    corners = []
    for dx, dy in ((0.0, 0.0), (0.7, 0.7), (0.7, -0.7), (-0.7, 0.7), (-0.7, -0.7)):
        seen = projected_rays(
            camera.projection, x + dx, y + dy, camera.width, camera.height,
            np.radians(camera.field_of_view),
        )  # fmt: skip
        corners.append(seen @ camera.axes @ one.ground_frame.T)
    eye = (R + one.altitude) * one.ground_frame[:, 2]
    return eye, np.array(corners)


@pytest.mark.parametrize(("place", "radius"), [(-9.0, INNER), (-39.0, OUTER)])
def test_shadow_edges_on_the_ground_are_where_geometry_puts_them(place, radius, bare, black):
    # rays to the star from the noon meridian meet the rings' edges: within one pixel
    def crossing(latitude):
        up = np.array([np.cos(latitude), 0.0, np.sin(latitude)])
        return np.linalg.norm(R * up - R * up[2] / SUN[2] * SUN)

    one = scene(place, 9e5, width=3, height=120, field_of_view=2.0)
    ratio = (render(black, one).rgb / render(bare, one).rgb)[:, 1, 0]
    eye, corners = lines(one)
    rays = corners[0][:, 1]
    along = -(rays @ eye)
    way = along - np.sqrt(along**2 - eye @ eye + R * R)
    latitude = np.arcsin((eye + way[:, None] * rays)[:, 2] / R)
    shadow = np.exp(-DEPTH / SUN[2])
    inside = ratio < 0.5 * (1.0 + shadow)
    edge = brentq(lambda f: crossing(f) - radius, np.radians(-80.0), np.radians(-1e-3))
    (change,) = np.flatnonzero(np.diff(inside)) + 0.5
    at = np.interp(edge, latitude[::-1], np.arange(latitude.size)[::-1])
    assert abs(change - at) <= 1.0
    assert_allclose(np.sort(ratio)[:40], shadow, rtol=2e-3)


def ringlets(narrow, wide, number, **values):
    """Ring whose optical depth alternates between 0.1 and 2 over random widths [m]."""
    edges = INNER + 1e5 + np.cumsum(np.random.default_rng(1).uniform(narrow, wide, number))
    radii = np.repeat(edges, 2) + np.tile([-1.0, 1.0], edges.size)
    depths = np.repeat(np.tile([0.1, 2.0], edges.size), 2)[1 : 1 + radii.size]
    return ring(optical_depth=None, radii=tuple(radii), optical_depths=tuple(depths), **values)


def test_ringlets_narrower_than_a_pixel_have_their_mean_light(bright):
    # Chandrasekhar's layer at 60 x 60 places in each pixel, over that of an even ring; ringlets of
    # 40 to 200 km, pixels of 800 km. 2 %: rows of the table, of 1.2 km, are means of optical depth.
    # Three radii in a pixel would err by a third
    fine = ringlets(4e4, 2e5, 36, single_scattering_albedo=1.0, exponent=0.0)
    one = scene(40.0, 3e8 - R, width=35, height=3, field_of_view=np.degrees(35 * 8e5 / 3e8))
    camera, n = one.camera, 60
    x, y = ((np.arange(size * n) + 0.5) / n for size in (camera.width, camera.height))
    size = camera.width, camera.height, np.radians(camera.field_of_view)
    rays = projected_rays(camera.projection, x, y, *size) @ camera.axes @ one.ground_frame.T
    eye = (R + one.altitude) * one.ground_frame[:, 2]
    radius = np.linalg.norm(eye - (eye[2] / rays[..., 2:]) * rays, axis=-1)
    steep = 1.0 / SUN[2] - 1.0 / rays[..., 2]

    def mean(values):
        return values.reshape(camera.height, n, camera.width, n).mean(axis=(1, 3))[1]

    expected = mean(-np.expm1(-fine.depths(radius) * steep)) / mean(-np.expm1(-DEPTH * steep))
    found, even = (render(one_, one, disc=False).rgb[1, :, 1] for one_ in (solved((fine,)), bright))
    whole = mean((radius > fine.radii[0]) & (radius < fine.radii[-1])) == 1.0
    assert whole.sum() >= 8
    assert_allclose(found[whole] / even[whole], expected[whole], rtol=0.02)


def test_shadows_of_ringlets_are_means_over_the_disc_of_the_star():
    # Beer's law through the table, over the chords of a disc, by 2000; five chords err by 29 %
    fine = ringlets(4e3, 2e4, 300)
    tables = ring_tables((fine,), np.array([550.0]))
    radii = tables.ring_inner + np.arange(len(tables.ring_layers)) / tables.ring_rows
    wide, way = 31.0 / tables.ring_rows, 1e7
    place = np.linspace(fine.radii[0] + wide, fine.radii[-1] - wide, 400)
    along, height, sun = np.zeros_like(place), np.full_like(place, -way), np.ones_like(place)
    out = np.empty_like(place)
    ring_shades(place**2 + way**2, along - way, height, sun, wide / way, tables, out)
    u = np.cos(np.pi * (np.arange(2000) + 0.5) / 2000)
    depth = np.interp(place[:, None] + wide * u, radii, tables.ring_layers[:, 0])
    expected = np.average(np.exp(-depth), axis=1, weights=1.0 - u * u)
    assert np.sqrt(np.mean((out / expected - 1.0) ** 2)) < 0.05


def test_planet_hides_its_rings_from_the_star_where_geometry_puts_its_shadow(bright):
    # A cylinder of the ground's radius; a pixel with an edge in it is left out.
    one = scene(80.0, 6e7, width=50, height=50, field_of_view=24.0)
    rgb = render(bright, one).rgb[..., 1]
    eye, corners = lines(one)
    point = eye - (eye[2] / corners[..., 2])[..., None] * corners
    radius = np.linalg.norm(point, axis=-1)
    on_ring = (radius > INNER) & (radius < OUTER)
    along = point @ SUN
    dark = (along < 0.0) & (radius**2 - along**2 < R * R)
    sure = on_ring.all(axis=0) & (dark.all(axis=0) | ~dark.any(axis=0))
    nearest = np.linalg.norm(np.cross(eye, corners), axis=-1).min(axis=0)
    sure &= nearest > PLANET.top_radius
    assert (sure & dark[0]).sum() > 20
    assert not rgb[sure & dark[0]].any()
    assert (rgb[sure & ~dark[0]] > 0.0).all()
    empty = ~on_ring.any(axis=0) & (nearest > PLANET.top_radius) & (nearest < 2.0 * OUTER)
    assert not rgb[empty].any()


def test_ring_before_the_planet_dims_it_and_behind_it_is_hidden(bare, black):
    # Beer's law along the line of sight; rings that reflect nothing
    one = scene(10.0, 6e7, width=40, height=40, field_of_view=6.0)
    seen, without = render(black, one).rgb[..., 1], render(bare, one).rgb[..., 1]
    eye, corners = lines(one)
    slope = corners[..., 2]
    way = -eye[2] / slope
    radius = np.linalg.norm(eye + way[..., None] * corners, axis=-1)
    on_ring = ((radius > INNER) & (radius < OUTER)).all(axis=0)
    nearest = np.linalg.norm(np.cross(eye, corners), axis=-1).max(axis=0)
    before = way[0] < -(corners[0] @ eye)
    ray = corners[0]
    length = -(ray @ eye) - np.sqrt(np.maximum((ray @ eye) ** 2 - eye @ eye + R * R, 0.0))
    ground = eye + length[..., None] * ray
    to_star = -ground[..., 2] / SUN[2]
    meets = np.linalg.norm(ground + to_star[..., None] * SUN, axis=-1)
    free = (to_star < 0.0) | (meets < 0.9 * INNER)  # of the shadow of the rings, by some pixels
    chosen = on_ring & (nearest < 0.98 * R) & (without > 0.0) & free
    front, back = chosen & before, chosen & ~before
    assert front.sum() > 5
    assert back.sum() > 5
    expected = np.exp(-DEPTH / np.abs(slope[0]))
    assert_allclose(seen[front] / without[front], expected[front], rtol=0.02)  # a pixel's mean
    assert_allclose(seen[back], without[back], rtol=1e-5)


def test_light_in_the_shadow_is_that_of_monte_carlo():
    # 3 %, by far more than the error of either; nadir of a point in the middle of the shadow
    planet = replace(PLANET, rings=(ring(),))
    solution = airlight.solve(planet, (540.0, 550.0, 560.0), quality="preview")
    reference = airlight.solve(planet, (550.0,), solver="montecarlo")
    one = scene(-25.0, planet.thickness + 1e3, width=1, height=1, field_of_view=0.01)
    ours = render(solution, one).rgb[0, 0, 1]
    free = render(solved((), (540.0, 550.0, 560.0)), one).rgb[0, 0, 1]
    up = one.ground_frame[:, 2]
    star = OccultedStar.whole()._replace(star_x=SUN[0], star_y=SUN[1], star_z=SUN[2])
    shadow = RingShadow(Vec3(0.0, 0.0, 1.0), solution.tables.rings)
    start = [up * (planet.top_radius - 1.0)]
    dark, lit = (
        eclipsed_estimate(reference, star, start, [-up], rings=rings).total[0, 0]
        for rings in (shadow, None)
    )
    assert_allclose(ours / free, dark / lit, rtol=0.03)


def test_ringshine_is_the_integral_over_a_thin_ring(bright):
    # L = ϖ τ / 4π |slope| of thin isotropic rings, integrated by another rule; the ring is in the
    # sun's light but for the planet's shadow. 1 %: the sums over rings have some thousand points
    thin = solved((ring(optical_depth=1e-3, single_scattering_albedo=1.0, exponent=0.0),))
    shine = ring_shine(thin.tables, float(SUN[2]))
    row, column = LATITUDES // 2 - 8, HOURS - 1  # at midnight
    node = row * HOURS + column
    latitude = np.pi * (row / (LATITUDES - 1) - 0.5)
    up = np.array([-np.cos(latitude), 0.0, np.sin(latitude)])
    r, angle = np.meshgrid(
        np.linspace(INNER, OUTER, 1201), np.linspace(0.0, 2.0 * np.pi, 2400, endpoint=False)
    )
    point = np.stack([r * np.cos(angle), r * np.sin(angle), 0.0 * r], axis=-1)
    away = point - R * up
    distance = np.linalg.norm(away, axis=-1)
    rise = away @ up / distance
    along = point @ SUN
    light = ~((along < 0.0) & (r**2 - along**2 < R * R)) * (rise > 0.0)
    integrand = 1e-3 / (4.0 * np.pi) * light * rise * r / distance**2
    total = np.trapezoid(integrand.sum(axis=0) * 2.0 * np.pi / 2400, r[0])
    ours = shine.irradiance[node, 0] * (shine.directions[node] @ up)
    assert_allclose(ours, total, rtol=0.01)


def test_planet_receives_no_more_ringshine_than_rings_intercept(bright):
    # energy: flux on the whole ground, of an albedo of 1, below the sunlight that the rings stop
    shine = ring_shine(bright.tables, float(SUN[2]))
    latitude = np.pi * (np.arange(LATITUDES) / (LATITUDES - 1) - 0.5)
    hour = np.pi * np.arange(HOURS) / (HOURS - 1)
    f, h = np.meshgrid(latitude, hour, indexing="ij")
    up = np.stack([np.cos(f) * np.cos(h), np.cos(f) * np.sin(h), np.sin(f)], axis=-1)
    rise = np.sum(shine.directions.reshape(*f.shape, 3) * up, axis=-1)
    flux = shine.irradiance[:, 0].reshape(f.shape) * rise * np.cos(f)
    received = 2.0 * R * R * np.trapezoid(np.trapezoid(flux, hour, axis=1), latitude)
    stopped = np.pi * (OUTER**2 - INNER**2) * SUN[2] * (1.0 - np.exp(-DEPTH / SUN[2]))
    assert 0.01 * stopped < received < 0.5 * stopped


def test_rings_light_the_night_side(bare, black, bright):
    # at midnight without a Moon only their light is there; the bounds of its size are by eye
    one = scene(40.0, 1e6, hour=180.0, width=1, height=1, field_of_view=1.0)
    dark, shaded, lit = (render(s, one, disc=False).rgb[0, 0, 1] for s in (bare, black, bright))
    assert lit > 100.0 * max(dark, shaded)
    day = render(bare, scene(40.0, 1e6, width=1, height=1, field_of_view=1.0)).rgb[0, 0, 1]
    assert 1e-4 * day < lit < 0.1 * day


def test_ringshine_is_left_out_where_it_is_faint_but_not_in_the_shadow_of_rings():
    # Dark, dense rings: 7e-3 of the sunlight is left in their shadow, and what they scatter down is
    # less than 3e-3 of daylight, below which it is left out, but not of the shadow's.
    def green(latitude, albedo):
        rings = (ring(optical_depth=2.2, single_scattering_albedo=albedo, exponent=0.0),)
        one = scene(latitude, 1e6, width=1, height=1, field_of_view=1.0)
        return float(render(solved(rings), one, disc=False).rgb[0, 0, 1])

    sunlit, shadow = ((green(at, 0.1), green(at, 0.0)) for at in (40.0, -25.0))
    assert_allclose(*sunlit, rtol=3e-3)
    assert shadow[1] < 0.02 * sunlit[1]
    added = shadow[0] - shadow[1]
    assert 0.01 * shadow[1] < added < 3e-3 * sunlit[1]


def test_stars_are_dimmed_by_rings_before_them(black):
    # Beer's law
    air = AirAround(solution=black, altitude=6e7, pole=np.array([0.6, 0.0, 0.8]))
    eye = np.array([0.0, 0.0, R + 6e7])
    pole = air.pole
    aside = np.cross(pole, [0.0, 1.0, 0.0])
    targets = np.array([10e6 * aside, 20e6 * aside])
    rays = targets - eye
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    through, _ = air.behind(rays)
    expected = np.exp(-DEPTH / abs(rays[0] @ pole))
    assert_allclose(through[:, 0], [expected, 1.0], rtol=1e-6)


def test_scenes_of_saturn_are_read():
    for name in ("saturn-rings", "saturn-ring-plane", "saturn-night"):
        assert load_system(name).planets["saturn"].rings


def numbers_place(latitude, hour=0.0):
    """Arguments of ``radiance`` for a point whose longitude is so many degrees east of noon."""
    one = scene(latitude, 0.0, hour)
    return {
        "sun_zenith": one.sun_zenith,
        "latitude": latitude,
        "sun_azimuth": one.sun_azimuth,
    }


def test_irradiance_in_the_shadow_is_that_of_monte_carlo():
    # 3 %: the target. Diffuse light of Monte Carlo, direct light by Beer's law through the rings
    planet = replace(PLANET, rings=(ring(),))
    reference = airlight.solve(planet, (550.0,), solver="montecarlo")
    solution = airlight.solve(planet, (540.0, 550.0, 560.0), quality="preview")
    place = numbers_place(-25.0)
    with pytest.warns(AirlightWarning, match="their light is left out"):
        ours = solution.irradiance(altitude=0.0, **place)
    free = solved((), (540.0, 550.0, 560.0)).irradiance(
        altitude=0.0, sun_zenith=place["sun_zenith"]
    )
    up = scene(-25.0, 0.0).ground_frame[:, 2]
    star = OccultedStar.whole()._replace(star_x=SUN[0], star_y=SUN[1], star_z=SUN[2])
    shadow = RingShadow(Vec3(0.0, 0.0, 1.0), solution.tables.rings)
    start = [up * (R + 1.0)]
    dark, lit = (
        eclipsed_estimate(reference, star, start, rings=rings).total[0, 0]
        for rings in (shadow, None)
    )
    assert_allclose(ours.diffuse[1] / free.diffuse[1], dark / lit, rtol=0.03)
    left = np.exp(-DEPTH / SUN[2])
    assert_allclose(ours.direct / free.direct, left, rtol=1e-3)


@pytest.mark.parametrize("altitude", [0.0, 3e6])
def test_radiance_in_the_shadow_is_that_of_pictures_and_of_monte_carlo(altitude, bare, black):
    # Monte Carlo, with its own geometry, to 3 %; pictures interpolate in tables
    planet = replace(PLANET, rings=(ring(single_scattering_albedo=0.0),))
    look = {"view_zenith": 60.0, "azimuth": 75.0}
    if altitude > 0.0:
        look["view_zenith"] = 160.0
    place = numbers_place(-22.0, 20.0)
    reference = airlight.solve(planet, (550.0,), solver="montecarlo")
    with pytest.warns(AirlightWarning, match="their light is left out"):
        ours = black.radiance(altitude=altitude, **look, **place)
    with pytest.warns(AirlightWarning, match="their light is left out"):
        traced = reference.radiance(altitude=altitude, **look, **place)
    without = bare.radiance(altitude=altitude, **look, sun_zenith=place["sun_zenith"])
    assert 0.2 < float(ours[1] / without[1]) < 0.35
    assert_allclose(ours[1], traced[0], rtol=0.03)
    one = scene(-22.0, altitude, 20.0)
    camera = Camera(
        look_zenith=look["view_zenith"],
        look_azimuth=look["azimuth"],
        width=1,
        height=1,
        field_of_view=0.01,
    )
    one = replace(one, camera=camera)
    pictures = render(black, one).rgb[0, 0, 1] / render(bare, one).rgb[0, 0, 1]
    assert_allclose(ours[1] / without[1], pictures, rtol=5e-3)


def test_numbers_ask_for_both_latitude_and_bearing(black):
    with pytest.raises(ParameterError, match=r"^sun_azimuth"):
        black.radiance(altitude=0.0, sun_zenith=60.0, view_zenith=0.0, latitude=10.0)


def test_integrals_of_irradiance_are_those_in_the_shadow(bare, black):
    # Beer's law through the rings, of a scene that pictures show in their shadow
    one = scene(-25.0, 0.0)
    with pytest.warns(AirlightWarning, match="their light is left out"):
        shaded = irradiance(black, one, spectral=True)
    free = irradiance(bare, one, spectral=True)
    for name in ("ghi", "dni", "dhi"):
        assert_allclose(shaded[name] / free[name], np.exp(-DEPTH / SUN[2]), rtol=1e-3)
