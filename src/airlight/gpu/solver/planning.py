"""From a medium to the plan of its solve on the GPU: grid, rays, tables and their places.

All of it is the CPU's; what the GPU does follows from the plan.
"""

from __future__ import annotations

from collections import OrderedDict
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import AirlightError, ParameterError
from airlight.gpu.solver.plan import SolverPlan, Span
from airlight.gpu.solver.tables import COUNTS, MEASURES, SCALARS, SPECTRA, uniform_fields
from airlight.kernel.lanes import LANES
from airlight.optics.density_profile import DensitySegments
from airlight.pixels.shown import MOST_CONSTITUENTS, WAVELENGTHS
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments.harmonics import coefficient_count, harmonics
from airlight.solvers.moments.iterate import (
    even_azimuths,
    grid_for,
    nodes_of_rays,
    weights_of_levels,
)
from airlight.solvers.moments.packing import filled, thickness
from airlight.solvers.moments.rays import trace_rays
from airlight.solvers.moments.reduced_optics import (
    choose_degree,
    column_rows,
    make_air,
    panel_ends,
    scattering_depth,
    transport_depth,
)
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.visible_rays import rays_in_sight
from airlight.tables.column_ratios import mean_density_ratios
from airlight.tables.columns import ColumnTable

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Texels of a texture that one span of radii fills: 64 MB.
_SPAN: Final = 4 << 20
#: Tables of columns that are kept: they depend on the profiles alone.
_KEPT: Final = 4
#: Vertical depth, each scattering counted by 1 - g, beyond which the air is left to the CPU. [1]
THICKEST: Final = 2.5

_tables: OrderedDict[tuple[Any, ...], tuple[ColumnTable, FloatArray]] = OrderedDict()


class ThickAir(AirlightError):
    """Air so thick that only the CPU solves it: light wanders up and down in it many times."""

    def __str__(self) -> str:
        return "the air is too thick for the GPU's orders of scattering; the CPU solves it"


