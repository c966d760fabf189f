"""Observers of a planet with rings: where its pole is, and the rings' shadow there."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets.parameters import MISSING
from airlight.solver.lines_of_sight import LinesOfSight, distance_to_shell, start_frame
from airlight.solver.named_axes import Argument
from airlight.solver.tables.ring_shadow import ring_shades, ring_tables

if TYPE_CHECKING:
    from airlight.physics.units import Measures
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]


def place_arguments(latitude: Measures | None, sun_azimuth: Measures | None) -> dict[str, Argument]:
    """Latitude and compass bearing of the star as arguments of a query, both or none. [deg]"""
    if latitude is None and sun_azimuth is None:
        return {}
    if latitude is None or sun_azimuth is None:
        name = "latitude" if latitude is None else "sun_azimuth"
        raise ParameterError(name, MISSING, "both latitude and sun_azimuth, or none")
    return {
        "latitude": Argument(latitude, -90.0, 90.0, "deg"),
        "sun_azimuth": Argument(sun_azimuth, -360.0, 360.0, "deg"),
    }


def ring_shade_at(
    medium: Medium, r: FloatArray, sun: FloatArray, latitude: FloatArray, bearing: FloatArray
) -> FloatArray:
    """Transmittance of the rings between points and the star, shape (n,). [1]

    Parameters
    ----------
    medium : Medium
        Planet with its rings, a sphere.
    r, sun, latitude, bearing : array, shape (n,)
        Radii [m]; zenith angles of the star, latitudes and compass bearings of the star [rad].
    """
    pole = pole_direction(latitude, bearing)
    rise = np.sin(sun) * pole[:, 0] + np.cos(sun) * pole[:, 2]
    rings, star = ring_tables(medium.rings, medium.wavelengths), medium.lights[0].angular_radius
    left = np.empty_like(r)
    ring_shades(np.square(r), r * np.cos(sun), r * pole[:, 2], rise, star, rings, left)
    return left


def under_rings(
    lines: LinesOfSight,
    r: FloatArray,
    view: tuple[FloatArray, FloatArray],
    sun: FloatArray,
    place: tuple[FloatArray, FloatArray],
) -> LinesOfSight:
    """Lines of sight in the shadow of rings.

    Parameters
    ----------
    lines : LinesOfSight
        Lines from ``enter_shell``.
    r : array, shape (n,)
        Radii of the observers. [m]
    view : (array, array)
        Zenith angle of the view, and its azimuth from the star, clockwise. [rad]
    sun : array, shape (n,)
        Zenith angle of the star. [rad]
    place : (array, array)
        Latitude, and compass bearing of the star. [rad]
    """
    zenith, azimuth = view
    zero = np.zeros_like(r)
    towards = np.stack([np.sin(sun), zero, np.cos(sun)], axis=-1)
    along = np.stack(
        [np.sin(zenith) * np.cos(azimuth), np.sin(zenith) * np.sin(azimuth), np.cos(zenith)],
        axis=-1,
    )
    north = pole_direction(*place)
    way = distance_to_shell(r, along[:, 2], np.sin(zenith), lines.r)
    start = np.stack([zero, zero, r], axis=-1) + way[:, None] * along
    up = start / np.linalg.norm(start, axis=-1, keepdims=True)
    frames = [start_frame(up[k], along[k], towards[k]) for k in range(r.size)]
    poles = [frame @ one for frame, one in zip(frames, north, strict=True)]
    return replace(lines, pole=np.reshape(poles, (-1, 3)))


def pole_direction(latitude: FloatArray, bearing: FloatArray) -> FloatArray:
    """North pole in the frame x towards the star, y to its right, z up, shape (n, 3). [1]

    Parameters
    ----------
    latitude, bearing : array, shape (n,)
        Latitude, and compass bearing of the star. [rad]
    """
    level = np.cos(latitude)
    return np.stack([level * np.cos(bearing), -level * np.sin(bearing), np.sin(latitude)], axis=-1)
