"""Keys of the table, pressed in a page: each has the effect of its row."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import painted
import pytest
from numpy.testing import assert_allclose
from waiting import until

from airlight.viewer.browser.page import page_text
from airlight.viewer.browser.page_data import page_parameters
from airlight.viewer.navigation.flight import Flight
from airlight.viewer.navigation.keys import as_json
from airlight.viewer.navigation.viewpoints import VIEWPOINTS, view_of
from airlight.viewer.navigation.viewpoints import as_json as viewpoints
from airlight.viewer.parameters.view_parameters import DEFAULTS
from airlight.viewer.session.session import Session

RADIUS, THICKNESS = 6.36e6, 1e5
TABLE = as_json("page")
START = {**DEFAULTS, "view.altitude": 1000.0, "view.latitude": 10.0, "display.automatic": False,
         "display.glare": 0.0}  # fmt: skip
#: Value that a held key moves, by its axis.
MOVES = {
    "ahead": "view.latitude",  # the camera looks south
    "right": "view.longitude",
    "up": "view.altitude",
    "turn": "view.heading",
    "tilt": "view.look_zenith",
    "widen": "view.field_of_view",
}
#: Names of the keys in the browser's driver.
NAMES = {"arrowup": "ArrowUp", "arrowdown": "ArrowDown", "arrowleft": "ArrowLeft",
         "arrowright": "ArrowRight", "pageup": "PageUp", "pagedown": "PageDown"}  # fmt: skip


@pytest.fixture(scope="module")
def shared(kept_wide: Callable[..., Any], tmp_path_factory: pytest.TempPathFactory) -> Any:
    """Page with a painted sky, opened once."""
    data = {
        "title": "keys", "planet": "painted", "note": "",
        "parameters": [one.as_json() for one in page_parameters()],
        "values": {one.path: START[one.path] for one in page_parameters()},
        "picture": {**painted.page(), "radius": RADIUS,
                    "viewpoints": viewpoints(RADIUS, RADIUS + THICKNESS)},
    }  # fmt: skip
    file = tmp_path_factory.mktemp("keys") / "keys.html"
    file.write_text(page_text("keys", data), encoding="utf-8")
    page = kept_wide(file, "?device=webgl2")
    page.evaluate("airlight.ready")
    return page


@pytest.fixture
def page(shared: Any) -> Any:
    """The page as it began, with the keyboard focus."""
    shared.evaluate(
        """() => {
          const { state, flight, parts, controls } = airlight;
          flight.release();
          if (flight.playing) flight.play();
          Object.assign(state, { other: null, showing: "A", sharesCamera: true });
          state.reset();
          Object.assign(state.history, { done: [], undone: [] });
          parts.help.hidden = true;
          parts.probe.hidden = false;
          parts.root.classList.remove("airlight-hidden");
          parts.search.value = "";
          controls.search("");
          parts.canvas.focus({ preventScroll: true });
        }"""
    )
    return shared


def now(page: Any, path: str) -> Any:
    return page.evaluate("(path) => airlight.state.get(path)", path)


@pytest.mark.parametrize("axis", MOVES)
def test_held_keys_move_their_way(axis: str, page: Any) -> None:
    # the window's flight, advanced by one step, gives the direction
    keys = {key: way for key, way in TABLE["held"].items() if way[0] == axis}
    assert {sign for _, sign in keys.values()} == {-1.0, 1.0}
    for key in keys:
        session = Session("earth-atmosphere-plus")
        for path, value in START.items():
            session.set(path, value)
        flight = Flight(session)
        assert flight.press(key)
        flight.step(0.05)
        wanted = session.value(MOVES[axis]) - START[MOVES[axis]]
        page.evaluate("airlight.state.reset()")
        page.keyboard.down(NAMES.get(key, key))
        until(page, f"airlight.state.get('{MOVES[axis]}') !== {START[MOVES[axis]]}")
        page.keyboard.up(NAMES.get(key, key))
        got = now(page, MOVES[axis]) - START[MOVES[axis]]
        assert got * wanted > 0.0, key
        # once released, it stands still, and the movement was one undo step
        assert page.evaluate("airlight.flight.moving") is False
        page.keyboard.press("Control+z")
        assert now(page, MOVES[axis]) == START[MOVES[axis]]


@pytest.mark.parametrize("factor", TABLE["factors"])
def test_keys_that_change_the_speed(factor: str, page: Any) -> None:
    # the logarithm of the altitude grows by 0.8 per second, times the factor; equal time steps
    def climbed() -> float:
        return page.evaluate(
            """() => {
              const { flight, state } = airlight;
              const before = state.get("view.altitude") + 5;
              flight.now = 0;
              flight.advance(50);
              return Math.log((state.get("view.altitude") + 5) / before);
            }"""
        )

    # only the test's frames
    page.evaluate("airlight.kept = airlight.flight.request")
    page.evaluate("airlight.flight.request = () => {}")
    page.keyboard.down("e")
    plain = climbed()
    page.keyboard.down(factor.capitalize())
    changed = climbed()
    page.keyboard.up(factor.capitalize())
    page.keyboard.up("e")
    page.evaluate("airlight.flight.request = airlight.kept")
    assert_allclose(plain, 0.8 * 0.05, rtol=1e-9)
    assert_allclose(changed, plain * TABLE["factors"][factor], rtol=1e-9)


def test_keys_that_do_something_once(page: Any) -> None:
    # the effect of each is visible; all keys of the table are pressed
    left = dict(TABLE["once"])

    def press(key: str) -> str:
        page.keyboard.press(key)
        return left.pop(key)

    for index, viewpoint in enumerate(VIEWPOINTS):
        assert press(str(index + 1)) == f"viewpoint {index + 1}"
        view = view_of(viewpoint, bottom_radius=RADIUS, top_radius=RADIUS + THICKNESS)
        for path, value in view.items():
            assert_allclose(now(page, path), value, rtol=1e-12, err_msg=path)
    press("Control+z")
    assert_allclose(now(page, "view.altitude"), 2.4 * RADIUS)
    press("Control+y")
    assert now(page, "view.sun_zenith") == 89.0
    page.keyboard.press("Control+z")
    press("Control+Shift+z")
    assert now(page, "view.sun_zenith") == 89.0
    press("Home")
    assert (now(page, "view.look_zenith"), now(page, "view.sun_zenith")) == (180.0, 89.0)
    page.keyboard.press("Control+z")
    for key, stops in (("+", 1), ("=", 1), ("Shift+=", 1), ("Shift++", 1), ("-", -1)):
        before = now(page, "display.exposure")
        press(key)
        assert_allclose(now(page, "display.exposure") - before, stops / 3.0, err_msg=key)
    press("x")
    assert now(page, "display.automatic") is True
    assert now(page, "display.exposure") == 0.0
    press("t")
    until(page, "airlight.state.get('view.sun_zenith') !== 89")
    page.keyboard.press("t")
    assert page.evaluate("airlight.flight.playing") is False
    press("b")
    assert page.evaluate("airlight.state.hasOther") is True
    press("v")
    assert page.evaluate("airlight.state.showing") == "B"
    press("p")
    assert page.evaluate("airlight.parts.probe.hidden") is True
    for key in ("F1", "h"):
        press(key)
        assert page.locator(".airlight-help").is_visible() is (key == "F1")
    press("Tab")
    assert page.locator(".airlight-panel").is_visible() is False
    page.keyboard.press("h")
    press("Escape")  # one thing at a time, the topmost first
    assert page.locator(".airlight-help").is_visible() is False
    assert page.locator(".airlight-panel").is_visible() is False
    page.keyboard.press("Escape")
    assert page.locator(".airlight-panel").is_visible() is True
    page.evaluate("airlight.settled()")  # a key that waits 5 s for a frame may not fill the screen
    press("f")
    until(page, "document.fullscreenElement === airlight.parts.root")
    page.keyboard.press("f")
    until(page, "document.fullscreenElement === null")
    page.evaluate("airlight.parts.canvas.focus()")
    press("u")
    until(page, "airlight.parts.note.textContent.startsWith('copied: ')")
    link = page.evaluate("airlight.parts.note.textContent").removeprefix("copied: ")
    assert link.startswith("file://")
    assert page.evaluate("(link) => link.endsWith(airlight.state.asFragment())", link)
    page.evaluate("airlight.parts.canvas.focus()")
    press("o")
    assert page.evaluate("airlight.film !== null")
    page.keyboard.down("l")
    until(page, "(airlight.film.recorder.requestData(), airlight.film.parts.length)")
    page.keyboard.up("l")
    with page.expect_download() as download:
        page.keyboard.press("o")
    assert download.value.suggested_filename == "keys.webm"
    assert Path(download.value.path()).read_bytes()[:4] == bytes.fromhex("1a45dfa3")  # EBML
    with page.expect_download() as download:
        press("Control+s")
    assert download.value.suggested_filename == "keys.png"
    assert left == {}


def test_keys_stay_with_what_is_typed_or_slid(page: Any) -> None:
    # a field takes letters, a slider arrow keys; the picture is unchanged
    field = page.locator("[data-path='view.altitude'] input[type=text]")
    field.click()
    page.keyboard.type("w3")
    assert now(page, "view.latitude") == START["view.latitude"]
    page.keyboard.press("Escape")
    slider = page.locator("[data-path='view.roll'] input[type=range]")
    slider.focus()
    slider.press("ArrowRight")
    assert now(page, "view.roll") > 0.0
    assert now(page, "view.latitude") == START["view.latitude"]
    assert page.evaluate("airlight.flight.moving") is False


def test_help_lists_the_table(page: Any) -> None:
    # the same rows, in the same order
    page.locator(".airlight-menu summary").click()
    page.locator("[data-action=help]").click()
    shown = page.evaluate(
        """[...document.querySelectorAll(".airlight-help > div")].map((group) => [
          group.querySelector("h3").textContent,
          [...group.querySelectorAll("tr")].map((row) =>
            [...row.children].map((cell) => cell.textContent)),
        ])"""
    )
    assert shown == TABLE["help"]


def test_any_drag_with_ctrl_or_shift_moves_the_sun(page: Any) -> None:
    # fractions of the picture's width are fractions of the field of view, as in the window
    box = page.locator("canvas").bounding_box()
    x, y = box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"]
    for modifier, button in (("Shift", "left"), ("Control", "left"), ("", "right")):
        page.evaluate("airlight.state.reset()")
        if modifier:
            page.keyboard.down(modifier)
        page.mouse.move(x, y)
        page.mouse.down(button=button)
        page.mouse.move(x + 0.25 * box["width"], y)
        page.mouse.up(button=button)
        if modifier:
            page.keyboard.up(modifier)
        moved = now(page, "view.sun_azimuth") - START["view.sun_azimuth"]
        assert_allclose(moved, 0.25 * 60.0, rtol=1e-6, err_msg=modifier)
        assert now(page, "view.heading") == START["view.heading"]


def test_wheel_climbs_by_notches_and_with_ctrl_widens(page: Any) -> None:
    # 2.6 per notch, with Shift four times as much, with Alt a quarter; a field of view 1.15
    box = page.locator("canvas").bounding_box()
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    for modifier, path, wanted in (
        ("", "view.altitude", 1005.0 * 2.6 - 5.0),
        ("Shift", "view.altitude", 1005.0 * 2.6**4 - 5.0),
        ("Alt", "view.altitude", 1005.0 * 2.6**0.25 - 5.0),
        ("Control", "view.field_of_view", 60.0 * 1.15),
    ):
        page.evaluate("airlight.state.reset()")
        if modifier:
            page.keyboard.down(modifier)
        page.mouse.wheel(0, 100)
        until(page, f"airlight.state.get('{path}') !== {START[path]}")
        if modifier:
            page.keyboard.up(modifier)
        assert_allclose(now(page, path), wanted, rtol=1e-9, err_msg=modifier)


def test_fifteen_clicks_of_the_wheel_lead_to_space(page: Any) -> None:
    # from the ground to 10 000 km
    box = page.locator("canvas").bounding_box()
    page.evaluate("airlight.state.set({ 'view.altitude': 2 })")
    page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + 0.5 * box["height"])
    for _ in range(15):
        before = now(page, "view.altitude")
        page.mouse.wheel(0, 100)
        until(page, f"airlight.state.get('view.altitude') > {before}")
    assert now(page, "view.altitude") > 1e7


def test_a_flick_keeps_its_last_movement(page: Any) -> None:
    # the release is elsewhere than the last movement that was told
    wanted = page.evaluate(
        """() => {
          const { canvas } = airlight.parts;
          const box = canvas.getBoundingClientRect();
          const tell = (name, x) => canvas.dispatchEvent(new PointerEvent(name, {
            pointerId: 1, clientX: box.left + x, clientY: box.top + 50,
          }));
          canvas.setPointerCapture = () => {};
          tell("pointerdown", 100);
          tell("pointermove", 110);
          tell("pointerup", 100 + box.width / 10);
          delete canvas.setPointerCapture;
          return 0.1 * airlight.state.get("view.field_of_view");
        }"""
    )
    turned = START["view.heading"] - now(page, "view.heading")
    assert_allclose(turned, wanted, rtol=1e-3)  # near the horizon, where headings are not wider
    assert page.evaluate("airlight.flight.state.canUndo")


def test_search_finds_what_people_say_and_escape_ends_it(page: Any) -> None:
    field = page.locator(".airlight-search")
    field.click()
    page.keyboard.type("zoom")
    rows = page.locator("[data-path]")
    assert rows.evaluate_all("all => all.map((one) => one.dataset.path)") == ["view.field_of_view"]
    page.keyboard.press("Escape")
    assert field.input_value() == ""
    assert rows.count() == len(page_parameters())
    page.keyboard.type("no such thing")
    assert page.locator(".airlight-none").is_visible()
    page.keyboard.press("Escape")
    page.keyboard.press("Escape")
    assert page.evaluate("document.activeElement === airlight.parts.canvas")
