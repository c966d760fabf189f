"""Ringshine: light of the rings on air and ground, which the night side has.

At a point of the planet all light of the rings comes from one direction, that of its vector
irradiance, with the irradiance that gives the ground the exact sum over the rings above its
horizon. The planet's own light on the rings is left out.
"""

from __future__ import annotations

from math import acos, asin, cos, pi, sin, sqrt
from typing import Final, NamedTuple

import numpy as np
import numpy.typing as npt

from airlight.geometry.spheroid import spheroid_point
from airlight.geometry.vectors import Vec3, cross, dot, minus, plus, scaled
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, lane_view, largest, load, store
from airlight.kernel.without_refcount import without_refcount
from airlight.physics.optics.ring_layer import ring_phase, single_scattering_layer
from airlight.render.pixels.ground import ground_factor
from airlight.render.pixels.ring_light import outside_shadow, ring_layer
from airlight.render.pixels.sky_view_lut import Observer, SightLine, look
from airlight.solver.moments.march_tables import MarchTables
from airlight.solver.tables.ring_shadow import ring_row

FloatArray = npt.NDArray[np.float64]
Float32Array = npt.NDArray[np.float32]

#: Nodes of the table: latitudes from pole to pole, and hours from noon to midnight.
LATITUDES: Final = 49
HOURS: Final = 25
#: Points of the integral over the rings: radii, and longitudes.
_RADII: Final = 96
_AROUND: Final = 120
#: Mean square of sin(θ/2) over an arch of rings, by which phase functions are blurred: by eye. [1]
SPREAD: Final = 0.06
#: Irradiance by the rings over that of a white ground with the pixel's radiance, below which it is
#: neglected. [1]
FAINT: Final = 3e-3


class RingShine(NamedTuple):
    """Irradiance by the rings, by latitude and hour.

    Attributes
    ----------
    irradiance : array, shape (n, w)
        Irradiance on a plane that faces the light, per that of the star. [1]
    directions : array, shape (n, 3)
        Direction of the light: x towards the star in the plane of the rings, z north; y is
        mirrored in the morning. [1]
    """

    irradiance: Float32Array
    directions: FloatArray


def no_shine(tables: MarchTables) -> RingShine:
    """Table without light."""
    return RingShine(np.zeros((1, tables.lanes), np.float32), np.zeros((1, 3)))


def ring_shine(tables: MarchTables, sun: float, flattening: float = 0.0) -> RingShine:
    """Irradiance of a planet by its rings.

    Parameters
    ----------
    tables : MarchTables
        Tables of the solution.
    sun : float
        Cosine of the angle between star and north pole. [1]
    flattening : float
        Flattening of the planet. [1]
    """
    count = LATITUDES * HOURS
    made = RingShine(np.zeros((count, tables.lanes), np.float32), np.zeros((count, 3)))
    fill_shine(sun, flattening, tables, made)
    return made


@compiled_loop
def fill_shine(sun, flattening, tables, shine):
    """Fill a table of ``RingShine``; arguments of ``ring_shine``."""
    tables, shine = without_refcount((tables, shine))
    for row in range(LATITUDES):
        for column in range(HOURS):
            latitude, hour = pi * (row / (LATITUDES - 1.0) - 0.5), pi * column / (HOURS - 1.0)
            level = cos(latitude)
            up = Vec3(level * cos(hour), level * sin(hour), sin(latitude))
            _shine_at(up, sun, flattening, tables, row * HOURS + column, shine)


