"""Gather pass: radiance of one order integrated over the sphere with the phase functions."""

from __future__ import annotations

from math import ceil, cos, floor, log, sin, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.shell import horizon_cosine
from airlight.kernel import compiled_loop
from airlight.solver.direct.layout import Layout, angle_index, angle_of, radius_of, sun_of, view_of
from airlight.solver.direct.settings import DirectSettings
from airlight.solver.direct.trapezoid import sphere

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Nodes of the phase functions in u = sin(θ/2).
_PHASE_NODES = 4097
#: Smallest argument of the logarithm. [1]
_DARK = 1e-280
#: Distance from the end of the possible range, in steps, below which a node is not used for slopes.
_TOO_NEAR = 0.15
#: Width of the possible range, in steps, below which it counts as one angle.
_NARROW = 0.3
#: Largest number of steps over which a value beyond the possible range is continued.
_CONTINUED = 2.0


class GatherDirections(NamedTuple):
    """Quadrature of directions at each radius of the table.

    Attributes
    ----------
    zenith : array, shape (radii, nz)
        Zenith angles. [rad]
    azimuth : array, shape (na,)
        Azimuths from the sun's side to the opposite side. [rad]
    weights : array, shape (radii, nz, na)
        Solid angles, of both mirrored directions together. [sr]
    """

    zenith: FloatArray
    azimuth: FloatArray
    weights: FloatArray


def directions_for(axes: Layout, settings: DirectSettings) -> GatherDirections:
    """Directions of the gather, split at the horizon of each radius if the rule is graded."""
    rules = []
    for i in range(axes.radii):
        cuts: tuple[float, ...] = (0.0, np.pi)
        if settings.graded:
            horizon = float(np.arccos(horizon_cosine(radius_of(i, axes), axes.bottom)))
            cuts = (0.0, horizon, np.pi)
        rules.append(
            sphere(settings.zenith_steps, settings.azimuth_steps, cuts, grade=settings.graded)
        )
    return GatherDirections(
        np.stack([one[0] for one in rules]), rules[0][1], np.stack([one[2] for one in rules])
    )


def phase_nodes(
    medium: Medium, scatterers: NDArray[np.int64]
) -> tuple[FloatArray, NDArray[np.int64]]:
    """Phase functions on even steps of sin(θ/2), without duplicates.

    Parameters
    ----------
    scatterers : array, shape (ns,)
        Indices of the scattering constituents.

    Returns
    -------
    values : array, shape (different, nodes)
        Phase functions. [sr⁻¹]
    which : array, shape (ns·nl,)
        Row of ``values`` for each constituent and wavelength.
    """
    u = np.linspace(0.0, 1.0, _PHASE_NODES)
    values = medium.phase_function(1.0 - 2.0 * u * u)[:, scatterers]
    different, which = np.unique(values.reshape(_PHASE_NODES, -1).T, axis=0, return_inverse=True)
    return np.ascontiguousarray(different), which.ravel()


@compiled_loop
def gather(i, axes, directions, phases, incoming, psi, normalise, logarithmic, out):
    """Gathered radiance at one radius, for all sun angles and view directions.

    G(V) = ∫ p(V·ω) H(ω) dω for each constituent; if ``normalise``, each phase function is divided
    by its quadrature over the directions.

    Parameters
    ----------
    axes, directions : Layout, GatherDirections
        Axes of the table, and directions of the gather.
    phases : tuple of arrays
        Result of ``phase_nodes``.
    incoming : array, shape (sun_angles, nl, nz, na)
        Radiance H of one order at this radius, per irradiance of the star. [sr⁻¹]
    psi : tuple of float
        Cosine and sine of the azimuth of a table without angles. [1]
    out : array, shape (views, sun_angles, angles, ns·nl)
        Receives G or its logarithm. [sr⁻¹]
    """
    phase, which = phases
    cos_psi, sin_psi = psi
    zenith, azimuth = directions.zenith[i], directions.azimuth
    nz, na = zenith.size, azimuth.size
    count = nz * na
    # Components of each direction: up, towards the sun's side, across.
    up, ahead, across = np.empty(count), np.empty(count), np.empty(count)
    half_weight = np.empty(count)
    for z in range(nz):
        for a in range(na):
            up[z * na + a] = cos(zenith[z])
            ahead[z * na + a] = sin(zenith[z]) * cos(azimuth[a])
            across[z * na + a] = sin(zenith[z]) * sin(azimuth[a])
            half_weight[z * na + a] = 0.5 * directions.weights[i, z, a]
    near, far = np.empty(count, np.int32), np.empty(count, np.int32)
    kernel = np.empty((phase.shape[0], count))
    r = radius_of(i, axes)
    wavelengths = incoming.shape[1]
    last = phase.shape[1] - 1.0
    for k in range(axes.sun_angles):
        light = incoming[k].reshape((wavelengths, count))
        mu_s = min(max(sun_of(k, axes), -1.0), 1.0)
        sun_sine = sqrt((1.0 - mu_s) * (1.0 + mu_s))
        for j in range(axes.views):
            mu = view_of(j, r, axes)
            sine = sqrt(max((1.0 - mu) * (1.0 + mu), 0.0))
            flat = sine * sun_sine
            for m in range(axes.angles):
                if axes.angles > 1:
                    nu = angle_of(m, axes)
                    cos_psi = 1.0
                    if flat > 1e-9:
                        cos_psi = min(max((nu - mu * mu_s) / flat, -1.0), 1.0)
                    sin_psi = sqrt((1.0 - cos_psi) * (1.0 + cos_psi))
                for n in range(count):
                    along = 0.5 - 0.5 * (up[n] * mu + ahead[n] * sine * cos_psi)
                    aside = 0.5 * across[n] * sine * sin_psi
                    near[n] = int(sqrt(max(along - aside, 0.0)) * last + 0.5)
                    far[n] = int(sqrt(max(along + aside, 0.0)) * last + 0.5)
                for p in range(phase.shape[0]):
                    norm = 0.0
                    for n in range(count):
                        weight = half_weight[n] * (
                            phase[p, min(near[n], phase.shape[1] - 1)]
                            + phase[p, min(far[n], phase.shape[1] - 1)]
                        )
                        kernel[p, n] = weight
                        norm += weight
                    if normalise and norm > 0.0:
                        for n in range(count):
                            kernel[p, n] /= norm
                for q in range(which.size):
                    row, l = which[q], q % wavelengths
                    value = 0.0
                    for n in range(count):
                        value += kernel[row, n] * light[l, n]
                    out[j, k, m, q] = log(max(value, _DARK)) if logarithmic else value
    if logarithmic and axes.angles > 1:
        complete(r, axes, out)


