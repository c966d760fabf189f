"""Cloud layer in a pixel: cover on its lines, and light of the layer with the ground below it."""

from __future__ import annotations

from math import pi, sqrt
from typing import Final

from airlight.geometry.vectors import Vec3, components, plus
from airlight.image.texels import CHANNELS
from airlight.kernel import inlined, kernel
from airlight.physics.optics.clouds import (
    DIFFUSE_COSINE,
    LayerPassage,
    LayerReflectance,
    layer_distance,
    layer_passage,
    layer_reflectance,
    reflected_lanes,
    under_sky,
    under_star,
)
from airlight.physics.optics.reflection import brdf_diffuse
from airlight.physics.optics.water import brdf_diffuse as water_diffuse
from airlight.render.pixels.relief import LOWEST
from airlight.render.pixels.star_azimuth import star_azimuth
from airlight.scene.cloud_grain import EDGE, STEP_OF_COVER, cloud_grain, veil_grain
from airlight.scene.ground_detail import above_threshold, grained_cover, pixel_width
from airlight.scene.ground_place import latitude_longitude, map_channel, map_value
from airlight.scene.land_texture import texture_footprint

#: Values of ``color``: cover of the star's beam over the mean around it, and light of the tops of
#: clouds over that of a level layer.
BEAM: Final = 7
TOPS: Final = 24
#: First of the values of ``color`` that ``keep_clouds`` fills, and number of all these.
_FIRST: Final = 12
CLOUD_VALUES: Final = 13
#: Height of full cover above none: ISCCP's middle clouds have their tops at 3.2 to 6.5 km (see
#: ``planets.ground.CLOUD_ALTITUDE``). [m]
THICKNESS: Final = 3300.0
#: Height of tops in a standard deviation of noise of two texels, of few clouds, and the share of it
#: that full cover loses, by eye. [m], [1]
HEAPED: Final = 1800.0
LEVELLED: Final = 0.5
#: Largest change of the light of a slope, whose light is spread by scattering within the cloud, by
#: eye. [1]
SHADING: Final = 0.6
#: Share of veils in the cover of clouds, least one that has texture, reciprocal of the width of
#: their edges, and level of the map around which they lie, by eye. [1]
VEILED: Final = 0.06
LEAST_VEIL: Final = 0.002
VEIL_EDGE: Final = 0.65
AROUND: Final = 3.0
#: Cover through which no shadow is seen, and finest texture of shadows over that of clouds. [1]
HIDDEN: Final = 0.9
SOFTER: Final = 1.6
#: Finest texture of clouds over that which pixels resolve: smaller ones are crumbs. By eye. [1]
FINEST: Final = 1.1


@kernel
def tops_light(mu_s, ascent):
    """Light that a slope of clouds reflects over that of level ones. [1]

    Odd in the slope but for 1, so that the mean over both sides of a cloud remains.

    Parameters
    ----------
    mu_s : float
        Cosine of the star's zenith angle. [1]
    ascent : float
        Tangent of the ascent towards the star. [1]

    Examples
    --------
    >>> tops_light(1.0, 2.0), round(tops_light(0.5, 1.0) + tops_light(0.5, -1.0), 9)
    (1.0, 2.0)
    """
    tangent = sqrt(max((1.0 - mu_s) * (1.0 + mu_s), 0.0)) / max(mu_s, LOWEST)
    steep = ascent * tangent if mu_s > 0.0 else 0.0
    return 1.0 - SHADING * steep / sqrt(1.0 + steep * steep)


@inlined
def cover_near(latitude, longitude, level, view):
    """Cover of the map at a mip level. [1]

    Parameters
    ----------
    latitude, longitude : float
        Geocentric coordinates. [rad]
    level : int
        Mip level of the overlay.
    view : ViewUniforms
        Camera with its maps.
    """
    return map_value(
        view.over_texels,
        view.over_rows,
        view.over_columns,
        level,
        latitude,
        longitude,
        CHANNELS - 1,
    )


