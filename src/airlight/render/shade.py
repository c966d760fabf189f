"""The light of a row of pixels: one march a pixel and eight wavelengths, then the ground.

The radiance is per irradiance of the star until the weights turn it into linear sRGB.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.bending import bend_angle, turned
from airlight.geometry.path import ray_length
from airlight.geometry.shell import meets_ground, way_to_shell
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, load, maximum, minimum, splat, store
from airlight.scene.ground_place import latitude_longitude, map_color, map_level, moved_on
from airlight.solvers.moments.irradiance import ground_light
from airlight.solvers.moments.march import march
from airlight.solvers.moments.source import read_phase, reflected

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


class View(NamedTuple):
    """Who looks, and at which planet.

    Attributes
    ----------
    r : float
        Distance of the observer from the centre, as optical radius. [m]
    sun, sun_seen : array, shape (3,)
        Unit vectors in the local frame towards the star, and to where it is seen.
    ground_frame : array, shape (3, 3)
        Rotates local to planet-fixed vectors.
    pixel_angle : float
        That a pixel spans. [rad]
    orders : int
        1: the star's light scattered or reflected once; 0: all the rest; 2: both together.
    """

    r: float
    sun: FloatArray
    sun_seen: FloatArray
    ground_frame: FloatArray
    pixel_angle: float
    orders: int


class Paint(NamedTuple):
    """What turns radiances into colour, and the map into reflectance; w lanes as in ``Light``.

    Attributes
    ----------
    weights : array, shape (3·w,)
        Linear sRGB per radiance over irradiance. [W m⁻² sr⁻¹ sr]
    phase : array, shape (nodes·nc·w,)
        Phase functions on the uniform grid sin(θ/2). [sr⁻¹]
    phase_nodes : int
    basis : array, shape (3·w,)
        Reflectance of a red, a green and a blue ground. [1]
    texels : array, flat
        The map of the ground and its halvings one after another, linear sRGB reflectance; a
        single pixel where there is no map. [1]
    levels : array, shape (n, 3)
        Start in ``texels``, height and width of each.
    mapped : bool
        Whether ``texels`` is a map, rather than the solver's albedo.
    """

    weights: Float32Array
    phase: Float32Array
    phase_nodes: int
    basis: Float32Array
    texels: Float32Array
    levels: NDArray[np.int64]
    mapped: bool


@inlined
def ground_color(pixel, reach, cosine, angle, directions, view, paint, bottom, color):
    """Linear sRGB reflectance of the ground where a pixel's line of sight ends. [1]

    ``reach`` is the distance from the observer [m], ``cosine`` that of the slant there [1], and
    ``angle`` that by which the line has been bent [rad].
    """
    m, texels, levels = view.ground_frame, paint.texels, paint.levels
    x = reach * directions[pixel, 0]
    y = reach * directions[pixel, 1]
    z = view.r + reach * directions[pixel, 2]
    x, y, z = moved_on(
        x, y, z, directions[pixel, 0], directions[pixel, 1], directions[pixel, 2],
        cosine, angle, bottom,
    )  # fmt: skip
    gx = m[0, 0] * x + m[0, 1] * y + m[0, 2] * z
    gy = m[1, 0] * x + m[1, 1] * y + m[1, 2] * z
    gz = m[2, 0] * x + m[2, 1] * y + m[2, 2] * z
    latitude, longitude = latitude_longitude(gx, gy, gz)
    level = map_level(view.pixel_angle, reach, cosine, bottom, levels[0, 1])
    map_color(texels, levels, latitude, longitude, level, color)


@compiled_loop
def shade(directions, view, paint, light, panels, rules, packet, work, out):
    """The pixels of one row.

    Parameters
    ----------
    directions : array, shape (width, 3)
        Unit vectors in the local frame; a zero vector leaves its pixel black.
    view, paint, light : View, Paint, Light
        Who looks, the colours, the solution.
    panels, rules : int, three tuples of arrays
        As in ``march``.
    packet, work : Packet, Workspace
        Scratch.
    out : array, shape (width, 3)
        Receives linear sRGB; black pixels are not touched.
    """
    bottom, top = light.grid.bottom_radius, light.grid.top_radius
    size = packet.r.size
    pixels = np.empty(size, np.int64)
    ways = np.empty(size)
    sun, sun_z, seen_sun = view.sun, view.sun[2], view.sun_seen
    rays = 0
    for pixel in range(directions.shape[0]):
        x, y, z = directions[pixel, 0], directions[pixel, 1], directions[pixel, 2]
        nu = min(max(x * sun[0] + y * sun[1] + z * sun_z, -1.0), 1.0)
        r, mu, mu_s, way = view.r, min(max(z, -1.0), 1.0), sun_z, 0.0
        seen = x != 0.0 or y != 0.0 or z != 0.0
        if r > top:
            way, enters = way_to_shell(r, mu, sqrt(x * x + y * y), top)
            seen = seen and way >= 0.0
            if seen:
                mu_s = min(max((r * mu_s + way * nu) / top, -1.0), 1.0)
                mu = enters
                r = top
        if seen:
            packet.r[rays], packet.mu[rays], packet.mu_s[rays] = r, mu, mu_s
            packet.nu[rays] = nu
            packet.length[rays] = ray_length(r, mu, bottom, top)
            # θ from the difference of the vectors: the cosine has no digits left near the star.
            half = 0.5 * sqrt(
                (x - seen_sun[0]) ** 2 + (y - seen_sun[1]) ** 2 + (z - seen_sun[2]) ** 2
            )
            read_phase(
                min(half, 1.0),
                paint.phase,
                paint.phase_nodes,
                packet.phase.shape[1],
                packet.phase[rays],
            )
            pixels[rays], ways[rays] = pixel, way
            rays += 1
        if rays == size or (rays > 0 and pixel == directions.shape[0] - 1):
            march(packet, rays, view.orders, panels, rules, light, work)
            for p in range(rays):
                finish(p, pixels[p], ways[p], directions, view, paint, light, packet, work, out)
            rays = 0


@compiled_loop
def finish(p, pixel, way, directions, view, paint, light, packet, work, out):
    """Add the ground behind the air of one ray, and turn its light into colour."""
    lanes = light.air.ground.albedo.size
    bottom = light.grid.bottom_radius
    radiance, through, received = work.radiance[p], work.through[p], work.received
    r, mu, length = packet.r[p], packet.mu[p], packet.length[p]
    if meets_ground(r, mu, bottom):
        mu_s_ground = (r * packet.mu_s[p] + length * packet.nu[p]) / bottom
        angle = 0.0
        if light.bend > 0.0:
            angle = bend_angle(r, mu, light.bend, work.total[p, work.total.shape[1] - 1])
            mu_ground = (r * mu + length) / bottom
            mu_s_ground, _ = turned(mu_ground, mu_s_ground, packet.nu[p], angle)
        ground_light(min(max(mu_s_ground, -1.0), 1.0), view.orders, light, work)
        color = np.zeros(3)
        if paint.mapped:
            slant = -(r * mu + length) / bottom
            reach = way + length
            ground_color(pixel, reach, slant, angle, directions, view, paint, bottom, color)
        for lane in range(0, lanes, LANES):
            reflectance = load(light.air.ground.albedo, lane)
            if paint.mapped:
                reflectance = splat(0.0)
                for c in range(3):
                    basis = load(paint.basis, lanes * c + lane)
                    reflectance = reflectance + basis * np.float32(color[c])
                reflectance = minimum(maximum(reflectance, splat(0.0)), splat(1.0))
            ground = reflected(load(received, lane), reflectance)
            store(radiance, lane, load(radiance, lane) + load(through, lane) * ground)
    for c in range(3):
        total = np.float32(0.0)
        for lane in range(lanes):
            total += radiance[lane] * paint.weights[lanes * c + lane]
        out[pixel, c] = total
