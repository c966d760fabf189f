"""Spectral radiance of one pixel, from the sky-view LUT or marched."""

from __future__ import annotations

from math import atan2, pi, sqrt
from typing import Annotated, NamedTuple

import numpy as np

from airlight.geometry.mappings.sky_view import angle_above_horizon, row_from_angle, row_from_impact
from airlight.kernel import inlined, kernel
from airlight.kernel.lanes import LANES, lane_view, load, splat, store
from airlight.kernel.shader_fields import CHOICE, InTexture
from airlight.render.pixels.disc_shading import darkened
from airlight.render.pixels.ground import ground_factor, ground_reflectances, lamp_light
from airlight.render.pixels.ground_angles import columns_to_ground, refraction_to_ground
from airlight.render.pixels.polarising_filter import filter_shares
from airlight.render.pixels.sky_view_lut import half_sine_between, look
from airlight.render.pixels.star_disc import star_disc
from airlight.solver.moments.march_tables import MIRRORED
from airlight.solver.moments.source import transmittance_columns
from airlight.solver.stokes_frame import star_plane


class ViewUniforms(NamedTuple):
    """Camera, ground maps, sky-view LUT and discs: uniforms and textures of a pixel."""

    width: float
    height: float
    field_of_view: float
    projection: Annotated[int, CHOICE]
    right_x: float
    right_y: float
    right_z: float
    up_x: float
    up_y: float
    up_z: float
    forward_x: float
    forward_y: float
    forward_z: float
    pixel_angle: float
    disc: float
    draws_disc: bool
    draws_air: bool
    phased: bool
    phase_sine: float
    phase_cosine: float
    phase_share: float
    limb_x: float
    limb_y: float
    limb_z: float
    occulter_x: float
    occulter_y: float
    occulter_z: float
    occulter_radius: float
    samples: Annotated[int, CHOICE]
    edges: bool
    mapped: bool
    map_rows: int
    map_columns: int
    map_levels: int
    xx: float
    xy: float
    xz: float
    yx: float
    yy: float
    yz: float
    zx: float
    zy: float
    zz: float
    sky_columns: int
    sky_rows: int
    separated_phases: bool
    overlaid: bool
    clouded: bool
    cloud_altitude: float
    cloud_radius: float
    detailed: bool
    detail_cell: float
    whole_x: float
    whole_y: float
    whole_z: float
    part_x: float
    part_y: float
    part_z: float
    over_rows: int
    over_columns: int
    over_levels: int
    lamp_red: float
    lamp_green: float
    lamp_blue: float
    filter: Annotated[int, CHOICE]
    filter_x: float
    filter_y: float
    filter_z: float
    texels: Annotated[np.ndarray, InTexture("ground", packed=True)]
    over_texels: Annotated[np.ndarray, InTexture("overlay", packed=True)]
    sky_air: Annotated[np.ndarray, InTexture("air", spectral=True, whole=True)]
    sky_ground: Annotated[np.ndarray, InTexture("behind", spectral=True, whole=True)]
    sky_first: Annotated[np.ndarray, InTexture("first", spectral=True, whole=True)]
    sky_second: Annotated[np.ndarray, InTexture("second", spectral=True, whole=True)]
    sky_q: Annotated[np.ndarray, InTexture("stokes_q", spectral=True, whole=True)]
    sky_u: Annotated[np.ndarray, InTexture("stokes_u", spectral=True, whole=True)]


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
def between_texels(table, near, stride, right, down):
    """Bilinear interpolation of a layer of the sky-view LUT.

    Parameters
    ----------
    table : lanes, shape (texels,)
        Layer of fourth roots.
    near, stride : int
        Index of the first of the four texels, and texels per row.
    right, down : float
        Fractions of the distance to the next texel and to the next row. [1]
    """
    e, f = np.float32(right), np.float32(down)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    below = near + stride
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
def polarised_between(
    near, stride, right, down, half_sine, turn_cosine, turn_sine, view, tables, at
):  # fmt: skip
    """Q and U from the sky-view LUT, with exact phase matrices of separated constituents. [sr⁻¹]

    Parameters
    ----------
    near, stride, right, down, half_sine, view, tables, at :
        Arguments of ``air_between``.
    turn_cosine, turn_sine : float
        Results of ``star_plane``. [1]
    """
    phases = lane_view(tables.phase_f12, at)
    peaked = splat(0.0)
    if tables.separated_1 >= 0:
        first = lane_view(view.sky_first, at)
        element = phase_of(half_sine, tables.separated_1, phases)
        peaked = peaked + element * between_texels(first, near, stride, right, down)
    if tables.separated_2 >= 0:
        second = lane_view(view.sky_second, at)
        element = phase_of(half_sine, tables.separated_2, phases)
        peaked = peaked + element * between_texels(second, near, stride, right, down)
    rest = between_texels(lane_view(view.sky_air, at), near, stride, right, down)
    stokes_q = between_texels(lane_view(view.sky_q, at), near, stride, right, down) - rest
    stokes_u = between_texels(lane_view(view.sky_u, at), near, stride, right, down) - rest
    return stokes_q + peaked * np.float32(turn_cosine), stokes_u + peaked * np.float32(turn_sine)


