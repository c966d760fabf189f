"""Direction and visibility of the star at the points of a ray, for eight azimuths in the lanes."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.mappings.transmittance import altitude_coordinate
from airlight.geometry.refraction import HIGH
from airlight.geometry.shell import horizon_cosine
from airlight.geometry.sun_disc import visible_fraction, visible_spread
from airlight.kernel import inlined
from airlight.kernel.lanes import (
    floored,
    lane_view,
    largest,
    looked_up,
    maximum,
    minimum,
    splat,
    square_root,
    where_positive,
)

#: Nodes of the table of the visible part of the star's disc.
DISC_NODES: Final = 256

Float32Array = NDArray[np.float32]


class StarNodes(NamedTuple):
    """Stars at the points of a ray, for eight azimuths in the lanes.

    Attributes
    ----------
    columns, shares : array, shape (points, 8)
        Index of the lower sun angle, and weight of the higher. [1]
    steps, sines : array, shape (points, 8)
        Cosine and sine of the azimuth between ray and star. [1]
    """

    columns: Float32Array
    shares: Float32Array
    steps: Float32Array
    sines: Float32Array


class RayPoints(NamedTuple):
    """Points of a ray, as the star is seen from them.

    Attributes
    ----------
    turned : array, shape (points·2,)
        Cosine and sine of the angle by which the star's direction turns. [1]
    places : array, shape (points·7,)
        Radius [m], (top - radius)(top + radius) [m²], shortest distance to the top [m], steps of
        the tabulated directions per distance [m⁻¹]; cosines of the horizon's true and geometric
        zenith angles, and sine of the latter [1].
    lifts : array, shape (points·2·columns,)
        Rows from ``fill_refraction_row``.
    """

    turned: Float32Array
    places: Float32Array
    lifts: Float32Array


class StarPoints(NamedTuple):
    """``star_points`` of the points of a ray, for eight azimuths in the lanes.

    Attributes
    ----------
    seen : array, shape (points, 8)
        Visible part of the star. [1]
    low_at, high_at : array, shape (points, 8)
        Fractional indices of the two directions that represent it. [1]
    kinds : array, shape (points,)
        Number of directions: 0 where the star is hidden, 1 where one suffices, or 2.
    """

    seen: Float32Array
    low_at: Float32Array
    high_at: Float32Array
    kinds: NDArray[np.int64]


@inlined
def place_stars(turned, first_point, points, ahead, aside, mu_s, places, sun_angles, stars):
    """Directions of the star at the points of a ray, for eight azimuths in the lanes.

    The component of the star's direction normal to the plane of the ray is constant; the others
    rotate by the angle at the planet's centre and by the refraction angle.

    Parameters
    ----------
    turned : array, shape (points·2,)
        Cosine and sine of that angle at the points. [1]
    first_point, points : int
        Index of the ray's first point in ``turned``, and number of its points.
    ahead, aside : lanes
        Horizontal components of the star at the start of the ray: along its plane and normal to
        it. [1]
    mu_s : float32
        Cosine of the star's zenith angle there. [1]
    places : array
        ``MomentsGrid.place`` in single precision.
    sun_angles : int
        Number of sun elevations.
    stars : StarNodes
        Receives the stars.
    """
    half = np.float32(0.5 * (places.size - 1))
    nodes, weights = lane_view(stars.columns), lane_view(stars.shares)
    star_cosines, star_sines = lane_view(stars.steps), lane_view(stars.sines)
    for k in range(points):
        keep, turn = turned[2 * (first_point + k)], turned[2 * (first_point + k) + 1]
        cos_star = ahead * turn + keep * mu_s
        along = ahead * keep - turn * mu_s
        x = minimum(maximum((cos_star + np.float32(1.0)) * half, 0.0), np.float32(2.0) * half)
        node = minimum(floored(x), np.float32(places.size - 2))
        low = looked_up(places, node)
        index = low + (looked_up(places, node + np.float32(1.0)) - low) * (x - node)
        node = minimum(floored(index), np.float32(sun_angles - 2))
        nodes[k], weights[k] = node, index - node
        scale = splat(1.0) / square_root(along * along + aside * aside + np.float32(1e-30))
        star_cosines[k], star_sines[k] = along * scale, aside * scale


@inlined
def fill_disc(out):
    """Visible part of the star's disc as a function of elevation over radius, -1 to 1.

    ``out``, shape (3·n,), receives ``visible_fraction``, and the mean elevation of the visible part
    above the centre and its deviation, over the star's radius. [1]
    """
    nodes = out.size // 3
    for k in range(nodes):
        x = 2.0 * k / (nodes - 1) - 1.0
        mean, deviation = visible_spread(x, 1.0)
        out[k] = np.float32(visible_fraction(x, 1.0))
        out[nodes + k] = np.float32(mean - x)
        out[2 * nodes + k] = np.float32(deviation)


@inlined
def fill_refraction_row(refraction_table, q, bottom, top, first, out):
    """Row of the refraction table at a radius, and the true horizon's cosine there. [1]

    ``out`` receives, from ``first`` on, apparent less true cosine, then the flattening, at the
    table's columns; 0 and 1 without refraction.
    """
    columns = max(refraction_table.shape[1], 2)
    horizon = horizon_cosine(q, bottom)
    if refraction_table.shape[0] == 0:
        for k in range(columns):
            out[first + k], out[first + columns + k] = np.float32(0.0), np.float32(1.0)
        return horizon
    x = altitude_coordinate(q, bottom, top) * (refraction_table.shape[0] - 1)
    row = min(int(x), refraction_table.shape[0] - 2)
    f = x - row
    for k in range(columns):
        for part in range(2):
            between = (
                refraction_table[row, k, part] * (1.0 - f) + refraction_table[row + 1, k, part] * f
            )
            out[first + part * columns + k] = np.float32(between)
    return horizon - (refraction_table[row, 0, 0] * (1.0 - f) + refraction_table[row + 1, 0, 0] * f)


@inlined
def place_star_points(along, points, ahead, mu_s, star_radius, columns, disc, directions, stars):
    """``star_points`` at the points of a ray, for eight azimuths in the lanes.

    Parameters
    ----------
    along : RayPoints
        Points of the ray.
    ahead : lanes
        Component of the star along the ray's plane, at its start. [1]
    mu_s : float32
        Cosine of the star's zenith angle there. [1]
    star_radius : float32
        Angular radius of the star; not 0. [rad]
    columns : int
        Columns of the refraction table.
    disc : array
        Table from ``fill_disc``.
    directions : int
        Number of tabulated directions.
    stars : StarPoints
        Receives the star.

    Returns
    -------
    bool
        Whether the star is visible from any point.
    """
    turned, places, lifts = along
    seen, low_at, high_at, kinds = stars
    one = np.float32(1.0)
    nodes = disc.size // 3
    half = np.float32(0.5 * (nodes - 1))
    last = np.float32(directions - 1)
    parts, lows, highs = lane_view(seen), lane_view(low_at), lane_view(high_at)
    lit = False
    for k in range(points):
        cos_star = ahead * turned[2 * k + 1] + turned[2 * k] * mu_s
        q, across = places[7 * k], places[7 * k + 1]
        shortest, scale = places[7 * k + 2], places[7 * k + 3]
        horizon, lowest, sine = places[7 * k + 4], places[7 * k + 5], places[7 * k + 6]
        above = cos_star - horizon
        highest = largest(above)
        kinds[k] = 0
        if highest <= -star_radius * sine:
            continue
        lit = True
        position = minimum(maximum(above, 0.0) / (one - horizon), 1.0)
        position = square_root(position) * np.float32(columns - 1)
        node = minimum(floored(position), np.float32(columns - 2))
        e = position - node
        node = node + np.float32(2 * columns * k)
        low = looked_up(lifts, node)
        raised = low + (looked_up(lifts, node + one) - low) * e
        node = node + np.float32(columns)
        low = looked_up(lifts, node)
        refraction_jacobian = low + (looked_up(lifts, node + one) - low) * e
        middle = minimum(cos_star + raised, 1.0)
        least = 0.0 - largest(0.0 - above)
        kinds[k] = 1
        part = refraction_jacobian
        top_point = middle
        if least <= np.float32(HIGH) * star_radius * sine:
            kinds[k] = 2
            x = minimum(maximum(above / (star_radius * sine), -1.0), 1.0)
            x = (x + one) * half
            node = minimum(floored(x), np.float32(nodes - 2))
            e = x - node
            low = looked_up(disc, node)
            part = refraction_jacobian * (low + (looked_up(disc, node + one) - low) * e)
            # Where the star is high it is seen at its centre.
            near = minimum(maximum((HIGH * star_radius * sine - above) * np.float32(1e9), 0.0), 1.0)
            size = refraction_jacobian * (sine * star_radius) * near
            node = node + np.float32(nodes)
            low = looked_up(disc, node)
            centre = middle + size * (low + (looked_up(disc, node + one) - low) * e)
            node = node + np.float32(nodes)
            low = looked_up(disc, node)
            offset = size * (low + (looked_up(disc, node + one) - low) * e)
            middle = maximum(centre - offset, lowest)
            top_point = minimum(centre + offset, 1.0)
        parts[k] = part
        x = (distance_to_top_f32(middle * q, across) - shortest) * scale
        lows[k] = minimum(maximum(x, 0.0), last)
        x = (distance_to_top_f32(top_point * q, across) - shortest) * scale
        highs[k] = minimum(maximum(x, 0.0), last)
    return lit


@inlined
def distance_to_top_f32(upwards, across):
    """``distance_to_top`` in single precision, from q·mu and (top - q)(top + q)."""
    away = maximum(upwards, 0.0 - upwards)
    far = away + square_root(away * away + across)
    return where_positive(upwards, across / maximum(far, np.float32(1e-30)), far)
