"""Points of lines of sight: as good as many times as many, by day and at dusk."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from airlight.planets import Constituent, Planet, load_planet, replace
from airlight.planets.matter.phases.formulas import Rayleigh
from airlight.planets.matter.profiles.formulas import Tent
from airlight.planets.spectral import PerWavelength
from airlight.render.pixels.march_points import FEW
from airlight.solver import solve
from airlight.solver.moments.march_panels import MANY_EDGES
from airlight.solver.moments.march_tables import quadratures
from airlight.solver.moments.solution import MomentsSolution

NM = (680.0, 550.0, 440.0)


def under_a_cloud(center: float, half_width: float, depth: float) -> Planet:
    """Air whose only layer with ends is high above what scatters; lengths in metres."""
    one = load_planet("earth-atmosphere-plus")
    cloud = Constituent(
        name="cloud",
        profile=Tent(center=center, half_width=half_width),
        scattering=PerWavelength(wavelengths=NM[::-1], values=(depth / half_width,) * 3),
        phase_function=Rayleigh(),
    )
    return replace(one, constituents=(*one.constituents, cloud))


CLOUDS = {"high layer": (55e3, 1e3, 1e-4), "narrow layer": (83e3, 500.0, 3e-5)}


@pytest.mark.parametrize(
    ("planet", "bound"),
    [
        ("earth", 4e-4),
        ("earth-atmosphere-plus", 1e-4),
        ("high layer", 2.5e-4),
        ("narrow layer", 1e-3),
    ],
)
def test_points_of_lines_of_sight_are_enough(
    planet: str, bound: float, tell: Callable[[str], None]
) -> None:
    # The same integral by 28 points in each of six panels a leg. Layers cut the lines of the first
    # planet, nothing those of the others where it matters: in one panel these would err by 1.5e-4
    # and 3.4e-4. With one end of the narrow layer alone its largest error would be 3.9e-2. The
    # solution's own error is 6e-3 at 95 %.
    one = under_a_cloud(*CLOUDS[planet]) if planet in CLOUDS else load_planet(planet)
    solution = solve(one, NM, cache=False)
    assert isinstance(solution, MomentsSolution)
    rng, n = np.random.default_rng(5), 1500
    height = solution.medium.thickness * np.where(rng.random(n) < 0.5, 0.0, rng.random(n) ** 2)
    lines, _ = solution.lines_of_sight(
        altitude=height,
        sun_zenith=rng.uniform(0.0, 96.0, n),
        view_zenith=rng.uniform(0, 180, n),
        azimuth=rng.uniform(0.0, 180.0, n),
    )
    many = solution.tables._replace(rules=quadratures((28,) * 4), panels=6)
    got, truth = (
        solution.radiance_per_irradiance(lines, 2),
        solution.radiance_per_irradiance(lines, 2, tables=many),
    )
    lit = truth > 1e-6 * truth.max(axis=0)
    error = np.abs(got[lit] / truth[lit] - 1.0)
    tell(f"{planet}: 95 % within {np.quantile(error, 0.95):.1e}, largest {error.max():.1e}")
    assert np.quantile(error, 0.95) < bound
    assert error.max() < 1e-2


def test_four_points_in_a_panel_are_enough_through_many_layers(
    tell: Callable[[str], None],
) -> None:
    # Lines from space onto the day side of a planet whose haze ends panels at more than ten
    # altitudes: those of pictures, and 28 points in each of three panels a leg.
    solution = solve(load_planet("neptune"), NM, "preview")
    rng, n = np.random.default_rng(7), 400
    sun = rng.uniform(0.0, 80.0, n)
    lines, _ = solution.lines_of_sight(
        altitude=1.01 * solution.medium.thickness,
        sun_zenith=sun,
        view_zenith=rng.uniform(110.0, 180.0, n),
        azimuth=rng.uniform(0.0, 180.0, n),
    )
    few, many = (
        solution.tables._replace(rules=quadratures(points), panels=panels)
        for points, panels in (FEW, ((28,) * 4, 3))
    )
    assert few.ends.size > MANY_EDGES
    got, truth = (solution.radiance_per_irradiance(lines, 2, tables=one) for one in (few, many))
    error = np.abs(got / truth - 1.0)
    tell(f"95 % within {np.quantile(error, 0.95):.1e}, largest {error.max():.1e}")
    assert np.quantile(error, 0.99) < 2e-3
