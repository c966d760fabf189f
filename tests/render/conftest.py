"""Solutions and cameras that the tests share: three wavelengths, preview, solved once."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from airlight import Planet, load_planet, replace
from airlight.solver.moments.solution import MomentsSolution

RGB = (680.0, 550.0, 440.0)


@pytest.fixture(scope="session")
def lit(solved: Callable[..., MomentsSolution]) -> Callable[..., MomentsSolution]:
    """Solution of a preset or a planet; ``wavelengths`` three, ``quality`` preview."""

    def make(
        planet: str | Planet = "earth-atmosphere-plus", wavelengths: tuple[float, ...] = RGB
    ) -> MomentsSolution:
        return solved(
            load_planet(planet) if isinstance(planet, str) else planet, wavelengths, "preview"
        )

    return make


@pytest.fixture(scope="session")
def with_star() -> Callable[[float], Planet]:
    """Earth of the Atmosphere Plus notes under a star of given angular radius. [deg]"""

    def make(degrees: float) -> Planet:
        planet = load_planet("earth-atmosphere-plus")
        return replace(planet, star=replace(planet.star, angular_radius=degrees))

    return make
