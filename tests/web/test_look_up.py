"""Look-up code of baked tables in WebGL2 gives Python's numbers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from look_up_vectors import FUNCTIONS, calls, textures, vectors
from numpy.testing import assert_allclose

from airlight.engines.baking.bake import bake
from airlight.engines.baking.table_files import write_tables
from airlight.planets import load_planet, replace
from airlight.render.gpu.emit.glsl import GLSL

_RUN = """({ vertex, fragments, images, width }) => {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl.getExtension("EXT_color_buffer_float")) throw new Error("no float targets");
  const image = (unit, list, size) => {
    const target = size.length === 3 ? gl.TEXTURE_3D : gl.TEXTURE_2D;
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(target, gl.createTexture());
    const numbers = new Float32Array(list);
    if (size.length === 3) {
      gl.texImage3D(target, 0, gl.RGBA32F, ...size, 0, gl.RGBA, gl.FLOAT, numbers);
    } else {
      gl.texImage2D(target, 0, gl.RGBA32F, ...size, 0, gl.RGBA, gl.FLOAT, numbers);
    }
    gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  };
  images.forEach(({ list, size }, unit) => image(unit, list, size));
  const target = gl.createTexture();
  gl.activeTexture(gl.TEXTURE0 + images.length);
  gl.bindTexture(gl.TEXTURE_2D, target);
  gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA32F, width, 1);
  gl.bindFramebuffer(gl.FRAMEBUFFER, gl.createFramebuffer());
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, target, 0);
  gl.viewport(0, 0, width, 1);
  return fragments.map((fragment) => {
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      const log = gl.getShaderInfoLog(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(log);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
      throw new Error(gl.getProgramInfoLog(program));
    }
    gl.useProgram(program);
    images.forEach(({ name }, unit) => {
      gl.uniform1i(gl.getUniformLocation(program, name), unit);
    });
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    const read = new Float32Array(4 * width);
    gl.readPixels(0, 0, width, 1, gl.RGBA, gl.FLOAT, read);
    return Array.from(read);
  });
}"""


@pytest.mark.parametrize("packing", ["separate", "combined"])
def test_glsl_gives_the_test_vectors(
    packing: str, solved: Callable[..., Any], opened: Callable[..., Any], tmp_path: Path
) -> None:
    planet = replace(load_planet("earth"), refraction="none")
    solution = solved(planet, (680.0, 550.0, 440.0), quality="preview")
    baked = bake(solution, size=(6, 20, 9, 8), packing=packing, points=20)
    folder = write_tables(tmp_path / "out", baked).parent
    images = textures(folder)
    arguments, results = vectors(folder)
    count, size = arguments.shape
    texels = np.zeros((count, 12), np.float32)
    texels[:, :size] = arguments
    declared = "".join(
        f"uniform highp sampler{'3D' if one.ndim == 4 else '2D'} {name};\n"
        for name, one in images.items()
    )
    head = f"""#version 300 es
precision highp float;
precision highp int;
{declared}uniform highp sampler2D given;
{(folder / "look_up.glsl").read_text(encoding="utf-8")}
out vec4 seen;
float argument(int k) {{
  return texelFetch(given, ivec2(3 * int(gl_FragCoord.x) + (k >> 2), 0), 0)[k & 3];
}}
"""
    fragments = [
        f"{head}void main() {{ seen = {call}; }}" for call in calls("argument({})", "{} > 0.5")
    ]
    page = tmp_path / "empty.html"
    page.write_text('<!doctype html><meta charset="utf-8">', encoding="utf-8")
    images["given"] = texels.reshape(1, 3 * count, 4)
    got = opened(page).evaluate(
        _RUN,
        {
            "vertex": GLSL.triangle,
            "fragments": fragments,
            "images": [
                {"name": name, "list": one.ravel().tolist(), "size": list(one.shape[-2::-1])}
                for name, one in images.items()
            ],
            "width": count,
        },
    )
    for (name, wanted), seen in zip(results.items(), got, strict=True):
        light = np.reshape(seen, (count, 4))[:, :3]
        # Single precision at the horizon, and every fourth node of the phase functions.
        assert_allclose(light, wanted, rtol=4e-3, atol=2e-5 * wanted.max(), err_msg=name)
        bright = wanted > 1e-6
        assert np.median(np.abs(light[bright] / wanted[bright] - 1.0)) < 1e-4
    assert list(results) == list(FUNCTIONS)
