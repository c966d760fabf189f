"""Formulas that read tables, on the GPU and on the CPU; and a check that no formula is left out.

Reference: Numba, which compiles the same functions for the same tables, in double precision for
plain numbers. Four wavelengths of the GPU are the first four of the CPU's eight lanes, both in
single precision. EPS is the unit of its rounding.
"""

from __future__ import annotations

import runpy
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numba
import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry import path, refraction
from airlight.kernel.lanes import lane_array, lane_view, store
from airlight.physics.optics import altitude_nodes
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import ShaderTable
from airlight.render.gpu.picture.display_shaders import all_shaders
from airlight.render.gpu.solver import passes as solver_passes
from airlight.render.gpu.solver import ray_sums
from airlight.render.pixels import sky_lookup as picture
from airlight.solver.moments import first_order, harmonics, ray_optics, source
from airlight.solver.moments import opaque_culling as block_rays
from airlight.solver.tables import column_ratios, columns

EPS = 2.0**-23
COUNT = 400
BOTTOM, TOP = 6360e3, 6460e3
#: Rounding of lengths of the planet's size. [m]
METRES = 4.0 * EPS * TOP
#: GridSizes of the tables here: constituents, degree of harmonics, nodes.
THREE = 3
DEGREE = 4
TERMS = 15
MOMENTS = TERMS + harmonics.POLARISED
NODES = 9
EDGES = 64
STAR = 0.00465

RNG = np.random.default_rng(7)


def uniform(low: float, high: float) -> np.ndarray:
    return RNG.uniform(low, high, COUNT)


def lanes(*shape: int, low: float = 0.0, high: float = 1.0) -> np.ndarray:
    """Table of four wavelengths."""
    return RNG.uniform(low, high, (*shape, 4)).astype(np.float32)


# --- compared functions: numbers first, then tables, then spectral tables ------------------------


def through_three(a, b, c, extinction):
    here = np.empty(THREE)
    here[0], here[1], here[2] = a, b, c
    return source.transmittance_columns(here, lane_view(extinction), THREE)


def star_of_two(seen, a, b, c, spread, extinction):
    here, there = np.empty(THREE), np.empty(THREE)
    here[0], here[1], here[2] = a, b, c
    there[0], there[1], there[2] = c, a, b
    return source.direct_beam(seen, here, there, spread, lane_view(extinction), THREE)


def scattered_by_three(a, b, c, scattering, phase):
    here = np.empty(THREE, np.float32)
    here[0], here[1], here[2] = np.float32(a), np.float32(b), np.float32(c)
    return source.single_scattering_source(here, lane_view(scattering), lane_view(phase), THREE)


def level_by_two(a, b, c, low, high, extinction):
    here, there = np.empty(THREE), np.empty(THREE)
    here[0], here[1], here[2] = a, b, c
    there[0], there[1], there[2] = c, a, b
    return source.direct_horizontal(here, there, low, high, lane_view(extinction), THREE)


def level_under_sky(place, share, sky):
    return source.diffuse_horizontal(lane_view(sky), place, share)


def third_phase(half_sine, table):
    out = lane_array(THREE)
    source.read_phase(half_sine, table, out)
    return lane_view(out)[2]


def some_harmonics(mu, start, ahead, back):
    out = np.empty(TERMS, np.float32)
    harmonics.legendre_functions(mu, (DEGREE, start, ahead, back), out)
    return out[0], out[2], out[7], out[10], out[14]


def one_harmonic(mu, l, m, start, ahead, back):
    return harmonics.legendre_function(mu, l, m, start, ahead, back)


def some_directed(mu, cosine, start, ahead, back):
    out = np.empty(TERMS, np.float32)
    harmonics.directed_functions(mu, cosine, (DEGREE, start, ahead, back), out)
    return out[0], out[2], out[7], out[10], out[14]


