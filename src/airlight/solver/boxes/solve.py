"""``solve_box``: light of a cloud field, computed or from the cache on disk."""

from __future__ import annotations

import hashlib
from pathlib import Path
from time import perf_counter
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.clouds.cloud_field import CloudField
from airlight.clouds.cloud_optics import CloudOptics
from airlight.errors import ParameterError, warn
from airlight.kernel import disk
from airlight.kernel.fingerprints import fingerprint
from airlight.kernel.lanes import HALF_LANES
from airlight.kernel.memory import check_memory
from airlight.kernel.threads import Cancel, Progress
from airlight.solver.boxes.directions import TOGETHER, directions, term_count
from airlight.solver.boxes.grid import BoxGrid, box_grid
from airlight.solver.boxes.iterate import BoxIteration, BoxLevels
from airlight.solver.boxes.light import BoxLight
from airlight.solver.boxes.nest import Nest
from airlight.solver.boxes.problem import BoxProblem, beam_cells, beam_depths
from airlight.solver.boxes.scaled_optics import BoxOptics, scaled_optics
from airlight.solver.boxes.settings import BoxSettings, settings_for
from airlight.solver.boxes.solution import BoxSolution
from airlight.solver.report import Report

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: Angles of the phase function in a fingerprint. [deg]
_ANGLES: Final = np.linspace(0.0, 180.0, 361)
#: Largest error of the energy balance without a warning. [1]
_ENERGY: Final = 0.02
#: Floats of a cell besides moments: optics, currents and the balance.
_FLOATS: Final = 30


def sky_directions(quality: str | BoxSettings = "default") -> FloatArray:
    """Directions of the light that enters at the top, shape (n, 3); see ``BoxLight.sky``. [1]"""
    settings = settings_for(quality)
    ways = directions(settings.zenith_angles, settings.azimuths)
    return np.asarray(ways.vectors[0].reshape(-1, 3))


