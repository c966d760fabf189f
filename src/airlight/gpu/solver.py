"""The moments solver on the GPU: successive orders as passes of fragments.

The passes (``solver_passes``) compute what the CPU's sweeps compute, by the same functions; the
host runs them, reads the mean radiance at the nodes after each order (some 20 kB), and combines
the last few images as the CPU does (``acceleration``). What the CPU does for thick air,
the inverse of a sweep along the vertical, is left out: in clear and in dusty air each order
changes the light by much less than the one before, and six to twelve sweeps arrive.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Mapping
from math import log
from time import perf_counter
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled, ConvergenceError
from airlight.gpu.device import Device
from airlight.gpu.flat import FLAT_WIDTH, empty_flat_texture, flat_rows, flat_texture, read_flat
from airlight.gpu.fragment_pass import FragmentPass
from airlight.gpu.shown import WAVELENGTHS
from airlight.gpu.solver_passes import IMAGES, MIX, ONCE, PACK, SWEEP, SolverPass, shader
from airlight.gpu.solver_plan import SolverPlan, plan_for
from airlight.kernel.threads import Cancel, Progress
from airlight.planets.medium import Medium
from airlight.solvers.light_paths import LightPaths
from airlight.solvers.moments.acceleration import mixing_weights
from airlight.solvers.moments.convergence import counts, relative_change, what_follows
from airlight.solvers.moments.iterate import Moments
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.solution import MomentsSolution

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

#: The GPU gives up after so many sweeps: then the air is one for the CPU.
MOST_SWEEPS: Final = 60

_FORMAT: Final = "rgba32float"
_passes: dict[tuple[int, str], FragmentPass] = {}


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
    sweeper = GpuSweeper(device, plan)
    sweeps, residual = _iterate(sweeper, settings, progress, cancel)
    count = medium.wavelengths.size
    field, sky = sweeper.light()
    moments = Moments(
        degree=plan.degree,
        grid=plan.grid,
        parts=1,
        field=np.ascontiguousarray(field[..., :count]),
        sky=np.ascontiguousarray(sky[..., :count]),
        columns=plan.table.values,
        sweeps=sweeps,
        residual=residual[:count],
    )
    return MomentsSolution(medium, settings, moments, perf_counter() - started, paths)


class GpuSweeper:
    """The passes of one solve with their textures.

    Parameters
    ----------
    device : Device
    plan : SolverPlan
    """

    def __init__(self, device: Device, plan: SolverPlan) -> None:
        self.device, self.plan = device, plan
        self.textures: dict[str, Any] = {
            "scalars": flat_texture(device, plan.scalars, "scalars"),
            "spectra": flat_texture(device, plan.spectra, "spectra"),
        }
        for name, texels in plan.textures.items():
            self.textures[name] = empty_flat_texture(device, texels, 4, name)
        self.ring: deque[Any] = deque(self.textures[name] for name in IMAGES)
        self.solve = self._uniform(plan.solve)
        self.mix = self._uniform(np.zeros((len(IMAGES) + 2, 4), np.float32))
        self._spans: dict[tuple[int, int, int], Any] = {}

    def _uniform(self, values: Float32Array) -> Any:
        import wgpu

        use = wgpu.BufferUsage.UNIFORM | wgpu.BufferUsage.COPY_DST
        return self.device.device.create_buffer_with_data(data=values, usage=use)

    def _span(self, texels: tuple[int, int, int]) -> Any:
        if texels not in self._spans:
            self._spans[texels] = self._uniform(np.array([*texels, 0], np.float32))
        return self._spans[texels]

    def run(
        self,
        passes: tuple[SolverPass, ...],
        *,
        after: Callable[[str], None] | None = None,
    ) -> None:
        """Run passes, span by span where they are spanned.

        Parameters
        ----------
        passes : tuple of SolverPass
        after : callable, optional
            Called with each pass's name once it is done, to measure; without it all are submitted
            together.
        """
        encoder = self.device.device.create_command_encoder()
        for one, texels in self.plan.runs(passes):
            ready = _compiled(self.device, one)
            target = self.ring[0] if one.target == "image" else self.textures[one.target]
            top, bottom = texels[0] // FLAT_WIDTH, flat_rows(texels[1])
            ready.run(
                encoder,
                ready.bind(self._resources(texels)),
                [target],
                (0, top, FLAT_WIDTH, bottom - top),
                keep=True,
            )
            if after is not None:
                self.device.device.queue.submit([encoder.finish()])
                read_flat(self.device, self.textures["means"], 1)
                after(one.name)
                encoder = self.device.device.create_command_encoder()
        self.device.device.queue.submit([encoder.finish()])

    def _resources(self, texels: tuple[int, int, int]) -> Mapping[str, Any]:
        images = dict(zip(IMAGES, self.ring, strict=True))
        return {
            **self.textures,
            **images,
            "image": self.ring[0],
            "solve": self.solve,
            "span": self._span(texels),
            "mix": self.mix,
        }

    def begin(self) -> None:
        """All that is computed once, and the first order as the first guess."""
        self.run(ONCE)
        first, light = self.textures["first"], self.textures["light"]
        encoder = self.device.device.create_command_encoder()
        encoder.copy_texture_to_texture({"texture": first}, {"texture": light}, first.size)
        self.device.device.queue.submit([encoder.finish()])

    def sweep(self) -> tuple[Float32Array, Float32Array, Float32Array]:
        """One more order, into a new image.

        Returns
        -------
        mean, sky, before : array, shape (r, s, 4)
            Mean radiance and irradiance of the image, and mean radiance of the guess.
        """
        self.ring.rotate(1)
        self.run((*PACK, *SWEEP))
        n = self.plan.sizes
        means = read_flat(self.device, self.textures["means"], 4 * self.plan.nodes)
        means = means.reshape(4, n["radii"], n["suns"], WAVELENGTHS)
        return means[0], means[1], means[2]

    def combine(self, weights: Float32Array) -> None:
        """The next guess from the last images.

        Parameters
        ----------
        weights : array, shape (7, 4)
            Of the images, the last first; then the largest mean radiance and irradiance.
        """
        self.device.device.queue.write_buffer(self.mix, 0, np.ascontiguousarray(weights))
        self.run(MIX)

    def light(self) -> tuple[Float32Array, Float32Array]:
        """Moments (r, s, k, 4) and irradiances (r, s, 4) of the guess, packed on the device too."""
        self.run(PACK)
        n = self.plan.sizes
        moments = self.plan.nodes * n["terms"]
        flat = read_flat(self.device, self.textures["light"], moments + self.plan.nodes)
        shape = (n["radii"], n["suns"])
        return (
            flat[:moments].reshape(*shape, n["terms"], WAVELENGTHS),
            flat[moments:].reshape(*shape, WAVELENGTHS),
        )


def _compiled(device: Device, one: SolverPass) -> FragmentPass:
    """The pass on a device, compiled at its first use."""
    key = (id(device), one.name)
    if key not in _passes:
        _passes[key] = FragmentPass(device, shader(one.name), "fill", (_FORMAT,), one.name)
    return _passes[key]


def _iterate(
    sweeper: GpuSweeper, settings: Settings, progress: Progress | None, cancel: Cancel | None
) -> tuple[int, FloatArray]:
    """Sweeps until nothing changes: how many, and what is still to come."""
    tolerance = settings.tolerance
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
        change = relative_change(before, mean) * counts(mean, sweeper.plan.thick)
        residuals.append(change.reshape(-1, WAVELENGTHS))
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
