r"""Correction of single scattering for multiple scattering within the forward peak.

Delta-M scaling treats the fraction f of scattering as unscattered, and the march adds single
scattering by the whole phase function with the scaled extinction (TMS: Nakajima & Tanaka 1988,
JQSRT 40, 51). The peak is then counted both as transmitted along the path and as scattered at each
point: too much by x/(1 - exp(-x)), where x is the optical depth of the peak from the star to the
observer, and it is not broadened by multiple scattering. Like their IMS method, this correction
adds small-angle multiple scattering.

The Legendre moments of the peak are the truncated ones: q_l = f up to the degree of the sweeps, and
p_l, those of the phase function, beyond. In the small-angle approximation the moments after the
optical depth x of the peak are exp(-x (1 - χ_l)), χ_l = q_l/f (Goudsmit & Saunderson 1940,
Phys. Rev. 57, 24), of which exp(-x) is unscattered. One n-th of n-fold scattering is attributed to
each point of the path, so that the phase function p at a point becomes

.. math:: p + f B, \quad B = \sum_l \frac{2l + 1}{4\pi} P_l(\nu)
          \left[\frac{e^{-x (1 - \chi_l)} - e^{-x}}{x} - \chi_l\right].

Its integral is exact for any x, so energy is conserved. The table holds f B/p, the relative gain of
single scattering, as a function of the scattering angle and of x.
"""

from __future__ import annotations

from functools import cache
from math import pi, sqrt
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import inlined
from airlight.kernel.lanes import LANES, lane_view, maximum, splat
from airlight.solver.moments.delta_m import MOST_PEAK, NEGLIGIBLE, Optics

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Numbers of angles, at even steps of the fourth root of sin(θ/2), and of depths x, at even steps
#: of x/(x + MIDDLE): the last is infinite.
ANGLES: Final = 128
DEPTHS: Final = 20
MIDDLE: Final = 2.0
#: Vertical optical depth of the peaks below which there is no correction. [1]
_FAINT: Final = 1e-4
#: Numbers of Legendre moments: usual, and for sharper peaks.
_MOMENTS: Final = (400, 4000)
#: Moment over f below which higher ones are omitted, since they contribute by their square. [1]
_LAST: Final = 5e-3
#: Smallest weight of the peaks on a line, which keeps their mean optical depth finite. [1]
_LEAST: Final = 1e-30


@inlined
def reset_peaks(tables, work):
    """Reset the sums of ``add_peaks``."""
    for at in range(0, tables.lanes, LANES):
        sums = lane_view(work.peaks, at)
        sums[0], sums[1], sums[2] = splat(0.0), splat(0.0), splat(0.0)


@inlined
def add_peaks(star, dimmed, spread, phase, tables, work, at):
    """Add the forward-peak scattering at a point to the sums over its line.

    Parameters
    ----------
    star : lanes
        Direct irradiance at the point, times its weight and the transmittance to the start of the
        line. [m]
    dimmed : lanes or float
        Factor of single scattering. [1]
    spread : bool
        Whether two points represent the star.
    phase : lanes, shape (nc,)
        Phase functions. [sr⁻¹]
    tables, work : MarchTables, MarchWorkspace
        Tables of the solution; workspace with density and columns of the point, whose peaks receive
        single scattering by peaked constituents [sr⁻¹], its truncated part [1], and the latter
        times the optical depth of the peaks on its path. [1]
    at : int
        Index of the first lane.
    """
    extinction, scaled = lane_view(tables.extinction, at), lane_view(tables.scaled_extinction, at)
    inverse, sums = lane_view(tables.inverse_peak_fraction, at), lane_view(work.peaks, at)
    peaked, strength, depth = splat(0.0), splat(0.0), splat(0.0)
    for c in range(tables.constituents):
        part = extinction[c] - scaled[c]
        column = work.columns_to_sun_low[c]
        if spread:
            column = 0.5 * (column + work.columns_to_sun_high[c])
        depth = depth + part * np.float32(work.depths[c] + column)
        part = part * work.point_density[c]
        strength = strength + part
        peaked = peaked + part * inverse[c] * phase[c]
    strength = strength * star
    sums[0] += peaked * (star * dimmed)
    sums[1] += strength
    sums[2] += strength * depth


@inlined
def peak_gain(half_sine, tables, work, at):
    """Relative gain f B/p of single scattering by forward peaks. [1]

    Parameters
    ----------
    half_sine : float
        sin(θ/2) of the angle to the apparent star. [1]
    tables, work, at :
        Arguments of ``add_peaks``, after the last point of the line.
    """
    u = sqrt(sqrt(half_sine)) * (ANGLES - 1)
    node = min(int(u), ANGLES - 2)
    f = np.float32(u - node)
    sums, broadening = lane_view(work.peaks, at), lane_view(tables.broadening, at)
    depth = sums[2] / maximum(sums[1], _LEAST)
    place = depth / (depth + np.float32(MIDDLE)) * np.float32(DEPTHS - 1)
    more = splat(0.0)
    for k in range(DEPTHS):
        away = place - np.float32(k)
        weight = maximum(np.float32(1.0) - maximum(away, 0.0 - away), 0.0)
        low = broadening[k, node]
        more = more + weight * (low + f * (broadening[k, node + 1] - low))
    return more


