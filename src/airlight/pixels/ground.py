"""Radiance of the ground in a pixel, from its map and BRDF.

The sky-view LUT and the march give the attenuated radiance of a white Lambert ground. It is scaled
by the reflectance factors for direct and diffuse irradiance, which differ for other BRDFs. Water
also mirrors the sky, whose radiance is stored separately.
"""

from __future__ import annotations

from math import pi
from typing import Final

import numpy as np

from airlight.geometry.shell import first_meeting
from airlight.kernel import inlined
from airlight.kernel.lanes import load, maximum, minimum, splat
from airlight.optics.clouds import layer_distance, under_clouds
from airlight.optics.reflection import WATER, sky_share, star_share
from airlight.optics.water import wet_shares
from airlight.pixels.ground_angles import ground_angles, ground_cosine
from airlight.scene.ground_detail import ground_detail
from airlight.scene.ground_place import latitude_longitude, map_color, map_level, moved_on
from airlight.solvers.moments.irradiance import ground_light
from airlight.solvers.moments.march_tables import MIRRORED
from airlight.solvers.moments.source import transmittance_columns

#: Length of the array that ``ground_color`` fills.
GROUND_VALUES: Final = 11


@inlined
def ground_color(x, y, z, sine, angle, observer, view, light, color):
    """Map values at the end of a line of sight, into ``color`` (11,). [1]

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame. [1]
    sine, angle : float
        Sine of its zenith angle [1]; angle of refraction [rad].
    observer, view, light : Observer, ViewUniforms, MarchTables
        Observer, camera with its maps, and tables of the solution.
    color : array, shape (11,)
        Receives linear sRGB reflectance and water fraction of the map, four values of the overlay,
        the noise factor, and the cloud cover on the line of sight and on the path to the star;
        values of absent maps are unchanged. [1]
    """
    cosine = ground_cosine(z, sine, observer, light)
    _across, up = first_meeting(min(observer.r * sine, light.bottom), sine, light.bottom)
    # the distance as a quotient, of which single precision keeps all digits near the observer
    both = max(light.bottom * cosine - observer.r * z, 1e-30)
    reach = observer.optical_altitude * (observer.r + light.bottom) / both
    px, py, pz = reach * x, reach * y, up
    color[8] = 1.0
    if view.detailed:  # of the straight line: how much a near one is bent is lost in rounding
        # pz - bottom of a point of the sphere, which single precision has to half a metre only
        below = -(px * px + py * py) / max(light.bottom + pz, 1e-3 * light.bottom)
        color[8] = 1.0 + ground_detail(
            view.xx * px + view.xy * py + view.xz * below,
            view.yx * px + view.yy * py + view.yz * below,
            view.zx * px + view.zy * py + view.zz * below,
            view.pixel_angle * reach / max(cosine, 0.01), view.detail_cell,
            view.whole_x, view.whole_y, view.whole_z,
            view.part_x, view.part_y, view.part_z,
        )  # fmt: skip
    px, py, pz = moved_on(px, py, pz, x, y, z, cosine, angle, light.bottom)
    latitude, longitude = latitude_longitude(
        view.xx * px + view.xy * py + view.xz * pz,
        view.yx * px + view.yy * py + view.yz * pz,
        view.zx * px + view.zy * py + view.zz * pz,
    )
    if view.mapped:
        level = map_level(view.pixel_angle, reach, cosine, light.bottom, view.map_rows)
        map_color(
            view.texels, view.map_rows, view.map_columns, view.map_levels, latitude,
            longitude, level, color, 0,
        )  # fmt: skip
        color[8] = color[8] * (1.0 - color[3]) + color[3]
    if view.overlaid:
        level = map_level(view.pixel_angle, reach, cosine, light.bottom, view.over_rows)
        if view.clouded:
            cloud_cover(px, py, pz, x, y, z, cosine, level, observer, view, light, color)
        map_color(
            view.over_texels, view.over_rows, view.over_columns, view.over_levels,
            latitude, longitude, level, color, 4,
        )  # fmt: skip
        if view.clouded:
            for c in range(4, 7):
                color[c] *= 1.0 - color[9]


@inlined
def cloud_cover(px, py, pz, x, y, z, cosine, level, observer, view, light, color):
    """Cloud cover on a line of sight and on the path from its end to the star. [1]

    Refraction between ground and layer is neglected.

    Parameters
    ----------
    px, py, pz : float
        End of the line of sight on the ground, from the centre, in the observer's frame. [m]
    x, y, z, cosine : float
        Its direction, and cosine of the zenith angle of the way back. [1]
    level : float
        Level of the overlay. [1]
    observer, view, light, color :
        Arguments of ``ground_color``; the cover of the line of sight is 0 from below the layer.
    """
    mu_s = (px * observer.sun_x + pz * observer.sun_z) / light.bottom
    back = layer_distance(cosine, light.bottom, view.cloud_altitude)
    out = layer_distance(mu_s, light.bottom, view.cloud_altitude)
    for towards in range(2):
        qx, qy, qz = px - back * x, py - back * y, pz - back * z
        if towards == 1:
            qx, qy, qz = px + out * observer.sun_x, py, pz + out * observer.sun_z
        latitude, longitude = latitude_longitude(
            view.xx * qx + view.xy * qy + view.xz * qz,
            view.yx * qx + view.yy * qy + view.yz * qz,
            view.zx * qx + view.zy * qy + view.zz * qz,
        )
        map_color(
            view.over_texels, view.over_rows, view.over_columns, view.over_levels,
            latitude, longitude, level, color, 4,
        )  # fmt: skip
        color[9 + towards] = color[7]
    if observer.r <= view.cloud_radius:
        color[9] = 0.0


