"""Rounds of Monte Carlo histories until each line of sight has the requested standard error.

Each pair of line of sight and wavelength is an independent task. A task begins with two blocks of
histories, whose variance determines the number of further ones, at most three times the previous
number. Decisions are made after complete rounds, and sums are added in block order, so that results
do not depend on the number of threads.
"""

from __future__ import annotations

import struct
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from airlight.geometry.occulted_star import OccultedStar
from airlight.kernel.threads import Cancel, Progress, run_blocks
from airlight.solver.montecarlo.cloud_cells import CloudyStarts
from airlight.solver.montecarlo.events import HistoryStart
from airlight.solver.montecarlo.histories import trace_paths
from airlight.solver.montecarlo.history_optics import HistoryOptics
from airlight.solver.montecarlo.rays import new_trace
from airlight.solver.montecarlo.settings import MonteCarloSettings
from airlight.solver.montecarlo.streams import stream
from airlight.solver.montecarlo.sun_biased_sampling import new_sampling_density
from airlight.solver.tables.ring_shadow import RingShadow

FloatArray = NDArray[np.float64]

#: Number of histories of a block, which has its own stream of random numbers.
BLOCK: Final = 8192
#: Number of blocks in the first round.
_FIRST_ROUND: Final = 2
#: Number of blocks without any contribution after which a task ends.
_DARK: Final = 64
#: Zenith cosine of the star on a line of sight below which half of the points are drawn towards
#: sunlight; above, nearly the whole atmosphere is sunlit. [1]
_LOW_STAR: Final = 0.0
_SUN_SAMPLING_FRACTION: Final = 0.5


@dataclass(frozen=True)
class Estimate:
    """Monte Carlo estimates for n lines of sight.

    Attributes
    ----------
    total, total_error : array, shape (n, nl)
        Radiance (or irradiance) per irradiance of the star and its standard error, including an
        exact first order. [sr⁻¹] or [1]
    parts, part_errors : array, shape (n, k + 1, nl)
        Contributions of each order; the last is the sum of all further ones. Errors of the orders
        of a line are correlated, those of different lines or wavelengths are not.
    histories : array of int, shape (n, nl)
        Number of histories.
    reached : array of bool, shape (n, nl)
        Whether the requested error was reached.
    polarised, polarised_error : array, shape (n, 2, nl)
        Q and U of all orders in the frame of ``stokes``, and their standard errors; 0 without
        polarisation. [sr⁻¹]
    """

    total: FloatArray
    total_error: FloatArray
    parts: FloatArray
    part_errors: FloatArray
    histories: NDArray[np.int64]
    reached: NDArray[np.bool_]
    polarised: FloatArray
    polarised_error: FloatArray


@dataclass(frozen=True)
class Query:
    """Quantities to be estimated.

    Attributes
    ----------
    starts : array, shape (n, 4)
        Radius [m], cosines of view zenith, star zenith and the angle between them [1].
    lengths : array, shape (n,)
        Lengths of the lines of sight; no histories where it is 0. [m]
    hemisphere : int
        1 or -1 to estimate the irradiance from the upper or lower hemisphere; 0 for a radiance.
    known : array, shape (n, 3, nl), or None
        I, Q and U of the first order, if it is not sampled.
    order : int or None
        Order whose standard error determines the number of histories; None: sum of all orders.
    occulted : sequence of OccultedStar, optional
        Moon in front of the star for each start, in its own frame (``vectors.start_vectors``), with
        all wavelengths.
    rings : sequence of RingShadow, optional
        Rings in front of the star for each start, in its own frame.
    clouds : CloudyStarts, optional
        Clouds, and the frame and area of each start.
    """

    starts: FloatArray
    lengths: FloatArray
    hemisphere: int
    known: FloatArray | None
    order: int | None
    occulted: Sequence[OccultedStar] | None = None
    rings: Sequence[RingShadow] | None = None
    clouds: CloudyStarts | None = None


