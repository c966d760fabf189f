"""Pictures of several bodies, against pictures of one planet and against laws."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import airlight
from airlight.errors import ParameterError
from airlight.image.glare import Glare
from airlight.image.xyz import luminance
from airlight.physics.spectra.limb_darkening import solar_darkening
from airlight.render.render_scene import render_scene
from airlight.render.render_system import render_system
from airlight.render.scene_lights import SceneLights
from airlight.scene import Camera, Scene
from airlight.scene.local_ground import local_ground
from airlight.scene.system import System, load_system
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.milky_way import milky_way_radiance
from airlight.scene.system.stars import stars
from airlight.scene.system.vectors import unit
from airlight.scene.system.viewpoint import SceneObserver, View

NM = (680.0, 550.0, 440.0)
SUN = airlight.Star(spectrum="astm-g173")
EARTH = Body(name="earth", planet="earth")
MOON = Body(name="moon", radius=1737.4e3, reflection="moon", position=(3.844e8, 0.0, 0.0))
SIZE = {"width": 60, "height": 40}


def system(*bodies: Body, lights: tuple[Light, ...], observer: SceneObserver, view: View) -> System:
    return System(name="x", bodies=bodies, lights=lights, observer=observer, view=view)


def rendered(scene: System, **options: object) -> np.ndarray:
    return render_system(scene, **(SIZE | {"wavelengths": NM, "quality": "preview"} | options)).rgb


@pytest.mark.parametrize(("altitude", "polariser"), [(2.0, 35.0), (400e3, None)])
def test_a_planet_alone_is_drawn_as_render_draws_it(
    altitude: float, polariser: float | None
) -> None:
    # The sun 10 degrees above the horizon in the east; the camera to the south-east, rolled.
    up, east = np.array([1.0, 0.0, 0.0]), np.array([0.0, 1.0, 0.0])
    sun = np.sin(np.radians(10.0)) * up + np.cos(np.radians(10.0)) * east
    got = rendered(system(
        EARTH, lights=(Light(star=SUN, direction=tuple(sun)),),
        observer=SceneObserver(body="earth", altitude=altitude),
        view=View(
            look_zenith=95.0, look_bearing=135.0, roll=20.0, field_of_view=70.0,
            polariser=polariser,
        ),
    ))  # fmt: skip
    # Azimuth 45: to the right of the sun, which stands at bearing 90.
    scene = Scene(
        camera=Camera(
            **SIZE, field_of_view=70.0, look_zenith=95.0, look_azimuth=45.0, roll=20.0,
            polariser=polariser,
        ),
        altitude=altitude, sun_zenith=80.0, sun_azimuth=90.0, ground="detailed",
    )  # fmt: skip
    planet = local_ground(airlight.load_planet("earth"), latitude=0.0, longitude=0.0,
                          altitude=altitude)  # fmt: skip
    solution = airlight.solve(planet, NM, quality="preview")
    expected = airlight.render(solution, scene).rgb
    # The star's disc is rendered line by line here, and has a dark rim.
    disc = expected.max(axis=-1) > 20.0 * np.median(expected)
    assert_allclose(got[~disc], expected[~disc], rtol=1e-3, atol=1e-6 * np.median(expected))


def test_a_filter_halves_the_light_of_moons_and_stars() -> None:
    # Unpolarised light, whatever the axis: a half-lit moon, a star's disc and the points of stars.
    scene = System(
        name="x", bodies=(MOON,), lights=(Light(star=SUN, direction=(0.2, 1.0, 0.0)),),
        observer=SceneObserver(position=(3.7e8, 0.0, 0.0)), stars=True,
        view=View(direction=(1.0, 0.4, 0.0), field_of_view=120.0),
    )  # fmt: skip
    open_, *behind = (
        rendered(replace(scene, view=replace(scene.view, polariser=angle)))
        for angle in (None, 0, 70)
    )
    assert np.count_nonzero(open_) > 50
    for one in behind:
        assert_allclose(one, 0.5 * open_, rtol=1e-6)


def test_a_filter_is_refused_where_a_moons_shadow_falls() -> None:
    scene = load_system("solar-eclipse-2017")
    turned = replace(scene, view=replace(scene.view, polariser=30.0))
    with pytest.raises(ParameterError, match=r"camera\.polariser is 30\.0; allowed: none where a"):
        rendered(turned, width=8, height=6)


def test_the_full_moons_light_is_that_of_its_picture() -> None:
    # Second method: the radiance of the picture over the pixels' solid angles, against the
    # magnitude by which the Moon lights a landscape.
    scene = system(
        MOON, EARTH, lights=(Light(star=SUN, direction=(-1.0, 0.05, 0.0)), Light(body="moon")),
        observer=SceneObserver(position=(7e7, 0.0, 0.0)),
        view=View(look_at="moon", field_of_view=1.0),
    )  # fmt: skip
    rgb = rendered(scene, width=80, height=80, wavelengths=NM)
    eye = scene.eye
    lights = SceneLights(scene, np.array(NM), {})
    source = lights.source(scene.lights[1], eye)
    pixel = np.radians(1.0) / 80.0
    total = luminance(rgb.sum(axis=(0, 1))) * pixel**2
    colors = lights.source(scene.lights[0], eye).colors() / lights.source(
        scene.lights[0], eye).irradiance[:, None]  # fmt: skip
    assert_allclose(total, luminance(source.irradiance @ colors), rtol=0.01)


def test_a_body_in_front_hides_and_one_behind_is_hidden() -> None:
    lights = (Light(star=SUN, direction=(-1.0, 0.0, 0.0)),)
    near = Body(name="near", radius=1e6, albedo=0.5, position=(1e8, 0.0, 0.0))
    far = Body(name="far", radius=2e6, albedo=0.05, position=(2e8, 0.0, 0.0))
    view = View(direction=(1.0, 0.0, 0.0), field_of_view=1.6)
    observer = SceneObserver(position=(0.0, 0.0, 0.0))
    both = rendered(system(near, far, lights=lights, observer=observer, view=view))
    swapped = rendered(system(far, near, lights=lights, observer=observer, view=view))
    assert_allclose(both, swapped)
    alone = rendered(system(near, lights=lights, observer=observer, view=view))
    assert_allclose(both[18:22, 28:32], alone[18:22, 28:32], rtol=1e-6)
    # The nearer one throws its shadow on the other: its sunlit side is dark behind it.
    assert both.max() > 0.0


def test_a_moon_seen_through_the_air_is_dimmed_by_its_transmittance() -> None:
    # A full Moon of dark dust, which is uniform, 20 degrees high by night.
    up, south = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, -1.0])
    apart = np.sin(np.radians(20.0)) * up + np.cos(np.radians(20.0)) * south
    moon = Body(name="moon", radius=1737.4e3, position=tuple(3.844e8 * apart))
    lights = (Light(star=SUN, direction=tuple(np.array([0.0, 0.06, 0.0]) - apart)),)
    view = View(look_at="moon", field_of_view=0.2)
    dimmer, bare = (
        rendered(system(*bodies, lights=lights, observer=observer, view=view), width=4, height=4)
        for bodies, observer in (
            ((EARTH, moon), SceneObserver(body="earth", altitude=2.0)),
            ((moon,), SceneObserver(position=(6378e3, 0.0, 0.0))),
        )
    )
    solution = airlight.solve(airlight.load_planet("earth"), NM, quality="preview")
    zenith = np.degrees(np.arccos(unit(moon.centre - [6378e3, 0.0, 0.0], "x") @ up))
    dimmed = solution.transmittance(altitude=2.0, view_zenith=zenith).values
    lights_at = SceneLights(system(moon, lights=lights, observer=SceneObserver(position=(0, 0, 0)),
                                   view=view), np.array(NM), {})  # fmt: skip
    colors = lights_at.seen_from(lights[0], moon).colors() * moon.albedos(NM)[:, None]
    expected = (dimmed @ colors) / colors.sum(axis=0)
    assert_allclose((dimmer / bare).mean(axis=(0, 1)), expected, rtol=0.01)


def test_a_stars_disc_has_its_irradiance_and_its_dark_rim() -> None:
    scene = system(
        Body(name="rock", radius=1.0, position=(0.0, 1e6, 0.0)),
        lights=(Light(star=SUN, direction=(1.0, 0.0, 0.0)),),
        observer=SceneObserver(position=(0.0, 0.0, 0.0)),
        view=View(look_at="sun", field_of_view=0.7),
    )  # fmt: skip
    rgb = rendered(scene, width=70, height=70)
    lights = SceneLights(scene, np.array(NM), {})
    source = lights.source(scene.lights[0], scene.eye)
    pixel = np.radians(0.7) / 70.0
    assert_allclose(rgb.sum(axis=(0, 1)) * pixel**2, source.colors().sum(axis=0), rtol=5e-3)
    centre, rim = rgb[35, 35], rgb[35, 35 + 25]
    expected = solar_darkening([550.0])[0] @ np.sqrt(1 - (0.255 / 0.2665) ** 2) ** np.arange(6)
    assert_allclose(rim[1] / centre[1] * solar_darkening([550.0])[0].sum(), expected, rtol=0.1)
    assert rim[2] / centre[2] < rim[0] / centre[0]  # redder towards the rim


def test_two_suns_are_the_sum_of_each() -> None:
    towards = ((0.2, 1.0, 0.0), (0.3, 0.9, 0.4))
    suns = [Light(name=f"s{k}", star=SUN, direction=d) for k, d in enumerate(towards)]
    observer = SceneObserver(body="earth", altitude=2.0)
    view = View(look_zenith=60.0, look_bearing=0.0, field_of_view=60.0)
    pictures = [
        rendered(system(EARTH, lights=tuple(some), observer=observer, view=view))
        for some in (suns, suns[:1], suns[1:])
    ]
    # Lamps of towns do not shine twice.
    assert_allclose(pictures[0], pictures[1] + pictures[2], rtol=2e-3,
                    atol=1e-4 * pictures[0].max())  # fmt: skip


def test_moonlight_is_a_faint_day() -> None:
    # A full Moon at the sun's place: the same sky, 4e5 times darker and redder by the Moon's
    # own colour.
    towards = np.array([0.6, 0.8, 0.0])
    place = tuple(3.844e8 * towards)
    moon = Body(name="moon", radius=1737.4e3, reflection="moon", position=place)
    observer = SceneObserver(body="earth", altitude=2.0)
    view = View(look_zenith=30.0, look_bearing=270.0, field_of_view=60.0)
    day = rendered(system(EARTH, lights=(Light(star=SUN, direction=tuple(towards)),),
                       observer=observer, view=view))  # fmt: skip
    night = rendered(system(EARTH, moon, observer=observer, view=view, lights=(
        Light(star=SUN, direction=tuple(-towards + np.array([0.0, 0.0, 0.05]))),
        Light(body="moon"),
    )))  # fmt: skip
    ratio = day[:20].mean(axis=(0, 1)) / night[:20].mean(axis=(0, 1))
    assert_allclose(ratio[1], 4.0e5, rtol=0.25)
    assert ratio[0] < ratio[1] < ratio[2]


def test_options_out_of_range_are_refused() -> None:
    scene = system(
        MOON, lights=(Light(star=SUN, direction=(-1.0, 0.0, 0.0)),),
        observer=SceneObserver(position=(0.0, 0.0, 0.0)), view=View(look_at="moon"),
    )  # fmt: skip
    with pytest.raises(ParameterError, match=r"samples is 17; allowed: 1 to 16"):
        render_system(scene, samples=17)
    with pytest.raises(ParameterError, match=r"wavelengths"):
        render_system(scene, wavelengths=(550.0,))


def test_stars_have_their_light_and_their_place() -> None:
    # Orion's belt without air: all light of the catalogue and of the Milky Way within the picture,
    # and Alnilam, HIP 26311 at 84.05338, -1.20192 degrees, in its centre.
    towards = direction_to(84.05338, -1.20192)
    rock = Body(name="rock", radius=1.0, position=tuple(-1e6 * towards))
    scene = replace(
        system(rock, lights=(Light(star=SUN, direction=tuple(-towards)),),
               observer=SceneObserver(position=(0.0, 0.0, 0.0)),
               view=View(direction=tuple(towards), field_of_view=20.0)),
        stars=True,
    )  # fmt: skip
    rgb = rendered(scene, width=81, height=81)
    row, column = np.unravel_index(np.argmax(rgb[36:45, 36:45, 1]), (9, 9))
    assert (row, column) == (4, 4)
    lights = SceneLights(scene, np.array(NM), {})
    source = lights.source(scene.lights[0], scene.eye)
    weights = source.colors() / source.irradiance[:, None]
    local = stars().directions @ scene.camera_axes.T
    side = np.tan(np.radians(10.0)) * 0.98
    inside = (local[:, 2] > 0) & (np.abs(local[:, :2] / local[:, 2:]).max(axis=1) < side)
    expected = (stars().irradiances(NM)[inside] @ weights).sum(axis=0)
    x, y = (np.arange(81) + 0.5 - 40.5) / 40.5 * np.tan(np.radians(10.0)), 0
    solid = (np.tan(np.radians(10.0)) / 40.5) ** 2 / (1.0 + x[:, None] ** 2 + x**2) ** 1.5 + y
    across, down = np.meshgrid(x, x)
    lines = np.stack([across, -down, np.ones_like(x * across)], axis=-1) @ scene.camera_axes
    lines = (lines / np.linalg.norm(lines, axis=-1, keepdims=True)).reshape(-1, 3)
    expected += solid.ravel() @ milky_way_radiance(lines, NM) @ weights
    total = (rgb * solid[..., None]).sum(axis=(0, 1))
    assert_allclose(total, expected, rtol=0.03)


def test_a_star_is_lifted_dimmed_and_hidden() -> None:
    # One star truly on the horizon is seen half a degree higher, red; behind a body it is gone.
    up = direction_to(84.05338 + 90.0, 0.0)
    radius = airlight.load_planet("earth").bottom_radius
    towards = direction_to(84.05338, -1.20192)
    earth = Body(name="earth", planet="earth", position=tuple(-radius * up))
    scene = system(
        earth, lights=(Light(star=SUN, direction=tuple(-up)),),
        observer=SceneObserver(position=tuple(2.0 * up)),
        view=View(direction=tuple(towards), up=tuple(up), field_of_view=2.0),
    )  # fmt: skip
    dark = rendered(scene, width=40, height=40)
    lit = rendered(replace(scene, stars=True), width=40, height=40) - dark
    row = float((lit[..., 0].sum(axis=1) @ np.arange(40)) / lit[..., 0].sum())
    assert 0.45 < (19.5 - row) * 2.0 / 40.0 < 0.65
    light = lit.sum(axis=(0, 1))
    assert light[0] > 20.0 * light[2]
    rock = Body(name="rock", radius=100.0, position=tuple(2.0 * up + 3000.0 * towards))
    with pytest.raises(ParameterError, match=r"position is .* m from earth.; allowed: at least"):
        rendered(replace(scene, bodies=(earth, rock)))


def direction_to(ascension: float, declination: float) -> np.ndarray:
    a, d = np.radians([ascension, declination])
    return np.array([np.cos(d) * np.cos(a), np.cos(d) * np.sin(a), np.sin(d)])


@pytest.mark.parametrize(("altitude", "zenith"), [(2.0, 90.1), (400e3, 109.95)])
def test_a_low_light_looked_at_is_in_the_middle_of_the_picture(
    altitude: float, zenith: float
) -> None:
    # a second method: the disc as rendered, refracted ray by ray. 0.05°, two pixels, for its
    # flattening and the loss of light towards its lower rim; without refraction it is 0.4° off
    turn = np.radians(zenith)
    lights = (Light(star=SUN, direction=(np.cos(turn), np.sin(turn), 0.0)),)
    observer = SceneObserver(body="earth", altitude=altitude)
    view = View(look_at="sun", field_of_view=1.5)
    bright = luminance(rendered(system(EARTH, lights=lights, observer=observer, view=view)))
    planet = airlight.load_planet("earth")
    angle, _ = airlight.look_at(
        "sun", altitude=altitude, sun_zenith=zenith, bottom_radius=planet.bottom_radius,
        planet=planet,
    )  # fmt: skip
    camera = Camera(**SIZE, look_zenith=angle, field_of_view=1.5)
    scene = Scene(altitude=altitude, sun_zenith=zenith, camera=camera)
    alone = render_scene(planet, scene, wavelengths=NM, quality="preview").rgb
    for found in (bright, luminance(alone)):
        row, column = np.nonzero(found > 0.3 * found.max())
        assert abs(0.5 * (row.min() + row.max()) - 19.5) <= 2.0
        assert abs(0.5 * (column.min() + column.max()) - 29.5) <= 1.0


@pytest.mark.parametrize("field_of_view", [1.0, 3.0, 12.0, 60.0])
def test_a_star_limits_the_exposure_of_a_scene(field_of_view: float) -> None:
    # in front of black space: the disc is seen, and its glare whitens less than a 25th of the
    # picture; without the sun in view the exposure is that of what is there, a moon in its light
    scene = system(
        MOON, lights=(Light(star=SUN, direction=(0.0, 1.0, 0.0)),),
        observer=SceneObserver(position=(0.0, 0.0, 0.0)),
        view=View(look_at="sun", field_of_view=field_of_view),
    )  # fmt: skip
    frame = render_system(scene, **SIZE, wavelengths=NM, quality="preview")
    bright = luminance(frame.rgb.astype(float))
    shown = 2.0**frame.exposure * luminance(Glare(frame.rgb, frame.pixel_angle).rows(0, 40))
    of_disc = bright > 0.01 * bright.max()
    assert shown.max() > 0.5
    assert np.mean((shown > 1.5) & ~of_disc) < 0.06
    away = replace(scene, view=View(look_at="moon", field_of_view=field_of_view))
    assert render_system(away, **SIZE, wavelengths=NM, quality="preview").scene is None
