r"""March of a line of sight through clouds and the air before them.

.. math:: L = \int_0^{s_1} \left[T_a S + A(s) \kappa\right] T_c \, ds + T_c(s_1) L_1 ,

with the transmittances of air and of clouds T_a and T_c, the source S of clouds, their extinction
κ, the path radiance A of the air up to a distance, and the radiance L₁ of all without clouds. In
the first order, S has the exact phase function and unscaled scattering with delta-M scaled
attenuation (TMS; Nakajima & Tanaka 1988, JQSRT 40, 51); higher orders come from moments.
"""

from __future__ import annotations

from math import exp, sqrt

import numpy as np

from airlight.geometry.vectors import Vec3, dot, minus, plus, scaled
from airlight.kernel import inlined
from airlight.kernel.lanes import (
    LANES,
    exponential,
    folded,
    lane_view,
    largest,
    load,
    maximum,
    pair,
    splat,
)
from airlight.render.clouds.beam_depth import cell_after, cell_before, cell_value
from airlight.render.clouds.cloud_place import (
    box_place,
    clear_distance,
    patch_place,
    visibility,
)
from airlight.render.clouds.detailed_extinction import detailed_extinction
from airlight.render.clouds.directions import fill_harmonics
from airlight.render.clouds.sight_extent import node_distance, node_of_distance
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
#: Points of an interval of the table of air at which the beam is followed; below the bases they are
#: a cell apart at least.
SHADOWS = 8


@inlined
def line_of_air(ray, half_sine, place, extent, clouds, tables, work):
    """Path radiance and transmittance of the air at the nodes of a line, without shaded light.

    Parameters
    ----------
    ray, half_sine : Vec3, float
        Direction in the observer's frame, and sin(θ/2) of the angle to the sun. [1]
    place : TexelPlace
        Place in the table of air.
    extent : SightExtent
        Part below the tops of the clouds.
    clouds, tables, work : CloudTables, MarchTables, CloudWork
        The workspace receives ``before``, ``through`` and, in ``light[3]``, the light lost.
    """
    nodes = clouds.air.shape[1]
    e, f = np.float32(place.right), np.float32(place.down)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    w00, w01, w10, w11 = g * h, g * e, f * h, f * e
    near, below = place.near, place.near + place.stride
    for at in range(0, tables.lanes, LANES):
        lane_view(work.light, at)[3] = splat(0.0)
    so_far = node_distance(0, nodes, extent)
    for node in range(nodes):
        shade = 0.0
        distance = node_distance(node, nodes, extent)
        middle = 0.5 * (so_far + distance)
        above = middle < extent.leaves or middle > extent.enters
        if node > 0 and distance > so_far:
            points = SHADOWS
            if so_far >= extent.leaves and distance <= extent.enters:
                points = min(max(int((distance - so_far) / clouds.step_x), 1), SHADOWS)
            gap = (distance - so_far) / points
            for k in range(points):
                s = so_far + (k + 0.5) * gap
                point = plus(Vec3(0.0, 0.0, clouds.eye), scaled(ray, s))
                width = max((distance - so_far) / SHADOWS, s * clouds.pixel_angle)
                shade += (1.0 - visibility(point, width, clouds)) / points
        for at in range(0, tables.lanes, LANES):
            air, kept = lane_view(clouds.air, at), lane_view(work.before, at)
            phases, lost = lane_view(tables.phase, at), lane_view(work.light, at)
            first = splat(0.0)
            for layer in range(3):
                one = (
                    w00 * air[near, node, layer]
                    + w01 * air[near + 1, node, layer]
                    + w10 * air[below, node, layer]
                    + w11 * air[below + 1, node, layer]
                )
                if layer == 1 and tables.separated_1 >= 0:
                    one = one * phase_of(half_sine, tables.separated_1, phases)
                if layer == 2 and tables.separated_2 >= 0:
                    one = one * phase_of(half_sine, tables.separated_2, phases)
                first = first + one
            higher = (
                w00 * air[near, node, 3]
                + w01 * air[near + 1, node, 3]
                + w10 * air[below, node, 3]
                + w11 * air[below + 1, node, 3]
            )
            lane_view(work.through, at)[node] = (
                w00 * air[near, node, 4]
                + w01 * air[near + 1, node, 4]
                + w10 * air[below, node, 4]
                + w11 * air[below + 1, node, 4]
            )
            ahead = lane_view(work.passed, at)
            factors = lane_view(clouds.air_light, at)
            more = factors[1] if above else factors[0]
            if node > 0:
                lost[3] = lost[3] + maximum(first - ahead[0], 0.0) * np.float32(shade)
                lost[3] = lost[3] + (higher - ahead[1]) * (np.float32(1.0) - more)
            else:
                lost[3] = higher * (np.float32(1.0) - more)
            ahead[0], ahead[1] = first, higher
            kept[node] = first + higher - lost[3]
        so_far = distance


