"""Three-dimensional clouds of one light in textures."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from airlight.errors import ParameterError
from airlight.render.clouds.cloud_light import CloudLight
from airlight.render.clouds.cloud_tables import CloudTables
from airlight.render.clouds.tables_of_frame import cloud_tables
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import flat_texture, packed_texture
from airlight.render.gpu.emit.uniform_struct import Fixed, Place, UniformStruct
from airlight.render.gpu.picture.cloudy_shaders import (
    air_arrays,
    cloud_numbers,
    cloudy_frame,
    cloudy_shader,
    layer_arrays,
)
from airlight.render.gpu.picture.frame_passes import FramePasses
from airlight.render.gpu.picture.shaders import Shader
from airlight.render.gpu.picture.solution_textures import uneven
from airlight.render.pixels.march_points import march_points
from airlight.render.pixels.render_tables import render_tables
from airlight.render.pixels.scenes_by_light import SceneForLight
from airlight.render.pixels.view_uniforms import observer_from


@dataclass(frozen=True, eq=False)
class CloudTextures:
    """Clouds of a light and the air before them on a device.

    Attributes
    ----------
    struct : UniformStruct
        Uniforms and tables of their shaders.
    terms : int
        Number of harmonics of the higher orders.
    uniforms, places, textures : dict
        As those of ``SolutionTextures``.
    layers : int
        Number of layers.
    """

    struct: UniformStruct
    terms: int
    uniforms: dict[str, float]
    places: dict[str, Place]
    textures: dict[str, Any]
    layers: int

    @classmethod
    def of(cls, device: Device, clouds: CloudTables) -> CloudTextures:
        """Upload clouds.

        Parameters
        ----------
        device : Device
            Device from ``open_device``.
        clouds : CloudTables
            Clouds.

        Raises
        ------
        ParameterError
            If a table exceeds a texture.
        """
        struct = cloudy_frame(len(clouds.layers))
        arrays = {**layer_arrays(clouds), **air_arrays(clouds)}
        contents, places = struct.laid_out(arrays)
        textures = {}
        for name, texels in contents.items():
            if texels.dtype == np.float16:
                textures[name] = packed_texture(device, texels, name)
            else:
                textures[name] = flat_texture(device, uneven(texels), name)
        sources = [layer.source for layer in clouds.layers]
        terms = max(2 * source.shape[3] for source in sources)
        return cls(struct, terms, cloud_numbers(clouds), places, textures, len(clouds.layers))

    def shader(self, uniforms: Mapping[str, float], exact: bool, fixed: Fixed = ()) -> Shader:
        """Shader of pixels.

        Parameters
        ----------
        uniforms : mapping
            Uniforms of the frame, with those of the clouds.
        exact, fixed :
            Arguments of ``cloudy_shader``.
        """
        own = tuple(one for one in self.struct.fixed(uniforms) if one[0].startswith("layer"))
        known = {"filter": 0, **dict(own), **dict(fixed)}
        return cloudy_shader(self.layers, self.terms, exact, tuple(sorted(known.items())))


def set_clouds(
    passes: FramePasses,
    number: int,
    light: SceneForLight,
    lit: Sequence[CloudLight],
    uniforms: Mapping[str, float],
    exact: bool,
) -> dict[str, float]:
    """Upload the clouds of a light for its passes; returns their uniforms.

    Parameters
    ----------
    passes : FramePasses
        Passes of rendering.
    number, light : int, SceneForLight
        Light.
    lit : sequence of CloudLight
        Light of each of the clouds, by ascending tops.
    uniforms : mapping
        Uniforms of the frame without clouds.
    exact : bool
        Whether every pixel is marched.

    Raises
    ------
    ParameterError
        If there is a polarising filter.
    """
    if uniforms["filter"] > 0:
        raise ParameterError("camera.polariser", "a filter", "none with clouds on the GPU")
    solution = light.solution
    tables = cloud_tables(
        lit,
        solution,
        light.scene,
        render_tables(solution, peaks=not exact, **march_points(solution)._asdict()),
        observer_from(uniforms),
    )
    made = CloudTextures.of(passes.device, tables)
    passes.read_clouds(made, number)
    return made.uniforms
