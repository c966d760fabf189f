"""Ground that does not reflect alike into all directions, in pictures."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet
from airlight.planets.planet import Planet
from airlight.render import render
from airlight.solver import solve

#: From 400 km, the ground from straight below to the limb, under a star 40° from the zenith.
SCENE = Scene(
    altitude=400e3,
    sun_zenith=40.0,
    camera=Camera(width=256, height=192, field_of_view=100.0, look_zenith=150.0, look_azimuth=30.0),
)
WAVELENGTHS = (680.0, 550.0, 440.0)


def rocky(name: str, **ground: object) -> Planet:
    planet = load_planet(name)
    return replace(planet, ground=replace(planet.ground, law="lommel-seeliger", **ground))


@pytest.fixture(scope="module", params=["earth-atmosphere-plus", "earth-openspace-refractive"])
def solution(request):
    return solve(rocky(request.param, map=None), wavelengths=WAVELENGTHS, quality="preview")


def test_a_picture_has_the_radiance_of_the_solution_s_lines(solution):
    # Second path: the solver's own march asks the law by itself, without pixels.
    # Lines that graze the limb are left out, where the two marches' panels differ by 1 %.
    camera = Camera(width=24, height=18, field_of_view=70.0, look_zenith=165.0, look_azimuth=30.0)
    small = replace(SCENE, camera=camera)
    rgb = render(solution, small, exact=True).rgb
    directions = small.camera.directions()
    zenith = np.degrees(np.arctan2(np.hypot(*directions[..., :2].T).T, directions[..., 2]))
    azimuth = np.degrees(np.arctan2(-directions[..., 1], directions[..., 0]))
    radiance = solution.radiance(
        altitude=small.altitude, sun_zenith=small.sun_zenith, view_zenith=zenith, azimuth=azimuth
    )
    expected = np.asarray(radiance) @ (
        solution.lights[0].colors() / solution.lights[0].irradiance[:, None]
    )
    # Both march; the picture's panels have other points than the solver's.
    assert_allclose(rgb, expected, rtol=3e-3)


@pytest.mark.parametrize("orders", ["all", "single", "multiple"])
def test_the_table_of_the_sky_shows_the_law_as_the_march_does(solution, orders):
    # The table holds a white ground's light; star and sky share it by their irradiances.
    exact = render(solution, SCENE, orders=orders, exact=True).rgb
    table = render(solution, SCENE, orders=orders).rgb
    error = np.abs(table - exact) / exact.max(axis=(0, 1))
    assert np.median(error) < 1e-3
    assert np.quantile(error, 0.999) < 1e-2


def test_the_law_is_seen(solution):
    # A high star's ground darkens towards the limb by Lambert's law less than it brightens by the
    # other: c/(mu_0 + mu) grows as the line flattens.
    lambert = solve(
        replace(solution.planet, ground=replace(solution.planet.ground, law="lambert")),
        wavelengths=WAVELENGTHS, quality="preview",
    )  # fmt: skip
    below, aside = (
        replace(SCENE, camera=Camera(width=8, height=8, field_of_view=4.0, look_zenith=view))
        for view in (180.0, 118.0)
    )
    ratio = {}
    for name, one in (("lambert", lambert), ("rock", solution)):
        near, far = (float(render(one, s, exact=True).rgb[4, 4, 0]) for s in (below, aside))
        ratio[name] = far / near
    assert ratio["rock"] > 1.1 * ratio["lambert"]


def test_a_map_s_colour_is_the_albedo_of_the_law(solution):
    # Earth's map by both laws: where the star stands over the observer and the line leaves straight
    # up, the factors' ratio is that of the law, c/2.
    scene = Scene(
        altitude=400e3, sun_zenith=0.0, latitude=20.0, longitude=20.0,
        camera=Camera(width=4, height=4, field_of_view=1.0, look_zenith=180.0),
    )  # fmt: skip
    earth = load_planet("earth")
    plain = replace(earth, ground=replace(earth.ground, map="earth"))
    seen = []
    for law in ("lambert", "lommel-seeliger"):
        one = replace(plain, ground=replace(plain.ground, law=law))
        solved = solve(one, wavelengths=WAVELENGTHS, quality="preview")
        whole = render(solved, scene, orders="single").rgb[2, 2, 0]
        bare = replace(one, ground=replace(one.ground, albedo=0.0, map=None))
        black = solve(bare, wavelengths=WAVELENGTHS, quality="preview")
        seen.append(float(whole - render(black, scene, orders="single").rgb[2, 2, 0]))
    assert_allclose(seen[1] / seen[0], 3.0 / (16.0 * (1.0 - np.log(2.0))), rtol=2e-3)
