"""A line marched once under many stars has the light that the march gives it under each."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.geometry.path import ray_length
from airlight.geometry.shell import meets_ground
from airlight.kernel import vectorized
from airlight.planets import load_planet
from airlight.planets import replace as changed
from airlight.solver import solve
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.march_sun_angles import scattering_by_constituent
from airlight.solver.moments.solution import MomentsSolution

#: Elevations of the stars [deg], and their azimuths from the lines. [deg]
_ELEVATIONS = (80.0, 30.0, 5.0, 0.1, -1.0, -4.0, -9.0)
_AZIMUTHS = (0.0, 20.0, 100.0, 180.0)


def _lines(solution: MomentsSolution) -> LinesOfSight:
    """Up, level, over the limb and down, from four heights, each under all stars."""
    medium = solution.medium
    bottom, top = medium.bottom_radius, medium.top_radius
    heights = bottom + (top - bottom) * np.array([0.0, 0.02, 0.3, 0.9])
    dip = np.sqrt(1.0 - (bottom / heights) ** 2)
    rows = []
    for r, low in zip(heights, dip, strict=True):
        for mu in (1.0, 0.3, -0.98 * low, -low - 0.1):
            for elevation in np.radians(_ELEVATIONS):
                for azimuth in np.radians(_AZIMUTHS):
                    side = np.sqrt(1.0 - mu * mu) * np.cos(elevation) * np.cos(azimuth)
                    rows.append((r, mu, np.sin(elevation), mu * np.sin(elevation) + side))
    r, mu, mu_s, nu = np.array(rows).T
    to_ground = vectorized(meets_ground)(r, mu, bottom)
    length = vectorized(ray_length)(r, mu, bottom, top)
    return LinesOfSight(r, mu, mu_s, np.clip(nu, -1.0, 1.0), length, to_ground)


@pytest.mark.parametrize(
    ("planet", "refraction"), [("earth", "none"), ("earth", "bouguer"), ("mars", "none")]
)
def test_many_stars_have_the_light_of_each(planet: str, refraction: str) -> None:
    """Everything agrees with single marches: their sums, and each constituent alone."""
    world = changed(load_planet(planet), refraction=refraction)
    solution = solve(world, wavelengths=(680.0, 550.0, 440.0), quality="preview")
    assert isinstance(solution, MomentsSolution)
    lines = _lines(solution)
    own = solution.medium.phase_function(
        solution.geometry.apparent_nu(solution.geometry.optical_lines(lines))
    )
    air = solution.tables._replace(broadened=False, scaled_extinction=solution.tables.extinction)
    for orders, delta_scaled, light in ((2, False, air), (0, True, None), (2, True, None)):
        found, once = scattering_by_constituent(solution, lines, orders, delta_scaled=delta_scaled)
        # Columns up to a panel come from whole panels or from those that a shadow cuts in two.
        near = {"rtol": 2e-3, "atol": 1e-7}
        assert_allclose(
            found, solution.radiance_per_irradiance(lines, orders, ground=False), **near
        )
        for c in range(own.shape[1]):
            alone = solution.radiance_per_irradiance(
                lines, 1, tables=light, scatterers=[c], ground=False
            )
            assert_allclose(once[:, c] * own[:, c], alone, **near)


def test_the_result_does_not_depend_on_company() -> None:
    """Stars marched together and stars in any other order have the same light."""
    world = changed(load_planet("earth"), refraction="none")
    solution = solve(world, wavelengths=(680.0, 550.0, 440.0), quality="preview")
    assert isinstance(solution, MomentsSolution)
    lines = _lines(solution)
    mixed = np.random.default_rng(5).permutation(lines.r.size)
    together, _ = scattering_by_constituent(solution, lines, 2, delta_scaled=False)
    apart, _ = scattering_by_constituent(
        solution,
        replace(
            lines,
            r=lines.r[mixed],
            mu=lines.mu[mixed],
            mu_s=lines.mu_s[mixed],
            nu=lines.nu[mixed],
            length=lines.length[mixed],
            to_ground=lines.to_ground[mixed],
        ),
        2,
        delta_scaled=False,
    )
    assert_allclose(apart, together[mixed], rtol=2e-3, atol=1e-7)
