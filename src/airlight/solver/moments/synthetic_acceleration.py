"""Synthetic acceleration with the plane-parallel sweep as low-order operator.

In optically thick media successive orders of scattering converge slowly. In the plane-parallel
approximation, with the star at the same elevation everywhere, a sweep couples moments over radius
and degree only, for each sun elevation and order m: a small matrix K. With r the residual of a
sweep, (1 - K)⁻¹ r is the sum of all further sweeps, except for lateral transport. The iteration,
which converges to the exact solution, then needs only a few sweeps at any optical thickness. This
is the synthetic method (Kopp 1963, Nucl. Sci. Eng. 17, 65; Larsen 1982, Nucl. Sci. Eng. 82, 47)
with the plane-parallel sweep in place of diffusion.
"""

from __future__ import annotations

from math import acos, cos, pi, sin
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import LANES, lane_view, splat
from airlight.kernel.threads import Cancel, run_blocks
from airlight.solver.moments.elimination import factorise, substitute
from airlight.solver.moments.harmonics import Harmonics, legendre_functions
from airlight.solver.moments.levels import finer_weights
from airlight.solver.moments.packing import positive
from airlight.solver.moments.setup import WavelengthBatch
from airlight.solver.moments.synthetic_operator import gather_levels, project_radii, synthetic_rows

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]
#: Moments, or their means, and irradiances.
Light = tuple[Float32Array, Float32Array]

#: Highest degree l and order m of the moments in K; higher ones converge fast without it.
DEGREE: Final = 8
ORDER: Final = 3
#: Number of sun elevations solved for together.
_SUNS: Final = 14


