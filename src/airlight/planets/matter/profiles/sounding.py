"""Density of a gas from measured temperatures and pressures."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import Annotated, Any, Final

from airlight.errors import ConflictError, ParameterError
from airlight.physics.optics.density_profile import Row
from airlight.physics.optics.hydrostatic import (
    HydrostaticLayers,
    mass_per_length,
    thickness_between,
)
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.matter.profiles.weight_keys import (
    gravity_key,
    gravity_radius_key,
    molar_mass_key,
)
from airlight.planets.parameters import MISSING, ascending, parameters
from airlight.planets.schema.field import Field, always

#: Largest number of rows of a table.
MOST_ROWS: Final = 1000


@parameters
class Sounding(Profile):
    """Sounding of temperature over altitude or pressure; density 1 at the first row.

    With altitudes and pressures the density is p/T. With one of them the other follows from
    hydrostatic equilibrium, with temperature linear in altitude between rows.

    Parameters
    ----------
    temperatures : tuple of float
        Temperatures, 2 to 1000 of them. [K]
    altitudes : tuple of float, optional
        Altitudes, ascending. [m]
    pressures : tuple of float, optional
        Pressures, descending. [Pa]
    molar_mass, gravity : float, optional
        Molar mass of the gas [kg mol⁻¹] and gravity at the ground [m s⁻²]; required without
        altitudes or pressures.
    gravity_radius : float, optional
        Radius of the ground in the inverse-square law of gravity. [m]

    Notes
    -----
    See ``physics.optics.tabulated_profile`` for densities between the rows and beyond them.

    Examples
    --------
    >>> air = Sounding(altitudes=(0.0, 10e3), pressures=(101325.0, 26499.0),
    ...                temperatures=(288.15, 223.252))
    >>> f"{1.225 * air.densities[1]:.4f}"  # U.S. Standard Atmosphere, 1976: 0.41351 kg/m^3
    '0.4135'
    """

    keyword = "sounding"

    temperatures: Annotated[
        tuple[float, ...],
        Field(
            label="temperature",
            help="Temperatures of the table's rows.",
            unit="K",
            range=(1.0, 1e5),
            listed=True,
            example="288, 250, 217 K",
            slider=(20.0, 1000.0),
            scale="log",
            mode="advanced",
        ),
    ]
    altitudes: (
        Annotated[
            tuple[float, ...],
            Field(
                label="altitude",
                help="Altitudes of the rows, in increasing order.",
                note="They or pressures or both; what is left out follows from the gas's weight.",
                unit="m",
                range=(0.0, 1e9),
                listed=True,
                example="0, 6, 11 km",
                shown="km",
                slider=(0.0, 100.0),
                mode="advanced",
            ),
        ]
        | None
    ) = None
    pressures: (
        Annotated[
            tuple[float, ...],
            Field(
                label="pressure",
                help="Pressures of the rows, in decreasing order.",
                unit="Pa",
                range=(1e-12, 1e10),
                listed=True,
                example="1013, 472, 226 hPa",
                shown="hPa",
                slider=(1e-5, 1e5),
                scale="log",
                mode="advanced",
            ),
        ]
        | None
    ) = None
    molar_mass: Annotated[float, molar_mass_key(offered=always)] | None = None
    gravity: Annotated[float, gravity_key(offered=always)] | None = None
    gravity_radius: Annotated[float, gravity_radius_key(offered=always)] | None = None

    def __post_init__(self) -> None:
        rows = len(self.temperatures)
        if not 2 <= rows <= MOST_ROWS:
            raise ParameterError("temperatures", self.temperatures, f"2 to {MOST_ROWS} rows")
        if self.altitudes is None and self.pressures is None:
            raise ParameterError("altitudes", MISSING, "altitudes or pressures of the rows")
        for name, values in (("altitudes", self.altitudes), ("pressures", self.pressures)):
            if values is not None and len(values) != rows:
                raise ParameterError(name, values, f"one for each of {rows} temperatures")
        if self.altitudes is not None:
            ascending(self.altitudes, "altitudes", "m")
        if self.pressures is not None:
            for k, (low, high) in enumerate(itertools.pairwise(self.pressures)):
                if high >= low:
                    raise ParameterError(f"pressures[{k + 1}]", high, f"less than {low:g} Pa")
        if self.altitudes is None or self.pressures is None:
            for name in ("molar_mass", "gravity"):
                if getattr(self, name) is None:
                    raise ConflictError(
                        name, "is required unless both altitudes and pressures are given"
                    )

    @property
    def _weight(self) -> float:
        assert self.molar_mass is not None
        assert self.gravity is not None
        return mass_per_length(self.molar_mass, self.gravity)

    @property
    def _radius(self) -> float:
        return math.inf if self.gravity_radius is None else self.gravity_radius

    @property
    def air(self) -> HydrostaticLayers | None:
        """Hydrostatic gas with these temperatures; None with both altitudes and pressures."""
        if self.altitudes is not None and self.pressures is not None:
            return None
        warmth = self.temperatures
        if self.altitudes is None:
            assert self.pressures is not None
            steps = [
                thickness_between(self._weight, *pair, high / low)
                for pair, (low, high) in zip(
                    itertools.pairwise(warmth), itertools.pairwise(self.pressures), strict=True
                )
            ]
            bases = (0.0, *itertools.accumulate(steps))
        else:
            bases = tuple(self._geopotential(h) for h in self.altitudes)
        rates = [
            (low - high) / (top - bottom)
            for (low, high), (bottom, top) in zip(
                itertools.pairwise(warmth), itertools.pairwise(bases), strict=True
            )
        ]
        return HydrostaticLayers.stacked(
            bases, warmth[0], (*rates, 0.0), self._weight, self._radius
        )

    def _geopotential(self, altitude: float) -> float:
        if math.isinf(self._radius):
            return altitude
        return self._radius * altitude / (self._radius + altitude)

    @property
    def densities(self) -> tuple[float, ...]:
        """Density at each row over that at the first. [1]"""
        if self.pressures is not None:
            states = list(zip(self.pressures, self.temperatures, strict=True))
            first = states[0][0] / states[0][1]
            return tuple(p / t / first for p, t in states)
        assert self.air is not None
        assert self.altitudes is not None
        ratios = self.air.density_ratio(self.altitudes)
        return tuple((ratios / ratios[0]).tolist())

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        from airlight.physics.optics.tabulated_profile import tabulated

        air = self.air
        if air is not None and (self.altitudes is None or self.altitudes[0] == 0.0):
            return air.row(thickness)
        assert self.altitudes is not None
        return tabulated(self.altitudes, self.densities, thickness)

    @classmethod
    def default_table(cls, old: Mapping[str, Any], thickness: float) -> dict[str, Any]:
        """Three levels of the Earth's troposphere; see ``TomlModel.default_table``."""
        return {
            "altitudes": ["0 km", "5 km", "11 km"],
            "pressures": ["1013.25 hPa", "540.48 hPa", "226.99 hPa"],
            "temperatures": ["288.15 K", "255.676 K", "216.774 K"],
        }