def plan_for(paths: LightPaths, settings: Settings) -> SolverPlan:
    """The plan of a medium's solve.

    Parameters
    ----------
    paths : LightPaths
        Of a medium of at most four wavelengths.
    settings : Settings
        Grid sizes.

    Raises
    ------
    ParameterError
        If there are more wavelengths or constituents than the shaders have room for.
    ThickAir
        If light wanders in the air for many orders.
    """
    medium = paths.medium
    count = medium.wavelengths.size
    if count > WAVELENGTHS:
        raise ParameterError("wavelengths", count, f"at most {WAVELENGTHS} on the GPU")
    constituents = len(medium.names)
    if constituents > MOST_CONSTITUENTS:
        raise ParameterError(
            "constituents", constituents, f"at most {MOST_CONSTITUENTS} on the GPU"
        )
    degree = choose_degree(medium, settings)
    if transport_depth(medium).max() > THICKEST:
        raise ThickAir
    grid, parts = grid_for(medium, settings)
    gathering = grid._replace(radii=grid.radii[::parts])
    ends = panel_ends(medium, grid, parts)
    whole = trace_rays(
        gathering,
        medium.density,
        medium.extinction.max(axis=1),
        settings.zenith_angles,
        nodes_of_rays(settings, parts, ends),
        bend=paths.bend,
        ends=ends,
    )
    air = make_air(medium, degree, slice(None))
    rays, _ = rays_in_sight(whole, air)
    azimuths = even_azimuths(degree, max(settings.azimuths, 3 * degree // 4))
    expansion = harmonics(degree)
    table, ratios = _columns(
        medium.bottom_radius,
        medium.top_radius,
        medium.density,
        (column_rows(medium, settings), settings.column_directions),
    )
    depth = scattering_depth(medium, degree)
    level = _four(weights_of_levels(grid, depth))
    arrays: dict[str, NDArray[Any]] = {
        "mu": rays.mu, "weight": rays.weight, "flux": rays.flux, "start": rays.start,
        "total": rays.total.reshape(-1), "end": rays.end, "radius": rays.radius,
        "mu_along": rays.mu_along, "turn": rays.turn,
        "amount": rays.amount[:, :constituents],
        "column": rays.column[:, :constituents].reshape(-1),
        "sun_cosines": grid.sun_cosines, "row": grid.row, "place": grid.place,
        "cosines": azimuths.cosines, "multiples": azimuths.multiples,
        "harmonic": expansion.start, "ahead": expansion.ahead, "back": expansion.back,
        "ratios": ratios, "lift": paths.lift, "level": level.reshape(-1),
        "extinction": _lanes(air.extinction), "moments": _lanes(air.moments),
        "albedo": _lanes(air.albedo),
    }  # fmt: skip
    sizes: dict[str, Any] = {
        "radii": gathering.radii.size,
        "angles": rays.mu.shape[1],
        "suns": grid.sun_cosines.size,
        "turns": azimuths.cosines.size,
        "degree": degree,
        "terms": coefficient_count(degree),
        "constituents": constituents,
        "directions": table.values.shape[1],
        "levels": grid.radii.size,
        "parts": parts,
        "bottom": grid.bottom_radius,
        "top": grid.top_radius,
        "star_radius": air.star_radius,
    }
    solve, scalars, spectra = _laid_out(arrays, sizes)
    return SolverPlan(
        paths=paths,
        degree=degree,
        grid=grid,
        table=table,
        sizes=sizes,
        solve=solve,
        scalars=scalars,
        spectra=spectra,
        spans=_spans(rays.start, sizes),
        thick=_four(thickness(depth)),
    )


def _columns(
    bottom: float, top: float, density: DensitySegments, shape: tuple[int, int]
) -> tuple[ColumnTable, FloatArray]:
    """The table of columns and its ratios, from the last few that were made."""
    key = (bottom, top, shape, density.edges.tobytes(), density.coefficients.tobytes())
    if key not in _tables:
        table = ColumnTable.build(bottom, top, density, shape)
        _tables[key] = table, mean_density_ratios(table)
        while len(_tables) > _KEPT:
            _tables.popitem(last=False)
    _tables.move_to_end(key)
    return _tables[key]


def _four(values: NDArray[Any]) -> NDArray[Any]:
    """Wavelengths (..., w) as four: the last one repeated."""
    return filled(values)[..., :WAVELENGTHS]


def _lanes(flat: Float32Array) -> Float32Array:
    """Eight lanes an element as four, shape (n, 4)."""
    return flat.reshape(-1, LANES)[:, :WAVELENGTHS]


def _laid_out(
    arrays: dict[str, NDArray[Any]], sizes: dict[str, Any]
) -> tuple[Float32Array, Float32Array, Float32Array]:
    """The uniform and the two textures of tables."""
    uniform = dict.fromkeys(uniform_fields(), (0.0, 0.0, 0.0, 0.0))
    uniform["counts"] = tuple(sizes[name] for name in COUNTS[:4])
    uniform["more_counts"] = tuple(sizes[name] for name in COUNTS[4:8])
    uniform["most_counts"] = (*(sizes[name] for name in COUNTS[8:]), 0.0, 0.0)
    ground = sizes["levels"] * sizes["suns"] * (1 + sizes["terms"])
    uniform["measures"] = (*(sizes[name] for name in MEASURES), ground)
    textures: list[Float32Array] = []
    for names, channels in ((SCALARS, 1), (SPECTRA, 4)):
        start = 0
        parts = []
        for name in names:
            array = arrays[name]
            shape = array.shape if channels == 1 else array.shape[:1]
            uniform[f"{name}_shape"] = (*shape, *(0,) * (4 - len(shape)))
            uniform[f"{name}_start"] = (start, 0.0, 0.0, 0.0)
            parts.append(np.asarray(array, np.float32).reshape(-1, channels))
            start += parts[-1].shape[0]
        textures.append(np.concatenate(parts))
    solve = np.array(list(uniform.values()), np.float32)
    return solve, textures[0][:, 0], textures[1]


def _spans(start: NDArray[np.int64], sizes: dict[str, Any]) -> tuple[Span, ...]:
    """Radii in groups whose textures are not too large."""
    angles = sizes["angles"]
    each = max(sizes["suns"] * (sizes["degree"] + 2), sizes["directions"])
    most = _SPAN // each - 1
    bounds = [0]
    for i in range(1, start.shape[0]):
        if start[i, angles] - start[bounds[-1], 0] > most:
            bounds.append(i)
    bounds.append(start.shape[0])
    return tuple(
        Span(
            first_point=int(start[low, 0]),
            points=int(start[high - 1, angles] - start[low, 0]),
            first_ray=low * angles,
            rays=(high - low) * angles,
        )
        for low, high in pairwise(bounds)
    )
