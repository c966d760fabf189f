"""``sweep``: the blocks of a grid that are missing, by many processes, into Zarr."""

from __future__ import annotations

import contextlib
import itertools
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.distribution import Runner, opened_runner
from airlight.distribution.fingerprint import check_code, code_digest, digest
from airlight.errors import ParameterError
from airlight.kernel.cost import LINES, announce_all
from airlight.planets.missing_bands import warn_of_missing_bands
from airlight.planets.planet import Planet
from airlight.solvers.moments.settings import settings_for
from airlight.solvers.moments.solve import solve_work
from airlight.solvers.stokes_frame import (
    STOKES,
    angle_of_polarisation,
    degree_of_polarisation,
)
from airlight.sweep.grid import Grid
from airlight.sweep.shared_solution import shared_solution
from airlight.sweep.store import SweepStore, check_store

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress
    from airlight.solvers.moments.solution import MomentsSolution

#: Source that computes radiances: this file's imports.
_SOURCE: Final = Path(__file__)


@dataclass(frozen=True, kw_only=True)
class Swept:
    """Sweep that was written.

    Attributes
    ----------
    path : Path
        Folder of the Zarr group.
    computed, kept : int
        Number of blocks that were computed, and that were there already.
    radiances : int
        Number of radiances in all.
    """

    path: Path
    computed: int
    kept: int
    radiances: int


@dataclass(frozen=True, kw_only=True)
class Block:
    """Lines of sight of one block.

    Attributes
    ----------
    planet : Planet
        Planet.
    quality : str
        Quality of its solution.
    polarisation, stokes : bool
        Whether light is polarised, and whether Q, U, degree and angle are wanted.
    altitude : float
        Altitude of the observer. [m]
    sun_zenith, view_zenith, azimuth : tuple of float
        Angles. [deg]
    wavelengths : tuple of float
        Wavelengths. [nm]
    """

    planet: Planet
    quality: str
    polarisation: bool
    stokes: bool
    altitude: float
    sun_zenith: tuple[float, ...]
    view_zenith: tuple[float, ...]
    azimuth: tuple[float, ...]
    wavelengths: tuple[float, ...]


def sweep(
    grid: Grid,
    path: str | Path,
    *,
    quality: str = "default",
    polarisation: bool = True,
    stokes: bool = False,
    scheduler: str | None = None,
    workers: int | None = None,
    progress: Progress | None = None,
) -> Swept:
    """Compute the radiances of a grid that are missing or have changed.

    Parameters
    ----------
    grid : Grid
        Planets, what varies, observers, suns, views and wavelengths.
    path : str or Path
        Folder of the Zarr group: new, or that of the same grid.
    quality : str
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether light is polarised, as for ``airlight.solve``.
    stokes : bool
        Whether the arrays ``Q``, ``U``, ``dolp`` and ``aolp`` are written beside the radiance.
    scheduler, workers : optional
        See ``airlight.distribution.opened_runner``.
    progress : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Swept
        The store's ``radiance`` is in W m⁻² sr⁻¹ nm⁻¹, float32; ``xarray.open_zarr`` opens it.

    Raises
    ------
    ParameterError
        If a planet cannot be read, or is not known at a wavelength; or Stokes parameters are
        requested of scalar transfer.
    FileError
        If the folder is named as a file of another format, or holds another grid, or one with or
        without Stokes parameters.
    WorkerError
        If workers or their scheduler are lost.
    """
    if stokes and not polarisation:
        raise ParameterError("stokes", True, "a sweep with polarisation left on")
    check_store(Path(path), "path")
    light = "radiance" if polarisation else "radiance of scalar transfer"
    light = "radiance and Stokes parameters" if stokes else light
    settings = replace(settings_for(quality), polarisation=polarisation)
    about = {"title": f"{light}, quality {quality}", "solver": "moments"}
    about["settings"] = settings.as_text()
    store = SweepStore(Path(path), grid, about, stokes=stokes)
    how = quality, polarisation, stokes
    code = code_digest(_SOURCE)
    missing: list[tuple[int, ...]] = []
    marks: dict[tuple[int, ...], int] = {}
    planets: dict[str, Planet] = {}
    for block in _indices(grid.blocks):
        task = _block(grid, block, how)
        planets.setdefault(task.planet.name, task.planet)
        # Sixty-three bits of the hash, never 0.
        marks[block] = 1 + int(digest((task, code))[:15], 16)
        if not store.has(block, marks[block]):
            missing.append(block)
    if missing:
        variants = list(dict.fromkeys(block[: len(grid.variants)] for block in missing))
        for planet in planets.values():  # here: nobody sees the warnings of a worker
            warn_of_missing_bands(planet, grid.nm)
        solutions, lines = len(variants), sum(_lines(grid, block) for block in missing)
        amounts = [
            ("solve", solutions * solve_work(quality, len(grid.nm))),
            (LINES, float(lines * len(grid.nm) * (3 if stokes else 1))),
        ]
        announce_all(f"{solutions} solutions and {lines} lines of sight", amounts)
        with contextlib.ExitStack() as stack:
            runner: Runner = stack.enter_context(
                opened_runner(len(missing), scheduler=scheduler, workers=workers)
            )
            first = {one: next(b for b in missing if b[: len(one)] == one) for one in variants}
            tasks = ((one, (_block(grid, first[one], how), code)) for one in variants)
            for done, _ in enumerate(runner.run(solved, tasks)):
                if progress is not None:
                    progress(done + 1, len(variants), "solving")
            blocks = ((block, (_block(grid, block, how), code)) for block in missing)
            for done, (block, values) in enumerate(runner.run(radiances, blocks)):
                store.write(grid.region(block), block, values, marks[block])
                if progress is not None:
                    progress(done + 1, len(missing), "radiances")
    count = len(marks)
    return Swept(
        path=Path(path), computed=len(missing), kept=count - len(missing),
        radiances=int(np.prod(grid.shape)),
    )  # fmt: skip


