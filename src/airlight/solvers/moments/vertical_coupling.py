"""Sweep as a matrix, in air lit alike everywhere, and its inverse, which ends the iteration.

In thick air light travels up and down many times before it leaves, and each order of scattering
differs little from the last. Along the vertical, however, a sweep is a small matrix: if the star
stood at the same height everywhere, the moments of each sun elevation and of each m would couple
over radius and degree alone. With K that matrix and r the light that one more sweep adds,
(1 - K)⁻¹ r is what all further sweeps add, except for the light that travels sideways. So the
iteration, which alone is exact, ends after a few sweeps however thick the air is. This is the
synthetic method (Kopp 1963, Nucl. Sci. Eng. 17, 65; Larsen 1982, Nucl. Sci. Eng. 82, 47) with the
sweep's own operator in place of diffusion.
"""

from __future__ import annotations

from math import pi
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import INVERSE_PI, LANES, exponential, load, splat, store
from airlight.kernel.threads import Cancel, run_blocks
from airlight.optics.reflection import sky_factor
from airlight.solvers.moments.elimination import factorise, substitute
from airlight.solvers.moments.grid import radius_index
from airlight.solvers.moments.harmonics import Harmonics, legendre_functions
from airlight.solvers.moments.levels import finer_weights
from airlight.solvers.moments.setup import Block
from airlight.solvers.moments.sweep import leaving_at_end, optical_depth, through_ray

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Highest degree and order in the m that is inverted; the rest converges by itself.
_DEGREE: Final = 8
_ORDER: Final = 3
#: Number of sun elevations solved for together.
_SUNS: Final = 14


