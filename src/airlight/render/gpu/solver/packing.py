"""Kernels that pack a radiance field: refinement to all radii, and rational interpolation.

``rays`` defines the index.
"""

from __future__ import annotations

from math import sqrt

from airlight.kernel import inlined
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.solver.moments.levels import between_levels, cubic_bend, smoothness
from airlight.solver.moments.packing import floor_below, rational_scale


@inlined
def largest_of(index, sizes, count, values):
    """Largest mean radiance, or irradiance, of ``count`` radii under one star. [1]

    Parameters
    ----------
    index : int
        Index of a number (mean radiance or irradiance, sun, lane).
    values : array
        Moments (radius, sun, moment, lane), and after them irradiances. [1]
    """
    lane = index % WAVELENGTHS
    j = index // WAVELENGTHS % sizes.sun_angles
    step = sizes.terms * WAVELENGTHS
    start = 0
    if index >= sizes.sun_angles * WAVELENGTHS:
        start = count * sizes.sun_angles * step
        step = WAVELENGTHS
    largest = 0.0
    for i in range(count):
        largest = max(largest, values[start + (i * sizes.sun_angles + j) * step + lane])
    return largest


@inlined
def highest(index, sizes, light):
    """Largest mean radiance, or irradiance, of all gathering radii under one star. [1]

    Indices of the element: (mean radiance or irradiance, sun, lane).
    """
    return largest_of(index, sizes, sizes.radii, light)


@inlined
def highest_level(index, sizes, fine):
    """Largest mean radiance, or irradiance, of all levels, from ``refined``. [1]"""
    return largest_of(index, sizes, sizes.levels, fine)


@inlined
def floor(index, sizes, heights):
    """Threshold of darkness, from ``highest``. [1]

    Indices of the element: (mean radiance or irradiance, lane).
    """
    lane = index % WAVELENGTHS
    first = index // WAVELENGTHS * sizes.sun_angles
    brightest = 0.0
    for j in range(sizes.sun_angles):
        brightest = max(brightest, heights[(first + j) * WAVELENGTHS + lane])
    return floor_below(brightest)


@inlined
def light_number(values, start, step, i, part, dark):
    """Component of a radiance field at a radius; mean radiance and irradiance are positive. [1]

    Parameters
    ----------
    values : array
        Numbers as in ``largest_of``. [1]
    start, step : int
        Index of the component at radius 0, and step from radius to radius.
    part : int
        Moment; 0 for mean radiances and irradiances.
    dark : float
        Threshold of darkness. [1]
    """
    value = values[start + i * step]
    if part == 0:
        return max(value, dark)
    return value


@inlined
def four_levels(values, start, step, i, part, dark, radii):
    """Component of a radiance field at two adjacent radii and at the ones below and above. [1]

    The level beyond each end continues the parabola through the last three.

    Parameters
    ----------
    values, start, step, part, dark :
        Arguments of ``light_number``.
    i : int
        Index of the lower of the two radii.
    radii : int
        Number of radii, at least three.

    Returns
    -------
    below, near, far, above : float
        Components at four successive radii. [1]
    """
    near = light_number(values, start, step, i, part, dark)
    far = light_number(values, start, step, i + 1, part, dark)
    below = light_number(values, start, step, max(i - 1, 0), part, dark)
    above = light_number(values, start, step, min(i + 2, radii - 1), part, dark)
    if i == 0:
        below = 3.0 * (near - far) + above
    if i == radii - 2:
        above = 3.0 * (far - near) + below
    return below, near, far, above


@inlined
def refined(index, sizes, tables, light, floors):
    """Radiance field at all levels from the radii of the sweep; see ``levels.refine``. [1]

    Elements: moments (level, sun, moment, lane), then irradiances (level, sun, lane).
    """
    lane = index % WAVELENGTHS
    number = index // WAVELENGTHS
    width, start, dark = sizes.terms, 0, floors[lane]
    if number >= sizes.levels * sizes.sun_angles * sizes.terms:
        number = number - sizes.levels * sizes.sun_angles * sizes.terms
        width = 1
        start = sizes.radii * sizes.sun_angles * sizes.terms * WAVELENGTHS
        dark = floors[WAVELENGTHS + lane]
    part = number % width
    j = number // width % sizes.sun_angles
    level = number // (width * sizes.sun_angles)
    i = level // sizes.refinement
    step = sizes.sun_angles * width * WAVELENGTHS
    mean_at = start + j * width * WAVELENGTHS + lane
    first_of_moment = mean_at + part * WAVELENGTHS
    if level % sizes.refinement == 0:
        return light_number(light, first_of_moment, step, i, part, dark)
    x = float(level % sizes.refinement) / float(sizes.refinement)
    below, near, far, above = four_levels(light, mean_at, step, i, 0, dark, sizes.radii)
    near_scale, far_scale = 1.0 / sqrt(near), 1.0 / sqrt(far)
    refinement = float(sizes.refinement)
    share = smoothness(x, near, far, cubic_bend(x, below, near, far, above, refinement))
    below, near, far, above = four_levels(light, first_of_moment, step, i, part, dark, sizes.radii)
    bend = share * cubic_bend(x, below, near, far, above, refinement)
    weight = tables.level[j * WAVELENGTHS + lane]
    return between_levels(x, near, far, bend, near_scale, far_scale, weight)


@inlined
def node_scale(index, sizes, tables, fine, heights):
    """Scale s of a node. [1]

    Numbers (mean radiance or irradiance, level, sun, lane); ``heights`` from ``highest_level``.
    """
    lane = index % WAVELENGTHS
    node = index // WAVELENGTHS
    nodes = sizes.levels * sizes.sun_angles
    if node >= nodes:
        received = fine[(nodes * sizes.terms + node - nodes) * WAVELENGTHS + lane]
        return rational_scale(received, received, 0.0)
    j = node % sizes.sun_angles
    value = fine[node * sizes.terms * WAVELENGTHS + lane]
    above = max(heights[j * WAVELENGTHS + lane], value)
    return rational_scale(value, above, tables.level[j * WAVELENGTHS + lane])


@inlined
def packed(index, sizes, fine, scales):
    """Moments and irradiances in the form of rational interpolation, for march and next sweep.

    Texels (level, sun, 1 + moments): s, then the moments times s; after them (level, sun, 2):
    s, then the irradiance times s.
    """
    nodes = sizes.levels * sizes.sun_angles
    moments = nodes * (1 + sizes.terms)
    if index >= moments:
        node = (index - moments) // 2
        scale = scales[nodes + node]
        if (index - moments) % 2 == 0:
            return scale
        return fine[nodes * sizes.terms + node] * scale
    node, part = index // (1 + sizes.terms), index % (1 + sizes.terms)
    scale = scales[node]
    if part == 0:
        return scale
    return fine[node * sizes.terms + part - 1] * scale
