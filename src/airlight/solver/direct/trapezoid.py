r"""Trapezoid rules on a line, on a rectangle and on the sphere, uniform and graded.

The uniform rules are those of the Atmosphere Plus notes. The graded rule is the same after the
substitution x = t - sin(2πt)/2π (Sidi 1993), whose slope vanishes at both ends, which removes the
end-point error of the trapezoid: 16 steps integrate exp(-5x) to 1e-6 instead of 8e-3.
"""

from __future__ import annotations

import itertools
from math import pi

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import Rule

FloatArray = NDArray[np.float64]

#: Amplitude by which the graded turn's steps are concentrated towards the sun. [1]
_TOWARDS_SUN = 0.7


def weights_1d(steps: int) -> FloatArray:
    """Weights of the trapezoid rule over ``steps`` steps, in steps: 1/2, 1, …, 1, 1/2.

    Parameters
    ----------
    steps : int
        Number of steps, at least 1.

    Returns
    -------
    array, shape (steps + 1,)
        Weights in units of a step. [1]

    References
    ----------
    Atmosphere Plus notes 2, section 4.1.
    """
    weights = np.ones(steps + 1)
    weights[[0, -1]] = 0.5
    return weights


def weights_2d(steps: int, steps_2: int) -> FloatArray:
    """Weights of the trapezoid rule on a rectangle, in cells: 1/4 in corners, 1/2 on edges, 1.

    Parameters
    ----------
    steps, steps_2 : int
        Number of steps along each side.

    Returns
    -------
    array, shape (steps + 1, steps_2 + 1)
        Weights in units of a cell. [1]

    References
    ----------
    Atmosphere Plus notes 2, section 4.2, where they are given as 1, 2 and 4 quarters. They are the
    products of the weights of two nested rules, so that nesting is equally accurate (unlike notes
    1, section 1.8).

    Examples
    --------
    >>> weights_2d(2, 2) * 4
    array([[1., 2., 1.],
           [2., 4., 2.],
           [1., 2., 1.]])
    """
    return np.outer(weights_1d(steps), weights_1d(steps_2))


def uniform(steps: int) -> Rule:
    """Trapezoid rule on [0, 1] with equal steps, ends included, and its running sums.

    Returns
    -------
    Rule
        Rule with ``steps + 1`` nodes.

    Examples
    --------
    >>> rule = uniform(4)
    >>> float(rule.weights @ rule.nodes)
    0.5
    """
    nodes = np.linspace(0.0, 1.0, steps + 1)
    running = np.tril(np.full((steps + 1, steps + 1), 1.0 / steps))
    running[:, 0] *= 0.5
    running[np.diag_indices(steps + 1)] *= 0.5
    running[0, 0] = 0.0
    return _frozen(nodes, weights_1d(steps) / steps, running)


def graded(steps: int) -> Rule:
    """Trapezoid rule on [0, 1] in t with x = t - sin(2πt)/2π; the ends have no weight.

    Returns
    -------
    Rule
        Rule with ``steps - 1`` nodes inside (0, 1). Its running integrals are those of cubics
        through four neighbours.

    References
    ----------
    A. Sidi (1993), A new variable transformation for numerical integration, in Numerical
    Integration IV, ISNM 112, 359, with m = 1.

    Examples
    --------
    >>> import numpy as np
    >>> rule = graded(16)  # error 1e-6, with sixteen equal steps 8e-3
    >>> f"{rule.weights @ np.exp(-5 * rule.nodes):.6f}, exact {(1 - np.exp(-5)) / 5:.6f}"
    '0.198653, exact 0.198652'
    """
    t = np.arange(steps + 1) / steps
    slope = 1.0 - np.cos(2.0 * pi * t)
    # Over one step: (-F[k-1] + 13 F[k] + 13 F[k+1] - F[k+2]) / 24, F = f·slope, even at the ends.
    step = np.zeros((steps, steps + 1))
    for k in range(steps):
        for at, weight in ((k - 1, -1.0), (k, 13.0), (k + 1, 13.0), (k + 2, -1.0)):
            mirrored = abs(at) if at <= steps else 2 * steps - at
            step[k, mirrored] += weight / (24.0 * steps)
    running = np.cumsum(step, axis=0)[:-1] * slope
    return _frozen(
        (t - np.sin(2.0 * pi * t) / (2.0 * pi))[1:-1], (slope / steps)[1:-1], running[:, 1:-1]
    )


def _frozen(nodes: FloatArray, weights: FloatArray, running: FloatArray) -> Rule:
    rule = Rule(nodes, weights, np.ascontiguousarray(running))
    for array in (rule.nodes, rule.weights, rule.running):
        array.setflags(write=False)
    return rule


def sphere(
    zenith_steps: int, azimuth_steps: int, cuts: tuple[float, ...], *, grade: bool
) -> tuple[FloatArray, FloatArray, FloatArray]:
    r"""Directions for integrals over the sphere of functions that are even in azimuth.

    .. math:: \int_{4\pi} f\, d\omega = \int_0^{2\pi} \int_0^\pi f \sin\Theta\, d\Theta\, d\Phi

    The rule in Φ has ``azimuth_steps`` steps over the whole turn; directions mirrored in the plane
    Φ = 0 are represented by one, with the weight of both. If graded, Φ = t - 0.7 sin t with equal
    steps in t: three times finer towards the sun, where haze is bright, and as accurate for smooth
    functions, which are periodic.

    Parameters
    ----------
    zenith_steps : int
        Number of steps in Θ on each interval.
    azimuth_steps : int
        Number of steps in Φ over 2π, even.
    cuts : tuple of float
        Ends of the intervals of Θ, ascending, such as (0, horizon, π). [rad]
    grade : bool
        Whether the rules are graded rather than uniform.

    Returns
    -------
    zenith : array, shape (nz,)
        Zenith angles Θ. [rad]
    azimuth : array, shape (azimuth_steps / 2 + 1,)
        Azimuths Φ from 0 to π. [rad]
    weights : array, shape (nz, azimuth_steps / 2 + 1)
        Solid angles; the sum is 4π for cuts from 0 to π, within the accuracy of the rule. [sr]

    References
    ----------
    Atmosphere Plus notes 2, section 4.3.

    Examples
    --------
    >>> zenith, azimuth, weights = sphere(12, 24, (0.0, 3.141592653589793), grade=True)
    >>> f"{weights.sum():.4f}"  # 4π
    '12.5663'
    """
    rule = (graded if grade else uniform)(zenith_steps)
    angles, lengths = [], []
    for low, high in itertools.pairwise(cuts):
        angles.append(low + (high - low) * rule.nodes)
        lengths.append((high - low) * rule.weights)
    zenith = np.concatenate(angles)
    half = azimuth_steps // 2
    t = np.linspace(0.0, pi, half + 1)
    grading = _TOWARDS_SUN if grade else 0.0
    around = 2.0 * weights_1d(half) * (pi / half) * (1.0 - grading * np.cos(t))
    weights = np.outer(np.concatenate(lengths) * np.sin(zenith), around)
    return zenith, t - grading * np.sin(t), weights