@compiled_loop
def couple_radius(i, grid, rays, share, mu_along, air, expansion, degree, order, out, bounced):
    """Weights of the moments at all radii in the radiance of the rays from one radius.

    Parameters
    ----------
    i, grid, rays, share, air, expansion :
        As in ``sweep_radius``.
    mu_along : array, shape (p,)
        Zenith cosine of the rays at their points. [1]
    degree, order : int
        Limits of the moments that count: l up to ``degree``, m up to ``order``.
    out : array, shape (a·r·pairs·8,)
        Receives the weight of each moment (l, m), ordered by m and then l, in each ray. [1]
    bounced : array, shape (a·8,)
        Receives the weight of the ground's irradiance. [1]
    """
    bottom, top, radii, _, rows_at, _ = grid
    extinction, moments, surface, _, _ = air
    highest = expansion.degree
    starts, ray_radii = rays.start, rays.radius
    amounts, depths, totals = rays.amount, rays.column, rays.total
    constituents = extinction.size // LANES
    angles = rays.mu.shape[1]
    pairs = out.size // (angles * radii.size * LANES)
    functions = np.empty((highest + 1) * (highest + 2) // 2)
    strengths = np.empty((degree + 1) * LANES, np.float32)
    out[:] = 0.0
    bounced[:] = 0.0
    for a in range(angles):
        exact = load(share, LANES * (i * angles + a))
        for k in range(starts[i, a], starts[i, a + 1]):
            legendre_functions(mu_along[k], expansion, functions)
            depth = optical_depth(depths[k], 0, extinction, constituents)
            through = exponential(0.0 - depth) * exact
            for l in range(degree + 1):
                strength = splat(0.0)
                for c in range(constituents):
                    strength = strength + load(
                        moments, LANES * (c * (highest + 1) + l)
                    ) * np.float32(amounts[k, c])
                store(strengths, LANES * l, strength * through)
            x = radius_index(ray_radii[k], bottom, top, rows_at)
            row = min(int(x), radii.size - 2)
            f = x - row
            low = (a * radii.size + row) * pairs * LANES
            high = low + pairs * LANES
            for m in range(order + 1):
                for l in range(m, degree + 1):
                    value = functions[l * (l + 1) // 2 + m]
                    strength = load(strengths, LANES * l)
                    store(out, low, load(out, low) + np.float32(value * (1.0 - f)) * strength)
                    store(out, high, load(out, high) + np.float32(value * f) * strength)
                    low += LANES
                    high += LANES
        if a < angles // 2:
            through = through_ray(extinction, totals[i, a], 0, constituents)
            leaving = leaving_at_end(rays.end, i, a, rays.mu[i, a])
            store(bounced, LANES * a, sky_factor(surface, 0, leaving) * INVERSE_PI * through)


class Wandering:
    """Inverse (1 - K)⁻¹ for eight wavelengths: the sum of all further sweeps along the vertical.

    Parameters
    ----------
    block : Block
        Set-up of the sweeps.
    cancel : callable, optional
        See ``airlight.kernel.threads``.
    """

    def __init__(self, block: Block, cancel: Cancel | None = None) -> None:
        setup, rays, share, air = block.setup, block.rays, block.share, block.air
        grid, expansion, parts = setup.grid, setup.expansion, setup.parts
        wide, leak = (length / grid.bottom_radius for length in block.reach)
        self.spread = sideways(grid.sun_cosines, wide, leak)
        self.degree = min(expansion.degree, _DEGREE)
        self.order = min(expansion.degree, _ORDER)
        self.radii = rays.mu.shape[0]
        widths = [self.degree + 1 - m for m in range(self.order + 1)]
        starts = np.concatenate([[0], np.cumsum(widths)])
        angles, levels = rays.mu.shape[1], grid.radii.size
        along = rays.mu_along
        cubics = finer_weights(self.radii, parts).astype(np.float32)
        # The ground's irradiance is one more unknown beside the moments of m = 0.
        sizes = [self.radii * width + (m == 0) for m, width in enumerate(widths)]
        self.factors = [np.zeros((size, size, LANES), np.float32) for size in sizes]
        self.to_sky = np.zeros((self.radii, self.radii * widths[0], LANES), np.float32)

        def couple(i: int) -> None:
            weights = np.empty(angles * levels * int(starts[-1]) * LANES, np.float32)
            bounced = np.empty(angles * LANES, np.float32)
            couple_radius(
                i, grid, rays, share, along, air, expansion, self.degree, self.order,
                weights, bounced,
            )  # fmt: skip
            seen: NDArray[Any] = weights.reshape(angles, levels, -1)
            if parts > 1:
                seen = np.einsum("fr,afk->ark", cubics, seen, optimize=True)
            seen = seen.reshape(angles, self.radii, -1, LANES)
            functions = _functions(rays.mu[i], expansion)
            for m, (first, width) in enumerate(zip(starts[:-1], widths, strict=True)):
                turn = 2.0 * pi if m == 0 else pi
                project = turn * rays.weight[i] * functions[_indices(m, self.degree)]
                part = seen[:, :, first : first + width].reshape(angles, -1)
                here = slice(i * width, (i + 1) * width)
                moments = self.radii * width
                self.factors[m][here, :moments] = np.einsum("la,an->ln", project, part).reshape(
                    width, moments, LANES
                )
                if m == 0:
                    self.factors[0][here, -1] = project @ bounced.reshape(angles, LANES)
                    self.to_sky[i] = (turn * rays.flux[i] @ part).reshape(-1, LANES)

        run_blocks(couple, self.radii, cancel=cancel)
        self.factors[0][-1, :-1] = self.to_sky[0]

        def invert(m: int) -> None:
            matrix = self.factors[m]
            np.negative(matrix, out=matrix)
            matrix[np.diag_indices(matrix.shape[0])] += 1.0
            factorise(matrix.reshape(-1), matrix.shape[0])

        run_blocks(invert, self.order + 1, cancel=cancel)

    def finish(self, field: Float32Array, sky: Float32Array) -> tuple[Float32Array, Float32Array]:
        """Add to moments and irradiances the sum of all further sweeps.

        Parameters
        ----------
        field : array, shape (r, s, k, 8)
            Change of the moments by the last sweep.
        sky : array, shape (r, s, 8)
            Change of the irradiances.
        """
        more_field, more_sky = np.zeros_like(field), np.zeros_like(sky)
        radii, suns = field.shape[:2]

        def solve(index: int) -> None:
            m, first = index % (self.order + 1), index // (self.order + 1) * _SUNS
            here = slice(first, min(first + _SUNS, suns))
            terms = _indices(m, self.degree)
            state = np.moveaxis(field[:, here, terms], 1, 2).reshape(radii * len(terms), -1, LANES)
            if m == 0:
                state = np.concatenate([state, sky[:1, here]])
            values = np.ascontiguousarray(state)
            substitute(
                self.factors[m].reshape(-1), values.shape[0], values.reshape(-1), values.shape[1]
            )
            moments = values[: radii * len(terms)]
            after = np.moveaxis(moments.reshape(radii, len(terms), -1, LANES), 1, 2)
            more_field[:, here, terms] = after - field[:, here, terms]
            if m == 0:
                more_sky[:, here] = np.einsum("rkw,ksw->rsw", self.to_sky, moments)

        run_blocks(solve, (self.order + 1) * -(-suns // _SUNS))
        wide = self._spread(more_field.reshape(radii, suns, -1)).reshape(field.shape)
        # With the star in the zenith or the nadir the light is the same in all azimuths.
        level = _indices(0, self.degree)
        for pole in (0, suns - 1):
            kept = wide[:, pole, level]
            wide[:, pole] = 0.0
            wide[:, pole, level] = kept
        return field + wide, sky + self._spread(more_sky)

    def _spread(self, values: Float32Array) -> Float32Array:
        """``sideways`` of values (r, s, n); without a library whose threads wait for each other."""
        return np.asarray(np.einsum("ts,rsn->rtn", self.spread, values), np.float32)


def sideways(sun_cosines: FloatArray, reach: float, leak: float) -> Float32Array:
    """Matrix of (1 - Λ²∇²)⁻¹ on the sphere, between sun elevations, shape (s, s). [1]

    Light that is scattered many times in a layer also spreads sideways, about as far as the layer
    is thick. Without that spread, a pattern of sun elevations finer than it would be counted
    several times over, and the iteration would diverge at the terminator of a vast planet.
    Interpolation between sun elevations h apart spreads it too: where a ray of length ℓ should see
    δ²M (ℓ/h)²/2 it sees δ²M ℓ/(2h), so that Λ² = reach² + leak·h/2 with leak = ℓ over the loss by
    one scattering.

    Parameters
    ----------
    sun_cosines : array, shape (s,)
        Sun cosines, ascending from -1 to 1. [1]
    reach, leak : float
        Lengths over the planet's radius. [rad]
    """
    angle = np.arccos(sun_cosines)
    between = 0.5 * (angle[1:] + angle[:-1])
    edges = np.concatenate([[-1.0], np.cos(between), [1.0]])
    step = -np.diff(angle)
    flux = (reach**2 + 0.5 * leak * step) * np.sin(between) / step
    matrix = np.diag(np.diff(edges))
    spread = matrix.copy()
    low = np.arange(flux.size)
    for j, k in ((low, low + 1), (low + 1, low)):
        spread[j, j] += flux
        spread[j, k] -= flux
    return np.linalg.solve(spread, matrix).astype(np.float32)


def _indices(m: int, degree: int) -> list[int]:
    """Indices of (m, m) to (degree, m) among the moments."""
    return [l * (l + 1) // 2 + m for l in range(m, degree + 1)]


def _functions(mu: FloatArray, expansion: Harmonics) -> FloatArray:
    """Normalised Legendre functions, shape (k, a). [1]"""
    out = np.empty((mu.size, expansion.ahead.size))
    _legendre_rows(mu, expansion, out)
    return out.T


@compiled_loop
def _legendre_rows(mu, expansion, out):
    for k in range(mu.size):
        legendre_functions(mu[k], expansion, out[k])
