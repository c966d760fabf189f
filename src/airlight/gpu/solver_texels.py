"""What each texel of the solver's passes holds, in restricted Python: for the GPU and for Numba.

A pass fills a flat texture; the functions here find out from an index which radius, ray, star or
moment it belongs to, and leave the rest to the functions of ``solvers.moments`` that the CPU's
loops call too. A function that gives four wavelengths fills a texel, its index counts texels; one
that gives a number fills a quarter of one, its index counts numbers. ``LANES`` is 1 on the GPU.
"""

from __future__ import annotations

from math import sqrt
from typing import Any, Final, NamedTuple

import numpy as np

from airlight.gpu.shown import MOST_CONSTITUENTS, WAVELENGTHS
from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, exponential, load, room_of_lanes, splat
from airlight.solvers.moments.block_rays import ray_share
from airlight.solvers.moments.convergence import is_near
from airlight.solvers.moments.first_order import (
    depth_in_row,
    direct_light,
    fill_phases,
    scattered_once,
)
from airlight.solvers.moments.grid import row_of
from airlight.solvers.moments.harmonics import degree_of, legendre_function
from airlight.solvers.moments.levels import between_levels, cubic_bend, is_smooth
from airlight.solvers.moments.packing import floor_below, ratio_scale
from airlight.solvers.moments.sweep import (
    contracted,
    gathered,
    optical_depth,
    reflected_share,
    sky_at,
    star_at_end,
    star_from_ray,
    strength_of,
)

#: Images that are combined into the next guess.
IMAGES: Final = 5


class Sizes(NamedTuple):
    """How long the axes are.

    Attributes
    ----------
    radii, angles, suns, turns : int
        Radii that gather light; directions in zenith angle; nodes in sun elevation; azimuths.
    degree, terms, constituents, directions : int
        Of the harmonics; how many of them; of the air; of the table of columns.
    levels, parts : int
        Radii of the grid; light is gathered at one of so many of them.
    bottom, top, star_radius : float
        Radii of the ground and the top [m]; angular radius of the star [rad].
    """

    radii: Any
    angles: Any
    suns: Any
    turns: Any
    degree: Any
    terms: Any
    constituents: Any
    directions: Any
    levels: Any
    parts: Any
    bottom: Any
    top: Any
    star_radius: Any


class Tables(NamedTuple):
    """What the host gives to the passes; shapes and units as in ``Grid``, ``Rays``, ``Air`` ….

    Attributes
    ----------
    mu, weight, flux, start, total, end, radius, mu_along, turn, amount, column :
        Of ``Rays``; total and column flat.
    sun_cosines, row, place :
        Of ``Grid``.
    cosines, multiples :
        Of ``Azimuths``.
    harmonic, ahead, back :
        Of ``Harmonics``.
    ratios :
        From ``mean_density_ratios``.
    lift :
        From ``star_lift``.
    level : array, shape (s·4,)
        From ``level_weights``, of four wavelengths.
    extinction, moments, albedo :
        Of ``Air``; four wavelengths a texel.
    """

    mu: Any
    weight: Any
    flux: Any
    start: Any
    total: Any
    end: Any
    radius: Any
    mu_along: Any
    turn: Any
    amount: Any
    column: Any
    sun_cosines: Any
    row: Any
    place: Any
    cosines: Any
    multiples: Any
    harmonic: Any
    ahead: Any
    back: Any
    ratios: Any
    lift: Any
    level: Any
    extinction: Any
    moments: Any
    albedo: Any


@inlined
def strength(index, sizes, tables):
    """Amount of a constituent at a point of a ray times the transmittance from there. [m]

    Texels (point, constituent).
    """
    point, c = index // sizes.constituents, index % sizes.constituents
    depth = optical_depth(
        tables.column, point * sizes.constituents, tables.extinction, sizes.constituents
    )
    return exponential(0.0 - depth) * np.float32(tables.amount[point, c])


