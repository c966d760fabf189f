"""Cloud layer in a pixel: cover on its lines, and light of the layer with the ground below it."""

from __future__ import annotations

from typing import Final

from airlight.geometry.vectors import Vec3, components, minus, scaled
from airlight.image.texels import CHANNELS
from airlight.kernel import inlined
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
from airlight.scene.ground_place import latitude_longitude, map_channel

#: First of the values of ``color`` that ``keep_clouds`` fills, and their number.
_FIRST: Final = 12
CLOUD_VALUES: Final = 12


@inlined
def cloud_cover(end, ray, cosine, level, north, east, observer, frame, color):
    """Cloud cover on a line of sight and on the path from its end to the star. [1]

    Refraction between ground and layer is neglected.

    Parameters
    ----------
    end : Vec3
        End of the line of sight on the ground, from the centre, in the observer's frame. [m]
    ray, cosine : Vec3, float
        Its direction, and cosine of the zenith angle of the way back. [1]
    level : float
        Level of the overlay. [1]
    north, east : float
        Displacement of the clouds that are seen, in latitude and longitude. [rad]
    observer, frame, color :
        Arguments of ``ground_color``; the cover of the line of sight is 0 from below the layer.
    """
    view, tables = frame.camera, frame.tables
    mu_s = (end.x * observer.sun_x + end.z * observer.sun_z) / tables.bottom
    back = layer_distance(cosine, tables.bottom, view.cloud_altitude)
    out = layer_distance(mu_s, tables.bottom, view.cloud_altitude)
    for towards in range(2):
        place = minus(end, scaled(ray, back))
        if towards == 1:
            north, east = 0.0, 0.0
            place = Vec3(end.x + out * observer.sun_x, end.y, end.z + out * observer.sun_z)
        latitude, longitude = latitude_longitude(
            components(place, observer.ground_x, observer.ground_y, observer.ground_z)
        )
        color[9 + towards] = map_channel(
            view.over_texels,
            view.over_rows,
            view.over_columns,
            view.over_levels,
            latitude + north,
            longitude + east,
            level,
            CHANNELS - 1,
        )
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
        Covers at 9 and 10, of which the first becomes what the clouds hide of light from below;
        receives ``LayerReflectance``, ``LayerPassage`` and the factors of diffuse light. [1]
    """
    once = layer_reflectance(mu_s, mu_r, nu, ground.layer)
    passage = layer_passage(mu_s, mu_r, color[9], color[10], ground.layer)
    diffuse, specular = brdf_diffuse(ground.law, ground, DIFFUSE_COSINE)
    if share > 0.0:
        wet, mirrored = water_diffuse(ground, DIFFUSE_COSINE)
        diffuse += share * (wet - diffuse)
        specular += share * (mirrored - specular)
    color[_FIRST] = once.single
    color[_FIRST + 1] = once.angle
    color[_FIRST + 2] = once.multiple
    color[_FIRST + 3] = passage.seen
    color[_FIRST + 4] = passage.seen_albedo
    color[_FIRST + 5] = passage.star_direct
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
