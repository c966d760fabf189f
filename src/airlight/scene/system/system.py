"""``System``: bodies, lights, observer and camera of a scene file."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from airlight.errors import ParameterError
from airlight.planets.reading.reader import load_planet
from airlight.scene.apparent_sun import apparent_zenith
from airlight.scene.system.body import Body
from airlight.scene.system.light import Light
from airlight.scene.system.vectors import unit
from airlight.scene.system.viewpoint import SceneObserver, View

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

FloatArray = npt.NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class System:
    """Scene of several bodies and lights.

    Parameters
    ----------
    name, description : str
        Title and description.
    bodies : tuple of Body
        Bodies, whose spheres and atmospheres do not overlap.
    lights : tuple of Light
        Stars, and bodies that shine by reflected light; at least one star.
    observer : SceneObserver
        Place of the observer.
    view : View
        Camera.
    folder : Path, optional
        Folder that paths refer to.
    stars : bool
        Whether the star catalogue is rendered; the frame is then equatorial J2000.
    time : datetime, optional
        Time for which an ephemeris determined the positions of the bodies.
    changes : mapping
        Overrides of planet files, from path to value, by the name of the body.
    given : mapping
        Planets that are read already, by the name of the body.

    Raises
    ------
    ParameterError
        If a name is unknown or used twice, or bodies overlap.
    """

    name: str
    bodies: tuple[Body, ...]
    lights: tuple[Light, ...]
    observer: SceneObserver
    view: View
    description: str = ""
    folder: Path | None = None
    stars: bool = False
    time: datetime | None = None
    changes: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    given: Mapping[str, Planet] = field(default_factory=dict)

    def __post_init__(self) -> None:
        names = [body.name for body in self.bodies]
        stars = [light.name for light in self.lights if light.star is not None]
        for used in (names, stars, names + stars):
            for name in used:
                if used.count(name) > 1:
                    raise ParameterError("name", name, "unique names of bodies and stars")
        if not self.bodies:
            raise ParameterError("bodies", 0, "at least 1")
        if not stars:
            raise ParameterError("lights", 0, "at least 1 star")
        for i, light in enumerate(self.lights):
            if light.body is not None:
                self._known(f"lights[{i}].body", light.body)
        for i, body in enumerate(self.bodies):
            if body.faces is not None:
                self._known(f"bodies[{i}].faces", body.faces)
        if self.observer.body is not None:
            self._known("observer.body", self.observer.body)
        if self.view.look_at is not None and self.view.look_at not in stars:
            self._known("camera.look_at", self.view.look_at, tuple(stars))
        if self.view.look_zenith is not None and self.observer.body is None:
            raise ParameterError(
                "camera.look_zenith",
                self.view.look_zenith,
                "look_at or direction, for an observer above no body",
            )

    def _known(self, field: str, name: str, more: tuple[str, ...] = ()) -> None:
        known = (*(body.name for body in self.bodies), *more)
        if name not in known:
            raise ParameterError(field, name, ", ".join(known))

    def body(self, name: str) -> Body:
        """Body by name."""
        return next(body for body in self.bodies if body.name == name)

    def path_of(self, name: str) -> str:
        """Path of a file that the scene names: beside the scene file if it is there."""
        own = None if self.folder is None else self.folder / name
        return str(own) if own is not None and own.is_file() else name

    @cached_property
    def planets(self) -> dict[str, Planet]:
        """Planets of bodies with an atmosphere, by body name."""
        found = {}
        for body in self.bodies:
            if body.name in self.given:
                found[body.name] = self.given[body.name]
            elif body.planet is not None:
                own_file = body.planet.endswith(".toml")
                named = self.path_of(body.planet) if own_file else body.planet
                found[body.name] = load_planet(named, self.changes.get(body.name))
        return found

    def radius(self, body: Body) -> float:
        """Ground radius of a body. [m]"""
        if body.planet is None:
            assert body.radius is not None
            return body.radius
        return self.planets[body.name].bottom_radius

    def outer_radius(self, body: Body) -> float:
        """Radius of a body including its atmosphere. [m]"""
        if body.planet is None:
            return self.radius(body)
        return self.planets[body.name].top_radius

    def axes(self, body: Body) -> FloatArray:
        """Axes of a body-fixed frame as rows, shape (3, 3). [1]"""
        return body.axes(None if body.faces is None else self.body(body.faces).centre)

    @cached_property
    def eye(self) -> FloatArray:
        """Position of the observer, shape (3,). [m]

        Raises
        ------
        ParameterError
            If it lies inside a body.
        """
        observer = self.observer
        if observer.position is not None:
            at = np.asarray(observer.position, float)
        else:
            assert observer.body is not None
            body = self.body(observer.body)
            up = self._up_at(body, observer)
            at = body.centre + (self.radius(body) + observer.altitude) * up
        for body in self.bodies:
            height = float(np.linalg.norm(at - body.centre)) - self.radius(body)
            if height < -1e-6 * self.radius(body):
                raise ParameterError(
                    "observer", f"{height:.6g} m above {body.name}", "a position outside all bodies"
                )
        return at

    def _up_at(self, body: Body, observer: SceneObserver) -> FloatArray:
        lat, lon = np.radians(observer.latitude), np.radians(observer.longitude)
        local = np.array([np.cos(lat) * np.cos(lon), np.cos(lat) * np.sin(lon), np.sin(lat)])
        return np.asarray(local @ self.axes(body))

    def place_above(self, body: Body) -> tuple[float, float, float]:
        """Latitude and longitude [deg], and altitude [m], of the observer above a body."""
        offset = self.eye - body.centre
        distance = float(np.linalg.norm(offset))
        x, y, z = self.axes(body) @ (offset / distance)
        altitude = max(distance - self.radius(body), 0.0)
        if self.observer.body == body.name:
            altitude = self.observer.altitude
        latitude, longitude = math.asin(min(max(z, -1.0), 1.0)), math.atan2(y, x)
        return math.degrees(latitude), math.degrees(longitude), altitude

    def power(self, body: Body) -> float:
        """Power of the observer's point with respect to a body and its atmosphere. [m²]"""
        distance, outer = float(np.linalg.norm(body.centre - self.eye)), self.outer_radius(body)
        return (distance - outer) * (distance + outer)

    def check_distances(self) -> None:
        """Raise if bodies or their atmospheres overlap.

        Raises
        ------
        ParameterError
            Names the pair and its minimum distance.
        """
        for i, body in enumerate(self.bodies):
            for other in self.bodies[:i]:
                distance = float(np.linalg.norm(body.centre - other.centre))
                least = self.outer_radius(body) + self.outer_radius(other)
                if distance < least:
                    raise ParameterError(
                        f"bodies[{i}].position",
                        f"{distance:.6g} m from {other.name}",
                        f"at least {least:.6g} m",
                    )

    @cached_property
    def camera_axes(self) -> FloatArray:
        """Right, up and forward of the camera in the frame of the scene, shape (3, 3). [1]"""
        view, eye = self.view, self.eye
        zenith = np.array([0.0, 0.0, 1.0])
        north = aside = None
        if self.observer.body is not None:
            body = self.body(self.observer.body)
            zenith = unit(eye - body.centre, "observer")
            north = self.axes(body)[2]
        if view.direction is not None:
            forward = unit(view.direction, "camera.direction")
        elif view.look_at is not None:
            forward = self._seen(self._towards(view.look_at), zenith)
        else:
            assert north is not None
            assert view.look_zenith is not None
            assert view.look_bearing is not None
            level = north - (north @ zenith) * zenith
            if np.linalg.norm(level) < 1e-9:  # at a pole north is any direction: the meridian's
                level = np.cross(zenith, [0.0, 1.0, 0.0])
            level = unit(level, "pole")
            east = np.cross(level, zenith)
            tilt, turn = np.radians(view.look_zenith), np.radians(view.look_bearing)
            flat = np.cos(turn) * level + np.sin(turn) * east
            forward = np.cos(tilt) * zenith + np.sin(tilt) * flat
            aside = np.cross(flat, zenith)
        up = zenith if view.up is None else unit(view.up, "camera.up")
        right = np.cross(forward, up)
        if aside is not None and view.up is None:
            right = aside  # also for a view to the zenith or nadir
        if np.linalg.norm(right) < 1e-9:
            # Along the vertical any direction is up: north, or x.
            other = north if north is not None else np.array([1.0, 0.0, 0.0])
            right = np.cross(forward, other)
            if np.linalg.norm(right) < 1e-9:
                right = np.cross(forward, [1.0, 0.0, 0.0])
        right = unit(right, "camera.up")
        above = np.cross(right, forward)
        roll = np.radians(view.roll)
        return np.stack(
            [
                np.cos(roll) * right - np.sin(roll) * above,
                np.cos(roll) * above + np.sin(roll) * right,
                forward,
            ]
        )

    def _seen(self, towards: FloatArray, zenith: FloatArray) -> FloatArray:
        """Apparent direction of a point behind the atmosphere of the observer's planet. [1]"""
        name, target = self.observer.body, self.view.look_at
        if name is None or name == target or name not in self.planets:
            return towards
        true = math.degrees(math.atan2(np.linalg.norm(np.cross(zenith, towards)), zenith @ towards))
        seen = apparent_zenith(self.planets[name], self.observer.altitude, true)
        level = towards - (towards @ zenith) * zenith
        length = float(np.linalg.norm(level))
        if length < 1e-12:
            return towards
        turn = math.radians(seen)
        return np.asarray(math.cos(turn) * zenith + math.sin(turn) / length * level)

    def _towards(self, name: str) -> FloatArray:
        for light in self.lights:
            if light.star is not None and light.name == name:
                return light.towards(self.eye)
        return unit(self.body(name).centre - self.eye, "camera.look_at")
