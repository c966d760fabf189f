"""Fit of phase functions by a Cornette-Shanks lobe times weights at the texels along nu.

Bruneton's look-up has one lobe for all particles and wavelengths, multiplied by a table that is
linear in nu between its texels. Each type of particles has weights at these texels, for the lobe's
table and for the table of the Rayleigh phase function:

    p(nu) ~ sum_j hat_j(nu) (w_j p_CS(nu; g) + v_j p_R(nu)),   w_j, v_j >= 0

Only g is common to all types. If the lobe's table holds only red, w of a type is one row times a
factor per wavelength.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import minimize_scalar, nnls

from airlight.engines.targets.target import FittedFormula
from airlight.kernel import vectorized
from airlight.physics.optics.phase_functions import cornette_shanks, rayleigh

FloatArray = NDArray[np.float64]

#: Angles between view and sun at which functions are compared: NEAREST first, then denser towards
#: the sun. [deg]
NEAREST: Final = 0.3
_NODES: Final = 240
#: Range of the lobe's g, and number of steps of the first search.
_G: Final = (0.2, 0.98)
_STEPS: Final = 14
#: Number of alternating passes over the row of weights and its factors, and limits of a factor.
_TURNS: Final = 3
_FACTORS: Final = (0.05, 20.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class WeightedLobe:
    """Lobe of all particles, and weights of each type at the texels along nu.

    Attributes
    ----------
    g : float
        Parameter of the Cornette-Shanks function. [1]
    lobe : array, shape (kinds, nl, angles)
        Weights w of the lobe's table. [1]
    smooth : array, shape (kinds, nl, angles)
        Weights v of the table of the Rayleigh phase function. [1]
    fitted : tuple of FittedFormula
        Report of each type.
    """

    g: float
    lobe: FloatArray
    smooth: FloatArray
    fitted: tuple[FittedFormula, ...]


def fit_weighted_lobe(
    names: tuple[str, ...],
    phases: Any,
    shares: FloatArray,
    angles: int,
    *,
    one_row: bool = False,
) -> WeightedLobe:
    """Least squares fit of relative errors, weighted by scattering.

    Parameters
    ----------
    names : tuple of str
        Names of the types of particles.
    phases : callable
        ``phases(k, nu)``: phase function of type k, from nu (n,) to (n, nl). [sr⁻¹]
    shares : array, shape (kinds, nl)
        Scattering optical depths of types and wavelengths, as weights.
    angles : int
        Number of equidistant texels in nu from -1 to 1.
    one_row : bool
        Whether w is one row times a factor per wavelength.

    Returns
    -------
    WeightedLobe
        Fit; g is 0 without particles.
    """
    if not names:
        nothing = np.zeros((0, shares.shape[-1], angles))
        return WeightedLobe(g=0.0, lobe=nothing, smooth=nothing, fitted=())
    share = np.linspace(0.0, 1.0, _NODES) ** 2
    theta = np.radians(NEAREST + (180.0 - NEAREST) * share)
    nu = np.cos(theta)
    goal = np.stack([phases(k, nu).T for k in range(len(names))])
    hats = hat_functions(nu, angles)
    importance = shares / shares.sum()

    def cost(g: float) -> float:
        _, error = _solve(g, nu, hats, goal)
        return float((importance * (error**2).mean(axis=-1)).sum())

    g = _smallest(cost)
    weights, error = _solve(g, nu, hats, goal)
    if one_row:
        weights, error = _in_one_row(g, nu, hats, goal, weights)
    plain = np.ones((nu.size, 1))

    def cost_alone(g: float) -> float:
        _, error = _solve(g, nu, plain, goal, smooth=False)
        return float((importance * (error**2).mean(axis=-1)).sum())

    g_alone = _smallest(cost_alone)
    alone = _solve(g_alone, nu, plain, goal, smooth=False)[1]
    where = f"{NEAREST:g} to 180 deg from the sun, denser near it"
    fitted = tuple(
        FittedFormula(
            name=f"{name}: phase function",
            form=f"Cornette-Shanks times weights at the table's {angles} angles to the sun",
            parameters={"g": g},
            errors={
                "root mean square, relative": _rms(error[k]),
                "largest, relative": float(np.abs(error[k]).max()),
                "at the worst angle [deg]": float(
                    np.degrees(theta[np.abs(error[k]).max(axis=0).argmax()])
                ),
                f"root mean square without weights, g = {g_alone:.3f}": _rms(alone[k]),
            },
            where=where,
        )
        for k, name in enumerate(names)
    )
    return WeightedLobe(
        g=g, lobe=weights[..., :angles], smooth=weights[..., angles:], fitted=fitted
    )


def hat_functions(nu: FloatArray, angles: int) -> FloatArray:
    """Weights of the texels in linear interpolation along nu, shape (n, angles). [1]

    Examples
    --------
    >>> hat_functions(np.array([-1.0, 0.0]), 8)[:, :5].tolist()
    [[1.0, 0.0, 0.0, 0.0, 0.0], [0.0, 0.0, 0.0, 0.5, 0.5]]
    """
    x = 0.5 * (nu + 1.0) * (angles - 1)
    return np.asarray(np.maximum(0.0, 1.0 - np.abs(x[:, None] - np.arange(angles))))


def _solve(
    g: float, nu: FloatArray, hats: FloatArray, goal: FloatArray, *, smooth: bool = True
) -> tuple[FloatArray, FloatArray]:
    """Weights (kinds, nl, columns) and relative errors (kinds, nl, n) for a value of g."""
    lobe: Any = vectorized(cornette_shanks)
    columns = [hats * lobe(nu, g)[:, None]]
    if smooth:
        even: Any = vectorized(rayleigh)
        columns.append(hats * even(nu, 0.0)[:, None])
    functions = np.hstack(columns)
    weights = np.empty((*goal.shape[:2], functions.shape[1]))
    error = np.empty_like(goal)
    for k, l in np.ndindex(*goal.shape[:2]):
        relative = functions / goal[k, l][:, None]
        weights[k, l] = nnls(relative, np.ones(nu.size))[0]
        error[k, l] = relative @ weights[k, l] - 1.0
    return weights, error


def _in_one_row(
    g: float, nu: FloatArray, hats: FloatArray, goal: FloatArray, start: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Weights and errors as in ``_solve``, with one row of w times factors, from a start."""
    kinds, count, n = goal.shape
    angles = hats.shape[1]
    narrow: Any = vectorized(cornette_shanks)
    even: Any = vectorized(rayleigh)
    lobe, smooth = hats * narrow(nu, g)[:, None], hats * even(nu, 0.0)[:, None]
    weights, error = np.empty_like(start), np.empty_like(goal)
    for k in range(kinds):
        ahead = start[k, :, angles - 1]
        factors = np.clip(ahead / max(ahead[0], 1e-9), *_FACTORS)
        for _ in range(_TURNS):
            joint = np.zeros((count * n, angles * (1 + count)))
            for l in range(count):
                rows = slice(l * n, (l + 1) * n)
                joint[rows, :angles] = factors[l] * lobe / goal[k, l][:, None]
                joint[rows, angles * (l + 1) : angles * (l + 2)] = smooth / goal[k, l][:, None]
            row = nnls(joint, np.ones(count * n), maxiter=100 * joint.shape[1])[0][:angles]
            for l in range(count):
                functions = np.column_stack([lobe @ row, smooth]) / goal[k, l][:, None]
                found = nnls(functions, np.ones(n))[0]
                factors[l] = max(found[0], 1e-3)
                weights[k, l, :angles] = found[0] * row
                weights[k, l, angles:] = found[1:]
                error[k, l] = functions @ found - 1.0
    return weights, error


def _smallest(cost: Any) -> float:
    """Parameter g of minimal cost: the best of even steps, refined."""
    steps = np.linspace(*_G, _STEPS)
    best = int(np.argmin([cost(float(g)) for g in steps]))
    around = (steps[max(best - 1, 0)], steps[min(best + 1, _STEPS - 1)])
    return float(minimize_scalar(cost, bounds=around, method="bounded", options={"xatol": 1e-3}).x)


def _rms(error: FloatArray) -> float:
    return float(np.sqrt((error**2).mean()))
