"""Radiance of the ground in a pixel, from its map and BRDF.

The sky-view LUT and the march give the attenuated radiance of a white Lambert ground. It is scaled
by the reflectance factors for direct and diffuse irradiance, which differ for other BRDFs. Water
also mirrors the sky, whose radiance is stored separately.
"""

from __future__ import annotations

from math import pi
from typing import Final

import numpy as np

from airlight.geometry.shell import first_intersection
from airlight.geometry.vectors import Vec3, components, minus, plus, scaled
from airlight.kernel import inlined
from airlight.kernel.lanes import lane_view, load, maximum, minimum, splat
from airlight.physics.optics.clouds import GroundFactors, clouds_shown, plane_albedo
from airlight.physics.optics.cox_munk import mean_square_slope, mirror_slope
from airlight.physics.optics.reflection import WATER, brdf_diffuse, brdf_direct
from airlight.physics.optics.rpv import land_diffuse, land_direct, unsaturated
from airlight.physics.optics.water import water_reflectances
from airlight.render.pixels.coast import MapSpot, edged_color, river
from airlight.render.pixels.ground_angles import ground_angles, ground_cosine
from airlight.render.pixels.ground_clouds import (
    CLOUD_VALUES,
    cloud_cover,
    clouded_light,
    keep_clouds,
)
from airlight.render.pixels.land import NEARLY_WATER, SKY, detailed_land
from airlight.render.pixels.oblate import point_below
from airlight.render.pixels.relief import relief_light
from airlight.render.pixels.sea_sky import mirror_place
from airlight.render.pixels.sea_surface import (
    SMALL,
    Waves,
    disc_spread,
    mirror_waves,
    resolved_waves,
    spread_glint,
)
from airlight.render.pixels.skyline import LOW
from airlight.scene.ground_detail import (
    STEP,
    GroundNoise,
    displacement,
    ground_detail,
    pixel_width,
)
from airlight.scene.ground_place import (
    latitude_longitude,
    map_channel,
    map_color,
    map_level,
    moved_on,
)
from airlight.scene.lamps import BENT, ROOFS, lamps_at
from airlight.scene.land_texture import (
    FINEST_OF_MAP,
    texture_footprint,
)
from airlight.scene.sea_waves import COARSEST, peak_wavenumber
from airlight.scene.slicks import STEEPEST, slick_glint, slick_roughness
from airlight.solver.moments.irradiance import ground_light
from airlight.solver.moments.march_tables import MIRRORED
from airlight.solver.moments.source import transmittance_columns

#: Length of the array that ``ground_color`` fills.
GROUND_VALUES: Final = 14 + CLOUD_VALUES
#: Cosine of the star's zenith angle from which light of the night is lost in its light on the
#: ground: skyglow of cities is 2e-4 of it, and lamps keep their mean, without a pattern. [1]
DAYLIGHT: Final = 0.1


@inlined
def level_ground(color):
    """Values of ground without detail, clouds and relief, into ``color``. [1]"""
    color[8] = 1.0
    color[9] = 0.0
    color[10] = 0.0
    color[11] = 1.0
    color[SKY] = 1.0


@inlined
def straight_end(ray, sine, cosine, observer, tables):
    """Distance to the end of a line of sight without refraction [m], and its place.

    Parameters
    ----------
    ray, sine, cosine : Vec3, float, float
        Direction in the observer's frame, sine of its zenith angle, and ``ground_cosine``. [1]
    observer, tables : Observer, MarchTables
        Observer, and tables of the solution.

    Returns
    -------
    reach, end : float, Vec3
        Distance; end from the centre, in the observer's frame. [m]
    """
    _across, up = first_intersection(min(observer.r * sine, tables.bottom), sine, tables.bottom)
    # the distance as a quotient, of which single precision keeps all digits near the observer
    both = max(tables.bottom * cosine - observer.r * ray.z, 1e-30)
    reach = observer.optical_altitude * (observer.r + tables.bottom) / both
    return reach, Vec3(reach * ray.x, reach * ray.y, up)


