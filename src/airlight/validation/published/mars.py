"""Mars: chromaticity of daylight.

Maki et al. (2021), Color properties at the Mars InSight landing site, Earth and Space Science 8,
e2020EA001336, abstract: the white point of daylight has x = 0.35, y = 0.34, standard deviations
0.01 and 0.02, by the cameras' pictures of the lander's calibration target.

Lemmon et al. (2024), Results from the InSight atmospheric imaging campaign, Icarus 421, 116248,
abstract: the optical depth of dust and ice at the lander was 0.5 to 1.9, typically under 1.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.image.spectral import default_wavelengths, rgb_weights
from airlight.image.xyz import chromaticity, rgb_to_xyz
from airlight.planets import load_planet
from airlight.validation.published.row import PublishedRow, PublishedSection, Solve
from airlight.validation.published.twilight import ground_light

#: Altitude of the sun. [deg]
DAY: Final = 60.0
#: Optical depth of the dust of the preset, and on a dusty day.
DUST: Final = (0.5, 1.0)


def daylight(solve: Solve, quality: object = "default") -> PublishedSection:
    """Chromaticity of global horizontal irradiance.

    Parameters
    ----------
    solve : callable
        See ``row.Solve``.
    """
    rows = []
    for dust in DUST:
        x, y = daylight_chromaticity(solve, quality, dust)
        for name, value, error, got in (("x", 0.35, 0.01, x), ("y", 0.34, 0.02, y)):
            rows.append(
                PublishedRow(
                    what=f"daylight on Mars, dust {dust:g}, chromaticity {name}", published=value,
                    # The preset is assessed; the dusty day shows the dependence on the dust.
                    ours=got, error=error if dust == DUST[0] else None,
                    source="Maki et al. (2021)", compare="difference",
                )
            )  # fmt: skip
    return PublishedSection(
        title="Daylight on Mars",
        rows=rows,
        note=f"Sun and sky together on level ground, sun {DAY:g}° high. The lander's days had "
        "optical depths of 0.5 to 1.9, typically under 1 (Lemmon et al. 2024); the preset has 0.5. "
        "The published errors are standard deviations.",
    )


def daylight_chromaticity(solve: Solve, quality: object, dust: float) -> tuple[float, float]:
    """Chromaticity x, y of global horizontal irradiance for an optical depth of dust. [1]"""
    mars = load_planet("mars", {"dust.particles.optical_depth": dust})
    solution = solve(mars, default_wavelengths(12).tolist(), quality)
    light = solution.lights[0]
    weights = rgb_weights(solution.wavelengths, light.spectrum)
    rgb = ground_light(solution, DAY) * light.irradiance @ weights
    x, y = np.asarray(chromaticity(rgb_to_xyz(rgb)))
    return float(x), float(y)
