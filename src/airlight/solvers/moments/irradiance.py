"""Irradiance of level ground and of level surfaces aloft from a solution: by star and by sky."""

from __future__ import annotations

import numpy as np

from airlight.geometry.bending import level_light
from airlight.kernel import compiled_loop
from airlight.kernel.lanes import INVERSE_PI, LANES, load, splat, store
from airlight.optics.reflection import sky_factor, star_factor
from airlight.solvers.moments.grid import radius_index
from airlight.solvers.moments.source import level_sky, level_star
from airlight.solvers.moments.sweep import sun_index
from airlight.tables.column_ratios import columns_to_top


@compiled_loop
def ground_light(mu_s, orders, light, work):
    """Compute irradiance of level ground per irradiance of the star in ``work.received``. [1]

    ``orders`` as in ``march``.
    """
    _light_ground(mu_s, False, 0.0, 0.0, orders, light, work)


@compiled_loop
def ground_radiance(mu_s, leaving, nu, orders, light, work):
    """Compute radiance of the ground per irradiance of the star in ``work.received``. [sr⁻¹]

    Parameters
    ----------
    mu_s, leaving, nu : float
        Cosines as in ``star_factor``. [1]
    orders, light, work :
        As in ``march``.
    """
    _light_ground(mu_s, True, leaving, nu, orders, light, work)


@compiled_loop
def _light_ground(mu_s, reflects, leaving, nu, orders, light, work):
    """Compute ``ground_radiance``, or ``ground_light`` without ``reflects``."""
    grid, air = light.grid, light.air
    bottom, lanes = grid.bottom_radius, air.ground.albedo.size
    top = grid.top_radius
    from_low, from_high, below, above = level_light(
        bottom, mu_s, bottom, top, air.star_radius, light.lift
    )
    direct = from_low + from_high
    if direct > 0.0:
        columns_to_top(bottom, below, bottom, top, light.columns, work.here)
        columns_to_top(bottom, above, bottom, top, light.columns, work.there)
    x = sun_index(mu_s, grid.place)
    place = min(int(x), grid.sun_cosines.size - 2)
    constituents = light.columns.shape[2]
    for at in range(0, lanes, LANES):
        received = splat(0.0)
        if orders != 0 and direct > 0.0:
            received = level_star(
                work.here, work.there, from_low, from_high, air.extinction, constituents, lanes, at
            )
            if reflects:
                received = received * star_factor(air.ground, at, mu_s, leaving, nu)
        if orders != 1:
            sky = level_sky(light.sky, place, x - place, lanes, at)
            if reflects:
                sky = sky * sky_factor(air.ground, at, leaving)
            received = received + sky
        if reflects:
            received = received * INVERSE_PI
        store(work.received, at, received)


@compiled_loop
def direct_irradiance(r, mu_s, light, work, out):
    """Compute irradiance of a level surface by the star, for arrays of radii and cosines. [1]"""
    bottom, top = light.grid.bottom_radius, light.grid.top_radius
    lanes = light.air.ground.albedo.size
    for k in range(r.size):
        from_low, from_high, low, high = level_light(
            r[k], mu_s[k], bottom, top, light.air.star_radius, light.lift
        )
        columns_to_top(r[k], low, bottom, top, light.columns, work.here)
        columns_to_top(r[k], high, bottom, top, light.columns, work.there)
        for at in range(0, lanes, LANES):
            star = level_star(
                work.here, work.there, from_low, from_high, light.air.extinction,
                light.columns.shape[2], lanes, at,
            )  # fmt: skip
            store(out[k], at, star)


@compiled_loop
def sky_irradiance(r, mu_s, light, out):
    """Compute irradiance of a level surface by the sky, for arrays of radii and cosines. [1]"""
    grid = light.grid
    bottom, top = grid.bottom_radius, grid.top_radius
    suns, lanes = grid.sun_cosines.size, light.air.ground.albedo.size
    for k in range(r.size):
        row = min(int(radius_index(r[k], bottom, top, grid.row)), grid.radii.size - 2)
        # Linear in altitude: aloft the sky's light falls as the air above does, exponentially.
        f = (r[k] - grid.radii[row]) / (grid.radii[row + 1] - grid.radii[row])
        x = sun_index(mu_s[k], grid.place)
        place = min(int(x), suns - 2)
        e = x - place
        for at in range(0, lanes, LANES):
            scale = splat(0.0)
            value = splat(0.0)
            for corner in range(4):
                up, right = corner // 2, corner % 2
                weight = np.float32((f if up else 1.0 - f) * (e if right else 1.0 - e))
                node = ((row + up) * suns + place + right) * 2 * lanes + at
                scale = scale + weight * load(light.sky, node)
                value = value + weight * load(light.sky, node + lanes)
            store(out[k], at, value / scale)
