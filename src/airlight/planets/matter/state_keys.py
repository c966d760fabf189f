"""Keys shared by several kinds of matter: state of a gas, number density, radius."""

from __future__ import annotations

from typing import Any

from airlight.planets.schema.field import Field

#: State of a gas: density, temperature and pressure where its profile is 1.
_HERE = "of the gas where its profile is 1"


def temperature_key(label: str = "temperature", of: str = _HERE, **more: Any) -> Field:
    """Key of the temperature of a gas."""
    return Field(label=label, help=f"Temperature {of}.", unit="K", range=(1.0, 1e5),
               slider=(20.0, 2000.0), scale="log", mode="advanced", example="288.15 K",
               **more)  # fmt: skip


def pressure_key(label: str = "pressure", of: str = _HERE, **more: Any) -> Field:
    """Key of the pressure of a gas."""
    return Field(label=label, help=f"Pressure {of}.", unit="Pa", range=(1e-9, 1e10), shown="hPa",
               slider=(0.01, 1e5), scale="log", mode="advanced", example="101325 Pa",
               **more)  # fmt: skip


def density_key(
    label: str = "number density",
    text: str = "Molecules in a cubic metre, where its profile is 1.",
    least: float = 1e10,
    **more: Any,
) -> Field:
    """Key of the number density of molecules or particles."""
    fields = {"slider": (1e18, 1e28), "example": "2.547e25 /m^3", **more}
    return Field(label=label, help=text, unit="1/m^3", range=(least, 1e29), scale="log",
               mode="advanced", **fields)  # fmt: skip


def depolarisation_key(**more: Any) -> Field:
    """Key of the depolarisation of molecules."""
    return Field(label="depolarisation", help="Depolarisation ratio of the molecules, 0 to 0.5.",
               range=(0.0, 0.5), spectral=True, example="0.035", per="wavelengths",
               mode="advanced", **more)  # fmt: skip


def refractivity_key(text: str = "Of the gas, at the state given with it.", **more: Any) -> Field:
    """Key of the refractivity n - 1 of a gas."""
    return Field(label="refractivity n - 1", help=text, range=(0.0, 1.0), slider=(1e-7, 1e-2),
               scale="log", spectral=True, example="2.78e-4", per="wavelengths", mode="advanced",
               **more)  # fmt: skip


def radius_key(label: str, text: str, **more: Any) -> Field:
    """Key of the radius of a particle."""
    fields = {"range": (1e-10, 1e-3), "shown": "um", "slider": (0.01, 20.0), "example": "1.6 um",
              "initial": "0.5 um", **more}  # fmt: skip
    return Field(label=label, help=text, unit="m", scale="log", mode="advanced", **fields)


def albedo_key(**more: Any) -> Field:
    """Key of the single-scattering albedo."""
    return Field(label="single-scattering albedo", help="Scattering over extinction.",
               range=(0.0, 1.0), example="0.9", **more)  # fmt: skip


def depth_key(text: str, **more: Any) -> Field:
    """Key of a vertical optical depth."""
    return Field(label="optical depth", help=text, range=(0.0, 1e4), slider=(1e-3, 30.0),
               scale="log", example="0.05", **more)  # fmt: skip
