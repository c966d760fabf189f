"""Sum over lights of linear radiance on the GPU."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.picture.display_passes import LINEAR
from airlight.render.gpu.picture.display_shaders import added_shader
from airlight.render.gpu.picture.uniforms import FRAME


class LightSum:
    """Accumulation of the frames of several lights.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self._pictures: list[Any] = []
        self._size = (0, 0)
        self._passes: dict[str, FragmentPass] = {}

    def render(
        self,
        parts: Sequence[Callable[[Any, str], None]],
        view: Any,
        size: tuple[int, int],
        target_format: str,
    ) -> None:
        """Render the sum over lights into the target.

        Parameters
        ----------
        parts : sequence of callable
            ``part(view, format)`` renders the frame of one light.
        size : (int, int)
            Width and height of the target. [pixel]
        """
        if len(parts) == 1:
            parts[0](view, target_format)
            return
        # the last sum is written to the target: two lights need no third texture
        one, other, *spare = self._sized(size, min(len(parts), 3))
        parts[0](one.create_view(), LINEAR)
        for number, part in enumerate(parts[1:], start=2):
            part(other.create_view(), LINEAR)
            last = number == len(parts)
            form = target_format if last else LINEAR
            adding = self._pass(form)
            encoder = self._device.device.create_command_encoder()
            groups = adding.bind({"frame": self._frame, "picture": one, "level": other})
            adding.run(encoder, groups, [view if last else spare[0].create_view()])
            self._device.device.queue.submit([encoder.finish()])
            if not last:
                one, spare = spare[0], [one]

    @cached_property
    def _frame(self) -> Any:
        """Uniform buffer; the shader reads no uniform."""
        import wgpu

        size = FRAME.packed({}, {}).nbytes
        return self._device.device.create_buffer(size=size, usage=wgpu.BufferUsage.UNIFORM)

    def _sized(self, size: tuple[int, int], count: int) -> list[Any]:
        """At least ``count`` textures of a size."""
        import wgpu

        if size != self._size or count > len(self._pictures):
            for texture in self._pictures:
                texture.destroy()
            use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.TEXTURE_BINDING
            self._pictures = [
                self._device.device.create_texture(
                    label=f"light {k}", size=(*size, 1), format=LINEAR, usage=use
                )
                for k in range(count)
            ]
            self._size = size
        return self._pictures

    def _pass(self, target_format: str) -> FragmentPass:
        if target_format not in self._passes:
            shader = added_shader()
            entry = next(iter(shader.entries))
            self._passes[target_format] = FragmentPass(
                self._device, shader.text, entry, (target_format,), entry
            )
        return self._passes[target_format]
