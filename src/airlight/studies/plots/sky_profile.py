"""Cuts through the sky: along the principal plane, and along the almucantar."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.solver.solution import Solution
from airlight.studies.plots.figure import LINE_STYLES, chosen, grid, new_figure, wavelength_ink

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Largest zenith angle of the almucantar. [deg]
LOWEST_CIRCLE: Final = 85.0
#: Largest number of wavelengths drawn.
_MOST: Final = 6


def sky_profile(solution: Solution, *, sun_zenith: float = 60.0, altitude: float = 0.0) -> Figure:
    """Radiance in the principal plane and along the almucantar.

    Parameters
    ----------
    sun_zenith : float
        Zenith angle of the sun, 0 to 180. [deg]
    altitude : float
        Altitude of the observer. [m]

    Returns
    -------
    Figure
        Two logarithmic panels, one curve per wavelength: over the view zenith angle, negative on
        the side away from the sun; and over the azimuth from the sun at the sun's zenith angle, or
        at 85° if the sun is lower. Without the sun's disc.
    """
    view = np.linspace(-90.0, 90.0, 361)
    circle = min(sun_zenith, LOWEST_CIRCLE)
    around = np.linspace(0.0, 180.0, 361)
    plane = solution.radiance(
        altitude=altitude,
        sun_zenith=sun_zenith,
        view_zenith=np.abs(view),
        azimuth=np.where(view < 0.0, 180.0, 0.0),
    )
    ring = solution.radiance(
        altitude=altitude, sun_zenith=sun_zenith, view_zenith=circle, azimuth=around
    )
    name = solution.planet.name if solution.planet is not None else "planet"
    figure = new_figure(
        f"{name}: profiles of the sky",
        f"Sun zenith angle {sun_zenith:.4g}°, observer at {altitude * 1e-3:.4g} km; "
        "without the sun's own disc.",
    )
    left, right = figure.subplots(1, 2, sharey=True)
    nm = solution.wavelengths
    shown = chosen(nm, _MOST)
    inks = wavelength_ink(nm)
    for index, k in enumerate(shown):
        for axes, angle, values in (
            (left, view, np.asarray(plane)[:, k]),
            (right, around, np.asarray(ring)[:, k]),
        ):
            axes.plot(
                angle,
                np.where(values > 0.0, values, np.nan),
                color=inks[k],
                linestyle=LINE_STYLES[index % len(LINE_STYLES)],
                linewidth=1.8,
                label=f"{nm[k]:.4g} nm",
            )
    for axes in (left, right):
        grid(axes)
        axes.set_yscale("log")
    if sun_zenith <= 90.0:
        left.axvline(sun_zenith, color="black", linewidth=0.8, linestyle=":")
    left.set(
        xlim=(-90.0, 90.0),
        xticks=range(-90, 91, 30),
        xlabel="view zenith angle [°], positive towards the sun",
        ylabel="radiance [W m⁻² sr⁻¹ nm⁻¹]",
    )
    left.set_title("principal plane", loc="left", fontsize=10)
    right.set(xlim=(0.0, 180.0), xticks=range(0, 181, 30), xlabel="azimuth from the sun [°]")
    right.set_title(f"circle at view zenith angle {circle:.4g}°", loc="left", fontsize=10)
    right.legend(loc="upper right", fontsize=9, framealpha=1.0)
    return figure