@inlined
def veil_cover(latitude, longitude, place, blur, thin, view):
    """Cover of veils around clouds, whose mean is a share of that of the map. [1]

    Parameters
    ----------
    latitude, longitude : float
        Geocentric coordinates. [rad]
    place, blur : Vec3, float
        Place and footprint, as of ``cloud_grain``. [m]
    thin : float
        Share of veils in the cover. [1]
    view : ViewUniforms
        Camera with its maps.
    """
    around = map_channel(
        view.over_texels, view.over_rows, view.over_columns, view.over_levels,
        latitude, longitude, AROUND, CHANNELS - 1,
    )  # fmt: skip
    veil = thin * around
    if veil > LEAST_VEIL:
        noise, variance = veil_grain(place, blur, view.detail_cell, view.whole, view.part)
        shown = min(veil / LEAST_VEIL - 1.0, 1.0)
        veil += shown * (above_threshold(veil, VEIL_EDGE, noise, variance) - veil)
    return veil


@inlined
def cloud_cover(end, ray, cosine, spot, footprint, level, north, east, observer, frame, color):
    """Clouds on a line of sight and on the path from its end to the star.

    Of detailed ground, the texture of the clouds casts shadows, and their tops are shaded by the
    slope of the texture and of the map towards the star. A mean over many places of cover, beam or
    light of the tops is that without texture; the light below clouds grows where they hide their
    own shadows. Thin veils lie around them, without shadows. Refraction between ground and layer is
    neglected, and clouds cast no shadows on one another.

    Parameters
    ----------
    end : Vec3
        End of the line of sight on the ground, from the centre, in the observer's frame. [m]
    ray, cosine : Vec3, float
        Its direction, and cosine of the zenith angle of the way back. [1]
    spot, footprint : Vec3, float
        Results of ``ground_spot``. [m]
    level : float
        Level of the overlay. [1]
    north, east : float
        Displacement of the clouds that are seen, in latitude and longitude. [rad]
    observer, frame, color :
        Arguments of ``ground_color``; the cover of the line of sight is 0 from below the layer.
    """
    view, bottom = frame.camera, frame.tables.bottom
    mu_s = (end.x * observer.sun_x + end.z * observer.sun_z) / bottom
    back = layer_distance(cosine, bottom, view.cloud_altitude)
    out = layer_distance(mu_s, bottom, view.cloud_altitude)
    width = pixel_width(level) if view.detailed else 1.0
    blur = FINEST * texture_footprint(footprint, cosine)
    color[BEAM], color[TOPS], edge = 1.0, 1.0, EDGE
    for towards in range(2):
        way = Vec3(-back * ray.x, -back * ray.y, -back * ray.z)
        if towards == 1:
            north, east = 0.0, 0.0
            way = Vec3(out * observer.sun_x, 0.0, out * observer.sun_z)
        latitude, longitude = latitude_longitude(
            components(plus(end, way), observer.ground_x, observer.ground_y, observer.ground_z)
        )
        latitude, longitude = latitude + north, longitude + east
        cover = map_channel(
            view.over_texels,
            view.over_rows,
            view.over_columns,
            view.over_levels,
            latitude,
            longitude,
            level,
            CHANNELS - 1,
        )
        thin = VEILED * (1.0 - width) if towards == 0 else 0.0
        cover *= (1.0 - thin) / (1.0 - thin * cover)
        color[9 + towards] = cover
        wanted = view.detailed and cover > STEP_OF_COVER
        if towards == 1:
            wanted = wanted and mu_s > 0.0 and color[9] < HIDDEN
        if wanted:
            star = star_azimuth(end, latitude, longitude, bottom, observer)
            ascent = 0.0
            if towards == 0 and mu_s > 0.0:
                which = int(min(max(level, 0.0), view.over_levels - 1.0))
                angle = pi / view.over_rows * 2.0**which
                lat, lon = angle * star.north, angle * star.east
                ahead = cover_near(latitude + lat, longitude + lon, which, view)
                behind = cover_near(latitude - lat, longitude - lon, which, view)
                ascent = THICKNESS * (ahead - behind) / (2.0 * angle * bottom)
            if width < 1.0 and cover < 1.0 - STEP_OF_COVER:
                place = components(way, observer.ground_x, observer.ground_y, observer.ground_z)
                place, cell = plus(spot, place), view.detail_cell
                grain = cloud_grain(
                    place, blur, cover, cell, view.whole, view.part, star.way, edge, towards == 0
                )
                edge = grain.edge if towards == 0 else edge
                grained = grained_cover(cover, width, grain.noise, grain.variance, edge)
                heaped = HEAPED * (1.0 - LEVELLED * cover) * min(edge / EDGE, 1.0)
                ascent += heaped * grain.ascent
                if towards == 0:
                    color[9] = grained
                else:
                    color[BEAM] = grained / cover
            if towards == 0:
                color[TOPS] = tops_light(mu_s, ascent)
        if thin > 0.0:
            place = components(way, observer.ground_x, observer.ground_y, observer.ground_z)
            veil = veil_cover(latitude, longitude, plus(spot, place), blur, thin, view)
            total = veil + (1.0 - veil) * color[9]
            color[TOPS] = 1.0 + (color[TOPS] - 1.0) * color[9] / max(total, 1e-6)
            color[9] = total
        blur *= SOFTER
    if observer.r <= view.cloud_radius:
        color[9] = 0.0


