"""Transmittance and refraction of lines of sight through an atmosphere to space."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from airlight.render.sun_disc import leaving_direction
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.tables.columns import columns

FloatArray = NDArray[np.float64]


def through_air(
    solution: MomentsSolution, altitude: float, directions: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Transmittance of lines of sight to space, and their refracted directions.

    Parameters
    ----------
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
    medium, geometry = solution.medium, solution.geometry
    r = np.full(len(directions), medium.bottom_radius + altitude)
    mu = np.clip(directions[:, 2], -1.0, 1.0)
    sine = np.hypot(directions[:, 0], directions[:, 1])
    zero = np.zeros_like(mu)
    lines = geometry.optical_lines(
        enter_shell(r, mu, sine, zero, zero, medium.bottom_radius, medium.top_radius)
    )
    transmittance = np.ones((len(mu), solution.wavelengths.size))
    crossing = np.flatnonzero((lines.length > 0.0) & ~lines.to_ground)
    drawn = geometry.medium
    if crossing.size:
        depth = columns(
            lines.r[crossing], lines.mu[crossing], lines.length[crossing], drawn.bottom_radius,
            drawn.density,
        )  # fmt: skip
        transmittance[crossing] = np.exp(-(depth @ drawn.extinction))
    transmittance[lines.to_ground] = 0.0
    return transmittance, leaving_direction(directions, solution, altitude)
