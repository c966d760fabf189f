"""Probe: its parts, their sum, and agreement with the picture."""

from __future__ import annotations

import math
import time
from collections.abc import Callable

import numpy as np
import pytest
from marched_pictures import centres
from numpy.testing import assert_allclose

from airlight.errors import ParameterError
from airlight.image.xyz import rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.physics.spectra.limb_darkening import solar_darkening
from airlight.planets import load_planet
from airlight.render import render
from airlight.scene import Camera, Scene
from airlight.scene.directions import direction
from airlight.solver import solve
from airlight.solver.moments.radiance_parts import radiance_parts
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.painting.probe import GROUND_SKY, GROUND_STAR, MORE, STAR, probe, probe_pixel

NM = (440.0, 510.0, 550.0, 680.0)


@pytest.fixture(scope="module")
def earth() -> MomentsSolution:
    return solve(load_planet("earth-atmosphere-plus"), NM, "preview")


@pytest.fixture(scope="module")
def mapped() -> MomentsSolution:
    """Earth with its map, without particles, which take long."""
    return solve(load_planet("earth-atmosphere-plus", {"ground.map": "earth"}), NM, "preview")


@pytest.mark.parametrize("altitude", [2.0, 35e3, 400e3, 2e7])
def test_parts_sum_to_the_radiance_of_the_solution(earth: MomentsSolution, altitude: float) -> None:
    # All light was scattered once or more, or comes from the ground. Float32: 2e-6.
    scene = Scene(altitude=altitude, sun_zenith=75.0)
    for zenith in (0.0, 60.0, 89.0, 100.0, 160.0, 179.0):
        seen = probe(earth, scene, direction(zenith, 35.0))
        whole = earth.radiance(altitude=altitude, sun_zenith=75.0, view_zenith=zenith, azimuth=35.0)
        assert_allclose(
            np.sum([part.radiance for part in seen.parts], axis=0), seen.radiance, rtol=1e-14
        )
        assert_allclose(seen.radiance, whole, rtol=2e-6, atol=1e-12)


def test_luminance_and_colour_are_those_of_the_picture(earth: MomentsSolution) -> None:
    # The picture integrates separately, with fewer points: 0.3 % outside the star's aureole.
    camera = Camera(width=12, height=8, field_of_view=90.0, look_zenith=88.0, look_azimuth=110.0)
    scene = Scene(camera=camera, altitude=2.0, sun_zenith=60.0)
    rgb = centres(earth, scene).astype(float)
    for x, y in ((0, 0), (5, 3), (11, 7)):
        seen = probe_pixel(earth, scene, x + 0.5, y + 0.5)
        assert seen is not None
        xyz = rgb_to_xyz(rgb[y, x])
        assert_allclose(seen.rgb, rgb[y, x], rtol=3e-3, atol=3e-3 * rgb[y, x].max())
        assert_allclose(seen.luminance, LUMINOUS_EFFICACY * xyz[1], rtol=3e-3)
        assert_allclose(seen.chromaticity, xyz[:2] / xyz.sum(), atol=1e-3)


def test_the_map_of_the_ground_is_read_where_the_picture_reads_it(
    mapped: MomentsSolution,
) -> None:
    # The same map by the same interpolation; the picture draws from a sky-view LUT.
    camera = Camera(width=16, height=16, field_of_view=70.0, look_zenith=180.0)
    scene = Scene(camera=camera, altitude=3e6, sun_zenith=30.0, latitude=20.0, longitude=10.0)
    rgb = render(mapped, scene).rgb.astype(float)
    for x, y in ((4, 4), (8, 8), (11, 5)):
        seen = probe_pixel(mapped, scene, x + 0.5, y + 0.5)
        assert seen is not None
        assert seen.latitude is not None
        assert_allclose(seen.rgb, rgb[y, x], rtol=5e-3)


def test_the_map_colours_all_light_of_the_ground(mapped: MomentsSolution) -> None:
    # The map's reflectance replaces the albedo under both the star's and the sky's light.
    scene = Scene(altitude=3e6, sun_zenith=30.0, latitude=20.0, longitude=10.0)
    seen = probe(mapped, scene, direction(170.0, 0.0))
    lines, _ = mapped.lines_of_sight(altitude=3e6, sun_zenith=30.0, view_zenith=170.0)
    plain = radiance_parts(mapped, lines)
    sun = mapped.medium.solar_irradiance
    painted = {part.name: part.radiance for part in seen.parts}
    star = painted[GROUND_STAR] / (plain.ground_star[0] * sun)
    sky = painted[GROUND_SKY] / (plain.ground_sky[0] * sun)
    assert_allclose(star, sky, rtol=1e-12)
    assert (np.abs(star - 1.0) > 0.1).any()  # the Sahara does not have the mean albedo


@pytest.mark.parametrize(("altitude", "view"), [(500.0, 95.0), (400e3, 150.0)])
def test_water_is_probed_as_it_is_drawn(altitude: float, view: float) -> None:
    # The picture's own pixels, too large for waves.
    planet = load_planet("earth-atmosphere-plus", {"ground.law": "water", "ground.albedo": 0.02})
    sea = solve(planet, NM, "preview")
    for azimuth in (0.0, 60.0):
        camera = Camera(width=8, height=8, field_of_view=2.0, look_zenith=view,
                        look_azimuth=azimuth)  # fmt: skip
        scene = Scene(camera=camera, altitude=altitude, sun_zenith=50.0)
        seen = probe_pixel(sea, scene, 4.5, 4.5)
        assert seen is not None
        assert_allclose(seen.rgb, render(sea, scene).rgb[4, 4], rtol=0.02)


