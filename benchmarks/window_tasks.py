"""Tasks of a teacher and of an operator of a planetarium, done in the window by mouse and keys.

    python benchmarks/window_tasks.py                       # all, into a temporary folder
    python benchmarks/window_tasks.py sunset eclipse --pictures FOLDER

Each line has the task, its number of actions (clicks, keys, drags, typed words), the time from the
last of them to a finished picture, and what was reached. Windows are on displays of their own
(Xvfb, xdotool), in preview quality; each task leaves a picture of its window.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "tests" / "viewer"))

from driven_window import Driven, opened_window

from airlight.image.png import write_png

SIZE = (1100, 700)


class User:
    """Actions on a window, counted."""

    def __init__(self, window: Driven) -> None:
        self.window, self.actions = window, 0

    def key(self, name: str, repeat: int = 1) -> None:
        """Press a key over the picture."""
        self.actions += repeat
        left, top, width, height = self.window.ask("picture_place")
        at = int(left + 0.9 * width), int(top + 0.9 * height)
        self.window.mouse("mousemove", *at, "sleep", 0.1)
        for _ in range(repeat):
            self.window.mouse("key", name, "sleep", 0.15)

    def hold(self, name: str, seconds: float) -> None:
        """Hold a key."""
        self.actions += 1
        self.window.mouse("keydown", name, "sleep", seconds, "keyup", name)

    def click(self, name: str) -> None:
        """Click a control by its name."""
        self.actions += 1
        self.window.until(lambda: name in self.window.ask("controls"), of=name)
        self.window.click(name)
        self.window.ask("draws", 2)

    def slide(self, name: str, across: float) -> None:
        """Drag a slider."""
        self.actions += 1
        left, top, right, bottom = self.window.ask("place_of", name)
        y = int(0.5 * (top + bottom))
        self.window.press(left + 0.3 * (right - left), y)
        self.window.mouse("mousemove", int(left + across * (right - left)), y, "sleep", 0.3,
                          "mouseup", 1)  # fmt: skip

    def find(self, words: str) -> None:
        """Type into the search field."""
        self.actions += 1
        self.window.click("search")
        self.window.mouse("key", "ctrl+a", "type", "--delay", 30, words)
        self.window.ask("draws", 2)

    def type_into(self, name: str, text: str) -> None:
        """Type a number into a slider."""
        self.actions += 2
        at = self.window.ask("place_of", name)
        x, y = int(0.5 * (at[0] + at[2])), int(0.5 * (at[1] + at[3]))
        self.window.mouse("mousemove", x, y, "sleep", 0.2, "keydown", "ctrl", "sleep", 0.1,
                          "click", 1, "sleep", 0.1, "keyup", "ctrl", "sleep", 0.2)  # fmt: skip
        self.window.until(lambda: self.window.ask("typing"), of=name)
        self.window.mouse("key", "ctrl+a", "type", "--delay", 40, text)
        self.window.mouse("key", "Return")

    def type(self, text: str) -> None:
        """Replace the text of the field that has the focus, and confirm it."""
        self.actions += 2
        self.window.until(lambda: self.window.ask("typing"))
        self.window.mouse("key", "ctrl+a", "type", "--delay", 30, text)
        self.window.mouse("key", "Return")

    def click_picture(self) -> None:
        """Click the middle of the picture."""
        self.actions += 1
        left, top, width, height = self.window.ask("picture_place")
        at = int(left + 0.5 * width), int(top + 0.5 * height)
        self.window.mouse(
            "mousemove", *at, "sleep", 0.2, "mousedown", 1, "sleep", 0.1, "mouseup", 1
        )

    def choose_planet(self, name: str) -> None:
        """Choose a planet from the gallery."""
        self.key("g")
        self.window.until(lambda: self.window.ask("knows", name), of=name)
        while self.window.ask("place_of", name)[3] > SIZE[1] - 40:
            self.window.mouse("mousemove", SIZE[0] // 2, SIZE[1] // 2, "click", 5, "sleep", 0.2)
        self.click(name)

    def rest(self) -> float:
        """Wait for a finished picture; seconds."""
        begun = time.monotonic()
        assert self.window.ask("settled", 240.0), self.window.ask("state")
        return time.monotonic() - begun


def sunset(user: User, folder: Path) -> str:
    """Show the blue sunset of Mars at Gale crater."""
    user.choose_planet("mars")
    user.click("tab View")
    user.click("places")
    user.click("place Gale: Curiosity")
    user.key("7")
    return f"latitude {user.window.ask('value', 'view.latitude'):.2f}"


def whole(user: User, folder: Path) -> str:
    """Fly out until the whole Earth is seen, and come back."""
    before = user.window.ask("value", "view.altitude")
    user.key("Home")
    seconds = user.rest()
    far = user.window.ask("value", "view.altitude")
    user.key("ctrl+z")
    back = user.window.ask("value", "view.altitude")
    return f"{before / 1e3:.0f} km, {far / 1e3:.0f} km in {seconds:.1f} s, {back / 1e3:.0f} km"


def compare(user: User, folder: Path) -> str:
    """Compare Earth and Titan under the same sun."""
    user.key("b")
    user.choose_planet("titan")
    user.key("c")
    return f"side by side: {user.window.ask('open_parts')['compare']}"


def zenith(user: User, folder: Path) -> str:
    """Read the luminance of the sky at the zenith."""
    user.key("1")
    user.find("look zenith")
    user.type_into("view.look_zenith", "0")
    user.rest()
    user.click_picture()
    user.window.until(lambda: user.window.ask("probe_rows") and not user.window.ask("busy"), 120.0)
    rows = user.window.ask("probe_rows")
    return next((f"{k} {v}" for k, v in rows.items() if "cd" in v), str(rows)[:80])


def twilight(user: User, folder: Path) -> str:
    """Set date and place to this evening's twilight in Berlin."""
    user.click("tab View")
    user.click("places")
    user.click("place Berlin")
    user.key("1")
    user.click("date")
    user.click("day 21")
    user.find("hour")
    user.type_into("view.hour", "20.2")
    return f"sun {user.window.ask('value', 'view.sun_zenith'):.1f}° from the zenith"


