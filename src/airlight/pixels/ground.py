"""Light of the ground in a pixel: what colour and law of reflection make of the light on it.

Table of the sky and march give the light of a white Lambert ground behind the air. The ground asks
its law of reflection for two factors, of the star's light and of the sky's, which differ where it
does not reflect alike into all directions: then the two irradiances share that light between them.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from airlight.geometry.bending import bend_angle, turned
from airlight.geometry.shell import first_meeting
from airlight.kernel import inlined
from airlight.kernel.lanes import load, maximum, minimum, splat
from airlight.optics.reflection import sky_share, star_share
from airlight.pixels.sky_table import star_from
from airlight.scene.ground_place import latitude_longitude, map_color, map_level, moved_on
from airlight.solvers.moments.irradiance import ground_light
from airlight.tables.column_ratios import columns_to_top


@inlined
def bent_to_ground(z, sine, observer, light, columns):
    """Angle of refraction of a line of sight that ends on the ground. [rad]

    Parameters
    ----------
    z, sine : float
        Cosine and sine of its zenith angle. [1]
    observer, light : Observer, MarchTables
        Observer, and tables of the solution.
    columns : array, shape (nc,)
        Workspace. [m]
    """
    bottom, top = light.bottom, light.top
    impact = min(observer.r * sine, bottom)
    slant = sqrt(max((bottom - impact) * (bottom + impact), 0.0)) / bottom
    columns_to_top(bottom, slant, bottom, top, light.columns, columns)
    column = columns[light.constituents - 1]
    if not observer.outside:
        columns_to_top(observer.r, -z, bottom, top, light.columns, columns)
        column = max(column - columns[light.constituents - 1], 0.0)
    return bend_angle(bottom, slant, light.bend, column)


@inlined
def ground_color(x, y, z, sine, angle, observer, screen, light, color):
    """Colour of the map at the end of a line of sight, into ``color`` (3,). [1]

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame. [1]
    sine, angle : float
        Sine of its zenith angle [1]; angle of refraction [rad].
    observer, screen, light : Observer, Screen, MarchTables
        Observer, camera with its maps, and tables of the solution.
    color : array, shape (3,)
        Receives linear sRGB reflectance. [1]
    """
    impact = min(observer.r * sine, light.bottom)
    cosine = sqrt(max((light.bottom - impact) * (light.bottom + impact), 0.0)) / light.bottom
    across, up = first_meeting(impact, sine, light.bottom)
    scale = across / max(sine, 1e-30)
    px, py, pz = scale * x, scale * y, up
    px, py, pz = moved_on(px, py, pz, x, y, z, cosine, angle, light.bottom)
    latitude, longitude = latitude_longitude(
        screen.xx * px + screen.xy * py + screen.xz * pz,
        screen.yx * px + screen.yy * py + screen.yz * pz,
        screen.zx * px + screen.zy * py + screen.zz * pz,
    )
    reach = sqrt(px * px + py * py + (pz - observer.r) * (pz - observer.r))
    level = map_level(screen.pixel_angle, reach, cosine, light.bottom, screen.levels[0, 1])
    map_color(screen.texels, screen.levels, latitude, longitude, level, color)


@inlined
def ground_angles(x, z, sine, angle, observer, light):
    """Directions at the end of a line of sight on the ground.

    Parameters
    ----------
    x, z, sine, angle, observer, light :
        Arguments of ``ground_color``.

    Returns
    -------
    mu_s, leaving, nu : float
        Cosines of ``star_factor``: of the star's zenith angle there, of the zenith angle towards
        the observer, and between the arriving line and the star. [1]
    """
    impact = min(observer.r * sine, light.bottom)
    leaving = sqrt(max((light.bottom - impact) * (light.bottom + impact), 0.0)) / light.bottom
    across, up = first_meeting(impact, sine, light.bottom)
    cos_azimuth = x / sine if sine > 0.0 else 1.0
    mu_s = star_from(across, up, light.bottom, cos_azimuth, observer.sun_x, observer.sun_z)
    nu = min(max(x * observer.sun_x + z * observer.sun_z, -1.0), 1.0)
    if light.bend > 0.0:
        mu_s, nu = turned(-leaving, mu_s, nu, angle)
        mu_s = min(max(mu_s, -1.0), 1.0)
    return mu_s, leaving, nu


@inlined
def ground_shares(x, y, z, sine, angle, observer, screen, light, work, color):
    """Ground at the end of a line of sight: its colour, and both factors of its law.

    Parameters
    ----------
    x, y, z, sine, angle, observer, screen, light, color :
        Arguments of ``ground_color``; ``color`` is received where there is a map.
    work : MarchWorkspace
        Workspace, whose ``received`` has the irradiances by star and sky, except for Lambert's law.

    Returns
    -------
    star_matte, star_gloss, sky_matte, sky_gloss : float
        Factor of the albedo, and part without it, of the star's and of the sky's light. [1]
    """
    if screen.mapped:
        ground_color(x, y, z, sine, angle, observer, screen, light, color)
    star_matte, star_gloss, sky_matte, sky_gloss = 1.0, 0.0, 1.0, 0.0
    if light.ground.law != 0:
        mu_s, leaving, nu = ground_angles(x, z, sine, angle, observer, light)
        star_matte, star_gloss = star_share(light.ground.law, light.ground, mu_s, leaving, nu)
        sky_matte, sky_gloss = sky_share(light.ground.law, light.ground, leaving)
        ground_light(mu_s, observer.orders, light, work)
    return star_matte, star_gloss, sky_matte, sky_gloss


@inlined
def reflectance(color, mapped, light, at):
    """Albedo of the ground: that of a colour of the map, or the solver's. [1]

    Parameters
    ----------
    color : array, shape (3,)
        Linear sRGB reflectance. [1]
    mapped : bool
        Whether the ground has a map.
    light : MarchTables
        Tables of the solution.
    at : int
        Index of the first lane.
    """
    if not mapped:
        return load(light.ground.albedo, at)
    total = splat(0.0)
    for c in range(3):
        total = total + load(light.basis, light.lanes * c + at) * np.float32(color[c])
    return minimum(maximum(total, splat(0.0)), splat(1.0))


@inlined
def ground_factor(
    color, mapped, star_matte, star_gloss, sky_matte, sky_gloss, light, work, at
):  # fmt: skip
    """Light of the ground relative to that of a white Lambert ground. [1]

    Parameters
    ----------
    color, mapped, light, at :
        Arguments of ``reflectance``.
    star_matte, star_gloss, sky_matte, sky_gloss, work :
        Results of ``ground_shares``, and its workspace.
    """
    albedo = reflectance(color, mapped, light, at)
    if light.ground.law == 0:
        return albedo
    star, sky = load(work.received, at), load(work.received, light.lanes + at)
    by_star = star * (albedo * np.float32(star_matte) + np.float32(star_gloss))
    by_sky = sky * (albedo * np.float32(sky_matte) + np.float32(sky_gloss))
    return (by_star + by_sky) / maximum(star + sky, splat(1e-30))
