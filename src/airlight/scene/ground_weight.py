r"""Weight of each part of the ground in the illumination of the atmosphere in view.

The solver has a single ground albedo. Ground-reflected radiance reaches the sky of an observer by
scattering at points y of the lines of sight, which receive it from all directions below their
horizon. To first order in the scattering coefficient σ, uniformly illuminated ground has the weight

.. math:: \mathrm{d}w = \mathrm{d}\Omega_x \; T(x, y)\, σ(y)\, \mathrm{d}s \;
          T(y, g)\, \mathrm{d}\Omega_y,

with :math:`\mathrm{d}\Omega_x` over directions at the observer x that cross the atmosphere, and
:math:`\mathrm{d}\Omega_y` over directions at y that end on the ground, at g. By symmetry it depends
only on the distance between g and the nadir of the observer. Phase functions are replaced by
isotropic ones by similarity, with scattering σ (1 - g) and extinction k - gσ (van de Hulst 1980,
Multiple Light Scattering, section 14.1). From the ground, half of the weight is within a few scale
heights, the rest as far as the atmosphere is visible; from far away it covers the disc.

Neglected: higher orders of scattering after the ground, which widen the weight; the position of the
star, so that one solution serves a day; refraction.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.solver.tables.columns import columns

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]

#: Numbers of lines of sight in each range of directions and of points on each leg, for an observer
#: within the atmosphere and for one outside.
_IN_THE_AIR: Final = (20, 20)
_OUTSIDE: Final = (64, 8)
#: Numbers of directions from a point to the ground, and of azimuths over half a turn.
_DOWN: Final = 16
_AZIMUTHS: Final = 24
#: Points of each of two panels of a column.
_NODES: Final = 10
#: Bins of the logarithm of the distance, from 1e-8 of half a turn to half a turn.
_BINS: Final = 600
_NEAREST: Final = 1e-8 * np.pi


class _Legs(NamedTuple):
    """Ray segments with monotonic radius; shape (n, 1).

    Attributes
    ----------
    impact : array
        Distance at which the line passes the planet's centre. [m]
    observer, entry : array
        Distances along the line, from its lowest point, of the observer, and of the point where it
        enters the air. [m]
    solid : array
        Solid angle that the line represents, over 2π. [1]
    low, high : array
        Radii of the ends. [m]
    side : array
        1 where the radius increases along the line, -1 where it decreases.
    """

    impact: FloatArray
    observer: FloatArray
    entry: FloatArray
    solid: FloatArray
    low: FloatArray
    high: FloatArray
    side: FloatArray


def ground_distances(medium: Medium, altitude: float, shares: FloatArray) -> FloatArray:
    """Quantiles of the weight by distance along the ground.

    Parameters
    ----------
    medium : Medium
        Atmosphere; its first wavelength is used.
    altitude : float
        Altitude of the observer above the ground, also outside the shell. [m]
    shares : array, shape (n,)
        Fractions of the weight, ascending, 0 to 1. [1]

    Returns
    -------
    array, shape (n,)
        Distances from the point below the observer, seen from the planet's centre; 0 where no air
        scatters. [rad]
    """
    angle, radius, weight = _lit_air(medium, altitude)
    below, share = _ground_below(medium, radius)
    azimuth = np.pi * (np.arange(_AZIMUTHS) + 0.5) / _AZIMUTHS
    # haversines: hav d = hav(a - b) + sin a sin b hav(azimuth), which does not cancel at small d
    near = np.sin(0.5 * (angle[:, None] - below)) ** 2
    across = np.sin(angle)[:, None] * np.sin(below)
    hav = near[..., None] + across[..., None] * np.sin(0.5 * azimuth) ** 2
    distance = 2.0 * np.arcsin(np.sqrt(np.clip(hav, 0.0, 1.0)))
    mass = np.broadcast_to((weight[:, None] * share)[..., None], distance.shape)
    edges = np.geomspace(_NEAREST, np.pi, _BINS + 1)
    found, _ = np.histogram(np.clip(distance, _NEAREST, np.pi), edges, weights=mass)
    inside = np.concatenate([[0.0], np.cumsum(found)])
    if inside[-1] <= 0.0:
        return np.zeros_like(shares)
    end = int(np.searchsorted(inside, inside[-1])) + 1
    return np.asarray(np.interp(shares, inside[:end] / inside[-1], edges[:end]))


def _even_air(medium: Medium) -> tuple[FloatArray, FloatArray]:
    """Isotropic part of scattering, and extinction by it and absorption, shape (nc,). [m⁻¹]"""
    even = medium.scattering[:, 0] * (1.0 - medium.phase_moments(1)[:, 0, 1])
    return even, even + medium.absorption[:, 0]


def _transmittance(medium: Medium, r: ArrayLike, mu: ArrayLike, length: ArrayLike) -> FloatArray:
    """Transmittance of ray segments. [1]"""
    _, extinction = _even_air(medium)
    column = columns(r, mu, length, medium.bottom_radius, medium.density, nodes=_NODES, panels=2)
    return np.asarray(np.exp(-(column @ extinction)))


def _lit_air(medium: Medium, altitude: float) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Sample points on all lines of sight, shape (n,).

    Returns
    -------
    angle, radius, weight : array
        Angle from the observer, seen from the centre [rad], radius [m], and weight.
    """
    bottom, top = medium.bottom_radius, medium.top_radius
    lines, points = _IN_THE_AIR if bottom + altitude <= top else _OUTSIDE
    legs, rule = _legs(bottom + altitude, bottom, top, lines), gauss_legendre(points)
    # r = impact + y² makes ds = 2 r / √(r + impact) dy smooth at the lowest point of a line.
    first, last = (np.sqrt(np.maximum(r - legs.impact, 0.0)) for r in (legs.low, legs.high))
    y = first + (last - first) * rule.nodes
    radius = np.clip(legs.impact + y * y, bottom, top)
    root = np.sqrt(radius + legs.impact)
    step = 2.0 * radius / root * (last - first) * rule.weights
    along = legs.side * y * root
    start = np.hypot(legs.impact, legs.entry)
    transmittance = _transmittance(
        medium, start, legs.entry / start, np.maximum(along - legs.entry, 0.0)
    )
    scattering, _ = _even_air(medium)
    density = (scattering @ medium.density.at((radius - bottom).ravel())).reshape(radius.shape)
    angle = np.arctan2(along, legs.impact) - np.arctan2(legs.observer, legs.impact)
    weight = legs.solid * step * transmittance * density
    return angle.ravel(), radius.ravel(), weight.ravel()


