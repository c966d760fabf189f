"""Tables of aerial perspective against the march that fills them."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight import Camera, Scene, load_planet
from airlight.engines.composition.aerial_perspective import AerialPerspective
from airlight.engines.composition.aerial_shader import TEXTURES, aerial_shader
from airlight.errors import Cancelled, ParameterError
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.solver.moments.solution import MomentsSolution


def towards(elevation: float, azimuth: float) -> np.ndarray:
    """Unit vector, shape (1, 3); angles in degrees, azimuth from the sun's."""
    up, turn = np.radians([elevation, azimuth])
    level = np.cos(up)
    return np.array([[level * np.cos(turn), level * np.sin(turn), np.sin(up)]])


def test_small_tables_are_as_good_as_they_say(aerial: AerialPerspective) -> None:
    # a quarter of the texels of the default; the default's errors are in docs/compose.md
    reported = aerial.errors
    assert 0.0 < reported.air_median < 1e-3
    assert reported.air_median < reported.air_95 < 0.01
    assert 0.0 < reported.sky_median < 3e-3
    assert reported.sky_median < reported.sky_95 < 0.01
    assert reported.air_largest < 0.05
    assert reported.sky_largest < 0.05


def test_no_air_before_the_eye_and_all_of_it_far_away(aerial: AerialPerspective) -> None:
    unit = np.concatenate([towards(2.0, 30.0), towards(-3.0, 170.0), towards(88.0, 90.0)])
    radiance, transmittance = aerial.air(unit, np.zeros(3))
    assert_array_equal(radiance, 0.0)
    assert_array_equal(transmittance, 1.0)
    # in proportion before the nearest node
    near, half = (aerial.air(unit, np.full(3, d)) for d in (10.0, 5.0))
    assert_allclose(half[0], 0.5 * near[0], rtol=1e-6)
    assert_allclose(np.log(half[1]), 0.5 * np.log(near[1]), rtol=2e-3)
    # beyond the farthest as at it
    last, beyond = (aerial.air(unit, np.full(3, d)) for d in (200e3, 1e9))
    assert_array_equal(last[0], beyond[0])
    # where the line leaves the air, that is the sky
    assert_allclose(last[0][2], aerial.sky(unit)[2], rtol=5e-3)
    grown = [aerial.air(unit[:1], np.array([d]))[1][0, 2] for d in (1e2, 1e3, 1e4, 1e5)]
    assert (np.diff(grown) < 0.0).all()


def test_both_sides_of_the_sun_are_alike(aerial: AerialPerspective) -> None:
    left, right = towards(4.0, 25.0), towards(4.0, -25.0)
    assert_array_equal(aerial.sky(left), aerial.sky(right))
    assert_array_equal(aerial.air(left, [3e4])[0], aerial.air(right, [3e4])[0])


def test_the_disc_sends_what_arrives_from_the_sun(aerial: AerialPerspective) -> None:
    # White that faces the star gets 1 without air, so the disc's radiance times its solid angle is
    # π times the transmittance.
    tables = aerial.tables
    rng = np.random.default_rng(7)
    around = np.array([tables.star_x, 0.0, tables.star_z])
    aside = np.cross(around, [0.0, 1.0, 0.0])
    angle, reach = rng.uniform(0.0, 2.0 * np.pi, 4000), 0.02 * np.sqrt(rng.random(4000))
    unit = around + (reach * np.cos(angle))[:, None] * aside
    unit[:, 1] += reach * np.sin(angle)
    unit /= np.linalg.norm(unit, axis=1, keepdims=True)
    dark = AerialPerspective(
        tables._replace(air_star=0.0 * tables.air_star), aerial.scene, aerial.scale, aerial.errors
    )
    disc = aerial.sky(unit, pixel=2e-3) - dark.sky(unit, pixel=2e-3)
    received = disc.mean(axis=0) * np.pi * 0.02**2
    # the line to the sun leaves the air beyond the farthest node, where almost none is left
    transmittance = aerial.air(around[None], [200e3])[1][0]
    assert_allclose(received / np.pi, transmittance, rtol=0.08)


@pytest.mark.parametrize("dialect", [WGSL, GLSL])
def test_the_shader_needs_its_textures_alone(aerial: AerialPerspective, dialect: Any) -> None:
    text = aerial_shader(aerial, dialect)
    for name in TEXTURES:
        assert name in text
    for declared in ("uniform ", "@group", "#version", "sampler"):
        assert declared not in text.replace("without a sampler", "")


@pytest.mark.parametrize(
    ("scene", "given", "field"),
    [
        ({"altitude": 200e3}, {}, "scene.altitude"),
        ({"camera": Camera(polariser=30.0)}, {}, "camera.polariser"),
        ({}, {"nearest": 0.0}, "nearest"),
        ({}, {"nearest": 1e3, "farthest": 1.5e3}, "farthest"),
        ({}, {"size": (3, 24, 6)}, "size"),
        ({}, {"sky_size": (24, 1000)}, "size"),
    ],
)
def test_refused(
    earth: MomentsSolution, scene: dict[str, Any], given: dict[str, Any], field: str
) -> None:
    with pytest.raises(ParameterError) as refused:
        AerialPerspective.fill(earth, Scene(**scene), **given)
    assert refused.value.field == field


def test_cancelled(earth: MomentsSolution) -> None:
    with pytest.raises(Cancelled):
        AerialPerspective.fill(earth, Scene(), size=(4, 4, 4), cancel=lambda: True)


def test_a_planet_of_another_solver_is_refused(earth: MomentsSolution) -> None:
    with pytest.raises(ParameterError, match="of the moments solver"):
        AerialPerspective.fill("earth", Scene())  # type: ignore[arg-type]


def test_mars(solved: Callable[..., MomentsSolution]) -> None:
    mars = solved(load_planet("mars-standard"), (440.0, 550.0, 620.0), "preview")
    made = AerialPerspective.fill(
        mars, Scene(altitude=20.0, sun_zenith=50.0), farthest=50e3, size=(24, 24, 6),
        sky_size=(48, 48),
    )  # fmt: skip
    # the dust's aureole between 24 azimuths
    assert made.errors.air_95 < 0.05
    red, _, blue = made.air(towards(0.5, 120.0), [30e3])[0][0]
    assert red > 1.5 * blue
