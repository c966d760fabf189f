"""The folder for Bruneton's WebGL demo, drawn by a page that does with it what demo.js does.

The page replaces the shaders' heads, joins the two fragment shaders, uploads the files in the
demo's formats and sets its uniforms, the Earth's centre and sun included, whatever the planet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.engines.targets.bruneton_demo import TARGET, read_constants, read_tables
from airlight.engines.targets.bruneton_tables import SkyTables
from airlight.engines.targets.target import read_export
from airlight.geometry.shell import meets_ground
from airlight.kernel import vectorized
from airlight.planets import load_planet
from airlight.solver.lines_of_sight import enter_shell
from airlight.solver.tables.layout import Positions

pytestmark = pytest.mark.slow

WIDTH, HEIGHT = 48, 32
EXPOSURE = 10.0

PAGE = """<!doctype html><link rel="icon" href="data:,">
<canvas width="WIDTH" height="HEIGHT"></canvas>
<script type="module">
  const gl = document.querySelector("canvas").getContext("webgl2", { preserveDrawingBuffer: true });
  const linear = gl.getExtension("OES_texture_float_linear");
  gl.getExtension("EXT_color_buffer_float");
  const text = async (name) => (await (await fetch(`demo/${name}`)).text()).trim();
  const floats = async (name) =>
    new Float32Array(await (await fetch(`demo/${name}`)).arrayBuffer());
  function texture(unit, kind) {
    gl.activeTexture(gl.TEXTURE0 + unit);
    gl.bindTexture(kind, gl.createTexture());
    for (const side of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) {
      gl.texParameteri(kind, side, gl.CLAMP_TO_EDGE);
    }
    gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, gl.LINEAR);
    gl.texParameteri(kind, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  }
  texture(0, gl.TEXTURE_2D);
  gl.texImage2D(gl.TEXTURE_2D, 0, linear ? gl.RGBA32F : gl.RGBA16F, 256, 64, 0, gl.RGBA, gl.FLOAT,
    await floats("transmittance.dat"));
  texture(1, gl.TEXTURE_3D);
  gl.texImage3D(gl.TEXTURE_3D, 0, gl.RGBA16F, 256, 128, 32, 0, gl.RGBA, gl.FLOAT,
    await floats("scattering.dat"));
  texture(2, gl.TEXTURE_2D);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA16F, 64, 16, 0, gl.RGBA, gl.FLOAT,
    await floats("irradiance.dat"));
  const program = gl.createProgram();
  function add(kind, source) {
    const shader = gl.createShader(kind);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw gl.getShaderInfoLog(shader);
    gl.attachShader(program, shader);
  }
  const head = "#version 330";
  add(gl.VERTEX_SHADER, (await text("vertex_shader.txt")).replace(head, "#version 300 es"));
  add(gl.FRAGMENT_SHADER,
    (await text("atmosphere_shader.txt"))
      .replace(head, "#version 300 es\\nprecision highp float;\\nprecision highp sampler3D;") +
    (await text("fragment_shader.txt")).replace(head, ""));
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) throw gl.getProgramInfoLog(program);
  gl.useProgram(program);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 1, -1, -1, 1, 1, 1]), gl.STATIC_DRAW);
  const vertex = gl.getAttribLocation(program, "vertex");
  gl.vertexAttribPointer(vertex, 2, gl.FLOAT, false, 0, 0);
  gl.enableVertexAttribArray(vertex);
  const at = (name) => gl.getUniformLocation(program, name);
  gl.uniform1i(at("transmittance_texture"), 0);
  gl.uniform1i(at("scattering_texture"), 1);
  gl.uniform1i(at("irradiance_texture"), 2);
  gl.uniform3f(at("white_point"), 1, 1, 1);
  gl.uniform3f(at("earth_center"), 0, 0, -6360);
  gl.uniform2f(at("sun_size"), Math.tan(0.004675), Math.cos(0.004675));
  gl.uniform1f(at("exposure"), EXPOSURE);
  window.shoot = ({ clip, model, camera, sun }) => {
    gl.uniformMatrix4fv(at("view_from_clip"), true, new Float32Array(clip));
    gl.uniformMatrix4fv(at("model_from_view"), true, new Float32Array(model));
    gl.uniform3f(at("camera"), ...camera);
    gl.uniform3f(at("sun_direction"), ...sun);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    const pixels = new Uint8Array(4 * WIDTH * HEIGHT);
    gl.readPixels(0, 0, WIDTH, HEIGHT, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return Array.from(pixels);
  };
</script>"""

#: Distance [m], then zenith angle and azimuth of camera and sun [rad]: keys 1, 2, 6, 9 of demo.js.
VIEWS = {
    "afternoon": (9e3, 1.47, 0.0, 1.3, 3.0),
    "sunset": (9e3, 1.47, 0.0, 1.564, -3.0),
    "dusk": (9e3, 1.5, 0.0, 1.628, 1.05),
    "planet": (1.2e7, 0.0, 0.0, 0.93, -2.0),
}


def unit(zenith: float, around: float) -> np.ndarray:
    return np.array(
        [np.sin(zenith) * np.cos(around), np.sin(zenith) * np.sin(around), np.cos(zenith)]
    )


def asked(view: tuple[float, ...]) -> tuple[dict[str, Any], np.ndarray, np.ndarray, np.ndarray]:
    """Uniforms of a view, and directions of its pixels, camera [m] and sun."""
    distance, zenith, around, sun_zenith, sun_around = view
    tall = np.tan(np.radians(25.0))
    behind = unit(zenith, around)
    right = np.array([-np.sin(around), np.cos(around), 0.0])
    model = np.eye(4)
    model[:3] = np.stack([right, np.cross(behind, right), behind, behind * distance / 1e3], axis=-1)
    wide = tall * WIDTH / HEIGHT
    clip = [[wide, 0, 0, 0], [0, tall, 0, 0], [0, 0, 0, -1], [0, 0, 1, 1]]
    x = ((np.arange(WIDTH) + 0.5) / WIDTH * 2.0 - 1.0) * wide
    y = ((np.arange(HEIGHT) + 0.5) / HEIGHT * 2.0 - 1.0) * tall
    ray = np.stack(np.broadcast_arrays(x, y[:, None], -1.0), axis=-1) @ model[:3, :3].T
    ray /= np.linalg.norm(ray, axis=-1, keepdims=True)
    sun = unit(sun_zenith, sun_around)
    uniforms = {
        "clip": np.ravel(clip).tolist(), "model": model.ravel().tolist(),
        "camera": (behind * distance / 1e3).tolist(), "sun": sun.tolist(),
    }  # fmt: skip
    return uniforms, ray.reshape(-1, 3), behind * distance, sun


def ground_light(
    tables: SkyTables, said: dict[str, Any], views: Positions, length: np.ndarray
) -> np.ndarray:
    """Linear light of Lambert ground behind its air, lit by sun and sky, (n, 3)."""
    bottom, count = tables.layout.bottom_radius, len(views)
    level = np.full(count, bottom)
    cosine = -(views.r * views.mu + length) / bottom  # of the way back from the ground
    mu_s = np.clip((views.r * views.mu_s + length * views.nu) / bottom, -1.0, 1.0)
    spot = Positions(level, cosine, mu_s, views.nu, np.zeros(count, bool))
    back = Positions(views.r, -views.mu, mu_s, views.nu, np.zeros(count, bool))
    sunward = Positions(level, mu_s, mu_s, views.nu, np.zeros(count, bool))
    transmittance = tables.transmittance_at(spot) / np.maximum(tables.transmittance_at(back), 1e-30)
    x = np.clip(0.5 + 0.5 * mu_s / said["SUN_ANGULAR_RADIUS"], 0.0, 1.0)
    seen = (x * x * (3.0 - 2.0 * x) * np.maximum(mu_s, 0.0))[:, None]
    sun = said["SOLAR_IRRADIANCE"] * tables.transmittance_at(sunward) * seen
    lit = sun * said["SUN_SPECTRAL_RADIANCE_TO_LUMINANCE"]
    lit += tables.irradiance_at(spot) * said["SKY_SPECTRAL_RADIANCE_TO_LUMINANCE"]
    return np.asarray(np.minimum(transmittance, 1.0) * said["GROUND_ALBEDO"] * lit / np.pi)


@pytest.fixture(
    scope="module", params=["earth", pytest.param("mars", marks=pytest.mark.validation)]
)
def folder(request: pytest.FixtureRequest, demo_folder: Callable[[str], Path]) -> Path:
    return demo_folder(request.param)


@pytest.fixture(scope="module")
def shoot(
    folder: Path,
    served_pages: Callable[[Path], AbstractContextManager[Any]],
    tmp_path_factory: pytest.TempPathFactory,
) -> Iterator[Callable[[dict[str, Any]], np.ndarray]]:
    place = tmp_path_factory.mktemp("demo-site")
    (place / "demo").symlink_to(folder)
    page_text = PAGE.replace("EXPOSURE", f"{EXPOSURE}")
    page_text = page_text.replace("WIDTH", str(WIDTH)).replace("HEIGHT", str(HEIGHT))
    (place / "index.html").write_text(page_text, encoding="utf-8")
    with served_pages(place) as open_page:
        page = open_page("index.html")
        page.wait_for_function("window.shoot !== undefined")
        yield lambda uniforms: np.array(page.evaluate("(given) => shoot(given)", uniforms)).reshape(
            -1, 4
        )[:, :3]


@pytest.mark.parametrize("name", list(VIEWS))
def test_the_demo_draws_our_look_up(
    name: str, folder: Path, shoot: Callable[[dict[str, Any]], np.ndarray]
) -> None:
    # Two of 255 steps: halves, single precision in the shader, and rounding to eight bits.
    tables, said = read_tables(folder), read_constants(folder)
    uniforms, ray, camera, sun = asked(VIEWS[name])
    drawn = shoot(uniforms)
    bottom, top = tables.layout.bottom_radius, tables.layout.top_radius
    place = camera + np.array([0.0, 0.0, bottom])
    r = float(np.linalg.norm(place))
    up = place / r
    mu, mu_s, nu = ray @ up, np.full(len(ray), sun @ up), ray @ sun
    sine = np.sqrt(np.maximum(1.0 - mu**2, 0.0))
    lines = enter_shell(np.full(len(ray), r), mu, sine, mu_s, nu, bottom, top)
    where = Positions(lines.r, lines.mu, lines.mu_s, lines.nu, lines.to_ground)
    light = np.where((lines.length > 0.0)[:, None], tables.radiance(where), 0.0)
    light *= said["SKY_SPECTRAL_RADIANCE_TO_LUMINANCE"]
    to_display = lambda one: 255.0 * (1.0 - np.exp(-one * EXPOSURE)) ** (1.0 / 2.2)  # noqa: E731
    ground = vectorized(meets_ground)(np.full(len(ray), r), mu, bottom).astype(bool)
    light[ground] += ground_light(tables, said, where[ground], lines.length[ground])
    away = nu < np.cos(2.0 * said["SUN_ANGULAR_RADIUS"])
    assert ground.any()
    assert (~ground & away).any()
    assert_allclose(drawn[away], to_display(light[away]), atol=2.0)
    assert drawn[away].max() > 30.0


def test_the_errors_of_a_folder_are_those_of_the_demo_s_own_precision(folder: Path) -> None:
    rows = {row.name: row for row in read_export(folder, TARGET).errors}
    bar = {"earth": 0.015, "mars": 0.09}[folder.name]
    assert rows["sky"].median < bar
    assert rows["transmittance to the top"].percentile_95 < 5e-4
    planet = load_planet(folder.name)
    assert read_constants(folder)["BOTTOM_RADIUS"] == 1e-3 * planet.bottom_radius
