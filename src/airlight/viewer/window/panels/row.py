"""Row of a panel: a parameter's name, its control with the unit, and a reset button."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from airlight.viewer.parameters.number_text import quantity_text
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.window import style

#: Widths of the names and of the reset button. [logical pixel]
NAME_WIDTH = 138.0
RESET_WIDTH = 26.0
#: Smallest widths of a slider, and of the number beside it. [logical pixel]
_SLIDER_WIDTH = 72.0
_NUMBER_WIDTH = 76.0
#: Gap between a name and its control. [logical pixel]
_GAP = 8.0


class RowInput(NamedTuple):
    """User input of a row.

    Attributes
    ----------
    value : float, str, bool or None
        New value, or None if unchanged. [parameter.unit]
    reset : bool
        Whether the reset button was pressed.
    place : (float, float, float, float)
        Rectangle of the control: left, top, right, bottom. [logical pixel]
    texts : tuple of (str, float, float)
        Label and value as shown, with the available and the required width. [logical pixel]
    """

    value: Value | None
    reset: bool
    place: tuple[float, float, float, float]
    texts: tuple[tuple[str, float, float], ...] = ()


def parameter_row(
    parameter: Parameter, value: Value, default: Value, *, marks: bool = True
) -> RowInput:
    """Draw a row and return the user's input.

    A label or a value that is too long for its half of the row has a line of its own.

    Parameters
    ----------
    parameter : Parameter
        Declaration of the parameter.
    value : float, str or bool
        Current value. [parameter.unit]
    default : float, str or bool
        Value restored by the reset button. [parameter.unit]
    marks : bool
        Whether the name of a changed parameter is highlighted.
    """
    from imgui_bundle import imgui

    imgui.push_id(parameter.path)
    changed: Value | None = None
    imgui.align_text_to_frame_padding()
    left = imgui.get_cursor_pos_x()
    differs = not same_value(value, default)
    whole = imgui.get_content_region_avail().x
    label, needed = imgui.calc_text_size(parameter.label).x, _needed(parameter, value)
    room = max(needed, _NUMBER_WIDTH) if parameter.kind == "number" else 0.0
    least = room + _SLIDER_WIDTH if room else needed
    fits = label <= NAME_WIDTH - _GAP and least <= whole - NAME_WIDTH - RESET_WIDTH
    imgui.push_text_wrap_pos(0.0)
    color = style.ACCENT if differs and marks else style.TEXT_COLOR
    imgui.text_colored(imgui.ImVec4(*color), parameter.label)
    imgui.pop_text_wrap_pos()
    style.hint(_explained(parameter, default))
    if fits:
        imgui.same_line(left + NAME_WIDTH)
    right = imgui.get_content_region_avail().x
    imgui.set_next_item_width(right - RESET_WIDTH - room)
    texts = (
        (parameter.label, NAME_WIDTH - _GAP if fits else whole, min(label, whole)),
        (shown(parameter, value), room or right - RESET_WIDTH, needed),
    )
    moved, new = _control(parameter, value)
    style.hint(_explained(parameter, default))
    if moved:
        changed = new
    place, reset = style.item_place(), False
    if room:
        imgui.same_line(0.0, _GAP)
        start = imgui.get_cursor_pos_x()
        imgui.text_unformatted(shown(parameter, value))
        style.hint(_explained(parameter, default))
        imgui.same_line(start + room - _GAP)
        imgui.dummy(imgui.ImVec2(0.0, 0.0))
    if differs:
        imgui.same_line(0.0, 3.0)
        imgui.push_style_color(imgui.Col_.button, imgui.ImVec4(0.0, 0.0, 0.0, 0.0))
        if imgui.button(style.RESET, imgui.ImVec2(RESET_WIDTH - 3.0, 0.0)):
            reset = True
        imgui.pop_style_color()
        style.hint(f"back to {shown(parameter, default)}")
    imgui.pop_id()
    return RowInput(changed, reset, place, texts)


def same_value(one: Value, other: Value) -> bool:
    """Whether two values are equal up to rounding of the last digits.

    Examples
    --------
    >>> same_value(0.1 + 0.2, 0.3), same_value(0.3, 0.31), same_value("hable", "aces")
    (True, False, False)
    """
    if isinstance(one, (bool, str)) or isinstance(other, (bool, str)):
        return one == other
    return math.isclose(one, other, rel_tol=1e-6, abs_tol=1e-300)


def shown(parameter: Parameter, value: Value) -> str:
    """Format a value with its unit.

    Examples
    --------
    >>> shown(Parameter(path="a", label="a", group="b", help="-", unit="km"), 8.5)
    '8.5 km'
    """
    if isinstance(value, bool):
        return "on" if value else "off"
    if isinstance(value, str):
        return value or "nothing"
    return quantity_text(float(value), parameter.unit)


def _explained(parameter: Parameter, default: Value) -> str:
    """Tooltip of a row: label, help, range and default."""
    lines = [parameter.label, parameter.help]
    if parameter.kind == "number":
        low, high = (max(parameter.least, -1e300), min(parameter.most, 1e300))
        known = abs(low) < 1e300 and high < 1e300
        ends = (low, high) if known else (parameter.low, parameter.high)
        texts = [quantity_text(one, parameter.unit) for one in ends]
        lines.append(("" if known else "slider: ") + " to ".join(texts))
    lines.append(f"as it was: {shown(parameter, default)}")
    if parameter.kind == "number":
        lines.append("Ctrl+click to type a number")
    return "\n".join(lines)


def _control(parameter: Parameter, value: Any) -> tuple[bool, Any]:
    from imgui_bundle import imgui

    if parameter.kind == "switch":
        return imgui.checkbox("##value", bool(value))
    if parameter.kind == "choice":
        return _choice(parameter, str(value))
    if parameter.kind == "text":
        _, text = imgui.input_text("##value", str(value))
        return imgui.is_item_deactivated_after_edit(), text
    flags = imgui.SliderFlags_.no_round_to_format.value
    if parameter.scale == "log":
        flags |= imgui.SliderFlags_.logarithmic.value
    number = float(value)
    moved, new = imgui.slider_float(
        "##value",
        number,
        float(parameter.low),
        float(parameter.high),
        "",
        flags,
    )
    return moved, float(f"{new:.7g}")  # the slider has single precision


def _needed(parameter: Parameter, value: Value) -> float:
    """Width that a control needs to show its value. [logical pixel]"""
    from imgui_bundle import imgui

    padding = 2.0 * imgui.get_style().frame_padding.x
    if parameter.kind == "number":
        return float(imgui.calc_text_size(shown(parameter, value)).x + _GAP)
    if parameter.kind == "choice":  # with its arrow; all options, so that the row keeps its form
        widest = max(imgui.calc_text_size(one).x for one in (*parameter.options, str(value)))
        return float(widest + padding + imgui.get_frame_height())
    return 0.0  # a text scrolls, a switch does not


def _choice(parameter: Parameter, value: str) -> tuple[bool, str]:
    from imgui_bundle import imgui

    options = list(parameter.options)
    at = options.index(value) if value in options else -1
    moved, at = imgui.combo("##value", at, options)
    return moved, options[at] if at >= 0 else value
