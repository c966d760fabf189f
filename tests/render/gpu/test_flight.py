"""Continuity on a flight from the ground to deep space, and across the horizon behind an object.

The method of drawing changes there: the sky-view LUT has one mapping inside the shell and
another outside; the horizon separates its halves; lines that graze the ground have more points.
"""

from __future__ import annotations

from collections.abc import Callable
from math import sqrt
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight import Camera, Scene, load_planet, look_at, render
from airlight.image.xyz import rgb_to_xyz
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import empty_flat_texture, flat_texture, read_flat
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import F32, FLAT_WIDTH, VEC4, LocalArray
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.picture.gpu_renderer import GpuRenderer, view_uniforms
from airlight.render.gpu.picture.shaders import assembled, filled_by, march_workspace
from airlight.render.gpu.picture.uniforms import FRAME
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.march import march
from airlight.solver.moments.march_tables import MarchTables, MarchTerms, Segment
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.moments.source import read_phase
from airlight.solver.tables.ring_shadow import no_rings

NM = (440.0, 500.0, 560.0, 620.0)


@pytest.fixture(scope="module")
def earth(solved: Callable[..., MomentsSolution]) -> MomentsSolution:
    """Solution of the Earth, preview, light straight: so are the rays by which it is asked here."""
    return solved(load_planet("earth", {"refraction": "none"}), NM, "preview")


@pytest.fixture(scope="module")
def pictures(device: Device, earth: MomentsSolution) -> GpuRenderer:
    """Pictures of it, with a table a quarter as high and as wide as by default."""
    made = GpuRenderer(device, (64, 64))
    made.set_solution(earth)
    return made


def flown(altitude: float, earth: MomentsSolution) -> Scene:
    """View along a fixed heading, slightly below the horizon at any altitude."""
    bottom = earth.medium.bottom_radius
    zenith, _ = look_at("horizon", altitude=altitude, sun_zenith=70.0, bottom_radius=bottom)
    far = np.degrees(np.arcsin(bottom / (bottom + altitude)))
    camera = Camera(
        width=32, height=18, look_zenith=min(zenith + 0.3 * far, 180.0), look_azimuth=40.0,
        field_of_view=max(0.9 * far, 2.0),
    )  # fmt: skip
    return Scene(altitude=altitude, sun_zenith=70.0, camera=camera)


