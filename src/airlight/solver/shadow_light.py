r"""Irradiance in the shadow of a planet with an atmosphere: lunar eclipses.

A line of sight from a point in the shadow, at the angle θ from the planet's centre, has the impact
parameter b = d sin θ. It is refracted by α(b) and continues towards a point of the sky at θ - α(b)
from the planet's centre. Radiance is conserved along rays, so the irradiance is that of the star's
refracted image, an arc around the planet,

.. math:: \frac{E}{E_0} = \frac{1}{\pi \sin^2\alpha_*} \int T(b)
          \oint \frac{L(\mu)}{\bar L} \, d\varphi \, \sin\theta \cos\theta \, d\theta

plus that of the part of the disc outside the atmosphere. The scattered radiance of the atmospheric
ring comes from the same solution.

Source: Vollmer & Gedzelman (2008), Applied Optics 47, H52, for the refracted ray.
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
from airlight.physics.spectra.limb_darkening import UNIFORM
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.solution import Solution
from airlight.solver.tables.columns import columns

FloatArray = NDArray[np.float64]

#: Rays through the shell, even in tangent height.
_RAYS: Final = 3000
#: Points of a circular arc within the star's disc.
_ARC: Final = 24
#: Heights and position angles of the lines of sight for scattered light.
_HEIGHTS: Final = 48
_POSITIONS: Final = 24


class ShadowLight:
    """Irradiance in the shadow of a planet, at one distance.

    Parameters
    ----------
    distance : float
        Distance from the planet's centre, outside its atmosphere. [m]
    """

    def __init__(self, solution: Solution, distance: float) -> None:
        medium, geometry = solution.medium, solution.geometry
        if not distance > medium.top_radius:
            raise ParameterError("distance", distance, f"above {medium.top_radius:.7g} m")
        source = solution.lights[0]
        self.star_radius = source.angular_radius
        law = source.darkening
        count = solution.wavelengths.size
        self._law = np.tile(UNIFORM, (count, 1)) if law is None else law(solution.wavelengths)
        self._solution, self._distance = solution, distance
        drawn = geometry.medium
        bottom, top = drawn.bottom_radius, drawn.top_radius
        step = (top - bottom) / _RAYS
        impact = np.asarray(bottom + step * (np.arange(_RAYS) + 0.5), np.float64)
        straight = np.zeros(_RAYS)
        half = np.sqrt((top - impact) * (top + impact))
        depth = 2.0 * columns(impact, straight, half, bottom, drawn.density) @ drawn.extinction
        #: Sines of the angles between the rays and the planet's centre, and their weights.
        self._sine = impact / distance
        self._weight = self._sine * step / distance
        self._turned = np.arcsin(self._sine) - 2.0 * geometry.refraction_angle(impact, straight)
        self._through = np.exp(-depth)
        #: Angular radii of the planet and of its atmosphere. [rad]
        self.planet_radius = float(np.arcsin(bottom / distance))
        self.air_radius = float(np.arcsin(top / distance))

    def at(self, separation: ArrayLike) -> FloatArray:
        """Direct normal irradiance: refracted part and free part of the star's disc.

        Parameters
        ----------
        separation : array, shape (n,)
            Angles between the centres of planet and star, 0 to 90. [deg]

        Returns
        -------
        array, shape (n, nl)
            Irradiance over that without the planet. [1]
        """
        return np.asarray([self._free(a) + self._refracted(a) for a in self._angles(separation)])

    def scattered(self, separation: ArrayLike) -> FloatArray:
        """Irradiance by scattered light of the atmospheric ring; arguments and shape of ``at``."""
        return np.asarray([self._around(a) for a in self._angles(separation)])

    def _angles(self, separation: ArrayLike) -> FloatArray:
        angles = np.radians(np.atleast_1d(np.asarray(separation, float)))
        if not np.all((angles >= 0.0) & (angles <= 0.5 * np.pi)):
            raise ParameterError("separation", separation, "0 to 90 deg")
        if self.star_radius <= 0.0:
            raise ParameterError("star.angular_radius", 0.0, "above 0 deg in an eclipse")
        return np.asarray(angles)

    def _free(self, separation: float) -> FloatArray:
        """Irradiance by the part of the star's disc outside the atmosphere. [1]"""
        return visible_light(
            math.degrees(self.star_radius),
            [np.degrees(separation)],
            [np.degrees(self.air_radius)],
            darkening=self._law,
        )

    def _refracted(self, separation: float) -> FloatArray:
        """Irradiance of the refracted image. [1]"""
        star = self.star_radius
        # A ray refracted past the centre leaves on its other side.
        away = np.abs(self._turned)
        half = vectorized(covered_half_arc)(away, np.full_like(away, separation), star)
        rays = np.flatnonzero(half > 0.0)
        if rays.size == 0:
            return np.zeros(len(self._law))
        rule = gauss_legendre(_ARC)
        turn = np.sin(0.5 * np.pi * rule.nodes) ** 2
        step = rule.weights * np.pi * np.sqrt(turn * (1.0 - turn))
        phi = half[rays, None] * turn
        haversine = _sine_squared_half(away[rays, None], separation, phi)
        outer = np.sin(0.5 * star) ** 2
        # sin² of the whole angle: 4 s (1 - s)
        ratio = np.clip(haversine * (1.0 - haversine) / (outer * (1.0 - outer)), 0.0, 1.0)
        mu = np.sqrt(1.0 - ratio)
        powers = mu[..., None] ** np.arange(self._law.shape[1])
        arcs = np.einsum("rpk,p->rk", powers, step) * 2.0 * half[rays, None]
        light = (arcs @ self._law.T) * self._through[rays]
        weight = self._weight[rays] / (np.pi * np.sin(star) ** 2)
        return np.asarray(weight @ light)

    def _around(self, separation: float) -> FloatArray:
        """Irradiance by the scattered light of both halves of the ring. [1]"""
        solution, d = self._solution, self._distance
        medium = solution.medium
        bottom, top = medium.bottom_radius, medium.top_radius
        heights, azimuths = gauss_legendre(_HEIGHTS), gauss_legendre(_POSITIONS)
        # Denser near the ground, where most of the atmosphere is.
        reach = bottom + (top - bottom) * heights.nodes**2
        weight = 2.0 * heights.nodes * heights.weights * (top - bottom) * reach / d**2
        sine = np.repeat(reach / d, _POSITIONS)
        azimuth = np.tile(np.pi * azimuths.nodes, _HEIGHTS)
        mu = -np.sqrt((1.0 - sine) * (1.0 + sine))
        mu_s = np.full(sine.size, -np.cos(separation))
        nu = mu * mu_s + sine * np.sin(separation) * np.cos(azimuth)
        lines = enter_shell(np.full(sine.size, d), mu, sine, mu_s, nu, bottom, top)
        radiance = solution.relative_radiance(lines)
        solid_angles = np.repeat(weight, _POSITIONS) * np.tile(
            2.0 * np.pi * azimuths.weights, _HEIGHTS
        )
        return np.asarray(solid_angles @ radiance)


def _sine_squared_half(a: FloatArray, b: float, phi: FloatArray) -> FloatArray:
    """sin²(c/2) of the third side c of a spherical triangle, without cancellation. [1]"""
    return np.asarray(np.sin(0.5 * (a - b)) ** 2 + np.sin(a) * np.sin(b) * np.sin(0.5 * phi) ** 2)
