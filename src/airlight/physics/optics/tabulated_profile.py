"""Density profile from a table over altitude: monotone cubic in the logarithm of the density."""

from __future__ import annotations

import itertools
import math
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.physics.cubic_curves import cubic_curve, monotone_slopes
from airlight.physics.optics.density_profile import Row

FloatArray = npt.NDArray[np.float64]

#: Number of exponential pieces per interval of the table.
PIECES: Final = 8
#: Largest relative density of the extrapolation down to the ground.
_LARGEST: Final = 1e6
#: Steepest exponential of one segment, as an exponent: e^-300 is negligible.
_STEEPEST: Final = 300.0

#: Lower edge, upper edge [m], then a, b, c, d of the segment.
_Piece = tuple[float, float, float, float, float, float]


def tabulated(altitudes: npt.ArrayLike, densities: npt.ArrayLike, thickness: float) -> Row:
    """Segments of a tabulated profile.

    Between positive densities: a monotone cubic (PCHIP) through their logarithms, divided into
    exponential pieces. Next to a density of 0: linear. Outside the table: 0 if the end value is 0;
    otherwise exponential with the slope of the cubic, or constant if it would grow upwards.

    Parameters
    ----------
    altitudes : array, shape (n,)
        Altitudes, strictly ascending, not negative, at least two. [m]
    densities : array, shape (n,)
        Densities relative to that of the coefficients; not negative. [1]
    thickness : float
        Thickness of the shell, where the table is truncated. [m]

    Returns
    -------
    tuple of arrays
        Edges, shape (ns + 1,) [m], and coefficients, shape (ns, 4).

    Raises
    ------
    ParameterError
        If the extrapolation to the ground exceeds a million.

    Examples
    --------
    >>> edges, rows = tabulated([0.0, 10e3], [1.0, math.exp(-1.25)], 1e5)
    >>> float(edges[-1]), rows[0].round(6).tolist()  # the exponential of H = 8 km
    (100000.0, [1.0, -0.000125, 0.0, 0.0])
    """
    h = np.asarray(altitudes, dtype=np.float64)
    density = np.asarray(densities, dtype=np.float64)
    pieces = _below(h, density)
    for first, last in _runs(density):
        if first == last:
            continue
        if density[first] == 0.0 or density[last] == 0.0:
            pieces.append(_line(h[first], h[last], density[first], density[last]))
        else:
            pieces += _cubic(h[first : last + 1], density[first : last + 1])
    pieces += _above(h, density, thickness)
    return _as_row(pieces, thickness)


def _runs(density: FloatArray) -> list[tuple[int, int]]:
    """Index ranges, in order: runs of positive densities, and intervals next to a 0."""
    runs: list[tuple[int, int]] = []
    k = 0
    while k < len(density) - 1:
        last = k + 1
        if density[k] > 0.0 and density[last] > 0.0:
            while last + 1 < len(density) and density[last + 1] > 0.0:
                last += 1
        runs.append((k, last))
        k = last
    return runs


def _cubic(h: FloatArray, density: FloatArray) -> list[_Piece]:
    log_density = np.log(density)
    slopes = monotone_slopes(h, log_density)
    pieces: list[_Piece] = []
    for low, high in itertools.pairwise(h):
        nodes = np.linspace(low, high, PIECES + 1)
        logs = cubic_curve(h, log_density, slopes, nodes)
        rates = np.diff(logs) / np.diff(nodes)
        for k in range(PIECES):
            value = math.exp(logs[k])
            pieces.append((nodes[k], nodes[k + 1], value, float(rates[k]), 0.0, 0.0))
    return pieces


def _line(low: float, high: float, at_low: float, at_high: float) -> _Piece:
    return low, high, 0.0, 0.0, (at_high - at_low) / (high - low), at_low


def _end_rate(h: FloatArray, density: FloatArray, *, top: bool) -> float:
    """Slope of the logarithm at an end of the table; 0 where the neighbour is 0. [m⁻¹]"""
    runs = _runs(density)
    first, last = runs[-1] if top else runs[0]
    if density[first] == 0.0 or density[last] == 0.0:
        return 0.0
    slopes = monotone_slopes(h[first : last + 1], np.log(density[first : last + 1]))
    return float(slopes[-1 if top else 0])


def _below(h: FloatArray, density: FloatArray) -> list[_Piece]:
    if h[0] <= 0.0:
        return []
    if density[0] == 0.0:
        return [_line(0.0, h[0], 0.0, 0.0)]
    rate = _end_rate(h, density, top=False)
    exponent = -rate * h[0]
    if exponent + math.log(density[0]) > math.log(_LARGEST):
        raise ParameterError(
            "altitudes[0]",
            float(h[0]),
            f"0, or a table whose continuation to the ground stays below {_LARGEST:g}",
        )
    # An exponential that vanishes towards the ground starts where it becomes negligible.
    start = h[0] - _STEEPEST / rate if exponent < -_STEEPEST else 0.0
    empty = [_line(0.0, start, 0.0, 0.0)] if start > 0.0 else []
    return [*empty, (start, h[0], density[0] * math.exp(-rate * (h[0] - start)), rate, 0.0, 0.0)]


def _above(h: FloatArray, density: FloatArray, thickness: float) -> list[_Piece]:
    if h[-1] >= thickness:
        return []
    if density[-1] == 0.0:
        return [_line(h[-1], thickness, 0.0, 0.0)]
    rate = min(0.0, _end_rate(h, density, top=True))
    return [(h[-1], thickness, density[-1], rate, 0.0, 0.0)]


def _as_row(pieces: list[_Piece], thickness: float) -> Row:
    """Edges and coefficients of the pieces, truncated at the top of the shell."""
    kept = [piece for piece in pieces if piece[0] < thickness]
    edges = [0.0, *(min(piece[1], thickness) for piece in kept)]
    return np.array(edges), np.array([piece[2:] for piece in kept])
