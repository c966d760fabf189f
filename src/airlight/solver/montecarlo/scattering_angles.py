"""Exact sampling of scattering angles.

Each phase function is encoded as a kind, three numbers and, for tables, rows, from which compiled
loops sample cosines and evaluate it. Formulas with an invertible distribution function have a kind
of their own (``EXACT``); all others are represented by their ``sampled`` table.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import acos, cos, exp, log, pi, sqrt
from typing import TYPE_CHECKING, Final, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import compiled_loop, inlined, kernel, vectorized
from airlight.physics.optics.phase_functions import cornette_shanks, henyey_greenstein, rayleigh
from airlight.physics.optics.phase_matrix import rayleigh_ratios, unpolarising_ratio
from airlight.physics.optics.phase_table import SMALLEST_LOGARITHMIC
from airlight.planets.matter.phases import FormulaPhase, PhaseFunction, PhaseRow
from airlight.solver.montecarlo.streams import uniform

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

NOTHING: Final = 0
RAYLEIGH: Final = 1
HENYEY: Final = 2
DOUBLE_HENYEY: Final = 3
CORNETTE: Final = 4
TABLE: Final = 5
#: Phase functions with an exact sampler, by their names in planet files.
EXACT: Final = {
    "rayleigh": RAYLEIGH,
    "henyey-greenstein": HENYEY,
    "double-henyey-greenstein": DOUBLE_HENYEY,
    "cornette-shanks": CORNETTE,
}

_LEAST: Final = float(SMALLEST_LOGARITHMIC)


#: Angles [rad], values [sr⁻¹], distribution function [1] and ratios (3, m) [1] of a table.
_Row: TypeAlias = tuple[FloatArray, FloatArray, FloatArray, FloatArray]


class Lobes(NamedTuple):
    """Phase functions of all constituents at one wavelength.

    Attributes
    ----------
    kinds : array of int, shape (nc,)
        Kind of each: ``RAYLEIGH``, ... ``TABLE``; ``NOTHING`` does not scatter.
    parameters : array, shape (nc, 3)
        Depolarisation; g; g₁, g₂, α; g; or for a table: first row, number of rows (1 or 2) and
        weight of the first row.
    angles : array, shape (rows, m)
        Angles of tables, ascending from 0 to π; padded with π. [rad]
    values : array, shape (rows, m)
        Values of tables, normalised to 1. [sr⁻¹]
    cumulative : array, shape (rows, m)
        Distribution function of the scattering angle. [1]
    ratios : array, shape (rows, 3, m)
        F₁₂, F₃₃ and F₃₄ over the phase function of tables. [1]
    """

    kinds: NDArray[np.int64]
    parameters: FloatArray
    angles: FloatArray
    values: FloatArray
    cumulative: FloatArray
    ratios: FloatArray


def lobes(medium: Medium, wavelength: int, clouds: Sequence[PhaseFunction] = ()) -> Lobes:
    """Phase functions of a medium at one of its wavelengths, and those of clouds.

    Tables are normalised, since those of a planet integrate to 1 only within 0.001.
    """
    nm = medium.wavelengths[wavelength : wavelength + 1]
    phases = [
        one.phase_function_at(nm)
        if one.scatters and medium.scattering[i, wavelength] > 0.0
        else None
        for i, one in enumerate(medium.constituents)
    ]
    phases += clouds
    count = len(phases)
    kinds, parameters = np.zeros(count, np.int64), np.zeros((count, 3))
    rows: list[_Row] = []
    for i, phase in enumerate(phases):
        if phase is None:
            continue
        if isinstance(phase, FormulaPhase) and phase.keyword in EXACT:
            kinds[i] = EXACT[phase.keyword]
            given = phase.parameters_at(nm)[:, 0]
            parameters[i, : given.size] = given
        else:
            kinds[i] = TABLE
            parameters[i] = _add_rows(phase.sampled(float(nm[0])), rows)
    longest = max((row[0].size for row in rows), default=2)
    arrays = np.zeros((3, max(len(rows), 1), longest))
    arrays[0], arrays[2] = pi, 1.0
    ratios = np.zeros((max(len(rows), 1), 3, longest))
    for at, (*row, matrix) in enumerate(rows):
        for array, part in zip(arrays, row, strict=True):
            array[at, : part.size] = part
        ratios[at, :, : matrix.shape[1]] = matrix
    return Lobes(kinds, parameters, arrays[0], arrays[1], arrays[2], ratios)


def _add_rows(sampled: tuple[PhaseRow, ...], rows: list[_Row]) -> tuple[float, float, float]:
    """Append the one or two rows at a wavelength; returns the parameters of their mixture."""
    first = len(rows)
    light = []
    for row in sampled:
        angles = np.radians(row.angles)
        angles[-1] = pi
        within = np.concatenate([[0.0], np.cumsum(cell_probability(angles, row.values))])
        light.append(row.share * within[-1])
        ratios = row.ratios
        if ratios is None:
            across = vectorized(unpolarising_ratio)(np.cos(angles))
            ratios = np.stack([np.zeros(angles.size), across, np.zeros(angles.size)])
        rows.append((angles, row.values / within[-1], within / within[-1], ratios))
    fraction = light[0] / sum(light)
    return float(first), float(len(sampled)), float(fraction)


def cell_probability(angles: FloatArray, values: FloatArray) -> FloatArray:
    r"""Probability of scattering into each interval of angles of a table.

    .. math:: 2\pi \int p_0 e^{a(\theta - \theta_0)} \sin\theta\, d\theta

    by Gauss-Legendre quadrature, with linear interpolation next to values of 0.

    Parameters
    ----------
    angles, values : array, shape (m,)
        Angles and phase function. [rad], [sr⁻¹]

    Returns
    -------
    array, shape (m - 1,)
        Probability of each interval. [1]
    """
    from airlight.geometry.quadrature import gauss_legendre

    rule = gauss_legendre(32)
    low, high = values[:-1, None], values[1:, None]
    width = np.diff(angles)[:, None]
    fraction = rule.nodes
    positive = (low > _LEAST) & (high > _LEAST)
    safe_low, safe_high = np.where(positive, low, 1.0), np.where(positive, high, 1.0)
    p = np.where(
        positive, safe_low * (safe_high / safe_low) ** fraction, low + fraction * (high - low)
    )
    rings = np.sin(angles[:-1, None] + width * fraction) * width
    return np.asarray(2.0 * pi * ((p * rings) @ rule.weights))


@kernel
def rayleigh_cosine(u, depolarisation):
    r"""Inverse of the distribution function of Rayleigh scattering, in closed form. [1]

    With A = 1+3γ, B = 1-γ it is the real root of ν³ + 3(A/B)ν = (2u-1)(3A/B + 1) (Cardano).

    Parameters
    ----------
    u : float
        Random number, 0 to 1.
    depolarisation : float
        Depolarisation factor δ, with γ = δ/(2-δ). [1]

    Examples
    --------
    >>> rayleigh_cosine(0.5, 0.0), round(rayleigh_cosine(1.0, 0.0), 12)
    (0.0, 1.0)
    """
    gamma = depolarisation / (2.0 - depolarisation)
    third = (1.0 + 3.0 * gamma) / (1.0 - gamma)
    half = (u - 0.5) * (3.0 * third + 1.0)
    if half == 0.0:
        return 0.0
    size = abs(half)
    root = (size + sqrt(size * size + third * third * third)) ** (1.0 / 3.0)
    nu = min(root - third / root, 1.0)
    return nu if half > 0.0 else -nu


@kernel
def henyey_greenstein_cosine(u, g):
    r"""Inverse of the distribution function of Henyey-Greenstein, without a division by g. [1]

    .. math:: \nu = \frac{s(1+g^2) + \frac{g}{2}\left(3 - g^2 + s^2(1+g^2)\right)}{(1+gs)^2},
              \quad s = 2u - 1

    This is Witt's (1977) formula, expanded.

    Parameters
    ----------
    g : float
        Mean cosine, between -1 and 1.

    References
    ----------
    Witt (1977), Astrophysical Journal Supplement 35, 1, eq. 19. doi:10.1086/190463

    Examples
    --------
    >>> henyey_greenstein_cosine(0.75, 0.0), round(henyey_greenstein_cosine(1.0, 0.9), 12)
    (0.5, 1.0)
    """
    s = 2.0 * u - 1.0
    square = 1.0 + g * g
    bottom = 1.0 + g * s
    top = s * square + 0.5 * g * (3.0 - g * g + s * s * square)
    return min(max(top / (bottom * bottom), -1.0), 1.0)


@inlined
def _table_place(angles, angle):
    """Index of the tabulated angle below, and fraction of the step to the next."""
    low, high = 0, angles.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if angles[middle] <= angle:
            low = middle
        else:
            high = middle
    width = angles[low + 1] - angles[low]
    return low, (angle - angles[low]) / width if width > 0.0 else 0.0


@inlined
def _table_value(angles, values, angle):
    """Phase function of a table, with its logarithm linear in angle."""
    low, fraction = _table_place(angles, angle)
    before, after = values[low], values[low + 1]
    if before > _LEAST and after > _LEAST:
        return before * exp(fraction * log(after / before))
    return before + fraction * (after - before)


@inlined
def _table_cosine(angles, values, cumulative, state):
    """Cosine sampled from a table: the interval by inversion, within it by rejection."""
    u = uniform(state)
    low, high = 0, cumulative.size - 1
    while high - low > 1:
        middle = (low + high) // 2
        if cumulative[middle] <= u:
            low = middle
        else:
            high = middle
    start, end = cos(angles[low]), cos(angles[low + 1])
    before, after = values[low], values[low + 1]
    most = max(before, after)
    width = angles[low + 1] - angles[low]
    while True:
        nu = start + (end - start) * uniform(state)
        fraction = (acos(min(max(nu, -1.0), 1.0)) - angles[low]) / width
        fraction = min(max(fraction, 0.0), 1.0)
        if before > _LEAST and after > _LEAST:
            value = before * exp(fraction * log(after / before))
        else:
            value = before + fraction * (after - before)
        if uniform(state) * most <= value:
            return nu


@compiled_loop
def random_cosine(lobes, i, state):
    """Sampled cosine of the scattering angle of constituent i.

    Parameters
    ----------
    state : array, shape (1,)
        Stream of random numbers.

    Returns
    -------
    float
        Cosine, -1 to 1. [1]
    """
    kind = lobes.kinds[i]
    first = lobes.parameters[i, 0]
    if kind == RAYLEIGH:
        return rayleigh_cosine(uniform(state), first)
    if kind == HENYEY:
        return henyey_greenstein_cosine(uniform(state), first)
    if kind == DOUBLE_HENYEY:
        g = first if uniform(state) < lobes.parameters[i, 2] else lobes.parameters[i, 1]
        return henyey_greenstein_cosine(uniform(state), g)
    if kind == CORNETTE:
        # Proportional to (1 + ν²) times Henyey-Greenstein: at least half are accepted.
        while True:
            nu = henyey_greenstein_cosine(uniform(state), first)
            if 2.0 * uniform(state) <= 1.0 + nu * nu:
                return nu
    row = int(first)
    if lobes.parameters[i, 1] > 1.0 and uniform(state) >= lobes.parameters[i, 2]:
        row += 1
    return _table_cosine(lobes.angles[row], lobes.values[row], lobes.cumulative[row], state)


@compiled_loop
def lobe_value(lobes, i, nu):
    """Phase function of constituent i, normalised. [sr⁻¹]

    Parameters
    ----------
    nu : float
        Cosine of the scattering angle. [1]
    """
    kind = lobes.kinds[i]
    first = lobes.parameters[i, 0]
    if kind == RAYLEIGH:
        return rayleigh(nu, first)
    if kind == HENYEY:
        return henyey_greenstein(nu, first)
    if kind == CORNETTE:
        return cornette_shanks(nu, first)
    if kind == DOUBLE_HENYEY:
        fraction = lobes.parameters[i, 2]
        return fraction * henyey_greenstein(nu, first) + (1.0 - fraction) * henyey_greenstein(
            nu, lobes.parameters[i, 1]
        )
    if kind == TABLE:
        row = int(first)
        angle = acos(min(max(nu, -1.0), 1.0))
        value = _table_value(lobes.angles[row], lobes.values[row], angle)
        if lobes.parameters[i, 1] > 1.0:
            other = _table_value(lobes.angles[row + 1], lobes.values[row + 1], angle)
            fraction = lobes.parameters[i, 2]
            value = fraction * value + (1.0 - fraction) * other
        return value
    return 0.0


@compiled_loop
def lobe_ratios(lobes, i, nu):
    """Elements F₁₂, F₂₂, F₃₃, F₃₄ and F₄₄ over F₁₁ of constituent i's phase matrix. [1]"""
    if lobes.kinds[i] == RAYLEIGH:
        across, along, turned, circular = rayleigh_ratios(nu, lobes.parameters[i, 0])
        return across, along, turned, 0.0, circular
    if lobes.kinds[i] != TABLE:
        turned = unpolarising_ratio(nu)
        return 0.0, 1.0, turned, 0.0, turned
    first = int(lobes.parameters[i, 0])
    angle = acos(min(max(nu, -1.0), 1.0))
    whole, across, turned, skew = 0.0, 0.0, 0.0, 0.0
    for k in range(int(lobes.parameters[i, 1])):
        row = first + k
        fraction = lobes.parameters[i, 2] if k == 0 else 1.0 - lobes.parameters[i, 2]
        weight = fraction * _table_value(lobes.angles[row], lobes.values[row], angle)
        low, part = _table_place(lobes.angles[row], angle)
        ratios = lobes.ratios[row]
        whole += weight
        across += weight * (ratios[0, low] + part * (ratios[0, low + 1] - ratios[0, low]))
        turned += weight * (ratios[1, low] + part * (ratios[1, low + 1] - ratios[1, low]))
        skew += weight * (ratios[2, low] + part * (ratios[2, low + 1] - ratios[2, low]))
    if not whole > 0.0:
        return 0.0, 1.0, 0.0, 0.0, 0.0
    return across / whole, 1.0, turned / whole, skew / whole, turned / whole
