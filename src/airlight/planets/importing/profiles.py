"""Profile of a constituent from a table of its density or extinction over altitude."""

from __future__ import annotations

from typing import Final

import numpy as np

from airlight.errors import ConflictError, FileError, ParameterError
from airlight.physics.data_tables.data_table import DataTable, Quantity
from airlight.planets.importing.atmospheres import ALTITUDE, percent_text
from airlight.planets.importing.planet_tables import PlanetTables, numbers_text
from airlight.planets.importing.thinning import tabulated_between, thinned

#: What a profile may be of: it is divided by its largest value.
DENSITY: Final = Quantity(
    name="density",
    unit="1",
    names=("extinction", "ext", "numberdensity", "concentration", "relativedensity", "backscatter"),
    low=0.0,
)
#: Largest difference between rows and what is kept, over the largest value. [1]
_TOLERANCE: Final = 5e-3


def import_profile(
    planet: PlanetTables, table: DataTable, name: str, ground_altitude: float = 0.0
) -> None:
    """Replace the profile of a constituent; its optical depth stays.

    Parameters
    ----------
    planet : PlanetTables
        Tables of the planet file, changed in place.
    table : DataTable
        Rows in either order, of any unit of density or extinction.
    name : str
        Name of a constituent that is given by an optical depth, a column or particles.
    ground_altitude : float
        Altitude in the table of the planet's ground; rows below it are left out. [m]
    """
    place, _ = planet.constituent_of(name)
    if len(place) == 1:
        known = ", ".join(one.name for one in planet.base.constituents)
        raise ParameterError("name", name, f"a constituent of {planet.base.name}: {known}")
    nested = [one for one in place.values() if isinstance(one, dict)]
    if not any({"optical_depth", "ozone", "column"} & set(one) for one in (place, *nested)):
        raise ConflictError(name, "requires an optical depth, which the profile spreads")
    table.check_lists(ALTITUDE, DENSITY)
    h = table.numbers(ALTITUDE) - ground_altitude
    values = table.own_numbers(DENSITY, table.required(DENSITY))
    if h.size < 2 or not values.max() > 0.0:
        raise FileError(table.source, "has no density above 0")
    sign = 1 if h[-1] > h[0] else -1
    wrong = sign * np.diff(h) <= 0.0
    if wrong.any():
        k = int(np.argmax(wrong)) + 1
        shown = f"{h[k]:g} m"
        raise ParameterError(f"{table.place(k)}, altitude", shown, "monotonic rows", table.source)
    h, values = h[::sign], values[::sign] / values.max()
    h, values = h[h >= 0.0], values[h >= 0.0]
    if h.size < 2 or not values.max() > 0.0:
        raise FileError(table.source, "has no density above the ground")
    kept, error = thinned(h, values, _TOLERANCE, tabulated_between)
    place["profile"] = {
        "kind": "tabulated",
        "altitudes": numbers_text(h[kept] / 1e3, "km", 7),
        "densities": [float(f"{one:.5g}") for one in values[kept]],
    }
    planet.comment(f"{name}.profile", f"{planet.source}: {kept.size} of {h.size} rows")
    planet.notes.append(
        f"{name}: {kept.size} of {h.size} rows kept, within {percent_text(error)} of the largest"
    )
