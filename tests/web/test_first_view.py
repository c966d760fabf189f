"""What a page shows before its scripts have drawn a picture, and when they have."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image

from airlight import load_planet, render, solve
from airlight.viewer.browser.page import LARGEST_PICTURE, first_picture, page_text
from airlight.viewer.browser.page_data import page_data
from airlight.viewer.browser.page_subject import SIDE
from airlight.viewer.parameters.view_parameters import scene_of
from airlight.viewer.session.session import Session

#: Script before all others: whether the first picture has stood in the viewer, however short.
WITNESS = """<script>
new MutationObserver(() => {
  window.stood ||= document.querySelector(".airlight-view .airlight-first") !== null;
}).observe(document, { childList: true, subtree: true });
</script>"""


@pytest.fixture(scope="module")
def text() -> str:
    """Page of Mars without dust from above, where a picture has a dark and a bright part."""
    solution = solve(load_planet("mars-rayleigh"), [680, 550, 440], "preview")
    session = Session("mars-rayleigh")
    session.move({"view.altitude": 4e5, "view.look_zenith": 105.0, "view.sun_zenith": 60.0})
    data = page_data(solution, "mars-rayleigh", "Mars", session.values, "three")
    frame = render(solution, scene_of(session.values, SIDE, SIDE))
    return page_text("Mars", data, first_picture(frame, session.values))


def test_the_picture_is_small_and_of_the_view(text: str) -> None:
    address = text.partition('src="data:image/webp;base64,')[2].partition('"')[0]
    assert 0 < len(address) <= LARGEST_PICTURE
    pixels = np.asarray(Image.open(io.BytesIO(base64.b64decode(address))).convert("L"), float)
    high = pixels.shape[0] // 4
    assert pixels.shape[0] == pixels.shape[1]
    assert pixels[:high].mean() < 20.0 < 60.0 < pixels[-high:].mean()  # space above the ground


def test_without_scripts_the_page_shows_its_picture(
    text: str, chromium: Any, tmp_path: Path
) -> None:
    # The scripts never run: what is seen stands in the page itself.
    file = tmp_path / "page.html"
    file.write_text(text, encoding="utf-8")
    context = chromium.new_context(
        java_script_enabled=False, viewport={"width": 700, "height": 400}
    )
    page = context.new_page()
    page.goto(file.as_uri())
    shown = np.asarray(Image.open(io.BytesIO(page.screenshot())).convert("L"), float)[:, 320:]
    context.close()
    assert shown[-80:-60, :200].mean() > 60.0
    assert shown[:60].mean() < 20.0


def test_the_first_picture_takes_its_place(
    text: str, opened: Callable[..., Any], tmp_path: Path
) -> None:
    file = tmp_path / "page.html"
    file.write_text(text.replace("<body>", f"<body>{WITNESS}", 1), encoding="utf-8")
    page = opened(file, "?device=webgl2")
    page.evaluate("airlight.settled()")
    page.wait_for_selector(".airlight-first", state="detached")
    page.wait_for_selector(".airlight-progress", state="detached")
    assert page.evaluate("window.stood")


def test_shaders_are_counted_as_they_are_compiled(modules: Callable[..., Any]) -> None:
    # Three passes by two shaders, on a device that compiles them one after the other.
    page = modules({"drawing/program": ("Program",)})
    reported = page.evaluate(
        """async () => {
          const passes = [["a", "sky"], ["b", "sky"], ["c", "picture"]].map(([name, entry]) => ({
            name, entry, shader: "one", vertex: "corners", reads: {}, targets: [], uniforms: "0/0",
          }));
          let turn = Promise.resolve();
          const device = { pipeline: () => (turn = turn.then(() => ({}))) };
          const program = new Program(device, { passes, size: 1 }, { one: { glsl: {} } });
          const reported = [];
          await program.build((done, total) => reported.push([done, total]));
          return reported;
        }"""
    )
    assert reported == [[1, 2], [2, 2]]
