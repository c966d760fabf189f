"""Marched pixels of a planet in the shadow of a moon, on the CPU.

Radiance in an eclipse is neither symmetric about the solar vertical nor smooth enough for a
sky-view LUT. Ground, water, clouds and lamps are as in ``pixel``.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.geometry.refraction import refraction_angle
from airlight.geometry.shell import distance_to_bottom, distance_to_top
from airlight.geometry.vectors import Vec3, components, dot, plus, scaled
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, lane_view, load, store
from airlight.physics.optics.cox_munk import mean_square_slope, mirrored_cosine
from airlight.render.pixels.deck import shade_deck
from airlight.render.pixels.pixel import ground_along, ground_radiance
from airlight.render.pixels.render_cpu import each_pixel
from airlight.render.pixels.sky_lookup import classify_ray
from airlight.render.pixels.sky_view_lut import half_sine_between
from airlight.render.pixels.skyline import haze_beyond
from airlight.solver.eclipsed.eclipsed_march import (
    TOTAL,
    Eclipse,
    EclipsedLine,
    eclipsed_ground_light,
    end_on_ground,
    march_eclipsed,
)
from airlight.solver.moments.march_tables import MIRRORED
from airlight.solver.moments.source import read_phase


class EclipsedWorkspace(NamedTuple):
    """Shadow, and workspace of its pixels.

    Attributes
    ----------
    turn : (Vec3, Vec3, Vec3)
        Axes of the shadow's frame in the observer's. [1]
    eclipse : Eclipse
        Tables and workspaces.
    found : array, shape (2, w)
        Workspace.
    """

    turn: tuple[Vec3, Vec3, Vec3]
    eclipse: Eclipse
    found: npt.NDArray[np.float32]


@inlined
def eclipsed_light(px, py, ray, beyond, exact, frame, work, color, result):
    """Spectral radiance of a pixel, per irradiance of the unocculted star. [sr⁻¹]

    Parameters
    ----------
    px, py, ray, beyond, exact, frame, color, result :
        Arguments of ``pixel_light``; every pixel is marched.
    work : EclipsedWorkspace
        Shadow and workspace.
    """
    turn, eclipse, found = work
    observer, tables, march_work = frame.observer, frame.tables, eclipse.work
    seen = classify_ray(ray, observer, tables)
    sine, to_ground = seen.sine, seen.to_ground
    result[:] = 0.0
    if not seen.through_air:
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
    read_phase(half_sine, tables.phase, march_work.phase)
    line = EclipsedLine(start.x, start.y, start.z, along.x, along.y, along.z, length, half_sine)
    march_eclipsed(line, TOTAL, march_work.phase, eclipse, found)
    result[:] = found[0]
    if not to_ground:
        shade_deck(ray, seen, observer, frame, color, result)
        return
    x, y, z, mu_r = end_on_ground(line, eclipse)
    refraction = 0.0
    if tables.refraction_strength > 0.0:
        refraction = refraction_angle(
            r, mu, tables.refraction_strength, march_work.columns_total[tables.constituents - 1]
        )
    march_work.radiance[0], march_work.radiance[1] = found[0], found[1]
    if beyond > 1.0:
        haze_beyond(ray, sine, beyond, frame, march_work)
        result[:] = march_work.radiance[0]
    if tables.ground.wet:
        _mirrored_sky(Vec3(x, y, z), along, mu_r, eclipse, found)
        march_work.radiance[MIRRORED] = found[0]
    factors = ground_along(ray, sine, refraction, False, observer, frame, march_work, color)
    eclipsed_ground_light(x, y, z, TOTAL, eclipse)
    for at in range(0, tables.lanes, LANES):
        received, behind = lane_view(march_work.irradiance, at), lane_view(march_work.radiance, at)
        white = (received[0] + received[1]) * INVERSE_PI * behind[1]
        ground = ground_radiance(white, factors, color, frame, march_work, at)
        store(result, at, load(result, at) + ground)
    shade_deck(ray, seen, observer, frame, color, result)


@inlined
def _mirrored_sky(end, along, mu_r, eclipse, found):
    """Sky radiance mirrored by water at the end of a line of sight, into ``radiance``. [sr⁻¹]

    Parameters
    ----------
    end, along, mu_r : Vec3, Vec3, float
        Point and cosine from ``end_on_ground``, and direction of the line. [m], [1]
    eclipse, found :
        Fields of ``EclipsedWorkspace``.
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
def render_eclipsed(px, py, frame, work, weights, out):
    """March pixels of a planet in the shadow of a moon.

    Parameters
    ----------
    px, py, frame, weights, out :
        Arguments of ``render_pixels``.
    work : EclipsedWorkspace
        Shadow and workspace of the thread.
    """
    each_pixel(eclipsed_light, True, px, py, frame, work, weights, out)
