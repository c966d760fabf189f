"""Star catalogue as point sources in a frame, attenuated and refracted by the atmosphere."""

from __future__ import annotations

import math
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError
from airlight.geometry.ephemeris.instant import days_of
from airlight.geometry.ephemeris.sky import Place, horizon_axes, horizon_axes_by_sun
from airlight.geometry.ephemeris.world import WORLDS
from airlight.geometry.refraction import apparent_sun_cosine
from airlight.render.through_air import through_air
from airlight.scene import Scene
from airlight.scene.pixel_position import pixel_positions
from airlight.scene.projections import PROJECTIONS
from airlight.scene.system.stars import stars
from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Iterations for the apparent direction of a star behind refracting air.
_BENDS: Final = 4


def add_catalogue(
    rgb: NDArray[np.float32], scene: Scene, solution: MomentsSolution, body: str | None
) -> None:
    """Add the star catalogue to a frame.

    Sidereal time follows from the scene's time or, without it, from the position of the sun, see
    ``horizon_axes_by_sun``.

    Parameters
    ----------
    rgb : array, shape (rows, columns, 3)
        Linear sRGB, modified in place. [W m⁻² sr⁻¹]
    scene : Scene
        Scene; discs of its lights occult stars.
    body : str or None
        Celestial body of the planet, from ``WORLDS``.

    Raises
    ------
    ParameterError
        If the body is not in ``WORLDS``, or the camera is orthographic.
    """
    check_stars(body, scene.camera.projection)
    place = Place(body=str(body), latitude=scene.latitude, longitude=scene.longitude)
    if scene.time is None:
        axes = horizon_axes_by_sun(place, scene.sun_zenith, scene.sun_azimuth)
    else:
        axes = horizon_axes(place, days_of(scene.time))
    catalogue = stars()
    east, north, up = axes @ catalogue.directions.T
    turn = math.radians(scene.sun_azimuth)
    ahead = north * math.cos(turn) + east * math.sin(turn)
    true = np.stack([ahead, north * math.sin(turn) - east * math.cos(turn), up], axis=-1)
    free = np.ones(len(true), bool)
    for light in scene.lights:
        radius = light.radius(solution.lights[0].angular_radius)
        free &= true @ light.direction < math.cos(radius)
    # candidates in view; refraction near the horizon is below 2°
    camera = scene.camera
    ahead_of = true @ camera.axes.T
    x, _, _ = pixel_positions(camera, ahead_of)
    near = np.isfinite(x) | (np.abs(true[:, 2]) < math.sin(math.radians(2.0)))
    shown = np.flatnonzero(free & near)
    if shown.size == 0:
        return
    rays, through = apparent_points(solution, scene.altitude, true[shown])
    source = solution.lights[0]
    weights = source.colors() / source.irradiance[:, None]
    light_of = (through * catalogue.irradiances(solution.wavelengths)[shown]) @ weights
    light_of *= 1.0 if camera.polariser is None else 0.5  # starlight is not polarised
    x, y, solid = pixel_positions(camera, rays @ camera.axes.T)
    seen = np.isfinite(x) & (through.max(axis=1) > 0.0)
    add_points(rgb, x[seen] - camera.left, y[seen] - camera.top, light_of[seen] / solid[seen, None])


def check_stars(body: str | None, projection: str, field: str = "stars") -> None:
    """Raise if a planet or projection does not support the star catalogue.

    Parameters
    ----------
    body : str or None
        Celestial body of the planet.
    projection : str
        Projection of the camera.
    field : str
        Name in the error.

    Raises
    ------
    ParameterError
        If the body is not in ``WORLDS``, or the projection is parallel.
    """
    if body not in WORLDS:
        raise ConflictError(field, f"requires a planet whose body is {' or '.join(WORLDS)}")
    if PROJECTIONS[projection].parallel:
        raise ConflictError(field, f"cannot be combined with projection {projection}")


def apparent_points(
    solution: MomentsSolution, altitude: float, true: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Apparent directions of points at infinity, and transmittance towards them.

    Fixed-point iteration on the error of the refracted direction, from the direction that the
    refraction table gives.

    Parameters
    ----------
    altitude : float
        Altitude of the observer. [m]
    true : array, shape (n, 3)
        Unit vectors in the observer's local frame, with z to the zenith.

    Returns
    -------
    rays : array, shape (n, 3)
        Unit vectors.
    transmittance : array, shape (n, nl)
        Transmittance; 0 where the line ends on the ground. [1]
    """
    rays = true
    if altitude < solution.medium.thickness:
        rays = raised_points(solution, altitude, true)
    for _ in range(_BENDS):
        through, behind = through_air(solution, altitude, rays)
        open_ = through.max(axis=1) > 0.0
        moved = np.where(open_[:, None], rays + true - behind, rays)
        rays = moved / np.linalg.norm(moved, axis=-1, keepdims=True)
    return rays, through_air(solution, altitude, rays)[0]


def raised_points(solution: MomentsSolution, altitude: float, true: FloatArray) -> FloatArray:
    """Apparent directions of points at infinity within the atmosphere, by the refraction table.

    Parameters
    ----------
    solution, altitude, true :
        Arguments of ``apparent_points``.

    Returns
    -------
    array, shape (n, 3)
        Unit vectors in the observer's local frame.
    """
    geometry = solution.geometry
    if geometry.shell is None:
        return true
    r = np.array(solution.medium.bottom_radius + altitude)
    place = float(geometry.optical_radius(r)), geometry.shell.bottom, geometry.shell.top
    seen = np.array(
        [
            apparent_sun_cosine(place[0], z, *place[1:], geometry.refraction_table)
            for z in true[:, 2]
        ]
    )
    flat = np.hypot(true[:, 0], true[:, 1])
    level = np.sqrt(np.maximum((1.0 - seen) * (1.0 + seen), 0.0))
    scale = np.divide(level, flat, out=np.ones_like(flat), where=flat > 0.0)
    return np.stack([true[:, 0] * scale, true[:, 1] * scale, seen], axis=-1)


def add_points(rgb: NDArray[np.floating], x: FloatArray, y: FloatArray, light: FloatArray) -> None:
    """Add point sources to a frame, splatted bilinearly onto the four nearest pixels.

    Parameters
    ----------
    rgb : array, shape (height, width, 3)
        Linear sRGB. [W m⁻² sr⁻¹]
    x, y : array, shape (n,)
        Positions from the left and the top edge. [pixel]
    light : array, shape (n, 3)
        Irradiance over the solid angle of a pixel there, as linear sRGB. [W m⁻² sr⁻¹]

    Examples
    --------
    >>> picture = np.zeros((2, 2, 3))
    >>> add_points(picture, np.array([0.75]), np.array([0.5]), np.array([[1.0, 1.0, 1.0]]))
    >>> picture[..., 0]
    array([[0.75, 0.25],
           [0.  , 0.  ]])
    """
    column, row = np.floor(x - 0.5).astype(int), np.floor(y - 0.5).astype(int)
    right, down = x - 0.5 - column, y - 0.5 - row
    for i, j, share in ((0, 0, (1.0 - right) * (1.0 - down)), (0, 1, right * (1.0 - down)),
                        (1, 0, (1.0 - right) * down), (1, 1, right * down)):  # fmt: skip
        inside = (row + i >= 0) & (row + i < rgb.shape[0])
        inside &= (column + j >= 0) & (column + j < rgb.shape[1])
        np.add.at(rgb, (row[inside] + i, column[inside] + j), (share[:, None] * light)[inside])
