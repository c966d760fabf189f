"""Lights behind a moon: the disc pixel by pixel, and the light that is left for the air."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, MoonLight, Scene, StarLight, load_planet, render
from airlight.cli.camera_options import CameraOptions
from airlight.cli.place_options import PlaceOptions
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.scene_file import load_scene
from airlight.geometry.disc_overlap import visible_light
from airlight.image.xyz import luminance
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.pixels.occulted_light import DARKEST, light_left
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.render.render_scene import render_scene
from airlight.render.render_system import render_system
from airlight.solver.moments.solution import MomentsSolution

NM = (680.0, 550.0, 440.0)
#: Radiance of the new moon over the sun's, at most: the Earth's light is 1.2e-4 of the sun's
#: (Mallama & Hilton 2018), the full Moon 2.5e-6 of the sun, bright ground 2.5 times the mean.
EARTHSHINE = 1e-9


@pytest.fixture(scope="module")
def earth(solved: Callable[..., MomentsSolution]) -> MomentsSolution:
    return solved(load_planet("earth"), NM, "preview")


def eclipse(apart: float, radius: float = 0.27, zenith: float = 40.0, **camera: float) -> Scene:
    """Sun high in the sky, and a new moon beside its middle, to the right. [deg]"""
    moon = MoonLight(
        zenith=zenith, azimuth=apart / np.sin(np.radians(zenith)), phase=180.0,
        angular_radius=radius,
    )  # fmt: skip
    view = {"width": 120, "height": 120, "field_of_view": 0.8, "look_zenith": zenith} | camera
    return Scene(camera=Camera(**view), altitude=2.0, sun_zenith=zenith, secondary_lights=(moon,))


def discs(scene: Scene, solution: MomentsSolution) -> np.ndarray:
    """Light of the discs alone, linear sRGB; that of a new moon is earthshine."""
    shape = (scene.camera.height, scene.camera.width, 3)
    total = np.zeros(shape, np.float32)
    for seen, lit, _, _ in scenes_by_light(scene, solution):
        rgb = np.zeros(shape, np.float32)
        CpuRenderer(lit, seen, exact=True, air=False).render_rows(0, scene.camera.height, rgb)
        total += rgb
    return total


@pytest.mark.parametrize(
    ("apart", "radius"), [(0.0, 0.2), (0.1, 0.27), (0.3, 0.27), (0.45, 0.27), (0.6, 0.27)]
)
def test_the_light_of_the_crescent_is_what_the_moon_leaves(
    apart: float, radius: float, earth: MomentsSolution
) -> None:
    # a second method: the integral over the darkened disc; 1 % of the whole for rims of pixels
    whole = discs(dataclasses.replace(eclipse(apart, radius), secondary_lights=()), earth)
    found = discs(eclipse(apart, radius), earth).sum(axis=(0, 1)) / whole.sum(axis=(0, 1))
    star = earth.lights[0]
    left = visible_light(
        np.degrees(star.angular_radius), [apart], [radius], darkening=star.darkenings
    )
    assert_allclose(found, np.broadcast_to(left.mean(), 3), atol=0.012 + 0.03 * (left < 1.0).any())


def test_behind_the_moon_there_is_nothing_and_beside_it_nothing_changes(
    earth: MomentsSolution,
) -> None:
    # a law: a pixel shows the sun or the moon, but for their rims
    scene = eclipse(0.25)
    whole, found = (
        discs(dataclasses.replace(scene, secondary_lights=()), earth),
        discs(scene, earth),
    )
    rays = scene.camera.directions()
    angle = np.degrees(np.arccos(np.clip(rays @ scene.secondary_lights[0].direction, -1.0, 1.0)))
    rim = np.degrees(scene.camera.pixel_angle) + 0.01  # refraction of half a minute
    # the new moon shows earthshine alone
    assert found[angle < 0.27 - rim].max() < EARTHSHINE * whole.max()
    assert_allclose(found[angle > 0.27 + rim], whole[angle > 0.27 + rim], rtol=2e-5)
    assert np.count_nonzero(found) > 1000


@pytest.mark.parametrize("width", [12, 40, 120])
def test_the_last_crescent_has_no_ring(width: int, earth: MomentsSolution) -> None:
    # a law: where the moon's rim is just outside the sun's, by less than a pixel, nothing is left;
    # in totality there is none but earthshine, whatever the size of the pixels
    star = earth.lights[0]
    alpha = np.degrees(star.angular_radius)
    view = {"width": width, "height": width, "field_of_view": 4.0}
    whole = discs(dataclasses.replace(eclipse(0.0, **view), secondary_lights=()), earth)
    assert discs(eclipse(0.0, alpha + 0.005, **view), earth).max() < EARTHSHINE * whole.max()
    thin = discs(eclipse(0.012, alpha + 0.005, **view), earth)
    left = visible_light(alpha, [0.012], [alpha + 0.005], darkening=star.darkenings)
    assert 0.0 < left.min() < left.max() < 0.01
    assert thin.sum() / whole.sum() < 0.04  # of it without the moon's rim, 0.19


def test_air_is_lit_by_what_is_left(earth: MomentsSolution) -> None:
    # a law: light is linear in that of the sun
    away = {"field_of_view": 40.0, "look_zenith": 60.0, "look_azimuth": 120.0, "width": 24}
    scene = eclipse(0.1, **away)
    sky = luminance(render(earth, scene).rgb)
    day = luminance(render(earth, dataclasses.replace(scene, secondary_lights=())).rgb)
    star = earth.lights[0]
    left = visible_light(np.degrees(star.angular_radius), [0.1], [0.27], darkening=star.darkenings)
    assert np.ptp(left) > 1e-3
    assert_allclose(sky / day, np.mean(left), atol=np.ptp(left))
    total = luminance(render(earth, eclipse(0.0, 0.3, **away)).rgb)
    assert_allclose(total / day, DARKEST, rtol=1e-3)
    far = luminance(render(earth, eclipse(0.6, **away)).rgb)
    assert_array_equal(far, day)


def test_the_share_of_live_pictures_is_that_of_the_disc(earth: MomentsSolution) -> None:
    # a second method: the integral by the sun's own law of darkening, to the promised 0.01
    star = earth.lights[0]
    for radius in (0.2, 0.26, 0.28, 3.0):
        for apart in np.linspace(0.0, star.angular_radius + np.radians(radius), 14):
            wanted = visible_light(
                np.degrees(star.angular_radius), [np.degrees(apart)], [radius],
                darkening=star.darkenings,
            )  # fmt: skip
            found = light_left(star.angular_radius, apart, np.radians(radius))
            assert_allclose(found, wanted[1], atol=0.01)


def test_a_second_star_is_hidden_too(earth: MomentsSolution) -> None:
    # both stand behind the moon; half of the light of equal stars would be left by hiding one
    star = StarLight(zenith=40.0, azimuth=0.2, star=StarLight.black_body(5800.0, 0.2))
    moon = eclipse(0.0, 3.0).secondary_lights[0]
    scene = dataclasses.replace(eclipse(0.0), secondary_lights=(star, moon))
    sun = discs(dataclasses.replace(scene, secondary_lights=(star,)), earth)
    assert discs(scene, earth).max() < EARTHSHINE * sun.max()


@pytest.mark.slow
def test_the_eclipse_over_london_is_that_of_the_scene() -> None:
    # a second method: bodies in space, and the shadow at each point of the air. The sky to 10 %
    # where 0.06 of the light is left, the crescent to a pixel and a half
    time, place = "2026-08-12T18:13Z", {"latitude": 51.5, "longitude": -0.1}
    size = {"width": 60, "height": 60}
    planet = load_planet("earth")
    for look, wide in (("sun", 1.2), ("S/35", 90.0)):
        system = load_scene(
            PlanetOptions(planet="solar-eclipse-2017"),
            PlaceOptions(at="51.5,-0.1", time_=time),
            CameraOptions(look_at=look, fov=f"{wide}"),
        )
        wanted = luminance(render_system(system, **size, wavelengths=NM, quality="preview").rgb)
        camera = Camera(**size, field_of_view=wide)
        scene = Scene.at(planet, **place, time=time, look_at=look, camera=camera)
        lit = planet.lit_at(scene.time)
        found = luminance(render_scene(lit, scene, wavelengths=NM, quality="preview").rgb)
        if look != "sun":
            assert_allclose(np.median(found / wanted), 1.0, atol=0.1)
            continue
        one, other = (np.argwhere(x > 0.2 * x.max()) for x in (found, wanted))
        assert_allclose(one.min(axis=0), other.min(axis=0), atol=1.5)
        assert_allclose(one.max(axis=0), other.max(axis=0), atol=1.5)
        assert_allclose(len(one), len(other), rtol=0.15)
