"""The pass of the example for three.js, by its own file, against the look-ups in Python."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Iterator
from contextlib import AbstractContextManager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.cli import main
from airlight.engines.composition.aerial_files import write_aerial
from airlight.engines.composition.aerial_perspective import AerialPerspective
from airlight.image.encoding import srgb_encode

EXAMPLE = Path(__file__).parents[2] / "examples" / "engines" / "three"
WIDTH, HEIGHT, FIELD_OF_VIEW = 96, 54, 50.0
GREY, AWAY = 0.25, 20e3

#: A wall to the north that covers the left half, and what is drawn of it.
PAGE = f"""<!doctype html><link rel="icon" href="data:,"><script type="importmap">
{{ "imports": {{ "three": "./node_modules/three/build/three.module.js" }} }}
</script><script type="module">
  import * as THREE from "three";
  import {{ AirPass }} from "./air_pass.js";
  const renderer = new THREE.WebGLRenderer();
  renderer.setSize({WIDTH}, {HEIGHT});
  const air = await AirPass.load("air");
  air.star.setFromSphericalCoords(1, 75 * Math.PI / 180, Math.PI - 60 * Math.PI / 180);
  air.exposure = 2;
  const scene = new THREE.Scene();
  const wall = new THREE.Mesh(
    new THREE.PlaneGeometry(40, 80),
    new THREE.MeshBasicMaterial({{ color: new THREE.Color({GREY}, {GREY}, {GREY}) }}),
  );
  wall.position.set(-20, 0, -20);
  scene.add(wall);
  air.metresPerUnit = 1000;
  const camera = new THREE.PerspectiveCamera({FIELD_OF_VIEW}, {WIDTH / HEIGHT}, 0.01, 100);
  camera.updateMatrixWorld();
  air.render(renderer, scene, camera);
  const pixels = new Uint8Array(4 * {WIDTH * HEIGHT});
  const gl = renderer.getContext();
  gl.readPixels(0, 0, {WIDTH}, {HEIGHT}, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
  window.seen = Array.from(pixels);
</script>"""


@pytest.fixture(scope="module")
def folder(
    aerial: AerialPerspective,
    tmp_path_factory: pytest.TempPathFactory,
    npm_install: Callable[[Path], None],
) -> Path:
    """The example with its tables, and three.js by npm."""
    place = tmp_path_factory.mktemp("three")
    for name in ("air_pass.js", "index.html", "package.json"):
        shutil.copy(EXAMPLE / name, place / name)
    npm_install(place)
    write_aerial(place / "air", aerial)
    (place / "wall.html").write_text(PAGE, encoding="utf-8")
    return place


@pytest.fixture(scope="module")
def opened_page(
    folder: Path, served_pages: Callable[[Path], AbstractContextManager[Any]]
) -> Iterator[Callable[[str], Any]]:
    """Open a page of the folder by HTTP."""
    with served_pages(folder) as open_page:
        yield open_page


def test_a_wall_and_the_sky_behind(
    opened_page: Callable[[str], Any], aerial: AerialPerspective
) -> None:
    page = opened_page("wall.html")
    page.wait_for_function("window.seen !== undefined", timeout=120e3)
    seen = np.array(page.evaluate("window.seen"), float).reshape(HEIGHT, WIDTH, 4)[::-1, :, :3]
    tall = np.tan(np.radians(0.5 * FIELD_OF_VIEW))
    x = ((np.arange(WIDTH) + 0.5) / WIDTH * 2.0 - 1.0) * tall * WIDTH / HEIGHT
    y = (1.0 - (np.arange(HEIGHT) + 0.5) / HEIGHT * 2.0) * tall
    ray = np.stack(np.broadcast_arrays(x, y[:, None], -1.0), axis=-1)
    length = np.linalg.norm(ray, axis=-1, keepdims=True)
    level = np.array([np.sin(np.radians(60.0)), 0.0, -np.cos(np.radians(60.0))])
    rows = np.stack([level, np.cross([0.0, 1.0, 0.0], level), [0.0, 1.0, 0.0]])
    unit = (ray / length @ rows.T).reshape(-1, 3)
    radiance, transmittance = aerial.air(unit, AWAY * length.ravel())
    covered = np.broadcast_to(x < 0.0, (HEIGHT, WIDTH)).ravel()
    sky = aerial.sky(unit, pixel=np.radians(FIELD_OF_VIEW) / HEIGHT)
    light = np.where(covered[:, None], GREY * transmittance + radiance, sky)
    wanted = 255.0 * srgb_encode(1.0 - np.exp(-2.0 * light)).reshape(HEIGHT, WIDTH, 3)
    assert_allclose(seen, wanted, atol=2.0)


def test_the_example_draws(opened_page: Callable[[str], Any]) -> None:
    page = opened_page("index.html")
    page.wait_for_function("document.title.includes('drawn')", timeout=120e3)


#: A map of ``airlight sky`` as the background of a camera, and what its middle shows.
SKY_PAGE = """<!doctype html><link rel="icon" href="data:,"><script type="importmap">
{ "imports": { "three": "./node_modules/three/build/three.module.js",
  "three/addons/": "./node_modules/three/examples/jsm/" } }
</script><script type="module">
  import * as THREE from "three";
  import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
  const renderer = new THREE.WebGLRenderer();
  renderer.setSize(64, 64);
  renderer.toneMapping = THREE.LinearToneMapping;
  renderer.outputColorSpace = THREE.LinearSRGBColorSpace;
  const sky = await new EXRLoader().loadAsync("sky.exr");
  const { scale, lights } = await (await fetch("sky.json")).json();
  sky.mapping = THREE.EquirectangularReflectionMapping;
  const scene = new THREE.Scene();
  scene.background = sky;
  scene.backgroundIntensity = 1 / scale;
  const camera = new THREE.PerspectiveCamera(20, 1, 0.1, 10);
  const towards = new THREE.Vector3(...lights[0].direction);
  const pixels = new Uint8Array(4 * 64 * 64);
  const gl = renderer.getContext();
  window.seen = [[0, 1e-6], [0, 0.01], [120, 0.01]].map(([turn, exposure]) => {
    camera.lookAt(towards.clone().applyAxisAngle(new THREE.Vector3(0, 1, 0), turn * Math.PI / 180));
    renderer.toneMappingExposure = exposure;
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 64, 64, gl.RGBA, gl.UNSIGNED_BYTE, pixels);
    return Array.from(pixels);
  });
