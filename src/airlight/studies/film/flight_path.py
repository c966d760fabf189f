"""``FlightPath``: flight over a planet, through key frames of the whole view.

The observer flies along great circles, the camera turns by rotations, the sun moves as by time of
day; altitude and field of view change by equal factors. Velocities are continuous.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.geometry.place_axes import place_axes
from airlight.scene.directions import camera_angles, camera_axes, level_axes
from airlight.scene.flight import FOOTING
from airlight.studies.film.key_frames import smooth

FloatArray: TypeAlias = NDArray[np.float64]

#: Numbers of a view that a flight joins, with their units; roll, field of view and sun may be
#: left out.
UNITS: Final = {
    **dict.fromkeys(("latitude", "longitude", "look_zenith", "look_bearing", "roll"), "deg"),
    **dict.fromkeys(("field_of_view", "sun_zenith", "sun_azimuth"), "deg"),
    "altitude": "m",
}
_REQUIRED: Final = ("latitude", "longitude", "altitude", "look_zenith", "look_bearing")
_SUN: Final = ("sun_zenith", "sun_azimuth")
#: Sum of opposite unit vectors, between which no arc is shortest. [1]
_OPPOSITE: Final = 1e-9
#: From right, up and forward of a camera, which are left-handed, to right, up and back.
_BACK: Final = np.diag([1.0, 1.0, -1.0])


def smooth_arcs(at: FloatArray, points: FloatArray, where: FloatArray) -> FloatArray:
    r"""Curve through points of a sphere with a continuous velocity, at rest at both ends.

    Pieces are cubic Bézier curves by de Casteljau's construction from arcs of great circles
    (Shoemake 1985). The velocity at an inner key has the direction of the mean of the adjacent
    arcs' unit tangents :math:`e`, and their speeds' weighted harmonic mean, as ``smooth``,

    .. math:: \frac{w_1 + w_2}{w_1 / s_{k-1} + w_2 / s_k} \; \frac{e_{k-1} + e_k}{2},

    so that points of one great circle are joined along it as ``smooth`` joins their angles.

    Parameters
    ----------
    at : array, shape (k,)
        Times of the points, ascending.
    points : array, shape (k, m)
        Unit vectors; successive ones are not opposite. [1]
    where : array, shape (n,)
        Times of the results, shape (n, m).

    References
    ----------
    Shoemake (1985), SIGGRAPH Computer Graphics 19, 245. doi:10.1145/325165.325242

    Examples
    --------
    >>> quarter = np.array([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    >>> smooth_arcs(np.array([0.0, 1.0]), quarter, np.array([0.5])).round(6)
    array([[0.707107, 0.707107, 0.      ]])
    """
    h = np.diff(at)[:, None]
    velocities = np.zeros_like(points)
    before = -_tangent(points[1:], points[:-1])[:-1] / h[:-1]
    after = _tangent(points[:-1], points[1:])[1:] / h[1:]
    first, second = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    speeds = [np.linalg.norm(one, axis=-1, keepdims=True) for one in (before, after)]
    rests = (speeds[0] == 0.0) | (speeds[1] == 0.0)
    s, t = (np.where(rests, 1.0, one) for one in speeds)
    mean = (first + second) / (first / s + second / t)
    velocities[1:-1] = np.where(rests, 0.0, mean * 0.5 * (before / s + after / t))
    within = np.clip(where, at[0], at[-1])
    k = np.clip(np.searchsorted(at, within, side="right") - 1, 0, len(at) - 2)
    u = ((within - at[k]) / h[k, 0])[:, None]
    curve = [
        points[k],
        _moved(points[k], h[k] * velocities[k] / 3.0),
        _moved(points[k + 1], -h[k] * velocities[k + 1] / 3.0),
        points[k + 1],
    ]
    while len(curve) > 1:
        curve = [_moved(a, u * _tangent(a, b)) for a, b in pairwise(curve)]
    return curve[0]


def _tangent(start: FloatArray, end: FloatArray) -> FloatArray:
    """Tangent at the start of the arc to the end; its length is the angle. [rad]"""
    cosine = (start * end).sum(axis=-1, keepdims=True)
    aside = end - cosine * start
    sine = np.linalg.norm(aside, axis=-1, keepdims=True)
    length = np.arctan2(sine, cosine) / np.where(sine > 0.0, sine, 1.0)
    return np.asarray(aside * length)


def _moved(start: FloatArray, tangent: FloatArray) -> FloatArray:
    """End of the arc of a tangent."""
    angle = np.linalg.norm(tangent, axis=-1, keepdims=True)
    end = np.cos(angle) * start + np.sinc(angle / np.pi) * tangent
    return np.asarray(end / np.linalg.norm(end, axis=-1, keepdims=True))


class FlightPath:
    """Flight through views.

    Parameters
    ----------
    at : sequence of float
        Times of the views, ascending, two at least.
    views : mapping from str to sequence of float
        Numbers of the views by name, ``UNITS``; roll, field of view and sun may be left out.

    Raises
    ------
    ParameterError
        If numbers are missing, or successive places are opposite each other.

    Examples
    --------
    >>> level = {"altitude": [2, 2], "look_zenith": [90, 90], "look_bearing": [90, 90]}
    >>> path = FlightPath([0, 1], {"latitude": [0, 0], "longitude": [0, 90], **level})
    >>> {name: round(value, 6) for name, value in path.view(0.5).items()}
    {'latitude': 0.0, 'longitude': 45.0, 'look_zenith': 90.0, 'look_bearing': 90.0, 'altitude': 2.0}
    """

    def __init__(self, at: Sequence[float], views: Mapping[str, Sequence[float]]) -> None:
        missing = [name for name in _REQUIRED if name not in views]
        missing += [name for name in _SUN if name not in views and set(_SUN) & set(views)]
        if missing:
            allowed = f"a flight of view.{', view.'.join(_REQUIRED)}, and both or no sun_ angles"
            raise ParameterError("keys", f"without view.{missing[0]}", allowed)
        self._at = np.array(at, float)
        given = {name: np.array(one, float) for name, one in views.items()}
        self._sees_sun, self._rolls = "sun_zenith" in given, "roll" in given
        local = place_axes(given["latitude"], given["longitude"])
        self._places = local[:, 2]
        if (np.linalg.norm(self._places[1:] + self._places[:-1], axis=-1) < _OPPOSITE).any():
            raise ParameterError("keys", "view.latitude", "places that are not opposite each other")
        # Around this axis a flight along a great circle is level: it is the circle's pole.
        self._axis = np.linalg.eigh(self._places.T @ self._places)[1][:, 0]
        roll = given.get("roll", np.zeros(len(self._at)))
        look = zip(given["look_zenith"], given["look_bearing"], roll, strict=True)
        cameras = [
            camera_axes(*one) @ _compass(axes) for one, axes in zip(look, local, strict=True)
        ]
        self._cameras = _quaternions(
            np.array([c @ self._level(up).T for c, up in zip(cameras, self._places, strict=True)])
        )
        logarithms = {"altitude": FOOTING, "field_of_view": 0.0}
        self._logarithms = {name: x for name, x in logarithms.items() if name in given}
        for name, offset in self._logarithms.items():
            if (given[name] <= -offset).any():
                raise ParameterError("keys", f"view.{name}", "numbers above 0 in a flight")
        columns = [np.log(given[name] + offset) for name, offset in self._logarithms.items()]
        if self._sees_sun:
            axes = [_compass(one) for one in local]
            suns = zip(given["sun_zenith"], given["sun_azimuth"], axes, strict=True)
            columns += list(_below(np.array([camera_axes(z, a, 0.0)[2] @ x for z, a, x in suns])))
        self._columns = np.stack(columns, axis=-1)

    def _level(self, up: FloatArray) -> FloatArray:
        """Axes of a place that keep their angle to a flight along a great circle."""
        return level_axes(up, self._axis)

    def view(self, time: float) -> dict[str, float]:
        """View at a time, by the names of ``UNITS`` that were given. [deg], [m]"""
        where = np.array([time])
        up = smooth_arcs(self._at, self._places, where)[0]
        latitude, longitude = _angles(up)
        local = _compass(place_axes(latitude, longitude))
        turn = _camera(smooth_arcs(self._at, self._cameras, where)[0])
        zenith, bearing, roll = camera_angles(turn @ self._level(up) @ local.T)
        view = {"latitude": latitude, "longitude": longitude, "look_zenith": zenith}
        view["look_bearing"] = bearing % 360.0
        if self._rolls or abs(roll) > 1e-9:
            view["roll"] = roll
        row = smooth(self._at, self._columns, where)[0]
        for (name, offset), value in zip(self._logarithms.items(), row, strict=False):
            view[name] = float(np.exp(value)) - offset
        if self._sees_sun:
            east, north, out = place_axes(row[-2], row[-1])[2] @ place_axes(latitude, longitude).T
            view["sun_zenith"] = float(np.degrees(np.arctan2(np.hypot(east, north), out)))
            view["sun_azimuth"] = float(np.degrees(np.arctan2(east, north))) % 360.0
        return view


def _compass(axes: FloatArray) -> FloatArray:
    """Axes north, west and up, in which azimuths are compass bearings."""
    east, north, up = axes
    return np.stack([north, -east, up])


def _angles(towards: FloatArray) -> tuple[float, float]:
    """Latitude and longitude of a direction. [deg]"""
    x, y, z = towards
    return float(np.degrees(np.arctan2(z, np.hypot(x, y)))), float(np.degrees(np.arctan2(y, x)))


def _below(suns: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Latitudes, and longitudes by the shorter way, of the points below suns. [deg]"""
    latitudes, longitudes = np.array([_angles(one) for one in suns]).T
    return latitudes, np.unwrap(longitudes, period=360.0)


def _quaternions(cameras: FloatArray) -> FloatArray:
    """Unit quaternions of cameras, each nearer to the one before than its opposite."""
    from scipy.spatial.transform import Rotation

    found = Rotation.from_matrix(_BACK @ cameras).as_quat()
    turns = np.sign((found[1:] * found[:-1]).sum(axis=-1))
    found[1:] *= np.cumprod(np.where(turns == 0.0, 1.0, turns))[:, None]
    return np.asarray(found)


def _camera(quaternion: FloatArray) -> FloatArray:
    """Camera of a quaternion, the inverse of ``_quaternions``."""
    from scipy.spatial.transform import Rotation

    return np.asarray(_BACK @ Rotation.from_quat(quaternion).as_matrix())
