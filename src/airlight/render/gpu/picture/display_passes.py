"""Passes after rendering: sum over lights and layers, glare, exposure, tone map and encoding."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Mapping, Sequence
from typing import Any, Final, NamedTuple
from weakref import WeakKeyDictionary

from airlight.image.displayed import Display
from airlight.image.glare import glare_levels, glare_share
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.uniform_struct import Fixed
from airlight.render.gpu.picture.display_shaders import (
    added_shader,
    coarser_shader,
    covering_shader,
    display_shader,
    layered_shader,
    spread_shader,
)
from airlight.render.gpu.picture.shaders import Shader
from airlight.render.gpu.picture.uniforms import FRAME

#: Format of linear radiance; half precision overflows at the radiance of the sun's disc.
LINEAR: Final = "rgba32float"


class PictureLayer(NamedTuple):
    """Planet, body without air, or stars.

    Attributes
    ----------
    lights : sequence of callable
        ``part(view, format)`` renders the frame of one light.
    transmittance : callable
        ``transmittance(view, format)`` renders its transmittance, or what it covers.
    key : hashable
        Key of its contents.
    covers : bool
        Whether ``transmittance`` renders the coverage.
    """

    lights: Sequence[Callable[[Any, str], None]]
    transmittance: Callable[[Any, str], None]
    key: Hashable
    covers: bool = False


class DisplayPasses:
    """Sum over lights of linear radiance, and display of a cached frame with its glare.

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
        self._lights: list[Any] = []  # frames of single lights and their partial sums
        self._layers: list[Any] = []  # two pictures, and light and transmittance of a layer
        self._levels: list[Any] = []  # pyramid in texels of 2, 4, 8 … pixels
        self._spreads: list[Any] = []  # spread light of each level and all coarser ones
        self._uniforms: dict[int, Any] = {}
        self._groups: WeakKeyDictionary[FragmentPass, dict[int, list[Any]]] = WeakKeyDictionary()

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

    def render(self, layers: Sequence[PictureLayer], size: tuple[int, int]) -> None:
        """Render layers into the texture of linear radiance, unless it holds them.

        Parameters
        ----------
        layers, size :
            See ``add_layers``.
        """
        picture, rendered = self.picture(*size), tuple(layer.key for layer in layers)
        if self.rendered != rendered:
            self.rendered = None
            self.add_layers(layers, picture, size, LINEAR)
            self.rendered = rendered

    def add_lights(
        self,
        parts: Sequence[Callable[[Any, str], None]],
        view: Any,
        size: tuple[int, int],
        target_format: str,
    ) -> None:
        """Render the sum over lights into a target.

        Parameters
        ----------
        parts : sequence of callable
            ``part(view, format)`` renders the frame of one light.
        view : wgpu.GPUTextureView
            View of the target.
        size : (int, int)
            Width and height of the target. [pixel]
        target_format : str
            Format of the target.
        """
        if len(parts) == 1:
            parts[0](view, target_format)
            return
        # the last sum is written to the target: two lights need no third texture
        count = min(len(parts), 3)
        if count > len(self._lights) or size != tuple(self._lights[0].size[:2]):
            for texture in self._lights:
                texture.destroy()
            self._lights = [self._texture(*size, f"light {k}") for k in range(count)]
        one, other, *spare = self._lights
        parts[0](one.create_view(), LINEAR)
        for number, part in enumerate(parts[1:], start=2):
            part(other.create_view(), LINEAR)
            last = number == len(parts)
            adding = self._pass(added_shader(), target_format if last else LINEAR)
            encoder = self.device.device.create_command_encoder()
            # the shader reads no uniform
            groups = adding.bind({"frame": self._buffer(0), "picture": one, "level": other})
            adding.run(encoder, groups, [view if last else spare[0].create_view()])
            self.device.device.queue.submit([encoder.finish()])
            if not last:
                one, spare = spare[0], [one]

    def add_layers(
        self,
        layers: Sequence[PictureLayer],
        view: Any,
        size: tuple[int, int],
        target_format: str,
    ) -> None:
        """Render layers, each in front of the one before it, into a target.

        Parameters
        ----------
        layers : sequence of PictureLayer
            Layers from the farthest to the nearest.
        view, size, target_format :
            See ``add_lights``.
        """
        if len(layers) == 1:
            self.add_lights(layers[0].lights, view, size, target_format)
            return
        if not self._layers or size != tuple(self._layers[0].size[:2]):
            for texture in self._layers:
                texture.destroy()
            self._layers = [self._texture(*size, f"layer {k}") for k in range(4)]
        behind, light, transmittance, spare = self._layers
        self.add_lights(layers[0].lights, behind.create_view(), size, LINEAR)
        for number, layer in enumerate(layers[1:], start=2):
            self.add_lights(layer.lights, light.create_view(), size, LINEAR)
            layer.transmittance(transmittance.create_view(), LINEAR)
            last = number == len(layers)
            shader = covering_shader() if layer.covers else layered_shader()
            one = self._pass(shader, target_format if last else LINEAR)
            encoder = self.device.device.create_command_encoder()
            groups = one.bind(
                {
                    "frame": self._buffer(0),
                    "picture": behind,
                    "level": light,
                    "coarser": transmittance,
                }
            )
            one.run(encoder, groups, [view if last else spare.create_view()])
            self.device.device.queue.submit([encoder.finish()])
            behind, spare = spare, behind

    def copy(self, texture: Any, view: Any, target_format: str) -> None:
        """Copy linear radiance into a target of its size."""
        adding = self._pass(added_shader(), target_format)
        encoder = self.device.device.create_command_encoder()
        nothing = self._texture(1, 1, "black")
        groups = adding.bind({"frame": self._buffer(0), "picture": texture, "level": nothing})
        adding.run(encoder, groups, [view])
        self.device.device.queue.submit([encoder.finish()])

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
        groups = self._groups.setdefault(one, {})
        if number not in groups:
            groups[number] = one.bind({"frame": self._buffer(number), **textures})
        return groups[number]

    def _pass(self, shader: Shader, target_format: str) -> FragmentPass:
        entry = next(iter(shader.entries))
        return FragmentPass.of(self.device, shader.text, entry, (target_format,))
