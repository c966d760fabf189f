"""Planets and moons of these tests."""

from __future__ import annotations

import numpy as np
import pytest

import airlight
from airlight.geometry.occulted_star import OccultedStar, occulted_star
from airlight.physics.spectra.limb_darkening import solar_darkening
from airlight.solver.eclipsed.solution import EclipsedSolution
from airlight.solver.moments.solution import MomentsSolution

NM = (440.0, 680.0)


def moon_over(
    solution: MomentsSolution, elevation: float, *, size: float = 1.03, beside: float = 0.0
) -> OccultedStar:
    """Moon in front of the sun over the place (0, 0, R), or ``beside`` it in y. [deg], [m]

    ``size`` is its apparent radius over the sun's.
    """
    towards = np.array([np.cos(np.radians(elevation)), 0.0, np.sin(np.radians(elevation))])
    alpha, distance = solution.lights[0].angular_radius, 370e6
    place = np.array([0.0, beside, solution.medium.bottom_radius])
    return occulted_star(
        place + distance * towards, distance * np.sin(size * alpha), towards, alpha,
        darkening=solar_darkening(solution.wavelengths), reach=solution.medium.top_radius,
    )  # fmt: skip


@pytest.fixture(scope="package")
def earth() -> MomentsSolution:
    return airlight.solve(airlight.load_planet("earth"), NM, quality="preview")


@pytest.fixture(scope="package")
def totality(earth: MomentsSolution) -> EclipsedSolution:
    return EclipsedSolution(earth, moon_over(earth, 45.0), cache=False)
