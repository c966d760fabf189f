"""Fluxes through horizontal surfaces, by quadrature of radiances, for energy balances."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from math import pi
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.solver import Solution

FloatArray = NDArray[np.float64]

#: Quadrature points per piece, in view and in azimuth.
_VIEWS, _AZIMUTHS = 8, 6


class Fluxes(NamedTuple):
    """Diffuse fluxes at a level per irradiance of the star, shape (suns, wavelengths). [1]

    ``down`` and ``up`` are horizontal irradiances, ``scalar`` is the radiance integrated over the
    sphere.
    """

    down: FloatArray
    up: FloatArray
    scalar: FloatArray


def pieces(edges: Sequence[float], count: int) -> tuple[FloatArray, FloatArray]:
    """Composite Gauss-Legendre points and weights between edges.

    Parameters
    ----------
    edges : sequence of float
        Edges, ascending.
    count : int
        Points per piece.

    Examples
    --------
    >>> x, w = pieces([0.0, 1.0, 3.0], 2)
    >>> f"{w @ x**3:.10f}"  # 81/4
    '20.2500000000'
    """
    rule = gauss_legendre(count)
    points = [a + (b - a) * rule.nodes for a, b in pairwise(edges)]
    weights = [(b - a) * rule.weights for a, b in pairwise(edges)]
    return np.concatenate(points), np.concatenate(weights)


def level_fluxes(solution: Solution, altitude: float, mu_s: FloatArray) -> Fluxes:
    """Diffuse fluxes at a level.

    Gauss-Legendre quadrature in pieces: split at the horizon and at the horizontal, and finer in
    azimuth near the star.

    Parameters
    ----------
    solution : Solution
        Solution.
    altitude : float
        [m]
    mu_s : array, shape (n,)
        Cosines of the star's zenith angle at that altitude. [1]
    """
    bottom, top = solution.medium.bottom_radius, solution.medium.top_radius
    r = min(bottom + altitude, top)
    horizon = -float(np.sqrt(max((r - bottom) * (r + bottom), 0.0))) / r
    mu, w_mu = pieces(sorted({-1.0, horizon, 0.0, 0.05, 0.2, 1.0}), _VIEWS)
    phi, w_phi = pieces([0.0, 0.15 * pi, 0.5 * pi, pi], _AZIMUTHS)
    sun, view, around = np.meshgrid(mu_s, mu, phi, indexing="ij")
    radiance = solution.radiance(
        altitude=altitude,
        sun_zenith=np.degrees(np.arccos(sun)),
        view_zenith=np.degrees(np.arccos(view)),
        azimuth=np.degrees(around),
    ).values
    relative = radiance / solution.medium.solar_irradiance
    over_phi = 2.0 * np.einsum("smpw,p->smw", relative, w_phi)
    return Fluxes(
        down=np.einsum("smw,m->sw", over_phi, w_mu * np.maximum(mu, 0.0)),
        up=np.einsum("smw,m->sw", over_phi, w_mu * np.maximum(-mu, 0.0)),
        scalar=np.einsum("smw,m->sw", over_phi, w_mu),
    )


def star_through(solution: Solution, altitude: float, mu_s: FloatArray) -> FloatArray:
    """Transmittance to the star, 0 behind the planet, shape (suns, wavelengths). [1]"""
    zenith = np.degrees(np.arccos(mu_s))
    return np.asarray(solution.transmittance(altitude=altitude, view_zenith=zenith).values)


def absorbed_by_air(
    solution: Solution, altitudes: FloatArray, mu_s: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Absorbed power at some levels, per volume and irradiance of the star.

    Parameters
    ----------
    altitudes : array, shape (n,)
        [m]
    mu_s : array, shape (m,)
        Cosines of the star's zenith angle. [1]

    Returns
    -------
    absorbed, coefficient : array, shapes (n, m, nl), (n, nl)
        Absorbed power, and absorption coefficient. [m⁻¹]
    """
    medium = solution.medium
    coefficient = medium.density.at(altitudes).T @ medium.absorption
    light = np.stack(
        [
            level_fluxes(solution, float(h), mu_s).scalar + star_through(solution, float(h), mu_s)
            for h in altitudes
        ]
    )
    return coefficient[:, None, :] * light, coefficient