def fisheye(user: User, folder: Path) -> str:
    """Save a fisheye picture of 2048 × 2048 pixels, the whole sky."""
    user.key("1")
    user.find("projection")
    at = user.window.ask("place_of", "view.projection")
    user.click("view.projection")
    user.actions += 1
    user.window.until(lambda: user.window.ask("lists"))
    y = int(at[3] + 10.0 + 20.0 * 1.4)
    user.window.mouse("mousemove", int(at[0] + 20), y, "sleep", 0.2, "mousemove", int(at[0] + 21),
                      y, "sleep", 0.1, "click", 1, "sleep", 0.3)  # fmt: skip
    user.key("ctrl+s")
    path = folder / "fisheye-sky.png"
    user.type(str(path))
    user.window.until(path.exists, 240.0)
    return f"{user.window.ask('value', 'view.projection')}, {path.stat().st_size / 1e3:.0f} kB"


def flight(user: User, folder: Path) -> str:
    """Record a flight and save it as a film file."""
    user.key("r")
    user.hold("w", 2.5)
    user.hold("Left", 1.0)
    user.key("r")
    user.click("tab Flight")
    user.click("save flight")
    return f"{user.window.ask('open_parts')['key frames']} key frames, {user.window.ask('error')}"


def dust(user: User, folder: Path) -> str:
    """Show more dust on Mars, and undo it."""
    user.choose_planet("mars")
    user.rest()
    user.find("dust")
    before = user.window.ask("value", "air.amounts[1]")
    user.slide("air.amounts[1]", 0.8)
    more, seconds = user.window.ask("value", "air.amounts[1]"), user.rest()
    user.key("ctrl+z")
    after = user.window.ask("value", "air.amounts[1]")
    return f"{before:.2f}, {more:.2f} in {seconds:.1f} s, {after:.2f}"


def link(user: User, folder: Path) -> str:
    """Copy a link, and open it in another window."""
    user.key("4")
    user.rest()
    before = user.window.picture_pixels()
    user.key("u")
    text = user.window.ask("clipboard")
    place = folder / "linked"
    place.mkdir()
    with opened_window(place, text, SIZE) as other:
        other.mouse("mousemove", 10, SIZE[1] - 3)
        other.ask("settled", 240.0)
        off = np.abs(other.picture_pixels() - before).mean()
    return f"{len(text)} characters, picture differs by {off:.2f}/255 in the mean"


def eclipse(user: User, folder: Path) -> str:
    """Find the Moon's eclipse, and let time run (opened as ``airlight view lunar-eclipse``)."""
    before = user.window.picture_pixels()
    hour = user.window.ask("value", "view.hour")
    user.key("t")
    time.sleep(4.0)
    user.key("t")
    seconds = user.rest()
    after = user.window.ask("value", "view.hour")
    off = np.abs(user.window.picture_pixels() - before).mean()
    return f"hour {hour:.2f} to {after:.2f}, {seconds:.1f} s, changed by {off:.1f}/255"


#: Tasks by name, with the planet or scene that the window begins with.
TASKS: dict[str, tuple[str, Callable[[User, Path], str]]] = {
    one.__name__: (start, one)
    for start, one in (
        ("earth", sunset), ("earth", whole), ("earth", compare), ("earth", zenith),
        ("earth", twilight), ("earth", fisheye), ("earth", flight), ("earth", dust),
        ("earth", link), ("lunar-eclipse", eclipse),
    )
}  # fmt: skip


def do(name: str, folder: Path) -> str:
    """Do a task in a window of its own; its line."""
    start, task = TASKS[name]
    place = folder / name
    place.mkdir(parents=True)
    begun = time.monotonic()
    with opened_window(place, start, SIZE) as window:
        opening, user = time.monotonic() - begun, User(window)
        try:
            words: Any = task(user, place)
            seconds = user.rest()
        except Exception as error:
            words, seconds = f"FAILED {type(error).__name__}: {str(error)[:300]}", float("nan")
        window.ask("draws", 2)
        write_png(folder / f"{name}.png", np.ascontiguousarray(window.pixels(), np.uint8), {})
        errors = window.log.read_text().strip()
    line = f"{name:9} {user.actions:3d} actions, opened in {opening:5.1f} s, rest {seconds:5.1f} s"
    return f"{line}: {words}{' STDERR ' + errors[-300:] if errors else ''}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("tasks", nargs="*", default=list(TASKS), metavar="TASK")
    parser.add_argument("--pictures", type=Path, help="folder for pictures of the windows")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as spare:
        folder = asked.pictures or Path(spare)
        for name in asked.tasks:
            print(do(name, folder), flush=True)


if __name__ == "__main__":
    main()
