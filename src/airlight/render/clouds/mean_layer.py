"""``MeanLayer``: light of the air of a planet below the mean layer of its clouds."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from math import prod
from typing import TYPE_CHECKING, Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.columns import LAYER, EvenLayer, with_even_layer
from airlight.kernel.cache import Cache
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.render.clouds.cloud_deck import CloudDeck, solved_wavelengths
from airlight.render.pixels.march_points import march_points
from airlight.render.pixels.render_tables import render_tables
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.march_tables import MarchTables
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.solve import solve

if TYPE_CHECKING:
    from airlight.solver.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]

#: Quality of the solutions, of which only the ratio counts.
QUALITY: Final = "preview"
#: Clear columns of the last solutions, with these, whose identity is the key.
_CLEAR: Final[Cache[int, tuple[Any, MomentsSolution]]] = Cache(2)
#: Largest energy balance error without a warning: air scatters a tenth of a picture's light. [1]
ENERGY_TOLERANCE: Final = 0.1
#: Largest ratio of the light, where clear sky has none. [1]
MOST_LIGHT: Final = 1000.0
#: Tables of the march with a coefficient of each constituent on the first axis.
_BY_CONSTITUENT: Final = (
    "strongest",
    "brightest",
    "scaled_extinction",
    "extinction",
    "scattering",
    "moments",
    "polarised_moments",
)


class MeanColumn(NamedTuple):
    """Part of a planet under an even cover of clouds.

    Attributes
    ----------
    fraction : float
        Fraction of the area. [1]
    solution : MomentsSolution
        Planet that is everywhere like this part, with the clouds as its last constituents.
    """

    fraction: float
    solution: MomentsSolution


@dataclass(frozen=True, eq=False, kw_only=True)
class MeanLayer:
    r"""Mean of a planet below uniform layers of clouds and without them, over that without.

    .. math:: q = \sum_i f_i L_i / L_0

    for light L and fractions f of independent columns, of which the first is clear, at a few
    wavelengths. Between those the ratio is linear.

    Attributes
    ----------
    columns : tuple of MeanColumn
        Columns; the first is clear.
    weights : array, shape (solved, nl)
        Weights of their wavelengths. [1]
    layers : tuple of EvenLayer
        Layers of clouds that the columns have.
    """

    columns: tuple[MeanColumn, ...]
    weights: FloatArray
    layers: tuple[EvenLayer, ...]

    def is_like(self, layers: Sequence[EvenLayer], columns: int) -> bool:
        """Whether so many columns of layers, of any covers, have nearly the same light."""
        return (
            len(self.columns) == columns
            and len(self.layers) == len(layers)
            and all(one.is_like(other) for one, other in zip(self.layers, layers, strict=True))
        )

    def ratio(self, light: Sequence[NDArray[np.floating]]) -> FloatArray:
        """Ratio q at all wavelengths, of the light (..., solved) of each column. [1]"""
        return 1.0 + self.change(light, light[0])

    def change(
        self, light: Sequence[NDArray[np.floating]], clear: NDArray[np.floating]
    ) -> FloatArray:
        """Light less that of the clear column, over the latter's radiance, at all wavelengths. [1]

        Parameters
        ----------
        light : sequence of array, shape (..., solved)
            Radiance, or Q or U, of each column.
        clear : array, shape (..., solved)
            Radiance of the clear column.
        """
        total = sum(one.fraction * part for one, part in zip(self.columns, light, strict=True))
        found = (np.asarray(total) - light[0]) / np.maximum(clear, 1e-30)
        return np.asarray(np.clip(found, -MOST_LIGHT, MOST_LIGHT) @ self.weights)

    def radiance_ratio(self, lines: LinesOfSight) -> FloatArray:
        """Ratio of the diffuse radiance of lines of sight, shape (n, nl). [1]"""
        return self.ratio([one.solution.relative_radiance(lines) for one in self.columns])

    def sky_ratio(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """Ratio of the irradiance of a level surface by the sky, shape (n, nl). [1]

        Parameters
        ----------
        r, mu_s : array, shape (n,)
            Radii [m] and cosines of the light's zenith angle [1].
        """
        return self.ratio([one.solution.relative_sky_irradiance(r, mu_s) for one in self.columns])

    @cached_property
    def air(self) -> tuple[MarchTables, ...]:
        """Tables of the march through the air alone, in the light of each column."""
        return tuple(_air_tables(one.solution) for one in self.columns)


def _air_tables(solution: MomentsSolution) -> MarchTables:
    """Tables of the march through a planet whose clouds are there only as light."""
    tables = render_tables(solution, peaks=False, **march_points(solution)._asdict())
    names = solution.geometry.medium.names
    clouds = [n for n, name in enumerate(names) if name.startswith(LAYER)]
    without = {}
    for name in _BY_CONSTITUENT:
        values = getattr(tables, name).copy()
        values[clouds] = 0.0
        without[name] = values
    return tables._replace(**without)


def _fraction(layers: Sequence[EvenLayer], present: Sequence[bool]) -> float:
    """Fraction of columns in which some layers are present, at random overlap. [1]"""
    return prod(
        one.cover if there else 1.0 - one.cover for one, there in zip(layers, present, strict=True)
    )


def mean_layer(
    solution: MomentsSolution,
    decks: Sequence[CloudDeck],
    *,
    similar: MeanLayer | None = None,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MeanLayer | None:
    """Mean layers of clouds above a planet, at random overlap; None without cloudy columns.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet without clouds.
    decks : sequence of CloudDeck
        Clouds.
    similar : MeanLayer, optional
        Mean layer of the same planet, whose columns are taken if the layers are alike.
    cache : bool
        Whether solutions are read from and stored on disk.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    layers = tuple(EvenLayer.of(deck.field) for deck in decks)
    planet, every = solution.planet, solution.medium.wavelengths
    if planet is None or not any(layer.cover > 0.0 for layer in layers):
        return None
    parts = [
        (present, fraction)
        for present in product((False, True), repeat=len(layers))
        if (fraction := _fraction(layers, present)) > 0.0 or not any(present)
    ]
    known = similar if similar is not None and similar.is_like(layers, len(parts)) else None
    nm = every[solved_wavelengths(every.size)]
    settings = settings_for(QUALITY)
    # one degree for all, so that delta-M scaling of haze is the same
    degree = settings.layer_degree
    settings = replace(
        settings,
        polarisation=solution.polarised,
        degree=degree,
        thick_degree=degree,
        energy_tolerance=ENERGY_TOLERANCE,
    )

    def solved(present: tuple[bool, ...]) -> MomentsSolution:
        column = planet.without_clouds
        for deck, layer, there in zip(decks, layers, present, strict=True):
            if there:
                column = with_even_layer(column, layer, deck.optics_at(nm))
        medium = Medium.from_planet(column, nm, progress=progress, cancel=cancel)
        found = solve(medium, settings, cache=cache, progress=progress, cancel=cancel)
        return found.of(column)

    def clear() -> tuple[Any, MomentsSolution]:
        return solution, solved((False,) * len(layers))

    columns = []
    for number, (present, fraction) in enumerate(parts):
        if known is not None:
            one = known.columns[number].solution
        elif any(present):
            one = solved(present)
        else:  # the same for all clouds
            _, one = _CLEAR.of(id(solution.moments), clear)
        columns.append(MeanColumn(fraction, one))
    order = np.argsort(nm)
    weights = [np.interp(every, nm[order], row[order]) for row in np.eye(nm.size)]
    return MeanLayer(
        columns=tuple(columns),
        weights=np.array(weights),
        layers=layers if known is None else known.layers,
    )
