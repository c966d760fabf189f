"""The star's own disc in a picture: its light through the air, smooth at the rim."""

from __future__ import annotations

from math import cos, pi, sin
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.scene import Scene
from airlight.solvers.solution import Solution, enter_shell
from airlight.tables.columns import columns

FloatArray = NDArray[np.float64]

#: Samples across a pixel that the rim of the disc crosses.
_SAMPLES: Final = 4


def add_sun_disc(
    rgb: NDArray[np.float32], solution: Solution, scene: Scene, weights: FloatArray
) -> None:
    """Add the star's disc to a picture.

    Its radiance is irradiance over solid angle, times the transmittance along each pixel's own
    line of sight. Limb darkening is left out: the disc is even. A point star (angular radius 0)
    is not drawn.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB, added to.
    solution : Solution
        Whose medium the light passes.
    scene : Scene
        Camera and star.
    weights : array, shape (nl, 3)
        Linear sRGB per radiance over irradiance.
    """
    alpha = solution.medium.star_angular_radius
    if alpha <= 0.0:
        return
    sun = scene.sun_direction
    solid_angle = sun_solid_angle(alpha)
    reach = alpha + scene.camera.pixel_angle
    offsets = (np.arange(_SAMPLES) + 0.5) / _SAMPLES - 0.5
    for row in range(rgb.shape[0]):
        directions = scene.camera.directions(slice(row, row + 1))[0]
        # The cheap test first: most rows are far from the star.
        near = directions @ sun > cos(min(2.0 * reach, pi))
        if not near.any():
            continue
        whole = near & (_angle(directions, sun) < alpha - 0.75 * scene.camera.pixel_angle)
        if whole.any():
            rgb[row, whole] += _disc(directions[whole], solution, scene, weights, solid_angle)
        rim = np.flatnonzero(near & ~whole)
        total = np.zeros((rim.size, 3))
        for dy in offsets:
            for dx in offsets:
                at = scene.camera.directions(slice(row, row + 1), offset=(dx, dy))[0][rim]
                inside = _angle(at, sun) < alpha
                if inside.any():
                    total[inside] += _disc(at[inside], solution, scene, weights, solid_angle)
        rgb[row, rim] += total / _SAMPLES**2


def _angle(directions: FloatArray, sun: FloatArray) -> FloatArray:
    """Angle to the star, from the length of the difference; π where there is no direction."""
    half = 0.5 * np.linalg.norm(directions - sun, axis=-1)
    seen = np.any(directions != 0.0, axis=-1)
    return np.asarray(np.where(seen, 2.0 * np.arcsin(np.minimum(half, 1.0)), pi))


def _disc(
    directions: FloatArray,
    solution: Solution,
    scene: Scene,
    weights: FloatArray,
    solid_angle: float,
) -> FloatArray:
    medium = solution.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    mu = np.clip(directions[:, 2], -1.0, 1.0)
    sine = np.hypot(directions[:, 0], directions[:, 1])
    r = np.full(mu.shape, bottom + scene.altitude)
    sight = enter_shell(r, mu, sine, mu, np.ones_like(mu), bottom, top)
    depth = columns(sight.r, sight.mu, sight.length, bottom, medium.density, nodes=16, panels=2)
    through = np.exp(-(depth @ medium.extinction))
    through[sight.to_ground] = 0.0
    return np.asarray(through @ weights / solid_angle)


def sun_solid_angle(angular_radius: float) -> float:
    """Solid angle of a disc. [sr]

    Examples
    --------
    >>> f"{sun_solid_angle(0.2678 * pi / 180):.3e}"
    '6.863e-05'
    """
    return 4.0 * pi * sin(0.5 * angular_radius) ** 2