def solve_box(
    field: CloudField,
    optics: CloudOptics,
    light: BoxLight,
    *,
    nest: Nest | None = None,
    quality: str | BoxSettings = "default",
    cache: bool = True,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> BoxSolution:
    """Multiple scattering in a cloud field above flat ground, by discrete ordinates.

    Without polarisation. Light that enters at clear sides is that of the same air and ground
    without cloud.

    Parameters
    ----------
    field : CloudField
        Cloud.
    optics : CloudOptics
        Optical properties of its particles, at any number of wavelengths.
    light : BoxLight
        Sun, sky, ground and air.
    nest : Nest, optional
        Larger box, whose light enters at the sides.
    quality : str or BoxSettings
        ``"preview"``, ``"default"`` or ``"high"``, or settings.
    cache : bool
        Whether to read the solution from the cache on disk, and to write it there.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Raises
    ------
    ParameterError
        If the light does not fit the field or the wavelengths.
    CostError
        If the solution does not fit into free memory.
    ConvergenceError
        If the sweeps do not converge.
    """
    settings = settings_for(quality)
    count = np.size(optics.wavelengths)
    if light.albedo.size not in (1, count):
        raise ParameterError("albedo", light.albedo, f"1 or {count} numbers")
    edges = np.array([field.base, field.top])
    thickest = float(scaled_optics(optics, None, edges, settings.degree).cloud.max())
    grid = box_grid(field, light.ground, thickest, settings)
    _check_memory(grid, settings, count)
    given = light.sky_at(sky_directions(settings), count), _direct(light, optics, grid, settings)

    def make() -> BoxSolution:
        return _computed(field, optics, light, settings, grid, given, nest, progress, cancel)

    return disk.cached(
        _key(field, optics, light, settings, given, nest),
        make,
        _to_arrays,
        lambda stored: _of_arrays(stored, field, optics, light, settings, grid),
        use=cache,
    )


def _check_memory(grid: BoxGrid, settings: BoxSettings, wavelengths: int) -> None:
    cells, terms = grid.extinction.size, term_count(settings.degree)
    _, ny, nx = grid.extinction.shape
    ways = settings.zenith_angles * settings.azimuths // 4 + TOGETHER
    work = cells * (2 * terms + _FLOATS) + nx * ny * (2 * terms + 8 * ways)
    kept = cells * term_count(settings.stored_degree) * wavelengths
    needed = 4.0 * (HALF_LANES * work + kept)
    check_memory(needed, f"the light of a box of {cells} cells at {wavelengths} wavelengths")


def _computed(
    field: CloudField,
    optics: CloudOptics,
    light: BoxLight,
    settings: BoxSettings,
    grid: BoxGrid,
    given: tuple[FloatArray, FloatArray],
    nest: Nest | None,
    progress: Progress | None,
    cancel: Cancel | None,
) -> BoxSolution:
    started = perf_counter()
    count = np.size(optics.wavelengths)
    scaled = scaled_optics(optics, light.air, grid.edges, settings.degree)
    sky, beam = given
    shape = grid.extinction.shape[1:]
    depth = np.zeros((shape[0], 1, shape[1], beam.shape[0]), np.float32)
    if beam.any():
        cells = beam_cells(grid, light.curvature)
        if nest is not None:
            cells = nest.beam_cells(float(grid.edges[0]), light.curvature)
        depth = beam_depths(
            grid,
            light.towards,
            settings.beam_points,
            cells,
            cells.corner if nest is None else (field.west, field.south),
            progress=progress,
            cancel=cancel,
        )
    ground = np.broadcast_to(light.albedo, (count,))
    by_octant = sky.reshape(4, -1, count)
    parts = []
    for first in range(0, count, HALF_LANES):
        some = slice(first, min(first + HALF_LANES, count))
        optics_here = BoxOptics(*(one[..., some] for one in scaled))
        problem = BoxProblem(
            grid,
            optics_here,
            light.towards,
            ground[some],
            by_octant[..., some],
            beam[:, some],
            light.curvature,
            depth,
        )
        sides, start = None, None
        if nest is not None:
            ways = directions(settings.zenith_angles, settings.azimuths)
            sides, start = nest.sides(field, grid, ways, some), nest.start(field, grid, some)
        elif not grid.periodic:
            sides = _sides(problem, settings)
        # Without names, so that workspaces are free when moments are copied.
        parts.append(
            _BoxPart.of(
                BoxIteration(problem, settings, sides, start).run(progress=progress, cancel=cancel),
                grid,
                settings,
                some.stop - some.start,
            )
        )
    joined = [
        one[0] if len(one) == 1 else np.concatenate(one, axis=-1)
        for one in zip(*parts, strict=True)
    ]
    moments, down, direct, up, absorbed, residual, energy, sweeps = joined
    imbalance = float(np.abs(energy).max()) if grid.periodic else 0.0
    if imbalance > _ENERGY:
        warn(f"the light of clouds misses the balance of energy by {100.0 * imbalance:.2g} %")
    report = Report(
        solver="boxes",
        settings=settings.as_text(),
        sweeps=int(sweeps.max()),
        residual=tuple(residual.tolist()),
        seconds=perf_counter() - started,
        energy=tuple(energy.tolist()) if grid.periodic else (),
    )
    middle = 0.5 * (depth[..., 1:] + depth[..., :-1]).mean(axis=1)  # (ny, nx, levels)
    mean = grid.coarse(np.ascontiguousarray(middle.transpose(2, 0, 1))).transpose(2, 1, 0)
    solution = BoxSolution(
        field=field,
        optics=optics,
        light=light,
        settings=settings,
        levels=grid.coarse_edges,
        moments=moments,
        depth=np.ascontiguousarray(mean),
        down=down,
        direct=direct,
        up=up,
        absorbed=absorbed,
        report=report,
    )
    solution.depth[...] *= np.float32(solution.scaled_at_reference)
    return solution


def _direct(
    light: BoxLight, optics: CloudOptics, grid: BoxGrid, settings: BoxSettings
) -> FloatArray:
    """Irradiance of the beam at the edges of levels without cloud, shape (levels + 1, w). [1]"""
    count, levels = np.size(optics.wavelengths), grid.edges.size
    if light.beam is not None:
        found = np.asarray(light.beam.irradiance(grid.edges), np.float64)
        if found.shape != (levels, count) or not np.all((found >= 0.0) & (found < np.inf)):
            raise ParameterError(
                "beam.irradiance", f"shape {found.shape}", f"0 or more, shape {(levels, count)}"
            )
        if light.beam.air is None:
            return found
        whole, known = (
            scaled_optics(optics, air, grid.edges, settings.degree).air
            for air in (light.air, light.beam.air)
        )
        paths = _paths(grid.edges, light.cosine, light.beam.radius)
        return np.asarray(found * np.exp(-paths @ np.maximum(whole - known, 0.0)))
    if light.cosine == 0.0:
        return np.zeros((levels, count))
    air = scaled_optics(optics, light.air, grid.edges, settings.degree).air
    above = np.cumsum((air * np.diff(grid.edges)[:, None])[::-1], axis=0)[::-1]
    return np.exp(-np.concatenate([above, np.zeros((1, count))]) / light.cosine)


def _paths(edges: FloatArray, cosine: float, radius: float) -> FloatArray:
    """Lengths of rising beams from each edge through the levels, shape (levels + 1, levels). [m]"""
    rise = np.maximum(edges - edges[:, None], 0.0)
    start = radius * cosine
    ends = 2.0 * radius * rise / (start + np.sqrt(start**2 + 2.0 * radius * rise) + 1e-9)
    return np.diff(ends, axis=1)


class _BoxPart(tuple[NDArray[Any], ...]):
    """Arrays of a solution for some wavelengths, the last axis."""

    @classmethod
    def of(cls, levels: BoxLevels, grid: BoxGrid, settings: BoxSettings, count: int) -> _BoxPart:
        """Arrays of the first ``count`` wavelengths, on the cells of the field."""
        terms = term_count(settings.stored_degree)
        moments = grid.coarse(levels.moments[..., :terms, :count])
        columns = [
            grid.coarse_columns(one[None])[0][..., :count].transpose(1, 0, 2)
            for one in (levels.down, levels.direct, levels.up)
        ]
        return cls(
            [
                np.ascontiguousarray(moments.transpose(2, 1, 0, 3, 4)),
                *(np.ascontiguousarray(one) for one in columns),
                levels.absorbed[:count],
                levels.residual[:count],
                levels.energy[:count],
                np.full(count, levels.sweeps),
            ]
        )


def _sides(problem: BoxProblem, settings: BoxSettings) -> tuple[Float32Array, Float32Array]:
    """Light at the sides: that of one column without cloud, which repeats itself."""
    grid = problem.grid
    levels = grid.extinction.shape[0]
    column = BoxGrid(
        np.zeros((levels, 1, 1), np.float32),
        grid.edges,
        grid.widths,
        True,
        (1, 1, 1),
        levels,
        0,
    )
    depth = np.zeros((1, 1, 1, levels + 1), np.float32)
    alone = problem._replace(grid=column, beam_depth=depth)
    sides = BoxIteration(alone, settings).run().sides
    return sides, sides


def _key(
    field: CloudField,
    optics: CloudOptics,
    light: BoxLight,
    settings: BoxSettings,
    given: tuple[FloatArray, FloatArray],
    nest: Nest | None,
) -> str:
    """Fingerprint of all that a solution depends on."""
    digest = hashlib.sha256(f"boxes {fingerprint(Path(__file__))} {settings.as_text()}".encode())
    place = (light.ground or 0.0, light.curvature)
    numbers = (*field.spacing, field.base, *light.towards, *place)
    words = f"{numbers} {light.ground is None} {field.beyond} {field.interpolated}"
    digest.update(words.encode() + str(field.extinction.shape).encode())
    nm = np.asarray(optics.wavelengths, np.float64)
    arrays = [field.extinction, nm, optics.extinction, optics.albedo, light.albedo, *given]
    arrays.append(optics.phase.values(np.cos(np.radians(_ANGLES)), nm))
    if light.air is not None:
        arrays += [light.air.edges, light.air.extinction, light.air.albedo, light.air.moments]
    if nest is not None:
        digest.update(f"{field.drift} {nest.field.drift} {nest.field.spacing}".encode())
        arrays += [nest.around.moments, nest.field.extinction]
    for one in arrays:
        digest.update(np.ascontiguousarray(one).tobytes())
    return digest.hexdigest()[:40]


#: Arrays of a solution, by name.
_ARRAYS: Final = ("moments", "depth", "down", "direct", "up", "absorbed")


def _to_arrays(solution: BoxSolution) -> dict[str, NDArray[Any]]:
    report = solution.report
    return {name: getattr(solution, name) for name in _ARRAYS} | {
        "residual": np.array(report.residual),
        "energy": np.array(report.energy),
        "sweeps": np.array(report.sweeps),
    }


def _of_arrays(
    stored: dict[str, NDArray[Any]],
    field: CloudField,
    optics: CloudOptics,
    light: BoxLight,
    settings: BoxSettings,
    grid: BoxGrid,
) -> BoxSolution | None:
    """Solution of arrays of the cache, or None if they do not fit."""
    try:
        count = np.size(optics.wavelengths)
        nx, ny, _ = field.extinction.shape
        shape = (nx, ny, grid.coarse_edges.size - 1)
        terms = term_count(settings.stored_degree)
        sound = (
            stored["moments"].shape == (*shape, terms, count)
            and stored["depth"].shape == shape
            and stored["residual"].shape == (count,)
            and stored["energy"].shape == ((count,) if grid.periodic else (0,))
            and all(stored[name].shape == (nx, ny, count) for name in ("down", "direct", "up"))
            and bool(np.isfinite(stored["moments"]).all())
        )
        if not sound:
            return None
        report = Report(
            solver="boxes",
            settings=settings.as_text(),
            sweeps=int(stored["sweeps"]),
            residual=tuple(stored["residual"].tolist()),
            seconds=0.0,
            energy=tuple(stored["energy"].tolist()),
        )
        arrays = {name: stored[name] for name in _ARRAYS}
        return BoxSolution(
            field=field, optics=optics, light=light, settings=settings,
            levels=grid.coarse_edges, report=report, **arrays,
        )  # fmt: skip
    except (KeyError, ValueError, TypeError):
        return None
