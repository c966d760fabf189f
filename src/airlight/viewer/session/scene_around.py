"""Scene of several bodies around the planet of a session."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime, timedelta
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.ephemeris.sun_formula import NUMBERED
from airlight.planets.parameters import replace as replaced
from airlight.planets.planet import Planet
from airlight.planets.reading.reader import nested_tables
from airlight.render.gpu_system_renderer import check_drawn_by_gpu
from airlight.render.planet_renderer import scene_of_light, zenith_above
from airlight.render.scene_lights import SceneLights
from airlight.scene import Scene
from airlight.scene.directions import level_axes
from airlight.scene.system import System
from airlight.scene.system.light import Light
from airlight.scene.system.reading import changed_system, system_text
from airlight.scene.system.viewpoint import SceneObserver, View
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.sun_clock import CLOCK, DATE

FloatArray = NDArray[np.float64]

#: Paths of the aim, and its largest error while a camera looks at a body. [deg]
AIM: Final = ("view.look_zenith", "view.heading", "view.roll")
_AIMED: Final = 0.05


@dataclass(frozen=True, kw_only=True)
class SceneAround:
    """Scene file, of which a session edits one planet and moves the observer.

    Attributes
    ----------
    tables, file, folder, changes :
        Arguments of ``changed_system``.
    system : System
        Scene as the file has it.
    body : str
        Name of the planet with air that is edited, and above which the observer flies.
    """

    tables: Mapping[str, Any]
    file: str
    folder: Path | None
    changes: Mapping[str, Any]
    system: System
    body: str
    _moved: dict[datetime, System] = field(default_factory=dict, compare=False)

    @classmethod
    def opened(cls, name_or_path: str, changes: Mapping[str, Any]) -> SceneAround:
        """Open a scene by preset name or path.

        The planet is that of the observer or, above a body without air or free, the nearest one.

        Raises
        ------
        ConflictError
            If the GPU does not draw the scene.
        """
        text, file, folder = system_text(name_or_path)
        tables = nested_tables(text, file)
        system = changed_system(tables, file, folder, changes)
        system.check_distances()
        check_drawn_by_gpu(system)
        planets = [body for body in system.bodies if body.planet is not None]
        nearest = min(planets, key=system.power).name
        own = system.observer.body if system.observer.body in system.planets else nearest
        return cls(
            tables=tables,
            file=file,
            folder=folder,
            changes=changes,
            system=system,
            body=str(own),
        )

    @property
    def planet(self) -> str:
        """Preset or planet file of the edited planet."""
        name = str(self.system.body(self.body).planet)
        return self.system.path_of(name) if name.endswith(".toml") else name

    @property
    def dated(self) -> bool:
        """Whether a date places the bodies and the sun."""
        return (
            self.system.time is not None
            and self.system.planets[self.body].body in NUMBERED
            and self._ephemeris("bodies")
            and self._ephemeris("lights")
        )

    def _ephemeris(self, name: str) -> bool:
        return any("ephemeris" in one for one in self.tables.get(name, []))

    def view(self) -> dict[str, Value]:
        """View of the scene file, by paths of a session."""
        system, scene = self.system, self._scene(self.system)
        found: dict[str, Value] = {
            "view.projection": scene.camera.projection,
            "view.dehaze": system.view.dehaze,
            "view.field_of_view": float(scene.camera.field_of_view or 60.0),
            "view.latitude": scene.latitude,
            "view.longitude": scene.longitude,
            "view.altitude": max(scene.altitude, 1.0),
            **_aim(scene),
            **self.sun(system),
        }
        if system.view.polariser is not None:
            found |= {"view.filter": True, "view.polariser": system.view.polariser % 180.0}
        if self.dated:
            assert system.time is not None
            time = system.time.astimezone(UTC)
            midnight = time.replace(hour=0, minute=0, second=0, microsecond=0)
            hour = (time - midnight) / timedelta(hours=1)
            date = float(time.year), float(time.timetuple().tm_yday), hour
            found |= {CLOCK: True, **dict(zip(DATE, date, strict=True))}
        return found

    def _scene(self, system: System) -> Scene:
        """Scene above the edited planet, with the camera of a scene of several bodies."""
        body = system.body(self.body)
        towards = _star(system).towards(system.eye)
        local = level_axes(zenith_above(system, body), towards)
        lights = SceneLights(system, np.array([550.0]), {})
        return scene_of_light(lights, system.view.camera(1280, 720, None), body, towards, local)

    def aimed(self, view: Mapping[str, Value], changes: Mapping[str, Value]) -> dict[str, Value]:
        """Changes of a view; at another date a camera still looks at the body of the scene file.

        Parameters
        ----------
        view, changes : mapping
            Values before, and changes, by path. A camera that has been turned stays.
        """
        dated = self.dated and any(path in changes for path in DATE)
        if not dated or self.system.view.look_at is None or any(path in changes for path in AIM):
            return dict(changes)
        before = self._at_body(view)
        turned = (float(view[path]) - before[path] for path in AIM)
        if any(abs((turn + 180.0) % 360.0 - 180.0) > _AIMED for turn in turned):
            return dict(changes)
        return {**changes, **self._at_body({**view, **changes})}

    def _place(self, view: Mapping[str, Value]) -> SceneObserver:
        latitude, longitude, altitude = (
            float(view[f"view.{name}"]) for name in ("latitude", "longitude", "altitude")
        )
        return SceneObserver(
            body=self.body, latitude=latitude, longitude=longitude, altitude=altitude
        )

    def _at_body(self, view: Mapping[str, Value]) -> dict[str, float]:
        """Aim of the scene file's camera at the date and place of a view."""
        return self.aim(self._at(view), view)

    def aim(self, system: System, view: Mapping[str, Value]) -> dict[str, float]:
        """Aim of the scene file's camera at the place of a view, by paths of a session. [deg]

        Parameters
        ----------
        system : System
            Scene at some time.
        """
        return _aim(self._scene(replace(system, observer=self._place(view), view=self.system.view)))

    def seen(self, view: Mapping[str, Value], planet: Planet | None) -> System:
        """Scene of a view of the session.

        Parameters
        ----------
        view : mapping
            View values by path.
        planet : Planet, optional
            Planet as edited.
        """
        by_date = self.dated and bool(view[CLOCK])
        system = self.placed(self._at(view) if by_date else self.system, view, planet)
        return system if by_date else self._under_sun(system, view)

    def placed(
        self, system: System, view: Mapping[str, Value], planet: Planet | None = None
    ) -> System:
        """Scene with observer and camera of a view; arguments of ``seen``."""
        tilt, heading, roll, field_of_view, polariser, dehaze = (
            float(view[f"view.{name}"])
            for name in (
                "look_zenith",
                "heading",
                "roll",
                "field_of_view",
                "polariser",
                "dehaze",
            )
        )
        return replace(
            system,
            observer=self._place(view),
            view=View(
                look_zenith=tilt,
                look_bearing=heading,
                roll=roll,
                field_of_view=field_of_view,
                projection=str(view["view.projection"]),
                polariser=polariser if view["view.filter"] else None,
                dehaze=dehaze,
            ),
            given=self.system.planets | ({} if planet is None else {self.body: planet}),
        )

    def sun(self, system: System) -> dict[str, float]:
        """Place of the first star above the edited planet, by paths of a session. [deg]"""
        scene = self._scene(system)
        return {
            "view.sun_zenith": scene.sun_zenith,
            "view.sun_azimuth": scene.sun_azimuth % 360.0,
        }

    def after(self, hours: float) -> System:
        """Scene of the file some hours later. [h]"""
        assert self.system.time is not None
        time = (self.system.time + timedelta(hours=hours)).isoformat()
        return changed_system(self.tables, self.file, self.folder, {**self.changes, "time": time})

    def _at(self, view: Mapping[str, Value]) -> System:
        """Scene at the date of a view, to the second."""
        year, day, hour = (float(view[path]) for path in DATE)
        time = datetime(int(year), 1, 1, tzinfo=UTC) + timedelta(days=int(day) - 1)
        time += timedelta(seconds=round(3600.0 * hour))
        if time == self.system.time:
            return self.system
        if time not in self._moved:
            self._moved.clear()
            changes = {**self.changes, "time": time.isoformat()}
            self._moved[time] = changed_system(self.tables, self.file, self.folder, changes)
        return self._moved[time]

    def _under_sun(self, system: System, view: Mapping[str, Value]) -> System:
        """Scene with its first star where a view has the sun."""
        zenith, bearing = (
            math.radians(float(view[f"view.sun_{name}"])) for name in ("zenith", "azimuth")
        )
        body = system.body(self.body)
        up = zenith_above(system, body)
        north = system.axes(body)[2]
        level = north - (north @ up) * up
        size = float(np.linalg.norm(level))
        if size < 1e-9:  # as System.camera_axes at a pole
            level = np.cross(up, [0.0, 1.0, 0.0])
            size = float(np.linalg.norm(level))
        level = level / size
        flat = math.cos(bearing) * level + math.sin(bearing) * np.cross(level, up)
        towards = math.cos(zenith) * up + math.sin(zenith) * flat
        star = _star(self.system)
        if star.position is None:
            moved = replaced(star, direction=tuple(towards.tolist()))
        else:
            distance = float(np.linalg.norm(np.asarray(star.position) - system.eye))
            moved = replaced(star, position=tuple((system.eye + distance * towards).tolist()))
        lights = tuple(moved if one is star else one for one in system.lights)
        return replace(system, lights=lights)


def _star(system: System) -> Light:
    """First star of a scene."""
    return next(light for light in system.lights if light.star is not None)


def _aim(scene: Scene) -> dict[str, float]:
    """Aim of a scene's camera, by paths of a session. [deg]"""
    camera = scene.camera
    heading = (camera.look_azimuth + scene.sun_azimuth) % 360.0
    return dict(zip(AIM, (float(camera.look_zenith or 0.0), heading, camera.roll), strict=True))
