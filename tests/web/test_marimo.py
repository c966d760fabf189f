"""Viewer in marimo, controlled by a real slider and by Python."""

from __future__ import annotations

import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import pytest
from waiting import PATIENCE

from airlight.kernel import cache_folder

for needed in ("marimo", "anywidget"):  # to import them takes seconds, in each worker
    if find_spec(needed) is None:
        pytest.skip(f"no {needed}", allow_module_level=True)

_NOTEBOOK = """
import marimo

app = marimo.App()


@app.cell
def _():
    import marimo as mo
    from airlight.viewer.browser.notebook import Viewer
    from airlight.viewer.session.session import Session

    session = Session("mars")
    session.set("light.quality", "preview")
    session.set("light.wavelengths", "three")
    viewer = mo.ui.anywidget(Viewer(session, height=300, device="webgl2"))
    viewer
    return mo, session, viewer


@app.cell
def _(mo, session, viewer):
    _path = "view.look_zenith"
    mo.md(f"<b id=said>{viewer.value['values'][_path]} {session.value(_path)}</b>")
    return


@app.cell
def _(mo, viewer):
    mo.ui.button(label="up", on_click=lambda _: viewer.widget.set("view.look_zenith", 30.0))
    return


if __name__ == "__main__":
    app.run()
"""


@pytest.fixture
def served(tmp_path: Path) -> Iterator[str]:
    """URL of a running notebook."""
    file = tmp_path / "viewer.py"
    file.write_text(_NOTEBOOK, encoding="utf-8")
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    options = ["--headless", "--host", "127.0.0.1", "--port", str(port), "--no-token"]
    own = {"HOME": str(tmp_path), "XDG_CONFIG_HOME": str(tmp_path), "XDG_STATE_HOME": str(tmp_path)}
    own["AIRLIGHT_CACHE"] = str(cache_folder())  # a folder of its own would be filled for a minute
    with (tmp_path / "marimo.log").open("w") as log:
        server = subprocess.Popen(
            [sys.executable, "-m", "marimo", "run", str(file), *options],
            stdout=log,
            stderr=log,
            cwd=tmp_path,
            env={**os.environ, **own},
        )
    try:
        end = time.monotonic() + 120.0
        while True:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    break
            assert server.poll() is None, (tmp_path / "marimo.log").read_text()
            assert time.monotonic() < end
            time.sleep(0.2)
        yield f"http://127.0.0.1:{port}"
    finally:
        server.terminate()
        server.wait(PATIENCE)


@pytest.mark.slow
def test_slider_in_marimo_moves_python_and_python_the_slider(served: str, chromium: Any) -> None:
    page = chromium.new_page(viewport={"width": 1200, "height": 900})
    page.set_default_timeout(120_000)
    page.goto(served)
    page.locator(".airlight canvas").wait_for()
    said = page.locator("#said")
    said.wait_for()
    assert [float(x) for x in said.inner_text().split()] == [88.0, 88.0]
    slider = page.locator("[data-path='view.look_zenith'] input[type=range]")
    field = page.locator("[data-path='view.look_zenith'] input[type=text]")
    slider.focus()
    slider.press("Home")
    for _ in range(3):
        slider.press("PageUp")
    shown = float(field.input_value().removesuffix("°"))
    assert 0.0 < shown < 88.0
    end = time.monotonic() + PATIENCE
    while [float(x) for x in said.inner_text().split()] != [shown, shown]:
        assert time.monotonic() < end, said.inner_text()
        page.wait_for_timeout(200)
    # the solution comes from a thread, and is drawn
    page.locator(".airlight-status", has_text="preview").wait_for()

    page.get_by_role("button", name="up").click()
    end = time.monotonic() + PATIENCE
    while field.input_value() != "30°":
        assert time.monotonic() < end, field.input_value()
        page.wait_for_timeout(200)

    # behind a filter the probe tells degree and angle of the light before it
    page.locator("[data-path='view.filter'] input[type=checkbox]").click()
    box = page.locator(".airlight canvas").bounding_box()
    reported = page.locator(".airlight-probe")
    found, end = None, time.monotonic() + PATIENCE
    while found is None:
        assert time.monotonic() < end, reported.inner_text()
        page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.3 * box["height"])
        page.wait_for_timeout(200)
        page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.31 * box["height"])
        found = re.search(r"polarised ([\d.]+) % at (-?[\d.]+)°", reported.inner_text())
    assert 0.0 <= float(found[1]) <= 100.0
    assert -90.0 <= float(found[2]) <= 90.0
    page.close()
