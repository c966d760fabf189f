"""Columns of the gases by a formula of air mass, as some programs have them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.physics.optics.air_mass import air_mass_pickering2002

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]


def replace_air_mass(
    depth: FloatArray,
    air_mass: str,
    altitude: FloatArray,
    view_zenith: FloatArray,
    medium: Medium,
) -> None:
    """Replace columns of the gases by Pickering's air mass times the vertical column.

    Parameters
    ----------
    depth : array, shape (n, nc)
        Columns by constituent, changed. [m]
    air_mass : str
        Name of the formula.
    altitude, view_zenith : array, shape (n,)
        Altitudes of the observers, 0 [m], and zenith angles of the views, 0 to 90 [deg].
    medium : Medium
        Medium of the planet.
    """
    if air_mass != "pickering":
        raise ParameterError("air_mass", air_mass, "'pickering', or none for true columns")
    for name, value, allowed in (
        ("altitude", float(altitude.max()), "0 m with an air mass"),
        ("view_zenith", float(view_zenith.max()), "0 to 90 deg with an air mass"),
    ):
        if value > (90.0 if name == "view_zenith" else 0.0):
            raise ParameterError(name, value, allowed)
    nm = medium.wavelengths[:1]
    formula = air_mass_pickering2002(90.0 - view_zenith)
    for i, one in enumerate(medium.constituents):
        if one.refractivities(nm, medium.thickness)[0] > 0.0:
            depth[:, i] = formula * medium.columns[i]
