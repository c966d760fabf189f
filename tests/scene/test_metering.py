"""Metering of scenes: solid angles, the star left out, pictures of any size and field of view."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.scene import Camera, Scene
from airlight.scene.metering import metering_weights, scene_exposure
from airlight.scene.moon_light import MoonLight
from airlight.scene.projections import PROJECTIONS

RADIUS = 0.00465


def weights_of(projection: str, **size: float) -> np.ndarray:
    camera = Camera(projection=projection, look_zenith=90.0, look_azimuth=180.0, **size)
    # the sun is behind the camera, or of no consequence
    return metering_weights(Scene(camera=camera, sun_zenith=60.0), RADIUS)


def test_weights_are_solid_angles():
    # of the sphere, of half a sphere seen by a fisheye of 180°, of a pyramid of 90° by 90°, a sixth
    sphere = 4.0 * np.pi
    lost = 2.0 * np.pi * (1.0 - np.cos(RADIUS + np.radians(0.75 + 360.0 / 256)))
    found = weights_of("equirectangular", width=256, height=128).sum()
    assert_allclose(found, sphere - lost, rtol=1e-3)
    assert_allclose(weights_of("cubemap", width=768, height=128).sum(), sphere - lost, rtol=1e-3)
    fisheye = weights_of("fisheye", width=256, height=256, field_of_view=180.0).sum()
    assert_allclose(fisheye, sphere / 2.0, rtol=5e-3)
    square = weights_of("perspective", width=256, height=256, field_of_view=90.0).sum()
    assert_allclose(square, sphere / 6.0, rtol=1e-3)


@pytest.mark.parametrize("projection", [n for n, form in PROJECTIONS.items() if not form.parallel])
def test_the_star_s_neighbourhood_is_left_out(projection):
    size = {"equirectangular": (256, 128), "cubemap": (768, 128)}.get(projection, (128, 128))
    camera = Camera(projection=projection, width=size[0], height=size[1], look_zenith=60.0)
    scene = Scene(camera=camera, sun_zenith=60.0)
    weights = metering_weights(scene, RADIUS)
    angle = np.arccos(np.clip(camera.directions() @ scene.sun_direction, -1.0, 1.0))
    seen = np.linalg.norm(camera.directions(), axis=-1) > 0.5
    assert weights[seen & (angle < np.radians(1.0))].size > 0
    assert np.all(weights[seen & (angle < np.radians(1.0))] == 0.0)
    far = seen & (angle > np.radians(1.1) + 1.01 * camera.pixel_angle)
    assert np.all(weights[far] > 0.0)


def test_an_orthographic_picture_shows_no_star_and_leaves_nothing_out():
    # Its lines of sight have one direction, in which the star may stand: the pixels' solid angles
    # add up to the square of the angle that the picture spans.
    camera = Camera(projection="orthographic", width=64, height=64, extent=14e6)
    weights = metering_weights(Scene(camera=camera, sun_zenith=180.0), RADIUS)
    assert_allclose(weights.sum(), np.radians(camera.field_of_view) ** 2, rtol=1e-6)


def test_a_star_of_any_brightness_in_the_picture_changes_nothing():
    camera = Camera(width=320, height=180, look_zenith=60.0)
    scene = Scene(camera=camera, sun_zenith=60.0)
    sky = np.full((180, 320, 3), 5.0)
    angle = np.arccos(np.clip(camera.directions() @ scene.sun_direction, -1.0, 1.0))
    lit = np.where(angle[..., None] < RADIUS, 1e7, sky)
    assert lit.max() == 1e7
    assert scene_exposure(lit, scene, RADIUS) == scene_exposure(sky, scene, RADIUS)


def test_pictures_of_all_sizes_are_exposed_alike():
    # a sky that brightens towards the sun and the horizon
    exposures = []
    for width in (320, 640, 1920):
        camera = Camera(width=width, height=width * 9 // 16, look_zenith=80.0, look_azimuth=30.0)
        scene = Scene(camera=camera, sun_zenith=70.0)
        rays = camera.directions()
        bright = 1.0 / (0.1 + np.abs(rays[..., 2])) + 0.05 / (1.01 - rays @ scene.sun_direction)
        rgb = bright[..., None] * np.array([0.6, 0.8, 1.0])
        exposures.append(scene_exposure(rgb.astype(np.float32), scene, RADIUS))
    assert np.ptp(exposures) < 0.05  # 0.1 EV is the bar


def test_other_sampling_measures_the_same_pixels():
    scene = Scene(camera=dataclasses.replace(Camera(), width=40, height=30))
    whole = metering_weights(scene, 0.0)
    assert_allclose(metering_weights(scene, 0.0, 3)[2, 5], whole[6, 15], rtol=1e-12)


def test_the_disc_of_a_second_light_does_not_count_by_its_own_size() -> None:
    # Pixels within the moon's own radius and the margin of 0.75° have no weight, those beyond do.
    camera = Camera(width=200, height=100, field_of_view=40.0, look_zenith=70.0)
    moon = MoonLight(zenith=70.0, azimuth=5.0, angular_radius=3.0)
    scene = Scene(camera=camera, sun_zenith=120.0, others=(moon,))
    weights = metering_weights(scene, 0.005)
    apart = np.degrees(np.arccos(np.clip(camera.directions() @ moon.direction, -1.0, 1.0)))
    margin = np.degrees(camera.pixel_angle)
    assert not weights[apart < 3.75].any()
    assert (weights[apart > 3.75 + 1.01 * margin] > 0.0).all()