def multiple_scattering_of_four(
    a, b, c, mu, f, e, start, ahead, back, moments, polarised_moments, field
):
    here = np.empty(THREE, np.float32)
    here[0], here[1], here[2] = np.float32(a), np.float32(b), np.float32(c)
    out = np.empty(TERMS, np.float32)
    harmonics.legendre_functions(mu, (DEGREE, start, ahead, back), out)
    node = source.field_node(0, 0, np.float32(f), np.float32(e))
    return source.multiple_scattering_source(
        here, lane_view(moments), lane_view(polarised_moments), lane_view(field), out, node,
        DEGREE, THREE,
    )  # fmt: skip


def between_four(a, b, c, d, field):
    node = source.FieldNode(0, 0, np.float32(a), np.float32(b), np.float32(c), np.float32(d))
    return source.between(lane_view(field), node, 1)


def row_in_grid(q, nodes, row):
    return altitude_nodes.node_value(q, BOTTOM, TOP, nodes, row)


def place_in_grid(mu_s, place):
    return ray_optics.sun_index(mu_s, place)


def place_of_density(radius, nodes):
    node, fraction = altitude_nodes.altitude_node(radius, BOTTOM, TOP - BOTTOM, nodes)
    return node + fraction


def three_columns(r, mu, nodes, rows, ratios):
    here = np.empty(THREE)
    column_ratios.columns_to_top(r, mu, BOTTOM, TOP, nodes, rows, ratios, here)
    return here[0], here[1], here[2]


def corners_cut(r, mu, count, ends):
    edges = np.empty(EDGES)
    edges[0], edges[1] = 0.0, 1e7
    count = columns.split_at_profile_edges(r, mu, BOTTOM, ends, edges, count)
    return count, edges[1], edges[2], edges[3]


def edges_placed(r, mu, length):
    edges = np.empty(EDGES)
    count = path.place_edges(r, mu, length, 2, 0.31 * length, 0.63 * length, edges)
    return count, edges[0], edges[1], edges[2], edges[3], edges[4]


def edge_inserted(cut):
    edges = np.empty(EDGES)
    edges[0], edges[1], edges[2] = 0.0, 0.5, 1.0
    count = path.insert_edge(edges, 3, cut)
    return count, edges[1], edges[2]


def star_lifted(x, mu_s, refraction_table):
    return refraction.apparent_sun(x, mu_s, BOTTOM, TOP, refraction_table)


def star_in_two(x, mu_s, refraction_table):
    return refraction.star_points(x, mu_s, BOTTOM, TOP, STAR, refraction_table)


def star_on_level(x, mu_s, refraction_table):
    return refraction.direct_horizontal_weights(x, mu_s, BOTTOM, TOP, STAR, refraction_table)


def sky_between(row, sky, azimuth, table):
    column, right = picture.texel_before(7.0 * azimuth, 0, 7)
    line, down = picture.texel_before(5.0 * row, 0, 5)
    near = (line if sky else line + 6) * 8 + column
    return picture.between_texels(lane_view(table), picture.TexelPlace(near, 8, right, down))


def depth_of_row(first, column, extinction):
    return ray_optics.optical_depth(column, first, lane_view(extinction), THREE)


def star_at_point(point, mu_s, nu, turn):
    return ray_sums.star_from_point(turn, point, mu_s, nu)


def star_at_ground(i, a, mu_s, nu, end):
    return ray_optics.star_at_end(end, i, a, mu_s, nu)


def strength_of_point(point, l, amount, moments):
    return ray_optics.strength_of(lane_view(moments), amount, point, l, THREE)


def through_whole_ray(first, total, extinction):
    return ray_optics.transmittance_ray(lane_view(extinction), total, first, THREE)


def angle_leaving(i, a, mu, end):
    return ray_optics.mu_r_at_end(end, i, a, mu)


def sky_on_ground(mu_s, place, ground):
    return ray_optics.sky_at(lane_view(ground), mu_s, place, NODES)


def emitted_by(a, scale):
    return block_rays.emitted(lane_view(scale)[0] * np.float32(a))


def through_a_row(local, x, depths):
    return first_order.transmittance_row(lane_view(depths), local, x, NODES)


def depth_above(row, f, place, distance, ratios, extinction):
    return ray_sums.depth_towards(ratios, row, f, place, distance, lane_view(extinction), THREE)


