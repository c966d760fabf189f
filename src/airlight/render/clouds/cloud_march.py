r"""March of a line of sight through clouds and the air before them.

.. math:: L = \int_0^{s_1} \left[T_a S + A(s) \kappa\right] T_c \, ds + T_c(s_1) L_1 ,

with the transmittances of air and of clouds T_a and T_c, the source S of clouds, their extinction
κ, the path radiance A of the air up to a distance, and the radiance L₁ of all without clouds. In
the first order, S has the exact phase function and unscaled scattering with delta-M scaled
attenuation (TMS; Nakajima & Tanaka 1988, JQSRT 40, 51); higher orders come from moments. With
polarisation, L is each of ``PARTS``: S has the exact element F₁₂ in the first order, and no other.
"""

from __future__ import annotations

from math import exp, floor, sqrt

import numpy as np

from airlight.geometry.vectors import Vec3, dot, minus, plus, scaled
from airlight.kernel import inlined
from airlight.kernel.lanes import (
    LANES,
    exponential,
    folded,
    lane_view,
    largest,
    maximum,
    splat,
)
from airlight.kernel.tuple_item import tuple_item
from airlight.render.clouds.cell_level import CellLevel, cell_level, level_number
from airlight.render.clouds.cloud_place import (
    beam_depth_at,
    box_place,
    clear_way,
)
from airlight.render.clouds.cloud_tables import (
    ONCE,
    PARTS,
    WHOLE,
)
from airlight.render.clouds.detailed_extinction import extinction_at
from airlight.render.clouds.directions import fill_harmonics
from airlight.render.clouds.higher_orders import inner_place, mixed_source
from airlight.render.clouds.local_sun import local_light, sun_place
from airlight.render.clouds.sight_extent import (
    node_of_distance,
    way_out_of_layer,
    way_to_layer,
)
from airlight.render.pixels.sky_lookup import phase_of

#: Transmittance at which a line ends. [1]
OPAQUE = 0.005
#: Optical depth of a step inside clouds. [1]
STEP_DEPTH = 0.3
#: Length of a step over the smallest width of a cell, and over the width of a pixel; its height
#: over that of a cell. [1]
STEP_CELL = 0.5
STEP_PIXEL = 2.0
STEP_LEVEL = 1.0
#: Largest number of steps.
MOST_STEPS = 6000
#: Share of the distance after which light is attenuated by the air together. [1]
TOGETHER = 0.02


@inlined
def add_clouds(ray, half_sine, extent, polarised, clouds, tables, work):
    """Light of clouds along a line of sight, after ``line_of_air``.

    Parameters
    ----------
    ray, half_sine, extent, polarised, clouds, tables, work :
        Arguments of ``line_of_air``; ``work.extents`` has the result of ``sight_extents``, and the
        workspace receives ``light`` and ``clear``.
    """
    no_light(tables, work)
    for at in range(0, tables.lanes, LANES):
        first, passed = lane_view(work.first, at), lane_view(work.passed, at)
        passed[0], passed[1] = splat(1.0), splat(1.0)
        first[WHOLE], first[ONCE] = splat(0.0), splat(0.0)
    count = len(clouds.layers)
    solved = lane_view(work.solved)
    for n in range(len(clouds.layers)):
        solved[n] = splat(0.0)
        work.found[n], work.depths[n] = 0.0, 0.0
    solved[count] = splat(1.0)
    eye = Vec3(0.0, 0.0, clouds.eye)
    s, start, weight, middle = extent.first, extent.first, 0.0, 0.0
    previous, entry = 1.0, dither(ray)
    for _turn in range(MOST_STEPS):
        if s >= extent.last or previous < OPAQUE:
            break
        point = plus(eye, scaled(ray, s))
        footprint = STEP_PIXEL * s * clouds.pixel_angle
        # a step is as wide as the footprint, but not higher than a level
        climb = max(abs(dot(ray, point)) / sqrt(dot(point, point)), 1e-3)
        most, least, near = 1e9, 1e9, False
        for n in range(len(clouds.layers)):
            layer = tuple_item(clouds.layers, n)
            clear = way_to_layer(s, n, work)
            work.numbers[n] = level_number(s * clouds.pixel_angle, climb, layer)
            if clear == 0.0:
                clear = clear_way(box_place(point, layer), work.numbers[n], layer)
                finest = STEP_CELL * min(layer.step_x, layer.step_y, layer.step_z)
                coarse = max(finest, min(footprint, STEP_LEVEL * layer.step_z / climb))
                if clear <= coarse:
                    near, least = True, min(least, finest)
                    clear = min(coarse, way_out_of_layer(s, n, work))
            most = min(most, clear)
        if not near:
            s += most
            for n in range(len(clouds.layers)):
                work.found[n] = 0.0
            entry = dither(ray)
            continue
        most = min(most, extent.last - s)
        step = min(most, largest_step(least, clouds, work)) * entry
        for _again in range(2):
            point = plus(eye, scaled(ray, s + 0.5 * step))
            width, any_found = max(s, 1.0) * clouds.pixel_angle, False
            for n in range(len(clouds.layers)):
                layer, found = tuple_item(clouds.layers, n), 0.0
                if way_to_layer(s + 0.5 * step, n, work) == 0.0:
                    found = extinction_at(box_place(point, layer), width, work.numbers[n], layer)
                work.found[n] = found
                any_found = any_found or found > 0.0
            # the first step inside a cloud is as short as those that follow
            shorter = largest_step(least, clouds, work)
            if shorter >= 0.5 * step:
                break
            step = shorter
        s += step
        entry = 1.0
        if not any_found:
            continue
        for n in range(len(clouds.layers)):
            layer = tuple_item(clouds.layers, n)
            work.beams[n] = beam_depth_at(point, work.numbers[n], layer)
        now = 1.0
        for n in range(len(clouds.layers)):
            layer = tuple_item(clouds.layers, n)
            if work.found[n] > 0.0:
                add_step(ray, point, n, step, half_sine, polarised, clouds, tables, work)
                work.depths[n] += work.found[n] * step
            now *= exp(-work.depths[n] * layer.scaled[0, 0])
        weight += previous - now
        middle += (previous - now) * (s - 0.5 * step)
        previous = now
        if s - start > TOGETHER * start + 4.0 * least:
            attenuate(middle / max(weight, 1e-12), extent, polarised, clouds, tables, work)
            start, weight, middle = s, 0.0, 0.0
    if weight > 0.0:
        attenuate(middle / weight, extent, polarised, clouds, tables, work)
    for at in range(0, tables.lanes, LANES):
        clear, passed = lane_view(work.clear, at), lane_view(work.passed, at)
        clear[0] = passed[1]
        depth = splat(0.0)
        for n in range(len(clouds.layers)):
            whole = lane_view(tuple_item(clouds.layers, n).whole, at)[0]
            depth = depth + whole * np.float32(-work.depths[n])
        clear[1] = exponential(depth)