@inlined
def ground_spot(reach, end, cosine, observer, view, tables):
    """Place of a pixel on the ground, and the longer axis of its footprint. [m]

    Parameters
    ----------
    reach, end : float, Vec3
        Results of ``straight_end``. [m]
    cosine : float
        Cosine of the zenith angle towards the observer. [1]
    observer, view, tables : Observer, ViewUniforms, MarchTables
        Observer, camera, and tables of the solution.

    Returns
    -------
    place, footprint : Vec3, float
        Position relative to the point below the observer, in the planet's frame; length.
    """
    # z - bottom of a point of the sphere, which single precision has to half a metre only
    below = -(end.x * end.x + end.y * end.y) / max(tables.bottom + end.z, 1e-3 * tables.bottom)
    place = components(
        Vec3(end.x, end.y, below), observer.ground_x, observer.ground_y, observer.ground_z
    )
    if observer.outside:  # of a displaced line of sight
        up = components(
            Vec3(0.0, 0.0, 1.0), observer.ground_x, observer.ground_y, observer.ground_z
        )
        place = plus(place, scaled(minus(up, point_below(observer)), tables.bottom))
    return place, view.pixel_angle * reach / max(cosine, 0.02)


@inlined
def ground_color(ray, sine, angle, observer, frame, color):
    """Map values at the end of a line of sight, into ``color`` (GROUND_VALUES,). [1]

    Parameters
    ----------
    ray : Vec3
        Direction in the observer's frame. [1]
    sine, angle : float
        Sine of its zenith angle [1]; angle of refraction [rad].
    observer, frame : Observer, FrameTables
        Observer, and what the pixels read.
    color : array, shape (GROUND_VALUES,)
        Receives linear sRGB reflectance and water fraction of the map, three colours of city
        lights, the noise factor of ground without a map (at 8), the cloud cover on the line of
        sight and on the path to the star, the factor of direct light by slopes, and those of
        ``cloud_cover``; values of absent maps are unchanged. [1]
    """
    view, tables = frame.camera, frame.tables
    cosine = ground_cosine(ray.z, sine, observer, tables)
    reach, end = straight_end(ray, sine, cosine, observer, tables)
    level_ground(color)
    # of the straight line: how much a near one is bent is lost in rounding
    noise, width = GroundNoise(0.0, 0.0), 1.0
    place, footprint = ground_spot(reach, end, cosine, observer, view, tables)
    # a low observer's ground lies within a texel, whose edges are seen of coasts alone
    if view.detailed and (tables.ground.wet or observer.optical_altitude > LOW):
        noise = ground_detail(
            place, max(footprint, 0.5 * view.detail_cell * STEP**FINEST_OF_MAP),
            view.detail_cell, view.whole, view.part,
        )  # fmt: skip
    end = moved_on(end, ray, cosine, angle, tables.bottom)
    latitude, longitude = latitude_longitude(
        components(end, observer.ground_x, observer.ground_y, observer.ground_z)
    )
    seen = MapSpot(latitude, longitude, 1.0, 0.0)
    if view.mapped:
        level = map_level(view.pixel_angle, reach, cosine, tables.bottom, view.map_rows)
        if view.detailed:
            width = pixel_width(level)
        seen = MapSpot(
            latitude + displacement(width, noise.north, view.map_rows),
            longitude + displacement(width, noise.east, view.map_rows),
            width,
            0.0,
        )
        map_color(
            view.texels, view.map_rows, view.map_columns, view.map_levels,
            seen.latitude, seen.longitude, level, color, 0,
        )  # fmt: skip
        if width < 1.0 and color[3] < NEARLY_WATER:
            flowing = river(seen, view, color)
            edged_color(seen, view, color)
            seen = MapSpot(seen.latitude, seen.longitude, width, flowing)
    mu_s = 0.0
    if view.detailed:
        mu_s = (end.x * observer.sun_x + end.z * observer.sun_z) / tables.bottom
        detailed_land(place, footprint, cosine, mu_s, seen, reach, observer, frame, color)
    if view.overlaid:
        level = map_level(view.pixel_angle, reach, cosine, tables.bottom, view.over_rows)
        shown, north, east = 0.0, 0.0, 0.0
        if view.detailed:
            width = pixel_width(level)
            north = displacement(width, noise.north, view.over_rows)
            east = displacement(width, noise.east, view.over_rows)
        if view.clouded:
            shown = clouds_shown(observer.optical_altitude, view.detailed, view.clouds_from_space)
        if shown > 0.0:
            cloud_cover(
                end, ray, cosine, place, footprint, level, north, east, observer, frame, color
            )
            color[9] *= shown
            color[10] *= shown
        if view.relieved and view.detailed and (not view.mapped or color[3] < NEARLY_WATER):
            color[11] *= relief_light(end, latitude, longitude, level, observer, frame)
        lamps = map_channel(
            view.over_texels,
            view.over_rows,
            view.over_columns,
            view.over_levels,
            latitude + BENT * north,
            longitude + BENT * east,
            level,
            0,
        )
        if view.detailed and lamps > 0.0 and mu_s < DAYLIGHT:
            lamps = lamps_at(
                lamps,
                cosine,
                latitude,
                longitude,
                texture_footprint(footprint, cosine),
                pi * tables.bottom / view.over_rows,
                view.over_rows,
            )
            lamps *= min(observer.optical_altitude / ROOFS, 1.0)
        color[4] = lamps * (1.0 - color[9] * plane_albedo(cosine, tables.ground.layer))
        color[5] = color[4]
        color[6] = color[4]