</script>"""


def test_three_js_shows_the_sun_of_a_map_where_the_json_says(
    folder: Path, opened_page: Callable[[str], Any]
) -> None:
    words = ["--for", "three", "--size", "512", "--sun-zenith", "55", "--sun-azimuth", "160"]
    quick = ["--wavelengths", "rgb", "--quality", "preview", "--sun", "include"]
    assert main(["sky", "earth", "-o", str(folder / "sky.exr"), *words, *quick]) == 0
    (folder / "sky.html").write_text(SKY_PAGE, encoding="utf-8")
    page = opened_page("sky.html")
    page.wait_for_function("window.seen !== undefined", timeout=120e3)
    seen = np.array(page.evaluate("window.seen"), float).reshape(3, 64, 64, 4)[..., :3]
    # at an exposure that shows the disc alone: it is in the middle, and nowhere else
    row, column = np.nonzero(seen[0].max(axis=-1) > 0.0)
    texel = 64 * (360.0 / 512) / 20.0
    assert_allclose([row.mean(), column.mean()], 31.5, atol=texel)
    assert row.size < 40.0 * texel
    # and the sky to its left is dimmer than the glow around it, but not dark
    glow, away = seen[1].mean(), seen[2].mean()
    assert 3.0 < away < 0.7 * glow
