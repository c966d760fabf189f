"""Body without air in a pixel: its reflected light, and its coverage of the pixel.

Lengths are in radii of the body and directions in the observer's frame, so that single precision
resolves the ground from its surface, and its disc from any distance.
"""

from __future__ import annotations

from math import asin, sqrt
from typing import Annotated, Final, NamedTuple

import numpy as np

from airlight.geometry.sun_disc import mean_incidence
from airlight.geometry.vectors import Vec3, components, cross, dot, minus, scaled
from airlight.kernel import inlined, kernel
from airlight.kernel.shader_fields import CHOICE, InTexture
from airlight.physics.optics.bare_surface import surface_factor
from airlight.render.pixels.bare_ground import crater_light
from airlight.render.pixels.bare_relief import HIGHEST, Met, relief_met, relief_shown
from airlight.render.pixels.pixel import ViewUniforms
from airlight.render.pixels.sky_view_lut import Observer
from airlight.render.pixels.star_disc import camera_direction, leaving_air
from airlight.scene.craters import REGIONAL, highland
from airlight.scene.ground_detail import NOMINAL_ROWS
from airlight.scene.ground_place import latitude_longitude, map_color, map_level
from airlight.solver.moments.march_tables import MarchTables

#: Power of the observer's point below which it decides between hit and miss. [radius²]
_NEAR: Final = 3.0
#: Distance from the limb within which pixels are supersampled. [pixel]
_EDGE: Final = 1.5


class BareBody(NamedTuple):
    """Body without air under one light.

    Attributes
    ----------
    body_centre : Vec3
        Its centre relative to the observer. [radius]
    body_power : float
        Squared distance of the centre, less 1. [radius²]
    body_x, body_y, body_z : Vec3
        Axes of the body-fixed frame. [1]
    body_law : int
        Number of the law of reflection.
    body_samples : int
        Samples per side of a pixel on the limb.
    body_behind : bool
        Whether it is seen through refracting air.
    body_hides : bool
        Whether it stands before the star whose disc is drawn.
    body_radius, body_craters : float
        Radius [m]; craters wider than D per area D², 0 without [1].
    body_mapped : bool
        Whether it has a map, in the place of that of the ground.
    body_color : Vec3
        Linear sRGB of the irradiance, times the albedo over the mean of the map. [W m⁻² sr⁻¹]
    body_light, light_parallax, light_radius : Vec3, float, float
        Direction of the light from the centre [1], radius of the body over its distance [1], and
        angular radius of the light [rad].
    shaded : bool
        Whether another body stands before the light.
    shade, shade_parallax : Vec3, float
        Direction of that body from the centre, and radius over its distance. [1]
    shade_radius : float
        Sine of the angular radius of that body from the centre; 0 if it does not vary. [1]
    shade_first, shade_step : float
        Separation of the first row of ``shade_table``, and steps per radian. [rad], [rad⁻¹]
    shade_table : array, shape (n, 3)
        Fraction of the light left, by separation and channel. [1]
    """

    body_centre: Vec3
    body_power: float
    body_x: Vec3
    body_y: Vec3
    body_z: Vec3
    body_law: Annotated[int, CHOICE]
    body_samples: Annotated[int, CHOICE]
    body_behind: bool
    body_hides: bool
    body_radius: float
    body_craters: float
    body_mapped: bool
    body_color: Vec3
    body_light: Vec3
    light_parallax: float
    light_radius: float
    shaded: bool
    shade: Vec3
    shade_parallax: float
    shade_radius: float
    shade_first: float
    shade_step: float
    shade_table: Annotated[np.ndarray, InTexture("shade", 2)]


class BodyFrame(NamedTuple):
    """Everything that the pixels of a body without air read: camera, body and air before it."""

    camera: ViewUniforms
    body: BareBody
    observer: Observer
    tables: MarchTables


@kernel
def sphere_distance(along, across, power):
    """Distance to a unit sphere along a line of sight; -1 if the line misses it. [radius]

    s = (d² - 1)/(p + √D), with D = p² - (d² - 1) = (1 - m)(1 + m): the first is accurate near the
    ground, the second far away.

    Parameters
    ----------
    along, across : float
        Distance p of the point nearest to the centre, along the line, and its distance m from the
        centre. [radius]
    power : float
        Squared distance of the centre, less 1: d² - 1. [radius²]

    Examples
    --------
    >>> sphere_distance(3.0, 0.0, 8.0), sphere_distance(3.0, 1.5, 10.25)
    (2.0, -1.0)
    """
    square = (1.0 - across) * (1.0 + across)
    if power < _NEAR:
        square = along * along - power
    if along <= 0.0 or square <= 0.0:
        return -1.0
    return max(power, 0.0) / (along + sqrt(square))


