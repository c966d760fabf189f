"""The moments solver's result: marches lines of sight through the moments."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.path import MAX_EDGES
from airlight.geometry.quadrature import gauss_legendre
from airlight.kernel import compiled_loop, source_fingerprint
from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.planets.medium import Medium
from airlight.solvers.moments.air import make_air, pack
from airlight.solvers.moments.grid import make_grid
from airlight.solvers.moments.harmonics import normalisation
from airlight.solvers.moments.iterate import Moments, pack_light, solve_moments
from airlight.solvers.moments.march import (
    Light,
    Workspace,
    direct_irradiance,
    march,
    sky_irradiance,
)
from airlight.solvers.moments.settings import Settings
from airlight.solvers.solution import Report, Sight, Solution
from airlight.tables import cache as disk
from airlight.tables.columns import new_path

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Lines of sight in one block of work.
_BLOCK = 2048


class MomentsSolution(Solution):
    """A solution by the moments solver.

    Parameters
    ----------
    medium : Medium
        What was solved.
    settings : Settings
        How finely.
    moments : Moments
        What came out.
    seconds : float
        What it took; 0 from the cache. [s]
    """

    def __init__(
        self, medium: Medium, settings: Settings, moments: Moments, seconds: float
    ) -> None:
        self.medium = medium
        self.settings = settings
        self.moments = moments
        self.report = Report(
            solver="moments",
            settings=f"{settings.as_text()} degree_used={moments.degree}",
            sweeps=moments.sweeps,
            residual=tuple(float(x) for x in moments.residual),
            seconds=seconds,
        )

    @cached_property
    def lights(self) -> tuple[tuple[slice, Light], ...]:
        """What ``march`` needs, for each block of eight wavelengths."""
        count = self.wavelengths.size
        blocks = [slice(first, min(first + LANES, count)) for first in range(0, count, LANES)]
        return tuple((block, self._light(block)) for block in blocks)

    def _light(self, block: slice) -> Light:
        moments = self.moments
        missing = LANES - (block.stop - block.start)

        def filled(values: Float32Array) -> Float32Array:
            part = values[..., block]
            return np.concatenate([part, np.repeat(part[..., -1:], missing, axis=-1)], axis=-1)

        field, sky = pack_light(filled(moments.field), filled(moments.sky))
        return Light(
            grid=moments.grid,
            air=make_air(self.medium, moments.degree, block),
            scattering=pack(self.medium.scattering[:, block]),
            constants=normalisation(moments.degree),
            field=field,
            sky=sky,
            columns=moments.columns,
            density_edges=self.medium.density.edges,
            coefficients=self.medium.density.coefficients,
        )

    def workspace(self, nodes: int, panels: int) -> Workspace:
        """Scratch for one thread that marches with so many nodes a panel and panels a leg."""
        constituents = len(self.medium.names)
        return Workspace(
            edges=np.empty(MAX_EDGES),
            path=new_path(nodes * (2 * panels + 4), constituents),
            functions=np.empty(normalisation(self.moments.degree).size),
            here=np.empty(constituents),
        )

    def relative_radiance(self, sight: Sight, *, order: int | None = None) -> FloatArray:
        """See ``Solution``; all orders, or the first alone."""
        n = sight.r.size
        out = np.empty((n, self.wavelengths.size))
        nodes, panels = self.settings.march_nodes, self.settings.march_panels
        quadrature = gauss_legendre(nodes)
        rule = (quadrature.nodes, quadrature.weights, quadrature.running)
        lights = self.lights

        def run(index: int) -> None:
            rows = slice(index * _BLOCK, min((index + 1) * _BLOCK, n))
            phases = self.medium.phase_function(sight.nu[rows])
            work = self.workspace(nodes, panels)
            for block, light in lights:
                phase = _pack_rows(phases[..., block])
                result = np.empty((phase.shape[0], 2 * LANES), np.float32)
                _march_all(
                    sight.r[rows], sight.mu[rows], sight.mu_s[rows], sight.nu[rows],
                    sight.length[rows], sight.to_ground[rows], 2 if order is None else 1, phase,
                    panels, rule, light, work, result,
                )
                out[rows, block] = result[:, : block.stop - block.start]

        run_blocks(run, -(-n // _BLOCK))
        return out

    def relative_direct_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        work = self.workspace(1, 1)
        return self._received(r, lambda light, out: direct_irradiance(r, mu_s, light, work, out))

    def relative_sky_irradiance(self, r: FloatArray, mu_s: FloatArray) -> FloatArray:
        """See ``Solution``."""
        return self._received(r, lambda light, out: sky_irradiance(r, mu_s, light, out))

    def _received(
        self, r: FloatArray, fill: Callable[[Light, Float32Array], None]
    ) -> FloatArray:
        out = np.empty((r.size, self.wavelengths.size))
        for block, light in self.lights:
            result = np.empty((r.size, LANES), np.float32)
            fill(light, result)
            out[:, block] = result[:, : block.stop - block.start]
        return out


def _pack_rows(values: FloatArray) -> Float32Array:
    """(n, nc, up to 8) to flat float32 rows (n, nc·8)."""
    n, constituents, count = values.shape
    packed = np.zeros((n, constituents, LANES), np.float32)
    packed[..., :count] = values
    packed[..., count:] = values[..., -1:]
    return packed.reshape(n, constituents * LANES)


@compiled_loop
def _march_all(r, mu, mu_s, nu, length, to_ground, orders, phase, panels, rule, light, work, out):
    for k in range(r.size):
        march(
            r[k], mu[k], mu_s[k], nu[k], length[k], to_ground[k], orders, phase[k], panels, rule,
            light, work, out[k],
        )


def solve(
    medium: Medium,
    settings: Settings,
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """Solve a medium, or read its solution from the cache.

    Parameters
    ----------
    medium : Medium
        What to solve.
    settings : Settings
        How finely.
    cache : bool
        Whether to look for the solution on disk and to leave it there.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    key = _key(medium, settings)
    if cache:
        stored = disk.load(key)
        if stored is not None:
            moments = _from_arrays(medium, settings, stored)
            if moments is not None:
                return MomentsSolution(medium, settings, moments, 0.0)
    started = perf_counter()
    moments = solve_moments(medium, settings, progress=progress, cancel=cancel)
    solution = MomentsSolution(medium, settings, moments, perf_counter() - started)
    if cache:
        disk.save(
            key,
            {
                "field": moments.field,
                "sky": moments.sky,
                "columns": moments.columns,
                "residual": moments.residual,
                "counts": np.array([moments.degree, moments.sweeps]),
            },
        )
    return solution


