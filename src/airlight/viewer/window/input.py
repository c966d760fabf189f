"""Mouse and key events on the picture, outside the panels, mapped to actions."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, Final, Protocol

from airlight.viewer.navigation.flight import Flight
from airlight.viewer.navigation.keys import FACTORS, ONCE, RATES, chord
from airlight.viewer.window.picture_area import PictureArea, Rectangle

#: Mouse buttons.
_LEFT, _RIGHT = 1, 2
#: Modifier keys with which any drag moves the sun.
_SUN: Final = frozenset({"Control", "Shift"})


class Host(Protocol):
    """Target of the mouse and the keys."""

    area: PictureArea

    @property
    def covered(self) -> bool:
        """Whether an overlay on the picture captures the mouse."""

    def picture_rectangle(self) -> Rectangle:
        """Rectangle of the picture. [logical pixel]"""

    def attempt(self, edit: Callable[[], object]) -> None:
        """Run an edit; an error is shown in the window."""

    def click(self, x: float, y: float) -> None:
        """Handle a click at a point of the window. [logical pixel]"""

    def do(self, action: str) -> None:
        """Perform an action, one of the values of ``keys.ONCE``."""


class WindowInput:
    """Event handlers of a canvas.

    Parameters
    ----------
    canvas : rendercanvas canvas
        Canvas whose events are handled.
    host : Host
        Target of actions and clicks.
    flight : Flight
        Target of movements.
    typing : callable
        Function that returns whether the user is typing into a field.
    """

    def __init__(self, canvas: Any, host: Host, flight: Flight, typing: Callable[[], bool]) -> None:
        self._host = host
        self._flight = flight
        self._typing = typing
        self._at = (0.0, 0.0)
        self._pressed_at = (0.0, 0.0)
        self._drag = ""
        # Releases are handled everywhere, before the panels receive them.
        canvas.add_event_handler(self._release, "pointer_up", "key_up", order=-500)
        # The uncovered part of the picture is known here at once, in ImGui a frame later.
        canvas.add_event_handler(self._press, "pointer_down", order=-500)
        canvas.add_event_handler(self._move, "pointer_move", order=-500)
        canvas.add_event_handler(self._wheel, "wheel", order=-500)
        # ImGui captures the keys in the frame after a click, and would keep them.
        canvas.add_event_handler(self._key, "key_down", order=-500)

    def _press(self, event: Mapping[str, Any]) -> None:
        x, y = event["x"], event["y"]
        rectangle = self._host.picture_rectangle()
        if self._host.covered or not rectangle.holds(x, y):
            return
        self._at = self._pressed_at = (x, y)
        if event["button"] == _LEFT:
            self._drag = "divider" if self._host.area.grab(x, y, rectangle) else "look"
            if _SUN & set(event.get("modifiers", ())):
                self._drag = "sun"
        elif event["button"] == _RIGHT:
            self._drag = "sun"

    def _move(self, event: Mapping[str, Any]) -> None:
        x, y = event["x"], event["y"]
        right, down = x - self._at[0], y - self._at[1]
        self._at = (x, y)
        if not self._drag:
            return
        rectangle = self._host.picture_rectangle()
        parts = right / rectangle.width, down / rectangle.width
        if self._drag == "divider":
            self._host.area.drag(x, rectangle)
        elif self._drag == "look":
            self._host.attempt(lambda: self._flight.look(*parts))
        elif self._drag == "sun":
            self._host.attempt(lambda: self._flight.drag_sun(*parts))

    def _release(self, event: Mapping[str, Any]) -> None:
        if event["event_type"] == "key_up":
            self._flight.release(str(event["key"]))
            return
        self._move(event)  # the last movement of a drag arrives with its release
        drag, self._drag = self._drag, ""
        self._host.area.release()
        if drag:
            self._flight.rest()
        moved = abs(event["x"] - self._pressed_at[0]) + abs(event["y"] - self._pressed_at[1])
        if drag == "look" and moved < RATES["click"]:
            self._host.click(event["x"], event["y"])

    def _wheel(self, event: Mapping[str, Any]) -> None:
        bare = not self._host.covered
        if not bare or not self._host.picture_rectangle().holds(event["x"], event["y"]):
            return
        modifiers = event.get("modifiers", ())
        notches = -event["dy"] / RATES["wheel"]
        if "Control" in modifiers:
            self._host.attempt(lambda: self._flight.widen(-notches))
            return
        for name in ("Shift", "Alt"):
            notches *= FACTORS[name.lower()] if name in modifiers else 1.0
        self._host.attempt(lambda: self._flight.wheel(notches))

    def _key(self, event: Mapping[str, Any]) -> None:
        if self._typing():
            return
        key = str(event["key"])
        modifiers = set(event.get("modifiers", ())) - {key}
        control = "Control" in modifiers
        if not control and self._flight.press(key):
            return
        action = ONCE.get(chord(key, control=control, shift="Shift" in modifiers))
        if action is not None and "Alt" not in modifiers:
            self._host.do(action)
