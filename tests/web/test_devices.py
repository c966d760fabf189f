"""Two back ends of the browser: the same pass gives the same numbers as NumPy."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.kernel.lanes import LANES, lane_array, load, store
from airlight.render.gpu.emit.dialect import ShaderDialect
from airlight.render.gpu.emit.emitter import Emitter
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.shader_types import F32, I32, VEC4, TupleType
from airlight.render.gpu.emit.texture_table import TextureTable
from airlight.render.gpu.emit.wgsl import WGSL
from airlight.render.gpu.solver.passes import PASSES
from airlight.viewer.browser.package import program
from airlight.viewer.browser.web_shaders import CORNERS, FILL, LAYERED, solver_shaders, web_shaders

BACK_ENDS = ("webgpu", "webgl2")

_SIZE = 16


def steps(i):
    return 2.0 ** float(i % 4) * i


def fill(out, count):
    for i in range(count):
        out[i] = steps(i)


def fill_through(out, count):
    fill(out, count)
    if count > 3:
        out[0] = 0.5
        return
    out[1] = 0.25


def doubled(x):
    return x, 2.0 * x


def all_means(index, count, scalars, field):
    """All language features of the viewer's shaders: arrays, loops, tuples, tables, lanes."""
    numbers = np.empty(_SIZE)
    kept = lane_array(8)
    fill_through(numbers, count)
    total = 0.0
    k = 0
    while k < count:
        k += 1
        if k == 3:
            continue
        total += numbers[k - 1]
    store(kept, LANES * (k % 8), load(field, LANES * index))
    once, twice = doubled(scalars[index + 2040])
    chosen = twice if index % 2 == 1 else once
    return load(kept, LANES * (k % 8)) * total, chosen, total


def two_targets(dialect: ShaderDialect) -> str:
    """Text of the pass in a language."""
    tables = [
        (TextureTable("scalars", "scalars"), 0, 1),
        (TextureTable("spectra", "spectra", 1, True), 0, 2),
        (TextureTable("field", "field", 1, True), 1, 0),
    ]
    emitter = Emitter(dialect)
    numbers, _, field = (table.table for table, *_ in tables)
    made = emitter.add(all_means, I32, I32, numbers, field)
    assert isinstance(made.result, TupleType)
    parts = [dialect.uniforms("uniforms", ["counts", ("colors", 4)], 0, 0)]
    for table, *slot in tables:
        parts.append(dialect.texture(table.texture, *slot))
        parts.append(table.reader(dialect, dialect.texture_name(table.texture, *slot)))
    x, y = dialect.convert("at.x", I32), dialect.convert("at.y", I32)
    width = dialect.uniform("uniforms.counts.y", I32)
    count = dialect.uniform("uniforms.counts.x", I32)
    scattered, chosen, total = (dialect.part("means", i) for i in range(3))
    number = dialect.convert("index", F32)
    body = [
        dialect.let("index", I32, f"{y} * {width} + {x}"),
        dialect.let("means", made.result, f"all_means(index, {count})"),
        dialect.let("color", VEC4, "uniforms.colors[index & 3] * read_spectra(index)"),
    ]
    place = f"{dialect.type_name(VEC4)}({number}, {chosen}, {total}, at.y)"
    entry = dialect.fragment("fragment", 2, body, [f"color + {scattered}", place])
    return dialect.module([*parts, emitter.module(), entry])


_RUN = """async ({ wanted, shader, uniforms, scalars, spectra, field, width, height }) => {
  const device = await openDevice(document.createElement("canvas"), wanted);
  const numbers = (list) => new Float32Array(list);
  const pipeline = await device.pipeline(shader, ["rgba32float", "rgba32float"]);
  const targets = [0, 1].map(() => device.target("rgba32float", width, height));
  const reads = {
    "0/1": device.flatTexture("r32float", numbers(scalars)),
    "0/2": device.flatTexture("rgba32float", numbers(spectra)),
    "1/0": device.flatTexture("rgba32float", numbers(field)),
  };
  device.run(pipeline, numbers(uniforms), reads, targets);
  await device.finished();
  const [light, place] = [await device.read(targets[0]), await device.read(targets[1])];
  const { kind, name } = device;
  Object.values(reads).forEach((texture) => device.release(texture));
  device.close();
  return { kind, name, light: Array.from(light), place: Array.from(place) };
}"""


