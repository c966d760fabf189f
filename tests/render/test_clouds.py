"""Clouds in pictures: full and no cover, shadow and parallax of the layer, what it veils."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Scene, load_planet, solve
from airlight.physics.optics.clouds import layer_reflectance, plane_albedo, reflected_at
from airlight.physics.optics.reflection import mean_albedo
from airlight.planets.cloud_cover import mean_cover
from airlight.render import render
from airlight.scene.ground_overlay import enlarged, ground_overlay
from airlight.solver.moments.solution import MomentsSolution

RGB = (680.0, 550.0, 440.0)
PLANET = "earth-atmosphere-plus"
BOTTOM = 6.36e6
Cloudy = Callable[..., MomentsSolution]
FROM_SPACE = Scene(
    altitude=400e3,
    sun_zenith=50.0,
    camera=Camera(width=32, height=18, field_of_view=70.0, look_zenith=150.0, look_azimuth=30.0),
)


@pytest.fixture
def cloudy(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Cloudy:
    """Solution of an Earth below a cover, a number or pixels, at three wavelengths."""
    monkeypatch.chdir(tmp_path)
    for kept in (ground_overlay, mean_cover):
        kept.cache_clear()  # the tests' clouds have the same name
    count = 0

    def make(cover: float | np.ndarray, **ground: object) -> MomentsSolution:
        nonlocal count
        count += 1
        pixels = np.broadcast_to(255.0 * np.asarray(cover), np.shape(cover) or (16, 32))
        name = f"./clouds-{count}.png"
        Image.fromarray(pixels.astype(np.uint8)).save(name)
        changes = {f"ground.{key}": value for key, value in ground.items()}
        return solved({"ground.clouds": name, **changes})

    return make


def solved(changes: dict[str, object]) -> MomentsSolution:
    return solve(load_planet(PLANET, changes), RGB, "preview", cache=False)


def rgb_of(solution: MomentsSolution, scene: Scene, **options: object) -> np.ndarray:
    return render(solution, scene, **options).rgb.astype(float)


@pytest.mark.parametrize("sun", [50.0, 80.0])
def test_full_cover_is_drawn_as_lines_of_sight_see_it(cloudy: Cloudy, sun: float) -> None:
    # A second path: the ground of ``radiance``, in double precision, without map, pixel or LUT.
    # Over Lambert ground both have the layer and what is below it; a layer at the ground has no
    # parallax.
    solution = cloudy(1.0, albedo=0.3, cloud_altitude="0 m")
    camera = Camera(width=9, height=5, field_of_view=50.0, look_zenith=155.0, look_azimuth=30.0)
    scene = replace(FROM_SPACE, sun_zenith=sun, camera=camera)
    directions = camera.directions().reshape(-1, 3)
    zenith = np.degrees(np.arccos(directions[:, 2]))
    azimuth = np.degrees(np.arctan2(-directions[:, 1], directions[:, 0]))
    lines = {"altitude": scene.altitude, "sun_zenith": sun, "view_zenith": zenith}
    seen = solution.radiance(**lines, azimuth=azimuth)
    values = np.asarray(seen.values if hasattr(seen, "values") else seen).reshape(-1, len(RGB))
    drawn = rgb_of(solution, scene, exact=True).reshape(-1, 3)
    ratio = drawn[:, 1] / values[:, 1]
    assert_allclose(ratio, ratio.mean(), rtol=5e-3)


def test_no_droplets_are_clear_sky(cloudy: Cloudy) -> None:
    # The limit of optical depth 0, seen from above and lit from below.
    none = cloudy(1.0, cloud_optical_depth=0.0, albedo=0.3)
    clear = solved({"ground.albedo": 0.3})
    assert_allclose(rgb_of(none, FROM_SPACE), rgb_of(clear, FROM_SPACE), rtol=1e-5)


def test_a_glory_surrounds_the_shadow_of_the_observer(cloudy: Cloudy) -> None:
    # Mie theory: rings around the point opposite to the star, in colours, brighter than the cloud
    # 10° from there; the red ring is wider than the blue one.
    solution = cloudy(1.0, cloud_optical_depth=10.0, albedo=0.05)
    camera = Camera(width=81, height=81, field_of_view=24.0, look_zenith=150.0, look_azimuth=180.0)
    scene = Scene(camera=camera, altitude=11e3, sun_zenith=30.0)
    picture = rgb_of(solution, scene)
    apart = np.degrees(np.arccos(np.clip(-camera.directions() @ scene.sun_direction, -1.0, 1.0)))
    rings = [
        picture[(apart > a) & (apart < a + 0.4)].mean(axis=0) for a in np.arange(0.4, 10.0, 0.4)
    ]
    light = np.array(rings) / np.array(rings)[-1]
    assert light[:6].max() > 1.04
    assert light[2:8, 0].argmax() >= light[2:8, 2].argmax()
    assert np.ptp(light[:8, 0] / light[:8, 2]) > 0.02


@pytest.mark.parametrize("ground", [{}, {"law": "lommel-seeliger"}, {"law": "water"}])
def test_no_cover_is_clear_sky(cloudy: Cloudy, ground: dict[str, object]) -> None:
    clear = solved({f"ground.{key}": value for key, value in ground.items()})
    none = cloudy(0.0, **ground)
    assert_allclose(rgb_of(none, FROM_SPACE), rgb_of(clear, FROM_SPACE), rtol=1e-6)


def test_the_air_is_lit_by_the_mean_of_clouds_and_ground(cloudy: Cloudy) -> None:
    # Second path: a Lambert planet of the albedo under a uniform sky, under the sun whose plane
    # albedo is the same; 102/255 is two fifths. What the clouds add to the sky is a tenth
    # more, since the layer is brighter near the horizon, where the air is thick.
    half = cloudy(0.4, cloud_optical_depth=20.0, albedo=0.1)
    mean = mean_albedo(half.medium.ground)
    layer = half.medium.ground.layer
    cosines = np.linspace(0.4, 0.9, 501)
    sun = cosines[np.abs([plane_albedo(x, layer) - layer.layer_albedo for x in cosines]).argmin()]
    lines = {"altitude": 2.0, "sun_zenith": np.degrees(np.arccos(sun)), "azimuth": 40.0,
             "view_zenith": [0.0, 60.0, 89.0]}  # fmt: skip
    plain, dark = (solved({"ground.albedo": x}).radiance(**lines) for x in (float(mean[0]), 0.1))
    found, plain, dark = (np.asarray(x) for x in (half.radiance(**lines), plain, dark))
    assert_allclose(found - dark, plain - dark, rtol=0.12)


def test_orders_are_parts_of_the_whole(cloudy: Cloudy) -> None:
    # Clouds are lit by the star and by the sky, which are of different orders.
    solution = cloudy(0.4)
    once, more, both = (
        rgb_of(solution, FROM_SPACE, orders=x) for x in ("single", "multiple", "all")
    )
    assert_allclose(once + more, both, rtol=2e-4)


def block(latitude: float, longitude: float) -> np.ndarray:
    """Cover of a square of 1° (111 km), of pixels of a quarter of a degree."""
    rows = 90.0 - (np.arange(720) + 0.5) / 4.0
    columns = (np.arange(1440) + 0.5) / 4.0 - 180.0
    inside = (np.abs(rows - latitude)[:, None] < 0.5) & (np.abs(columns - longitude) < 0.5)
    return inside.astype(float)


def center_of(weights: np.ndarray, camera: Camera, altitude: float) -> np.ndarray:
    """Centre of light or shadow on the ground below, in the observer's frame. [m]"""
    x, y, z = np.moveaxis(camera.directions(), -1, 0)
    r = BOTTOM + altitude
    along = -r * z - np.sqrt(BOTTOM**2 - r**2 * (1.0 - z**2))
    return np.array([np.sum(weights * along * one) for one in (x, y)]) / weights.sum()


