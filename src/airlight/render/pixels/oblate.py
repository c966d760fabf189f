r"""Line of sight to an oblate planet, displaced to where a sphere has the same local angles.

The point at which the line meets the spheroid, or its lowest one, has a normal **n** and an
altitude h. The line is displaced, parallel to itself, so that it meets (R + h) **n**: there the
spherical solution has the line's and the star's true zenith angles. The silhouette, the terminator
and the latitude of maps are exact. The profile of the file holds along each local vertical.

Curvature, 1/R_c along a vertical plane (Euler), differs from 1/R. In the parabolic approximation,
altitudes h + μ t + t²/2R_c along a line are those of a sphere for μ √(R_c/R) and lengths
√(R/R_c) t. Hence columns of a line are longer by

.. math:: \sqrt{\frac{m + 1}{m + R/R_c}}, \quad m = \frac{\pi R \mu^2}{2 H},

from the airmass 1/√(μ² + 2H/πR), with a tenth of the shell for H. The depression θ of a star below
the horizon becomes

.. math:: \theta' = \theta \left[\sqrt{q} + \frac{H}{2R}
          \frac{\ln q}{(\theta + \sqrt{2H/\pi R})^2}\right], \quad q = \frac{R_c}{R},

which changes the lowest altitude R θ²/2 of its rays by R (q - 1) θ²/2, and by H ln √q for their
columns far below the horizon, less above. Scattering angles change by as much, 0.2° at 3.4°.

By Monte Carlo in a spheroid of f = 0.1, light errs by 1 % at most on the disc and at its limb,
where the sphere alone errs by -5 % (pole) and +9 % (equator, seen from the pole); with the sun 1.7°
and 3.4° below the horizon by 1 to 2 %, the sphere alone by -3 % at the equator and up to +14 % at a
pole. Left out: curvature in the light of rings on the night side, and along refracted lines.
"""

from __future__ import annotations

from math import log, pi, sqrt
from typing import Final, NamedTuple

from airlight.geometry.spheroid import lowest_point, relative_curvature, unit
from airlight.geometry.vectors import Vec3, components, cross, dot, minus, plus, scaled
from airlight.kernel import compiled_loop, inlined, kernel
from airlight.render.pixels.sky_view_lut import Observer

#: Thickness of the shell over the scale height that is taken at the limb. [1]
SCALES: Final = 10.0


class DisplacedLine(NamedTuple):
    """Displaced line of sight.

    Attributes
    ----------
    ray : Vec3
        Direction in the frame of its observer. [1]
    observer : Observer
        Observer on it, as far from its lowest point as the camera, above a sphere.
    longer : float
        Columns along the line over those in the sphere. [1]
    """

    ray: Vec3
    observer: Observer
    longer: float


class DisplacedAxes(NamedTuple):
    """Place of the observer of a displaced line of sight.

    Attributes
    ----------
    level, up, normal : Vec3
        Horizontal direction of the line, vertical, and normal of the spheroid at the line's end or
        lowest point. [1]
    lateral, ahead : float
        Distance of the line from the centre, and of the observer before its lowest point, negative
        outside. [m]
    longer : float
        Columns along the line over those in the sphere. [1]
    """

    level: Vec3
    up: Vec3
    normal: Vec3
    lateral: float
    ahead: float
    longer: float


@kernel
def displaced_axes(ray, r, pole, flattening, bottom, top):
    """``DisplacedAxes`` of a line of sight.

    Parameters
    ----------
    ray, r, pole, flattening, bottom :
        Arguments of ``lowest_point``.
    top : float
        Radius of the top of the air. [m]
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
    steep = 0.5 * pi * SCALES * mu * mu * bottom / (top - bottom)
    curved = relative_curvature(end.normal, ray, pole, flattening)
    longer = sqrt((steep + 1.0) / (steep + curved))
    return DisplacedAxes(level, up, end.normal, lateral, ahead, longer)


@kernel
def lowered_star(sun, axes, pole, flattening, scale):
    """Direction of a star in the sphere, lower or higher if it is below the horizon. [1]

    Parameters
    ----------
    sun, axes : Vec3, DisplacedAxes
        Direction of the star [1], and result of ``displaced_axes``.
    pole, flattening :
        Arguments of ``lowest_point``.
    scale : float
        Scale height over the radius of the sphere. [1]
    """
    rise = min(dot(sun, axes.normal), 0.0)
    ratio = 1.0 / sqrt(relative_curvature(axes.normal, sun, pole, flattening))
    apart = sqrt(2.0 / pi * scale) - rise
    lower = rise * (ratio - 1.0 + scale * log(ratio) / (apart * apart))
    return unit(plus(sun, scaled(axes.normal, lower)))


@compiled_loop
def displaced_places(rays, r, pole, flattening, bottom, top, out):
    """Places of the observers of displaced lines of sight.

    Parameters
    ----------
    rays : array, shape (n, 3)
        Directions in the observer's frame. [1]
    r, pole, flattening, bottom, top :
        Arguments of ``displaced_axes``.
    out : array, shape (4, n)
        Receives radius [m], cosine and sine of the view zenith angle, and ``longer`` [1].
    """
    for k in range(rays.shape[0]):
        ray = Vec3(rays[k, 0], rays[k, 1], rays[k, 2])
        at = displaced_axes(ray, r, pole, flattening, bottom, top)
        radius = sqrt(at.lateral * at.lateral + at.ahead * at.ahead)
        out[0, k], out[1, k] = radius, at.ahead / radius
        out[2, k], out[3, k] = at.lateral / radius, at.longer


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
        return DisplacedLine(ray, same_observer(observer), 1.0)
    pole, flattening = observer.ground_z, observer.flattening
    axes = displaced_axes(ray, observer.r, pole, flattening, tables.bottom, tables.top)
    level, up, lateral, ahead = axes.level, axes.up, axes.lateral, axes.ahead
    r = sqrt(lateral * lateral + ahead * ahead)
    scale = (tables.top - tables.bottom) / (SCALES * tables.bottom)
    sun = lowered_star(Vec3(observer.sun_x, 0.0, observer.sun_z), axes, pole, flattening, scale)
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
    return DisplacedLine(direction, moved, axes.longer)


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
