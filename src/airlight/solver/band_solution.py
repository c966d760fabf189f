"""``BandSolution``: means over bands of the solution of their k-distributions."""

from __future__ import annotations

from dataclasses import replace
from typing import Self

import numpy as np
from numpy.typing import NDArray

from airlight.planets.light_source import LightSource
from airlight.solver.band_columns import BandColumns
from airlight.solver.independent_columns import IndependentColumns
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.refracted_geometry import RefractedGeometry
from airlight.solver.solution import Solution

FloatArray = NDArray[np.float64]


class BandSolution(Solution):
    r"""Solution whose results are means over bands.

    .. math:: L_b = \sum_j w_{bj} L_{bj}

    over the terms of each band, and so for irradiances, Stokes parameters and transmittances.

    Parameters
    ----------
    bands : BandColumns
        Bands, and their terms as columns of a medium.
    terms : Solution
        Solution of ``bands.columns``.
    """

    def __init__(self, bands: BandColumns, terms: Solution) -> None:
        self.bands, self.terms = bands, terms
        self.medium = bands.medium
        self.highest_order = terms.highest_order
        count = f"{self.medium.wavelengths.size} bands, {bands.weights.size} terms"
        notes = [one for one in (terms.report.note, count) if one]
        residual = tuple(self._largest(np.asarray(terms.report.residual)))
        self.report = replace(terms.report, residual=residual, note="; ".join(notes))

    def _largest(self, residual: FloatArray) -> list[float]:
        if residual.size != self.bands.band.size:
            return list(residual.tolist())
        return [float(residual[self.bands.band == k].max()) for k in range(self.wavelengths.size)]

    @property
    def geometry(self) -> RefractedGeometry:
        """Refracted geometry of the terms."""
        return self.terms.geometry

    @property
    def polarised(self) -> bool:
        """Whether transfer is polarised."""
        return self.terms.polarised

    def with_light(self, source: LightSource, *, secondary: bool = False) -> Self:
        """Solution under another light source; see ``Solution``."""
        other = super().with_light(source, secondary=secondary)
        band = self.bands.band
        spread = replace(
            source, wavelengths=source.wavelengths[band], irradiance=source.irradiance[band]
        )
        other.terms = self.terms.with_light(spread, secondary=secondary)
        return other

    @property
    def shaded_by_rings(self) -> bool:
        """See ``Solution``."""
        return self.terms.shaded_by_rings

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``."""
        return self._over_bands(self.terms.relative_radiance(lines, order=order))

    def relative_stokes(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``."""
        return self._over_bands(self.terms.relative_stokes(lines, order=order))

    def relative_sky_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        return self._over_bands(self.terms.relative_sky_irradiance(r, mu_s))

    def relative_direct_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        return self._over_bands(self.terms.relative_direct_irradiance(r, mu_s))

    def relative_beam(self, r: FloatArray, mu_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See ``Solution``."""
        flat, normal = self.terms.relative_beam(r, mu_s)
        return self._over_bands(flat), self._over_bands(normal)

    def _over_bands(self, values: FloatArray) -> FloatArray:
        return self.bands.mean(values)


def band_widths(solution: Solution) -> FloatArray | None:
    """Widths of the bands of a solution, shape (nl,); None if it has none. [nm]"""
    while isinstance(solution, IndependentColumns):
        solution = solution.columns[0].solution
    return solution.bands.widths if isinstance(solution, BandSolution) else None
