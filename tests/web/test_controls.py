"""Every control of the page, clicked and touched for real, at the sizes of screens and phones."""

from __future__ import annotations

import json
import os
import random
from collections.abc import Callable, Iterator
from typing import Any

import painted
import pytest
from numpy.testing import assert_allclose
from waiting import PATIENCE, until

from airlight.planets import load_planet
from airlight.viewer.browser.page import page_parameters
from airlight.viewer.browser.page_solver import MOST
from airlight.viewer.browser.page_text import page_text
from airlight.viewer.navigation.viewpoints import as_json as viewpoints
from airlight.viewer.parameters.amounts import amounts_of
from airlight.viewer.parameters.view_parameters import DEFAULTS

RADIUS = 6.36e6
#: Viewports: screens, and a phone.
SIZES = ((1280, 720), (800, 600), (390, 844))
PHONE = {"width": 390, "height": 844}
#: Number of random clicks; AIRLIGHT_CLICKS asks for more.
CLICKS = int(os.environ.get("AIRLIGHT_CLICKS", "60"))
#: Buttons that leave the page or ask the browser.
ASIDE = ("save picture", "film", "copy link", "fullscreen")


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Page with a painted sky, and the controls of a planet with a long list of amounts."""
    amounts = amounts_of(load_planet("earth-volcanic"), MOST)
    # the painted sky has no glare
    view = [one for one in page_parameters() if one.path != "display.glare"]
    parameters = (*amounts, *view)
    values = {one.path: DEFAULTS[one.path] for one in view}
    data = {
        "title": "Earth after an eruption – airlight", "planet": "painted",
        "note": "Amounts and the ground are edited here.",
        "parameters": [one.as_json() for one in parameters],
        "values": {**values, **{one.path: one.present for one in amounts}},
        "picture": {**painted.page(), "radius": RADIUS,
                    "viewpoints": viewpoints(RADIUS, RADIUS + 1e5)},
    }  # fmt: skip
    # the painted sky knows these
    for one in data["parameters"]:
        if one["path"] == "display.tone_map":
            one["options"] = [one["options"][0], "hable"]
    place = tmp_path_factory.mktemp("controls") / "page.html"
    place.write_text(page_text("controls", json.loads(json.dumps(data))), encoding="utf-8")
    return place


@pytest.fixture(scope="module")
def shared(kept_wide: Callable[..., Any], file: Any) -> Any:
    page = kept_wide(file, "?device=webgl2")
    page.evaluate("airlight.ready")
    return page


@pytest.fixture
def page(shared: Any) -> Any:
    """The page in its first size and state."""
    shared.set_viewport_size({"width": 1280, "height": 720})
    shared.evaluate("airlight.state.reset(); airlight.parts.help.hidden = true")
    shared.evaluate("airlight.parts.root.classList.remove('airlight-hidden')")
    return shared


@pytest.fixture
def phone(chromium: Any, file: Any) -> Iterator[Any]:
    """The page on a phone, which is touched."""
    context = chromium.new_context(viewport=PHONE, has_touch=True, device_scale_factor=2)
    page = context.new_page()
    page.set_default_timeout(1e3 * PATIENCE)
    page.goto(f"{file.as_uri()}?device=webgl2")
    page.evaluate("airlight.ready")
    yield page
    context.close()


#: Elements whose text leaves its box, and those that leave the panel.
MISFITS = """() => {
  const { root } = airlight.parts;
  const panel = root.querySelector(".airlight-panel").getBoundingClientRect();
  const found = [];
  for (const details of root.querySelectorAll("details")) details.open = true;
  for (const one of root.querySelectorAll(
    ".airlight-label, .airlight-panel button, .airlight-row input, .airlight-row select, " +
    ".airlight-title, .airlight-note, .airlight-status, summary, .airlight-search")) {
    if (one.hidden) continue;
    const box = one.getBoundingClientRect();
    const name = one.textContent || one.ariaLabel || one.className;
    if (one.scrollWidth > one.clientWidth + 1 && one.type !== "range") found.push(`cut: ${name}`);
    if (box.width < 1 || box.left < panel.left - 1 || box.right > panel.right + 1)
      found.push(`outside: ${name}`);
  }
  if (root.scrollWidth > root.clientWidth) found.push("the page scrolls");
  return found;
}"""


@pytest.mark.parametrize("size", SIZES, ids=lambda one: f"{one[0]}x{one[1]}")
def test_labels_and_numbers_fit(size: tuple[int, int], page: Any) -> None:
    # as laid out by the browser; numbers of six digits are the longest
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.evaluate("airlight.state.set({ 'view.altitude': 123456.7, 'view.latitude': -12.3457 })")
    assert page.evaluate(MISFITS) == []
    box = page.locator("canvas").bounding_box()
    assert box["width"] * box["height"] > 0.3 * size[0] * size[1]


def test_every_control_changes_its_value(page: Any) -> None:
    # a click on a slider at a third or two thirds of it, an option, a box; undo takes each back
    rows = page.evaluate(
        """() => [...airlight.controls.rows].map(([path, { element }]) => [
          path, airlight.state.parameters.get(path).kind])"""
    )
    assert {path for path, _ in rows} == set(page.evaluate("[...airlight.state.parameters.keys()]"))
    get = "(path) => airlight.state.get(path)"
    for path, kind in rows:
        row = page.locator(f'[data-path="{path}"]')
        row.scroll_into_view_if_needed()
        before = page.evaluate(get, path)
        if kind == "number":
            slider = row.locator("input[type=range]")
            box = slider.bounding_box()
            share = float(slider.input_value()) / 1000.0
            x = box["width"] * (0.3 if share > 0.5 else 0.7)
            slider.click(position={"x": x, "y": 0.5 * box["height"]})
        elif kind == "choice":
            options = page.evaluate("(path) => airlight.state.parameters.get(path).options", path)
            other = next((one for one in options if one != before), None)
            if other is None or path == "view.projection":  # the painted sky has one
                continue
            row.locator("select").select_option(other)
        else:
            row.locator("input").click()
        after = page.evaluate(get, path)
        assert after != before, path
        page.evaluate("airlight.state.rest()")
        page.locator("[data-action=undo]").click()
        assert page.evaluate(get, path) == before, path
    page.evaluate("airlight.settled()")
    assert page.evaluate("airlight.parts.message.textContent") == ""


def test_typed_numbers_and_escape(page: Any) -> None:
    field = page.locator('[data-path="air.turbidity"] input[type=text]')
    field.click()
    field.fill("4")
    page.keyboard.press("Enter")
    assert_allclose(page.evaluate("airlight.state.get('air.turbidity')"), 4.0, rtol=1e-6)
    field.fill("9")
    page.keyboard.press("Escape")  # as before, and back to the picture
    assert_allclose(page.evaluate("airlight.state.get('air.turbidity')"), 4.0, rtol=1e-6)
    assert page.evaluate("document.activeElement === airlight.parts.canvas")


def test_every_button_is_pressed(page: Any) -> None:
    for button in page.locator("[data-action]").all():
        action = button.get_attribute("data-action")
        if action in ASIDE or button.is_disabled() or not button.is_visible():
            continue
        button.click()
        assert page.evaluate("airlight.parts.message.textContent") == "", action
        if action == "help":
            assert page.locator(".airlight-help").is_visible()
            page.keyboard.press("Escape")
    page.evaluate("airlight.flight.playing && airlight.flight.play()")
    assert page.evaluate("airlight.state.hasOther") is True
    page.locator(".airlight-fold").click()
    assert not page.locator(".airlight-panel").is_visible()
    page.locator(".airlight-fold").click()
    assert page.locator(".airlight-panel").is_visible()


def test_a_phone_hides_the_panel_and_turns_by_touch(phone: Any) -> None:
    # half the screen is panel, until a finger folds it; one finger turns, two fly
    get = "(path) => airlight.state.get(path)"
    assert phone.locator("canvas").bounding_box()["height"] > 0.4 * PHONE["height"]
    slider = phone.locator('[data-path="air.amounts[1]"] input[type=range]')
    before = phone.evaluate(get, "air.amounts[1]")
    slider.scroll_into_view_if_needed()
    slider.tap(position={"x": 40, "y": 16})
    assert phone.evaluate(get, "air.amounts[1]") != before
    phone.locator(".airlight-fold").tap()
    box = phone.locator("canvas").bounding_box()
    assert box["height"] == PHONE["height"]
    touches = phone.context.new_cdp_session(phone)

    def touch(kind: str, *points: tuple[float, float]) -> None:
        at = [{"x": x, "y": y, "id": index} for index, (x, y) in enumerate(points)]
        touches.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": at})

    heading, zenith = (phone.evaluate(get, f"view.{one}") for one in ("heading", "look_zenith"))
    touch("touchStart", (200, 400))
    for step in range(1, 5):
        touch("touchMove", (200 + 20 * step, 400 + 10 * step))
    touch("touchEnd")
    until(phone, f"airlight.state.get('view.heading') !== {heading}")
    assert phone.evaluate(get, "view.look_zenith") < zenith
    altitude = phone.evaluate(get, "view.altitude")
    touch("touchStart", (150, 400), (250, 400))
    for step in range(1, 5):  # fingers that close fly away from the ground
        touch("touchMove", (150 + 9 * step, 400), (250 - 9 * step, 400))
    touch("touchEnd")
    until(phone, f"airlight.state.get('view.altitude') > {altitude}")
    phone.locator(".airlight-fold").tap()
    assert phone.locator(".airlight-panel").is_visible()


def test_random_clicks_leave_the_page_alive(page: Any) -> None:
    clicked(page, CLICKS, seed=12)


def clicked(page: Any, count: int, seed: int) -> None:
    """Click at random, anywhere, with drags and keys; the page still draws and reacts."""
    chance = random.Random(seed)
    width, height = 1280, 720
    for _ in range(count):
        x, y = chance.uniform(1, width - 1), chance.uniform(1, height - 1)
        what = chance.random()
        page.mouse.move(x, y)
        if what < 0.7:
            page.mouse.click(x, y, button=chance.choice(["left", "left", "left", "right"]))
        elif what < 0.9:
            page.mouse.down()
            page.mouse.move(chance.uniform(1, width - 1), chance.uniform(1, height - 1), steps=3)
            page.mouse.up()
        else:
            page.mouse.wheel(0, chance.choice([-300, 300]))
        page.keyboard.press("Escape")
    page.evaluate("airlight.flight.release(); airlight.flight.playing && airlight.flight.play()")
    if page.evaluate("document.fullscreenElement !== null"):
        page.evaluate("document.exitFullscreen()")
    page.evaluate("airlight.film && airlight.toggleFilm()")
    page.evaluate("airlight.settled()")
    assert page.evaluate("airlight.parts.message.textContent") == ""
    frames = page.evaluate("airlight.loop.frames")
    page.evaluate("airlight.parts.canvas.focus()")
    heading = page.evaluate("airlight.state.get('view.heading')")
    page.keyboard.down("l")
    until(page, f"airlight.state.get('view.heading') !== {heading}")
    page.keyboard.up("l")
    until(page, f"airlight.loop.frames > {frames}")
