"""``EclipseRenderer``: frame of a planet in the shadow of a moon, on the CPU."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.vectors import Vec3
from airlight.render.cpu_renderer import CpuRenderer
from airlight.render.pixels.eclipsed_pixel import EclipsedWorkspace, render_eclipsed
from airlight.solver.eclipsed.eclipsed_march import new_eclipse
from airlight.solver.eclipsed.solution import EclipsedSolution

if TYPE_CHECKING:
    from airlight.scene import Scene

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


def check_unfiltered(scene: Scene) -> None:
    """Raise if the camera has a polarising filter, which eclipses do not support."""
    angle = scene.camera.polariser
    if angle is not None:
        raise ParameterError("camera.polariser", angle, "none where a moon's shadow is rendered")


class EclipseRenderer(CpuRenderer):
    """Renderer under a partly occulted star; every pixel is marched.

    Parameters
    ----------
    eclipsed : EclipsedSolution
        Solution of the planet and the shadow.
    scene : Scene
        Observer and camera, in the frame of the star.
    local : array, shape (3, 3)
        Axes of the observer's local frame in that of the eclipse, as rows: x horizontally towards
        the star, z to the zenith. [1]
    """

    def __init__(self, eclipsed: EclipsedSolution, scene: Scene, local: FloatArray) -> None:
        check_unfiltered(scene)
        super().__init__(eclipsed.solution, scene, exact=True, disc=False)
        self._observer = self._observer._replace(flattening=0.0)
        self.filled = None  # the sky is not symmetric about the star
        self._shadow = eclipsed.shadow
        x, y, z = (Vec3(*row) for row in (eclipsed.axes @ local.T).tolist())
        self._turn = x, y, z

    def render_pixels(
        self, px: FloatArray, py: FloatArray, rgb: Float32Array, element: int | None = None
    ) -> None:
        """See ``CpuRenderer``; Stokes Q and U are not supported."""
        if element is not None:
            raise ParameterError("stokes", True, "False where a moon's shadow is rendered")
        eclipse = new_eclipse(self._tables, self._shadow)
        work = EclipsedWorkspace(self._turn, eclipse, np.empty((2, self._tables.lanes), np.float32))
        render_eclipsed(px, py, self._frame(self._view), work, self._weights, rgb)
