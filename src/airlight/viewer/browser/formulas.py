"""Formulas that a page evaluates itself, emitted as JavaScript on demand."""

from __future__ import annotations

import json
from collections.abc import Callable
from functools import cache
from typing import Any, Final

from airlight.geometry.ephemeris import moon_formula, sun_formula
from airlight.geometry.refraction import apparent_sun_cosine
from airlight.image.cool_exposure import cool_share
from airlight.image.exposure import eased, metered_light, unlit_exposure
from airlight.image.glare import glare_levels, glare_share
from airlight.image.sky_magnitude import sky_magnitude
from airlight.image.star_exposure import exposure_with_stars
from airlight.image.white_balance import scene_weight, white_gains
from airlight.image.xyz import luminance_of
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.moon_phase import moon_phase_factor
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.javascript import JAVASCRIPT
from airlight.render.gpu.emit.shader_types import (
    F32,
    I32,
    VEC3,
    VEC4,
    LocalArray,
    ShaderTable,
    Value,
)
from airlight.render.pixels.disc_shading import OCCULTER, SHADING, phase_shading
from airlight.render.pixels.occulted_light import disc_factor, light_left
from airlight.render.pixels.scenes_by_light import light_visibility
from airlight.render.pixels.view_uniforms import observer_uniforms
from airlight.scene import flight, great_circle, ground_detail, sun_time
from airlight.scene.directions import camera_frame, direction_of, rolled
from airlight.scene.metering import dehazed_exposure, left_out, metering_weight
from airlight.scene.moon_light import bright_limb
from airlight.scene.observer import ground_axes
from airlight.scene.projections import PROJECTIONS
from airlight.scene.projections.projected import projected_ray
from airlight.solver.moments import (
    convergence,
    elimination,
    iterate_update,
    packing,
    stopping,
    synthetic_acceleration,
    synthetic_operator,
)
from airlight.solver.moments.acceleration import combine
from airlight.solver.moments.delta_m import delta_m_scaling
from airlight.viewer.parameters.turbidity import haze_of, turbidity_of


def _table(rank: int) -> ShaderTable:
    """Table of numbers; parameters give the names."""
    return ShaderTable("table", rank)


def _lanes(rank: int) -> ShaderTable:
    """Table of lanes."""
    return ShaderTable("table", rank, spectral=True)