def test_the_ground_below_is_the_place_below(earth: MomentsSolution) -> None:
    # Straight down is the point at the observer's latitude and longitude, one altitude away.
    scene = Scene(altitude=400e3, latitude=-33.0, longitude=151.0, sun_zenith=50.0)
    seen = probe(earth, scene, direction(180.0, 0.0))
    assert_allclose((seen.latitude, seen.longitude), (-33.0, 151.0), atol=1e-9)
    assert_allclose(seen.distance, 400e3, rtol=1e-12)
    names = [part.name for part in seen.parts]
    assert GROUND_STAR in names
    assert GROUND_SKY in names


def test_depths_and_transmittance_belong_together(earth: MomentsSolution) -> None:
    # T = exp(-tau); straight up tau is the vertical optical depth; the solution's result is a
    # second method.
    scene = Scene(altitude=0.0, sun_zenith=50.0)
    up = probe(earth, scene, direction(0.0, 0.0))
    assert_allclose(up.optical_depth, earth.medium.vertical_optical_depth, rtol=1e-9)
    slant = probe(earth, scene, direction(70.0, 0.0))
    assert_allclose(slant.transmittance, np.exp(-np.sum(slant.optical_depth, axis=0)), rtol=1e-14)
    known = earth.transmittance(altitude=0.0, view_zenith=70.0)
    assert_allclose(slant.transmittance, known, rtol=1e-9)


def test_the_star_is_seen_on_its_disc_alone(earth: MomentsSolution) -> None:
    # Its radiance is irradiance over solid angle times transmittance, pi sin(alpha)^2 to 1e-5, and
    # darkened at 0.1° from its middle as Neckel (2005) measured: the angle's own cosine.
    scene = Scene(altitude=0.0, sun_zenith=50.0)
    on = probe(earth, scene, direction(50.1, 0.0))
    off = probe(earth, scene, direction(50.3, 0.0))
    star = next(part for part in on.parts if part.name == STAR)
    alpha = earth.medium.star_angular_radius
    expected = earth.medium.solar_irradiance / (math.pi * math.sin(alpha) ** 2)
    mu = math.sqrt(1.0 - (math.radians(0.1) / alpha) ** 2)
    expected = expected * (solar_darkening(earth.wavelengths) @ mu ** np.arange(6))
    assert_allclose(star.radiance, expected * np.array(on.transmittance), rtol=1e-4)
    assert STAR not in [part.name for part in off.parts]


def test_past_the_planet_there_is_nothing(earth: MomentsSolution) -> None:
    # Far away, away from the planet: no light, no air, no ground.
    seen = probe(earth, Scene(altitude=1e9, sun_zenith=50.0), direction(10.0, 0.0))
    assert seen.luminance == 0.0
    assert seen.chromaticity == (0.0, 0.0)
    assert seen.distance == math.inf
    assert set(seen.transmittance) == {1.0}


def test_light_that_is_bent_has_the_same_parts(earth: MomentsSolution) -> None:
    # As above, with an additional profile that only refracts.
    bent = solve(load_planet("earth", {"refraction": "bouguer"}), NM, "preview")
    scene = Scene(altitude=0.0, sun_zenith=90.0)
    seen = probe(bent, scene, direction(89.5, 0.0))
    whole = bent.radiance(altitude=0.0, sun_zenith=90.0, view_zenith=89.5, azimuth=0.0)
    sky = [part.radiance for part in seen.parts if part.name != STAR]
    assert_allclose(np.sum(sky, axis=0), whole, rtol=2e-6)
    assert len(seen.optical_depth) == len(bent.medium.names)


def test_places_outside_the_picture_are_refused_and_a_fisheye_has_corners(
    earth: MomentsSolution,
) -> None:
    # A fisheye's circle leaves the corners empty.
    scene = Scene(camera=Camera(projection="fisheye", width=20, height=20), sun_zenith=50.0)
    assert probe_pixel(earth, scene, 0.5, 0.5) is None
    assert probe_pixel(earth, scene, 10.0, 10.0) is not None
    with pytest.raises(ParameterError, match="0 to 20 pixels"):
        probe_pixel(earth, scene, 20.5, 3.0)


def test_a_probe_takes_milliseconds(earth: MomentsSolution, tell: Callable[[str], None]) -> None:
    # A picture follows the mouse at 20 frames a second: 50 ms of this thread's own time, which
    # other work on the machine does not lengthen.
    scene = Scene(altitude=2.0, sun_zenith=60.0)
    probe(earth, scene, direction(80.0, 20.0))
    times = []
    for _ in range(9):
        started = time.thread_time()
        seen = probe(earth, scene, direction(80.0, 20.0))
        times.append(time.thread_time() - started)
    tell(f"probe: {1e3 * sorted(times)[4]:.1f} ms a direction")
    assert sorted(times)[4] < 0.05
    assert MORE in [part.name for part in seen.parts]
