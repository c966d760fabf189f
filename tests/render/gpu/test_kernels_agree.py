"""Scalar formulas on the GPU against the same functions compiled for the CPU.

Reference: Numba in double precision, of the inputs rounded to single precision, so that only the
shader's own rounding differs. EPS is the unit of that rounding. Where a tolerance exceeds a few
EPS, a comment gives the reason: how much the formula amplifies the rounding of its steps.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry import path, refraction, shell, sun_disc, vectors
from airlight.geometry.mappings import sky_view, transmittance
from airlight.geometry.vectors import Vec3
from airlight.image import (
    aces,
    adaptation,
    agx,
    dither,
    encoding,
    eye,
    gamut,
    natural,
    oklab,
    tone_maps,
    white_balance,
    xyz,
)
from airlight.image.encoding import ENCODINGS
from airlight.image.floating import physical_light
from airlight.image.gamut import in_gamut
from airlight.image.tone_maps import TONE_MAPS
from airlight.physics.optics import (
    bare_surface,
    clouds,
    cox_munk,
    fresnel,
    hapke,
    moon_phase,
    phase_functions,
    reflection,
    rpv,
    water,
)
from airlight.physics.optics.reflection import LAWS, Reflection
from airlight.render.gpu.emit.shader_types import Constant, ShaderTable, StructValue
from airlight.render.gpu.solver import ray_sums
from airlight.render.pixels import disc_shading, ground_angles, sky_view_lut, star_disc
from airlight.scene import ground_detail, ground_place
from airlight.scene.projections import PROJECTIONS
from airlight.scene.projections.cubemap import cube_ray
from airlight.scene.projections.equirectangular import panorama_ray
from airlight.scene.projections.fisheye import fisheye_ray
from airlight.scene.projections.octahedral import octahedral_ray
from airlight.scene.projections.orthographic import orthographic_ray
from airlight.scene.projections.perspective import perspective_ray
from airlight.scene.projections.projected import projected_ray, projected_rays
from airlight.solver.moments import convergence, harmonics, levels, march, packing, ray_optics

EPS = 2.0**-23
COUNT = 3000

BOTTOM, TOP = 6360e3, 6460e3


def uniform(low: float, high: float, seed: int) -> np.ndarray:
    return np.random.default_rng(seed).uniform(low, high, COUNT)


R = uniform(BOTTOM, TOP, 1)
MU = uniform(-1.0, 1.0, 2)
MU_S = uniform(-1.0, 1.0, 3)
UNIT = uniform(0.0, 1.0, 4)
LENGTH = uniform(1e3, 1e6, 5)
FAR = np.geomspace(1.01 * TOP, 1e9, COUNT)
SINE = np.sqrt(1.0 - MU**2)


def agree(
    on_gpu: Callable[..., Any], function: Any, inputs: tuple[Any, ...], rtol: float, atol: Any
) -> None:
    """Compare every result; ``atol`` is one for all or one for each."""
    seen = on_gpu(function, *inputs)
    flat = [part for one in inputs for part in (one if isinstance(one, tuple) else (one,))]
    single = [np.asarray(one, np.float32) for one in flat]
    exact = [
        wide.astype(np.float64) if np.asarray(one).dtype.kind == "f" else np.asarray(one)
        for wide, one in zip(single, flat, strict=True)
    ]
    rows = zip(*(one.tolist() for one in np.broadcast_arrays(*exact)), strict=True)
    expected = [function(*grouped(row, inputs)) for row in rows]
    if not isinstance(seen, tuple):
        seen, expected = (seen,), [(one,) for one in expected]
    for i, one in enumerate(seen):
        wanted = np.array([row[i] for row in expected])
        if one.dtype == np.bool_:
            assert_array_equal(one, wanted)
            continue
        limit = atol[i] if isinstance(atol, tuple) else atol
        assert_allclose(one, wanted, rtol=rtol, atol=limit, err_msg=f"result {i}")


def grouped(row: tuple[Any, ...], inputs: tuple[Any, ...]) -> list[Any]:
    """Arguments of one call, with the NamedTuples of the inputs."""
    left = iter(row)
    return [
        type(one)(*(next(left) for _ in one)) if isinstance(one, tuple) else next(left)
        for one in inputs
    ]


class Case(NamedTuple):
    """Kernel, its inputs, and the tolerance for single precision."""

    function: Any
    inputs: tuple[Any, ...]
    rtol: float = 8.0 * EPS
    atol: Any = 0.0


#: Sums and differences of lengths of the planet's size. [m]
METRES = 4.0 * EPS * TOP
#: The square of a chord is a difference of squares of 4e13 m²: where the chord is zero, rounding
#: is an error of sqrt(2 EPS) R, 3 km; the error falls as the chord grows.
NEAR_TANGENT = math.sqrt(2.0 * EPS) * TOP
#: An angle of a few rad and its functions.
ANGLE = 4.0 * EPS
#: Radii close to the ground, with a near horizon: r - R is exact in single precision.
LOW = BOTTOM + np.geomspace(0.5, 1e3, COUNT)

GEOMETRY = [
    Case(shell.chord, (R, MU, TOP), atol=METRES),
    Case(shell.chord, (R, MU, BOTTOM), atol=NEAR_TANGENT),
    Case(shell.distance_to_top, (R, MU, TOP), atol=METRES),
    Case(shell.distance_to_bottom, (R, uniform(-1.0, -0.3, 6), BOTTOM), atol=METRES),
    Case(shell.horizon_cosine, (R, BOTTOM)),
    Case(shell.horizon_cosine, (LOW, BOTTOM)),
    Case(shell.radius_along, (R, MU, LENGTH)),
    # From far away the observer's distance, up to 1e9 m, is rounded.
    Case(shell.distance_to_shell, (FAR, -np.sqrt(1 - (0.9 * TOP * UNIT / FAR) ** 2),
         0.9 * TOP * UNIT / FAR, TOP), atol=(4.0 * EPS * 1e9, ANGLE)),
    Case(shell.first_intersection, (0.99 * BOTTOM * UNIT, uniform(0.0, 0.9, 7), BOTTOM),
         atol=METRES),
    Case(path.ray_length, (R, uniform(-1.0, -0.3, 6), BOTTOM, TOP), atol=METRES),
    Case(path.ray_length, (R, uniform(0.05, 1.0, 8), BOTTOM, TOP), atol=METRES),
    # Over 1 - ν², at least 0.19 here.
    Case(path.shadow_edges, (R, uniform(-0.3, 0.3, 9), uniform(-0.9, -0.3, 10),
         uniform(-0.9, 0.9, 11), BOTTOM), atol=METRES / 0.19),
    Case(path.panel_point, (LENGTH, UNIT < 0.5, R, LENGTH, 100.0 * UNIT, 300.0 * UNIT,
         uniform(0.0, 1.0, 12)), atol=METRES),
    # Over the sine, at least 0.14 here.
    Case(refraction.turned, (uniform(-0.99, 0.99, 13), MU_S, MU, uniform(0.0, 0.02, 14)),
         atol=ANGLE / 0.14),
    Case(refraction.refraction_angle, (R, MU, 1e-11, uniform(0.0, 1e6, 15))),
    Case(sun_disc.sun_elevation, (R, uniform(-0.1, 0.1, 16), BOTTOM), atol=ANGLE),
    Case(sun_disc.sun_elevation, (LOW, uniform(-0.1, 0.1, 16), BOTTOM), atol=ANGLE),
    Case(sun_disc.star_elevation, (R, MU_S, BOTTOM), atol=ANGLE),
    # The rim's arc cosine changes fast where the segment's area hardly changes.
    Case(sun_disc.visible_fraction, (uniform(-0.006, 0.006, 17), 0.00465), atol=ANGLE),
    # Near ±1 the arc sine, but not the result, is steep.
    Case(sun_disc.mean_incidence, (uniform(-0.9, 0.9, 18), 0.00465), atol=ANGLE),
    Case(sun_disc.mean_incidence, (uniform(-0.006, 0.006, 19), 0.00465), atol=0.006 * ANGLE),
    Case(sun_disc.mean_cosine, (uniform(-0.006, 0.006, 17), uniform(-0.006, 0.006, 17), 0.00465),
         atol=0.006 * ANGLE),
    # The variance is a difference of squares of order 1 (in radii), the deviation at least 0.03.
    Case(sun_disc.visible_spread, (uniform(-0.0040, 0.006, 17), 0.00465),
         atol=0.00465 * 16 * EPS / (2.0 * 0.03)),
]  # fmt: skip

HORIZON = -0.17  # as from 95 km above the Earth
HORIZON_SINE = math.sqrt(1.0 - HORIZON**2)
MAPPINGS = [
    Case(transmittance.altitude_coordinate, (R, BOTTOM, TOP)),
    Case(transmittance.altitude_coordinate, (LOW, BOTTOM, TOP)),
    Case(transmittance.radius_from_coordinate, (UNIT, BOTTOM, TOP)),
    # Lengths accurate to METRES, over the span between shortest and longest, above 1000 km.
    Case(transmittance.direction_coordinate, (R, uniform(0.05, 1.0, 8), BOTTOM, TOP),
         atol=METRES / 1000e3),
    # Quotients of order 1, whose difference is taken.
    Case(transmittance.cosine_from_coordinate, (uniform(0.02, 1.0, 18), R, BOTTOM, TOP),
         atol=ANGLE),
    Case(sky_view.angle_above_horizon, (MU, SINE, HORIZON, HORIZON_SINE), atol=ANGLE),
    Case(sky_view.row_from_angle, (uniform(-1.3, 1.7, 19), HORIZON)),
    Case(sky_view.direction_from_row, (UNIT, UNIT < 0.3, HORIZON, HORIZON_SINE), atol=ANGLE),
    Case(sky_view.row_from_impact, (uniform(0.0, BOTTOM - 1e3, 20), BOTTOM, TOP)),
    Case(sky_view.row_from_impact, (uniform(BOTTOM + 1e3, TOP, 21), BOTTOM, TOP)),
    Case(sky_view.impact_from_row, (UNIT, UNIT < 0.4, BOTTOM, TOP), atol=METRES),
]  # fmt: skip

#: 1 - ν is exact, but for g < 0 the base is a difference: (1 - |g|)² of terms of order (1 + |g|)²,
#: which gives 20 EPS at g = -0.8, raised to the power 3/2.
PHASES = [
    Case(phase_functions.rayleigh, (MU, 0.035)),
    Case(phase_functions.rayleigh_modified, (MU,)),
    Case(phase_functions.cornette_shanks, (MU, uniform(-0.8, 0.95, 22)), rtol=128 * EPS),
    Case(phase_functions.henyey_greenstein, (MU, uniform(-0.8, 0.95, 22)), rtol=128 * EPS),
    Case(phase_functions.double_henyey_greenstein, (MU, 0.8, -0.3, UNIT)),
]

LIGHTS = tuple(
    np.geomspace(1e-4, 1e3, COUNT)[np.random.default_rng(23 + c).permutation(COUNT)]
    for c in range(3)
)
#: WGSL's table of accuracy gives log₂ and 2ˣ an error of 2⁻²¹ and of 3 + 2|x| units: for powers up
#: to 2.4 of numbers down to 1e-4, 64 EPS.
POWER = 64 * EPS
UNITS = tuple(uniform(0.0, 1.0, 33 + c) for c in range(3))
CHROMA = (uniform(-0.3, 0.3, 36), uniform(-0.3, 0.3, 37))
#: What the cones' roots of red colours differ by from their lightness, beyond the gamut.
SATURATED = (uniform(0.1, 0.3, 38), uniform(-0.1, -0.03, 39), uniform(-0.4, -0.1, 40))
#: Reciprocal distance of a grey to white.
UP = uniform(1.0, 20.0, 41)
PIXELS = np.random.default_rng(42).integers(0, 65536, (2, COUNT)) + 0.5
COLORS = [
    Case(physical_light, LIGHTS[:1], rtol=EPS),
    Case(xyz.luminance_of, LIGHTS),
    Case(tone_maps.exponential_curve, LIGHTS[:1], atol=4 * EPS),  # 1 - e^-x
    Case(tone_maps.exponential_shown, LIGHTS[:1], atol=4 * EPS),
    Case(tone_maps.hable_curve, LIGHTS[:1], atol=4 * EPS),  # a quotient less E/F
    Case(tone_maps.hable_shown, LIGHTS[:1], atol=4 * EPS),
    Case(tone_maps.reinhard_color, LIGHTS),
    Case(tone_maps.reinhard_extended_color, (*LIGHTS, 4.0)),
    Case(aces.aces_curve, LIGHTS[:1], atol=EPS),
    # The output matrix subtracts up to 0.6 of one channel from 1.6 of another.
    Case(aces.aces_color, LIGHTS, atol=8 * EPS),
    Case(agx.agx_curve, LIGHTS[:1], rtol=POWER, atol=4 * EPS),  # ½ less its toe
    # The outset subtracts up to 0.1 of one channel from 1.2 of another, before a power again.
    Case(agx.agx_color, LIGHTS, rtol=2 * POWER, atol=16 * EPS),
    # Weighted differences of cube roots up to 10, with weights up to 2.4.
    Case(oklab.lab_of, LIGHTS, atol=10 * POWER),
    Case(oklab.cone_roots, (uniform(0.1, 1.0, 30), *CHROMA), atol=4 * EPS),
    # Differences of cones' responses up to 1, with weights up to 4.
    Case(oklab.rgb_of_cones, UNITS, atol=16 * EPS),
    Case(oklab.cone_roots_of, LIGHTS, rtol=POWER),
    Case(oklab.lightness_of, UNITS, atol=4 * EPS),
    # From a luminance of 0.002 to 4 cd/m², as from 0.0001 to 1000 W/m²/sr.
    Case(eye.rod_share, (np.geomspace(1e-4, 1e2, COUNT),), atol=POWER),
    Case(adaptation.adapted_key, (np.geomspace(1e-6, 1e4, COUNT),), rtol=4 * POWER),
    Case(adaptation.shown_key, (np.geomspace(1e-6, 1e4, COUNT),), rtol=4 * POWER),
    Case(adaptation.seen_share, (np.geomspace(1e-3, 1e6, COUNT),), rtol=4 * POWER),
    Case(eye.seen_by_eye, tuple(1e-4 * one for one in LIGHTS), rtol=4 * POWER),
    # The scotopic luminance is a difference of ratios up to 10, times 1.33.
    Case(
        eye.cones_and_rods,
        (*(1e-4 * one for one in LIGHTS), uniform(0.0, 1e4, 33)),
        rtol=4 * POWER,
        atol=EPS,
    ),
    Case(eye.with_rods, (*LIGHTS, 0.3, 0.1), rtol=8 * EPS, atol=EPS),
    # Sums of three products each way, of cones' responses up to the largest channel.
    Case(
        white_balance.white_balanced,
        (*LIGHTS, 1.02, 0.99, 0.8),
        rtol=64 * EPS,
        atol=64 * EPS * 20.0,
    ),
    Case(gamut.signed_light, (LIGHTS[0] - 1.0,), rtol=EPS),
    # Differences of channels up to 1, with weights up to 4.
    Case(gamut.light_of_cones, (1, *UNITS), atol=16 * EPS),
    Case(gamut.with_primaries, (1, *UNITS), atol=4 * EPS),
    Case(gamut.to_white, (uniform(0.0, 0.9, 31), True), rtol=16 * EPS),
    Case(natural.natural_curve, (*LIGHTS[:1], 1.4), atol=16 * EPS),
    Case(natural.toe, (uniform(0.0, 0.25, 30), uniform(0.5, 1.5, 31)), rtol=16 * EPS),
    Case(natural.shoulder_slope, (uniform(0.5, 1.5, 31),), rtol=64 * EPS),
    Case(natural.vividness, (uniform(0.5, 1.5, 31),), rtol=4 * EPS),
    Case(natural.style_contrast, (np.arange(3),)),
    Case(gamut.softened, LIGHTS[:1], atol=8 * EPS),
    # Differences of the channels and the grey, over the grey's distance to 0 or 1, at least 0.05.
    Case(gamut.gamut_share, (uniform(0.06, 0.9, 31), UP, *UNITS), atol=4 * EPS / 0.05),
    Case(
        gamut.share_at,
        (0, uniform(0.4, 0.95, 31), UP, *CHROMA, CHROMA[0] - CHROMA[1], UNIT),
        atol=(64 * EPS / 0.05, 256 * EPS / 0.05),
    ),
    # The chroma that Newton's method finds is as good as the share that it compares.
    Case(
        gamut.amount_of_share,
        (0, uniform(0.4, 0.9, 31), UP, *SATURATED, uniform(0.8, 1.0, 32), 1.0, 64.0),
        rtol=512 * EPS,
    ),
    Case(gamut.into_gamut, (0, True, True, *UNITS), atol=10 * POWER),
    Case(gamut.into_gamut, (1, True, False, *UNITS), atol=10 * POWER),
    Case(
        gamut.into_gamut,
        (0, False, True, LIGHTS[0], LIGHTS[1], -0.1 * LIGHTS[2]),
        rtol=512 * EPS,
        atol=10 * POWER,
    ),
    # Whole numbers, then a root of one of 4096 parts of 2.
    Case(dither.hashed, (PIXELS[0].astype(int), PIXELS[1].astype(int))),
    Case(dither.quarter, (PIXELS[0].astype(int), PIXELS[1].astype(int), 5)),
    Case(dither.dither_place, (PIXELS[0], PIXELS[1])),
    Case(dither.dither_noise, (np.arange(4096),), atol=EPS * 64),
    Case(natural.natural_color, LIGHTS, atol=10 * POWER),
    Case(natural.natural_shown, (1, 1.4, *LIGHTS), atol=10 * POWER),
    Case(encoding.srgb_curve, (uniform(0.0, 1.0, 24),), rtol=POWER),
    Case(encoding.gamma_curve, (uniform(0.0, 1.0, 24),), rtol=POWER),
]

X, Y = uniform(0.0, 1280.0, 25), uniform(0.0, 640.0, 26)
#: Coordinates of pixels are rounded to EPS of the picture's width, which is 2π wide or, of a cube
#: map, 12 times the distance of a face.
DIRECTION = 8 * EPS
SPHERE = 2.0 * math.pi
RAYS = [
    Case(perspective_ray, (X, Y, 1280.0, 640.0, 1.0), atol=DIRECTION),
    Case(perspective_ray, (X, Y, 1280, 640, math.radians(170.0)), atol=DIRECTION),
    Case(fisheye_ray, (X, Y, 1280.0, 640.0, math.pi), atol=DIRECTION),
    Case(panorama_ray, (X, Y, 1280.0, 640.0, SPHERE), atol=DIRECTION),
    Case(cube_ray, (X, Y / 3.0, 1280.0, 1280.0 / 6.0, SPHERE), atol=DIRECTION),
    Case(octahedral_ray, (X, 2.0 * Y, 1280.0, 1280.0, SPHERE), atol=DIRECTION),
    Case(orthographic_ray, (X, Y, 1280.0, 640.0, 1.0), atol=DIRECTION),
]

GROUND = [
    # Over the sine of the slant, at least 0.43 here.
    Case(ground_place.moved_on, (Vec3(R * MU, R * SINE, 1e5 * UNIT), Vec3(SINE, -MU, 0.0 * MU),
         uniform(0.02, 0.9, 27), uniform(0.0, 0.02, 28), BOTTOM), atol=METRES / 0.43),
    Case(ground_place.latitude_longitude, (Vec3(R * MU * SINE, R * SINE * SINE, R * MU),),
         atol=ANGLE),
    # log₂ of numbers from 1e-3 to 1e3: 2⁻²¹.
    Case(ground_place.map_level, (1e-3, np.geomspace(10.0, 1e7, COUNT), UNIT, BOTTOM, 2048.0),
         atol=16 * EPS),
    Case(clouds.layer_distance, (uniform(-0.2, 1.0, 46), BOTTOM, np.geomspace(1.0, 1e5, COUNT)),
         rtol=8 * EPS),
    # Sums of products of numbers up to 1, over at least 1 - 0.9 · 0.9.
    Case(clouds.under_star, (
        clouds.LayerPassage(*(uniform(0.0, 0.9, k) for k in range(47, 54))),
        *(uniform(0.0, 0.9, k) for k in range(54, 58)),
    ), atol=64 * EPS),
    Case(clouds.under_sky, (
        clouds.LayerPassage(*(uniform(0.0, 0.9, k) for k in range(47, 54))),
        *(uniform(0.0, 0.9, k) for k in range(58, 60)),
    ), atol=64 * EPS),
    Case(clouds.node_before, (uniform(-0.1, 1.1, 60), 24), atol=24 * EPS),
    # Roots, and 1 - 2Θν + Θ², at least 0.8.
    Case(rpv.land_direct, (uniform(-0.1, 1.0, 61), uniform(0.0, 1.0, 62), uniform(-1.0, 1.0, 63)),
         rtol=16 * EPS),
    Case(rpv.land_diffuse, (uniform(0.0, 1.0, 64),)),
    Case(rpv.unsaturated, (uniform(0.0, 3.0, 65), UNIT), atol=8 * EPS),
    # eˣ and its reciprocal, of 2⁻²¹; the sine hyperbolic of a third of log₂, of 2⁻²¹, times 5.5.
    Case(ground_detail.normal_distribution, (uniform(-6.0, 6.0, 66),), atol=16 * EPS),
    Case(ground_detail.normal_quantile, (uniform(0.005, 0.995, 67),), atol=64 * EPS),
]  # fmt: skip

#: Cosines of a star and of an observer over water, the angle between both planes, and the wind.
WET = (uniform(0.05, 1.0, 41), uniform(0.0, 1.0, 42), uniform(0.0, math.pi, 43))
WET_NU = -(WET[0] * WET[1] + np.sqrt((1.0 - WET[0] ** 2) * (1.0 - WET[1] ** 2)) * np.cos(WET[2]))
WIND = uniform(0.5, 25.0, 44)
WATER = [
    # Differences of numbers up to n² are divided by their sum, at least n² - 1.
    Case(fresnel.fresnel_amplitudes, (1.34, UNIT), atol=16 * EPS),
    Case(fresnel.fresnel_reflectances, (1.34, UNIT), atol=32 * EPS),
    Case(cox_munk.mean_square_slope, (WIND,), rtol=2 * EPS),
    Case(cox_munk.hidden_slopes, (UNIT, uniform(0.07, 0.36, 45)), atol=8 * EPS),
    # The exponent is a difference of squares near 1 over at least 0.0056; where light and line
    # graze the sea so is the facet's tilt, of cosines of 0.05. Of a factor that reaches 13.
    Case(cox_munk.glint_factor, (*WET[:2], WET_NU, WIND), rtol=5e-3, atol=1e-4),
    # A sum of terms up to 5 in an exponent; and eˣ, of 2⁻²¹.
    Case(cox_munk.mirrored_fraction, (UNIT, WIND), rtol=40 * EPS),
    Case(cox_munk.mean_mirrored, (WIND,), rtol=8 * EPS),
    Case(cox_munk.mirrored_cosine, (UNIT, WIND), atol=8 * EPS),
    Case(cox_munk.steepest_mirror, (UNIT,), atol=4 * EPS),
    Case(cox_munk.facing_limit, (UNIT, uniform(0.05, 0.26, 46)), rtol=64 * EPS),
    # Sums and differences of numbers up to 11.
    Case(cox_munk.facing_slope, (uniform(-3.0, 3.0, 57), uniform(0.0, 8.0, 58)), atol=32 * EPS),
    Case(cox_munk.facing_normal, (uniform(0.0, 3.0, 59), uniform(0.1, 8.0, 60)), atol=64 * EPS),
    # A mirrored line near the horizon is a difference of numbers up to 2.
    Case(cox_munk.mirrored_by, (uniform(0.0, 0.5, 61), uniform(-0.5, 0.5, 62), WET[0], WIND,
         uniform(0.0, 0.2, 63)), atol=1e-4),
    Case(water.water_reflectances, (WIND, *WET[:2], WET_NU, UNIT), rtol=5e-3, atol=1e-4),
    Case(water.foam_fraction, (WIND,), rtol=2 * POWER),
]  # fmt: skip

#: Unit vectors, and others.
DIRECTIONS = Vec3(SINE * MU_S, SINE * np.sqrt(1.0 - MU_S**2), MU)
TRIPLE = Vec3(MU, UNIT, MU_S), DIRECTIONS, Vec3(UNIT, MU_S, MU)
#: Phase of a moon.
LIT = disc_shading.MoonPhase(0.8, 0.6, 8.0, 0.002)
# Sums of products of numbers up to 1.
VECTORS = [
    Case(vectors.dot, TRIPLE[:2], atol=4 * EPS),
    Case(vectors.cross, TRIPLE[:2], atol=4 * EPS),
    Case(vectors.plus, TRIPLE[:2], atol=4 * EPS),
    Case(vectors.minus, TRIPLE[:2], atol=4 * EPS),
    Case(vectors.scaled, (DIRECTIONS, UNIT)),
    Case(vectors.components, (DIRECTIONS, *TRIPLE), atol=8 * EPS),
    Case(vectors.combined, (DIRECTIONS, *TRIPLE), atol=8 * EPS),
]

#: Light and scales of a solver: positive.
POSITIVE = np.geomspace(1e-6, 10.0, COUNT)
OTHER = uniform(0.1, 10.0, 40)
STEPS = [
    Case(harmonics.climbed, (MU, UNIT, MU_S, UNIT, MU), atol=4 * EPS),
    Case(harmonics.degree_of, (np.arange(COUNT) % 325,)),
    Case(packing.floor_below, (POSITIVE,)),
    # A power of a quotient: WGSL's log₂ and 2ˣ, as POWER; under a root.
    Case(packing.rational_scale, (POSITIVE, OTHER, UNIT), rtol=2 * POWER),
    Case(levels.cubic_bend, (UNIT, OTHER, POSITIVE, UNIT, OTHER, 3.0), atol=80 * EPS),
    # Falls by 15 times what its argument, a ratio, rises.
    Case(levels.smoothness, (UNIT, OTHER, POSITIVE, MU), atol=16 * EPS),
    # The ratio is inverted again: differences of numbers up to 10.
    Case(
        levels.between_levels,
        (UNIT, OTHER, POSITIVE, MU, OTHER, POSITIVE, UNIT),
        rtol=16 * EPS,
        atol=80 * EPS,
    ),
    Case(convergence.is_near, (OTHER, POSITIVE, 10.0)),
    # Over the sines, whose product is at least 0.02 here; 1 - μ² from cosines accurate to EPS.
    Case(ray_sums.azimuth_cosine, (0.99 * MU, 0.99 * MU_S, UNIT), atol=ANGLE / 0.02),
    Case(march.line_azimuth, (0.99 * MU, 0.99 * MU_S, UNIT), atol=ANGLE / 0.02),
    Case(ray_optics.star_from_ray, (MU, MU_S, 2.0 * UNIT - 1.0), atol=ANGLE),
    Case(sky_view_lut.row_coordinate, (np.arange(COUNT) % 32, 16, UNIT < 0.5)),
    Case(ground_angles.star_from, (R * SINE, R * MU, R, MU_S, SINE, MU), atol=ANGLE),
    Case(
        sky_view_lut.half_sine_between,
        (DIRECTIONS, 0.6, 0.8),
        atol=ANGLE,
    ),
    # An angle less a radius, divided by the pixel.
    # a quotient of two cosines of which one may vanish: the shade is at most 2.65, its slope 300
    Case(
        moon_phase.moon_reflectance,
        (0.01 + 0.99 * UNIT, 0.05 + 0.95 * UNIT[::-1], 0.9 * MU),
        atol=300 * EPS,
    ),
    Case(disc_shading.face_level, (0.2 * UNIT, 128)),
    Case(disc_shading.face_place, (MU, np.exp2(np.arange(COUNT) % 6 + 2.0)), atol=64 * EPS),
    Case(disc_shading.moon_shade, (0.01 + 0.99 * UNIT, 0.9 * MU, LIT), atol=300 * EPS),
    Case(bare_surface.lambert_factor, (UNIT, UNITS[0], MU)),
    Case(bare_surface.lommel_seeliger_factor, (UNIT, UNITS[0], MU)),
    Case(hapke.grain_phase, (MU, 0.24, 0.33), rtol=POWER),
    Case(hapke.multiple_scattering, (UNIT, 0.6), rtol=POWER),
    Case(hapke.tilted, (0.02 + 0.96 * UNIT, 0.43), atol=16 * EPS, rtol=POWER),
    # away from the surge, whose slope at opposition is infinite
    Case(
        hapke.hapke_reflectance,
        (0.1 + 0.8 * UNIT, 0.1 + 0.8 * UNITS[0], 0.3 * MU, hapke.MOON),
        rtol=300 * EPS,
        atol=30 * EPS,
    ),
    # without a phase, and with one where the shade is smooth; μ loses half its digits at the rim
    Case(
        disc_shading.disc_powers,
        (1.0, 0.0045 * UNIT, 0.00465, 1e-4, MU, False, LIT),
        atol=300 * EPS,
    ),
    Case(
        disc_shading.disc_powers,
        (1.0, 0.0045 * UNIT, 0.00465, 1e-4, UNIT, True, LIT),
        atol=1000 * EPS,
    ),
    Case(star_disc.covered, (0.01 * UNIT, 0.00465, 1e-3), atol=16 * EPS),
    Case(star_disc.covered, (0.01 * UNIT, 0.00465, 1e-2), atol=16 * EPS),
    Case(
        star_disc.shared_out, (0.01 * MU, 0.01 * MU_S, 0.00465, 0.01, 0.002, 0.008), atol=16 * EPS
    ),
]


@pytest.mark.parametrize(
    "case",
    [*GEOMETRY, *MAPPINGS, *PHASES, *COLORS, *RAYS, *GROUND, *WATER, *STEPS, *VECTORS],
    ids=lambda case: case.function.__name__,
)
def test_a_formula_on_the_gpu_is_the_cpu_s(on_gpu: Callable[..., Any], case: Case) -> None:
    # A second compiler for the same source.
    agree(on_gpu, case.function, case.inputs, case.rtol, case.atol)


def test_every_scalar_formula_of_these_files_is_compared() -> None:
    # The other functions have array arguments, or a separate test.
    named = {case.function.py_func for case in
             [*GEOMETRY, *MAPPINGS, *PHASES, *COLORS, *RAYS, *GROUND, *VECTORS]}  # fmt: skip
    others = {"meets_ground", "panel_leg", "apparent_sun", "refraction_table_index",
              "apparent_sun_cosine", "star_points", "direct_horizontal_weights", "shown_light",
              "insert_edge", "place_edges", "start_vectors",
              "place_nodes", "map_color", "map_channel",
              "map_value", "map_cell", "add_texel", "encoded"}  # fmt: skip
    rooms = [
        shell,
        path,
        refraction,
        sun_disc,
        transmittance,
        sky_view,
        phase_functions,
        ground_place,
        vectors,
    ]
    for room in rooms:
        for name, one in vars(room).items():
            plain = getattr(one, "py_func", None)
            if plain is not None and plain.__module__ == room.__name__ and name not in others:
                assert plain in named, f"{room.__name__}.{name}"


def test_a_ray_meets_the_ground_or_not_as_on_the_cpu(on_gpu: Callable[..., Any]) -> None:
    # Within EPS of the horizon either result is correct: those rays are left out.
    horizon = -np.sqrt(1.0 - (BOTTOM / R) ** 2)
    mu = MU[np.abs(MU - horizon) > 16 * EPS]
    agree(on_gpu, shell.meets_ground, (R[np.abs(MU - horizon) > 16 * EPS], mu, BOTTOM), 0.0, 0.0)


def test_the_leg_of_a_panel_is_the_cpu_s(on_gpu: Callable[..., Any]) -> None:
    # A root of a difference of radii, each accurate to EPS of it: METRES under the root near 0.
    mu = uniform(0.05, 0.9, 30)
    agree(on_gpu, path.panel_leg, (R, mu, 0.2 * LENGTH, 0.7 * LENGTH, LENGTH), 16 * EPS,
          (0.0, METRES, 20.0 * METRES, math.sqrt(METRES), math.sqrt(METRES)))  # fmt: skip


@pytest.mark.parametrize("which", range(len(PROJECTIONS)), ids=list(PROJECTIONS))
def test_a_projection_s_number_is_its_place(on_gpu: Callable[..., Any], which: int) -> None:
    # The array functions by name, in double precision.
    name, form = list(PROJECTIONS.items())[which]
    width, height = {"equirectangular": (64, 32), "cubemap": (96, 16), "octahedral": (48, 48)}.get(
        name, (60, 40)
    )
    fov = math.radians(form.field_of_view)
    x, y = np.meshgrid(np.arange(width) + 0.5, np.arange(height) + 0.5)
    wanted = projected_rays(name, x[0], y[:, 0], width, height, fov)
    for number in (which, Constant(which)):  # at run time, and when the shader is written
        seen = np.stack(on_gpu(projected_ray, number, x, y, float(width), float(height), fov), -1)
        assert_allclose(seen, wanted, rtol=0.0, atol=DIRECTION)
        assert_array_equal(np.any(seen != 0.0, axis=-1), np.any(wanted != 0.0, axis=-1))


@pytest.mark.parametrize("which", range(len(TONE_MAPS)), ids=list(TONE_MAPS))
def test_a_tone_map_s_number_is_its_place(on_gpu: Callable[..., Any], which: int) -> None:
    # The array functions by name, in double precision; also black, and light of extreme values.
    extreme = np.array([-1.0, 0.0, 1e-30, 1.0, 1e19, 3e38])
    light = np.concatenate(
        [np.stack(LIGHTS, -1), np.stack(np.meshgrid(*[extreme] * 3), -1).reshape(-1, 3)]
    )
    light = light.astype(np.float32).astype(np.float64)
    forward = list(TONE_MAPS.values())[which].forward
    wanted = forward(light if which == 0 else in_gamut(light, bounded=False))
    if which:
        beyond = wanted.max(axis=-1, keepdims=True) > 1.0
        wanted = np.where(beyond, in_gamut(wanted, soft=False), wanted)
    for number in (which, Constant(which)):
        seen = np.stack(on_gpu(tone_maps.shown_light, number, 0, 0, *light.T), -1)
        assert_allclose(seen, wanted, rtol=4 * POWER, atol=4 * POWER)
        assert np.all(seen >= 0.0)


#: Fields of ``Reflection`` that are not numeric.
UNBOUND = ("albedo", "regolith", "layer")


@pytest.mark.parametrize("which", range(len(LAWS)), ids=list(LAWS))
def test_a_law_of_reflection_s_number_is_its_place(on_gpu: Callable[..., Any], which: int) -> None:
    # The law's own kernels, in double precision; also at the horizon, where cosines are 0.
    ground = Reflection(1.0, which)
    grains = StructValue({key: Constant(x) for key, x in ground.regolith._asdict().items()})
    numbers = {key: Constant(x) for key, x in ground._asdict().items() if key not in UNBOUND}
    bound = StructValue(numbers | {"regolith": grains})
    cosines = np.append(UNIT, [0.0, 0.0, 1.0]).astype(np.float32)
    suns = np.append(MU_S, [0.0, -0.1, 1.0]).astype(np.float32)
    law = list(LAWS.values())[which]
    for number in (which, Constant(which)):
        star = on_gpu(reflection.brdf_direct, number, bound, suns, cosines, suns)
        wanted = [law.brdf_direct(ground, *each) for each in zip(suns, cosines, suns, strict=True)]
        assert_allclose(np.broadcast_arrays(*star), np.transpose(wanted), rtol=4 * POWER)
        sky = on_gpu(reflection.brdf_diffuse, number, bound, cosines)
        # Near 1 the two terms cancel to 0.3.
        wanted = [law.brdf_diffuse(ground, each) for each in cosines]
        assert_allclose(np.broadcast_arrays(*sky), np.transpose(wanted), rtol=8 * POWER)


@pytest.mark.parametrize("which", range(len(ENCODINGS)), ids=list(ENCODINGS))
def test_an_encoding_s_number_is_its_place(on_gpu: Callable[..., Any], which: int) -> None:
    # The array functions by name, in double precision.
    linear = np.concatenate([[-1.0, 0.0, 1.0], np.geomspace(1e-6, 1.0, 500)])
    wanted = list(ENCODINGS.values())[which].encode(linear)
    for number in (which, Constant(which)):
        seen = on_gpu(encoding.encoded, number, linear)
        assert_allclose(seen, wanted, rtol=POWER, atol=EPS)


def test_light_that_is_no_number_is_black_on_the_gpu(on_gpu: Callable[..., Any]) -> None:
    # As on the CPU; a shader may make NaN of its own inputs.
    light = np.array([np.nan, -1.0, -np.inf, 2.0, np.inf])
    assert_array_equal(on_gpu(physical_light, light), np.float32([0.0, 0.0, 0.0, 2.0, 1e18]))


ROWS, COLUMNS = 27, 54


def read_map(latitude, longitude, level, texels):
    """The four channels of ``map_color``, and ``map_channel`` of the last."""
    color = np.empty(_CHANNELS)
    ground_place.map_color(texels, ROWS, COLUMNS, 3, latitude, longitude, level, color, 0)
    alone = ground_place.map_channel(texels, ROWS, COLUMNS, 3, latitude, longitude, level, 3)
    return color[0], color[1], color[2], color[3], alone


_CHANNELS = 4


def test_the_map_of_the_ground_is_read_as_on_the_cpu(on_gpu: Callable[..., Any]) -> None:
    # Bilinear in values of 0 to 1; a position in the map is accurate to EPS of its 54 pixels. The
    # device's texture gives the texels as fractions of 255, which the shader decodes by a power.
    count = sum(h * w for h, w in [(27, 54), (14, 27), (7, 14)])
    texels = np.random.default_rng(31).integers(0, 256, (count, 4)).astype(np.uint8)
    latitude = uniform(-0.5 * math.pi, 0.5 * math.pi, 32)
    longitude = uniform(-math.pi, math.pi, 33)
    level = uniform(-1.0, 3.0, 34)
    seen = on_gpu(
        read_map, latitude, longitude, level, ShaderTable("texels", spectral=True),
        spectra={"texels": texels / 255.0},
    )  # fmt: skip
    wanted = np.empty((COUNT, _CHANNELS + 1))
    for i in range(COUNT):
        place = [float(np.float32(one[i])) for one in (latitude, longitude, level)]
        ground_place.map_color(texels.reshape(-1), ROWS, COLUMNS, 3, *place, wanted[i], 0)
    wanted[:, -1] = wanted[:, -2]
    assert_allclose(np.stack(seen, -1), wanted, rtol=0.0, atol=64 * 4 * EPS)
