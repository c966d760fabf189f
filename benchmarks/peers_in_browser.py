"""Time against error of skies made in a browser: takram's generator and this package, one Chromium.

    python benchmarks/peers_in_browser.py                # all of it, and a table
    python benchmarks/peers_in_browser.py --plot docs/images/peers-in-browser.png

``PrecomputedTexturesGenerator`` of @takram/three-atmosphere (by npm, the version that
``examples/engines/takram`` asks for) computes Bruneton's tables of its own default atmosphere,
which is our preset ``earth-bruneton``, scalar and unbent; its ``SkyMaterial`` draws skies into
targets of floats, which are read back. Ours are the page's solver in the same Chromium, and the
CPU and the GPU's passes without a browser. Errors are of radiance, against the moments solver's
``fine``, over the pixels of six views of the sky in three wavelengths: median, with the
quartiles as bars. The page's passes are those of the native device: its errors are read there.

CPU time is that of all processes of the browser. Ours are timed at their second run, shaders
and loops compiled, the page's as it is shipped, polarised. In software takram's generator takes two
minutes of CPU, so it runs once, with its shaders. Without npm or Chromium their cases are
left out, and a line says why.
"""

from __future__ import annotations

import argparse
import functools
import http.server
import json
import os
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

ROOT = Path(__file__).parents[1]
EXAMPLE = ROOT / "examples" / "engines" / "takram"
PLANET = "earth-bruneton"
WAVELENGTHS = (680.0, 550.0, 440.0)
WIDTH, HEIGHT = 32, 24
#: Views: altitude [m], sun's zenith angle and the view's bearing from it [deg].
VIEWS = [(2e3, sun, bearing) for sun in (30.0, 60.0, 85.0) for bearing in (0.0, 115.0)]
#: Height of the middle of a view, and its vertical field. [deg]
UP, FIELD = 28.6, 80.0
#: Quality of the reference.
REFERENCE = "fine"
#: WebGL2 on Mesa's llvmpipe.
FLAGS = (
    "--no-sandbox", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--disable-gpu-watchdog",
    "--disable-background-networking", "--no-first-run",
)  # fmt: skip
PAGE = """<!doctype html><link rel="icon" href="data:,"><script type="importmap">IMPORTS</script>
<script type="module">
  import * as THREE from "three";
  import {
    AtmosphereParameters, PrecomputedTexturesGenerator, SkyMaterial,
  } from "@takram/three-atmosphere";
  const renderer = new THREE.WebGLRenderer();
  const air = AtmosphereParameters.DEFAULT;
  const generator = new PrecomputedTexturesGenerator(renderer, { combinedScattering: false });
  const quad = new THREE.Mesh(new THREE.PlaneGeometry(2, 2));
  quad.frustumCulled = false;
  const scene = new THREE.Scene().add(quad);
  window.generate = async () => {
    const began = performance.now();
    await generator.update(air);
    const pixel = new Float32Array(4); // waits for the device
    renderer.readRenderTargetPixels(generator.transmittanceRenderTarget, 0, 0, 1, 1, pixel);
    renderer.getContext().finish();
    return performance.now() - began;
  };
  window.shoot = (views) => views.map(({ altitude, sun, bearing, height, field }) => {
    const sky = new SkyMaterial({ sun: false, moon: false, ground: false });
    Object.assign(sky, generator.textures);
    sky.correctAltitude = false;
    const target = new THREE.WebGLRenderTarget(WIDTH, HEIGHT, { type: THREE.FloatType });
    const camera = new THREE.PerspectiveCamera(field, WIDTH / HEIGHT, 1, 1e8);
    camera.up.set(0, 0, 1);
    camera.position.set(0, 0, air.bottomRadius + altitude);
    const level = Math.cos(height);
    const to = new THREE.Vector3(
      level * Math.cos(bearing), level * Math.sin(bearing), Math.sin(height));
    camera.lookAt(to.add(camera.position));
    camera.updateMatrixWorld();
    sky.sunDirection.set(Math.sin(sun), 0, Math.cos(sun));
    quad.material = sky;
    renderer.setRenderTarget(target);
    renderer.render(scene, camera);
    const pixels = new Float32Array(4 * WIDTH * HEIGHT);
    renderer.readRenderTargetPixels(target, 0, 0, WIDTH, HEIGHT, pixels);
    return [Array.from(pixels), air.skyRadianceToRelativeLuminance.toArray()];
  });
  window.ready = true;
</script>"""
#: Solves the page's planet again, with the optics of its last edit; milliseconds.
SOLVE_AGAIN = """async ([path, value]) => {
  await airlight.settled();
  const { edits, state } = airlight;
  state.set({ [path]: value });
  await edits.settled();
  const { solver } = edits;
  const light = solver.light.bind(solver);
  let air = null;
  solver.light = (given, ...others) => light((air = given), ...others);
  state.set({ [path]: 1.01 * value });
  await airlight.settled();
  window.again = async () => {
    const began = performance.now();
    await light(air, () => false);
    await airlight.device.finished();
    return performance.now() - began;
  };
}"""


