"""Metering of scenes: solid angles, the star left out, pictures of any size and field of view."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.image.camera_exposure import camera_exposure
from airlight.image.glare import Glare
from airlight.scene import Camera, Scene
from airlight.scene.metering import METERED, metering_weights, scene_exposure
from airlight.scene.moon_light import MoonLight
from airlight.scene.projections import PROJECTIONS

RADIUS = 0.00465
#: Luminance of a white surface in the sunlight above the Earth's air, 128 klx over π and 683 lm/W.
#: [W m⁻² sr⁻¹]
WHITE = 60.0


def weights_of(projection: str, **size: float) -> np.ndarray:
    camera = Camera(projection=projection, look_zenith=90.0, look_azimuth=180.0, **size)
    weights, _ = metering_weights(Scene(camera=camera, sun_zenith=60.0), RADIUS)
    return np.abs(weights)


def test_weights_are_solid_angles():
    # of the sphere, of half a sphere seen by a fisheye of 180°, of a pyramid of 90° by 90°, a sixth
    sphere = 4.0 * np.pi
    found = weights_of("equirectangular", width=256, height=128).sum()
    assert_allclose(found, sphere, rtol=1e-3)
    assert_allclose(weights_of("cubemap", width=768, height=128).sum(), sphere, rtol=1e-3)
    fisheye = weights_of("fisheye", width=256, height=256, field_of_view=180.0).sum()
    assert_allclose(fisheye, sphere / 2.0, rtol=5e-3)
    square = weights_of("perspective", width=256, height=256, field_of_view=90.0).sum()
    assert_allclose(square, sphere / 6.0, rtol=1e-3)


@pytest.mark.parametrize("projection", [n for n, form in PROJECTIONS.items() if not form.parallel])
def test_the_star_s_neighbourhood_is_told_apart(projection):
    size = {"equirectangular": (256, 128), "cubemap": (768, 128)}.get(projection, (128, 128))
    camera = Camera(projection=projection, width=size[0], height=size[1], look_zenith=60.0)
    scene = Scene(camera=camera, sun_zenith=60.0)
    weights, _ = metering_weights(scene, RADIUS)
    angle = np.arccos(np.clip(camera.directions() @ scene.sun_direction, -1.0, 1.0))
    seen = np.linalg.norm(camera.directions(), axis=-1) > 0.5
    near = seen & (angle < np.radians(1.0))
    assert near.any(), "the picture needs pixels that are smaller"
    assert np.all(weights[near] < 0.0)
    far = seen & (angle > np.radians(1.1) + 1.01 * camera.pixel_angle)
    assert np.all(weights[far] > 0.0)


def test_an_orthographic_picture_shows_no_star_and_leaves_nothing_out():
    # Its lines of sight have one direction, in which the star may stand: the pixels' solid angles
    # add up to the square of the angle that the picture spans.
    camera = Camera(projection="orthographic", width=64, height=64, extent=14e6)
    weights, _ = metering_weights(Scene(camera=camera, sun_zenith=180.0), RADIUS)
    assert_allclose(weights.sum(), np.radians(camera.field_of_view) ** 2, rtol=1e-6)


def lit_picture(
    field_of_view: float, sky: float, disc: float, moon: MoonLight | None = None, width: int = 240
) -> tuple[np.ndarray, Scene]:
    """Even sky with an even disc of the sun, or of the moon by night, in the middle."""
    camera = Camera(
        width=width, height=width * 9 // 16, look_zenith=60.0, field_of_view=field_of_view
    )
    others = () if moon is None else (moon,)
    scene = Scene(
        camera=camera, sun_zenith=60.0 if moon is None else 140.0, secondary_lights=others
    )
    towards = scene.lights[-1].direction
    angle = np.arccos(np.clip(camera.directions() @ towards, -1.0, 1.0))
    rgb = np.where(angle[..., None] < scene.lights[-1].radius(RADIUS), disc, sky)
    return np.repeat(rgb, 3, axis=2), scene


def test_a_day_s_sun_in_a_wide_picture_changes_nothing():
    # a sun 250 000 times as bright as its sky, as in clear air: its glare whitens 3 % of 60°
    sunny, scene = lit_picture(60.0, 7.0, 1.8e6)
    sky, _ = lit_picture(60.0, 7.0, 7.0)
    assert sunny.max() == 1.8e6
    wanted = scene_exposure(sky, scene, RADIUS)
    assert_allclose(scene_exposure(sunny, scene, RADIUS), wanted, rtol=1e-12)


@pytest.mark.parametrize("sky", [7.0, 1e-3, 0.0])
@pytest.mark.parametrize("field_of_view", [0.4, 1.0, 2.0, 3.0, 5.0, 10.0, 20.0, 60.0, 120.0])
@pytest.mark.parametrize("disc", [1.8e6, 20.0, 1e10])
def test_a_star_in_view_leaves_a_picture_neither_white_nor_black(sky, field_of_view, disc):
    # a second method: glare itself, drawn. Its white may be a 25th of the picture, and the disc
    rgb, scene = lit_picture(field_of_view, min(sky, disc), disc)
    factor = 2.0 ** scene_exposure(rgb, scene, RADIUS)
    shown = factor * Glare(rgb.astype(np.float32), scene.camera.glare_angle).rows(0, 135)[..., 0]
    of_disc = rgb[..., 0] == disc
    assert np.mean((shown > 1.5) & ~of_disc) < 0.06
    assert factor * disc > 0.3
    if of_disc.mean() > 0.1:  # the subject: its shape is not drowned in white
        assert factor * disc < 1.0


def test_through_a_telescope_the_moon_is_exposed_as_in_photographs():
    # 2500 cd/m²: "looney 11", f/11 at 1/ISO, makes 0.17 of what saturates; pictures are shown
    # brighter than sensors are exposed, a sunlit scene too
    moon = MoonLight(zenith=60.0, azimuth=20.0)
    camera = {"look_azimuth": 20.0}
    rgb, scene = lit_picture(1.0, 0.0, 2500.0 / 683.0, moon)
    scene = dataclasses.replace(scene, camera=dataclasses.replace(scene.camera, **camera))
    angle = np.arccos(np.clip(scene.camera.directions() @ moon.direction, -1.0, 1.0))
    rgb[:] = np.where(angle[..., None] < moon.radius(RADIUS), 2500.0 / 683.0, 0.0)
    looney = camera_exposure(iso=100.0, aperture=11.0, shutter=1.0 / 100.0)
    assert abs(scene_exposure(rgb, scene, RADIUS) - looney) < 2.5


def test_a_zoom_to_the_sun_darkens_without_a_leap():
    # a law: a factor of 1.1 in the field of view is 0.28 EV of the picture's solid angle, by which
    # the glow changes; and for the disc 12 stops are taken away over the 4.3 stops from 1/1200 to
    # 1/60 of the picture, 2.8 times that; the pixels of the rim add to it
    views = 0.8 * 1.1 ** np.arange(39)
    found = [scene_exposure(*lit_picture(one, 7.0, 1.8e6, width=640), RADIUS) for one in views]
    assert found[-1] - found[0] > 10.0
    assert np.all(np.diff(found) > -0.1)
    assert np.max(np.diff(found)) < 3.8 * 0.28 + 0.2


def test_a_telephoto_lens_shows_the_limb_darkening_of_the_sun():
    # a field of view of 3° is what 700 mm have: photographers see the disc's edge and its limb,
    # which has a third of the light of its middle [Neckel & Labs 1994, Sol. Phys. 153, 91]. No part
    # of the disc is white then, and the limb is no darker than a shaded object; by 8° its glow is
    # dim beside the disc, whose edge is seen
    rgb, scene = lit_picture(3.0, 7.0, 1.8e6)
    factor = 2.0 ** scene_exposure(rgb, scene, RADIUS)
    assert 0.5 < factor * 1.8e6 < 1.0
    rgb, scene = lit_picture(8.0, 7.0, 1.8e6)
    factor = 2.0 ** scene_exposure(rgb, scene, RADIUS)
    shown = factor * Glare(rgb.astype(np.float32), scene.camera.glare_angle).rows(0, 135)[..., 0]
    beside = rgb[..., 0] < 1.8e6
    assert factor * 1.8e6 > 1.0
    assert np.mean((shown > 0.5) & beside) < 0.01


def test_a_flight_to_space_ends_at_the_glow_of_the_sun():
    # where the sky is black its darkness no longer matters
    found = []
    for sky in np.geomspace(7.0, 1e-12, 40):
        rgb, scene = lit_picture(120.0, sky, 1.8e6)
        found.append(scene_exposure(rgb, scene, RADIUS))
    rgb, scene = lit_picture(120.0, 0.0, 1.8e6)
    assert_allclose(found[-1], scene_exposure(rgb, scene, RADIUS), atol=0.01)
    assert np.max(np.abs(np.diff(found))) < 1.3  # the sky itself falls by 1.1 EV a step


def test_the_glint_of_the_sun_on_the_sea_is_a_highlight():
    # bright haze, sea a quarter of it, and a glint of forty times the sea on a 15th of the picture:
    # a photographer by "sunny 16" shows a white card that faces the sun as 0.7 to 1.4, half a stop
    # about white, and what is white is the glint alone
    camera = Camera(width=160, height=90, look_zenith=90.0, look_azimuth=120.0)
    scene = Scene(camera=camera, sun_zenith=70.0)
    rgb = np.full((90, 160, 3), 22.0)
    rgb[45:] = 6.0
    rgb[45:, 70:91] = 240.0
    factor = 2.0 ** scene_exposure(rgb, scene, RADIUS, WHITE)
    assert 0.7 < factor * WHITE < 1.4
    assert np.mean(factor * rgb > 1.0) < 0.07
    assert factor * 22.0 > 0.2  # no dull day: the haze is brighter than a grey card


def test_a_sun_on_the_horizon_through_a_telephoto_lens_leaves_colour():
    # of a red sky 1.5 times as bright below as above, with the sun and its glare drawn, a channel
    # saturates on the disc and an eighth of the picture beside it: the glare may have 1.5 times
    # white, which has 1.8 times its light in red, on a 25th of the picture, and falls as 1/θ²
    for field_of_view in (3.0, 5.0, 10.0, 20.0):
        rgb, scene = lit_picture(field_of_view, 1.6, 2500.0)
        red = rgb * np.linspace(0.8, 1.2, rgb.shape[0])[:, None, None] * [2.4, 0.66, 0.25]
        factor = 2.0 ** scene_exposure(red, scene, RADIUS, WHITE)
        lens = Glare(red.astype(np.float32), scene.camera.glare_angle)
        shown = factor * lens.rows(0, 135).max(axis=-1)
        assert np.mean((shown > 1.0) & (rgb[..., 0] < 2500.0)) < 0.12


def disc(radius: float, lit: float = 2.0, width: int = METERED, dark: float = 0.0) -> np.ndarray:
    """Coverage of the pixels of a picture by a disc, or by the crescent of a shifted disc.

    Parameters
    ----------
    radius : float
        Radius over half the width. [1]
    lit : float
        Thickness of the crescent, in radii; 2 for the whole disc. [1]
    dark : float
        Light of the rest of the disc over that of the crescent. [1]
    """
    fine, height = 4, width * 9 // 16
    across = (np.arange(fine * width) + 0.5) / (0.5 * fine * width) - 1.0
    down = ((np.arange(fine * height) + 0.5) / (0.5 * fine * height) - 1.0) * 9.0 / 16.0
    x, y = np.meshgrid(across - 0.003, down - 0.002)
    inside = np.hypot(x, y) < radius
    shade = np.hypot(x - lit * radius, y) < radius
    light = np.where(inside & ~shade, 1.0, np.where(inside, dark, 0.0))
    return light.reshape(height, fine, width, fine).mean(axis=(1, 3))


SPACE = Scene(altitude=1e9, camera=Camera(width=METERED, height=72, look_zenith=180.0))


def space_exposure(light: np.ndarray) -> float:
    """Exposure of a picture from space, of light over that of white."""
    rgb = WHITE * np.repeat(light[..., None], 3, axis=2)
    return scene_exposure(rgb, SPACE, RADIUS, WHITE)


def test_full_venus_is_bright_and_the_moon_is_not_white():
    # geometric albedos of the discs at full phase [Mallama et al. 2017, Icarus 282, 19, V: 0.689;
    # Lane & Irvine 1973, AJ 78, 267: 0.13]: Venus nearly white, the Moon a mid-grey of 18 to 35 %
    venus = 0.689 * 2.0 ** space_exposure(0.689 * disc(0.3)) * WHITE
    moon = 0.13 * 2.0 ** space_exposure(0.13 * disc(0.3)) * WHITE
    assert 0.6 < venus < 0.8
    assert 0.18 < moon < 0.35


def test_crescents_of_all_thicknesses_are_exposed_for_their_light():
    # the same light, whether the crescent has a 10th or a 100th of the picture, and whether the
    # dark side is black, or lit by twilight: within half a stop, by which edges dilute it
    thick = space_exposure(0.3 * disc(0.5, lit=0.4))
    for lit in (0.2, 0.1, 0.05):
        for dark in (0.0, 1e-5, 1e-3):
            thin = 0.3 * disc(0.5, lit=lit, dark=dark)
            assert abs(space_exposure(thin) - thick) < 0.5, (lit, dark)


@pytest.mark.parametrize("power", [3.0, 5.0])
def test_the_bright_limb_of_a_crescent_is_not_white(power):
    # What forward scattering does to Titan and the Earth: light rises steeply from the terminator
    # to the limb. At most 2 % of the lit part exceed what a display shows, and the limb is no
    # darker than a mid-grey.
    shape = disc(0.6, lit=0.6)
    inward = np.cumsum(shape > 0.0, axis=1) - 1
    inward = inward / np.maximum(inward.max(axis=1, keepdims=True) + 1, 1)
    light = 0.6 * shape * (0.01 + 0.99 * (1.0 - inward) ** power)
    shown = (light * 2.0 ** space_exposure(light) * WHITE)[shape > 0.5]
    assert np.mean(shown > 1.0) < 0.02
    assert np.quantile(shown, 0.96) > 0.3


def test_a_disc_that_grows_from_a_dot_to_the_frame_is_exposed_without_a_leap():
    # steps of a tenth, from a twentieth of a pixel, which samples miss, to the whole picture: the
    # light is the same; a sample that hits the disc first may show a stop, as any new light, and
    # the share of black space 0.74 EV
    radii = 0.05 / 64.0 * 1.1 ** np.arange(85)
    assert radii[-1] > 1.2
    for albedo in (0.1, 0.3, 0.7):
        found = np.array([space_exposure(albedo * disc(one)) for one in radii])
        assert np.max(np.abs(np.diff(found))) < 1.0
        assert np.ptp(found) < 1.75


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
    whole, _ = metering_weights(scene, 0.0)
    assert_allclose(metering_weights(scene, 0.0, 3)[0][2, 5], whole[6, 15], rtol=1e-12)


def test_the_disc_of_a_second_light_does_not_count_by_its_own_size() -> None:
    # Pixels within the moon's own radius and the margin of 0.75° are its own, those beyond are not.
    camera = Camera(width=200, height=100, field_of_view=40.0, look_zenith=70.0)
    moon = MoonLight(zenith=70.0, azimuth=5.0, angular_radius=3.0)
    scene = Scene(camera=camera, sun_zenith=120.0, secondary_lights=(moon,))
    weights, light = metering_weights(scene, 0.005)
    apart = np.degrees(np.arccos(np.clip(camera.directions() @ moon.direction, -1.0, 1.0)))
    margin = np.degrees(camera.pixel_angle)
    assert np.all((weights[apart < 3.75] < 0.0) & (light[apart < 3.75] == 1))
    assert (weights[apart > 3.75 + 1.01 * margin] > 0.0).all()
