"""What a page shows: a planet, or a scene of several bodies."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, TypeAlias

from airlight.errors import ParameterError
from airlight.geometry.ephemeris.sun_formula import NUMBERED
from airlight.kernel.threads import Progress
from airlight.planets import load_planet
from airlight.planets.picture_wavelengths import texel_wavelengths
from airlight.planets.planet import Planet
from airlight.render import render
from airlight.render.render_system import render_solved_system
from airlight.render.scene_lights import SceneLights
from airlight.render.solve_planet import solve_planet, solve_planets
from airlight.scene.frame import Frame
from airlight.scene.system import is_scene_file
from airlight.scene.system.system import System
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.browser.page_data import (
    page_data,
    page_parameters,
    picture_data,
    program_data,
)
from airlight.viewer.browser.scene_package import HOURS, SPAN, scene_package
from airlight.viewer.browser.star_sky import planet_sky
from airlight.viewer.browser.web_shaders import LAYERED, STARRY
from airlight.viewer.navigation.viewpoints import view_in
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.sun_clock import SUN
from airlight.viewer.parameters.view_parameters import DEFAULTS, VIEW_VALUES, scene_of
from airlight.viewer.session.scene_around import AIM, SceneAround
from airlight.viewer.session.session import Session

#: Size of the picture, of which a browser shows the part that its window has: a square holds what a
#: window of any shape, wider than high, sees. [pixel]
SIDE: Final = 840

#: Solutions by the names of planets.
Solutions: TypeAlias = Mapping[str, MomentsSolution]


def page_subject(
    name: str | Path, changes: Mapping[str, Any], progress: Progress | None = None
) -> PlanetPage | ScenePage:
    """Planet or scene of a page.

    Parameters
    ----------
    name : str or Path
        Name of a preset, or path of a planet or scene file.
    changes : mapping
        Overrides of the file by path.
    """
    if is_scene_file(name):
        return ScenePage(str(name), SceneAround.opened(str(name), changes))
    return PlanetPage(name, load_planet(name, dict(changes), progress=progress))


def _checked(view: Mapping[str, Value], parameters: tuple[Parameter, ...]) -> None:
    """Raise if a page has no control of a value."""
    known = [one.path for one in parameters]
    for path in view:
        if path not in known:
            raise ParameterError("view", path, ", ".join(known))


@dataclass(frozen=True)
class PlanetPage:
    """Page of a planet.

    Attributes
    ----------
    name : str or Path
        Name of the preset, or path of the file.
    planet : Planet
        Planet with its changes.
    """

    name: str | Path
    planet: Planet

    @property
    def title(self) -> str:
        """Its name."""
        return self.planet.name

    def values(self, view: Mapping[str, Value]) -> dict[str, Value]:
        """Initial values of all parameters by path, of which some are given."""
        session = Session(self.name)
        if not any(path.startswith("view.") for path in view):
            session.move(view_in(session))
        _checked(view, page_parameters(dated=self.planet.body in NUMBERED))
        for path, value in view.items():
            session.set(path, value)
        return dict(session.values)

    def solved(self, count: str, quality: str, **options: Any) -> Solutions:
        """Solutions at ``three`` or ``four`` wavelengths; options of ``solve_planet``."""
        nm = texel_wavelengths(self.planet, count)
        return {self.planet.name: solve_planet(self.planet, nm, quality, **options)}

    def data(
        self,
        solutions: Solutions,
        title: str,
        values: Mapping[str, Value],
        count: str,
        **report: Any,
    ) -> dict[str, Any]:
        """Data of a page; arguments of ``page_data``."""
        solution = solutions[self.planet.name]
        sky = planet_sky(solution.lights[0], self.planet.body)
        layers = () if sky is None else STARRY
        data = page_data(solution, str(self.name), title, values, count, layers)
        data["picture"]["star_sky"] = sky
        return data

    def frame(self, solutions: Solutions, values: Mapping[str, Value], **report: Any) -> Frame:
        """Square frame of the initial view."""
        scene, orders = scene_of(values, SIDE, SIDE), str(values["light.orders"])
        return render(solutions[self.planet.name], scene, orders=orders, **report)


@dataclass(frozen=True)
class ScenePage:
    """Page of a scene of several bodies.

    Attributes
    ----------
    name : str
        Name of the preset, or path of the file.
    around : SceneAround
        Scene with its changes.
    """

    name: str
    around: SceneAround

    @property
    def title(self) -> str:
        """See ``PlanetPage``."""
        return self.around.system.name

    def parameters(self, ends: tuple[float, float] = (-SPAN, SPAN)) -> tuple[Parameter, ...]:
        """Parameters of the page: the time moves sun and moons, between its ends. [h]"""
        known = (one for one in page_parameters(dated=False) if one.group != "moon")
        shown = (replace(one, mode="derived") if one.path in SUN else one for one in known)
        low, high = ends
        time = replace(HOURS, low=low, high=high, least=low, most=high)
        return (*shown, *((time,) if self.around.dated else ()))

    def values(self, view: Mapping[str, Value]) -> dict[str, Value]:
        """See ``PlanetPage``."""
        _checked(view, tuple(one for one in self.parameters() if one.mode != "derived"))
        declared = {one.path: one for one in (*VIEW_VALUES, HOURS)}
        given = {path: declared[path].checked(value) for path, value in view.items()}
        values = {HOURS.path: 0.0, **DEFAULTS, **self.around.view(), **given}
        system, turned = self.at(values), any(path in given for path in AIM)
        if HOURS.path in given and self.around.system.view.look_at and not turned:
            values |= self.around.aim(system, values)
        return values | self.around.sun(system)

    def at(self, values: Mapping[str, Value]) -> System:
        """Scene of values of the page."""
        around, hours = self.around, float(values[HOURS.path])
        return around.placed(around.after(hours) if hours else around.system, values)

    def solved(self, count: str, quality: str, **options: Any) -> Solutions:
        """See ``PlanetPage``."""
        system = self.around.system
        nm = texel_wavelengths(system.planets[self.around.body], count)
        return solve_planets(system, nm.tolist(), quality, **options)

    def data(
        self,
        solutions: Solutions,
        title: str,
        values: Mapping[str, Value],
        count: str,
        **report: Any,
    ) -> dict[str, Any]:
        """See ``PlanetPage``."""
        own = self.around.body
        data = page_data(solutions[own], self.name, title, values, count)
        scene = scene_package(self.around, solutions, **report)
        for one in scene["bodies"]:
            away = one["name"] in solutions and one["name"] != own
            one["planet"] = picture_data(solutions[one["name"]]) if away else None
        times = [one["hours"] for one in scene["moments"]]
        parameters = self.parameters((times[0], times[-1]))
        values = {one.path: one.checked(values[one.path]) for one in parameters}
        declared = [one.path for one in parameters if one.mode != "derived"]
        first = {
            "name": "scene",
            "sentence": self.around.system.description or title,
            "view": {path: values[path] for path in declared if not path.startswith("display.")},
        }
        picture = data["picture"]
        views = [one for one in picture["viewpoints"] if one["name"] == "planet"]
        picture |= program_data(solutions.values(), LAYERED)
        picture |= {
            "scene": scene,
            "viewpoints": [first, *views],
            "star_white": scene["white"],
        }
        picture["uniforms"] |= scene["moments"][0]["bodies"][scene["home"]]["lights"][0]["numbers"]
        known = {one.path for one in VIEW_VALUES}
        edited = [one for one in data["parameters"] if one["path"] not in known]
        data["parameters"] = [*edited, *(one.as_json() for one in parameters)]
        data["values"] = {
            **{one["path"]: data["values"][one["path"]] for one in edited},
            **values,
        }
        return data

    def frame(self, solutions: Solutions, values: Mapping[str, Value], **report: Any) -> Frame:
        """See ``PlanetPage``."""
        nm = solutions[self.around.body].wavelengths
        lights = SceneLights(self.at(values), nm, solutions)
        return render_solved_system(lights, (SIDE, SIDE, None), **report)
