"""Transmittance and refraction of lines of sight through an atmosphere to space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.render.sun_disc import leaving_direction
from airlight.solvers.moments.solution import MomentsSolution
from airlight.solvers.sight import enter_shell
from airlight.tables.columns import columns

FloatArray = NDArray[np.float64]


def through_air(
    solution: MomentsSolution, altitude: float, directions: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Transmittance of lines of sight to space, and their refracted directions.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet.
    altitude : float
        Altitude of the observer. [m]
    directions : array, shape (n, 3)
        Unit vectors in the observer's local frame, z to the zenith.

    Returns
    -------
    transmittance : array, shape (n, nl)
        Transmittance; 0 where the line ends on the ground. [1]
    directions : array, shape (n, 3)
        Unit vectors outside the atmosphere.
    """
    medium, paths = solution.medium, solution.paths
    r = np.full(len(directions), medium.bottom_radius + altitude)
    mu = np.clip(directions[:, 2], -1.0, 1.0)
    sine = np.hypot(directions[:, 0], directions[:, 1])
    zero = np.zeros_like(mu)
    sight = paths.sight(
        enter_shell(r, mu, sine, zero, zero, medium.bottom_radius, medium.top_radius)
    )
    through = np.ones((len(mu), solution.wavelengths.size))
    crossing = np.flatnonzero((sight.length > 0.0) & ~sight.to_ground)
    drawn = paths.medium
    if crossing.size:
        depth = columns(
            sight.r[crossing], sight.mu[crossing], sight.length[crossing], drawn.bottom_radius,
            drawn.density,
        )  # fmt: skip
        through[crossing] = np.exp(-(depth @ drawn.extinction))
    through[sight.to_ground] = 0.0
    return through, leaving_direction(directions, solution, altitude)
