"""The two back ends of the browser: the same pass, the same numbers as NumPy."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import painted
import pytest
from numpy.testing import assert_allclose

from airlight.gpu.emit.translated import entry_points, translated

SHADERS = Path(__file__).parent / "shaders"
BACK_ENDS = ("webgpu", "webgl2")

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
    # a second method: the pass of two_targets.wgsl written in NumPy
    width, height, count = 24, 10, 11
    random = np.random.default_rng(7)
    scalars = random.random(5000, np.float32)
    spectra, field = random.random((2, 3000, 4), np.float32)
    colors = random.random((4, 4), np.float32)
    wgsl = (SHADERS / "two_targets.wgsl").read_text(encoding="utf-8")
    page = modules({"devices/device": ("openDevice",)})
    got = page.evaluate(
        _RUN,
        {
            "wanted": wanted,
            "shader": {
                "wgsl": wgsl,
                "glsl": {
                    stage: translated("two_targets", entry, wgsl, SHADERS)
                    for stage, entry in (("vertex", "corners"), ("fragment", "fragment"))
                },
                "vertex": "corners",
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


def test_glsl_belongs_to_its_wgsl() -> None:
    # the head of a translated file names the text that it was made of
    for file in SHADERS.glob("*.wgsl"):
        wgsl = painted.text(file.stem)
        for _, entry in entry_points(wgsl):
            assert translated(file.stem, entry, wgsl, SHADERS).startswith("#version 300 es")
