"""Valid planet files, for tests that damage them."""

from __future__ import annotations

from pathlib import Path

import pytest

GOOD = """
name = "Test"
[shell]
bottom_radius = "6360 km"
top_radius = "6460 km"
[ground]
albedo = 0.1
[star]
irradiance = "1 W/m^2/nm"
angular_radius = "0.2678 deg"
[[constituents]]
name = "air"
profile = { kind = "exponential", scale_height = "8 km" }
wavelengths = "680, 550, 440 nm"
scattering = ["5.802e-6 /m", "13.558e-6 /m", "33.1e-6 /m"]
phase_function = { kind = "rayleigh" }
[[constituents]]
name = "aerosol"
profile = { kind = "exponential", scale_height = "1.2 km" }
scattering = "3.996e-6 /m"
absorption = "0.444e-6 /m"
phase_function = { kind = "cornette-shanks", asymmetry = 0.8 }
[[constituents]]
name = "ozone"
profile = { kind = "tent", center = "25 km", half_width = "15 km" }
wavelengths = "680, 550, 440 nm"
absorption = ["0.65e-6 /m", "1.881e-6 /m", "0.085e-6 /m"]
"""


@pytest.fixture
def good() -> str:
    """The file of the issue, except for a flat solar spectrum."""
    return GOOD


@pytest.fixture
def composed() -> str:
    """File by composition, with every kind of absorber."""
    return Path(__file__).with_name("composed.toml").read_text(encoding="utf-8")
