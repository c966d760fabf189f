"""Density profiles over altitude, as analytic segments.

Each profile is a row of segments; within each, the relative density is
``max(0, a·exp(b·x) + c·x + d)`` with x the height above the segment's lower edge. This represents
the exponential, the tent, Bruneton's layers and (in small exponential pieces) any table without
error, and its vertical column has a closed form. Over a segment ``abs(b·x)`` is at most 700.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.kernel import compiled_loop, kernel
from airlight.physics.optics.altitude_nodes import altitude_nodes, node_altitudes
from airlight.physics.units import values_in

FloatArray = npt.NDArray[np.float64]

#: Profile: its edges, shape (ns + 1,) [m], and its coefficients (a, b, c, d), shape (ns, 4).
Row = tuple[FloatArray, FloatArray]

#: Largest magnitude of a term of a layer; beyond it the sum suffers cancellation.
_LARGEST_TERM: Final = 1e6
#: Largest number of inner edges that count as breakpoints; more represent a smooth curve.
_MOST_BREAKPOINTS: Final = 12
#: Density over its largest above which a layer counts as dense.
DENSE: Final = 0.01
#: Largest width of a thin layer, aloft and on the ground, over the thickness of the shell.
THIN: Final = 0.12
_THIN_ON_GROUND: Final = 0.015


@kernel
def segment_density(x: float, a: float, b: float, c: float, d: float) -> float:
    """Relative density within one segment: max(0, a·exp(b·x) + c·x + d). [1]

    Parameters
    ----------
    x : float
        Height above the segment's lower edge. [m]
    a, d : float
        Factor of the exponential, and the constant. [1]
    b, c : float
        Rate of the exponential, and slope. [m⁻¹]
    """
    return max(0.0, a * math.exp(b * x) + c * x + d)


@compiled_loop
def relative_density(altitude: float, edges: FloatArray, coefficients: FloatArray) -> float:
    """Relative density of one constituent at an altitude. [1]

    Altitudes outside the shell are clamped, so that rounding at its boundaries is harmless.

    Parameters
    ----------
    altitude : float
        Altitude above the ground. [m]
    edges : array, shape (ns + 1,)
        Edges, ascending; padding repeats the last. [m]
    coefficients : array, shape (ns, 4)
        Coefficients; see ``segment_density``.

    Returns
    -------
    float
        Density, never negative. [1]
    """
    low = 0
    high = coefficients.shape[0]
    h = min(max(altitude, edges[0]), edges[high])
    while high - low > 1:
        middle = (low + high) // 2
        if edges[middle] <= h:
            low = middle
        else:
            high = middle
    return float(
        segment_density(
            h - edges[low],
            coefficients[low, 0],
            coefficients[low, 1],
            coefficients[low, 2],
            coefficients[low, 3],
        )
    )


@compiled_loop
def _relative_densities(
    altitudes: FloatArray, edges: FloatArray, coefficients: FloatArray, out: FloatArray
) -> None:
    for i in range(edges.shape[0]):
        for k in range(altitudes.shape[0]):
            out[i, k] = relative_density(altitudes[k], edges[i], coefficients[i])


@dataclass(frozen=True, eq=False)
class DensitySegments:
    """Profiles of all constituents of a planet, as arrays.

    Parameters
    ----------
    edges : array, shape (nc, ns + 1)
        Altitudes where segments meet, ascending from 0 to the shell's thickness; a row with
        fewer segments repeats its last edge. [m]
    coefficients : array, shape (nc, ns, 4)
        Coefficients a, b, c, d of ``segment_density``.
    known_breakpoints : array, optional
        Breakpoints, if the segments are resampled profiles. [m]
    """

    edges: FloatArray
    coefficients: FloatArray
    known_breakpoints: FloatArray | None = None

    @classmethod
    def from_rows(cls, rows: Sequence[Row]) -> DensitySegments:
        """Rows of different lengths, padded with segments of zero width.

        Examples
        --------
        >>> DensitySegments.from_rows([uniform(1e5), tent(25e3, 15e3, 1e5)]).edges.shape
        (2, 5)
        """
        count = max(len(coefficients) for _, coefficients in rows)
        edges = np.empty((len(rows), count + 1))
        padded = np.zeros((len(rows), count, 4))
        for i, (row_edges, row) in enumerate(rows):
            n = len(row)
            edges[i, : n + 1] = row_edges
            edges[i, n + 1 :] = row_edges[-1]
            padded[i, :n] = row
            padded[i, n:, 3] = segment_density(row_edges[-1] - row_edges[-2], *row[-1])
        edges.flags.writeable = False
        padded.flags.writeable = False
        return cls(edges, padded)

    @property
    def thickness(self) -> float:
        """Thickness of the shell. [m]"""
        return float(self.edges[0, -1])

    @cached_property
    def first_nodes(self) -> FloatArray:
        """Index of the first altitude node of each cell, see ``altitude_nodes``. [1]"""
        return altitude_nodes(self.edges, self.coefficients)

    @cached_property
    def node_altitudes(self) -> FloatArray:
        """Altitudes of the nodes, ascending, shape (n,). [m]"""
        return node_altitudes(self.first_nodes, self.thickness)

    @cached_property
    def at_nodes(self) -> FloatArray:
        """Relative densities at the altitude nodes, shape (nc, n). [1]"""
        return self.at(self.node_altitudes)

    @cached_property
    def breakpoints(self) -> FloatArray:
        """Altitudes of breakpoints of the profiles, ascending, shape (n,). [m]

        All edges of profiles with few segments; for one segment, or many that represent a smooth
        curve, the boundaries of thin layers.
        """
        if self.known_breakpoints is not None:
            return self.known_breakpoints
        found: set[float] = set()
        for edges, profile in zip(self.edges, self.at_nodes, strict=True):
            inside = np.unique(edges[(edges > edges[0]) & (edges < edges[-1])])
            if not 0 < inside.size <= _MOST_BREAKPOINTS:
                ends = np.ravel(thin_runs(profile, self.node_altitudes))
                inside = ends[(ends > 0.0) & (ends < self.thickness)]
            found.update(inside.tolist())
        return np.array(sorted(found))

    def below(self, altitude: float) -> DensitySegments:
        """Profiles of a shell that ends at an altitude, with the same columns. [m]"""
        cut = DensitySegments(np.minimum(self.edges, altitude), self.coefficients)
        factor = np.ones_like(self.coefficients)
        factor[..., [0, 2, 3]] = (self.columns / np.maximum(cut.columns, 1e-300))[:, None, None]
        scaled = self.coefficients * factor
        cut.edges.flags.writeable = scaled.flags.writeable = False
        return DensitySegments(cut.edges, scaled)

    @property
    def arrays(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Edges, coefficients and breakpoints, as arguments of compiled loops. [m], [1], [m]"""
        return self.edges, self.coefficients, self.breakpoints

    def at(self, altitudes: npt.ArrayLike) -> FloatArray:
        """Relative densities of every constituent.

        Parameters
        ----------
        altitudes : array, shape (...)
            Altitudes above the ground. [m]

        Returns
        -------
        array, shape (nc, ...)
            Densities. [1]

        Examples
        --------
        >>> segments = DensitySegments.from_rows([exponential(8e3, 1e5), tent(25e3, 15e3, 1e5)])
        >>> segments.at([0.0, 8e3, 25e3]).round(4).tolist()
        [[1.0, 0.3679, 0.0439], [0.0, 0.0, 1.0]]
        """
        h = values_in(altitudes, "m", "altitudes")
        out = np.empty((len(self.edges), h.size))
        _relative_densities(h.ravel(), self.edges, self.coefficients, out)
        return out.reshape(len(self.edges), *h.shape)

    @cached_property
    def columns(self) -> FloatArray:
        """Vertical column of every constituent, ∫ density dh over the whole shell.

        Returns
        -------
        array, shape (nc,)
            Columns. [m]

        Examples
        --------
        >>> column = DensitySegments.from_rows([exponential(8e3, 1e5)]).columns[0]
        >>> f"{column:.4f}"  # 8 km (1 - exp(-100/8))
        '7999.9702'
        """
        return np.array(
            [row_column((e, k)) for e, k in zip(self.edges, self.coefficients, strict=True)]
        )