def directions(bearing: float) -> np.ndarray:
    """Unit vectors of a view's pixels, the lowest row first, shape (pixels, 3); z is up."""
    tall = np.tan(np.radians(0.5 * FIELD))
    x = ((np.arange(WIDTH) + 0.5) / WIDTH * 2.0 - 1.0) * tall * WIDTH / HEIGHT
    y = ((np.arange(HEIGHT) + 0.5) / HEIGHT * 2.0 - 1.0) * tall
    height, around = np.radians(UP), np.radians(bearing)
    ahead = np.array(
        [np.cos(height) * np.cos(around), np.cos(height) * np.sin(around), np.sin(height)]
    )
    right = np.cross(ahead, [0.0, 0.0, 1.0]) / np.cos(height)
    out = ahead + x[:, None] * right + y[:, None, None] * np.cross(right, ahead)
    return np.asarray(out / np.linalg.norm(out, axis=-1, keepdims=True)).reshape(-1, 3)


def lines() -> list[tuple[float, float, np.ndarray]]:
    """Altitude, sun and directions above the horizon of each view; which, as a mask, follows."""
    return [(altitude, sun, directions(bearing)) for altitude, sun, bearing in VIEWS]


def radiances(solution: Any) -> np.ndarray:
    """Radiance along the lines of sight that do not meet the ground, shape (n, 3)."""
    found = []
    for altitude, sun, ray in lines():
        ray = ray[ray[:, 2] > 0.0]
        found.append(
            solution.radiance(
                altitude=altitude, sun_zenith=sun,
                view_zenith=np.degrees(np.arccos(ray[:, 2])),
                azimuth=np.degrees(np.arctan2(ray[:, 1], ray[:, 0])),
            ).values
        )  # fmt: skip
    return np.concatenate(found)


def processor_time(root: int) -> float:
    """CPU time of a process and all its descendants so far. [s]"""
    parents: dict[int, int] = {}
    times: dict[int, float] = {}
    for place in Path("/proc").glob("[0-9]*/stat"):
        try:
            fields = place.read_text().rpartition(")")[2].split()
        except OSError:
            continue
        number = int(place.parent.name)
        parents[number] = int(fields[1])
        times[number] = sum(map(int, fields[11:15])) / os.sysconf("SC_CLK_TCK")
    total = 0.0
    for number, spent in times.items():
        above = number
        while above not in (root, 0):
            above = parents.get(above, 0)
        total += spent if above == root else 0.0
    return total


def timed(call: Callable[[], Any], clock: Callable[[], float]) -> tuple[Any, float, float]:
    """Result of a call, its CPU time and its time. [s]"""
    spent, began = clock(), time.perf_counter()
    found = call()
    return found, clock() - spent, time.perf_counter() - began


Row = tuple[float, float, np.ndarray]


def processor(quality: str) -> Row:
    """Our solver on the CPU."""
    from airlight.planets.medium import Medium
    from airlight.solver.moments.solve import solve

    medium = Medium.from_planet(world(), WAVELENGTHS)
    settings = scalar(quality)
    solve(medium, scalar("preview"), cache=False)
    found, spent, took = timed(lambda: solve(medium, settings, cache=False), time.process_time)
    return spent, took, radiances(found)


