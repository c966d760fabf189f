"""Random mouse, wheel and keys on a real window, whose picture is compared with the CPU's.

The window runs in a process and on a display of its own. After some events it rests, and what is
open is closed by keys; then its display shows the picture of the state that it exports.
"""

from __future__ import annotations

import random
import string
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from shown_state import expected, facts, fault_of, save
from tally import Tally

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "viewer"))

from driven_window import Driven, opened_window

from airlight.viewer.gallery.presets import PRESETS
from airlight.viewer.navigation.keys import HELD, ONCE

SIZE = (900, 560)
#: Times until a frame answers an input: slow, dead. Longest until a picture is finished. [s]
SLOW, ANSWER, FINISH = 10.0, 120.0, 240.0
#: Number of events between two comparisons.
TOGETHER = 25
#: Names of X11 keys by the names of the table of keys.
_X11 = {
    "+": "plus", "-": "minus", "=": "equal", "arrowup": "Up", "arrowdown": "Down",
    "arrowleft": "Left", "arrowright": "Right", "pageup": "Prior", "pagedown": "Next",
    "Control": "ctrl", "Shift": "shift",
}  # fmt: skip
#: Words that are searched for.
WORDS = ("dust", "haze", "ozone", "sun", "exposure", "field", "quality", "ground", "xyz", "")


def x11(chord: str) -> str:
    """Key of the table with its modifiers, as xdotool spells it."""
    parts = chord.replace("++", "+plus").split("+") if chord != "+" else [chord]
    return "+".join(_X11.get(one, one) for one in parts)


#: Keys of the table but the one that closes the window, by what they do.
KEYS = {x11(key): word for key, word in ONCE.items() if word != "close"}


