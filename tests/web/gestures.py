"""Random gestures on a page by mouse, wheel and keys, or by fingers, repeatable by a seed.

The viewer is the global ``airlight`` of the page.
"""

from __future__ import annotations

import random
from typing import Any

from waiting import until

from airlight.viewer.navigation.keys import as_json

_TABLE = as_json("page")
#: Keys of the table, and others that sliders, lists and fields know; Playwright's names.
KEYS = (
    *(key for key in _TABLE["once"] if "++" not in key and key != "+"),
    *(key for key in _TABLE["held"] if len(key) == 1),
    "ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "PageUp", "PageDown", "Home", "End",
    "Enter", "Space", "Shift+Tab", "Backspace", "Delete", "7", "z", "ö",
)  # fmt: skip

#: Rectangle of the viewer within the page: left, top, width, height. [pixel]
_PLACE = """() => {
  airlight.parts.root.scrollIntoView({ block: "nearest" });
  const { left, top, width, height } = airlight.parts.root.getBoundingClientRect();
  return [left, top, width, height];
}"""
#: Whether a point is the viewer's.
_HELD = "([x, y]) => airlight.parts.root.contains(document.elementFromPoint(x, y))"
#: Whether the keyboard focus is in the viewer; elsewhere keys belong to its host.
_FOCUSED = "airlight.parts.root.contains(document.activeElement)"


class Gestures:
    """Gestures of a seed on a page.

    Parameters
    ----------
    page : playwright page
    seed : int
    host : bool
        Whether the viewer is a part of a page with menus of its own, which a right click on the
        panel opens; a right click then falls on the picture.
    """

    def __init__(self, page: Any, seed: int, *, host: bool = False) -> None:
        self.page, self.chance, self.host = page, random.Random(seed), host

    def by_mouse(self, count: int) -> None:
        """Click, drag, turn the wheel and press keys, anywhere on the viewer."""
        acts = (self._click, self._drag, self._wheel, self._key)
        for act in self.chance.choices(acts, (0.55, 0.15, 0.1, 0.2), k=count):
            act()
            if self.chance.random() < 0.3:
                self._press("Escape")

    def by_fingers(self, count: int) -> None:
        """Tap, swipe and pinch, anywhere on the viewer."""
        touches = self.page.context.new_cdp_session(self.page)
        for fingers in self.chance.choices((0, 1, 2), (0.6, 0.25, 0.15), k=count):
            if fingers == 0:
                self.page.touchscreen.tap(*self._point())
            else:
                self._slide(touches, fingers)
        touches.detach()

    def _point(self) -> tuple[float, float]:
        """Point of the viewer that its host neither covers nor has scrolled away."""
        for _ in range(100):
            left, top, width, height = self.page.evaluate(_PLACE)
            x = left + 1.0 + self.chance.random() * (width - 2.0)
            y = top + 1.0 + self.chance.random() * (height - 2.0)
            if self.page.evaluate(_HELD, [x, y]):
                return x, y
        raise AssertionError("the viewer is out of sight")

    def _click(self) -> None:
        x, y = self._point()
        button = self.chance.choice(("left", "left", "left", "right"))
        on = self.page.evaluate("([x, y]) => document.elementFromPoint(x, y)?.tagName", [x, y])
        if self.host and on != "CANVAS":
            button = "left"
        self.page.mouse.click(x, y, button=button, click_count=self.chance.choice((1, 1, 1, 2)))

    def _drag(self) -> None:
        self.page.mouse.move(*self._point())
        self.page.mouse.down()
        self.page.mouse.move(*self._point(), steps=3)
        self.page.mouse.up()

    def _wheel(self) -> None:
        self.page.mouse.move(*self._point())
        self.page.mouse.wheel(0, self.chance.choice((-300, 300)))

    def _key(self) -> None:
        self._press(self.chance.choice(KEYS))

    def _press(self, key: str) -> None:
        if not self.page.evaluate(_FOCUSED):
            return
        if key.isascii():
            self.page.keyboard.press(key)
        else:  # Playwright has no such key
            self.page.keyboard.type(key)

    def _slide(self, touches: Any, fingers: int) -> None:
        starts, ends = ([self._point() for _ in range(fingers)] for _ in range(2))
        slide(touches, starts, ends)


def slide(touches: Any, starts: list[tuple[float, float]], ends: list[tuple[float, float]]) -> None:
    """Slide fingers in straight lines, by a session of Chromium's protocol."""
    for step in range(5):
        points = [
            {"x": a + 0.25 * step * (c - a), "y": b + 0.25 * step * (d - b), "id": index}
            for index, ((a, b), (c, d)) in enumerate(zip(starts, ends, strict=True))
        ]
        kind = "touchMove" if step else "touchStart"
        touches.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": points})
    touches.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})


#: What Escape closes, by name, while it is open.
_OPEN = """() => {
  const { help, root, search } = airlight.parts;
  const open = {
    help: !help.hidden,
    menu: root.querySelector(".airlight-menu").open,
    "hidden panel": root.classList.contains("airlight-hidden"),
    search: search.value !== "",
    fullscreen: document.fullscreenElement !== null,
  };
  return Object.keys(open).filter((name) => open[name]);
}"""


def close_all(page: Any) -> None:
    """Close by Escape whatever is open, and by their keys a film and the passing of time."""
    page.evaluate("airlight.parts.canvas.focus({ preventScroll: true })")
    for _ in range(12):  # several presses each: one leaves a field, the next clears it
        if not page.evaluate(_OPEN):
            break
        page.keyboard.press("Escape")
        page.wait_for_timeout(100)
    assert page.evaluate(_OPEN) == []
    for running, key in (("airlight.film !== null", "o"), ("airlight.flight.playing", "t")):
        page.evaluate("airlight.parts.canvas.focus({ preventScroll: true })")
        if page.evaluate(running):
            page.keyboard.press(key)
            until(page, f"!({running})")


#: Faults of the viewer: its message, a lost device, values or light that are not numbers.
_FAULTS = """async () => {
  const { parts, device, state, picture } = airlight;
  const faults = [];
  if (parts.message.textContent) faults.push(parts.message.textContent);
  if (device.gl?.isContextLost()) faults.push("the context is lost");
  for (const [path, value] of Object.entries(state.values)) {
    if (typeof value === "number" && !Number.isFinite(value)) faults.push(`${path} is ${value}`);
  }
  if (picture.program) {
    const light = await airlight.alone(() => picture.program.read("picture"));
    if (!light.every(Number.isFinite)) faults.push("light that is not a number");
    if (!light.some((one) => one > 0)) faults.push("no light");
  }
  return faults;
}"""


def assert_sound(page: Any) -> None:
    """Assert that the picture is drawn, of finite light, and that nothing is complained of."""
    page.evaluate("airlight.settled()")
    assert page.evaluate(_FAULTS) == []
