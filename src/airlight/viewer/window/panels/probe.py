"""Panel of the probe: values of one direction, its parts, its spectrum."""

from __future__ import annotations

import math
from typing import Any, Final

import numpy as np

from airlight.image.sky_magnitude import DARK, sky_magnitude
from airlight.viewer.painting.probe import Probe
from airlight.viewer.painting.probing import ProbeResult
from airlight.viewer.parameters.number_text import luminance_text, number_text, quantity_text
from airlight.viewer.window import style
from airlight.viewer.window.panels.status import fixed_window_flags
from airlight.viewer.window.picture_area import Rectangle

#: Height of the panel. [logical pixel]
PROBE_HEIGHT: Final = 262.0
#: Widths of the columns of values and of parts. [logical pixel]
_NUMBERS: Final = 252.0
_PARTS: Final = 292.0
#: Margins of the panel and the gap between the columns. [logical pixel]
_GAPS: Final = 32.0
#: Smallest width of a plot. [logical pixel]
_PLOT: Final = 200.0
#: Wavelength of single values; the nearest available one is used. [nm]
_GREEN: Final = 550.0


def draw_probe(reading: ProbeResult | None, working: str, into: Rectangle) -> bool:
    """Draw the panel.

    Parameters
    ----------
    reading : ProbeResult or None
        Result of the probe; None until a point has been chosen.
    working : str
        Status of the computation; empty if idle.
    into : Rectangle
        Rectangle of the panel. [logical pixel]

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
    words = working or ("click a point of the picture" if reading is None else reading.quality)
    imgui.text_colored(imgui.ImVec4(*(style.WARNING if working else style.QUIET)), words)
    imgui.same_line(into.width - 34.0)
    still_open = not imgui.small_button("×")
    style.hint("close the probe (P)")
    if reading is not None:
        beside = into.width > _NUMBERS + _PARTS + _GAPS
        plotted = into.width > _NUMBERS + _PARTS + _PLOT
        imgui.begin_child("numbers", imgui.ImVec2(_NUMBERS if beside else 0.0, 0.0))
        for name, value in numbers_of(reading.spectrum):
            imgui.text_colored(imgui.ImVec4(*style.QUIET), name)
            imgui.same_line(100.0)
            imgui.text_unformatted(value)
        if not beside:  # in a narrow window the parts follow, and the panel scrolls
            _parts(reading.spectrum)
        imgui.end_child()
        if beside:
            imgui.same_line()
            imgui.begin_child("parts", imgui.ImVec2(_PARTS if plotted else 0.0, 0.0))
            _parts(reading.spectrum)
            imgui.end_child()
        if plotted:
            imgui.same_line()
            _plot(reading.spectrum)
    imgui.end()
    return still_open


def numbers_of(probe: Probe) -> tuple[tuple[str, str], ...]:
    """Names and formatted values of a probe, with units."""
    green = int(np.argmin(np.abs(np.asarray(probe.wavelengths) - _GREEN)))
    nm = f"{probe.wavelengths[green]:.0f} nm"
    depth = sum(row[green] for row in probe.optical_depth)
    x, y = probe.chromaticity
    dark = 0.0 < probe.luminance < DARK
    polarised = []
    if probe.polarised is not None:
        degree, angle = probe.polarised
        polarised = [("polarised", f"{100.0 * degree:.1f} % at {angle:.1f}°")]
    rows = [
        ("luminance", luminance_text(probe.luminance)),
        *([("", f"{sky_magnitude(probe.luminance):.2f} mag/arcsec²")] if dark else []),
        ("colour x, y", f"{x:.3f}, {y:.3f}"),
        *polarised,
        (f"at {nm}", f"{number_text(1e3 * probe.radiance[green])} mW/(m² sr nm)"),
        ("optical depth", f"{number_text(depth)} at {nm}"),
        ("transmitted", f"{number_text(100.0 * probe.transmittance[green])} % at {nm}"),
        *zip(("direction", ""), direction_texts(probe.view_zenith, probe.azimuth), strict=True),
    ]
    if math.isfinite(probe.distance):
        rows.append(("ground", f"{quantity_text(probe.distance, 'm')} away"))
        if probe.latitude is not None and probe.longitude is not None:
            rows.append(("", _on_globe(probe.latitude, probe.longitude)))
    return tuple(rows)


def direction_texts(zenith: float, azimuth: float) -> tuple[str, str]:
    """Format a direction by its zenith angle and its azimuth from the sun. [deg]

    Examples
    --------
    >>> direction_texts(83.06, 283.4), direction_texts(103.06, 76.6)
    (('6.9° up', '76.6° left of the sun'), ('13.1° down', '76.6° right of the sun'))
    """
    up, turn = 90.0 - zenith, (azimuth + 180.0) % 360.0 - 180.0
    side = "right" if turn >= 0.0 else "left"
    height = f"{abs(up):.1f}° {'up' if up >= 0.0 else 'down'}"
    return height, f"{abs(turn):.1f}° {side} of the sun"


def _on_globe(latitude: float, longitude: float) -> str:
    """Format coordinates on the globe [deg].

    Examples
    --------
    >>> _on_globe(-4.074, 12.5)
    '4.07° S, 12.50° E'
    """
    north, east = "S" if latitude < 0.0 else "N", "W" if longitude < 0.0 else "E"
    return f"{abs(latitude):.2f}° {north}, {abs(longitude):.2f}° {east}"


def _parts(probe: Probe) -> None:
    """Draw luminance by part, in the colours of the plot, and optical depth by constituent."""
    from imgui_bundle import imgui, implot

    green = int(np.argmin(np.abs(np.asarray(probe.wavelengths) - _GREEN)))
    whole = sum(one.luminance for one in probe.parts)
    flags = (
        imgui.TableFlags_.row_bg.value
        | imgui.TableFlags_.sizing_fixed_fit.value
        | imgui.TableFlags_.pad_outer_x.value
    )
    if imgui.begin_table("parts", 3, flags):
        stretch = imgui.TableColumnFlags_.width_stretch.value
        imgui.table_setup_column("part of the light", stretch)
        imgui.table_setup_column("cd/m²")
        imgui.table_setup_column("%")
        imgui.table_headers_row()
        for index, part in enumerate(probe.parts):
            share = 100.0 * part.luminance / whole if whole > 0.0 else 0.0
            color = implot.get_colormap_color(index + 1)  # the first line is their sum
            _row(part.name, number_text(part.luminance), f"{share:.1f}", color=color)
        imgui.end_table()
    if imgui.begin_table("depths", 2, flags):
        stretch = imgui.TableColumnFlags_.width_stretch.value
        imgui.table_setup_column("optical depth on the way", stretch)
        imgui.table_setup_column(f"{probe.wavelengths[green]:.0f} nm")
        imgui.table_headers_row()
        for name, row in zip(probe.names, probe.optical_depth, strict=True):
            _row(name, number_text(row[green]))
        imgui.end_table()


def _row(*texts: str, color: Any = None) -> None:
    from imgui_bundle import imgui

    imgui.table_next_row()
    for index, text in enumerate(texts):
        imgui.table_next_column()
        if index == 0 and color is not None:
            flags = imgui.ColorEditFlags_.no_tooltip.value
            imgui.color_button(f"##{text}", color, flags, imgui.ImVec2(9.0, 9.0))
            imgui.same_line()
        imgui.text_unformatted(text)
        style.hint(text)


def _plot(probe: Probe) -> None:
    """Draw the spectrum and its parts over the wavelength."""
    from imgui_bundle import imgui, implot

    order = np.argsort(probe.wavelengths)
    nm = np.ascontiguousarray(np.asarray(probe.wavelengths)[order])
    lines = {"all": np.asarray(probe.radiance)}
    lines |= {one.name: np.asarray(one.radiance) for one in probe.parts}
    top = max(float(np.max(one)) for one in lines.values())
    scale, unit = scaled_unit(top)
    flags = (
        implot.Flags_.no_mouse_text.value
        | implot.Flags_.no_menus.value
        | implot.Flags_.no_legend.value
    )
    implot.push_style_var(implot.StyleVar_.plot_padding, imgui.ImVec2(6.0, 6.0))
    is_drawn = implot.begin_plot("##spectrum", imgui.ImVec2(-1.0, -1.0), flags)
    try:  # the surface recovers ImGui's state, but not that of plots
        if is_drawn:
            implot.setup_axes("wavelength [nm]", unit)
            first, last = float(nm[0]), float(nm[-1])
            always = imgui.Cond_.always.value
            implot.setup_axis_limits(implot.ImAxis_.x1.value, first, max(last, first + 1.0), always)
            highest = max(1.1 * top * scale, 1e-30)
            implot.setup_axis_limits(implot.ImAxis_.y1.value, 0.0, highest, always)
            for name, values in lines.items():
                implot.plot_line(name, nm, np.ascontiguousarray(scale * values[order]))
    finally:
        if is_drawn:
            implot.end_plot()
        implot.pop_style_var()


def scaled_unit(top: float) -> tuple[float, str]:
    """Factor that scales the largest radiance to between 1 and 1000, and the resulting unit.

    Parameters
    ----------
    top : float
        Largest radiance. [W m⁻² sr⁻¹ nm⁻¹]

    Examples
    --------
    >>> scaled_unit(0.02)
    (1000.0, 'mW/(m² sr nm)')
    """
    for factor, prefix in ((1.0, ""), (1e3, "m"), (1e6, "µ"), (1e9, "n"), (1e12, "p")):
        if top * factor >= 1.0:
            return factor, f"{prefix}W/(m² sr nm)"
    return 1.0, "W/(m² sr nm)"
