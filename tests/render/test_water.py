"""Water in pictures: the glint, the mirrored sky, and the mask that says where it is."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image
from scipy.special import erfc

from airlight import Camera, Ground, Scene, load_planet
from airlight.geometry.mappings.sky_view import direction_from_row
from airlight.kernel.lanes import LANES
from airlight.physics.optics.cox_munk import (
    SEA_WATER,
    glint_factor,
    mean_square_slope,
    mirrored_fraction,
)
from airlight.physics.optics.fresnel import fresnel_reflectances
from airlight.planets.medium import Medium
from airlight.render import render
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.pixels.sea_sky import (
    AZIMUTHS,
    ELEVATIONS,
    MirrorPlace,
    mean_facet,
    mirrored_sky,
)
from airlight.render.pixels.sea_surface import Waves, mirror_waves
from airlight.scene.surface_map import surface_map
from airlight.solver.moments.march_tables import FACETS, MIRRORED
from airlight.solver.moments.solution import MomentsSolution

Lit = Callable[..., MomentsSolution]
Wet = Callable[..., MomentsSolution]
WIND = 6.0
RGB = (680.0, 550.0, 440.0)
FROM_SPACE = Scene(
    altitude=800e3,
    sun_zenith=40.0,
    camera=Camera(width=200, height=150, field_of_view=80.0, look_zenith=150.0),
)


class Wind(NamedTuple):
    wind: float


class Sea(NamedTuple):
    """What the mirrored sky reads of ``MarchTables``."""

    lanes: int
    ground: Wind


class Radiance(NamedTuple):
    """What it uses of ``MarchWorkspace``."""

    radiance: np.ndarray


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


def facets(cosine: float) -> tuple[np.ndarray, np.ndarray]:
    """Directions that facets mirror, and their weights, by a dense grid of slopes.

    Smith's visibility with its error function: nothing of the kernels but Fresnel's formula.
    """
    square, sine = mean_square_slope(WIND), np.sqrt(1.0 - cosine**2)

    def hidden(mu: np.ndarray) -> np.ndarray:
        v = mu / np.sqrt(square * np.maximum(1.0 - mu**2, 1e-12))
        return np.asarray(0.5 * (np.exp(-(v**2)) / (v * np.sqrt(np.pi)) - erfc(v)))

    x, y = np.meshgrid(*[np.linspace(-4.0, 4.0, 81) * np.sqrt(0.5 * square)] * 2, indexing="ij")
    normal = np.stack([-x, -y, np.ones_like(x)]) / np.sqrt(1.0 + x**2 + y**2)
    facing = cosine * normal[2] - sine * normal[0]
    ray = 2.0 * facing * normal - np.array([-sine, 0.0, cosine])[:, None, None]
    up = np.clip(ray[2], 1e-9, 1.0 - 1e-9)
    smooth = np.array([np.mean(fresnel_reflectances(SEA_WATER, max(one, 0.0)))
                       for one in facing.ravel()]).reshape(x.shape)  # fmt: skip
    weight = np.exp(-(x**2 + y**2) / square) * np.maximum(facing, 0.0) / normal[2] * smooth
    weight /= 1.0 + hidden(np.array(cosine)) + hidden(up)
    return ray, np.where(ray[2] > 0.0, weight, 0.0)


@pytest.mark.parametrize("sun", [40.0, 88.0])
@pytest.mark.parametrize(("view", "azimuth"), [(92.0, 60.0), (100.0, 0.0), (130.0, 120.0)])
def test_the_mirrored_sky_is_the_integral_over_the_facets(
    sun: float, view: float, azimuth: float, wet: Wet
) -> None:
    # A second method: the solution's own lines of sight in thousands of directions. The star's
    # glint, by its formula, is a part of the light.
    solution, scene = wet(), at(2.0, sun, view, azimuth, 20.0)
    large = replace(scene.camera, width=640, height=360)
    renderer = CpuRenderer(solution, replace(scene, camera=large))
    renderer.fill_sky_view()
    window, observer = renderer.window, renderer._observer
    assert window is not None
    row, column = window.ground_count // 2, window.column_count // 2
    texel = (window.sky_count + row) * window.column_count + column
    found = renderer._view.sky_mirrored[texel, : len(RGB)] ** 4.0
    place = (window.first_ground + row) / (window.rows - 1)
    _, sine = direction_from_row(place, False, observer.horizon_mu, observer.horizon_sine)
    cosine = np.sqrt(1.0 - (sine * observer.r / solution.tables.bottom) ** 2)
    ray, weight = facets(float(cosine))
    kept = weight > 1e-5 * weight.max()
    turn = 180.0 * (window.first_column + column) / (window.columns - 1)
    sky = np.asarray(solution.radiance(
        altitude=0.0, sun_zenith=sun, view_zenith=np.degrees(np.arccos(ray[2][kept])),
        azimuth=turn + np.degrees(np.arctan2(ray[1], ray[0]))[kept],
    ))  # fmt: skip
    expected = weight[kept] @ sky / weight[kept].sum() / solution.lights[0].irradiance
    mu_s, bend = np.cos(np.radians(sun)), np.sqrt(1.0 - cosine**2) * np.sin(np.radians(sun))
    nu = bend * np.cos(np.radians(turn)) - cosine * mu_s
    beam = np.asarray(solution.irradiance(altitude=0.0, sun_zenith=sun).direct) / np.pi
    glint = glint_factor(mu_s, cosine, nu, WIND) / mirrored_fraction(cosine, WIND)
    star = beam / solution.lights[0].irradiance * glint
    assert_allclose(found + star, expected + star, rtol=0.01)


@pytest.mark.parametrize("share", [0.1, 0.5, 0.95])
@pytest.mark.parametrize("cosine", [0.03, 0.1, 0.3, 0.7])
def test_the_mean_over_waves_is_the_mean_over_slopes(cosine: float, share: float) -> None:
    # A second method: resolved slopes on a fine grid with their normal density, under a sky that is
    # ten times as bright at the horizon as overhead, and brighter on one side.
    row, column = np.meshgrid(
        *(np.arange(n) / (n - 1) for n in (ELEVATIONS, AZIMUTHS)), indexing="ij"
    )
    bright = (1.0 - 0.5 * column) / (row**2 + 0.1)
    sky = np.tile((bright.ravel() ** 0.25).astype(np.float32)[:, None], (2, LANES))
    place = MirrorPlace(cosine, 0.3, 0.6, 0.7, 0, 0.5)
    tables, work = Sea(LANES, Wind(WIND)), Radiance(np.zeros((FACETS + 1, LANES), np.float32))
    mirrored_sky(place, sky, tables, work)
    mean_facet(place, sky, tables, work)
    whole, total, weights = work.radiance.copy(), 0.0, 0.0
    for along in np.arange(-4.0, 4.1, 0.25):
        for across in np.arange(-4.0, 4.1, 0.5):
            weight = np.exp(-0.5 * (along**2 + across**2))
            work.radiance[:] = whole
            waves = Waves(np.sqrt(share) * along, np.sqrt(share) * across, share)
            mirror_waves(waves, place, sky, tables, work)
            total += weight * work.radiance[MIRRORED, 0]
            weights += weight
    assert_allclose(total / weights, whole[MIRRORED, 0], rtol=0.01)


def test_waves_keep_the_sea_s_mean(wet: Wet) -> None:
    # A picture of so few pixels that they resolve no waves has the mean of one that resolves them.
    solution = wet(wind=2.0)
    camera = Camera(width=640, height=360, field_of_view=40.0, look_zenith=120.0)
    scene = Scene(altitude=20.0, sun_zenith=45.0, camera=camera)
    waves = rgb_of(solution, scene)
    blurred = replace(camera, width=16, height=9)
    mean = rgb_of(solution, replace(scene, camera=blurred)).mean(axis=(0, 1))
    assert_allclose(waves.mean(axis=(0, 1)), mean, rtol=0.03)
    assert waves[..., 1].std() > 0.1 * mean[1]


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
