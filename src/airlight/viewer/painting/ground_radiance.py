"""Reflected radiance of the ground at a probe: map, reflectance law, water and clouds."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.vectors import Vec3
from airlight.image.texels import CHANNELS
from airlight.physics.optics import water
from airlight.physics.optics.clouds import (
    DIFFUSE_COSINE,
    clouds_shown,
    layer_distance,
    layer_passage,
    layer_reflectance,
    reflected_at,
    under_sky,
    under_star,
)
from airlight.physics.optics.reflection import (
    WATER,
    brdf_diffuse,
    brdf_direct,
    cos_reflected,
    diffuse_reflectances,
    direct_reflectances,
)
from airlight.render.pixels.sea_sky import ACROSS, ALONG, mirror_facet
from airlight.scene import Scene
from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.ground_place import latitude_longitude, map_color, map_level
from airlight.scene.light_position import LightPosition
from airlight.solver.lines_of_sight import LinesOfSight, enter_shell
from airlight.solver.moments.radiance_parts import Parts
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


def ground_radiance(
    solution: MomentsSolution,
    lines: LinesOfSight,
    parts: Parts,
    color: FloatArray | None,
    clouds: tuple[float, float] | None,
) -> tuple[FloatArray, FloatArray]:
    """Reflected direct and diffuse radiance of the ground, attenuated by the atmosphere.

    Parameters
    ----------
    solution : MomentsSolution
        Displayed solution.
    lines : LinesOfSight
        Line of sight that ends on the ground.
    parts : Parts
        Contributions along it for ground of the solver's albedo.
    color : array, shape (4,), or None
        Linear sRGB reflectance and water fraction of the ground; None without a map. [1]
    clouds : (float, float) or None
        Result of ``probed_clouds``. [1]

    Returns
    -------
    star, sky : array, shape (nl,)
        Radiances per irradiance of the star. [sr⁻¹]
    """
    medium = solution.medium
    ground, bottom = medium.ground, medium.bottom_radius
    albedo = medium.ground_albedo
    if color is not None:
        albedo = np.clip(medium.map_basis @ color[:3], 0.0, 1.0)
    r, nu = float(lines.r[0]), float(lines.nu[0])
    mu_s = (r * float(lines.mu_s[0]) + float(lines.length[0]) * nu) / bottom
    mu_s = min(max(mu_s, -1.0), 1.0)
    mu_r = cos_reflected(r, float(lines.mu[0]), bottom)
    by_law = (
        brdf_direct(ground.law, ground, mu_s, mu_r, nu),
        brdf_diffuse(ground.law, ground, mu_r),
    )
    solved = np.empty((2, 1, albedo.size))
    cosines = [np.array([x]) for x in (mu_s, mu_r, nu)]
    direct_reflectances(ground, *cosines, solved[0])
    diffuse_reflectances(ground, cosines[1], solved[1])
    star, sky = (
        np.divide(part[0], factor, out=np.zeros_like(albedo), where=factor > 0.0)
        for part, factor in zip((parts.ground_star, parts.ground_sky), solved[:, 0], strict=True)
    )
    share = 0.0
    if ground.law == WATER:
        share = 1.0
    elif ground.wet and color is not None:
        share = float(color[3])
    (star_diffuse, star_specular), (sky_diffuse, sky_specular) = (
        ((1.0 - share) * diffuse, (1.0 - share) * specular) for diffuse, specular in by_law
    )
    mirrored = 0.0
    if share > 0.0:
        diffuse, specular = water.brdf_direct(ground, mu_s, mu_r, nu)
        star_diffuse, star_specular = (
            star_diffuse + share * diffuse,
            star_specular + share * specular,
        )
        diffuse, specular = water.brdf_diffuse(ground, mu_r)
        sky_diffuse, mirrored = sky_diffuse + share * diffuse, share * specular
    by_star = _factor((star_diffuse, star_specular), albedo)
    by_sky = _factor((sky_diffuse, sky_specular), albedo)
    sky_mirrored = mirrored * _mirrored(solution, mu_s, mu_r, nu) if mirrored > 0.0 else 0.0
    if clouds is None:
        return star * by_star, sky * (by_sky + sky_mirrored)
    passage = layer_passage(mu_s, mu_r, *clouds, ground.layer)
    once = layer_reflectance(mu_s, mu_r, nu, ground.layer)
    reflected = np.array([reflected_at(once, ground.layer, l) for l in range(albedo.size)])
    land = np.array(brdf_diffuse(ground.law, ground, DIFFUSE_COSINE))
    sea = np.array(water.brdf_diffuse(ground, DIFFUSE_COSINE))
    spread = _factor(tuple(land + share * (sea - land)), albedo)
    by_star = under_star(passage, reflected, by_star, by_sky + mirrored, spread)
    clouded = under_sky(passage, by_sky + mirrored, spread)
    clouded += passage.view_direct * (1.0 - passage.back) * (sky_mirrored - mirrored)
    return star * by_star, sky * clouded


def _factor(shares: tuple[float, float], albedo: FloatArray) -> FloatArray:
    """Reflectance factor of direct and diffuse light. [1]"""
    diffuse, specular = shares
    return np.asarray(diffuse * albedo + specular)


def _mirrored(solution: MomentsSolution, mu_s: float, mu_r: float, nu: float) -> FloatArray:
    """Mean sky that the facets mirror over a uniform sky, shape (nl,). [1]"""
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    wind = solution.medium.ground.wind
    facets = [mirror_facet(number, mu_r, wind) for number in range(ALONG * ACROSS)]
    share = np.array([one for one, _ in facets])
    ahead, aside, mu = np.array([ray for _, ray in facets])[share > 0.0].T
    share = share[share > 0.0] / share.sum()
    level = math.sqrt(max(1.0 - mu_s * mu_s, 0.0))
    towards = (nu + mu_r * mu_s) / math.sqrt(max(1.0 - mu_r * mu_r, 1e-12))
    towards = min(max(towards, -level), level)
    across = math.sqrt(max(level * level - towards * towards, 0.0))
    turn = np.clip(mu * mu_s + ahead * towards + aside * across, -1.0, 1.0)
    sine = np.sqrt((1.0 - mu) * (1.0 + mu))
    same = np.ones_like(mu)
    up = enter_shell(bottom * same, mu, sine, mu_s * same, turn, bottom, top)
    seen = share @ solution.relative_radiance(up)
    even = solution.relative_sky_irradiance(up.r[:1], up.mu_s[:1])[0] / math.pi
    return np.asarray(np.divide(seen, even, out=np.zeros_like(seen), where=even > 0.0))


def probed_clouds(
    solution: MomentsSolution,
    scene: Scene,
    direction: FloatArray,
    distance: float,
    position: LightPosition,
) -> tuple[float, float] | None:
    """Cloud cover on a line of sight to the ground, as in ``render.pixels.ground``.

    Parameters
    ----------
    solution : MomentsSolution
        Displayed solution.
    scene : Scene
        Observer and camera.
    direction : array, shape (3,)
        Direction in the observer's frame. [1]
    distance : float
        Distance to the ground; infinite if there is none. [m]
    position : LightPosition
        Position of the light.

    Returns
    -------
    seen, shaded : float
        Cover on the line of sight, and on the path to the light. None without clouds. [1]
    """
    medium, bottom = solution.medium, solution.medium.bottom_radius
    surface = medium.surface
    shown = clouds_shown(scene.altitude, scene.ground == "detailed", surface.clouds is None)
    overlay = ground_overlay(*surface.overlay)
    if surface.overlay[1] is None or overlay is None or not np.isfinite(distance):
        return None
    place = distance * direction + np.array([0.0, 0.0, bottom + scene.altitude])
    cosine = -float(direction @ place) / bottom
    level = map_level(scene.camera.pixel_angle, distance, cosine, bottom, overlay.rows)
    covers = []
    for towards in (-direction, position.direction):
        mu = float(towards @ place) / bottom
        away = layer_distance(mu, bottom, medium.surface.cloud_altitude)
        spot = scene.ground_frame @ (place + away * towards)
        texel = np.empty(CHANNELS)
        size = overlay.rows, overlay.columns, len(overlay.levels)
        map_color(overlay.flat, *size, *latitude_longitude(Vec3(*spot)), level, texel, 0)
        covers.append(shown * float(texel[CHANNELS - 1]))
    above = scene.altitude > medium.surface.cloud_altitude
    return covers[0] if above else 0.0, covers[1]