def device(settings: Any) -> Row:
    """Our passes on the graphics device, without a browser."""
    from airlight.planets.medium import Medium
    from airlight.render.gpu.device.device import open_device
    from airlight.render.gpu.solver.solver import solve_on

    chosen, medium = open_device(), Medium.from_planet(world(), WAVELENGTHS)
    solve_on(chosen, medium, settings)
    found, spent, took = timed(lambda: solve_on(chosen, medium, settings), time.process_time)
    return spent, took, radiances(found)


def world() -> Any:
    from airlight import load_planet

    return replace(load_planet(PLANET), refraction="none")


def scalar(quality: str) -> Any:
    from airlight.solver.moments.settings import settings_for

    return replace(settings_for(quality), polarisation=False)


def in_page(browser: Any, clock: Callable[[], float], folder: Path) -> tuple[float, float]:
    """CPU time and time of the page's solver in the browser. [s]"""
    from airlight.planets.medium import Medium
    from airlight.solver.moments.solve import solve
    from airlight.viewer.browser.page import page_text
    from airlight.viewer.browser.page_data import page_data
    from airlight.viewer.session.session import Session

    planet = world()
    solution = solve(Medium.from_planet(planet, WAVELENGTHS), scalar("preview"))
    solution = solution.of(planet)
    data = page_data(solution, PLANET, PLANET, Session(PLANET).values, "three")
    file = folder / "page.html"
    file.write_text(page_text(PLANET, json.loads(json.dumps(data))), encoding="utf-8")
    page = browser.new_page()
    page.set_default_timeout(600_000)
    page.goto(f"{file.as_uri()}?device=webgl2")
    page.evaluate(SOLVE_AGAIN, ["air.ground", 0.1001])
    _, spent, took = timed(lambda: page.evaluate("again()"), clock)
    page.close()
    return spent, took


def takram(browser: Any, clock: Callable[[], float], folder: Path) -> Row:
    """Takram's generator in the browser, and the skies that its material draws."""
    shutil.copy(EXAMPLE / "package.json", folder)
    words = ["npm", "install", "--silent", "--no-audit", "--no-fund", "--legacy-peer-deps"]
    subprocess.run(words, cwd=folder, check=True, timeout=300)
    imports = (EXAMPLE / "index.html").read_text(encoding="utf-8")
    imports = imports.split('<script type="importmap">')[1].split("</script>")[0]
    text = PAGE.replace("IMPORTS", imports)
    text = text.replace("WIDTH", str(WIDTH)).replace("HEIGHT", str(HEIGHT))
    (folder / "takram.html").write_text(text, encoding="utf-8")
    handler = functools.partial(Quiet, directory=str(folder))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    page = browser.new_page()
    page.set_default_timeout(1_800_000)
    page.on("pageerror", lambda error: print(f"takram: {error}", file=sys.stderr))
    page.goto(f"http://127.0.0.1:{server.server_port}/takram.html")
    page.wait_for_function("window.ready")
    _, spent, took = timed(lambda: page.evaluate("generate()"), clock)
    views = [
        {
            "altitude": altitude, "sun": np.radians(sun), "bearing": np.radians(bearing),
            "height": np.radians(UP), "field": FIELD,
        }
        for altitude, sun, bearing in VIEWS
    ]  # fmt: skip
    found = []
    shots = page.evaluate("v => shoot(v)", views)
    for (pixels, factors), (_, _, ray) in zip(shots, lines(), strict=True):
        drawn = np.array(pixels).reshape(-1, 4)[:, :3] / factors
        found.append(drawn[ray[:, 2] > 0.0])
    page.close()
    server.shutdown()
    return spent, took, np.concatenate(found)


class Quiet(http.server.SimpleHTTPRequestHandler):
    """Server of the folder that prints nothing."""

    def log_message(self, *arguments: Any) -> None:
        pass