def phases_from_moments(nu, moments):
    out = lane_view(lane_array(THREE))
    ray_sums.fill_phases(lane_view(moments), nu, DEGREE, THREE, out)
    return out[1]


class Case(NamedTuple):
    """Function of these, its numbers and tables, and the tolerance for single precision."""

    function: Any
    of: tuple[Any, ...]
    inputs: tuple[Any, ...]
    tables: Mapping[str, np.ndarray] = {}
    spectra: Mapping[str, np.ndarray] = {}
    rtol: float = 16.0 * EPS
    atol: float = 0.0


RECURRENCES = harmonics.harmonics(DEGREE)
HARMONICS = {"start": RECURRENCES.start, "ahead": RECURRENCES.ahead, "back": RECURRENCES.back}
AMOUNTS = (uniform(0.0, 3.0), uniform(0.0, 3.0), uniform(0.0, 3.0))
MU, UNIT = uniform(-1.0, 1.0), uniform(0.0, 1.0)
R = uniform(BOTTOM + 1e3, TOP)
#: Exponentials of up to -9, and sums of three before.
DEPTH = 64.0 * EPS
SPECTRA = {"extinction": lanes(THREE)}
GRID = np.sort(RNG.uniform(0.0, 40.0, 33))
#: Cells of 1 to 3 steps, 32 in all.
CELLS = np.concatenate([[0.0], np.cumsum([1.0, 2.0, 3.0, 2.0] * 4)])
#: Rows of the ratios at the nodes.
ROWS = np.sort(RNG.uniform(0.0, 7.0, 33))
RATIOS = 1.0 + RNG.uniform(0.0, 0.2, (8, 16, THREE, 2))
LIFT = np.stack([RNG.uniform(0.0, 0.01, (8, 12)), RNG.uniform(0.8, 1.0, (8, 12))], -1)
FIELD = np.concatenate([lanes(2, 2, 1, low=0.5), lanes(2, 2, MOMENTS)], axis=2)

