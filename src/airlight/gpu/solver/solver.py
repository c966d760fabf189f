"""The moments solver on the GPU: successive orders as passes of fragments.

The passes (``solver_passes``) compute what the CPU's sweeps compute, by the same functions; the
host runs them, reads the mean radiance at the nodes after each order (some 20 kB), and combines
the last few images as the CPU does (``acceleration``). What the CPU does for thick air,
the inverse of a sweep along the vertical, is left out: in clear and in dusty air each order
changes the light by much less than the one before, and five to fifteen sweeps arrive. Air in which
light wanders for longer is left to the CPU.
"""

from __future__ import annotations

from collections import deque
from math import log
from time import perf_counter
from typing import Any, Final
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ConvergenceError
from airlight.gpu.device.device import Device
from airlight.gpu.solver.passes import IMAGES
from airlight.gpu.solver.planning import plan_for
from airlight.gpu.solver.sweeper import GpuSweeper, borrowed_sweeper
from airlight.kernel.threads import Cancel, Progress
from airlight.pixels.shown import WAVELENGTHS
from airlight.planets.medium import Medium
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments.acceleration import mixing_weights
from airlight.solvers.moments.convergence import counts, relative_change, what_follows
from airlight.solvers.moments.iterate import Moments
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: By so much the tolerance is smaller in thick air.
STRICTER: Final = 0.9
#: Part of the thickness by which a change in the night counts less.
NIGHT: Final = 0.25
#: The GPU gives up after so many sweeps: then the air is one for the CPU.
MOST_SWEEPS: Final = 60

#: A packed field of each solution, on the device that it was solved on.
_fields: WeakKeyDictionary[MomentsSolution, tuple[Device, Any]] = WeakKeyDictionary()


def solve_on(
    device: Device,
    medium: Medium,
    settings: Settings,
    *,
    progress: Progress | None = None,
    cancel: Cancel | None = None,
) -> MomentsSolution:
    """Solve a medium on the GPU.

    Parameters
    ----------
    device : Device
        From ``open_device``.
    medium : Medium
        Of at most four wavelengths.
    settings : Settings
        How finely.
    progress, cancel : callable, optional
        See ``airlight.kernel.threads``.

    Returns
    -------
    MomentsSolution
        As the CPU's solver gives, within 0.5 %.

    Raises
    ------
    ParameterError
        If there are more wavelengths or constituents than the shaders have room for.
    ThickAir
        If light wanders in the air for many orders: the CPU solves it.
    ConvergenceError
        If the tolerance is not reached within 60 sweeps.
    Cancelled
        If ``cancel`` said so.
    """
    started = perf_counter()
    paths = LightPaths.of(medium)
    plan = plan_for(paths, settings)
    count = medium.wavelengths.size
    with borrowed_sweeper(device) as sweeper:
        sweeper.load(plan)
        sweeps, residual = _iterate(sweeper, settings, progress, cancel)
        field, sky = sweeper.light()
        fields = sweeper.packed_copy()
    moments = Moments(
        degree=plan.degree,
        grid=plan.grid,
        parts=plan.sizes["parts"],
        field=np.ascontiguousarray(field[..., :count]),
        sky=np.ascontiguousarray(sky[..., :count]),
        columns=plan.table.values,
        sweeps=sweeps,
        residual=residual[:count],
    )
    solution = MomentsSolution(medium, settings, moments, perf_counter() - started, paths)
    _fields[solution] = device, fields
    return solution


def fields_on(device: Device, solution: MomentsSolution) -> Any | None:
    """The field of a solution as ``solve_on`` left it on its device, or None.

    Parameters
    ----------
    device : Device
        On which it is wanted.
    solution : MomentsSolution

    Returns
    -------
    wgpu.GPUTexture or None
        Flat: ``Light.field`` and after it ``Light.sky``, four wavelengths a texel.
    """
    found = _fields.get(solution)
    return found[1] if found is not None and found[0] is device else None


def _iterate(
    sweeper: GpuSweeper, settings: Settings, progress: Progress | None, cancel: Cancel | None
) -> tuple[int, FloatArray]:
    """Sweeps until nothing changes: how many, and what is still to come."""
    # Where many orders follow, what one more changes says less of what is still to come.
    tolerance = settings.tolerance * (1.0 - STRICTER * float(sweeper.plan.thick.max()))
    sweeper.begin()
    residuals: deque[FloatArray] = deque(maxlen=len(IMAGES))
    largest = np.full(WAVELENGTHS, np.inf)
    most = min(settings.max_sweeps, MOST_SWEEPS)
    for sweep in range(1, most + 1):
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        mean, sky, before = sweeper.sweep()
        if not (mean > 0.0).any():
            return 0, np.zeros(WAVELENGTHS)
        change = relative_change(before, mean)
        thick = sweeper.plan.thick
        residuals.append((change * counts(mean, thick)).reshape(-1, WAVELENGTHS))
        # Nothing but more orders brings light into the night: there it counts for more.
        change *= counts(mean, NIGHT * thick)
        largest = np.abs(change).max(axis=(0, 1)) * what_follows(residuals)
        sweeper.combine(_weights(residuals, mean, sky))
        if progress is not None:
            still = float(largest.max())
            share = log(min(still, 1.0)) / log(tolerance) if still > tolerance else 1.0
            progress(round(100 * share), 100, f"orders of scattering: still to come {still:.1e}")
        if largest.max() <= tolerance and sweep > 1:
            return sweep, largest
    raise ConvergenceError(
        f"after {most} sweeps the last still changed the light by {largest.max():.1e}, "
        f"more than the tolerance {tolerance:g}"
    )


def _weights(residuals: deque[FloatArray], mean: Float32Array, sky: Float32Array) -> Float32Array:
    """What ``combine`` takes."""
    weights = np.zeros((len(IMAGES) + 2, WAVELENGTHS), np.float32)
    for lane in range(WAVELENGTHS):
        mixed = mixing_weights(np.stack([one[:, lane] for one in residuals]))
        weights[: mixed.size, lane] = mixed[::-1]
    weights[-2] = mean.max(axis=(0, 1))
    weights[-1] = sky.max(axis=(0, 1))
    return weights
