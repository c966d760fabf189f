"""Viewer in a notebook: JupyterLab, marimo and other hosts of anywidget.

The browser renders with the page's JavaScript, or Python if the browser has no GPU; Python solves.
Requires the extra ``airlight[notebook]``.
"""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from airlight.errors import AirlightError
from airlight.planets.picture_wavelengths import texel_wavelengths
from airlight.render.rendering_gpu import any_gpu
from airlight.render.solve_planet import live_solver
from airlight.viewer.background.solver_thread import SolverThread
from airlight.viewer.browser.kernel_pictures import KernelPictures, Order
from airlight.viewer.browser.modules import join_modules, web_file
from airlight.viewer.browser.package import program, solution_package
from airlight.viewer.gallery.thumbnails import thumbnail_address
from airlight.viewer.navigation.viewpoints import view_in
from airlight.viewer.parameters.cloud_kinds import CLOUD_GROUP
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.session.session import Session

try:
    import anywidget
    import traitlets
except ImportError as error:
    raise ImportError("a viewer in a notebook needs pip install 'airlight[notebook]'") from error


def _first_session(planet: str | Path) -> Session:
    """Session on a planet in its initial view, with an empty history."""
    session = Session(planet)
    session.move(view_in(session))
    session.forget_steps()
    return session


