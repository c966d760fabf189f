"""Pictures of a fit: residuals by wavelength and angle, domes, correlations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.studies.fit.fit_sky import SkyFit
from airlight.studies.fit.least_squares import FitResult
from airlight.studies.fit.residuals import SUN_EDGES, ZENITH_EDGES, Binned, Residuals, binned
from airlight.studies.plots.figure import GREY, PALETTE, chosen, grid, new_figure, wavelength_ink
from airlight.studies.reports.parts import ReportPicture

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

#: Limit of the colour scale of relative differences. [%]
_LEAST_LIMIT, _LARGEST_LIMIT = 2.0, 40.0
#: Largest number of scans that are shown as domes.
_MOST_DOMES: Final = 3
#: Smallest number of directions of a scan for a dome.
_DOME: Final = 12


def residual_curves(residuals: Residuals, title: str = "Residuals") -> ReportPicture:
    """Residuals by wavelength, by angle from the sun and by view zenith angle.

    Parameters
    ----------
    title : str
        Title of the picture.
    """
    figure = new_figure(title, size=(12.0, 4.2))
    axes = figure.subplots(1, 3, sharey=True)
    by = (
        ("wavelength [nm]", binned(residuals, residuals.wavelength, _wavelength_edges(residuals))),
        ("angle from the sun [°]", binned(residuals, residuals.from_sun, SUN_EDGES)),
        ("view zenith angle [°]", binned(residuals, residuals.view_zenith, ZENITH_EDGES)),
    )
    reach = 1.15 * max(0.1, *(float(bins.spread.max()) for _, bins in by))
    axes[0].set_ylim(-reach, reach)
    for one, (label, bins) in zip(axes, by, strict=True):
        _curve(one, bins)
        one.set_xlabel(label)
    axes[0].set_ylabel("fit over measured, less 1 [%]")
    axes[0].legend(fontsize=9, loc="upper left")
    return ReportPicture.from_figure(
        figure,
        title=title,
        caption="Line: mean of the relative differences. Band: their root mean square about 0. "
        "Grey bars: share of the squared differences, of the axis's height.",
    )


def _wavelength_edges(residuals: Residuals) -> FloatArray | None:
    """Edges of wavelength bins, for many wavelengths."""
    nm = np.unique(residuals.wavelength)
    return None if nm.size <= 64 else np.linspace(nm[0], nm[-1] * (1.0 + 1e-9), 49)


def _curve(axes: Axes, bins: Binned) -> None:
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    band: Any = {"color": PALETTE[0], "alpha": 0.18, "linewidth": 0.0}
    axes.fill_between(bins.middle, -bins.spread, bins.spread, label="root mean square", **band)
    axes.plot(bins.middle, bins.bias, color=PALETTE[1], marker=".", label="mean")
    grid(axes)
    share = axes.twinx()
    width = 0.6 * float(np.diff(bins.middle).min()) if bins.middle.size > 1 else 1.0
    share.bar(bins.middle, bins.share, width=width, color=GREY, alpha=0.3)
    share.set_ylim(0.0, 1.0)
    share.set_axis_off()


def value_plot(residuals: Residuals, title: str = "Measured and fitted values") -> ReportPicture:
    """Fitted over measured values, by colour, and the distribution of the residuals."""
    figure = new_figure(title, size=(10.0, 4.6))
    left, right = figure.subplots(1, 2)
    nm = np.unique(residuals.wavelength)
    for k, ink in zip(chosen(nm, 5), wavelength_ink(nm[chosen(nm, 5)]), strict=True):
        at = residuals.wavelength == nm[k]
        measured, predicted, name = (
            residuals.measured[at],
            residuals.predicted[at],
            f"{nm[k]:.4g} nm",
        )
        name = f"{nm[k]:.4g} nm"
        left.plot(measured, predicted, ".", color=ink, markersize=3, label=name)
    ends = [float(residuals.measured.min()), float(residuals.measured.max())]
    left.plot(ends, ends, color=GREY, linewidth=0.8)
    if ends[0] > 0.0 and residuals.predicted.min() > 0.0:
        left.set_xscale("log")
        left.set_yscale("log")
    left.set_xlabel(f"measured [{residuals.unit}]")
    left.set_ylabel(f"fitted [{residuals.unit}]")
    left.legend(fontsize=8, markerscale=3)
    grid(left)
    pulls = (residuals.predicted - residuals.measured) / residuals.sigma
    steps = np.linspace(-5.0, 5.0, 51)
    right.hist(np.clip(pulls, -4.99, 4.99), bins=steps.tolist(), density=True, color=PALETTE[0])
    right.plot(
        steps, np.exp(-0.5 * steps**2) / np.sqrt(2.0 * np.pi), color=PALETTE[1], label="Gaussian"
    )
    right.set_xlabel("residual over standard deviation")
    right.set_ylabel("density")
    right.legend(fontsize=9)
    grid(right)
    return ReportPicture.from_figure(
        figure,
        title=title,
        caption="Left: one point a value, on the line where both agree. Right: residuals in "
        "standard deviations; what is beyond 5 stands in the last bars.",
    )


def dome_pictures(
    residuals: Residuals, title: str = "Residuals over the sky"
) -> ReportPicture | None:
    """Measured values, fitted values and differences on the dome; None with few directions."""
    scans = [k for k in range(len(residuals.scans)) if _seen(residuals, k)[0].size >= _DOME]
    if not scans:
        return None
    scans = [scans[k] for k in chosen(scans, _MOST_DOMES)]
    figure = new_figure(title, size=(10.5, 3.3 * len(scans) + 0.6))
    panels = figure.subplots(len(scans), 3, squeeze=False)
    found = [_seen(residuals, k) for k in scans]
    differences = np.concatenate([one[4] for one in found])
    limit = float(np.clip(np.percentile(np.abs(differences), 95.0), _LEAST_LIMIT, _LARGEST_LIMIT))
    for row, (k, (x, y, measured, fitted, residual)) in enumerate(zip(scans, found, strict=True)):
        top = float(np.percentile(measured, 98.0))
        sun = float(residuals.sun_zenith[residuals.scan == k].mean())
        for axes, values, word in zip(
            panels[row], (measured, fitted), ("measured", "fitted"), strict=False
        ):
            shown = axes.scatter(x, y, c=values, s=26, cmap="viridis", vmin=0.0, vmax=top)
            _frame(axes, f"{residuals.scans[k]}, {word}", sun)
        figure.colorbar(shown, ax=panels[row, :2], shrink=0.8, label=residuals.unit)
        last = panels[row, 2]
        apart = last.scatter(x, y, c=residual, s=26, cmap="RdBu_r", vmin=-limit, vmax=limit)
        _frame(last, f"{residuals.scans[k]}, fitted over measured", sun)
        figure.colorbar(apart, ax=last, shrink=0.8, label="%")
    return ReportPicture.from_figure(
        figure,
        title=title,
        caption="Mean over the wavelengths; one dot a direction. Zenith in the middle, rings at "
        "30°, 60° and 90° from it, sun (circle) below.",
    )


def _seen(residuals: Residuals, scan: int) -> tuple[FloatArray, ...]:
    """Positions on the dome, and measured, fitted and relative difference of a scan."""
    at = residuals.scan == scan
    places = np.stack([residuals.view_zenith[at], residuals.azimuth[at]], axis=-1)
    unique, row = np.unique(places, axis=0, return_inverse=True)
    row = row.reshape(-1)
    count = np.bincount(row)
    measured = np.bincount(row, residuals.measured[at]) / count
    fitted = np.bincount(row, residuals.predicted[at]) / count
    around = np.radians(unique[:, 1])
    x, y = unique[:, 0] * np.sin(around), -unique[:, 0] * np.cos(around)
    return x, y, measured, fitted, 100.0 * (fitted / measured - 1.0)


def _frame(axes: Axes, title: str, sun: float) -> None:
    turn = np.linspace(0.0, 2.0 * np.pi, 181)
    for ring in (30.0, 60.0, 90.0):
        axes.plot(ring * np.sin(turn), ring * np.cos(turn), color="#cccccc", linewidth=0.6)
    if sun <= 95.0:
        axes.plot(0.0, -sun, "o", markersize=8, fillstyle="none", color="#000000")
    axes.set_title(title, fontsize=9)
    axes.set_aspect("equal")
    axes.set_axis_off()


def correlation_picture(found: FitResult, title: str = "Correlations") -> ReportPicture | None:
    """Correlation matrix of the first parameters; None for a single parameter."""
    count = min(len(found.parameters), 16)
    if count < 2:
        return None
    names = [one.name for one in found.parameters[:count]]
    figure = new_figure(title, size=(2.6 + 0.6 * count, 2.0 + 0.5 * count))
    axes = figure.subplots()
    values = found.errors.correlation[:count, :count]
    shown = axes.imshow(values, cmap="RdBu_r", vmin=-1.0, vmax=1.0)
    axes.set_xticks(range(count), names, rotation=40, ha="right", fontsize=8)
    axes.set_yticks(range(count), names, fontsize=8)
    middle: Any = {"ha": "center", "va": "center", "fontsize": 8}
    for i in range(count):
        for j in range(count):
            ink = "#ffffff" if abs(values[i, j]) > 0.6 else "#000000"
            axes.text(j, i, f"{values[i, j]:.2f}", color=ink, **middle)
    figure.colorbar(shown, ax=axes, shrink=0.8)
    return ReportPicture.from_figure(
        figure,
        title=title,
        caption="Two parameters near ±1 are nearly degenerate in these data.",
    )


def pictures_of(sky: SkyFit, residuals: Residuals) -> list[ReportPicture]:
    """All pictures of a fit, in the order of its report."""
    found = [draw(residuals) for draw in (residual_curves, dome_pictures, value_plot)]
    return [one for one in (*found, correlation_picture(sky.fitted)) if one is not None]
