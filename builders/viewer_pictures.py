"""Remake the pictures of window, page and notebook in ``docs/images``.

Run with ``python builders/viewer_pictures.py``, or with the names of the pictures wanted:
``window-probe``, ``window-date``, ``window-compare``, ``page-400km``, ``notebook-marimo``. The
window is drawn offscreen; page and notebook need Chromium and playwright, the notebook marimo too.
"""

from __future__ import annotations

import argparse
import io
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from PIL import Image

from airlight.render.gpu.device.device import open_device
from airlight.render.solve_planet import live_solver
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.window.canvas import OffscreenCanvas
from airlight.viewer.window.start import Start, opened, renderer_by
from airlight.viewer.window.window import Window

FOLDER = Path(__file__).parents[1] / "docs" / "images"
WINDOW, PAGE = (1280, 720), (960, 540)
#: Limit of one picture, in software and on a busy machine. [s]
PATIENCE = 600.0
#: WebGL2 by Mesa where there is no GPU, as in tests/web.
FLAGS = ("--no-sandbox", "--use-angle=gl-egl", "--ignore-gpu-blocklist", "--disable-gpu-watchdog")
#: Mars in marimo, and the value of a slider in Python below it.
NOTEBOOK = """
import marimo

app = marimo.App()


@app.cell
def _():
    import marimo as mo
    from airlight.viewer.browser.notebook import Viewer
    from airlight.viewer.session.session import Session

    session = Session("mars")
    session.set("light.quality", "preview")
    viewer = mo.ui.anywidget(Viewer(session, height=420, device="webgl2"))
    viewer
    return mo, session, viewer


@app.cell
def _(mo, session, viewer):
    path = "view.look_zenith"
    mo.md(f"<b id=said>{viewer.value['values'][path]} {session.value(path)}</b>")
    return


if __name__ == "__main__":
    app.run()
"""


def keep(name: str, picture: Image.Image) -> None:
    """Write a picture into the documentation."""
    file = FOLDER / f"{name}.png"
    picture.convert("RGB").save(file, optimize=True)
    print(f"{file.name}  {picture.width}x{picture.height}  {file.stat().st_size / 1e3:.0f} kB")


def wait(ready: Callable[[], Any], pause: Callable[[], object]) -> None:
    """Pause until something is ready."""
    until = time.monotonic() + PATIENCE
    while not ready():
        if time.monotonic() > until:
            raise SystemExit(f"not finished after {PATIENCE:.0f} s")
        pause()


def window(
    name: str, view: Mapping[str, Value], look: tuple[float, float], tab: str, *, other: str = ""
) -> None:
    """Picture of the window with a tab open; alone with the probe, or beside another planet."""
    canvas = OffscreenCanvas(WINDOW)
    device = open_device()
    view = {"light.quality": "preview", **view}
    start = Start(planet="earth", view=view, look=look, size=WINDOW)
    made = Window(
        opened(start), canvas, device.device, renderer_by("auto", device),
        live_solver("auto", device),
    )  # fmt: skip

    def drawn() -> bool:
        canvas.run(made.draw)
        return bool(made.settled) and made.shown() is not None and not canvas.wanted

    try:
        if other:
            made.panel.compare_with(other)
        made.panel.opens, made.panel.probes = tab, not other
        wait(drawn, lambda: time.sleep(0.02))
        if not other:
            into = made.picture_rectangle()
            made.click(into.left + 0.5 * into.width, into.top + 0.4 * into.height)
            wait(drawn, lambda: time.sleep(0.02))
        for _ in range(2):  # panels reach their final sizes one frame later
            canvas.run(made.draw)
        assert canvas.picture is not None
        keep(name, Image.fromarray(canvas.picture))
    finally:
        made.close()


@contextmanager
def browser_page(size: tuple[int, int]) -> Iterator[Any]:
    """Page of a headless Chromium."""
    from playwright.sync_api import sync_playwright

    program = os.environ.get("AIRLIGHT_CHROMIUM") or shutil.which("chromium")
    with sync_playwright() as play:
        browser = play.chromium.launch(executable_path=program, headless=True, args=list(FLAGS))
        page = browser.new_page(viewport={"width": size[0], "height": size[1]})
        page.set_default_timeout(1e3 * PATIENCE)
        yield page
        browser.close()


def exported_page(name: str) -> None:
    """Picture of a page: Earth from 400 km."""
    from airlight.viewer.browser.page import export_page

    view = {"view.altitude": 400e3, "view.latitude": 38.0, "view.longitude": 12.0,
            "view.look_zenith": 112.0, "view.heading": 60.0,
            "view.field_of_view": 75.0}  # fmt: skip
    with tempfile.TemporaryDirectory() as folder, browser_page(PAGE) as page:
        file = Path(folder) / "earth.html"
        export_page("earth", file, view=view, wavelengths="four")
        page.goto(f"{file.as_uri()}?device=webgl2")
        page.evaluate("airlight.settled()")
        keep(name, Image.open(io.BytesIO(page.screenshot())))


def notebook(name: str) -> None:
    """Picture of a widget in marimo."""
    with tempfile.TemporaryDirectory() as folder, browser_page((900, 560)) as page:
        file = Path(folder) / "viewer.py"
        file.write_text(NOTEBOOK, encoding="utf-8")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        command = [sys.executable, "-m", "marimo", "run", str(file), "--headless", "--no-token",
                   "--host", "127.0.0.1", "--port", str(port)]  # fmt: skip
        server = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        def answers() -> bool:
            with socket.socket() as probe:
                return probe.connect_ex(("127.0.0.1", port)) == 0

        try:
            wait(answers, lambda: time.sleep(0.2))
            page.goto(f"http://127.0.0.1:{port}")
            page.locator("#said").wait_for()
            page.locator(".airlight-status", has_text="webgl2").wait_for()
            page.locator(".airlight-status", has_text="preview").wait_for()
            seen: list[bytes] = []

            def rests() -> bool:
                box = page.locator(".airlight").bounding_box()
                clip = {"x": box["x"] - 10, "y": box["y"] - 10, "width": box["width"] + 20,
                        "height": box["height"] + 70}  # fmt: skip
                seen.append(page.screenshot(clip=clip))
                return len(seen) > 1 and seen[-1] == seen[-2]

            wait(rests, lambda: page.wait_for_timeout(5000))
            keep(name, Image.open(io.BytesIO(seen[-1])))
        finally:
            server.terminate()
            server.wait(60)


PICTURES: dict[str, Callable[[str], None]] = {
    "window-probe": lambda name: window(
        name, {"view.altitude": 400e3, "view.sun_zenith": 75.0}, (113.8, 60.0), "View"
    ),
    "window-date": lambda name: window(
        name,
        {"view.hour": 19.5, "view.latitude": 59.33, "view.longitude": 18.07, "view.altitude": 2.0},
        (88.0, 0.0),
        "View",
    ),
    "window-compare": lambda name: window(
        name,
        {"view.altitude": 1.529e7, "view.sun_zenith": 35.0, "view.sun_azimuth": 250.0},
        (180.0, 110.0),  # north above
        "Compare",
        other="mars",
    ),
    "page-400km": exported_page,
    "notebook-marimo": notebook,
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("names", nargs="*", metavar="PICTURE", help=", ".join(PICTURES))
    for name in parser.parse_args().names or PICTURES:
        PICTURES[name](name)


if __name__ == "__main__":
    main()
