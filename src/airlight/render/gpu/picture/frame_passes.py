"""Fragment passes of rendering, with their pipelines and bindings."""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from typing import Any, Final, Protocol
from weakref import WeakKeyDictionary

import numpy as np
from numpy.typing import NDArray

from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.uniform_struct import Fixed, UniformStruct
from airlight.render.gpu.picture.shaders import Shader, picture_shader
from airlight.render.gpu.picture.uniforms import FRAME

#: Uniform of pictures with three-dimensional clouds.
CLOUDY: Final = "cloud_eye"


class CloudsOfLight(Protocol):
    """Three-dimensional clouds of a light, see ``CloudTextures``."""

    @property
    def places(self) -> Mapping[str, tuple[int, ...]]:
        """Positions of tables in the textures."""

    @property
    def textures(self) -> Mapping[str, Any]:
        """Textures by name."""

    def shader(self, uniforms: Mapping[str, float], exact: bool, fixed: Fixed = ()) -> Shader:
        """Shader of pixels."""


class FramePasses:
    """Cached bind groups of the rendering passes.

    Parameters
    ----------
    device : Device
        Device from ``open_device``.
    """

    def __init__(self, device: Device) -> None:
        self.device = device
        #: Of each light by pass; the device keeps the passes.
        self._groups: dict[Hashable, WeakKeyDictionary[FragmentPass, list[Any]]] = {}
        self._textures: dict[Hashable, Mapping[str, Any]] = {}
        self._places: dict[Hashable, Mapping[str, tuple[int, ...]]] = {}
        self._clouds: dict[Hashable, CloudsOfLight] = {}
        self._buffers: dict[UniformStruct, Any] = {}

    def read(
        self,
        textures: Mapping[str, Any],
        places: Mapping[str, tuple[int, ...]],
        light: Hashable = 0,
    ) -> None:
        """Set the input textures of a light, and the positions of tables in them."""
        self._textures[light], self._places[light] = textures, places
        self._groups.pop(light, None)

    def read_clouds(self, clouds: CloudsOfLight, light: Hashable = 0) -> None:
        """Set the three-dimensional clouds of a light, for shaders that read them."""
        if self._clouds.get(light) is not clouds:
            self._clouds[light] = clouds
            self._groups.pop(light, None)

    def picture_shader(
        self, uniforms: Mapping[str, float], exact: bool, fixed: Fixed = (), light: Hashable = 0
    ) -> Shader:
        """Shader of the pixels of a light, with clouds if its uniforms have them.

        Parameters
        ----------
        uniforms : mapping
            Uniforms of the frame.
        exact, fixed :
            Arguments of ``picture_shader``.
        light : hashable
            Light.
        """
        if CLOUDY not in uniforms:
            return picture_shader(exact, fixed, uniforms["flattening"] > 0.0)
        return self._clouds[light].shader(uniforms, exact, fixed)

    def _buffer(self, struct: UniformStruct) -> Any:
        import wgpu

        if struct not in self._buffers:
            use = wgpu.BufferUsage.UNIFORM | wgpu.BufferUsage.COPY_DST
            size = struct.packed({}, {}).nbytes
            self._buffers[struct] = self.device.device.create_buffer(size=size, usage=use)
        return self._buffers[struct]

    def packed(
        self,
        uniforms: Mapping[str, float],
        light: Hashable = 0,
        struct: UniformStruct = FRAME,
    ) -> NDArray[np.float32]:
        """Contents of a uniform buffer, for the tables of a light."""
        # Relative to the ground radius in single precision, which is accurate to half a metre.
        r = float(np.float32(uniforms["bottom"])) + (uniforms["r"] - uniforms["bottom"])
        places = dict(self._places.get(light, {}))
        if struct is not FRAME:
            places |= self._clouds[light].places
        return struct.packed({**uniforms, "r": r}, places)

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
        device = self.device.device
        entry = next(iter(shader.entries))
        one = FragmentPass.of(self.device, shader.text, entry, formats)
        packed = self.packed(uniforms, light, shader.struct)
        device.queue.write_buffer(self._buffer(shader.struct), 0, packed)
        encoder = device.create_command_encoder()
        one.run(encoder, self._bound(one, light, shader.struct), list(views), area, keep)
        device.queue.submit([encoder.finish()])

    def _bound(self, one: FragmentPass, light: Hashable, struct: UniformStruct) -> list[Any]:
        groups = self._groups.setdefault(light, WeakKeyDictionary())
        if one not in groups:
            clouds = {} if struct is FRAME else self._clouds[light].textures
            read = {**self._textures[light], **clouds}
            groups[one] = one.bind({"frame": self._buffer(struct), **read})
        return groups[one]