def quartiles(values: np.ndarray, truth: np.ndarray) -> np.ndarray:
    """Quartiles of the relative error. [%]"""
    return np.percentile(100.0 * np.abs(values / truth - 1.0), (25.0, 50.0, 75.0))


def with_browser(act: Callable[[Any, Callable[[], float], Path], Any]) -> Any:
    """Run a case in a Chromium of its own; a line of why not, where it cannot be."""
    program = os.environ.get("AIRLIGHT_CHROMIUM") or shutil.which("chromium")
    if program is None:
        return "no chromium (on Debian: apt-get install chromium)"
    try:
        from playwright.sync_api import sync_playwright
    except ImportError:
        return "no playwright (pip install playwright)"
    with tempfile.TemporaryDirectory() as name, sync_playwright() as play:
        browser = play.chromium.launch(executable_path=program, args=list(FLAGS))
        try:
            return act(browser, lambda: processor_time(os.getpid()) - time.process_time(),
                       Path(name))  # fmt: skip
        finally:
            browser.close()


def rows() -> dict[str, Callable[[], Row | str]]:
    """Cases by name."""
    from airlight.viewer.browser.page_solver import page_settings

    of_page = replace(page_settings(), polarisation=False)

    def page() -> Row | str:
        found = with_browser(in_page)
        return found if isinstance(found, str) else (*found, device(of_page)[2])

    def generator() -> Row | str:
        if shutil.which("npm") is None:
            return "takram is not installed, and there is no npm (on Debian: apt-get install npm)"
        try:
            return with_browser(takram)
        except subprocess.SubprocessError as fault:
            return f"takram is not installed: npm: {fault}"

    return {
        "airlight preview, processor": lambda: processor("preview"),
        "airlight default, processor": lambda: processor("default"),
        "airlight preview, lavapipe": lambda: device(scalar("preview")),
        "airlight default, lavapipe": lambda: device(scalar("default")),
        "airlight page, Chromium": page,
        "takram generator, Chromium": generator,
    }


def draw(found: dict[str, tuple[float, np.ndarray]], path: Path, load: float) -> None:
    """Plot the error against CPU time."""
    from airlight.studies.plots.figure import grid, new_figure, write_figure

    figure = new_figure(
        "Time against error: the sky of Bruneton's Earth, in a browser and beside it",
        f"Error of radiance against {REFERENCE}: median and quartiles, three wavelengths, suns "
        f"30° to 85°.\nProcessor time of two cores in software, at a load of {load:.0f}",
    )
    axes = figure.subplots()
    for marker, (name, (spent, error)) in zip("ospD^v", found.items(), strict=False):
        low, middle, high = error
        axes.errorbar(spent, middle, [[middle - low], [high - middle]], fmt=marker, label=name,
                      capsize=3)  # fmt: skip
    axes.set(xscale="log", yscale="log", xlabel="CPU time [s]", ylabel="error [%]")
    axes.legend(frameon=False, fontsize=8)
    grid(axes)
    with path.open("wb") as file:
        write_figure(figure, file)


def main() -> None:
    """Run the cases and print their table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="cases whose name contains this")
    parser.add_argument("--plot", type=Path)
    asked = parser.parse_args()
    truth = processor(REFERENCE)[2]
    found: dict[str, tuple[float, np.ndarray]] = {}
    print("| case | processor | clock | error: median (quartiles) | load |")
    print("|---|---|---|---|---|")
    for name, run in rows().items():
        if asked.only not in name:
            continue
        row = run()
        if isinstance(row, str):
            print(f"| {name} | not run: {row} |", flush=True)
            continue
        spent, took, values = row
        found[name] = spent, quartiles(values, truth)
        low, middle, high = found[name][1]
        print(
            f"| {name} | {spent:.2f} s | {took:.2f} s | {middle:.3f} ({low:.3f} to {high:.3f}) % "
            f"| {os.getloadavg()[0]:.1f} |",
            flush=True,
        )
    if asked.plot is not None:
        draw(found, asked.plot, os.getloadavg()[0])


if __name__ == "__main__":
    main()
