"""Where each program looks a direction up, by its own formula, against where the map has it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.environment.consumers import CONSUMERS, consumer_named
from airlight.engines.environment.disc import enu_from_local
from airlight.engines.environment.environment_map import map_camera
from airlight.engines.environment.texels import texel_positions
from airlight.errors import ParameterError

EAST, NORTH, UP = np.eye(3)
FULL = 2.0 * np.pi


def _godot(x: float, y: float, z: float) -> tuple[float, float]:
    # drivers/…/sky.glsl, PanoramaSkyMaterial: atan2(x, -z), acos(y)
    return np.arctan2(x, -z) / FULL % 1.0, np.arccos(y) / np.pi


def _blender(x: float, y: float, z: float) -> tuple[float, float]:
    # Cycles, direction_to_equirectangular; v counts from below there
    return -np.arctan2(y, x) / FULL + 0.5, 0.5 - np.arctan2(z, np.hypot(x, y)) / np.pi


def _openexr(x: float, y: float, z: float) -> tuple[float, float]:
    # ImfEnvmap: longitude atan2(x, z) from +180° at the left edge to -180° at the right one
    return 0.5 - np.arctan2(x, z) / FULL, 0.5 - np.arcsin(y) / np.pi


def _three(x: float, y: float, z: float) -> tuple[float, float]:
    # shaders/ShaderChunk/common.glsl.js, equirectUv; v counts from below there
    return np.arctan2(z, x) / FULL + 0.5, 0.5 - np.arcsin(y) / np.pi


def _unity(x: float, y: float, z: float) -> tuple[float, float]:
    # Skybox-Panoramic.shader, ToRadialCoords; v counts from below there
    return 0.5 - np.arctan2(z, x) / FULL, np.arccos(y) / np.pi


def _pbrt(u: float, v: float) -> np.ndarray:
    # the other way, EqualAreaSquareToSphere: Pharr et al. (2023), section 3.8.3
    a, b = abs(2.0 * u - 1.0), abs(2.0 * v - 1.0)
    distance = 1.0 - (a + b)
    r = 1.0 - abs(distance)
    phi = np.pi / 4.0 if r == 0.0 else ((b - a) / r + 1.0) * np.pi / 4.0
    level = r * np.sqrt(max(2.0 - r * r, 0.0))
    return np.array([
        np.copysign(np.cos(phi), 2.0 * u - 1.0) * level,
        np.copysign(np.sin(phi), 2.0 * v - 1.0) * level,
        np.copysign(1.0 - r * r, distance),
    ])  # fmt: skip


FORMULAS: dict[str, Callable[[float, float, float], tuple[float, float]]] = {
    "blender": _blender, "mitsuba": _openexr, "usd": _openexr, "godot": _godot, "three": _three,
    "unity": _unity,
}  # fmt: skip


def test_every_program_but_the_dome_has_its_formula_here() -> None:
    assert set(FORMULAS) | {"pbrt", "dome"} == set(CONSUMERS)


@pytest.mark.parametrize("name", [*FORMULAS, "pbrt"])
@pytest.mark.parametrize("sun_azimuth", [0.0, 215.0])
def test_the_map_has_a_direction_where_the_program_looks_for_it(
    name: str, sun_azimuth: float
) -> None:
    consumer = CONSUMERS[name]
    width, height = (200, 100) if consumer.projection == "equirectangular" else (100, 100)
    camera = map_camera(consumer, width, height, sun_azimuth)
    generator = np.random.default_rng(1)
    enu = generator.normal(size=(12, 3))
    enu /= np.linalg.norm(enu, axis=1)[:, None]
    x, y = texel_positions(camera, enu @ enu_from_local(sun_azimuth))
    for k, one in enumerate(enu):
        u, v = x[k] / width, y[k] / height
        if name == "pbrt":
            assert_allclose(_pbrt(u, v), consumer.direction(one), atol=1e-12)
        else:
            assert_allclose([u, v], FORMULAS[name](*consumer.direction(one)), atol=1e-12)


@pytest.mark.parametrize("name", CONSUMERS)
def test_axes_are_a_rotation_or_of_a_left_handed_program_a_mirror_image(name: str) -> None:
    consumer = CONSUMERS[name]
    axes = np.array(consumer.axes)
    assert_allclose(axes @ axes.T, np.eye(3), atol=0.0)
    assert consumer.handedness == ("left" if name == "unity" else "right")
    # a camera of a y-up program looks to -z, of Unity to z: to the north in both
    if name in ("mitsuba", "usd", "godot", "three"):
        assert_allclose(consumer.direction(NORTH), [0.0, 0.0, -1.0], atol=0.0)
    elif name == "unity":
        assert_allclose(consumer.direction(NORTH), [0.0, 0.0, 1.0], atol=0.0)
    assert_allclose(consumer.direction(EAST), [1.0, 0.0, 0.0], atol=0.0)


def test_a_dome_has_its_front_at_the_bottom_and_the_west_on_the_right_of_the_south() -> None:
    camera = map_camera(CONSUMERS["dome"], 100, 100, 30.0)
    low = 0.01 * UP
    x, y = texel_positions(camera, (np.stack([low - NORTH, low - EAST]) @ enu_from_local(30.0)))
    assert_allclose([x[0], y[0]], [50.0, 100.0], atol=1.0)
    assert_allclose([x[1], y[1]], [100.0, 50.0], atol=1.0)


def test_a_tilted_dome_shows_what_is_below_the_horizon_of_its_front() -> None:
    tilted = CONSUMERS["dome"].facing(180.0, 15.0)
    camera = map_camera(tilted, 180, 180, 0.0)
    low, high = np.radians(-14.5), np.radians(15.5)
    front = np.array([0.0, -np.cos(low), np.sin(low)])
    rear = np.array([0.0, np.cos(high), np.sin(high)])
    x, y = texel_positions(camera, np.stack([front, rear]) @ enu_from_local(0.0))
    assert_allclose(x, 90.0, atol=1e-9)
    assert_allclose(y, [179.5, 0.5], atol=1e-9)


@pytest.mark.parametrize(("front", "tilt"), [(400.0, 0.0), (0.0, -1.0), (0.0, 91.0)])
def test_a_dome_s_front_out_of_range_is_refused(front: float, tilt: float) -> None:
    with pytest.raises(ParameterError, match="deg"):
        CONSUMERS["dome"].facing(front, tilt)


def test_a_front_of_what_is_no_dome_is_refused() -> None:
    with pytest.raises(ParameterError, match="dome"):
        consumer_named("usd").facing(180.0, 0.0)


def test_an_unknown_program_is_refused_with_those_that_are_known() -> None:
    with pytest.raises(ParameterError, match="blender, mitsuba"):
        consumer_named("maya")