@compiled_loop
def complete(r, axes, out):
    """Extrapolation of gathered radiance to impossible angles between view and sun, at one radius.

    For a vertical view or an overhead sun only one angle is possible; the shape is then that of the
    neighbouring view or sun angle.

    Parameters
    ----------
    r : float
        Radius. [m]
    out : array, shape (views, sun_angles, angles, channels)
        Logarithms, changed in place.
    """
    narrow = np.zeros((axes.views, axes.sun_angles))
    for k in range(axes.sun_angles):
        mu_s = min(max(sun_of(k, axes), -1.0), 1.0)
        for j in range(axes.views):
            mu = view_of(j, r, axes)
            flat = sqrt(max((1.0 - mu) * (1.0 + mu) * (1.0 - mu_s) * (1.0 + mu_s), 0.0))
            one, other = angle_index(mu * mu_s + flat, axes), angle_index(mu * mu_s - flat, axes)
            low, high = min(one, other), max(one, other)
            if high - low > _NARROW:
                extrapolate_linearly(out[j, k], low, high)
            else:
                narrow[j, k] = 0.5 * (low + high) + 1.0
    last = axes.sun_angles - 1
    for j in range(1, axes.views - 1):
        if narrow[j, 0] > 0.0:
            extrapolate_shape(out[j, 0], narrow[j, 0] - 1.0, out[j, 1])
        if narrow[j, last] > 0.0:
            extrapolate_shape(out[j, last], narrow[j, last] - 1.0, out[j, last - 1])
    last = axes.views - 1
    for k in range(axes.sun_angles):
        if narrow[0, k] > 0.0:
            extrapolate_shape(out[0, k], narrow[0, k] - 1.0, out[1, k])
        if narrow[last, k] > 0.0:
            extrapolate_shape(out[last, k], narrow[last, k] - 1.0, out[last - 1, k])


@compiled_loop
def extrapolate_shape(values, index, neighbour):
    """Extrapolation of a row known at one index, with the shape of its neighbour.

    Parameters
    ----------
    values : array, shape (angles, channels)
        Identical logarithms; changed in place.
    index : float
        Fractional index of the known angle.
    """
    n = values.shape[0]
    node = min(max(int(index), 0), n - 2)
    f = index - node
    for q in range(values.shape[1]):
        own = values[node, q]
        there = (1.0 - f) * neighbour[node, q] + f * neighbour[node + 1, q]
        for m in range(n):
            values[m, q] = own + neighbour[m, q] - there


@compiled_loop
def extrapolate_linearly(values, low, high):
    """Linear extrapolation of a row of logarithms to impossible angles.

    Nodes outside the possible range hold the value at its end. With the slope from inside,
    interpolation up to that end is exact.

    Parameters
    ----------
    values : array, shape (angles, channels)
        Logarithms, changed in place.
    low, high : float
        Fractional indices of the ends.
    """
    n = values.shape[0]
    first, last = ceil(low - 1e-9), floor(high + 1e-9)
    for q in range(values.shape[1]):
        if first > last:  # both ends between two nodes
            slope = 0.0
            if high - low > _TOO_NEAR:
                slope = (values[first, q] - values[last, q]) / (high - low)
            below = above = slope
            at_low, at_high = values[last, q], values[first, q]
        else:
            at_low = values[max(first - 1, 0), q]
            at_high = values[min(last + 1, n - 1), q]
            inner = (values[last, q] - values[first, q]) / max(last - first, 1)
            below = above = inner
            if first - low > _TOO_NEAR:
                below = (values[first, q] - at_low) / (first - low)
            elif last > first:
                below = values[first + 1, q] - values[first, q]
            if high - last > _TOO_NEAR:
                above = (at_high - values[last, q]) / (high - last)
            elif last > first:
                above = values[last, q] - values[last - 1, q]
        for m in range(n):
            if m < low:
                values[m, q] = at_low - below * min(low - m, _CONTINUED)
            elif m > high:
                values[m, q] = at_high + above * min(m - high, _CONTINUED)


def node_suns(axes: Layout) -> FloatArray:
    """Cosines of the sun's zenith angle at the table's nodes, shape (sun_angles,). [1]"""
    return np.array([sun_of(k, axes) for k in range(axes.sun_angles)])
