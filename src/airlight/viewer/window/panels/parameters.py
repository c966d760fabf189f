"""Rows of parameters under collapsible headings, for the planet and for the view."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from itertools import groupby

from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.window import style
from airlight.viewer.window.panels.row import parameter_row, same_value

#: Largest number of items of a list that is not collapsed.
_SHORT_LIST = 4


class ParameterRows:
    """Rows of parameters, with a search and a switch for the advanced ones.

    Parameters
    ----------
    marks : bool
        Whether changed parameters are highlighted.

    Attributes
    ----------
    search : str
        Search words; only parameters that match all of them are shown.
    advanced : bool
        Whether parameters of composition are shown too.
    places : dict
        Last rectangles of the rows' controls, by path, and of the ``search`` field: left, top,
        right, bottom. [logical pixel]
    texts : dict
        Labels and values of the rows drawn last, by path, with available and required widths; see
        ``RowInput``.
    """

    def __init__(self, *, marks: bool = True) -> None:
        self.marks = marks
        self.search = ""
        self.advanced = False
        self.places: dict[str, tuple[float, float, float, float]] = {}
        self.texts: dict[str, tuple[tuple[str, float, float], ...]] = {}

    def draw_search(self) -> None:
        """Draw the search field."""
        from imgui_bundle import imgui

        imgui.set_next_item_width(-1.0)
        clears = imgui.InputTextFlags_.escape_clears_all.value
        _, self.search = imgui.input_text_with_hint(
            "##search", "find: haze, ozone, zoom, sunset …", self.search, clears
        )
        self.places["search"] = style.item_place()

    def draw_advanced(self, hidden: int) -> None:
        """Draw the switch of the advanced parameters, with their number."""
        from imgui_bundle import imgui

        imgui.begin_disabled(hidden == 0)
        _, self.advanced = imgui.checkbox("advanced", self.advanced)
        self.places["advanced"] = style.item_place()
        imgui.end_disabled()
        style.hint(
            f"also the {hidden} parameters of composition: gases, particles, profiles"
            if hidden
            else "this planet's file has no parameters of composition"
        )

    def draw(
        self,
        parameters: Iterable[Parameter],
        values: Callable[[Parameter], Value],
        defaults: Callable[[Parameter], Value],
        change: Callable[[str, Value], None],
        reset: Callable[[str], None],
        *,
        closed: Iterable[str] = (),
        under: Callable[[str], None] = lambda group: None,
    ) -> None:
        """Draw the rows of parameters.

        Parameters
        ----------
        parameters : iterable of Parameter
            Parameters in display order, sorted by group.
        values, defaults : callable
            Functions that return a parameter's value and default. [parameter.unit]
        change : callable
            ``change(path, value)`` is called after each movement of a control.
        reset : callable
            ``reset(path)`` is called to restore a parameter's default.
        closed : iterable of str
            Groups that are initially collapsed.
        under : callable
            ``under(group)`` draws additional controls below the rows of a group.
        """
        from imgui_bundle import imgui

        parameters = list(parameters)
        shown = [one for one in parameters if self._matches(one)]
        hidden = [] if self.search else [one for one in parameters if not self._matches(one)]
        if not shown:
            style.colored("nothing of that name", style.QUIET)
        for group, members in groupby(shown, key=lambda one: one.group):
            rows = list(members)
            if self.search:
                imgui.set_next_item_open(True)
            else:
                imgui.set_next_item_open(group not in set(closed), imgui.Cond_.once.value)
            changed = sum(not same_value(values(one), defaults(one)) for one in rows)
            title = f"{group}   · {changed} changed" if changed and self.marks else group
            if imgui.collapsing_header(f"{title}###{group}"):
                imgui.push_id(group)
                self._group(rows, values, defaults, change, reset)
                self._more(sum(one.group == group for one in hidden))
                under(group)
                imgui.pop_id()
                imgui.dummy(imgui.ImVec2(0.0, 3.0))

    def _group(
        self,
        rows: list[Parameter],
        values: Callable[[Parameter], Value],
        defaults: Callable[[Parameter], Value],
        change: Callable[[str, Value], None],
        reset: Callable[[str], None],
    ) -> None:
        from imgui_bundle import imgui

        for part_of, members in groupby(rows, key=lambda one: one.part_of):
            items = list(members)
            folds = bool(part_of) and len(items) > _SHORT_LIST and not self.search
            if folds:
                name = re.sub(r" (at .*|\d+)$", "", items[0].label)
                if not imgui.tree_node(f"{name}: {len(items)} values###{part_of}"):
                    continue
            for one in items:
                answer = parameter_row(one, values(one), defaults(one), marks=self.marks)
                self.places[one.path] = answer.place
                self.texts[one.path] = answer.texts
                if answer.reset:
                    reset(one.path)
                elif answer.value is not None:
                    change(one.path, answer.value)
            if folds:
                imgui.tree_pop()

    def _more(self, count: int) -> None:
        """Draw a button with the number of hidden parameters of a group, which shows them."""
        from imgui_bundle import imgui

        if count:
            imgui.push_style_color(imgui.Col_.text, imgui.ImVec4(*style.QUIET))
            if imgui.small_button(f"{count} more, advanced"):
                self.advanced = True
            imgui.pop_style_color()
            style.hint("show the advanced parameters")

    def _matches(self, parameter: Parameter) -> bool:
        if parameter.mode == "advanced" and not (self.advanced or self.search):
            return False
        return parameter.answers(self.search)