@pytest.mark.parametrize("sun_azimuth", [0.0, 120.0])
def test_the_shadow_lies_away_from_the_star_by_the_altitude_times_the_tangent(
    cloudy: Cloudy, sun_azimuth: float
) -> None:
    # Geometry on the sphere: the ray of the star through the middle of the square meets the ground
    # 177 km away; flat ground would have h tan 60° = 173 km. Such clouds let 1 % through.
    altitude, sun = 100e3, np.radians(60.0)
    solution = cloudy(block(0.0, 20.0), cloud_optical_depth=1000.0, albedo=0.5,
                      cloud_altitude=f"{altitude} m")  # fmt: skip
    camera = Camera(width=120, height=120, field_of_view=24.0, look_zenith=180.0)
    scene = Scene(camera=camera, altitude=3e6, sun_zenith=60.0, sun_azimuth=sun_azimuth,
                  longitude=20.0)  # fmt: skip
    clear = rgb_of(solved({"ground.albedo": 0.5}), scene)[..., 0]
    ratio = rgb_of(solution, scene)[..., 0] / clear
    shade = np.clip(0.97 - ratio, 0.0, None)
    star = np.array([np.sin(sun), 0.0, np.cos(sun)])
    top = np.array([0.0, 0.0, BOTTOM + altitude])
    cosine = star @ top
    away = cosine - np.sqrt(cosine**2 - (top @ top - BOTTOM**2))
    expected = (top - away * star)[:2]
    assert -180e3 < expected[0] < -173.2e3
    # a pixel is 10 km, the map's 28 km
    assert_allclose(center_of(shade, camera, scene.altitude), expected, atol=8e3)
    bright = np.clip(ratio - 1.2, 0.0, None)
    # seen from straight above the square has no parallax
    assert_allclose(center_of(bright, camera, scene.altitude), 0.0, atol=8e3)
    assert shade.max() > 0.3