@pytest.mark.parametrize("wanted", BACK_ENDS)
def test_pass_reads_flat_tables_and_draws_two_float_targets(
    wanted: str, modules: Callable[..., Any], tell: Callable[[str], None]
) -> None:
    # a second method: the same pass written in NumPy
    width, height, count = 24, 10, 11
    random = np.random.default_rng(7)
    scalars = random.random(5000, np.float32)
    spectra, field = random.random((2, 3000, 4), np.float32)
    colors = random.random((4, 4), np.float32)
    page = modules({"devices/device": ("openDevice",)})
    got = page.evaluate(
        _RUN,
        {
            "wanted": wanted,
            "shader": {
                "wgsl": f"{WGSL.triangle}\n{two_targets(WGSL)}",
                "glsl": {"vertex": GLSL.triangle, "fragment": two_targets(GLSL)},
                "vertex": CORNERS,
                "entry": "fragment",
                "uniforms": "0/0",
                "reads": ["0/1", "0/2", "1/0"],
            },
            "uniforms": [count, width, 0, 0, *colors.ravel().tolist()],
            "scalars": scalars.tolist(),
            "spectra": spectra.ravel().tolist(),
            "field": field.ravel().tolist(),
            "width": width,
            "height": height,
        },
    )
    tell(f"{wanted}: {got['name']}")
    assert got["kind"] == wanted
    index = np.arange(width * height)
    room = np.array([1.0, 2.0, 4.0, 8.0])[np.arange(count) % 4] * np.arange(count)
    room[0] = 0.5
    total = room.sum() - room[2]
    light = colors[index % 4] * spectra[index] + field[index] * total
    # Two products and a sum of float32.
    assert_allclose(np.reshape(got["light"], (-1, 4)), light, rtol=4e-7)
    place = np.reshape(got["place"], (-1, 4))
    assert_allclose(place[:, 0], index, rtol=0)
    assert_allclose(place[:, 1], scalars[index + 2040] * np.where(index % 2 == 1, 2, 1), rtol=1e-7)
    assert_allclose(place[:, 2], np.full(index.size, total), rtol=1e-6)
    assert_allclose(place[:, 3], index // width + 0.5, rtol=0)


_COMPILE = """async (shaders) => {
  const device = await openDevice(document.createElement("canvas"), "webgl2");
  for (const shader of shaders) await device.pipeline(shader, ["rgba32float"]);
  device.close();
}"""


@pytest.mark.validation  # pages of test_pictures.py and test_edits.py are made of all of them
def test_every_shader_compiles_in_webgl2(modules: Callable[..., Any]) -> None:
    # the shaders of a page: an error names the entry point and the line
    pairs = [
        (f"{name}.{entry}", text)
        for name, one in {**web_shaders(False, LAYERED), **solver_shaders()}.items()
        for entry, text in one["glsl"].items()
        if entry != CORNERS
    ]
    # sky, its peaks and polarisation, sea, pixels, glare down and up, sum of lights, display
    assert len(pairs) == 9 + len(LAYERED) + len(PASSES)
    page = modules({"devices/device": ("openDevice",)})
    shaders = [
        {"entry": name, "uniforms": {}, "glsl": {"vertex": GLSL.triangle, "fragment": text}}
        for name, text in pairs
    ]
    page.evaluate(_COMPILE, shaders)


_BUILD = """async ({ plan, shaders, solver, entry }) => {
  const device = await openDevice(document.createElement("canvas"), "webgpu");
  const lost = [];
  device.device.addEventListener("uncapturederror", (event) => lost.push(event.error.message));
  const made = await new Program(device, plan, shaders).build();
  for (const shader of Object.values(solver)) {
    const text = { ...shader, ...entry, reads: Object.keys(shader.reads) };
    await device.pipeline(text, Array(shader.targets).fill("rgba32float"));
  }
  await device.finished();
  device.close();
  return [device.kind, made.compiled.size, lost];
}"""


def test_every_pipeline_is_made_in_webgpu(modules: Callable[..., Any]) -> None:
    # with the page's own slots and targets; software takes minutes to draw by the large ones, which
    # only test_pictures.py's validation waits for
    page = modules({"devices/device": ("openDevice",), "drawing/program": ("Program",)})
    given = program(layers=LAYERED)
    given |= {"solver": solver_shaders(), "entry": {"vertex": CORNERS, "entry": FILL}}
    kind, count, faults = page.evaluate(_BUILD, json.loads(json.dumps(given)))
    assert faults == []
    assert (kind, count) == ("webgpu", len({one["name"] for one in given["plan"]["passes"]}))


_LAYER = """async ([kind, plan, shaders, texels]) => {
  const device = await openDevice(document.createElement("canvas"), kind);
  const names = ["layered", "covering", "added"];
  const made = new Program(device, plan, shaders);
  await made.build(() => {}, (name) => names.includes(name));
  const image = (values) => device.image("rgba32float", 3, 2, new Float32Array(values));
  const [picture, level, coarser] = texels.map(image);
  const read = [];
  for (const name of names) {
    const into = device.target("rgba32float", 3, 2);
    made.runIn("added", null, { picture, level: picture }, [into]);
    made.runIn(name, [1, 0, 2, 1], { picture, level, coarser }, [into]);
    read.push(Array.from(await device.read(into)));
  }
  device.close();
  return read;
}"""


@pytest.mark.parametrize("kind", BACK_ENDS)
def test_layers_are_put_in_front_of_a_part_of_a_picture(
    kind: str, modules: Callable[..., Any]
) -> None:
    page = modules({"devices/device": ("openDevice",), "drawing/program": ("Program",)})
    given = json.loads(json.dumps(program(layers=LAYERED)))
    picture, level, through = np.random.default_rng(3).random((3, 2, 3, 4)).astype(np.float32)
    texels = [one.ravel().tolist() for one in (picture, level, through)]
    read = page.evaluate(_LAYER, [kind, given["plan"], given["shaders"], texels])
    for got, layer in zip(
        np.reshape(read, (3, 2, 3, 4)),
        (level + through * picture, level + picture - through * picture, level + picture),
        strict=True,
    ):
        wanted = 2.0 * picture
        wanted[0, 1:] = layer[0, 1:]
        assert_allclose(got[..., :3], wanted[..., :3], rtol=1e-6)


@pytest.mark.parametrize("kind", ["webgpu", "webgl2"])
@pytest.mark.parametrize("wide", [False, True])
def test_the_canvas_has_the_screen_s_colour_space(
    kind: str, wide: bool, modules: Callable[..., Any]
) -> None:
    # read back from what the browser took, not from what it was asked for
    page = modules({"devices/device": ("openDevice",)})
    got = page.evaluate(
        """async ([kind, wide]) => {
          window.matchMedia = (query) => ({ matches: wide && query === "(color-gamut: p3)" });
          const device = await openDevice(document.createElement("canvas"), kind);
          const { space, gl, context } = device;
          const taken = gl ? gl.drawingBufferColorSpace : context.getConfiguration().colorSpace;
          device.close();
          return [space, taken];
        }""",
        [kind, wide],
    )
    assert got == ["display-p3" if wide else "srgb"] * 2
