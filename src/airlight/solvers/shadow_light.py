r"""Light of the star behind a planet with air: what a moon receives in the planet's shadow.

A line from a point in the shadow that meets the shell at the angle θ from the planet's centre has
the impact parameter b = d sin θ. It is bent around the planet by α(b) and leaves towards a point of
the sky at θ - α(b) from the direction of the planet's centre. Radiance is kept along rays, so the
irradiance of the point is that of the star's disc as it is seen there: through the air, in an arc
around the planet,

.. math:: \frac{E}{E_0} = \frac{1}{\pi \sin^2\alpha_*} \int T(b)
          \oint \frac{L(\mu)}{\bar L} \, d\varphi \, \sin\theta \cos\theta \, d\theta

beside the part of the disc that stands free of the air. The air around the planet scatters light
too, which the same solution knows.

Source: Vollmer & Gedzelman (2008), Applied Optics 47, H52, for the ray around the planet.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from airlight.errors import ParameterError
from airlight.geometry.disc_overlap import covered_half_arc, visible_light
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import vectorized
from airlight.solvers.lines_of_sight import enter_shell
from airlight.solvers.solution import Solution
from airlight.spectra.limb_darkening import UNIFORM
from airlight.tables.columns import columns

FloatArray = NDArray[np.float64]

#: Rays through the shell, evenly in the height of their lowest point.
_RAYS: Final = 3000
#: Points of the arc of a circle within the star's disc.
_ARC: Final = 24
#: Heights and position angles of the lines that see scattered light.
_HEIGHTS: Final = 48
_POSITIONS: Final = 24


class ShadowLight:
    """Light of the star behind a planet, at one distance from it.

    Parameters
    ----------
    solution : Solution
        Solution of the planet.
    distance : float
        Distance from the planet's centre, outside its air. [m]

    Raises
    ------
    ParameterError
        If the distance lies inside the air.
    """

    def __init__(self, solution: Solution, distance: float) -> None:
        medium, paths = solution.medium, solution.paths
        if not distance > medium.top_radius:
            raise ParameterError("distance", distance, f"above {medium.top_radius:.7g} m")
        source = solution.lights[0]
        self.star_radius = source.angular_radius
        law = source.darkening
        count = solution.wavelengths.size
        self._law = np.tile(UNIFORM, (count, 1)) if law is None else law(solution.wavelengths)
        self._solution, self._distance = solution, distance
        drawn = paths.medium
        bottom, top = drawn.bottom_radius, drawn.top_radius
        step = (top - bottom) / _RAYS
        impact = np.asarray(bottom + step * (np.arange(_RAYS) + 0.5), np.float64)
        straight = np.zeros(_RAYS)
        half = np.sqrt((top - impact) * (top + impact))
        depth = 2.0 * columns(impact, straight, half, bottom, drawn.density) @ drawn.extinction
        #: Sines of the angles between the rays and the planet's centre, and their weights.
        self._sine = impact / distance
        self._weight = self._sine * step / distance
        self._turned = np.arcsin(self._sine) - 2.0 * paths.refraction_angle(impact, straight)
        self._through = np.exp(-depth)
        #: Angular radii of the planet and of its air. [rad]
        self.planet_radius = float(np.arcsin(bottom / distance))
        self.air_radius = float(np.arcsin(top / distance))

    def at(self, separation: ArrayLike) -> FloatArray:
        """Irradiance of a plane that faces the star, by the star itself, through the air.

        Parameters
        ----------
        separation : array, shape (n,)
            Angles between the centres of planet and star, 0 to 90. [deg]

        Returns
        -------
        array, shape (n, nl)
            Irradiance over that without the planet. [1]

        Raises
        ------
        ParameterError
            If an angle is out of its range, or the star is a point.
        """
        return np.asarray([self._free(a) + self._refracted(a) for a in self._angles(separation)])

    def scattered(self, separation: ArrayLike) -> FloatArray:
        """Irradiance by light that the air around the planet scatters, as ``at``."""
        return np.asarray([self._around(a) for a in self._angles(separation)])

    def _angles(self, separation: ArrayLike) -> FloatArray:
        angles = np.radians(np.atleast_1d(np.asarray(separation, float)))
        if not np.all((angles >= 0.0) & (angles <= 0.5 * np.pi)):
            raise ParameterError("separation", separation, "0 to 90 deg")
        if self.star_radius <= 0.0:
            raise ParameterError("star.angular_radius", 0.0, "above 0 deg in an eclipse")
        return np.asarray(angles)

    def _free(self, separation: float) -> FloatArray:
        """Light of the part of the disc beside the air."""
        return visible_light(
            math.degrees(self.star_radius), [np.degrees(separation)],
            [np.degrees(self.air_radius)], darkening=self._law,
        )  # fmt: skip

    def _refracted(self, separation: float) -> FloatArray:
        """Light that comes through the air."""
        star = self.star_radius
        # A ray bent past the centre leaves on the other side of it.
        away = np.abs(self._turned)
        half = vectorized(covered_half_arc)(away, np.full_like(away, separation), star)
        rays = np.flatnonzero(half > 0.0)
        if rays.size == 0:
            return np.zeros(len(self._law))
        rule = gauss_legendre(_ARC)
        turn = np.sin(0.5 * np.pi * rule.nodes) ** 2
        step = rule.weights * np.pi * np.sqrt(turn * (1.0 - turn))
        phi = half[rays, None] * turn
        apart = _sine_squared_half(away[rays, None], separation, phi)
        outer = np.sin(0.5 * star) ** 2
        # sin² of the whole angle: 4 s (1 - s)
        ratio = np.clip(apart * (1.0 - apart) / (outer * (1.0 - outer)), 0.0, 1.0)
        mu = np.sqrt(1.0 - ratio)
        powers = mu[..., None] ** np.arange(self._law.shape[1])
        arcs = np.einsum("rpk,p->rk", powers, step) * 2.0 * half[rays, None]
        light = (arcs @ self._law.T) * self._through[rays]
        weight = self._weight[rays] / (np.pi * np.sin(star) ** 2)
        return np.asarray(weight @ light)

    def _around(self, separation: float) -> FloatArray:
        """Light that the air scatters around the planet, by both halves of its ring."""
        solution, d = self._solution, self._distance
        medium = solution.medium
        bottom, top = medium.bottom_radius, medium.top_radius
        heights, azimuths = gauss_legendre(_HEIGHTS), gauss_legendre(_POSITIONS)
        # Denser at the ground, where the air is.
        reach = bottom + (top - bottom) * heights.nodes**2
        weight = 2.0 * heights.nodes * heights.weights * (top - bottom) * reach / d**2
        sine = np.repeat(reach / d, _POSITIONS)
        azimuth = np.tile(np.pi * azimuths.nodes, _HEIGHTS)
        mu = -np.sqrt((1.0 - sine) * (1.0 + sine))
        mu_s = np.full(sine.size, -np.cos(separation))
        nu = mu * mu_s + sine * np.sin(separation) * np.cos(azimuth)
        lines = enter_shell(np.full(sine.size, d), mu, sine, mu_s, nu, bottom, top)
        radiance = solution.relative_radiance(lines)
        share = np.repeat(weight, _POSITIONS) * np.tile(2.0 * np.pi * azimuths.weights, _HEIGHTS)
        return np.asarray(share @ radiance)


def _sine_squared_half(a: FloatArray, b: float, phi: FloatArray) -> FloatArray:
    """sin²(c/2) of the third side of a spherical triangle, without loss of digits. [1]"""
    return np.asarray(np.sin(0.5 * (a - b)) ** 2 + np.sin(a) * np.sin(b) * np.sin(0.5 * phi) ** 2)
