"""Vertical optical depth of each constituent over wavelength."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.planets.planet import Planet
from airlight.studies.plots.figure import PALETTE, grid, look, new_figure, wavelength_ink, words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Range of wavelengths shown of a planet with more data. [nm]
_SHOWN: Final = (300.0, 1000.0)
#: Optical depths below this fraction of the largest are not shown.
_FAINTEST: Final = 1e-5


def optical_depth(planet: Planet, wavelengths: tuple[float, ...] | None = None) -> Figure:
    """Vertical optical depth of each constituent and of all, over wavelength.

    Parameters
    ----------
    wavelengths : tuple of float, optional
        Wavelengths to mark; default: the planet's. [nm]

    Returns
    -------
    Figure
        One logarithmic panel; the last curve is the sum.
    """
    marks = planet.wavelengths if wavelengths is None else wavelengths
    low, high = planet.wavelength_limits
    if max(low, _SHOWN[0]) < min(high, _SHOWN[1]):
        low, high = max(low, _SHOWN[0]), min(high, _SHOWN[1])
    nm = np.linspace(low, high, 501)
    parts = []
    for constituent in planet.constituents:
        coefficient = constituent.scattering_coefficients(
            nm, planet.thickness
        ) + constituent.absorption_coefficients(nm, planet.thickness)
        parts.append(coefficient * constituent.profile.column(planet.thickness))
    total = np.sum(parts, axis=0)
    figure = new_figure(
        f"{planet.name}: vertical optical depth",
        "From the ground straight up to space, scattering and absorption together.",
    )
    axes = figure.add_subplot()
    grid(axes)
    for at, ink in zip(marks, wavelength_ink(marks), strict=True):
        axes.axvline(at, color=ink, linewidth=1.0, alpha=0.6)
    for index, (constituent, depth) in enumerate(zip(planet.constituents, parts, strict=True)):
        style = look(index + 1, PALETTE[index % len(PALETTE)], words(constituent.name))
        axes.plot(nm, np.where(depth > 0.0, depth, np.nan), **style)
    axes.plot(nm, np.where(total > 0.0, total, np.nan), color="black", linewidth=2.2, label="all")
    top = float(total.max())
    lowest = min(float(depth[depth > 0.0].min()) for depth in (*parts, total) if depth.any())
    lowest = max(0.7 * lowest, _FAINTEST * top)
    axes.set(
        yscale="log",
        ylim=(lowest, 1.5 * top * (top / lowest) ** 0.15),  # space for the legend
        xlim=(low, high),
        xlabel="wavelength [nm]",
        ylabel="vertical optical depth [1]",
    )
    axes.legend(loc="upper right", fontsize=9, ncols=2, framealpha=1.0)
    return figure