def thin_runs(
    profile: FloatArray, altitude: FloatArray, widest: float = THIN
) -> list[tuple[float, float]]:
    """Bottom and top of each thin layer in which a profile exceeds 1 % of its maximum. [m]

    Parameters
    ----------
    profile, altitude : array, shape (n,)
        Densities [1] at ascending altitudes, from the ground to the top of the shell. [m]
    widest : float
        Largest width of a layer aloft, over the thickness of the shell; of one on the ground it is
        0.015. [1]
    """
    dense = np.concatenate([[False], profile > DENSE * profile.max(), [False]])
    changes = np.flatnonzero(dense[1:] != dense[:-1])
    runs = []
    for first, last in zip(changes[::2], changes[1::2] - 1, strict=True):
        width = altitude[last] - altitude[first]
        if 0.0 < width < (_THIN_ON_GROUND if first == 0 else widest) * altitude[-1]:
            runs.append((float(altitude[first]), float(altitude[last])))
    return runs


def row_column(row: Row) -> float:
    r"""Exact vertical column of one profile.

    .. math:: \sum_k \frac{a}{b}\left(e^{bL}-1\right) + \frac{c L^2}{2} + d L

    Parameters
    ----------
    row : tuple of arrays
        Edges, shape (ns + 1,) [m], and coefficients, shape (ns, 4).

    Returns
    -------
    float
        Column. [m]
    """
    edges, coefficients = row
    length = np.diff(edges)
    a, b, c, d = coefficients.T
    rate = np.where(b == 0.0, 1.0, b)
    exponential_part = np.where(b == 0.0, a * length, a * np.expm1(b * length) / rate)
    return float(np.sum(exponential_part + length * (0.5 * c * length + d)))


