"""The same computations as in ``classic.c``, in NumPy, on one core."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.solver.tables.bruneton import BrunetonGrid
from airlight.solver.tables.layout import Positions

FloatArray = NDArray[np.float64]


def columns(
    r: FloatArray, mu: FloatArray, length: FloatArray, air: tuple[float, ...], steps: int
) -> FloatArray:
    """Columns of a gas, an aerosol and a tent by the trapezoid of equal steps, (n, 3). [m]

    ``air``: radius of the ground, two scale heights, centre and half width of the tent. [m]
    """
    bottom, gas, aerosol, centre, half_width = air
    out = np.empty((r.size, 3))
    block = max(1, (1 << 18) // (steps + 1))  # what stays in the cache
    for start in range(0, r.size, block):
        rows = slice(start, start + block)
        dx = length[rows, None] / steps
        s = np.arange(steps + 1) * dx
        h = np.sqrt(s * s + 2.0 * (r[rows] * mu[rows])[:, None] * s + r[rows, None] ** 2) - bottom
        for i, density in enumerate(
            (
                np.exp(-h / gas),
                np.exp(-h / aerosol),
                np.maximum(1.0 - np.abs(h - centre) / half_width, 0.0),
            )
        ):
            ends = 0.5 * (density[:, 0] + density[:, -1])
            out[rows, i] = (density.sum(axis=1) - ends) * dx[:, 0]
    return out


def _root(x: FloatArray) -> FloatArray:
    return np.sqrt(np.maximum(x, 0.0))


def _to_top(r: FloatArray | float, mu: FloatArray | float, top: float) -> FloatArray:
    return np.maximum(-r * mu + _root(r * r * (mu * mu - 1.0) + top * top), 0.0)


def _cell(
    place: FloatArray, first: NDArray | int, last: NDArray | int
) -> tuple[NDArray, FloatArray]:
    place = np.clip(place, first, last)
    low = np.minimum(place.astype(np.int64), last - 1)
    return low, place - low


def look_up(values: NDArray[np.float32], positions: Positions, grid: BrunetonGrid) -> FloatArray:
    """Values between texels of a table (r, mu, mu_s, nu), 16 corners, (n, channels)."""
    r, mu, ground = positions.r, positions.mu, positions.to_ground
    bottom, top, half = grid.bottom_radius, grid.top_radius, grid.views // 2
    tangent = np.sqrt(top * top - bottom * bottom)
    horizon = _root(r * r - bottom * bottom)
    down = -r * mu - _root(r * r * (mu * mu - 1.0) + bottom * bottom)
    distance = np.where(ground, down, _to_top(r, mu, top))
    shortest = np.where(ground, r - bottom, top - r)
    span = np.where(ground, horizon, horizon + tangent) - shortest
    x = np.clip((distance - shortest) / np.where(span > 0.0, span, np.inf), 0.0, 1.0)
    first = np.where(ground, 0, half)
    view = np.where(ground, (1.0 - x) * (half - 1), half + x * (half - 1))

    thick = top - bottom
    a = (_to_top(bottom, positions.mu_s, top) - thick) / (tangent - thick)
    end = (_to_top(bottom, grid.lowest, top) - thick) / (tangent - thick)
    sun = np.maximum(1.0 - a / end, 0.0) / (1.0 + a)

    low, share = zip(
        _cell(horizon / tangent * (grid.radii - 1), 0, grid.radii - 1),
        _cell(view, first, first + half - 1),
        _cell(sun * (grid.sun_angles - 1), 0, grid.sun_angles - 1),
        _cell(0.5 * (positions.nu + 1.0) * (grid.angles - 1), 0, grid.angles - 1),
        strict=True,
    )
    out = np.zeros((r.size, values.shape[-1]))
    for corner in np.ndindex(2, 2, 2, 2):
        weight = np.ones_like(r)
        for up, part in zip(corner, share, strict=True):
            weight *= part if up else 1.0 - part
        index = tuple(i + up for i, up in zip(low, corner, strict=True))
        out += weight[:, None] * values[index]
    return out


def rayleigh(nu: FloatArray) -> FloatArray:
    """Phase function of a gas without depolarisation. [sr⁻¹]"""
    return 3.0 / (16.0 * np.pi) * (1.0 + nu * nu)


def gather(
    values: NDArray[np.float32],
    positions: Positions,
    grid: BrunetonGrid,
    scattering: FloatArray,
    scale_height: float,
    directions: tuple[int, int],
) -> FloatArray:
    """Light that a gas scatters into directions, gathered from all sides, (n, 3). [m⁻¹ sr⁻¹]

    Over black ground. ``values`` holds the order before, without its phase function; midpoints of
    ``directions`` (zeniths, azimuths).
    """
    zeniths, azimuths = directions
    theta = (np.arange(zeniths) + 0.5) * np.pi / zeniths
    phi = (np.arange(azimuths) + 0.5) * 2.0 * np.pi / azimuths
    z = np.repeat(np.cos(theta), azimuths)
    x, y = ((np.sin(theta)[:, None] * f(phi)).ravel() for f in (np.cos, np.sin))
    solid = np.repeat(np.sin(theta), azimuths) * (np.pi / zeniths) * (2.0 * np.pi / azimuths)
    r, mu, mu_s, nu = (
        p[:, None] for p in (positions.r, positions.mu, positions.mu_s, positions.nu)
    )
    side = _root(1.0 - mu * mu)
    sun_x = np.where(side > 0.0, (nu - mu * mu_s) / np.where(side > 0.0, side, 1.0), 0.0)
    sun_y = _root(1.0 - sun_x**2 - mu_s**2)
    to_sun = np.clip(x * sun_x + y * sun_y + z * mu_s, -1.0, 1.0)
    weight = rayleigh(to_sun) * rayleigh(x * side + z * mu) * solid
    ground = z < -_root(r * r - grid.bottom_radius**2) / r
    full = np.broadcast_arrays(r, z, mu_s, to_sun, ground)
    seen = look_up(values, Positions(*(array.ravel() for array in full)), grid)
    light = np.einsum("pd,pdc->pc", weight, seen.reshape(*weight.shape, -1))
    density = np.exp(-(positions.r - grid.bottom_radius) / scale_height)
    return light * scattering * density[:, None]
