"""``Film``: a planet or scene with key frames, and the specification of each frame."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import datetime
from functools import cached_property
from pathlib import Path
from typing import Any

from airlight.errors import ParameterError
from airlight.planets.planet import Planet
from airlight.planets.reading.overrides import FIELD
from airlight.planets.reading.reader import read_tables
from airlight.planets.schema.toml_model import fields_of
from airlight.planets.schema.toml_table import TomlTable
from airlight.scene.system.reading import changed_system
from airlight.scene.system.system import System
from airlight.studies.film.frame_spec import FrameSpec, PlanetFrameSpec, Quality, SystemFrameSpec
from airlight.studies.film.plan import FilmPlan
from airlight.studies.film.view import PlanetView

Tables = Mapping[str, Any]


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
    display : mapping
        Display settings of its table ``[display]``, by name: fields of ``DisplaySettings``.
    """

    name: str
    plan: FilmPlan
    tables: Tables
    file: str
    folder: Path | None = None
    view: Tables | None = field(default=None)
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
            view, planet = self._planet_at(changes)
            time = self._time(number, view, planet)
            scene = view.scene(planet, time, how.width, how.height)
            planet, scene = scene.on_basin_floor(planet)
            return PlanetFrameSpec(planet=planet, scene=scene, how=how, stars=view.stars)
        system = self._system_at(changes, self._time(number))
        system.check_distances()
        return SystemFrameSpec(system=system, how=how)

    @property
    def projection(self) -> str:
        """Projection of the first frame."""
        if self.view is not None:
            return self._planet_at(self.plan.changes(0))[0].projection
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
        if time is not None:
            changes = {**changes, "time": time.isoformat()}
        try:
            return changed_system(self.tables, self.file, self.folder, changes)
        except ParameterError as error:
            raise _of_a_key(error) from None

    # --- the clock ----------------------------------------------------------------------------

    def _time(
        self, number: int, view: PlanetView | None = None, planet: Planet | None = None
    ) -> datetime | None:
        plan = self.plan
        if plan.start is None or plan.end is None:
            return None
        if view is not None and planet is not None:
            start, end = self._span
        else:
            start, end = _instant(plan.start, "start"), _instant(plan.end, "end")
        return start + plan.normalised_time(number) * (end - start)

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
