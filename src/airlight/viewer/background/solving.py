"""A thread that follows a session: each planet that is wanted is read and solved, preview first.

The newest edit wins. The host is never kept waiting: it takes ``latest`` and ``status`` whenever it
likes, and is called when they change. While nothing is wanted the thread sleeps.
"""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final, Protocol

from airlight.color.spectral import rgb_weights
from airlight.errors import Cancelled
from airlight.kernel.threads import Cancel, Progress
from airlight.paint.solve_planet import PlanetSolver, live_solver
from airlight.planets.picture_wavelengths import FloatArray, picture_wavelengths
from airlight.planets.planet import Planet
from airlight.planets.reading.reader import read_tables
from airlight.viewer.background.error_line import one_line
from airlight.viewer.session.constituent_switches import switched
from airlight.viewer.session.solve_request import Versions, Wanted

#: A preview that takes longer than this is given up for a newer edit. Quicker ones are finished, so
#: that the picture follows a drag whose edits come faster than previews do. [s]
PATIENCE: Final = 3.0
#: Solutions that are kept, so that an undo or a look at the other side costs nothing.
MOST_KEPT: Final = 4
#: Progress is reported no more often than this. [s]
_REPORT_EVERY: Final = 0.1


class Followed(Protocol):
    """A session, or one side of it."""

    @property
    def wanted(self) -> Wanted:
        """What has to be solved."""

    def follow(self, follower: Callable[[Versions], None]) -> Callable[[], None]:
        """Call something after every change, on the host's thread; returns how to stop."""


@dataclass(frozen=True, kw_only=True)
class Solved:
    """A solution and what it belongs to.

    Attributes
    ----------
    solution : Solution
        Of the solver.
    planet : Planet
        As it was solved: constituents that are switched off neither scatter nor absorb.
    version : int
        Of the session's planet; the picture is of the newest if it equals
        ``session.versions.planet``.
    quality : str
    seconds : float
        From the edit to the solution, reading included. [s]
    """

    solution: Any
    planet: Planet
    version: int
    quality: str
    seconds: float


@dataclass(frozen=True, kw_only=True)
class Status:
    """What the thread does now.

    Attributes
    ----------
    busy : bool
    doing : str
        A few words, empty if it is idle.
    done, total : int
        Of that.
    version : int
        Of the planet that it works at, or worked at last.
    error : str
        One line if the planet of ``version`` cannot be; else empty.
    """

    busy: bool = False
    doing: str = ""
    done: int = 0
    total: int = 0
    version: int = 0
    error: str = ""


