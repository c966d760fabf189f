"""Fragment passes of rendering, with their pipelines and bindings."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.picture.shaders import Shader
from airlight.render.gpu.picture.uniforms import FRAME


class FramePasses:
    """Cached pipelines and bind groups of the rendering passes.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    like : FramePasses, optional
        Passes of the same device, whose pipelines are used too.
    """

    def __init__(self, device: Device, like: FramePasses | None = None) -> None:
        self._device = device
        self._passes: dict[tuple[Shader, tuple[str, ...]], FragmentPass] = (
            {} if like is None else like._passes
        )
        self._groups: dict[tuple[FragmentPass, Hashable], list[Any]] = {}
        self._textures: dict[Hashable, Mapping[str, Any]] = {}
        self._places: dict[Hashable, Mapping[str, tuple[int, ...]]] = {}

    def read(
        self,
        textures: Mapping[str, Any],
        places: Mapping[str, tuple[int, ...]],
        light: Hashable = 0,
    ) -> None:
        """Set the input textures of a light, and the positions of tables in them."""
        self._textures[light], self._places[light] = textures, places
        self._groups = {key: one for key, one in self._groups.items() if key[1] != light}

    @cached_property
    def _uniforms(self) -> Any:
        import wgpu

        use = wgpu.BufferUsage.UNIFORM | wgpu.BufferUsage.COPY_DST
        return self._device.device.create_buffer(size=FRAME.packed({}, {}).nbytes, usage=use)

    def packed(self, uniforms: Mapping[str, float], light: Hashable = 0) -> NDArray[np.float32]:
        """Contents of the uniform buffer, for the tables of a light."""
        # Relative to the ground radius in single precision, which is accurate to half a metre.
        r = float(np.float32(uniforms["bottom"])) + (uniforms["r"] - uniforms["bottom"])
        return FRAME.packed({**uniforms, "r": r}, dict(self._places.get(light, {})))

    def run(
        self,
        shader: Shader,
        uniforms: Mapping[str, float],
        views: Sequence[Any],
        formats: tuple[str, ...],
        area: tuple[int, int, int, int] | None = None,
        keep: bool = False,
        light: Hashable = 0,
    ) -> None:
        """Run a shader on an area of its targets.

        Parameters
        ----------
        shader : Shader
            Shader of the pass, with one entry point.
        views : sequence of wgpu.GPUTextureView
            Views of the targets, of the ``formats``.
        area : (int, int, int, int), optional
            First column, first row, number of columns and of rows; by default the whole target.
        keep : bool
            Whether the other texels are preserved; otherwise they are cleared.
        light : hashable
            Light whose textures are bound.
        """
        device = self._device.device
        one = self._pass(shader, formats)
        device.queue.write_buffer(self._uniforms, 0, self.packed(uniforms, light))
        encoder = device.create_command_encoder()
        one.run(encoder, self._bound(one, light), list(views), area, keep)
        device.queue.submit([encoder.finish()])

    def _pass(self, shader: Shader, targets: tuple[str, ...]) -> FragmentPass:
        key = shader, targets
        if key not in self._passes:
            entry = next(iter(shader.entries))
            self._passes[key] = FragmentPass(self._device, shader.text, entry, targets, entry)
        return self._passes[key]

    def _bound(self, one: FragmentPass, light: Hashable) -> list[Any]:
        key = one, light
        if key not in self._groups:
            self._groups[key] = one.bind({"frame": self._uniforms, **self._textures[light]})
        return self._groups[key]