def _lines(grid: Grid, block: tuple[int, ...]) -> int:
    """Number of lines of sight of a block."""
    suns, views = grid.region(block)[-4:-2]
    return int((suns.stop - suns.start) * (views.stop - views.start) * len(grid.azimuth))


def _indices(shape: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    return itertools.product(*(range(count) for count in shape))


_PLANETS: Final[dict[tuple[Any, ...], Planet]] = {}


def _block(grid: Grid, block: tuple[int, ...], how: tuple[str, bool, bool]) -> Block:
    quality, polarisation, stokes = how
    *variant, altitude, _, _ = block
    suns, views = grid.region(block)[-4:-2]
    key = (id(grid), *variant)
    if key not in _PLANETS:
        _PLANETS.clear()
        _PLANETS[key] = grid.planet(tuple(variant))
    return Block(
        planet=_PLANETS[key], quality=quality, polarisation=polarisation, stokes=stokes,
        altitude=grid.altitude[altitude],
        sun_zenith=tuple(grid.sun_zenith[suns]), view_zenith=tuple(grid.view_zenith[views]),
        azimuth=tuple(grid.azimuth), wavelengths=grid.nm,
    )  # fmt: skip


# --- on a worker ------------------------------------------------------------------------------


def solved(block: Block, code: str) -> None:
    """Solve a block's planet, and keep the solution on the disk of this machine."""
    check_code(code, _SOURCE)
    _solution(block)


def radiances(block: Block, code: str) -> NDArray[np.float32]:
    """Arrays of a block, shape (1 or 5, suns, views, azimuths, wavelengths).

    The radiance [W m⁻² sr⁻¹ nm⁻¹], and with Stokes parameters ``POLARISED``.

    Parameters
    ----------
    block : Block
        Lines of sight.
    code : str
        Hash of the source of the process that sent it.
    """
    check_code(code, _SOURCE)
    found = _solution(block).radiance(
        altitude=block.altitude,
        sun_zenith=np.array(block.sun_zenith)[:, None, None],
        view_zenith=np.array(block.view_zenith)[:, None],
        azimuth=np.array(block.azimuth),
        stokes=block.stokes,
    )
    if not block.stokes:
        return np.asarray(found, np.float32)[None]
    layers = [found.sel(stokes=name) for name in STOKES]
    layers += [degree_of_polarisation(found), angle_of_polarisation(found)]
    return np.stack([np.asarray(one, np.float32) for one in layers])


def _solution(block: Block) -> MomentsSolution:
    return shared_solution(
        block.planet, block.wavelengths, block.quality, polarisation=block.polarisation
    )
