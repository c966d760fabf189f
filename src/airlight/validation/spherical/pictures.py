"""Pictures of errors against an independent code: over sun zenith and altitude."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.studies.plots.figure import GREY, PALETTE, grid, new_figure, wavelength_ink
from airlight.validation.reference_earth import WAVELENGTHS
from airlight.validation.suite import ReportPicture

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

#: Edges of the bins in sun zenith. [deg]
SUN_EDGES = (0.0, 30.0, 60.0, 75.0, 82.0, 87.0, 89.0, 91.0, 93.0, 95.0, 180.0)


class Errors(NamedTuple):
    """Errors of one quality, n values.

    Attributes
    ----------
    suns, heights : array, shape (n,)
        Sun zenith angle [deg] and altitude [m] of the observer.
    errors : array, shape (n,)
        Relative errors, signed. [1]
    channels : array of int, shape (n,)
        Indices in ``WAVELENGTHS``.
    thresholds : (float, float, float)
        Allowed median, 95 % quantile and largest error. [1]
    """

    quality: str
    suns: FloatArray
    heights: FloatArray
    errors: FloatArray
    channels: NDArray[np.intp]
    thresholds: tuple[float, float, float]


def error_scatter(found: Errors) -> ReportPicture:
    """Plot every error over the sun's zenith angle, by wavelength."""
    title = f"Errors against Monte Carlo over sun zenith, {found.quality} quality"
    figure = new_figure(title, size=(9.0, 4.6))
    axes = figure.add_subplot()
    for channel, ink in enumerate(wavelength_ink(WAVELENGTHS)):
        chosen = found.channels == channel
        # Shifted slightly, so that one wavelength does not hide the next.
        suns, errors = found.suns[chosen] + 0.25 * (channel - 1), 100.0 * found.errors[chosen]
        name = f"{WAVELENGTHS[channel]:g} nm"
        axes.plot(suns, errors, ".", color=ink, markersize=2.5, label=name)
    for sign in (1.0, -1.0):
        for threshold, style in zip(found.thresholds[1:], ("--", "-"), strict=True):
            axes.axhline(sign * 100.0 * threshold, color=GREY, linewidth=0.8, linestyle=style)
    axes.set_yscale("symlog", linthresh=0.1, linscale=0.7)
    ticks = [-5.0, -2.0, -1.0, -0.5, -0.1, 0.0, 0.1, 0.5, 1.0, 2.0, 5.0]
    axes.set_yticks(ticks, [f"{tick:g}" for tick in ticks])
    axes.minorticks_off()
    axes.set_xlabel("sun zenith angle at the observer [°]")
    axes.set_ylabel("error [%]")
    axes.legend(loc="upper left", fontsize=9, markerscale=4.0)
    grid(axes)
    caption = (
        "Each point is one radiance. Linear within ±0.1 %, logarithmic beyond. Dashed: threshold "
        "for 95 % of the values; solid: for all of them, beyond the reference's noise."
    )
    return ReportPicture.from_figure(figure, title=title, caption=caption)


def error_histograms(found: Errors) -> ReportPicture:
    """Plot the median, 95 % quantile and largest error by sun zenith and by altitude."""
    suns, heights, thresholds = found.suns, found.heights, found.thresholds
    title = f"Errors by sun zenith and by altitude, {found.quality} quality"
    figure = new_figure(title, size=(9.0, 4.2))
    left, right = figure.subplots(1, 2, sharey=True)
    size = 100.0 * np.abs(found.errors)
    groups = []
    for low, high in pairwise(SUN_EDGES):
        name = f"{low:g}–{high:g}" if high < 180.0 else f"> {low:g}"
        groups.append((name, size[(suns >= low) & (suns < high)]))
    _grouped(left, groups, thresholds)
    left.set_xlabel("sun zenith angle at the observer [°]")
    left.set_ylabel("size of the error [%]")
    by_height = [(f"{h / 1e3:g}", size[heights == h]) for h in np.unique(heights)]
    _grouped(right, by_height, thresholds)
    right.set_xlabel("altitude of the observer [km]")
    figure.legend(*right.get_legend_handles_labels(), loc="outside lower center", ncols=3)
    caption = "The errors as they are, the reference's noise included. Numbers: values per bin."
    return ReportPicture.from_figure(figure, title=title, caption=caption)


def _grouped(
    axes: Axes, groups: list[tuple[str, FloatArray]], thresholds: tuple[float, float, float]
) -> None:
    named = [(name, values) for name, values in groups if values.size]
    at = np.arange(len(named))
    for k, (label, share) in enumerate((("median", 0.5), ("95 %", 0.95), ("largest", 1.0))):
        heights = [max(float(np.quantile(values, share)), 1e-3) for _, values in named]
        axes.bar(at + 0.27 * (k - 1), heights, width=0.25, color=PALETTE[k], label=label)
    axes.set_yscale("log")
    axes.set_ylim(1e-2, 30.0)
    axes.set_yticks([0.01, 0.1, 1.0, 10.0], ["0.01", "0.1", "1", "10"])
    for x, (_, values) in zip(at, named, strict=True):
        axes.text(float(x), 18.0, str(values.size), ha="center", fontsize=6.5, color=GREY)
    axes.set_xticks(at, [name for name, _ in named], fontsize=8, rotation=45)
    for k, threshold in enumerate(thresholds):
        axes.axhline(100.0 * threshold, color=PALETTE[k], linewidth=0.9, linestyle="--")
    grid(axes)
