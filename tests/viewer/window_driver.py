"""Real window for the tests: opens on the display, and answers queries on standard input.

Started as a separate process by ``test_window.py``. Each line read is a JSON list, a word and its
arguments; each line written is the JSON answer.
"""

from __future__ import annotations

import json
import sys
import threading
import time
import traceback
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, cast

import numpy as np

from airlight.clouds.planet_clouds import Box
from airlight.render import render
from airlight.render.clouds import clouds_around
from airlight.render.clouds.cloud_light import FIRST, LIVE, MOST_LIVE
from airlight.render.clouds.clouds_around import CloudsAround
from airlight.render.gpu.device.device import open_device
from airlight.render.pixels.sky_view_window import COARSEST
from airlight.render.rendering_gpu import Choice
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.session.saved_state import to_fragment
from airlight.viewer.window.canvas import DesktopCanvas
from airlight.viewer.window.panels import parameters as panel_parameters
from airlight.viewer.window.panels.probe import numbers_of
from airlight.viewer.window.panels.row import parameter_row
from airlight.viewer.window.start import Start, opened, window_of
from airlight.viewer.window.window import Window


class Answers:
    """Queries."""

    def __init__(self, window: Window, canvas: DesktopCanvas) -> None:
        self.window, self.canvas = window, canvas
        import glfw

        self.reads_clipboard, self.copied = False, ""
        draw = window.draw

        def draw_and_read() -> None:
            draw()
            if self.reads_clipboard:
                self.reads_clipboard = False
                self.copied = (glfw.get_clipboard_string(canvas._window) or b"").decode()

        window.draw = draw_and_read  # type: ignore[method-assign]

    def settled(self, seconds: float) -> bool:
        """Whether everything is shown in full quality within a time."""
        until = time.monotonic() + seconds
        while time.monotonic() < until:
            if self.window.settled and self.window.shown("A") is not None:
                return True
            time.sleep(0.02)
        return False

    def value(self, path: str) -> Any:
        return self.window.session.value(path)

    def put(self, path: str, value: Any) -> None:
        """Change a value as Python does."""
        self.window.session.set(path, value)

    def place_of(self, path: str) -> list[float]:
        self.draws(2)  # a list or a search takes its place within a frame
        panel, gallery = self.window.panel, self.window.gallery
        tab = panel.flight.places
        return list({**gallery.places, **panel.places, **tab, **panel.planet_rows.places}[path])

    def controls(self) -> dict[str, list[float]]:
        """Rectangles of all controls that are within the window, by name."""
        panel, gallery = self.window.panel, self.window.gallery
        rows = {**panel.view_rows.places, **panel.planet_rows.places}
        shown = gallery.places if gallery.is_open else {**rows, **panel.flight.places}
        width, height = self.window.surface.size
        return {
            name: list(one)
            for name, one in {**({} if gallery.is_open else panel.places), **shown}.items()
            if 0.0 <= one[0] < one[2] <= width and 0.0 <= one[1] < one[3] <= height
        }

    def state(self) -> dict[str, Any]:
        """What is displayed: its link, size and exposure, and the error."""
        session, shown = self.window.session, self.window.shown()
        return {
            "link": f"#{to_fragment(session.to_state())}",
            "view": dict(session.view),
            "size": session.size,
            "exposure": None if shown is None else shown.exposure,
            "held": session.holds_exposure,
            "error": self.window.problem,
            "progress": self.window.progress,
        }

    def draws(self, frames: int) -> bool:
        """Whether the window draws some more frames."""
        until, wanted = time.monotonic() + 20.0, self.window.frames + frames
        while self.window.frames < wanted and time.monotonic() < until:
            self.canvas.wake()
            time.sleep(0.01)
        return self.window.frames >= wanted

    def knows(self, path: str) -> bool:
        places = (self.window.panel.planet_rows.places, self.window.gallery.places)
        return any(path in one for one in places)

    def lists(self) -> bool:
        return self.window.surface.asks

    def search(self) -> str:
        return self.window.panel.planet_rows.search

    def source(self) -> str:
        return self.window.session.planet.source

    def open_parts(self) -> dict[str, Any]:
        """Switches that keys change."""
        window, panel = self.window, self.window.panel
        return {
            "panels": window.actions.shows_panels,
            "help": window.actions.shows_help,
            "dialog": window._dialog.asks,
            "probe": panel.probes,
            "time": panel.plays,
            "compare": panel.compares,
            "showing": window.session.showing,
            "other": window.session.has_other,
            "moving": window._flight.moving,
            "records": window.recorder.records,
            "plays": window.recorder.plays,
            "key frames": len(window.recorder.keys),
            "fullscreen": self.canvas.fullscreen,
            "lists": window.surface.asks,
        }

    def find(self, words: str) -> list[list[Any]]:
        """Search, as typed; declared path, kind and options of what is shown then."""
        window = self.window
        window.panel.search(words)
        self.draws(2)
        return [
            [one.path, one.kind, list(one.options)]
            for one in window.session.parameters
            if one.answers(words)
        ]

    def located(self, words: str, path: str) -> list[Any]:
        """Rectangle and value of a parameter, once it is found by a search."""
        self.window.panel.search(words)
        return [self.place_of(path), self.value(path)]

    def open_tab(self, name: str) -> bool:
        self.window.panel.opens = name
        return self.draws(3)

    def clear_flight(self) -> None:
        self.window.recorder.clear()

    def recover(self, planet: str) -> str:
        """Planet of the beginning, as after random clicks; the error that was shown."""
        error = self.window.problem
        self.window.panel.compares = self.window.panel.plays = False
        self.window.session.forget_other()
        self.window.session.open(planet)
        self.window.session.reset()
        return error

    def clipboard(self) -> str:
        """Text of the clipboard, read by the window's thread: GLFW in another may wait for ever."""
        self.reads_clipboard = True
        self.draws(2)
        return self.copied

    def flight_speed(self) -> float:
        return self.window._flight.speed

    def typing(self) -> bool:
        return self.window.surface.typing

    def probes(self, shown: bool) -> bool:
        """Show the probe, or hide it."""
        self.window.panel.probes = shown
        return self.draws(2)

    def probe_rows(self) -> dict[str, str]:
        """Names and values of the probe's last reading; none before the first."""
        reading = self.window._probing.reading
        return dict(numbers_of(reading.spectrum)) if reading is not None else {}

    def picture_place(self) -> list[float]:
        one = self.window.picture_rectangle()
        return [one.left, one.top, one.width, one.height]

    def picture(self) -> dict[str, Any]:
        shown = self.window.shown("A")
        assert shown is not None
        solution = shown.request.solution
        return {
            "width": shown.width,
            "height": shown.height,
            "finished": shown.finished,
            "depth": float(np.sum(solution.medium.vertical_optical_depth)),
            "planet": solution.planet.name,
            "altitude": shown.request.scene.altitude,
        }

    def clouds(self) -> dict[str, Any]:
        """Kinds, cover and detail of light of the clouds of the shown picture."""
        shown = self.window.shown("A")
        assert shown is not None
        lit = shown.request.clouds
        if lit is None:
            return {}
        planet: Any = lit.planet
        return {"cover": planet.clouds[0].cover, "detail": lit.detail, "by": shown.by}

    def cpu_picture(self, file: str) -> bool:
        """Write the CPU's picture of the state shown, with light and LUT as detailed."""
        shown = self.window.shown("A")
        assert shown is not None
        request, planet = shown.request, self.window._sides.solved("A").cloudy  # type: ignore[union-attr]
        around = CloudsAround.of(planet, request.scene, quality="preview", cache=False)
        assert around is not None
        clouds = replace(around, detail=LIVE, sky_view=COARSEST)
        frame = render(request.solution, request.scene, clouds=clouds)
        np.save(file, request.displayed(frame, shown.exposure))
        return True

    def break_rows(self) -> None:
        """Make the rows fail within a frame, with several begins left without an end."""

        def fail(*_: Any, **__: Any) -> Any:
            raise KeyError("no such row")

        panel_parameters.parameter_row = fail

    def mend_rows(self) -> None:
        panel_parameters.parameter_row = parameter_row

    def scene_progress(self) -> list[Any]:
        shown = self.window.shown()
        return [self.window.progress, None if shown is None else [shown.width, shown.finished]]

    def frames(self) -> int:
        return self.window.frames

    def busy(self) -> bool:
        return not self.window.settled

    def cpu(self, seconds: float) -> float:
        """Fraction of one CPU that the process uses while idle. [1]"""
        started, before = time.perf_counter(), time.process_time()
        time.sleep(seconds)
        return (time.process_time() - before) / (time.perf_counter() - started)

    def longest_gap(self, seconds: float) -> float:
        """Longest time between frames of a window that draws continuously. [s]"""
        until, last = time.monotonic() + seconds, time.monotonic()
        frames, longest = self.window.frames, 0.0
        while time.monotonic() < until:
            self.canvas.wake()
            time.sleep(0.004)
            if self.window.frames != frames:
                longest = max(longest, time.monotonic() - last)
                frames, last = self.window.frames, time.monotonic()
        return max(longest, time.monotonic() - last)

    def slowness(self) -> float:
        """Ratio of wall-clock time to CPU time of some work. [1]"""
        started, before = time.perf_counter(), time.thread_time()
        while time.thread_time() - before < 0.1:
            pass
        return (time.perf_counter() - started) / (time.thread_time() - before)

    def stack(self) -> str:
        """What the window's thread is doing."""
        frame = sys._current_frames()[threading.main_thread().ident or 0]
        lines = traceback.extract_stack(frame)[-12:]
        return " < ".join(f"{Path(o.filename).name}:{o.lineno} {o.name}" for o in reversed(lines))

    def threads(self) -> list[str]:
        return sorted(one.name for one in threading.enumerate() if "airlight" in one.name)

    def software(self) -> bool:
        return open_device().software

    def compiling(self) -> bool:
        """Whether shaders are being compiled for pictures."""
        return any(one.name == "airlight-compiling" for one in threading.enumerate())

    def error(self) -> str:
        return self.window.problem


