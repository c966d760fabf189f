"""Maps against the solution that they show, and each mode against the others."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet
from airlight.engines.environment.consumers import CONSUMERS
from airlight.engines.environment.disc import enu_from_local
from airlight.engines.environment.environment_map import EnvironmentMap, environment_map
from airlight.engines.environment.gamut import grey_of
from airlight.engines.environment.ground import grey_ground, horizon_cosine
from airlight.engines.environment.texels import texel_solid_angles, texels_of
from airlight.errors import ParameterError
from airlight.render.solve_planet import solve_planet

NM = (440.0, 500.0, 560.0, 620.0)
BEARING = 215.0
UP = np.array([0.0, 0.0, 1.0])
Made = Callable[..., EnvironmentMap]


def solved_irradiance(planet: str, zenith: float, quality: str = "preview") -> np.ndarray:
    """Linear sRGB of sun and sky on level ground, by the solution."""
    solution = solve_planet(grey_ground(load_planet(planet)), NM, quality)
    found = solution.irradiance(altitude=2.0, sun_zenith=zenith)
    weights = solution.lights[0].colors() / solution.lights[0].irradiance[:, None]
    return np.asarray((found.direct.values + found.diffuse.values) @ weights)


@pytest.mark.parametrize("zenith", [20.0, 75.0, 89.0])
def test_the_map_lights_level_ground_as_the_solution_does(made: Made, zenith: float) -> None:
    # the table of the solver's irradiances, against the radiances of every direction. At the
    # quality preview they differ by 0.2 % at 85° and 1.6 % at 89°, at the default by 0.6 % at most;
    # of colours out of gamut the luminance
    wanted = solved_irradiance("earth", zenith)
    whole = made(sun="light", zenith=zenith, width=256)
    found = whole.irradiance(UP) + sum(one.irradiance * one.direction[2] for one in whole.discs)
    assert_allclose(grey_of(found), grey_of(wanted), rtol=0.02)
    if zenith < 80.0:
        assert_allclose(found, wanted, rtol=0.005)


@pytest.mark.parametrize("consumer", ["blender", "pbrt", "dome"])
@pytest.mark.parametrize("width", [32, 256])
def test_a_disc_in_the_map_has_the_irradiance_of_the_disc_beside_it(
    made: Made, consumer: str, width: int
) -> None:
    # 32 texels around are 11° each, 21 times the disc; 256 are 1.4°
    beside = made(consumer, "light", width=width)
    inside = made(consumer, "include", width=width)
    solid = texel_solid_angles(inside.scene.camera)[..., None]
    (disc,) = beside.discs
    added = np.sum((inside.rgb.astype(float) - beside.rgb) * solid, axis=(0, 1))
    assert_allclose(added, disc.irradiance, rtol=1e-5)


def test_the_disc_s_irradiance_is_that_of_a_star_through_the_air(made: Made) -> None:
    # second method: transmittance along the line to its centre. It differs by the light's path
    # across the disc, 1e-4 at 50°, and by the drawn disc's rim, 1e-3
    (disc,) = made(sun="light", zenith=50.0).discs
    solution = solve_planet(grey_ground(load_planet("earth")), NM, "preview")
    elevation = float(np.degrees(np.arcsin(disc.direction[2])))
    transmittance = solution.transmittance(altitude=2.0, view_zenith=90.0 - elevation).values
    assert_allclose(disc.irradiance, transmittance @ solution.lights[0].colors(), rtol=2e-3)
    assert_allclose(disc.angular_diameter, 0.533, atol=0.001)
    # raised by refraction: at 40° of altitude 0.019° (Bennett's formula: 1.17')
    assert_allclose(elevation - 40.0, 0.019, atol=0.002)


@pytest.mark.parametrize("consumer", ["blender", "mitsuba", "three", "unity", "pbrt", "dome"])
def test_the_sun_is_brightest_at_its_bearing(made: Made, consumer: str) -> None:
    shown = made(consumer)
    row, column = np.unravel_index(np.argmax(shown.rgb.sum(axis=-1)), shown.rgb.shape[:2])
    zenith, turn = np.radians(50.0), np.radians(BEARING)
    enu = np.array([np.sin(zenith) * np.sin(turn), np.sin(zenith) * np.cos(turn), np.cos(zenith)])
    wanted = texels_of(shown.scene.camera, (enu @ enu_from_local(BEARING))[None])
    assert abs(int(wanted[0][0]) - row) <= 1
    assert abs(int(wanted[1][0]) - column) <= 1


def test_every_map_shows_the_same_sky(made: Made) -> None:
    # a vertical wall that faces the sun's side, and one that faces north-east
    turn = np.radians(BEARING)
    for normal in (np.array([np.sin(turn), np.cos(turn), 0.0]), np.array([1.0, 1.0, 0.0]) / 2**0.5):
        reference = made("blender", "exclude").irradiance(normal)
        for consumer in ("mitsuba", "three", "unity", "pbrt"):
            assert_allclose(made(consumer, "exclude").irradiance(normal), reference, rtol=0.005)


def test_without_the_sun_no_texel_has_its_disc(made: Made) -> None:
    assert_array_equal(made(sun="exclude").rgb, made(sun="light").rgb)
    assert made(sun="exclude").rgb.max() < 0.01 * made(sun="include").rgb.max()


def test_a_setting_sun_is_in_gamut_and_keeps_its_luminance(made: Made) -> None:
    (disc,) = made(sun="light", zenith=89.5).discs
    assert disc.light.min() >= 0.0
    assert disc.moved[2] > 0.0  # its blue was negative
    assert abs(grey_of(disc.moved)) < 1e-6 * grey_of(disc.irradiance)
    assert made(sun="include", zenith=89.5).rgb.min() >= 0.0


def test_a_sun_far_below_the_horizon_is_no_light(made: Made) -> None:
    assert made(sun="light", zenith=95.0).discs == ()
    assert made(sun="light", zenith=95.0).irradiance(UP).min() > 0.0


def test_half_of_a_setting_sun_has_less_than_all_of_it(made: Made) -> None:
    # refraction lifts by 0.5°: at a true 90.5° about half of the disc is above the horizon
    whole, half, none = (made(sun="light", zenith=z).discs for z in (89.9, 90.45, 91.2))
    assert none == ()
    assert 0.0 < half[0].illuminance < 0.7 * whole[0].illuminance


def test_grounds(made: Made) -> None:
    grey, black = made(ground="neutral"), made(ground="black")
    below = np.asarray(black.scene.camera.directions()[..., 2] < -0.1)
    assert_array_equal(black.rgb[below], 0.0)
    above = ~below & np.asarray(black.scene.camera.directions()[..., 2] > 0.1)
    # Earth's own ground and its grey light the sky alike, to the colour of the ground's light
    assert_allclose(black.rgb[above], grey.rgb[above], rtol=0.02)
    # grey ground in sunlight has the sun's colour but for the sky's part: no desert
    lower = grey.rgb[below].mean(axis=0)
    sun = grey.discs[0].irradiance * grey.discs[0].direction[2]
    assert_allclose(lower / lower.sum(), sun / sun.sum(), atol=0.05)


def test_grey_ground_reflects_what_the_eye_sees_of_its_own() -> None:
    own = load_planet("earth")
    grey = grey_ground(own)
    low, high = own.ground.albedos([450.0, 650.0])
    assert low < grey.ground.albedo < high
    assert (grey.ground.map, grey.ground.lights, grey.ground.clouds) == (None, None, None)


def test_the_horizon_of_black_ground_is_the_line_of_sight_s() -> None:
    # straight light on a sphere: cos of the dip is R / (R + h)
    planet = load_planet("earth-atmosphere-plus")
    solution = solve_planet(planet, (450.0, 550.0, 650.0), "preview")
    for altitude in (0.0, 1000.0, 400e3):
        radius = planet.bottom_radius
        wanted = -np.sqrt(1.0 - (radius / (radius + altitude)) ** 2)
        assert_allclose(horizon_cosine(solution, altitude), wanted, atol=1e-6)


def test_a_second_sun_and_a_moon_have_discs_of_their_own() -> None:
    from airlight.scene.moon_light import MoonLight
    from airlight.scene.star_light import StarLight

    others = (
        MoonLight(zenith=40.0, azimuth=90.0, phase=20.0),
        StarLight(zenith=60.0, azimuth=-90.0, star=StarLight.black_body(3500.0, 0.4)),
    )
    camera = Camera(projection="equirectangular", width=64, height=32)
    scene = Scene(
        altitude=2.0, sun_zenith=96.0, sun_azimuth=100.0, camera=camera, secondary_lights=others
    )
    planet = load_planet("earth-atmosphere-plus")
    shown = environment_map(
        planet, scene, CONSUMERS["usd"], sun="light", placed=False, wavelengths=NM,
        quality="preview",
    )  # fmt: skip
    assert [one.name for one in shown.discs] == ["moon", "second star"]
    for one, bearing in zip(shown.discs, (190.0, 10.0), strict=True):
        turn = np.degrees(np.arctan2(one.direction[0], one.direction[1])) % 360.0
        assert_allclose(turn, bearing, atol=0.3)  # the moon's light is towards its lit side
    assert_allclose(shown.discs[1].angular_diameter, 0.8, rtol=1e-6)


def test_unknown_words_are_refused() -> None:
    scene = Scene(camera=Camera(projection="equirectangular", width=8, height=4))
    planet, blender = load_planet("earth"), CONSUMERS["blender"]
    with pytest.raises(ParameterError, match="include, exclude, light"):
        environment_map(planet, scene, blender, sun="both")
    behind = replace(scene, camera=replace(scene.camera, polariser=30.0))
    with pytest.raises(ParameterError, match=r"camera\.polariser does not apply"):
        environment_map(planet, behind, blender)
    with pytest.raises(ParameterError, match="neutral, map, black"):
        environment_map(planet, scene, blender, ground="white")
    with pytest.raises(ParameterError, match="twice as wide"):
        environment_map(planet, replace(scene, camera=Camera(width=8, height=8)), blender)
