"""Lines of sight past the bodies of a scene, with and without air."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from airlight.image.texels import CHANNELS
from airlight.kernel import vectorized
from airlight.render.bare_bodies import body_map, crater_density
from airlight.render.pixels.bare_body import sphere_distance
from airlight.render.pixels.bare_ground import map_colors
from airlight.render.pixels.bare_relief import HIGHEST, relief_lines, relief_shown
from airlight.render.through_air import AirAround
from airlight.scene.craters import REGIONAL, highland
from airlight.scene.ground_detail import NOMINAL_ROWS
from airlight.scene.system import System
from airlight.scene.system.body import Body

FloatArray = NDArray[np.float64]


class SeenPast:
    """``SeenThrough`` of all bodies of a scene.

    Parameters
    ----------
    system : System
        Scene with the observer.
    items : sequence of AirAround or Body
        Air of planets, and bodies without air, in the order in which lines meet them.
    wavelengths : array, shape (nl,)
        Wavelengths. [nm]
    pixel_angle : float
        Angle of a pixel. [rad]
    """

    def __init__(
        self,
        system: System,
        items: Sequence[AirAround | Body],
        wavelengths: FloatArray,
        pixel_angle: float,
    ) -> None:
        self.pixel_angle = pixel_angle
        self.system, self.items, self.wavelengths = system, items, wavelengths

    def raised(self, true: FloatArray) -> FloatArray:
        """See ``SeenThrough``: by the air in which the observer is."""
        for item in self.items:
            if isinstance(item, AirAround) and item.altitude < item.solution.medium.thickness:
                return item.raised(true)
        return true

    def behind(self, rays: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See ``SeenThrough``: past all bodies."""
        through = np.ones((len(rays), self.wavelengths.size))
        for item in self.items:
            if isinstance(item, AirAround):
                dimmed, rays = item.behind(rays)
                through *= dimmed
            else:
                met, _length, cover, _leaving = self.meets(item, rays)
                through[met] *= 1.0 - cover[:, None]
        return through, rays

    def meets(
        self, body: Body, rays: FloatArray
    ) -> tuple[NDArray[np.intp], FloatArray, FloatArray, FloatArray]:
        """Rays that hit a body without air.

        Returns
        -------
        met, length, cover, leaving : array, shape (n,)
            Their indices; distances [m], share of the pixel that is covered, and cosine of
            emergence [1].
        """
        radius = self.system.radius(body)
        offset = (body.centre - self.system.eye) / radius
        power = self.system.power(body) / radius**2
        # By the cross product, which avoids cancellation at large distances.
        across = np.linalg.norm(np.cross(rays, offset), axis=-1)
        along = rays @ offset
        if self.raised_limb(body) > 0.0:
            shown = relief_shown(power, radius, self.pixel_angle)
            near = np.flatnonzero((across < 1.0 + shown * HIGHEST / radius) & (along > 0.0))
            level = along[near] - np.sqrt(np.maximum(1.0 - across[near] ** 2, 0.0))
            found = self._relief(body, rays[near], level, offset, power)
            hit = found[:, 0] >= 0.0
            length, cover, leaving = found[hit].T
            return near[hit], length * radius, cover, leaving
        length = np.asarray(vectorized(sphere_distance)(along, across, power))
        met = np.flatnonzero(length >= 0.0)
        leaving = np.sqrt(np.maximum((1.0 - across[met]) * (1.0 + across[met]), 0.0))
        return met, length[met] * radius, np.ones(met.size), leaving

    def raised_limb(self, body: Body) -> float:
        """Angle by which relief may rise above the limb of a body; 0 if it is a sphere. [rad]"""
        radius, power = self.system.radius(body), self.system.power(body)
        shown = float(relief_shown(power / radius**2, radius, self.pixel_angle))
        if shown == 0.0 or crater_density(body) == 0.0:
            return 0.0
        return 1.1 * shown * HIGHEST / math.sqrt(power)

    def _relief(
        self, body: Body, rays: FloatArray, lengths: FloatArray, offset: FloatArray, power: float
    ) -> FloatArray:
        """Result of ``relief_lines``."""
        radius, picture = self.system.radius(body), body_map(self.system, body)
        axes, high = self.system.axes(body), np.ones(len(rays))
        if picture is not None:
            colors = np.empty((len(rays), CHANNELS))
            places = lengths[:, None] * rays - offset
            places /= np.linalg.norm(places, axis=-1, keepdims=True)
            size = picture.rows, picture.columns, len(picture.levels)
            level = np.full(len(rays), REGIONAL)
            map_colors(picture.flat, *size, np.ascontiguousarray(places @ axes.T), level, colors)
            high = np.asarray(vectorized(highland)(colors[:, 1]))
        rows = float(NOMINAL_ROWS if picture is None else picture.rows)
        out = np.empty((len(rays), 3))
        own = np.ascontiguousarray(rays @ axes.T)
        high = np.ascontiguousarray(high)
        relief_lines(own, axes @ offset, power, radius, rows, self.pixel_angle, high, out)
        return out
