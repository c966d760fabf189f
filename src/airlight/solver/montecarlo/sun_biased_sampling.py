"""Sun-biased sampling of points along a ray: importance sampling for twilight.

With a low star most of a ray lies in the planet's shadow. Half of the points of a history's first
events (``events.MAX_BIASED_EVENTS``) are then drawn in proportion to single scattering: extinction
times transmittance times direct irradiance. The latter comes from a coarse table, which affects
only the variance: the weight of a point is the ratio of the unbiased density to the mixture of both
(the balance heuristic of Veach & Guibas 1995, doi:10.1145/218380.218498), at most 2.
"""

from __future__ import annotations

from math import exp, sqrt
from typing import Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.shell import horizon_cosine
from airlight.kernel import compiled_loop, inlined
from airlight.solver.montecarlo.rays import (
    Extinction,
    depth_within,
    most_panels,
    new_trace,
    trace_optical_depth,
)

FloatArray = NDArray[np.float64]

#: Numbers of altitudes and elevations of the coarse table.
_HEIGHTS: Final = 40
_ELEVATIONS: Final = 80


class StarTransmittance(NamedTuple):
    """Coarse table of the transmittance to the star.

    Attributes
    ----------
    bottom, thickness : float
        Radius of the ground and thickness of the shell. [m]
    values : array, shape (_HEIGHTS, _ELEVATIONS)
        Transmittance to space over the square roots of altitude and of the cosine's excess over
        the horizon's. [1]
    """

    bottom: float
    thickness: float
    values: FloatArray


class SamplingDensity(NamedTuple):
    """Sampling density along a ray, piecewise around its quadrature points.

    Attributes
    ----------
    mass : array, shape (p, n)
        Unnormalised probability of the piece around each point of each panel.
    depth : array, shape (p, n)
        Optical depth from the panel's start to each point.
    before : array, shape (p,)
        Optical depth from the ray's start to each panel's.
    """

    mass: FloatArray
    depth: FloatArray
    before: FloatArray


def new_sampling_density(extinction: Extinction) -> SamplingDensity:
    """Workspace of one ray."""
    panels, nodes = most_panels(extinction), extinction.nodes.size
    return SamplingDensity(np.empty((panels, nodes)), np.empty((panels, nodes)), np.empty(panels))


def star_transmittance_table(extinction: Extinction) -> StarTransmittance:
    """Table of the transmittance to the star at one wavelength."""
    values = np.empty((_HEIGHTS, _ELEVATIONS))
    _fill(extinction, new_trace(extinction), values)
    return StarTransmittance(extinction.bottom, extinction.top - extinction.bottom, values)


@compiled_loop
def _fill(extinction, path, values):
    bottom, thickness = extinction.bottom, extinction.top - extinction.bottom
    for i in range(values.shape[0]):
        x = i / (values.shape[0] - 1.0)
        r = bottom + thickness * x * x * 0.9999
        horizon = horizon_cosine(r, bottom)
        for j in range(values.shape[1]):
            e = j / (values.shape[1] - 1.0)
            mu = min(horizon + (1.0 - horizon) * e * e, 1.0)
            values[i, j] = exp(-trace_optical_depth(r, mu, False, extinction, path)[1])


@inlined
def _star_transmittance(r, mu_s, star_transmittance):
    horizon = horizon_cosine(r, star_transmittance.bottom)
    excess = mu_s - horizon
    if excess <= 0.0:
        return 0.0
    x = sqrt(min(max((r - star_transmittance.bottom) / star_transmittance.thickness, 0.0), 1.0)) * (
        _HEIGHTS - 1
    )
    e = sqrt(min(excess / (1.0 - horizon), 1.0)) * (_ELEVATIONS - 1)
    i, j = min(int(x), _HEIGHTS - 2), min(int(e), _ELEVATIONS - 2)
    f, g = x - i, e - j
    below = star_transmittance.values[i, j] * (1.0 - g) + star_transmittance.values[i, j + 1] * g
    above = (
        star_transmittance.values[i + 1, j] * (1.0 - g)
        + star_transmittance.values[i + 1, j + 1] * g
    )
    return below * (1.0 - f) + above * f


@compiled_loop
def sun_sampling_integral(r, mu, mu_s, nu, count, extinction, star_transmittance, path, sampling):
    """Integral of the sun-biased sampling density along a traced ray, by pieces.

    Parameters
    ----------
    r, mu, mu_s, nu : float
        Radius of the ray's start, and cosines of its zenith angle, of the star's, and of the angle
        between them. [m], [1]
    count : int
        Number of panels, from ``trace_optical_depth``.
    sampling : SamplingDensity
        Receives the pieces.

    Returns
    -------
    float
        Sum of the masses; 0 in complete shadow.
    """
    nodes, weights, running = extinction.nodes, extinction.weights, extinction.running
    n = nodes.size
    depth, total = 0.0, 0.0
    for at in range(count):
        sampling.before[at] = depth
        panel, values = path.panels[at], path.values[at]
        for k in range(n):
            within = 0.0
            for j in range(n):
                within += running[k, j] * values[j]
            within = max(within, sampling.depth[at, k - 1] if k > 0 else 0.0)
            sampling.depth[at, k] = within
            y = panel[3] + (panel[4] - panel[3]) * nodes[k]
            square = y * y
            away = sqrt(panel[1] * panel[1] + square * (2.0 * panel[0] + square))
            q = panel[0] + square
            mu_s_point = (r * mu_s + (-r * mu + panel[2] * away) * nu) / q
            mass = (
                weights[k]
                * values[k]
                * exp(-depth - within)
                * _star_transmittance(q, mu_s_point, star_transmittance)
            )
            sampling.mass[at, k] = mass
            total += mass
        depth += panel[5]
    return total


@compiled_loop
def sample_sun_biased(u, v, count, total, extinction, path, sampling):
    """Point sampled from the sun-biased density.

    Parameters
    ----------
    u, v : float
        Random numbers in (0, 1).
    count, total, extinction, path, sampling :
        Arguments, result and outputs of ``sun_sampling_integral``.

    Returns
    -------
    panel, t, depth : int, float, float
        Panel and position of the point, and optical depth from the ray's start to it.
    """
    weights = extinction.weights
    target = u * total
    at, k = 0, 0
    for piece in range(count * weights.size):
        at, k = piece // weights.size, piece % weights.size
        if sampling.mass[at, k] > 0.0:
            target -= sampling.mass[at, k]
            if target <= 0.0:
                break
    first = 0.0
    for j in range(k):
        first += weights[j]
    t = first + v * weights[k]
    base = k if t >= extinction.nodes[k] else k - 1
    before = sampling.depth[at, base] if base >= 0 else 0.0
    depth = sampling.before[at] + depth_within(at, t, base, before, extinction, path)
    return at, t, depth


@compiled_loop
def sun_biased_density(at, t, total, extinction, sampling):
    """Sampling density of ``sample_sun_biased``, per panel variable."""
    weights = extinction.weights
    edge = 0.0
    for k in range(weights.size):
        edge += weights[k]
        if t <= edge or k == weights.size - 1:
            return sampling.mass[at, k] / (total * weights[k])
    return 0.0
