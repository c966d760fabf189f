"""Pixel loops of the CPU, with the sky-view LUT or marched."""

from __future__ import annotations

import numpy as np

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import LANES, lane_view, load, splat
from airlight.kernel.without_refcount import without_refcount
from airlight.render.pixels.ground import GROUND_VALUES
from airlight.render.pixels.pixel import oblate_light, pixel_light
from airlight.render.pixels.samples import sampled_light


@inlined
def as_color(radiance, weights, sums, out):
    """Convert spectral radiance to linear sRGB, into ``out``."""
    red, green, blue = splat(0.0), splat(0.0), splat(0.0)
    for at in range(0, radiance.size, LANES):
        total, weight = load(radiance, at), lane_view(weights, at)
        red = red + total * weight[0]
        green = green + total * weight[1]
        blue = blue + total * weight[2]
    channels = lane_view(sums)
    channels[0], channels[1], channels[2] = red, green, blue
    for c in range(3):
        total = np.float32(0.0)
        for lane in range(LANES):
            total += sums[c, lane]
        out[c] = total


@inlined
def each_pixel(light, exact, px, py, frame, work, weights, out):
    """Body of a loop over pixels.

    Parameters
    ----------
    light, exact :
        Arguments of ``sampled_light``.
    px, py, frame, work, weights, out :
        Arguments of ``render_pixels``; the workspace is that of ``light``.
    """
    frame, work, weights, out = without_refcount((frame, work, weights, out))
    lanes = frame.tables.lanes
    found, total = np.empty(lanes, np.float32), np.empty(lanes, np.float32)
    color = np.zeros(GROUND_VALUES)
    sums = np.empty((3, LANES), np.float32)
    for k in range(px.size):
        sampled_light(px[k], py[k], light, exact, frame, work, color, total, found)
        as_color(found, weights, sums, out[k])


@compiled_loop
def render_pixels(px, py, frame, work, weights, out):
    """Render pixels with the sky-view LUT.

    Parameters
    ----------
    px, py : array, shape (n,)
        Pixel centres, from the left and top edge of the frame. [pixel]
    frame : FrameTables
        What the pixels read.
    work : MarchWorkspace
        Workspace of the thread.
    weights : array, shape (3, w)
        Linear sRGB per radiance over irradiance. [W m⁻² sr⁻¹ sr]
    out : array, shape (n, 3)
        Receives linear sRGB.
    """
    each_pixel(pixel_light, False, px, py, frame, work, weights, out)


@compiled_loop
def march_pixels(px, py, frame, work, weights, out):
    """March pixels, also of oblate planets from outside the air; arguments of ``render_pixels``."""
    each_pixel(oblate_light, True, px, py, frame, work, weights, out)
