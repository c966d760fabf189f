"""Session: editing, undo, comparison and saving of a planet, a view and a display.

A session belongs to its host's thread and never blocks; ``SolverThread`` reads and solves edited
planets.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from airlight.errors import ParameterError
from airlight.files.atomic_file import atomic_file
from airlight.planets.planet import Planet
from airlight.planets.reading.planet_file import planet_file
from airlight.planets.reading.reader import read_tables
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.sun_clock import CLOCK
from airlight.viewer.session import saved_state
from airlight.viewer.session.comparing import ParameterDifference, differing
from airlight.viewer.session.editing import Editing
from airlight.viewer.session.freeze_coefficients import freeze_coefficients, is_advanced
from airlight.viewer.session.history import Change
from airlight.viewer.session.planet_state import SolveRequest, Versions
from airlight.viewer.session.side import Side

__all__ = ["Session", "Versions", "SolveRequest"]


class Session(Editing):
    """Editable state behind window, notebook and page.

    Parameters
    ----------
    planet : str or Path
        Name of a preset, or path of a planet file.
    clock : callable
        Monotonic clock, see ``Editing``. [s]

    Attributes
    ----------
    size : (int, int)
        Size of the picture, set by ``resize``. [pixel]
    shares_camera : bool
        Whether both sides of a comparison share the camera and the sun.
    shares_exposure : bool
        Whether they share the exposure of the brighter one; otherwise each has its own.
    adaptation : Adaptation
        Automatic exposure.

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

    # --- composition --------------------------------------------------------------------------

    @property
    def advanced(self) -> tuple[str, ...]:
        """Groups of the constituents that have a composition rather than coefficients."""
        constituents = self.planet.tables["constituents"]
        return tuple(
            group
            for group, one in zip(self.planet.groups, constituents, strict=True)
            if is_advanced(one)
        )

    def freeze_coefficients(self, group: str, planet: Planet | None = None) -> None:
        """Convert a constituent to fixed coefficients, as an undo step.

        Parameters
        ----------
        planet : Planet, optional
            Current planet without disabled constituents; by default it is read, which takes
            seconds for particles that are not cached.

        Raises
        ------
        ParameterError
            If there is no such constituent, if it already has coefficients, or if the planet is
            invalid; nothing is changed then.
        """
        state = self.planet
        if group not in state.groups:
            raise ParameterError("constituent", group, ", ".join(state.groups))
        if planet is None:
            planet = read_tables(state.tables, state.source)
        index = state.groups.index(group)
        self.replace_tables(
            f"constituents[{index}]", freeze_coefficients(state.tables, planet, index)
        )

    # --- two sides ----------------------------------------------------------------------------

    @property
    def showing(self) -> str:
        """Current side, ``A`` or ``B``."""
        return self._showing

    @property
    def has_other(self) -> bool:
        """Whether there are two sides."""
        return self._other is not None

    @property
    def view_other(self) -> Mapping[str, Value] | None:
        """View of the other side, with the camera and the sun of this one if they are shared.

        Another body has another sun at the same date, so that a shared one is not by the date.
        """
        if self._other is None:
            return None
        if not self.shares_camera:
            return self._other.view
        shared = {path: one for path, one in self._side.view.items() if path.startswith("view.")}
        bodies = {one.planet.tables.get("body") for one in (self._side, self._other)}
        if len(bodies) > 1:
            shared[CLOCK] = False
        return {**self._other.view, **shared}

    @property
    def planet_name_other(self) -> str:
        """Name of the other side's planet; empty without one."""
        return "" if self._other is None else str(self._other.planet.tables.get("name", ""))

    def store_b(self) -> None:
        """Copy the current side to the other; later edits apply to the current side only."""
        self._other = Side(self._side.planet, self._side.view, self._clock)
        self._other.first, self._other.around = self._side.first, self.around

    def swap(self) -> None:
        """Show the other side; without one, the current side is copied first."""
        if self._other is None:
            self.store_b()
        assert self._other is not None
        self.end_drag()
        self._other.view = dict(self.view_other or {})
        self._side, self._other = self._other, self._side
        self._showing = "B" if self._showing == "A" else "A"
        self._bump_versions({"planet", "view", "display"})

    def open_as_b(self, planet: str) -> None:
        """Open a planet as side B; the shown side stays."""
        was, shares = self.showing, self.shares_camera
        if self._other is None:
            self.store_b()
        self.shares_camera = False  # A keeps its sun, B may have that of its date
        if was == "A":
            self.swap()
        try:
            self.open(planet)
        finally:
            if was == "A":
                self.swap()
            self.shares_camera = shares

    def forget_other(self) -> None:
        """Discard the other side; the shown one becomes A."""
        self._other = None
        self._showing = "A"

    def differences(self) -> tuple[ParameterDifference, ...]:
        """Parameters that differ between A and B; empty without another side."""
        if self._other is None:
            return ()
        first, second = self._side, self._other
        if self._showing != "A":
            first, second = second, first
        return tuple(differing(first, second, self.shares_camera))

    # --- saving -------------------------------------------------------------------------------

    def save_planet(self, path: str | Path) -> None:
        """Write the planet to a planet file, completely or not at all."""
        state = self.planet
        comments = [f"Made with airlight from {Path(state.source).name}."]
        changes = state.changes
        if changes:
            comments.append(f"Changed: {', '.join(change[0] for change in changes[:40])}.")
        with atomic_file(path) as place:
            place.write_text(planet_file(state.tables, tuple(comments)), encoding="utf-8")

    def to_state(self) -> dict[str, Any]:
        """State of the current side as JSON values: the planet's name, and the changes."""
        return saved_state.state_of(self.planet, self._side.view)

    def from_state(self, state: Mapping[str, Any]) -> None:
        """Show a state made by ``to_state``, as one undo step."""
        planet, view = saved_state.read_state(state, self.planet)
        self._changed(self._side.change("state", Change(planet=planet, view=view)))


class SessionSide:
    """Solve requests of a session for one side, independent of the side shown.

    Parameters
    ----------
    session : Session
        Session that holds the sides.
    side : str
        Side, ``A`` or ``B``.
    """

    def __init__(self, session: Session, side: str) -> None:
        self._session = session
        self._side = side

    @property
    def solve_request(self) -> SolveRequest:
        """Request to solve; that of the current side while there is only one."""
        if self._session.showing == self._side:
            return self._session.solve_request
        return self._session.solve_request_other or self._session.solve_request

    def subscribe(self, observer: Callable[[Versions], None]) -> Callable[[], None]:
        """See ``Session.subscribe``."""
        return self._session.subscribe(observer)