class WindowEvents:
    """Events of a seed on a window."""

    def __init__(self, window: Driven, seed: int, log: Callable[[str], None]) -> None:
        self.window, self.chance, self.log = window, random.Random(seed), log
        self.answers: list[float] = []
        self.acts = {
            self.control: 0.27, self.slide: 0.12, self.anywhere: 0.08, self.key: 0.16,
            self.hold: 0.1, self.wheel: 0.08, self.drag: 0.08, self.undo: 0.03,
            self.planet: 0.03, self.size: 0.015, self.save: 0.015, self.search: 0.02,
        }  # fmt: skip

    # --- events -------------------------------------------------------------------------------

    def act(self) -> str:
        """Perform an event; returns what it was. The time to the next frame is kept."""
        (one,) = self.chance.choices(list(self.acts), list(self.acts.values()))
        before, words = self.window.ask("frames"), one()
        begun, told = time.monotonic(), False
        while self.window.ask("frames") == before and time.monotonic() - begun < ANSWER:
            time.sleep(0.01)
            if not told and time.monotonic() - begun > SLOW:
                told = True
                self.log(f"slow: {words}; {self.window.ask('stack')}")
        self.answers.append(time.monotonic() - begun)
        return words

    def _within(self, place: list[float], across: float) -> tuple[int, int]:
        left, top, right, bottom = place
        return int(left + across * (right - left)), int(0.5 * (top + bottom))

    def _picture(self) -> tuple[int, int]:
        left, top, width, height = self.window.ask("picture_place")
        return (
            int(left + (0.02 + 0.96 * self.chance.random()) * width),
            int(top + (0.02 + 0.96 * self.chance.random()) * height),
        )

    def control(self) -> str:
        places = self.window.ask("controls")
        name = self.chance.choice(sorted(places))
        at = self._within(places[name], self.chance.random())
        self.window.mouse("mousemove", *at, "sleep", 0.1, "click", 1)
        return f"click {name}"

    def slide(self) -> str:
        places = {k: v for k, v in self.window.ask("controls").items() if "." in k}
        if not places:
            return self.anywhere()
        name = self.chance.choice(sorted(places))
        words: list[Any] = ["mousemove", *self._within(places[name], self.chance.random())]
        words += ["sleep", 0.1, "mousedown", 1]
        for _ in range(self.chance.randrange(2, 9)):
            at = self._within(places[name], self.chance.random())
            words += ["sleep", 0.1, "mousemove", *at]
        self.window.mouse(*words, "sleep", 0.1, "mouseup", 1)
        return f"slide {name}"

    def anywhere(self) -> str:
        left, top, width, height = self.window.ask("picture_place")
        at = self.chance.randrange(int(left + width)), self.chance.randrange(int(top + height))
        button = self.chance.choice((1, 1, 1, 3))
        self.window.mouse("mousemove", *at, "sleep", 0.1, "click", button)
        return f"click {at} with {button}"

    def key(self) -> str:
        name = self.chance.choice(sorted(KEYS))
        self.window.mouse("mousemove", *self._picture(), "sleep", 0.1, "key", name)
        return f"key {name}"

    def hold(self) -> str:
        name = self.chance.choice([_X11.get(one, one) for one in HELD])
        seconds = round(self.chance.uniform(0.1, 1.5), 2)
        with_key = self.chance.choice(([], [], [], ["shift"], ["alt"]))
        words = [*(w for m in with_key for w in ("keydown", m)), "keydown", name, "sleep", seconds]
        words += ["keyup", name, *(w for m in with_key for w in ("keyup", m))]
        self.window.mouse(*words)
        return f"hold {'+'.join([*with_key, name])} for {seconds} s"

    def wheel(self) -> str:
        button, count = self.chance.choice((4, 5)), self.chance.randrange(1, 16)
        with_key = self.chance.choice(([], [], [], ["shift"], ["ctrl"]))
        words: list[Any] = ["mousemove", *self._picture(), "sleep", 0.1]
        words += [w for m in with_key for w in ("keydown", m)]
        words += ["click", "--repeat", count, "--delay", 40, button]
        self.window.mouse(*words, *(w for m in with_key for w in ("keyup", m)))
        return f"wheel {'+'.join([*with_key, str(button)])} {count} times"

    def drag(self) -> str:
        button = self.chance.choice((1, 1, 3))
        words: list[Any] = ["mousemove", *self._picture(), "sleep", 0.1, "mousedown", button]
        for _ in range(self.chance.randrange(1, 8)):
            words += ["sleep", 0.05, "mousemove", *self._picture()]
        self.window.mouse(*words, "sleep", 0.05, "mouseup", button)
        return f"drag with {button}"

    def undo(self) -> str:
        count, key = self.chance.randrange(1, 8), self.chance.choice(("z", "z", "y"))
        self.window.mouse("mousemove", *self._picture(), "sleep", 0.1, "key", "--repeat", count,
                          "--delay", 80, f"ctrl+{key}")  # fmt: skip
        return f"ctrl+{key} {count} times"

    def planet(self) -> str:
        self.window.mouse("mousemove", *self._picture(), "sleep", 0.1, "key", "g", "sleep", 0.5)
        for _ in range(self.chance.randrange(4)):
            self.window.mouse("click", 5, "sleep", 0.2)
        names = {one.name for one in PRESETS}
        places = {k: v for k, v in self.window.ask("controls").items() if k in names}
        if not places:
            self.window.mouse("key", "Escape")
            return "gallery, closed"
        name = self.chance.choice(sorted(places))
        self.window.mouse("mousemove", *self._within(places[name], 0.5), "sleep", 0.1, "click", 1)
        return f"gallery {name}"

    def size(self) -> str:
        width, height = self.chance.randrange(500, SIZE[0] + 1), self.chance.randrange(400, SIZE[1])
        self.window.mouse("search", "--name", "airlight", "windowsize", width, height)
        return f"resize to {width} x {height}"

    def save(self) -> str:
        name = f"{''.join(self.chance.choices(string.ascii_lowercase, k=6))}.png"
        self.window.mouse(
            "mousemove", *self._picture(), "sleep", 0.1, "key", "ctrl+s", "sleep", 0.5
        )
        self.window.mouse("key", "ctrl+a", "type", "--delay", 40, name)
        self.window.mouse("key", "Return", "sleep", 0.3)
        return f"save {name}"

    def search(self) -> str:
        places = self.window.ask("controls")
        if "search" not in places:
            return self.key()
        word = self.chance.choice(WORDS)
        self.window.mouse(
            "mousemove", *self._within(places["search"], 0.5), "sleep", 0.1, "click", 1
        )
        self.window.mouse("sleep", 0.2,
                          "key", "ctrl+a", "key", "BackSpace")  # fmt: skip
        if word:
            self.window.mouse("type", "--delay", 50, word)
        return f"search {word!r}"

    # --- rest ---------------------------------------------------------------------------------

    def close_all(self) -> None:
        """Close by keys what covers the picture, and stop what moves."""
        for _ in range(5):
            self.window.mouse("mousemove", SIZE[0] - 2, 2, "key", "Escape", "sleep", 0.2)
        for part, key in (("time", "t"), ("compare", "c"), ("records", "r"), ("plays", "shift+r"),
                          ("probe", "p"), ("help", "h")):  # fmt: skip
            for _ in range(3):
                if not self.window.ask("open_parts")[part]:
                    break
                self.window.mouse("key", key, "sleep", 0.3)
        left, top, width, height = self.window.ask("picture_place")
        self.window.mouse("mousemove", int(left + width) - 1, int(top + height) + 5)

    def compare(self, pictures: Path | None) -> tuple[str, str]:
        """Let the window rest; class of what is wrong with its picture, and figures.

        A wrong picture, and that of the CPU below it, go to the file ``pictures``.
        """
        self.close_all()
        begun = time.monotonic()
        settled = self.window.ask("settled", FINISH)
        seconds = time.monotonic() - begun
        time.sleep(1.5)  # hints fade
        draws, state = self.window.ask("draws", 3), self.window.ask("state")
        if state["error"]:
            self.window.mouse("key", "ctrl+z", "sleep", 0.3)
            return "refused", state["error"]
        if not (settled and draws):
            words = f"{seconds:.0f} s, frames {draws}; {facts(state)}; {self.window.ask('stack')}"
            return "unfinished", words
        left, top, width, height = (round(one) for one in self.window.ask("picture_place"))
        shown = self.window.pixels()[top : top + height, left : left + width].astype(float)
        try:
            view = tuple(sorted(state["view"].items()))
            wanted = expected(state["link"], tuple(state["size"]), state["exposure"] >= 3.0, view)
        except Exception as error:
            return "link", f"{type(error).__name__}: {error}; {facts(state)}"
        picture = wanted.picture(state["exposure"])
        fault, figures = fault_of(shown, picture)
        automatic = wanted.session.view["display.automatic"] and not state["held"]
        off = abs(state["exposure"] - wanted.exposure)
        if not fault and automatic and off > 0.2:
            fault = "exposure"
        if pictures is not None and (fault or shown.max() < 5.0 or shown.min() > 250.0):
            save(pictures, shown, picture)
        figures = f"rest {seconds:.1f} s, {figures}, exposure off {off:.2f}"
        return fault, f"{figures}; {facts(state)}" if fault else figures

    def memory(self) -> tuple[float, float]:
        """Resident memory of the window's process, and its peak. [MB]"""
        text = Path(f"/proc/{self.window.process.pid}/status").read_text()
        now, most = (text.split(f"{name}:")[1].split()[0] for name in ("VmRSS", "VmHWM"))
        return float(now) / 1024.0, float(most) / 1024.0


