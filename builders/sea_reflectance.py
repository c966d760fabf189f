"""Print the fits in ``src/airlight/physics/optics/cox_munk.py``: light that a rough sea mirrors.

Run with ``python builders/sea_reflectance.py``; it needs NumPy, SciPy, and airlight for the
formulas. A fit is a polynomial in x = 2 cos - 1 and y = (rms slope - 0.22)/0.14, fitted by least
squares whose weights are raised where the error is largest.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares
from scipy.special import ndtr

from airlight.kernel import vectorized
from airlight.physics.optics.cox_munk import glint_factor, mean_square_slope

FloatArray = NDArray[np.float64]

WINDS = np.array([0.5, 0.8, 1.2, 2.0, 3.0, 4.0, 5.0, 7.0, 10.0, 13.0, 16.0, 20.0, 25.0])
COSINES = np.concatenate([
    [5e-4, 5e-3, 0.01, 0.02, 0.03, 0.04, 0.06, 0.08, 0.1, 0.13, 0.16], np.arange(0.2, 0.61, 0.05),
    [0.7, 0.8, 0.9, 1.0 - 1e-9],
])  # fmt: skip
#: A sky brightens towards the horizon as 1/(μ + 0.1). [1]
HORIZON = 0.1


def mirrored(cosine: float, wind: float) -> tuple[float, float]:
    """Fraction of a beam that is mirrored, and cosine where the sky is as bright as its light."""
    nodes, weights = np.polynomial.legendre.leggauss(300)
    root = 0.5 * (nodes + 1.0)
    mu, share = root**2, weights * root  # in the root of the cosine, where the factor is smooth
    step = (np.arange(720) + 0.5) / 720.0
    turn, dense = math.pi * (1.0 - step**3), 3.0 * step**2  # dense opposite the beam
    sine, beam = np.sqrt(1.0 - mu**2)[:, None], math.sqrt(1.0 - cosine**2)
    nu = -(mu[:, None] * cosine + sine * beam * np.cos(turn))
    factor = dense * vectorized(glint_factor)(mu[:, None], cosine, nu, wind)
    light = 2.0 * share * mu
    total = light @ factor.mean(axis=1)
    bright = (light / (mu + HORIZON)) @ factor.mean(axis=1)
    return float(total), float(total / bright - HORIZON)


def fitted(name: str, values: FloatArray, degrees: tuple[int, int], scale: FloatArray) -> None:
    """Print the coefficients of a fit, a line for each power of x, and its largest scaled error."""
    slope = np.sqrt(vectorized(mean_square_slope)(WINDS))
    y, x = np.meshgrid((slope - 0.22) / 0.14, 2.0 * COSINES - 1.0, indexing="ij")
    powers = [x**i * y**j for i in range(degrees[0] + 1) for j in range(degrees[1] + 1)]
    basis = np.stack(powers, axis=-1).reshape(values.size, -1)
    weight, best = np.ones(values.size), (math.inf, basis[0])
    for _ in range(200):
        found = np.linalg.lstsq(basis * weight[:, None], values.ravel() * weight, rcond=None)[0]
        found = found.round(4)
        error = np.abs(basis @ found - values.ravel()) * np.tile(scale, WINDS.size)
        if error.max() < best[0]:
            best = float(error.max()), found
        weight *= np.sqrt(0.2 + error / error.max())
        weight /= weight.mean()
    print(f"{name}, error at most {best[0]:.4f}")
    print(best[1].reshape(degrees[0] + 1, -1).tolist())


def fit_visible_slopes() -> None:
    """Print the shift and the bend of ``facing_slope`` by the limit, and their fits."""
    normal = np.linspace(-2.6, 2.6, 53)
    limits = np.array([0.0, 0.25, 0.5, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0])
    found = []
    for limit in limits:
        x = np.linspace(-min(limit, 8.0), 8.0, 40001)
        mass = np.cumsum((limit + x) * np.exp(-0.5 * x**2))
        slope = np.interp(ndtr(normal), mass / mass[-1], x)

        def error(p: FloatArray, limit: float = limit, slope: FloatArray = slope) -> FloatArray:
            above = normal + limit + p[0]
            miss = 0.5 * (above + np.sqrt(above**2 + p[1])) - limit - slope
            return np.asarray(miss * np.exp(-0.25 * normal**2))

        found.append(least_squares(error, [0.6, 2.0]).x)
    shift, bend = np.array(found).T
    fits = {
        "shift": (lambda p: (p[0] + p[1] * limits) / (1.0 + limits * (p[2] + p[3] * limits)), shift,
                  [0.6, 0.1, 0.6, 0.3]),
        "bend": (lambda p: p[0] + p[1] / (1.0 + p[2] * limits**2), bend, [2.0, 0.4, 0.5]),
    }  # fmt: skip
    for name, (form, values, start) in fits.items():
        fit = least_squares(lambda p, form=form, values=values: form(p) - values, start)
        print(f"{name} of visible slopes", fit.x.round(3), np.abs(fit.fun).max().round(3))


def main() -> None:
    """Integrate the glint's factor over the hemisphere, and fit."""
    fit_visible_slopes()
    table = np.array([[mirrored(cosine, wind) for cosine in COSINES] for wind in WINDS])
    fitted(
        "logarithm of the reflected fraction", np.log(table[..., 0]), (5, 2), 1.0 + 0.0 * COSINES
    )
    # Overhead, where the sky is even, it goes to 1: a line straight down has no azimuth.
    fall = (1.0 - table[..., 1]) * (1.0 - COSINES**8) / (1.0 - COSINES)
    fitted("(1 - mirrored cosine)/(1 - cosine)", fall, (4, 2), 1.0 - COSINES)
    nodes, weights = np.polynomial.legendre.leggauss(64)
    cosines, shares = 0.5 * (nodes + 1.0), 0.5 * weights
    mean = [2.0 * sum(w * c * mirrored(c, wind)[0] for c, w in zip(cosines, shares, strict=True))
            for wind in WINDS]  # fmt: skip
    slope = np.sqrt(vectorized(mean_square_slope)(WINDS))
    fit = np.polyfit(slope, mean, 2).round(4)
    print("mean over the hemisphere", fit, np.abs(np.polyval(fit, slope) / mean - 1.0).max())


if __name__ == "__main__":
    main()
