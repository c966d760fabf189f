"""Pictures with detail of the ground below its map's resolution."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Medium, Scene, load_planet, replace
from airlight.errors import ParameterError
from airlight.physics.optics.rpv import land_diffuse, land_direct, unsaturated
from airlight.render import render
from airlight.scene.directions import direction
from airlight.solver.moments.solution import MomentsSolution


def test_a_scene_is_plain_unless_it_is_told_otherwise() -> None:
    # Radiances of the library are those of the map.
    assert Scene().ground == "plain"
    with pytest.raises(ParameterError, match=r"scene\.ground is 'bumpy'; allowed: plain, detailed"):
        Scene(ground="bumpy")


def test_detail_varies_the_land_and_keeps_its_mean(lit: Callable[..., MomentsSolution]) -> None:
    # Noise of mean 0 and a tenth of deviation: over 40 places the mean is known to 2 %, times the
    # law of reflection in the middle, for sun and sky in equal parts within a fifth of both; the
    # sizes below a hundred metres vary within a picture.
    camera = Camera(width=24, height=18, look_zenith=150.0, field_of_view=60.0)
    solution, random = lit("mars"), np.random.default_rng(5)
    ratios = []
    for _ in range(40):
        scene = Scene(
            camera=camera, altitude=300.0, latitude=random.uniform(-80.0, 80.0),
            longitude=random.uniform(-180.0, 180.0),
        )  # fmt: skip
        plain = render(solution, scene).rgb
        ratios.append(render(solution, replace(scene, ground="detailed")).rgb / plain)
    nu = float(direction(150.0, camera.look_azimuth) @ direction(60.0, 0.0))
    cosine = np.cos(np.radians(30.0))
    laws = land_direct(0.5, cosine, nu), land_diffuse(cosine)
    seen = np.mean([unsaturated(one, 0.165) for one in laws])
    assert_allclose(np.mean(ratios), seen, atol=0.04)
    within = np.std(np.array(ratios)[..., 0], axis=(1, 2))
    assert 0.02 < within.mean() < 0.2


def test_the_land_of_a_map_has_detail(lit: Callable[..., MomentsSolution]) -> None:
    # The Sahara from 300 m, a texel of the map: only the detail varies.
    camera = Camera(width=24, height=18, look_zenith=150.0, field_of_view=60.0)
    scene = Scene(camera=camera, altitude=300.0, latitude=24.0, longitude=10.0, ground="detailed")
    ratio = (
        render(lit("earth"), scene).rgb / render(lit("earth"), replace(scene, ground="plain")).rgb
    )
    assert ratio.std() > 0.02


@pytest.mark.parametrize(("latitude", "longitude"), [(29.5, 53.0), (50.0, 10.5)])
def test_valleys_and_fields_keep_the_mean_of_the_land(
    lit: Callable[..., MomentsSolution], latitude: float, longitude: float
) -> None:
    # The Zagros and fields of Germany from 400 km, against the same land without a map of heights,
    # which has hills and woods instead: of 450 km, whose means over 50 texels are known to 2 %.
    earth, pictures = load_planet("earth"), []
    camera = Camera(width=96, height=54, look_zenith=180.0, field_of_view=60.0)
    scene = Scene(
        camera=camera, altitude=4e5, sun_zenith=45.0, latitude=latitude, longitude=longitude,
        ground="detailed",
    )  # fmt: skip
    for relief in (earth.ground.relief, None):
        ground = replace(earth.ground, relief=relief, clouds_from_space=None)
        planet = replace(earth, ground=ground)
        cloudy = lit(earth)
        medium = Medium.from_planet(planet, cloudy.wavelengths)
        clear = MomentsSolution(medium, cloudy.settings, cloudy.moments, 0.0)
        pictures.append(render(clear, scene).rgb)
    with_relief, without = pictures
    assert_allclose(with_relief.mean(axis=(0, 1)), without.mean(axis=(0, 1)), rtol=0.02)
    assert np.std(with_relief / without) > 0.004  # pixels of 5 km average most of it


def test_sky_and_water_outside_the_glint_have_no_detail(
    lit: Callable[..., MomentsSolution],
) -> None:
    camera = Camera(width=24, height=16, look_zenith=100.0, look_azimuth=180.0)
    scene = Scene(camera=camera, altitude=300.0, latitude=-20.0, longitude=-120.0)  # the Pacific
    solution = lit("earth")
    plain = render(solution, scene).rgb
    assert_array_equal(render(solution, replace(scene, ground="detailed")).rgb, plain)
    assert np.all(np.isfinite(plain))


def test_clouds_seen_from_space_are_in_detailed_pictures_from_above_60_km(
    lit: Callable[..., MomentsSolution],
) -> None:
    # The key's definition: without it everything else is the same, as is the ground of solvers; a
    # descent has no sudden change.
    camera = Camera(width=24, height=16, look_zenith=180.0, field_of_view=60.0)
    scene = Scene(
        camera=camera, altitude=400e3, sun_zenith=40.0, latitude=-50.0, longitude=-20.0,
        ground="detailed",
    )  # fmt: skip
    earth = load_planet("earth")
    cloudy = lit(earth)
    without = replace(earth, ground=replace(earth.ground, clouds_from_space=None))
    medium = Medium.from_planet(without, cloudy.wavelengths)
    clear = MomentsSolution(medium, cloudy.settings, cloudy.moments, 0.0)
    assert cloudy.medium.fingerprint() == medium.fingerprint()
    for seen in (replace(scene, ground="plain"), replace(scene, altitude=60e3)):
        assert_array_equal(render(cloudy, seen).rgb, render(clear, seen).rgb)
    levels = [
        float(np.mean(render(cloudy, one).rgb / render(clear, one).rgb))
        for one in (replace(scene, altitude=h) for h in (70e3, 80e3, 90e3, 100e3))
    ]
    assert levels == sorted(levels)
    assert levels[-1] > levels[0] > 1.0


@pytest.mark.parametrize("edits", [{}, {"ground.map": None}])
def test_ejecta_are_seen_under_an_overhead_sun(
    edits: dict[str, None], solved: Callable[..., MomentsSolution]
) -> None:
    # Slopes have no shade there: what craters change, with a map or without, is the reflectance, of
    # 40 places, since a wide fresh crater brightens all of one by a fifth.
    camera = Camera(width=24, height=18, look_zenith=180.0, field_of_view=60.0)
    random, seen = np.random.default_rng(7), []
    places = random.uniform([-80.0, -180.0], [80.0, 180.0], (40, 2))
    for of in ({}, {"ground.craters": 0.0}):
        solution = solved(load_planet("moon", {**edits, **of}), (680.0, 550.0, 440.0), "preview")
        scene = Scene(camera=camera, altitude=3e4, sun_zenith=0.0, ground="detailed")
        seen.append(
            [
                render(solution, replace(scene, latitude=north, longitude=east)).rgb
                for north, east in places
            ]
        )
    ratio = np.array(seen[0]) / np.array(seen[1])
    assert ratio.std() > 0.01
    assert_allclose(ratio.mean(), 1.0, atol=0.03)
