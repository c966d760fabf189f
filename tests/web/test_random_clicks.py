"""Page of a planet that is clicked and touched at random: it lives, and shows what it is told."""

from __future__ import annotations

import base64
import io
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from gestures import Gestures, assert_sound, close_all, slide
from numpy.testing import assert_allclose
from PIL import Image
from waiting import PATIENCE, until

from airlight import load_planet, solve
from airlight.viewer.browser.page import page_text
from airlight.viewer.browser.page_data import page_data
from airlight.viewer.session.session import Session

WIDTH, HEIGHT = 160, 90
PHONE = {"width": 390, "height": 844}
SLIDER = "[data-path='view.look_zenith'] input[type=range]"
#: Number of gestures of the check of minutes; AIRLIGHT_CLICKS asks for more.
LONG = int(os.environ.get("AIRLIGHT_CLICKS", "200"))
COUNTS = (6, pytest.param(LONG, marks=pytest.mark.validation))


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Page of Mars without dust, whose air can be edited."""
    solution = solve(load_planet("mars-rayleigh"), [680, 550, 440], "preview", cache=False)
    session = Session("mars-rayleigh")
    session.move({"view.altitude": 4e5, "view.look_zenith": 105.0, "view.sun_zenith": 60.0})
    data = page_data(solution, "mars-rayleigh", "Mars", session.values, "three")
    assert data["solver"] is not None
    path = tmp_path_factory.mktemp("clicks") / "page.html"
    path.write_text(page_text("Mars", data), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def phone(chromium: Any, file: Path) -> Iterator[Any]:
    """The page on a phone, which is touched; fails at the end on any error in the page."""
    context = chromium.new_context(viewport=PHONE, has_touch=True, device_scale_factor=1)
    context.set_offline(True)
    page, faults = context.new_page(), []
    page.set_default_timeout(1e3 * PATIENCE)
    page.on("pageerror", lambda error: faults.append(str(error)))
    page.on("console", lambda m: faults.append(m.text) if m.type == "error" else None)
    page.goto(f"{file.as_uri()}?device=webgl2")
    yield page
    context.close()
    assert faults == []


def png(page: Any) -> np.ndarray:
    """Picture of the page. [0 to 255]"""
    text = page.evaluate(
        """async ([width, height]) => {
          await airlight.settled();
          const blob = await airlight.png(width, height);
          const bytes = new Uint8Array(await blob.arrayBuffer());
          return btoa(Array.from(bytes, (one) => String.fromCharCode(one)).join(""));
        }""",
        [WIDTH, HEIGHT],
    )
    image = Image.open(io.BytesIO(base64.b64decode(text)))
    return np.asarray(image.convert("RGB"), float)


def clicked(page: Any, act: Callable[[], None], press: Callable[[Any], None]) -> None:
    """Do something at random; then all is closed, undone by reset, and follows a slider again."""
    page.evaluate("airlight.ready.then(() => airlight.do('reset'))")
    first = png(page)
    assert first.max() > 60.0
    act()
    close_all(page)
    assert_sound(page)
    press(page.locator(".airlight-menu summary"))
    press(page.locator("[data-action=reset]"))
    until(page, "Object.entries(airlight.state.initial).every(([path, value]) =>"
                " airlight.state.get(path) === value)")  # fmt: skip
    # the picture of the beginning: none of what was done in between has stayed
    assert_allclose(png(page), first, atol=1.0)
    folded = page.locator(".airlight-controls details:not([open]) > summary:visible")
    while folded.count():
        press(folded.first)
    slider = page.locator(SLIDER)
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    before = page.evaluate("airlight.state.get('view.look_zenith')")
    page.mouse.click(box["x"] + 0.9 * box["width"], box["y"] + 0.5 * box["height"])
    until(page, f"airlight.state.get('view.look_zenith') > {before} + 20")
    assert np.abs(png(page) - first).mean() > 10.0
    assert_sound(page)


@pytest.mark.parametrize("count", COUNTS)
def test_random_clicks_leave_the_page_of_a_planet_alive(
    count: int, file: Path, opened_small: Callable[..., Any]
) -> None:
    page = opened_small(file, "?device=webgl2")
    clicked(page, lambda: Gestures(page, 12).by_mouse(count), lambda button: button.click())


@pytest.mark.validation
@pytest.mark.parametrize("count", COUNTS)
def test_random_touches_leave_the_page_of_a_planet_alive(count: int, phone: Any) -> None:
    clicked(phone, lambda: Gestures(phone, 7).by_fingers(count), lambda button: button.tap())
    assert phone.evaluate("visualViewport.scale") == 1.0


def test_fingers_on_the_panel_neither_zoom_nor_leave_the_page(phone: Any) -> None:
    phone.evaluate("airlight.ready")
    address = phone.url
    touches = phone.context.new_cdp_session(phone)
    slide(touches, [(180.0, 620.0), (200.0, 640.0)], [(20.0, 560.0), (370.0, 800.0)])
    assert phone.evaluate("visualViewport.scale") == 1.0
    for _ in range(2):
        slide(touches, [(20.0, 540.0)], [(380.0, 545.0)])
        phone.wait_for_timeout(300)
    assert phone.url.partition("#")[0] == address.partition("#")[0]
    assert phone.evaluate("airlight.state.get('view.altitude')") == 4e5