@inlined
def ground_shares(x, y, z, sine, angle, observer, view, light, work, color):
    """Map values and reflectance factors at the end of a line of sight.

    Parameters
    ----------
    x, y, z, sine, angle, observer, view, light, color :
        Arguments of ``ground_color``; ``color`` is filled if there is a map.
    work : MarchWorkspace
        Workspace; ``received`` receives direct and diffuse irradiance, except for a Lambert ground
        without water and clouds.

    Returns
    -------
    star_matte, star_gloss, sky_matte, sky_gloss : float
        Diffuse factor, to be multiplied by the albedo, and specular factor, of direct and of
        diffuse irradiance. [1]
    mirrored : float
        Factor of the mirrored sky. [1]
    """
    if view.mapped or view.overlaid or view.detailed:
        ground_color(x, y, z, sine, angle, observer, view, light, color)
    else:
        color[8] = 1.0
    star_matte, star_gloss, sky_matte, sky_gloss, mirrored = 1.0, 0.0, 1.0, 0.0, 0.0
    if light.ground.law != 0 or light.ground.wet or view.clouded:
        mu_s, leaving, nu = ground_angles(x, z, sine, angle, observer, light)
        ground_light(mu_s, observer.orders, light, work)
        share = 0.0
        if light.ground.law == WATER:
            share = 1.0
        else:
            star_matte, star_gloss = star_share(light.ground.law, light.ground, mu_s, leaving, nu)
            sky_matte, sky_gloss = sky_share(light.ground.law, light.ground, leaving)
            if light.ground.wet and view.mapped:
                share = color[3]
        if share > 0.0:
            land = 1.0 - share
            star, glint, sky, mirrored = wet_shares(light.ground.wind, mu_s, leaving, nu)
            star_matte = land * star_matte + share * star
            star_gloss = land * star_gloss + share * glint
            sky_matte = land * sky_matte + share * sky
            sky_gloss = land * sky_gloss
            mirrored = share * mirrored
    if view.clouded:
        star_matte, star_gloss, sky_matte, sky_gloss, mirrored = under_clouds(
            color[9], color[10], light.ground.cloud_albedo,
            star_matte, star_gloss, sky_matte, sky_gloss, mirrored,
        )  # fmt: skip
    return star_matte, star_gloss, sky_matte, sky_gloss, mirrored


@inlined
def lamp_light(color, view, light, columns, at):
    """Attenuated radiance of city lights, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    color : array, shape (11,)
        Values from ``ground_color``. [1]
    view, light : ViewUniforms, MarchTables
        Colour of the lamps, and tables of the solution.
    columns : array, shape (nc,)
        Columns from ``columns_to_ground``. [m]
    at : int
        Index of the first lane.
    """
    red = np.float32(color[4] * view.lamp_red)
    green = np.float32(color[5] * view.lamp_green)
    blue = np.float32(color[6] * view.lamp_blue)
    total = load(light.basis, at) * red + load(light.basis, light.lanes + at) * green
    total = total + load(light.basis, 2 * light.lanes + at) * blue
    through = transmittance_columns(
        columns, light.scaled_extinction, light.constituents, light.lanes, at
    )
    return total * through


@inlined
def reflectance(color, mapped, light, at):
    """Spectral albedo of the ground, from the map or the solver. [1]

    Parameters
    ----------
    color : array, shape (11,)
        Values from ``ground_color``. [1]
    mapped : bool
        Whether the ground has a map.
    light : MarchTables
        Tables of the solution.
    at : int
        Index of the first lane.
    """
    detail = np.float32(max(color[8], 0.0))
    if not mapped:
        return load(light.ground.albedo, at) * detail
    total = splat(0.0)
    for c in range(3):
        total = total + load(light.basis, light.lanes * c + at) * np.float32(color[c])
    return minimum(maximum(total * detail, splat(0.0)), splat(1.0))


@inlined
def ground_factor(
    color, view, star_matte, star_gloss, sky_matte, sky_gloss, mirrored, light, work, at
):  # fmt: skip
    """Radiance of the ground over that of a white Lambert ground. [1]

    Parameters
    ----------
    color, light, at :
        Arguments of ``reflectance``.
    view : ViewUniforms
        Camera with its maps.
    star_matte, star_gloss, sky_matte, sky_gloss, mirrored, work :
        Results and workspace of ``ground_shares``; ``found`` has the mirrored sky radiance at
        ``MIRRORED``.
    """
    albedo = reflectance(color, view.mapped, light, at)
    if light.ground.law == 0 and not light.ground.wet and not view.clouded:
        return albedo
    star, sky = load(work.received, at), load(work.received, light.lanes + at)
    by_star = star * (albedo * np.float32(star_matte) + np.float32(star_gloss))
    by_sky = sky * (albedo * np.float32(sky_matte) + np.float32(sky_gloss))
    if light.ground.wet:
        by_sky = by_sky + load(work.found, MIRRORED * light.lanes + at) * np.float32(pi * mirrored)
    return (by_star + by_sky) / maximum(star + sky, splat(1e-30))
