"""Light of the ground in a pixel: what colour and law of reflection make of the light on it.

sky-view LUT and march give the light of a white Lambert ground behind the air. The ground asks
its law of reflection for two factors, of the star's light and of the sky's, which differ where it
does not reflect alike into all directions: then the two irradiances share that light between them.
Water mirrors the sky itself, at the place that table and march give it beside the ground's light.
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
    """Colour, water, lamps and clouds of the end of a line of sight, into ``color`` (11,). [1]

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame. [1]
    sine, angle : float
        Sine of its zenith angle [1]; angle of refraction [rad].
    observer, view, light : Observer, ViewUniforms, MarchTables
        Observer, camera with its maps, and tables of the solution.
    color : array, shape (11,)
        Receives linear sRGB reflectance and share of water of the map, four values of the overlay,
        the factor of the detail below the map's resolution, and the cover of the clouds on the line
        of sight and on the star's light; those of a map that is missing stay. [1]
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
    """Ground at the end of a line of sight: its colour, and both factors of its law.

    Parameters
    ----------
    x, y, z, sine, angle, observer, view, light, color :
        Arguments of ``ground_color``; ``color`` is received where there is a map.
    work : MarchWorkspace
        Workspace, whose ``received`` has the irradiances by star and sky, except for Lambert's law
        without water and clouds.

    Returns
    -------
    star_matte, star_gloss, sky_matte, sky_gloss : float
        Factor of the albedo, and part without it, of the star's and of the sky's light. [1]
    mirrored : float
        Factor of the light of the sky that is seen mirrored. [1]
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
    """Light of lamps on the ground that reaches the observer, per irradiance of the star. [sr⁻¹]

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
    """Albedo of the ground: that of a colour of the map, or the solver's. [1]

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
    """Light of the ground relative to that of a white Lambert ground. [1]

    Parameters
    ----------
    color, light, at :
        Arguments of ``reflectance``.
    view : ViewUniforms
        Camera with its maps.
    star_matte, star_gloss, sky_matte, sky_gloss, mirrored, work :
        Results of ``ground_shares``, and its workspace, of which ``found`` has the light of the
        mirrored sky after those of a line of sight.
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
