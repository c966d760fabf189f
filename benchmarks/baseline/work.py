"""What the baselines and airlight are given to do, and the truth to judge them by.

The air is that of the Atmosphere Plus notes, for which golden columns exist; the light is that of
its gas alone over black ground, which is kind to the baselines: no forward peak to resolve.
"""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from airlight import solve
from airlight.engines.baking.air_light import lines_of_sight
from airlight.planets import Medium
from airlight.solver.scattered_once import scattered_once
from airlight.solver.tables.bruneton import BrunetonLayout
from airlight.solver.tables.layout import Positions
from airlight.solver.tables.table import Table
from airlight.validation.golden_numbers import golden_groups
from airlight.validation.reference_earth import (
    CORRECTED_ABSORPTION,
    WAVELENGTHS,
    reference_earth,
)
from baseline.plain import FloatArray, rayleigh

BOTTOM, TOP = 6360e3, 6460e3
#: Ground, scale heights of gas and aerosol, centre and half width of the ozone. [m]
AIR = (BOTTOM, 8000.0, 1200.0, 25e3, 15e3)
#: Zeniths and azimuths of a gather: 512 directions.
DIRECTIONS = (16, 32)
#: Texels of the usual table.
FULL_SIZE = (32, 128, 32, 8)


@cache
def whole_air() -> Medium:
    """Gas, aerosol and ozone."""
    planet = reference_earth(albedo=0.0, aerosol_absorption=CORRECTED_ABSORPTION)
    return Medium.from_planet(planet, WAVELENGTHS)


@cache
def gas_planet() -> Any:
    """The gas alone over black ground."""
    return reference_earth(albedo=0.0, aerosol=None, ozone=False)


def rays(n: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Radius, cosine and length of random rays to the top that miss the ground. [m], [1], [m]"""
    rng = np.random.default_rng(1)
    r = BOTTOM + (TOP - BOTTOM) * rng.random(n) ** 2
    horizon = -np.sqrt((r - BOTTOM) * (r + BOTTOM)) / r
    mu = horizon + (1.0 - horizon) * rng.random(n)
    return r, mu, -r * mu + np.sqrt((r * mu) ** 2 + (TOP - r) * (TOP + r))


def golden_rays() -> tuple[tuple[FloatArray, FloatArray, FloatArray], FloatArray]:
    """The rays of the golden table of columns, and the columns. [m], [1], [m]; [m]"""
    rows = next(group for group in golden_groups() if group.name == "columns").rows
    r = np.array([BOTTOM + row.at["altitude"] for row in rows])
    mu = np.array(
        [
            -np.sqrt(1.0 - ((BOTTOM + row.at["tangent"]) / one) ** 2)
            if "tangent" in row.at
            else np.cos(np.radians(row.at["zenith"]))
            for row, one in zip(rows, r, strict=True)
        ]
    )
    length = np.array([1e3 * row.at["length_km"] for row in rows])
    return (r, mu, length), np.array([[float(x) for x in row.expected] for row in rows])


def positions(n: int, *, lit_air: bool = False) -> Positions:
    """Random positions, views and suns: anywhere down to twilight, or below 20 km by day."""
    rng = np.random.default_rng(2)
    r = BOTTOM + (20e3 if lit_air else TOP - BOTTOM) * rng.random(n) ** 2
    mu = rng.uniform(-1.0, 1.0, n)
    mu_s = rng.uniform(0.1 if lit_air else -0.2, 1.0, n)
    around = np.cos(rng.uniform(0.0, np.pi, n))
    nu = np.clip(mu * mu_s + np.sqrt((1 - mu**2) * (1 - mu_s**2)) * around, -1.0, 1.0)
    return Positions.of(r, mu, mu_s, nu, bottom_radius=BOTTOM)


@cache
def first_order(size: tuple[int, int, int, int] = FULL_SIZE) -> Table:
    """Light that the gas scatters once, without its phase function, on Bruneton's table."""
    layout = BrunetonLayout(
        bottom_radius=BOTTOM, top_radius=TOP,
        **dict(zip(("radii", "views", "sun_angles", "angles"), size, strict=True)),
    )  # fmt: skip
    medium = Medium.from_planet(gas_planet(), WAVELENGTHS)
    values = scattered_once(medium, lines_of_sight(layout.positions(), medium))[:, 0]
    return Table(
        name="scattering", quantity="light scattered once, without its phase function", unit="1",
        layout=layout, channels=("680 nm", "550 nm", "440 nm"),
        values=values.reshape(*layout.shape, 3).astype(np.float32),
    )  # fmt: skip


def true_gather(where: Positions, steps: int = 48) -> FloatArray:
    """What a gather converges to: the first order itself, marched, not looked up, (n, 3).

    Gauss-Legendre in the zenith angle on each side of the horizon, so many each, and twice as
    many even azimuths. [m⁻¹ sr⁻¹]
    """
    medium = Medium.from_planet(gas_planet(), WAVELENGTHS)
    nodes, weights = np.polynomial.legendre.leggauss(steps)
    horizon = 0.5 * np.pi + np.arccos(BOTTOM / where.r)[:, None]
    theta = np.hstack([horizon * (nodes + 1) / 2, np.pi + (horizon - np.pi) * (nodes + 1) / 2])
    share = np.hstack([horizon * weights / 2, (np.pi - horizon) * weights / 2]) * np.pi / steps
    phi = (np.arange(2 * steps) + 0.5) * np.pi / steps
    r, mu, mu_s, nu = (p[:, None, None] for p in (where.r, where.mu, where.mu_s, where.nu))
    z, across = np.cos(theta)[..., None], np.sin(theta)[..., None]
    x, y = across * np.cos(phi), across * np.sin(phi)
    side = np.sqrt(1.0 - mu * mu)
    sun_x = (nu - mu * mu_s) / side
    sun_y = np.sqrt(np.maximum(1.0 - sun_x**2 - mu_s**2, 0.0))
    to_sun = np.clip(x * sun_x + y * sun_y + z * mu_s, -1.0, 1.0)
    ground = (np.arange(2 * steps) >= steps)[None, :, None]
    full = np.broadcast_arrays(r, z, mu_s, to_sun, ground)
    around = Positions(*(np.ascontiguousarray(array).ravel() for array in full))
    once = scattered_once(medium, lines_of_sight(around, medium))[:, 0]
    weight = share[..., None] * across * rayleigh(to_sun) * rayleigh(x * side + z * mu)
    light = np.einsum("ptf,ptfc->pc", weight, once.reshape(*weight.shape, 3))
    return light * medium.scattering[0] * np.exp(-(where.r - BOTTOM) / AIR[1])[:, None]


def solved(quality: str = "default") -> Any:
    """airlight's own solution of the gas, all orders."""
    return solve(gas_planet(), WAVELENGTHS, quality, cache=False)
