"""``CloudTables`` of a frame from the light of clouds and the solution of the planet."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.threads import Cancel, Progress
from airlight.render.clouds.air_table import DIRECTIONS, air_table
from airlight.render.clouds.cloud_deck import solved_wavelengths
from airlight.render.clouds.cloud_light import CloudLight
from airlight.render.clouds.cloud_tables import SOLVED, CloudTables, LayerTables
from airlight.render.clouds.detail_levels import Cells, detail_levels, joins, stacked
from airlight.render.clouds.directions import harmonic_norms
from airlight.render.clouds.higher_orders import InnerSource, no_inner
from airlight.render.clouds.incident_light import sun_in_frame
from airlight.render.clouds.layer_geometry import layer_geometry
from airlight.render.pixels.sky_view_lut import Observer
from airlight.render.pixels.sky_view_window import coarse_window
from airlight.solver.boxes.directions import degrees
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.moments.march_tables import MarchTables
from airlight.solver.moments.packing import pack

if TYPE_CHECKING:
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Nodes of the phase function, altitudes and angles of the beam.
_PHASES: Final = 40001
_ALTITUDES: Final = 4
_ANGLES: Final = 256
#: Least irradiance of the star's, and largest ratio of that of two places. [1]
_DARK: Final = 1e-12
_MOST: Final = 1000.0


def cloud_tables(
    lights: Sequence[CloudLight],
    solution: MomentsSolution,
    scene: Scene,
    tables: MarchTables,
    observer: Observer,
    *,
    directions: tuple[int, int] = DIRECTIONS,
    polarised: bool = False,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> CloudTables:
    """Tables of the pixels of a frame.

    Parameters
    ----------
    lights : sequence of CloudLight
        Light of each of the clouds, by ascending tops.
    solution, scene : MomentsSolution, Scene
        Solution and scene under the same light.
    tables, observer : MarchTables, Observer
        Tables and observer of the frame.
    directions : tuple of two int
        Azimuths from 0 to π of the table of the air, and rows of each half.
    polarised : bool
        Whether Q and U are seen.
    """
    radius = solution.medium.bottom_radius
    base = radius + min(light.field.base for light in lights)
    top, eye = radius + max(light.field.top for light in lights), radius + scene.altitude
    window = coarse_window(scene.camera, observer, tables.bottom, tables.top, directions)
    air, beyond = air_table(
        solution.geometry,
        tables,
        observer,
        window,
        (eye, radius, base, top),
        lights[0].layer,
        polarised=polarised,
        progress=progress,
        cancel=cancel,
    )
    return CloudTables(
        radius=radius,
        eye=eye,
        base=base,
        top=top,
        pixel_angle=float(scene.camera.pixel_angle),
        layers=tuple(_layer(light, solution, scene, observer, polarised) for light in lights),
        window=window,
        air=air,
        beyond=beyond,
    )


def _layer(
    light: CloudLight,
    solution: MomentsSolution,
    scene: Scene,
    observer: Observer,
    polarised: bool,
) -> LayerTables:
    """Tables of one of the clouds."""
    box, optics = light.box, light.optics
    beam, low, high = _beam(light, solution, scene)
    sines = np.linspace(low, high, _ANGLES)
    if observer.orders == 0:
        beam = np.zeros_like(beam)
    scaled = light.scaled
    radius, eye = solution.medium.bottom_radius, solution.medium.bottom_radius + scene.altitude
    base, top = radius + light.field.base, radius + light.field.top
    # lines of sight leave the clouds beyond the horizon at most
    reach = math.sqrt(max(eye**2 - radius**2, 0.0)) + math.sqrt(top**2 - radius**2)
    count = joins(light.field, reach * float(scene.camera.pixel_angle))
    key = count, eye > 0.5 * (base + top), observer.orders == 1, polarised
    return LayerTables(
        **light.arrays.of(key, lambda: _arrays(light, *key)),
        **layer_geometry(light.field, scene, solution.medium.bottom_radius),
        sun=sun_in_frame(scene),
        mean_visibility=float(light.visibility(light.field.base).mean()),
        solved_extinction=_twice(np.asarray(box.scaled.cloud, np.float32)[None], missing=1.0),
        spectrum=pack(light.spectrum),
        scaled=pack(scaled[None]),
        whole=pack(np.asarray(optics.extinction)[None]),
        single=pack((np.asarray(optics.extinction) * np.asarray(optics.albedo))[None]),
        norms=harmonic_norms(box.degree),
        beam=pack(beam),
        beam_low=low,
        beam_high=high,
        slant=light.local.depth_over(sines, light.towards[2]),
        local=_local(light, solution, sines),
    )


def _arrays(
    light: CloudLight, count: int, above: bool, single: bool, polarised: bool
) -> dict[str, Any]:
    """Tables of one of the clouds that frames share: cells with their light, phase functions."""
    optics, factor = light.optics, 0.0 if single else 1.0
    nu = 1.0 - 2.0 * np.linspace(0.0, 1.0, _PHASES) ** 2
    phase = optics.phase.values(nu, optics.wavelengths)
    phase_f12 = np.zeros_like(phase[:2])
    if polarised:
        phase_f12 = optics.phase.phase_f12(nu, optics.wavelengths)
    finest = Cells(
        extinction=np.ascontiguousarray(light.field.extinction.transpose(2, 1, 0)),
        clear=light.clear,
        depth=light.depth,
        base_depth=light.base_depth,
        source=_source(light.box, factor),
        down=_twice(light.box.down.transpose(1, 0, 2) * np.float32(factor)),
    )
    return {
        **stacked(detail_levels(light, finest, count, above)),
        "inner": _inner(light, factor),
        "phase": pack(phase[:, None]),
        "phase_f12": pack(phase_f12[:, None]),
    }


def _local(light: CloudLight, solution: MomentsSolution, sines: FloatArray) -> Float32Array:
    """Higher orders under the suns of sines over those under the sun of the box."""
    own = light.towards[2]
    mu_s = np.append(sines, own)
    r = np.full(mu_s.size, solution.medium.bottom_radius + light.field.top)
    sky = solution.relative_sky_irradiance(r, mu_s)
    if light.layer is not None:
        sky = sky * light.layer.sky_ratio(r, mu_s)
    beam = np.maximum(solution.relative_normal_irradiance(r, mu_s), 0.0)
    received = sky + beam * np.maximum(mu_s, 0.0)[:, None]
    received = received[:, solved_wavelengths(received.shape[1])]
    ratio = received[:-1] / np.maximum(received[-1], _DARK)
    found = light.local.light_over(sines, own) * np.clip(ratio, 0.0, _MOST)[:, None]
    return _twice(found.astype(np.float32), missing=1.0)


def _twice(values: Float32Array, missing: float = 0.0) -> Float32Array:
    """Solved wavelengths in both halves of eight lanes, and a value where there is none."""
    half = np.full((*values.shape[:-1], SOLVED), missing, np.float32)
    half[..., : values.shape[-1]] = values
    return np.ascontiguousarray(np.concatenate([half, half], axis=-1))


def _source(box: BoxSolution, factor: float) -> Float32Array:
    """Multiple scattering by a cloud of extinction 1 in a box, times a factor. [sr⁻¹]"""
    per_degree = np.asarray(box.scaled.cloud_source)[degrees(box.degree)]
    return _in_pairs(box.moments[:, :, box.below :], (factor * per_degree).astype(np.float32))


def _inner(light: CloudLight, factor: float) -> InnerSource:
    """Source of the finer box."""
    inner, field = light.inner, light.box.field
    if inner is None:
        return no_inner()
    east, north, _ = light.field.spacing
    corner = inner.field.west - field.west, inner.field.south - field.south
    wide, long = inner.field.sides
    return InnerSource(
        corner[0] / east,
        corner[1] / north,
        wide / east,
        long / north,
        inner.moments.shape[0],
        inner.moments.shape[1],
        _source(inner, factor),
    )


def _in_pairs(moments: Float32Array, factors: Float32Array) -> Float32Array:
    """Moments (nx, ny, nz, terms, solved) times factors, as (nz, ny, nx, pairs, 8)."""
    nx, ny, nz, terms, count = moments.shape
    pairs = (terms + 1) // 2
    out = np.zeros((nz, ny, nx, 2 * pairs, SOLVED), np.float32)
    np.multiply(moments.transpose(2, 1, 0, 3, 4), factors, out=out[..., :terms, :count])
    return out.reshape(nz, ny, nx, pairs, 2 * SOLVED)


def _beam(
    light: CloudLight, solution: MomentsSolution, scene: Scene
) -> tuple[FloatArray, float, float]:
    """Direct normal irradiance by altitude and by the sine of the light's height, and its range."""
    radius, field = solution.medium.bottom_radius, light.field
    top, eye = radius + field.top, radius + scene.altitude
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