class SyntheticAcceleration:
    """Synthetic acceleration (1 - K)⁻¹ for eight wavelengths, K the plane-parallel sweep.

    Parameters
    ----------
    batch : WavelengthBatch
        Set-up of the sweeps.
    """

    def __init__(self, batch: WavelengthBatch, cancel: Cancel | None = None) -> None:
        setup, rays, tables = batch.setup, batch.rays, batch.sweep_tables
        grid, expansion, parts = setup.grid, setup.expansion, setup.refinement
        self.batch, self.grid = batch, grid
        self.set_lateral_scale(1.0)
        cosines = grid.sun_cosines
        self.diffusion = lateral_diffusion_matrix(cosines, batch.diffusion_length, 0.0)
        self.grid_diffusion = lateral_diffusion_matrix(cosines, 0.0, batch.grid_diffusion)
        self.degree = min(expansion.degree, DEGREE)
        self.order = min(expansion.degree, ORDER)
        self.radii = rays.mu.shape[0]
        widths = [self.degree + 1 - m for m in range(self.order + 1)]
        starts = np.concatenate([[0], np.cumsum(widths)])
        angles, levels = rays.mu.shape[1], grid.radii.size
        cubics = finer_weights(self.radii, parts).astype(np.float32)
        # The irradiance of the ground is an additional unknown for m = 0.
        self.sizes = sizes = [self.radii * width + (m == 0) for m, width in enumerate(widths)]
        self.factors = [np.zeros((size, size, LANES), np.float32) for size in sizes]
        self.to_sky = np.zeros((self.radii, self.radii * widths[0], LANES), np.float32)
        self.accelerated: Light | None = None

        def couple(i: int) -> None:
            weights = np.empty((angles, levels, int(starts[-1]), LANES), np.float32)
            bounced = np.empty((angles, LANES), np.float32)
            synthetic_rows(i, tables, self.degree, self.order, weights, bounced)
            seen = weights
            if parts > 1:
                seen = np.zeros((angles, self.radii, *weights.shape[2:]), np.float32)
                gather_levels(cubics, weights, seen)
            functions = _functions(rays.mu[i], expansion)
            for m, (first, width) in enumerate(zip(starts[:-1], widths, strict=True)):
                turn = 2.0 * pi if m == 0 else pi
                project = turn * rays.weight[i] * functions[_indices(m, self.degree)]
                span = slice(i * width, (i + 1) * width)
                project_radii(project, seen, int(first), width, self.factors[m][span])
                if m == 0:
                    self.factors[0][span, -1] = project @ bounced
                    flux = turn * rays.flux[i : i + 1]
                    project_radii(flux, seen, 0, width, self.to_sky[i : i + 1])

        run_blocks(couple, self.radii, cancel=cancel)
        self.factors[0][-1, :-1] = self.to_sky[0]

        def invert(m: int) -> None:
            matrix = self.factors[m]
            np.negative(matrix, out=matrix)
            matrix[np.diag_indices(matrix.shape[0])] += 1.0
            factorise(matrix.reshape(-1, LANES), matrix.shape[0])

        run_blocks(invert, self.order + 1, cancel=cancel)

    def set_lateral_scale(self, factor: float) -> None:
        """Set the factor of the lateral diffusion length. [1]"""
        length, grid_diffusion = self.batch.diffusion_length, self.batch.grid_diffusion
        self.spread = lateral_diffusion_matrix(
            self.grid.sun_cosines, factor * length, factor**2 * grid_diffusion
        )

    def apply(self, field: Float32Array, sky: Float32Array, light: Light | None = None) -> Light:
        """Accelerated residual (1 - K)⁻¹ r, with lateral diffusion.

        The sum of further sweeps is multiplied by ``lateral_diffusion_matrix``. In optically deep
        media its ratio to the radiance is diffused instead, consistent with rational interpolation
        in the sweeps, so that radiance which falls e-fold between sun elevations is not smeared
        out. The first order nearly vanishes at dusk, where lateral transport dominates; its further
        orders are diffused over the physical length first, then, as a ratio, over the numerical
        one. The result is overwritten by the next call.

        Parameters
        ----------
        field : array, shape (r, s, k, 8)
            Residual of the moments, or the first order.
        sky : array, shape (r, s, 8)
            Residual of the irradiances.
        light : two arrays, shapes (r, s, 8), optional
            Mean radiances and irradiances after the sweep; omitted for the first order.

        Returns
        -------
        two arrays, shapes (r, s, k, 8), (r, s, 8)
            Accelerated residual of moments and irradiances.
        """
        radii, sun_angles = field.shape[:2]
        more = [np.empty((size, sun_angles, LANES), np.float32) for size in self.sizes]
        more_sky = np.empty_like(sky)

        def solve(index: int) -> None:
            m, first = index % (self.order + 1), index // (self.order + 1) * _SUNS
            span = slice(first, min(first + _SUNS, sun_angles))
            width = span.stop - first
            before = np.empty((self.sizes[m], width, LANES), np.float32)
            take_terms(field, sky, m, self.degree, first, before)
            after = before.copy()
            flat = self.factors[m].reshape(-1, LANES), after.reshape(-1, LANES)
            substitute(flat[0], self.sizes[m], flat[1], width)
            more[m][:, span] = after - before
            if m == 0:
                found = np.empty((radii, width, LANES), np.float32)
                multiply(self.to_sky, after, found)
                more_sky[:, span] = found

        run_blocks(solve, (self.order + 1) * -(-sun_angles // _SUNS))
        spread = self.spread
        mean, received = np.ones_like(sky), np.ones_like(sky)
        if self.batch.deep:
            if light is None:
                more, more_sky = [self.diffusion @ one for one in more], self.diffusion @ more_sky
                light, spread = (field[:, :, 0], sky), self.grid_diffusion
            # A change cannot exceed the sum of radiance and change.
            added = more[0][: radii * (self.degree + 1) : self.degree + 1]
            mean = positive(np.maximum(light[0], 0.0) + np.abs(added))
            received = positive(np.maximum(light[1], 0.0) + np.abs(more_sky))
        if self.accelerated is None:
            self.accelerated = np.empty_like(field), np.empty_like(sky)
        np.copyto(self.accelerated[0], field)
        np.copyto(self.accelerated[1], sky)
        field, sky = self.accelerated

        def move(i: int) -> None:
            for m in range(self.order + 1):
                # With the star in the zenith or the nadir no light depends on azimuth.
                width, inner = self.degree + 1 - m, int(m > 0)
                shares = more[m][i * width : (i + 1) * width] / mean[i]
                terms = _indices(m, self.degree)
                spread_onto(spread, shares, terms, inner, mean[i], field[i])
            shares = more_sky[i : i + 1] / received[i]
            spread_onto(spread, shares, _indices(0, 0), 0, received[i], sky[i, :, None])

        run_blocks(move, radii)
        return field, sky


@compiled_loop
def take_terms(field, sky, m, degree, first, out):
    """Moments of one order m for some sun angles, and for m = 0 the irradiance of the ground.

    Parameters
    ----------
    field, sky : array, shapes (r, s, k, 8), (r, s, 8)
        Moments, and irradiances from above.
    m, degree : int
        Order of the moments, and highest degree.
    out : array, shape (n, sun_angles, 8)
        Receives the moments by radius, then degree.
    """
    row, sun_angles = 0, out.shape[1]
    given, received, taken = lane_view(field), lane_view(sky), lane_view(out)
    for i in range(field.shape[0]):
        for l in range(m, degree + 1):
            for s in range(sun_angles):
                taken[row, s] = given[i, first + s, l * (l + 1) // 2 + m]
            row += 1
    if m == 0:
        for s in range(sun_angles):
            taken[row, s] = received[0, first + s]


@compiled_loop
def spread_onto(matrix, values, terms, inner, scale, out):
    """Add values, multiplied by a matrix (s, s) over sun angles and by ``scale``, to some terms.

    Parameters
    ----------
    matrix : array, shape (s, s)
        Matrix from ``lateral_diffusion_matrix``. [1]
    values : array, shape (n, s, 8)
        Values by term and sun angle.
    terms : array, shape (n,)
        Indices of the terms in ``out``.
    inner : int
        1 to exclude the first and the last sun angle, else 0.
    scale : array, shape (s, 8)
        Factors of the sums at each sun angle.
    out : array, shape (s, k, 8)
        Receives the sums.
    """
    sun_angles = matrix.shape[0]
    given, factors, found = lane_view(values), lane_view(scale), lane_view(out)
    for n in range(terms.size):
        for t in range(inner, sun_angles - inner, 4):
            # Four at a time, so that each value is loaded once.
            second, third = min(t + 1, sun_angles - 1), min(t + 2, sun_angles - 1)
            fourth = min(t + 3, sun_angles - 1)
            one, two, three, four = splat(0.0), splat(0.0), splat(0.0), splat(0.0)
            for s in range(sun_angles):
                value = given[n, s]
                one = one + matrix[t, s] * value
                two = two + matrix[second, s] * value
                three = three + matrix[third, s] * value
                four = four + matrix[fourth, s] * value
            last = sun_angles - inner
            found[t, int(terms[n])] += one * factors[t]
            if t + 1 < last:
                found[t + 1, int(terms[n])] += two * factors[t + 1]
            if t + 2 < last:
                found[t + 2, int(terms[n])] += three * factors[t + 2]
            if t + 3 < last:
                found[t + 3, int(terms[n])] += four * factors[t + 3]


@compiled_loop
def multiply(matrix, values, out):
    """Product of a matrix (r, k, 8) and values (k, s, 8) per wavelength, into ``out`` (r, s, 8)."""
    factors, given, found = lane_view(matrix), lane_view(values), lane_view(out)
    for r in range(found.shape[0]):
        for s in range(found.shape[1]):
            total = splat(0.0)
            for k in range(factors.shape[1]):
                total = total + factors[r, k] * given[k, s]
            found[r, s] = total


def lateral_diffusion_matrix(
    sun_cosines: FloatArray, diffusion_length: float, grid_diffusion: float
) -> Float32Array:
    """Matrix of (1 - Λ²∇²)⁻¹ on the sphere, between sun elevations, shape (s, s). [1]

    Multiple scattering in a layer diffuses radiation laterally over about the layer's thickness,
    the diffusion length L. Without it, variations over sun elevation on smaller scales would be
    overestimated by the acceleration, and the iteration would diverge at the terminator of a large
    planet. Linear interpolation between sun elevations with the step h adds numerical diffusion: a
    ray of length ℓ gets δ²M ℓ/(2h) instead of δ²M (ℓ/h)²/2, so that Λ² = L² + λh/2 with λ = ℓ over
    the loss per scattering.

    Parameters
    ----------
    sun_cosines : array, shape (s,)
        Sun cosines, ascending from -1 to 1. [1]
    diffusion_length, grid_diffusion : float
        L and λ over the planet's radius. [rad]
    """
    sun_angles = sun_cosines.size
    spread, measure = np.zeros(sun_angles * sun_angles), np.empty(sun_angles)
    lateral_diffusion_equations(sun_cosines, diffusion_length, grid_diffusion, spread, measure)
    matrix = np.linalg.solve(spread.reshape(sun_angles, sun_angles), np.diag(measure))
    return np.asarray(matrix, np.float32)


def lateral_diffusion_equations(sun_cosines, diffusion_length, grid_diffusion, spread, measure):
    """Finite-volume discretisation of ``lateral_diffusion_matrix`` = spread⁻¹ diag(measure).

    Parameters
    ----------
    sun_cosines, diffusion_length, grid_diffusion :
        As in ``lateral_diffusion_matrix``.
    spread : array, shape (s·s,)
        Receives the matrix of 1 - Λ²∇² times the measure of the cells; 0 before. [1]
    measure : array, shape (s,)
        Receives the measure of each cell, its interval of cosines. [1]
    """
    sun_angles = sun_cosines.size
    below = -1.0
    for j in range(sun_angles):
        spread[j * sun_angles + j] -= below
        measure[j] = -below
        below = 1.0
        if j < sun_angles - 1:
            angle, further = acos(sun_cosines[j]), acos(sun_cosines[j + 1])
            between, step = 0.5 * (angle + further), angle - further
            below = cos(between)
            flux = (
                (diffusion_length * diffusion_length + 0.5 * grid_diffusion * step)
                * sin(between)
                / step
            )
            spread[j * sun_angles + j] += flux
            spread[j * sun_angles + j + 1] -= flux
            spread[(j + 1) * sun_angles + j] -= flux
            spread[(j + 1) * sun_angles + j + 1] += flux
        spread[j * sun_angles + j] += below
        measure[j] += below


def _indices(m: int, degree: int) -> NDArray[np.int64]:
    """Indices of (m, m) to (degree, m) among the moments."""
    l = np.arange(m, degree + 1)
    return l * (l + 1) // 2 + m


def _functions(mu: FloatArray, expansion: Harmonics) -> FloatArray:
    """Normalised Legendre functions, shape (k, a). [1]"""
    out = np.empty((mu.size, expansion.ahead.size))
    _legendre_rows(mu, expansion, out)
    return out.T


@compiled_loop
def _legendre_rows(mu, expansion, out):
    for k in range(mu.size):
        legendre_functions(mu[k], expansion, out[k])
