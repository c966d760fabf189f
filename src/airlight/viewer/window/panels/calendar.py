"""Calendar of the sun's date: a button with the date, and the days of a month below it."""

from __future__ import annotations

from calendar import Calendar
from collections.abc import Mapping
from datetime import date, timedelta
from typing import Final

from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.sun_clock import DATE, date_text
from airlight.viewer.parameters.view_parameters import VIEW_VALUE
from airlight.viewer.window import style

#: First and last year that can be chosen, those of the slider.
YEARS: Final = tuple(int(one) for one in (VIEW_VALUE[DATE[0]].least, VIEW_VALUE[DATE[0]].most))
#: Width of a day. [logical pixel]
_DAY: Final = 34.0

Places = dict[str, tuple[float, float, float, float]]


class CalendarButton:
    """Button with the date of a view, which opens a calendar.

    Parameters
    ----------
    places : dict
        Receives the rectangles of its controls, by name. [logical pixel]
    """

    def __init__(self, places: Places) -> None:
        self._places = places
        self._month = date(YEARS[0], 1, 1)

    def draw(self, view: Mapping[str, Value], width: float, *, on: bool) -> dict[str, Value]:
        """Draw the button, and the calendar if it is open; returns the changes of the view.

        Parameters
        ----------
        view : mapping
            Values of the view, by path.
        width : float
            Width of the button. [logical pixel]
        on : bool
            Whether the sun follows the date, which the button then shows.
        """
        from imgui_bundle import imgui

        shown = date_of(view)
        words = date_text(view) if on else "sun of a date …"
        if imgui.button(f"{words}##date", imgui.ImVec2(width, 0.0)):
            self._month = shown.replace(day=1)
            imgui.open_popup("calendar")
        self._places["date"] = style.item_place()
        style.hint("calendar: the sun of a day, at the time below")
        changes: dict[str, Value] = {}
        if imgui.begin_popup("calendar"):
            self._draw_head()
            for week in Calendar().monthdatescalendar(self._month.year, self._month.month):
                for weekday, day in enumerate(week):
                    if weekday:
                        imgui.same_line(0.0, 2.0)
                    if self._draw_day(day, shown):
                        changes = date_values(day)
                        imgui.close_current_popup()
            imgui.end_popup()
        return changes

    def _draw_head(self) -> None:
        """Draw the month between arrows of a month, and of a year."""
        from imgui_bundle import imgui

        for name, months in (("<<", -12), ("<", -1), ("", 0), (">", 1), (">>", 12)):
            if months:
                if imgui.button(name, imgui.ImVec2(_DAY, 0.0)):
                    self._month = month_later(self._month, months)
                self._places[f"calendar {name}"] = style.item_place()
            else:
                left = imgui.get_cursor_pos_x()
                imgui.align_text_to_frame_padding()
                imgui.text_unformatted(f"{self._month:%B %Y}")
                imgui.same_line(left + 3.0 * (_DAY + 2.0))
                continue
            if name != ">>":
                imgui.same_line(0.0, 2.0)
        for weekday, name in enumerate(("Mo", "Tu", "We", "Th", "Fr", "Sa", "Su")):
            left = imgui.get_style().window_padding.x + weekday * (_DAY + 2.0)
            imgui.same_line(left + 7.0) if weekday else imgui.set_cursor_pos_x(left + 7.0)
            imgui.text_colored(imgui.ImVec4(*style.QUIET), name)

    def _draw_day(self, day: date, shown: date) -> bool:
        """Draw a day of the month; other days are empty. Returns whether it is chosen."""
        from imgui_bundle import imgui

        if day.month != self._month.month:
            imgui.dummy(imgui.ImVec2(_DAY, imgui.get_frame_height()))
            return False
        if day == shown:
            imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(*style.ACCENT))
        chosen = imgui.button(f"{day.day}##{day}", imgui.ImVec2(_DAY, 0.0))
        if day == shown:
            imgui.pop_style_color()
        self._places[f"day {day.day}"] = style.item_place()
        return bool(chosen)


def date_of(view: Mapping[str, Value]) -> date:
    """Date of a view.

    Examples
    --------
    >>> date_of({"view.year": 2026.0, "view.day": 172.0})
    datetime.date(2026, 6, 21)
    """
    year, day = (int(view[path]) for path in DATE[:2])
    return date(year, 1, 1) + timedelta(days=day - 1)


def date_values(day: date) -> dict[str, Value]:
    """Values of a date, by path.

    Examples
    --------
    >>> date_values(date(2026, 6, 21))
    {'view.year': 2026.0, 'view.day': 172.0}
    """
    return dict(zip(DATE, (float(day.year), float(day.timetuple().tm_yday)), strict=False))


def month_later(first: date, months: int) -> date:
    """First day of a month some months later, within ``YEARS``.

    Examples
    --------
    >>> month_later(date(2026, 12, 1), 1), month_later(date(2050, 12, 1), 1)
    (datetime.date(2027, 1, 1), datetime.date(2050, 12, 1))
    """
    index = 12 * first.year + first.month - 1 + months
    index = min(max(index, 12 * YEARS[0]), 12 * YEARS[1] + 11)
    return date(index // 12, index % 12 + 1, 1)
