"""Window in a process and on a display of its own, driven by mouse and keys."""

from __future__ import annotations

import contextlib
import json
import os
import select
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np

DRIVER = Path(__file__).with_name("window_driver.py")
SIZE = (800, 480)


def missing() -> str:
    """Reason why a window cannot be opened here; empty if it can."""
    for program in ("Xvfb", "xdotool"):
        if shutil.which(program) is None:
            return f"no {program}: apt-get install xvfb xdotool"
    try:
        import glfw  # noqa: F401
        import imgui_bundle  # noqa: F401
        import rendercanvas  # noqa: F401

        from airlight.render.gpu.device.device import open_device

        open_device()
    except ImportError as error:
        return f"{error.name} is not installed: pip install 'airlight[view]'"
    except Exception as error:
        return str(error)
    return ""


class Driven:
    """Window in its own process, with a mouse and keys on its display."""

    def __init__(
        self,
        display: str,
        folder: Path,
        planet: str,
        size: tuple[int, int],
        changes: tuple[str, ...] = (),
        **environment: str,
    ) -> None:
        # Shaders of a window, which draws for minutes, are optimised: see tests/conftest.py.
        self.environment = {**os.environ, "GALLIVM_PERF": "", "DISPLAY": display, **environment}
        self.screen = folder / "Xvfb_screen0"
        self.log = folder / "stderr"
        self._errors = self.log.open("w")
        self.process = subprocess.Popen(
            [sys.executable, str(DRIVER), planet, *map(str, size), "auto", *changes],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=self._errors,
            env=self.environment,
            cwd=folder,
            text=True,
        )

    def ask(self, word: str, *arguments: Any) -> Any:
        assert self.process.stdin is not None
        self.process.stdin.write(json.dumps([word, *arguments]) + "\n")
        self.process.stdin.flush()
        return self.answer()

    def answer(self) -> Any:
        assert self.process.stdout is not None
        ready, _, _ = select.select([self.process.stdout], [], [], 300.0)
        assert ready, self.log.read_text()[-2000:]
        line = self.process.stdout.readline()
        assert line, self.log.read_text()[-2000:]
        reply = json.loads(line)
        assert "error" not in reply, reply
        return reply["answer"]

    def mouse(self, *words: Any) -> None:
        command = ["xdotool", *map(str, words)]
        subprocess.run(command, env=self.environment, check=True, timeout=20)

    def press(self, x: float, y: float) -> None:
        """Move to a point, let the window handle it, and press the left button."""
        self.mouse("mousemove", int(x), int(y), "sleep", 0.2, "mousedown", 1, "sleep", 0.2)

    def click(self, name: str) -> None:
        """Click a control of the panel, once it stays where it is: a list opens over frames."""
        before: list[float] = []
        while (place := self.ask("place_of", name)) != before:
            left, top, right, bottom = before = place
            x, y = int(0.5 * (left + right)), int(0.5 * (top + bottom))
            self.mouse("mousemove", x, y, "sleep", 0.1, "mousemove", x + 1, y, "sleep", 0.1)
        self.mouse("mousedown", 1, "sleep", 0.1, "mouseup", 1, "sleep", 0.1)

    def leave_the_field(self) -> None:
        """Click the picture, which ends typing; and close the probe that the click opens."""
        self.press(600, 200)
        self.until(lambda: not self.ask("typing"))
        self.mouse("mouseup", 1)
        self.until(lambda: self.ask("open_parts")["probe"])
        self.ask("probes", False)

    def pixels(self) -> np.ndarray:
        """Pixels of the display, shape (rows, columns, 3).

        The file is an X window dump: a header of numbers of 32 bits, colours, pixels as BGRX.
        """
        data = self.screen.read_bytes()
        head = np.frombuffer(data, ">u4", 25)
        start, colors = int(head[0]) + 12 * int(head[19]), 4
        width, height, stride = int(head[4]), int(head[5]), int(head[12])
        body = np.frombuffer(data, np.uint8, stride * height, start).reshape(height, stride)
        return body[:, : colors * width].reshape(height, width, colors)[..., 2::-1].astype(int)

    def picture_pixels(self) -> np.ndarray:
        """Part of the display that the picture occupies."""
        left, top, width, height = (int(one) for one in self.ask("picture_place"))
        return self.pixels()[top : top + height, left : left + width]

    def until(self, condition: Callable[[], Any], seconds: float = 60.0, of: str = "") -> None:
        """Wait for a condition, which a loaded machine may meet late."""
        limit = time.monotonic() + seconds
        while not condition():
            if time.monotonic() > limit:
                found = [self.ask(one) for one in ("open_parts", "state", "controls")]
                raise AssertionError(of, *found, self.log.read_text()[-2000:])
            time.sleep(0.02)

    def close(self) -> None:
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        for stream in (self.process.stdin, self.process.stdout, self._errors):
            assert stream is not None
            with contextlib.suppress(BrokenPipeError):
                stream.close()


@contextlib.contextmanager
def opened_window(
    folder: Path,
    planet: str = "mars",
    size: tuple[int, int] = SIZE,
    changes: tuple[str, ...] = (),
    **environment: str,
) -> Iterator[Driven]:
    """Window on a display of its own, with its first picture."""
    reads, writes = os.pipe()
    screen = f"{size[0]}x{size[1]}x24"
    server = subprocess.Popen(
        [
            "Xvfb",
            "-displayfd",
            str(writes),
            "-screen",
            "0",
            screen,
            "-nolisten",
            "tcp",
            "-fbdir",
            str(folder),
        ],
        pass_fds=(writes,),
        stderr=subprocess.DEVNULL,
    )
    os.close(writes)
    with os.fdopen(reads) as pipe:
        display = f":{pipe.readline().strip()}"
    driven = Driven(display, folder, planet, size, changes, **environment)
    try:
        assert driven.ask("settled", 290.0), driven.ask("error") or "not settled"
        yield driven
    finally:
        driven.close()
        server.terminate()
        server.wait()
