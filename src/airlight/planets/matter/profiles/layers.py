"""Hydrostatic density of a gas in layers of constant lapse rate: a standard atmosphere."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import Row
from airlight.physics.optics.hydrostatic import (
    HydrostaticLayers,
    mass_per_length,
    thickness_of_layer,
)
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.matter.state_keys import GRAVITY, GRAVITY_RADIUS, MOLAR_MASS
from airlight.planets.parameters import MISSING, ascending, parameters
from airlight.planets.schema.field import always, key

#: Largest number of layers.
MOST_LAYERS: Final = 100


@parameters
class Layers(Profile):
    """Hydrostatic ideal gas in layers of constant lapse rate; density 1 at the ground.

    Parameters
    ----------
    altitudes : tuple of float, optional
        Altitudes of the layers' bases, ascending from 0; geopotential with ``gravity_radius``. [m]
    pressures : tuple of float, optional
        Pressures of the bases instead, descending from that at the ground. [Pa]
    temperature : float
        Temperature at the ground. [K]
    lapse_rates : tuple of float
        Lapse rate of each layer: decrease of temperature with altitude. [K m⁻¹]
    molar_mass : float
        Molar mass of the gas. [kg mol⁻¹]
    gravity : float
        Gravity at the ground. [m s⁻²]
    gravity_radius : float, optional
        Radius of the ground in the inverse-square law of gravity. [m]

    Examples
    --------
    >>> layers = Layers(altitudes=(0.0, 11e3), temperature=288.15, lapse_rates=(6.5e-3, 0.0),
    ...                 molar_mass=28.9644e-3, gravity=9.80665)
    >>> f"{1.225 * float(layers.air.density_ratio(11e3)):.4f}"  # kg/m^3
    '0.3639'
    """

    keyword = "layers"
    mode = "advanced"

    altitudes: tuple[float, ...] | None = key(
        label="base altitude",
        help="Altitudes of the layers' bases, from 0 up.",
        note="It or `pressures`. Geopotential altitudes beside a `gravity_radius`.",
        unit="m",
        range=(0.0, 1e9),
        example="0, 11, 20 km",
        shown="km",
        slider=(0.0, 100.0),
        default=None,
    )
    pressures: tuple[float, ...] | None = key(
        label="base pressure",
        help="Pressures of the layers' bases, instead of altitudes, from the ground up.",
        unit="Pa",
        range=(1e-12, 1e10),
        example="1013.25, 226.32 hPa",
        shown="hPa",
        slider=(1e-5, 1e5),
        scale="log",
        default=None,
    )
    temperature: float = key(
        help="Temperature at the ground.",
        unit="K",
        range=(1.0, 1e5),
        example="288.15 K",
        slider=(20.0, 1000.0),
        scale="log",
        initial="288.15 K",
    )
    lapse_rates: tuple[float, ...] = key(
        label="lapse rate",
        help="Lapse rate of each layer: decrease of temperature with altitude.",
        note="One for each base; negative where it grows warmer upwards.",
        unit="K/m",
        range=(-1.0, 1.0),
        example="6.5, 0 K/km",
        shown="K/km",
        slider=(-10.0, 10.0),
    )
    molar_mass: float = key(MOLAR_MASS, initial="28.9644 g/mol")
    gravity: float = key(GRAVITY, initial="9.80665 m/s^2")
    gravity_radius: float | None = key(GRAVITY_RADIUS, offered=always, default=None)

    def __post_init__(self) -> None:
        if (self.altitudes is None) == (self.pressures is None):
            given = MISSING if self.altitudes is None else self.altitudes
            raise ParameterError("altitudes", given, "altitudes or pressures of the bases")
        name = "altitudes" if self.altitudes is not None else "pressures"
        bases = self.altitudes if self.altitudes is not None else self.pressures
        assert bases is not None
        if not 1 <= len(bases) <= MOST_LAYERS:
            raise ParameterError(name, bases, f"1 to {MOST_LAYERS} bases")
        if len(self.lapse_rates) != len(bases):
            raise ParameterError(
                "lapse_rates", self.lapse_rates, f"one for each of {len(bases)} bases"
            )
        if self.altitudes is None:
            for k, (low, high) in enumerate(itertools.pairwise(bases)):
                if high >= low:
                    raise ParameterError(f"pressures[{k + 1}]", high, f"less than {low:g} Pa")
        elif bases[0] != 0.0:
            raise ParameterError("altitudes[0]", bases[0], "0 m, the ground")
        else:
            ascending(bases, "altitudes", "m")
        _ = self.air  # raises an error for temperatures below 0 K at a base

    @property
    def air(self) -> HydrostaticLayers:
        """Temperature, pressure and density over altitude."""
        weight = mass_per_length(self.molar_mass, self.gravity)
        radius = math.inf if self.gravity_radius is None else self.gravity_radius
        bases = self.altitudes
        if bases is None:
            bases = self._altitudes_of_pressures(weight)
        air = HydrostaticLayers.stacked(bases, self.temperature, self.lapse_rates, weight, radius)
        cold = int(np.argmax(air.temperatures < 1.0))
        if air.temperatures[cold] < 1.0:
            raise ParameterError(
                f"lapse_rates[{cold - 1}]",
                self.lapse_rates[cold - 1],
                "a temperature of at least 1 K at the next base",
            )
        return air

    def _altitudes_of_pressures(self, weight: float) -> tuple[float, ...]:
        assert self.pressures is not None
        altitude, temperature = 0.0, self.temperature
        found = [altitude]
        for rate, (low, high) in zip(
            self.lapse_rates, itertools.pairwise(self.pressures), strict=False
        ):
            thickness = thickness_of_layer(weight, temperature, rate, high / low)
            altitude += thickness
            temperature -= rate * thickness
            found.append(altitude)
        return tuple(found)

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        return self.air.row(thickness)

    @classmethod
    def default_table(cls, old: Mapping[str, Any], thickness: float) -> dict[str, Any]:
        """Table of the Earth's troposphere and stratosphere; see ``TomlModel.default_table``."""
        table = super().default_table(old, thickness)
        table["altitudes"] = ["0 km", "11 km"]
        table["lapse_rates"] = ["6.5 K/km", "0 K/km"]
        return table
