"""Moon and second star in a planet's picture: sums, moonlight, lamps, what is left out."""

from __future__ import annotations

import copy
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, MoonLight, ParameterError, Scene, StarLight, load_planet, solve
from airlight.image.xyz import luminance
from airlight.physics.optics.moon_phase import earthlight, moon_phase
from airlight.render import render
from airlight.render.pixels.scenes_by_light import scenes_by_light
from airlight.scene.light_position import LightPosition
from airlight.solver.moments.solution import MomentsSolution

NM = (680.0, 550.0, 440.0)
CAMERA = Camera(width=64, height=36, look_zenith=78.0, look_azimuth=20.0)
SEA = Scene(altitude=3e3, sun_zenith=75.0, latitude=20.0, longitude=-40.0, camera=CAMERA)
RED = StarLight(zenith=60.0, azimuth=50.0, star=StarLight.black_body(3500.0, 1.0))


@pytest.fixture(scope="module")
def earth() -> MomentsSolution:
    return solve(load_planet("earth"), NM, "preview")


def test_two_suns_are_the_sum_of_their_pictures(earth: MomentsSolution) -> None:
    # Linearity. The second alone: the same solution under its own star, turned to it.
    both = render(earth, replace(SEA, secondary_lights=(RED,))).rgb
    second = earth.with_light(RED.source(earth.lights))
    alone = render(second, SEA.with_light(RED)).rgb
    assert_allclose(both, render(earth, SEA).rgb + alone, rtol=2e-6)
    assert np.median(alone) > 0.03 * np.median(both)


def test_a_second_light_in_the_same_place_doubles_the_picture(earth: MomentsSolution) -> None:
    # Linearity again, disc and ground included; the sea there has no lamps.
    twice = render(earth, replace(SEA, secondary_lights=(LightPosition(zenith=75.0),))).rgb
    assert_allclose(twice, 2.0 * render(earth, SEA).rgb, rtol=2e-6)


def test_a_full_moon_s_sky_is_a_day_four_hundred_thousand_times_darker(
    earth: MomentsSolution,
) -> None:
    # Krisciunas & Schaefer (1991) at 7°, where the opposition surge ends: -12.55 mag, the sun
    # -26.74: 14.19 mag are a factor 4.7e5 in V, by 550 nm and the eye's weights 5 %; and the Moon's
    # B - V is 0.27 mag larger.
    camera = Camera(width=16, height=9, look_zenith=50.0, look_azimuth=140.0)
    day = render(earth, Scene(camera=camera, sun_zenith=45.0)).rgb
    moon = MoonLight(zenith=45.0, azimuth=0.0, phase=7.0)
    night = render(earth, Scene(camera=camera, sun_zenith=140.0, secondary_lights=(moon,))).rgb
    ratio = luminance(day.astype(float)) / luminance(night.astype(float))
    assert_allclose(ratio, 10.0 ** (0.4 * (14.01 + 0.182)), rtol=0.05)
    redder = (night[..., 0] / night[..., 2]) / (day[..., 0] / day[..., 2])
    assert (redder > 1.1).all()


def test_half_moon_lights_a_tenth_of_a_moon_past_its_surge(earth: MomentsSolution) -> None:
    # Hapke's disc, which test_moon_phase.py compares with the integral over the face, and light of
    # the Earth.
    # Krisciunas & Schaefer (1991), eq. 9, between 7° and 90°: 2.42 mag, Hapke's law within 0.1
    full, half = (
        MoonLight(zenith=40.0, phase=phase).source(earth.lights).irradiance
        for phase in (7.0, 90.0)
    )  # fmt: skip
    past, quarter = (moon_phase(phase) + earthlight(phase) for phase in (7.0, 90.0))
    assert_allclose(full / half, past / quarter, rtol=1e-6)
    assert_allclose(2.5 * np.log10(full / half), 2.42, atol=0.1)


def test_lamps_shine_once_beside_the_moon(earth: MomentsSolution) -> None:
    # What the Moon adds is the same with the lamps of towns and without them.
    dark = copy.copy(earth)
    dark.medium = replace(earth.medium, surface=replace(earth.medium.surface, lights=None))
    camera = Camera(width=48, height=27, look_zenith=150.0, field_of_view=50.0)
    scene = Scene(camera=camera, altitude=4e5, sun_zenith=180.0, latitude=45.4, longitude=9.2)
    moonlit = replace(scene, secondary_lights=(MoonLight(zenith=60.0, azimuth=30.0, phase=60.0),))
    added = []
    for solution in (earth, dark):
        added.append(render(solution, moonlit).rgb - render(solution, scene).rgb)
    lamps = render(earth, scene).rgb
    assert lamps.max() > 2.0 * added[1].max()
    # of single precision, in the sum with the lamps
    assert_allclose(added[0], added[1], atol=3e-7 * lamps.max())