class Solving:
    """Solves what a session wants, on a thread of its own.

    Parameters
    ----------
    session : Session or SessionSide
        Followed from now on.
    solver : PlanetSolver, optional
        See there; called on the thread. The processor's without it.
    wavelengths : callable
        ``wavelengths(planet, count)`` with a word of ``picture_wavelengths``.
    on_change : callable, optional
        Called on the thread when ``latest`` or ``status`` has changed; it should do no more than
        wake the host.

    Notes
    -----
    ``close`` ends the thread; so does the end of a ``with`` block.
    """

    def __init__(
        self,
        session: Followed,
        *,
        solver: PlanetSolver | None = None,
        wavelengths: Callable[[Planet, str], FloatArray] = picture_wavelengths,
        on_change: Callable[[], None] | None = None,
    ) -> None:
        self._session = session
        self._solver = live_solver() if solver is None else solver
        self._wavelengths = wavelengths
        self._on_change = on_change
        self._condition = threading.Condition()
        self._wanted = session.wanted
        self._asked = time.perf_counter()
        self._served: Wanted | None = None
        self._latest: Solved | None = None
        self._status = Status(busy=True, doing="starting", version=self._wanted.version)
        self._closed = False
        self._kept: OrderedDict[tuple[Any, ...], Solved] = OrderedDict()
        self._planets: OrderedDict[str, Planet] = OrderedDict()
        self._reported = 0.0
        self._unfollow = session.follow(self._follow)
        self._thread = threading.Thread(target=self._run, name="airlight solving", daemon=True)
        self._thread.start()

    # --- the host's side ----------------------------------------------------------------------

    @property
    def latest(self) -> Solved | None:
        """The newest solution, or None before the first."""
        return self._latest

    @property
    def status(self) -> Status:
        """What is being done, and the error if the newest planet cannot be."""
        return self._status

    @property
    def idle(self) -> bool:
        """Whether all that was wanted is solved, or known to be impossible."""
        with self._condition:
            return self._served is self._wanted

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until it is idle; False if that took longer. [s]"""
        with self._condition:
            return self._condition.wait_for(
                lambda: self._closed or self._served is self._wanted, timeout
            )

    def close(self) -> None:
        """Stop what is running and end the thread."""
        self._unfollow()
        with self._condition:
            self._closed = True
            self._condition.notify_all()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def __enter__(self) -> Solving:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def _follow(self, versions: Versions) -> None:
        """A change of the session, on the host's thread: view and display need no solution."""
        if versions.planet == self._wanted.version:
            return
        with self._condition:
            self._wanted = self._session.wanted
            self._asked = time.perf_counter()
            self._condition.notify_all()

    # --- the thread's side --------------------------------------------------------------------

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._closed or self._served is not self._wanted)
                if self._closed:
                    return
                wanted, asked = self._wanted, self._asked
            error = ""
            try:
                self._serve(wanted, asked)
            except Cancelled as stopped:
                if self._closed or self._wanted is not wanted:
                    continue
                error = str(stopped)
            except Exception as failure:
                # Whatever goes wrong with one planet, the next edit must find the thread alive.
                error = one_line(failure)
            with self._condition:
                self._status = Status(version=wanted.version, error=error)
                self._served = wanted
                self._condition.notify_all()
            self._tell()

    def _serve(self, wanted: Wanted, asked: float) -> None:
        """Every quality of a planet up to the wanted one, the quickest first."""
        kept = self._kept.get((*wanted.key, wanted.quality))
        if kept is not None:
            self._publish(replace(kept, version=wanted.version, seconds=0.0), wanted)
            return
        levels = ["preview", wanted.quality] if wanted.quality != "preview" else ["preview"]
        started = time.perf_counter()
        for level in levels:
            newer = self._gives_up(wanted, started if level == "preview" else None)
            if level != levels[0] and newer():
                raise Cancelled("a newer edit")
            known = self._kept.get((*wanted.key, level))
            if known is not None:
                self._publish(replace(known, version=wanted.version, seconds=0.0), wanted)
                continue
            planet = self._planet(wanted, newer)
            wavelengths = self._wavelengths(planet, wanted.wavelengths)
            # Refuses a star without light at one of them: its picture would have no colours.
            rgb_weights(wavelengths, planet.star.irradiances)
            solution = self._solver(
                planet,
                wavelengths,
                level,
                progress=self._reporter(wanted, f"solving, {level}"),
                cancel=newer,
            )
            self._publish(
                Solved(
                    solution=solution,
                    planet=planet,
                    version=wanted.version,
                    quality=level,
                    seconds=time.perf_counter() - asked,
                ),
                wanted,
            )

    def _gives_up(self, wanted: Wanted, started: float | None) -> Cancel:
        """Whether to stop: closed, or something newer is wanted and patience has ended."""

        def newer() -> bool:
            if self._closed:
                return True
            if self._wanted is wanted:
                return False
            return started is None or time.perf_counter() - started > PATIENCE

        return newer

    def _planet(self, wanted: Wanted, cancel: Cancel) -> Planet:
        key = wanted.state.tables_key
        planet = self._planets.get(key)
        if planet is None:
            report = self._reporter(wanted, "reading the planet")
            report(0, 0, "")
            planet = read_tables(
                wanted.state.tables,
                wanted.state.source,
                wavelengths=lambda planet: self._wavelengths(planet, wanted.wavelengths),
                progress=report,
                cancel=cancel,
            )
            self._planets[key] = planet
            while len(self._planets) > MOST_KEPT:
                self._planets.popitem(last=False)
        return switched(planet, wanted.state.off)

    def _publish(self, solved: Solved, wanted: Wanted) -> None:
        self._kept[(*wanted.key, solved.quality)] = solved
        self._kept.move_to_end((*wanted.key, solved.quality))
        while len(self._kept) > 2 * MOST_KEPT:
            self._kept.popitem(last=False)
        self._latest = solved
        self._status = replace(self._status, version=solved.version, error="")
        self._tell()

    def _reporter(self, wanted: Wanted, doing: str) -> Progress:
        def report(done: int, total: int, message: str) -> None:
            now = time.perf_counter()
            self._status = Status(
                busy=True, doing=doing, done=done, total=total, version=wanted.version
            )
            if now - self._reported >= _REPORT_EVERY:
                self._reported = now
                self._tell()

        return report

    def _tell(self) -> None:
        if self._on_change is not None:
            self._on_change()
