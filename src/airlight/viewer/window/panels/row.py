"""Row of a panel: a parameter's name, its control with the unit, and a reset button."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.window import style

#: Widths of the names and of the reset button. [logical pixel]
NAME_WIDTH = 138.0
RESET_WIDTH = 26.0
#: Length from which it is shown in kilometres. [m]
_FAR = 1e4
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
    return _number(float(value), parameter.unit)


def _number(value: float, unit: str) -> str:
    """Format a number with at most four digits, long lengths in km.

    Examples
    --------
    >>> _number(4e5, "m"), _number(2.0, "m"), _number(187.7523, "1"), _number(1995.0, "1")
    ('400 km', '2 m', '187.8', '1995')
    """
    if unit == "m" and abs(value) >= _FAR:
        return with_unit(f"{1e-3 * value:.4g}", "km")
    return with_unit(f"{value:.4g}", unit)


def unit_text(unit: str) -> str:
    """Format a unit for a panel, with superscript powers; empty for pure numbers.

    Examples
    --------
    >>> unit_text("W/m^2/nm"), unit_text("/m"), unit_text("deg"), unit_text("1")
    ('W/(m² nm)', '/m', '°', '')
    """
    if unit in ("1", ""):
        return ""
    if unit in ("deg", "degree"):
        return "°"
    above, *below = unit.replace("**", "^").split("/")
    words = [_raised(one) for one in below if one]
    under = words[0] if len(words) == 1 else f"({' '.join(words)})"
    over = "" if above == "1" else _raised(above)
    return f"{over}/{under}" if words else over


def with_unit(number: str, unit: str) -> str:
    """Join a number and its unit, with a space except before °.

    Examples
    --------
    >>> with_unit("8.5", "km"), with_unit("60", "deg"), with_unit("0.3", "1")
    ('8.5 km', '60°', '0.3')
    """
    text = unit_text(unit)
    return number + text if text == "°" else f"{number} {text}".rstrip()


def _raised(unit: str) -> str:
    name, _, power = unit.partition("^")
    name = "µm" if name == "um" else name
    return name + power.translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))


def _explained(parameter: Parameter, default: Value) -> str:
    """Tooltip of a row: label, help, range and default."""
    lines = [parameter.label, parameter.help]
    if parameter.kind == "number":
        low, high = (max(parameter.least, -1e300), min(parameter.most, 1e300))
        unit = parameter.unit
        if abs(low) < 1e300 and high < 1e300:
            lines.append(f"{low:.6g} to {with_unit(f'{high:.6g}', unit)}")
        else:
            high = parameter.high
            lines.append(f"slider: {parameter.low:.6g} to {with_unit(f'{high:.6g}', unit)}")
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