def window_soak(
    seconds: float,
    seed: int,
    folder: Path,
    log: Callable[[str], None] = lambda _: None,
    pictures: Path | None = None,
) -> Tally:
    """Use a window at random for a time.

    Parameters
    ----------
    seconds : float
        Time. [s]
    folder : Path
        Working directory of the window, into which it saves.
    log : callable
        Receives a line for each event and each comparison.
    pictures : Path, optional
        Folder for wrong, white and black pictures.
    """
    tally = Tally("random events on a window, with its picture compared with the CPU's")
    begun, count, number = time.monotonic(), 0, 0
    sizes: list[float] = []
    answers: list[float] = []
    while time.monotonic() - begun < seconds:
        place = folder / f"window-{number}"
        place.mkdir(parents=True)
        with opened_window(place, "mars", SIZE) as window:
            events = WindowEvents(window, seed + number, log)
            read = 0
            try:
                while time.monotonic() - begun < seconds:
                    for _ in range(TOGETHER):
                        words = events.act()
                        count += 1
                        log(f"event {count} {words}: {events.answers[-1]:.2f} s")
                        if events.answers[-1] >= ANSWER:
                            tally.add("", f"dead: no frame {ANSWER:.0f} s after {words}")
                            log(f"FAULT dead after {words}")
                        time.sleep(events.chance.choice((0.1, 0.3, 0.5, 1.0, 2.0, 5.0)))
                    fault, figures = events.compare(
                        None if pictures is None else pictures / f"window-{seed}-{count}.png"
                    )
                    now, most = events.memory()
                    sizes.append(now)
                    log(f"{'FAULT ' + fault if fault else 'held'} after {count}: {figures}, "
                        f"memory {now:.0f} of at most {most:.0f} MB")  # fmt: skip
                    verdict = fault if fault == "refused" else "held"
                    tally.add(verdict, "" if fault in ("", "refused") else f"{fault}: {figures}")
                    text = window.log.read_text()
                    if text[read:].strip():
                        tally.add("", f"stderr: {text[read:][-600:]!r}")
                        log(f"FAULT stderr {text[read:][-2000:]!r}")
                        read = len(text)
            except Exception as error:
                tally.add("", f"ended: {type(error).__name__}: {ascii(str(error))[:600]}")
                log(f"FAULT ended {type(error).__name__}: {ascii(str(error))[:3000]}")
            answers += events.answers
        number += 1
    tally.note = (
        f"{count} events, memory {sizes[0]:.0f} MB first, {max(sizes):.0f} MB at most, "
        f"answer {1e3 * float(np.median(answers)):.0f} ms median, {max(answers):.1f} s at most"
        if sizes
        else "no comparison"
    )
    return tally
