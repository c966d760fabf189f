"""Components of radiance: single scattering by constituent, multiple scattering, ground."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.harmonics import moment_count

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]


@dataclass(frozen=True, eq=False, kw_only=True)
class Parts:
    """Components of the radiance along n lines of sight, per irradiance of the star.

    Attributes
    ----------
    scattered_once : array, shape (n, nc, nl)
        Single scattering by each constituent. [sr⁻¹]
    scattered_more : array, shape (n, nl)
        Multiple scattering, including scattered light from the ground. [sr⁻¹]
    ground_star, ground_sky : array, shape (n, nl)
        Attenuated radiance of the ground by direct and by diffuse irradiance. [sr⁻¹]
    """

    scattered_once: FloatArray
    scattered_more: FloatArray
    ground_star: FloatArray
    ground_sky: FloatArray

    @property
    def total(self) -> FloatArray:
        """Sum of all components, shape (n, nl). [sr⁻¹]"""
        air = self.scattered_once.sum(axis=1) + self.scattered_more
        return np.asarray(air + self.ground_star + self.ground_sky)


def radiance_parts(solution: MomentsSolution, lines: LinesOfSight) -> Parts:
    """Components of the radiance along lines of sight.

    Parameters
    ----------
    lines : LinesOfSight
        n lines of sight.
    """
    tables = solution.tables
    dark_air = tables._replace(field=_without_source(tables.field, solution))
    single = [
        solution.radiance_per_irradiance(lines, 1, scatterers=[c], ground=False)
        for c in range(len(solution.medium.names))
    ]
    return Parts(
        scattered_once=np.stack(single, axis=1),
        scattered_more=solution.radiance_per_irradiance(lines, 0, ground=False),
        ground_star=solution.radiance_per_irradiance(lines, 1, scatterers=()),
        ground_sky=solution.radiance_per_irradiance(lines, 0, tables=dark_air),
    )


def _without_source(field: NDArray[np.float32], solution: MomentsSolution) -> NDArray[np.float32]:
    """Field with vanishing moments: each node keeps its scale, (s, 0)."""
    lanes = solution.tables.lanes
    nodes = field.reshape(-1, 1 + moment_count(solution.moments.degree), lanes).copy()
    nodes[:, 1:] = 0.0
    return nodes.reshape(field.shape)
