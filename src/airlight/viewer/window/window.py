"""Main window: picture and parameters of a planet, in a loop that never blocks.

``SolverThread``, ``PictureThread``, ``Probing`` and ``Saving`` wake the window when they have a
result, the session when it is changed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import Any, Final

from airlight.render.solve_planet import PlanetSolver
from airlight.viewer.background.error_line import Faults
from airlight.viewer.background.preparing import Preparing
from airlight.viewer.navigation.flight import Flight
from airlight.viewer.navigation.flight_recorder import FlightRecorder
from airlight.viewer.navigation.keys import LOST, RATES
from airlight.viewer.painting.picture_source import Picture, PictureSource
from airlight.viewer.painting.probing import Probing
from airlight.viewer.session.session import Session
from airlight.viewer.window.actions import Actions
from airlight.viewer.window.canvas import EVENTS, Canvas
from airlight.viewer.window.film import sun_path
from airlight.viewer.window.first_picture import draw_first_picture
from airlight.viewer.window.input import WindowInput
from airlight.viewer.window.messages import Messages
from airlight.viewer.window.overlay_help import draw_help
from airlight.viewer.window.panels.gallery import ENLARGED, Gallery, Thumbnails
from airlight.viewer.window.panels.probe import PROBE_HEIGHT, draw_probe
from airlight.viewer.window.panels.save import SaveDialog, Saving
from airlight.viewer.window.panels.side import SidePanel
from airlight.viewer.window.panels.status import (
    FrameTimes,
    StatusLine,
    draw_status,
    picture_text,
    solver_text,
    where_text,
)
from airlight.viewer.window.picture_area import PictureArea, Rectangle, layout
from airlight.viewer.window.sides import Sides
from airlight.viewer.window.surface import WindowSurface

#: Time for which the window is redrawn after an event, for tooltips and fading buttons. [s]
_LINGER: Final = 1.0


class Window:
    """Window of a session.

    Parameters
    ----------
    session : Session
        Displayed and edited session.
    canvas : Canvas
        Canvas on the desktop or offscreen.
    device : wgpu.GPUDevice
        Device that draws the window.
    renderer : callable
        Factory of renderers, called once per side.
    solver : PlanetSolver, optional
        Solver, called on ``SolverThread``; by default on the CPU.
    preparing : Preparing, optional
        Progress until the first picture; it is closed with the window.
    """

    def __init__(
        self,
        session: Session,
        canvas: Canvas,
        device: Any,
        renderer: Callable[[], PictureSource],
        solver: PlanetSolver | None = None,
        preparing: Preparing | None = None,
    ) -> None:
        self.session = session
        self._canvas = canvas
        self._preparing = preparing
        self.surface = WindowSurface(device, canvas.render_canvas)
        self.area = PictureArea(self.surface.backend)
        self.thumbnails = Thumbnails(device, self.surface.backend)
        self.gallery = Gallery(self.thumbnails.of)
        self._unsubscribe = session.subscribe(lambda _versions: canvas.wake())
        self._sides = Sides(session, renderer, solver, canvas.wake)
        self._flight = Flight(session)
        self.recorder = FlightRecorder(session)
        self.messages = Messages(canvas.render_canvas.request_draw)
        self.panel = SidePanel(
            session, self._flight, self.do, self.attempt, lambda: self._sides.planet, self.recorder
        )
        self._saving = Saving(canvas.wake)
        self._dialog = SaveDialog()
        self.actions = Actions(
            session,
            self.panel,
            self._dialog,
            self.messages,
            self.shown,
            canvas,
            self.surface.close_popups,
            self.gallery.open,
            self.recorder,
        )
        self._probing = Probing(canvas.wake)
        self._probed = session.showing
        self._times = FrameTimes()
        self._parts: dict[str, Rectangle] = {}
        self._faults = Faults()
        self._last_event = perf_counter()
        self._last_frame = perf_counter()
        self.frames = 0
        self.input = WindowInput(
            canvas.render_canvas,
            self,
            self._flight,
            lambda: self.surface.typing or self.gallery.is_open,
        )
        canvas.render_canvas.add_event_handler(self._noticed, *EVENTS, order=-999)

    def run(self) -> None:
        """Show the window until it is closed; then end all threads."""
        try:
            self._canvas.run(self.draw)
        finally:
            self.close()

    def close(self) -> None:
        """End all threads."""
        self._unsubscribe()
        if self._preparing is not None:
            self._preparing.close()
        self._saving.close()
        self._probing.close()
        self._sides.close()

    @property
    def settled(self) -> bool:
        """Whether all requested pictures and probes are shown, in full quality."""
        return self._sides.settled and not self._probing.busy

    @property
    def problem(self) -> str:
        """First current error, in one line; empty if there is none."""
        return self.messages.error or self._faults.line or self._sides.error

    @property
    def progress(self) -> str:
        """Activity and progress until the first picture."""
        status = self._sides.status
        return status.text if self._preparing is None else self._preparing.text(status)

    def shown(self, side: str = "") -> Picture | None:
        """Picture of a side in the last frame, by default of the edited side."""
        return self._sides.picture(side)

    # --- frames -------------------------------------------------------------------------------

    def draw(self) -> None:
        """Draw one frame."""
        self._times.begin()
        self._faults.forget()
        with self._faults.caught("flight"):
            self._step()
        size = self.surface.size
        self._parts = layout(
            size, panels=self.actions.shows_panels, probe=PROBE_HEIGHT if self.panel.probes else 0.0
        )
        with self._faults.caught("request"):
            self._follow()
        self.surface.draw(self._gui)
        self._times.end()
        self.frames += 1
        if self._restless:
            self._canvas.render_canvas.request_draw()

    @property
    def _restless(self) -> bool:
        """Whether the window must be redrawn without an event."""
        return (
            self._flight.moving
            or self.recorder.moving
            or self.panel.plays
            or self.surface.pressed
            or self.surface.took_input
            or perf_counter() - self._last_event < _LINGER
        )

    def _noticed(self, _event: Any) -> None:
        self._last_event = perf_counter()

    def _step(self) -> None:
        """Advance flight and time since the last frame."""
        now = perf_counter()
        elapsed, self._last_frame = now - self._last_frame, now
        seconds = min(elapsed, RATES["longest_step"])
        if self.surface.typing:
            self._flight.release()
        if self._flight.moving:
            self.attempt(lambda: self._flight.step(seconds))
        if self.recorder.moving:
            if self._flight.moving:
                self.recorder.pause()
            self.attempt(lambda: self.recorder.step(elapsed))
        if self.panel.plays:
            self.attempt(lambda: self._flight.pass_time(seconds * self.panel.speed / 3600.0))

    def _follow(self) -> None:
        """Send the current requests to the solvers and renderers."""
        session = self.session
        into = self._parts["picture"]
        ratio = self.surface.ratio
        session.resize(round(into.width * ratio), round(into.height * ratio))
        self._sides.follow(both=session.has_other and self.panel.compares)

    @contextmanager
    def _part(self, name: str) -> Iterator[None]:
        """Isolate a part of the frame, whose failure does not end the frame."""
        with self._faults.caught(name), self.surface.balanced():
            yield

    def _gui(self) -> None:
        with self._part("picture"):
            self._draw_picture()
        if self.actions.shows_panels:
            with self._part("side panel"):
                self.panel.draw(self._parts["panel"])
            if self.panel.probes:
                with self._part("probe"):
                    self._draw_probe()
        width, height = self.surface.size
        if self.actions.shows_help:
            with self._part("help"):
                self.actions.shows_help = draw_help(width, height)
        with self._part("gallery"):
            chosen = self.gallery.draw(str(self.session.planet.source), (width, height))
            if chosen:
                self.attempt(lambda: self.session.open(chosen))
        with self._part("save dialog"):
            self._dialog.draw(width, height, self._save_picture, self._save_film, self._save_planet)
        if self.actions.shows_panels:  # last, to show the results of the others
            with self._part("status line"):
                draw_status(self._status(), self._parts["status"])

    def _draw_picture(self) -> None:
        shown = self.shown()
        if shown is None:
            self._draw_first_picture()
            return
        if self._preparing is not None:
            self._preparing.finish()
        fitting = self.picture_rectangle()
        both = self.panel.compares and self.session.has_other
        if not both and not self._is_of_planet(shown, self.session.planet_name):
            self._draw_first_picture()  # another planet was opened
            return
        if both:
            self.area.draw(self.shown("A"), self.shown("B"), fitting)
            middle = self.area.divider
            for side, first, last in (("A", 0.0, middle), ("B", middle, 1.0)):
                self._draw_outdated(side, fitting, first, last)
            self.area.draw_divider(fitting, self._names())
        else:
            self.area.draw(shown, None, fitting)
            words = self._sides.outdated()
            if not self.session.has_other:
                words = words.removeprefix(f"{self.session.showing}: ")
            lost = LOST if self._flight.planet_hidden else ""
            self.area.draw_working(words or lost, fitting)
        reading = self._probing.reading
        if self.panel.probes and reading is not None:
            self.area.draw_mark(fitting, reading.place)

    @staticmethod
    def _is_of_planet(shown: Picture, name: str) -> bool:
        """Whether a picture shows the planet of a name, edited or not."""
        pictured = shown.request.solution.planet
        return pictured is None or pictured.name == name

    def _draw_outdated(self, side: str, into: Rectangle, first: float, last: float) -> None:
        """Current task of a side between two limits; its picture is veiled if of another planet."""
        session, shown = self.session, self.shown(side)
        name = session.planet_name if side == session.showing else session.planet_name_other
        words = self._sides.outdated(side)
        if shown is None or self._is_of_planet(shown, name):
            self.area.draw_working(words, into, first)
        else:
            self.area.draw_outdated(words, into, first, last)

    def _draw_first_picture(self) -> None:
        status = self._sides.status
        share = status.done / max(status.total, 1)
        if self._preparing is not None and self._preparing.share < 1.0:
            share = self._preparing.share
        texture = self.thumbnails.of(str(self.session.planet.source), ENLARGED)
        draw_first_picture(texture, self._parts["picture"], self.progress, share)

    def _draw_probe(self) -> None:
        reading, working = self._probing.reading, self._probing.working
        shown = self.shown(self._probed)
        if reading is not None and shown is not None and shown.finished and not working:
            self._probing.follow(shown.request)
        self.panel.probes = draw_probe(reading, working, self._parts["probe"])

    def _names(self) -> tuple[str, str]:
        names = [self.session.planet_name, self.session.planet_name_other]
        if self.session.showing == "B":
            names.reverse()
        dark = self._sides.dark_side
        a, b = (
            f"{side}  {name}" + (f", exposed for {other}" if side == dark else "")
            for side, other, name in zip("AB", "BA", names, strict=True)
        )
        return a, b

    def _status(self) -> StatusLine:
        if self._saving.message and not self._saving.busy:
            self.messages.say(self._saving.message)
            self._saving.message = ""
        shown, status = self.shown(), self._sides.status
        return StatusLine(
            place=where_text(self.session.view),
            exposure="" if shown is None else f"{shown.exposure:+.1f} EV",
            frame=f"window: {self._times.milliseconds:.0f} ms",
            picture="" if shown is None else picture_text(shown),
            # before the first picture its place says what is done, and how long it takes
            solver="" if shown is None else solver_text(self._sides.solved(), status),
            working="" if shown is None else status.text,
            message=self._saving.message if self._saving.busy else self.messages.text,
            error=self.problem or self._saving.error or self._probing.error,
        )

    # --- targets of mouse and keys ------------------------------------------------------------

    @property
    def covered(self) -> bool:
        """See ``Host.covered``."""
        return self.actions.shows_help or bool(self._dialog.asks) or self.surface.asks

    def picture_rectangle(self) -> Rectangle:
        """Rectangle of the picture, centred in its area, with its own aspect ratio."""
        into = self._parts["picture"]
        camera = self.session.scene.camera
        ratio = self.surface.ratio
        return into.centered(camera.width / ratio, camera.height / ratio)

    def click(self, x: float, y: float) -> None:
        """Probe the picture at a clicked point; see ``Host.click``."""
        if self.session.around is not None:
            self.messages.say("a scene of several bodies has no probe")
            return
        rectangle = self.picture_rectangle()
        at = rectangle.place_of(x, y)
        if at is None:
            return
        self.panel.probes = True
        side = self.session.showing
        if self.panel.compares and self.session.has_other:
            side = "A" if at[0] < self.area.divider else "B"
        shown = self.shown(side)
        if shown is not None:
            self._probed = side
            self._probing.ask(shown.request, at)

    def do(self, action: str) -> None:
        """See ``Host.do``."""
        self.actions.do(action)

    def attempt(self, edit: Callable[[], object]) -> None:
        """See ``Host.attempt``."""
        self.messages.attempt(edit)

    def _save_picture(self, path: str, size: tuple[int, int] | None) -> None:
        shown = self.shown()
        if shown is None:
            self.messages.error = "there is no picture to save yet"
            return
        self._saving.save(path, shown, size)

    def _save_film(
        self, path: str, size: tuple[int, int] | None, hours: float, seconds: float
    ) -> None:
        shown = self.shown()
        if shown is None:
            self.messages.error = "there is no picture to film yet"
            return
        if self.session.around is not None:
            self.messages.error = "films of scenes are made by airlight animate"
            return
        if shown.request.clouds is not None:
            self.messages.error = "films with clouds are made by airlight animate"
            return
        view = self.session.view
        latitude, zenith, azimuth = (
            float(view[f"view.{name}"]) for name in ("latitude", "sun_zenith", "sun_azimuth")
        )
        suns = sun_path(latitude, (zenith, azimuth), hours, seconds)
        self._saving.film(path, shown, size, suns)

    def _save_planet(self, path: str) -> None:
        self.attempt(lambda: self.session.save_planet(path))
        if not self.messages.error:
            self.messages.say(f"saved {path}")
