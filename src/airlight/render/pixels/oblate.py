r"""Line of sight to an oblate planet, displaced to where a sphere has the same local angles.

The point at which the line meets the spheroid, or its lowest one, has a normal **n** and an
altitude h. The line is displaced, parallel to itself, so that it meets (R + h) **n**: there the
spherical solution has the line's and the star's true zenith angles, and scattering angles do not
change. The silhouette, the terminator and the latitude of maps are exact. The profile of the
file holds along each local vertical. Left out: that curvature differs from 1/R, by which columns
at the limb err as √(R/R_c) with the radius of curvature R_c along the line: -5 % at the pole of
Saturn, +11 % at its equator seen from the pole. By Monte Carlo in a spheroid of f = 0.1, light errs
by -4 and +9 % there in thin air and by 1 % in thick air; with the sun 1.7° below the horizon by
-3 % at the equator and +6 % at a pole, 3.4° below by +13 %; by less than 0.5 % on the lit disc.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

from airlight.geometry.spheroid import lowest_point, unit
from airlight.geometry.vectors import Vec3, components, cross, dot, minus, plus, scaled
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.render.pixels.sky_view_lut import Observer


class DisplacedLine(NamedTuple):
    """Displaced line of sight.

    Attributes
    ----------
    ray : Vec3
        Direction in the frame of its observer. [1]
    observer : Observer
        Observer on it, as far from its lowest point as the camera, above a sphere.
    """

    ray: Vec3
    observer: Observer


@kernel
def displaced_axes(ray, r, pole, flattening, bottom):
    """Place of the observer of a displaced line of sight.

    Parameters
    ----------
    ray, r, pole, flattening, bottom :
        Arguments of ``lowest_point``.

    Returns
    -------
    level, up : Vec3
        Horizontal direction of the line, and vertical. [1]
    lateral, ahead : float
        Distance of the line from the centre, and of the observer before its lowest point, negative
        outside. [m]
    """
    end = lowest_point(ray, r, pole, flattening, bottom)
    mu = min(dot(ray, end.normal), 0.0)
    if end.altitude > 0.0:
        mu = 0.0
    side = minus(end.normal, scaled(ray, dot(ray, end.normal)))
    if dot(side, side) < 1e-12:
        side = cross(ray, Vec3(0.6, 0.8, 0.0))
        if dot(side, side) < 0.1:
            side = cross(ray, Vec3(0.0, 0.6, 0.8))
    side = unit(side)
    reach = bottom + end.altitude
    lateral = reach * sqrt((1.0 - mu) * (1.0 + mu))
    ahead = reach * mu - end.distance
    inverse = 1.0 / sqrt(lateral * lateral + ahead * ahead)
    up = plus(scaled(ray, ahead * inverse), scaled(side, lateral * inverse))
    level = minus(scaled(ray, lateral * inverse), scaled(side, ahead * inverse))
    return level, up, lateral, ahead


@compiled_loop
def displaced_places(rays, r, pole, flattening, bottom, out):
    """Places of the observers of displaced lines of sight.

    Parameters
    ----------
    rays : array, shape (n, 3)
        Directions in the observer's frame. [1]
    r, pole, flattening, bottom :
        Arguments of ``displaced_axes``.
    out : array, shape (3, n)
        Receives radius [m], and cosine and sine of the view zenith angle [1].
    """
    for k in range(rays.shape[0]):
        ray = Vec3(rays[k, 0], rays[k, 1], rays[k, 2])
        _, _, lateral, ahead = displaced_axes(ray, r, pole, flattening, bottom)
        radius = sqrt(lateral * lateral + ahead * ahead)
        out[0, k], out[1, k], out[2, k] = radius, ahead / radius, lateral / radius


@inlined
def same_observer(observer):
    """Observer as a value, which a shader otherwise has as uniforms."""
    return Observer(
        observer.r,
        observer.optical_altitude,
        observer.outside,
        observer.horizon_mu,
        observer.horizon_sine,
        observer.sun_x,
        observer.sun_z,
        observer.seen_x,
        observer.seen_z,
        observer.orders,
        observer.centre,
        observer.flattening,
        observer.ground_x,
        observer.ground_y,
        observer.ground_z,
        observer.forward,
        observer.filter_axis,
    )


@inlined
def displaced_line(ray, observer, tables):
    """``DisplacedLine`` of a line of sight, which stays where it is without flattening.

    Parameters
    ----------
    ray : Vec3
        Direction. [1]
    observer, tables : Observer, MarchTables
        Observer, and tables of the solution.
    """
    if observer.flattening <= 0.0:
        return DisplacedLine(ray, same_observer(observer))
    level, up, lateral, ahead = displaced_axes(
        ray, observer.r, observer.ground_z, observer.flattening, tables.bottom
    )
    r = sqrt(lateral * lateral + ahead * ahead)
    sun = Vec3(observer.sun_x, 0.0, observer.sun_z)
    sun_z = dot(sun, up)
    across, x_axis = minus(sun, scaled(up, sun_z)), level
    sun_x = sqrt(dot(across, across))
    if sun_x > 1e-6:
        x_axis = scaled(across, 1.0 / sun_x)
    y_axis = cross(up, x_axis)
    sine = lateral / r
    moved = Observer(
        r,
        r - tables.bottom,
        True,
        -sqrt(max((r - tables.bottom) * (r + tables.bottom), 0.0)) / r,
        tables.bottom / r,
        sun_x,
        sun_z,
        sun_x,
        sun_z,
        observer.orders,
        components(observer.centre, x_axis, y_axis, up),
        0.0,
        components(observer.ground_x, x_axis, y_axis, up),
        components(observer.ground_y, x_axis, y_axis, up),
        components(observer.ground_z, x_axis, y_axis, up),
        components(observer.forward, x_axis, y_axis, up),
        components(observer.filter_axis, x_axis, y_axis, up),
    )
    direction = Vec3(sine * dot(level, x_axis), sine * dot(level, y_axis), ahead / r)
    return DisplacedLine(direction, moved)


@inlined
def point_below(observer):
    """Vertical of the point below the camera, in the planet's frame. [1]

    Parameters
    ----------
    observer : Observer
        Observer, also that of a displaced line.
    """
    up = Vec3(0.0, 0.0, 1.0)
    if observer.outside:
        up = unit(scaled(observer.centre, -1.0))
    return components(up, observer.ground_x, observer.ground_y, observer.ground_z)
