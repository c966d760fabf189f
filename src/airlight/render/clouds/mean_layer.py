"""``MeanLayer``: light of the air of a planet below the mean layer of its clouds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.clouds.columns import LAYER, EvenLayer, with_even_layer
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.planets.planet import Planet
from airlight.render.pixels.march_points import march_points
from airlight.render.pixels.render_tables import render_tables
from airlight.solver.lines_of_sight import LinesOfSight
from airlight.solver.moments.march_tables import MarchTables
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.moments.solve import solve

FloatArray = NDArray[np.float64]

#: Quality of both solutions, of which only the ratio counts.
QUALITY: Final = "preview"
#: Largest energy balance error without a warning: air scatters a tenth of a picture's light. [1]
ENERGY_TOLERANCE: Final = 0.1
#: Largest ratio of the light, where clear sky has none. [1]
MOST_LIGHT: Final = 1000.0
#: Tables of the march with a coefficient of each constituent on the first axis.
_BY_CONSTITUENT: Final = (
    "strongest", "brightest", "scaled_extinction", "extinction", "scattering", "moments",
    "polarised_moments",
)  # fmt: skip


@dataclass(frozen=True, eq=False, kw_only=True)
class MeanLayer:
    r"""Mean of a planet below a uniform layer and without it, over the planet without it.

    .. math:: q = 1 + c \left(\frac{L_1}{L_0} - 1\right)

    for the cover c and light with the layer and without: independent columns, in scalar transfer at
    a few wavelengths. Between those the ratio is linear.

    Attributes
    ----------
    cover : float
        Fraction of the area below the layer. [1]
    layered, clear : MomentsSolution
        Planet below the layer, its last constituent, and without it.
    weights : array, shape (solved, nl)
        Weights of their wavelengths. [1]
    """

    cover: float
    layered: MomentsSolution
    clear: MomentsSolution
    weights: FloatArray

    def ratio(self, layered: NDArray[np.floating], clear: NDArray[np.floating]) -> FloatArray:
        """Ratio q at all wavelengths, of light (..., solved) with and without the layer. [1]"""
        found = 1.0 + self.cover * (layered / np.maximum(clear, 1e-30) - 1.0)
        return np.asarray(np.clip(found, 0.0, MOST_LIGHT) @ self.weights)

    def radiance_ratio(self, lines: LinesOfSight) -> FloatArray:
        """Ratio of the diffuse radiance of lines of sight, shape (n, nl). [1]"""
        return self.ratio(*(one.relative_radiance(lines) for one in (self.layered, self.clear)))

    def sky_ratio(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """Ratio of the irradiance of a level surface by the sky, shape (n, nl). [1]

        Parameters
        ----------
        r, mu_s : array, shape (n,)
            Radii [m] and cosines of the light's zenith angle [1].
        """
        return self.ratio(
            *(one.relative_sky_irradiance(r, mu_s) for one in (self.layered, self.clear))
        )

    @cached_property
    def air(self) -> tuple[MarchTables, MarchTables]:
        """Tables of the march through the air alone, in the light with the layer and without."""
        first, other = (
            render_tables(one, peaks=False, **march_points(one)._asdict())
            for one in (self.layered, self.clear)
        )
        cloud = self.layered.geometry.medium.names.index(LAYER)
        without = {}
        for name in _BY_CONSTITUENT:
            values = getattr(first, name).copy()
            values[cloud] = 0.0
            without[name] = values
        return first._replace(**without), other


def mean_layer(
    solution: MomentsSolution,
    field: CloudField,
    optics: CloudOptics,
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MeanLayer | None:
    """Mean layer of a field above a planet; None without cloudy columns.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet without clouds.
    field : CloudField
        Clouds.
    optics : CloudOptics
        Optical properties at some wavelengths of the solution.
    cache : bool
        Whether solutions are read from and stored on disk.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    layer, planet, nm = EvenLayer.of(field), solution.planet, np.asarray(optics.wavelengths)
    if layer.cover == 0.0 or planet is None:
        return None
    moments = np.asarray(optics.phase.moments(nm, 1))
    asymmetry = float((moments[:, 1] / moments[:, 0]).mean())
    settings = settings_for(QUALITY)
    # one degree for both, so that delta-M scaling of haze is the same
    degree = settings.layer_degree
    settings = replace(
        settings,
        polarisation=False,
        degree=degree,
        thick_degree=degree,
        energy_tolerance=ENERGY_TOLERANCE,
    )

    def solved(one: Planet) -> MomentsSolution:
        medium = Medium.from_planet(one, nm, progress=progress, cancel=cancel)
        return solve(medium, settings, cache=cache, progress=progress, cancel=cancel).of(one)

    below = with_even_layer(planet, layer, optics, layer.reflecting_depth(asymmetry))
    order = np.argsort(nm)
    weights = [np.interp(solution.wavelengths, nm[order], row[order]) for row in np.eye(nm.size)]
    return MeanLayer(
        cover=layer.cover,
        layered=solved(below),
        clear=solved(planet.without_clouds),
        weights=np.array(weights),
    )
