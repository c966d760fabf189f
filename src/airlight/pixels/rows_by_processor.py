"""Rows of pixels on the CPU: from the table of the sky, or each pixel by its own march."""

from __future__ import annotations

from math import atan2, pi

import numpy as np

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.borrowing import borrowed
from airlight.kernel.lanes import LANES, load, splat, store
from airlight.pixels.ground import SEEN_NUMBERS, bent_to_ground, ground_factor, ground_seen
from airlight.pixels.pixel import air_between, between_texels, sight, texel_before
from airlight.pixels.sky_table import half_sine_between, look, phases_towards
from airlight.pixels.star_disc import camera_direction, star_disc
from airlight.solvers.moments.source import through_columns


@inlined
def _ground_workspace(constituents):
    """Arrays that ``ground_seen`` fills: colour, columns to the star, and numbers."""
    return np.zeros(3), np.empty(constituents), np.empty(constituents), np.empty(SEEN_NUMBERS)


@inlined
def _finish(
    px, py, x, y, z, sine, through_air, to_ground, bent, air, ground, observer, screen, shown,
    weights, reach, spot, columns, sums, out,
):  # fmt: skip
    """Add the ground and the star's disc to the air of a pixel, and convert it to linear sRGB."""
    lanes = shown.lanes
    part = 0.0
    color, below, above, seen = spot
    if to_ground:
        ground_seen(x, y, z, sine, bent, observer, screen, shown, color, below, above, seen)
    if screen.draws_disc and not to_ground:
        apart = 2.0 * half_sine_between(x, y, z, observer.seen_x, observer.seen_z)
        if apart < reach:
            part = star_disc(px, py, x, y, z, observer, screen, shown, columns)
    red, green, blue = splat(0.0), splat(0.0), splat(0.0)
    for at in range(0, lanes, LANES):
        total = splat(0.0)
        if through_air:
            total = load(air, at)
        if to_ground:
            total = total + load(ground, at) * ground_factor(
                color, screen.mapped, observer.orders, below, above, seen, shown, lanes, at
            )
        if part > 0.0:
            through = through_columns(columns, shown.extinction, shown.constituents, lanes, at)
            total = total + through * np.float32(part)
        red = red + total * load(weights, at)
        green = green + total * load(weights, lanes + at)
        blue = blue + total * load(weights, 2 * lanes + at)
    store(sums, 0, red)
    store(sums, LANES, green)
    store(sums, 2 * LANES, blue)
    for c in range(3):
        total = np.float32(0.0)
        for lane in range(LANES):
            total += sums[LANES * c + lane]
        out[c] = total


@compiled_loop
def draw_rows(first, last, window, observer, screen, shown, weights, reach, out):
    """Draw rows of pixels from the table of the sky.

    Parameters
    ----------
    first, last : int
        Rows ``first`` to ``last`` - 1.
    window : SkyWindow
        Available part of the table.
    observer, screen, shown : Observer, Screen, MarchTables
        Observer, camera with its maps, and tables of the solution.
    weights : array, shape (3·w,)
        Linear sRGB per radiance over irradiance. [W m⁻² sr⁻¹ sr]
    reach : float
        Angle from the apparent star beyond which nothing of its disc is visible. [rad]
    out : array, shape (height, width, 3)
        Receives linear sRGB; pixels that show nothing are not changed.
    """
    screen, shown, weights, out = borrowed((screen, shown, weights, out))
    lanes = shown.lanes
    air, ground = np.empty(lanes, np.float32), np.empty(lanes, np.float32)
    columns, spot = np.empty(shown.constituents), _ground_workspace(shown.constituents)
    sums = np.empty(3 * LANES, np.float32)
    stride = window.last_column - window.first_column + 1
    ground_texels = stride * (window.last_sky - window.first_sky + 1)
    for j in range(first, last):
        for i in range(out.shape[1]):
            px, py = i + 0.5, j + 0.5
            x, y, z = camera_direction(px, py, screen)
            sine, row, through_air, to_ground = sight(x, y, z, observer, shown)
            bent = 0.0
            if through_air:
                half_sine = half_sine_between(x, y, z, observer.seen_x, observer.seen_z)
                column, right = texel_before(
                    atan2(abs(y), x) / pi * (window.columns - 1),
                    window.first_column,
                    window.last_column,
                )
                lowest, highest, start = window.first_sky, window.last_sky, 0
                if to_ground:
                    lowest, highest = window.first_ground, window.last_ground
                    start = ground_texels
                line, down = texel_before(row * (window.rows - 1), lowest, highest)
                near = start + (line - lowest) * stride + column - window.first_column
                for at in range(0, lanes, LANES):
                    value = air_between(
                        near, stride, right, down, half_sine, screen, shown, lanes, at
                    )
                    store(air, at, value)
                    if to_ground:
                        value = between_texels(
                            screen.sky_ground, near, stride, right, down, lanes, at
                        )
                        store(ground, at, value)
                if to_ground and shown.bend > 0.0:
                    bent = bent_to_ground(z, sine, observer, shown, columns)
            _finish(
                px, py, x, y, z, sine, through_air, to_ground, bent, air, ground, observer,
                screen, shown, weights, reach, spot, columns, sums, out[j, i],
            )  # fmt: skip


@compiled_loop
def march_rows(first, last, observer, screen, light, work, weights, reach, out):
    """Draw rows of pixels, each pixel by its own march.

    Parameters
    ----------
    first, last, observer, screen, light, weights, reach, out :
        Arguments of ``draw_rows``.
    work : MarchWorkspace
        Workspace of the thread.
    """
    screen, light, work, weights, out = borrowed((screen, light, work, weights, out))
    lanes = light.lanes
    air = work.found
    ground = np.empty(lanes, np.float32)
    columns, spot = np.empty(light.constituents), _ground_workspace(light.constituents)
    sums = np.empty(3 * LANES, np.float32)
    for j in range(first, last):
        for i in range(out.shape[1]):
            px, py = i + 0.5, j + 0.5
            x, y, z = camera_direction(px, py, screen)
            sine, _, through_air, to_ground = sight(x, y, z, observer, light)
            bent = 0.0
            if through_air:
                cos_azimuth = x / sine if sine > 0.0 else 1.0
                half_sine = half_sine_between(x, y, z, observer.seen_x, observer.seen_z)
                phases_towards(half_sine, True, light, work.phase)
                bent = look(
                    z, sine, cos_azimuth, to_ground, True, False, observer, light, work.phase,
                    work, air,
                )  # fmt: skip
                for at in range(0, lanes, LANES):
                    store(ground, at, load(air, lanes + at))
            _finish(
                px, py, x, y, z, sine, through_air, to_ground, bent, air, ground, observer,
                screen, light, weights, reach, spot, columns, sums, out[j, i],
            )  # fmt: skip
