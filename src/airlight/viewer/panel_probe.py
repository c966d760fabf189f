"""What the probe reads: numbers of one direction, its spectrum, and what it is made of."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.viewer import window_style as style
from airlight.viewer.panel_status import fixed_window_flags
from airlight.viewer.picture_area import Rectangle

FloatArray = NDArray[np.float64]

#: Height of the panel. [logical pixel]
PROBE_HEIGHT: Final = 226.0
#: Width of the numbers on its left. [logical pixel]
_NUMBERS: Final = 330.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Reading:
    """What a probe found, as the panel shows it.

    Parameters
    ----------
    numbers : sequence of (str, str)
        Quantity, and value with its unit.
    wavelengths : array, shape (nl,)
        [nm]
    spectra : mapping of str to array, shape (nl,)
        By what they are: the whole, then its parts. [W m⁻² sr⁻¹ nm⁻¹]
    note : str
        How it was computed.
    """

    numbers: Sequence[tuple[str, str]]
    wavelengths: FloatArray
    spectra: Mapping[str, FloatArray] = field(default_factory=dict)
    note: str = ""


def draw_probe(reading: Reading | None, working: str, into: Rectangle) -> bool:
    """Draw the panel.

    Parameters
    ----------
    reading : Reading or None
        None until a point has been chosen.
    working : str
        What is being computed; empty if nothing is.
    into : Rectangle

    Returns
    -------
    bool
        False once the user has closed it.
    """
    from imgui_bundle import imgui

    imgui.set_next_window_pos(imgui.ImVec2(into.left, into.top))
    imgui.set_next_window_size(imgui.ImVec2(into.width, into.height))
    imgui.begin("probe", None, fixed_window_flags())
    style.colored("Probe", style.ACCENT)
    imgui.same_line()
    words = working or ("click a point of the picture" if reading is None else reading.note)
    imgui.text_colored(imgui.ImVec4(*(style.WARNING if working else style.QUIET)), words)
    imgui.same_line(into.width - 34.0)
    still_open = not imgui.small_button("×")
    if reading is not None:
        imgui.begin_child("numbers", imgui.ImVec2(_NUMBERS, 0.0))
        for name, value in reading.numbers:
            imgui.text_colored(imgui.ImVec4(*style.QUIET), name)
            imgui.same_line(124.0)
            imgui.text_unformatted(value)
        imgui.end_child()
        imgui.same_line()
        if into.width > _NUMBERS + 180.0:
            _plot(reading)
    imgui.end()
    return still_open


def _plot(reading: Reading) -> None:
    """The spectra over the wavelength."""
    from imgui_bundle import imgui, implot

    order = np.argsort(reading.wavelengths)
    nm = np.ascontiguousarray(reading.wavelengths[order], dtype=np.float64)
    top = max((float(np.max(one)) for one in reading.spectra.values()), default=0.0)
    scale, unit = _scaled_unit(top)
    flags = implot.Flags_.no_mouse_text.value | implot.Flags_.no_menus.value
    if not implot.begin_plot("##spectrum", imgui.ImVec2(-1.0, -1.0), flags):
        return
    implot.setup_axes("wavelength [nm]", f"radiance [{unit}]")
    first, last = float(nm[0]), float(nm[-1])
    if first == last:
        first, last = first - 10.0, last + 10.0
    always = imgui.Cond_.always.value
    implot.setup_axis_limits(implot.ImAxis_.x1.value, first, last, always)
    implot.setup_axis_limits(implot.ImAxis_.y1.value, 0.0, max(1.08 * top * scale, 1e-30), always)
    for name, values in reading.spectra.items():
        line: Any = np.ascontiguousarray(scale * values[order], dtype=np.float64)
        implot.plot_line(name, nm, line)
    implot.end_plot()


def _scaled_unit(top: float) -> tuple[float, str]:
    """A factor that makes the largest value 1 to 1000, and the unit it leads to.

    Examples
    --------
    >>> _scaled_unit(0.02)
    (1000.0, 'mW m⁻² sr⁻¹ nm⁻¹')
    """
    steps = ((1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n"), (1e12, "p"))
    for factor, prefix in steps:
        if top * factor >= 1.0:
            return factor, f"{prefix}W m⁻² sr⁻¹ nm⁻¹"
    return 1.0, "W m⁻² sr⁻¹ nm⁻¹"
