"""Left panel: choice of planet, parameters of planet and view, comparison."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from airlight.planets.planet import Planet
from airlight.planets.reading.reader import planet_names
from airlight.viewer.navigation.flight import Flight
from airlight.viewer.navigation.viewpoints import VIEWPOINTS
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.session.session import Session
from airlight.viewer.window import style
from airlight.viewer.window.panels.parameters import ParameterRows
from airlight.viewer.window.panels.row import NAME_WIDTH, RESET_WIDTH, with_unit
from airlight.viewer.window.panels.status import fixed_window_flags
from airlight.viewer.window.panels.values import PanelValues
from airlight.viewer.window.picture_area import Rectangle

#: Speeds of the sun to choose from, relative to real time. [1]
SPEEDS = (60.0, 600.0, 1800.0, 3600.0, 14400.0)


class SidePanel:
    """Left panel, which edits the session.

    Parameters
    ----------
    session : Session
    flight : Flight
        Controller that reads and sets the time of day.
    do : callable
        ``do(action)`` performs an action, as the keys do.
    attempt : callable
        ``attempt(edit)`` runs an edit and shows its error in the window.
    read_planet : callable
        Function that returns the shown planet as read, or None while it is not available.

    Attributes
    ----------
    plays, speed : bool, float
        Whether time passes, and its speed relative to real time. [1]
    compares, probes : bool
        Whether two pictures are shown side by side, and whether a click probes a point.
    opens : str
        Name of a tab that the next frame selects.
    places : dict
        Last rectangles of the header's controls: ``planet``, the names in its list, ``undo`` and
        ``redo``: left, top, right, bottom. [logical pixel]
    """

    def __init__(
        self,
        session: Session,
        flight: Flight,
        do: Callable[[str], None],
        attempt: Callable[[Callable[[], object]], None],
        read_planet: Callable[[], Planet | None],
    ) -> None:
        self._read_planet = read_planet
        self._session = session
        self._flight = flight
        self._do = do
        self._attempt = attempt
        self._values = PanelValues(session)
        self.planet_rows = ParameterRows()
        self.view_rows = ParameterRows(marks=False)
        self.plays = False
        self.speed = SPEEDS[2]
        self.compares = False
        self.probes = False
        self.opens = ""
        self.places: dict[str, tuple[float, float, float, float]] = {}
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
        if imgui.begin_tab_bar("tabs"):
            for name, draw in (
                ("Planet", self._planet),
                ("View", self._view),
                ("Compare", self._compare),
            ):
                chosen = imgui.TabItemFlags_.set_selected.value if name == self.opens else 0
                if imgui.begin_tab_item_simple(name, chosen):
                    draw()
                    imgui.end_tab_item()
            self.opens = ""
            imgui.end_tab_bar()
        imgui.end()
        if self._dragged and not imgui.is_any_item_active():
            self._dragged = ""
            self._session.end_drag()

    def _head(self) -> None:
        from imgui_bundle import imgui

        session = self._session
        source = str(session.planet.source)
        names = list(planet_names())
        if source not in names:
            names.insert(0, source)
        imgui.set_next_item_width(imgui.get_content_region_avail().x - 204.0)
        shown = Path(source).name
        if imgui.begin_combo(
            "##planet", f"{session.showing}: {shown}", imgui.ComboFlags_.height_large
        ):
            for name in names:
                picked, _ = imgui.selectable(name, name == source)
                self.places[name] = style.item_place()
                if picked:
                    self._attempt(lambda name=name: session.open(name))  # type: ignore[misc]
            imgui.end_combo()
        self.places["planet"] = style.item_place()
        style.hint("another planet in place of this one")
        imgui.same_line()
        style.button(
            style.UNDO, "undo", "undo (Ctrl+Z)", lambda: self._do("undo"), on=session.can_undo
        )
        self.places["undo"] = style.item_place()
        imgui.same_line()
        style.button(
            style.REDO, "redo", "redo (Ctrl+Y)", lambda: self._do("redo"), on=session.can_redo
        )
        self.places["redo"] = style.item_place()
        imgui.same_line()
        style.button(
            "reset",
            "all",
            "back to what the planet came with: planet and view",
            lambda: self._do("reset"),
        )
        imgui.same_line()
        style.button(style.SAVE, "save", "save the picture (Ctrl+S) or the planet", self._save_menu)
        imgui.same_line()
        style.button(style.HELP, "help", "what mouse and keys do (F1)", lambda: self._do("help"))
        if imgui.begin_popup("save menu"):
            for words, deed in (("picture …", "save picture"), ("planet file …", "save planet")):
                if imgui.menu_item_simple(words):
                    self._do(deed)
            imgui.end_popup()

    def _save_menu(self) -> None:
        from imgui_bundle import imgui

        imgui.open_popup("save menu")

    def _planet(self) -> None:
        from imgui_bundle import imgui

        rows = self._values.of_planet
        self.planet_rows.draw_search(sum(one.mode == "advanced" for one in rows))
        imgui.begin_child("planet rows")
        self.planet_rows.draw(
            rows,
            self._values.value,
            self._values.default,
            self._change,
            self._reset,
            closed=("planet",),
            under=self._freeze,
        )
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
                imgui.same_line()
            if imgui.button(place.name):
                self._do(f"viewpoint {index + 1}")
            style.hint(f"{place.sentence} ({index + 1})")
        icon, words = (style.PAUSE, "stop the sun") if self.plays else (style.PLAY, "let time pass")
        style.button(icon, "time", f"{words} (T)", lambda: self._do("time"))
        imgui.same_line()
        imgui.set_next_item_width(150.0)
        at = SPEEDS.index(self.speed)
        moved, at = imgui.combo("time##speed", at, [_speed(one) for one in SPEEDS])
        if moved:
            self.speed = SPEEDS[at]
        style.hint("how fast the sun moves: time that passes in a second")
        imgui.same_line()
        _, self.probes = imgui.checkbox("probe", self.probes)
        style.hint("point at the picture and read spectrum, luminance and colour (P)")
        self._time_of_day()
        self.view_rows.draw(
            self._values.of_view,
            self._values.value,
            self._values.default,
            self._change,
            self._reset,
        )
        imgui.end_child()

    def _time_of_day(self) -> None:
        """Draw the sliders of local solar time and declination."""
        from imgui_bundle import imgui

        declination, hour = self._flight.time
        for name, value, high, form, sentence in (
            ("local solar time", hour, 24.0, "%.2f h", "12 h when the sun is highest"),
            (
                "sun's declination", declination, 90.0, "%.1f°",
                "how far north of the equator the sun stands: its season",
            ),
        ):  # fmt: skip
            left = imgui.get_cursor_pos_x()
            imgui.align_text_to_frame_padding()
            imgui.text_unformatted(name)
            style.hint(sentence)
            imgui.same_line(left + NAME_WIDTH)
            imgui.set_next_item_width(imgui.get_content_region_avail().x - RESET_WIDTH)
            low = 0.0 if name.startswith("local") else -high
            moved, new = imgui.slider_float(f"##{name}", value, low, high, form)
            style.hint(sentence)
            if moved and low == 0.0:
                self._attempt(lambda new=new: self._flight.set_time(declination, new))  # type: ignore[misc]
            elif moved:
                self._attempt(lambda new=new: self._flight.set_time(new, hour))  # type: ignore[misc]

    def _compare(self) -> None:
        from imgui_bundle import imgui

        session = self._session
        imgui.begin_child("compare rows")
        style.colored(
            "B is another planet, or this one with other settings. Edits go to the side that is "
            f"chosen: now {session.showing}.",
            style.QUIET,
        )
        if imgui.button("keep as B"):
            self._do("keep as b")
        style.hint("keep this planet and its settings as B, and go on with A (B)")
        imgui.same_line()
        imgui.begin_disabled(not session.has_other)
        if imgui.button("edit A" if session.showing == "B" else "edit B"):
            self._do("swap")
        style.hint("change A and B over (V)")
        imgui.same_line()
        if imgui.button("end"):
            session.forget_other()
            self.compares = False
        imgui.end_disabled()
        changed, split = imgui.checkbox("side by side", self.compares)
        if changed and split != self.compares:
            self._do("compare")
        style.hint("A at the left, B at the right of a line that can be dragged (C)")
        imgui.same_line()
        _, session.shares_camera = imgui.checkbox("one camera", session.shares_camera)
        style.hint("both are seen from the same place under the same sun")
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
        session = self._session
        was = session.showing
        if not session.has_other:
            session.store_b()
        if session.showing == "A":
            session.swap()
        try:
            session.open(planet)
        finally:
            if session.showing != was:
                session.swap()
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
    return value if isinstance(value, str) else with_unit(f"{value:.5g}", unit)
