"""Lines of sight through the air to space: refraction, transmittance, and solid angle of discs."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.refraction import apparent_sun_cosine
from airlight.geometry.vectors import Vec3
from airlight.solver.lines_of_sight import LinesOfSight, enter_shell
from airlight.solver.tables.columns import columns

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Iterations for the apparent direction of a point behind refracting air.
_BENDS: Final = 4


def straight_lines(
    directions: FloatArray,
    solution: MomentsSolution,
    altitude: float,
    pole: FloatArray | None = None,
) -> tuple[LinesOfSight, FloatArray]:
    """Unrefracted lines of sight from the observer.

    Parameters
    ----------
    directions : array, shape (n, 3)
        Unit vectors in the local frame.
    altitude : float
        Altitude of the observer. [m]
    pole : array, shape (3,), optional
        Direction of the north pole in the local frame, of a planet that may be oblate. [1]

    Returns
    -------
    lines : LinesOfSight
        Lines of sight inside the shell, those to an oblate planet displaced.
    longer : array, shape (n,)
        Columns along the lines over those in the sphere. [1]
    """
    medium = solution.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    mu = np.clip(directions[:, 2], -1.0, 1.0)
    sine = np.hypot(directions[:, 0], directions[:, 1])
    r, longer = np.full(mu.shape, bottom + altitude), np.ones_like(mu)
    if pole is not None and medium.flattening > 0.0 and altitude >= medium.thickness:
        from airlight.render.pixels.oblate import displaced_places

        places = np.empty((4, len(directions)))
        axis = Vec3(*pole.tolist())
        rays = np.ascontiguousarray(directions)
        displaced_places(rays, r[0], axis, medium.flattening, bottom, top, places)
        r, mu, sine, longer = places
    lines = enter_shell(r, mu, sine, mu, np.ones_like(mu), bottom, top)
    return solution.geometry.optical_lines(lines), longer


def leaving_direction(
    directions: FloatArray,
    solution: MomentsSolution,
    altitude: float,
    pole: FloatArray | None = None,
) -> FloatArray:
    """Refracted directions of lines of sight outside the atmosphere.

    Parameters
    ----------
    directions : array, shape (n, 3)
        Unit vectors in the local frame; zero vectors remain zero.
    altitude, pole :
        Arguments of ``straight_lines``; refraction is in the plane of the observer's vertical.

    Returns
    -------
    array, shape (n, 3)
        Unit vectors; unchanged for lines that meet the ground.
    """
    if solution.geometry.shell is None or len(directions) == 0:
        return directions
    lines, _ = straight_lines(directions, solution, altitude, pole)
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
    >>> f"{sun_solid_angle(0.2678 * math.pi / 180):.3e}"
    '6.863e-05'
    """
    return 4.0 * math.pi * math.sin(0.5 * angular_radius) ** 2


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
    clouds : callable, optional
        Transmittance of clouds on lines of sight in the frame of directions. [1]
    pole : array, shape (3,), optional
        Direction of the north pole in the frame of directions, of a planet with rings or an oblate
        one. [1]
    """

    solution: MomentsSolution
    altitude: float
    axes: FloatArray = field(default_factory=lambda: np.eye(3))
    clouds: Callable[[FloatArray], FloatArray] | None = None
    pole: FloatArray | None = None

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
        pole, drawn = None if self.pole is None else self.axes @ self.pole, solution.geometry.medium
        lines, longer = straight_lines(directions, solution, self.altitude, pole)
        transmittance = np.ones((len(directions), solution.wavelengths.size))
        crossing = np.flatnonzero((lines.length > 0.0) & ~lines.to_ground)
        if crossing.size:
            depth = columns(
                lines.r[crossing],
                lines.mu[crossing],
                lines.length[crossing],
                drawn.bottom_radius,
                drawn.density,
            )
            depth *= longer[crossing, None]
            transmittance[crossing] = np.exp(-(depth @ drawn.extinction))
        transmittance[lines.to_ground] = 0.0
        if pole is not None and solution.medium.rings:
            transmittance *= self._through_rings(directions, pole)[:, None]
        if self.clouds is not None:
            open_ = np.flatnonzero(transmittance.max(axis=1) > 0.0)
            transmittance[open_] *= self.clouds(rays[open_])
        left = leaving_direction(directions, solution, self.altitude, pole)
        return transmittance, left @ self.axes

    def _through_rings(self, directions: FloatArray, pole: FloatArray) -> FloatArray:
        """Transmittance of the rings along directions in the local frame, shape (n,). [1]"""
        from airlight.render.pixels.ring_light import ring_transmittances

        out = np.empty(len(directions))
        r = self.solution.medium.bottom_radius + self.altitude
        rings = self.solution.tables.rings
        axis = Vec3(*pole.tolist())
        ring_transmittances(np.ascontiguousarray(directions), r, axis, rings, out)
        return out
