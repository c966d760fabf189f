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
_SAMPLES: Final = 5
#: Rings and spokes of samples on a disc that is smaller than a pixel.
_RINGS: Final = 4
_SPOKES: Final = 12


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
    pixel = scene.camera.pixel_angle
    reach = 2.0 * (alpha + pixel)
    # The cheap test first: most rows are far from the star.
    rows = [
        row
        for row in range(rgb.shape[0])
        if (scene.camera.directions(slice(row, row + 1))[0] @ sun > cos(min(reach, pi))).any()
    ]
    if alpha < pixel:
        _add_small_disc(rgb, rows, solution, scene, weights)
        return
    solid_angle = sun_solid_angle(alpha)
    offsets = (np.arange(_SAMPLES) + 0.5) / _SAMPLES - 0.5
    for row in rows:
        directions = scene.camera.directions(slice(row, row + 1))[0]
        near = directions @ sun > cos(min(reach, pi))
        whole = near & (_angle(directions, sun) < alpha - 0.75 * pixel)
        if whole.any():
            light = _through(directions[whole], solution, scene.altitude) @ weights
            rgb[row, whole] += light / solid_angle
        rim = np.flatnonzero(near & ~whole)
        total = np.zeros((rim.size, 3))
        for dy in offsets:
            for dx in offsets:
                at = scene.camera.directions(slice(row, row + 1), offset=(dx, dy))[0][rim]
                inside = _angle(at, sun) < alpha
                if inside.any():
                    light = _through(at[inside], solution, scene.altitude) @ weights
                    total[inside] += light / solid_angle
        rgb[row, rim] += total / _SAMPLES**2


def _add_small_disc(
    rgb: NDArray[np.float32],
    rows: list[int],
    solution: Solution,
    scene: Scene,
    weights: FloatArray,
) -> None:
    """Share out a disc smaller than a pixel: each of its samples goes to the nearest pixel.

    Pixels then hold irradiance over their own solid angle, so that no light is lost or made.
    """
    if not rows:
        return
    block = slice(rows[0], rows[-1] + 1)
    camera, sun = scene.camera, scene.sun_direction
    corners = [
        camera.directions(block, offset=offset)
        for offset in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))
    ]
    solid_angles = 0.5 * np.linalg.norm(
        np.cross(corners[2] - corners[0], corners[3] - corners[1]), axis=-1
    )
    middles = camera.directions(block).reshape(-1, 3)
    samples = _disc_samples(sun, solution.medium.star_angular_radius)
    light = _through(samples, solution, scene.altitude) @ weights / len(samples)
    nearest = np.argmax(samples @ middles.T, axis=1)
    # Outside a fisheye's circle nothing is seen; a sample must also lie on its pixel.
    seen = np.any(middles[nearest] != 0.0, axis=1) & (solid_angles.ravel()[nearest] > 0.0)
    distance = np.linalg.norm(middles[nearest] - samples, axis=1)
    seen &= distance < 1.5 * np.sqrt(np.maximum(solid_angles.ravel()[nearest], 1e-30))
    flat = rgb[block].reshape(-1, 3)
    np.add.at(
        flat,
        nearest[seen],
        (light[seen] / solid_angles.ravel()[nearest[seen], None]).astype(np.float32),
    )


def _disc_samples(sun: FloatArray, angular_radius: float) -> FloatArray:
    """Directions that stand for equal parts of the star's disc, shape (n, 3)."""
    ring, spoke = np.meshgrid(np.arange(_RINGS), np.arange(_SPOKES), indexing="ij")
    radius = angular_radius * np.sqrt((ring + 0.5) / _RINGS)
    # Half a spoke off the vertical: mirror images of each other, and none on the mirror itself.
    turn = (spoke + 0.5) * (2.0 * pi / _SPOKES)
    side = np.cross(sun, (0.0, 1.0, 0.0) if abs(sun[1]) < 0.9 else (1.0, 0.0, 0.0))
    side /= np.linalg.norm(side)
    other = np.cross(sun, side)
    tangent = np.cos(turn)[..., None] * side + np.sin(turn)[..., None] * other
    samples = np.cos(radius)[..., None] * sun + np.sin(radius)[..., None] * tangent
    return np.asarray(samples.reshape(-1, 3))


def _angle(directions: FloatArray, sun: FloatArray) -> FloatArray:
    """Angle to the star, from the length of the difference; π where there is no direction."""
    half = 0.5 * np.linalg.norm(directions - sun, axis=-1)
    seen = np.any(directions != 0.0, axis=-1)
    return np.asarray(np.where(seen, 2.0 * np.arcsin(np.minimum(half, 1.0)), pi))


def _through(directions: FloatArray, solution: Solution, altitude: float) -> FloatArray:
    """Transmittance to space along directions, 0 where the ground is in the way, (n, nl). [1]"""
    medium = solution.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    mu = np.clip(directions[:, 2], -1.0, 1.0)
    sine = np.hypot(directions[:, 0], directions[:, 1])
    r = np.full(mu.shape, bottom + altitude)
    sight = enter_shell(r, mu, sine, mu, np.ones_like(mu), bottom, top)
    depth = columns(sight.r, sight.mu, sight.length, bottom, medium.density, nodes=16, panels=2)
    through = np.exp(-(depth @ medium.extinction))
    through[sight.to_ground] = 0.0
    return np.asarray(through)


def sun_solid_angle(angular_radius: float) -> float:
    """Solid angle of a disc. [sr]

    Examples
    --------
    >>> f"{sun_solid_angle(0.2678 * pi / 180):.3e}"
    '6.863e-05'
    """
    return 4.0 * pi * sin(0.5 * angular_radius) ** 2