def _legs(r: float, bottom: float, top: float, lines: int) -> _Legs:
    """Monotonic segments of the lines of sight of an observer at a radius. [m]"""
    rule = gauss_legendre(lines)
    rows: list[tuple[ArrayLike, ...]] = []
    start = min(r, top)
    horizon = bottom * bottom
    if r > top:  # even in solid angle is, but for the cosine, even in the squared impact parameter
        ranges = [(horizon, top * top), (0.0, horizon)]
    else:
        low = -np.sqrt(max((r - bottom) * (r + bottom), 0.0)) / r
        ranges = [(0.0, 1.0), (low, 0.0), (-1.0, low)]
    for first, last in ranges:
        nodes, solid = first + (last - first) * rule.nodes, (last - first) * rule.weights
        if r > top:
            impact, observer = np.sqrt(nodes), -np.sqrt(r * r - nodes)
            solid, entry = 0.5 * solid / (-observer * r), -np.sqrt(top * top - nodes)
        else:
            impact, observer = r * np.sqrt((1.0 - nodes) * (1.0 + nodes)), r * nodes
            entry = observer
        line = impact, observer, entry, solid
        if first >= 0.0 and r <= top:
            rows.append((*line, start, top, 1.0))
        elif np.all(impact < bottom):
            rows.append((*line, bottom, start, -1.0))
        else:
            rows += [(*line, impact, start, -1.0), (*line, impact, top, 1.0)]
    each = [np.broadcast_arrays(*row) for row in rows]
    return _Legs(*(np.concatenate(parts)[:, None] for parts in zip(*each, strict=True)))


def _ground_below(medium: Medium, radius: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Ground visible from a point of the atmosphere, in ``_DOWN`` directions from nadir to horizon.

    Parameters
    ----------
    radius : array, shape (n,)
        Radii of the points. [m]

    Returns
    -------
    angle, share : array, shape (n, _DOWN)
        Central angle between point and ground [rad], and solid angle over 2π times transmittance
        [1].
    """
    bottom, rule = medium.bottom_radius, gauss_legendre(_DOWN)
    r = radius[:, None]
    horizon = np.sqrt(np.maximum((r - bottom) * (r + bottom), 0.0)) / r
    # squared nodes: most ground seen by points just above it is near the horizon
    down = horizon + (1.0 - horizon) * rule.nodes**2
    solid = (1.0 - horizon) * 2.0 * rule.nodes * rule.weights
    sine = np.sqrt((1.0 - down) * (1.0 + down))
    leaving = np.sqrt(np.maximum(1.0 - (r / bottom * sine) ** 2, 0.0))
    length = np.maximum(r * down - bottom * leaving, 0.0)
    angle = np.arctan2(length * sine, r - length * down)
    return angle, solid * _transmittance(medium, r, -down, length)
