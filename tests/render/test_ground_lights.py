"""Lights of towns: their luminance through the air, on the ground's night side."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose
from PIL import Image

from airlight import Camera, Scene, load_planet
from airlight.errors import FileError
from airlight.image.xyz import chromaticity, luminance, rgb_to_xyz
from airlight.physics.constants import LUMINOUS_EFFICACY
from airlight.render import render
from airlight.scene.ground_overlay import TOWN_LUMINANCE, ground_overlay
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.solve import solve

NM = (440.0, 500.0, 560.0, 620.0)


@pytest.fixture
def lit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Callable[..., MomentsSolution]:
    """Solution of an Earth with a map of lights that has one value everywhere."""
    monkeypatch.chdir(tmp_path)

    def make(value: int, **changes: object) -> MomentsSolution:
        ground_overlay.cache_clear()  # maps are kept by name
        Image.new("L", (8, 4), value).save("lights.png")
        overrides = {"ground.lights": "./lights.png", **changes}
        planet = load_planet("earth-atmosphere-plus", overrides)
        return solve(planet, NM, "preview", cache=False)

    return make


@pytest.mark.parametrize("altitude", [2.0, 4e5])
def test_lights_are_as_bright_as_their_map_says(
    lit: Callable[..., MomentsSolution], altitude: float
) -> None:
    # The definition, times Beer's law along the line of sight; the sun is at the antipodes, so that
    # nothing else shines. Four wavelengths carry the lamps' colour through the air to 2 %.
    solution = lit(255)
    camera = Camera(width=3, height=3, field_of_view=1.0, look_zenith=180.0)
    rgb = render(solution, Scene(camera=camera, altitude=altitude, sun_zenith=180.0)).rgb[1, 1]
    seen = LUMINOUS_EFFICACY * float(luminance(rgb))
    depth = solution.medium.vertical_optical_depth.sum(axis=0)
    clear = np.exp(-depth) if altitude > 1e5 else np.ones(len(NM))
    # from space with what the air scatters of it: up to a fifth, as lamps shine most to the side
    more = 1.2 if altitude > 1e5 else 1.02
    assert TOWN_LUMINANCE * clear.min() * 0.98 <= seen <= TOWN_LUMINANCE * clear.max() * more
    if altitude < 1e5:
        assert_allclose(seen, TOWN_LUMINANCE, rtol=0.02)
        # CIE 15: the chromaticity of a black body of 2250 K.
        xyz = rgb_to_xyz(rgb.astype(float))
        assert_allclose(chromaticity(xyz), [0.5003, 0.4153], atol=0.02)


def test_lights_are_added_to_what_the_ground_reflects(lit: Callable[..., MomentsSolution]) -> None:
    # Light adds up: by day the difference of the pictures is that of the night.
    camera = Camera(width=4, height=4, field_of_view=30.0, look_zenith=180.0)
    pictures = {}
    for value in (0, 255):
        solution = lit(value)
        for sun in (88.0, 180.0):
            scene = Scene(camera=camera, altitude=4e5, sun_zenith=sun)
            pictures[value, sun] = render(solution, scene).rgb.astype(float)
    assert pictures[0, 180.0].max() < 1e-12 * pictures[255, 180.0].min()
    added = pictures[255, 88.0] - pictures[0, 88.0]
    assert_allclose(added, pictures[255, 180.0], rtol=2e-2, atol=2e-7 * pictures[0, 88.0].max())


def test_lights_do_not_depend_on_the_star_or_the_ground_s_brightness(
    lit: Callable[..., MomentsSolution],
) -> None:
    camera = Camera(width=2, height=2, field_of_view=10.0, look_zenith=180.0)
    scene = Scene(camera=camera, altitude=4e5, sun_zenith=180.0)
    plain = render(lit(200), scene).rgb
    changed = render(lit(200, **{"ground.brightness": 0.3, "star.distance": "5 au"}), scene).rgb
    assert_allclose(changed, plain, rtol=1e-4)


def test_the_earth_s_lights_are_where_towns_are() -> None:
    # An atlas: Paris, Tokyo and Cairo shine, the Sahara, the Amazon and the Pacific do not.
    found = ground_overlay("earth")
    assert found is not None
    lights = found.sample(
        [48.86, 35.68, 30.05, 24.0, -5.0, 0.0], [2.35, 139.76, 31.24, 10.0, -65.0, -150.0]
    )[:, 0]
    assert np.all(lights[:3] > 0.3)
    assert np.all(lights[3:] < 1e-3)


def test_unknown_lights_are_refused_with_the_known_ones() -> None:
    with pytest.raises(FileError, match=r"unknown city-lights map \(known: earth\)$"):
        ground_overlay("vulcan")
