"""Regional ground albedo around an observer, used by the solver for the whole planet."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.physics.units import Measure
from airlight.planets.cloud_cover import mean_cover
from airlight.planets.local_ground import GroundMeans, LocalGround
from airlight.planets.medium import Medium
from airlight.planets.parameters import replace
from airlight.planets.reading.reader import PlanetLike, load_planet
from airlight.scene.ground_overlay import ground_overlay
from airlight.scene.ground_weight import ground_distances
from airlight.scene.limits import HIGHEST_ALTITUDE, within
from airlight.scene.observer import planet_frame
from airlight.scene.surface_map import SurfaceMap, surface_map

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

FloatArray = NDArray[np.float64]

#: Numbers of rings of equal weight around the nadir, and of points on each.
_RINGS: Final = 160
_BEARINGS: Final = 96
#: Wavelength at which the weights are computed, or the nearest with data of the planet. [nm]
_WAVELENGTH: Final = 550.0
#: Number of rows of the map level whose mean is the planet's.
_MEAN_ROWS: Final = 700
#: Step of the mean albedo: neighbours share a solution, with an error of at most 0.1 % at the
#: zenith. [1]
_STEP: Final = 0.002


def local_ground(
    planet: PlanetLike, *, latitude: Measure, longitude: Measure, altitude: Measure = 0.0
) -> Planet:
    """Planet with the mean albedo of the ground that illuminates an observer's sky.

    Colour, water and clouds of the map are averaged with the weight of
    ``airlight.scene.ground_weight``: half of it is within a few tens of kilometres of a low
    observer, and on the visible disc from far away. The albedo of the planet's file is multiplied
    by the ratio of the albedos of these means and of the means over the whole map; the rendered map
    is unchanged.

    Parameters
    ----------
    planet : Planet, str, Path or Solution
        Planet, see ``load_planet``; returned unchanged if it has neither map nor clouds.
    latitude, longitude : float
        Coordinates of the point below the observer, -90 to 90 and -360 to 360, north and east
        positive. [deg]
    altitude : float
        Altitude of the observer, 0 to 1e12. [m]

    Returns
    -------
    Planet
        Planet to be solved for this observer.

    Raises
    ------
    ParameterError
        If a coordinate is out of range.
    FileError
        If the map, or the picture of the clouds, cannot be read.

    Examples
    --------
    >>> from airlight import load_planet
    >>> earth = load_planet("earth")
    >>> sahara = local_ground(earth, latitude=23.0, longitude=5.0)
    >>> sahara.ground.albedos([550.0]) > 2.0 * earth.ground.albedos([550.0])
    array([ True])
    """
    planet = load_planet(planet)
    lat = within("latitude", latitude, -90.0, 90.0, "deg")
    lon = within("longitude", longitude, -360.0, 360.0, "deg")
    height = within("altitude", altitude, 0.0, HIGHEST_ALTITUDE, "m")
    ground = planet.ground
    if ground.map is None and ground.clouds is None:
        return planet
    distances, reach = _rings(planet, height)
    shown = None if ground.map is None else surface_map(ground.map)
    here, everywhere = np.zeros(4), np.zeros(4)
    if shown is not None:
        here = ring_mean(shown, lat, lon, distances)
        levels = [k for k, one in enumerate(shown.levels) if one.shape[0] >= _MEAN_ROWS]
        everywhere = shown.mean(max(levels, default=0))
    cover = (0.0, 0.0)
    if ground.clouds is not None:
        clouds = ground_overlay(ground.lights, ground.clouds)
        assert clouds is not None
        cover = float(ring_mean(clouds, lat, lon, distances)[3]), mean_cover(ground.clouds)
    local = LocalGround(
        latitude=lat,
        longitude=math.remainder(lon, 360.0),
        altitude=height,
        reach=reach * planet.bottom_radius,
        here=_means(_STEP * np.round(here / _STEP), _STEP * round(cover[0] / _STEP)),
        planet=_means(everywhere, cover[1]),
    )
    return replace(planet, ground=replace(ground, local=local))


def _means(texel: FloatArray, cover: float) -> GroundMeans:
    red, green, blue, water = (float(one) for one in texel)
    return GroundMeans((red, green, blue), water, cover)


def _rings(planet: Planet, altitude: float) -> tuple[FloatArray, float]:
    """Radii of rings of equal weight, shape (_RINGS,), and the median radius. [rad]"""
    low, high = planet.wavelength_limits
    medium = Medium.from_planet(planet.without_clouds, [min(max(_WAVELENGTH, low), high)])
    shares = np.append((np.arange(_RINGS) + 0.5) / _RINGS, 0.5)
    order = np.argsort(shares)
    found = np.empty_like(shares)
    found[order] = ground_distances(medium, altitude, shares[order])
    return found[:-1], float(found[-1])


def ring_mean(
    shown: SurfaceMap, latitude: float, longitude: float, distances: FloatArray
) -> FloatArray:
    """Mean of a map over rings around a point.

    Parameters
    ----------
    latitude, longitude : float
        Coordinates of the point. [deg]
    distances : array, shape (n,)
        Distances of the rings from it, ascending, seen from the planet's centre. [rad]

    Returns
    -------
    array, shape (4,)
        Mean of the map's four channels, each ring at the mip level with the spacing of its points
        or of the rings. [1]
    """
    bearing = 2.0 * np.pi * (np.arange(_BEARINGS) + 0.5) / _BEARINGS
    far, near = np.sin(distances)[:, None], np.cos(distances)[:, None]
    north, east = far * np.cos(bearing), far * np.sin(bearing)
    up = np.broadcast_to(near, north.shape)
    # x to the north, y to the west: the local frame of a star in the north
    x, y, z = np.tensordot(planet_frame(latitude, longitude, 0.0), [north, -east, up], axes=1)
    spacing = np.maximum(np.gradient(distances), far[:, 0] * (2.0 * np.pi / _BEARINGS))
    level = np.broadcast_to(shown.level(spacing)[:, None], x.shape)
    lat, lon = np.degrees(np.arcsin(np.clip(z, -1.0, 1.0))), np.degrees(np.arctan2(y, x))
    return np.asarray(shown.sample(lat, lon, level).astype(np.float64).mean(axis=(0, 1)))
