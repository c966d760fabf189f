"""Rings in a pixel: their light, what they let through, and the planet's shadow on them.

Single scattering of sunlight (``ring_layer``). The planet's shadow is that of its ground. Left out:
light that its air refracts, scatters or transmits into the shadow, and planetshine on the rings.
Lines of sight are straight.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final, NamedTuple

import numpy as np

from airlight.geometry.spheroid import beside_shadow
from airlight.geometry.sun_disc import visible_fraction
from airlight.geometry.vectors import Vec3, dot, minus, scaled
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.kernel.lanes import LANES, lane_view, load, splat, store
from airlight.physics.optics.ring_layer import ring_phase, single_scattering_layer
from airlight.render.pixels.star_disc import camera_direction
from airlight.solver.moments.source import transmittance_columns
from airlight.solver.tables.ring_shadow import ring_depth, ring_row

#: Samples per side of a pixel, and most radii in a sample, over which ringlets are averaged.
SAMPLES: Final = 3
RADII: Final = 64.0
#: Ratio of radii by which a place beyond the rings is moved among them for its phase function. [1]
NEARLY: Final = 1.0 + 1e-6


class RingCrossing(NamedTuple):
    """Crossing of a line of sight with the rings.

    Attributes
    ----------
    radius, width : float
        Distance from the centre of the planet, negative for none, and range of distances in a
        sample with the variance of those of its square. [m]
    before_air : bool
        Whether the line meets the rings before the air.
    slope, sun_slope : float
        Components of the line and of the star's direction along the normal of the rings. [1]
    light : float
        Phase function times the visible fraction of the star. [sr⁻¹]
    """

    radius: float
    width: float
    before_air: bool
    slope: float
    sun_slope: float
    light: float


@inlined
def ring_crossing(ray, sine, to_ground, frame):
    """``RingCrossing`` of a line of sight, which is straight.

    A change d of its direction moves the crossing P by t (d - ray (d·n)/(ray·n)) at the distance t,
    with the normal n of the rings, and so its distance from the centre by d·(P - n (P·ray)/(ray·n))
    t/P.

    Parameters
    ----------
    ray, sine : Vec3, float
        Direction in the observer's frame, and sine of its zenith angle. [1]
    to_ground : bool
        Whether it ends on the ground.
    frame : FrameTables
        What the pixels read.
    """
    observer, tables = frame.observer, frame.tables
    rings, pole = tables.rings, observer.ground_z
    radius, width, before, light = -1.0, 0.0, False, 0.0
    slope, sun = dot(ray, pole), Vec3(observer.sun_x, 0.0, observer.sun_z)
    way = way_to_rings(ray, observer.r, pole)
    if way > 0.0:
        before = observer.outside
        before = before and (way < -observer.r * ray.z or observer.r * sine > tables.top)
        if before or not to_ground:
            radius = ring_radius(ray, observer.r, way)
            point = Vec3(way * ray.x, way * ray.y, observer.r + way * ray.z)
            change = minus(point, scaled(pole, dot(point, ray) / slope))
            width = way / radius * sqrt(dot(change, change)) * frame.camera.pixel_angle / SAMPLES
            row, fraction = ring_row(
                min(max(radius, rings.ring_inner * NEARLY), rings.ring_outer / NEARLY),
                rings.ring_inner,
                rings.ring_outer,
                rings.ring_rows,
                rings.ring_layers.shape[0],
            )
            light = ring_phase(
                dot(ray, sun),
                ring_layer(row, fraction, 1, rings),
                ring_layer(row, fraction, 2, rings),
                ring_layer(row, fraction, 3, rings),
                ring_layer(row, fraction, 4, rings),
            )
            light *= outside_shadow(point, sun, pole, observer.flattening, tables)
    return RingCrossing(radius, width, before, slope, dot(sun, pole), light)


@kernel
def way_to_rings(ray, r, pole):
    """Distance to the plane of the rings along a line of sight; -1 if it does not meet it. [m]

    Parameters
    ----------
    ray, r : Vec3, float
        Direction in the observer's frame [1], and distance of the observer from the centre [m].
    pole : Vec3
        Normal of the plane. [1]

    Examples
    --------
    >>> way_to_rings(Vec3(0.0, -0.6, -0.8), 5.0, Vec3(0.0, 0.0, 1.0))
    6.25
    """
    height, slope = r * pole.z, dot(ray, pole)
    way = -1.0
    if height * slope < 0.0:
        way = -height / slope
    return way


@kernel
def ring_radius(ray, r, way):
    """Distance from the centre of the planet of a point on a line of sight. [m]

    Parameters
    ----------
    ray, r :
        Arguments of ``way_to_rings``.
    way : float
        Distance of the point. [m]
    """
    x, y, z = way * ray.x, way * ray.y, r + way * ray.z
    return sqrt(x * x + y * y + z * z)


@compiled_loop
def ring_transmittances(rays, r, pole, rings, out):
    """Transmittance of the rings along lines of sight.

    Parameters
    ----------
    rays : array, shape (n, 3)
        Directions in the observer's frame. [1]
    r, pole : float, Vec3
        Arguments of ``way_to_rings``.
    rings : Rings
        Rings.
    out : array, shape (n,)
        Receives the transmittance. [1]
    """
    for k in range(rays.shape[0]):
        ray = Vec3(rays[k, 0], rays[k, 1], rays[k, 2])
        way = way_to_rings(ray, r, pole)
        out[k] = 1.0
        if way > 0.0:
            steep = max(abs(dot(ray, pole)), 1e-6)
            out[k] = exp(-ring_depth(ring_radius(ray, r, way), rings) / steep)


@inlined
def near_rings(ray, frame):
    """Whether a line of sight, or another in the same pixel, meets the rings.

    Parameters
    ----------
    ray, frame : Vec3, FrameTables
        Direction in the observer's frame, and what the pixels read. [1]
    """
    observer, rings = frame.observer, frame.tables.rings
    way, met = way_to_rings(ray, observer.r, observer.ground_z), False
    if way > 0.0:
        radius = ring_radius(ray, observer.r, way)
        wide = frame.camera.pixel_angle * way / max(abs(dot(ray, observer.ground_z)), 1e-3)
        met = radius > rings.ring_inner - wide and radius < rings.ring_outer + wide
    return met


@inlined
def ring_layer(row, fraction, column, rings):
    """Value of a column of ``ring_layers`` at a place of ``ring_row``."""
    low = rings.ring_layers[row, column]
    return low + (rings.ring_layers[row + 1, column] - low) * fraction


@inlined
def outside_shadow(point, sun, pole, flattening, tables):
    """Visible fraction of the star at a point of the rings, behind the edge of the ground. [1]

    Parameters
    ----------
    point, sun : Vec3
        Point from the centre of the planet [m], and direction of the star [1].
    pole, flattening : Vec3, float
        Direction of the planet's north pole, and its flattening. [1]
    tables : MarchTables
        Tables of the solution.
    """
    along, seen = dot(point, sun), 1.0
    if along < 0.0:
        behind = beside_shadow(point, sun, pole, flattening, tables.bottom)
        seen = visible_fraction(behind / along, tables.star_radius)
    return seen


@inlined
def sum_rings(px, py, to_ground, frame, work):
    """Light of the rings in a pixel, into ``work.radiance[2]``, a mean over samples. [sr⁻¹]

    Air and ground have one sample there, as rings have the finer details; a sample is a mean over
    radii, without which ringlets narrower than it would be moiré.

    Parameters
    ----------
    px, py, frame :
        Arguments of ``pixel_light``.
    to_ground : bool
        Whether the line ends on the ground.
    work : MarchWorkspace
        Workspace, with the columns of the air along the line. [m]

    Returns
    -------
    whole, before : float
        Transmittance of the rings, and of those before the air. [1]
    """
    view, tables = frame.camera, frame.tables
    rings, whole, before = tables.rings, 0.0, 0.0
    for at in range(0, tables.lanes, LANES):
        radiance = lane_view(work.radiance, at)
        radiance[2], radiance[3] = splat(0.0), splat(0.0)
    for sample in range(SAMPLES * SAMPLES):
        x = px + (sample % SAMPLES + 0.5) / SAMPLES - 0.5
        y = py + (sample // SAMPLES + 0.5) / SAMPLES - 0.5
        ray = camera_direction(x, y, view)
        sine = sqrt(ray.x * ray.x + ray.y * ray.y)
        crossing = ring_crossing(ray, sine, to_ground, frame)
        steep = 1.0 / max(abs(crossing.slope), 1e-6)
        count = int(min(crossing.width * rings.ring_rows, RADII - 1.0)) + 1
        share = 1.0 / (SAMPLES * SAMPLES * count)
        for k in range(count):
            row, fraction = ring_row(
                crossing.radius + crossing.width * ((k + 0.5) / count - 0.5),
                rings.ring_inner,
                rings.ring_outer,
                rings.ring_rows,
                rings.ring_layers.shape[0],
            )
            transmittance = 1.0
            if row >= 0:
                depth = ring_layer(row, fraction, 0, rings)
                transmittance = exp(-depth * steep)
                light = single_scattering_layer(depth, -crossing.slope, crossing.sun_slope)
                light *= crossing.light * share
                for at in range(0, tables.lanes, LANES):
                    radiance = lane_view(work.radiance, at)
                    albedo = lane_view(rings.ring_albedo, at)
                    low = albedo[row]
                    part = low + (albedo[row + 1] - low) * np.float32(fraction)
                    part = part * np.float32(light)
                    if crossing.before_air:
                        radiance[2] += part
                    else:
                        radiance[3] += part
            whole += share * transmittance
            before += share * (transmittance if crossing.before_air else 1.0)
    for at in range(0, tables.lanes, LANES):
        radiance = lane_view(work.radiance, at)
        radiance[2] += radiance[3] * transmittance_columns(
            work.columns_total, lane_view(tables.extinction, at), tables.constituents
        )
    return whole, before


@inlined
def ring_light(px, py, ray, found, seen, frame, work, result):
    """Add the light of the rings, behind the filter, to that of air and ground.

    Parameters
    ----------
    px, py, ray, frame, work, result :
        Arguments of ``pixel_light``.
    found, seen : ClassifiedRay, SeenLine
        Class of the line, and what is seen along it.

    Returns
    -------
    float
        Weight of the star's disc, ``seen.whole`` times the transmittance of the rings. [1]
    """
    tables, left = frame.tables, 1.0
    if near_rings(ray, frame):
        if not found.through_air:
            for c in range(tables.constituents):
                work.columns_total[c] = 0.0
        left, before = sum_rings(px, py, found.to_ground, frame, work)
        light = seen.whole if frame.camera.draws_air and frame.observer.orders != 0 else 0.0
        for at in range(0, tables.lanes, LANES):
            rings = lane_view(work.radiance, at)[2] * np.float32(light)
            store(result, at, load(result, at) * np.float32(before) + rings)
    return seen.whole * left
