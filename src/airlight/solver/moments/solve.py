"""Solve of a medium by the moments solver, with the cache on disk and the energy balance check."""

from __future__ import annotations

import contextlib
import hashlib
from dataclasses import replace
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConvergenceError, warn
from airlight.kernel import disk
from airlight.kernel.cost import timed
from airlight.kernel.fingerprints import fingerprint
from airlight.kernel.lanes import LANES
from airlight.kernel.threads import Cancel, Progress
from airlight.solver.moments.energy_balance import imbalance, violates_energy_balance
from airlight.solver.moments.harmonics import moment_count
from airlight.solver.moments.iterate import Moments, solve_moments
from airlight.solver.moments.settings import MomentsSettings, settings_for
from airlight.solver.moments.setup import Setup
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.refracted_geometry import RefractedGeometry

if TYPE_CHECKING:
    from airlight.planets.medium import Medium


def solve(
    medium: Medium,
    settings: MomentsSettings,
    *,
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """Solution of a medium, computed or from the cache.

    If the energy balance is violated or the iteration does not converge, a medium with thick layers
    aloft is solved again with grids that resolve them.

    Parameters
    ----------
    medium : Medium
        Medium to solve.
    settings : MomentsSettings
        Grid sizes and tolerance.
    cache : bool
        Whether to read the solution from the cache on disk and to write it there.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.
    """
    resolved = replace(medium, resolve_layers=True)
    wider = resolved.thin_layers != medium.thin_layers
    key = _key(medium, settings)
    keys = {False: key, True: _resolved_key(key)}

    def obtained(one: Medium) -> MomentsSolution:
        return disk.cached(
            keys[one.resolve_layers],
            lambda: _computed(one, settings, progress=progress, cancel=cancel),
            _to_arrays,
            lambda stored: _stored(stored, one, settings),
            use=cache,
        )

    try:
        solution = obtained(medium)
    except ConvergenceError:
        if not wider:
            raise
        return _warned(obtained(resolved))
    if wider and violates_energy_balance(solution.moments.energy, settings.energy_tolerance):
        with contextlib.suppress(ConvergenceError):
            solution = min(solution, obtained(resolved), key=_largest_imbalance)
    return _warned(solution)


def _computed(
    medium: Medium, settings: MomentsSettings, *, progress: Progress | None, cancel: Cancel | None
) -> MomentsSolution:
    geometry = RefractedGeometry.of(medium)
    started = perf_counter()
    count = medium.wavelengths.size
    with timed("solve", solve_work(settings, count), f"solving {count} wavelengths"):
        moments = solve_moments(geometry, settings, progress=progress, cancel=cancel)
    return MomentsSolution(medium, settings, moments, perf_counter() - started, geometry)


def _stored(
    stored: dict[str, NDArray[Any]], medium: Medium, settings: MomentsSettings
) -> MomentsSolution | None:
    """Solution of arrays of the cache, or None."""
    geometry = RefractedGeometry.of(medium)
    moments = _from_arrays(Setup(geometry=geometry, settings=settings), stored)
    return None if moments is None else MomentsSolution(medium, settings, moments, 0.0, geometry)


def _to_arrays(solution: MomentsSolution) -> dict[str, NDArray[Any]]:
    moments = solution.moments
    return {
        "field": moments.field,
        "sky": moments.sky,
        "columns": moments.columns,
        "residual": moments.residual,
        "energy": moments.energy,
        "counts": np.array([moments.degree, moments.sweeps, moments.scheme]),
    }


def _largest_imbalance(solution: MomentsSolution) -> float:
    return float(np.abs(solution.moments.energy).max())


def _warned(solution: MomentsSolution) -> MomentsSolution:
    """Solution, after a warning if its energy balance error exceeds the tolerance."""
    moments, settings = solution.moments, solution.settings
    line = imbalance(moments.energy, solution.wavelengths, settings.energy_tolerance)
    if line:
        warn(line)
    return solution


def solve_work(quality: str | MomentsSettings, wavelengths: int) -> float:
    """Estimated work of a solve: five sweeps of a dusty atmosphere, moments times ray points. [1]

    The degree and the number of points are typical, since those of a planet take as long as a
    preview to determine.

    Parameters
    ----------
    quality : str or MomentsSettings
        Quality of the solution.
    """
    settings = settings_for(quality)
    degree = settings.thick_degree
    rays = 2.0 * settings.zenith_angles * max(settings.azimuths, 3 * degree // 4)
    points = settings.radii * settings.sun_angles * rays * settings.nodes
    return 5.0 * -(-wavelengths // LANES) * points * moment_count(degree)


def _key(medium: Medium, settings: MomentsSettings) -> str:
    text = f"moments {fingerprint(Path(__file__))} {settings.as_text()} {medium.fingerprint()}"
    return hashlib.sha256(text.encode()).hexdigest()[:40]


def _resolved_key(key: str) -> str:
    """Cache key of the solution whose grids resolve all layers."""
    return hashlib.sha256(f"{key} resolve_layers".encode()).hexdigest()[:40]


def _from_arrays(setup: Setup, arrays: dict[str, NDArray[Any]]) -> Moments | None:
    """Moments from the arrays of a cache file; None if they do not fit."""
    try:
        degree, sweeps, scheme = (int(x) for x in arrays["counts"])
        medium, sun_angles = setup.medium, setup.settings.sun_angles
        count, radii = medium.wavelengths.size, setup.gathering.radii.size
        shape = (radii, sun_angles, moment_count(degree), count)
        sound = (
            arrays["field"].shape == shape
            and arrays["field"].dtype == np.float32
            and arrays["sky"].shape == (radii, sun_angles, count)
            and arrays["residual"].shape == arrays["energy"].shape == (count,)
            and arrays["columns"].shape == setup.table_shape
            and bool(np.isfinite(arrays["field"]).all())
        )
        if not sound:
            return None
        return Moments(
            degree=degree,
            grid=setup.grid,
            refinement=setup.refinement,
            field=arrays["field"],
            sky=arrays["sky"],
            columns=arrays["columns"],
            sweeps=sweeps,
            residual=arrays["residual"],
            energy=arrays["energy"],
            scheme=scheme,
        )
    except (KeyError, ValueError, IndexError, TypeError):
        return None
