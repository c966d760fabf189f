"""Path radiance and transmittance between the camera and surfaces, by marching."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.render.pixels.march_points import march_points
from airlight.render.pixels.render_tables import render_tables
from airlight.solver.lines_of_sight import enter_shell

if TYPE_CHECKING:
    from airlight.scene import Scene
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Longest path whose radiance is negligible. [m]
_NOTHING = 1e-6
#: Length up to which nodes extend below the ground, relative to the length to it.
_BELOW = 2.5
#: Reflectance of the grey surface to whose light errors are compared.
_GREY = 0.18


class PathRadiance:
    """Atmosphere in front of an observer under one light.

    Parameters
    ----------
    solution : MomentsSolution
        Solution, lit by that light.
    scene : Scene
        Observer, with the light at azimuth 0.
    """

    def __init__(self, solution: MomentsSolution, scene: Scene) -> None:
        self.solution = solution
        medium = solution.medium
        self._bottom, self._top = medium.bottom_radius, medium.top_radius
        self._r, self._sun = medium.bottom_radius + scene.altitude, scene.sun_direction
        points = march_points(solution)
        self._tables = render_tables(
            solution, peaks=False, points=points.points, panels=points.panels
        )

    @property
    def inside(self) -> bool:
        """Whether the observer is inside the atmosphere."""
        return self._r < self._top

    @property
    def grey(self) -> FloatArray:
        """Radiance of a horizontal grey surface at the observer, per irradiance, (nl,). [sr⁻¹]"""
        r, mu_s = np.array([min(self._r, self._top)]), np.array([self._sun[2]])
        received = self.solution.relative_direct_irradiance(r, mu_s)
        received = received + self.solution.relative_sky_irradiance(r, mu_s)
        return np.asarray(_GREY / np.pi * received[0])

    def before(
        self, directions: FloatArray, distances: FloatArray, *, below: bool = False
    ) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
        """Path radiance and transmittance to points.

        Parameters
        ----------
        directions : array, shape (n, 3)
            Apparent directions in the observer's local frame, unit vectors. [1]
        distances : array, shape (n,)
            Distances of the points, along the ray; may be infinite. [m]
        below : bool
            Whether points below the ground are reached, through air of the density at the ground,
            for nodes of a smooth table.

        Returns
        -------
        radiance, transmittance : array, shape (n, nl)
            Path radiance per irradiance of the light [sr⁻¹], and transmittance [1].
        whole : array of bool, shape (n,)
            Whether a point lies at or beyond the end of its line in the atmosphere.
        """
        geometry = self.solution.geometry
        mu, sine = directions[:, 2], np.hypot(directions[:, 0], directions[:, 1])
        nu = np.clip(directions @ self._sun, -1.0, 1.0)
        r, mu_s = np.full_like(mu, self._r), np.full_like(mu, self._sun[2])
        entered = enter_shell(r, mu, sine, mu_s, nu, self._bottom, self._top)
        lines = geometry.optical_lines(entered)
        way = np.zeros_like(mu)
        if not self.inside:
            chord = np.sqrt(np.maximum(self._top**2 - np.square(r * sine), 0.0))
            way = np.where(entered.length > 0.0, -r * mu - chord, 0.0)
        wanted = np.minimum(np.maximum(distances - way, 0.0), 1e3 * self._top)
        asked = geometry.optical_length(lines.r, lines.mu, wanted, lines.length, quick=True)
        longest = np.where(below & lines.to_ground, _BELOW * lines.length, lines.length)
        length = np.minimum(asked, longest)
        radiance = np.zeros((mu.size, self.solution.wavelengths.size))
        transmittance = np.ones_like(radiance)
        some = length > _NOTHING
        if some.any():
            kept = type(lines)(
                lines.r[some],
                lines.mu[some],
                lines.mu_s[some],
                lines.nu[some],
                lines.length[some],
                lines.to_ground[some],
            )
            marched = self.solution.segments(kept, length[some], tables=self._tables)
            radiance[some], transmittance[some] = marched
        return radiance, transmittance, length >= longest
