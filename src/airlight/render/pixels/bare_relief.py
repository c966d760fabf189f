"""Relief of bodies without air that lines of sight meet: mountains on the limb, hills before it.

The line is followed through the heights of ``rolling_ground``, by steps as long as slopes allow.
Past a crest it covers the pixel by how near it comes. Heights are shown to observers far above
them, and where they are wider than pixels; elsewhere the body is a sphere. Lengths are in radii.
"""

from __future__ import annotations

from math import sqrt
from typing import Final, NamedTuple

from airlight.geometry.vectors import Vec3, cross, dot, minus, scaled
from airlight.kernel import compiled_loop, kernel
from airlight.scene.ground_detail import finest_cell
from airlight.scene.rolling_ground import rolling_height

#: Greatest height or depth, and altitudes between which heights begin to be shown. [m]
HIGHEST: Final = 4.5e3
LOW: Final = 10e3
FREE: Final = 40e3
#: Largest number of steps, slope for which they are short enough [1], the least first step [pixel],
#: and ratio of the least successive ones [1].
STEPS: Final = 160
SLOPE: Final = 0.3
LEAST: Final = 0.7
LONGER: Final = 1.03


class Met(NamedTuple):
    """Where a line of sight meets relief.

    Attributes
    ----------
    length : float
        Distance; -1 if it passes. [radius]
    cover : float
        Share of the pixel that is covered. [1]
    leaving : float
        Cosine of emergence from the slope. [1]
    """

    length: float
    cover: float
    leaving: float


@kernel
def relief_shown(power, radius, pixel_angle):
    """Share of the heights of a body that is shown. [1]

    Parameters
    ----------
    power : float
        Squared distance of the centre, less 1. [radius²]
    radius : float
        Radius. [m]
    pixel_angle : float
        Angle of a pixel. [rad]

    Examples
    --------
    >>> relief_shown(0.133, 1.7374e6, 2e-4), relief_shown(5e4, 1.7374e6, 2e-4)
    (1.0, 0.0)
    """
    above = min(max((0.5 * power * radius - LOW) / (FREE - LOW), 0.0), 1.0)
    wide = pixel_angle * sqrt(max(power, 0.0)) * radius
    return above * min(max(HIGHEST / max(wide, 1.0) - 1.0, 0.0), 1.0)


@kernel
def relief_met(ray, centre, power, radius, rows, pixel_angle, high):
    """``Met`` of a line of sight.

    Parameters
    ----------
    ray, centre : Vec3
        Direction [1], and centre of the body from the observer [radius]; in the body-fixed frame.
    power, radius, pixel_angle :
        Arguments of ``relief_shown``.
    rows : float
        Rows of the map.
    high : float
        Share of highlands. [1]
    """
    miss, along = cross(ray, centre), dot(ray, centre)
    across = sqrt(dot(miss, miss))
    shown = relief_shown(power, radius, pixel_angle)
    top = shown * HIGHEST / radius
    if along <= 0.0 or across >= 1.0 + top:
        return Met(-1.0, 0.0, 1.0)
    low, cells = (across - 1.0) * (across + 1.0), radius / finest_cell(radius, rows)
    end = sqrt(max(top * (2.0 + top) - low, 0.0))
    at = -min(end, along)
    before, gap_before, nearest, found = at, 1e9, 1.0, at
    met, leaving, step, least = False, 0.0, 0, LEAST
    while step < STEPS and at <= end and not met:
        square = low + at * at
        altitude = square / (1.0 + sqrt(1.0 + square))
        length = along + at
        point = scaled(minus(scaled(ray, length), centre), cells / (1.0 + altitude))
        pixel = max(pixel_angle * length, 1e-9)
        height = rolling_height(
            point, 2.0 * pixel * cells, altitude * cells / shown, high, radius / cells
        )
        gap = altitude - min(max(shown * height / cells, -top), top)
        if gap <= 0.0:
            met = True
            if gap_before < 1e8:
                share = gap_before / max(gap_before - gap, 1e-12)
                leaving = (gap_before - gap) / max(at - before, 1e-9)
                at = before + (at - before) * share
        else:
            if gap < nearest * pixel:
                nearest, found = gap / pixel, at
            before, gap_before = at, gap
            at += max(gap / (max(-at, 0.0) + SLOPE), least * pixel)
            least *= LONGER
        step += 1
    if met:
        return Met(max(along + at, 0.0), 1.0, max(leaving, abs(at)))
    if nearest < 1.0:
        return Met(along + found, 1.0 - nearest, abs(found))
    return Met(-1.0, 0.0, 1.0)


@compiled_loop
def relief_lines(rays, centre, power, radius, rows, pixel_angle, high, out):
    """``relief_met`` of n lines of sight, for ``out`` of shape (n, 3).

    Parameters
    ----------
    rays, centre : array, shape (n, 3), (3,)
        Arguments of ``relief_met``.
    power, radius, rows, pixel_angle : float
        Arguments of ``relief_met``.
    high : array, shape (n,)
        Shares of highlands. [1]
    """
    middle = Vec3(centre[0], centre[1], centre[2])
    for k in range(high.size):
        ray = Vec3(rays[k, 0], rays[k, 1], rays[k, 2])
        met = relief_met(ray, middle, power, radius, rows, pixel_angle, high[k])
        out[k, 0], out[k, 1], out[k, 2] = met.length, met.cover, met.leaving
