"""Air before clouds on a line of sight, in their shadow and in their light."""

from __future__ import annotations

from math import exp

import numpy as np

from airlight.geometry.vectors import Vec3, dot, plus, scaled
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, maximum, splat
from airlight.kernel.tuple_item import tuple_item
from airlight.render.clouds.cell_level import level_number
from airlight.render.clouds.cloud_place import box_depth_at
from airlight.render.clouds.cloud_tables import (
    FIRST,
    FIRST_P,
    HIGHER,
    HIGHER_Q,
    HIGHER_U,
    LOST,
    LOST_Q,
    LOST_U,
    ONCE,
    PARTS,
    PEAKS,
    THROUGH,
    WHOLE,
    Q,
    U,
)
from airlight.render.clouds.local_sun import local_slant
from airlight.render.clouds.sight_extent import node_distance
from airlight.render.pixels.sky_lookup import phase_of

#: Most points of an interval of the table of air at which the beam is followed, a cell apart at
#: least.
SHADOWS = 8


@inlined
def line_of_air(ray, half_sine, place, extent, polarised, clouds, tables, work):
    """Path radiance and transmittance of the air at the nodes of a line, with shadows.

    Parameters
    ----------
    ray, half_sine : Vec3, float
        Direction in the observer's frame, and sin(θ/2) of the angle to the sun. [1]
    place : TexelPlace
        Place in the table of air.
    extent : SightExtent
        Part below the highest top.
    polarised : bool
        Whether also the parts of polarised light are computed.
    clouds, tables, work : CloudTables, MarchTables, CloudWork
        The workspace receives ``before``, ``through`` and ``lost``.
    """
    nodes = clouds.air.shape[1]
    for at in range(0, tables.lanes, LANES):
        for part in range(PARTS):
            lane_view(work.lost, at)[part] = splat(0.0)
    for node in range(nodes):
        work.lit[node] = 1.0
    for n in range(len(clouds.layers)):
        shade_line(ray, extent, tuple_item(clouds.layers, n), clouds, work)
    for node in range(nodes):
        shade = 1.0 - work.lit[node]
        for at in range(0, tables.lanes, LANES):
            air, kept = lane_view(clouds.air, at), lane_view(work.before, at)
            ahead, lost = lane_view(work.passed, at), lane_view(work.lost, at)
            lane_view(work.through, at)[node] = air_between(air, place, node, THROUGH)
            phases = lane_view(tables.phase, at)
            first = first_order_between(air, place, node, FIRST, half_sine, phases, tables)
            if node > 0:
                lost[WHOLE] += maximum(first - ahead[WHOLE], 0.0) * np.float32(shade)
            ahead[WHOLE] = first
            kept[node, WHOLE] = first + air_between(air, place, node, HIGHER) - lost[WHOLE]
            if polarised:
                elements = lane_view(tables.phase_f12, at)
                once = first_order_between(air, place, node, FIRST_P, half_sine, elements, tables)
                if node > 0:
                    lost[ONCE] += (once - ahead[ONCE]) * np.float32(shade)
                ahead[ONCE] = once
                kept[node, ONCE] = once - lost[ONCE]
                kept[node, Q] = air_between(air, place, node, HIGHER_Q)
                kept[node, U] = air_between(air, place, node, HIGHER_U)
    for at in range(0, tables.lanes, LANES):
        air, beyond = lane_view(clouds.air, at), lane_view(clouds.beyond, at)
        lost = lane_view(work.lost, at)
        lost[WHOLE] += air_between(air, place, nodes - 1, LOST) + texel_between(beyond, place, 0)
        if polarised:
            lost[Q] += air_between(air, place, nodes - 1, LOST_Q) + texel_between(beyond, place, 1)
            lost[U] += air_between(air, place, nodes - 1, LOST_U) + texel_between(beyond, place, 2)


@inlined
def texel_between(table, place, layer):
    """Bilinear interpolation between directions of lanes of shape (directions, layers)."""
    e, f = np.float32(place.right), np.float32(place.down)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    near, below = place.near, place.near + place.stride
    return (
        (g * h) * table[near, layer]
        + (g * e) * table[near + 1, layer]
        + (f * h) * table[below, layer]
        + (f * e) * table[below + 1, layer]
    )


@inlined
def air_between(air, place, node, layer):
    """The same of lanes of shape (directions, distances, layers), ``CloudTables.air``."""
    e, f = np.float32(place.right), np.float32(place.down)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    near, below = place.near, place.near + place.stride
    return (
        (g * h) * air[near, node, layer]
        + (g * e) * air[near + 1, node, layer]
        + (f * h) * air[below, node, layer]
        + (f * e) * air[below + 1, node, layer]
    )


@inlined
def first_order_between(air, place, node, layer, half_sine, phases, tables):
    """First order of the air up to a node. [sr⁻¹]

    Parameters
    ----------
    air, place, node :
        Arguments of ``air_between``.
    layer, phases : int, lanes
        ``FIRST`` and the phase functions, or ``FIRST_P`` and the elements F₁₂. [sr⁻¹]
    half_sine, tables :
        Arguments of ``line_of_air``.
    """
    first = air_between(air, place, node, layer)
    if tables.separated_1 >= 0:
        phase = phase_of(half_sine, tables.separated_1, phases)
        first = first + air_between(air, place, node, PEAKS) * phase
    if tables.separated_2 >= 0:
        phase = phase_of(half_sine, tables.separated_2, phases)
        first = first + air_between(air, place, node, PEAKS + 1) * phase
    return first


@inlined
def shade_line(ray, extent, layer, clouds, work):
    """Multiply ``work.lit`` by the mean transmittance of the sun's beam through a layer.

    Parameters
    ----------
    ray, extent, clouds, work :
        Arguments of ``line_of_air``.
    layer : LayerTables
        Layer.
    """
    nodes, eye = clouds.air.shape[1], Vec3(0.0, 0.0, clouds.eye)
    so_far = node_distance(0, nodes, extent)
    for node in range(1, nodes):
        distance = node_distance(node, nodes, extent)
        if distance > so_far:
            points = min(max(int((distance - so_far) / layer.step_x), 1), SHADOWS)
            gap, lit = (distance - so_far) / points, 0.0
            middle = 0.5 * (so_far + distance)
            width = max((distance - so_far) / SHADOWS, middle * clouds.pixel_angle)
            number = level_number(width, 1.0, layer)
            slant = local_slant(plus(eye, scaled(ray, middle)), layer)
            # the mean where a footprint is as wide as the box
            wide = min(2.0 * width / (layer.step_x * layer.levels[0, 0]), 1.0)
            mean = layer.mean_visibility**slant
            for k in range(points):
                point = plus(eye, scaled(ray, so_far + (k + 0.5) * gap))
                seen = 1.0
                if dot(point, point) < layer.top * layer.top:
                    depth = box_depth_at(point, number, layer)
                    if depth > 0.0:
                        seen = exp(-depth * slant * layer.scaled[0, 0])
                    seen += wide * (mean - seen)
                lit += seen
            work.lit[node] *= lit / points
        so_far = distance
