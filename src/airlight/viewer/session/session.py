"""The session: a planet, a view and a display that are edited, undone, compared and saved.

It belongs to one thread, that of its host, and never waits: what an edit makes of the planet is
found out by ``solving``, on a thread of its own.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from airlight.errors import ParameterError
from airlight.exports.whole_file import whole_file
from airlight.planets.planet import Planet
from airlight.planets.reading.reader import read_tables
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.view_parameters import view_parameters
from airlight.viewer.session import saved_state
from airlight.viewer.session.comparing import Difference, differing
from airlight.viewer.session.editing import Editing
from airlight.viewer.session.freeze_coefficients import as_standard, is_advanced
from airlight.viewer.session.history import Change
from airlight.viewer.session.planet_file import planet_file
from airlight.viewer.session.side import Side
from airlight.viewer.session.solve_request import Versions, Wanted

__all__ = ["Session", "Versions", "Wanted"]


class Session(Editing):
    """What window, notebook and page edit.

    Parameters
    ----------
    planet : str or Path
        The name of a preset, or a planet file.
    clock : callable
        Seconds that only grow, for joining quick edits into one step.

    Attributes
    ----------
    size : (int, int)
        Of the picture; set by ``resize``. [pixel]
    shares_camera : bool
        Whether both sides of a comparison are seen by the same camera, under the same sun.

    Examples
    --------
    >>> session = Session("mars")
    >>> session.set("dust.particles.optical_depth", 2.0)
    >>> session.values["constituents[1].particles.optical_depth"], session.versions.planet
    (2.0, 2)
    >>> session.undo()
    'constituents[1].particles.optical_depth'
    >>> session.value("dust.particles.optical_depth")
    0.5
    """

    # --- another form -------------------------------------------------------------------------

    @property
    def advanced(self) -> tuple[str, ...]:
        """Groups of the constituents that are given by what they are made of."""
        constituents = self.planet.tables["constituents"]
        return tuple(
            group
            for group, one in zip(self.planet.groups, constituents, strict=True)
            if is_advanced(one)
        )

    def as_standard(self, group: str, planet: Planet | None = None) -> None:
        """Freeze a constituent to coefficients; see ``as_standard``. A step to undo.

        Parameters
        ----------
        group : str
            The constituent's.
        planet : Planet, optional
            What the reader made of the planet that is shown, none of it switched off, if that is
            at hand; without it the planet is read here, and particles that were never met take
            seconds.

        Raises
        ------
        ParameterError
            If there is no such constituent, if it has coefficients already, or if the planet
            cannot be; nothing is changed then.
        """
        state = self.planet
        if group not in state.groups:
            raise ParameterError("constituent", group, ", ".join(state.groups))
        if planet is None:
            planet = read_tables(state.tables, state.source)
        index = state.groups.index(group)
        self.replace_tables(f"constituents[{index}]", as_standard(state.tables, planet, index))

    # --- two sides ----------------------------------------------------------------------------

    @property
    def showing(self) -> str:
        """``A`` or ``B``."""
        return self._showing

    @property
    def has_other(self) -> bool:
        """Whether there are two sides."""
        return self._other is not None

    @property
    def view_other(self) -> Mapping[str, Value] | None:
        """The other side's view, with the camera and the sun of this one if they share them."""
        if self._other is None:
            return None
        shared = self._side.view if self.shares_camera else {}
        camera = {path: value for path, value in shared.items() if path.startswith("view.")}
        return {**self._other.view, **camera}

    @property
    def planet_name_other(self) -> str:
        """The name of the other side's planet; empty without one."""
        return "" if self._other is None else str(self._other.planet.tables.get("name", ""))

    def store_b(self) -> None:
        """Keep what is shown as the other side; edits from now on are of this one alone."""
        self._other = Side(self._side.planet, self._side.view, self._clock)

    def swap(self) -> None:
        """Show the other side; the first time it is a copy of this one."""
        if self._other is None:
            self.store_b()
        assert self._other is not None
        self.end_drag()
        view = dict(self._other.view)
        if self.shares_camera:
            view |= {p: v for p, v in self._side.view.items() if p.startswith("view.")}
            self._other.view = view
        self._side, self._other = self._other, self._side
        self._showing = "B" if self._showing == "A" else "A"
        self._grown({"planet", "view", "display"})

    def forget_other(self) -> None:
        """One side again: the one that is shown, as A."""
        self._other = None
        self._showing = "A"

    def differences(self) -> tuple[Difference, ...]:
        """What differs from A to B, in the words of the list; empty without another side."""
        if self._other is None:
            return ()
        first, second = (self._side, self._other) if self._showing == "A" else (
            self._other, self._side)  # fmt: skip
        return tuple(_side_differences(first, second, self.shares_camera))

    # --- saving -------------------------------------------------------------------------------

    def save_planet(self, path: str | Path) -> None:
        """Write the planet as a planet file, whole or not at all.

        Raises
        ------
        FileError
            If it cannot be written.
        """
        state = self.planet
        comments = [f"Made with airlight from {Path(state.source).name}."]
        changes = state.changes
        if changes:
            comments.append(f"Changed: {', '.join(change[0] for change in changes[:40])}.")
        with whole_file(path) as place:
            place.write_text(planet_file(state.tables, tuple(comments)), encoding="utf-8")

    def to_state(self) -> dict[str, Any]:
        """What is shown as JSON takes it: the planet's name, and what differs from it."""
        return saved_state.state_of(self.planet, self._side.view)

    def from_state(self, state: Mapping[str, Any]) -> None:
        """Show what ``to_state`` had kept: one step to undo.

        Raises
        ------
        ParameterError, FileError
            If it cannot be; nothing is changed then.
        """
        planet, view = saved_state.read_state(state, self.planet)
        self._changed(self._side.change("state", Change(planet=planet, view=view)))


def _side_differences(first: Side, second: Side, shares: bool) -> Iterator[Difference]:
    yield from differing(first.planet, second.planet)
    for one in view_parameters():
        if shares and one.path.startswith("view."):
            continue
        a, b = first.view[one.path], second.view[one.path]
        if a != b:
            yield Difference(path=one.path, label=one.label, unit=one.unit, first=a, second=b)
