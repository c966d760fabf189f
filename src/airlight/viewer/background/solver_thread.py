"""Solver thread: observes a session, and reads and solves each planet, preview first.

The newest edit supersedes older ones. The host never blocks: it reads ``latest`` and ``status``.
"""

from __future__ import annotations

import copy
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Final, Protocol

from airlight.errors import Cancelled
from airlight.image.spectral import rgb_weights
from airlight.kernel.cache import Cache
from airlight.kernel.memory import give_back
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.picture_wavelengths import FloatArray, picture_wavelengths
from airlight.planets.planet import Planet
from airlight.planets.reading.reader import read_tables
from airlight.planets.without_clouds import check_clear
from airlight.render.solve_planet import PlanetSolver, live_solver
from airlight.viewer.background.error_line import one_line
from airlight.viewer.session.constituent_switches import switched
from airlight.viewer.session.planet_state import SolveRequest, Versions

#: Time after which a preview is cancelled by a newer edit. Faster previews are completed, so that
#: the display follows a drag. [s]
PATIENCE: Final = 3.0
#: Time without an edit after which an edited planet is solved beyond the preview, whose picture is
#: rendered meanwhile. [s]
PAUSE: Final = 0.3
#: Number of cached solutions, for immediate undo and change of side.
CACHE_SIZE: Final = 4
#: Completed fraction from which the remaining time is estimated. [1]
_ESTIMATE_AFTER: Final = 0.1
#: Shortest time between progress reports. [s]
_REPORT_EVERY: Final = 0.1


class ObservableSession(Protocol):
    """Observable source of solve requests: a session or one of its sides."""

    @property
    def solve_request(self) -> SolveRequest:
        """Request to solve."""

    def subscribe(self, observer: Callable[[Versions], None]) -> Callable[[], None]:
        """Call ``observer`` after every change, on the host's thread; returns the unsubscriber."""


@dataclass(frozen=True, kw_only=True)
class SolverResult:
    """Result of a solve, with planet and version.

    Attributes
    ----------
    planet : Planet
        Solved planet, without its three-dimensional clouds; disabled constituents neither scatter
        nor absorb.
    cloudy : Planet
        The same with its clouds.
    version : int
        Version of the session's planet.
    quality : str
        Quality level of the solution.
    seconds : float
        Time from the edit to the solution. [s]
    """

    solution: Any
    planet: Planet
    cloudy: Planet
    version: int
    quality: str
    seconds: float


@dataclass(frozen=True, kw_only=True)
class SolverStatus:
    """Current activity of the thread.

    Attributes
    ----------
    busy : bool
        Whether the thread is solving.
    doing : str
        Short description of the current task; empty if idle.
    done, total : int
        Progress of that task. [1]
    version : int
        Version of the current or last planet.
    error : str
        One-line error if the planet of ``version`` is invalid or cannot be solved; else empty.
    left : float or None
        Estimated time left; None while unknown. [s]
    """

    busy: bool = False
    doing: str = ""
    done: int = 0
    total: int = 0
    version: int = 0
    error: str = ""
    left: float | None = None

    @property
    def text(self) -> str:
        """Current task with its progress and the time left; empty if idle.

        Examples
        --------
        >>> SolverStatus(busy=True, doing="solving, default", done=1, total=4, left=31.2).text
        'solving, default 25 %, about 31 s left …'
        """
        if not self.busy:
            return ""
        part = f" {100 * self.done // self.total} %" if self.total else ""
        left = "" if self.left is None or self.left < 1.0 else f", about {self.left:.0f} s left"
        return f"{self.doing}{part}{left} …"


