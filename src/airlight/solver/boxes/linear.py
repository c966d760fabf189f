"""Solution of the balance of a box's cells: BiCGStab with two grids.

The preconditioner solves for constant changes of blocks of cells, then eliminates columns of cells
without their neighbours.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined
from airlight.kernel.lanes import HALF_LANES
from airlight.solver.boxes.cell_balance import FaceCoefficients, balance, in_chunks
from airlight.solver.boxes.cell_blocks import Blocks, precondition_rows

Float32Array = NDArray[np.float32]
FloatArray = NDArray[np.float64]

#: Largest number of steps, and its tolerance. [1]
_STEPS, _TOLERANCE = 30, 0.3


@inlined
def _factorise_row(y, coefficients, thickness, factors):
    """Elimination of the columns of a row: reciprocal pivots in ``factors``. [m]"""
    diagonal, (_, _, low_z), (_, _, high_z) = coefficients
    levels, _, nx, _ = diagonal.shape
    for k in range(levels):
        per_z = np.float32(1.0) / thickness[k]
        for x in range(nx):
            for w in range(HALF_LANES):
                pivot = diagonal[k, y, x, w]
                if k > 0:
                    below = np.float32(1.0) / thickness[k - 1]
                    pivot -= (
                        per_z
                        * low_z[k - 1, y, x, w]
                        * below
                        * high_z[k - 1, y, x, w]
                        * factors[k - 1, y, x, w]
                    )
                factors[k, y, x, w] = np.float32(1.0) / max(pivot, np.float32(1e-30))


@compiled_loop
def factorise(first, last, coefficients, thickness, factors):
    """Elimination of the columns of some rows: reciprocal pivots in ``factors``. [m]"""
    for y in range(first, last):
        _factorise_row(y, coefficients, thickness, factors)


@compiled_loop
def _products(first, last, a, b, out):
    """Sums of products over some levels by wavelength, shape (levels, 4)."""
    for k in range(first, last):
        out[k] = 0.0
        for y in range(a.shape[1]):
            part = np.zeros(HALF_LANES, np.float32)
            for x in range(a.shape[2]):
                for w in range(HALF_LANES):
                    part[w] += a[k, y, x, w] * b[k, y, x, w]
            for w in range(HALF_LANES):
                out[k, w] += part[w]


@compiled_loop
def _add_multiples(first, last, out, factors, a, b):
    """Add multiples of two arrays to a third one in some levels."""
    for k in range(first, last):
        for y in range(out.shape[1]):
            for x in range(out.shape[2]):
                for w in range(HALF_LANES):
                    out[k, y, x, w] += factors[0, w] * a[k, y, x, w] + factors[1, w] * b[k, y, x, w]


def _dot(a: Float32Array, b: Float32Array) -> FloatArray:
    """Sum of products over the cells, shape (4,)."""
    out = np.empty((len(a), a.shape[-1]))
    in_chunks(lambda first, last: _products(first, last, a, b, out), len(a), a.size // 4)
    return np.asarray(out.sum(axis=0))


def _add(out: Float32Array, p: FloatArray, a: Float32Array, q: FloatArray, b: Float32Array) -> None:
    """Add p a + q b to ``out``."""
    factors = np.stack([p, q]).astype(np.float32)
    in_chunks(
        lambda first, last: _add_multiples(first, last, out, factors, a, b), len(out), out.size // 4
    )


def _ratio(a: FloatArray, b: FloatArray) -> FloatArray:
    return np.divide(a, b, out=np.zeros_like(a), where=np.abs(b) > 1e-300)


def solve_linear(
    coefficients: FaceCoefficients,
    thickness: Float32Array,
    source: Float32Array,
    phi: Float32Array,
) -> Float32Array:
    """Mean radiances of balanced cells, from a guess.

    Source: van der Vorst (1992), SIAM J. Sci. Stat. Comput. 13, 631 (BiCGStab).

    Parameters
    ----------
    coefficients : FaceCoefficients
    thickness : array, shape (levels,)
        Depth of the levels. [m]
    source : array, shape (levels, ny, nx, 4)
        Gain from the beam, the ground and outside. [m⁻¹]
    phi : array, shape (levels, ny, nx, 4)
        Guess of the mean radiance times 4π. [1]
    """
    levels, ny = phi.shape[:2]
    size = phi.size // 4
    factors = np.empty_like(phi)
    in_chunks(lambda a, b: factorise(a, b, coefficients, thickness, factors), ny, size)

    def apply(vector: Float32Array) -> Float32Array:
        out = np.empty_like(vector)
        in_chunks(
            lambda a, b: balance(a, b, coefficients, thickness, vector, out), levels, phi.size // 4
        )
        return out

    blocks = Blocks(coefficients, thickness, apply(np.ones_like(phi)))
    one, zero = np.ones(phi.shape[-1]), np.zeros(phi.shape[-1])

    def precondition(vector: Float32Array) -> Float32Array:
        coarse = blocks.solve(vector)
        out = np.empty_like(vector)
        in_chunks(
            lambda a, b: precondition_rows(
                a, b, coefficients, thickness, factors, blocks.cells, coarse, vector, out
            ),
            ny,
            size,
        )
        return out

    residual = source - apply(phi)
    goal = _TOLERANCE * np.sqrt(np.maximum(_dot(residual, residual), 1e-60))
    goal = np.maximum(goal, 1e-6 * np.sqrt(_dot(source, source)))
    shadow, phi = residual.copy(), phi.copy()
    along, through = np.zeros_like(phi), np.zeros_like(phi)
    rho = alpha = omega = one
    for _ in range(_STEPS):
        if np.all(np.sqrt(_dot(residual, residual)) <= goal):
            break
        before, rho = rho, _dot(shadow, residual)
        beta = _ratio(rho, before) * _ratio(alpha, omega)
        along *= beta.astype(np.float32)
        _add(along, one, residual, -beta * omega, through)
        ready = precondition(along)
        through = apply(ready)
        alpha = _ratio(rho, _dot(shadow, through))
        _add(residual, -alpha, through, zero, through)
        smooth = precondition(residual)
        rough = apply(smooth)
        omega = _ratio(_dot(rough, residual), _dot(rough, rough))
        _add(phi, alpha, ready, omega, smooth)
        _add(residual, -omega, rough, zero, rough)
    return phi
