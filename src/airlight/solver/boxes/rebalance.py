r"""Diffusion that accelerates the sweeps of a box: coarse-mesh finite differences on its cells.

Net currents through faces are

.. math:: J = D (\\phi_- - \\phi_+) + H (\\phi_- + \\phi_+),

where H makes them those of the last sweep, so that the solution of the balance of all cells is that
of the sweeps once these converge. D is that of diffusion; in optically thick cells it is larger,
which keeps the iteration stable (Zhu, Kochunas & Downar 2016, Annals of Nuclear Energy 95, 116).
Diamond differences let out more of a cell's own light than diffusion does: half of a change of the
mean radiance leaves through each face, so that additions are larger than theirs.
"""

from __future__ import annotations

from math import exp
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined, kernel
from airlight.kernel.lanes import HALF_LANES, load_half, store_half
from airlight.solver.boxes.cell_balance import FaceCoefficients, in_chunks

Float32Array = NDArray[np.float32]
FloatArray = NDArray[np.float64]

#: Least optical depth between two cells for diffusion. [1]
LEAST_DEPTH = 0.15
#: Largest addition to D across upright faces, of cells that are often wide and thick, and across
#: horizontal ones, and the optical depths at which it begins and over which it grows.
_ADDED, _ADDED_UP, _BEGIN, _GROWTH = 1.5, 0.5, 0.5, 4.0
#: Largest current over the light of a cell. [1]
_MOST_LEAVING = 2.0
#: Least mean radiance, against division by 0. [sr⁻¹]
_LEAST = 1e-20


class BalanceCells(NamedTuple):
    """Optics of cells for their balance.

    Attributes
    ----------
    total, transport, absorption : array, shape (levels, ny, nx, 4)
        Scaled extinction, transport extinction and absorption. [m⁻¹]
    widths : tuple of two float
        Widths of a cell. [m]
    thickness : array, shape (levels,)
        Depth of the levels. [m]
    periodic : bool
        Whether the box repeats itself.
    flat : tuple of two bool
        Whether light does not vary along x, and along y.
    ground : array, shape (4,)
        Albedo of the ground. [1]
    """

    total: Float32Array
    transport: Float32Array
    absorption: Float32Array
    widths: tuple[float, float]
    thickness: Float32Array
    periodic: bool
    flat: tuple[bool, bool]
    ground: Float32Array


@kernel
def diffusivity(low_depth, high_depth, low_total, high_total, most):
    """D between two cells by half of their transport depths and depths, and most addition. [1]"""
    total = low_total + high_total
    added = 0.0
    if total > _BEGIN:
        added = most * (1.0 - exp((_BEGIN - total) / _GROWTH))
    return 1.0 / (3.0 * max(low_depth + high_depth, LEAST_DEPTH)) + added


@kernel
def leaving(current, light):
    """Current over the light from which it comes, 0 to a limit. [1]"""
    return min(max(current / max(light, _LEAST), 0.0), _MOST_LEAVING)


@kernel
def face(d, current, low, high):
    """Coefficients D + H and D - H of a face, both at least 0. [1]"""
    bend = (current - d * (low - high)) / max(low + high, _LEAST)
    if bend > d or bend < 0.0 - d:
        # All of the current is from one side.
        return leaving(current, low), leaving(0.0 - current, high)
    return d + bend, d - bend