@inlined
def no_light(tables, work):
    """Result of a line of sight without clouds, in ``work.light`` and ``work.clear``."""
    for at in range(0, tables.lanes, LANES):
        light, clear = lane_view(work.light, at), lane_view(work.clear, at)
        for part in range(PARTS):
            light[part] = splat(0.0)
        clear[0], clear[1] = splat(1.0), splat(1.0)


@inlined
def dither(ray):
    """Length of the first step of a line over that of the others: even between 1/4 and 1. [1]

    Lines side by side would else meet detail at the same distances, in streaks. The factors are by
    eye: in single precision the result is within 0.01.
    """
    place = 437.585453 * (12.9898 * ray.x + 78.233 * ray.y + 37.719 * ray.z)
    return 0.25 + 0.75 * (place - floor(place))


@inlined
def largest_step(least, clouds, work):
    """Length of a step of the optical depth ``STEP_DEPTH`` in the extinction found last. [m]

    Parameters
    ----------
    least : float
        Smallest length of a step outside clouds. [m]
    clouds, work : CloudTables, CloudWork
        Arguments of ``add_clouds``.
    """
    extinction = 1e-9
    for n in range(len(clouds.layers)):
        extinction += work.found[n] * largest(lane_view(tuple_item(clouds.layers, n).scaled, 0)[0])
    return max(STEP_DEPTH / extinction, 0.02 * least)


