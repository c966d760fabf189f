"""Iteration on the GPU: fragment passes and their textures, pooled between solves."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.errors import Cancelled
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import (
    empty_flat_texture,
    flat_rows,
    read_flat,
    update_flat,
)
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.device.pass_times import PassTimes
from airlight.render.gpu.emit.shader_types import FLAT_WIDTH
from airlight.render.gpu.solver.passes import ITERATES, MIX, ONCE, PACK, SWEEP, SolverPass, shader
from airlight.render.gpu.solver.plan import SolverPlan
from airlight.render.pixels.render_tables import WAVELENGTHS
from airlight.solver.moments.fixed_point import Backend

FloatArray = NDArray[np.float64]
Float32Array = NDArray[np.float32]

_FORMAT: Final = "rgba32float"
#: Number of radius ranges whose uniforms and bind groups are cached.
_CACHED_RANGES: Final = 64

_lock = threading.Lock()
_passes: dict[tuple[Device, str], FragmentPass] = {}
_pool: dict[Device, list[GpuIteration]] = {}


@contextmanager
def pooled_iteration(device: Device) -> Iterator[GpuIteration]:
    """Context with exclusive use of a ``GpuIteration`` from a pool, which reuses its textures.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    """
    with _lock:
        pool = _pool.setdefault(device, [])
        iteration = pool.pop() if pool else GpuIteration(device)
    sound = False
    try:
        yield iteration
        sound = True
    except Cancelled:
        sound = True
        raise
    finally:  # a failed solve may have left iterates that are not finite
        with _lock:
            if sound and not pool:
                pool.append(iteration)


class GpuIteration(Backend):
    """Successive orders of scattering by fragment passes; reusable for any plan.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.

    Attributes
    ----------
    plan : SolverPlan
        Plan of the current solve, from ``load`` on.
    """

    plan: SolverPlan

    def __init__(self, device: Device) -> None:
        self.device = device
        self._textures: dict[str, Any] = {}
        self._views: dict[str, Any] = {}
        self._iterates: deque[str] = deque(ITERATES)
        self._brightest = np.zeros((2, WAVELENGTHS), np.float32)
        self._mix = self._uniform(np.zeros((len(ITERATES) + 2, 4), np.float32))
        self._solve: Any = None
        self._spans: dict[tuple[int, int, int], Any] = {}
        self._groups: dict[tuple[str, tuple[int, int, int], str], list[Any]] = {}

    def load(self, plan: SolverPlan) -> None:
        """Upload the tables of a plan; textures are reused if they are large enough.

        Parameters
        ----------
        plan : SolverPlan
            Plan from ``plan_for``.
        """
        self.plan = plan
        for name, values in plan.tables.items():
            self._make(name, *values.shape)
            update_flat(self.device, self._textures[name], 0, values)
        for name, texels in plan.textures.items():
            self._make(name, texels, 4)
        if self._solve is None:
            self._solve = self._uniform(plan.solve)
        else:
            self.device.device.queue.write_buffer(self._solve, 0, plan.solve)
        if len(self._spans) > _CACHED_RANGES:
            self._spans.clear()
            self._groups.clear()

    def _make(self, name: str, texels: int, channels: int) -> None:
        at_hand = self._textures.get(name)
        if at_hand is None or at_hand.size[1] < flat_rows(texels):
            self._textures[name] = empty_flat_texture(self.device, texels, channels, name)
            self._views[name] = self._textures[name].create_view()
            self._groups.clear()

    def _uniform(self, values: Float32Array) -> Any:
        import wgpu

        use = wgpu.BufferUsage.UNIFORM | wgpu.BufferUsage.COPY_DST
        return self.device.device.create_buffer_with_data(data=values, usage=use)

    def run(self, passes: tuple[SolverPass, ...], *, times: PassTimes | None = None) -> None:
        """Run passes; spanned passes run once per radius range.

        Parameters
        ----------
        passes : tuple of SolverPass
            Passes in the order in which they run.
        times : PassTimes, optional
            Timer of the passes.
        """
        encoder = self.device.device.create_command_encoder()
        for one, texels in self.plan.runs(passes):
            ready = self._pass(one)
            targets = [self._iterates[0] if name == "iterate" else name for name in one.targets]
            top, bottom = texels[0] // FLAT_WIDTH, flat_rows(texels[1])
            ready.run(
                encoder,
                self._bound(ready, one, texels),
                [self._views[target] for target in targets],
                (0, top, FLAT_WIDTH, bottom - top),
                keep=True,
                timestamps=None if times is None else times(one.name),
            )
        if times is not None:
            times.resolve(encoder)
        self.device.device.queue.submit([encoder.finish()])

    def _pass(self, one: SolverPass) -> FragmentPass:
        """Compiled pass, from a cache."""
        key = (self.device, one.name)
        if key not in _passes:
            formats = (_FORMAT,) * len(one.targets)
            _passes[key] = FragmentPass(self.device, shader(one.name), "fill", formats, one.name)
        return _passes[key]

    def _bound(
        self, ready: FragmentPass, one: SolverPass, texels: tuple[int, int, int]
    ) -> list[Any]:
        key = (one.name, texels, self._iterates[0])
        if key not in self._groups:
            if texels not in self._spans:
                self._spans[texels] = self._uniform(np.array([*texels, 0], np.float32))
            iterates = {
                name: self._views[at] for name, at in zip(ITERATES, self._iterates, strict=True)
            }
            resources = {
                **self._views,
                **iterates,
                "iterate": self._views[self._iterates[0]],
                "solve": self._solve,
                "span": self._spans[texels],
                "mix": self._mix,
            }
            self._groups[key] = ready.bind(resources)
        return self._groups[key]

    def begin(self) -> None:
        """Compute the first order of scattering, which is also the initial guess."""
        self.run(ONCE)
        self._copy("first", self._textures["light"], self.plan.textures["light"])

    def _copy(self, name: str, target: Any, texels: int) -> None:
        encoder = self.device.device.create_command_encoder()
        encoder.copy_texture_to_texture(
            {"texture": self._textures[name]},
            {"texture": target},
            (FLAT_WIDTH, flat_rows(texels), 1),
        )
        self.device.device.queue.submit([encoder.finish()])

    def sweep(self) -> None:
        """Compute the next iterate by one sweep of the current guess."""
        self._iterates.rotate(1)
        self.run((*PACK, *SWEEP))

    def reduce(self) -> tuple[Float32Array, Float32Array]:
        """Mean radiances (r, s, 4) of the guess and of its iterate."""
        n = self.plan.sizes
        means = read_flat(self.device, self._textures["means"], 4 * self.plan.nodes)
        means = means.reshape(4, n["radii"], n["sun_angles"], WAVELENGTHS)
        self._brightest = means[:2].max(axis=(1, 2))
        return means[2], means[0]

    def combine(self, weights: FloatArray, *, best: bool) -> None:
        """Compute the next guess: the uniform ``mix`` has the weights, the latest first.

        After them it has the largest mean radiance and irradiance.
        """
        mix = np.zeros((len(ITERATES) + 2, WAVELENGTHS), np.float32)
        mix[: weights.shape[0]] = weights[::-1]
        mix[-2:] = self._brightest
        self.device.device.queue.write_buffer(self._mix, 0, mix)
        self.run(MIX)

    def texture(self, name: str) -> Any:
        """Texture by its name in the plan; ``iterate`` is that of the last sweep.

        Parameters
        ----------
        name : str
            Name from ``plan.textures``, or ``iterate``.
        """
        return self._textures[self._iterates[0] if name == "iterate" else name]

    def light(self) -> tuple[Float32Array, Float32Array]:
        """Moments (r, s, k, 4) and irradiances (r, s, 4) of the guess, which is also packed."""
        self.run(PACK)
        n = self.plan.sizes
        moments = self.plan.nodes * n["terms"]
        flat = read_flat(self.device, self._textures["light"], moments + self.plan.nodes)
        shape = (n["radii"], n["sun_angles"])
        return (
            flat[:moments].reshape(*shape, n["terms"], WAVELENGTHS),
            flat[moments:].reshape(*shape, WAVELENGTHS),
        )

    def packed_copy(self) -> Any:
        """Copy the packed light to a separate texture, after ``light``."""
        texels = self.plan.textures["packed"]
        copy = empty_flat_texture(self.device, texels, 4, "fields")
        self._copy("packed", copy, texels)
        return copy
