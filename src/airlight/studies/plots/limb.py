"""Limb radiance over tangent height, seen from space."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.physics.units import values_in
from airlight.solver.solution import Solution
from airlight.studies.observables.limb import limb_radiance
from airlight.studies.plots.figure import chosen, grid, look, new_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Zenith angles of the sun at the tangent point. [deg]
SUN_ZENITHS: Final = (0.0, 30.0, 60.0, 80.0, 90.0, 96.0)
#: Lowest tangent height as a fraction of the shell's thickness, and number of heights.
_LOWEST, _COUNT = -0.15, 231
#: Radiances below this fraction of a panel's largest are not shown.
_FAINTEST: Final = 1e-8


def limb(solution: Solution, sun_zeniths: Sequence[float] = SUN_ZENITHS) -> Figure:
    """Radiance of the limb over tangent height, seen from space.

    Parameters
    ----------
    sun_zeniths : sequence of float
        Zenith angles of the sun at the tangent point. [deg]

    Returns
    -------
    Figure
        One panel for each of at most three wavelengths, one curve per sun angle; the sun is at
        right angles to the line of sight.
    """
    medium = solution.medium
    height = medium.thickness * np.linspace(_LOWEST, 1.0, _COUNT)
    suns = values_in(sun_zeniths, "deg", "sun_zeniths")
    radiance = limb_radiance(solution, height[None, :], suns[:, None])
    name = solution.planet.name if solution.planet is not None else "planet"
    figure = new_figure(
        f"{name}: limb seen from space",
        "Sun at right angles to the line of sight; its zenith angle is that at the tangent point.\n"
        "Below a tangent height of 0 the line of sight ends on the ground.",
        size=(8.0, 5.4),
    )
    import matplotlib
    from matplotlib.ticker import LogLocator

    colors = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.88, suns.size))
    shown = chosen(solution.wavelengths, 3)
    panels = figure.subplots(1, len(shown), sharey=True, squeeze=False)[0]
    for axes, k in zip(panels, shown, strict=True):
        grid(axes)
        for index, sun in enumerate(suns):
            values = radiance[index, :, k]
            lit, name = np.where(values > 0.0, values, np.nan), f"sun {sun:.4g}°"
            axes.plot(lit, height * 1e-3, **look(index, colors[index], name))
        top = float(radiance[..., k].max())
        axes.axhline(0.0, color="black", linewidth=0.8)
        axes.set_title(f"{solution.wavelengths[k]:.4g} nm", fontsize=10)
        axes.set(xscale="log", ylim=(height[0] * 1e-3, height[-1] * 1e-3))
        if top > 0.0:
            lowest = float(radiance[..., k][radiance[..., k] > 0.0].min())
            axes.set_xlim(max(_FAINTEST * top, 0.05 * lowest), 3.0 * top)
            axes.xaxis.set_major_locator(LogLocator(numticks=5))
        axes.set_xlabel("radiance\n[W m⁻² sr⁻¹ nm⁻¹]")
    panels[0].set_ylabel("tangent height [km]")
    panels[0].legend(loc="lower left", fontsize=8.5, framealpha=0.9)
    return figure