@inlined
def add_step(ray, point, number, step, half_sine, polarised, clouds, tables, work):
    """Add the light of a layer in a step to the workspace, not yet attenuated by air.

    Parameters
    ----------
    point : Vec3
        Middle of the step, from the centre. [m]
    number, step : int, float
        Number of the layer, and length [m].
    ray, half_sine, polarised, clouds, tables, work :
        Arguments of ``add_clouds``; the workspace has extinction, and depths to the sun.
    """
    layer, extinction = tuple_item(clouds.layers, number), work.found[number]
    count = len(clouds.layers)
    place = box_place(point, layer)
    nz, cells = layer.extinction.shape[0], cell_level(0, layer.levels)
    nx, ny = cells.columns, cells.rows
    radius = sqrt(dot(point, point))
    low, lower = sun_place(point, layer)
    up = (radius - layer.base) / (layer.top - layer.base) * (layer.beam.shape[0] - 1)
    level = min(max(int(up), 0), layer.beam.shape[0] - 2)
    e, f = np.float32(lower), np.float32(min(max(up - level, 0.0), 1.0))
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    for at in range(0, tables.lanes, LANES):
        scaled_extinction = lane_view(layer.scaled, at)[0]
        first, ahead, beams = (
            lane_view(work.first, at),
            lane_view(work.passed, at),
            lane_view(layer.beam, at),
        )
        sun = g * (h * beams[level, low] + e * beams[level, low + 1]) + f * (
            h * beams[level + 1, low] + e * beams[level + 1, low + 1]
        )
        shade = splat(0.0)
        for n in range(len(clouds.layers)):
            dimming = lane_view(tuple_item(clouds.layers, n).scaled, at)[0]
            shade = shade + dimming * np.float32(-work.beams[n])
        sun = sun * exponential(shade)
        kept = exponential(scaled_extinction * np.float32(-extinction * step))
        once = sun * lane_view(layer.single, at)[0]
        once = once / scaled_extinction * ahead[1] * (np.float32(1.0) - kept)
        first[WHOLE] += once * phase_of(half_sine, 0, lane_view(layer.phase, at))
        if polarised:
            first[ONCE] += once * phase_of(half_sine, 0, lane_view(layer.phase_f12, at))
        ahead[1] = ahead[1] * kept
    # harmonics of the direction in which light propagates, in the frame of the place
    upward = scaled(point, 1.0 / radius)
    eastern = minus(layer.east, scaled(upward, dot(layer.east, upward)))
    eastern = scaled(eastern, 1.0 / sqrt(dot(eastern, eastern)))
    northern = Vec3(
        upward.y * eastern.z - upward.z * eastern.y,
        upward.z * eastern.x - upward.x * eastern.z,
        upward.x * eastern.y - upward.y * eastern.x,
    )
    fill_harmonics(
        -dot(ray, eastern), -dot(ray, northern), -dot(ray, upward), layer.norms, work.harmonics
    )
    rows = cell_level(work.numbers[number], layer.source_levels)
    height = (place.z + 0.5) / nz
    total = splat(0.0)
    share, x, y = 1.0 - place.share, place.x, place.y
    for _turn in range(2):
        if share > 0.0:
            u, v, inner = 0.0, 0.0, 0.0
            if work.numbers[number] == 0 and layer.inner.columns > 0:
                u, v, inner = inner_place(x, y, nx, ny, layer.inner, layer.periodic)
            if inner > 0.0:
                found = mixed_source(
                    layer.inner.source,
                    CellLevel(layer.inner.columns, layer.inner.rows, 0),
                    Vec3(u, v, height),
                    False,
                    work.harmonics,
                )
                total = total + found * np.float32(share * inner)
            if inner < 1.0:
                outer = Vec3((x + 0.5) / nx, (y + 0.5) / ny, height)
                found = mixed_source(layer.source, rows, outer, layer.periodic, work.harmonics)
                total = total + found * np.float32(share * (1.0 - inner))
        share, x, y = place.share, place.other_x, place.other_y
    total = maximum(folded(total), 0.0) * local_light(height, low, lower, layer)
    solved = lane_view(work.solved)
    scaled_extinction = lane_view(layer.solved_extinction)[0]
    kept = exponential(scaled_extinction * np.float32(-extinction * step))
    passed = solved[count]
    solved[number] = solved[number] + total / scaled_extinction * passed * (np.float32(1.0) - kept)
    solved[count] = passed * kept


@inlined
def attenuate(distance, extent, polarised, clouds, tables, work):
    """Move light of clouds around a distance to the result, behind the air before it.

    Parameters
    ----------
    distance : float
        Mean distance. [m]
    extent, polarised, clouds, tables, work :
        Arguments of ``add_clouds``.
    """
    nodes = clouds.air.shape[1]
    place = node_of_distance(distance, nodes, extent)
    node = min(int(place), nodes - 2)
    e = np.float32(place - node)
    h = np.float32(1.0) - e
    for at in range(0, tables.lanes, LANES):
        light, first, passed = (
            lane_view(work.light, at),
            lane_view(work.first, at),
            lane_view(work.passed, at),
        )
        total = first[WHOLE]
        for number in range(len(clouds.layers)):
            spectrum = lane_view(tuple_item(clouds.layers, number).spectrum, at)
            for n in range(4):
                total = total + spectrum[n] * np.float32(work.solved[number, n])
        total = maximum(total, 0.0)
        through, before = lane_view(work.through, at), lane_view(work.before, at)
        seen, gone = h * through[node] + e * through[node + 1], passed[0] - passed[1]
        light[WHOLE] += (
            seen * total + (h * before[node, WHOLE] + e * before[node + 1, WHOLE]) * gone
        )
        if polarised:
            light[ONCE] += seen * first[ONCE]
            for part in range(ONCE, PARTS):
                light[part] += (h * before[node, part] + e * before[node + 1, part]) * gone
        first[WHOLE], first[ONCE] = splat(0.0), splat(0.0)
        passed[0] = passed[1]
    for number in range(len(clouds.layers)):
        lane_view(work.solved)[number] = splat(0.0)
