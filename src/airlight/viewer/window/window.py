"""The window: a planet, its light and all its parameters, in one loop that never waits.

Everything slow is done elsewhere: ``solving`` solves, a picture source renders, ``Saving`` writes;
each wakes the window when there is something new. A frame takes what is there and draws it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from time import perf_counter
from typing import Any, Final

from airlight.errors import AirlightError
from airlight.gpu.solve_planet import PlanetSolver
from airlight.viewer.background.error_line import Faults
from airlight.viewer.navigation.flight import Flight
from airlight.viewer.navigation.viewpoints import VIEWPOINTS, view_of
from airlight.viewer.painting.picture_source import Painter, Picture
from airlight.viewer.painting.probing import Probing
from airlight.viewer.session.session import Session
from airlight.viewer.window.canvas import EVENTS, Place
from airlight.viewer.window.input import WindowInput
from airlight.viewer.window.overlay_help import draw_help
from airlight.viewer.window.panels.probe import PROBE_HEIGHT, draw_probe
from airlight.viewer.window.panels.save import SaveDialog, Saving
from airlight.viewer.window.panels.side import SidePanel
from airlight.viewer.window.panels.status import FrameTimes, Status, draw_status
from airlight.viewer.window.picture_area import PictureArea, Rectangle, layout
from airlight.viewer.window.sides import Sides
from airlight.viewer.window.surface import WindowSurface

#: After an event the window goes on drawing for so long: hints appear, buttons fade. [s]
_LINGER: Final = 1.0
#: The longest step of a flight: a frame that took longer does not jump. [s]
_LONGEST_STEP: Final = 0.1
#: A message is shown for so long. [s]
_MESSAGE: Final = 5.0
#: By how much a key changes the exposure. [EV]
_STOP: Final = 1.0 / 3.0


class Window:
    """A window on a session.

    Parameters
    ----------
    session : Session
        What is shown and edited.
    place : Place
        A window of the desktop, or memory.
    device : wgpu.GPUDevice
    painter : callable
        Makes a painter; called once for each side.
    solver : PlanetSolver, optional
        Solves, on threads of ``Solving``.
    """

    def __init__(
        self,
        session: Session,
        place: Place,
        device: Any,
        painter: Callable[[], Painter],
        solver: PlanetSolver | None = None,
    ) -> None:
        self.session = session
        self._place = place
        self.surface = WindowSurface(device, place.canvas)
        self.area = PictureArea(self.surface.backend)
        self._sides = Sides(session, painter, solver, place.wake)
        self._flight = Flight(session)
        self.panel = SidePanel(
            session, self._flight, self.do, self.attempt, lambda: self._sides.planet
        )
        self._saving = Saving(place.wake)
        self._dialog = SaveDialog()
        self._probing = Probing(place.wake)
        self._times = FrameTimes()
        self._parts: dict[str, Rectangle] = {}
        self._shows_panels = True
        self._shows_help = False
        self._said = ("", 0.0)
        self._error = ""
        self._faults = Faults()
        self._last_event = perf_counter()
        self._last_frame = perf_counter()
        self.frames = 0
        self.input = WindowInput(place.canvas, self, self._flight, lambda: self.surface.typing)
        place.canvas.add_event_handler(self._noticed, *EVENTS, order=-999)

    def run(self) -> None:
        """Show the window until it is closed; then end all threads."""
        try:
            self._place.run(self.draw)
        finally:
            self.close()

    def close(self) -> None:
        """End all threads."""
        self._saving.close()
        self._probing.close()
        self._sides.close()

    @property
    def settled(self) -> bool:
        """Whether all that is wanted is shown, in full quality."""
        return self._sides.settled and not self._probing.busy

    @property
    def problem(self) -> str:
        """Why what is wanted cannot be shown, in one line; empty if it can."""
        return self._error or self._faults.line or self._sides.error

    def shown(self, side: str = "") -> Picture | None:
        """What the last frame showed of a side; of the one that is edited if left out."""
        return self._sides.picture(side)

    # --- a frame ------------------------------------------------------------------------------

    def draw(self) -> None:
        """Draw one frame."""
        self._times.begin()
        self._faults.forget()
        with self._faults.caught("flight"):
            self._step()
        size = self.surface.size
        self._parts = layout(
            size, panels=self._shows_panels, probe=PROBE_HEIGHT if self.panel.probes else 0.0
        )
        with self._faults.caught("request"):
            self._follow()
        self.surface.draw(self._gui)
        self._times.end()
        self.frames += 1
        if self._restless:
            self._place.canvas.request_draw()

    @property
    def _restless(self) -> bool:
        """Whether something moves without any event."""
        return (
            self._flight.moving
            or self.panel.plays
            or self.surface.pressed
            or perf_counter() - self._last_event < _LINGER
        )

    def _noticed(self, _event: Any) -> None:
        self._last_event = perf_counter()

    def _step(self) -> None:
        """Fly, and let time pass, since the last frame."""
        now = perf_counter()
        seconds = min(now - self._last_frame, _LONGEST_STEP)
        self._last_frame = now
        if self.surface.typing:
            self._flight.release()
        if self._flight.moving:
            self.attempt(lambda: self._flight.step(seconds))
        if self.panel.plays:
            declination, hour = self._flight.time
            hour += seconds * self.panel.speed / 3600.0
            self.attempt(lambda: self._flight.set_time(declination, hour % 24.0))

    def _follow(self) -> None:
        """Say what is wanted to those who solve and render."""
        session = self.session
        into = self._parts["picture"]
        ratio = self.surface.ratio
        session.resize(round(into.width * ratio), round(into.height * ratio))
        self._sides.follow(both=session.has_other and self.panel.compares)

    @contextmanager
    def _part(self, name: str) -> Iterator[None]:
        """A part of the frame whose fault does not end it."""
        with self._faults.caught(name), self.surface.balanced():
            yield

    def _gui(self) -> None:
        with self._part("picture"):
            self._draw_picture()
        if self._shows_panels:
            with self._part("side panel"):
                self.panel.draw(self._parts["panel"])
            if self.panel.probes:
                with self._part("probe"):
                    self._draw_probe()
        width, height = self.surface.size
        if self._shows_help:
            with self._part("help"):
                self._shows_help = draw_help(width, height)
        with self._part("save dialog"):
            self._dialog.draw(width, height, self._save_picture, self._save_planet)
        if self._shows_panels:  # the last, so that it tells what the others came to
            with self._part("status line"):
                draw_status(self._status(self.shown()), self._parts["status"])

    def _draw_picture(self) -> None:
        shown = self.shown()
        fitting = self.picture_rectangle()
        both = self.panel.compares and self.session.has_other
        if both:
            self.area.draw(self.shown("A"), self.shown("B"), fitting)
            self.area.draw_divider(fitting, self._names())
        else:
            self.area.draw(shown, None, fitting)
        reading = self._probing.reading
        if self.panel.probes and reading is not None:
            self.area.draw_mark(fitting, reading.place)

    def _draw_probe(self) -> None:
        reading, working = self._probing.reading, self._probing.working
        self.panel.probes = draw_probe(reading, working, self._parts["probe"])

    def _names(self) -> tuple[str, str]:
        names = [self.session.planet_name, self.session.planet_name_other]
        if self.session.showing == "B":
            names.reverse()
        return f"A  {names[0]}", f"B  {names[1]}"

    def _status(self, shown: Picture | None) -> Status:
        solver, working = "", ""
        solved, status = self._sides.solved(), self._sides.status
        if solved is not None:
            solver = f"{solved.quality}: {_seconds(solved.seconds)}"
        if status.busy:
            part = f" {100 * status.done // status.total} %" if status.total else ""
            working = f"{status.doing}{part} …"
            solver = f"{solver}, {working}" if solver else working
        picture = exposure = ""
        if shown is not None:
            fine = "" if shown.finished else ", finer follows"
            seconds = _seconds(shown.seconds)
            picture = f"{shown.by}: {shown.width}×{shown.height} in {seconds}{fine}"
            exposure = f"{shown.exposure:+.1f} EV"
        error = self.problem
        if self._saving.message and not self._saving.busy:
            self.say(self._saving.message)
            self._saving.message = ""
        text, until = self._said
        message = self._saving.message if self._saving.busy else ""
        if not message and perf_counter() < until:
            message = text
        return Status(
            place=self._where(),
            exposure=exposure,
            frame=f"window: {self._times.milliseconds:.0f} ms",
            picture=picture,
            solver=solver,
            working=working,
            message=message,
            error=error or self._saving.error or self._probing.error,
        )

    def _where(self) -> str:
        view = self.session.view
        zenith = float(view["view.sun_zenith"])
        return f"{_length(float(view['view.altitude']))} up    sun {zenith:.1f}° from the zenith"

    # --- what mouse and keys do ---------------------------------------------------------------

    @property
    def covered(self) -> bool:
        """See ``Deeds``."""
        return self._shows_help or bool(self._dialog.asks) or self.surface.asks

    def picture_rectangle(self) -> Rectangle:
        """Where the picture lies: in the middle of its part, in its own shape."""
        into = self._parts["picture"]
        camera = self.session.scene.camera
        ratio = self.surface.ratio
        return into.centered(camera.width / ratio, camera.height / ratio)

    def click(self, x: float, y: float) -> None:
        """See ``Deeds``."""
        if not self.panel.probes:
            return
        rectangle = self.picture_rectangle()
        at = rectangle.place_of(x, y)
        if at is None:
            return
        side = self.session.showing
        if self.panel.compares and self.session.has_other:
            side = "A" if at[0] < self.area.divider else "B"
        shown = self.shown(side)
        if shown is not None:
            self._probing.ask(shown.request, at)

    def do(self, deed: str) -> None:
        """See ``Deeds``."""
        word, _, number = deed.partition(" ")
        if word == "viewpoint" and number.isdigit():
            self._go(int(number) - 1)
            return
        deeds: dict[str, Callable[[], object]] = {
            "undo": self.session.undo,
            "redo": self.session.redo,
            "reset": self.session.reset,
            "save picture": lambda: self._dialog.ask("picture"),
            "save planet": lambda: self._dialog.ask("planet"),
            "close": self._place.close,
            "help": self._toggle_help,
            "leave": self._leave,
            "panels": self._toggle_panels,
            "probe": self._toggle_probe,
            "keep as b": self._keep_as_b,
            "compare": self._toggle_comparison,
            "swap": self.session.swap,
            "time": self._toggle_time,
            "automatic exposure": self._toggle_exposure,
            "brighter": lambda: self._expose(_STOP),
            "darker": lambda: self._expose(-_STOP),
        }
        self.attempt(deeds[deed])

    def attempt(self, edit: Callable[[], object]) -> None:
        """Do something; if it cannot be, say so in one line."""
        try:
            edit()
            self._error = ""
        except AirlightError as error:
            self._error = str(error)
        self._place.canvas.request_draw()

    def say(self, text: str) -> None:
        """Show a line for a while."""
        self._said = (text, perf_counter() + _MESSAGE)

    def _go(self, index: int) -> None:
        session = self.session
        bottom, top = (
            1e3 * float(session.value(f"shell.{end}_radius")) for end in ("bottom", "top")
        )
        place = VIEWPOINTS[index]
        bearing = float(session.view["view.sun_azimuth"])
        moved = view_of(place, bottom_radius=bottom, top_radius=top, bearing=bearing)
        self.attempt(lambda: session.move(moved))

    def _toggle_help(self) -> None:
        self._shows_help = not self._shows_help

    def _toggle_panels(self) -> None:
        self._shows_panels = not self._shows_panels

    def _toggle_probe(self) -> None:
        self.panel.probes = not self.panel.probes

    def _toggle_time(self) -> None:
        self.panel.plays = not self.panel.plays

    def _leave(self) -> None:
        self._shows_help, self._dialog.asks = False, ""
        self._shows_panels = True

    def _keep_as_b(self) -> None:
        self.session.store_b()
        self.say("kept as B: C shows both side by side, V changes them over")

    def _toggle_comparison(self) -> None:
        if not self.panel.compares and not self.session.has_other:
            self.session.store_b()
        self.panel.compares = not self.panel.compares

    def _toggle_exposure(self) -> None:
        automatic = bool(self.session.view["display.automatic"])
        shown = self.shown()
        self.session.set("display.automatic", not automatic)
        # The picture stays as bright as it was when the camera stops to adjust.
        exposure = shown.exposure if automatic and shown is not None else 0.0
        self.session.set("display.exposure", exposure)

    def _expose(self, stops: float) -> None:
        exposure = float(self.session.view["display.exposure"])
        self.session.set("display.exposure", exposure + stops)

    def _save_picture(self, path: str, size: tuple[int, int] | None) -> None:
        shown = self.shown()
        if shown is None:
            self._error = "there is no picture to save yet"
            return
        self._saving.save(path, shown, size)

    def _save_planet(self, path: str) -> None:
        self.attempt(lambda: self.session.save_planet(path))
        if not self._error:
            self.say(f"saved {path}")


def _length(metres: float) -> str:
    """A length in m or km.

    Examples
    --------
    >>> _length(2.0), _length(35e3), _length(1.529e7), _length(4.2e11)
    ('2 m', '35 km', '15290 km', '4.2e+08 km')
    """
    if metres < 1e3:
        return f"{metres:.4g} m"
    kilometres = metres / 1e3
    digits = ".0f" if 1e4 <= kilometres < 1e7 else ".4g"
    return f"{kilometres:{digits}} km"


def _seconds(seconds: float) -> str:
    """A time in ms or s.

    Examples
    --------
    >>> _seconds(0.0421), _seconds(3.14159), _seconds(0.0)
    ('42 ms', '3.1 s', 'at once')
    """
    if seconds <= 0.0:
        return "at once"
    return f"{1e3 * seconds:.0f} ms" if seconds < 1.0 else f"{seconds:.1f} s"