def estimate(
    query: Query,
    airs: Sequence[HistoryOptics],
    wavelengths: FloatArray,
    settings: MonteCarloSettings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> Estimate:
    """Monte Carlo estimates, by rounds of histories until all tasks are done.

    Parameters
    ----------
    airs : sequence of HistoryOptics, length nl
        Optical properties at each wavelength.
    wavelengths : array, shape (nl,)
        Wavelengths, from which the streams of random numbers are derived. [nm]
    """
    n, count = query.starts.shape[0], len(airs)
    bins = settings.kept_orders + 1
    sums = np.zeros((n * count, 2, bins + 3))
    blocks = np.zeros(n * count, np.int64)
    most = max(1, settings.most_histories // BLOCK)
    all_known = np.zeros((n, 3, count)) if query.known is None else query.known
    known = all_known[:, 0]
    open_ = np.repeat(query.lengths > 0.0, count)
    planned = np.where(open_, min(_FIRST_ROUND, most), 0)
    done_before = 0
    while True:
        units = [
            (int(task), block)
            for task in np.flatnonzero(planned > blocks)
            for block in range(blocks[task], planned[task])
        ]
        if not units:
            break
        results = np.zeros((len(units), 2, bins + 3))

        def run(
            index: int, units: list[tuple[int, int]] = units, out: FloatArray = results
        ) -> None:
            task, block = units[index]
            line, at = divmod(task, count)
            nm = float(wavelengths[at])
            _run_block(query, line, at, airs[at], nm, block, settings, out[index])

        def shown(done: int, total: int, message: str, before: int = done_before) -> None:
            if progress is not None:
                progress(before + done, before + total, message)

        run_blocks(run, len(units), cancel=cancel, progress=shown, message="histories")
        done_before += len(units)
        for (task, _), result in zip(units, results, strict=True):
            sums[task] += result
        blocks = np.maximum(blocks, planned)
        planned = _more(query, sums, blocks, known, open_, settings, most)
    histories = blocks.reshape(n, count) * BLOCK
    means, errors = _statistics(sums, blocks * BLOCK)
    parts = np.moveaxis(means[:, :bins].reshape(n, count, bins), 1, 2)
    part_errors = np.moveaxis(errors[:, :bins].reshape(n, count, bins), 1, 2)
    if query.known is not None:
        parts[:, 0] = known
    stokes, stokes_errors = (
        np.moveaxis(rows[:, bins + 1 :].reshape(n, count, 2), 1, 2) for rows in (means, errors)
    )
    total = means[:, bins].reshape(n, count) + known
    total_error = errors[:, bins].reshape(n, count)
    judged, judged_error = _criterion(query, means, errors, known)
    reached = judged_error <= settings.relative_error * judged
    reached = (reached & (judged > 0.0)) | ~open_
    return Estimate(
        total=total,
        total_error=total_error,
        parts=np.ascontiguousarray(parts),
        part_errors=np.ascontiguousarray(part_errors),
        histories=histories,
        reached=reached.reshape(n, count),
        polarised=stokes + all_known[:, 1:],
        polarised_error=np.ascontiguousarray(stokes_errors),
    )


def _run_block(
    query: Query,
    line: int,
    at: int,
    air: HistoryOptics,
    nm: float,
    block: int,
    settings: MonteCarloSettings,
    out: FloatArray,
) -> None:
    """Run one block of histories of one task."""
    start = query.starts[line]
    r, mu, mu_s, nu = (float(one) for one in start)
    # The stream depends on the line of sight itself, not on its index.
    numbers = [r, mu, mu_s, nu, nm]
    clouds, area = None, np.zeros((2, 3))
    if query.clouds is not None:
        clouds, area = query.clouds.cells_at(line, at), query.clouds.areas[line]
        numbers += [*query.clouds.frames[line].flat, *area.flat]
    count = len(numbers)
    names = struct.unpack(f"<{count}Q", struct.pack(f"<{count}d", *(one + 0.0 for one in numbers)))
    state = stream(settings.seed, *names, int(query.hemisphere), block)
    along = air.extinction
    paths = (
        new_trace(along),
        new_trace(along),
        new_trace(along),
        new_sampling_density(along),
        new_sampling_density(along),
    )
    workspace = (
        np.zeros(air.scattering.size),
        np.zeros(settings.kept_orders + 1),
        np.zeros(2),
        np.zeros((3, 4)),
    )
    first_order = 1 if query.known is None else 2
    end_r = np.sqrt(max(r * r + query.lengths[line] * (query.lengths[line] + 2 * r * mu), 1))
    end_mu_s = (r * mu_s + query.lengths[line] * nu) / end_r
    lowest = mu_s if query.hemisphere else min(mu_s, end_mu_s)
    sun_sampling_fraction = _SUN_SAMPLING_FRACTION if lowest < _LOW_STAR else 0.0
    occulted = OccultedStar.whole()
    if query.occulted is not None:
        occulted = query.occulted[line].lane(at)
    rings = None if query.rings is None else query.rings[line]
    start = HistoryStart(
        r, mu, mu_s, nu, int(query.hemisphere), first_order, sun_sampling_fraction, area
    )
    trace_paths(BLOCK, start, air, clouds, occulted, rings, state, paths, workspace, out)


def _statistics(sums: FloatArray, histories: NDArray[np.int64]) -> tuple[FloatArray, FloatArray]:
    """Means and their standard errors, shape (tasks, k + 2)."""
    number = np.maximum(histories, 1)[:, None]
    mean = sums[:, 0] / number
    scatter = np.maximum(sums[:, 1] / number - mean * mean, 0.0)
    return mean, np.sqrt(scatter / np.maximum(number - 1, 1))


def _criterion(
    query: Query, means: FloatArray, errors: FloatArray, known: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Value and error of each task for the stopping rule, shape (tasks,)."""
    if query.order is None:
        return means[:, -3] + known.ravel(), errors[:, -3]
    if query.order == 1 and query.known is not None:
        return known.ravel(), np.zeros(known.size)
    return means[:, query.order - 1], errors[:, query.order - 1]


def _more(
    query: Query,
    sums: FloatArray,
    blocks: NDArray[np.int64],
    known: FloatArray,
    open_: NDArray[np.bool_],
    settings: MonteCarloSettings,
    most: int,
) -> NDArray[np.int64]:
    """Number of blocks of each task after the next round, shape (tasks,)."""
    means, errors = _statistics(sums, blocks * BLOCK)
    value, error = _criterion(query, means, errors, known)
    allowed = settings.relative_error * value
    ratio = np.divide(error, allowed, out=np.full(value.size, 2.0), where=allowed > 0.0)
    # A tenth more than estimated from the variance, so that the next round is usually the last.
    need = np.where(ratio > 1.0, np.ceil(1.1 * blocks * np.square(np.minimum(ratio, 1e3))), blocks)
    dark = (value <= 0.0) & (blocks >= _DARK)
    planned = np.minimum(np.minimum(need, 4 * blocks), most).astype(np.int64)
    return np.where(open_ & ~dark, np.maximum(planned, blocks), blocks)
