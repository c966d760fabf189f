"""Panels of the window: every label and number fits its box, at all sizes of the window."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from airlight.errors import AirlightError
from airlight.render.gpu.device.device import Device
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.session.session import Session
from airlight.viewer.window import style
from airlight.viewer.window.canvas import OffscreenCanvas
from airlight.viewer.window.panels.status import StatusLine, draw_status
from airlight.viewer.window.picture_area import Rectangle
from airlight.viewer.window.window import Window

#: Width, height and physical pixels per logical pixel.
SIZES = ((1280, 720, 1.0), (800, 600, 1.0), (1280, 720, 2.0))
#: Long names, layers, gases by their composition, droplets by their sizes.
PLANETS = ("earth", "earth-hazy", "earth-openspace-refractive", "titan", "venus")
#: Rounding of positions. [logical pixel]
CLOSE = 0.51


class Idle:
    """PictureSource that is never called, since nothing is ever solved."""

    def render(self, request: Request, stale: object) -> Iterator[Picture]:
        raise AssertionError("nothing was solved")

    def close(self) -> None:
        pass


def unsolved(*_: Any, **__: Any) -> Any:
    raise AirlightError("not solved here")


@pytest.fixture(params=SIZES, ids=lambda one: f"{one[0]}x{one[1]}@{one[2]:g}")
def shown(request: pytest.FixtureRequest, device: Device) -> Iterator[Any]:
    """Window of a size, as a function of its session that draws some frames."""
    pytest.importorskip("imgui_bundle")
    width, height, ratio = request.param
    made: list[Window] = []

    def show(session: Session, search: str = "", tab: str = "Planet") -> Window:
        canvas = OffscreenCanvas((width, height), ratio)
        window = Window(session, canvas, device.device, Idle, unsolved)
        made.append(window)
        window.panel.planet_rows.search, window.panel.opens = search, tab
        for _ in range(4):
            canvas.run(window.draw)
        return window

    yield show
    for window in made:
        window.close()


def test_labels_and_numbers_fit(shown: Any) -> None:
    # All rows of all groups, advanced too: their help ends with a full stop, which is searched.
    session = Session(PLANETS[0])
    window = shown(session, search=".")
    canvas, rows = window._canvas, window.panel.planet_rows
    for planet in PLANETS:
        session.open(planet)
        rows.texts.clear()
        rows.places.clear()
        for _ in range(3):
            canvas.run(window.draw)
        assert set(rows.texts) == {one.path for one in session.parameters}
        for path, texts in rows.texts.items():
            for text, has, needs in texts:
                assert needs <= has + CLOSE, (planet, path, text)
            left, _, right, _ = rows.places[path]
            assert left >= 0.0, path
            assert right <= style.PANEL_WIDTH, path


@pytest.mark.parametrize("tab", ["Planet", "View", "Compare"])
def test_controls_stay_within_the_panel(tab: str, shown: Any) -> None:
    session = Session("earth-openspace-depolarisation")
    session.store_b()
    session.set("air.turbidity", 3.0)
    window = shown(session, tab=tab)
    panel = window.panel
    assert len(panel.places) > 8
    for name, (left, _, right, _) in panel.places.items():
        assert 0.0 <= left < right <= style.PANEL_WIDTH, name
    # the longest name of a planet
    from imgui_bundle import imgui

    left, _, right, _ = panel.places["planet"]
    text = imgui.calc_text_size("A: earth-openspace-depolarisation").x
    assert text + imgui.get_frame_height() + 14.0 <= right - left


def test_the_status_line_drops_what_matters_least(shown: Any) -> None:
    # The place is whole at any width; times of the window leave first.
    from imgui_bundle import imgui

    said: list[str] = []
    window = shown(Session("earth"))
    width, _ = window.surface.size
    status = StatusLine(
        place="15290 km up    sun 60.0° from the zenith", exposure="+2.5 EV",
        frame="window: 12 ms", picture="graphics: 2560×1440 in 142 ms, finer follows",
        solver="default: 13.1 s, solving, preview 40 % …",
    )  # fmt: skip

    def gui() -> None:
        with pytest.MonkeyPatch.context() as patch:
            plain, colored = imgui.text_unformatted, imgui.text_colored
            patch.setattr(imgui, "text_unformatted", lambda t: (said.append(t), plain(t)))
            patch.setattr(imgui, "text_colored", lambda c, t: (said.append(t), colored(c, t)))
            draw_status(status, Rectangle(left=0.0, top=0.0, width=width, height=26.0))

    window._gui = gui
    window._canvas.run(window.draw)
    left, right = said[-2:]
    assert left == f"{status.place}    {status.exposure}"
    assert right.startswith(status.solver)
    assert (status.frame in right) is (width > 1000)
