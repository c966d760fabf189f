"""Star catalogue as points, and the Milky Way, attenuated and refracted by the atmosphere."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError
from airlight.geometry.ephemeris.instant import days_of
from airlight.geometry.ephemeris.sky import Place, horizon_axes, horizon_axes_by_sun
from airlight.geometry.ephemeris.world import WORLDS
from airlight.physics.spectra.sun import solar_irradiance
from airlight.planets.light_source import LightSource
from airlight.render.through_air import AirAround, SeenThrough, apparent_points
from airlight.scene import Camera, Scene
from airlight.scene.pixel_position import pixel_positions
from airlight.scene.projections import PROJECTIONS
from airlight.scene.projections.projected import projected_rays
from airlight.scene.system.milky_way import Sun, milky_way_radiance
from airlight.scene.system.stars import stars

if TYPE_CHECKING:
    from airlight.render.clouds.clouds_around import CloudsAround
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Pixels of the Milky Way computed together.
_PIXELS: Final = 1 << 16


def add_catalogue(
    rgb: NDArray[np.float32],
    scene: Scene,
    solution: MomentsSolution,
    body: str | None,
    clouds: CloudsAround | None = None,
) -> None:
    """Add the star catalogue and the Milky Way to a frame.

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
    clouds : CloudsAround, optional
        Three-dimensional clouds before the stars.

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
    east, north, up = axes @ stars().directions.T
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
    air = AirAround(
        solution=solution,
        altitude=scene.altitude,
        clouds=None if clouds is None else clouds.before_space(solution, scene),
        pole=scene.ground_frame[2],
    )
    add_shown(rgb, camera, camera.axes, air, solution.lights[0], true, free & near)
    # North and east in the scene's frame, whose x axis is at the sun's azimuth.
    turned = np.array(
        [
            [math.sin(turn), math.cos(turn), 0.0],
            [-math.cos(turn), math.sin(turn), 0.0],
            [0.0, 0.0, 1.0],
        ]
    )
    discs = [
        (light.direction, light.radius(solution.lights[0].angular_radius)) for light in scene.lights
    ]
    star, sky = solution.lights[0], turned @ axes
    sun = _sun(scene.lights[0].direction @ sky, star)
    add_milky_way(rgb, camera, camera.axes, air, star, sky, discs, sun)


def add_sky(
    rgb: NDArray[np.floating],
    camera: Camera,
    axes: FloatArray,
    air: SeenThrough,
    source: LightSource,
    weights: FloatArray | None = None,
) -> None:
    """Add the catalogue and the Milky Way to a frame in the frame of the J2000 equator.

    Parameters
    ----------
    rgb, camera, axes, air, source, weights :
        Arguments of ``add_shown``.
    """
    true = stars().directions
    shown = np.isfinite(pixel_positions(camera, true @ axes.T)[0])
    add_shown(rgb, camera, axes, air, source, true, shown, weights)
    add_milky_way(rgb, camera, axes, air, source, weights=weights)


def _sun(direction: FloatArray, source: LightSource) -> Sun:
    """The sun in a direction of the frame of the J2000 equator [1], as far as it is bright."""
    x, y, z = direction.tolist()
    return Sun(x, y, z, sun_distance(source))


def sun_distance(source: LightSource) -> float:
    """Distance at which the sun's irradiance is that of a light. [au]"""
    whole = float(solar_irradiance(source.wavelengths).sum())
    return math.sqrt(whole / float(source.irradiance.sum()))


def add_milky_way(
    rgb: NDArray[np.floating],
    camera: Camera,
    axes: FloatArray,
    air: SeenThrough,
    source: LightSource,
    sky: FloatArray | None = None,
    discs: Sequence[tuple[FloatArray, float]] = (),
    sun: Sun | None = None,
    weights: FloatArray | None = None,
) -> None:
    """Add the Milky Way and zodiacal light, attenuated and refracted by air or occulted.

    Parameters
    ----------
    rgb, camera, axes, air, source, weights :
        Arguments of ``add_shown``.
    sky : array, shape (3, 3), optional
        Axes of the frame of ``axes`` in that of the J2000 equator, as rows; by default the same.
        [1]
    discs : sequence of (array, float)
        Directions and angular radii of lights that hide it. [1], [rad]
    sun : Sun, optional
        The sun, for zodiacal light; without it there is none.
    """
    rows, columns = rgb.shape[:2]
    weights = source.colors(weights) / source.irradiance[:, None]
    weights = weights * (1.0 if camera.polariser is None else 0.5)
    assert camera.field_of_view is not None
    angle = math.radians(camera.field_of_view)
    x = np.arange(columns, dtype=np.float64) + (camera.left + 0.5)
    step = max(1, _PIXELS // columns)
    for first in range(0, rows, step):
        y = np.arange(first, min(first + step, rows), dtype=np.float64) + (camera.top + 0.5)
        rays = projected_rays(camera.projection, x, y, camera.width, camera.height, angle)
        rays = rays.reshape(-1, 3)
        shown = np.flatnonzero(np.any(rays != 0.0, axis=-1))
        through, true = air.behind(rays[shown] @ axes)
        for towards, radius in discs:
            through[true @ towards > math.cos(radius)] = 0.0
        seen = np.flatnonzero(through.max(axis=1) > 0.0)
        known = true[seen] if sky is None else true[seen] @ sky
        light = (through[seen] * milky_way_radiance(known, source.wavelengths, sun)) @ weights
        rgb[first : first + y.size].reshape(-1, 3)[shown[seen]] += light


def add_shown(
    rgb: NDArray[np.floating],
    camera: Camera,
    axes: FloatArray,
    air: SeenThrough,
    source: LightSource,
    true: FloatArray,
    shown: NDArray[np.bool_],
    weights: FloatArray | None = None,
) -> None:
    """Add stars of the catalogue, attenuated and refracted by air or occulted.

    Parameters
    ----------
    rgb : array, shape (rows, columns, 3)
        Linear sRGB, modified in place. [W m⁻² sr⁻¹]
    camera : Camera
        Camera.
    axes : array, shape (3, 3)
        Its right, up and forward, as rows. [1]
    air : SeenThrough
        Air, and bodies, around the observer.
    source : LightSource
        Light with the colour-matching functions at the wavelengths.
    true : array, shape (n, 3)
        Directions of all stars of the catalogue. [1]
    shown : array, shape (n,)
        Which of them are added.
    weights : array, shape (nl, 3), optional
        Linear sRGB per radiance; by default ``picture_weights``.
    """
    if not shown.any():
        return
    rays, through = apparent_points(air, true[shown])
    weights = source.colors(weights) / source.irradiance[:, None]
    light = (through * stars().irradiances(source.wavelengths)[shown]) @ weights
    light *= 1.0 if camera.polariser is None else 0.5  # starlight is not polarised
    x, y, solid = pixel_positions(camera, rays @ axes.T)
    seen = np.isfinite(x) & (through.max(axis=1) > 0.0)
    add_points(rgb, x[seen] - camera.left, y[seen] - camera.top, light[seen] / solid[seen, None])


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
    for i, j, share in (
        (0, 0, (1.0 - right) * (1.0 - down)),
        (0, 1, right * (1.0 - down)),
        (1, 0, (1.0 - right) * down),
        (1, 1, right * down),
    ):
        inside = (row + i >= 0) & (row + i < rgb.shape[0])
        inside &= (column + j >= 0) & (column + j < rgb.shape[1])
        np.add.at(rgb, (row[inside] + i, column[inside] + j), (share[:, None] * light)[inside])
