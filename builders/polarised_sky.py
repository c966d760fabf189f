"""Remake ``validation/data/polarised-sky.csv``: round Rayleigh skies by SASKTRAN 2, polarised.

Run with ``python builders/polarised_sky.py`` where sasktran2 is installed (the extra
``dev``). Spherical geometry, successive orders of scattering with three Stokes
parameters. Columns of errors are the change from coarser settings; the finer ones take minutes
and some gigabytes.
"""

from __future__ import annotations

from importlib.metadata import version
from pathlib import Path
from typing import NamedTuple

import numpy as np
import sasktran2 as sk
from numpy.typing import NDArray

from airlight.validation.polarised.round_air import (
    ALBEDO,
    BOTTOM,
    DEPTHS,
    FILE,
    LEVELS,
    LINES,
    SUNS,
    densities,
)

FloatArray = NDArray[np.float64]

OUT = Path(__file__).parents[1] / "src" / "airlight" / "validation" / FILE
#: What the file says of itself.
HEAD = """\
# Light of round Rayleigh skies for an observer on the ground, per irradiance of the star, by
# SASKTRAN {version}: three Stokes parameters, successive orders with {rays} directions,
# {columns} columns, {levels} levels. Errors: change from {fewer} directions. Frame and signs:
# docs/notation.md. Made by builders/polarised_sky.py.
depth,sun_zenith_deg,view_zenith_deg,azimuth_deg,I,Q,U,error_I,error_Q,error_U
"""


class Fineness(NamedTuple):
    """Settings: directions of a source point, columns by star elevation, halvings of the levels."""

    rays: int
    columns: int
    halvings: int


FINE, COARSE = Fineness(434, 3, 0), Fineness(194, 3, 0)


def altitudes(halvings: int) -> FloatArray:
    """Levels of SASKTRAN, between which the density is linear as between ``LEVELS``. [m]"""
    z = LEVELS
    for _ in range(halvings):
        z = np.sort(np.concatenate([z, 0.5 * (z[1:] + z[:-1])]))
    return z


def sky(sun: float, fineness: Fineness) -> FloatArray:
    """I, Q and U, shape (depths, lines, 3), in the frame of this package. [sr⁻¹]"""
    config = sk.Config()
    config.num_stokes = 3
    config.num_streams = config.num_singlescatter_moments = 4
    config.single_scatter_source = sk.SingleScatterSource.Exact
    config.multiple_scatter_source = sk.MultipleScatterSource.SuccessiveOrders
    config.num_sza = fineness.columns
    config.num_successive_orders_incoming = config.num_successive_orders_outgoing = fineness.rays
    z = altitudes(fineness.halvings)
    mu_s = np.cos(np.radians(sun))
    geometry = sk.Geometry1D(
        mu_s, 0.0, BOTTOM, z, sk.InterpolationMethod.LinearInterpolation, sk.GeometryType.Spherical
    )
    viewing = sk.ViewingGeometry()
    for zenith, azimuth in LINES:
        viewing.add_ray(
            sk.SolarAnglesObserverLocation(
                mu_s, np.radians(azimuth), np.cos(np.radians(zenith)), 0.0
            )
        )
    air = sk.Atmosphere(geometry, config, numwavel=len(DEPTHS), calculate_derivatives=False)
    density = densities()
    profile = np.interp(z, LEVELS, density) / np.trapezoid(density, LEVELS)
    air.storage.total_extinction[:] = profile[:, None] * np.array(DEPTHS)
    air.storage.ssa[:] = 1.0
    # Rayleigh's expansion coefficients: Hovenier, van der Mee & Domke (2004), section 2.9
    air.leg_coeff.a1[0], air.leg_coeff.a1[2] = 1.0, 0.5
    air.leg_coeff.a2[2], air.leg_coeff.b1[2] = 3.0, np.sqrt(6.0) / 2.0
    air.surface.albedo[:] = ALBEDO
    found = sk.Engine(config, geometry, viewing).calculate_radiance(air)["radiance"].values
    return np.asarray(found, dtype=np.float64)


def main() -> None:
    """Write the file."""
    rows = []
    for sun in SUNS:
        fine, coarse = sky(sun, FINE), sky(sun, COARSE)
        for k, depth in enumerate(DEPTHS):
            for (zenith, azimuth), value, other in zip(LINES, fine[k], coarse[k], strict=True):
                cells = [f"{x:.6e}" for x in value] + [f"{x:.1e}" for x in np.abs(value - other)]
                rows.append(",".join([f"{depth:g},{sun:g},{zenith:g},{azimuth:g}", *cells]))
    head = HEAD.format(
        version=version("sasktran2"), rays=FINE.rays, columns=FINE.columns,
        levels=altitudes(FINE.halvings).size, fewer=COARSE.rays,
    )  # fmt: skip
    OUT.write_text(head + "\n".join(rows) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
