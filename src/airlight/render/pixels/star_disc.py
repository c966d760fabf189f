"""Antialiased disc of a light in a pixel, for any apparent size.

Discs of several pixels have an antialiased rim, the shading of ``disc_shading`` and are occulted
pixel by pixel. Smaller discs are sets of points splatted bilinearly, and are dimmed by occultation.
Both conserve irradiance.
"""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np

from airlight.geometry.mappings.sky_view import angle_above_horizon
from airlight.geometry.refraction import refraction_angle
from airlight.geometry.vectors import Vec3, combined, cross, dot, minus, plus, scaled
from airlight.kernel import inlined, kernel
from airlight.render.pixels.disc_shading import DiscPlace, disc_powers, whole_powers
from airlight.render.pixels.oblate import displaced_axes
from airlight.render.pixels.sky_view_lut import half_sine_between
from airlight.scene.projections.projected import projected_ray
from airlight.solver.tables.column_ratios import columns_to_top

#: Radius below which a disc is splatted as points. [pixel]
SMALL = 1.5
#: Rings and spokes of these points.
RINGS = 3
SPOKES = 8
#: Stencil: the pixel, its right, lower, left and upper neighbours, and the midpoints.
_PLACES = 9
_NUMBERS = 27
#: Angular distance beyond which a neighbour is disconnected. [pixel]
_APART = 3.0
#: Pixel area over a square below which points are not splatted, as at the poles of panoramas.
_FLAT = 0.3


@kernel
def camera_direction(px, py, view):
    """Viewing direction of an image point in the observer's frame; zero outside the projection.

    Parameters
    ----------
    px, py : float
        Position from the left and top edge of the frame. [pixel]
    """
    ray = projected_ray(view.projection, px, py, view.width, view.height, view.field_of_view)
    return combined(ray, view.right, view.up, view.forward)


@inlined
def leaving_air(ray, observer, tables, columns):
    """Refracted direction of a line of sight outside the atmosphere.

    Parameters
    ----------
    ray : Vec3
        Direction at the observer. [1]
    observer, tables : Observer, MarchTables
        Observer, and tables of the solution.
    columns : array, shape (nc,)
        Receives the columns of the whole line. [m]

    Returns
    -------
    Vec3
        Refracted direction. [1]
    free : bool
        Whether the line misses the ground.
    """
    level = sqrt(ray.x * ray.x + ray.y * ray.y)
    r, z, up, longer = observer.r, ray.z, Vec3(0.0, 0.0, 1.0), 1.0
    if observer.outside and observer.flattening > 0.0:
        axes = displaced_axes(
            ray, r, observer.ground_z, observer.flattening, tables.bottom, tables.top
        )
        up, longer = axes.up, axes.longer
        r = sqrt(axes.lateral * axes.lateral + axes.ahead * axes.ahead)
        level, z = axes.lateral / r, axes.ahead / r
    impact = r * level
    start_r, start_mu = r, z
    inside, free = True, True
    if observer.outside:
        inside = z < 0.0 and impact < tables.top
        free = not (inside and impact < tables.bottom)
        start_r = tables.top
        start_mu = -sqrt(max((tables.top - impact) * (tables.top + impact), 0.0)) / tables.top
    else:
        free = angle_above_horizon(z, level, observer.horizon_mu, observer.horizon_sine) >= 0.0
    for c in range(tables.constituents):
        columns[c] = 0.0
    if inside and free:
        columns_to_top(
            start_r,
            start_mu,
            tables.bottom,
            tables.top,
            tables.first_nodes,
            tables.column_rows,
            tables.columns,
            columns,
        )
        for c in range(tables.constituents):
            columns[c] *= longer
        if tables.refraction_strength > 0.0:
            angle = refraction_angle(
                start_r, start_mu, tables.refraction_strength, columns[tables.constituents - 1]
            )
            turn, keep = sin(angle), cos(angle)
            scale = (level * keep + z * turn) / max(level, 1e-30)
            across = scaled(minus(ray, scaled(up, z)), scale)
            return plus(across, scaled(up, z * keep - level * turn)), free
    return ray, free