def _key(medium: Medium, settings: Settings) -> str:
    import hashlib

    text = f"moments {source_fingerprint()} {settings.as_text()} {medium.fingerprint()}"
    return hashlib.sha256(text.encode()).hexdigest()[:40]


def _from_arrays(
    medium: Medium, settings: Settings, arrays: dict[str, NDArray[Any]]
) -> Moments | None:
    """The moments that a cache file holds, or None if it holds something else."""
    try:
        degree, sweeps = (int(x) for x in arrays["counts"])
        count, terms = medium.wavelengths.size, (degree + 1) * (degree + 2) // 2
        shape = (settings.radii, settings.suns, terms, count)
        sound = (
            arrays["field"].shape == shape
            and arrays["field"].dtype == np.float32
            and arrays["sky"].shape == (settings.radii, settings.suns, count)
            and arrays["residual"].shape == (count,)
            and arrays["columns"].shape[2] == len(medium.names)
            and bool(np.isfinite(arrays["field"]).all())
        )
        if not sound:
            return None
        return Moments(
            degree=degree,
            grid=make_grid(
                medium.bottom_radius, medium.top_radius, settings.radii, settings.suns
            ),
            field=arrays["field"],
            sky=arrays["sky"],
            columns=arrays["columns"],
            sweeps=sweeps,
            residual=arrays["residual"],
        )
    except (KeyError, ValueError, IndexError, TypeError):
        return None
