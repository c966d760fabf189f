"""``sweep``: parallel computation of the missing blocks of a grid, into Zarr."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import ConflictError
from airlight.files.output_lock import output_lock
from airlight.kernel.cache import Cache
from airlight.kernel.cost import LINES, announce_all
from airlight.kernel.memory import check_memory
from airlight.planets.omitted_absorption_bands import warn_of_omitted_bands
from airlight.planets.planet import Planet
from airlight.solver.moments.settings import settings_for
from airlight.solver.moments.solve import solve_work
from airlight.studies.distribution import opened_runner
from airlight.studies.distribution.fingerprint import check_code, code_digest, digest
from airlight.studies.sweep.grid import Grid
from airlight.studies.sweep.shared_solution import RadianceTask
from airlight.studies.sweep.store import (
    State,
    SweepStore,
    check_room,
    check_store,
    in_words,
    size_on_disk,
)
from airlight.studies.sweep.store_layout import POLARISED, chunk_shape

if TYPE_CHECKING:
    from airlight.kernel.threads import Progress

#: Source code that affects radiances: the imports of this file.
_SOURCE: Final = Path(__file__)
#: Size from which a store is reported in advance. [byte]
_LARGE: Final = 10**9
#: Memory per radiance of a block, from lines of sight to the compressed chunk, and per block in the
#: array of checksums. [byte]
_MEMORY: Final = 40
_MEMORY_OF_A_MARK: Final = 400


@dataclass(frozen=True, kw_only=True)
class Swept:
    """Sweep that was written.

    Attributes
    ----------
    path : Path
        Folder of the Zarr group.
    computed, kept : int
        Numbers of computed and of existing blocks.
    damaged : int
        Number of computed blocks that replaced damaged ones.
    radiances : int
        Total number of radiances.
    """

    path: Path
    computed: int
    kept: int
    damaged: int
    radiances: int


def sweep(
    grid: Grid,
    path: str | Path,
    *,
    quality: str = "default",
    polarisation: bool = True,
    stokes: bool = False,
    scheduler: str | None = None,
    workers: int | None = None,
    on_message: Callable[[str], None] | None = None,
    progress: Progress | None = None,
) -> Swept:
    """Compute the radiances of a grid that are missing, damaged or have changed.

    Existing blocks are verified by their checksums. The folder appears with the first block and is
    locked meanwhile.

    Parameters
    ----------
    grid : Grid
        Planets, varied keys, observers, suns, views and wavelengths.
    path : str or Path
        Folder of the Zarr group, new or of the same grid.
    quality : str
        Quality as for ``airlight.solve``.
    polarisation : bool
        Whether transfer is polarised.
    stokes : bool
        Whether to write the arrays ``Q``, ``U``, ``dolp`` and ``aolp`` too.
    scheduler, workers : optional
        See ``airlight.studies.distribution.opened_runner``.
    on_message : callable, optional
        Receives progress messages.
    progress : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    Swept
        Report; the store's ``radiance`` is float32, in W m⁻² sr⁻¹ nm⁻¹.

    Raises
    ------
    ParameterError
        If a planet cannot be read, a wavelength is outside its range, or Stokes parameters are
        requested of scalar transfer.
    FileError
        If the folder has the suffix of another format, contains another grid or a damaged group,
        cannot be written to or is locked, or the disk space is insufficient.
    CostError
        If a block needs more memory than is free.
    WorkerError
        If workers or their scheduler are lost.
    """
    if stokes and not polarisation:
        raise ConflictError("stokes", "requires polarisation")
    check_store(Path(path), "path")
    say = on_message or (lambda line: None)
    light = "radiance" if polarisation else "radiance of scalar transfer"
    light = "radiance and Stokes parameters" if stokes else light
    settings = replace(settings_for(quality), polarisation=polarisation)
    about = {"title": f"{light}, quality {quality}", "solver": "moments"}
    about["settings"] = settings.as_text()
    if grid.common:
        about["changes"] = "; ".join(f"{path}={value}" for path, value in grid.common.items())
    task = RadianceTask(
        planet=grid.planet((0,) * len(grid.variants)),
        wavelengths=grid.nm,
        quality=quality,
        polarisation=polarisation,
        stokes=stokes,
    )
    code = code_digest(_SOURCE)
    with output_lock(Path(path).resolve()):
        _check_cost(grid, Path(path), stokes, say)
        marks = _marks(grid, task, code, progress)
        store = SweepStore(Path(path), grid, about, stokes=stokes)
        states = {}
        for done, (block, mark) in enumerate(marks.items()):
            states[block] = store.state(block, mark)
            if progress is not None and states[block] is not State.MISSING:
                progress(done + 1, len(marks), "verifying")
        missing = [block for block, state in states.items() if state is not State.WHOLE]
        damaged = sum(state is State.DAMAGED for state in states.values())
        for name in store.renew():
            say(f"the axis {name} was damaged and is written again")
        if damaged:
            say(f"{damaged} of {len(marks)} blocks are damaged and will be recomputed")
        if missing:
            first = _first_of_variants(grid, missing)
            _announce(grid, first, missing, task)
            with opened_runner(len(missing), scheduler=scheduler, workers=workers) as runner:
                tasks = ((one, (_task(grid, one, task), code)) for one in first)
                for done, _ in enumerate(runner.run(solved, tasks)):
                    if progress is not None:
                        progress(done + 1, len(first), "solving")
                blocks = ((block, (*_block(grid, block, task), code)) for block in missing)
                for done, (block, values) in enumerate(runner.run(radiances, blocks)):
                    store.write(block, values, marks[block])
                    if progress is not None:
                        progress(done + 1, len(missing), "radiances")
    return Swept(
        path=Path(path),
        computed=len(missing),
        kept=len(marks) - len(missing),
        damaged=damaged,
        radiances=int(np.prod(grid.shape)),
    )


def _check_cost(grid: Grid, path: Path, stokes: bool, say: Callable[[str], None]) -> None:
    """Raise an error for a grid that exceeds disk or memory; announce the size of a large one."""
    count = math.prod(grid.blocks)
    size = size_on_disk(grid, stokes=stokes)
    work = f"a sweep of {math.prod(grid.shape):.3g} radiances in {count} blocks"
    check_room(path.resolve(), size)
    block = math.prod(chunk_shape(grid)) * _MEMORY * (len(POLARISED) + 1 if stokes else 1)
    check_memory(block + count * _MEMORY_OF_A_MARK, work)
    if size > _LARGE:
        say(f"{path}: up to {in_words(size)}, {work}")


def _marks(
    grid: Grid, task: RadianceTask, code: str, progress: Progress | None
) -> dict[tuple[int, ...], int]:
    """Fingerprint of each block: sixty-three bits of a hash, never 0."""
    found: dict[tuple[int, ...], int] = {}
    count = math.prod(grid.variants)
    suns, views = (
        [np.array(values[first : first + step]) for first in range(0, len(values), step)]
        for values, step in zip((grid.sun_zenith, grid.view_zenith), grid.steps, strict=True)
    )
    described = {
        (k, sun, view): (grid.altitude[k], suns[sun], views[view])
        for k, sun, view in _indices(grid.blocks[len(grid.variants) :])
    }
    for done, variant in enumerate(_indices(grid.variants)):
        planet = digest((_task(grid, variant, task), grid.azimuth, code))
        for inner, lines in described.items():
            found[*variant, *inner] = 1 + int(digest((planet, *lines))[:15], 16)
        if progress is not None and count > 1:
            progress(done + 1, count, "reading planets")
    return found


def _announce(
    grid: Grid,
    variants: Collection[tuple[int, ...]],
    missing: list[tuple[int, ...]],
    task: RadianceTask,
) -> None:
    """Announce the work, and emit warnings here, as those of workers are lost."""
    for one in sorted({variant[0] for variant in variants}):
        warn_of_omitted_bands(grid.planet((one, *(0 for _ in grid.vary))), grid.nm)
    lines = sum(_lines(grid, block) for block in missing)
    amounts = [
        ("solve", len(variants) * solve_work(task.quality, len(grid.nm))),
        (LINES, float(lines * len(grid.nm) * (3 if task.stokes else 1))),
    ]
    announce_all(f"{len(variants)} solutions and {lines} lines of sight", amounts)


def _first_of_variants(
    grid: Grid, blocks: list[tuple[int, ...]]
) -> dict[tuple[int, ...], tuple[int, ...]]:
    """First missing block of each planet of the grid."""
    first: dict[tuple[int, ...], tuple[int, ...]] = {}
    for block in blocks:
        first.setdefault(block[: len(grid.variants)], block)
    return first


def _lines(grid: Grid, block: tuple[int, ...]) -> int:
    """Number of lines of sight of a block."""
    suns, views = grid.region(block)[-4:-2]
    return int((suns.stop - suns.start) * (views.stop - views.start) * len(grid.azimuth))


def _indices(shape: tuple[int, ...]) -> Iterator[tuple[int, ...]]:
    return itertools.product(*(range(count) for count in shape))


_PLANETS: Final[Cache[tuple[Any, ...], Planet]] = Cache(1)


def _task(grid: Grid, variant: tuple[int, ...], task: RadianceTask) -> RadianceTask:
    """Task of a planet of the grid."""
    planet = _PLANETS.of((id(grid), *variant), lambda: grid.planet(variant))
    return replace(task, planet=planet)


def _block(
    grid: Grid, block: tuple[int, ...], task: RadianceTask
) -> tuple[RadianceTask, dict[str, Any]]:
    """Task of a block, and its lines of sight as arguments of ``radiance``. [m], [deg]"""
    *variant, altitude, _, _ = block
    suns, views = grid.region(block)[-4:-2]
    return _task(grid, tuple(variant), task), {
        "altitude": grid.altitude[altitude],
        "sun_zenith": np.array(grid.sun_zenith[suns])[:, None, None],
        "view_zenith": np.array(grid.view_zenith[views])[:, None],
        "azimuth": np.array(grid.azimuth),
    }


# --- on a worker ------------------------------------------------------------------------------


def solved(task: RadianceTask, code: str) -> None:
    """Solve a planet, and keep the solution on the disk of this machine."""
    check_code(code, _SOURCE)
    task.solution()


def radiances(task: RadianceTask, where: Mapping[str, Any], code: str) -> NDArray[np.float32]:
    """Arrays of a block, shape (1 or 5, suns, views, azimuths, wavelengths).

    The radiance [W m⁻² sr⁻¹ nm⁻¹], and with Stokes parameters ``POLARISED``.

    Parameters
    ----------
    task : RadianceTask
        Planet, wavelengths and accuracy.
    where : mapping
        Lines of sight, as arguments of ``radiance``.
    code : str
        Hash of the sender's source code.
    """
    check_code(code, _SOURCE)
    return np.stack([one.astype(np.float32) for one in task.layers(**where)])
