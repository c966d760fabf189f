"""A planet, its solution, and a stand-in whose light is a known function of the line of sight."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np
import pytest

pytest.importorskip("matplotlib")

from airlight import load_planet
from airlight.planets import Medium, Planet
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.report import Report
from airlight.solver.solution import Solution

if TYPE_CHECKING:
    from numpy.typing import NDArray

Light = Callable[[LinesOfSight, int | None], "NDArray[np.float64]"]


class KnownLight(Solution):
    """Light by a formula, per irradiance of the star; keeps the lines of sight it was asked for."""

    def __init__(self, planet: Planet, light: Light, orders: int = 1) -> None:
        self.planet = planet
        self.medium = Medium.from_planet(planet, planet.wavelengths)
        self.report = Report(solver="formula", settings="", sweeps=0, residual=(0.0,), seconds=0.0)
        self.highest_order = orders
        self.light = light
        self.asked: list[LinesOfSight] = []

    def relative_radiance(
        self, lines: LinesOfSight, *, order: int | None = None
    ) -> NDArray[np.float64]:
        self.asked.append(lines)
        return np.repeat(self.light(lines, order)[:, None], self.wavelengths.size, axis=1)

    def relative_sky_irradiance(
        self, r: NDArray[np.float64], mu_s: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        raise NotImplementedError

    def relative_direct_irradiance(
        self, r: NDArray[np.float64], mu_s: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        raise NotImplementedError


@pytest.fixture(scope="session")
def planet() -> Planet:
    """The planet of the golden numbers."""
    return load_planet("earth-atmosphere-plus")


@pytest.fixture(scope="session")
def solution(planet: Planet, solved: Callable[..., Solution]) -> Solution:
    return solved(planet, None, "preview")


@pytest.fixture(scope="session")
def known_light(planet: Planet) -> Callable[..., KnownLight]:
    return lambda light, orders=1: KnownLight(planet, light, orders)