@inlined
def ground_reflectances(ray, sine, angle, observer, frame, work, color):
    """Map values and ``GroundFactors`` at the end of a line of sight.

    Parameters
    ----------
    ray, sine, angle, observer, frame, color :
        Arguments of ``ground_color``; ``color`` is filled if there is a map.
    work : MarchWorkspace
        Workspace; ``irradiance`` receives direct and diffuse irradiance, except for a Lambert
        ground without water and clouds.
    """
    view, tables = frame.camera, frame.tables
    if view.mapped or view.overlaid or view.detailed:
        ground_color(ray, sine, angle, observer, frame, color)
    else:
        level_ground(color)
    star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored = 1.0, 0.0, 1.0, 0.0, 0.0
    if tables.ground.law != 0 or tables.ground.wet or view.clouded or view.detailed:
        mu_s, mu_r, nu = ground_angles(ray.x, ray.z, sine, angle, observer, tables)
        ground_light(mu_s, observer.orders, tables, work)
        share = 0.0
        if tables.ground.law == WATER:
            share = 1.0
        else:
            star_diffuse, star_specular = brdf_direct(
                tables.ground.law, tables.ground, mu_s, mu_r, nu
            )
            star_diffuse *= color[11]
            star_specular *= color[11]
            sky_diffuse, sky_specular = brdf_diffuse(tables.ground.law, tables.ground, mu_r)
            sky_diffuse *= color[SKY]
            if view.detailed and view.mapped and tables.ground.law == 0:
                star_diffuse *= unsaturated(land_direct(mu_s, mu_r, nu), color[1])
                sky_diffuse *= unsaturated(land_diffuse(mu_r), color[1])
            if tables.ground.wet and view.mapped:
                share = color[3]
        if share > 0.0:
            land = 1.0 - share
            sparkle = wave_light(ray, sine, mu_s, mu_r, nu, observer, frame, work)
            star, glint, sky, mirrored = water_reflectances(
                tables.ground.wind, mu_s, mu_r, nu, sparkle
            )
            star_diffuse = land * star_diffuse + share * star
            star_specular = land * star_specular + share * glint
            sky_diffuse = land * sky_diffuse + share * sky
            sky_specular = land * sky_specular
            mirrored = share * mirrored
        if view.clouded and color[9] + color[10] > 0.0:
            keep_clouds(mu_s, mu_r, nu, share, tables.ground, color)
    return GroundFactors(star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored)


