"""Viewer in a page opened from disk, on both back ends, with a painted sky."""

from __future__ import annotations

import base64
import io
import json
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import painted
import pytest
from numpy.testing import assert_allclose
from PIL import Image
from waiting import PATIENCE, until

from airlight.scene.directions import camera_axes
from airlight.viewer.browser.page import page_text

WIDTH, HEIGHT = 160, 90
VIEW = {
    "view.altitude": 100.0,
    "view.latitude": 10.0,
    "view.longitude": 20.0,
    "view.look_zenith": 80.0,
    "view.heading": 200.0,
    "view.roll": 10.0,
    "view.field_of_view": 70.0,
    "view.projection": "perspective",
    "view.sun_zenith": 60.0,
    "view.sun_azimuth": 180.0,
    "view.dehaze": 0.0,
    "display.automatic": False,
    "display.exposure": 0.5,
    "display.tone_map": "hable",
    "light.orders": "all",
}
_GROUPS = {"view": "camera", "display": "display", "light": "light"}
_RANGES = {
    "view.altitude": (0.0, 1e12, "log"),
    "view.latitude": (-90.0, 90.0, "linear"),
    "view.longitude": (-180.0, 180.0, "wraps"),
    "view.look_zenith": (0.0, 180.0, "linear"),
    "view.heading": (0.0, 360.0, "wraps"),
    "view.roll": (-180.0, 180.0, "wraps"),
    "view.field_of_view": (1e-3, 360.0, "linear"),
    "view.sun_zenith": (0.0, 180.0, "linear"),
    "view.sun_azimuth": (0.0, 360.0, "wraps"),
    "display.exposure": (-100.0, 100.0, "linear"),
}


def parameters() -> list[dict[str, Any]]:
    """Sufficient part of the declared list."""
    made = []
    for path, value in VIEW.items():
        low, high, scale = _RANGES.get(path, (0.0, 1.0, "linear"))
        kind = {bool: "switch", str: "choice"}.get(type(value), "number")
        made.append({
            "path": path, "label": path.split(".")[1], "group": _GROUPS[path.split(".")[0]],
            "help": "-", "kind": kind, "unit": "1", "low": max(low, 1.0) if scale == "log" else low,
            "high": high, "least": low, "most": high, "step": 1.0, "wraps": scale == "wraps",
            "scale": "log" if scale == "log" else "linear", "mode": "standard", "part_of": "",
            "options": [value] if kind == "choice" else [],
        })  # fmt: skip
    return made


@pytest.fixture
def file(tmp_path: Path) -> Path:
    """Page with a painted sky in a file."""
    data = {
        "title": "painted", "planet": "painted", "parameters": parameters(), "values": VIEW,
        "note": "nothing to edit", "picture": painted.page(),
    }  # fmt: skip
    place = tmp_path / "page.html"
    place.write_text(page_text("painted <sky>", data), encoding="utf-8")
    return place


def png(page: Any, width: int = WIDTH, height: int = HEIGHT) -> np.ndarray:
    """Picture of the page, drawn at a size. [0 to 255]"""
    url = page.evaluate(
        """async ([width, height]) => {
          const blob = await airlight.png(width, height);
          const reader = new FileReader();
          await new Promise((resolve) => { reader.onload = resolve; reader.readAsDataURL(blob); });
          return reader.result;
        }""",
        [width, height],
    )
    image = Image.open(io.BytesIO(base64.b64decode(url.partition(",")[2])))
    return np.asarray(image.convert("RGB"), np.float64)


def expected(view: dict[str, Any]) -> np.ndarray:
    """Same picture by NumPy. [0 to 255]"""
    azimuth = view["view.heading"] - view["view.sun_azimuth"]
    axes = camera_axes(view["view.look_zenith"], azimuth, view["view.roll"])
    field, exposure = view["view.field_of_view"], view["display.exposure"]
    return 255.0 * painted.picture(axes, WIDTH, HEIGHT, field, exposure)


def assert_same_picture(got: np.ndarray, wanted: np.ndarray) -> None:
    """Assert equality up to rounding, except for a few pixels on an edge between two colours."""
    assert got.shape == wanted.shape
    off = np.abs(got - wanted).max(axis=2) > 1.0
    assert off.mean() < 0.01
    assert_allclose(np.median(np.abs(got - wanted)), 0.0, atol=0.6)


@pytest.mark.parametrize("device", ["webgpu", "webgl2"])
def test_page_from_disk_shows_the_picture(
    device: str, file: Path, opened: Callable[..., Any]
) -> None:
    # a second method: the same picture by NumPy; top and bottom, left and right are distinct
    page = opened(file, f"?device={device}")
    assert_same_picture(png(page), expected(VIEW))
    assert page.title() == "painted <sky>"
    assert page.evaluate("airlight.device.kind") == device


def test_slider_moves_the_picture_and_the_address(file: Path, opened: Callable[..., Any]) -> None:
    page = opened(file)
    png(page)
    slider = page.locator("[data-path='view.look_zenith'] input[type=range]")
    slider.focus()
    for _ in range(3):
        slider.press("ArrowRight")
    zenith = page.evaluate("airlight.state.get('view.look_zenith')")
    assert zenith > VIEW["view.look_zenith"]
    assert_same_picture(png(page), expected({**VIEW, "view.look_zenith": zenith}))
    # The address follows a moment after the last change, so an earlier press may stand there.
    until(page, "location.href === airlight.source.link(airlight.state.asFragment())")
    again = opened(file, page.evaluate("location.hash"))
    assert_same_picture(png(again), expected({**VIEW, "view.look_zenith": zenith}))
    again.locator(".airlight-menu summary").click()
    again.get_by_role("button", name="reset", exact=True).click()
    assert_same_picture(png(again), expected(VIEW))
    again.get_by_role("button", name="undo", exact=True).click()
    assert again.evaluate("airlight.state.get('view.look_zenith')") == zenith


