"""Supersampling of pixels on the horizon or the limb.

Only these edges alias: stellar discs have antialiased rims, and air is smooth. Other pixels have
one sample.
"""

from __future__ import annotations

from math import sqrt
from typing import Final

import numpy as np

from airlight.geometry.spheroid import height_above_limb
from airlight.geometry.vectors import Vec3
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, load, store
from airlight.render.pixels.skyline import BEYOND, seen_hill
from airlight.render.pixels.star_disc import camera_direction
from airlight.scene.projections import PROJECTIONS

#: Samples per side of a pixel that an edge crosses.
EDGE: Final = 3
#: Index of the projection that is periodic horizontally.
_PANORAMA: Final = [one.periodic for one in PROJECTIONS.values()].index(True)
#: Distance of a pixel's corner from its centre, with a margin for its shape. [pixel]
_CORNER: Final = 0.75
#: Width of a pixel at the limb over the thickness of the air from which on the pixel above the limb
#: is supersampled too: its air is not smooth. [1]
_COARSE: Final = 0.1


@inlined
def samples_per_side(ray, frame, color):
    """Samples per side of a pixel: at least ``EDGE`` on the horizon and on the skyline of hills.

    Of the lines of sight of its lower and upper corner one meets land, the other none; in pixels
    wider than the scale height of air the lower one is that of the pixel below.

    Parameters
    ----------
    ray : Vec3
        Viewing direction of its centre. [1]
    frame, color : FrameTables, array
        Arguments of ``seen_hill``.
    """
    observer, view = frame.observer, frame.camera
    side = view.samples
    sine = sqrt(ray.x * ray.x + ray.y * ray.y)
    if view.edges and ray.z * observer.horizon_mu + sine * observer.horizon_sine > 0.0:
        lower, thickness = -_CORNER, frame.tables.top - frame.tables.bottom
        if -view.pixel_angle * observer.r * observer.horizon_mu > _COARSE * thickness:
            lower -= 1.0
        for corner in range(2):
            moved = (_CORNER if corner == 0 else lower) * view.pixel_angle
            keep = 1.0 - moved * ray.z / max(sine, view.pixel_angle)
            end, _ = seen_hill(Vec3(ray.x * keep, ray.y * keep, ray.z + moved * sine), frame, color)
            level = sqrt(end.x * end.x + end.y * end.y)
            above = end.z * observer.horizon_sine - level * observer.horizon_mu
            if observer.outside and observer.flattening > 0.0:
                above = height_above_limb(
                    end, observer.r, observer.ground_z, observer.flattening, frame.tables.bottom
                )
            if above < 0.0:
                # below an upper corner on land there is land, too
                if corner == 1:
                    side = max(view.samples, EDGE)
                break
    return side


@inlined
def sample_place(px, py, sample, side, view):
    """Position of a sample, from the left and top edge of the frame. [pixel]

    The grid is rotated by atan(1 / side), so that no two samples share a row or column and a level
    horizon has side² steps. The rotation is mirrored in the right half of the frame, which keeps
    symmetric skies symmetric, and absent in panoramas.

    Parameters
    ----------
    px, py : float
        Centre of the pixel. [pixel]
    sample, side : int
        Index of the sample, and samples per side.
    view : ViewUniforms
        Camera.
    """
    hand = 1.0 if px < 0.5 * view.width else -1.0
    if view.projection == _PANORAMA:
        hand = 0.0
    step = 1.0 / side
    down = sample // side
    across = sample - side * down
    row, column = (down + 0.5) * step - 0.5, (across + 0.5) * step - 0.5
    return px + column - hand * row * step, py + row + hand * column * step


@inlined
def light_of_centre(px, py, light, exact, frame, work, color, result):
    """Spectral radiance of a pixel with one sample; arguments of ``sampled_light``."""
    ray, beyond = seen_hill(camera_direction(px, py, frame.camera), frame, color)
    color[BEYOND] = beyond
    light(px, py, ray, beyond, exact, frame, work, color, result)


@inlined
def sampled_light(px, py, light, exact, frame, work, color, total, result):
    """Spectral radiance of a pixel, averaged over samples, per irradiance of the star. [sr⁻¹]

    Parameters
    ----------
    px, py : float
        Pixel centre, from the left and top edge of the frame. [pixel]
    light : inlined function
        Constant: ``pixel_light``, or a function with the same arguments.
    exact, frame, work, color :
        Its arguments.
    total : array, shape (w,)
        Workspace.
    result : array, shape (w,)
        Receives the radiance. [sr⁻¹]
    """
    view, tables = frame.camera, frame.tables
    side = samples_per_side(camera_direction(px, py, view), frame, color)
    step = 1.0 / side
    for sample in range(side * side):
        sx, sy = px, py
        if side > 1:
            sx, sy = sample_place(px, py, sample, side, view)
        ray, beyond = seen_hill(camera_direction(sx, sy, view), frame, color)
        color[BEYOND] = beyond
        light(sx, sy, ray, beyond, exact, frame, work, color, result)
        if side > 1:
            for at in range(0, tables.lanes, LANES):
                share = load(result, at) * np.float32(step * step)
                if sample > 0:
                    share = share + load(total, at)
                store(total, at, share)
    if side > 1:
        for at in range(0, tables.lanes, LANES):
            store(result, at, load(total, at))
