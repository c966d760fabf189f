"""Analytic density profiles: exponential, tent, uniform."""

from __future__ import annotations

from typing import Final

from airlight.physics.optics import density_profile
from airlight.physics.optics.density_profile import Row
from airlight.physics.optics.rayleigh import scale_height
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.matter.state_keys import GRAVITY, MOLAR_MASS, TEMPERATURE
from airlight.planets.parameters import parameters
from airlight.planets.schema.field import Field, Wavelengths, key
from airlight.planets.schema.toml_model import TomlModel
from airlight.planets.schema.toml_table import TomlTable


@parameters
class BulkGas(TomlModel):
    """Isothermal gas whose scale height is RT/(Mg).

    Parameters
    ----------
    temperature : float
        Temperature T. [K]
    molar_mass : float
        Molar mass M. [kg mol⁻¹]
    gravity : float
        Gravitational acceleration g. [m s⁻²]
    """

    mode = "advanced"

    temperature: float = key(
        TEMPERATURE,
        help="Temperature T in the scale height RT/(Mg).",
        range=(0.0, 1e30),
        open_ends=True,
        slider=(20.0, 1000.0),
        input_range=(1e-3, 1e9),
    )
    molar_mass: float = key(
        MOLAR_MASS,
        help="Molar mass M in the scale height RT/(Mg).",
        range=(0.0, 1e30),
        open_ends=True,
        input_range=(1e-6, 1e9),
    )
    gravity: float = key(
        GRAVITY,
        help="Gravity g in the scale height RT/(Mg).",
        range=(0.0, 1e30),
        open_ends=True,
        input_range=(1e-6, 1e9),
    )


def _scale_height(table: TomlTable, name: str, wavelengths: Wavelengths) -> float:
    """Read a scale height, explicit or by the bulk parameters of a gas. [m]"""
    if not isinstance(table.raw(name), dict):
        return table.number(name, "m", "8 km")
    gas = BulkGas.read(table.table(name, "a length such as '8 km'"))
    return scale_height(gas.temperature, gas.molar_mass, gas.gravity)


#: Height over which a density falls: layers thinner than a metre are surfaces.
HEIGHT: Final = Field(
    help="Each such step up thins it by a factor of e.",
    unit="m",
    range=(1.0, 1e9),
    example="8 km",
    shown="km",
    slider=(0.1, 100.0),
    scale="log",
)


@parameters
class Exponential(Profile):
    """Exponential profile exp(-h/H).

    Parameters
    ----------
    scale_height : float
        Scale height H, 1 to 1e9. [m]

    Examples
    --------
    >>> f"{Exponential(scale_height=8000.0).column(100e3):.4f}"
    '7999.9702'
    """

    keyword = "exponential"

    scale_height: float = key(
        HEIGHT,
        note="Or from bulk parameters, RT/(Mg): `{ temperature, molar_mass, gravity }`.",
        read=_scale_height,
        table=BulkGas,
        initial_fraction=0.08,
    )

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        return density_profile.exponential(self.scale_height, thickness)


@parameters
class Tent(Profile):
    """Tent profile ``max(0, 1 - |h - center|/half_width)``.

    Parameters
    ----------
    center : float
        Altitude of the peak. [m]
    half_width : float
        Distance from the peak to density 0. [m]
    """

    keyword = "tent"

    center: float = key(
        label="centre",
        help="Altitude of the maximum density.",
        unit="m",
        range=(0.0, 1e9),
        example="25 km",
        shown="km",
        slider=(0.0, 100.0),
        initial_fraction=0.25,
    )
    half_width: float = key(
        HEIGHT,
        help="From the altitude where it is densest to where it ends.",
        example="15 km",
        initial_fraction=0.15,
    )

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        return density_profile.tent(self.center, self.half_width, thickness)


@parameters
class Uniform(Profile):
    """Uniform profile: 1 everywhere in the shell."""

    keyword = "uniform"

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        return density_profile.uniform(thickness)