def test_drag_keys_and_wheel_move_the_camera(file: Path, opened: Callable[..., Any]) -> None:
    page = opened(file)
    png(page)
    box = page.locator("canvas").bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]

    def now() -> dict[str, Any]:
        return page.evaluate("airlight.state.values")

    page.mouse.move(x, y)
    page.mouse.down()
    page.mouse.move(x + 60, y + 30, steps=4)
    page.mouse.up()
    # the sky follows the mouse: dragged right the camera turns left, dragged down it looks up
    after = now()
    assert after["view.heading"] < VIEW["view.heading"]
    assert after["view.look_zenith"] < VIEW["view.look_zenith"]
    page.mouse.wheel(0, 200)
    until(page, "airlight.state.get('view.altitude') > 100")
    page.keyboard.down("w")
    until(page, f"airlight.state.get('view.latitude') !== {VIEW['view.latitude']}")
    page.keyboard.up("w")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    page.keyboard.press("Control+z")
    assert now() == VIEW


def test_still_picture_costs_nothing(file: Path, opened: Callable[..., Any]) -> None:
    page = opened(file)
    png(page)
    # within the limit there are 700 ms in which nothing is drawn; a loop has none
    drawn = """async () => {
      await airlight.settled();
      const before = airlight.loop.frames;
      await new Promise((resolve) => setTimeout(resolve, 700));
      return airlight.loop.frames - before;
    }"""
    end = time.monotonic() + PATIENCE
    while page.evaluate(drawn):
        assert time.monotonic() < end


@pytest.mark.parametrize("device", ["webgpu", "webgl2"])
def test_a_lost_device_is_replaced_by_another(
    device: str, file: Path, opened: Callable[..., Any]
) -> None:
    # as when a driver is restarted: the view, its history and its keys go on
    page = opened(file, f"?device={device}")
    png(page)
    page.evaluate("airlight.state.set({'view.look_zenith': 85})")
    lose = "const { device, gl } = airlight.device; window.lost = airlight;"
    lose += "device ? device.destroy() : gl.getExtension('WEBGL_lose_context').loseContext()"
    page.evaluate(lose)
    until(page, "airlight !== lost && airlight.device && airlight.drawn")
    assert page.evaluate("airlight.device.kind") == "webgl2"
    assert_same_picture(png(page), expected({**VIEW, "view.look_zenith": 85.0}))
    assert "was lost" in page.evaluate("airlight.parts.note.textContent")
    assert page.locator("canvas").count() == 1
    page.locator("canvas").focus()
    page.keyboard.press("Control+z")
    assert page.evaluate("airlight.state.get('view.look_zenith')") == VIEW["view.look_zenith"]


def test_page_without_a_device_says_so(file: Path, opened: Callable[..., Any]) -> None:
    page = opened(file, "?device=none")
    until(page, "document.querySelector('.airlight-message').textContent !== ''")
    assert "neither WebGPU nor WebGL2" in page.locator(".airlight-message").text_content()


def test_page_carries_all_that_it_needs(file: Path) -> None:
    # nothing to load: no URL except the namespaces of the embedded data
    text = file.read_text(encoding="utf-8")
    for word in ("http://", "https://", "import(", "fetch(", "XMLHttpRequest"):
        assert word not in text, word
    data = text.partition('id="airlight-data">')[2].partition("</script>")[0]
    assert json.loads(data)["title"] == "painted"


@pytest.mark.parametrize("device", ["webgpu", "webgl2"])
def test_probe_tells_the_light_of_the_pixel_that_is_pointed_at(
    device: str, file: Path, opened: Callable[..., Any]
) -> None:
    # a second method: the painted sky in NumPy, and the two sums by hand
    page = opened(file, f"?device={device}")
    png(page)
    page.evaluate("airlight.settled()")
    width, height = page.evaluate("airlight.drawn")
    box = page.locator("canvas").bounding_box()
    page.mouse.move(box["x"] + 0.25 * box["width"], box["y"] + 0.7 * box["height"])
    until(page, "document.querySelector('.airlight-probe').textContent !== ''")
    words = page.locator(".airlight-probe").inner_text().replace(",", "").split()
    azimuth = VIEW["view.heading"] - VIEW["view.sun_azimuth"]
    axes = camera_axes(VIEW["view.look_zenith"], azimuth, VIEW["view.roll"])
    light = painted.picture(axes, width, height, VIEW["view.field_of_view"], 0.0)
    rgb = light[int(0.7 * height), int(0.25 * width)]
    xyz = rgb @ np.array(painted.program()["xyz"])
    # three digits, and three decimals
    assert_allclose(float(words[1]), 683.0 * xyz[1], rtol=5e-3)
    assert_allclose([float(words[4]), float(words[6])], xyz[:2] / xyz.sum(), atol=6e-4)
    # a click keeps the point, wherever one points then, until its text is clicked
    read = page.locator(".airlight-probe")
    page.mouse.click(box["x"] + 0.25 * box["width"], box["y"] + 0.7 * box["height"])
    kept = read.inner_text()
    page.mouse.move(box["x"] + 0.6 * box["width"], box["y"] + 0.1 * box["height"])
    page.evaluate("airlight.settled()")
    page.wait_for_timeout(300)
    assert read.inner_text() == kept
    assert page.locator(".airlight-mark").is_visible()
    read.click()
    assert not page.locator(".airlight-mark").is_visible()