@kernel
def towards_unit(direction, parallax, point):
    """Direction of a body from a point of the unit sphere. [1]

    Parameters
    ----------
    direction : Vec3
        Its direction from the centre. [1]
    parallax : float
        Radius over its distance from the centre. [1]
    point : Vec3
        Point of the sphere. [radius]
    """
    away = minus(direction, scaled(point, parallax))
    return scaled(away, 1.0 / sqrt(dot(away, away)))


@inlined
def shade_left(point, body, channel):
    """Fraction of the light that the body before it leaves, at a point of the surface. [1]

    Parameters
    ----------
    point : Vec3
        Unit vector from the centre. [1]
    body : BareBody
        Body, with ``shaded``.
    channel : int
        0 to 2.
    """
    away = minus(body.shade, scaled(point, body.shade_parallax))
    nearer = 1.0 / sqrt(dot(away, away))
    apart = minus(scaled(away, nearer), body.body_light)
    angle = 2.0 * asin(min(0.5 * sqrt(dot(apart, apart)), 1.0))
    # The limb counts: where that body is larger than from the centre, its centre is farther.
    angle -= asin(min(body.shade_radius * nearer, 1.0)) - asin(body.shade_radius)
    last = body.shade_table.shape[0] - 1
    place = min(max((angle - body.shade_first) * body.shade_step, 0.0), 1.0 * last)
    row = min(int(place), last - 1)
    share = place - row
    below, above = body.shade_table[row, channel], body.shade_table[row + 1, channel]
    return below + (above - below) * share


@inlined
def body_ray(px, py, frame, columns):
    """Direction of a line of sight behind the air before the body; zero for none.

    Parameters
    ----------
    px, py : float
        Position in the frame. [pixel]
    frame : BodyFrame
        What the pixels read.
    columns : array, shape (nc,)
        Workspace.
    """
    ray = camera_direction(px, py, frame.camera)
    if frame.body.body_behind:
        shown = dot(ray, ray)
        left, _ = leaving_air(ray, frame.observer, frame.tables, columns)
        ray = scaled(left, 1.0 if shown > 0.0 else 0.0)
    return ray


@inlined
def surface_color(point, length, leaving, least, frame, color):
    """Colour of the map at a point of the surface. [1]

    Parameters
    ----------
    point : Vec3
        Unit vector from the centre. [1]
    length, leaving : float
        Distance of the point [radius], and cosine of emergence [1].
    least : float
        Least level of the map. [1]
    frame : BodyFrame
        What the pixels read.
    color : array, shape (4,)
        Receives linear sRGB. [1]
    """
    view, body = frame.camera, frame.body
    own = components(point, body.body_x, body.body_y, body.body_z)
    latitude, longitude = latitude_longitude(own)
    level = max(map_level(view.pixel_angle, length, leaving, 1.0, 1.0 * view.map_rows), least)
    rows, columns, levels = view.map_rows, view.map_columns, view.map_levels
    map_color(view.texels, rows, columns, levels, latitude, longitude, level, color, 0)


@inlined
def limb_samples(ray, frame):
    """Samples per side of a pixel: more than one only near the limb of a sphere.

    Parameters
    ----------
    ray : Vec3
        Direction of its centre. [1]
    frame : BodyFrame
        What the pixels read.
    """
    body, side = frame.body, 1
    miss = cross(ray, body.body_centre)
    across, reach = sqrt(dot(miss, miss)), sqrt(body.body_power + 1.0)
    if abs(across - 1.0) < _EDGE * frame.camera.pixel_angle * reach and not raised(frame):
        side = body.body_samples
    return side


@inlined
def raised(frame):
    """Whether the body is seen with its relief.

    Parameters
    ----------
    frame : BodyFrame
        What the pixels read.
    """
    body = frame.body
    shown = relief_shown(body.body_power, body.body_radius, frame.camera.pixel_angle)
    return shown > 0.0 and body.body_craters > 0.0


