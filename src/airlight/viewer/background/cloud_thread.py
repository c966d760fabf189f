"""Thread that generates the clouds of a side and solves their light, coarse first."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from typing import Final

from airlight.kernel.background_compiler import BackgroundCompiler
from airlight.kernel.compiling import Compiling, progress_text
from airlight.kernel.memory import give_back
from airlight.kernel.threads import Progress
from airlight.planets.planet import Planet
from airlight.render.background_compilation import live_cloudy_compiler
from airlight.render.clouds import MOST_KINDS
from airlight.render.clouds.cloud_light import FIRST, LIVE
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.clouds.lit_clouds import LitClouds, near, same_lights
from airlight.render.clouds.loops import LOOPS
from airlight.scene import Scene
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.background.latest_thread import LatestThread

#: Time without an edit after which light is refined. [s]
_PAUSE: Final = 0.3
#: Shortest time between progress reports. [s]
_REPORT_EVERY: Final = 0.2
#: Parts of the light, by the beginnings of the messages of their progress.
_PARTS: Final = {"orders": "mean light", "shadows": "shadows", "light": "light"}


@dataclass(frozen=True, kw_only=True, eq=False)
class CloudRequest:
    """Clouds to show.

    Parameters
    ----------
    planet : Planet
        Planet with clouds.
    solution : MomentsSolution
        Its solution without clouds.
    scene : Scene
        Scene of the picture.
    quality : str
        Quality of the picture.
    refined : bool
        Whether the light is to be refined: no better solution follows.
    """

    planet: Planet
    solution: MomentsSolution
    scene: Scene
    quality: str = "default"
    refined: bool = True

    def same(self, other: CloudRequest | None) -> bool:
        """Whether both requests have the same light."""
        return (
            other is not None
            and self.solution is other.solution
            and self.planet.clouds == other.planet.clouds
            and (self.quality, self.refined) == (other.quality, other.refined)
            and same_lights(self.scene, other.scene, self.planet.bottom_radius)
            and near(other.scene, self.scene)
        )


class CloudThread(LatestThread[CloudRequest]):
    """Thread that solves the light of the latest clouds.

    A first, coarse light is completed once begun, so that pictures follow a drag; the refined one
    gives way to a newer request.

    Parameters
    ----------
    wake : callable
        Function without arguments, called on the thread after each result and progress.

    Attributes
    ----------
    latest : LitClouds or None
        Newest clouds, possibly of an older request; None before the first.
    """

    def __init__(self, wake: Callable[[], None]) -> None:
        self.latest: LitClouds | None = None
        self._doing = "clouds …"
        self._around: CloudsAround | None = None
        self._reported = 0.0
        self._compiling = Compiling(LOOPS)
        self._compiling.subscribe(self._compiled)
        self._renderer: BackgroundCompiler | None = None
        self._leave_renderer: Callable[[], None] = lambda: None
        super().__init__("airlight-clouds", wake)

    @property
    def doing(self) -> str:
        """Current task in one line, also of the process that compiles pictures; empty if idle."""
        compiling = progress_text([self._compiling]) if self.busy else ""
        if self.busy and not compiling:
            return self._doing
        if self._renderer is not None and self._renderer.busy:
            counts = [self._renderer.compiling] + ([self._compiling] if compiling else [])
            compiling = progress_text(counts)
        return f"clouds: {compiling} …" if compiling else ""

    def end(self) -> None:
        """Stop counting what is compiled."""
        self._leave_renderer()
        self._compiling.close()

    def want(self, request: CloudRequest) -> None:
        """Set the latest request, unless it has the same light; returns immediately."""
        # compiles in another process, while the light is solved
        renderer = live_cloudy_compiler(min(len(request.planet.clouds), MOST_KINDS))
        if renderer is not self._renderer:
            self._leave_renderer()
            self._renderer = renderer
            self._leave_renderer = renderer.compiling.subscribe(self._compiled)
        with self._news:
            wanted = self._wanted
        if not request.same(wanted) and not (wanted is self._served and self._shows(request)):
            super().want(request)

    def _shows(self, request: CloudRequest) -> bool:
        """Whether the newest clouds are those of a request, to its end."""
        shown = self.latest
        return (
            shown is not None
            and shown.solution is request.solution
            and shown.same_clouds(request.planet, request.scene)
            and shown.same_light(request.scene)
            and not (request.refined and shown.detail == FIRST)
        )

    def serve(self, request: CloudRequest) -> None:
        """Solve the light of a request."""
        shown, place, around = self.latest, request.scene, self._around
        if shown is not None and near(shown.scene, place):
            place = replace(place, latitude=shown.scene.latitude, longitude=shown.scene.longitude)
        if around is None or shown is None or not shown.same_clouds(request.planet, place):
            self._say("clouds: shapes …")
            around = CloudsAround.of(request.planet, place, quality=request.quality, cache=False)
        assert around is not None
        self._around = around
        known = shown is not None and shown.same_light(place) and shown.decks == around.decks
        similar = None
        if shown is not None and shown.solution is request.solution:
            similar = shown.mean_layer
        steps = ([] if known else [FIRST]) + ([LIVE] if request.refined else [])
        for detail in steps:
            if detail == LIVE:
                self._wait_for_edit(request)
            self.latest = LitClouds.solve(
                replace(around, similar=similar),
                request.planet,
                request.solution,
                place,
                detail=detail,
                progress=self._reporter("first " if detail == FIRST else ""),
                cancel=partial(self._gives_up, request, detail),
            )
            self._wake()
        give_back()

    def _gives_up(self, request: CloudRequest, detail: str) -> bool:
        """Whether the light of a request is no longer worth solving."""
        return self._closing if detail == FIRST else self.is_stale(request)

    def _wait_for_edit(self, request: CloudRequest) -> None:
        """Wait for ``_PAUSE`` or until a request is superseded."""
        with self._news:
            self._news.wait_for(lambda: self.is_stale(request), _PAUSE)

    def _reporter(self, what: str) -> Progress:
        def report(done: int, total: int, message: str) -> None:
            if time.perf_counter() - self._reported >= _REPORT_EVERY:
                known = next((one for text, one in _PARTS.items() if message.startswith(text)), "")
                self._say(f"clouds: {what}{known or 'light'} {100 * done // max(total, 1)} % …")

        return report

    def _compiled(self) -> None:
        """Show the progress of compilation."""
        if time.perf_counter() - self._reported >= _REPORT_EVERY:
            self._say(self._doing)

    def _say(self, words: str) -> None:
        self._doing, self._reported = words, time.perf_counter()
        self._wake()
