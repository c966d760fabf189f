"""Actions of the window's keys and buttons, by the names of ``navigation.keys``."""

from __future__ import annotations

from collections.abc import Callable

from airlight.errors import ConflictError
from airlight.viewer.navigation.flight_recorder import FlightRecorder
from airlight.viewer.navigation.keys import RATES
from airlight.viewer.navigation.viewpoints import VIEWPOINTS, Viewpoint, home_view, view_in
from airlight.viewer.painting.picture_source import Picture
from airlight.viewer.session.saved_state import to_fragment
from airlight.viewer.session.session import Session
from airlight.viewer.window.canvas import Canvas
from airlight.viewer.window.messages import Messages
from airlight.viewer.window.panels.save import SaveDialog
from airlight.viewer.window.panels.side import SidePanel


class Actions:
    """Actions by name.

    Parameters
    ----------
    panel : SidePanel
        Panel with the switches of time, probe and comparison.
    shown : callable
        Function that returns the picture of the edited side, or None.
    canvas : Canvas
        Canvas that is closed, fills the screen, and has a clipboard.
    close_popups : callable
        Function that closes popup lists and menus; returns whether there were any.
    gallery : callable
        Function that opens the gallery of planets.
    recorder : FlightRecorder
        Flight that is recorded and played.

    Attributes
    ----------
    shows_panels, shows_help : bool
        Whether the panels are visible, and whether the help is shown over the picture.
    """

    def __init__(
        self,
        session: Session,
        panel: SidePanel,
        dialog: SaveDialog,
        messages: Messages,
        shown: Callable[[], Picture | None],
        canvas: Canvas,
        close_popups: Callable[[], bool],
        gallery: Callable[[], None],
        recorder: FlightRecorder,
    ) -> None:
        self._session = session
        self._panel = panel
        self._dialog = dialog
        self._messages = messages
        self._shown = shown
        self._canvas = canvas
        self._close_popups = close_popups
        self.shows_panels = True
        self.shows_help = False
        self._known: dict[str, Callable[[], object]] = {
            "undo": session.undo,
            "redo": session.redo,
            "reset": session.reset,
            "save picture": lambda: dialog.ask("picture"),
            "save planet": lambda: dialog.ask("planet"),
            "film": lambda: dialog.ask("film"),
            "copy link": self._copy_link,
            "fullscreen": canvas.toggle_fullscreen,
            "close": canvas.close,
            "gallery": gallery,
            "home": self._go_home,
            "record": recorder.toggle_recording,
            "play": recorder.toggle_playing,
            "key frame": recorder.add,
            "help": self._toggle_help,
            "leave": self._leave,
            "panels": self._toggle_panels,
            "probe": self._toggle_probe,
            "keep as b": self._keep_as_b,
            "compare": self._toggle_comparison,
            "swap": session.swap,
            "time": self._toggle_time,
            "automatic exposure": self._toggle_exposure,
            "brighter": lambda: self._expose(RATES["stop"]),
            "darker": lambda: self._expose(-RATES["stop"]),
        }
        for number, viewpoint in enumerate(VIEWPOINTS, 1):
            self._known[f"viewpoint {number}"] = lambda one=viewpoint: self._go(one)  # type: ignore[misc]

    def do(self, action: str) -> None:
        """Perform an action; an error is shown in the window."""
        self._messages.attempt(self._known[action])

    def _go(self, viewpoint: Viewpoint) -> None:
        view = view_in(self._session, viewpoint)
        self._session.change_view(f"viewpoint {viewpoint.name}", view)

    def _go_home(self) -> None:
        self._session.change_view("home", home_view(self._session))

    def _toggle_help(self) -> None:
        self.shows_help = not self.shows_help

    def _toggle_panels(self) -> None:
        self.shows_panels = not self.shows_panels

    def _toggle_probe(self) -> None:
        if self._session.around is not None:
            raise ConflictError("probe", "is not available for a scene of several bodies")
        self._panel.probes = not self._panel.probes

    def _toggle_time(self) -> None:
        self._panel.plays = not self._panel.plays

    def _leave(self) -> None:
        """Close the topmost open dialog or overlay."""
        if self._close_popups():
            return
        if self._dialog.asks:
            self._dialog.asks = ""
        elif self.shows_help:
            self.shows_help = False
        elif not self.shows_panels:
            self.shows_panels = True
        elif self._panel.searched:
            self._panel.search("")
        elif self._canvas.fullscreen:
            self._canvas.toggle_fullscreen()

    def _copy_link(self) -> None:
        if self._session.around is not None:
            raise ConflictError("copy link", "is not available for a scene of several bodies")
        link = f"#{to_fragment(self._session.to_state())}"
        self._canvas.copy(link)
        self._messages.say("copied: put it behind a page's address, or airlight view '…'")

    def _keep_as_b(self) -> None:
        self._session.store_b()
        self._messages.say("kept as B: C shows both side by side, V changes them over")

    def _toggle_comparison(self) -> None:
        if not self._panel.compares and not self._session.has_other:
            self._session.store_b()
        self._panel.compares = not self._panel.compares

    def _toggle_exposure(self) -> None:
        automatic = bool(self._session.view["display.automatic"])
        shown = self._shown()
        # The picture keeps its brightness when automatic exposure is switched off.
        exposure = shown.exposure if automatic and shown is not None else 0.0
        view = {"display.automatic": not automatic, "display.exposure": exposure}
        self._session.change_view("automatic exposure", view)

    def _expose(self, stops: float) -> None:
        exposure = float(self._session.view["display.exposure"])
        self._session.set("display.exposure", exposure + stops)
