"""Light of the air along one line of sight, from the sky-view LUT or marched."""

from __future__ import annotations

from math import atan2, pi, sqrt
from typing import NamedTuple

import numpy as np

from airlight.geometry.mappings.sky_view import angle_above_horizon, row_from_angle, row_from_impact
from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import LANES, lane_view, splat
from airlight.render.pixels.ground_angles import ground_angles, refraction_to_ground
from airlight.render.pixels.sea_sky import mean_facet, mirror_place, mirrored_sky
from airlight.render.pixels.sky_view_lut import SightLine, half_sine_between, look
from airlight.solver.moments.march_tables import FACETS, MIRRORED
from airlight.solver.stokes_frame import star_plane


class ClassifiedRay(NamedTuple):
    """Classification of a line of sight.

    Attributes
    ----------
    sine, row : float
        Sine of the zenith angle; row coordinate in its half of the sky-view LUT. [1]
    through_air, to_ground : bool
        Whether it crosses the atmosphere, and whether it ends on the ground.
    """

    sine: float
    row: float
    through_air: bool
    to_ground: bool


class TexelPlace(NamedTuple):
    """Place between four texels of a layer.

    Attributes
    ----------
    near, stride : int
        Index of the first of the four texels, and texels per row.
    right, down : float
        Fractions of the distance to the next texel and to the next row. [1]
    """

    near: int
    stride: int
    right: float
    down: float


@kernel
def texel_before(coordinate, first, last):
    """Lower texel and fraction for linear interpolation.

    Parameters
    ----------
    coordinate : float
        Coordinate in texels; clamped between the first and the last. [1]
    first, last : int
        Index range of the texels.

    Examples
    --------
    >>> texel_before(2.25, 0, 7), texel_before(9.0, 0, 7), texel_before(1.0, 2, 7)
    ((2, 0.25), (6, 1.0), (2, 0.0))
    """
    held = min(max(coordinate, float(first)), float(last))
    texel = min(int(held), last - 1)
    return texel, held - texel


@inlined
def between_texels(table, place):
    """Bilinear interpolation of a layer of the sky-view LUT.

    Parameters
    ----------
    table, place : lanes of shape (texels,), TexelPlace
        Layer of fourth roots, and place in it.
    """
    e, f = np.float32(place.right), np.float32(place.down)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    near, below = place.near, place.near + place.stride
    root = (
        table[near] * (g * h)
        + table[near + 1] * (g * e)
        + table[below] * (f * h)
        + table[below + 1] * (f * e)
    )
    square = root * root
    return square * square


@inlined
def phase_of(half_sine, constituent, table):
    """Phase matrix element of one constituent. [sr⁻¹]

    Parameters
    ----------
    half_sine : float
        sin(θ/2). [1]
    table : lanes, shape (nodes, nc)
        ``phase`` or ``phase_f12`` of the tables.
    """
    u = half_sine * (table.shape[0] - 1)
    node = min(int(u), table.shape[0] - 2)
    f = np.float32(u - node)
    low = table[node, constituent]
    return low + f * (table[node + 1, constituent] - low)


@inlined
def polarised_between(place, half_sine, turn_cosine, turn_sine, view, tables, at):
    """Q and U from the sky-view LUT, with exact phase matrices of separated constituents. [sr⁻¹]

    Parameters
    ----------
    place, half_sine, view, tables, at :
        Arguments of ``air_between``.
    turn_cosine, turn_sine : float
        Results of ``star_plane``. [1]
    """
    phases = lane_view(tables.phase_f12, at)
    peaked = splat(0.0)
    if tables.separated_1 >= 0:
        first = lane_view(view.sky_first, at)
        element = phase_of(half_sine, tables.separated_1, phases)
        peaked = peaked + element * between_texels(first, place)
    if tables.separated_2 >= 0:
        second = lane_view(view.sky_second, at)
        element = phase_of(half_sine, tables.separated_2, phases)
        peaked = peaked + element * between_texels(second, place)
    rest = between_texels(lane_view(view.sky_air, at), place)
    stokes_q = between_texels(lane_view(view.sky_q, at), place) - rest
    stokes_u = between_texels(lane_view(view.sky_u, at), place) - rest
    return stokes_q + peaked * np.float32(turn_cosine), stokes_u + peaked * np.float32(turn_sine)


@inlined
def air_between(place, half_sine, view, tables, at):
    """Radiance from the sky-view LUT, with exact phase functions where separated. [sr⁻¹]

    Parameters
    ----------
    place : TexelPlace
        Place in the LUT.
    half_sine : float
        sin(θ/2) of the angle to the apparent star. [1]
    view, tables : ViewUniforms, MarchTables
        Sky-view LUT, and tables of the solution.
    at : int
        Index of the first lane.
    """
    phases = lane_view(tables.phase, at)
    total = between_texels(lane_view(view.sky_air, at), place)
    if tables.separated_1 >= 0:
        first = lane_view(view.sky_first, at)
        element = phase_of(half_sine, tables.separated_1, phases)
        total = total + element * between_texels(first, place)
    if tables.separated_2 >= 0:
        second = lane_view(view.sky_second, at)
        element = phase_of(half_sine, tables.separated_2, phases)
        total = total + element * between_texels(second, place)
    return total