@inlined
def factor(index, sizes, tables):
    """What a point sends along its ray of one moment. [1]

    Texels (point, moment).
    """
    point, term = index // sizes.terms, index % sizes.terms
    l = degree_of(term)
    m = term - l * (l + 1) // 2
    depth = optical_depth(
        tables.column, point * sizes.constituents, tables.extinction, sizes.constituents
    )
    scattered = strength_of(
        tables.moments, tables.amount, point, l, sizes.degree, sizes.constituents
    )
    function = legendre_function(
        tables.mu_along[point], l, m, tables.harmonic, tables.ahead, tables.back
    )
    return exponential(0.0 - depth) * scattered * np.float32(function)


@inlined
def share(index, sizes, tables):
    """What makes the sum over the points of a ray exact. [1]

    Texels (radius, direction).
    """
    i, a = index // sizes.angles, index % sizes.angles
    first = int(tables.start[i, a])
    total = optical_depth(
        tables.total, index * sizes.constituents, tables.extinction, sizes.constituents
    )
    return ray_share(
        first,
        int(tables.start[i, a + 1]) - first,
        tables.column,
        tables.amount,
        total,
        tables.extinction,
        sizes.constituents,
    )


@inlined
def reflection(index, sizes, tables):
    """Radiance at the start of a ray per irradiance of the ground at its end. [sr⁻¹]

    Texels (radius, direction); nothing for rays that miss the ground.
    """
    if index % sizes.angles >= sizes.angles // 2:
        return splat(0.0)
    return reflected_share(
        tables.albedo,
        tables.extinction,
        tables.total,
        index * sizes.constituents,
        sizes.constituents,
    )


