"""``Film``: a planet or scene with key frames, and the specification of each frame."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from datetime import datetime
from functools import cached_property
from pathlib import Path
from typing import Any, Final

import numpy as np

from airlight.errors import ParameterError
from airlight.planets.planet import Planet
from airlight.planets.reading.overrides import FIELD
from airlight.planets.reading.reader import read_tables
from airlight.planets.schema.toml_model import fields_of
from airlight.planets.schema.toml_table import TomlTable
from airlight.render.clouds.cloud_time import CloudTime
from airlight.scene.system.reading import changed_system
from airlight.scene.system.system import System
from airlight.studies.film.frame_spec import FrameSpec, PlanetFrameSpec, Quality, SystemFrameSpec
from airlight.studies.film.light_frames import LightFrames, light_directions
from airlight.studies.film.plan import FilmPlan
from airlight.studies.film.view import PlanetView

Tables = Mapping[str, Any]

#: Ends of paths of the wind, which displaces clouds by its speed times the time of a film.
_WIND: Final = (".wind_speed", ".wind_direction")


@dataclass(frozen=True, kw_only=True)
class Film:
    """Film of a planet or of a scene of several bodies.

    Parameters
    ----------
    name : str
        Name of the film, the prefix of its frames' file names.
    plan : FilmPlan
        Frames, clock and key frames.
    tables : mapping
        Nested tables of the planet file, or of the scene file.
    file : str
        Name of that file, for error messages.
    folder : Path, optional
        Folder of relative paths.
    view : mapping, optional
        Table of a ``PlanetView``, for a film of one planet; None for a scene.
    changes : mapping
        Overrides of bodies of a scene by path, see ``changed_system``.
    display : mapping
        Display settings of its table ``[display]``, by name: fields of ``DisplaySettings``.
    """

    name: str
    plan: FilmPlan
    tables: Tables
    file: str
    folder: Path | None = None
    view: Tables | None = field(default=None)
    changes: Tables = field(default_factory=dict)
    display: Tables = field(default_factory=dict)

    def frame_spec(self, number: int, how: Quality) -> FrameSpec:
        """Specification of a frame.

        Parameters
        ----------
        number : int
            Number of the frame, from 0.
        how : Quality
            Size of the frame, accuracy of the solution and the rendering.

        Raises
        ------
        ParameterError
            If the path of a key does not exist, or a value is out of range.
        """
        changes = self.plan.changes(number)
        if self.view is not None:
            spec = self._planet_spec(number, how)
            if not spec.planet.clouds:
                return spec
            return self._cloudy_planet(number, spec)
        system = self._system_at(changes, self._time(number))
        system.check_distances()
        return self._cloudy_system(number, SystemFrameSpec(system=system, how=how))

    def _planet_spec(self, number: int, how: Quality) -> PlanetFrameSpec:
        """Specification of a frame of a planet, without the time of its clouds."""
        view, planet = self._planet_at(self.plan.changes(number))
        time = self._time(number)
        scene = view.scene(planet, time, how.width, how.height)
        planet, scene = scene.on_basin_floor(planet)
        return PlanetFrameSpec(planet=planet, scene=scene, how=how, stars=view.stars)

    def planet_view(self, number: int) -> PlanetView:
        """View of a frame of a film of one planet."""
        return self._planet_at(self.plan.changes(number))[0]

    @property
    def planet_name(self) -> str:
        """Name of the preset, or path of the file, of a film of one planet."""
        return self.file if self.folder is not None else self.file.removesuffix(".toml")

    @property
    def projection(self) -> str:
        """Projection of the first frame."""
        if self.view is not None:
            return self.planet_view(0).projection
        return self._system_at(self.plan.changes(0), self._time(0)).view.projection

    @property
    def planets(self) -> tuple[Planet, ...]:
        """Planets of the first frame."""
        if self.view is not None:
            return (self._planet_at(self.plan.changes(0))[1],)
        system = self._system_at(self.plan.changes(0), self._time(0))
        return tuple(system.planets.values())

    # --- a planet -----------------------------------------------------------------------------

    def _planet_at(self, changes: Tables) -> tuple[PlanetView, Planet]:
        seen = {p[5:]: value for p, value in changes.items() if p.startswith("view.")}
        for name in seen:
            if name not in fields_of(PlanetView):
                allowed = f"view.{', view.'.join(fields_of(PlanetView))}, or a path of the planet"
                raise ParameterError("film.keys", f"view.{name}", allowed)
        view = PlanetView.read(TomlTable({**(self.view or {}), **seen}, "view"))
        rest = {path: value for path, value in changes.items() if not path.startswith("view.")}
        return view, self._planet if not rest else self._read_planet(rest)

    @cached_property
    def _planet(self) -> Planet:
        return read_tables(self.tables, self.file, self.folder)

    def _read_planet(self, changes: Tables) -> Planet:
        try:
            return read_tables(self.tables, self.file, self.folder, changes)
        except ParameterError as error:
            raise _of_a_key(error) from None

    # --- a scene ------------------------------------------------------------------------------

    def _system_at(self, changes: Tables, time: datetime | None) -> System:
        changes = {**self.changes, **changes}
        if time is not None:
            changes["time"] = time.isoformat()
        try:
            return changed_system(self.tables, self.file, self.folder, changes)
        except ParameterError as error:
            raise _of_a_key(error) from None

    # --- clouds -------------------------------------------------------------------------------

    def _cloudy_planet(self, number: int, spec: PlanetFrameSpec) -> PlanetFrameSpec:
        """Frame with the time of its clouds."""
        first, frames = self._planet_spec(0, spec.how).scene, self._light_frames
        around = frames.around(number)
        return replace(
            spec,
            clouds=CloudTime(
                seconds=self._seconds(number),
                latitude=first.latitude,
                longitude=first.longitude,
                solved_at=()
                if around == ((1.0, number),)
                else tuple((w, self._planet_spec(node, spec.how).scene) for w, node in around),
            ),
        )

    def lit_frames(self, numbers: Iterable[int]) -> tuple[int, ...]:
        """Frames of a planet for which the light of clouds is solved, for these frames.

        Parameters
        ----------
        numbers : iterable of int
            Numbers of frames.
        """
        if self.view is None or not self._planet.clouds:
            return ()
        around = (self._light_frames.around(number) for number in numbers)
        return tuple(sorted({node for some in around for _, node in some}))

    def _cloudy_system(self, number: int, spec: SystemFrameSpec) -> SystemFrameSpec:
        """Frame with the time of the clouds of its planets."""
        system = self._system_at(self.plan.changes(0), self._time(0))
        clouds = {}
        for name, planet in spec.system.planets.items():
            if planet.clouds:
                latitude, longitude, _ = system.place_above(system.body(name))
                clouds[name] = CloudTime(
                    seconds=self._seconds(number), latitude=latitude, longitude=longitude
                )
        return replace(spec, clouds=clouds)

    def _seconds(self, number: int) -> float:
        """Time since the first frame, by the clock, or of playback without one. [s]"""
        for one in self.plan.keys:
            if one.path.endswith(_WIND):
                raise ParameterError("film.keys", one.path, "a wind that is the same at all times")
        if self.plan.start is None:
            return number / self.plan.rate
        start, end = self._ends
        return self.plan.normalised_time(number) * (end - start).total_seconds()

    @cached_property
    def _light_frames(self) -> LightFrames:
        """Frames of a planet for which the light of its clouds is solved."""
        specs = [self._planet_spec(number, Quality()) for number in range(self.plan.count)]
        return LightFrames.of(
            np.array([light_directions(one.scene) for one in specs]),
            [(one.planet, one.solved_for, one.scene.place[:2]) for one in specs],
        )

    # --- the clock ----------------------------------------------------------------------------

    def _time(self, number: int) -> datetime | None:
        if self.plan.start is None:
            return None
        start, end = self._ends
        return start + self.plan.normalised_time(number) * (end - start)

    @property
    def _ends(self) -> tuple[datetime, datetime]:
        """Times of the first and the last frame of a film with a clock."""
        if self.view is not None:
            return self._span
        return _instant(str(self.plan.start), "start"), _instant(str(self.plan.end), "end")

    @cached_property
    def _span(self) -> tuple[datetime, datetime]:
        """Times of the first and the last frame."""
        from airlight.geometry.ephemeris.sky import Place
        from airlight.geometry.ephemeris.time_text import read_time

        plan, found = self.plan, []
        for name, number in (("start", 0), ("end", plan.count - 1)):
            view, planet = self._planet_at(plan.changes(number))
            place = Place(
                body=planet.world.name,
                latitude=view.latitude,
                longitude=view.longitude,
                altitude=view.altitude,
            )
            text = getattr(plan, name)
            found.append(read_time(text, place, zone=plan.zone, field=f"film.{name}"))
        return found[0], found[1]


def _instant(text: str, name: str) -> datetime:
    allowed = "a time with a zone, such as '2017-08-21T18:25Z'"
    try:
        moment = datetime.fromisoformat(text)
    except ValueError:
        raise ParameterError(f"film.{name}", text, allowed) from None
    if moment.tzinfo is None:
        raise ParameterError(f"film.{name}", text, allowed)
    return moment


def _of_a_key(error: ParameterError) -> ParameterError:
    """Name the field of an error by its key in the film file."""
    if error.field != FIELD:
        return error
    return error.named("film.keys")