@inlined
def classify_ray(ray, observer, tables):
    """``ClassifiedRay`` of a direction in the observer's frame; zero outside the projection."""
    sine = sqrt(ray.x * ray.x + ray.y * ray.y)
    shown = ray.x != 0.0 or ray.y != 0.0 or ray.z != 0.0
    if observer.outside:
        impact = observer.r * sine
        inside = shown and ray.z < 0.0 and impact < tables.top
        to_ground = inside and impact < tables.bottom
        row = row_from_impact(impact, tables.bottom, tables.top)
        return ClassifiedRay(sine, row, inside, to_ground)
    angle_up = angle_above_horizon(ray.z, sine, observer.horizon_mu, observer.horizon_sine)
    row = row_from_angle(angle_up, observer.horizon_mu)
    return ClassifiedRay(sine, row, shown, shown and angle_up < 0.0)


@inlined
def sky_view_place(ray, found, window):
    """``TexelPlace`` of a line of sight in a window of the sky-view LUT; ``found`` is its class."""
    last = window.first_column + window.column_count - 1
    azimuth = atan2(abs(ray.y), ray.x) / pi * (window.columns - 1)
    column, right = texel_before(azimuth, window.first_column, last)
    first, count, before = window.first_sky, window.sky_count, 0
    if found.to_ground:
        first, count, before = window.first_ground, window.ground_count, window.sky_count
    line, down = texel_before(found.row * (window.rows - 1), first, first + count - 1)
    near = (before + line - first) * window.column_count + column - window.first_column
    return TexelPlace(near, window.column_count, right, down)


@inlined
def sky_lookup(ray, found, exact, observer, frame, work):
    """Path radiance along a line of sight, and radiance of a white ground behind it.

    Parameters
    ----------
    ray, found : Vec3, ClassifiedRay
        Its direction in the observer's frame, and its classification. [1]
    exact, observer, frame, work :
        Arguments of ``pixel_light``, and the observer; ``work.radiance`` receives results of
        ``look``, Q and U only with a filter, and those of the mirrored sky at ``MIRRORED`` and
        ``FACETS``. [sr⁻¹]

    Returns
    -------
    float
        Refraction angle of a line that ends on the ground. [rad]
    """
    window, view, tables = frame.window, frame.camera, frame.tables
    half_sine = half_sine_between(ray, observer.seen_x, observer.seen_z)
    refraction = 0.0
    wet = found.to_ground and tables.ground.wet
    if exact:
        cos_azimuth = ray.x / found.sine if found.sine > 0.0 else 1.0
        line = SightLine(
            ray.z, found.sine, cos_azimuth, half_sine, found.to_ground, ray, view.pixel_angle
        )
        refraction = look(line, True, False, view.filter > 0, observer, tables, work)
        for at in range(0, tables.lanes, LANES):
            radiance = lane_view(work.radiance, at)
            radiance[MIRRORED] = splat(0.0)
        if wet and observer.orders != 1:
            mu_s, mu_r, nu = ground_angles(ray.x, ray.z, found.sine, refraction, observer, tables)
            end = mirror_place(mu_s, mu_r, nu, 1.0, observer, window)
            mirrored_sky(end, view.sky_air, tables, work)
            mean_facet(end, view.sky_air, tables, work)
    else:
        place = sky_view_place(ray, found, window)
        after = place.near + place.stride * window.ground_count
        below = TexelPlace(after, place.stride, place.right, place.down)
        turn_cosine, turn_sine = 1.0, 0.0
        if view.filter > 0:
            nu = min(max(ray.x * observer.sun_x + ray.z * observer.sun_z, -1.0), 1.0)
            turn_cosine, turn_sine = star_plane(ray.z, observer.sun_z, nu)
        for at in range(0, tables.lanes, LANES):
            radiance = lane_view(work.radiance, at)
            radiance[0] = air_between(place, half_sine, view, tables, at)
            if view.filter > 0:
                radiance[4], radiance[5] = polarised_between(
                    place, half_sine, turn_cosine, turn_sine, view, tables, at
                )
            if found.to_ground:
                radiance[1] = between_texels(lane_view(view.sky_ground, at), place)
            if wet:
                radiance[MIRRORED] = splat(0.0)
                if observer.orders != 1:
                    mirrored = lane_view(view.sky_mirrored, at)
                    radiance[MIRRORED] = between_texels(mirrored, place)
                    radiance[FACETS] = between_texels(mirrored, below)
        if found.to_ground and tables.refraction_strength > 0.0:
            refraction = refraction_to_ground(
                ray.z, found.sine, observer, tables, work.columns_total
            )
    return refraction
