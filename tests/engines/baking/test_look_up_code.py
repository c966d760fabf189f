"""Look-up code beside baked tables: WGSL and HLSL run on a device give Python's numbers."""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any, NoReturn

import numpy as np
import pytest
from look_up_vectors import FUNCTIONS, calls, textures, vectors
from numpy.testing import assert_allclose

from airlight.engines.baking.bake import bake
from airlight.engines.baking.table_files import load_tables, write_tables
from airlight.render.gpu.device.device import Device

CHOICES: dict[str, dict[str, Any]] = {
    "separate": {"size": (6, 20, 9, 8)},
    "half": {"size": (6, 20, 9, 8), "precision": "half", "mu_s_min": -0.5},
    "combined": {"size": (5, 12, 7, 6), "packing": "combined"},
}


@pytest.fixture(scope="module", params=CHOICES)
def folder(request: Any, solved: Callable[..., Any], tmp_path_factory: Any) -> Path:
    """Tables of air with two kinds of particles."""
    from airlight.planets import load_planet, replace

    planet = replace(load_planet("earth"), refraction="none")
    solution = solved(planet, (680.0, 550.0, 440.0), quality="preview")
    path = tmp_path_factory.mktemp(request.param) / "out"
    return write_tables(path, bake(solution, points=20, **CHOICES[request.param])).parent


def agree(seen: np.ndarray, folder: Path) -> None:
    """Single precision and every fourth node of the phase functions: 4e-3 of each vector."""
    _, results = vectors(folder)
    for k, (name, wanted) in enumerate(results.items()):
        got = seen[:, k, :3]
        assert (wanted > 1e-6).mean() > 0.3
        assert_allclose(got, wanted, rtol=4e-3, atol=2e-5 * wanted.max(), err_msg=name)
        bright = wanted > 1e-6
        assert_allclose(got[bright], wanted[bright], rtol=4e-3, err_msg=name)
        assert np.median(np.abs(got[bright] / wanted[bright] - 1.0)) < 1e-4


def test_vectors_are_python_s_look_up(folder: Path) -> None:
    # The file stands alone: the tables read back give its results.
    baked = load_tables(folder)
    said = json.loads((folder / "test_vectors.json").read_text(encoding="utf-8"))["functions"]
    r, mu, mu_s, nu, ground = np.array(said["air_radiance"]["arguments"], float).T
    from airlight.solver.tables.layout import Positions

    made = baked.light.relative_radiance(Positions(r, mu, mu_s, nu, ground > 0.5))
    assert_allclose(made, said["air_radiance"]["results"], rtol=1e-12)


def test_wgsl_gives_the_test_vectors(folder: Path, device: Device) -> None:
    images = textures(folder)
    declared = "".join(
        f"@group(0) @binding({k}) var {name}: texture_{'3d' if one.ndim == 4 else '2d'}<f32>;\n"
        for k, (name, one) in enumerate(images.items())
    )
    count, size = len(images), sum(FUNCTIONS.values())
    stores = "".join(
        f"  results[{len(FUNCTIONS)} * i + {k}] = {call};\n"
        for k, call in enumerate(calls(f"arguments[{size} * i + {{}}]", "{} > 0.5"))
    )
    text = f"""{declared}{(folder / "look_up.wgsl").read_text(encoding="utf-8")}
@group(0) @binding({count}) var<storage, read> arguments: array<f32>;
@group(0) @binding({count + 1}) var<storage, read_write> results: array<vec4f>;
@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {{
  let i = i32(id.x);
  if (i * {size} >= i32(arrayLength(&arguments))) {{ return; }}
{stores}}}
"""
    agree(run_compute(device, text, images, folder), folder)