@inlined
def keep_clouds(mu_s, mu_r, nu, share, ground, color):
    """Keep the light of the clouds on a line of sight, for ``clouded_light``.

    Parameters
    ----------
    mu_s, mu_r, nu : float
        Results of ``ground_angles``. [1]
    share : float
        Fraction of water. [1]
    ground : Reflection
        Ground with its layer.
    color : array, shape (GROUND_VALUES,)
        Results of ``cloud_cover``: covers at 9 and 10, of which the first becomes what the clouds
        hide of light from below; receives ``LayerReflectance``, ``LayerPassage`` and the factors of
        diffuse light. [1]
    """
    once = layer_reflectance(mu_s, mu_r, nu, ground.layer)
    passage = layer_passage(mu_s, mu_r, color[9], color[10], ground.layer)
    diffuse, specular = brdf_diffuse(ground.law, ground, DIFFUSE_COSINE)
    if share > 0.0:
        wet, mirrored = water_diffuse(ground, DIFFUSE_COSINE)
        diffuse += share * (wet - diffuse)
        specular += share * (mirrored - specular)
    color[_FIRST] = once.single * color[TOPS]
    color[_FIRST + 1] = once.angle
    color[_FIRST + 2] = once.multiple * color[TOPS]
    color[_FIRST + 3] = passage.seen
    color[_FIRST + 4] = passage.seen_albedo
    color[_FIRST + 5] = 1.0 - color[BEAM] * (1.0 - passage.star_direct)
    color[_FIRST + 6] = passage.star_diffuse
    color[_FIRST + 7] = passage.view_direct
    color[_FIRST + 8] = passage.view_diffuse
    color[_FIRST + 9] = passage.back
    color[_FIRST + 10] = diffuse
    color[_FIRST + 11] = specular
    color[9] = passage.seen_albedo


@inlined
def clouded_light(star, sky, direct, diffuse, albedo, beyond, color, layer, at):
    """Reflected light of the star and of the sky, of ground and clouds.

    Parameters
    ----------
    star, sky : lanes
        Direct and diffuse irradiance. [1]
    direct, diffuse : lanes
        Reflectance factors of the ground; the second with the mirrored sky as a uniform one. [1]
    albedo : lanes
        Albedo of the ground. [1]
    beyond : lanes
        Light of the mirrored sky, less that of a uniform one. [1]
    color, layer, at : array, DropletLayer, int
        Values from ``keep_clouds``, the layer, and the index of the first lane.

    Returns
    -------
    by_star, by_sky : lanes
        π times the radiance. [1]
    """
    once = LayerReflectance(color[_FIRST], color[_FIRST + 1], color[_FIRST + 2])
    passage = LayerPassage(
        color[_FIRST + 3],
        color[_FIRST + 4],
        color[_FIRST + 5],
        color[_FIRST + 6],
        color[_FIRST + 7],
        color[_FIRST + 8],
        color[_FIRST + 9],
    )
    spread = albedo * color[_FIRST + 10] + color[_FIRST + 11]
    reflected = reflected_lanes(once, layer, at)
    by_star = star * under_star(passage, reflected, direct, diffuse, spread)
    by_sky = sky * under_sky(passage, diffuse, spread)
    return by_star, by_sky + beyond * (passage.view_direct * (1.0 - passage.back))
