"""Density profiles of all constituents of a planet."""

from __future__ import annotations

from airlight.errors import ParameterError
from airlight.physics.optics.density_profile import DensitySegments, Row
from airlight.planets.planet import Planet


def relative_densities(planet: Planet) -> DensitySegments:
    """Density profiles of a planet's constituents over its shell, cached with the planet."""
    kept: DensitySegments | None = vars(planet).get("_relative_densities")
    if kept is None:
        rows = [_row(planet, i) for i in range(len(planet.constituents))]
        kept = vars(planet)["_relative_densities"] = DensitySegments.from_rows(rows)
    return kept


def _row(planet: Planet, index: int) -> Row:
    try:
        return planet.constituents[index].profile.row(planet.thickness)
    except ParameterError as error:
        field_name = f"constituents[{index}].profile.{error.field}"
        raise error.named(field_name) from None
