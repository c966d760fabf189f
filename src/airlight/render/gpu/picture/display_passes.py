"""Display passes of a frame: glare, exposure, tone map and encoding."""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from typing import Any, Final

from airlight.image.displayed import Display
from airlight.image.glare import glare_levels, glare_share
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.uniform_struct import Fixed
from airlight.render.gpu.picture.display_shaders import (
    coarser_shader,
    display_shader,
    spread_shader,
)
from airlight.render.gpu.picture.shaders import Shader
from airlight.render.gpu.picture.uniforms import FRAME

#: Format of linear radiance; half precision overflows at the radiance of the sun's disc.
LINEAR: Final = "rgba32float"


class DisplayPasses:
    """Display of a cached frame of linear radiance, with its glare.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.

    Attributes
    ----------
    rendered : hashable
        Key of the cached radiance; None before it is rendered.
    """

    def __init__(self, device: Device) -> None:
        self.device = device
        self.rendered: Hashable = None
        self._size = (0, 0)
        self._spread: Hashable = None
        self._picture: Any = None
        self._levels: list[Any] = []  # pyramid in texels of 2, 4, 8 … pixels
        self._spreads: list[Any] = []  # spread light of each level and all coarser ones
        self._uniforms: dict[int, Any] = {}
        self._passes: dict[tuple[Shader, str], FragmentPass] = {}
        self._groups: dict[tuple[FragmentPass, int], list[Any]] = {}

    def picture(self, width: int, height: int) -> Any:
        """View of the texture of linear radiance, as a render target.

        Parameters
        ----------
        width, height : int
            Size; a change clears the texture. [pixel]
        """
        if (width, height) != self._size:
            for one in (self._picture, *self._levels, *self._spreads):
                if one is not None:
                    one.destroy()
            self._picture = self._texture(width, height, "picture")
            self._levels, self._spreads = [], []
            self._size, self.rendered, self._spread = (width, height), None, None
            self._groups.clear()
        return self._picture.create_view()

    def display(
        self, uniforms: Mapping[str, float], pixel_angle: float, view: Any, target_format: str
    ) -> None:
        """Display the cached radiance.

        Parameters
        ----------
        pixel_angle : float
            Pixel angle for glare; 0 disables it. [rad]
        view : wgpu.GPUTextureView
            View of the target, of the same size.
        """
        shorter = float(min(self._size))
        count = glare_levels(pixel_angle, shorter) if uniforms.get("glare", 0.0) > 0.0 else 0
        shares = [glare_share(level, pixel_angle, shorter) for level in range(1, count + 1)]
        encoder = self.device.device.create_command_encoder()
        wanted = self.rendered, pixel_angle
        if shares and (self._spread != wanted or self.rendered is None):
            self._spread_light(encoder, shares)
            self._spread = wanted
        fixed: Fixed = ()
        if self.device.software:  # evaluates every tone map for each pixel otherwise
            fixed = tuple(one for one in FRAME.fixed(uniforms) if one[0] in Display._fields)
        one = self._pass(display_shader(fixed), target_format)
        self._write(0, {**uniforms, "glare_total": float(sum(shares))})
        coarser = self._spreads[0] if self._spreads else self._picture
        one.run(encoder, self._bound(one, 0, picture=self._picture, coarser=coarser), [view])
        self.device.device.queue.submit([encoder.finish()])

    def _spread_light(self, encoder: Any, shares: list[float]) -> None:
        """Record the glare passes: down the pyramid, then up."""
        if not self._levels:
            width, height = self._size
            for level in range(1, len(shares) + 1):
                width, height = -(-width // 2), -(-height // 2)
                self._levels.append(self._texture(width, height, f"level {level}"))
                self._spreads.append(self._texture(width, height, f"spread {level}"))
            self._groups.clear()
        reduce = self._pass(coarser_shader(), LINEAR)
        for level, target in enumerate(self._levels, start=1):
            before = self._levels[level - 2] if level > 1 else self._picture
            reduce.run(encoder, self._bound(reduce, level, level=before), [target])
        spread = self._pass(spread_shader(), LINEAR)
        last = len(shares)
        for level in range(last, 0, -1):
            own = self._levels[level - 1]
            self._write(level, {"level_share": shares[level - 1], "level_more": level < last})
            coarser = self._spreads[level] if level < last else own
            groups = self._bound(spread, level, level=own, coarser=coarser)
            spread.run(encoder, groups, [self._spreads[level - 1]])

    def _texture(self, width: int, height: int, label: str) -> Any:
        import wgpu

        use = wgpu.TextureUsage.RENDER_ATTACHMENT | wgpu.TextureUsage.TEXTURE_BINDING
        return self.device.device.create_texture(
            label=label, size=(width, height, 1), format=LINEAR, usage=use
        )

    def _buffer(self, level: int) -> Any:
        """Uniform buffer of a pyramid level, or of the display (0)."""
        import wgpu

        if level not in self._uniforms:
            use = wgpu.BufferUsage.UNIFORM | wgpu.BufferUsage.COPY_DST
            size = FRAME.packed({}, {}).nbytes
            self._uniforms[level] = self.device.device.create_buffer(size=size, usage=use)
        return self._uniforms[level]

    def _write(self, level: int, uniforms: Mapping[str, float]) -> None:
        gpu = self.device.device
        gpu.queue.write_buffer(self._buffer(level), 0, FRAME.packed(uniforms, {}))

    def _bound(self, one: FragmentPass, number: int, **textures: Any) -> list[Any]:
        """Cached bind groups of a pass for a level."""
        key = one, number
        if key not in self._groups:
            self._groups[key] = one.bind({"frame": self._buffer(number), **textures})
        return self._groups[key]

    def _pass(self, shader: Shader, target_format: str) -> FragmentPass:
        key = shader, target_format
        if key not in self._passes:
            entry = next(iter(shader.entries))
            self._passes[key] = FragmentPass(
                self.device, shader.text, entry, (target_format,), entry
            )
        return self._passes[key]