def test_a_cloud_is_seen_where_it_is_aloft(cloudy: Cloudy) -> None:
    # Geometry: the direction from the observer to the middle of the square, at its altitude; on the
    # ground it would be 1.9° lower.
    altitude = 50e3
    solution = cloudy(
        block(0.0, 6.0), cloud_optical_depth=1000.0, albedo=0.0, cloud_altitude=f"{altitude} m"
    )
    scene = Scene(altitude=800e3, sun_zenith=0.0)
    angle = np.radians(6.0)
    radial = np.array([np.cos(angle), np.sin(angle), 0.0])  # in the planet's frame
    frame = np.asarray(scene.ground_frame)

    def towards(height: float) -> np.ndarray:
        way = frame.T @ ((BOTTOM + height) * radial) - np.array([0.0, 0.0, BOTTOM + 800e3])
        return way / np.linalg.norm(way)

    aim = towards(altitude)
    zenith, azimuth = np.degrees([np.arccos(aim[2]), np.arctan2(-aim[1], aim[0])])
    camera = Camera(
        width=96, height=96, field_of_view=24.0, look_zenith=zenith, look_azimuth=azimuth
    )
    scene = replace(scene, camera=camera)
    light = rgb_of(solution, scene)[..., 0]
    weights = np.clip(light - 0.5 * light.max(), 0.0, None)
    seen = (weights[..., None] * camera.directions()).sum(axis=(0, 1))
    seen /= np.linalg.norm(seen)
    off = np.degrees(np.arccos(min(seen @ aim, 1.0)))
    parallax = np.degrees(np.arccos(towards(0.0) @ aim))
    assert parallax > 1.9
    assert off < 0.3


def test_below_the_layer_clouds_are_not_seen_but_cast_shadows(cloudy: Cloudy) -> None:
    # From 3 km below full cover at 4 km: the ground in light that passes the cloud; from 5 km
    # mostly cloud. Their ratio by the transmittance t of the layer, its spherical albedo s, and its
    # reflectance factor; the geometric series of light between ground and cloud is in both.
    solution = cloudy(1.0, cloud_optical_depth=20.0, albedo=0.1)
    layer = solution.medium.ground.layer
    camera = Camera(width=8, height=8, field_of_view=20.0, look_zenith=180.0)
    low, high = (rgb_of(solution, Scene(camera=camera, altitude=h, sun_zenith=30.0))[..., 0]
                 for h in (3e3, 5e3))  # fmt: skip
    irradiance = solution.irradiance(altitude=0.0, sun_zenith=30.0)
    star, sky = (float(irradiance[part][0]) for part in ("direct", "diffuse"))
    mu = np.cos(np.radians(30.0))
    s, bounce = layer.layer_albedo, 0.1 / (1.0 - 0.1 * layer.layer_albedo)
    received = (1.0 - plane_albedo(mu, layer)) * star + (1.0 - s) * sky
    once = layer_reflectance(mu, 1.0, -mu, layer)
    above = reflected_at(once, layer, 0) * star + plane_albedo(1.0, layer) * sky
    above += (1.0 - plane_albedo(1.0, layer)) * bounce * received
    # 2 km of air in between adds as much light to both as 2 % of the clouds'
    assert_allclose(low / high, bounce * received / above, atol=0.02)