@inlined
def air_between(near, stride, right, down, half_sine, view, tables, at):
    """Radiance from the sky-view LUT, with exact phase functions where separated. [sr⁻¹]

    Parameters
    ----------
    near, stride, right, down :
        Arguments of ``between_texels``.
    half_sine : float
        sin(θ/2) of the angle to the apparent star. [1]
    view, tables : ViewUniforms, MarchTables
        Sky-view LUT, and tables of the solution.
    at : int
        Index of the first lane.
    """
    phases = lane_view(tables.phase, at)
    total = between_texels(lane_view(view.sky_air, at), near, stride, right, down)
    if tables.separated_1 >= 0:
        first = lane_view(view.sky_first, at)
        element = phase_of(half_sine, tables.separated_1, phases)
        total = total + element * between_texels(first, near, stride, right, down)
    if tables.separated_2 >= 0:
        second = lane_view(view.sky_second, at)
        element = phase_of(half_sine, tables.separated_2, phases)
        total = total + element * between_texels(second, near, stride, right, down)
    return total


@inlined
def classify_ray(x, y, z, observer, tables):
    """Classification of a line of sight, and its row in the sky-view LUT.

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame; zero outside the projection. [1]
    observer, tables : Observer, MarchTables
        Observer, and tables of the solution.

    Returns
    -------
    sine, row : float
        Sine of the zenith angle; row coordinate in its half of the LUT. [1]
    through_air, to_ground : bool
        Whether it crosses the atmosphere, and whether it ends on the ground.
    """
    sine = sqrt(x * x + y * y)
    shown = x != 0.0 or y != 0.0 or z != 0.0
    if observer.outside:
        impact = observer.r * sine
        inside = shown and z < 0.0 and impact < tables.top
        to_ground = inside and impact < tables.bottom
        return sine, row_from_impact(impact, tables.bottom, tables.top), inside, to_ground
    angle_up = angle_above_horizon(z, sine, observer.horizon_mu, observer.horizon_sine)
    row = row_from_angle(angle_up, observer.horizon_mu)
    return sine, row, shown, shown and angle_up < 0.0


@inlined
def sky_view_coordinates(x, y, row, to_ground, window):
    """Texel coordinates of a line of sight in a window of the sky-view LUT.

    Parameters
    ----------
    x, y : float
        Horizontal components of its direction in the observer's frame. [1]
    row, to_ground : float, bool
        Results of ``classify_ray``.

    Returns
    -------
    near : int
        Index of the first of the four texels.
    right, down : float
        Fractions of the distance to the next texel and to the next row. [1]
    """
    last = window.first_column + window.column_count - 1
    azimuth = atan2(abs(y), x) / pi * (window.columns - 1)
    column, right = texel_before(azimuth, window.first_column, last)
    first, count, before = window.first_sky, window.sky_count, 0
    if to_ground:
        first, count, before = window.first_ground, window.ground_count, window.sky_count
    line, down = texel_before(row * (window.rows - 1), first, first + count - 1)
    near = (before + line - first) * window.column_count + column - window.first_column
    return near, right, down


