"""Viewer in JupyterLab, controlled by a real slider and by Python."""

from __future__ import annotations

import io
import json
import os
import re
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from importlib.util import find_spec
from typing import Any

import numpy as np
import pytest
from gestures import Gestures, assert_sound, close_all
from PIL import Image
from waiting import PATIENCE, until

for needed in ("jupyterlab", "anywidget"):  # to import them takes seconds, in each worker
    if find_spec(needed) is None:
        pytest.skip(f"no {needed}", allow_module_level=True)

_CELLS = (
    """from airlight.viewer.browser.notebook import Viewer
from airlight.viewer.session.session import Session
session = Session("mars")
session.set("light.quality", "preview")
session.set("light.wavelengths", "three")
session.set("display.automatic", False)
viewer = Viewer(session, height=400)
viewer""",
    """path = "view.look_zenith"
print("zenith", viewer.values[path], session.value(path))""",
    """viewer.set("display.exposure", -6.0)
viewer.set("view.heading", (viewer.values["view.sun_azimuth"] + 90.0) % 360.0)
viewer.set("view.look_zenith", 30.0)""",
    """viewer.close()""",
)

#: Number of gestures of the check of minutes; AIRLIGHT_CLICKS asks for more.
LONG = int(os.environ.get("AIRLIGHT_CLICKS", "200"))
#: The viewer in the page.
VIEWER = "document.querySelector('.airlight').parentElement.viewer"


@pytest.fixture(scope="module")
def lab(tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """URL of a new notebook in a running JupyterLab."""
    tmp_path = tmp_path_factory.mktemp("jupyterlab")
    cells = [
        {"cell_type": "code", "id": f"c{i}", "metadata": {}, "outputs": [], "source": text,
         "execution_count": None}
        for i, text in enumerate(_CELLS)
    ]  # fmt: skip
    notebook = {
        "cells": cells,
        "metadata": {"kernelspec": {"name": "python3", "display_name": "Python 3"}},
        "nbformat": 4,
        "nbformat_minor": 5,
    }
    room = tmp_path / "lab"
    room.mkdir()
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    own = {f"JUPYTER_{n}_DIR": str(tmp_path / n.lower()) for n in ("CONFIG", "DATA", "RUNTIME")}
    options = ["--no-browser", "--ServerApp.ip=127.0.0.1", f"--ServerApp.port={port}",
               "--IdentityProvider.token=", f"--ServerApp.root_dir={room}", "--allow-root",
               "--ServerApp.port_retries=0"]  # fmt: skip
    with (tmp_path / "lab.log").open("w") as log:
        server = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *options],
            stdout=log,
            stderr=log,
            env={**os.environ, **own, "JUPYTERLAB_SETTINGS_DIR": str(tmp_path / "settings")},
        )
    try:
        end = time.monotonic() + 120.0
        while True:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", port)) == 0:
                    break
            assert server.poll() is None, (tmp_path / "lab.log").read_text()
            assert time.monotonic() < end
            time.sleep(0.2)

        (room / "viewer.ipynb").write_text(json.dumps(notebook), encoding="utf-8")
        yield f"http://127.0.0.1:{port}/lab/tree/viewer.ipynb?reset"
    finally:
        server.terminate()
        server.wait(PATIENCE)


def run_cell(page: Any, index: int) -> Any:
    """Run one cell and return it."""
    cell = page.locator(".jp-Notebook .jp-CodeCell").nth(index)
    prompt = cell.locator(".jp-InputPrompt")
    end = time.monotonic() + PATIENCE
    # A kernel that has just started may not be connected yet.
    while not re.search(r"[*\d]", prompt.inner_text()):
        assert time.monotonic() < end
        # It then asks for the kernel.
        while page.locator(".jp-Dialog .jp-mod-accept").count():
            page.locator(".jp-Dialog .jp-mod-accept").first.click()
            page.wait_for_timeout(500)
        cell.locator(".cm-content").click()
        page.keyboard.press("Control+Enter")
        page.wait_for_timeout(1500)
    return cell


def seen(page: Any) -> np.ndarray:
    """Picture as shown on the screen."""
    page.evaluate("document.querySelector('.airlight').parentElement.viewer.settled()")
    shot = page.locator(".airlight canvas").screenshot()
    return np.asarray(Image.open(io.BytesIO(shot)).convert("RGB"), float)


@pytest.fixture(scope="module")
def notebook(lab: str, chromium: Any) -> Iterator[Any]:
    """Notebook in JupyterLab, whose first cell shows the viewer's first picture."""
    page = chromium.new_page(viewport={"width": 1200, "height": 900})
    page.set_default_timeout(1e3 * PATIENCE)
    page.goto(lab)
    page.locator(".jp-Notebook .jp-CodeCell").first.wait_for()
    until(page, "!!document.querySelector('.jp-Notebook-ExecutionIndicator[data-status=idle]')")
    run_cell(page, 0)
    page.locator(".airlight canvas").wait_for()
    until(page, "!!document.querySelector('.airlight').parentElement.viewer.drawn")
    yield page
    page.close()


