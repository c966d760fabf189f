"""Light of the ground in a pixel: what colour and law of reflection make of the light on it.

Table of the sky and march give the light of a white Lambert ground behind the air. The ground asks
its law of reflection for two factors, of the star's light and of the sky's, which differ where it
does not reflect alike into all directions: then the two irradiances share that light between them.
Water mirrors the sky itself, at the place that table and march give it beside the ground's light.
"""

from __future__ import annotations

from math import pi
from typing import Final

import numpy as np

from airlight.geometry.shell import first_intersection
from airlight.kernel import inlined
from airlight.kernel.lanes import load, maximum, minimum, splat
from airlight.optics.clouds import layer_distance, under_clouds
from airlight.optics.reflection import WATER, brdf_diffuse, brdf_direct
from airlight.optics.water import water_reflectances
from airlight.pixels.ground_angles import ground_angles, ground_cosine
from airlight.scene.ground_detail import ground_detail
from airlight.scene.ground_place import latitude_longitude, map_color, map_level, moved_on
from airlight.solvers.moments.irradiance import ground_light
from airlight.solvers.moments.march_tables import MIRRORED
from airlight.solvers.moments.source import transmittance_columns

#: Length of the array that ``ground_color`` fills.
GROUND_VALUES: Final = 11


@inlined
def ground_color(x, y, z, sine, angle, observer, screen, tables, color):
    """Colour, water, lamps and clouds of the end of a line of sight, into ``color`` (11,). [1]

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame. [1]
    sine, angle : float
        Sine of its zenith angle [1]; angle of refraction [rad].
    observer, screen, tables : Observer, Screen, MarchTables
        Observer, camera with its maps, and tables of the solution.
    color : array, shape (11,)
        Receives linear sRGB reflectance and share of water of the map, four values of the overlay,
        the factor of the detail below the map's resolution, and the cover of the clouds on the line
        of sight and on the star's light; those of a map that is missing stay. [1]
    """
    cosine = ground_cosine(z, sine, observer, tables)
    _across, up = first_intersection(min(observer.r * sine, tables.bottom), sine, tables.bottom)
    # the distance as a quotient, of which single precision keeps all digits near the observer
    both = max(tables.bottom * cosine - observer.r * z, 1e-30)
    reach = observer.optical_altitude * (observer.r + tables.bottom) / both
    px, py, pz = reach * x, reach * y, up
    color[8] = 1.0
    if screen.detailed:  # of the straight line: how much a near one is bent is lost in rounding
        # pz - bottom of a point of the sphere, which single precision has to half a metre only
        below = -(px * px + py * py) / max(tables.bottom + pz, 1e-3 * tables.bottom)
        color[8] = 1.0 + ground_detail(
            screen.xx * px + screen.xy * py + screen.xz * below,
            screen.yx * px + screen.yy * py + screen.yz * below,
            screen.zx * px + screen.zy * py + screen.zz * below,
            screen.pixel_angle * reach / max(cosine, 0.01), screen.detail_cell,
            screen.whole_x, screen.whole_y, screen.whole_z,
            screen.part_x, screen.part_y, screen.part_z,
        )  # fmt: skip
    px, py, pz = moved_on(px, py, pz, x, y, z, cosine, angle, tables.bottom)
    latitude, longitude = latitude_longitude(
        screen.xx * px + screen.xy * py + screen.xz * pz,
        screen.yx * px + screen.yy * py + screen.yz * pz,
        screen.zx * px + screen.zy * py + screen.zz * pz,
    )
    if screen.mapped:
        level = map_level(screen.pixel_angle, reach, cosine, tables.bottom, screen.map_rows)
        map_color(
            screen.texels, screen.map_rows, screen.map_columns, screen.map_levels, latitude,
            longitude, level, color, 0,
        )  # fmt: skip
        color[8] = color[8] * (1.0 - color[3]) + color[3]
    if screen.overlaid:
        level = map_level(screen.pixel_angle, reach, cosine, tables.bottom, screen.over_rows)
        if screen.clouded:
            cloud_cover(px, py, pz, x, y, z, cosine, level, observer, screen, tables, color)
        map_color(
            screen.over_texels, screen.over_rows, screen.over_columns, screen.over_levels,
            latitude, longitude, level, color, 4,
        )  # fmt: skip
        if screen.clouded:
            for c in range(4, 7):
                color[c] *= 1.0 - color[9]


@inlined
def cloud_cover(px, py, pz, x, y, z, cosine, level, observer, screen, tables, color):
    """Cover of the clouds on a line of sight and on the star's light at its end. [1]

    Refraction between ground and layer is neglected.

    Parameters
    ----------
    px, py, pz : float
        End of the line of sight on the ground, from the centre, in the observer's frame. [m]
    x, y, z, cosine : float
        Its direction, and cosine of the zenith angle of the way back. [1]
    level : float
        Level of the overlay. [1]
    observer, screen, tables, color :
        Arguments of ``ground_color``; the cover of the line of sight is 0 from below the layer.
    """
    mu_s = (px * observer.sun_x + pz * observer.sun_z) / tables.bottom
    back = layer_distance(cosine, tables.bottom, screen.cloud_altitude)
    out = layer_distance(mu_s, tables.bottom, screen.cloud_altitude)
    for towards in range(2):
        qx, qy, qz = px - back * x, py - back * y, pz - back * z
        if towards == 1:
            qx, qy, qz = px + out * observer.sun_x, py, pz + out * observer.sun_z
        latitude, longitude = latitude_longitude(
            screen.xx * qx + screen.xy * qy + screen.xz * qz,
            screen.yx * qx + screen.yy * qy + screen.yz * qz,
            screen.zx * qx + screen.zy * qy + screen.zz * qz,
        )
        map_color(
            screen.over_texels, screen.over_rows, screen.over_columns, screen.over_levels,
            latitude, longitude, level, color, 4,
        )  # fmt: skip
        color[9 + towards] = color[7]
    if observer.r <= screen.cloud_radius:
        color[9] = 0.0


