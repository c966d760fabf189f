"""``IndependentColumns``: mean of solutions that cover fractions of a planet.

The independent-column approximation (Cahalan et al. 1994, J. Atmos. Sci. 51, 2434; there,
"independent pixels") for broken clouds: no light passes between columns.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Self

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ParameterError
from airlight.planets.light_source import LightSource
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.solution import Solution

if TYPE_CHECKING:
    import xarray

FloatArray = NDArray[np.float64]

#: Largest deviation of the sum of the fractions from 1.
_ROUNDING = 1e-9


@dataclass(frozen=True)
class SolvedColumn:
    """Solution of a part of the planet.

    Attributes
    ----------
    fraction : float
        Fraction of the area. [1]
    solution : Solution
        Solution of a planet that is everywhere like this part.
    """

    fraction: float
    solution: Solution


class IndependentColumns(Solution):
    r"""Mean of solutions, weighted by fractions of the area.

    .. math:: L = \sum_i f_i L_i

    and so for irradiances, Stokes parameters and transmittances.

    Parameters
    ----------
    columns : sequence of SolvedColumn
        Solutions of one shell at the same wavelengths under the same light.

    Raises
    ------
    ParameterError
        If the fractions are not in 0 to 1 or their sum is not 1, or the shells differ.
    """

    def __init__(self, columns: Sequence[SolvedColumn]) -> None:
        fractions = [one.fraction for one in columns]
        if min(fractions, default=-1.0) < 0.0 or abs(sum(fractions) - 1.0) > _ROUNDING:
            raise ParameterError("fractions", fractions, "numbers from 0, whose sum is 1")
        first = columns[0].solution
        for one in columns[1:]:
            if _shell(one.solution) != _shell(first):
                raise ParameterError("columns", _shell(one.solution), f"the shell {_shell(first)}")
        self.columns = tuple(columns)
        self.medium = first.medium
        self.highest_order = min(one.solution.highest_order for one in columns)
        reports = [one.solution.report for one in columns]
        notes = [one.note for one in reports if one.note]
        self.report = replace(
            first.report,
            sweeps=max(one.sweeps for one in reports),
            residual=tuple(np.max([one.residual for one in reports], axis=0).tolist()),
            seconds=sum(one.seconds for one in reports),
            note="; ".join([f"mean of {len(columns)} independent columns", *dict.fromkeys(notes)]),
        )

    @property
    def polarised(self) -> bool:
        """Whether all columns have polarised transfer."""
        return all(one.solution.polarised for one in self.columns)

    def with_light(self, source: LightSource, *, secondary: bool = False) -> Self:
        """Solution under another light source; see ``Solution``."""
        other = super().with_light(source, secondary=secondary)
        other.columns = tuple(
            SolvedColumn(one.fraction, one.solution.with_light(source, secondary=secondary))
            for one in self.columns
        )
        return other

    @property
    def shaded_by_rings(self) -> bool:
        """See ``Solution``."""
        return all(one.solution.shaded_by_rings for one in self.columns)

    def relative_radiance(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``."""
        return self._mean(lambda one: one.relative_radiance(lines, order=order))

    def relative_stokes(self, lines: LinesOfSight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``."""
        return self._mean(lambda one: one.relative_stokes(lines, order=order))

    def relative_sky_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        return self._mean(lambda one: one.relative_sky_irradiance(r, mu_s))

    def relative_direct_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        return self._mean(lambda one: one.relative_direct_irradiance(r, mu_s))

    def relative_beam(self, r: FloatArray, mu_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        """See ``Solution``."""
        both = self._mean(lambda one: np.stack(one.relative_beam(r, mu_s)))
        return both[0], both[1]

    def transmittance(self, **arguments: Any) -> xarray.DataArray:
        """Mean transmittance; arguments of ``Solution.transmittance``."""
        found = [one.solution.transmittance(**arguments) for one in self.columns]
        mean = sum(
            one.fraction * part.values for one, part in zip(self.columns, found, strict=True)
        )
        return found[0].copy(data=mean).assign_attrs(self.provenance)

    def _mean(self, of: Callable[[Solution], FloatArray]) -> FloatArray:
        """Mean over the columns of an array per solution."""
        total: FloatArray = np.sum(
            [one.fraction * of(one.solution) for one in self.columns], axis=0
        )
        return total


def _shell(solution: Solution) -> tuple[Any, ...]:
    """Radii and wavelengths of a solution. [m], [nm]"""
    medium = solution.medium
    return medium.bottom_radius, medium.top_radius, tuple(medium.wavelengths.tolist())
