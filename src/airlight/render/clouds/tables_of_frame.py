"""``CloudTables`` of a frame from the light of clouds and the solution of the planet."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds.air_table import DIRECTIONS, air_table
from airlight.render.clouds.cloud_light import CloudLight, field_axes, sun_in_frame
from airlight.render.clouds.cloud_tables import SOLVED, CloudTables
from airlight.render.clouds.directions import harmonic_norms
from airlight.render.clouds.patches import patch_edges
from airlight.render.pixels.sky_view_lut import Observer
from airlight.render.pixels.sky_view_window import coarse_window
from airlight.scene import Scene
from airlight.solver.boxes.directions import degrees
from airlight.solver.moments.march_tables import MarchTables
from airlight.solver.moments.packing import pack
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Nodes of the phase function, altitudes and angles of the beam.
_PHASES: Final = 40001
_ALTITUDES: Final = 4
_ANGLES: Final = 256


def cloud_tables(
    light: CloudLight,
    solution: MomentsSolution,
    scene: Scene,
    tables: MarchTables,
    observer: Observer,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> CloudTables:
    """Tables of the pixels of a frame.

    Parameters
    ----------
    light : CloudLight
        Light of the clouds.
    solution, scene : MomentsSolution, Scene
        Solution and scene under the same light.
    tables, observer : MarchTables, Observer
        Tables and observer of the frame.
    """
    field, box, optics, camera = light.field, light.box, light.optics, scene.camera
    radius = solution.medium.bottom_radius
    base, top, eye = radius + field.base, radius + field.top, radius + scene.altitude
    east, north, up = field_axes(field, scene)
    moments = box.moments[:, :, box.below :]
    per_degree = np.asarray(box.scaled.cloud_source)[degrees(box.degree)]
    single_orders = observer.orders == 1
    factor = 0.0 if single_orders else 1.0
    source = moments * (factor * per_degree * light.unit).astype(np.float32)
    beam, low, high = _beam(light, solution, scene, eye)
    if observer.orders == 0:
        beam = np.zeros_like(beam)
    scaled = _scaled(light)
    nu = 1.0 - 2.0 * np.linspace(0.0, 1.0, _PHASES) ** 2
    phase = optics.phase.values(nu, optics.wavelengths)
    nothing = light.base_depth if light.base_depth.size else np.zeros(1)
    window = coarse_window(camera, observer, tables.bottom, tables.top, DIRECTIONS)
    return CloudTables(
        radius=radius,
        eye=eye,
        base=base,
        top=top,
        corner_x=field.west,
        corner_y=field.south,
        step_x=float(field.spacing[0]),
        step_y=float(field.spacing[1]),
        step_z=float(field.spacing[2]),
        periodic=field.beyond == "periodic",
        detailed=field.interpolated and scene.ground == "detailed",
        trail=field.trail,
        east=east,
        north=north,
        up=up,
        sun=sun_in_frame(scene),
        pixel_angle=float(camera.pixel_angle),
        mean_visibility=float(np.exp(-nothing * scaled.mean()).mean()),
        extinction=np.ascontiguousarray(field.extinction.transpose(2, 1, 0)),
        clear=light.clear,
        edges=patch_edges(*field.sides),
        depth=light.depth,
        base_depth=light.base_depth,
        source=_in_pairs(source),
        down=_twice(box.down.transpose(1, 0, 2) * (factor * light.unit).astype(np.float32)),
        solved_extinction=_twice(np.asarray(box.scaled.cloud, np.float32)[None], missing=1.0),
        spectrum=pack(light.spectrum),
        scaled=pack(scaled[None]),
        whole=pack(np.asarray(optics.extinction)[None]),
        single=pack((np.asarray(optics.extinction) * np.asarray(optics.albedo))[None]),
        phase=pack(phase[:, None]),
        norms=harmonic_norms(box.degree),
        beam=pack(beam),
        beam_low=low,
        beam_high=high,
        air_light=pack(light.air_light),
        window=window,
        air=air_table(
            solution.geometry,
            tables,
            observer,
            window,
            (eye, radius, base, top),
            progress=progress,
            cancel=cancel,
        ),
    )


def _scaled(light: CloudLight) -> FloatArray:
    """Delta-M scaled extinction over that at 550 nm, at all wavelengths. [1]"""
    optics, degree = light.optics, light.box.settings.degree
    moments = optics.phase.moments(optics.wavelengths, degree + 1)
    truncated = np.clip(moments[:, -1] / moments[:, 0], 0.0, 1.0)
    return np.asarray(optics.extinction * (1.0 - optics.albedo * truncated))


def _twice(values: Float32Array, missing: float = 0.0) -> Float32Array:
    """Solved wavelengths in both halves of eight lanes, and a value where there is none."""
    half = np.full((*values.shape[:-1], SOLVED), missing, np.float32)
    half[..., : values.shape[-1]] = values
    return np.ascontiguousarray(np.concatenate([half, half], axis=-1))


def _in_pairs(source: Float32Array) -> Float32Array:
    """Source (nx, ny, nz, terms, solved) as (nz, ny, nx, pairs, 8)."""
    nx, ny, nz, terms, count = source.shape
    pairs = (terms + 1) // 2
    out = np.zeros((nz, ny, nx, 2 * pairs, SOLVED), np.float32)
    out[..., :terms, :count] = source.transpose(2, 1, 0, 3, 4)
    return out.reshape(nz, ny, nx, pairs, 2 * SOLVED)


def _beam(
    light: CloudLight, solution: MomentsSolution, scene: Scene, eye: float
) -> tuple[FloatArray, float, float]:
    """Direct normal irradiance by altitude and by the sine of the light's height, and its range."""
    radius, field = solution.medium.bottom_radius, light.field
    top = radius + field.top
    reach = math.acos(radius / top) + math.acos(min(radius / max(eye, radius), 1.0)) + 0.02
    heights = [
        math.asin(min(max(sun, -1.0), 1.0)) for sun in (light.towards[2], sun_in_frame(scene).z)
    ]
    low = math.sin(max(min(heights) - reach, -0.5 * math.pi))
    high = math.sin(min(max(heights) + reach, 0.5 * math.pi))
    sines = np.linspace(low, high, _ANGLES)
    altitudes = np.linspace(radius + field.base, top, _ALTITUDES)
    r, mu_s = (one.ravel() for one in np.meshgrid(altitudes, sines, indexing="ij"))
    found = solution.relative_normal_irradiance(r, mu_s)
    return found.reshape(_ALTITUDES, _ANGLES, -1), low, high
