"""Mouse and keys on the picture, where no panel is in the way, as words of what to do."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final, Protocol

from airlight.viewer.navigation.flight import Flight
from airlight.viewer.window.picture_area import PictureArea, Rectangle

#: Buttons of the mouse.
_LEFT, _RIGHT = 1, 2
#: Of the wheel, per notch.
_NOTCH: Final = 100.0
#: A press that moves less than this is a click. [logical pixel]
_CLICK: Final = 3.0

#: How many notches one counts for with the shift key.
_FAST: Final = 4.0
#: Keys that do something once: with modifiers in front, in alphabetical order.
SHORTCUTS: Final[Mapping[str, str]] = {
    "Control+z": "undo",
    "Control+y": "redo",
    "Control+Shift+z": "redo",
    "Control+s": "save picture",
    "Control+Shift+s": "save planet",
    "Control+q": "close",
    "F1": "help",
    "h": "help",
    "Escape": "leave",
    "Tab": "panels",
    "p": "probe",
    "b": "keep as b",
    "c": "compare",
    "v": "swap",
    "t": "time",
    "x": "automatic exposure",
    "=": "brighter",
    "+": "brighter",
    "Shift+=": "brighter",
    "Shift++": "brighter",
    "-": "darker",
    "1": "place 1",
    "2": "place 2",
    "3": "place 3",
    "4": "place 4",
    "5": "place 5",
}


class Deeds(Protocol):
    """What the mouse and the keys can do."""

    area: PictureArea

    @property
    def covered(self) -> bool:
        """Whether something lies over the picture that takes the mouse."""

    def picture_rectangle(self) -> Rectangle:
        """Where the picture lies."""

    def attempt(self, edit: Callable[[], object]) -> None:
        """Do something; if it cannot be, say so."""

    def click(self, x: float, y: float) -> None:
        """A point of the window was clicked. [logical pixel]"""

    def do(self, deed: str) -> None:
        """One of the values of ``SHORTCUTS``."""


class WindowInput:
    """Listens to a canvas.

    Parameters
    ----------
    canvas : rendercanvas canvas
    deeds : Deeds
        Told what to do.
    flight : Flight
        Told how to fly.
    typing : callable
        Whether the user is typing into a field.
    """

    def __init__(
        self, canvas: Any, deeds: Deeds, flight: Flight, typing: Callable[[], bool]
    ) -> None:
        self._deeds = deeds
        self._flight = flight
        self._typing = typing
        self._at = (0.0, 0.0)
        self._pressed_at = (0.0, 0.0)
        self._drag = ""
        # Releases count wherever they happen, before the panels see them.
        canvas.add_event_handler(self._release, "pointer_up", "key_up", order=-500)
        # Where the picture is bare is known here at once; ImGui knows it a frame later.
        canvas.add_event_handler(self._press, "pointer_down", order=-500)
        canvas.add_event_handler(self._move, "pointer_move", order=-500)
        canvas.add_event_handler(self._wheel, "wheel", order=-500)
        canvas.add_event_handler(self._key, "key_down")

    def _press(self, event: Mapping[str, Any]) -> None:
        x, y = event["x"], event["y"]
        rectangle = self._deeds.picture_rectangle()
        if self._deeds.covered or not rectangle.holds(x, y):
            return
        self._at = self._pressed_at = (x, y)
        if event["button"] == _LEFT:
            self._drag = "divider" if self._deeds.area.grab(x, y, rectangle) else "look"
            if "Control" in event.get("modifiers", ()):
                self._drag = "sun"
        elif event["button"] == _RIGHT:
            self._drag = "sun"

    def _move(self, event: Mapping[str, Any]) -> None:
        x, y = event["x"], event["y"]
        right, down = x - self._at[0], y - self._at[1]
        self._at = (x, y)
        if not self._drag:
            return
        rectangle = self._deeds.picture_rectangle()
        parts = right / rectangle.width, down / rectangle.width
        if self._drag == "divider":
            self._deeds.area.drag(x, rectangle)
        elif self._drag == "look":
            self._deeds.attempt(lambda: self._flight.look(*parts))
        elif self._drag == "sun":
            self._deeds.attempt(lambda: self._flight.drag_sun(*parts))

    def _release(self, event: Mapping[str, Any]) -> None:
        if event["event_type"] == "key_up":
            self._flight.release(str(event["key"]))
            return
        drag, self._drag = self._drag, ""
        self._deeds.area.release()
        moved = abs(event["x"] - self._pressed_at[0]) + abs(event["y"] - self._pressed_at[1])
        if drag == "look" and moved < _CLICK:
            self._deeds.click(event["x"], event["y"])

    def _wheel(self, event: Mapping[str, Any]) -> None:
        bare = not self._deeds.covered
        if bare and self._deeds.picture_rectangle().holds(event["x"], event["y"]):
            notches = -event["dy"] / _NOTCH
            notches *= _FAST if "Shift" in event.get("modifiers", ()) else 1.0
            self._deeds.attempt(lambda: self._flight.wheel(notches))

    def _key(self, event: Mapping[str, Any]) -> None:
        if self._typing():
            return
        key = str(event["key"])
        modifiers = set(event.get("modifiers", ()))
        if len(key) == 1:
            key = key.lower()
        if "Control" not in modifiers and self._flight.press(key):
            return
        words = [one for one in ("Control", "Shift") if one in modifiers and one != key]
        deed = SHORTCUTS.get("+".join([*words, key]))
        if deed is not None:
            self._deeds.do(deed)