@inlined
def add_clouds(ray, half_sine, extent, clouds, tables, work):
    """Light of clouds along a line of sight, after ``line_of_air``.

    Parameters
    ----------
    ray, half_sine, extent, clouds, tables, work :
        Arguments of ``line_of_air``; ``work.light`` receives radiance and transmittances.
    """
    for at in range(0, tables.lanes, LANES):
        light, passed = lane_view(work.light, at), lane_view(work.passed, at)
        light[0], light[1], light[2] = splat(0.0), splat(1.0), splat(1.0)
        passed[0], passed[1] = splat(1.0), splat(1.0)
        first = lane_view(work.first, at)
        first[0] = splat(0.0)
    solved = lane_view(work.solved)
    solved[0], solved[1] = splat(0.0), splat(1.0)
    eye = Vec3(0.0, 0.0, clouds.eye)
    least = STEP_CELL * min(clouds.step_x, clouds.step_y, clouds.step_z)
    steepest = largest(load(clouds.scaled[0], 0))
    s, start, weight, middle, depth = extent.first, extent.first, 0.0, 0.0, 0.0
    previous = 1.0
    found = 0.0
    for _ in range(MOST_STEPS):
        if extent.leaves < s < extent.enters:
            s = extent.enters + 1e-3
        if s >= extent.last or previous < OPAQUE:
            break
        point = plus(eye, scaled(ray, s))
        x, y, z, free, scale = patch_place(point, clouds)
        clear = min(scale * clear_distance(x, y, z, clouds), free)
        # a step is as wide as the footprint, but not higher than a level
        climb = max(abs(dot(ray, point)) / sqrt(dot(point, point)), 1e-3)
        coarse = min(STEP_PIXEL * s * clouds.pixel_angle, STEP_LEVEL * clouds.step_z / climb)
        coarse = max(least, coarse)
        if clear > coarse:
            s += clear
            found = 0.0
            continue
        most = min(coarse, extent.last - s)
        if s < extent.leaves:
            most = min(most, extent.leaves - s + 1e-3)
        step = min(most, max(STEP_DEPTH / max(found * steepest, 1e-9), 0.02 * least))
        for _again in range(2):
            point = plus(eye, scaled(ray, s + 0.5 * step))
            x, y, z = box_place(point, clouds)
            found = detailed_extinction(x, y, z, max(s, 1.0) * clouds.pixel_angle, clouds)
            # the first step inside a cloud is as short as those that follow
            shorter = max(STEP_DEPTH / max(found * steepest, 1e-9), 0.02 * least)
            if shorter >= 0.5 * step:
                break
            step = shorter
        s += step
        if found <= 0.0:
            continue
        add_step(ray, point, found, step, half_sine, clouds, tables, work)
        depth += found * step
        now = exp(-depth * clouds.scaled[0, 0])
        weight += previous - now
        middle += (previous - now) * (s - 0.5 * step)
        previous = now
        if s - start > TOGETHER * start + 4.0 * least:
            attenuate(middle / max(weight, 1e-12), extent, clouds, tables, work)
            start, weight, middle = s, 0.0, 0.0
    if weight > 0.0:
        attenuate(middle / weight, extent, clouds, tables, work)
    for at in range(0, tables.lanes, LANES):
        light, passed = lane_view(work.light, at), lane_view(work.passed, at)
        light[1] = passed[1]
        light[2] = exponential(splat(-depth) * load(clouds.whole[0], at))


