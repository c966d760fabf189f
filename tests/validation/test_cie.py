"""The comparison with the CIE sky: no difference from itself, and the aerosol where it belongs."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.planets import Medium, load_planet
from airlight.solver import Solution
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.report import Report
from airlight.validation.planets import round_earth

pytest.importorskip("matplotlib")

from airlight.validation.cie import (
    PLANE,
    dome_difference,
    gradation,
    indicatrix,
    plane_luminance,
    with_aerosol,
)

NM = (680.0, 550.0, 440.0)


class FittedSky(Solution):
    """The CIE sky itself, grey, as if it had been solved; ``tilt`` brightens it by view angle."""

    report = Report(solver="fit", settings="", sweeps=1, residual=(0.0,), seconds=0.0)

    def __init__(self, tilt: float = 0.0) -> None:
        self.medium = Medium.from_planet(round_earth(), NM)
        self.tilt = tilt

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> np.ndarray:
        sky = 0.01 * indicatrix(np.arccos(lines.nu)) * gradation(lines.mu)
        return np.repeat((sky * np.exp(self.tilt * (lines.mu < 0.999)))[:, None], 3, axis=1)

    def relative_sky_irradiance(self, r: np.ndarray, mu_s: np.ndarray) -> np.ndarray:
        return np.zeros((r.size, 3))

    relative_direct_irradiance = relative_sky_irradiance


def test_the_fit_does_not_differ_from_itself() -> None:
    # The angle between view and sun loses 1e-8 of a radian next to the sun.
    rms, mean, _ = dome_difference(FittedSky(), np.eye(3), 50.0)
    assert_allclose([rms, mean], 0.0, atol=1e-6)
    found = plane_luminance(FittedSky(), np.eye(3), 50.0)
    assert_allclose(found[PLANE == 0.0], 1.0, rtol=1e-12)
    assert_allclose(found[PLANE == 30.0], 2.976, atol=5e-4)  # the golden table


def test_a_sky_that_is_brighter_everywhere_but_at_the_zenith_differs_by_that() -> None:
    # By hand: ln of the factor, at all but a cap of 0.2 % of the dome.
    rms, mean, where = dome_difference(FittedSky(tilt=0.2), np.eye(3), 50.0)
    assert_allclose([rms, mean], 0.2, rtol=5e-3)
    assert where.endswith("+22 %")


def test_more_aerosol_is_more_of_the_aerosol_alone() -> None:
    # Optical depths are proportional to coefficients.
    earth = load_planet("earth")
    thin, thick = (Medium.from_planet(with_aerosol(earth, k), NM) for k in (1.0, 3.0))
    ratio = thick.vertical_optical_depth / thin.vertical_optical_depth
    assert_allclose(ratio, [[1.0] * 3, [3.0] * 3, [1.0] * 3, [1.0] * 3], rtol=1e-12)
