"""Transmittance and irradiance tables of a bake, and the metadata of its manifest."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from airlight.engines.baking.air_light import lines_of_sight
from airlight.errors import ParameterError
from airlight.solver.solution import Solution
from airlight.solver.tables.columns import columns
from airlight.solver.tables.irradiance import IrradianceLayout
from airlight.solver.tables.layout import Positions, TableLayout
from airlight.solver.tables.table import Table, stored
from airlight.solver.tables.transmittance import TransmittanceLayout

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

FloatArray = NDArray[np.float64]


class Labels:
    """Labels of the tables of a bake: channels by wavelength, provenance.

    Parameters
    ----------
    medium : Medium
        Medium with the wavelengths.
    provenance : dict of str to str
        Provenance of all tables.
    """

    def __init__(self, medium: Medium, provenance: dict[str, str]) -> None:
        self.names = tuple(f"{nm:.10g} nm" for nm in medium.wavelengths)
        self.provenance = provenance

    def table(
        self,
        name: str,
        quantity: str,
        unit: str,
        where: TableLayout,
        values: FloatArray,
        precision: str,
    ) -> Table:
        """Table of values, shape (..., nl), or (..., nl + 1) with the particles' channel."""
        if not np.isfinite(values).all():
            raise ParameterError(f"table {name}", "NaN or infinity", "finite values")
        names = self.names
        channels = names if values.shape[-1] == len(names) else (*names, "particles")
        kept, scale = stored(values.reshape(*where.shape, len(channels)), precision)
        return Table(
            name=name,
            quantity=quantity,
            unit=unit,
            layout=where,
            channels=channels,
            values=kept,
            scale=scale,
            provenance=self.provenance,
        )


def unscattered(solution: Solution, label: Labels, precision: str) -> dict[str, Table]:
    """Tables of transmittance and of diffuse irradiance."""
    shell: dict[str, Any] = {
        "bottom_radius": solution.medium.bottom_radius,
        "top_radius": solution.medium.top_radius,
    }
    to_top, level = TransmittanceLayout(**shell), IrradianceLayout(**shell)
    spots = level.positions()
    return {
        "transmittance": label.table(
            "transmittance", "transmittance to the top of the shell", "1", to_top,
            transmittance(solution, to_top.positions()), "single",
        ),
        "irradiance": label.table(
            "irradiance", "irradiance of level ground by the sky, per the star's; all orders", "1",
            level, solution.relative_sky_irradiance(spots.r, spots.mu_s), precision,
        ),
    }  # fmt: skip


def facts(solution: Solution, orders: str) -> dict[str, Any]:
    """Facts about planet, solver and star for the manifest."""
    medium, ground = solution.medium, solution.medium.ground
    clouds = {"cloud_cover": ground.cover, "cloud_optical_depth": ground.cloud_optical_depth}
    return {
        "planet": solution.planet.name if solution.planet is not None else "unnamed",
        "fingerprint": medium.fingerprint(),
        "solver": solution.report.provenance,
        "orders": orders,
        "wavelengths_nm": medium.wavelengths.tolist(),
        "solar_irradiance_W_m-2_nm-1": medium.lights[0].irradiance.tolist(),
        "ground_albedo": medium.ground_albedo.tolist(),
        **(clouds if medium.surface.clouds is not None else {}),
        "star_angular_radius_rad": medium.lights[0].angular_radius,
        "bottom_radius_m": medium.bottom_radius,
        "top_radius_m": medium.top_radius,
    }


def transmittance(solution: Solution, positions: Positions) -> FloatArray:
    """Transmittance to the top of the shell, shape (n, nl). [1]"""
    medium = solution.medium
    length = lines_of_sight(positions, medium).length
    depth = columns(positions.r, positions.mu, length, medium.bottom_radius, medium.density)
    return np.exp(-(depth @ medium.extinction))
