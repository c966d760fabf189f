"""Tab of the flight: record, play, scrub, key frames, file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Final

from airlight.studies.film.flight_film import FlightKey
from airlight.viewer.navigation.flight_recorder import FlightRecorder
from airlight.viewer.parameters.number_text import quantity_text
from airlight.viewer.window import style

#: Width of the field with the time of a key frame. [logical pixel]
_TIME_WIDTH: Final = 84.0
#: Slowest change of a time by a drag. [s/pixel]
_DRAG: Final = 0.02


class FlightTab:
    """Tab of the flight.

    Parameters
    ----------
    recorder : FlightRecorder
        Flight that it shows and edits.
    do : callable
        ``do(action)`` performs an action, as the keys do.
    attempt : callable
        ``attempt(edit)`` runs an edit and shows its error in the window.

    Attributes
    ----------
    path : str
        Path in the text field.
    places : dict
        Last rectangles of the controls by name: left, top, right, bottom. [logical pixel]
    """

    def __init__(
        self,
        recorder: FlightRecorder,
        do: Callable[[str], None],
        attempt: Callable[[Callable[[], object]], None],
    ) -> None:
        self._recorder = recorder
        self._do = do
        self._attempt = attempt
        self.path = "flight.toml"
        self.places: dict[str, tuple[float, float, float, float]] = {}

    def draw(self) -> None:
        """Draw the tab."""
        from imgui_bundle import imgui

        imgui.begin_child("flight rows")
        self._draw_controls()
        self._draw_keys()
        self._draw_file()
        imgui.end_child()

    def _draw_controls(self) -> None:
        from imgui_bundle import imgui

        recorder = self._recorder
        words = "stop recording" if recorder.records else "record"
        self._button(words, "record", "key frames of what you fly, one a second (R)")
        imgui.same_line()
        flies = len(recorder.keys) > 1
        icon = style.PAUSE if recorder.plays else style.PLAY
        self._button(icon, "play", "play the flight, or pause (Shift+R)", on=flies)
        imgui.same_line()
        self._button("key frame here", "key frame", "the view at this time, or 3 s later (Insert)")
        imgui.begin_disabled(not flies)
        imgui.set_next_item_width(-1.0)
        moved, time = imgui.slider_float(
            "##time", recorder.time, 0.0, max(recorder.duration, 1e-3), "%.2f s"
        )
        self.places["flight time"] = style.item_place()
        imgui.end_disabled()
        style.hint("the time of the flight that is shown")
        if moved:
            recorder.pause()
            self._attempt(lambda: recorder.show(time))

    def _button(self, label: str, action: str, sentence: str, *, on: bool = True) -> None:
        style.button(label, action, sentence, lambda: self._do(action), on=on)
        self.places[action] = style.item_place()

    def _draw_keys(self) -> None:
        """Draw the key frames, each with its time; clicks edit after all are drawn."""
        from imgui_bundle import imgui

        recorder = self._recorder
        edit: Callable[[], object] | None = None
        for number, key in enumerate(recorder.keys):
            imgui.push_id(number)
            imgui.begin_disabled(number == 0)
            imgui.set_next_item_width(_TIME_WIDTH)
            moved, time = imgui.drag_float("##at", key.time, _DRAG, 0.0, 3600.0, "%.2f s")
            imgui.end_disabled()
            self.places[f"key time {number}"] = style.item_place()
            style.hint("drag it, or Ctrl+click and type: when the flight is here")
            if moved:
                edit = lambda n=number, t=time: recorder.retime(n, t)  # noqa: E731
            imgui.same_line()
            if imgui.button(f"{_where(key)}##go"):
                edit = lambda t=key.time: self._go(t)  # noqa: E731
            self.places[f"key {number}"] = style.item_place()
            style.hint("show this key frame")
            imgui.same_line()
            if imgui.button("delete"):
                edit = lambda n=number: recorder.delete(n)  # noqa: E731
            self.places[f"delete {number}"] = style.item_place()
            imgui.pop_id()
        if edit is not None:
            self._attempt(edit)

    def _go(self, time: float) -> None:
        self._recorder.pause()
        self._recorder.show(time)

    def _draw_file(self) -> None:
        from imgui_bundle import imgui

        recorder = self._recorder
        imgui.dummy(imgui.ImVec2(0.0, 4.0))
        imgui.set_next_item_width(-1.0)
        _, self.path = imgui.input_text("##flight file", self.path)
        self.places["flight file"] = style.item_place()
        target = Path(self.path).expanduser() if self.path.startswith("~/") else Path(self.path)
        flies = len(recorder.keys) > 1
        for words, sentence, act, on in (
            ("save", "a film file, which animate renders", recorder.save, flies),
            ("load", "the key frames of a film file, and its planet", recorder.load, True),
        ):
            imgui.begin_disabled(not on)
            if imgui.button(f"{words}##flight"):
                self._attempt(lambda act=act: act(target))  # type: ignore[misc]
            imgui.end_disabled()
            self.places[f"{words} flight"] = style.item_place()
            style.hint(sentence)
            imgui.same_line()
        style.button(
            "clear", "clear flight", "delete all key frames", recorder.clear, on=bool(recorder.keys)
        )
        name = target.stem or "flight"
        style.colored(f"airlight animate {target.name} -o {name} -o {name}.mp4", style.QUIET)


def _where(key: FlightKey) -> str:
    """Place of a key frame, in a few words."""
    latitude, longitude = key.view["latitude"], key.view["longitude"]
    north = f"{abs(latitude):.1f}° {'N' if latitude >= 0.0 else 'S'}"
    east = f"{abs(longitude):.1f}° {'E' if longitude >= 0.0 else 'W'}"
    return f"{quantity_text(key.view['altitude'], 'm')}  {north}  {east}"