@inlined
def body_met(ray, frame, color):
    """``Met`` of a line of sight.

    Parameters
    ----------
    ray : Vec3
        Direction. [1]
    frame : BodyFrame
        What the pixels read.
    color : array, shape (4,)
        Workspace: map.
    """
    body = frame.body
    miss, along = cross(ray, body.body_centre), dot(ray, body.body_centre)
    across = sqrt(dot(miss, miss))
    if not raised(frame):
        length = sphere_distance(along, across, body.body_power)
        return Met(length, 1.0, sqrt(max((1.0 - across) * (1.0 + across), 0.0)))
    if along <= 0.0 or across > 1.0 + HIGHEST / body.body_radius:
        return Met(-1.0, 0.0, 1.0)
    high, rows = 1.0, 1.0 * NOMINAL_ROWS
    if body.body_mapped:
        rows = 1.0 * frame.camera.map_rows
        length = along - sqrt(max((1.0 - across) * (1.0 + across), 0.0))
        end = minus(scaled(ray, length), body.body_centre)
        end = scaled(end, 1.0 / sqrt(dot(end, end)))
        surface_color(end, length, 1.0, REGIONAL, frame, color)
        high = highland(color[1])
    return relief_met(
        components(ray, body.body_x, body.body_y, body.body_z),
        components(body.body_centre, body.body_x, body.body_y, body.body_z),
        body.body_power,
        body.body_radius,
        rows,
        frame.camera.pixel_angle,
        high,
    )


@inlined
def body_coverage(px, py, frame, columns, color):
    """Fraction of a pixel that the body covers. [1]

    Parameters
    ----------
    px, py, frame, columns :
        Arguments of ``body_ray``.
    color : array, shape (4,)
        Workspace: map.
    """
    side = limb_samples(body_ray(px, py, frame, columns), frame)
    step, count = 1.0 / side, 0.0
    for sample in range(side * side):
        down = sample // side
        across = sample - side * down
        x, y = px + (across + 0.5) * step - 0.5, py + (down + 0.5) * step - 0.5
        ray = body_ray(x, y, frame, columns)
        met = body_met(ray, frame, color)
        if met.length >= 0.0:
            count += met.cover
    return count * step * step


@inlined
def body_light(px, py, frame, columns, color):
    """Light of the body in a pixel, over ``body_color`` and by channel. [1]

    Parameters
    ----------
    px, py, frame, columns :
        Arguments of ``body_ray``.
    color : array, shape (4,)
        Workspace: map.

    Returns
    -------
    red, green, blue : float
        Reflected light, weighted by the coverage of the pixel. [1]
    """
    body, red, green, blue = frame.body, 0.0, 0.0, 0.0
    side = limb_samples(body_ray(px, py, frame, columns), frame)
    step = 1.0 / side
    for sample in range(side * side):
        down = sample // side
        across = sample - side * down
        x, y = px + (across + 0.5) * step - 0.5, py + (down + 0.5) * step - 0.5
        ray = body_ray(x, y, frame, columns)
        met = body_met(ray, frame, color)
        length = met.length
        if length >= 0.0:
            end = minus(scaled(ray, length), body.body_centre)
            point = scaled(end, 1.0 / sqrt(dot(end, end)))
            light = towards_unit(body.body_light, body.light_parallax, point)
            lit = mean_incidence(dot(point, light), body.light_radius)
            if lit > 0.0:
                factor = surface_factor(body.body_law, lit, met.leaving, -dot(light, ray))
                factor *= met.cover * step * step
                mapped = 1.0
                if body.body_mapped:
                    surface_color(point, length, met.leaving, REGIONAL, frame, color)
                    mapped = color[1]
                    surface_color(point, length, met.leaving, 0.0, frame, color)
                if body.body_craters > 0.0:
                    factor *= crater_light(
                        components(point, body.body_x, body.body_y, body.body_z),
                        components(ray, body.body_x, body.body_y, body.body_z),
                        components(light, body.body_x, body.body_y, body.body_z),
                        met.leaving,
                        frame.camera.pixel_angle * length,
                        mapped,
                        body.body_craters,
                        body.body_radius,
                        1.0 * (frame.camera.map_rows if body.body_mapped else NOMINAL_ROWS),
                    )
                if body.body_mapped:
                    color[0] *= factor
                    color[1] *= factor
                    color[2] *= factor
                else:
                    color[0] = factor
                    color[1] = factor
                    color[2] = factor
                if body.shaded:
                    color[0] *= shade_left(point, body, 0)
                    color[1] *= shade_left(point, body, 1)
                    color[2] *= shade_left(point, body, 2)
                red += color[0]
                green += color[1]
                blue += color[2]
    return red, green, blue