@compiled_loop
def level_coefficients(k, cells, currents, phi, first, coefficients):
    """Coefficients of a level's cells; ``first``: diffusion alone, without currents.

    Gains across the upper faces in z are those of the level; the diagonal lacks the loss at the
    lower face, see ``add_lower``.
    """
    total, transport, absorption, widths, thickness, periodic, flat, ground = cells
    current_x, current_y, current_z = currents
    diagonal, (low_x, low_y, low_z), (high_x, high_y, high_z) = coefficients
    levels, ny, nx, lanes = phi.shape
    per_x, per_y = 1.0 / widths[0], 1.0 / widths[1]
    per_z = 1.0 / thickness[k]
    flat_x, flat_y = flat
    for y in range(ny):
        for x in range(nx):
            for w in range(lanes):
                here = phi[k, y, x, w]
                own, depth = transport[k, y, x, w], total[k, y, x, w]
                loss = absorption[k, y, x, w]
                low_x[k, y, x, w], high_x[k, y, x, w] = 0.0, 0.0
                low_y[k, y, x, w], high_y[k, y, x, w] = 0.0, 0.0
                low_z[k, y, x, w], high_z[k, y, x, w] = 0.0, 0.0
                if not flat_x:
                    other = x + 1 if x + 1 < nx else 0
                    if x + 1 < nx or periodic:
                        half = 0.5 * widths[0]
                        d = diffusivity(
                            half * own,
                            half * transport[k, y, other, w],
                            half * depth,
                            half * total[k, y, other, w],
                            _ADDED,
                        )
                        current = current_x[k, y, x + 1, w]
                        if x + 1 == nx:
                            current += current_x[k, y, 0, w]
                        beyond = phi[k, y, other, w]
                        if first:
                            current = d * (here - beyond)
                        forward, backward = face(d, current, here, beyond)
                        low_x[k, y, x, w] = forward * per_x
                        high_x[k, y, x, w] = backward * per_x
                    elif first:
                        loss += 0.5 * per_x
                    else:
                        loss += leaving(current_x[k, y, nx, w], here) * per_x
                    if x == 0 and not periodic:
                        if first:
                            loss += 0.5 * per_x
                        else:
                            loss += leaving(0.0 - current_x[k, y, 0, w], here) * per_x
                if not flat_y:
                    other = y + 1 if y + 1 < ny else 0
                    if y + 1 < ny or periodic:
                        half = 0.5 * widths[1]
                        d = diffusivity(
                            half * own,
                            half * transport[k, other, x, w],
                            half * depth,
                            half * total[k, other, x, w],
                            _ADDED,
                        )
                        current = current_y[k, y + 1, x, w]
                        if y + 1 == ny:
                            current += current_y[k, 0, x, w]
                        beyond = phi[k, other, x, w]
                        if first:
                            current = d * (here - beyond)
                        forward, backward = face(d, current, here, beyond)
                        low_y[k, y, x, w] = forward * per_y
                        high_y[k, y, x, w] = backward * per_y
                    elif first:
                        loss += 0.5 * per_y
                    else:
                        loss += leaving(current_y[k, ny, x, w], here) * per_y
                    if y == 0 and not periodic:
                        if first:
                            loss += 0.5 * per_y
                        else:
                            loss += leaving(0.0 - current_y[k, 0, x, w], here) * per_y
                upper = current_z[0, k + 1, y, x, w] + current_z[1, k + 1, y, x, w]
                if k + 1 < levels:
                    half, next_half = 0.5 * thickness[k], 0.5 * thickness[k + 1]
                    d = diffusivity(
                        half * own,
                        next_half * transport[k + 1, y, x, w],
                        half * depth,
                        next_half * total[k + 1, y, x, w],
                        _ADDED_UP,
                    )
                    beyond = phi[k + 1, y, x, w]
                    if first:
                        upper = d * (here - beyond)
                    forward, backward = face(d, upper, here, beyond)
                    low_z[k, y, x, w], high_z[k, y, x, w] = forward, backward
                elif first:
                    loss += 0.5 * per_z
                else:
                    loss += leaving(upper, here) * per_z
                if k == 0:
                    down = 0.5 / (1.0 + ground[w])  # Marshak's condition, as at the other ends
                    if not first:
                        lower = current_z[0, 0, y, x, w] + current_z[1, 0, y, x, w]
                        down = leaving(0.0 - lower, here)
                    loss += (1.0 - ground[w]) * down * per_z
                diagonal[k, y, x, w] = loss


@compiled_loop
def add_losses(k, cells, coefficients):
    """Complete the diagonal of a level by what its cells lose to their neighbours."""
    _, _, _, _, thickness, _, _, _ = cells
    diagonal, (low_x, low_y, low_z), (high_x, high_y, high_z) = coefficients
    _levels, ny, nx, lanes = diagonal.shape
    per_z = 1.0 / thickness[k]
    for y in range(ny):
        for x in range(nx):
            west = x - 1 if x > 0 else nx - 1
            south = y - 1 if y > 0 else ny - 1
            for w in range(lanes):
                loss = low_x[k, y, x, w] + high_x[k, y, west, w]
                loss += low_y[k, y, x, w] + high_y[k, south, x, w]
                loss += low_z[k, y, x, w] * per_z
                if k > 0:
                    loss += high_z[k - 1, y, x, w] * per_z
                diagonal[k, y, x, w] += loss