@kernel
def shared_out(across, down, radius, right_x, below_x, below_y):
    """Bilinear weight of a small disc in a pixel. [1]

    Parameters
    ----------
    across, down : float
        Offset of the disc's centre from the pixel's: along the step to the right neighbour, and
        perpendicular to it. [rad]
    radius : float
        Radius of the disc. [rad]
    right_x, below_x, below_y : float
        Steps to the neighbours on the right, (right_x, 0), and below, (below_x, below_y). [rad]

    Examples
    --------
    >>> shared_out(0.25, 0.0, 0.0, 1.0, 0.0, 1.0)  # a point: three quarters are here
    0.75
    """
    total = 0.0
    for ring in range(RINGS):
        reach = radius * sqrt((ring + 0.5) / RINGS)
        for spoke in range(SPOKES):
            turn = (spoke + 0.5) * (2.0 * pi / SPOKES)
            b = (down + reach * sin(turn)) / below_y
            a = (across + reach * cos(turn) - b * below_x) / right_x
            total += max(1.0 - abs(a), 0.0) * max(1.0 - abs(b), 0.0)
    return total / (RINGS * SPOKES)


@kernel
def covered(apart, radius, pixel):
    """Antialiased coverage of a pixel by a disc, linear across its rim. [1]

    Its integral over the sphere is the solid angle of the disc.

    Parameters
    ----------
    apart : float
        Angle between the pixel and the disc's centre. [rad]
    radius, pixel : float
        Radius of the disc; angle that a pixel spans. [rad]
    """
    # ∫ over a rim of width p about w: π (w² + p²/12)
    rim = pixel * pixel / 12.0
    wide = max(sqrt(max(radius * radius - rim, 0.0)), 0.75 * pixel)
    share = radius * radius / (wide * wide + rim)
    return share * min(max((wide - apart) / pixel + 0.5, 0.0), 1.0)


@inlined
def star_disc(px, py, ray, frame, columns):
    """Unattenuated ``DiscPowers`` of the disc in a pixel, per irradiance, and its ``DiscPlace``.

    Powers are 0 off the disc. [sr⁻¹]

    Parameters
    ----------
    px, py : float
        Position of the pixel. [pixel]
    ray : Vec3
        Its viewing direction; zero vector for none. [1]
    frame : FrameTables
        What the pixels read.
    columns : array, shape (nc,)
        Receives the columns along the line of sight. [m]
    """
    if ray.x == 0.0 and ray.y == 0.0 and ray.z == 0.0:
        return whole_powers(0.0), DiscPlace(0.0, 0.0, 0.0)
    observer, view, tables = frame.observer, frame.camera, frame.tables
    left, free = leaving_air(ray, observer, tables, columns)
    apart = 2.0 * half_sine_between(left, observer.sun_x, observer.sun_z)
    pixel = view.pixel_angle
    # Beyond two pixel diagonals no point is splatted.
    if not free or apart > tables.star_radius + 3.0 * pixel:
        return whole_powers(0.0), DiscPlace(0.0, 0.0, 0.0)
    part = covered(apart, tables.star_radius, pixel) * view.disc
    if tables.star_radius < SMALL * pixel:
        part = _point_like(px, py, part, frame, columns)
        return whole_powers(part), DiscPlace(0.0, 0.0, 0.0)
    if view.occulter_radius > 0.0:
        away = minus(left, view.occulter)
        beside = 2.0 * min(0.5 * sqrt(dot(away, away)), 1.0)
        # Pixels with both rims: coverages are subtracted.
        part = max(part - covered(beside, view.occulter_radius, pixel) * view.disc, 0.0)
    along = 0.0
    away, limb = Vec3(left.x - observer.sun_x, left.y, left.z - observer.sun_z), view.limb
    if view.phased:
        along = dot(away, limb) / max(apart, 1e-12)
    powers = disc_powers(part, apart, tables.star_radius, pixel, along, view.phased, view.phase)
    if not view.faced:
        return powers, DiscPlace(0.0, 0.0, 0.0)
    inverse = 1.0 / tables.star_radius
    right = cross(Vec3(observer.sun_x, 0.0, observer.sun_z), limb)
    return powers, DiscPlace(dot(away, limb) * inverse, dot(away, right) * inverse, pixel * inverse)


