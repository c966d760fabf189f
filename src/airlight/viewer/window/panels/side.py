"""Left panel: choice of planet, parameters of planet and view, comparison."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

from airlight.geometry.ephemeris.sun_formula import NUMBERED
from airlight.planets.planet import Planet
from airlight.planets.reading.reader import planet_names
from airlight.viewer.navigation.flight import Flight
from airlight.viewer.navigation.flight_recorder import FlightRecorder
from airlight.viewer.navigation.places import menu_name, places_of, view_of
from airlight.viewer.navigation.viewpoints import VIEWPOINTS
from airlight.viewer.parameters.number_text import quantity_text
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.parameters.sun_clock import CLOCK
from airlight.viewer.session.session import Session
from airlight.viewer.window import style
from airlight.viewer.window.panels.calendar import CalendarButton
from airlight.viewer.window.panels.flight import FlightTab
from airlight.viewer.window.panels.parameters import ParameterRows
from airlight.viewer.window.panels.row import parameter_row
from airlight.viewer.window.panels.status import fixed_window_flags
from airlight.viewer.window.panels.values import PanelValues
from airlight.viewer.window.picture_area import Rectangle

#: Menu for saving the picture: label and action.
_MENU = (
    ("picture …  Ctrl+S", "save picture"),
    ("film of the moving sun …  O", "film"),
    ("planet file …  Ctrl+Shift+S", "save planet"),
    ("copy link  U", "copy link"),
    ("fullscreen  F", "fullscreen"),
)
#: Options for the rate of the sun's time, relative to real time. [1]
SPEEDS = (60.0, 600.0, 1800.0, 3600.0, 14400.0)
#: Sliders of the sun's place by time of day and season.
SOLAR_TIME = Parameter(
    path="local solar time",
    label="local solar time",
    group="sun",
    unit="h",
    high=24.0,
    least=0.0,
    most=24.0,
    help="12:00 when the sun is highest.",
)
DECLINATION = Parameter(
    path="sun's declination",
    label="sun's declination",
    group="sun",
    unit="deg",
    low=-90.0,
    high=90.0,
    least=-90.0,
    most=90.0,
    help="How far north of the equator the sun stands: its season.",
)


class SidePanel:
    """Left panel, which edits the session.

    Parameters
    ----------
    flight : Flight
        Controller that reads and sets the time of day.
    do : callable
        ``do(action)`` performs an action, as the keys do.
    attempt : callable
        ``attempt(edit)`` runs an edit and shows its error in the window.
    read_planet : callable
        Function that returns the displayed planet, or None until it has been read.
    recorder : FlightRecorder
        Flight of its tab.

    Attributes
    ----------
    plays, speed : bool, float
        Whether time passes, and its speed relative to real time. [1]
    compares, probes : bool
        Whether two pictures are shown side by side, and whether a click probes a point.
    opens : str
        Name of a tab that the next frame selects.
    places : dict
        Last rectangles of the controls other than rows, by name: left, top, right, bottom.
        [logical pixel]
    """

    def __init__(
        self,
        session: Session,
        flight: Flight,
        do: Callable[[str], None],
        attempt: Callable[[Callable[[], object]], None],
        read_planet: Callable[[], Planet | None],
        recorder: FlightRecorder,
    ) -> None:
        self._read_planet = read_planet
        self._session = session
        self._flight = flight
        self._do = do
        self._attempt = attempt
        self._values = PanelValues(session)
        self.planet_rows = ParameterRows()
        self.view_rows = ParameterRows(marks=False)
        self.flight = FlightTab(recorder, do, attempt)
        self.plays = False
        self.speed = SPEEDS[2]
        self.compares = False
        self.probes = False
        self.opens = ""
        self.places: dict[str, tuple[float, float, float, float]] = {}
        self._calendar = CalendarButton(self.places)
        self._dragged = ""

    def draw(self, into: Rectangle) -> None:
        """Draw the panel in a rectangle. [logical pixel]"""
        from imgui_bundle import imgui

        imgui.set_next_window_pos(imgui.ImVec2(into.left, into.top))
        imgui.set_next_window_size(imgui.ImVec2(into.width, into.height))
        imgui.begin("side", None, fixed_window_flags())
        self._head()
        # After the header, which may have opened another planet.
        self._values.refresh()
        rows = self.planet_rows
        rows.draw_search()
        if rows.search.strip():
            self._found()
        elif imgui.begin_tab_bar("tabs"):
            for name, draw in (
                ("Planet", self._planet),
                ("View", self._view),
                ("Flight", self.flight.draw),
                ("Compare", self._compare),
            ):
                chosen = imgui.TabItemFlags_.set_selected.value if name == self.opens else 0
                opened = imgui.begin_tab_item_simple(name, chosen)
                self.places[f"tab {name}"] = style.item_place()
                if opened:
                    draw()
                    imgui.end_tab_item()
            self.opens = ""
            imgui.end_tab_bar()
        imgui.end()
        if self._dragged and not imgui.is_any_item_active():
            self._dragged = ""
            self._session.end_drag()

    @property
    def searched(self) -> str:
        """Search words; empty without a search."""
        return self.planet_rows.search

    def search(self, words: str) -> None:
        """Show the parameters of planet and view that match some words; all if empty."""
        self.planet_rows.search = words

    def _found(self) -> None:
        """Draw the rows of planet and view that match the search."""
        from imgui_bundle import imgui

        imgui.begin_child("found rows")
        self._rows(self.planet_rows, self._values.parameters)
        imgui.end_child()

    def _rows(self, rows: ParameterRows, parameters: Iterable[Parameter], **more: Any) -> None:
        rows.draw(
            parameters, self._values.value, self._values.default, self._change, self._reset, **more
        )

    def _head(self) -> None:
        from imgui_bundle import imgui

        session = self._session
        name = Path(str(session.planet.source)).name
        imgui.push_style_var(imgui.StyleVar_.button_text_align, imgui.ImVec2(0.0, 0.5))
        if imgui.button(f"{session.showing}: {name}##planet", imgui.ImVec2(-1.0, 0.0)):
            self._do("gallery")
        imgui.pop_style_var()
        self.places["planet"] = style.item_place()
        style.hint("another planet in place of this one (G)")
        self._button(style.UNDO, "undo", "undo (Ctrl+Z)", "undo", on=session.can_undo)
        imgui.same_line()
        self._button(style.REDO, "redo", "redo (Ctrl+Y)", "redo", on=session.can_redo)
        imgui.same_line()
        self._button(
            "reset", "reset", "back to what the planet came with: planet and view", "reset"
        )
        imgui.same_line()
        style.button(
            style.SAVE, "save", "save picture, film or planet; link; fullscreen", self._save_menu
        )
        self.places["save"] = style.item_place()
        imgui.same_line()
        self._button(style.HELP, "help", "what mouse and keys do (F1)", "help")
        imgui.same_line()
        self.planet_rows.draw_advanced(
            sum(one.mode == "advanced" for one in self._values.of_planet)
        )
        if imgui.begin_popup("save menu"):
            for words, action in _MENU:
                if imgui.menu_item_simple(words):
                    self._do(action)
                self.places[action] = style.item_place()
            imgui.end_popup()

    def _button(self, icon: str, name: str, sentence: str, action: str, *, on: bool = True) -> None:
        """Draw a button that performs an action."""
        style.button(icon, name, sentence, lambda: self._do(action), on=on)
        self.places[name] = style.item_place()

    def _save_menu(self) -> None:
        from imgui_bundle import imgui

        imgui.open_popup("save menu")

    def _planet(self) -> None:
        from imgui_bundle import imgui

        imgui.begin_child("planet rows")
        rows, shown = self.planet_rows, self._values.of_planet
        self._rows(rows, shown, closed=("planet",), under=self._freeze)
        imgui.end_child()

    def _freeze(self, group: str) -> None:
        """Draw the button that converts a constituent's composition to coefficients."""
        from imgui_bundle import imgui

        if group not in self._session.advanced or not self.planet_rows.advanced:
            return
        planet = self._read_planet()
        imgui.begin_disabled(planet is None)
        if imgui.small_button("give it by coefficients"):
            self._attempt(lambda: self._session.freeze_coefficients(group, planet))
        imgui.end_disabled()
        style.hint("freeze what follows from its composition to numbers of its own; can be undone")

    def _view(self) -> None:
        from imgui_bundle import imgui

        imgui.begin_child("view rows")
        for index, place in enumerate(VIEWPOINTS):
            if index:
                self._same_line_if_it_fits(place.name)
            action = f"viewpoint {index + 1}"
            self._button(place.name, action, f"{place.sentence} ({index + 1})", action)
        icon, words = (style.PAUSE, "stop the sun") if self.plays else (style.PLAY, "let time pass")
        self._button(icon, "time", f"{words} (T)", "time")
        imgui.same_line()
        imgui.set_next_item_width(150.0)
        at = SPEEDS.index(self.speed)
        moved, at = imgui.combo("time##speed", at, [_speed(one) for one in SPEEDS])
        self.places["speed"] = style.item_place()
        if moved:
            self.speed = SPEEDS[at]
        style.hint("how fast the sun moves: time that passes in a second")
        imgui.same_line()
        _, self.probes = imgui.checkbox("probe", self.probes)
        self.places["probe"] = style.item_place()
        style.hint("point at the picture and read spectrum, luminance and colour (P)")
        self._places()
        self._time_of_day()
        self._rows(self.view_rows, self._values.of_view)
        imgui.end_child()

    def _same_line_if_it_fits(self, name: str) -> None:
        """Continue the line if a button of this name fits into the panel."""
        from imgui_bundle import imgui

        style_now = imgui.get_style()
        width = imgui.calc_text_size(name).x + 2.0 * style_now.frame_padding.x
        end = imgui.get_item_rect_max().x + style_now.item_spacing.x + width
        if end <= imgui.get_cursor_screen_pos().x + imgui.get_content_region_avail().x:
            imgui.same_line()

    def _places(self) -> None:
        """Draw the menu of named places of the planet's world."""
        from imgui_bundle import imgui

        places = places_of(self._session.planet.tables.get("body"))
        if not places:
            return
        imgui.set_next_item_width(-1.0)
        if imgui.begin_combo("##places", "go to a place", imgui.ComboFlags_.height_large):
            for place in places:
                name = menu_name(place)
                picked, _ = imgui.selectable(name, False)
                self.places[f"place {name}"] = style.item_place()
                if picked:
                    view = view_of(place)
                    self._attempt(
                        lambda name=name, view=view: self._session.change_view(name, view)  # type: ignore[misc]
                    )
            imgui.end_combo()
        self.places["places"] = style.item_place()
        style.hint("latitude and longitude of a place; camera and height stay")

    def _time_of_day(self) -> None:
        """Draw the date, and the sliders of local solar time and declination."""
        from imgui_bundle import imgui

        view = self._session.view
        if self._session.planet.tables.get("body") in NUMBERED:
            width = imgui.get_content_region_avail().x
            changes = self._calendar.draw(view, width, on=bool(view[CLOCK]))
            if changes:
                self._attempt(lambda: self._session.change_view("date", changes))
        declination, hour = self._flight.time
        for slider, value in ((SOLAR_TIME, hour), (DECLINATION, declination)):
            row = parameter_row(slider, value, value)
            self.places[slider.path] = row.place
            if row.value is None:
                continue
            new = float(row.value)
            time = (declination, new) if slider is SOLAR_TIME else (new, hour)
            self._attempt(lambda time=time: self._flight.set_time(*time))  # type: ignore[misc]

    def _compare(self) -> None:
        from imgui_bundle import imgui

        session = self._session
        imgui.begin_child("compare rows")
        style.colored(
            "B is another planet, or this one with other settings. Edits go to the side that is "
            f"chosen: now {session.showing}.",
            style.QUIET,
        )
        sentence = "keep this planet and its settings as B, and go on with A (B)"
        self._button("keep as B", "keep as b", sentence, "keep as b")
        imgui.same_line()
        imgui.begin_disabled(not session.has_other)
        words = "edit A" if session.showing == "B" else "edit B"
        self._button(words, "swap", "change A and B over (V)", "swap")
        imgui.same_line()
        if imgui.button("end"):
            session.forget_other()
            self.compares = False
        self.places["end"] = style.item_place()
        imgui.end_disabled()
        changed, split = imgui.checkbox("side by side", self.compares)
        self.places["side by side"] = style.item_place()
        if changed and split != self.compares:
            self._do("compare")
        style.hint("A at the left, B at the right of a line that can be dragged (C)")
        imgui.same_line()
        _, session.shares_camera = imgui.checkbox("one camera", session.shares_camera)
        self.places["one camera"] = style.item_place()
        style.hint("both are seen from the same place under the same sun")
        _, session.shares_exposure = imgui.checkbox("one exposure", session.shares_exposure)
        self.places["one exposure"] = style.item_place()
        style.hint("both have the exposure of the brighter; otherwise each its own")
        imgui.set_next_item_width(imgui.get_content_region_avail().x - 96.0)
        if imgui.begin_combo("B is planet", "choose", imgui.ComboFlags_.height_large):
            for name in planet_names():
                picked, _ = imgui.selectable(name, False)
                if picked:
                    self._attempt(lambda name=name: self.compare_with(name))  # type: ignore[misc]
            imgui.end_combo()
        self._differences()
        imgui.end_child()

    def compare_with(self, planet: str) -> None:
        """Show a planet as side B next to A."""
        self._session.open_as_b(planet)
        self.compares = True

    def _differences(self) -> None:
        from imgui_bundle import imgui

        if not self._session.has_other:
            return
        rows = self._session.differences()
        imgui.dummy(imgui.ImVec2(0.0, 4.0))
        style.colored(f"{len(rows)} differences" if rows else "no differences", style.ACCENT)
        flags = imgui.TableFlags_.row_bg.value | imgui.TableFlags_.sizing_stretch_prop.value
        if rows and imgui.begin_table("differences", 3, flags):
            imgui.table_setup_column("", 0, 2.0)
            imgui.table_setup_column("A", 0, 1.0)
            imgui.table_setup_column("B", 0, 1.0)
            imgui.table_headers_row()
            for row in rows[:200]:
                imgui.table_next_row()
                for text in (row.label, *(_text(one, row.unit) for one in (row.first, row.second))):
                    imgui.table_next_column()
                    imgui.text_unformatted(text)
                    style.hint(text)
            imgui.end_table()

    def _change(self, path: str, value: Value) -> None:
        from imgui_bundle import imgui

        if imgui.is_any_item_active() and self._dragged != path:
            self._attempt(lambda: self._session.begin_drag(path))
            self._dragged = path
        self._attempt(lambda: self._session.set(path, value))

    def _reset(self, path: str) -> None:
        self._attempt(lambda: self._session.reset(path))


def _speed(factor: float) -> str:
    minutes = factor / 60.0
    return f"{minutes:g} min/s" if minutes < 60.0 else f"{minutes / 60.0:g} h/s"


def _text(value: Value | None, unit: str) -> str:
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "on" if value else "off"
    return value if isinstance(value, str) else quantity_text(value, unit)