@inlined
def ground_reflectances(x, y, z, sine, angle, observer, screen, tables, work, color):
    """Ground at the end of a line of sight: its colour, and both factors of its law.

    Parameters
    ----------
    x, y, z, sine, angle, observer, screen, tables, color :
        Arguments of ``ground_color``; ``color`` is received where there is a map.
    work : MarchWorkspace
        Workspace; its ``irradiance`` has direct and diffuse irradiance, except for Lambert's law
        without water and clouds.

    Returns
    -------
    star_diffuse, star_specular, sky_diffuse, sky_specular : float
        Factor of the albedo, and part without it, of the star's and of the sky's light. [1]
    mirrored : float
        Factor of the light of the sky that is seen mirrored. [1]
    """
    if screen.mapped or screen.overlaid or screen.detailed:
        ground_color(x, y, z, sine, angle, observer, screen, tables, color)
    else:
        color[8] = 1.0
    star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored = 1.0, 0.0, 1.0, 0.0, 0.0
    if tables.ground.law != 0 or tables.ground.wet or screen.clouded:
        mu_s, mu_r, nu = ground_angles(x, z, sine, angle, observer, tables)
        ground_light(mu_s, observer.orders, tables, work)
        share = 0.0
        if tables.ground.law == WATER:
            share = 1.0
        else:
            star_diffuse, star_specular = brdf_direct(
                tables.ground.law, tables.ground, mu_s, mu_r, nu
            )
            sky_diffuse, sky_specular = brdf_diffuse(tables.ground.law, tables.ground, mu_r)
            if tables.ground.wet and screen.mapped:
                share = color[3]
        if share > 0.0:
            land = 1.0 - share
            star, glint, sky, mirrored = water_reflectances(tables.ground.wind, mu_s, mu_r, nu)
            star_diffuse = land * star_diffuse + share * star
            star_specular = land * star_specular + share * glint
            sky_diffuse = land * sky_diffuse + share * sky
            sky_specular = land * sky_specular
            mirrored = share * mirrored
    if screen.clouded:
        star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored = under_clouds(
            color[9], color[10], tables.ground.cloud_albedo,
            star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored,
        )  # fmt: skip
    return star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored


@inlined
def lamp_light(color, screen, tables, columns, at):
    """Light of lamps on the ground that reaches the observer, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    color : array, shape (11,)
        Values from ``ground_color``. [1]
    screen, tables : Screen, MarchTables
        Colour of the lamps, and tables of the solution.
    columns : array, shape (nc,)
        Columns from ``columns_to_ground``. [m]
    at : int
        Index of the first lane.
    """
    red = np.float32(color[4] * screen.lamp_red)
    green = np.float32(color[5] * screen.lamp_green)
    blue = np.float32(color[6] * screen.lamp_blue)
    total = load(tables.basis, at) * red + load(tables.basis, tables.lanes + at) * green
    total = total + load(tables.basis, 2 * tables.lanes + at) * blue
    transmittance = transmittance_columns(
        columns, tables.scaled_extinction, tables.constituents, tables.lanes, at
    )
    return total * transmittance


@inlined
def reflectance(color, mapped, tables, at):
    """Albedo of the ground: that of a colour of the map, or the solver's. [1]

    Parameters
    ----------
    color : array, shape (11,)
        Values from ``ground_color``. [1]
    mapped : bool
        Whether the ground has a map.
    tables : MarchTables
        Tables of the solution.
    at : int
        Index of the first lane.
    """
    detail = np.float32(max(color[8], 0.0))
    if not mapped:
        return load(tables.ground.albedo, at) * detail
    total = splat(0.0)
    for c in range(3):
        total = total + load(tables.basis, tables.lanes * c + at) * np.float32(color[c])
    return minimum(maximum(total * detail, splat(0.0)), splat(1.0))


@inlined
def ground_factor(
    color, screen, star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored, tables, work,
    at,
):  # fmt: skip
    """Light of the ground relative to that of a white Lambert ground. [1]

    Parameters
    ----------
    color, tables, at :
        Arguments of ``reflectance``.
    screen : Screen
        Camera with its maps.
    star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored, work :
        Results of ``ground_reflectances``, and its workspace, whose ``radiance`` holds the light of
        the mirrored sky after those of a line of sight.
    """
    albedo = reflectance(color, screen.mapped, tables, at)
    if tables.ground.law == 0 and not tables.ground.wet and not screen.clouded:
        return albedo
    star, sky = load(work.irradiance, at), load(work.irradiance, tables.lanes + at)
    by_star = star * (albedo * np.float32(star_diffuse) + np.float32(star_specular))
    by_sky = sky * (albedo * np.float32(sky_diffuse) + np.float32(sky_specular))
    if tables.ground.wet:
        by_sky = by_sky + load(work.radiance, MIRRORED * tables.lanes + at) * np.float32(
            pi * mirrored
        )
    return (by_star + by_sky) / maximum(star + sky, splat(1e-30))
