"""Air around an observer: transmittance and refraction towards points at infinity."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.refraction import apparent_sun_cosine
from airlight.render.sun_disc import leaving_direction
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.tables.columns import columns

FloatArray = NDArray[np.float64]

#: Iterations for the apparent direction of a point behind refracting air.
_BENDS: Final = 4


class SeenThrough(Protocol):
    """What an observer sees points at infinity through."""

    def raised(self, true: FloatArray) -> FloatArray:
        """Apparent directions by the refraction table, shape (n, 3). [1]"""

    def behind(self, rays: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Transmittance of lines of sight to space, and their refracted directions."""


def apparent_points(seen: SeenThrough, true: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Apparent directions of points at infinity, and transmittance towards them.

    Fixed-point iteration on the error of the refracted direction, from the direction that the
    refraction table gives.

    Parameters
    ----------
    seen : SeenThrough
        Air, and bodies, around the observer.
    true : array, shape (n, 3)
        Unit vectors.

    Returns
    -------
    rays : array, shape (n, 3)
        Unit vectors.
    transmittance : array, shape (n, nl)
        Transmittance; 0 where the line ends on the ground. [1]
    """
    rays = seen.raised(true)
    for _ in range(_BENDS):
        through, behind = seen.behind(rays)
        open_ = through.max(axis=1) > 0.0
        moved = np.where(open_[:, None], rays + true - behind, rays)
        rays = moved / np.linalg.norm(moved, axis=-1, keepdims=True)
    return rays, seen.behind(rays)[0]


@dataclass(frozen=True, eq=False, kw_only=True)
class AirAround:
    """Air of a planet around an observer.

    Attributes
    ----------
    altitude : float
        Altitude of the observer. [m]
    axes : array, shape (3, 3)
        Axes of the observer's local frame, z to the zenith, in the frame of directions, as rows.
        [1]
    """

    solution: MomentsSolution
    altitude: float
    axes: FloatArray = field(default_factory=lambda: np.eye(3))

    def raised(self, true: FloatArray) -> FloatArray:
        """See ``SeenThrough``; unchanged from outside the air."""
        geometry = self.solution.geometry
        if geometry.shell is None or self.altitude >= self.solution.medium.thickness:
            return true
        r = np.array(self.solution.medium.bottom_radius + self.altitude)
        place = float(geometry.optical_radius(r)), geometry.shell.bottom, geometry.shell.top
        local = true @ self.axes.T
        seen = np.array(
            [
                apparent_sun_cosine(place[0], z, *place[1:], geometry.refraction_table)
                for z in local[:, 2]
            ]
        )
        flat = np.hypot(local[:, 0], local[:, 1])
        level = np.sqrt(np.maximum((1.0 - seen) * (1.0 + seen), 0.0))
        scale = np.divide(level, flat, out=np.ones_like(flat), where=flat > 0.0)
        bent = np.stack([local[:, 0] * scale, local[:, 1] * scale, seen], axis=-1)
        return np.asarray(bent @ self.axes)

    def behind(self, rays: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See ``SeenThrough``; the transmittance is 0 where a line ends on the ground."""
        solution, directions = self.solution, rays @ self.axes.T
        medium, geometry = solution.medium, solution.geometry
        r = np.full(len(directions), medium.bottom_radius + self.altitude)
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
        return transmittance, leaving_direction(directions, solution, self.altitude) @ self.axes
