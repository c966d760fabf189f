"""Shaders of pixels with three-dimensional clouds: the functions of the CPU, for its tables."""

from __future__ import annotations

from functools import cache
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.kernel.shader_fields import InTexture, numbers_of, shader_fields
from airlight.render.clouds.air_table import DISTANCES
from airlight.render.clouds.cloud_tables import PARTS, CloudTables, LayerTables
from airlight.render.clouds.cloudy_pixel import cloudy_light
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import F32, I32, VEC4, LocalArray, Scalar, StructValue
from airlight.render.gpu.emit.uniform_struct import Fixed, UniformStruct
from airlight.render.gpu.emit.wgsl import WGSL_OF_MODULE
from airlight.render.gpu.picture.shaders import (
    Shader,
    call_of_light,
    linear_shader,
    march_workspace,
)
from airlight.render.gpu.picture.uniforms import FRAME
from airlight.render.pixels.render_tables import WAVELENGTHS

#: Beginnings of the names of clouds and of each layer in uniforms and tables.
AROUND: Final = "cloud_"
_LAYER: Final = "layer{}_"
#: Largest number in 16 bits.
_LARGEST: Final = 3e4


@cache
def cloudy_frame(layers: int) -> UniformStruct:
    """Uniforms and tables of pictures with so many layers of clouds.

    Parameters
    ----------
    layers : int
        Number of layers.
    """
    named = [(_LAYER.format(n), LayerTables) for n in range(layers)]
    return UniformStruct("frame", FRAME.bundles, FRAME.more, ((AROUND, CloudTables), *named))


def cloud_numbers(clouds: CloudTables) -> dict[str, float]:
    """Values of the uniforms of clouds.

    Parameters
    ----------
    clouds : CloudTables
        Clouds.
    """
    found = numbers_of(clouds, AROUND)
    for n, layer in enumerate(clouds.layers):
        found |= numbers_of(layer, _LAYER.format(n))
    return found


def air_arrays(clouds: CloudTables) -> dict[str, NDArray[Any]]:
    """Tables of the air before clouds, as texels, by their names in shaders.

    Parameters
    ----------
    clouds : CloudTables
        Clouds.
    """
    return _arrays(clouds, AROUND)


def layer_arrays(clouds: CloudTables) -> dict[str, NDArray[Any]]:
    """Tables of the layers; argument of ``air_arrays``.

    Multiple scattering is in 16 bits, over a number by which ``local`` is multiplied,
    and ``down`` with it.
    """
    source: Any
    inner: Any
    found: dict[str, NDArray[Any]] = {}
    for n, layer in enumerate(clouds.layers):
        sources = layer.source, layer.inner.source
        scale = np.float32(_LARGEST / max(1e-30, *(float(abs(one).max()) for one in sources)))
        source, inner = ((one * scale).astype(np.float16) for one in sources)
        halved = layer._replace(
            source=source,
            inner=layer.inner._replace(source=inner),
            down=layer.down * scale,
            local=layer.local / scale,
        )
        found |= _arrays(halved, _LAYER.format(n))
    return found


def _arrays(values: Any, start: str) -> dict[str, NDArray[Any]]:
    """Arrays of a NamedTuple and of those in it."""
    found: dict[str, NDArray[Any]] = {}
    for one in shader_fields(type(values)):
        value, name = getattr(values, one.name), f"{start}{one.name}"
        if isinstance(one.mark, InTexture):
            if one.name == "source":  # terms are columns
                value = value.reshape(*value.shape[:2], -1, WAVELENGTHS)
            found[name] = value[..., :WAVELENGTHS] if one.mark.spectral else value
        elif one.is_group and not one.vector:
            found |= _arrays(value, f"{name}_")
    return found


@cache
def cloudy_shader(layers: int, terms: int, exact: bool, fixed: Fixed) -> Shader:
    """Shader of linear radiance of pixels with clouds.

    Parameters
    ----------
    layers, terms : int
        Numbers of layers, and of harmonics of the higher orders.
    exact, fixed :
        Arguments of ``picture_shader``; the constants include the filter, which is off.
    """
    emitter, struct = Emitter(WGSL_OF_MODULE), cloudy_frame(layers)
    several = {
        str(n): struct.struct_value(LayerTables, fixed, _LAYER.format(n)) for n in range(layers)
    }
    around = struct.struct_value(CloudTables, fixed, AROUND)
    work = StructValue(
        {
            "air": march_workspace(emitter),
            "clouds": StructValue({**around.fields, "layers": StructValue(several)}),
            "front": _workspace(emitter, layers, terms),
        }
    )
    once = dict(fixed).get("samples") == 1 and not dict(fixed).get("edges", True)
    lines = call_of_light(emitter, cloudy_light, exact, once, fixed, work)
    return linear_shader("cloudy_picture", "cloudy_picture", lines, emitter, struct)


def _workspace(emitter: Emitter, layers: int, terms: int) -> StructValue:
    """``CloudWork`` for the emitter."""

    def array(count: int, element: Scalar = VEC4, columns: int = 0) -> LocalArray:
        return LocalArray(count * max(columns, 1), element, columns=columns)

    arrays = {
        "before": array(DISTANCES, VEC4, PARTS),
        "through": array(DISTANCES),
        "lit": array(DISTANCES, F32),
        "first": array(2),
        "solved": array(layers + 1),
        "passed": array(2),
        "extents": array(layers, F32, 4),
        "found": array(layers, F32),
        "beams": array(layers, F32),
        "depths": array(layers, F32),
        "numbers": array(layers, I32),
        "light": array(PARTS),
        "lost": array(PARTS),
        "clear": array(2),
        "harmonics": array(terms, F32),
    }
    return StructValue(
        {name: emitter.module_array(f"front_{name}", one) for name, one in arrays.items()}
    )