class Viewer(anywidget.AnyWidget):
    """Interactive planet, shown as the last expression of a cell.

    Parameters are synchronised both ways: ``viewer.values["view.altitude"]`` is the value of a
    slider, and ``viewer.set("view.altitude", 1e5)`` moves it.

    Parameters
    ----------
    planet : str, Path or Session
        Name of a preset, path of a planet file, or a session, which may be shared.
    height : int
        Height of the widget. [pixel]
    device : str
        Renderer: ``webgpu`` or ``webgl2`` of the browser, the CPU of the ``kernel``, or ``auto``:
        a GPU of the browser, else the kernel.
    solving : callable, optional
        Factory of the solver thread, with the arguments of ``SolverThread``.

    Attributes
    ----------
    session : Session
        Displayed session; the viewer observes its changes.
    values : dict
        Values of all parameters by path, synchronised both ways. [parameter.unit]
    status, message : str
        Status of the solution; error in one line, or empty.

    Examples
    --------
    >>> from airlight.viewer.browser.notebook import Viewer  # doctest: +SKIP
    >>> viewer = Viewer("mars")  # doctest: +SKIP
    >>> viewer  # doctest: +SKIP
    """

    _esm = join_modules("widget.js")
    _css = web_file("style.css")

    title = traitlets.Unicode().tag(sync=True)
    first = traitlets.Unicode().tag(sync=True)
    parameters = traitlets.List().tag(sync=True)
    values = traitlets.Dict().tag(sync=True)
    program = traitlets.Dict().tag(sync=True)
    picture = traitlets.Dict().tag(sync=True)
    status = traitlets.Unicode().tag(sync=True)
    message = traitlets.Unicode().tag(sync=True)
    can = traitlets.Dict().tag(sync=True)
    messages = traitlets.Dict().tag(sync=True)
    heard = traitlets.Dict().tag(sync=True)
    height = traitlets.Int(540).tag(sync=True)
    device = traitlets.Unicode("auto").tag(sync=True)
    drawer = traitlets.Unicode("").tag(sync=True)
    wanted = traitlets.Dict().tag(sync=True)
    rendered = traitlets.Dict().tag(sync=True)
    stale = traitlets.Bool(False).tag(sync=True)

    _ending: tuple[Callable[[], None], ...] = ()
    _solving: Any = None

    def __init__(
        self,
        planet: str | Path | Session = "earth",
        *,
        height: int = 540,
        device: str = "auto",
        solving: Callable[..., SolverThread] = SolverThread,
    ) -> None:
        self.session = planet if isinstance(planet, Session) else _first_session(planet)
        self._telling = False
        self._shown: object = None
        self._waiting: Mapping[str, Any] = {}
        tables = self.session.planet.tables
        super().__init__(
            height=height,
            device=device,
            program=program(bool(tables.get("rings")) or tables.get("flattening", 0.0) > 0.0),
            first=thumbnail_address(str(self.session.planet.source)),
            **self._state_message(),
        )
        try:
            self._loop: asyncio.AbstractEventLoop | None = asyncio.get_running_loop()
        except RuntimeError:
            self._loop = None
        unsubscribe = self.session.subscribe(lambda versions: self._notify())
        self.observe(self._take_values, "values")
        self.observe(self._take_messages, "messages")
        self.observe(self._take_wanted, "wanted")
        self.observe(self._take_drawer, "drawer")
        self._pictures = KernelPictures(self._answer)
        self._solving = solving(
            self.session,
            solver=live_solver("auto", any_gpu()),
            wavelengths=texel_wavelengths,
            on_change=self._wake,
        )
        self._ending = (unsubscribe, self._solving.close, self._pictures.close)
        self._follow_solution()

    # --- from Python --------------------------------------------------------------------------

    def set(self, path: str, value: Value) -> None:
        """Set a parameter; see ``Session.set``."""
        self.session.set(path, value)

    def wait(self, timeout: float | None = None) -> bool:
        """Wait until the planet is solved; False after ``timeout``. [s]"""
        done = bool(self._solving.wait(timeout))
        self._follow_solution()
        return done

    def close(self) -> None:
        """End the solver thread and close the widget."""
        ending, self._ending = self._ending, ()
        for end in ending:
            end()
        super().close()

    # --- to the browser -----------------------------------------------------------------------

    def _state_message(self) -> dict[str, Any]:
        session = self.session
        return {
            "title": session.planet_name,
            "parameters": [one.as_json() for one in session.parameters if one.group != CLOUD_GROUP],
            "values": dict(session.values),
            "can": {
                "undo": session.can_undo,
                "redo": session.can_redo,
                "swap": session.has_other,
                "showing": session.showing,
                "camera": session.shares_camera,
            },
        }

    def _notify(self, heard: dict[str, int] | None = None) -> None:
        """Send the session state to the browser, with the handled messages."""
        message = self._state_message() | ({} if heard is None else {"heard": heard})
        self._telling = True
        try:
            with self.hold_sync():
                for name, value in message.items():
                    setattr(self, name, value)
        finally:
            self._telling = False

    def _wake(self) -> None:
        """Pass a new solution from the solver thread to the notebook's event loop."""
        if self._loop is None or self._loop.is_closed():
            self._follow_solution()
        else:
            self._loop.call_soon_threadsafe(self._follow_solution)

    def _follow_solution(self) -> None:
        if self._solving is None:  # the thread may report before the end of ``__init__``
            return
        solved, now = self._solving.latest, self._solving.status
        self.message = now.error
        if solved is not None and solved is not self._shown:
            self._shown = solved
            numbers, tables = solution_package(solved.solution)
            if self.drawer == "kernel":  # the browser receives pictures
                tables = {}
            self.picture = numbers | {
                "version": solved.version,
                "tables": {
                    name: {"format": kind, "data": values.tobytes()}
                    for name, (kind, values) in tables.items()
                },
            }
            self._take_wanted({"new": self._waiting})
        self.stale = solved is not None and solved.version != self.session.versions.planet
        if self._pictures.preparing is not None and self._pictures.waits:
            self.status = self._pictures.preparing.text(now)
        elif now.busy:
            self.status = now.text
        elif solved is not None:
            self.status = f"{solved.quality}, {solved.seconds:.2f} s"

    def _answer(self, rendered: dict[str, Any]) -> None:
        """Pass a frame from its thread via the event loop to the browser."""
        if self._loop is None or self._loop.is_closed():
            self._show_rendered(rendered)
        else:
            self._loop.call_soon_threadsafe(self._show_rendered, rendered)

    def _show_rendered(self, rendered: dict[str, Any]) -> None:
        self.rendered = rendered
        self._follow_solution()  # which does not wait for the renderer

    # --- from the browser ---------------------------------------------------------------------

    def _take_messages(self, change: Mapping[str, Any]) -> None:
        """Handle the browser's new messages, in order.

        As hosts may merge or repeat updates, each view numbers its messages and sends them until
        they are acknowledged.
        """
        heard = dict(self.heard)
        faults = []
        for view, messages in change["new"].items():
            for message in messages:
                if message["count"] > heard.get(view, 0):
                    heard[view] = message["count"]
                    faults.append(self._act(message))
        if heard != self.heard:
            self.message = next(filter(None, faults), "")
            self._notify(heard)  # with rejected and adjusted values

    def _act(self, message: Mapping[str, Any]) -> str:
        """Handle a browser message; returns a one-line error or an empty string."""
        try:
            if "command" in message:
                self._command(message["command"])
            else:
                self._edit(message["edit"], message["gesture"], message["held"])
        except AirlightError as error:
            return str(error)
        return ""

    def _edit(
        self, edit: Mapping[str, Value], gesture: str | None = None, held: bool = False
    ) -> None:
        """Apply a browser's edit, with the same undo steps as on a page."""
        known = self.session.values
        news = {path: edit[path] for path in edit if path in known and edit[path] != known[path]}
        view = {path: value for path, value in news.items() if path.startswith("view.")}
        if len(view) > 1 or (view and gesture is not None and gesture not in view):
            self.session.move(view, gesture=gesture or "", held=held)  # type: ignore[arg-type]
            news = {path: value for path, value in news.items() if path not in view}
        if held and gesture in news and self.session.dragged != gesture:
            self.session.begin_drag(str(gesture))
        for path, value in news.items():
            self.session.set(path, value)

    def _command(self, name: str) -> None:
        session = self.session
        commands: dict[str, Callable[[], object]] = {
            "undo": session.undo,
            "redo": session.redo,
            "reset": session.reset,
            "keep": session.store_b,
            "swap": session.swap,
            "rest": session.end_drag,
            "one camera": lambda: self._share_camera(True),
            "two cameras": lambda: self._share_camera(False),
        }
        commands[name]()

    def _share_camera(self, shared: bool) -> None:
        self.session.shares_camera = shared

    def _take_values(self, change: Mapping[str, Any]) -> None:
        """Apply values that were set on the widget."""
        if self._telling:
            return
        try:
            self._edit(change["new"])
            self.message = ""
        except AirlightError as error:
            self.message = str(error)
        self._notify()

    def _take_drawer(self, change: Mapping[str, Any]) -> None:
        """Prepare rendering in the kernel for a browser without GPU."""
        if change["new"] == "kernel":
            self._pictures.prepare(self._wake)

    def _take_wanted(self, change: Mapping[str, Any]) -> None:
        """Render the frame that the browser requests, once there is a solution."""
        wanted = change["new"]
        if not wanted:
            return
        solved = None if self._solving is None else self._solving.latest
        self._waiting = wanted if solved is None else {}
        if solved is None:
            return
        view = {**self.session.view, **wanted["view"]}
        width, height = wanted["size"]
        size = (int(width), int(height))
        self._pictures.ask(Order(int(wanted["number"]), solved.solution, view, size))
