"""``SolverPlan``: data with which a host in any language runs the solver passes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.render.gpu.emit.uniform_struct import Place
from airlight.render.gpu.solver.passes import (
    ITERATES,
    MIX,
    ONCE,
    PACK,
    PASSES,
    SWEEP,
    SolverPass,
    shader,
)
from airlight.render.gpu.solver.tables import SOLVE
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.solver.moments.harmonics import POLARISED
from airlight.solver.moments.setup import Setup, WavelengthBatch

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]


def row_block(sizes: Mapping[str, Any]) -> int:
    """Texels per point and sun angle in the texture ``rows``."""
    return int(sizes["degree"]) + 2 + POLARISED


@dataclass(frozen=True, kw_only=True)
class RadiusRange:
    """Contiguous radii whose rays are processed by one run of a pass.

    Attributes
    ----------
    first_point, points : int
        First point of their rays, and number of points.
    first_ray, rays : int
        First ray, and number of rays.
    """

    first_point: int
    points: int
    first_ray: int
    rays: int


@dataclass(frozen=True, kw_only=True)
class SolverPlan:
    """Sizes, tables and texture layout of a solve.

    Attributes
    ----------
    batch : WavelengthBatch
        Set-up of its wavelengths: geometry, degree, grid, rays, tables.
    sizes : dict
        Values of ``GridSizes``, and of the law of reflection, by name.
    places : dict
        Start and axes of each table.
    solve : array, shape (n, 4)
        Values of the uniform ``solve``.
    tables : dict
        Contents of the textures ``scalars`` and ``spectra``, shapes (n, 1) and (n, 4).
    spans : tuple of RadiusRange
        Radius ranges.
    """

    batch: WavelengthBatch
    sizes: dict[str, Any]
    places: dict[str, Place]
    solve: Float32Array
    tables: dict[str, Float32Array]
    spans: tuple[RadiusRange, ...]

    @property
    def setup(self) -> Setup:
        """Set-up shared by all wavelengths."""
        return self.batch.setup

    @property
    def thick(self) -> FloatArray:
        """Weight of optically thick media, shape (4,); see ``WavelengthBatch``. [1]"""
        return self.batch.thick[:WAVELENGTHS]

    @property
    def nodes(self) -> int:
        """Number of nodes: radii times sun angles."""
        return int(self.sizes["radii"] * self.sizes["sun_angles"])

    @property
    def textures(self) -> dict[str, int]:
        """Texels of each texture that a pass fills."""
        n = self.sizes
        rays = n["radii"] * n["angles"]
        points = self.spans[-1].first_point + self.spans[-1].points
        most = max(span.points for span in self.spans)
        field = self.nodes * (n["terms"] + 1)
        levels = n["levels"] * n["sun_angles"]
        return {
            "strengths": points * (n["constituents"] + 1),
            "factors": points * (n["terms"] + 1),
            "shares": rays,
            "throughs": rays,
            "bounces": rays,
            "projections": -(-rays * (n["terms"] + 1) // WAVELENGTHS),
            "depths": (1 + most) * n["directions"],
            "rows": most * n["sun_angles"] * row_block(n),
            **dict.fromkeys(
                ("radiances", "stokes_qs", "stokes_us"), rays * n["sun_angles"] * n["turns"]
            ),
            "azimuthals": rays * n["sun_angles"] * (n["degree"] + 6),
            "first": field,
            "light": field,
            "heights": 2 * n["sun_angles"],
            "floors": 2,
            "fine": levels * (n["terms"] + 1),
            "level_heights": 2 * n["sun_angles"],
            "scales": 2 * levels,
            "packed": levels * (n["terms"] + 3),
            "means": 4 * self.nodes,
            "sounds": 2 * self.nodes,
            **dict.fromkeys(ITERATES, field),
        }

    def texels(self, one: SolverPass, span: RadiusRange | None = None) -> tuple[int, int, int]:
        """Texel range of a pass (end exclusive), and first point of its rays.

        Parameters
        ----------
        span : RadiusRange, optional
            Radius range of a spanned pass.
        """
        if span is None:
            target = ITERATES[0] if one.targets[0] == "iterate" else one.targets[0]
            return 0, self.textures[target], 0
        n = self.sizes
        if one.targets[-1] in ("radiances", "stokes_qs", "stokes_us"):
            each = n["sun_angles"] * n["turns"]
            begin = span.first_ray * each
            return begin, begin + span.rays * each, span.first_point
        if one.targets == ("depths",):
            return 0, (1 + span.points) * n["directions"], span.first_point
        return 0, span.points * n["sun_angles"] * row_block(n), span.first_point

    def runs(self, passes: tuple[SolverPass, ...]) -> list[tuple[SolverPass, tuple[int, int, int]]]:
        """Passes in running order with their texels; spanned passes repeat per radius range.

        Returns
        -------
        list of (SolverPass, (int, int, int))
            Passes with their ``texels``.
        """
        listed: list[tuple[SolverPass, tuple[int, int, int]]] = []
        at = 0
        while at < len(passes):
            end = at
            while end < len(passes) and passes[end].spanned:
                end += 1
            if end == at:
                listed.append((passes[at], self.texels(passes[at])))
                at += 1
                continue
            listed += [
                (one, self.texels(one, span)) for span in self.spans for one in passes[at:end]
            ]
            at = end
        return listed

    def as_dict(self) -> dict[str, Any]:
        """Plan as JSON values, without three arrays.

        The arrays are the uniform ``solve``, and the ``tables``, which fill the flat textures
        ``scalars`` and ``spectra``, ``r32float`` and ``rgba32float``. Every other texture is a flat
        ``rgba32float`` with the number of texels in ``textures``, and every shader has the entry
        ``fill``, which fills its ``targets`` and skips texels beyond its span. A host

        1. runs ``once`` and copies ``first`` to ``light``;
        2. for each order: rotates the ring of ``iterates`` by one, so that the oldest is
           ``iterate_0`` and ``iterate``; runs ``pack`` and ``sweep``; reads ``means`` (mean
           radiance and irradiance of the iterate, then of the previous light); writes the uniform
           ``mix``, a vec4f for the Anderson weight of each iterate, the latest first, one for the
           largest mean radiance and one for the largest irradiance; and runs ``mix``, which
           computes the next ``light``;
        3. runs ``pack`` at the end: ``packed`` is the input of a march.

        A change of coefficients alone changes only ``extinction``, ``moments``,
        ``polarised_moments``, ``albedo`` and ``level`` in their textures, at the positions in
        ``tables``.
        """

        def written(passes: tuple[SolverPass, ...]) -> list[dict[str, Any]]:
            return [
                {"shader": one.name, "targets": list(one.targets), "span": [*texels, 0]}
                for one, texels in self.runs(passes)
            ]

        tables = {
            name: {"texture": SOLVE.tables[name].texture, "start": start, "shape": shape}
            for name, (start, *shape) in self.places.items()
        }
        return {
            "sizes": {name: float(value) for name, value in self.sizes.items()},
            "uniform": list(SOLVE.vectors()),
            "tables": tables,
            "textures": self.textures,
            "iterates": list(ITERATES),
            "passes": {
                "once": written(ONCE),
                "pack": written(PACK),
                "sweep": written(SWEEP),
                "mix": written(MIX),
            },
            "shaders": {name: shader(name) for name in sorted(PASSES)},
        }