def means(
    pictures: GpuRenderer, earth: MomentsSolution, altitudes: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Mean luminance of each frame by the GPU and by the CPU."""
    found = []
    for altitude in altitudes:
        scene = flown(float(altitude), earth)
        drawn = pictures.render(scene, disc=False).rgb, render(earth, scene, exact=True).rgb
        found.append([rgb_to_xyz(rgb)[..., 1].mean() for rgb in drawn])
    return tuple(np.array(found).T)  # type: ignore[return-value]


@pytest.mark.validation
def test_no_frame_of_a_flight_to_deep_space_jumps(
    pictures: GpuRenderer, earth: MomentsSolution, tell: Callable[[str], None]
) -> None:
    # The CPU marches every pixel and has neither table nor mapping; both treat pixels at the limb
    # alike. Between two frames the GPU may change by as much as the CPU, and by 1e-3 more: the
    # contribution of its table, coarser here than by default, to the mean. The eye sees no step
    # below a hundredth.
    altitudes = np.geomspace(1.0, 1e8, 60)
    gpu, cpu = means(pictures, earth, altitudes)
    steps = np.diff(np.log(gpu)) - np.diff(np.log(cpu))
    worst = int(np.abs(steps).argmax())
    jump = f"{abs(steps[worst]):.1e} at {altitudes[worst]:.3g} m"
    tell(f"flight of {gpu.size} frames: largest jump {jump}")
    assert np.abs(steps).max() < 1e-3
    # and the frames themselves are those of one flight: no step is far from its neighbours'
    assert np.abs(np.diff(np.log(gpu), 2)).max() < 1.2 * np.abs(np.diff(np.log(cpu), 2)).max()


def test_the_top_of_the_air_is_crossed_without_a_jump(
    pictures: GpuRenderer, earth: MomentsSolution, tell: Callable[[str], None]
) -> None:
    # As above, a hundred metres a frame: the table's mapping changes between two of them.
    thickness = earth.medium.thickness
    altitudes = thickness + np.linspace(-1e3, 1e3, 20)
    gpu, cpu = means(pictures, earth, altitudes)
    steps = np.diff(np.log(gpu)) - np.diff(np.log(cpu))
    tell(f"across the top of the air: largest jump {np.abs(steps).max():.1e}")
    assert np.abs(steps).max() < 1e-3


def stretch(r, mu, mu_s, nu, half_sine, length, light, work, result):
    """Light of the air between an observer and an object, as the shaders march it."""
    read_phase(half_sine, light.phase, work.phase)
    segment = Segment(r, mu, mu_s, nu, half_sine, length, no_rings())
    march(segment, 2, MarchTerms(True, False, False), light, work, result)


@pytest.fixture(scope="module")
def stretches(device: Device, pictures: GpuRenderer) -> Callable[[np.ndarray], np.ndarray]:
    """Radiance per irradiance of air before objects: rows of r, μ, μs, ν, sin(θ/2), length."""
    import wgpu

    emitter = Emitter()
    made = emitter.add(
        stretch, *[F32] * 6, FRAME.struct_value(MarchTables), march_workspace(emitter),
        LocalArray(4, VEC4), name="light_of_stretch",
    )  # fmt: skip
    given = [f"number(item + {k})" for k in range(6)]
    base = assembled("stretch", {}, emitter).text
    text = f"""{base}
@group(0) @binding(9) var given: texture_2d<f32>;
fn number(index: i32) -> f32 {{ return textureLoad(given, vec2i(index & 2047, index >> 11), 0).x; }}
@fragment fn before_object(@builtin(position) at: vec4f) -> @location(0) vec4f {{
  let item = 6 * (i32(at.y) * {FLAT_WIDTH} + i32(at.x));
  {" ".join(filled_by(made, given, WGSL))}
  return result[0];
}}"""
    one = FragmentPass(device, text, "before_object", ["rgba32float"])

    def run(rows: np.ndarray) -> np.ndarray:
        textures = pictures._textures
        assert textures is not None
        numbers: dict[str, Any] = {
            **view_uniforms(Scene(), pictures._require_solution()),
            **textures.uniforms,
        }
        use = wgpu.BufferUsage.UNIFORM | wgpu.BufferUsage.COPY_DST
        values = FRAME.packed(
            {**numbers, "separated_1": -1.0, "separated_2": -1.0}, textures.places
        )
        uniforms = device.device.create_buffer(size=values.nbytes, usage=use)
        device.device.queue.write_buffer(uniforms, 0, values)
        target = empty_flat_texture(device, len(rows), 4)
        resources = {
            **textures.textures,
            "frame": uniforms,
            "given": flat_texture(device, rows.ravel()),
        }
        encoder = device.device.create_command_encoder()
        area = (0, 0, len(rows), 1)
        one.run(encoder, one.bind(resources), [target], area)
        device.device.queue.submit([encoder.finish()])
        return read_flat(device, target, len(rows)).astype(float)

    return run


def rows_of(
    earth: MomentsSolution, altitude: float, elevation: np.ndarray, length: np.ndarray
) -> tuple[np.ndarray, LinesOfSight]:
    """Stretches towards the sun's side, for the shader and for the CPU. [m], [rad]"""
    r = np.full(elevation.shape, earth.medium.bottom_radius + altitude)
    sun = np.radians(10.0)
    mu, mu_s = np.sin(elevation), np.full(elevation.shape, np.sin(sun))
    apart = sun - elevation
    nu = np.cos(apart)
    rows = np.stack([r, mu, mu_s, nu, np.sin(0.5 * np.abs(apart)), length], axis=-1)
    return rows, LinesOfSight(r, mu, mu_s, nu, length, np.zeros(elevation.shape, bool))


def horizon(earth: MomentsSolution, altitude: float) -> tuple[float, float]:
    """Elevation of the horizon [rad], negative, and its distance. [m]"""
    bottom = earth.medium.bottom_radius
    distance = sqrt(altitude * (altitude + 2.0 * bottom))
    return -float(np.arctan2(distance, bottom)), distance


@pytest.mark.parametrize("altitude", [100.0, 10e3])
def test_a_sphere_before_the_horizon_has_no_stripe(
    altitude: float, earth: MomentsSolution, stretches: Callable[[np.ndarray], np.ndarray],
    tell: Callable[[str], None],
) -> None:  # fmt: skip
    # Only the air before an object counts, whatever lies behind it: on a sphere half-way to the
    # horizon, which it covers, the radiance changes evenly from pixel to pixel; the line to the
    # horizon passes there at a quarter of the observer's height. A stripe, as from the difference
    # of two long paths, is a pixel that is far from the mean of its neighbours. 1e-3: rounding,
    # where a radius is accurate to half a metre.
    level, distance = horizon(earth, altitude)
    size = 0.2 * altitude
    offset = np.linspace(-0.9, 0.9, 121) * size
    elevation = level + offset / (0.5 * distance)
    length = 0.5 * distance - np.sqrt(size**2 - offset**2)
    rows, lines = rows_of(earth, altitude, elevation, length)
    seen = stretches(rows)
    # a second march
    assert_allclose(seen, earth.radiance_per_irradiance(lines, 2, ground=False)[:, :4], rtol=0.01)
    stripe = np.abs(0.5 * (seen[:-2] + seen[2:]) - seen[1:-1]) / seen[1:-1]
    tell(f"sphere before the horizon, from {altitude:g} m: largest stripe {stripe.max():.1e}")
    assert stripe.max() < 1e-3


def test_air_before_an_object_grows_evenly_past_the_horizon(
    earth: MomentsSolution, stretches: Callable[[np.ndarray], np.ndarray]
) -> None:
    # A line just above the horizon: for stretches that end before it, at it and behind it, each
    # step in length adds the contribution of that step's air, which changes slowly. A step at the
    # lowest point, behind which the march has one more leg, must stay invisible: below 1/2000 of
    # the radiance.
    level, distance = horizon(earth, 100.0)
    length = np.linspace(0.95, 1.05, 41) * distance
    rows, _ = rows_of(earth, 100.0, np.full(length.shape, level + 1e-5), length)
    seen = stretches(rows)
    gain = np.diff(seen, axis=0)
    assert (gain > 0.0).all()
    assert (np.abs(np.diff(gain, axis=0)) < 5e-4 * seen[1:-1]).all()