CASES = [
    Case(through_three, (source.transmittance_columns,), AMOUNTS, {}, SPECTRA, DEPTH),
    Case(star_of_two, (source.direct_beam,), (UNIT, *AMOUNTS, UNIT > 0.5), {}, SPECTRA, DEPTH),
    Case(scattered_by_three, (source.single_scattering_source,), AMOUNTS, {},
         {"scattering": lanes(THREE), "phase": lanes(THREE)}),
    Case(level_by_two, (source.direct_horizontal,),
         (*AMOUNTS, UNIT, 1.0 - UNIT), {}, SPECTRA, DEPTH),
    Case(level_under_sky, (source.diffuse_horizontal,),
         (RNG.integers(0, NODES - 1, COUNT), UNIT), {}, {"sky": lanes(1, NODES, 2, low=0.1)}),
    # The position in the table is accurate to EPS of its length, its slope is the table's step.
    Case(third_phase, (source.read_phase,), (UNIT,), {}, {"table": lanes(NODES, THREE)},
         atol=16 * NODES * EPS),
    # Four steps of the recurrence, each a difference of terms of order 2.
    Case(some_harmonics, (harmonics.legendre_functions,), (MU,), HARMONICS, atol=64 * EPS),
    Case(one_harmonic, (harmonics.legendre_function,),
         (MU, RNG.integers(2, DEGREE + 1, COUNT), RNG.integers(0, 3, COUNT)), HARMONICS,
         atol=64 * EPS),
    Case(some_directed, (harmonics.directed_functions,), (MU, 2.0 * UNIT - 1.0), HARMONICS,
         atol=64 * EPS),
    Case(between_four, (source.between,), (UNIT, UNIT, *AMOUNTS[:2]), {},
         {"field": lanes(2, 2, 2)}),
    # Sums of 15 harmonics of either sign, over a scale of at least a half.
    Case(multiple_scattering_of_four, (source.multiple_scattering_source, source.field_node),
         (*AMOUNTS, MU, UNIT, 1.0 - UNIT), HARMONICS,
         {"moments": lanes(THREE, DEGREE + 1), "polarised_moments": lanes(THREE, 4),
          "field": FIELD},
         rtol=64 * EPS, atol=2048 * EPS),
    # r - R is accurate to EPS of R, which is 1e-5 of the shell's 100 km; steps of the table: 40.
    Case(row_in_grid, (altitude_nodes.node_value,), (R,), {"nodes": CELLS, "row": GRID},
         atol=40 * 33 * METRES / 1e5),
    Case(place_in_grid, (ray_optics.sun_index,), (MU,), {"place": GRID}, atol=40 * 33 * 4 * EPS),
    # As the grid's: 16 cells of at most 4 steps, over twice the root of the lowest height, 1 km.
    Case(place_of_density, (altitude_nodes.altitude_node,), (R,), {"nodes": CELLS},
         atol=64 * METRES / 1e5 / 0.2),
    # Positions in the table as in test_kernels_agree, its steps a fifth; a path of up to 1000 km.
    Case(three_columns, (column_ratios.columns_to_top,), (R, uniform(0.05, 1.0)),
         {"nodes": CELLS, "rows": ROWS, "ratios": RATIOS}, rtol=1e-4, atol=4 * METRES),
    Case(corners_cut, (columns.split_at_profile_edges,), (uniform(BOTTOM, BOTTOM + 15e3),
         uniform(0.2, 0.9), np.full(COUNT, 2)), {"ends": np.array([20e3, 60e3])},
         atol=4 * METRES / 0.2),
    # Where the path is divided evenly in the root of its height.
    Case(edges_placed, (path.place_edges,), (R, uniform(0.2, 0.9), uniform(1e4, 1e5)),
         atol=8 * METRES / 0.2),
    Case(edge_inserted, (path.insert_edge,), (uniform(-0.5, 1.5),)),
    # A root of the height above the horizon, at least 0.02 there, over 8 or 12 steps of 0.01.
    Case(star_lifted, (refraction.apparent_sun, refraction.refraction_table_index),
         (R, uniform(0.02, 1.0)), {"refraction_table": LIFT}, atol=16 * 12 * EPS),
    # As visible_spread in test_kernels_agree.
    Case(star_in_two, (refraction.star_points,),
         (R, uniform(0.02, 0.2)), {"refraction_table": LIFT}, atol=32 * 12 * EPS),
    Case(star_on_level, (refraction.direct_horizontal_weights,),
         (R, uniform(0.02, 0.2)), {"refraction_table": LIFT}, atol=32 * 12 * EPS),
    # Fourth power of the value between texels.
    Case(sky_between, (picture.between_texels, picture.texel_before), (UNIT,
         uniform(0.0, 1.0) < 0.5, uniform(0.0, 1.0)), {}, {"table": lanes(8 * 12)},
         atol=4 * 16 * 8 * EPS),
    Case(depth_of_row, (ray_optics.optical_depth,), (RNG.integers(0, 20, COUNT),),
         {"column": RNG.uniform(0.0, 2.0, 24)}, SPECTRA),
    Case(star_at_point, (ray_sums.star_from_point,), (RNG.integers(0, 5, COUNT), MU, UNIT),
         {"turn": RNG.uniform(-1.0, 1.0, (5, 4))}, atol=4 * EPS),
    Case(star_at_ground, (ray_optics.star_at_end,), (RNG.integers(0, 5, COUNT),
         RNG.integers(0, 3, COUNT), MU, UNIT), {"end": RNG.uniform(-1.0, 1.0, (5, 3, 2))},
         atol=4 * EPS),
    Case(strength_of_point, (ray_optics.strength_of,), (RNG.integers(0, 5, COUNT),
         RNG.integers(0, DEGREE + 1, COUNT)), {"amount": RNG.uniform(0.0, 1.0, (5, THREE))},
         {"moments": lanes(THREE, DEGREE + 1)}),
    Case(through_whole_ray, (ray_optics.transmittance_ray,), (RNG.integers(0, 20, COUNT),),
         {"total": RNG.uniform(0.0, 2.0, 24)}, SPECTRA, DEPTH),
    Case(angle_leaving, (ray_optics.mu_r_at_end,), (RNG.integers(0, 5, COUNT),
         RNG.integers(0, 3, COUNT), MU), {"end": RNG.uniform(-1.0, 1.0, (5, 3, 2))},
         atol=4 * EPS),
    Case(sky_on_ground, (ray_optics.sky_at,), (MU,), {"place": np.linspace(0.0, NODES - 1.0, 33)},
         {"ground": lanes(1, NODES, 2, low=0.1)}, rtol=32 * NODES * 4 * EPS),
    # 1 - e^-τ from its series or directly: exact where τ is small, to EPS of 1 elsewhere.
    Case(emitted_by, (block_rays.emitted,), (np.geomspace(1e-6, 20.0, COUNT),), {},
         {"scale": lanes(1, low=0.5)}, rtol=DEPTH),
    Case(through_a_row, (first_order.transmittance_row,), (RNG.integers(0, 3, COUNT),
         uniform(0.0, NODES - 1.0)), {}, {"depths": lanes(3, NODES)}, DEPTH),
    Case(depth_above, (ray_sums.depth_towards,), (RNG.integers(0, 7, COUNT), UNIT,
         RNG.integers(0, 16, COUNT), uniform(0.0, 3.0)), {"ratios": RATIOS}, SPECTRA),
    Case(phases_from_moments, (ray_sums.fill_phases,), (MU,), {},
         {"moments": lanes(THREE, DEGREE + 1)}, atol=256 * EPS),
]  # fmt: skip