@inlined
def wave_light(ray, sine, mu_s, mu_r, nu, observer, frame, work):
    """Glint of a pixel of water over that of all facets, and its mirrored sky. [1]

    Parameters
    ----------
    ray, sine, observer, frame, work :
        Arguments of ``ground_reflectances``; ``radiance`` at ``MIRRORED`` becomes that of the
        resolved waves, unless the frame has no sea-sky LUT.
    mu_s, mu_r, nu : float
        Results of ``ground_angles``. [1]
    """
    view, tables = frame.camera, frame.tables
    reach, end = straight_end(ray, sine, mu_r, observer, tables)
    spot, footprint = ground_spot(reach, end, mu_r, observer, view, tables)
    waves = Waves(0.0, 0.0, 0.0)
    if footprint * peak_wavenumber(tables.ground.wind) < COARSEST:
        waves = resolved_waves(ray, sine, spot, footprint, observer, view, tables)
    broadening = 1.0
    if waves.share > 0.0 or disc_spread(mu_s, mu_r, tables) > SMALL:
        side = -1.0 if ray.y > 0.0 else 1.0
        place = mirror_place(mu_s, mu_r, nu, side, observer, frame.window)
        broadening = spread_glint(waves, place, tables)
        if waves.share > 0.0 and observer.orders != 1 and frame.window.columns > 0:
            mirror_waves(waves, place, view.sky_air, tables, work)
    if view.detailed:
        steep = mirror_slope(mu_s, mu_r, nu) / mean_square_slope(tables.ground.wind)
        if steep < STEEPEST:
            rougher, variance = slick_roughness(
                spot, footprint, view.detail_cell, view.whole, view.part
            )
            broadening *= slick_glint(steep, rougher, variance)
    return broadening


@inlined
def lamp_light(color, view, tables, columns, at):
    """Attenuated radiance of city lights, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    color : array, shape (GROUND_VALUES,)
        Values from ``ground_color``. [1]
    view, tables : ViewUniforms, MarchTables
        Colour of the lamps, and tables of the solution.
    columns : array, shape (nc,)
        Columns from ``columns_to_ground``. [m]
    at : int
        Index of the first lane.
    """
    red = np.float32(color[4] * view.lamp.red)
    green = np.float32(color[5] * view.lamp.green)
    blue = np.float32(color[6] * view.lamp.blue)
    basis, extinction = lane_view(tables.basis, at), lane_view(tables.scaled_extinction, at)
    total = basis[0] * red + basis[1] * green + basis[2] * blue
    return total * transmittance_columns(columns, extinction, tables.constituents)


@inlined
def reflectance(color, mapped, tables, at):
    """Spectral albedo of the ground, from the map or the solver. [1]

    Parameters
    ----------
    tables : MarchTables
        Tables of the solution.
    """
    detail = np.float32(max(color[8], 0.0))
    if not mapped:
        return load(tables.ground.albedo, at) * detail
    basis = lane_view(tables.basis, at)
    total = splat(0.0)
    for c in range(3):
        total = total + basis[c] * np.float32(color[c])
    return minimum(maximum(total * detail, splat(0.0)), splat(1.0))


@inlined
def ground_factor(color, view, factors, tables, work, at):
    """Radiance of the ground over that of a white Lambert ground. [1]

    Parameters
    ----------
    color, tables, at :
        Arguments of ``reflectance``.
    view : ViewUniforms
        Camera with its maps.
    factors, work :
        Result and workspace of ``ground_reflectances``; ``radiance`` has the mirrored sky radiance
        at ``MIRRORED``.
    """
    albedo = reflectance(color, view.mapped, tables, at)
    plain = not view.clouded and not view.detailed
    if tables.ground.law == 0 and not tables.ground.wet and plain:
        return albedo
    received, found = lane_view(work.irradiance, at), lane_view(work.radiance, at)
    star, sky = received[0], received[1]
    direct = albedo * np.float32(factors.star_diffuse) + np.float32(factors.star_specular)
    diffuse = albedo * np.float32(factors.sky_diffuse) + np.float32(factors.sky_specular)
    mirrored = splat(0.0)
    if tables.ground.wet:
        mirrored = found[MIRRORED] * np.float32(pi * factors.mirrored)
    by_star, by_sky = star * direct, sky * diffuse + mirrored
    if view.clouded and color[9] + color[10] > 0.0:
        diffuse = diffuse + np.float32(factors.mirrored)
        beyond = mirrored - sky * np.float32(factors.mirrored)
        by_star, by_sky = clouded_light(
            star, sky, direct, diffuse, albedo, beyond, color, tables.ground.layer, at
        )
    return (by_star + by_sky) / maximum(star + sky, splat(1e-30))
