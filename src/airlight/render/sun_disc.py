"""Refracted directions of lines of sight outside the atmosphere, and solid angle of a disc."""

from __future__ import annotations

from math import pi, sin

import numpy as np
from numpy.typing import NDArray

from airlight.solver.lines_of_sight import LinesOfSight, enter_shell
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


def straight_lines(
    directions: FloatArray, solution: MomentsSolution, altitude: float
) -> LinesOfSight:
    """Unrefracted lines of sight from the observer.

    Parameters
    ----------
    directions : array, shape (n, 3)
        Unit vectors in the local frame.
    altitude : float
        Altitude of the observer. [m]

    Returns
    -------
    LinesOfSight
        Lines of sight inside the shell.
    """
    medium = solution.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    mu = np.clip(directions[:, 2], -1.0, 1.0)
    sine = np.hypot(directions[:, 0], directions[:, 1])
    r = np.full(mu.shape, bottom + altitude)
    return solution.geometry.optical_lines(
        enter_shell(r, mu, sine, mu, np.ones_like(mu), bottom, top)
    )


def leaving_direction(
    directions: FloatArray, solution: MomentsSolution, altitude: float
) -> FloatArray:
    """Refracted directions of lines of sight outside the atmosphere.

    Parameters
    ----------
    directions : array, shape (n, 3)
        Unit vectors in the local frame; zero vectors remain zero.

    Returns
    -------
    array, shape (n, 3)
        Unit vectors; unchanged for lines that meet the ground.
    """
    if solution.geometry.shell is None or len(directions) == 0:
        return directions
    lines = straight_lines(directions, solution, altitude)
    free = ~lines.to_ground & (lines.length > 0.0)
    angle = np.zeros(len(directions))
    angle[free] = solution.geometry.refraction_angle(lines.r[free], lines.mu[free])
    level = np.hypot(directions[:, 0], directions[:, 1])
    height = np.arctan2(directions[:, 2], level) - angle
    scale = np.divide(np.cos(height), level, out=np.ones_like(level), where=level > 0.0)
    bent = np.stack([directions[:, 0] * scale, directions[:, 1] * scale, np.sin(height)], axis=-1)
    return np.asarray(np.where(np.any(directions != 0.0, axis=-1)[:, None], bent, 0.0))


def sun_solid_angle(angular_radius: float) -> float:
    """Solid angle of a disc. [sr]

    Parameters
    ----------
    angular_radius : float
        Angular radius of the disc. [rad]

    Examples
    --------
    >>> f"{sun_solid_angle(0.2678 * pi / 180):.3e}"
    '6.863e-05'
    """
    return 4.0 * pi * sin(0.5 * angular_radius) ** 2
