"""Mouse and keys on the picture, where no panel is in the way, as words of what to do."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final, Protocol

from airlight.viewer.picture_area import PictureArea, Rectangle

#: Buttons of the mouse.
_LEFT, _RIGHT = 1, 2
#: Of the wheel, per notch.
_NOTCH: Final = 100.0
#: A press that moves less than this is a click. [logical pixel]
_CLICK: Final = 3.0

#: Keys that fly as long as they are held.
FLYING: Final = frozenset("wasdqe")
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

    def picture_rectangle(self) -> Rectangle:
        """Where the picture lies."""

    def turn(self, right: float, down: float) -> None:
        """Look so far aside. [logical pixel]"""

    def move_sun(self, right: float, down: float) -> None:
        """Move the sun so far across the picture. [logical pixel]"""

    def approach(self, notches: float, *, fast: bool) -> None:
        """Go closer to the ground, or away from it."""

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
    typing : callable
        Whether the user is typing into a field.
    """

    def __init__(self, canvas: Any, deeds: Deeds, typing: Callable[[], bool]) -> None:
        self._deeds = deeds
        self._typing = typing
        self.held: set[str] = set()
        self.fast = False
        self._at = (0.0, 0.0)
        self._pressed_at = (0.0, 0.0)
        self._drag = ""
        # Releases count wherever they happen, before the panels see them.
        canvas.add_event_handler(self._release, "pointer_up", "key_up", order=-500)
        canvas.add_event_handler(self._press, "pointer_down")
        canvas.add_event_handler(self._move, "pointer_move", order=-500)
        canvas.add_event_handler(self._wheel, "wheel")
        canvas.add_event_handler(self._key, "key_down")

    @property
    def dragging(self) -> bool:
        """Whether the picture is being dragged."""
        return bool(self._drag)

    def _press(self, event: Mapping[str, Any]) -> None:
        x, y = event["x"], event["y"]
        rectangle = self._deeds.picture_rectangle()
        if not rectangle.holds(x, y):
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
        if self._drag == "divider":
            self._deeds.area.drag(x, self._deeds.picture_rectangle())
        elif self._drag == "look":
            self._deeds.turn(right, down)
        elif self._drag == "sun":
            self._deeds.move_sun(right, down)

    def _release(self, event: Mapping[str, Any]) -> None:
        if event["event_type"] == "key_up":
            key = str(event["key"])
            self.held.discard(key.lower())
            self.fast = self.fast and key != "Shift"
            return
        drag, self._drag = self._drag, ""
        self._deeds.area.release()
        moved = abs(event["x"] - self._pressed_at[0]) + abs(event["y"] - self._pressed_at[1])
        if drag == "look" and moved < _CLICK:
            self._deeds.click(event["x"], event["y"])

    def _wheel(self, event: Mapping[str, Any]) -> None:
        if self._deeds.picture_rectangle().holds(event["x"], event["y"]):
            fast = "Shift" in event.get("modifiers", ())
            self._deeds.approach(-event["dy"] / _NOTCH, fast=fast)

    def _key(self, event: Mapping[str, Any]) -> None:
        if self._typing():
            return
        key = str(event["key"])
        modifiers = set(event.get("modifiers", ()))
        self.fast = "Shift" in modifiers or key == "Shift"
        if len(key) == 1:
            key = key.lower()
        if key in FLYING and "Control" not in modifiers:
            self.held.add(key)
            return
        words = [one for one in ("Control", "Shift") if one in modifiers and one != key]
        deed = SHORTCUTS.get("+".join([*words, key]))
        if deed is not None:
            self._deeds.do(deed)
