"""Pictures of measured and computed skies: domes, and errors by scan, wavelength and angle."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import pairwise
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from airlight.studies.fit.scans import Scans
from airlight.studies.plots.figure import GREY, LINE_STYLES, PALETTE, grid, new_figure
from airlight.validation.kider.scans import MILLI, rmse_per_scan
from airlight.validation.suite import ReportPicture

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.tri import TriContourSet

FloatArray = NDArray[np.float64]

#: Edges of the bins in angle from the sun. [deg]
ANGLE_EDGES: Final = (0.0, 8.0, 15.0, 25.0, 35.0, 45.0, 55.0, 65.0, 75.0, 90.0, 130.0)
#: Limit of the colour scale of relative differences. [%]
_WIDEST: Final = 40.0
_UNIT: Final = "mW m⁻² sr⁻¹ nm⁻¹"


def error_curves(scans: Scans, rows: Mapping[str, FloatArray]) -> ReportPicture:
    """Root mean square errors of several models by scan, by wavelength and by angle from the sun.

    Parameters
    ----------
    rows : mapping of str to array, shape (ns, nd, nl)
        Radiance by name. [W m⁻² sr⁻¹ nm⁻¹]
    """
    title = "Error by scan, by wavelength and by angle from the sun"
    figure = new_figure(title, size=(12.0, 4.2))
    by_scan, by_colour, by_angle = figure.subplots(1, 3)
    angles = scans.angle_from_sun
    edges = np.array(ANGLE_EDGES)
    bins = [(angles >= a) & (angles < b) for a, b in pairwise(ANGLE_EDGES)]
    kept = [k for k, chosen in enumerate(bins) if chosen.any()]
    for index, (name, got) in enumerate(rows.items()):
        style = {"color": PALETTE[index], "linestyle": LINE_STYLES[index], "linewidth": 1.6}
        squares = np.square(got - scans.radiance)
        by_scan.plot(
            scans.time, rmse_per_scan(got, scans.radiance), marker=".", label=name, **style
        )
        by_colour.plot(scans.wavelengths, MILLI * np.sqrt(squares.mean(axis=(0, 1))), **style)
        by_angle.plot(
            [0.5 * (edges[k] + edges[k + 1]) for k in kept],
            [MILLI * np.sqrt(squares[bins[k]].mean()) for k in kept],
            marker=".",
            **style,
        )
    by_scan.set_xticks(range(0, len(scans.time), 2), list(scans.time)[::2], rotation=60)
    by_scan.set_xlabel("scan, local time")
    by_scan.set_ylabel(f"root mean square error [{_UNIT}]")
    by_colour.set_xlabel("wavelength [nm]")
    by_angle.set_xlabel("angle from the sun [°]")
    for axes in (by_scan, by_colour, by_angle):
        axes.set_ylim(bottom=0.0)
        grid(axes)
    figure.legend(loc="outside lower center", ncols=len(rows), fontsize=9)
    return ReportPicture.from_figure(
        figure,
        title=title,
        caption="The error near the sun weighs much in few directions; in the middle, the steps of "
        "the first row from wavelength to wavelength are those of a solar spectrum that everybody "
        "shares.",
    )


def domes(scans: Scans, got: FloatArray, chosen: Sequence[int], name: str) -> ReportPicture:
    """Measured and computed domes and their relative difference, for some scans.

    Parameters
    ----------
    got : array, shape (ns, nd, nl)
        Radiance of a model. [W m⁻² sr⁻¹ nm⁻¹]
    chosen : sequence of int
        Indices of the scans, one per row.
    name : str
        Name of the model.
    """
    title = "Domes, measured and computed"
    figure = new_figure(title, size=(9.6, 3.1 * len(chosen)))
    panels = figure.subplots(len(chosen), 3, squeeze=False)
    means = [(scans.radiance[k].mean(axis=1), got[k].mean(axis=1)) for k in chosen]
    brightest = MILLI * max(float(np.percentile(measured, 97.0)) for measured, _ in means)
    levels = 10.0 * np.arange(np.ceil(brightest / 10.0) + 1.0)
    for row, (k, (measured, ours)) in enumerate(zip(chosen, means, strict=True)):
        difference = 100.0 * (ours / measured - 1.0)
        for axes, values, word in (
            (panels[row, 0], measured, "measured"), (panels[row, 1], ours, name),
        ):  # fmt: skip
            sky = _dome(axes, scans, k, MILLI * values, levels, "viridis", "max")
            axes.set_title(f"{scans.time[k]}, {word}", fontsize=9)
        last = panels[row, 2]
        steps = np.linspace(-_WIDEST, _WIDEST, 17)
        apart = _dome(last, scans, k, difference, steps, "RdBu_r", "both")
        last.set_title(f"{scans.time[k]}, {name} over measured", fontsize=9)
        figure.colorbar(sky, ax=panels[row, :2], shrink=0.8, label=_UNIT)
        figure.colorbar(apart, ax=last, shrink=0.8, label="%")
    return ReportPicture.from_figure(
        figure,
        title=title,
        caption="Mean over the wavelengths. Zenith in the middle, rim at 78° from it, sun (circle) "
        "below; dots are the measured directions, between which both are interpolated alike.",
    )


def _dome(
    axes: Axes, scans: Scans, scan: int, values: FloatArray, levels: FloatArray, colors: str,
    beyond: str,
) -> TriContourSet:  # fmt: skip
    """Filled contours of values (nd,) on the dome, with the sun's side at the bottom."""
    around = np.radians(scans.azimuth[scan])
    x, y = scans.view_zenith[scan] * np.sin(around), -scans.view_zenith[scan] * np.cos(around)
    filled = axes.tricontourf(x, y, values, levels=levels, cmap=colors, extend=beyond)
    axes.plot(x, y, ".", color=GREY, markersize=1.0)
    axes.plot(0.0, -scans.sun_zenith[scan], "o", markersize=7, fillstyle="none", color="#000000")
    axes.set_aspect("equal")
    axes.set_axis_off()
    return filled
