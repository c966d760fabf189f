"""The line at the bottom: what is shown, how well, how fast, and what went wrong."""

from __future__ import annotations

from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from time import perf_counter
from typing import Any

from airlight.viewer.background.solving import Solved
from airlight.viewer.background.solving import Status as Solving
from airlight.viewer.painting.picture_source import Picture
from airlight.viewer.window import style
from airlight.viewer.window.picture_area import Rectangle


class FrameTimes:
    """Times of the last frames."""

    def __init__(self) -> None:
        self._took: deque[float] = deque(maxlen=30)
        self._starts: deque[float] = deque(maxlen=30)

    def begin(self) -> None:
        """A frame begins."""
        self._starts.append(perf_counter())

    def end(self) -> None:
        """It is done."""
        self._took.append(perf_counter() - self._starts[-1])

    @property
    def milliseconds(self) -> float:
        """Mean time that drawing took. [ms]"""
        return 1e3 * sum(self._took) / max(len(self._took), 1)

    @property
    def rate(self) -> float:
        """Frames in the last second; few while the window rests. [s⁻¹]"""
        now = perf_counter()
        return float(sum(1 for start in self._starts if now - start < 1.0))


@dataclass(frozen=True, kw_only=True)
class Status:
    """What the line says.

    Parameters
    ----------
    place : str
        Where the observer is.
    exposure : str
    frame : str
        Time of a frame.
    picture : str
        Who made the picture, how large, in what time.
    solver : str
        Quality and time of the solution.
    working : str
        What is being computed; empty if nothing is.
    message : str
        Of the last deed.
    error : str
        What went wrong.
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
    """Where the observer is, and the sun."""
    zenith = float(view["view.sun_zenith"])
    return f"{_length(float(view['view.altitude']))} up    sun {zenith:.1f}° from the zenith"


def picture_text(shown: Picture) -> str:
    """Who made a picture, how large, in what time."""
    fine = "" if shown.finished else ", finer follows"
    return f"{shown.by}: {shown.width}×{shown.height} in {_seconds(shown.seconds)}{fine}"


def working_text(status: Solving) -> str:
    """What is being solved; empty if nothing is."""
    if not status.busy:
        return ""
    part = f" {100 * status.done // status.total} %" if status.total else ""
    return f"{status.doing}{part} …"


def solver_text(solved: Solved | None, status: Solving) -> str:
    """Quality and time of a solution, and what is being solved."""
    done = "" if solved is None else f"{solved.quality}: {_seconds(solved.seconds)}"
    return ", ".join(one for one in (done, working_text(status)) if one)


def _length(metres: float) -> str:
    """A length in m or km.

    Examples
    --------
    >>> _length(2.0), _length(35e3), _length(1.529e7), _length(4.2e11)
    ('2 m', '35 km', '15290 km', '4.2e+08 km')
    """
    if metres < 1e3:
        return f"{metres:.4g} m"
    kilometres = metres / 1e3
    digits = ".0f" if 1e4 <= kilometres < 1e7 else ".4g"
    return f"{kilometres:{digits}} km"


def _seconds(seconds: float) -> str:
    """A time in ms or s.

    Examples
    --------
    >>> _seconds(0.0421), _seconds(3.14159), _seconds(0.0)
    ('42 ms', '3.1 s', 'at once')
    """
    if seconds <= 0.0:
        return "at once"
    return f"{1e3 * seconds:.0f} ms" if seconds < 1.0 else f"{seconds:.1f} s"


def draw_status(status: Status, into: Rectangle) -> None:
    """Draw the line."""
    from imgui_bundle import imgui

    imgui.set_next_window_pos(imgui.ImVec2(into.left, into.top))
    imgui.set_next_window_size(imgui.ImVec2(into.width, into.height))
    imgui.push_style_var(imgui.StyleVar_.window_padding, imgui.ImVec2(12.0, 4.0))
    imgui.push_style_color(imgui.Col_.window_bg, imgui.ImVec4(0.075, 0.08, 0.09, 1.0))
    imgui.begin("status", None, fixed_window_flags())
    imgui.pop_style_color()
    imgui.pop_style_var()
    right = "    ".join(one for one in (status.solver, status.picture, status.frame) if one)
    room = into.width - imgui.calc_text_size(right).x - 48.0
    if status.error:
        imgui.text_colored(imgui.ImVec4(*style.ERROR), _fitting(status.error, room))
        style.hint(status.error, width=480.0)
    elif status.message:
        imgui.text_unformatted(_fitting(status.message, room))
        style.hint(status.message, width=480.0)
    else:
        left = "    ".join(one for one in (status.place, status.exposure) if one)
        imgui.text_unformatted(_fitting(left, room))
    imgui.same_line(into.width - imgui.calc_text_size(right).x - 12.0)
    imgui.text_colored(imgui.ImVec4(*(style.WARNING if status.working else style.QUIET)), right)
    style.hint(
        "quality and time of the solution of the air; who made the picture, its size and time; "
        "time to draw the window"
    )
    imgui.end()


def fixed_window_flags() -> int:
    """Of a panel that has its place."""
    from imgui_bundle import imgui

    flags = imgui.WindowFlags_
    return int(
        flags.no_decoration.value
        | flags.no_move.value
        | flags.no_saved_settings.value
        | flags.no_bring_to_front_on_focus.value
        | flags.no_nav.value
    )


def _fitting(text: str, room: float) -> str:
    from imgui_bundle import imgui

    if imgui.calc_text_size(text).x <= room:
        return text
    while len(text) > 1 and imgui.calc_text_size(text + "…").x > room:
        text = text[:-1]
    return text + "…"
