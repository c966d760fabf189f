"""Monte Carlo against Monte Carlo: another program's radiances in exact spherical shells."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_less

from airlight import solve
from airlight.planets import Planet
from airlight.solver.montecarlo.settings import MonteCarloSettings

RGB = (680.0, 550.0, 440.0)
#: Scene, ground albedo, altitude [m], sun zenith, view zenith, azimuth [deg]: noon to twilight,
#: ground to space, both sides of the limb.
CASES = [
    ("full-cornette-shanks", 0.0, 0.0, 30.0, 85.0, 30.0),
    ("full-cornette-shanks", 0.3, 0.0, 60.0, 60.0, 0.0),
    ("full-cornette-shanks", 0.1, 0.0, 60.0, 0.0, 0.0),
    ("full-cornette-shanks", 0.3, 1000.0, 85.0, 60.0, 90.0),
    ("full-cornette-shanks", 0.1, 10000.0, 88.0, 89.5, 60.0),
    ("full-cornette-shanks", 0.1, 10000.0, 30.0, 105.0, 135.0),
    ("full-cornette-shanks", 0.0, 30000.0, 92.0, 95.0, 30.0),
    ("full-cornette-shanks", 0.1, 0.0, 92.0, 75.0, 60.0),
    ("full-cornette-shanks", 0.1, 500000.0, 80.0, 114.0, 90.0),
    ("full-cornette-shanks", 0.0, 500000.0, 60.0, 140.0, 30.0),
    ("full-henyey-greenstein", 0.1, 0.0, 60.0, 75.0, 30.0),
    ("full-henyey-greenstein", 0.1, 1000.0, 88.0, 120.0, 180.0),
    ("rayleigh-only", 0.1, 0.0, 88.0, 75.0, 60.0),
    ("rayleigh-ozone", 0.1, 0.0, 92.0, 75.0, 60.0),
]


@pytest.mark.slow
@pytest.mark.parametrize("every", [3, pytest.param(1, marks=pytest.mark.validation)])
def test_radiances_agree_within_three_standard_errors(
    every: int,
    reference_earth: Callable[..., Planet],
    reference_data: Path,
    tell: Callable[[str], None],
) -> None:
    # An authority: scalar, forced collisions, 1e6 histories a line. The seed is fixed.
    # Of 42 values (15 in the check) one in nine runs has one beyond three combined errors by chance
    # alone: at most one may be, none beyond four, and χ² of all together must be that of honest
    # errors.
    with (reference_data / "spherical-monte-carlo.csv").open() as stream:
        rows = list(csv.DictReader(stream))
    names = ("ground_albedo", "altitude_m", "sun_zenith_deg", "view_zenith_deg", "azimuth_deg")
    found = {(row["scene"], *(float(row[name]) for name in names)): row for row in rows}
    misses = []
    for case in CASES[::every]:
        row = found[case]
        kind, _, lobe = case[0].partition("-")
        planet = reference_earth(
            albedo=case[1], aerosol=lobe if kind == "full" else None,
            ozone=case[0] != "rayleigh-only",
        )  # fmt: skip
        settings = MonteCarloSettings(relative_error=0.002, most_histories=400_000)
        data = solve(planet, RGB, settings, solver="montecarlo", polarisation=False).estimate(
            altitude=case[2], sun_zenith=case[3], view_zenith=case[4], azimuth=case[5]
        )
        known = np.array([float(row[f"radiance_{nm:.0f}nm"]) for nm in RGB])
        noise = np.array([float(row[f"standard_error_{nm:.0f}nm"]) for nm in RGB])
        got, error = data["radiance"].values, data["standard_error"].values
        miss = (got - known) / np.hypot(error, noise)
        misses.append(miss)
        tell(
            f"Monte Carlo {case}: {', '.join(f'{x:+.2f} %' for x in 100 * (got / known - 1))}; "
            f"in standard errors {np.array2string(miss, precision=1)}"
        )
        assert (np.hypot(error, noise) < 0.01 * known).all()
    size = np.abs(misses)
    assert (size > 3.0).sum() <= 1
    assert_array_less(size, 4.0)
    # three wavelengths of a line of the reference share their histories
    assert np.mean(size**2) < 1.0 + 4.0 * np.sqrt(2.0 * 3.0 / size.size)
