"""Density profiles of a planet's constituents."""

from __future__ import annotations

from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.physics.optics.density_profile import DensitySegments
from airlight.planets.planet import Planet
from airlight.studies.plots.figure import PALETTE, grid, look, new_figure, words

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Densities below this fraction of a constituent's largest are not shown on the logarithmic panel.
_FAINTEST: Final = 1e-6


def density(planet: Planet) -> Figure:
    """Relative density of each constituent over altitude, linear and logarithmic.

    Returns
    -------
    Figure
        Two panels over altitude [km], with a curve per constituent.

    References
    ----------
    Atmosphere Plus notes 2, section 1.5.2.
    """
    rows = [constituent.profile.row(planet.thickness) for constituent in planet.constituents]
    altitude = np.linspace(0.0, planet.thickness, 1001)
    values = DensitySegments.from_rows(rows).at(altitude)
    figure = new_figure(
        f"{planet.name}: density of the constituents",
        "Relative density: 1 is where a constituent's coefficients are given.",
    )
    linear, logarithmic = figure.subplots(1, 2, sharey=True)
    for index, (constituent, curve) in enumerate(zip(planet.constituents, values, strict=True)):
        column = constituent.profile.column(planet.thickness)
        for axes in (linear, logarithmic):
            shown = np.where(curve > 0.0, curve, np.nan) if axes is logarithmic else curve
            name = words(f"{constituent.name} (column {column * 1e-3:.4g} km)")
            style = look(index, PALETTE[index % len(PALETTE)], name)
            axes.plot(shown, altitude * 1e-3, **(style | {"linewidth": 2.0}))
    for axes in (linear, logarithmic):
        grid(axes)
        axes.set_xlabel("relative density [1]")
    top = float(values.max())
    linear.set(xlim=(0.0, 1.05 * top), ylim=(0.0, planet.thickness * 1e-3))
    linear.set_ylabel("altitude [km]")
    linear.set_title("linear", loc="left", fontsize=10)
    logarithmic.set(xscale="log", xlim=(_FAINTEST * top, 2.0 * top))
    logarithmic.set_title("logarithmic", loc="left", fontsize=10)
    linear.legend(loc="upper right", fontsize=9, framealpha=1.0)
    return figure