@inlined
def peak_fraction(constituent, tables, at):
    """Fraction of a constituent's single scattering to which the gain applies; 0 without peak. [1]

    Parameters
    ----------
    tables, at :
        Arguments of ``add_peaks``.
    """
    extinction, scaled = lane_view(tables.extinction, at), lane_view(tables.scaled_extinction, at)
    inverse, scattering = (
        lane_view(tables.inverse_peak_fraction, at),
        lane_view(tables.scattering, at),
    )
    c = constituent
    return (extinction[c] - scaled[c]) * inverse[c] / maximum(scattering[c], _LEAST)


def inverse_peak_fraction(optics: Optics) -> FloatArray:
    """Reciprocal 1/f of the truncated fraction in the thick limit; 0 without a peak. [1]

    Parameters
    ----------
    optics : Optics
        Optics of the medium.

    Returns
    -------
    array, shape (nc, nl)
    """
    part = np.minimum(optics.phases[:, :, -1], MOST_PEAK)
    peaked = (part > NEGLIGIBLE) & (optics.medium.scattering > 0.0)
    return np.asarray(np.divide(1.0, part, out=np.zeros_like(part), where=peaked))


def peak_broadening(optics: Optics) -> FloatArray | None:
    """Table of the relative gain f B/p of single scattering by forward peaks.

    Peaked constituents are averaged by their vertical scattering optical depths.

    Returns
    -------
    array, shape (``DEPTHS``, ``ANGLES``, nl), or None
        Gain, at least -1 [1]; None without truncation.
    """
    medium = optics.medium
    weight = inverse_peak_fraction(optics) > 0.0
    depth = (medium.extinction - optics.extinction) * medium.columns[:, None]
    if depth.sum(axis=0).max() < _FAINT:
        return None
    amount = np.where(weight, medium.scattering * medium.columns[:, None], 0.0)
    amount /= np.maximum(amount.sum(axis=0), _LEAST)
    part = (amount * np.minimum(optics.phases[:, :, -1], MOST_PEAK)).sum(axis=0)
    moments = _mixed_moments(medium, amount, part)
    place = np.arange(DEPTHS - 1) / (DEPTHS - 1)
    x = (MIDDLE * place / (1.0 - place))[:, None]
    nu = 1.0 - 2.0 * np.linspace(0.0, 1.0, ANGLES) ** 8
    harmonics = _legendre(len(moments) - 1)
    phase = (medium.phase_function(nu) * amount).sum(axis=1)
    table = np.zeros((DEPTHS, ANGLES, medium.wavelengths.size))
    inside = optics.degree + 1
    for w in np.flatnonzero(part > NEGLIGIBLE):
        smooth = harmonics[:, :inside] @ (moments[:inside, w] - part[w])
        chi = np.clip(moments[:, w] / part[w], -1.0, 1.0)
        chi[:inside] = 1.0
        unscattered = np.exp(-x)
        several = unscattered * (np.expm1(x * chi) / np.maximum(x, 1e-12) - chi)
        several[0] = 0.0
        wide = np.zeros((DEPTHS, ANGLES))
        wide[:-1] = part[w] * (several @ harmonics.T)
        once = np.ones((DEPTHS, 1))
        once[:-1] = -np.expm1(-x)
        peak = phase[:, w] - smooth
        light = np.divide(
            wide - once * peak, phase[:, w], out=np.zeros_like(wide), where=phase[:, w] > 0.0
        )
        table[:, :, w] = np.maximum(light, -1.0)
    return table


def _mixed_moments(medium: Medium, amount: FloatArray, part: FloatArray) -> FloatArray:
    """Legendre moments of the mean peak, up to the last significant one, shape (l, nl). [1]"""
    peaked = part > NEGLIGIBLE
    part = part[peaked]
    for count in _MOMENTS:
        nu, weights = _quadrature(count)
        kept = (medium.phase_function(nu) * amount).sum(axis=1) * weights[:, None]
        moments = np.empty((count + 1, kept.shape[1]))
        before, value = np.zeros_like(nu), np.ones_like(nu)
        for l in range(count + 1):
            moments[l] = value @ kept
            before, value = value, ((2 * l + 1) * nu * value - l * before) / (l + 1)
            if l % 32 == 31 and (np.abs(moments[l - 15 : l + 1, peaked]) < _LAST * part).all():
                return np.asarray(moments[: l + 1] / np.maximum(moments[0], _LEAST))
    return np.asarray(moments / np.maximum(moments[0], _LEAST))


@cache
def _quadrature(degree: int) -> tuple[FloatArray, FloatArray]:
    """Quadrature over the sphere refined towards μ = 1, for moments up to a degree."""
    narrow = np.geomspace(1e-4, 0.04, 20)
    wide = np.linspace(0.04, pi, 2 + degree // 4)
    edges = np.concatenate([[0.0], narrow, wide[1:]])
    x, w = np.polynomial.legendre.leggauss(8)
    half = 0.5 * np.diff(edges)
    angle = (edges[:-1] + half)[:, None] + half[:, None] * x
    weights = 2.0 * pi * half[:, None] * w * np.sin(angle)
    return np.cos(angle).ravel(), weights.ravel()


@cache
def _legendre(degree: int) -> FloatArray:
    """(2l + 1)/(4π) P_l at the angles of the table, shape (``ANGLES``, degree + 1). [sr⁻¹]"""
    nu = 1.0 - 2.0 * np.linspace(0.0, 1.0, ANGLES) ** 8
    values = np.empty((degree + 1, ANGLES))
    before, value = np.zeros(ANGLES), np.ones(ANGLES)
    for l in range(degree + 1):
        values[l] = (2 * l + 1) / (4.0 * pi) * value
        before, value = value, ((2 * l + 1) * nu * value - l * before) / (l + 1)
    return values.T.copy()
