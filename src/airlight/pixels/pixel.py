"""The light of one pixel: from the table of the sky or by a march of its own, to linear sRGB."""

from __future__ import annotations

from math import atan2, pi, sqrt
from typing import NamedTuple

import numpy as np

from airlight.color.encoding import encoded
from airlight.color.tone_maps import tone_mapped
from airlight.geometry.shell import first_meeting
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, load, maximum, minimum, room_of_lanes, splat, store
from airlight.mappings.sky_view import angle_above_horizon, row_from_angle, row_from_impact
from airlight.pixels.shown import MOST_CONSTITUENTS
from airlight.pixels.sky_table import half_sine_between, look, phases_towards
from airlight.pixels.star_disc import camera_direction, star_disc
from airlight.scene.ground_place import latitude_longitude, map_color, map_level, moved_on


class Screen(NamedTuple):
    """The camera, the ground's map and the table of the sky; names as in ``gpu.uniforms``."""

    width: float
    height: float
    field_of_view: float
    projection: int
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
    mapped: bool
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
    keeps_peaks: bool
    levels: np.ndarray
    texels: np.ndarray
    sky_air: np.ndarray
    sky_ground: np.ndarray
    sky_first: np.ndarray
    sky_second: np.ndarray


class Display(NamedTuple):
    """How light is shown; names as in ``gpu.uniforms``.

    Attributes
    ----------
    exposure : float
        Factor. [1]
    tone_map : int
        Place in ``TONE_MAPS``.
    encoding : int
        Place in ``ENCODINGS``; -1 for a target that encodes by itself.
    """

    exposure: float
    tone_map: int
    encoding: int


@inlined
def displayed(red, green, blue, display):
    """What a display shows of linear light: exposed, tone-mapped and encoded. [1]

    Parameters
    ----------
    red, green, blue : float
        Linear sRGB. [W m⁻² sr⁻¹]
    display : Display

    Returns
    -------
    red, green, blue : float
        [1]
    """
    red, green, blue = tone_mapped(
        display.tone_map, red * display.exposure, green * display.exposure, blue * display.exposure
    )
    if display.encoding < 0:
        return red, green, blue
    return (
        encoded(display.encoding, red),
        encoded(display.encoding, green),
        encoded(display.encoding, blue),
    )


@inlined
def between_texels(table, columns, rows, row, sky, azimuth):
    """What the table of the sky holds between its texels.

    Parameters
    ----------
    table : array
        A layer of it, of fourth roots.
    columns, rows : int
        As in ``sky_texel``.
    row : float
        Coordinate from the horizon, 0 to 1. [1]
    sky : bool
        Which half.
    azimuth : float
        From the star's vertical plane, in half turns. [1]
    """
    x = min(max(azimuth, 0.0), 1.0) * (columns - 1)
    column = min(int(x), columns - 2)
    e = np.float32(x - column)
    y = row * (rows - 1)
    line = min(int(y), rows - 2)
    f = np.float32(y - line)
    g, h = np.float32(1.0) - f, np.float32(1.0) - e
    near = LANES * ((line if sky else line + rows) * columns + column)
    far = near + LANES * columns
    root = (
        load(table, near) * (g * h)
        + load(table, near + LANES) * (g * e)
        + load(table, far) * (f * h)
        + load(table, far + LANES) * (f * e)
    )
    square = root * root
    return square * square


@inlined
def phase_of(half_sine, constituent, light):
    """Phase function of one constituent, from the table of all. [sr⁻¹]

    Parameters
    ----------
    half_sine : float
        sin(θ/2). [1]
    constituent : int
    light : Shown
        The solution.
    """
    u = half_sine * (light.phase_nodes - 1)
    node = min(int(u), light.phase_nodes - 2)
    f = np.float32(u - node)
    at = LANES * (node * light.constituents + constituent)
    low = load(light.phase, at)
    return low + f * (load(light.phase, at + LANES * light.constituents) - low)


@inlined
def reflectance(x, y, z, sine, impact, cosine, angle, observer, screen, light):
    """Reflectance of the ground where a line of sight ends. [1]

    Parameters
    ----------
    x, y, z : float
        Direction in the observer's frame. [1]
    sine, impact : float
        Of its zenith angle [1]; its line's nearest distance to the centre. [m]
    cosine, angle : float
        Of the slant on the ground [1]; by which the line has been bent. [rad]
    observer, screen, light : Observer, Screen, Shown
    """
    color = np.empty(3)
    across, up = first_meeting(min(impact, light.bottom), sine, light.bottom)
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
    total = splat(0.0)
    for c in range(3):
        total = total + load(light.basis, LANES * c) * np.float32(color[c])
    return minimum(maximum(total, splat(0.0)), splat(1.0))


@inlined
def pixel_light(px, py, exact, observer, screen, light, result):
    """Spectral light of a pixel, per irradiance of the star, into ``result`` (w,). [sr⁻¹]

    Parameters
    ----------
    px, py : float
        From the picture's left and top edge. [pixel]
    exact : bool
        Constant: a march for the pixel itself instead of the table of the sky.
    observer, screen, light : Observer, Screen, Shown
    """
    x, y, z = camera_direction(px, py, screen)
    total = splat(0.0)
    sine = sqrt(x * x + y * y)
    impact = observer.r * sine
    angle_up = angle_above_horizon(z, sine, observer.horizon_mu, observer.horizon_sine)
    to_ground = angle_up < 0.0
    inside = True
    row = row_from_angle(angle_up, observer.horizon_mu)
    if observer.outside:
        inside = z < 0.0 and impact < light.top
        to_ground = inside and impact < light.bottom
        row = row_from_impact(impact, light.bottom, light.top)
    shown = x != 0.0 or y != 0.0 or z != 0.0
    if shown and inside:
        cos_azimuth = x / sine if sine > 0.0 else 1.0
        half_sine = half_sine_between(x, y, z, observer.seen_x, observer.seen_z)
        ground = splat(0.0)
        bent = 0.0
        if exact:
            phase = room_of_lanes(MOST_CONSTITUENTS)
            found = room_of_lanes(4)
            phases_towards(half_sine, True, light, phase)
            bent = look(z, sine, cos_azimuth, to_ground, True, False, observer, light, phase, found)
            total = load(found, 0)
            ground = load(found, LANES)
        else:
            columns, rows = screen.sky_columns, screen.sky_rows
            azimuth = atan2(abs(y), x) / pi
            total = between_texels(screen.sky_air, columns, rows, row, not to_ground, azimuth)
            if to_ground:
                ground = between_texels(screen.sky_ground, columns, rows, row, False, azimuth)
            if light.first_peak >= 0:
                total = total + phase_of(half_sine, light.first_peak, light) * between_texels(
                    screen.sky_first, columns, rows, row, not to_ground, azimuth
                )
            if light.second_peak >= 0:
                total = total + phase_of(half_sine, light.second_peak, light) * between_texels(
                    screen.sky_second, columns, rows, row, not to_ground, azimuth
                )
        if to_ground:
            albedo = load(light.albedo, 0)
            if screen.mapped:
                cosine = sqrt(max((light.bottom - impact) * (light.bottom + impact), 0.0))
                cosine = cosine / light.bottom
                albedo = reflectance(x, y, z, sine, impact, cosine, bent, observer, screen, light)
            total = total + ground * albedo
    if shown and screen.draws_disc and not to_ground:
        total = total + star_disc(px, py, observer, screen, light)
    store(result, 0, total)
