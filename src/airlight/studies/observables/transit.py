r"""Transmission spectrum: effective radius of a planet at mid-transit.

.. math:: R_{eff}^2 = b_0^2 + 2 \int_{b_0}^{R_{top}} (1 - T(b))\, b\, db

with the transmittance T at the impact parameter b. Below :math:`b_0` rays end on the ground or,
with refraction, miss the star: a ray refracted by δ meets the star's disc of angular radius θ only
if :math:`|\delta - b/a| < \theta`, with the star's distance a. Forward scattering into the line of
sight is neglected, and the star's disc is uniform.

References
----------
Brown (2001), ApJ 553, 1006, section 3; Seager (2010), Exoplanet Atmospheres, section 3.5; for
refraction Bétrémieux & Kaltenegger (2014), ApJ 791, 7.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.quadrature import gauss_legendre
from airlight.solver.solution import Solution
from airlight.studies.observables.distant_lines import ground_edge

FloatArray = NDArray[np.float64]

#: Panels over the shell, and points per panel: of the result, and of the coarser rule.
_PANELS: Final = 60
_POINTS: Final = 8
_FEWER: Final = 5
#: Bisections of the shell for the lowest ray that reaches the star.
_HALVINGS: Final = 60


@dataclass(frozen=True)
class Transit:
    """Transmission spectrum.

    Attributes
    ----------
    radius : array, shape (nl,)
        Effective radius of the planet. [m]
    error : array, shape (nl,)
        Quadrature error: difference from a rule with fewer points. [m]
    lowest : float
        Impact parameter of the lowest ray that meets the star. [m]
    limited_by_refraction : bool
        Whether it is limited by refraction rather than by the ground.
    """

    radius: FloatArray
    error: FloatArray
    lowest: float
    limited_by_refraction: bool


def transit(solution: Solution) -> Transit:
    """Effective radius of a planet in front of its star."""
    top = solution.medium.top_radius
    edge = ground_edge(solution.geometry)
    lowest = _lowest_ray(solution, edge)
    fine, coarse = (_effective_radius(solution, lowest, top, n) for n in (_POINTS, _FEWER))
    return Transit(fine, np.abs(fine - coarse), lowest, bool(lowest > edge))


def _effective_radius(solution: Solution, lowest: float, top: float, points: int) -> FloatArray:
    rule = gauss_legendre(points)
    edges = np.linspace(lowest, top, _PANELS + 1)
    width = np.diff(edges)
    b = (edges[:-1, None] + width[:, None] * rule.nodes).ravel()
    weights = (width[:, None] * rule.weights).ravel()
    transmittance = solution.transmittance(
        altitude=solution.medium.thickness, view_zenith=180.0 - np.degrees(np.arcsin(b / top))
    ).to_numpy()
    return np.asarray(np.sqrt(lowest**2 + 2.0 * (weights * b) @ (1.0 - transmittance)))


def _lowest_ray(solution: Solution, edge: float) -> float:
    """Impact parameter of the lowest ray that meets the star's disc. [m]"""
    geometry = solution.geometry
    if geometry.shell is None:
        return edge
    known = None if solution.planet is None else solution.planet.star.known_distance
    distance = math.inf if known is None else known
    radius = solution.lights[0].angular_radius

    def meets_star(b: float) -> bool:
        angle = 2.0 * float(geometry.refraction_angle(np.array([b]), np.zeros(1))[0])
        return abs(angle - b / distance) < radius

    low, high = edge, geometry.medium.top_radius
    if meets_star(low):
        return edge
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if meets_star(middle) else (middle, high)
    return high