def test_hlsl_compiles_and_gives_the_test_vectors(
    folder: Path, device: Device, lacking: Callable[[str], NoReturn], tmp_path: Path
) -> None:
    if shutil.which("glslangValidator") is None:
        lacking("no glslangValidator (Debian's glslang-tools)")
    images = textures(folder)
    declared = "".join(
        f"[[vk::binding({k}, 0)]] Texture{'3D' if one.ndim == 4 else '2D'}<float4> {name};\n"
        for k, (name, one) in enumerate(images.items())
    )
    count, size = len(images), sum(FUNCTIONS.values())
    stores = "".join(
        f"  results[{len(FUNCTIONS)} * i + {k}] = {call};\n"
        for k, call in enumerate(calls(f"arguments[{size} * i + {{}}]", "{} > 0.5"))
    )
    rows = vectors(folder)[0].shape[0]
    source = tmp_path / "look_up_test.hlsl"
    source.write_text(
        f"""{declared}{(folder / "look_up.hlsl").read_text(encoding="utf-8")}
[[vk::binding({count}, 0)]] StructuredBuffer<float> arguments;
[[vk::binding({count + 1}, 0)]] RWStructuredBuffer<float4> results;
[numthreads(64, 1, 1)] void main(uint3 id : SV_DispatchThreadID) {{
  int i = (int)id.x;
  if (i >= {rows}) return;
{stores}}}
""",
        encoding="utf-8",
    )
    made = tmp_path / "look_up_test.spv"
    words = ["glslangValidator", "-D", "-S", "comp", "-e", "main", "-V", "-o", str(made)]
    done = subprocess.run([*words, str(source)], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout
    agree(run_compute(device, made.read_bytes(), images, folder), folder)


def run_compute(
    device: Device, code: str | bytes, images: dict[str, np.ndarray], folder: Path
) -> np.ndarray:
    """Results of all functions, shape (n, functions, 4), by a compute pass on a device."""
    import wgpu

    arguments, _ = vectors(folder)
    gpu = device.device
    bound: list[dict[str, Any]] = []
    for binding, image in enumerate(images.values()):
        depth = image.shape[0] if image.ndim == 4 else 1
        height, width = image.shape[-3:-1]
        texture = gpu.create_texture(
            size=(width, height, depth), dimension="3d" if image.ndim == 4 else "2d",
            format="rgba32float",
            usage=wgpu.TextureUsage.TEXTURE_BINDING | wgpu.TextureUsage.COPY_DST,
        )  # fmt: skip
        gpu.queue.write_texture(
            {"texture": texture}, np.ascontiguousarray(image),
            {"bytes_per_row": 16 * width, "rows_per_image": height}, (width, height, depth),
        )  # fmt: skip
        bound.append({"binding": binding, "resource": texture.create_view()})
    given = gpu.create_buffer_with_data(
        data=np.ascontiguousarray(arguments), usage=wgpu.BufferUsage.STORAGE
    )
    count = arguments.shape[0] * len(FUNCTIONS)
    usage = wgpu.BufferUsage.STORAGE | wgpu.BufferUsage.COPY_SRC
    results = gpu.create_buffer(size=16 * count, usage=usage)
    bound += [
        {"binding": len(images) + k, "resource": {"buffer": one, "offset": 0, "size": one.size}}
        for k, one in enumerate((given, results))
    ]
    pipeline = gpu.create_compute_pipeline(
        layout="auto",
        compute={"module": gpu.create_shader_module(code=code), "entry_point": "main"},
    )
    group = gpu.create_bind_group(layout=pipeline.get_bind_group_layout(0), entries=bound)
    encoder = gpu.create_command_encoder()
    running = encoder.begin_compute_pass()
    running.set_pipeline(pipeline)
    running.set_bind_group(0, group)
    running.dispatch_workgroups(-(-arguments.shape[0] // 64))
    running.end()
    gpu.queue.submit([encoder.finish()])
    read = np.frombuffer(gpu.queue.read_buffer(results), np.float32)
    return read.reshape(arguments.shape[0], len(FUNCTIONS), 4)