#: What the first cell sets.
SET = ["light.quality", "light.wavelengths", "display.automatic"]
#: What the cells of the notebook hold.
CELLS = "[...document.querySelectorAll('.jp-CodeCell .cm-content')].map((one) => one.textContent)"


@pytest.mark.validation  # the page of a planet is clicked at random in each check
def test_random_clicks_leave_the_widget_alive(notebook: Any) -> None:
    faults: list[str] = []
    notebook.on("pageerror", lambda error: faults.append(str(error)))
    notebook.on("console", lambda m: faults.append(m.text) if m.type == "error" else None)
    notebook.evaluate(f"window.airlight = {VIEWER}")
    cells = notebook.evaluate(CELLS)
    start = notebook.evaluate("airlight.state.values")
    Gestures(notebook, 5, host=True).by_mouse(LONG)
    close_all(notebook)
    notebook.locator(".airlight-menu summary").click()
    notebook.locator("[data-action=reset]").click()
    # reset brings back all but what the cell had set, which is set again
    same = """([values, left]) => Object.entries(values).every(
      ([path, value]) => left.includes(path) || airlight.state.get(path) === value)"""
    end = time.monotonic() + PATIENCE
    while not notebook.evaluate(same, [start, SET]):
        assert time.monotonic() < end, notebook.evaluate("airlight.state.values")
        notebook.wait_for_timeout(100)
    for path in SET:
        notebook.evaluate("([path, value]) => airlight.state.set({ [path]: value })",
                          [path, start[path]])  # fmt: skip
    while not notebook.evaluate(same, [start, []]):
        assert time.monotonic() < end, notebook.evaluate("airlight.state.values")
        notebook.wait_for_timeout(100)
    until(notebook, "airlight.source.stale() === ''")
    assert_sound(notebook)
    folded = notebook.locator(".airlight details:not([open]) > summary:visible")
    while folded.count():
        folded.first.click()
    before = seen(notebook)  # JupyterLab may have opened a panel of its own beside it
    notebook.locator("[data-path='view.look_zenith'] input[type=text]").click()
    for key in ("Control+a", "3", "0", "Enter"):
        notebook.keyboard.press(key)
    until(notebook, "airlight.state.get('view.look_zenith') === 30")
    assert np.abs(seen(notebook) - before).mean() > 2.0
    assert_sound(notebook)
    assert notebook.evaluate(CELLS) == cells
    assert faults == []


@pytest.mark.slow
def test_slider_in_jupyterlab_moves_python_and_the_picture(
    notebook: Any, tell: Callable[[str], None]
) -> None:
    page = notebook
    before, cells = seen(page), page.evaluate(CELLS)

    slider = page.locator("[data-path='view.look_zenith'] input[type=range]")
    slider.focus()
    slider.press("Home")
    for _ in range(3):
        slider.press("PageUp")
    field = page.locator("[data-path='view.look_zenith'] input[type=text]")
    shown = float(field.input_value().removesuffix("°"))
    assert 0.0 < shown < 88.0
    # a key that is pressed in the widget is none of the notebook's, whose letters edit cells
    assert page.evaluate(CELLS) == cells
    # Python has the value, in the widget and in the session, once it has been sent
    cell = run_cell(page, 1)
    end = time.monotonic() + PATIENCE
    while True:
        cell.locator(".jp-OutputArea-output").wait_for()
        words = cell.locator(".jp-OutputArea-output").inner_text().split()
        if words == ["zenith", f"{shown:.1f}", f"{shown:.1f}"]:
            break
        assert time.monotonic() < end, words
        cell.locator(".cm-content").click()
        page.keyboard.press("Control+Enter")
        page.wait_for_timeout(1500)
    # and the picture has changed
    after = seen(page)
    assert np.abs(after - before).mean() > 2.0

    # without a GPU the kernel renders, and its frames follow what Python sets
    assert page.evaluate(f"{VIEWER}.device.kind") == "kernel"
    shown = page.evaluate(f"{VIEWER}.picture.number")
    run_cell(page, 2)
    until(page, "document.querySelector(\"[data-path='view.look_zenith'] input\").value === '30°'")
    began = time.monotonic()
    until(page, f"{VIEWER}.picture.number > {shown}")
    assert np.abs(seen(page) - after).mean() > 0.5
    took = time.monotonic() - began
    tell(f"JupyterLab: the picture follows viewer.set after {took:.1f} s, drawn by the kernel")

    # a polarising filter is clicked, and takes half of the light at the same exposure
    bright = seen(page)
    page.locator("[data-path='view.filter'] input[type=checkbox]").click()
    until(page, f"{VIEWER}.state.get('view.filter') === true")
    end = time.monotonic() + PATIENCE
    while not (dimmed := seen(page)).mean() < 0.9 * bright.mean():
        assert time.monotonic() < end, (dimmed.mean(), bright.mean())


@pytest.mark.slow
def test_a_closed_widget_leaves_the_page(notebook: Any) -> None:
    run_cell(notebook, 3)
    until(notebook, "!document.querySelector('.airlight')")
