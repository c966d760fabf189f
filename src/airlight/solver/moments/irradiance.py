"""Direct and diffuse horizontal irradiance, at the ground and aloft, from a solution."""

from __future__ import annotations

import numpy as np

from airlight.geometry.refraction import direct_horizontal_weights, star_points
from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import INVERSE_PI, LANES, lane_view, splat, store
from airlight.physics.optics.altitude_nodes import node_value
from airlight.physics.optics.reflection import diffuse_reflectance, direct_reflectance
from airlight.solver.moments.march_panels import columns_to_space
from airlight.solver.moments.ray_optics import sun_index
from airlight.solver.moments.source import diffuse_horizontal, direct_beam, direct_horizontal


@inlined
def ground_light(mu_s, orders, tables, work):
    """Horizontal irradiance of the ground per irradiance of the star, to ``work.irradiance``. [1]

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle at the ground. [1]
    orders, tables, work :
        Arguments of ``march``; the workspace receives direct and diffuse irradiance.
    """
    bottom, top = tables.bottom, tables.top
    from_low, from_high, low, high = direct_horizontal_weights(
        bottom, mu_s, bottom, top, tables.star_radius, tables.refraction_table
    )
    direct = orders != 0 and from_low + from_high > 0.0
    if direct:
        columns_to_space(bottom, low, tables, work.columns_to_sun_low)
        columns_to_space(bottom, high, tables, work.columns_to_sun_high)
    x = sun_index(mu_s, tables.place)
    place = min(int(x), tables.sun_angles - 2)
    for at in range(0, tables.lanes, LANES):
        star, sky = splat(0.0), splat(0.0)
        if direct:
            star = direct_horizontal(
                work.columns_to_sun_low,
                work.columns_to_sun_high,
                from_low,
                from_high,
                lane_view(tables.scaled_extinction, at),
                tables.constituents,
            )
        if orders != 1:
            sky = diffuse_horizontal(lane_view(tables.sky, at), place, x - place)
        received = lane_view(work.irradiance, at)
        received[0], received[1] = star, sky


@inlined
def ground_radiance(mu_s, mu_r, nu, orders, tables, work, out):
    """Radiance of the ground per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Cosines as in ``direct_reflectance``. [1]
    orders, tables, work :
        Arguments of ``march``.
    out : array, shape (w,)
        Receives the radiance. [sr⁻¹]
    """
    ground_light(mu_s, orders, tables, work)
    for at in range(0, tables.lanes, LANES):
        received = lane_view(work.irradiance, at)
        star = received[0] * direct_reflectance(tables.ground, at, mu_s, mu_r, nu)
        sky = received[1] * diffuse_reflectance(tables.ground, at, mu_r)
        store(out, at, (star + sky) * INVERSE_PI)


@compiled_loop
def direct_irradiance(r, mu_s, tables, work, out):
    """Direct horizontal irradiance, for arrays of radii and cosines. [1]"""
    bottom, top = tables.bottom, tables.top
    for k in range(r.size):
        from_low, from_high, low, high = direct_horizontal_weights(
            r[k], mu_s[k], bottom, top, tables.star_radius, tables.refraction_table
        )
        columns_to_space(r[k], low, tables, work.columns_to_sun_low)
        columns_to_space(r[k], high, tables, work.columns_to_sun_high)
        for at in range(0, tables.lanes, LANES):
            star = direct_horizontal(
                work.columns_to_sun_low,
                work.columns_to_sun_high,
                from_low,
                from_high,
                lane_view(tables.scaled_extinction, at),
                tables.constituents,
            )
            store(out[k], at, star)


@compiled_loop
def direct_normal_irradiance(r, mu_s, tables, work, out):
    """Direct normal irradiance; arguments as in ``direct_irradiance``. [1]"""
    bottom, top = tables.bottom, tables.top
    for k in range(r.size):
        seen, low, high = star_points(
            r[k], mu_s[k], bottom, top, tables.star_radius, tables.refraction_table
        )
        columns_to_space(r[k], low, tables, work.columns_to_sun_low)
        columns_to_space(r[k], high, tables, work.columns_to_sun_high)
        for at in range(0, tables.lanes, LANES):
            star = direct_beam(
                seen,
                work.columns_to_sun_low,
                work.columns_to_sun_high,
                high > low,
                lane_view(tables.scaled_extinction, at),
                tables.constituents,
            )
            store(out[k], at, star)


@compiled_loop
def sky_irradiance(r, mu_s, radii, tables, out):
    """Diffuse horizontal irradiance, for arrays of radii and cosines. [1]

    ``radii`` are those of the solution's grid. [m]
    """
    for k in range(r.size):
        place = node_value(r[k], tables.bottom, tables.top, tables.first_nodes, tables.row)
        row = min(int(place), tables.radii - 2)
        # Linear in altitude: aloft, diffuse irradiance falls exponentially, like the column above.
        f = (r[k] - radii[row]) / (radii[row + 1] - radii[row])
        x = sun_index(mu_s[k], tables.place)
        sun = min(int(x), tables.sun_angles - 2)
        e = x - sun
        for at in range(0, tables.lanes, LANES):
            sky = lane_view(tables.sky, at)
            scale = splat(0.0)
            value = splat(0.0)
            for corner in range(4):
                up, right = corner // 2, corner % 2
                weight = np.float32((f if up else 1.0 - f) * (e if right else 1.0 - e))
                scale = scale + weight * sky[row + up, sun + right, 0]
                value = value + weight * sky[row + up, sun + right, 1]
            store(out[k], at, value / scale)