def exponential(scale_height: float, thickness: float) -> Row:
    """Segments of exp(-h/H).

    Parameters
    ----------
    scale_height : float
        Scale height H. [m]
    thickness : float
        Thickness of the shell. [m]
    """
    return np.array([0.0, thickness]), np.array([[1.0, -1.0 / scale_height, 0.0, 0.0]])


def uniform(thickness: float) -> Row:
    """Segment of density 1 from the ground to the top."""
    return np.array([0.0, thickness]), np.array([[0.0, 0.0, 0.0, 1.0]])


def tent(center: float, half_width: float, thickness: float) -> Row:
    """Segments of ``max(0, 1 - |h - center|/half_width)``, cut off at the ground and the top.

    Parameters
    ----------
    center, half_width : float
        Altitude of the peak, and distance from it to where the density is 0. [m]
    thickness : float
        Thickness of the shell. [m]
    """
    corners = (center - half_width, center, center + half_width)
    edges = np.array([0.0, *(h for h in corners if 0.0 < h < thickness), thickness])
    middles = 0.5 * (edges[:-1] + edges[1:])
    rows = np.zeros((len(middles), 4))
    for k, (low, middle) in enumerate(zip(edges[:-1], middles, strict=True)):
        if abs(middle - center) < half_width:
            rows[k, 2] = math.copysign(1.0 / half_width, center - middle)
            rows[k, 3] = 1.0 - abs(low - center) / half_width
    return edges, rows