def by_cpu(case: Case) -> list[np.ndarray]:
    """Each result for all inputs; the inputs and tables rounded to single precision."""
    inner = numba.njit(case.function)

    @numba.njit
    def kept(out, *arguments):
        store(out, 0, inner(*arguments))

    tables = [table.astype(np.float32).astype(np.float64) for table in case.tables.values()]
    spectra = []
    for table in case.spectra.values():
        wide = np.zeros((*table.shape[:-1], 8), np.float32)
        wide[..., :4] = table
        spectra.append(wide)
    rows = []
    given = [
        one.astype(np.float32).astype(np.float64) if one.dtype.kind == "f" else one
        for one in case.inputs
    ]
    for numbers in zip(*(one.tolist() for one in given), strict=True):
        if case.spectra:
            out = np.zeros(8, np.float32)
            kept(out, *numbers, *tables, *spectra)
            rows.append((out[:4].astype(float),))
        else:
            found = inner(*numbers, *tables)
            rows.append(found if isinstance(found, tuple) else (found,))
    return [np.array(one) for one in zip(*rows, strict=True)]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.function.__name__)
def test_a_formula_with_tables_on_the_gpu_is_the_cpu_s(
    on_gpu: Callable[..., Any], case: Case
) -> None:
    # A second compiler for the same source.
    values = [ShaderTable(name, table.ndim) for name, table in case.tables.items()]
    values += [ShaderTable(name, table.ndim - 1, True) for name, table in case.spectra.items()]
    seen = on_gpu(
        case.function, *case.inputs, *values, tables=dict(case.tables), spectra=dict(case.spectra)
    )
    seen = seen if isinstance(seen, tuple) else (seen,)
    wanted = by_cpu(case)
    assert len(seen) == len(wanted)
    for one, expected in zip(seen, wanted, strict=True):
        assert_allclose(one, expected, rtol=case.rtol, atol=case.atol)


