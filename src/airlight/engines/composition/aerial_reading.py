"""Look-up of aerial perspective tables by direction and distance.

Directions are mapped as in the sky-view LUT, with azimuths denser towards the star. Interpolation
is linear in direction and cubic in the logarithm of distance. The kernels run on the CPU and are
emitted to shaders.
"""

from __future__ import annotations

from math import atan2, log2, pi, sqrt
from typing import Annotated, NamedTuple

import numpy as np

from airlight.geometry.mappings.sky_view import angle_above_horizon, row_from_angle
from airlight.geometry.vectors import Vec3
from airlight.kernel import inlined
from airlight.kernel.lanes import exponential, lane_view, maximum, splat
from airlight.kernel.shader_fields import InTexture
from airlight.physics.cubic_curves import catmull_rom
from airlight.render.pixels.sky_lookup import TexelPlace, between_texels, texel_before
from airlight.render.pixels.sky_view_lut import half_sine_between
from airlight.render.pixels.star_disc import covered


class AerialTables(NamedTuple):
    """Aerial perspective tables of one observer, with look-up parameters.

    Attributes
    ----------
    horizon_mu, horizon_sine : float
        Cosine and sine of the horizon's zenith angle. [1]
    star_x, star_z : float
        Horizontal and vertical component towards the apparent star. [1]
    star_radius : float
        Angular radius of its disc. [rad]
    nearest, farthest : float
        Range of tabulated distances. [m]
    octave : float
        Number of distances per factor of two. [1]
    columns, rows, steps : int
        Numbers of azimuths, of rows per hemisphere, and of distances of the air tables.
    sky_columns, sky_rows : int
        Numbers of azimuths and of rows per hemisphere of the sky tables.
    light_scale, extinction_scale : float
        Radiance over distance [m⁻¹] and mean extinction [m⁻¹] of a stored value of 1.
    air_light, air_extinction : array
        Stored radiance over distance, and mean extinction; red, green, blue. [1]
    air_sky, air_star : array
        Fourth roots of the radiance of the sky, and of the star's disc through the air. [1]
    """

    horizon_mu: float
    horizon_sine: float
    star_x: float
    star_z: float
    star_radius: float
    nearest: float
    farthest: float
    octave: float
    columns: int
    rows: int
    steps: int
    sky_columns: int
    sky_rows: int
    light_scale: float
    extinction_scale: float
    air_light: Annotated[np.ndarray, InTexture("air_light", spectral=True, whole=True)]
    air_extinction: Annotated[np.ndarray, InTexture("air_extinction", spectral=True, whole=True)]
    air_sky: Annotated[np.ndarray, InTexture("air_sky", spectral=True, whole=True)]
    air_star: Annotated[np.ndarray, InTexture("air_star", spectral=True, whole=True)]


@inlined
def texel_towards(x, y, z, columns, rows, tables):
    """``TexelPlace`` of a direction.

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame: x level towards the star, z up. A unit vector. [1]
    columns, rows : int
        Numbers of azimuths and of rows per hemisphere.
    tables : AerialTables
        Tables with their horizon.
    """
    sine = sqrt(x * x + y * y)
    angle = angle_above_horizon(z, sine, tables.horizon_mu, tables.horizon_sine)
    row = row_from_angle(angle, tables.horizon_mu)
    azimuth = sqrt(atan2(abs(y), x) / pi)
    column, right = texel_before(azimuth * (columns - 1), 0, columns - 1)
    line, down = texel_before(row * (rows - 1), 0, rows - 1)
    before = rows if angle < 0.0 else 0
    return TexelPlace((before + line) * columns + column, columns, right, down)


@inlined
def per_distance(table, x, y, z, distance, tables):
    """Interpolated value over distance. [1]

    Parameters
    ----------
    table : lanes, shape (texels,)
        ``air_light`` or ``air_extinction``.
    x, y, z, distance, tables :
        Arguments of ``air_radiance``.
    """
    near, _, right, down = texel_towards(x, y, z, tables.columns, tables.rows, tables)
    z_place = log2(max(distance, tables.nearest) / tables.nearest) * tables.octave + 1.0
    step, t = texel_before(z_place, 1, tables.steps - 2)
    e, f = np.float32(right), np.float32(down)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    total = splat(0.0)
    for node in range(4):
        upper = near * tables.steps + step - 1 + node
        lower = upper + tables.steps * tables.columns
        value = (
            table[upper] * (g * h)
            + table[upper + tables.steps] * (g * e)
            + table[lower] * (f * h)
            + table[lower + tables.steps] * (f * e)
        )
        total = total + value * np.float32(catmull_rom(node, t))
    return maximum(total, splat(0.0))


@inlined
def air_radiance(x, y, z, distance, tables):
    """Path radiance to a point; red, green, blue. [1]

    Parameters
    ----------
    x, y, z : float
        Direction of the point in the observer's frame: x level towards the star, z up. A unit
        vector. [1]
    distance : float
        Distance of the point. [m]
    """
    reach = min(distance, tables.farthest)
    stored = per_distance(lane_view(tables.air_light), x, y, z, reach, tables)
    return stored * np.float32(tables.light_scale * reach)


@inlined
def air_transmittance(x, y, z, distance, tables):
    """Transmittance to a point, for the colour of the star; red, green, blue. [1]"""
    reach = min(distance, tables.farthest)
    stored = per_distance(lane_view(tables.air_extinction), x, y, z, reach, tables)
    return exponential(stored * np.float32(-tables.extinction_scale * reach))


@inlined
def sky_radiance(x, y, z, pixel, tables):
    """Radiance of sky or ground, with the star's disc; red, green, blue. [1]

    Parameters
    ----------
    x, y, z, tables :
        Arguments of ``air_radiance``.
    pixel : float
        Angle of a pixel, the width of the disc's antialiased rim. [rad]
    """
    place = texel_towards(x, y, z, tables.sky_columns, tables.sky_rows, tables)
    sky = between_texels(lane_view(tables.air_sky), place)
    apart = 2.0 * half_sine_between(Vec3(x, y, z), tables.star_x, tables.star_z)
    share = covered(apart, tables.star_radius, pixel)
    disc = between_texels(lane_view(tables.air_star), place)
    return sky + disc * np.float32(share)
