"""Marched pixels of a planet in the shadow of a moon, on the CPU.

Radiance in an eclipse is neither symmetric about the solar vertical nor smooth enough for a
sky-view LUT. Ground, water, clouds and lamps are as in ``pixel``.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.geometry.refraction import refraction_angle
from airlight.geometry.shell import distance_to_bottom, distance_to_top
from airlight.geometry.vectors import Vec3, components, dot, plus, scaled
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, lane_view, load, store
from airlight.kernel.without_refcount import without_refcount
from airlight.physics.optics.cox_munk import mean_square_slope, mirrored_cosine
from airlight.render.pixels.ground import (
    GROUND_VALUES,
    ground_factor,
    ground_reflectances,
    lamp_light,
)
from airlight.render.pixels.ground_angles import columns_to_ground
from airlight.render.pixels.pixel import classify_ray
from airlight.render.pixels.samples import sample_place, samples_per_side
from airlight.render.pixels.sky_view_lut import half_sine_between
from airlight.render.pixels.star_disc import camera_direction
from airlight.solver.eclipsed.eclipsed_march import (
    TOTAL,
    EclipsedLine,
    eclipsed_ground_light,
    end_on_ground,
    march_eclipsed,
)
from airlight.solver.moments.march_tables import MIRRORED
from airlight.solver.moments.source import read_phase


@inlined
def eclipsed_light(ray, turn, frame, eclipse, color, found, result):
    """Spectral radiance along a line of sight, per irradiance of the unocculted star. [sr⁻¹]

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame. [1]
    turn : (Vec3, Vec3, Vec3)
        Axes of the shadow's frame in the observer's. [1]
    frame, color :
        Arguments of ``pixel_light``.
    eclipse : Eclipse
    found : array, shape (2, w)
        Workspace.
    result : array, shape (w,)
        Receives the radiance. [sr⁻¹]
    """
    observer, view, tables, work = frame.observer, frame.camera, frame.tables, eclipse.work
    sine, _, through_air, to_ground = classify_ray(ray, observer, tables)
    result[:] = 0.0
    if not through_air:
        return
    x_axis, y_axis, z_axis = turn
    along = components(ray, x_axis, y_axis, z_axis)
    r, mu, way = observer.r, ray.z, 0.0
    if observer.outside:
        impact = observer.r * sine
        half = sqrt(max((tables.top - impact) * (tables.top + impact), 0.0))
        way = -observer.r * ray.z - half
        r, mu = tables.top, -half / tables.top
    up = Vec3(x_axis.z, y_axis.z, z_axis.z)
    start = plus(scaled(up, observer.r), scaled(along, way))
    length = distance_to_top(r, mu, tables.top)
    if to_ground:
        length = distance_to_bottom(r, mu, tables.bottom)
    half_sine = half_sine_between(ray, observer.seen_x, observer.seen_z)
    read_phase(half_sine, tables.phase, work.phase)
    line = EclipsedLine(start.x, start.y, start.z, along.x, along.y, along.z, length, half_sine)
    march_eclipsed(line, TOTAL, work.phase, eclipse, found)
    result[:] = found[0]
    if not to_ground:
        return
    px, py, pz, mu_r = end_on_ground(line, eclipse)
    refraction = 0.0
    if tables.refraction_strength > 0.0:
        refraction = refraction_angle(
            r, mu, tables.refraction_strength, work.columns_total[tables.constituents - 1]
        )
    work.radiance[1] = found[1]
    if tables.ground.wet:
        _mirrored_sky(Vec3(px, py, pz), along, mu_r, eclipse, found)
        work.radiance[MIRRORED] = found[0]
    factors = ground_reflectances(ray, sine, refraction, frame, work, color)
    eclipsed_ground_light(px, py, pz, TOTAL, eclipse)
    if view.overlaid:
        columns_to_ground(ray.z, sine, observer, tables, work.columns_total, work.columns_so_far)
    for at in range(0, tables.lanes, LANES):
        received, behind = lane_view(work.irradiance, at), lane_view(work.radiance, at)
        factor = ground_factor(color, view, factors, tables, work, at)
        white = (received[0] + received[1]) * INVERSE_PI * behind[1]
        total = load(result, at) + white * factor
        if view.overlaid:
            total = total + lamp_light(color, view, tables, work.columns_total, at)
        store(result, at, total)


@inlined
def _mirrored_sky(end, along, mu_r, eclipse, found):
    """Sky radiance mirrored by water at the end of a line of sight, into ``radiance``. [sr⁻¹]

    Parameters
    ----------
    end, along, mu_r : Vec3, Vec3, float
        Point and cosine from ``end_on_ground``, and direction of the line. [m], [1]
    eclipse, found :
        Arguments of ``eclipsed_light``.
    """
    tables, work = eclipse.tables, eclipse.work
    up = Vec3(end.x / tables.bottom, end.y / tables.bottom, end.z / tables.bottom)
    mu = mirrored_cosine(mu_r, tables.ground.wind)
    level = sqrt(max((1.0 - mu_r) * (1.0 + mu_r), 1e-12))
    side = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0)) / level
    # The line without its vertical part, at its new zenith angle.
    mirrored = plus(scaled(up, mu), scaled(plus(along, scaled(up, mu_r)), side))
    star = eclipse.shadow.star
    nu = min(max(dot(mirrored, Vec3(star.star_x, star.star_y, star.star_z)), -1.0), 1.0)
    # Blurred by the slope distribution of the facets.
    spread = 0.25 * mean_square_slope(tables.ground.wind)
    half_sine = sqrt(min(0.5 * (1.0 - nu) + spread, 1.0))
    read_phase(half_sine, tables.phase, work.phase)
    length = distance_to_top(tables.bottom, mu, tables.top)
    line = EclipsedLine(end.x, end.y, end.z, mirrored.x, mirrored.y, mirrored.z, length, half_sine)
    march_eclipsed(line, TOTAL, work.phase, eclipse, found)


@compiled_loop
def render_eclipsed(px, py, turn, frame, eclipse, out):
    """March pixels of a planet in the shadow of a moon.

    Parameters
    ----------
    px, py : array, shape (n,)
        Pixel centres, from the left and top edge of the frame. [pixel]
    turn, frame, eclipse :
        Arguments of ``eclipsed_light``.
    out : array, shape (n, w)
        Receives the radiance per irradiance of the unocculted star. [sr⁻¹]
    """
    frame, eclipse = without_refcount((frame, eclipse))
    lanes, view = frame.tables.lanes, frame.camera
    found, result = np.empty((2, lanes), np.float32), np.empty(lanes, np.float32)
    color = np.zeros(GROUND_VALUES)
    for k in range(px.size):
        ray = camera_direction(px[k], py[k], view)
        side = samples_per_side(ray, frame.observer, view)
        for at in range(lanes):
            out[k, at] = 0.0
        for sample in range(side * side):
            if side > 1:
                sx, sy = sample_place(px[k], py[k], sample, side, view)
                ray = camera_direction(sx, sy, view)
            eclipsed_light(ray, turn, frame, eclipse, color, found, result)
            for at in range(lanes):
                out[k, at] += result[at] / (side * side)
