"""Keys shared by several kinds of matter: state of a gas, number density, radius."""

from __future__ import annotations

from typing import Final

from airlight.planets.schema.field import Field, Wavelengths
from airlight.planets.schema.measures import DOBSON, column_of_gas
from airlight.planets.schema.toml_table import TomlTable

#: State of a gas: density, temperature and pressure where its profile is 1.
TEMPERATURE: Final = Field(
    help="Temperature of the gas where its profile is 1.",
    unit="K",
    range=(1.0, 1e5),
    slider=(20.0, 2000.0),
    scale="log",
    example="288.15 K",
)
PRESSURE: Final = Field(
    help="Pressure of the gas where its profile is 1.",
    unit="Pa",
    range=(1e-9, 1e10),
    shown="hPa",
    slider=(0.01, 1e5),
    scale="log",
    example="101325 Pa",
)
#: Number density of molecules or particles.
DENSITY: Final = Field(
    help="Molecules in a cubic metre, where its profile is 1.",
    unit="1/m^3",
    range=(1e10, 1e29),
    slider=(1e18, 1e28),
    scale="log",
    example="2.547e25 /m^3",
)
#: Depolarisation of molecules.
DEPOLARISATION: Final = Field(
    help="Depolarisation ratio of the molecules, 0 to 0.5.",
    range=(0.0, 0.5),
    spectral=True,
    example="0.035",
)
#: Refractivity n - 1 of a gas.
REFRACTIVITY: Final = Field(
    label="refractivity n - 1",
    help="Of the gas, at the state given with it.",
    range=(0.0, 1.0),
    slider=(1e-7, 1e-2),
    scale="log",
    spectral=True,
    example="2.78e-4",
)
#: Radius of a particle.
RADIUS: Final = Field(
    help="The same for all.",
    unit="m",
    range=(1e-10, 1e-3),
    shown="um",
    slider=(0.01, 20.0),
    scale="log",
    example="1.6 um",
    initial="0.5 um",
)
#: Single-scattering albedo.
ALBEDO: Final = Field(
    label="single-scattering albedo",
    help="Scattering over extinction.",
    range=(0.0, 1.0),
    example="0.9",
)
#: Vertical optical depth.
DEPTH: Final = Field(
    help="Of the whole air straight up.",
    range=(0.0, 1e4),
    slider=(1e-3, 30.0),
    scale="log",
    example="0.05",
)
#: Molar mass, gravity at the ground, and distance from which gravity falls, of a hydrostatic gas.
MOLAR_MASS: Final = Field(
    help="Molar mass of the gas.",
    unit="kg/mol",
    range=(1e-4, 1.0),
    example="28.9644 g/mol",
    shown="g/mol",
    slider=(1.0, 100.0),
    scale="log",
)
GRAVITY: Final = Field(
    help="Gravity at the ground.",
    unit="m/s^2",
    range=(1e-3, 1e4),
    example="9.80665 m/s^2",
    slider=(0.1, 100.0),
    scale="log",
)
GRAVITY_RADIUS: Final = Field(
    label="radius of gravity",
    help="Distance of the ground from the planet's centre.",
    note="Gravity falls with its square; without it gravity is constant.",
    unit="m",
    range=(1e3, 1e12),
    example="6356.766 km",
    shown="km",
    slider=(10.0, 1e5),
    scale="log",
)


def _column(table: TomlTable, name: str, wavelengths: Wavelengths) -> float:
    """Read a column of molecules. [m⁻²]"""
    return column_of_gas(table.required(name, "a column such as '345 DU'"), table.name_of(name))


#: Vertical column of a gas.
COLUMN: Final = Field(
    help="All of the gas above the ground.",
    unit="1/m^2",
    range=(0.0, 1e33),
    read=_column,
    example="345 DU",
    shown=DOBSON,
    slider=(1.0, 2000.0),
    scale="log",
)
