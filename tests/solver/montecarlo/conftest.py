"""Planets with one or two constituents, for questions with known answers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from airlight.planets import Constituent, Ground, Planet, Star
from airlight.planets.matter.phases import Rayleigh
from airlight.planets.matter.profiles import Exponential


@pytest.fixture(scope="session")
def one_air() -> Callable[..., Planet]:
    """Makes a planet whose air is one constituent, under a star of irradiance 1.

    ``depth`` is the vertical optical depth of scattering times the profile's column over the
    scale height of 8 km; ``absorption`` is given in /m.
    """

    def make(
        *, depth: float = 0.2, absorption: float = 0.0, albedo: float = 0.0, disc: float = 0.0,
        profile: Any = None, phase: Any = None, bottom: float = 6360e3, thickness: float = 100e3,
    ) -> Planet:  # fmt: skip
        return Planet(
            name="one air",
            bottom_radius=bottom,
            top_radius=bottom + thickness,
            ground=Ground(albedo=albedo),
            star=Star(irradiance=1.0, angular_radius=disc),
            constituents=(
                Constituent(
                    name="air",
                    profile=profile or Exponential(scale_height=8e3),
                    scattering=depth / 8e3,
                    absorption=absorption,
                    phase_function=phase or Rayleigh(),
                ),
            ),
        )

    return make