@inlined
def sky_lookup(
    x, y, z, sine, row, to_ground, exact, window, observer, view, tables, work
):  # fmt: skip
    """Path radiance along a line of sight, and radiance of a white ground behind it.

    Parameters
    ----------
    x, y, z : float
        Its direction in the observer's frame. [1]
    sine, row, to_ground : float, float, bool
        Results of ``classify_ray``.
    exact, window, observer, view, tables, work :
        Arguments of ``pixel_light``; ``work.radiance`` receives path radiance, radiance of a white
        Lambert ground, of the mirrored sky at ``MIRRORED`` and, with a filter, Q and U as from
        ``march``. [sr⁻¹]

    Returns
    -------
    float
        Refraction angle of a line that ends on the ground. [rad]
    """
    half_sine = half_sine_between(x, y, z, observer.seen_x, observer.seen_z)
    refraction = 0.0
    wet = to_ground and tables.ground.wet
    if exact:
        cos_azimuth = x / sine if sine > 0.0 else 1.0
        # The mirrored sky first, as the second march leaves its results in place.
        for part in range(2):
            mirrored = part == 0
            if not mirrored or (wet and observer.orders != 1):
                refraction = look(
                    z, sine, cos_azimuth, half_sine, to_ground, mirrored, True, True, False,
                    view.filter > 0, observer, tables, work, work.radiance,
                )  # fmt: skip
            if mirrored:
                for at in range(0, tables.lanes, LANES):
                    found = lane_view(work.radiance, at)
                    found[MIRRORED] = splat(0.0)
                    if wet and observer.orders != 1:
                        found[MIRRORED] = found[0]
    else:
        near, right, down = sky_view_coordinates(x, y, row, to_ground, window)
        turn_cosine, turn_sine = 1.0, 0.0
        if view.filter > 0:
            nu = min(max(x * observer.sun_x + z * observer.sun_z, -1.0), 1.0)
            turn_cosine, turn_sine = star_plane(z, observer.sun_z, nu)
        for at in range(0, tables.lanes, LANES):
            found = lane_view(work.radiance, at)
            found[0] = air_between(
                near, window.column_count, right, down, half_sine, view, tables, at
            )
            if view.filter > 0:
                found[4], found[5] = polarised_between(
                    near,
                    window.column_count,
                    right,
                    down,
                    half_sine,
                    turn_cosine,
                    turn_sine,
                    view,
                    tables,
                    at,
                )
            if to_ground:
                layer = lane_view(view.sky_ground, at)
                found[1] = between_texels(layer, near, window.column_count, right, down)
            if wet:
                mirror = lane_view(view.sky_air, at)
                found[MIRRORED] = between_texels(
                    mirror, near + window.ground_count * window.column_count,
                    window.column_count, right, down,
                )  # fmt: skip
        if to_ground and tables.refraction_strength > 0.0:
            refraction = refraction_to_ground(z, sine, observer, tables, work.columns_total)
    return refraction


@inlined
def pixel_light(
    px, py, x, y, z, exact, reach, window, observer, view, tables, work, color, result
):  # fmt: skip
    """Spectral radiance of a pixel, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    px, py : float
        Position from the left and top edge of the frame. [pixel]
    x, y, z : float
        Viewing direction there, ``camera_direction``. [1]
    exact : bool
        Constant: whether the pixel is marched.
    reach : float
        Largest angle between the apparent star and a visible point of its disc. [rad]
    window : SkyViewWindow
        Window of the sky-view LUT.
    observer, view, tables : Observer, ViewUniforms, MarchTables
        Observer, camera with its maps, and tables of the solution.
    work, color : MarchWorkspace, array of shape (11,)
        Workspace.
    result : array, shape (w,)
        Receives the radiance. [sr⁻¹]
    """
    sine, row, through_air, to_ground = classify_ray(x, y, z, observer, tables)
    through_air = through_air and view.draws_air
    star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored = 1.0, 0.0, 1.0, 0.0, 0.0
    if through_air:
        refraction = sky_lookup(
            x, y, z, sine, row, to_ground, exact, window, observer, view, tables, work
        )
        if to_ground:
            star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored = ground_reflectances(
                x, y, z, sine, refraction, observer, view, tables, work, color
            )
            if view.overlaid:
                columns_to_ground(
                    z, sine, observer, tables, work.columns_total, work.columns_so_far
                )
    whole, stokes_q, stokes_u = 1.0, 0.0, 0.0
    if view.filter > 0:
        whole, stokes_q, stokes_u = filter_shares(x, y, z, view)
    for at in range(0, tables.lanes, LANES):
        found = lane_view(work.radiance, at)
        total = splat(0.0)
        if through_air:
            total = found[0]
        if to_ground and view.draws_air:
            factor = ground_factor(
                color, view, star_diffuse, star_specular, sky_diffuse, sky_specular, mirrored,
                tables, work, at,
            )  # fmt: skip
            total = total + found[1] * factor
            if view.overlaid:
                total = total + lamp_light(color, view, tables, work.columns_total, at)
        if view.filter > 0:
            total = total * np.float32(whole)
            if through_air:
                total = total + found[4] * np.float32(stokes_q)
                total = total + found[5] * np.float32(stokes_u)
        store(result, at, total)
    if view.draws_disc and not to_ground:
        apart = 2.0 * half_sine_between(x, y, z, observer.seen_x, observer.seen_z)
        p0, p1, p2, p3, p4, p5 = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
        if apart < reach:
            p0, p1, p2, p3, p4, p5 = star_disc(
                px, py, x, y, z, observer, view, tables, work.columns_total
            )
        if p0 > 0.0:
            for at in range(0, tables.lanes, LANES):
                transmittance = transmittance_columns(
                    work.columns_total, lane_view(tables.extinction, at), tables.constituents
                )
                disc = darkened(p0, p1, p2, p3, p4, p5, tables, at)
                store(result, at, load(result, at) + transmittance * disc * np.float32(whole))