#: Functions compared as a whole, because they are one pixel, one texel or one line of sight, with
#: another method of the CPU for the same light: the test, and the functions.
WHOLE = {
    "test_gpu_renderer.py::test_a_marched_picture_has_the_cpu_s_radiance": (
        "pixel_light", "classify_ray", "seen_line", "line_radiance", "ground_along",
        "ground_radiance", "reflectance", "ground_color", "ground_reflectances", "ground_angles",
        "ground_factor", "look", "line_of_sight",
        "star_on_ground", "unseparated_phases", "march", "add_point", "add_star", "star_columns",
        "field_place", "multiple_scattering_at", "place_panels", "place_panel", "panel_columns",
        "panel_place", "star_place", "columns_to_space",
        "columns_along", "columns_between", "meets_ground", "ground_light", "camera_direction",
        "broaden_peaks", "reset_peaks", "add_peaks", "peak_gain", "peak_fraction",
    ),
    "test_gpu_renderer.py::test_a_picture_from_the_table_is_shown_as_the_cpu_s": (
        "samples_per_side", "sample_place", "sampled_light", "phase_of", "air_between",
        "refraction_to_ground", "sky_view_place", "sky_lookup",
    ),
    "test_gpu_renderer.py::test_a_filter_lets_the_same_light_through_as_the_cpu_s": (
        "add_polarised_star", "add_polarised_light", "polarised_scattering_source",
        "polarised_between", "polarised_ratio_columns",
        "filter_shares", "filtered",
    ),
    "test_gpu_renderer.py::test_the_shader_fills_the_table_as_the_cpu_does": (
        "sky_view_texel", "line_of_texel", "upright",
    ),
    "test_gpu_renderer.py::test_the_disc_s_light_does_not_depend_on_how_it_is_shared_out": (
        "star_disc", "seen_disc", "disc_light", "leaving_air", "_point_like", "_step", "darkened",
        "whole_powers",
    ),
    "test_rings.py::test_rings_and_their_shadow_are_those_of_the_cpu": (
        "ring_row", "ring_depth", "ring_shade", "ring_shade_on", "ring_line", "no_rings",
        "way_to_rings", "ring_radius", "near_rings", "ring_layer", "outside_shadow",
        "ring_crossing", "sum_rings", "ring_light", "mean_attenuation", "power_law",
        "single_scattering_layer", "ring_phase",
    ),
    "test_oblate.py::test_an_oblate_planet_with_rings_is_that_of_the_cpu": (
        "oblate_light", "store_line", "add_beyond_air", "displaced_line", "displaced_axes",
        "same_observer", "lowest_point", "stretched", "unit", "height_above_limb",
        "relative_curvature", "lowered_star", "lengthen",
        "beside_shadow", "point_below",
    ),
    "test_deck.py::test_a_deck_is_that_of_the_cpu": ("meets_deck", "shade_deck"),
    "test_lights.py::test_several_lights_are_shown_as_by_the_cpu": ("added_texel",),
    "test_system_renderer.py::test_planets_before_each_other_are_drawn_as_by_the_cpu": (
        "layered_texel", "light_of_centre", "pixel_transmittance",
    ),
    "test_scene_bodies.py::test_bodies_without_air_are_those_of_the_cpu": (
        "covering_texel", "body_coverage", "body_light", "body_ray", "limb_samples",
        "surface_color", "towards_unit", "sphere_distance", "surface_factor", "factor_of_law",
        "regolith_factor",
    ),
    "test_scene_bodies.py::test_craters_of_a_near_moon_are_those_of_the_cpu": (
        "crater_light", "finest_cell", "raised", "body_met", "relief_met", "relief_shown",
        "rolling_height",
    ),
    "test_scene_bodies.py::test_a_shadow_on_a_moon_is_that_of_the_cpu": ("shade_left",),
    "test_scene_bodies.py::test_the_sun_behind_air_and_a_moon_is_that_of_the_cpu": (
        "scene_disc",
    ),
    "test_scene_bodies.py::test_a_small_sun_has_the_light_of_a_large_one": ("small_disc",),
    "test_gpu_renderer.py::test_what_is_drawn_is_exposed_and_tone_mapped": (
        "displayed", "dithered", "within_gamut",
    ),
    "test_emitter.py::test_a_construct_computes_what_python_does": ("squared", "cubed"),
    "test_emitter.py::test_angles_are_better_than_wgsl_promises": (
        "sine", "cosine", "sine_of_quarter", "cosine_of_quarter", "reduced_angle",
    ),
    "test_emitter.py::test_arcs_are_good_to_the_ends": ("arc_cosine", "arc_sine"),
    "test_emitter.py::test_the_cube_root_is_numpy_s": ("third_power_root",),
    "test_emitter.py::test_the_angle_of_a_point_is_right_in_every_quadrant": ("angle_of",),
    "test_kernels_agree.py::test_an_encoding_s_number_is_its_place": ("encoded",),
    "test_kernels_agree.py::test_a_tone_map_s_number_is_its_place": (
        "shown_light", "curved", "exponential_color", "hable_color",
        "reinhard_extended_default_color",
    ),
    "test_kernels_agree.py::test_a_law_of_reflection_s_number_is_its_place": (
        "brdf_direct", "brdf_diffuse", "hapke_reflectance", "grain_phase", "multiple_scattering",
        "tilted",
    ),
    "test_kernels_agree.py::test_a_projection_s_number_is_its_place": ("projected_ray",),
    "test_kernels_agree.py::test_the_leg_of_a_panel_is_the_cpu_s": ("panel_leg",),
    "test_kernels_agree.py::test_the_map_of_the_ground_is_read_as_on_the_cpu": (
        "map_color", "map_cell", "add_texel", "level_place", "halved", "srgb_curve_inverse",
    ),
    "test_glare.py::test_glare_of_a_device_is_the_cpu_s": (
        "_mean_across", "coarser_texel", "finer_texel", "_blurred_across", "blurred_texel",
        "spread_texel", "glared_texel",
    ),
    "test_glare.py::test_beyond_the_circle_of_a_dome_a_device_shows_no_glare": ("beyond_circle",),
    "test_ground_detail.py::test_the_ground_before_a_low_observer_is_that_of_the_cpu": (
        "ground_cosine", "land_texture", "along_lattice", "lattice_place", "texture_light",
        "octave_change", "seen_row", "row_before", "hills", "woods", "canopy", "hill_size",
        "leafiness", "snowiness", "near_hills", "risen", "grown", "land_color", "seen_hill",
        "haze_beyond", "face_of", "faced", "plane_noise", "sloping_noise", "rocks", "rocks_met",
        "rock_area", "rock_met", "rocky_hills", "octave_seen",
    ),
    "test_ground_detail.py::test_detail_near_the_observer_is_that_of_the_cpu": (
        "ground_detail", "gradient_noise", "corner_slope", "smooth_noise", "lattice_value",
        "quintic", "shuffled", "below_289",
        "in_period",
    ),
    "test_ground_detail.py::test_craters_are_those_of_the_cpu": (
        "craters", "crater_of", "crater_slope", "level_floor", "shadowed", "sunk", "highland",
        "crater_share", "crater_tone", "lumps", "pit_light", "highlands", "land_craters", "rolling",
    ),
    "test_sea.py::test_waves_near_the_observer_are_those_of_the_cpu": (
        "sea_slopes", "peak_wavenumber", "saturation", "lattice_turns", "turned", "turned_back",
        "resolved", "triad_products", "triad_sum", "wave",
    ),
    "test_sea.py::test_the_sea_of_a_device_is_that_of_the_cpu": (
        "wave_light", "straight_end", "ground_spot", "resolved_waves", "disc_spread",
        "spread_glint", "mirror_waves", "sun_slices", "sea_sky_texel", "mirror_place",
        "mirror_facet", "add_mirrored", "mirrored_sky", "mirrored_texel", "wave_facet",
        "mean_facet", "slick_roughness", "slick_glint", "mirror_slope",
    ),
    "test_kernels_agree.py::test_a_formula_on_the_gpu_is_the_cpu_s": ("_shift", "_bend"),
    "test_clouds.py::test_clouds_of_a_device_are_those_of_the_cpu": (
        "cloud_cover", "keep_clouds", "clouded_light", "layer_reflectance", "layer_passage",
        "plane_albedo", "multiple_reflectance", "reflected_lanes",
    ),
    "test_ground_detail.py::test_decorated_ground_from_orbit_is_that_of_the_cpu": (
        "cloud_grain", "clouds_shown", "detailed_land", "displacement", "grained_cover",
        "height_at", "turning_place", "level_ground", "map_channel", "map_value",
        "moved_coast", "pixel_width", "relief_light", "sharper_share", "slope_light",
        "texture_footprint", "textured", "unevenness", "unmixed", "unshaded", "hazy_day",
        "removed_haze", "kept_haze", "cover_near", "sloping_gradient_noise", "star_azimuth",
        "tops_light", "land_from_above", "map_slope", "valleys", "gullies", "lattice_phasor",
        "rotated", "farmland", "patch_noise", "noise_gradient", "land_and_water", "edged",
        "edged_color", "shoal", "above_threshold", "river_share", "dunes",
        "river", "arid_at", "veil_grain", "veil_cover",
    ),
    "test_clouds.py::test_a_device_solves_for_the_mean_ground": (
        "_spread", "_sky_factor", "_under_clouds", "_under_cloudy_sky", "mean_reflected",
    ),
    "test_lights.py::test_lights_by_night_are_those_of_the_cpu": (
        "columns_to_ground", "lamp_light", "airglow_color", "airglow_on_ground", "night_light",
        "layer_column", "layer_columns", "skyglow_color", "lamps_below", "scattered_lamps",
        "crossing", "lamps_at", "lattice_light", "lit_place", "place_light", "round_light",
        "road_light", "by_night",
    ),
    "test_solver.py::test_a_preview_agrees_with_the_cpu": (
        "azimuthal", "depth", "factor", "floor", "four_levels", "gathered_moment", "gathered_onto",
        "highest", "highest_level", "largest_of", "light_number", "mean", "mixed", "next_guess",
        "node_scale", "packed", "projection", "radiance_again", "radiance_once", "ray_and_star",
        "refined", "row", "share", "sound", "strength", "transmittance", "ray_norm",
        "depth_in_row", "direct_light", "scattered_once", "contracted", "gathered",
        "mean_direct_reflectance", "diffuse_reflectance", "polarised_again", "azimuthal_once",
        "azimuthal_weight", "coupled_moments", "fill_phase_f12", "polarised_functions",
        "polarised_function",
        "odd_moment", "star_plane", "first_register", "source_at_point",
        "polarised_transmittance_ratio", "bounce",
    ),
}  # fmt: skip


