"""Gallery of the presets: complete, small, and before the first picture of a window."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from typing import Any, NoReturn

import numpy as np
import pytest

from airlight.planets import planet_names
from airlight.viewer.gallery.presets import HEIGHT, PRESETS, WIDTH, families
from airlight.viewer.gallery.thumbnails import thumbnail, thumbnail_file


def test_every_preset_is_in_the_gallery_once() -> None:
    assert sorted(one.name for one in PRESETS) == sorted(planet_names())
    # Within a family the planet itself comes first, and the models of the literature last.
    order = ["reference", "variation", "literature"]
    for presets in families().values():
        kinds = [order.index(one.kind) for one in presets]
        assert kinds == sorted(kinds)
        assert kinds.count(0) == 1


def test_small_pictures_are_small_and_show_something() -> None:
    sizes = []
    for one in PRESETS:
        content, pixels = thumbnail_file(one.name), thumbnail(one.name)
        assert content is not None, one.name
        assert pixels is not None
        assert pixels.shape == (HEIGHT, WIDTH, 3)
        assert pixels.std() > 10.0, one.name
        sizes.append(len(content))
    assert max(sizes) <= 8000
    assert sum(sizes) <= 170_000


@pytest.mark.parametrize("name", ["my-planet.toml", "../../secret", "", "nowhere"])
def test_other_planets_have_no_small_picture(name: str) -> None:
    assert thumbnail(name) is None


@pytest.fixture
def waiting(device: Any, lacking: Callable[[str], NoReturn]) -> Iterator[Any]:
    """Window whose solver never answers, and its canvas."""
    try:
        from airlight.viewer.window.canvas import OffscreenCanvas
        from airlight.viewer.window.window import Window

        canvas = OffscreenCanvas((800, 600))
    except Exception as error:
        lacking(str(error))
    from airlight.viewer.session.session import Session

    stopped = threading.Event()

    def solver(*_: Any, progress: Any, cancel: Callable[[], bool], **__: Any) -> Any:
        progress(3, 10, "")
        while not cancel():
            stopped.wait(0.02)
        raise KeyError

    window = Window(Session("earth-bruneton"), canvas, device.device, lambda: _Painter(), solver)
    yield window, canvas
    window.close()


class _Painter:
    def close(self) -> None:
        pass


def test_before_the_first_picture_the_window_shows_the_small_one_and_the_progress(
    waiting: Any,
) -> None:
    window, canvas = waiting
    canvas.run(window.draw)
    canvas.run(window.draw)
    assert window.shown() is None
    area = window._parts["picture"]
    part = canvas.picture[
        int(area.top) : int(area.top + area.height), int(area.left) : int(area.left + area.width)
    ]
    small = thumbnail("earth-bruneton")
    assert small is not None
    # Dimmed, and as bright from top to bottom as the small picture in thirds of its middle.
    for third in range(3):
        rows = slice(third * part.shape[0] // 3, (third + 1) * part.shape[0] // 3)
        middle = slice(part.shape[1] // 3, 2 * part.shape[1] // 3)
        here = part[rows, middle].mean()
        there = small[third * 45 : (third + 1) * 45, 80:160].mean()
        assert 0.3 * there - 3.0 < here < there + 3.0
    assert part.max() > 200  # words
    assert "solving" in window.progress or "reading" in window.progress


def test_the_gallery_is_chosen_from_by_keys(waiting: Any) -> None:
    from airlight.viewer.window.panels.gallery import neighbour

    window, canvas = waiting
    canvas.run(window.draw)
    window.do("gallery")
    for _ in range(3):
        canvas.run(window.draw)
    assert window.gallery.is_open, window.problem
    assert window.surface.asks
    # The models of the literature are unfolded, since one of them is shown.
    rows = window.gallery._rows(3)
    assert ["earth", "earth-hazy", "earth-volcanic"] in rows
    names = [name for row in rows for name in row]
    assert "earth-bruneton" in names
    assert "mars-openspace" not in names
    assert neighbour(rows, "earth", (0, 1)) == "earth-hazy"
    left, top, right, bottom = window.gallery.places["earth"]
    assert right - left > 100.0
    np.testing.assert_allclose((right - left) / (bottom - top), WIDTH / HEIGHT, rtol=0.02)


def test_keys_that_come_within_a_slow_frame_are_answered_without_another_event(
    waiting: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Frames longer than the time for which the window is redrawn after an event: ImGui takes the
    # keys in several frames, and the window stood still after the first.
    window, canvas = waiting
    monkeypatch.setattr("airlight.viewer.window.window._LINGER", 0.0)
    canvas.run(window.draw)
    window.do("gallery")
    for _ in range(3):
        canvas.run(window.draw)
    assert window.gallery.is_open
    assert not window._restless
    for key in ("ArrowRight", "Escape"):
        for kind in ("key_down", "key_up"):
            canvas.render_canvas.submit_event({"event_type": kind, "key": key, "modifiers": ()})
    canvas.render_canvas._events.flush()
    frames = 0
    while frames == 0 or window._restless:
        canvas.run(window.draw)
        frames += 1
    assert not window.gallery.is_open
    assert not window.surface.asks
    assert 2 < frames < 9
