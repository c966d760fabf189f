"""Keys of a hydrostatic gas: molar mass and gravity."""

from __future__ import annotations

from typing import Any

from airlight.planets.schema.field import Field


def molar_mass_key(**more: Any) -> Field:
    """Key of the molar mass of a hydrostatic gas."""
    return Field(label="molar mass", help="Molar mass of the gas.", unit="kg/mol",
               range=(1e-4, 1.0), example="28.9644 g/mol", shown="g/mol", slider=(1.0, 100.0),
               scale="log", mode="advanced", **more)  # fmt: skip


def gravity_key(**more: Any) -> Field:
    """Key of the gravity at the ground."""
    return Field(label="gravity", help="Gravity at the ground.", unit="m/s^2", range=(1e-3, 1e4),
               example="9.80665 m/s^2", slider=(0.1, 100.0), scale="log", mode="advanced",
               **more)  # fmt: skip


def gravity_radius_key(**more: Any) -> Field:
    """Key of the radius of the inverse-square law of gravity."""
    return Field(label="radius of gravity", help="Distance of the ground from the planet's centre.",
               note="Gravity falls with its square; without it gravity is constant.", unit="m",
               range=(1e3, 1e12), example="6356.766 km", shown="km", slider=(10.0, 1e5),
               scale="log", mode="advanced", **more)  # fmt: skip
