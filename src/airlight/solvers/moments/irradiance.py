"""Irradiance of level ground and of level surfaces aloft from a solution: by star and by sky."""

from __future__ import annotations

import numpy as np

from airlight.geometry.refraction import direct_horizontal_weights, star_points
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, load, splat, store
from airlight.optics.altitude_nodes import node_value
from airlight.optics.reflection import diffuse_reflectance, direct_reflectance
from airlight.solvers.moments.ray_optics import sun_index
from airlight.solvers.moments.source import diffuse_horizontal, direct_beam, direct_horizontal
from airlight.tables.column_ratios import columns_to_top


@inlined
def ground_light(mu_s, orders, light, work):
    """Compute irradiance of level ground per irradiance of the star, in ``work.received``. [1]

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle on the ground. [1]
    orders, light, work :
        Arguments of ``march``; the workspace receives the irradiances by the star and by the sky.
    """
    bottom, top = light.bottom, light.top
    from_low, from_high, low, high = direct_horizontal_weights(
        bottom, mu_s, bottom, top, light.star_radius, light.lift
    )
    direct = orders != 0 and from_low + from_high > 0.0
    if direct:
        columns_to_top(
            bottom,
            low,
            bottom,
            top,
            light.first_nodes,
            light.column_rows,
            light.columns,
            work.columns_to_sun_low,
        )
        columns_to_top(
            bottom,
            high,
            bottom,
            top,
            light.first_nodes,
            light.column_rows,
            light.columns,
            work.columns_to_sun_high,
        )
    x = sun_index(mu_s, light.place)
    place = min(int(x), light.sun_angles - 2)
    for at in range(0, light.lanes, LANES):
        star, sky = splat(0.0), splat(0.0)
        if direct:
            star = direct_horizontal(
                work.columns_to_sun_low, work.columns_to_sun_high, from_low, from_high,
                light.scaled_extinction, light.constituents, light.lanes, at,
            )  # fmt: skip
        if orders != 1:
            sky = diffuse_horizontal(light.sky, place, x - place, light.lanes, at)
        store(work.received, at, star)
        store(work.received, light.lanes + at, sky)


@inlined
def ground_radiance(mu_s, mu_r, nu, orders, light, work, out):
    """Compute radiance of the ground per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``direct_reflectance``. [1]
    orders, light, work :
        Arguments of ``march``.
    out : array, shape (w,)
        Receives the radiance. [sr⁻¹]
    """
    ground_light(mu_s, orders, light, work)
    for at in range(0, light.lanes, LANES):
        star = load(work.received, at) * direct_reflectance(light.ground, at, mu_s, mu_r, nu)
        sky = load(work.received, light.lanes + at) * diffuse_reflectance(light.ground, at, mu_r)
        store(out, at, (star + sky) * INVERSE_PI)


@compiled_loop
def direct_irradiance(r, mu_s, light, work, out):
    """Compute irradiance of a level surface by the star, for arrays of radii and cosines. [1]"""
    bottom, top, lanes = light.bottom, light.top, light.lanes
    for k in range(r.size):
        from_low, from_high, low, high = direct_horizontal_weights(
            r[k], mu_s[k], bottom, top, light.star_radius, light.lift
        )
        columns_to_top(
            r[k],
            low,
            bottom,
            top,
            light.first_nodes,
            light.column_rows,
            light.columns,
            work.columns_to_sun_low,
        )
        columns_to_top(
            r[k],
            high,
            bottom,
            top,
            light.first_nodes,
            light.column_rows,
            light.columns,
            work.columns_to_sun_high,
        )
        for at in range(0, lanes, LANES):
            star = direct_horizontal(
                work.columns_to_sun_low, work.columns_to_sun_high, from_low, from_high,
                light.scaled_extinction, light.constituents, lanes, at,
            )  # fmt: skip
            store(out[k], at, star)


@compiled_loop
def direct_normal_irradiance(r, mu_s, light, work, out):
    """Compute irradiance by the star of surfaces that face it, arguments as above. [1]"""
    bottom, top, lanes = light.bottom, light.top, light.lanes
    for k in range(r.size):
        seen, low, high = star_points(r[k], mu_s[k], bottom, top, light.star_radius, light.lift)
        columns_to_top(
            r[k],
            low,
            bottom,
            top,
            light.first_nodes,
            light.column_rows,
            light.columns,
            work.columns_to_sun_low,
        )
        columns_to_top(
            r[k],
            high,
            bottom,
            top,
            light.first_nodes,
            light.column_rows,
            light.columns,
            work.columns_to_sun_high,
        )
        for at in range(0, lanes, LANES):
            star = direct_beam(
                seen, work.columns_to_sun_low, work.columns_to_sun_high, high > low,
                light.scaled_extinction, light.constituents, lanes, at,
            )  # fmt: skip
            store(out[k], at, star)


@compiled_loop
def sky_irradiance(r, mu_s, radii, light, out):
    """Compute irradiance of a level surface by the sky, for arrays of radii and cosines. [1]

    ``radii`` are those of the solution's grid. [m]
    """
    sun_angles, lanes = light.sun_angles, light.lanes
    for k in range(r.size):
        place = node_value(r[k], light.bottom, light.top, light.first_nodes, light.row)
        row = min(int(place), light.radii - 2)
        # Linear in altitude: aloft the sky's light falls as the air above does, exponentially.
        f = (r[k] - radii[row]) / (radii[row + 1] - radii[row])
        x = sun_index(mu_s[k], light.place)
        sun = min(int(x), sun_angles - 2)
        e = x - sun
        for at in range(0, lanes, LANES):
            scale = splat(0.0)
            value = splat(0.0)
            for corner in range(4):
                up, right = corner // 2, corner % 2
                weight = np.float32((f if up else 1.0 - f) * (e if right else 1.0 - e))
                node = ((row + up) * sun_angles + sun + right) * 2 * lanes + at
                scale = scale + weight * load(light.sky, node)
                value = value + weight * load(light.sky, node + lanes)
            store(out[k], at, value / scale)
