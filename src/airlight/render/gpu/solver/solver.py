"""Moments solver on the GPU: successive orders of scattering as fragment passes.

After each sweep the host reads the mean radiances (about 20 kB), computes the Anderson weights and
tests convergence as on the CPU (``stopping``). Without synthetic acceleration optically thin and
dusty atmospheres converge in five to fifteen sweeps; optically thick ones are left to the CPU.
"""

from __future__ import annotations

from time import perf_counter
from typing import TYPE_CHECKING, Any, Final
from weakref import WeakKeyDictionary

import numpy as np

from airlight.errors import AirlightError
from airlight.kernel.threads import Cancel, Progress
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.solver.gpu_iteration import pooled_iteration
from airlight.render.gpu.solver.planning import plan_for
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.solver.moments.delta_m import Optics
from airlight.solver.moments.energy_balance import energy_error, violates_energy_balance
from airlight.solver.moments.fixed_point import iterate
from airlight.solver.moments.iterate import Moments
from airlight.solver.moments.settings import MomentsSettings
from airlight.solver.moments.solution import MomentsSolution
from airlight.solver.moments.stopping import Iteration, Stopping
from airlight.solver.refracted_geometry import RefractedGeometry

if TYPE_CHECKING:
    from airlight.planets.medium import Medium

#: Largest vertical transport optical depth, (1 - g) times scattering. [1]
THICKEST: Final = 2.5
#: Packed field of each solution, on the GPU that solved it.
_fields: WeakKeyDictionary[MomentsSolution, tuple[Device, Any]] = WeakKeyDictionary()


class ThickAir(AirlightError):
    """Medium too optically thick for plain successive orders, left to the CPU."""

    def __init__(self, reason: str = "too thick for the GPU's orders of scattering") -> None:
        super().__init__(f"the atmosphere is {reason}; the CPU solves it")


def solve_on(
    device: Device,
    medium: Medium,
    settings: MomentsSettings,
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
        Medium of at most four wavelengths.
    settings : MomentsSettings
        Grid sizes and tolerance.

    Returns
    -------
    MomentsSolution
        Solution, equal to that of the CPU within 0.5 %.

    Raises
    ------
    ConvergenceError
        If the tolerance is not reached within the orders that ``Stopping`` allows.
    """
    started = perf_counter()
    geometry = RefractedGeometry.of(medium)
    if Optics.chosen(geometry.medium, settings).transport_depth.max() > THICKEST:
        raise ThickAir
    plan = plan_for(geometry, settings)
    count = medium.wavelengths.size

    def report(state: Iteration) -> None:
        if progress is not None:
            error = float(state.remaining_error.max())
            message = f"orders of scattering: remaining error {error:.1e}"
            progress(round(100 * state.progress), 100, message)

    with pooled_iteration(device) as gpu:
        gpu.load(plan)
        gpu.begin()
        iteration = Iteration(Stopping.of_passes(settings), plan.thick, WAVELENGTHS)
        iterate(gpu, iteration, report=report, cancel=cancel)
        field, sky = gpu.light()
        fields = gpu.packed_copy()
    moments = Moments(
        degree=plan.setup.degree,
        grid=plan.setup.grid,
        refinement=plan.setup.refinement,
        field=np.ascontiguousarray(field[..., :count]),
        sky=np.ascontiguousarray(sky[..., :count]),
        columns=plan.setup.table.values,
        sweeps=iteration.sweeps,
        residual=iteration.remaining_error[:count],
        energy=energy_error(plan.setup, field[..., :count]),
    )
    if violates_energy_balance(moments.energy, settings.energy_tolerance):
        raise ThickAir("not resolved by the GPU's grid")
    solution = MomentsSolution(medium, settings, moments, perf_counter() - started, geometry)
    _fields[solution] = device, fields
    return solution


def fields_on(device: Device, solution: MomentsSolution) -> Any | None:
    """Field of a solution in the memory of a device, from ``solve_on``; None if absent.

    Returns
    -------
    wgpu.GPUTexture or None
        Flat texture: ``Light.field`` followed by ``Light.sky``, four wavelengths a texel.
    """
    found = _fields.get(solution)
    return found[1] if found is not None and found[0] is device else None
