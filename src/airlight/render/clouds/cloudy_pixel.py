"""Pixels of a planet with three-dimensional clouds, on the CPU.

Sky, ground, water, lamps and light of the night are as in ``pixel``: behind the clouds, in their
shadow, and with the diffuse light below them.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from airlight.geometry.vectors import Vec3, dot, plus, scaled
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, exponential, lane_view, load, maximum, splat, store
from airlight.kernel.tuple_item import tuple_item
from airlight.render.clouds.beam_depth import cell_after, cell_before
from airlight.render.clouds.cell_level import cell_level, level_number
from airlight.render.clouds.cloud_march import add_clouds, no_light
from airlight.render.clouds.cloud_place import beam_depth_at, box_place
from airlight.render.clouds.cloud_tables import ONCE, PARTS, WHOLE, CloudTables, CloudWork, Q, U
from airlight.render.clouds.line_of_air import line_of_air
from airlight.render.clouds.local_sun import local_light, local_slant, sun_place
from airlight.render.clouds.sight_extent import sight_extents
from airlight.render.pixels.ground_angles import ground_angles
from airlight.render.pixels.pixel import (
    disc_light,
    filtered,
    line_radiance,
    seen_disc,
    seen_line,
)
from airlight.render.pixels.render_cpu import each_pixel
from airlight.render.pixels.sky_lookup import classify_ray, sky_view_place
from airlight.render.pixels.sky_view_lut import half_sine_between
from airlight.render.pixels.skyline import haze_beyond
from airlight.solver.moments.irradiance import ground_light
from airlight.solver.moments.march_tables import FACETS, MIRRORED, MarchWorkspace
from airlight.solver.stokes_frame import star_plane


class CloudyWorkspace(NamedTuple):
    """Clouds, and workspaces of their pixels.

    Attributes
    ----------
    air, clouds, front : MarchWorkspace, CloudTables, CloudWork
        Workspace of a pixel without clouds, clouds, and workspace of their light.
    """

    air: MarchWorkspace
    clouds: CloudTables
    front: CloudWork


@inlined
def cloudy_light(px, py, ray, beyond, exact, frame, work, color, result):
    """Spectral radiance of a pixel, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    px, py, ray, beyond, exact, frame, color, result :
        Arguments of ``pixel_light``.
    work : CloudyWorkspace
        Clouds and workspaces.
    """
    observer, view, tables = frame.observer, frame.camera, frame.tables
    air_work, clouds, front = work.air, work.clouds, work.front
    found = classify_ray(ray, observer, tables)
    no_light(tables, front)
    for at in range(0, tables.lanes, LANES):
        for part in range(PARTS):
            lane_view(front.lost, at)[part] = splat(0.0)
    extent = sight_extents(ray, found.sine, found.to_ground, clouds, front)
    if found.through_air and view.draws_air:
        half_sine = half_sine_between(ray, observer.seen_x, observer.seen_z)
        place = sky_view_place(ray, found, clouds.window)
        # also above the tops, where the air is in the light of the clouds
        line_of_air(ray, half_sine, place, extent, view.filter > 0, clouds, tables, front)
        if extent.last > extent.first:
            add_clouds(ray, half_sine, extent, view.filter > 0, clouds, tables, front)
    seen = seen_line(ray, found, exact, observer, frame, air_work, color)
    if beyond > 1.0:
        haze_beyond(ray, found.sine, beyond, frame, air_work)
    if seen.through_air and seen.to_ground:
        mu_s, _, _ = ground_angles(ray.x, ray.z, found.sine, seen.refraction, observer, tables)
        ground_light(mu_s, observer.orders, tables, air_work)
        shade_ground(ray, extent.last, observer.orders, clouds, tables, air_work, front)
    turn_cosine, turn_sine = np.float32(1.0), np.float32(0.0)
    if view.filter > 0:
        nu = min(max(ray.x * observer.sun_x + ray.z * observer.sun_z, -1.0), 1.0)
        cosine, sine = star_plane(ray.z, observer.sun_z, nu)
        turn_cosine, turn_sine = np.float32(cosine), np.float32(sine)
    for at in range(0, tables.lanes, LANES):
        radiance, light = lane_view(air_work.radiance, at), lane_view(front.light, at)
        lost = lane_view(front.lost, at)
        clear = lane_view(front.clear, at)[0]
        air = maximum(radiance[0] - lost[WHOLE], 0.0)
        total = line_radiance(air, seen, color, frame, air_work, at)
        total = light[WHOLE] + clear * total
        if view.filter > 0:
            once = light[ONCE] - clear * lost[ONCE]
            radiance[4] = light[Q] + clear * (radiance[4] - lost[Q]) + once * turn_cosine
            radiance[5] = light[U] + clear * (radiance[5] - lost[U]) + once * turn_sine
        store(result, at, filtered(total, seen, view, air_work, at))
    if view.draws_disc and not seen.to_ground:
        powers, on_disc = seen_disc(px, py, ray, frame, air_work.columns_total)
        if powers.p0 > 0.0:
            for at in range(0, tables.lanes, LANES):
                disc = disc_light(powers, on_disc, seen.whole, tables, air_work.columns_total, at)
                disc = disc * lane_view(front.clear, at)[1]
                store(result, at, load(result, at) + disc)


@inlined
def shade_ground(ray, distance, orders, clouds, tables, work, front):
    """Replace the light of clear sky on the ground by that below the clouds.

    Parameters
    ----------
    ray, distance : Vec3, float
        Direction in the observer's frame, and distance of the ground. [1], [m]
    orders : int
        Orders of scattering, see ``Observer``.
    clouds, tables, work : CloudTables, MarchTables, MarchWorkspace
        The workspace has direct and diffuse irradiance of clear sky, the light of the white ground
        behind the air, and the mirrored sky; all are changed.
    front : CloudWork
        Workspace of the clouds.
    """
    point = plus(Vec3(0.0, 0.0, clouds.eye), scaled(ray, distance))
    climb = max(-dot(ray, point) / sqrt(dot(point, point)), 1e-3)
    lowest = -1
    for n in range(len(clouds.layers) - 1, -1, -1):
        layer = tuple_item(clouds.layers, n)
        number = level_number(distance * clouds.pixel_angle, climb, layer)
        front.beams[n] = beam_depth_at(point, number, layer)
        place = box_place(point, layer)
        x, y = place.x, place.y
        cells = cell_level(0, layer.levels)
        inside = -0.5 <= x < cells.columns - 0.5 and -0.5 <= y < cells.rows - 0.5
        if layer.periodic or inside:
            lowest = n
            low, share = sun_place(point, layer)
            below = ground_below(x, y, number, layer)
            lane_view(front.solved)[0] = below * local_light(0.0, low, share, layer)
    for at in range(0, tables.lanes, LANES):
        received, behind = lane_view(work.irradiance, at), lane_view(work.radiance, at)
        before = maximum(received[0] + received[1], splat(1e-30))
        sky_before = maximum(received[1], splat(1e-30))
        for n in range(len(clouds.layers)):
            layer = tuple_item(clouds.layers, n)
            width = 0.5 * layer.step_x * layer.levels[0, 0]
            mean = np.float32(layer.mean_visibility ** local_slant(point, layer))
            wide = np.float32(min(distance * clouds.pixel_angle / width, 1.0))
            seen = exponential(lane_view(layer.scaled, at)[0] * np.float32(-front.beams[n]))
            received[0] = received[0] * (seen + (splat(mean) - seen) * wide)
            if n == lowest and orders != 1:
                spectrum = lane_view(layer.spectrum, at)
                diffuse = splat(0.0)
                for k in range(4):
                    diffuse = diffuse + spectrum[k] * np.float32(front.solved[0, k])
                received[1] = maximum(diffuse, splat(0.0))
        behind[1] = behind[1] * ((received[0] + received[1]) / before)
        if tables.ground.wet:
            ratio = received[1] / sky_before
            behind[MIRRORED] = behind[MIRRORED] * ratio
            behind[FACETS] = behind[FACETS] * ratio


@inlined
def ground_below(x, y, number, layer):
    """Diffuse irradiance of the ground at the solved wavelengths, twice. [1]

    Parameters
    ----------
    x, y : float
        Place from ``box_place``. [cells]
    number : int
        Number of the level of detail.
    layer : LayerTables
        Clouds above.
    """
    cells, rows = cell_level(0, layer.levels), cell_level(number, layer.source_levels)
    mx, my, first = rows.columns, rows.rows, rows.first
    i, e = cell_before((x + 0.5) * mx / cells.columns - 0.5, mx, layer.periodic)
    j, f = cell_before((y + 0.5) * my / cells.rows - 0.5, my, layer.periodic)
    right, back = cell_after(i, mx, layer.periodic), cell_after(j, my, layer.periodic)
    j, back = first + j, first + back
    down = lane_view(layer.down)
    return (
        down[j, i] * np.float32((1.0 - e) * (1.0 - f))
        + down[j, right] * np.float32(e * (1.0 - f))
        + down[back, i] * np.float32((1.0 - e) * f)
        + down[back, right] * np.float32(e * f)
    )


@compiled_loop
def render_cloudy(px, py, frame, work, weights, out):
    """Render pixels with the sky-view LUT.

    Parameters
    ----------
    px, py, frame, weights, out :
        Arguments of ``render_pixels``.
    work : CloudyWorkspace
        Clouds and workspaces of the thread.
    """
    each_pixel(cloudy_light, False, px, py, frame, work, weights, out)


@compiled_loop
def render_two_kinds(px, py, frame, work, weights, out):
    """``render_cloudy`` with clouds of two kinds, which is compiled by itself."""
    each_pixel(cloudy_light, False, px, py, frame, work, weights, out)


@compiled_loop
def render_three_kinds(px, py, frame, work, weights, out):
    """``render_cloudy`` with clouds of three kinds."""
    each_pixel(cloudy_light, False, px, py, frame, work, weights, out)


@compiled_loop
def march_cloudy(px, py, frame, work, weights, out):
    """March pixels; arguments of ``render_cloudy``."""
    each_pixel(cloudy_light, True, px, py, frame, work, weights, out)


#: Loops with the sky-view LUT by the number of kinds of clouds less one.
BY_KINDS = (render_cloudy, render_two_kinds, render_three_kinds)