def test_another_star_of_a_planet_keeps_its_lamps(earth: MomentsSolution) -> None:
    # The lamps have their own light: another star in the first place leaves their luminance, to
    # what the reflectances of red, green and blue at three wavelengths leave of a colour.
    camera = Camera(width=48, height=27, look_zenith=150.0, field_of_view=50.0)
    scene = Scene(camera=camera, altitude=4e5, sun_zenith=180.0, latitude=45.4, longitude=9.2)
    other = earth.with_light(RED.source(earth.lights))
    wanted = luminance(render(earth, scene).rgb.astype(float))
    seen = luminance(render(other, scene).rgb.astype(float))
    town = wanted > 0.1 * wanted.max()
    assert_allclose(seen[town], wanted[town], rtol=0.05)


@pytest.mark.parametrize(
    ("sun", "moon", "altitude", "rendered"),
    [
        (120.0, 60.0, 2.0, [True, True]),
        (120.0, 100.0, 2.0, [True, True]),  # twilight by moonlight
        (120.0, 130.0, 2.0, [True]),
        (120.0, 130.0, 4e5, [True, True]),  # lit air in view from orbit
        (40.0, 60.0, 2.0, [True, False]),  # by day its disc alone
        (40.0, 95.0, 2.0, [True]),
        (91.0, 60.0, 2.0, [True, True]),
    ],
)
def test_lights_that_cannot_matter_are_left_out(
    sun: float, moon: float, altitude: float, rendered: list[bool], earth: MomentsSolution
) -> None:
    # Each light in the list is a sky-view LUT and a pass over the pixels.
    scene = Scene(
        altitude=altitude, sun_zenith=sun, secondary_lights=(MoonLight(zenith=moon, azimuth=90.0),)
    )
    assert [one.air for one in scenes_by_light(scene, earth)] == rendered


def test_moonlight_left_out_by_day_is_invisible(earth: MomentsSolution) -> None:
    # With the sun on the horizon, where it is left out last: below a tenth of a per cent.
    camera = Camera(width=16, height=9, look_zenith=60.0, look_azimuth=170.0)
    scene = Scene(camera=camera, sun_zenith=89.9)
    moon = MoonLight(zenith=50.0, azimuth=0.0)
    moonlight = render(earth.with_light(moon.source(earth.lights)), scene.with_light(moon)).rgb
    assert (moonlight / render(earth, scene).rgb).max() < 1e-3


def test_the_day_moon_stands_in_a_blue_sky(earth: MomentsSolution) -> None:
    # Its disc alone is added, brighter than the sky around it, and lit on the sun's side.
    camera = Camera(width=80, height=60, field_of_view=1.2, look_zenith=50.0, look_azimuth=70.0)
    scene = Scene(camera=camera, altitude=2.0, sun_zenith=50.0)
    moon = MoonLight(zenith=50.0, azimuth=70.0, phase=90.0)
    added = render(earth, replace(scene, secondary_lights=(moon,))).rgb - render(earth, scene).rgb
    rows, columns = np.indices(added.shape[:2])
    weight = added[..., 1].astype(float)
    assert weight.max() > 0.1 * render(earth, scene).rgb[..., 1].max()
    assert np.average(columns, weights=weight) < 38.0  # the sun is to the left
    far = np.hypot(rows - 29.5, columns - 39.5) > 22.0  # of 17 pixels' radius
    assert not added[far].any()


def test_what_cannot_be_is_refused() -> None:
    for wrong in ({"phase": 190.0}, {"zenith": -1.0}, {"angular_radius": 0.0}):
        with pytest.raises(ParameterError, match=next(iter(wrong))):
            MoonLight(**{"zenith": 30.0, **wrong})
    with pytest.raises(ParameterError, match="temperature"):
        StarLight.black_body(1.0, 0.3)
    with pytest.raises(ParameterError, match="secondary_lights"):
        Scene(secondary_lights=("moon",))  # type: ignore[arg-type]