@dataclass(frozen=True, kw_only=True)
class LayerTerms:
    """Bruneton's density layer: exp_term·e^(exp_scale·h) + linear_term·h + constant_term.

    The result is clamped to [0, 1]; h is the altitude above the ground, not above the layer.

    Parameters
    ----------
    width : float
        Thickness of the layer; unused for the topmost layer. [m]
    exp_term, constant_term : float
        Factor of the exponential, and the constant. [1]
    exp_scale, linear_term : float
        Rate of the exponential, and slope. [m⁻¹]

    References
    ----------
    Bruneton (2017), Precomputed Atmospheric Scattering: a New Implementation, where it is called
    ``DensityProfileLayer``.
    """

    width: float = 0.0
    exp_term: float = 0.0
    exp_scale: float = 0.0
    linear_term: float = 0.0
    constant_term: float = 0.0

    def unclamped(self, altitude: float) -> float:
        """Sum of the terms before it is clamped. [1]"""
        return (
            self.exp_term * math.exp(self.exp_scale * altitude)
            + self.linear_term * altitude
            + self.constant_term
        )


def layered(layers: Sequence[LayerTerms], thickness: float) -> Row:
    """Segments of Bruneton's layers, cut where a layer meets 0 or 1.

    Parameters
    ----------
    layers : sequence of LayerTerms
        Layers from the ground upwards; the last reaches the top.
    thickness : float
        Thickness of the shell. [m]

    Raises
    ------
    ParameterError
        If a term exceeds a million within the shell.
    """
    edges = [0.0]
    rows: list[tuple[float, float, float, float]] = []
    bottom = 0.0
    for index, layer in enumerate(layers):
        last = index == len(layers) - 1
        top = thickness if last else min(bottom + layer.width, thickness)
        if top <= bottom:
            continue
        _check_terms(layer, index, bottom, top)
        cuts = [bottom, *_cuts(layer, bottom, top), top]
        for low, high in itertools.pairwise(cuts):
            rows.append(_clamped_piece(layer, low, high))
            edges.append(high)
        bottom = top
    return np.array(edges), np.array(rows)


def _check_terms(layer: LayerTerms, index: int, bottom: float, top: float) -> None:
    exponent = max(layer.exp_scale * bottom, layer.exp_scale * top)
    if exponent > 100.0 or abs(layer.exp_term) * math.exp(exponent) > _LARGEST_TERM:
        raise ParameterError(
            f"layers[{index}].exp_scale",
            layer.exp_scale,
            f"exp_term·exp(exp_scale·h) at most {_LARGEST_TERM:g} within the layer",
        )
    if abs(layer.linear_term) * top > _LARGEST_TERM:
        raise ParameterError(
            f"layers[{index}].linear_term",
            layer.linear_term,
            f"linear_term·h at most {_LARGEST_TERM:g} within the layer",
        )


def _cuts(layer: LayerTerms, low: float, high: float) -> list[float]:
    """Altitudes strictly inside (low, high) where the unclamped sum crosses 0 or 1.

    The sum is convex or concave, so it has at most one extremum and is monotone on either side.
    """
    from scipy.optimize import brentq

    bounds = [low, high]
    product = layer.exp_term * layer.exp_scale
    if product != 0.0 and -layer.linear_term / product > 0.0:
        extremum = math.log(-layer.linear_term / product) / layer.exp_scale
        if low < extremum < high:
            bounds.insert(1, extremum)
    found: set[float] = set()
    for level in (0.0, 1.0):

        def above(h: float, level: float = level) -> float:
            return layer.unclamped(h) - level

        for start, stop in itertools.pairwise(bounds):
            if above(start) * above(stop) < 0.0:
                found.add(float(brentq(above, start, stop)))
    return sorted(h for h in found if low < h < high)


def _clamped_piece(layer: LayerTerms, low: float, high: float) -> tuple[float, float, float, float]:
    middle = layer.unclamped(0.5 * (low + high))
    if middle <= 0.0:
        return 0.0, 0.0, 0.0, 0.0
    if middle >= 1.0:
        return 0.0, 0.0, 0.0, 1.0
    return (
        layer.exp_term * math.exp(layer.exp_scale * low),
        layer.exp_scale,
        layer.linear_term,
        layer.constant_term + layer.linear_term * low,
    )
