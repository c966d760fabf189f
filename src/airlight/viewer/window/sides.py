"""Sides of the comparison, each with a solver thread and a renderer thread."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final, cast

from airlight.planets.planet import Planet
from airlight.render.solve_planet import PlanetSolver
from airlight.scene.system import System
from airlight.viewer.background.cloud_clock import CloudClock
from airlight.viewer.background.solver_thread import SolverResult, SolverStatus, SolverThread
from airlight.viewer.painting.picture_source import Orders, Picture, PictureSource, Request
from airlight.viewer.painting.picture_thread import PictureThread
from airlight.viewer.parameters.view_parameters import scene_of, settings_of
from airlight.viewer.session.session import Session, SessionSide

if TYPE_CHECKING:
    from airlight.render.clouds.lit_clouds import LitClouds
    from airlight.viewer.background.cloud_thread import CloudThread

#: Time for which a picture counts as new. [s]
_FRESH: Final = 0.5
#: Difference of exposures at which a side is far too dark, by eye. [EV]
_DARK: Final = 3.0


class Sides:
    """Solutions and pictures of a session's one or two sides.

    Parameters
    ----------
    renderer : callable
        Factory of renderers, called once per side.
    solver : PlanetSolver, optional
        Solver, called on ``SolverThread``; by default on the CPU.
    wake : callable
        Called from any thread after each new solution, status or picture.
    """

    def __init__(
        self,
        session: Session,
        renderer: Callable[[], PictureSource],
        solver: PlanetSolver | None,
        wake: Callable[[], None],
    ) -> None:
        self._session = session
        self._make_renderer = renderer
        self._solver = solver
        self._wake = wake
        self._solvings: dict[str, SolverThread] = {}
        self._threads: dict[str, PictureThread] = {}
        self._clouds: dict[str, CloudThread] = {}
        self._clocks: dict[str, CloudClock] = {}
        self._pictures: dict[str, Picture] = {}
        self._wanted: tuple[str, ...] = ()
        self._arrived: dict[str, float] = {}

    def follow(self, *, both: bool) -> None:
        """Update the requests of the edited side or of both."""
        shown = self._session.showing
        other = "A" if shown == "B" else "B"
        sides = (shown, other) if both else (shown,)
        for side in sides:
            self._want(side)
        for side in self._threads.keys() - sides:  # would adapt the exposure that they share
            self._threads[side].drop()
        self._wanted = sides

    def _want(self, side: str) -> None:
        if side not in self._solvings:
            self._threads[side] = PictureThread(self._make_renderer(), self._wake)
            self._solvings[side] = SolverThread(
                SessionSide(self._session, side),
                solver=self._solver,
                draws_clouds=True,
                on_change=self._wake,
            )
            self._clocks[side] = CloudClock()
        solved = self._solvings[side].latest
        if solved is not None:
            self._want_clouds(side, solved)
            self._threads[side].want(self._request(side, solved))
        newest = self._threads[side].picture
        if newest is not None and newest is not self._pictures.get(side):
            self._pictures[side] = newest
            self._arrived[side] = perf_counter()

    def _want_clouds(self, side: str, solved: SolverResult) -> None:
        """Ask for the light of the clouds of a side, if it has any."""
        if not solved.cloudy.clouds or self._session.around is not None:
            if side in self._clouds:  # their light takes hundreds of megabytes
                self._clouds.pop(side).close(wait=False)
            return
        from airlight.viewer.background.cloud_thread import CloudRequest, CloudThread

        if side not in self._clouds:
            self._clouds[side] = CloudThread(self._wake)
        view = self._view(side)
        self._clouds[side].want(
            CloudRequest(
                planet=solved.cloudy,
                solution=solved.solution,
                scene=scene_of(view, *self._session.size),
                quality=solved.quality,
                refined=solved.quality == view["light.quality"],
            )
        )

    def _view(self, side: str) -> Mapping[str, Any]:
        """View of a side."""
        session = self._session
        return session.view if side == session.showing else session.view_other or session.view

    def _request(self, side: str, solved: SolverResult) -> Request:
        """Picture request of a side."""
        session = self._session
        view = self._view(side)
        lit, seconds = self._shown_clouds(side, solved)
        exposure = float(session.view["display.exposure"])
        automatic = bool(session.view["display.automatic"])
        shared = session.shares_exposure
        leads = side == (self._brighter if shared else session.showing)
        adapted = session.adaptation.exposure
        follows = automatic and shared and not leads and adapted is not None
        return Request(
            solution=solved.solution,
            scene=scene_of(view, *session.size),
            clouds=lit,
            cloud_time=seconds,
            exposure=exposure + adapted if follows and adapted is not None else exposure,
            automatic=automatic and not follows,
            adaptation=session.adaptation if leads else None,
            held=session.holds_exposure,
            meters=follows,
            display=settings_of(view),
            orders=cast(Orders, view["light.orders"]),
            system=self._system(view, solved),
            body="" if session.around is None else session.around.body,
        )

    def _system(self, view: Mapping[str, Any], solved: SolverResult) -> System | None:
        """Scene around the planet; None without one."""
        around = self._session.around
        return None if around is None else around.seen(view, solved.cloudy)

    def _shown_clouds(self, side: str, solved: SolverResult) -> tuple[LitClouds | None, float]:
        """Newest clouds of a side, and the time for which the wind has moved them. [s]"""
        seconds = self._clocks[side].seconds(self._view(side))
        if side not in self._clouds or not solved.cloudy.clouds:
            return None, 0.0
        moves = any(one.wind_speed > 0.0 for one in solved.cloudy.clouds)
        return self._clouds[side].latest, seconds if moves else 0.0

    def _cloud_words(self, side: str) -> str:
        """What is done for the clouds of a side; empty if they are shown as they are to be."""
        thread, solved = self._clouds.get(side), self.solved(side)
        if thread is None or solved is None or not solved.cloudy.clouds:
            return ""
        return thread.doing

    @property
    def _metered(self) -> dict[str, float]:
        """Metered exposures of the sides' pictures. [EV]"""
        shown = {side: self._pictures.get(side) for side in self._wanted}
        return {side: one.metered for side, one in shown.items() if one and one.metered is not None}

    @property
    def dark_side(self) -> str:
        """Side that the exposure of the other one makes far too dark; empty if there is none."""
        session, metered = self._session, self._metered
        together = session.shares_exposure and bool(session.view["display.automatic"])
        if not together or len(metered) < 2:
            return ""
        side = max(metered, key=metered.__getitem__)
        return side if metered[side] - min(metered.values()) > _DARK else ""

    @property
    def _brighter(self) -> str:
        """Side whose exposure both share: that of less exposure, so that neither is white."""
        metered = self._metered
        showing = self._session.showing
        return min(metered, key=metered.__getitem__) if len(metered) > 1 else showing

    def picture(self, side: str = "") -> Picture | None:
        """Displayed picture of a side, by default of the edited side."""
        return self._pictures.get(side or self._session.showing)

    def outdated(self, side: str = "") -> str:
        """Current task of a side with an outdated picture; empty if the picture is up to date.

        During continuous updates, as in flight, the last picture counts as up to date.
        """
        side = side or self._session.showing
        shown, solved = self._pictures.get(side), self.solved(side)
        if side not in self._wanted or shown is None:
            return ""
        words = self._cloud_words(side)
        if words and solved is not None and solved.version == self._session.versions.planet:
            return f"{side}: {words}"
        if perf_counter() - self._arrived[side] < _FRESH:
            return ""
        solving = self._solvings[side]
        if solved is None or solved.version != self._session.versions.planet:
            return "" if solving.idle else f"{side}: {solving.status.text or 'solving …'}"
        if shown.request.same_light(self._request(side, solved)) or not self._threads[side].busy:
            return ""
        return f"{side}: rendering …"

    def solved(self, side: str = "") -> SolverResult | None:
        """Newest solution of a side, by default of the edited side."""
        solving = self._solvings.get(side or self._session.showing)
        return None if solving is None else solving.latest

    @property
    def status(self) -> SolverStatus:
        """Status of the edited side's solver."""
        solving = self._solvings.get(self._session.showing)
        return SolverStatus() if solving is None else solving.status

    @property
    def planet(self) -> Planet | None:
        """Edited planet as read; None if not yet read or if constituents are switched off."""
        solved = self.solved()
        if solved is None or solved.version != self._session.versions.planet:
            return None
        return None if self._session.planet.off else solved.planet

    @property
    def settled(self) -> bool:
        """Whether all requested pictures are shown, in full quality."""
        return bool(self._wanted) and all(self._is_settled(side) for side in self._wanted)

    def _is_settled(self, side: str) -> bool:
        solved, shown = self._solvings[side].latest, self._pictures.get(side)
        return (
            self._solvings[side].idle
            and not self._threads[side].busy
            and not self._cloud_words(side)
            and solved is not None
            and shown is not None
            and shown.finished
            and shown.request.same(self._request(side, solved))
        )

    @property
    def error(self) -> str:
        """First error of the requested sides, in one line; empty if there is none."""
        errors = [self._solvings[side].status.error for side in self._wanted]
        errors += [self._threads[side].error for side in self._wanted]
        errors += [self._clouds[side].error for side in self._wanted if side in self._clouds]
        return next((one for one in errors if one), "")

    def close(self) -> None:
        """End all threads."""
        for solving in self._solvings.values():
            solving.close()
        for lighting in self._clouds.values():
            lighting.close()
        for thread in self._threads.values():
            thread.close()
        self._solvings.clear()
        self._threads.clear()
        self._clouds.clear()
        self._wanted = ()
