"""Star's disc by many samples a pixel: slow, the reference for the disc that is rendered."""

from __future__ import annotations

from math import cos, pi
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.refraction import apparent_sun
from airlight.render.through_air import leaving_direction, straight_lines, sun_solid_angle
from airlight.scene import Scene
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.tables.columns import columns

FloatArray = NDArray[np.float64]

#: Samples across a pixel that the rim of the disc crosses.
_SAMPLES: Final = 5
#: Rings and spokes of samples on a disc that is smaller than a pixel.
_RINGS: Final = 4
_SPOKES: Final = 12


def add_sun_disc(
    rgb: NDArray[np.float32], solution: MomentsSolution, scene: Scene, weights: FloatArray
) -> None:
    """Add the star's disc to a picture.

    Its radiance is irradiance over solid angle, times the transmittance along each pixel's own
    line of sight. With refraction, the disc is where the refracted lines of sight meet it: lifted,
    and flattened near the horizon. Each sample has the darkening of its place on the disc; a disc
    of less than a pixel is even. A point star (angular radius 0) is not rendered.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB, to which the disc is added. [W m⁻² sr⁻¹]
    solution : MomentsSolution
        Solution with the medium that the light crosses.
    scene : Scene
        Camera and star.
    weights : array, shape (nl, 3)
        Linear sRGB per radiance over irradiance. [W m⁻² sr⁻¹ sr]
    """
    alpha = solution.medium.star_angular_radius
    if alpha <= 0.0:
        return
    sun = scene.sun_direction
    seen = apparent_direction(sun, solution, scene.altitude)
    pixel = scene.camera.pixel_angle
    reach = 2.0 * (alpha + pixel) + solution.geometry.max_refraction
    # The cheap test first: most rows are far from the star.
    rows = [
        row
        for row in range(rgb.shape[0])
        if (scene.camera.directions(slice(row, row + 1))[0] @ seen > cos(min(reach, pi))).any()
    ]
    if alpha < pixel:
        _add_small_disc(rgb, rows, solution, scene, weights)
        return
    solid_angle = sun_solid_angle(alpha)
    offsets = (np.arange(_SAMPLES) + 0.5) / _SAMPLES - 0.5
    for row in rows:
        directions = scene.camera.directions(slice(row, row + 1))[0]
        near = directions @ seen > cos(min(reach, pi))
        whole = np.zeros(near.shape, bool)
        outside = leaving_direction(directions[near], solution, scene.altitude)
        whole[near] = _angle(outside, sun) < alpha - 1.5 * pixel
        if whole.any():
            shape = _darkened(_angle(outside, sun)[whole[near]], solution)
            light = (shape * _through(directions[whole], solution, scene.altitude)) @ weights
            rgb[row, whole] += light / solid_angle
        rim = np.flatnonzero(near & ~whole)
        total = np.zeros((rim.size, 3))
        for dy in offsets:
            for dx in offsets:
                at = scene.camera.directions(slice(row, row + 1), offset=(dx, dy))[0][rim]
                outside = leaving_direction(at, solution, scene.altitude)
                inside = _angle(outside, sun) < alpha
                if inside.any():
                    shape = _darkened(_angle(outside, sun)[inside], solution)
                    light = (shape * _through(at[inside], solution, scene.altitude)) @ weights
                    total[inside] += light / solid_angle
        rgb[row, rim] += total / _SAMPLES**2


def _darkened(apart: FloatArray, solution: MomentsSolution) -> FloatArray:
    """Radiance over the mean of the disc at angles from its middle, shape (n, nl). [1]"""
    star = solution.lights[0]
    ratio = np.sin(apart) / np.sin(star.angular_radius)
    mu = np.sqrt(np.maximum(1.0 - ratio**2, 0.0))
    law = star.darkenings
    return np.asarray((mu[:, None] ** np.arange(law.shape[1])) @ law.T)