def test_clouds_veil_the_lights_of_towns(cloudy: Cloudy) -> None:
    # The cover's definition: 204/255 leaves a fifth, and of the rest what the layer lets through
    # straight up; by night nothing else shines.
    Image.new("L", (8, 4), 255).save("lights.png")
    camera = Camera(width=4, height=4, field_of_view=4.0, look_zenith=180.0)
    scene = Scene(camera=camera, altitude=4e5, sun_zenith=180.0)
    dark = cloudy(0.8, lights="./lights.png")
    clear, veiled = (rgb_of(one, scene) for one in (cloudy(0.0, lights="./lights.png"), dark))
    assert clear.min() > 0.0
    passes = 1.0 - 0.8 * plane_albedo(1.0, dark.medium.ground.layer)
    assert_allclose(veiled, passes * clear, rtol=2e-3)


def test_pictures_of_two_sizes_cover_the_same_places(cloudy: Cloudy) -> None:
    # Clouds coarser than the lights are enlarged, and neither is moved.
    Image.new("L", (64, 32), 0).save("lights.png")
    row, column = np.mgrid[0:8, 0:16]
    coarse = 0.5 + 0.4 * np.sin(np.pi * column / 8.0) * np.sin(np.pi * (row + 0.5) / 8.0)
    name = cloudy(coarse, albedo=0.1).medium.surface.clouds
    alone, both = ground_overlay(None, name), ground_overlay("./lights.png", name)
    assert alone is not None
    assert both is not None
    assert (alone.rows, both.rows) == (8, 32)
    rng = np.random.default_rng(3)
    where = rng.uniform(-85.0, 85.0, 200), rng.uniform(-180.0, 180.0, 200)
    # Linear between the same texels: the finer grid cuts corners where slopes change by 0.06 a
    # texel, by a sixteenth of that, and rounds to eight bits.
    assert_allclose(both.sample(*where)[:, 3], alone.sample(*where)[:, 3], atol=0.01)
    assert_allclose(both.mean_water, alone.mean_water, atol=5e-3)
    pixels = (255.0 * coarse).astype(np.uint8)
    assert enlarged(pixels, 8, 16) is pixels


@pytest.mark.parametrize(("albedo", "seen"), [(0.0, 0.1), (0.8, 0.01)])
def test_texture_shadows_and_shaded_tops_keep_the_mean_light(
    cloudy: Cloudy, albedo: float, seen: float
) -> None:
    # The layer without texture is the limit. Shadows fall 112 km away, three cells of the coarsest
    # noise, so that no cloud hides its own. Views of 900 km, with some 500 of its cells and two of
    # those of veils each, differ by 5 %: 32 all over the globe err by 1 %. Clouds before bright
    # ground are hardly seen.
    solution = cloudy(0.5, albedo=albedo, cloud_altitude="30 km")
    camera = Camera(width=96, height=96, field_of_view=96.0, look_zenith=180.0)
    found = []
    for view in range(32):
        place = {"latitude": 60.0 * math.sin(2.4 * view), "longitude": 11.25 * view - 180.0}
        scene = Scene(camera=camera, altitude=400e3, sun_zenith=75.0, **place)
        detailed = rgb_of(solution, replace(scene, ground="detailed"))
        plain = rgb_of(solution, scene)
        assert np.std(detailed / plain) > seen
        found.append([detailed.mean(axis=(0, 1)), plain.mean(axis=(0, 1))])
    with_texture, without = np.mean(found, axis=0)
    print("YY", with_texture / without)
    assert_allclose(with_texture, without, rtol=0.03)