@compiled_loop
def correct(first, last, cells, coefficients, change, moments, shares):
    """Add a change of the mean radiance times 4π, and that of its net currents, to some levels.

    Parameters
    ----------
    change : array, shape (levels, ny, nx, 4)
        Change of the mean radiance times 4π. [1]
    moments : tuple of two arrays, shape (levels, ny, nx, terms, 4)
        Moments of downward and of upward light. [1]
    shares : array, shape (2, terms, 4)
        Moments of downward and of upward light of 1/4π and of 3/4π times the direction cosines.
    """
    widths = cells.widths
    _, (low_x, low_y, low_z), (high_x, high_y, high_z) = coefficients
    levels, ny, nx, _ = change.shape
    before, after = moments[0].reshape(-1), moments[1].reshape(-1)
    terms = shares.shape[1]
    changes = change.reshape(-1)
    gains = (low_x.reshape(-1), low_y.reshape(-1), low_z.reshape(-1))
    losses = (high_x.reshape(-1), high_y.reshape(-1), high_z.reshape(-1))
    half_x, half_y = np.float32(0.5 * widths[0]), np.float32(0.5 * widths[1])
    half = np.float32(0.5)
    for k in range(first, last):
        for y in range(ny):
            south, north = (y - 1 if y > 0 else ny - 1), (y + 1 if y + 1 < ny else 0)
            for x in range(nx):
                west, east = (x - 1 if x > 0 else nx - 1), (x + 1 if x + 1 < nx else 0)
                row = (k * ny + y) * nx
                at = (row + x) * HALF_LANES
                here = load_half(changes, at)
                along_x = _through(at, (row + east) * HALF_LANES, gains[0], losses[0], changes)
                along_x += _through((row + west) * HALF_LANES, at, gains[0], losses[0], changes)
                beyond = ((k * ny + north) * nx + x) * HALF_LANES
                along_y = _through(at, beyond, gains[1], losses[1], changes)
                beyond = ((k * ny + south) * nx + x) * HALF_LANES
                along_y += _through(beyond, at, gains[1], losses[1], changes)
                along_z = load_half(gains[2], at) * here
                if k + 1 < levels:
                    beyond = at + ny * nx * HALF_LANES
                    along_z = _through(at, beyond, gains[2], losses[2], changes)
                if k > 0:
                    beyond = at - ny * nx * HALF_LANES
                    along_z += _through(beyond, at, gains[2], losses[2], changes)
                along_x, along_y, along_z = half_x * along_x, half_y * along_y, half * along_z
                for t in range(terms):
                    place = at * terms + t * HALF_LANES
                    down = load_half(before, place) + shares[0, t, 0] * here
                    down += shares[0, t, 1] * along_x + shares[0, t, 2] * along_y
                    store_half(before, place, down + shares[0, t, 3] * along_z)
                    up = load_half(after, place) + shares[1, t, 0] * here
                    up += shares[1, t, 1] * along_x + shares[1, t, 2] * along_y
                    store_half(after, place, up + shares[1, t, 3] * along_z)


@inlined
def _through(low, high, gains, losses, change):
    """Net current through the face between two cells by their changes, over the width. [m⁻¹]"""
    return load_half(gains, low) * load_half(change, low) - (
        load_half(losses, low) * load_half(change, high)
    )


@compiled_loop
def add_currents(first, last, amount, shares, moments):
    """Add amounts of light (levels, ny, nx, 4), with moments ``shares`` (2, terms), to levels."""
    before, after = moments
    _, ny, nx, terms, lanes = before.shape
    for k in range(first, last):
        for y in range(ny):
            for x in range(nx):
                for t in range(terms):
                    for w in range(lanes):
                        before[k, y, x, t, w] += shares[0, t] * amount[k, y, x, w]
                        after[k, y, x, t, w] += shares[1, t] * amount[k, y, x, w]


def coefficients_for(
    cells: BalanceCells, currents: tuple[Float32Array, ...], phi: Float32Array, *, first: bool
) -> FaceCoefficients:
    """Coefficients of the balance; ``first``: those of diffusion alone."""

    def new() -> Float32Array:
        return np.empty_like(phi)

    found = FaceCoefficients(new(), (new(), new(), new()), (new(), new(), new()))
    levels = phi.shape[0]

    def coefficients(first_level: int, last: int) -> None:
        for k in range(first_level, last):
            level_coefficients(k, cells, currents, phi, first, found)

    def losses(first_level: int, last: int) -> None:
        for k in range(first_level, last):
            add_losses(k, cells, found)

    in_chunks(coefficients, levels, phi.size // 4)
    in_chunks(losses, levels, phi.size // 4)
    return found