def emitted_functions() -> dict[str, Any]:
    """Every function in a shader of the pictures or of the solver, by module and name."""
    emitters = [shader.emitter for shader in all_shaders()]
    add = Emitter.add

    def noted(self: Emitter, *arguments: Any, **options: Any) -> Any:
        if not any(self is one for one in emitters):
            emitters.append(self)
        return add(self, *arguments, **options)

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(Emitter, "add", noted)
        for name in solver_passes.PASSES:
            solver_passes.shader.__wrapped__(name)
    return {
        f"{one.function.__module__}.{one.function.__name__}": one.function
        for emitter in emitters
        for one in emitter.emitted.values()
    }


def test_every_function_of_every_shader_is_compared() -> None:
    # A new function in a shader must come with its case.
    every = emitted_functions()
    assert len(every) > 100
    file = Path(__file__).with_name("test_kernels_agree.py")
    plain = runpy.run_path(str(file))
    groups = (
        "GEOMETRY", "MAPPINGS", "PHASES", "COLORS", "RAYS", "GROUND", "WATER", "STEPS", "VECTORS",
    )  # fmt: skip
    compared = {case.function.py_func for group in groups for case in plain[group]}
    compared |= {one.py_func for case in CASES for one in case.of}
    whole = {name for functions in WHOLE.values() for name in functions}
    missing = [
        name for name, one in every.items() if one not in compared and one.__name__ not in whole
    ]
    assert missing == [], "each needs a case in test_kernels_agree.py, or in CASES or WHOLE here"
    assert whole <= {one.__name__ for one in every.values()}  # and no removed function is named


@pytest.mark.parametrize("test", WHOLE)
def test_what_is_compared_as_a_whole_has_that_test(test: str) -> None:
    file, name = test.split("::")
    assert f"\ndef {name}(" in Path(__file__).with_name(file).read_text(encoding="utf-8")