class SolverThread:
    """Thread that solves the requests of a session.

    Parameters
    ----------
    session : Session or SessionSide
        Session to observe.
    solver : PlanetSolver, optional
        Solver, called on the thread; by default on the CPU.
    wavelengths : callable
        ``wavelengths(planet, count)`` [nm], with ``count`` as for ``picture_wavelengths``.
    draws_clouds : bool
        Whether the host draws three-dimensional clouds; otherwise planets with them are refused.
    on_change : callable, optional
        Called on the thread when ``latest`` or ``status`` has changed; it should only wake the
        host.

    Notes
    -----
    ``close`` or the end of a ``with`` block ends the thread.
    """

    def __init__(
        self,
        session: ObservableSession,
        *,
        solver: PlanetSolver | None = None,
        wavelengths: Callable[[Planet, str], FloatArray] = picture_wavelengths,
        draws_clouds: bool = False,
        on_change: Callable[[], None] | None = None,
    ) -> None:
        self._session = session
        self._solver = live_solver() if solver is None else solver
        self._wavelengths = wavelengths
        self._draws_clouds = draws_clouds
        self._on_change = on_change
        self._condition = threading.Condition()
        self._request = session.solve_request
        self._asked = time.perf_counter()
        self._served: SolveRequest | None = None
        self._latest: SolverResult | None = None
        self._latest_key: tuple[Any, ...] = ()
        self._status = SolverStatus(busy=True, doing="starting", version=self._request.version)
        self._closed = False
        self._kept: Cache[tuple[Any, ...], SolverResult] = Cache(2 * CACHE_SIZE)
        self._planets: Cache[str, Planet] = Cache(CACHE_SIZE)
        self._reported = 0.0
        self._unsubscribe = session.subscribe(self._on_session_change)
        self._thread = threading.Thread(target=self._run, name="airlight solving", daemon=True)
        self._thread.start()

    # --- on the host's thread -----------------------------------------------------------------

    @property
    def latest(self) -> SolverResult | None:
        """Newest solution, or None before the first."""
        return self._latest

    @property
    def status(self) -> SolverStatus:
        """Current activity, and the error of the newest planet."""
        return self._status

    @property
    def idle(self) -> bool:
        """Whether the newest request is solved or has failed."""
        with self._condition:
            return self._served is self._request

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until the thread is idle; False after ``timeout``. [s]"""
        with self._condition:
            return self._condition.wait_for(
                lambda: self._closed or self._served is self._request, timeout
            )

    def close(self) -> None:
        """Cancel the running solve and end the thread."""
        self._unsubscribe()
        with self._condition:
            self._closed = True
            self._condition.notify_all()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def __enter__(self) -> SolverThread:
        return self

    def __exit__(self, *error: object) -> None:
        self.close()

    def _on_session_change(self, versions: Versions) -> None:
        """Handle a change of the session; changes of view and display need no solution."""
        if versions.planet == self._request.version:
            return
        with self._condition:
            self._request = self._session.solve_request
            self._asked = time.perf_counter()
            self._condition.notify_all()

    # --- on the solving thread ----------------------------------------------------------------

    def _run(self) -> None:
        while True:
            with self._condition:
                self._condition.wait_for(lambda: self._closed or self._served is not self._request)
                if self._closed:
                    return
                request, asked = self._request, self._asked
            error = ""
            try:
                self._serve(request, asked)
            except Cancelled as stopped:
                if self._closed or self._request is not request:
                    continue
                error = str(stopped)
            except Exception as failure:
                # The thread must survive any failure of one planet, to serve the next edit.
                error = one_line(failure)
            with self._condition:
                self._status = SolverStatus(version=request.version, error=error)
                self._served = request
                self._condition.notify_all()
            self._notify()

    def _serve(self, request: SolveRequest, asked: float) -> None:
        """Solve a planet at each quality up to the requested one, the fastest first."""
        if self._publish_known(request, request.quality):
            return
        levels = ["preview", request.quality] if request.quality != "preview" else ["preview"]
        is_first = self._latest is None
        started = time.perf_counter()
        for level in levels:
            newer = self._gives_up(request, started if level == "preview" else None)
            if level != levels[0]:
                if not is_first:
                    self._wait_for_edit(request)
                if newer():
                    raise Cancelled("a newer edit")
            if self._publish_known(request, level):
                continue
            cloudy = self._planet(request, newer)
            planet = cloudy.without_clouds
            wavelengths = self._wavelengths(planet, request.wavelengths)
            # Raises an error for a star without light at one of them: the picture would have no
            # colours.
            rgb_weights(wavelengths, planet.lights(wavelengths)[0].spectrum)
            solution = self._solver(
                planet,
                wavelengths,
                level,
                progress=self._reporter(request, f"solving, {level}"),
                cancel=newer,
            )
            self._publish(
                SolverResult(
                    solution=solution,
                    planet=planet,
                    cloudy=cloudy,
                    version=request.version,
                    quality=level,
                    seconds=time.perf_counter() - asked,
                ),
                request,
            )
        give_back()

    def _publish_known(self, request: SolveRequest, level: str) -> bool:
        """Publish a solution that is kept, also of a planet with other clouds; whether it is."""
        key = (*request.key, level)
        known = self._latest if key == self._latest_key else self._kept.get(key)
        if known is not None and known is not self._latest:
            known = _copied(known)
        if known is None:
            return False
        cloudy = self._planet(request, lambda: self._request is not request)
        self._publish(replace(known, cloudy=cloudy, version=request.version, seconds=0.0), request)
        return True

    def _wait_for_edit(self, request: SolveRequest) -> None:
        """Wait for ``PAUSE`` or until a request is superseded."""
        with self._condition:
            self._condition.wait_for(lambda: self._closed or self._request is not request, PAUSE)

    def _gives_up(self, request: SolveRequest, started: float | None) -> Cancel:
        """Cancellation test: closed, or superseded after ``PATIENCE`` has passed."""

        def newer() -> bool:
            if self._closed:
                return True
            if self._request is request:
                return False
            return started is None or time.perf_counter() - started > PATIENCE

        return newer

    def _planet(self, request: SolveRequest, cancel: Cancel) -> Planet:
        key = request.state.tables_key
        planet = self._planets.get(key)
        if planet is None:
            report = self._reporter(request, "reading the planet")
            report(0, 0, "")
            planet = read_tables(
                request.state.tables,
                request.state.source,
                wavelengths=lambda planet: self._wavelengths(planet, request.wavelengths),
                progress=report,
                cancel=cancel,
            )
            self._planets.put(key, planet)
        if not self._draws_clouds:
            check_clear(planet, "this viewer")
        return switched(planet, request.state.off)

    def _publish(self, solved: SolverResult, request: SolveRequest) -> None:
        self._latest_key = (*request.key, solved.quality)
        if self._latest_key not in self._kept:
            self._kept.put(self._latest_key, _copied(solved))
        self._latest = solved
        self._status = replace(self._status, version=solved.version, error="")
        self._notify()

    def _reporter(self, request: SolveRequest, doing: str) -> Progress:
        began = time.perf_counter()

        def report(done: int, total: int, message: str) -> None:
            now = time.perf_counter()
            share = done / max(total, 1)
            left = (now - began) * (1.0 / share - 1.0) if share >= _ESTIMATE_AFTER else None
            self._status = SolverStatus(
                busy=True, doing=doing, done=done, total=total, version=request.version, left=left
            )
            if now - self._reported >= _REPORT_EVERY:
                self._reported = now
                self._notify()

        return report

    def _notify(self) -> None:
        if self._on_change is not None:
            self._on_change()


def _copied(solved: SolverResult) -> SolverResult:
    """Copy to keep, or of one that is kept: it never gets the tables of pictures, up to 60 MB."""
    return replace(solved, solution=copy.copy(solved.solution))