def _add_small_disc(
    rgb: NDArray[np.float32],
    rows: list[int],
    solution: MomentsSolution,
    scene: Scene,
    weights: FloatArray,
) -> None:
    """Distribute a disc smaller than a pixel: each of its samples goes to the nearest pixel.

    Pixels then hold irradiance over their own solid angle, which conserves the light.
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
    samples = np.stack(
        [
            apparent_direction(one, solution, scene.altitude)
            for one in _disc_samples(sun, solution.medium.star_angular_radius)
        ]
    )
    squeeze = squeezed(sun, solution, scene.altitude)
    light = _through(samples, solution, scene.altitude) @ weights * (squeeze / len(samples))
    nearest = np.argmax(samples @ middles.T, axis=1)
    # Outside a fisheye's circle nothing is visible; a sample must also lie on its pixel.
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
    """Directions that represent equal parts of the star's disc, shape (n, 3)."""
    ring, spoke = np.meshgrid(np.arange(_RINGS), np.arange(_SPOKES), indexing="ij")
    radius = angular_radius * np.sqrt((ring + 0.5) / _RINGS)
    # Half a spoke off the vertical: the samples mirror each other, and none lies on the axis.
    turn = (spoke + 0.5) * (2.0 * pi / _SPOKES)
    side = np.cross(sun, (0.0, 1.0, 0.0) if abs(sun[1]) < 0.9 else (1.0, 0.0, 0.0))
    side /= np.linalg.norm(side)
    other = np.cross(sun, side)
    tangent = np.cos(turn)[..., None] * side + np.sin(turn)[..., None] * other
    samples = np.cos(radius)[..., None] * sun + np.sin(radius)[..., None] * tangent
    return np.asarray(samples.reshape(-1, 3))


def _angle(directions: FloatArray, sun: FloatArray) -> FloatArray:
    """Angle to the star, from the length of the difference; π where there is no direction. [rad]"""
    half = 0.5 * np.linalg.norm(directions - sun, axis=-1)
    seen = np.any(directions != 0.0, axis=-1)
    return np.asarray(np.where(seen, 2.0 * np.arcsin(np.minimum(half, 1.0)), pi))


def _through(directions: FloatArray, solution: MomentsSolution, altitude: float) -> FloatArray:
    """Transmittance to space along directions, 0 where the ground intervenes, (n, nl). [1]"""
    (lines, _), medium = straight_lines(directions, solution, altitude), solution.geometry.medium
    depth = columns(
        lines.r, lines.mu, lines.length, medium.bottom_radius, medium.density, nodes=32, panels=12
    )
    transmittance = np.exp(-(depth @ medium.extinction))
    transmittance[lines.to_ground] = 0.0
    return np.asarray(transmittance)


def apparent_direction(
    direction: FloatArray, solution: MomentsSolution, altitude: float
) -> FloatArray:
    """Apparent direction of a star at a true direction: lifted by refraction.

    Below the true position of the horizon, where it is invisible, the lift is that of the horizon.

    Parameters
    ----------
    direction : array, shape (3,)
        Unit vector in the local frame.
    solution : MomentsSolution
    altitude : float
        Altitude of the observer. [m]

    Returns
    -------
    array, shape (3,)
        Unit vector.
    """
    seen, _ = _seen(direction, solution, altitude)
    level = float(np.hypot(direction[0], direction[1]))
    if seen == direction[2] or level == 0.0:
        return direction
    scale = np.sqrt(max((1.0 - seen) * (1.0 + seen), 0.0)) / level
    return np.array([direction[0] * scale, direction[1] * scale, seen])


def squeezed(direction: FloatArray, solution: MomentsSolution, altitude: float) -> float:
    """Ratio of the disc's apparent size to that without air, at a true direction. [1]"""
    return _seen(direction, solution, altitude)[1]


def _seen(direction: FloatArray, solution: MomentsSolution, altitude: float) -> tuple[float, float]:
    """Sine of a star's apparent elevation, and its squeeze; true values from space. [1]

    Outside the shell light is not refracted until it enters: the apparent direction through the air
    follows from ``leaving_direction``, pixel by pixel.
    """
    geometry, true = solution.geometry, float(direction[2])
    if geometry.shell is None or solution.medium.thickness <= altitude:
        return true, 1.0
    x = float(geometry.optical_radius(np.array(solution.medium.bottom_radius + altitude)))
    seen, squeeze, _ = apparent_sun(
        x, true, geometry.shell.bottom, geometry.shell.top, geometry.refraction_table
    )
    return float(seen), float(squeeze)