@inlined
def _shine_at(up, sun, flattening, tables, node, shine):
    """Fill a node; ``up`` is the vertical there, in the frame of the directions. [1]"""
    rings, total, pole = tables.rings, Vec3(0.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0)
    star = Vec3(sqrt(max((1.0 - sun) * (1.0 + sun), 0.0)), 0.0, sun)
    place, found = spheroid_point(up, pole, flattening, tables.bottom), shine.irradiance[node]
    step = (rings.ring_outer - rings.ring_inner) / _RADII
    for i in range(_RADII):
        radius = rings.ring_inner + (i + 0.5) * step
        row, fraction = ring_row(
            radius, rings.ring_inner, rings.ring_outer, rings.ring_rows, len(rings.ring_layers)
        )
        depth = ring_layer(row, fraction, 0, rings)
        if not depth > 0.0:
            continue
        for k in range(_AROUND):
            angle = 2.0 * pi * (k + 0.5) / _AROUND
            point = Vec3(radius * cos(angle), radius * sin(angle), 0.0)
            away = minus(point, place)
            distance = sqrt(dot(away, away))
            ray = scaled(away, 1.0 / distance)
            rise = dot(ray, up)
            if rise <= 0.0 or ray.z == 0.0:
                continue
            light = single_scattering_layer(depth, -ray.z, sun)
            light *= ring_phase(
                dot(ray, star),
                ring_layer(row, fraction, 1, rings),
                ring_layer(row, fraction, 2, rings),
                ring_layer(row, fraction, 3, rings),
                ring_layer(row, fraction, 4, rings),
            )
            light *= outside_shadow(point, star, pole, flattening, tables)
            light *= radius * step * (2.0 * pi / _AROUND) * abs(ray.z) / (distance * distance)
            total = plus(total, scaled(ray, light * rings.ring_albedo[row, 0]))
            for lane in range(tables.lanes):
                found[lane] += np.float32(light * rise * rings.ring_albedo[row, lane])
    size = sqrt(dot(total, total))
    if size > 0.0:
        total = scaled(total, 1.0 / size)
        rise = dot(total, up)
        for lane in range(tables.lanes):
            found[lane] /= np.float32(rise)
    shine.directions[node, 0] = total.x
    shine.directions[node, 1] = total.y
    shine.directions[node, 2] = total.z


class ShinePlace(NamedTuple):
    """Place in the table of ``RingShine``, and direction of the light there.

    Attributes
    ----------
    node : int
        First of the four nodes.
    down, right : float
        Fractions of the steps to the next latitude and hour. [1]
    light : Vec3
        Direction of the light in the observer's frame; zero for none. [1]
    """

    node: int
    down: float
    right: float
    light: Vec3


@inlined
def shine_place(up, observer, directions):
    """``ShinePlace`` of a point of the planet.

    Parameters
    ----------
    up : Vec3
        Vertical of the point in the observer's frame. [1]
    observer : Observer
        Observer.
    directions : array, shape (n, 3)
        Directions of ``RingShine``.
    """
    pole = observer.ground_z
    star = Vec3(observer.sun_x, 0.0, observer.sun_z)
    north = min(max(dot(up, pole), -1.0), 1.0)
    x_axis = minus(star, scaled(pole, dot(star, pole)))
    x_axis = scaled(x_axis, 1.0 / sqrt(max(dot(x_axis, x_axis), 1e-12)))
    y_axis = cross(pole, x_axis)
    x, y = dot(up, x_axis), dot(up, y_axis)
    hour = acos(min(max(x / sqrt(max(x * x + y * y, 1e-12)), -1.0), 1.0))
    side = 1.0 if y >= 0.0 else -1.0
    row, down = _step(asin(north) / pi + 0.5, LATITUDES)
    column, right = _step(hour / pi, HOURS)
    node = row * HOURS + column
    along = Vec3(0.0, 0.0, 0.0)
    for corner in range(4):
        below, after = corner // 2, corner % 2
        share = (down if below == 1 else 1.0 - down) * (right if after == 1 else 1.0 - right)
        at = node + below * HOURS + after
        one = Vec3(directions[at, 0], directions[at, 1], directions[at, 2])
        along = plus(along, scaled(one, share))
    size = sqrt(dot(along, along))
    light = Vec3(0.0, 0.0, 0.0)
    if size > 1e-3:
        along = scaled(along, 1.0 / size)
        light = plus(scaled(x_axis, along.x), scaled(y_axis, side * along.y))
        light = plus(light, scaled(pole, along.z))
    return ShinePlace(node, down, right, light)


@inlined
def _step(coordinate, count):
    """Node before a coordinate from 0 to 1, and fraction of the step to the next."""
    at = coordinate * (count - 1)
    node = min(int(at), count - 2)
    return node, at - node