def main() -> None:
    planet, width, height = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
    by = cast(Choice, sys.argv[4])
    view: dict[str, Value] = {"light.quality": "preview"}
    changes = tuple(sys.argv[5:])
    if changes:  # clouds, seen from below
        view |= {"view.altitude": 2.0, "view.sun_zenith": 60.0}
    # small fields, with light of few cells: the same code in less time
    MOST_LIVE.update({LIVE: 10_000, FIRST: 3_000})
    clouds_around.Box = partial(Box, size=6400.0)  # type: ignore[attr-defined, assignment]
    start = Start(planet=planet, view=view, size=(width, height), device=by, changes=changes)
    session = opened(start)
    canvas = DesktopCanvas((width, height), "airlight test")
    window = window_of(start, session, canvas)
    answers = Answers(window, canvas)

    def listen() -> None:
        for line in sys.stdin:
            word, *arguments = json.loads(line)
            try:
                reply = {"answer": getattr(answers, word)(*arguments)}
            except Exception as error:
                reply = {"error": f"{type(error).__name__}: {error}"}
            print(json.dumps(reply), flush=True)

    threading.Thread(target=listen, daemon=True).start()
    window.run()
    left = answers.threads()
    print(json.dumps({"answer": {"ended": True, "threads": left}}), flush=True)


if __name__ == "__main__":
    assert Path(__file__).is_file()
    main()
