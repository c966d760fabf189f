"""Every control of the page, clicked and touched for real, at the sizes of screens and phones."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import painted
import pytest
from gestures import Gestures, close_all
from numpy.testing import assert_allclose
from waiting import PATIENCE, until

from airlight.planets import load_planet
from airlight.viewer.browser.page import page_text
from airlight.viewer.browser.page_data import page_parameters
from airlight.viewer.browser.page_solver import MOST
from airlight.viewer.navigation.viewpoints import as_json as viewpoints
from airlight.viewer.parameters.amounts import amounts_of
from airlight.viewer.parameters.view_parameters import DEFAULTS

RADIUS = 6.36e6
AXES = ("latitude", "longitude")
#: Viewports: screens, and a phone.
SIZES = ((1280, 720), (800, 600), (390, 844))
PHONE = {"width": 390, "height": 844}
#: Number of random clicks; AIRLIGHT_CLICKS asks for more.
CLICKS = int(os.environ.get("AIRLIGHT_CLICKS", "60"))


@pytest.fixture(scope="module")
def file(tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Page with a painted sky, and the controls of a planet with a long list of amounts."""
    amounts = amounts_of(load_planet("earth-volcanic"), MOST)
    # the painted sky has no glare
    view = [one for one in page_parameters() if one.path != "display.glare"]
    parameters = (*amounts, *view)
    values = {one.path: DEFAULTS[one.path] for one in view}
    data = {
        "title": "Earth after an eruption – airlight", "planet": "painted", "body": "earth",
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
    """The page in its first state, of a size that software draws fast."""
    shared.set_viewport_size({"width": 800, "height": 450})
    shared.evaluate("airlight.state.reset(); airlight.parts.help.hidden = true")
    shared.evaluate("airlight.parts.root.classList.remove('airlight-hidden')")
    return shared


@pytest.fixture(scope="module")
def touched(chromium: Any, file: Any) -> Iterator[Any]:
    context = chromium.new_context(viewport=PHONE, has_touch=True, device_scale_factor=1)
    page = context.new_page()
    page.set_default_timeout(1e3 * PATIENCE)
    page.goto(f"{file.as_uri()}?device=webgl2")
    page.evaluate("airlight.ready")
    yield page
    context.close()


@pytest.fixture
def phone(touched: Any) -> Any:
    """The page in its first state on a phone, which is touched."""
    touched.evaluate("airlight.state.reset(); airlight.parts.help.hidden = true")
    return touched


@pytest.fixture(params=["mouse", pytest.param("finger", marks=pytest.mark.validation)])
def used(request: pytest.FixtureRequest) -> tuple[Any, Callable[..., None]]:
    """The page, and what presses a control of it, at a place: the mouse, or a finger."""
    if request.param == "mouse":
        return request.getfixturevalue("page"), lambda one, **at: one.click(**at)
    return request.getfixturevalue("phone"), lambda one, **at: one.tap(**at)


#: Elements whose text leaves its box, and those that leave the panel.
MISFITS = """() => {
  const { root } = airlight.parts;
  const panel = root.querySelector(".airlight-panel").getBoundingClientRect();
  const found = [];
  for (const details of root.querySelectorAll("details")) details.open = true;
  for (const one of root.querySelectorAll(
    ".airlight-label, .airlight-panel button, .airlight-row input, .airlight-row select, " +
    ".airlight-title, .airlight-note, .airlight-status, summary, .airlight-search, " +
    ".airlight-destinations, .airlight-date input")) {
    if (!one.checkVisibility()) continue;
    const box = one.getBoundingClientRect();
    const name = one.textContent || one.ariaLabel || one.className;
    if (one.scrollWidth > one.clientWidth + 1 && one.type !== "range") found.push(`cut: ${name}`);
    if (box.width < 1 || box.left < panel.left - 1 || box.right > panel.right + 1)
      found.push(`outside: ${name}`);
  }
  root.querySelector(".airlight-menu").open = false;
  if (root.scrollWidth > root.clientWidth) found.push("the page scrolls");
  return found;
}"""


#: Controls that a finger would miss: less than 44 pixels high, without their labels.
SMALL = """() => [...airlight.parts.root.querySelectorAll("button, select, summary, input")]
  .filter((one) => one.checkVisibility() && one.type !== "checkbox")
  .filter((one) => one.getBoundingClientRect().height < 43.9)
  .map((one) => one.textContent || one.ariaLabel || one.type)"""


@pytest.mark.parametrize("size", SIZES, ids=lambda one: f"{one[0]}x{one[1]}")
def test_labels_and_numbers_fit(size: tuple[int, int], page: Any) -> None:
    # as laid out by the browser; numbers of six digits are the longest
    page.set_viewport_size({"width": size[0], "height": size[1]})
    page.evaluate("airlight.state.set({ 'view.altitude': 123456.7, 'view.latitude': -12.3457 })")
    assert page.evaluate(MISFITS) == []
    box = page.locator("canvas").bounding_box()
    assert box["width"] * box["height"] > 0.3 * size[0] * size[1]


@pytest.mark.usefixtures("chromium")  # by another of its fixtures, which is chosen when it runs
def test_every_control_changes_its_value(used: tuple[Any, Callable[..., None]]) -> None:
    # a slider at a third or two thirds of it, an option, a box; undo takes each back
    page, press = used
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
            press(slider, position={"x": x, "y": 0.5 * box["height"]})
        elif kind == "choice":
            options = page.evaluate("(path) => airlight.state.parameters.get(path).options", path)
            other = next((one for one in options if one != before), None)
            if other is None or path == "view.projection":  # the painted sky has one
                continue
            row.locator("select").select_option(other)
        else:
            press(row.locator("input"))
        after = page.evaluate(get, path)
        assert after != before, path
        page.evaluate("airlight.state.rest()")
        press(page.locator("[data-action=undo]"))
        assert page.evaluate(get, path) == before, path
    page.evaluate("airlight.settled()")
    assert page.evaluate("airlight.parts.message.textContent") == ""


def test_the_calendar_sets_the_sun_of_a_day(page: Any) -> None:
    # 2026-12-21 14:30 UTC is day 355 of the year
    date, clock = (page.locator(f".airlight-date input[type={one}]") for one in ("date", "time"))
    date.fill("2026-12-21")
    date.press("Enter")
    clock.fill("14:30")
    get = "['year', 'day', 'hour', 'clock'].map((one) => airlight.state.get(`view.${one}`))"
    assert page.evaluate(get) == [2026, 355, 14.5, True]
    page.evaluate("airlight.parts.canvas.focus(); airlight.state.set({'view.hour': 23.9999})")
    assert (date.input_value(), clock.input_value()) == ("2026-12-21", "23:59")


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


@pytest.mark.usefixtures("chromium")
def test_every_button_does_what_it_says(used: tuple[Any, Callable[..., None]]) -> None:
    # those that are left at the end have been forgotten here
    page, press = used
    left = set(page.evaluate("[...document.querySelectorAll('[data-action]')]"
                             ".map((one) => one.dataset.action)"))  # fmt: skip

    def press_action(action: str) -> None:
        button = page.locator(f'[data-action="{action}"]')
        if not button.is_visible():
            press(page.locator(".airlight-menu summary"))
        button.scroll_into_view_if_needed()
        press(button)
        assert not page.evaluate("document.querySelector('.airlight-menu').open")

    def pressed(action: str, effect: str) -> None:
        press_action(action)
        until(page, effect, 60.0)
        assert page.evaluate("airlight.parts.message.textContent") == "", action
        left.discard(action)

    def saved(action: str) -> bytes:
        with page.expect_download() as download:
            press_action(action)
        left.discard(action)
        name = download.value.suggested_filename
        assert page.locator(".airlight-done").inner_text().startswith(f"saved as {name}, ")
        return Path(download.value.path()).read_bytes()

    destinations = page.locator(".airlight-destinations")
    for index, one in enumerate(viewpoints(RADIUS, RADIUS + 1e5)):
        destinations.select_option(f"viewpoint {index + 1}")
        view = page.evaluate("airlight.state.values")
        assert {path: view[path] for path in one["view"]} == one["view"]
    destinations.select_option("Nairobi")
    place = [page.evaluate(f"airlight.state.get('view.{one}')") for one in AXES]
    assert_allclose(place, [-1.28, 36.82], rtol=1e-9)
    destinations.select_option("viewpoint 4")
    altitude = page.evaluate("airlight.state.get('view.altitude')")
    pressed("undo", f"airlight.state.get('view.altitude') !== {altitude}")
    pressed("redo", f"airlight.state.get('view.altitude') === {altitude}")
    pressed("reset", "Object.entries(airlight.state.initial)"
                     ".every(([path, value]) => airlight.state.get(path) === value)")  # fmt: skip
    pressed("keep as b", "airlight.state.hasOther")
    for showing in "BA":
        pressed("swap", f"airlight.state.showing === '{showing}'")
    for shared in ("false", "true"):
        pressed("one camera", f"airlight.state.sharesCamera === {shared}")
    left.discard("advanced")  # it is shown for planets that have such parameters
    for shown in ("false", "true"):
        pressed("help", f"airlight.parts.help.hidden === {shown}")
    zenith = page.evaluate("airlight.state.get('view.sun_zenith')")
    pressed("time", f"airlight.state.get('view.sun_zenith') !== {zenith}")
    pressed("time", "!airlight.flight.playing")
    pressed("fullscreen", "document.fullscreenElement === airlight.parts.root")
    pressed("fullscreen", "document.fullscreenElement === null")
    assert saved("save picture").startswith(b"\x89PNG")
    pressed("film", "airlight.film !== null")
    page.wait_for_timeout(300)  # of film
    assert saved("film").startswith(bytes.fromhex("1a45dfa3"))  # EBML
    assert page.evaluate("airlight.film === null")
    pressed("copy link", "airlight.parts.note.textContent.startsWith('copied: ')")
    link = page.evaluate("airlight.parts.note.textContent").removeprefix("copied: ")
    search = page.locator(".airlight-search")
    press(search)
    page.keyboard.press("Control+v")
    assert search.input_value() == link
    assert left == set()
    # search and its groups, and the panel
    search.fill("sun")
    rows = page.locator(".airlight-row:visible")
    until(page, "airlight.controls.words === 'sun'")
    assert 0 < rows.count() < page.evaluate("airlight.state.parameters.size")
    search.fill("")
    for summary in page.locator("summary:visible").all():
        is_open = "(one) => one.parentElement.open"
        before = summary.evaluate(is_open)
        press(summary)
        assert summary.evaluate(is_open) is not before
        press(summary)
        assert summary.evaluate(is_open) is before
    for hidden in (True, False):
        press(page.locator(".airlight-fold"))
        assert page.locator(".airlight-panel").is_visible() is not hidden


def test_a_phone_hides_the_panel_and_turns_by_touch(phone: Any) -> None:
    # half the screen is panel, until a finger folds it; one finger turns, two fly
    get = "(path) => airlight.state.get(path)"
    assert phone.locator("canvas").bounding_box()["height"] > 0.4 * PHONE["height"]
    slider = phone.locator('[data-path="air.amounts[1]"] input[type=range]')
    before = phone.evaluate(get, "air.amounts[1]")
    slider.scroll_into_view_if_needed()
    slider.tap(position={"x": 40, "y": 16})
    assert phone.evaluate(get, "air.amounts[1]") != before
    phone.locator("[data-action=undo]").tap()
    assert phone.evaluate(get, "air.amounts[1]") == before
    automatic = phone.evaluate(get, "display.automatic")
    box = phone.locator('[data-path="display.automatic"] input')
    box.scroll_into_view_if_needed()
    box.tap()
    assert phone.evaluate(get, "display.automatic") is not automatic
    small = phone.evaluate(SMALL)
    assert small == [], small
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
    # and the page still draws and reacts
    Gestures(page, seed=12).by_mouse(CLICKS)
    close_all(page)
    page.evaluate("airlight.settled()")
    assert page.evaluate("airlight.parts.message.textContent") == ""
    frames = page.evaluate("airlight.loop.frames")
    page.evaluate("airlight.parts.canvas.focus()")
    heading = page.evaluate("airlight.state.get('view.heading')")
    page.keyboard.down("l")
    until(page, f"airlight.state.get('view.heading') !== {heading}")
    page.keyboard.up("l")
    until(page, f"airlight.loop.frames > {frames}")
