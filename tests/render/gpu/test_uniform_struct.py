"""A table is one line: struct, layout, upload and reader follow from the field."""

from __future__ import annotations

from typing import Annotated, Any, NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.errors import ParameterError
from airlight.geometry.vectors import Vec3, dot
from airlight.kernel.lanes import lane_view
from airlight.kernel.shader_fields import CHOICE, InTexture, scalars, spectra
from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import empty_flat_texture, flat_texture, read_flat
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.shader_types import I32, Constant
from airlight.render.gpu.emit.uniform_struct import UniformStruct
from airlight.render.gpu.emit.wgsl import WGSL

RNG = np.random.default_rng(8)
COUNT = 12


class Inner(NamedTuple):
    factor: float
    tints: Annotated[Any, spectra(2)]


class Tint(NamedTuple):
    red: float
    blue: float


class Lamp(NamedTuple):
    height: float
    towards: Vec3
    tint: Tint
    count: int
    law: Annotated[int, CHOICE]
    lit: bool
    first: Annotated[Any, scalars(2)]
    second: Annotated[Any, scalars(4)]
    inner: Inner
    layer: Annotated[Any, InTexture("layer", spectral=True, whole=True)]


class Unmarked(NamedTuple):
    table: np.ndarray


STRUCT = UniformStruct("lamp", (Lamp,), ("color",))
ARRAYS = {
    "first": RNG.random((3, 4)),
    "second": RNG.random((2, 3, 2, 2)),
    "tints": RNG.random((COUNT // 4, 4, 4)),
}


def shone(index, lamp):
    """Sum that reads every table at several places, and every number."""
    total = lane_view(lamp.inner.tints)[index // 4, index % 4] * np.float32(lamp.inner.factor)
    i = index % 3
    scale = lamp.first[i, index % 4] + lamp.second[index % 2, i, index % 2, 1] * lamp.height
    scale = scale + float(lamp.first.shape[1] + lamp.second.shape[1] + lamp.count)
    scale = scale + dot(lamp.towards, Vec3(1.0, 2.0, lamp.towards.z)) + lamp.tint.red
    if lamp.lit:
        scale = scale + lamp.law
    return total * np.float32(scale)


def test_what_is_declared_arrives_in_the_shader(device: Device) -> None:
    # a second method: NumPy on the arrays; float32 after a few operations
    emitter = Emitter()
    made = emitter.add(shone, I32, STRUCT.struct_value(Lamp, (("law", 5),)))
    body = emitter.module()
    tables = STRUCT.read_by(body)
    assert {one.name for one in tables} == set(ARRAYS)  # nobody reads the layer
    names = list(dict.fromkeys(one.texture for one in tables))
    lines = [STRUCT.text(WGSL)]
    lines += [WGSL.texture(name, 0, slot) for slot, name in enumerate(names, start=1)]
    lines += [
        one.reader(WGSL, WGSL.texture_name(one.texture, 0, names.index(one.texture) + 1))
        for one in tables
    ]
    entry = WGSL.fragment("fill", 1, [], [f"{made.name}(i32(at.x)) + lamp.color"])
    textures, places = STRUCT.laid_out(ARRAYS)
    numbers = {"height": 2.0, "count": 7, "law": 9, "lit": 1.0, "factor": 0.5, "color_2": 3.0}
    numbers |= {"towards_x": 1.0, "towards_y": 3.0, "towards_z": 2.0, "tint_red": 6.0}
    text = WGSL.module([*lines, body, entry])
    target = empty_flat_texture(device, COUNT, 4)
    import wgpu

    uniforms = device.device.create_buffer_with_data(
        data=STRUCT.packed(numbers, places), usage=wgpu.BufferUsage.UNIFORM
    )
    resources = {name: flat_texture(device, one) for name, one in textures.items()}
    FragmentPass(device, text, "fill", ["rgba32float"]).draw(
        {"lamp": uniforms, **resources}, [target]
    )
    first, second, k = ARRAYS["first"], ARRAYS["second"], np.arange(COUNT)
    scale = first[k % 3, k % 4] + 2.0 * second[k % 2, k % 3, k % 2, 1] + 4 + 3 + 7 + 5
    scale += (1.0 + 2.0 * 3.0 + 2.0 * 2.0) + 6.0
    wanted = 0.5 * ARRAYS["tints"].reshape(-1, 4) * scale[:, None] + [0.0, 0.0, 3.0, 0.0]
    assert_allclose(read_flat(device, target, COUNT), wanted, rtol=1e-6)


def test_tables_lie_behind_each_other_in_their_textures() -> None:
    textures, places = STRUCT.laid_out(ARRAYS)
    assert places == {"first": (0, 3, 4), "second": (12, 2, 3, 2, 2), "tints": (0, COUNT // 4, 4)}
    assert_array_equal(textures["scalars"][12:, 0], ARRAYS["second"].astype(np.float32).ravel())
    assert textures["spectra"].shape == (COUNT, 4)
    assert "table_layer" not in STRUCT.vectors()


def test_choices_are_switches_and_marked_indices() -> None:
    # as constants, of their types; a size is none
    assert STRUCT.fixed({"law": 3.0, "lit": 1.0}) == (("law", 3), ("lit", True))
    assert STRUCT.struct_value(Lamp, STRUCT.fixed({})).fields["lit"] == Constant(False)


def test_the_struct_is_the_same_in_both_languages() -> None:
    for dialect in (WGSL, GLSL):
        text = STRUCT.text(dialect)
        assert [name for name in STRUCT.vectors() if name not in text] == []


def test_what_is_not_declared_is_refused() -> None:
    with pytest.raises(ParameterError, match="uniform is 'wide'"):
        STRUCT.packed({"wide": 1.0}, {})
    with pytest.raises(ParameterError, match="a number within single precision"):
        STRUCT.packed({"height": 1e60}, {})
    with pytest.raises(TypeError, match="table is an array without a mark"):
        UniformStruct("wrong", (Unmarked,))
