"""Canvases of the window: a desktop window that sleeps while idle, or an offscreen canvas.

The loop blocks in the window system until an event arrives or ``wake`` is called, so that an idle
window uses no CPU time.
"""

from __future__ import annotations

import sys
import time
import warnings
from collections.abc import Callable
from contextlib import suppress
from typing import Any, Final, Protocol

import numpy as np
from numpy.typing import NDArray

from airlight.child_processes import safe_path
from airlight.errors import AirlightError

#: Error message without the optional packages.
MISSING_EXTRA: Final = "the window needs more packages: pip install 'airlight[view]'"
#: Highest frame rate, and polling rate of events while the window is active. [s⁻¹]
_FRAME_RATE: Final = 60.0
#: Time without an event or a draw after which the loop sleeps. [s]
_AWAKE: Final = 0.5
#: Longest sleep between checks for signals such as Ctrl+C. [s]
_NAP: Final = 0.5

#: Events after which the window is redrawn.
EVENTS: Final = (
    "resize",
    "pointer_move",
    "pointer_down",
    "pointer_up",
    "pointer_enter",
    "pointer_leave",
    "double_click",
    "wheel",
    "key_down",
    "key_up",
    "char",
)


class WindowError(AirlightError):
    """Failure to open a window; the message is one line."""


class Canvas(Protocol):
    """Canvas and its event loop."""

    render_canvas: Any

    def run(self, draw: Callable[[], None]) -> None:
        """Call ``draw`` on request until the canvas is closed."""

    def wake(self) -> None:
        """See ``Canvas.wake``."""

    def copy(self, text: str) -> None:
        """Copy a text to the clipboard."""

    @property
    def fullscreen(self) -> bool:
        """See ``Canvas.fullscreen``."""

    def toggle_fullscreen(self) -> None:
        """Fill the screen, or restore the previous size."""

    def close(self) -> None:
        """End ``run``."""


class DesktopCanvas:
    """Window on the desktop.

    Parameters
    ----------
    size : (int, int)
        Width and height. [logical pixel]
    """

    def __init__(self, size: tuple[int, int], title: str) -> None:
        try:
            with warnings.catch_warnings(), safe_path():  # glfw asks a process for its version
                warnings.simplefilter("ignore")
                import glfw
                from rendercanvas.glfw import RenderCanvas, loop
        except ImportError as error:
            raise WindowError(MISSING_EXTRA) from error
        self._glfw, self._loop = glfw, loop
        _check_display(glfw)
        self.render_canvas: Any = RenderCanvas(
            size=size,
            title=title,
            update_mode="ondemand",
            max_fps=_FRAME_RATE,
            vsync=False,
        )
        self._wanted = True  # a draw was requested by another thread
        self._busy_until = 0.0
        self._closed = False
        self._before: tuple[int, int, int, int] | None = None
        # The order puts this before the panels' handler, which consumes events.
        self.render_canvas.add_event_handler(self._stir, *EVENTS, order=-1000)

    def _stir(self, _event: Any = None) -> None:
        self._busy_until = time.perf_counter() + _AWAKE
        self.render_canvas.request_draw()

    def run(self, draw: Callable[[], None]) -> None:
        """See ``Canvas.run``."""
        self.render_canvas.request_draw(draw)
        self._loop.add_task(self._rest)
        self._loop.run()
        self._closed = True

    async def _rest(self) -> None:
        from rendercanvas.utils.asyncs import sleep

        self._stir()
        while not self.render_canvas.get_closed():
            if self._wanted:
                self._wanted = False
                self._stir()
            await sleep(0.5 / _FRAME_RATE)
            if self._wanted or time.perf_counter() < self._busy_until:
                continue
            started = time.perf_counter()
            self._glfw.wait_events_timeout(_NAP)
            if time.perf_counter() - started < 0.9 * _NAP:  # woken: handle the event
                self._busy_until = time.perf_counter() + _AWAKE

    def wake(self) -> None:
        """See ``Canvas.wake``."""
        self._wanted = True
        if not self._closed:
            with suppress(Exception):  # the window system may just have ended
                self._glfw.post_empty_event()

    def copy(self, text: str) -> None:
        """See ``Canvas.copy``."""
        self._glfw.set_clipboard_string(self._window, text)

    @property
    def fullscreen(self) -> bool:
        """See ``Canvas.fullscreen``."""
        return self._before is not None

    def toggle_fullscreen(self) -> None:
        """Fill the screen that holds the window, or restore the previous size."""
        glfw, window = self._glfw, self._window
        if self._before is not None:
            left, top, width, height = self._before
            self._before = None
            glfw.set_window_monitor(window, None, left, top, width, height, glfw.DONT_CARE)
            return
        monitor = self._monitor()
        if monitor is None:
            return
        self._before = (*glfw.get_window_pos(window), *glfw.get_window_size(window))
        mode = glfw.get_video_mode(monitor)
        size = mode.size
        glfw.set_window_monitor(window, monitor, 0, 0, size.width, size.height, mode.refresh_rate)

    def _monitor(self) -> Any:
        """Screen that holds the window's centre, else the first; None without any."""
        glfw = self._glfw
        left, top = glfw.get_window_pos(self._window)
        width, height = glfw.get_window_size(self._window)
        monitors = glfw.get_monitors()
        for monitor in monitors:
            x, y = glfw.get_monitor_pos(monitor)
            size = glfw.get_video_mode(monitor).size
            across, down = left + width // 2 - x, top + height // 2 - y
            if 0 <= across < size.width and 0 <= down < size.height:
                return monitor
        return monitors[0] if monitors else None

    @property
    def _window(self) -> Any:
        return self.render_canvas._window

    def close(self) -> None:
        """Close the window after this frame, which ends ``run``."""
        self._loop.call_soon(self.render_canvas.close)


class OffscreenCanvas:
    """Offscreen canvas, for screenshots of the window.

    Parameters
    ----------
    size : (int, int)
        Width and height. [logical pixel]
    ratio : float
        Physical pixels per logical pixel; 2 on a high-density display. [1]
    """

    def __init__(self, size: tuple[int, int], ratio: float = 1.0) -> None:
        try:
            from rendercanvas.offscreen import RenderCanvas
        except ImportError as error:
            raise WindowError(MISSING_EXTRA) from error
        self.render_canvas: Any = RenderCanvas(size=size, pixel_ratio=ratio)
        self._frames = 1
        self.wanted = True
        self.picture: NDArray[np.uint8] | None = None
        self.copied = ""

    def run(self, draw: Callable[[], None]) -> None:
        """Draw once."""
        self.render_canvas.request_draw(draw)
        self.wanted = False
        self.picture = np.array(self.render_canvas.draw(), dtype=np.uint8)[..., :3]

    def wake(self) -> None:
        """See ``Canvas.wake``."""
        self.wanted = True

    def copy(self, text: str) -> None:
        """Store a text in place of a clipboard."""
        self.copied = text

    @property
    def fullscreen(self) -> bool:
        """False: there is no screen."""
        return False

    def toggle_fullscreen(self) -> None:
        """Do nothing: there is no screen."""

    def close(self) -> None:
        """Release the canvas."""
        self.render_canvas.close()


def _check_display(glfw: Any) -> None:
    """Raise a ``WindowError`` if no window can be opened."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        alive = bool(glfw.init())
    if not alive:
        hint = ": is DISPLAY set?" if sys.platform.startswith("linux") else ""
        raise WindowError(f"no display for a window{hint}")