#: Tables of a metered picture.
_STARS: Final = ("bright", "weight", "near", "light", "cool")
#: Formulas with the types of their arguments, by default all numbers. An array that a formula
#: writes to may have any length.
FORMULAS: Final[dict[Callable[..., Any], tuple[Value, ...]]] = {
    direction_of: (),
    camera_frame: (),
    rolled: (VEC3, VEC3, F32),
    ground_axes: (),
    observer_uniforms: (),
    apparent_sun_cosine: (F32, F32, F32, F32, ShaderTable("refraction_table", 3)),
    luminance_of: (),
    exposure_with_stars: (*(ShaderTable(one) for one in _STARS), I32, F32, F32, F32),
    metered_light: (),
    cool_share: (),
    unlit_exposure: (),
    eased: (),
    scene_weight: (),
    white_gains: (I32, *(F32 for _ in range(6))),
    left_out: (),
    dehazed_exposure: (),
    metering_weight: (I32, *(F32 for _ in range(5)), VEC3, F32),
    projected_ray: (I32, *(F32 for _ in range(5))),
    glare_levels: (),
    sky_magnitude: (),
    glare_share: (),
    great_circle.compass: (),
    ground_detail.finest_cell: (),
    ground_detail.lattice_origin: (),
    flight.climbed: (),
    flight.course_of: (),
    flight.angle_flown: (),
    flight.turned: (),
    flight.looked: (),
    flight.risen: (),
    flight.horizon_kept: (),
    flight.turns_planet: (),
    flight.planet_hidden: (),
    flight.angle_dragged: (),
    flight.sun_dragged: (),
    sun_time.sun_at: (),
    sun_time.time_of: (),
    sun_time.sun_on_date: (),
    sun_formula.days_of_date: (),
    sun_formula.date_after: (),
    moon_formula.moon_on_date: (),
    bright_limb: (),
    moon_phase_factor: (),
    phase_shading: (),
    light_visibility: (),
    light_left: (),
    disc_factor: (),
    stopping.stricter_tolerance: (),
    stopping.is_converged: (),
    stopping.logarithmic_progress: (),
    convergence.counted_changes: (
        _table(3),
        _table(3),
        _table(1),
        F32,
        _table(1),
        _table(2),
        _table(1),
    ),
    convergence.tail_steps: (I32,),
    convergence.geometric_tail: (F32, F32, I32),
    combine: (LocalArray(1), I32, LocalArray(1)),
    convergence.add_weighted: (_table(4), _table(4), _table(1)),
    convergence.damp_towards: (_table(4), _table(4), _table(3)),
    convergence.replace_unsound: (_table(4), _table(4), _table(3)),
    iterate_update.accelerate_nodes: (*[_table(3)] * 4, _table(2), _table(1), F32, _table(3)),
    iterate_update.fill_quantities: (_table(4), _table(4), I32, _table(4), _table(4)),
    convergence.is_near: (),
    convergence.is_positive: (),
    convergence.lateral_threshold_of: (),
    packing.floor_below: (),
    convergence.acceleration_weight: (),
    node_value: (F32, F32, F32, ShaderTable("first_nodes"), ShaderTable("row")),
    synthetic_acceleration.lateral_diffusion_equations: (
        _table(1),
        F32,
        F32,
        LocalArray(1),
        LocalArray(1),
    ),
    synthetic_acceleration.take_terms: (_lanes(3), _lanes(2), I32, I32, I32, _lanes(2)),
    synthetic_acceleration.spread_onto: (
        _table(2),
        _lanes(2),
        _table(1),
        I32,
        _lanes(1),
        _lanes(2),
    ),
    synthetic_acceleration.multiply: (_lanes(2), _lanes(2), _lanes(2)),
    synthetic_operator.gather_levels: (_table(2), _lanes(3), _lanes(3)),
    synthetic_operator.project_radii: (_table(2), _lanes(3), I32, I32, _lanes(2)),
    elimination.factorise: (LocalArray(1, VEC4), I32),
    elimination.substitute: (LocalArray(1, VEC4), I32, LocalArray(1, VEC4), I32),
    delta_m_scaling: (*[_table(2)] * 2, *[_table(3)] * 2, _table(1), I32, *[LocalArray(1)] * 4),
    turbidity_of: (),
    haze_of: (),
    packing.optically_thick_weight: (),
    packing.level_weight: (),
}


@cache
def emitted_formulas() -> Emitter:
    """Emitter of all formulas in JavaScript, with the functions that they call."""
    emitter = Emitter(JAVASCRIPT)
    for function, given in FORMULAS.items():
        plain = getattr(function, "py_func", function)
        emitter.add(function, *(given or (F32,) * plain.__code__.co_argcount))
    for name, form in PROJECTIONS.items():
        emitter.add(form.pixel_angle, F32, F32, F32, name=_pixel_angle(name))
    return emitter


def _pixel_angle(projection: str) -> str:
    """JavaScript name of a projection's function; names of projections may have hyphens."""
    return f"pixel_angle_{projection.replace('-', '_')}"


@cache
def formulas_text() -> str:
    """Text of ``generated/formulas.js``: formulas, and properties of projections."""
    angles = ", ".join(f"{json.dumps(name)}: {_pixel_angle(name)}" for name in PROJECTIONS)
    aspects = {name: form.aspect for name, form in PROJECTIONS.items()}
    connected = [name for name, form in PROJECTIONS.items() if form.connected]
    parallel = [name for name, form in PROJECTIONS.items() if form.parallel]
    circular = [name for name, form in PROJECTIONS.items() if form.circular]
    tables = (
        f"export const PIXEL_ANGLES = {{ {angles} }};\n"
        f"export const CONNECTED = {json.dumps(connected)};\n"
        f"export const PARALLEL = {json.dumps(parallel)};\n"
        f"export const CIRCULAR = {json.dumps(circular)};\n"
        f"export const ASPECTS = {json.dumps(aspects)};\n"
        f"export const SHADING = {json.dumps(SHADING)};\n"
        f"export const OCCULTER = {json.dumps(OCCULTER)};\n"
        f"export const WORLDS = {json.dumps(sun_formula.NUMBERED)};\n"
    )
    return f"{emitted_formulas().functions_text()}\n{tables}"
