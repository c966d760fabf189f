"""Lines of sight past the bodies of a scene, with and without air."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from airlight.kernel import vectorized
from airlight.render.pixels.bare_body import sphere_distance
from airlight.render.through_air import AirAround
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
    """

    def __init__(
        self, system: System, items: Sequence[AirAround | Body], wavelengths: FloatArray
    ) -> None:
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
                through[self.meets(item, rays)[0]] = 0.0
        return through, rays

    def meets(self, body: Body, rays: FloatArray) -> tuple[NDArray[np.intp], FloatArray]:
        """Indices of rays that hit a body without air, and distances. [m]"""
        offset = (body.centre - self.system.eye) / self.system.radius(body)
        power = self.system.power(body) / self.system.radius(body) ** 2
        # By the cross product, which avoids cancellation at large distances.
        across = np.linalg.norm(np.cross(rays, offset), axis=-1)
        length = np.asarray(vectorized(sphere_distance)(rays @ offset, across, power))
        met = np.flatnonzero(length >= 0.0)
        return met, length[met] * self.system.radius(body)
