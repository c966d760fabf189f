"""Density profile from a table of altitudes."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import Row
from airlight.planets.matter.profiles.profile import Profile
from airlight.planets.parameters import ascending, parameters
from airlight.planets.schema.field import Field, Wavelengths, key
from airlight.planets.schema.toml_table import TomlTable

#: Largest number of rows of a table.
MOST_ROWS = 1000
#: Name of the table of densities in the package.
OZONE_TABLE: Final = "ozone-afgl1986-us-standard"


@parameters
class Tabulated(Profile):
    """Density tabulated over altitude.

    Parameters
    ----------
    altitudes : tuple of float
        Altitudes, strictly ascending, 2 to 1000 of them. [m]
    densities : tuple of float
        Relative densities, one per altitude, not negative. [1]

    Notes
    -----
    See ``optics.tabulated_profile`` for interpolation between the rows and values beyond them.
    """

    keyword = "tabulated"
    mode = "advanced"
    extra_keys = (
        Field(
            name="table",
            help="Name of a density table included in the package.",
            note="Alternative to altitudes and densities.",
            kind="choice",
            choices=lambda: (OZONE_TABLE,),
            mode="standard",
        ),
    )

    altitudes: tuple[float, ...] = key(
        label="altitude",
        help="Altitudes of the table's rows, in increasing order.",
        note="Required without a `table`. Beyond its ends it is extrapolated exponentially,"
        " never growing upwards.",
        unit="m",
        range=(0.0, 1e9),
        example="0, 10, 20 km",
        shown="km",
        slider=(0.0, 100.0),
    )
    densities: tuple[float, ...] = key(
        label="density",
        help="Relative density of each row.",
        note="Interpolated in the logarithm with a monotone cubic; straight lines next to a"
        " density of 0.",
        range=(0.0, 1e6),
        example="1, 0.3, 0.1",
        slider=(1e-6, 1.0),
        scale="log",
        per="altitudes",
        per_unit="km",
    )

    def __post_init__(self) -> None:
        if not 2 <= len(self.altitudes) <= MOST_ROWS:
            raise ParameterError("altitudes", self.altitudes, f"2 to {MOST_ROWS} altitudes")
        if len(self.densities) != len(self.altitudes):
            raise ParameterError(
                "densities", self.densities, f"one for each of {len(self.altitudes)} altitudes"
            )
        ascending(self.altitudes, "altitudes", "m")
        if float(np.min(np.diff(self.altitudes))) < 1e-3:
            raise ParameterError("altitudes", self.altitudes, "steps of at least 1 mm")

    def row(self, thickness: float) -> Row:
        """Segments over a shell of this thickness [m]; see ``physics.optics.density_profile``."""
        from airlight.physics.optics.tabulated_profile import tabulated

        return tabulated(self.altitudes, self.densities, thickness)

    @classmethod
    def read_values(
        cls, table: TomlTable, wavelengths: Wavelengths = None, **known: Any
    ) -> dict[str, Any]:
        """Altitudes and densities, given or from a table of the package."""
        if "table" not in table:
            return super().read_values(table, wavelengths, **known)
        from airlight.physics.optics.gas_absorption import ozone_profile_afgl1986

        table.choice("table", (OZONE_TABLE,))
        altitudes, densities = ozone_profile_afgl1986()
        relative = densities / densities.max()
        return {"altitudes": tuple(altitudes.tolist()), "densities": tuple(relative.tolist())}

    @classmethod
    def default_table(cls, old: Mapping[str, Any], thickness: float) -> dict[str, Any]:
        """Table of the package; see ``TomlModel.default_table``."""
        return {"table": OZONE_TABLE}