@inlined
def add_step(ray, point, extinction, step, half_sine, clouds, tables, work):
    """Add the light of a step to the workspace, not yet attenuated by air.

    Parameters
    ----------
    point : Vec3
        Middle of the step, from the centre. [m]
    extinction, step : float
        Extinction at 550 nm [m⁻¹] and length [m].
    ray, half_sine, clouds, tables, work :
        Arguments of ``add_clouds``.
    """
    x, y, z = box_place(point, clouds)
    nz, ny, nx = clouds.extinction.shape
    beam = cell_value(clouds.depth, x, y, z, clouds.periodic)
    beam *= min(2.0 * max(nz - 0.5 - z, 0.0), 1.0)
    radius = sqrt(dot(point, point))
    height = dot(point, clouds.sun) / radius
    angle = (height - clouds.beam_low) / (clouds.beam_high - clouds.beam_low)
    angle = min(max(angle, 0.0), 1.0) * (clouds.beam.shape[1] - 1)
    low = min(int(angle), clouds.beam.shape[1] - 2)
    up = (radius - clouds.base) / (clouds.top - clouds.base) * (clouds.beam.shape[0] - 1)
    level = min(max(int(up), 0), clouds.beam.shape[0] - 2)
    e, f = np.float32(angle - low), np.float32(min(max(up - level, 0.0), 1.0))
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    for at in range(0, tables.lanes, LANES):
        scaled_extinction = load(clouds.scaled[0], at)
        first, passed, beams = (
            lane_view(work.first, at),
            lane_view(work.passed, at),
            lane_view(clouds.beam, at),
        )
        sun = g * (h * beams[level, low] + e * beams[level, low + 1]) + f * (
            h * beams[level + 1, low] + e * beams[level + 1, low + 1]
        )
        sun = sun * exponential(scaled_extinction * np.float32(-beam))
        kept = exponential(scaled_extinction * np.float32(-extinction * step))
        source = (
            sun * load(clouds.single[0], at) * phase_of(half_sine, 0, lane_view(clouds.phase, at))
        )
        first[0] = first[0] + source / scaled_extinction * passed[1] * (np.float32(1.0) - kept)
        passed[1] = passed[1] * kept
    # harmonics of the direction in which light propagates, in the frame of the place
    upward = scaled(point, 1.0 / radius)
    eastern = minus(clouds.east, scaled(upward, dot(clouds.east, upward)))
    eastern = scaled(eastern, 1.0 / sqrt(dot(eastern, eastern)))
    northern = Vec3(
        upward.y * eastern.z - upward.z * eastern.y,
        upward.z * eastern.x - upward.x * eastern.z,
        upward.x * eastern.y - upward.y * eastern.x,
    )
    fill_harmonics(
        -dot(ray, eastern), -dot(ray, northern), -dot(ray, upward), clouds.norms, work.harmonics
    )
    mz, my, mx, _, _ = clouds.source.shape
    i, ex = cell_before((x + 0.5) * mx / nx - 0.5, mx, clouds.periodic)
    j, ey = cell_before((y + 0.5) * my / ny - 0.5, my, clouds.periodic)
    # linear also in the outer halves of the lowest and the highest levels
    level = (z + 0.5) * mz / nz - 0.5
    k = min(max(int(level), 0), max(mz - 2, 0))
    ez = level - k
    right, back = cell_after(i, mx, clouds.periodic), cell_after(j, my, clouds.periodic)
    above = min(k + 1, mz - 1)
    source = lane_view(clouds.source)
    total = splat(0.0)
    for corner in range(8):
        column = right if corner & 1 else i
        line = back if corner & 2 else j
        layer = above if corner & 4 else k
        weight = (
            (ex if corner & 1 else 1.0 - ex)
            * (ey if corner & 2 else 1.0 - ey)
            * (ez if corner & 4 else 1.0 - ez)
        )
        if weight != 0.0:
            part = splat(0.0)
            for n in range(clouds.source.shape[3]):
                factor = pair(
                    np.float32(work.harmonics[2 * n]), np.float32(work.harmonics[2 * n + 1])
                )
                part = part + factor * source[layer, line, column, n]
            total = total + part * np.float32(weight)
    total = maximum(folded(total), 0.0)
    solved = lane_view(work.solved)
    scaled_extinction = load(clouds.solved_extinction[0], 0)
    kept = exponential(scaled_extinction * np.float32(-extinction * step))
    solved[0] = solved[0] + total / scaled_extinction * solved[1] * (np.float32(1.0) - kept)
    solved[1] = solved[1] * kept


@inlined
def attenuate(distance, extent, clouds, tables, work):
    """Move light of clouds around a distance to the result, behind the air before it.

    Parameters
    ----------
    distance : float
        Mean distance. [m]
    extent, clouds, tables, work :
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
        spectrum = lane_view(clouds.spectrum, at)
        total = first[0]
        for n in range(4):
            total = total + spectrum[n] * np.float32(work.solved[0, n])
        total = maximum(total, 0.0)
        through, before = lane_view(work.through, at), lane_view(work.before, at)
        light[0] = (
            light[0]
            + (h * through[node] + e * through[node + 1]) * total
            + (h * before[node] + e * before[node + 1]) * (passed[0] - passed[1])
        )
        first[0] = splat(0.0)
        passed[0] = passed[1]
    lane_view(work.solved)[0] = splat(0.0)
