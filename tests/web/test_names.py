"""Names from outside in a page: they are shown, and obeyed by nobody."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import airlight.viewer
from airlight import load_planet, solve
from airlight.planets import replace
from airlight.viewer.browser.page import page_text
from airlight.viewer.browser.page_data import page_data
from airlight.viewer.session.session import Session

#: Names that would each set ``hit`` where they were read as HTML.
SCRIPT = "</script><script>window.hit = 1</script>"
IMAGE = "<img src=x onerror='window.hit = 1'>"


def test_no_text_of_the_page_is_read_as_html() -> None:
    # the page and the notebook are made of the same modules, which set text alone
    files = sorted((Path(airlight.viewer.__file__).parent / "web").rglob("*.js"))
    assert len(files) > 20
    for file in files:
        text = file.read_text(encoding="utf-8")
        for word in ("innerHTML", "outerHTML", "insertAdjacentHTML", "document.write", "srcdoc"):
            assert word not in text, file.name


def test_hostile_names_are_shown_and_not_obeyed(tmp_path: Path, opened: Callable[..., Any]) -> None:
    planet = load_planet("mars-rayleigh")
    first, *others = planet.constituents
    planet = replace(planet, name=SCRIPT, constituents=(replace(first, name=IMAGE), *others))
    solution = solve(planet, [680, 550, 440], "preview", cache=False)
    session = Session("mars-rayleigh")
    session.set("name", SCRIPT)
    session.set("constituents[0].name", IMAGE)
    data = page_data(solution, "mars-rayleigh", SCRIPT, session.values, "three")
    file = tmp_path / "page.html"
    file.write_text(page_text(SCRIPT, data), encoding="utf-8")
    page = opened(file, "?device=webgl2")
    page.evaluate("airlight.ready")
    assert page.evaluate("window.hit === undefined")
    assert SCRIPT in page.title()
    assert page.evaluate("document.querySelectorAll('img').length") == 0
