"""Water in pictures: the glint, the mirrored sky, and the mask that says where it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Ground, Scene, load_planet
from airlight.physics.optics.cox_munk import glint_factor, mirrored_cosine, mirrored_fraction
from airlight.physics.optics.water import FOAM, foam_fraction
from airlight.planets.medium import Medium
from airlight.render import render
from airlight.scene.surface_map import surface_map
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]
Wet = Callable[..., MomentsSolution]
WIND = 6.0
FROM_SPACE = Scene(
    altitude=800e3,
    sun_zenith=40.0,
    camera=Camera(width=200, height=150, field_of_view=80.0, look_zenith=150.0),
)


def at(altitude: float, sun: float, view: float, azimuth: float = 0.0, field: float = 1.0) -> Scene:
    camera = Camera(
        width=4, height=4, field_of_view=field, look_zenith=view, look_azimuth=azimuth
    )  # fmt: skip
    return Scene(altitude=altitude, sun_zenith=sun, camera=camera)


@pytest.fixture
def wet(lit: Lit, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Wet:
    """Earth under a black map with a mask of its water, solved once over black ground."""
    monkeypatch.chdir(tmp_path)
    planet = load_planet("earth-atmosphere-plus")
    plain = lit(replace(planet, ground=Ground(albedo=0.0)))
    surface_map.cache_clear()  # the tests' maps have the same names

    def make(water: int = 255, **ground: object) -> MomentsSolution:
        name = f"./black-{water}.png"
        Image.new("RGB", (16, 8)).save(name)
        Image.new("L", (16, 8), water).save(f"./black-{water}-water.png")
        given = {"albedo": 0.0, "map": name, "wind": WIND} | ground
        medium = Medium.from_planet(replace(planet, ground=Ground(**given)), plain.wavelengths)
        solution = MomentsSolution(medium, plain.settings, plain.moments, 0.0)
        solution.planet = replace(planet, ground=Ground(**given))
        return solution

    return make


def rgb_of(solution: MomentsSolution, scene: Scene, **options: object) -> np.ndarray:
    return render(solution, scene, **options).rgb.astype(float)


def test_a_mask_of_water_alone_is_the_law_of_water(wet: Wet) -> None:
    # Two ways to the same ground.
    masked, law = wet(), wet(0, law="water")
    assert_allclose(rgb_of(masked, FROM_SPACE), rgb_of(law, FROM_SPACE), rtol=1e-5)


def test_half_water_is_half_of_each(wet: Wet) -> None:
    # The share's definition; 51/255 is a fifth.
    land, fifth, sea = (rgb_of(wet(share), FROM_SPACE) for share in (0, 51, 255))
    assert_allclose(fifth, 0.8 * land + 0.2 * sea, rtol=1e-4, atol=1e-5 * sea.max())


def test_without_wind_a_mask_changes_nothing(wet: Wet) -> None:
    # What planets said before there was water.
    assert_allclose(rgb_of(wet(wind=None), FROM_SPACE), rgb_of(wet(0), FROM_SPACE), rtol=1e-6)


@pytest.mark.parametrize("azimuth", [0.0, 90.0, 180.0])
def test_the_sea_shows_the_sky_that_its_facets_turn_to(azimuth: float, wet: Wet) -> None:
    # Second path: the solution's own line of sight towards the mirrored sky, from the ground, times
    # the fraction that is mirrored; a glint is added by the formula.
    solution, scene = wet(), at(1.0, 55.0, 100.0, azimuth)
    mu_r = np.cos(np.radians(80.0))
    mu_s = np.cos(np.radians(55.0))
    nu = -mu_s * mu_r + np.sqrt((1 - mu_s**2) * (1 - mu_r**2)) * np.cos(np.radians(azimuth))
    foam, up = foam_fraction(WIND), mirrored_cosine(mu_r, WIND)
    sky = np.asarray(solution.radiance(
        altitude=0.0, sun_zenith=55.0, view_zenith=np.degrees(np.arccos(up)), azimuth=azimuth
    ))  # fmt: skip
    star = np.asarray(solution.irradiance(altitude=0.0, sun_zenith=55.0).direct) / np.pi
    mirrored = (1.0 - foam) * mirrored_fraction(mu_r, WIND) + foam * FOAM
    glint = (1.0 - foam) * glint_factor(mu_s, mu_r, nu, WIND) + foam * FOAM
    weights = solution.lights[0].colors() / solution.lights[0].irradiance[:, None]
    expected = (sky * mirrored + star * glint) @ weights
    # 6 m of air in between add 0.2 %; the aureole is spread by the facets in the picture alone:
    # towards the star it is within 10 % of the mirrored sky, a hundredth of the glint.
    for exact in (True, False):
        seen = rgb_of(solution, replace(scene, camera=replace(scene.camera, width=160, height=90)),
                      exact=exact)[44:46, 79:81].mean(axis=(0, 1))  # fmt: skip
        assert_allclose(seen, expected, rtol=0.02)


@pytest.mark.parametrize("orders", ["all", "single", "multiple"])
def test_the_table_of_the_sky_shows_water_as_the_march_does(orders: str, wet: Wet) -> None:
    # As other ground: the median within 1e-3, 99.9 % of the pixels within 1 %.
    solution = wet()
    exact, table = (rgb_of(solution, FROM_SPACE, orders=orders, exact=x) for x in (True, False))
    error = np.abs(table - exact) / exact.max(axis=(0, 1))
    assert np.median(error) < 1e-3
    assert np.quantile(error, 0.999) < 1e-2


def test_orders_are_parts_of_the_whole(wet: Wet) -> None:
    # Light scattered once and all other light add up; the mirrored sky is of the second kind.
    solution = wet()
    once, more, both = (rgb_of(solution, FROM_SPACE, orders=x, exact=True)
                        for x in ("single", "multiple", "all"))  # fmt: skip
    assert_allclose(once + more, both, rtol=2e-4, atol=1e-6 * both.max())


def test_from_space_the_glint_lies_where_a_mirror_shows_the_star(wet: Wet) -> None:
    # Geometry: star and observer overhead of each other's mirror point; above a black sea the
    # brightest ground is there, and a calm sea's is brighter and smaller than a rough one's.
    scene = at(800e3, 20.0, 180.0, field=70.0)
    scene = replace(scene, camera=replace(scene.camera, width=140, height=140))
    places, peaks = [], []
    for wind in (3.0, 12.0):
        green = rgb_of(wet(wind=wind), scene)[..., 1]
        j, i = np.unravel_index(green.argmax(), green.shape)
        x, y, z = scene.camera.directions()[j, i]
        places.append((np.degrees(np.arctan2(x, -z)), np.degrees(np.arcsin(y))))
        peaks.append(green.max())
    # The line there is 15.9° from the vertical: 20° less twice the arc of 2.05° that it reaches.
    # A density of slopes and a map of pixels have their maxima some degrees apart.
    for along, across in places:
        assert abs(along - 15.9) < 3.0
        assert abs(across) < 1.0
    assert peaks[0] > 1.5 * peaks[1]
