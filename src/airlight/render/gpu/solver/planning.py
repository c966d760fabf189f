"""Plans of solves on the GPU, from a medium: grid, rays, tables and their positions."""

from __future__ import annotations

from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.shader_fields import numbers_of
from airlight.render.gpu.solver.plan import RadiusRange, SolverPlan, row_block
from airlight.render.gpu.solver.tables import SOLVE
from airlight.render.pixels.capacity import check_capacity
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.solver.moments.settings import MomentsSettings
from airlight.solver.moments.setup import Setup
from airlight.solver.refracted_geometry import RefractedGeometry

Float32Array = NDArray[np.float32]

#: Largest number of texels of a texture of one radius range: 64 MB.
_SPAN: Final = 4 << 20


def plan_for(
    geometry: RefractedGeometry, settings: MomentsSettings, *, extinction_headroom: float = 1.0
) -> SolverPlan:
    """Plan of the solve of a medium.

    Parameters
    ----------
    geometry : RefractedGeometry
        Geometry and medium of at most four wavelengths.
    settings : MomentsSettings
        Grid sizes.
    extinction_headroom : float
        See ``Setup``. [1]
    """
    medium = geometry.medium
    constituents = len(medium.names)
    check_capacity(medium.wavelengths.size, constituents)
    setup = Setup(geometry=geometry, settings=settings, extinction_headroom=extinction_headroom)
    batch = setup.batch(slice(None))
    grid, rays, air = setup.grid, batch.rays, batch.air
    azimuths, expansion, table = setup.azimuths, setup.expansion, setup.table
    arrays: dict[str, NDArray[Any]] = {
        "mu": rays.mu, "weight": rays.weight, "flux": rays.flux, "start": rays.start,
        "total": rays.total.reshape(-1), "end": rays.end, "radius": rays.radius,
        "mu_along": rays.mu_along, "turn": rays.turn,
        "amount": rays.amount[:, :constituents],
        "column": rays.column[:, :constituents].reshape(-1),
        "sun_cosines": grid.sun_cosines, "first_nodes": grid.first_nodes, "row": grid.row,
        "place": grid.place,
        "cosines": azimuths.cosines, "multiples": azimuths.multiples,
        "sines": azimuths.sines,
        "harmonic": expansion.start, "ahead": expansion.ahead, "back": expansion.back,
        "column_rows": setup.column_rows, "ratios": setup.ratios,
        "refraction_table": geometry.refraction_table,
        "level": batch.level[:, :WAVELENGTHS].reshape(-1),
        "extinction": _lanes(air.extinction), "moments": _lanes(air.moments),
        "polarised_moments": _lanes(air.polarised_moments),
        "albedo": _lanes(air.ground.albedo), "layer_plane": air.ground.layer.layer_plane,
    }  # fmt: skip
    sizes: dict[str, Any] = {
        "radii": setup.gathering.radii.size,
        "angles": rays.mu.shape[1],
        "sun_angles": grid.sun_cosines.size,
        "turns": azimuths.cosines.size,
        "degree": setup.degree,
        "terms": setup.terms,
        "constituents": constituents,
        "directions": table.values.shape[1],
        "levels": grid.radii.size,
        "refinement": setup.refinement,
        "received": grid.radii.size * grid.sun_cosines.size * (1 + setup.terms),
        "bottom": grid.bottom_radius,
        "top": grid.top_radius,
        "star_radius": air.star_radius,
        **numbers_of(air.ground),
    }
    textures, places = SOLVE.laid_out(arrays)
    return SolverPlan(
        batch=batch,
        sizes=sizes,
        places=places,
        solve=SOLVE.packed(sizes, places).reshape(-1, 4),
        tables=textures,
        spans=_spans(rays.start, sizes),
    )


def _lanes(values: Float32Array) -> Float32Array:
    """The first four of eight lanes, shape (..., 4)."""
    return values[..., :WAVELENGTHS]


def _spans(start: NDArray[np.int64], sizes: dict[str, Any]) -> tuple[RadiusRange, ...]:
    """Radius ranges that limit the size of textures."""
    angles = sizes["angles"]
    each = max(sizes["sun_angles"] * row_block(sizes), sizes["directions"])
    most = _SPAN // each - 1
    bounds = [0]
    for i in range(1, start.shape[0]):
        if start[i, angles] - start[bounds[-1], 0] > most:
            bounds.append(i)
    bounds.append(start.shape[0])
    return tuple(
        RadiusRange(
            first_point=int(start[low, 0]),
            points=int(start[high - 1, angles] - start[low, 0]),
            first_ray=low * angles,
            rays=(high - low) * angles,
        )
        for low, high in pairwise(bounds)
    )
