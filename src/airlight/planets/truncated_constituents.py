"""Constituents whose profile is truncated by a low top of the shell."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from airlight.physics.optics.density_profile import DensitySegments

if TYPE_CHECKING:
    from airlight.planets.planet import Planet

#: Scale heights below the top from which no truncation is reported: exp(-8) is 0.03 %.
ENOUGH: Final = 8.0
#: Distance below the top over which the last scale height is computed, over the thickness. [1]
_STEP: Final = 1e-3


def truncated_constituents(planet: Planet) -> list[str]:
    """Constituents that the top of the shell truncates.

    With the scale height H at the top and the density n there, the column n H is missing. Uniform
    layers are not listed.

    Returns
    -------
    list of str
        One line for each constituent whose density falls by less than exp(8) up to the top.

    Examples
    --------
    >>> from airlight.planets import load_planet
    >>> truncated_constituents(load_planet("earth"))
    []
    >>> low = load_planet("earth-bruneton", {"shell.top_radius": "6400 km"})
    >>> print(truncated_constituents(low)[0])
    air ends at 40 km, 5 of its scale heights up: 0.67 % of its column is truncated
    """
    thickness = planet.thickness
    rows = [one.profile.row(thickness) for one in planet.constituents]
    heights = np.append(np.linspace(0.0, 1.0 - _STEP, 400), 1.0) * thickness
    lines = []
    for one, density in zip(
        planet.constituents, DensitySegments.from_rows(rows).at(heights), strict=True
    ):
        below, top, largest = float(density[-2]), float(density[-1]), float(density.max())
        if not 0.0 < top < below or math.log(largest / top) >= ENOUGH - 1e-6:
            continue
        height = _STEP * thickness / math.log(below / top)
        column = float(one.profile.column(thickness))
        share = top * height / (column + top * height)
        up = f"{math.log(largest / top):.2g} of its scale heights up"
        lost = f"{100.0 * share:.2g} % of its column is truncated"
        lines.append(f"{one.name} ends at {thickness / 1e3:.4g} km, {up}: {lost}")
    return lines