@inlined
def projection(index, sizes, tables):
    """Weight of a direction in one moment. [1]

    Numbers (radius, direction, moment), and after them (radius, direction): weight in the
    irradiance from above.
    """
    rays = sizes.radii * sizes.angles
    if index >= rays * sizes.terms:
        ray = index - rays * sizes.terms
        return tables.flux[ray // sizes.angles, ray % sizes.angles]
    ray, term = index // sizes.terms, index % sizes.terms
    i, a = ray // sizes.angles, ray % sizes.angles
    l = degree_of(term)
    m = term - l * (l + 1) // 2
    function = legendre_function(tables.mu[i, a], l, m, tables.harmonic, tables.ahead, tables.back)
    return tables.weight[i, a] * function


@inlined
def depth(index, sizes, tables, first_point):
    """Optical depth from a point of a ray to the top of the shell. [1]

    Texels (point, direction); the points of one span of radii, the ground before them.
    """
    local, place = index // sizes.directions, index % sizes.directions
    q = sizes.bottom
    if local > 0:
        q = tables.radius[first_point + local - 1]
    return depth_in_row(
        tables.ratios,
        q,
        place,
        sizes.bottom,
        sizes.top,
        tables.extinction,
        sizes.constituents,
    )


@inlined
def radiance_once(index, sizes, tables, first_point, shares, strengths, reflections, depths):
    """Radiance of a ray by light that is scattered or reflected once. [sr⁻¹]

    Texels (radius, direction, sun, azimuth).
    """
    b = index % sizes.turns
    j = index // sizes.turns % sizes.suns
    ray = index // (sizes.turns * sizes.suns)
    i, a = ray // sizes.angles, ray % sizes.angles
    mu_s = tables.sun_cosines[j]
    nu = star_from_ray(tables.mu[i, a], mu_s, tables.cosines[b])
    first = int(tables.start[i, a])
    points = int(tables.start[i, a + 1]) - first
    phases = room_of_lanes(MOST_CONSTITUENTS)
    fill_phases(tables.moments, nu, sizes.degree, sizes.constituents, phases)
    radiance = load(shares, LANES * ray) * scattered_once(
        tables.turn,
        tables.radius,
        first,
        points,
        first,
        strengths,
        phases,
        sizes.constituents,
        1 + first - first_point,
        depths,
        sizes.directions,
        mu_s,
        nu,
        sizes.bottom,
        sizes.top,
        sizes.star_radius,
        tables.lift,
    )
    if a < sizes.angles // 2:
        at_ground = star_at_end(tables.end, i, a, mu_s, nu)
        radiance = radiance + load(reflections, LANES * ray) * direct_light(
            at_ground,
            sizes.bottom,
            sizes.top,
            sizes.star_radius,
            depths,
            0,
            sizes.directions,
            tables.lift,
        )
    return radiance


@inlined
def row(index, sizes, tables, first_point, factors, packed):
    """Moments at a point of a ray, contracted with what it sends along the ray. [1]

    Texels (point, sun, 2 + N): s, then A_0 s … A_N s; the points of one span of radii.
    """
    block = sizes.degree + 2
    part = index % block
    j = index // block % sizes.suns
    point = first_point + index // (block * sizes.suns)
    x = row_of(tables.radius[point], sizes.bottom, sizes.top, tables.row)
    level = min(int(x), sizes.levels - 2)
    f = np.float32(x - level)
    low = (level * sizes.suns + j) * (1 + sizes.terms) * LANES
    high = low + sizes.suns * (1 + sizes.terms) * LANES
    if part == 0:
        return (np.float32(1.0) - f) * load(packed, low) + f * load(packed, high)
    return contracted(
        factors, LANES * point * sizes.terms, packed, low, high, f, part - 1, sizes.degree
    )


@inlined
def radiance_again(index, sizes, tables, first_point, shares, rows, reflections, ground):
    """Radiance of a ray by light that was scattered or reflected before. [sr⁻¹]

    Texels (radius, direction, sun, azimuth).
    """
    b = index % sizes.turns
    j = index // sizes.turns % sizes.suns
    ray = index // (sizes.turns * sizes.suns)
    i, a = ray // sizes.angles, ray % sizes.angles
    mu_s = tables.sun_cosines[j]
    nu = star_from_ray(tables.mu[i, a], mu_s, tables.cosines[b])
    first = int(tables.start[i, a])
    points = int(tables.start[i, a + 1]) - first
    radiance = load(shares, LANES * ray) * gathered(
        tables.turn,
        tables.mu_along,
        first,
        points,
        first - first_point,
        rows,
        mu_s,
        nu,
        tables.place,
        sizes.suns,
        sizes.degree,
    )
    if a < sizes.angles // 2:
        at_ground = star_at_end(tables.end, i, a, mu_s, nu)
        radiance = radiance + load(reflections, LANES * ray) * sky_at(
            ground, at_ground, tables.place, sizes.suns
        )
    return radiance


@inlined
def azimuthal(index, sizes, tables, radiances):
    """∫ L cos mφ dφ. [sr⁻¹]

    Texels (radius, direction, sun, m).
    """
    m = index % (sizes.degree + 1)
    start = index // (sizes.degree + 1) * sizes.turns
    total = splat(0.0)
    for b in range(sizes.turns):
        total = total + np.float32(tables.multiples[m, b]) * load(radiances, LANES * (start + b))
    return total


@inlined
def gathered_moment(index, sizes, projections, azimuthals):
    """A moment of the light that arrives, or the irradiance of a level surface from above. [1]

    Texels (radius, sun, moment), and after them (radius, sun).
    """
    nodes = sizes.radii * sizes.suns
    width = sizes.degree + 1
    total = splat(0.0)
    if index >= nodes * sizes.terms:
        node = index - nodes * sizes.terms
        i, j = node // sizes.suns, node % sizes.suns
        weights = sizes.radii * sizes.angles * sizes.terms + i * sizes.angles
        for a in range(sizes.angles):
            at = ((i * sizes.angles + a) * sizes.suns + j) * width
            total = total + np.float32(projections[weights + a]) * load(azimuthals, LANES * at)
        return total
    node, term = index // sizes.terms, index % sizes.terms
    i, j = node // sizes.suns, node % sizes.suns
    l = degree_of(term)
    m = term - l * (l + 1) // 2
    for a in range(sizes.angles):
        ray = i * sizes.angles + a
        at = (ray * sizes.suns + j) * width + m
        total = total + np.float32(projections[ray * sizes.terms + term]) * load(
            azimuthals, LANES * at
        )
    return total


@inlined
def gathered_onto(index, sizes, projections, azimuthals, first):
    """``gathered_moment``, the first order added."""
    return load(first, LANES * index) + gathered_moment(index, sizes, projections, azimuthals)


@inlined
def largest_of(index, sizes, count, values):
    """Largest mean radiance, or irradiance, of so many radii under one star. [1]"""
    lane = index % WAVELENGTHS
    j = index // WAVELENGTHS % sizes.suns
    step = sizes.terms * WAVELENGTHS
    start = 0
    if index >= sizes.suns * WAVELENGTHS:
        start = count * sizes.suns * step
        step = WAVELENGTHS
    largest = 0.0
    for i in range(count):
        largest = max(largest, values[start + (i * sizes.suns + j) * step + lane])
    return largest


@inlined
def highest(index, sizes, light):
    """Largest mean radiance, or irradiance, of all radii under one star. [1]

    Numbers (mean radiance or irradiance, sun, lane).
    """
    return largest_of(index, sizes, sizes.radii, light)


@inlined
def highest_level(index, sizes, fine):
    """The same of all levels, from ``refined``. [1]"""
    return largest_of(index, sizes, sizes.levels, fine)


@inlined
def floor(index, sizes, heights):
    """What counts as dark, from ``highest``. [1]

    Numbers (mean radiance or irradiance, lane).
    """
    lane = index % WAVELENGTHS
    first = index // WAVELENGTHS * sizes.suns
    brightest = 0.0
    for j in range(sizes.suns):
        brightest = max(brightest, heights[(first + j) * WAVELENGTHS + lane])
    return floor_below(brightest)


@inlined
def light_number(values, start, step, i, part, dark):
    """A number of a light at a radius; the first of them, a mean radiance, is positive. [1]"""
    value = values[start + i * step]
    if part == 0:
        return max(value, dark)
    return value


@inlined
def four_levels(values, start, step, i, part, dark, radii):
    """A number of a light at two radii, the one below and the one above them. [1]

    The level beyond each end continues the parabola through the last three.
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
    """A light at all levels from the radii that gather it; see ``levels.finer``. [1]

    Numbers (level, sun, moment, lane), and after them irradiances (level, sun, lane).
    """
    lane = index % WAVELENGTHS
    number = index // WAVELENGTHS
    width, start, dark = sizes.terms, 0, floors[lane]
    if number >= sizes.levels * sizes.suns * sizes.terms:
        number = number - sizes.levels * sizes.suns * sizes.terms
        width = 1
        start = sizes.radii * sizes.suns * sizes.terms * WAVELENGTHS
        dark = floors[WAVELENGTHS + lane]
    part = number % width
    j = number // width % sizes.suns
    level = number // (width * sizes.suns)
    i = level // sizes.parts
    step = sizes.suns * width * WAVELENGTHS
    mean_at = start + j * width * WAVELENGTHS + lane
    here = mean_at + part * WAVELENGTHS
    if level % sizes.parts == 0:
        return light_number(light, here, step, i, part, dark)
    x = float(level % sizes.parts) / float(sizes.parts)
    below, near, far, above = four_levels(light, mean_at, step, i, 0, dark, sizes.radii)
    near_scale, far_scale = 1.0 / sqrt(near), 1.0 / sqrt(far)
    smooth = is_smooth(x, near, far, cubic_bend(x, below, near, far, above))
    below, near, far, above = four_levels(light, here, step, i, part, dark, sizes.radii)
    bend = cubic_bend(x, below, near, far, above)
    if not smooth:
        bend = 0.0
    weight = tables.level[j * WAVELENGTHS + lane]
    return between_levels(x, near, far, bend, near_scale, far_scale, weight)


@inlined
def node_scale(index, sizes, tables, fine, heights):
    """The s of a node. [1]

    Numbers (mean radiance or irradiance, level, sun, lane); ``heights`` from ``highest_level``.
    """
    lane = index % WAVELENGTHS
    node = index // WAVELENGTHS
    nodes = sizes.levels * sizes.suns
    if node >= nodes:
        received = fine[(nodes * sizes.terms + node - nodes) * WAVELENGTHS + lane]
        return ratio_scale(received, received, 0.0)
    j = node % sizes.suns
    value = fine[node * sizes.terms * WAVELENGTHS + lane]
    above = max(heights[j * WAVELENGTHS + lane], value)
    return ratio_scale(value, above, tables.level[j * WAVELENGTHS + lane])


@inlined
def packed(index, sizes, fine, scales):
    """Moments and irradiances as ratios: what a march and the next sweep read.

    Texels (level, sun, 1 + moments): s, then the moments times s; after them (level, sun, 2):
    s, then the irradiance times s.
    """
    nodes = sizes.levels * sizes.suns
    moments = nodes * (1 + sizes.terms)
    if index >= moments:
        node = (index - moments) // 2
        scale = load(scales, LANES * (nodes + node))
        if (index - moments) % 2 == 0:
            return scale
        return load(fine, LANES * (nodes * sizes.terms + node)) * scale
    node, part = index // (1 + sizes.terms), index % (1 + sizes.terms)
    scale = load(scales, LANES * node)
    if part == 0:
        return scale
    return load(fine, LANES * (node * sizes.terms + part - 1)) * scale


@inlined
def mean(index, sizes, image, guess):
    """What the host watches: mean radiances and irradiances of an image, and of its guess. [1]

    Texels (image or guess, mean radiance or irradiance, radius, sun).
    """
    nodes = sizes.radii * sizes.suns
    node = index % nodes
    at = node * sizes.terms
    if index // nodes % 2 == 1:
        at = nodes * sizes.terms + node
    if index < 2 * nodes:
        return load(image, LANES * at)
    return load(guess, LANES * at)


@inlined
def mixed(index, weights, images):
    """One number of the combination of images.

    ``weights`` and each of ``images`` are read number by number.
    """
    lane = index % WAVELENGTHS
    return (
        weights[lane] * images.image_0[index]
        + weights[WAVELENGTHS + lane] * images.image_1[index]
        + weights[2 * WAVELENGTHS + lane] * images.image_2[index]
        + weights[3 * WAVELENGTHS + lane] * images.image_3[index]
        + weights[4 * WAVELENGTHS + lane] * images.image_4[index]
    )


@inlined
def sound(index, sizes, weights, images):
    """1 where the combination of images can be trusted, for one wavelength; else 0.

    Numbers (mean radiance or irradiance, radius, sun, lane); ``image_0`` is the last.
    """
    numbers = sizes.radii * sizes.suns * WAVELENGTHS
    lane = index % WAVELENGTHS
    brightest = weights[WAVELENGTHS * IMAGES + lane]
    at = index // WAVELENGTHS * sizes.terms * WAVELENGTHS + lane
    if index >= numbers:
        brightest = weights[WAVELENGTHS * (IMAGES + 1) + lane]
        at = numbers * sizes.terms + index - numbers
    near = is_near(mixed(at, weights, images), images.image_0[at], brightest)
    return 1.0 if near else 0.0


@inlined
def next_guess(index, sizes, weights, images, sounds):
    """The combination of images where it can be trusted, elsewhere the last image.

    Texels as in ``gathered_moment``.
    """
    nodes = sizes.radii * sizes.suns
    node = index // sizes.terms
    if index >= nodes * sizes.terms:
        node = nodes + index - nodes * sizes.terms
    total = load(weights, 0) * load(images.image_0, LANES * index)
    total = total + load(weights, LANES) * load(images.image_1, LANES * index)
    total = total + load(weights, 2 * LANES) * load(images.image_2, LANES * index)
    total = total + load(weights, 3 * LANES) * load(images.image_3, LANES * index)
    total = total + load(weights, 4 * LANES) * load(images.image_4, LANES * index)
    last = load(images.image_0, LANES * index)
    return last + load(sounds, LANES * node) * (total - last)