@inlined
def _step(steps, place):
    """Step to a place of the stencil. [1]"""
    return Vec3(steps[3 * place], steps[3 * place + 1], steps[3 * place + 2])


@inlined
def _point_like(px, py, otherwise, frame, columns):
    """Unattenuated radiance of a small disc in a pixel, per irradiance. [sr⁻¹]"""
    observer, view, tables = frame.observer, frame.camera, frame.tables
    steps = np.empty(_NUMBERS)
    fits = np.empty(_PLACES)
    # The pixel itself last: its columns are kept.
    for turn in range(_PLACES):
        place = _PLACES - 1 - turn
        way = 0.5 if place > 4 else 1.0
        side = place - 4 if place > 4 else place
        aside = way if side == 1 else (-way if side == 3 else 0.0)
        below = way if side == 2 else (-way if side == 4 else 0.0)
        ray = camera_direction(px + aside, py + below, view)
        left, free = leaving_air(ray, observer, tables, columns)
        steps[3 * place], steps[3 * place + 1], steps[3 * place + 2] = left
        fits[place] = 1.0 if free else 0.0
    for place in range(1, _PLACES):
        apart = 0.0
        for c in range(3):
            steps[3 * place + c] -= steps[c]
            apart += steps[3 * place + c] * steps[3 * place + c]
        if apart >= (_APART * view.pixel_angle) ** 2:
            fits[place] = 0.0
    if fits[1] + fits[3] < 0.5 or fits[2] + fits[4] < 0.5:
        return otherwise
    # A pixel reaches half-way to its neighbours on both sides, which may differ in distance.
    half_right, half_left = fits[1] / (fits[1] + fits[3]), fits[3] / (fits[1] + fits[3])
    half_below, half_above = fits[2] / (fits[2] + fits[4]), fits[4] / (fits[2] + fits[4])
    p, q = 1, 2
    if fits[5] + fits[6] + fits[7] + fits[8] > 3.5:
        half_right, half_left, half_below, half_above = 1.0, 1.0, 1.0, 1.0
        p, q = 5, 6
    u = minus(scaled(_step(steps, p), half_right), scaled(_step(steps, p + 2), half_left))
    v = minus(scaled(_step(steps, q), half_below), scaled(_step(steps, q + 2), half_above))
    slant = dot(u, v)
    area = sqrt(max(dot(u, u) * dot(v, v) - slant * slant, 0.0))
    if area < _FLAT * view.pixel_angle * view.pixel_angle:
        return otherwise
    # Fractions are measured along the step to the neighbours between which the disc lies: both
    # pixels then use the same step, and the fractions sum to 1.
    away = Vec3(observer.sun_x - steps[0], -steps[1], observer.sun_z - steps[2])
    p, q = 1, 2
    if fits[1] < 0.5 or (fits[3] > 0.5 and dot(away, u) < 0.0):
        p = 3
    if fits[2] < 0.5 or (fits[4] > 0.5 and dot(away, v) < 0.0):
        q = 4
    u, v = _step(steps, p), _step(steps, q)
    right = sqrt(dot(u, u))
    if right == 0.0:
        return otherwise
    u = Vec3(u.x / right, u.y / right, u.z / right)
    slant = dot(u, v)
    v = minus(v, scaled(u, slant))
    upright = sqrt(dot(v, v))
    if upright == 0.0:
        return otherwise
    across = dot(away, u)
    down = dot(away, v) / upright
    part = shared_out(across, down, tables.star_radius, right, slant, upright)
    return part / area
