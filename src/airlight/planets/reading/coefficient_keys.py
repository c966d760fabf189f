"""Keys of a constituent's coefficients in other forms than its fields."""

from __future__ import annotations

from typing import Final

from airlight.planets.constituent import coefficient_key
from airlight.planets.matter.state_keys import albedo_key, depth_key
from airlight.planets.schema.field import Field

EXTINCTION: Final = coefficient_key(
    "extinction",
    "Scattering and absorption together, where its profile is 1.",
    name="extinction",
    example="4.44e-6 /m",
    note="Not below the scattering.",
)
ALBEDO: Final = albedo_key(name="single_scattering_albedo", spectral=True, per="wavelengths")
DEPTH: Final = depth_key(
    "Of the whole air straight up.",
    name="optical_depth",
    spectral=True,
    per="wavelengths",
    note="Divided by the profile's column when the file is read.",
)
#: Keys in the order in which an editor shows them.
COEFFICIENT_KEYS: Final[tuple[Field, ...]] = (EXTINCTION, ALBEDO, DEPTH)
