"""Shader look-ups of baked tables, texel by texel.

Kernels that are emitted by ``baking.look_up_code`` and equal ``interpolate`` of the layouts. A
table is a texture in memory order, indexed by texel.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from airlight.geometry.mappings import irradiance
from airlight.geometry.mappings.scattering import (
    angle_coordinate,
    sun_coordinate,
    view_coordinate,
    view_index,
)
from airlight.geometry.mappings.texels import cell
from airlight.geometry.mappings.transmittance import altitude_coordinate, direction_coordinate
from airlight.geometry.shell import horizon_cosine
from airlight.kernel import inlined
from airlight.kernel.lanes import splat


class TextureShape(NamedTuple):
    """Parameters of the textures of a bake, constants of a shader.

    Attributes
    ----------
    bottom, top : float
        Radii of the ground and of the top of the shell. [m]
    lowest : float
        Smallest zenith cosine of the sun in the tables of scattered light. [1]
    radii, views, sun_angles, angles : int
        Texels of those tables along r, mu, mu_s and nu.
    rows, columns : int
        Texels of the transmittance along r and mu.
    levels, heights : int
        Texels of the irradiance along r and mu_s.
    nodes : int
        Texels of the phase functions along u = sin(θ/2).
    """

    bottom: float
    top: float
    lowest: float
    radii: int
    views: int
    sun_angles: int
    angles: int
    rows: int
    columns: int
    levels: int
    heights: int
    nodes: int


@inlined
def ends_on_ground(r, mu, shape):
    """Whether a line of sight ends on the ground."""
    return mu < horizon_cosine(r, shape.bottom)


@inlined
def row_at(table, near, l0, l1, k0, k1, c, d, shape):
    """Values at a view and a radius, bilinear in nu and mu_s, in the stored unit.

    Parameters
    ----------
    table : array
        Texels: mu_s runs fastest, then nu, mu, r.
    near : int
        Index of the view, times the texels along nu.
    l0, l1, k0, k1 : int
        Neighbours along nu and along mu_s.
    c, d : float
        Weights of the second neighbour along each. [1]
    shape : TextureShape
        Parameters of the textures.
    """
    low, high = (near + l0) * shape.sun_angles, (near + l1) * shape.sun_angles
    first = table[low + k0] * np.float32(1.0 - d) + table[low + k1] * np.float32(d)
    second = table[high + k0] * np.float32(1.0 - d) + table[high + k1] * np.float32(d)
    return first * np.float32(1.0 - c) + second * np.float32(c)


@inlined
def scattering_at(table, r, mu, mu_s, nu, to_ground, shape):
    """Values of a scattering table, linear along each axis, in the stored unit.

    Parameters
    ----------
    r, mu, mu_s, nu : float
        Radius [m]; cosines of the zenith angles of view and sun, and of the angle between them [1].
    to_ground : bool
        Whether the line of sight ends on the ground, which selects the half of the views.
    """
    bottom, top = shape.bottom, shape.top
    half = shape.views // 2
    first = 0 if to_ground else half
    x = view_coordinate(r, mu, to_ground, bottom, top)
    i0, i1, f = cell(altitude_coordinate(r, bottom, top) * (shape.radii - 1), 0, shape.radii - 1)
    j0, j1, e = cell(view_index(x, to_ground, shape.views), first, first + half - 1)
    s = sun_coordinate(mu_s, shape.lowest, bottom, top) * (shape.sun_angles - 1)
    k0, k1, d = cell(s, 0, shape.sun_angles - 1)
    l0, l1, c = cell(angle_coordinate(nu) * (shape.angles - 1), 0, shape.angles - 1)
    near, far = (i0 * shape.views + j0) * shape.angles, (i0 * shape.views + j1) * shape.angles
    low = row_at(table, near, l0, l1, k0, k1, c, d, shape) * np.float32(1.0 - e)
    low = low + row_at(table, far, l0, l1, k0, k1, c, d, shape) * np.float32(e)
    near, far = (i1 * shape.views + j0) * shape.angles, (i1 * shape.views + j1) * shape.angles
    high = row_at(table, near, l0, l1, k0, k1, c, d, shape) * np.float32(1.0 - e)
    high = high + row_at(table, far, l0, l1, k0, k1, c, d, shape) * np.float32(e)
    return low * np.float32(1.0 - f) + high * np.float32(f)


@inlined
def phase_at(table, nu, row, shape):
    """Phase function in a row of the texture, linear in u = sin(θ/2). [sr⁻¹]

    Parameters
    ----------
    table : array
        Texels: u runs fastest, then the functions.
    nu : float
        Cosine of the angle between view and sun. [1]
    """
    u = sqrt(min(max(0.5 * (1.0 - nu), 0.0), 1.0))
    low, high, f = cell(u * (shape.nodes - 1), 0, shape.nodes - 1)
    near = row * shape.nodes
    return table[near + low] * np.float32(1.0 - f) + table[near + high] * np.float32(f)


@inlined
def light_at(table, phases, r, mu, mu_s, nu, to_ground, row, scale, shape):
    """Radiance from a scattering table. [sr⁻¹]

    Parameters
    ----------
    phases, row
        Texture of the phase functions, and the index of the table's.
    scale : float
        Factor of the stored values. [1]
    """
    stored = scattering_at(table, r, mu, mu_s, nu, to_ground, shape)
    return stored * np.float32(scale) * phase_at(phases, nu, row, shape)


@inlined
def between_four(table, x, y, rows, columns):
    """Bilinear value of a two-dimensional table, in the stored unit.

    Parameters
    ----------
    table : array
        Texels: the second axis runs fastest.
    x, y : float
        Coordinates along both axes, 0 to 1. [1]
    rows, columns : int
        Texels along them.
    """
    i0, i1, f = cell(x * (rows - 1), 0, rows - 1)
    j0, j1, e = cell(y * (columns - 1), 0, columns - 1)
    low, high = i0 * columns, i1 * columns
    lower = table[low + j0] * np.float32(1.0 - e) + table[low + j1] * np.float32(e)
    upper = table[high + j0] * np.float32(1.0 - e) + table[high + j1] * np.float32(e)
    return lower * np.float32(1.0 - f) + upper * np.float32(f)


@inlined
def transmittance_at(table, r, mu, scale, shape):
    """Transmittance to the top of the shell; 0 if the ray meets the ground. [1]

    Parameters
    ----------
    table, scale : array, float
        Texels of the transmittance, and their factor.
    r, mu : float
        Radius [m] and cosine of the ray's zenith angle [1].
    """
    if mu < horizon_cosine(r, shape.bottom):
        return splat(0.0)
    x = altitude_coordinate(r, shape.bottom, shape.top)
    y = direction_coordinate(r, mu, shape.bottom, shape.top)
    return between_four(table, x, y, shape.rows, shape.columns) * np.float32(scale)


@inlined
def irradiance_at(table, r, mu_s, scale, shape):
    """Diffuse horizontal irradiance, per irradiance of the star. [1]

    Parameters
    ----------
    table, scale : array, float
        Texels of the irradiance, and their factor.
    r, mu_s : float
        Radius [m] and cosine of the sun's zenith angle [1].
    """
    x = irradiance.radius_coordinate(r, shape.bottom, shape.top)
    y = irradiance.sun_coordinate(mu_s)
    return between_four(table, x, y, shape.levels, shape.heights) * np.float32(scale)
