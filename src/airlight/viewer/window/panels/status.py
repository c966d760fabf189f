"""Status line: view, quality, timing, and errors."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Any, Final

from airlight.viewer.background.solver_thread import SolverResult, SolverStatus
from airlight.viewer.painting.picture_source import Picture
from airlight.viewer.parameters.number_text import quantity_text
from airlight.viewer.window import style
from airlight.viewer.window.picture_area import Rectangle

#: Gap between two texts.
_GAP: Final = "    "
#: Width of the line that is reserved for its margins. [logical pixel]
_MARGINS: Final = 48.0


class FrameTimes:
    """Times of the last 30 frames."""

    def __init__(self) -> None:
        self._took: deque[float] = deque(maxlen=30)
        self._starts: deque[float] = deque(maxlen=30)

    def begin(self) -> None:
        """Start a frame."""
        self._starts.append(perf_counter())

    def end(self) -> None:
        """End the frame."""
        self._took.append(perf_counter() - self._starts[-1])

    @property
    def milliseconds(self) -> float:
        """Mean drawing time. [ms]"""
        return 1e3 * sum(self._took) / max(len(self._took), 1)

    @property
    def rate(self) -> float:
        """Frames in the last second; few while the window is idle. [s⁻¹]"""
        now = perf_counter()
        return float(sum(1 for start in self._starts if now - start < 1.0))


@dataclass(frozen=True, kw_only=True)
class StatusLine:
    """Texts of the status line.

    Parameters
    ----------
    place : str
        Altitude of the observer, and the sun.
    exposure : str
        Exposure in EV.
    frame : str
        Time of a frame.
    picture : str
        Renderer, size and time of the picture.
    solver : str
        Quality and time of the solution.
    working : str
        Current computation; empty if idle.
    message : str
        Message of the last action.
    error : str
        Error; empty if there is none.
    """

    place: str = ""
    exposure: str = ""
    frame: str = ""
    picture: str = ""
    solver: str = ""
    working: str = ""
    message: str = ""
    error: str = ""


def where_text(view: Mapping[str, Any]) -> str:
    """Altitude of the observer and zenith angle of the sun, formatted."""
    zenith = float(view["view.sun_zenith"])
    height = quantity_text(float(view["view.altitude"]), "m")
    return f"{height} up    sun {zenith:.1f}° from the zenith"


def picture_text(shown: Picture) -> str:
    """Renderer, size and time of a picture, formatted."""
    fine = "" if shown.finished else ", finer follows"
    return f"{shown.by}: {shown.width}×{shown.height} in {_seconds(shown.seconds)}{fine}"


def solver_text(solved: SolverResult | None, status: SolverStatus) -> str:
    """Quality and time of a solution, and the solver's current task."""
    done = "" if solved is None else f"{solved.quality}: {_seconds(solved.seconds)}"
    return ", ".join(one for one in (done, status.text) if one)


def _seconds(seconds: float) -> str:
    """Format a time [s] in ms or s.

    Examples
    --------
    >>> _seconds(0.0421), _seconds(3.14159), _seconds(0.0)
    ('42 ms', '3.1 s', 'at once')
    """
    if seconds <= 0.0:
        return "at once"
    return f"{1e3 * seconds:.0f} ms" if seconds < 1.0 else f"{seconds:.1f} s"


def draw_status(status: StatusLine, into: Rectangle) -> None:
    """Draw the status line."""
    from imgui_bundle import imgui

    imgui.set_next_window_pos(imgui.ImVec2(into.left, into.top))
    imgui.set_next_window_size(imgui.ImVec2(into.width, into.height))
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(12.0, 4.0))
    imgui.push_style_color(imgui.Col_.window_bg, imgui.ImVec4(0.075, 0.08, 0.09, 1.0))
    imgui.begin("status", None, fixed_window_flags())
    imgui.pop_style_color()
    imgui.pop_style_var()
    left = "    ".join(one for one in (status.place, status.exposure) if one)
    said = status.error or status.message or left
    # The least important texts are dropped first, so that none is cut off in a narrow window.
    parts = [one for one in (status.solver, status.picture, status.frame) if one]
    while parts and _width(said) + _width(_GAP.join(parts)) > into.width - _MARGINS:
        parts.pop()
    right = _GAP.join(parts)
    room = into.width - _width(right) - _MARGINS
    if status.error:
        imgui.text_colored(imgui.ImVec4(*style.ERROR), _fitting(status.error, room))
        style.hint(status.error, width=480.0)
    elif status.message:
        imgui.text_unformatted(_fitting(status.message, room))
        style.hint(status.message, width=480.0)
    else:
        imgui.text_unformatted(_fitting(left, room))
    imgui.same_line(into.width - _width(right) - 12.0)
    imgui.text_colored(imgui.ImVec4(*(style.WARNING if status.working else style.QUIET)), right)
    style.hint(
        "quality and time of the solution of the air; who made the picture, its size and time; "
        "time to draw the window"
    )
    imgui.end()


def fixed_window_flags() -> int:
    """Window flags of a fixed panel."""
    from imgui_bundle import imgui

    flags = imgui.WindowFlags_
    return int(
        flags.no_decoration.value
        | flags.no_move.value
        | flags.no_saved_settings.value
        | flags.no_bring_to_front_on_focus.value
        | flags.no_nav.value
    )


def _width(text: str) -> float:
    from imgui_bundle import imgui

    return float(imgui.calc_text_size(text).x)


def _fitting(text: str, room: float) -> str:
    if _width(text) <= room:
        return text
    while len(text) > 1 and _width(text + "…") > room:
        text = text[:-1]
    return text + "…"
