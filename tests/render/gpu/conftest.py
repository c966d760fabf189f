"""Fixture that runs a kernel on the device."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pytest
from numpy.typing import ArrayLike, NDArray

from airlight.render.gpu.device.device import Device
from airlight.render.gpu.device.flat import empty_flat_texture, flat_texture, read_flat
from airlight.render.gpu.device.fragment_pass import FragmentPass
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.shader_types import (
    BOOL,
    F32,
    FLAT_WIDTH,
    I32,
    VEC4,
    Scalar,
    TupleType,
    UniformValue,
    Value,
)

Arrays = Mapping[str, NDArray[Any]]

#: Type of an input of a NumPy kind in a kernel, and its conversion from a float.
_KINDS = {"f": (F32, "{}"), "i": (I32, "i32({})"), "b": (BOOL, "({} != 0.0)")}


@pytest.fixture(scope="session")
def on_gpu(device: Device) -> Callable[..., Any]:
    """``on_gpu(function, *inputs, tables={}, spectra={})``: results of its WGSL for the inputs.

    An input is an array or a number, passed at run time (floats as f32, integers as i32, bools), a
    NamedTuple of such, or a ``Value`` of the emitter, such as a ``Constant``. ``tables`` and
    ``spectra``, the latter of shape (..., 4), are the arrays of the ``ShaderTable`` values by name.
    The result is an array, or a tuple of them, in the inputs' common shape; four wavelengths are
    its last axis.
    """

    def run(
        function: Callable[..., Any], *inputs: ArrayLike | Value,
        tables: Arrays | None = None, spectra: Arrays | None = None,
    ) -> Any:  # fmt: skip
        return _run(device, function, inputs, tables or {}, spectra or {})

    return run


def _run(
    device: Device,
    function: Callable[..., Any],
    inputs: tuple[Any, ...],
    tables: Arrays,
    spectra: Arrays,
) -> Any:
    emitter = Emitter()
    arrays = [
        np.asarray(part)
        for one in inputs
        if not isinstance(one, Value)
        for part in (one if isinstance(one, tuple) else (one,))
    ]
    given = np.broadcast_arrays(*arrays) if arrays else []
    shape = given[0].shape if given else ()
    count = int(np.prod(shape))
    values: list[Value] = []
    handed: list[str] = []
    column = 0
    for one in inputs:
        if isinstance(one, Value):
            values.append(one)
            handed += [one.text] if isinstance(one, UniformValue) else []
            continue
        parts = []
        for part in one if isinstance(one, tuple) else (one,):
            kind, taken = _KINDS[np.asarray(part).dtype.kind]
            parts.append(taken.format(f"given(item * {len(arrays)} + {column})"))
            column += 1
        record = emitter.record_type(type(one)) if isinstance(one, tuple) else None
        values.append(kind if record is None else record)
        handed.append(parts[0] if record is None else emitter.dialect.tuple_expr(record, parts))
    made = emitter.add(function, *values)
    assert made.result is not None, "a kernel without a result"
    several = isinstance(made.result, TupleType)
    items = made.result.items if isinstance(made.result, TupleType) else (made.result,)
    numbers: list[str] = []
    for i, item in enumerate(items):
        text = emitter.dialect.part("result", i, made.result) if several else "result"
        numbers += [f"{text}.{c}" for c in "xyzw"] if item == VEC4 else [f"f32({text})"]
    assert len(numbers) <= 8, "two targets are all that a browser allows"
    numbers += ["0.0"] * (8 - len(numbers))
    shapes = [(name, array.shape, True) for name, array in tables.items()]
    shapes += [(name, array.shape[:-1], False) for name, array in spectra.items()]
    declared = "".join(_declared(*one, binding) for binding, one in enumerate(shapes, start=1))
    source = f"""{emitter.module()}
@group(0) @binding(0) var inputs: texture_2d<f32>;
fn given(index: i32) -> f32 {{ return textureLoad(inputs, vec2i(index & 2047, index >> 11), 0).x; }}
{declared}
struct Results {{ @location(0) first: vec4f, @location(1) second: vec4f }}
@fragment fn results(@builtin(position) at: vec4f) -> Results {{
  let item = min(i32(at.y) * {FLAT_WIDTH} + i32(at.x), {max(count, 1) - 1});
  let result = {made.name}({", ".join(handed)});
  return Results(vec4f({", ".join(numbers[:4])}), vec4f({", ".join(numbers[4:])}));
}}
"""
    packed = np.stack([one.astype(np.float32).ravel() for one in given], -1) if given else [0.0]
    resources = {"inputs": flat_texture(device, np.ravel(packed))}
    for name, array in tables.items():
        resources[f"texture_{name}"] = flat_texture(device, np.ravel(array))
    for name, array in spectra.items():
        resources[f"texture_{name}"] = flat_texture(device, array.reshape(-1, 4))
    targets = [empty_flat_texture(device, max(count, 1), 4) for _ in range(2)]
    FragmentPass(device, source, "results", ["rgba32float"] * 2, function.__name__).draw(
        resources, targets
    )
    read = np.concatenate([read_flat(device, one, max(count, 1)) for one in targets], axis=1)
    return _taken_apart(read, items, shape, several)


def _declared(name: str, shape: tuple[int, ...], scalar: bool, binding: int) -> str:
    """Declare a table's texture and the functions that read it."""
    sizes = "\n".join(
        f"fn size_{name}_{axis}() -> i32 {{ return {length}; }}"
        for axis, length in enumerate(shape)
    )
    place = "vec2i(index & 2047, index >> 11)"
    kind, taken = ("f32", ".x") if scalar else ("vec4f", "")
    return f"""
@group(0) @binding({binding}) var texture_{name}: texture_2d<f32>;
fn read_{name}(index: i32) -> {kind} {{ return textureLoad(texture_{name}, {place}, 0){taken}; }}
{sizes}"""


def _taken_apart(
    read: NDArray[np.float32], items: tuple[Scalar, ...], shape: tuple[int, ...], several: bool
) -> Any:
    answers, column = [], 0
    for item in items:
        if item == VEC4:
            answers.append(read[:, column : column + 4].reshape(*shape, 4))
            column += 4
            continue
        kind = {F32: np.float32, I32: np.int64, BOOL: np.bool_}[item]
        answers.append(read[:, column].astype(kind).reshape(shape))
        column += 1
    return tuple(answers) if several else answers[0]