@inlined
def shine_between(table, place):
    """Irradiance at a place, from lanes of shape (n,). [1]"""
    e, f = np.float32(place.right), np.float32(place.down)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    node, below = place.node, place.node + HOURS
    return (
        table[node] * (g * h)
        + table[node + 1] * (g * e)
        + table[below] * (f * h)
        + table[below + 1] * (f * e)
    )


@inlined
def look_by_shine(ray, found, light, observer, tables, work):
    """March a line of sight under the light of the rings; the result is that of ``look``.

    Parameters
    ----------
    ray, found :
        Direction in the observer's frame [1], and its ``ClassifiedRay``.
    light : Vec3
        Direction of the light. [1]
    observer, tables, work :
        Arguments of ``look``.
    """
    level = sqrt(light.x * light.x + light.y * light.y)
    cosine = 1.0
    if level > 1e-9 and found.sine > 0.0:
        cosine = (ray.x * light.x + ray.y * light.y) / (level * found.sine)
        cosine = min(max(cosine, -1.0), 1.0)
    apart = minus(ray, light)
    half_sine = min(sqrt(0.25 * dot(apart, apart) + SPREAD), 1.0)
    free = Vec3(0.0, 0.0, 0.0)  # the light of the rings is not in their shadow
    line = SightLine(ray.z, found.sine, cosine, half_sine, found.to_ground, free, 0.0)
    lit = Observer(
        observer.r,
        observer.optical_altitude,
        observer.outside,
        observer.horizon_mu,
        observer.horizon_sine,
        level,
        light.z,
        level,
        light.z,
        observer.orders,
        observer.centre,
        observer.flattening,
        observer.ground_x,
        observer.ground_y,
        observer.ground_z,
        observer.forward,
        observer.filter_axis,
    )
    look(line, True, False, False, lit, tables, work)


@inlined
def vertical_seen(ray, found, observer, tables):
    """Vertical where a line of sight meets the planet: of the ground, or of its lowest point. [1]

    Parameters
    ----------
    ray, found, observer, tables :
        Arguments of ``look_by_shine``.
    """
    way = 0.0
    if ray.z < 0.0:
        way = -observer.r * ray.z
        impact = observer.r * found.sine
        if found.to_ground:
            way -= sqrt(max((tables.bottom - impact) * (tables.bottom + impact), 0.0))
    point = Vec3(way * ray.x, way * ray.y, observer.r + way * ray.z)
    return scaled(point, 1.0 / sqrt(dot(point, point)))


@inlined
def exceeds_sunlight(place, view, lanes, result):
    """Whether the light of the rings is more than ``FAINT`` of the pixel's, also in their shadow.

    Parameters
    ----------
    place : ShinePlace
        Result of ``shine_place``.
    view, lanes, result : ViewUniforms, int, array of shape (w,)
        Camera, number of lanes, and radiance of air and ground under the star. [sr⁻¹]
    """
    shine, most = np.float32(0.0), np.float32(0.0)
    for at in range(0, lanes, LANES):
        shine = max(shine, largest(shine_between(lane_view(view.shine, at), place)))
        most = max(most, largest(load(result, at)))
    return shine > FAINT * pi * most


@inlined
def add_ring_shine(ray, found, seen, observer, frame, work, color, result):
    """Add the light of air and ground that the rings illuminate.

    Parameters
    ----------
    found, seen : ClassifiedRay, SeenLine
        Class of the line, and what is seen along it.
    ray, observer, frame, work, color, result :
        Arguments of ``pixel_light``, and the observer.
    """
    tables, view = frame.tables, frame.camera
    up = vertical_seen(ray, found, observer, tables)
    place = shine_place(up, observer, view.shine_directions)
    lit = dot(place.light, place.light) > 0.0
    if lit and exceeds_sunlight(place, view, tables.lanes, result):
        look_by_shine(ray, found, place.light, observer, tables, work)
        for at in range(0, tables.lanes, LANES):
            radiance = lane_view(work.radiance, at)
            total = radiance[0]
            if seen.to_ground:
                factor = ground_factor(color, view, seen.factors, tables, work, at)
                total = total + radiance[1] * factor
            total = total * shine_between(lane_view(view.shine, at), place)
            store(result, at, load(result, at) + total * np.float32(seen.whole))
