"""Words and veil of the window over a side whose picture is not the planet's as it is edited."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, cast

import numpy as np
import pytest

from airlight import load_planet
from airlight.render.gpu.device.device import Device
from airlight.render.live_renderer import LiveRenderer
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.painting.side_renderer import SideRenderer
from airlight.viewer.session.session import Session
from airlight.viewer.window.canvas import OffscreenCanvas
from airlight.viewer.window.window import Window

LONG = 300.0  # time limit, generous for a busy machine [s]
DEPTH = "constituents[1].particles.optical_depth"


class Solver:
    """Solver with one answer for all planets, given at once or held back."""

    def __init__(self, solution: MomentsSolution) -> None:
        self.solution = solution
        self.gate = threading.Event()
        self.gate.set()

    def __call__(self, *_: Any, **__: Any) -> MomentsSolution:
        assert self.gate.wait(LONG)
        return self.solution


@pytest.fixture
def solver(solved: Callable[..., MomentsSolution]) -> Solver:
    return Solver(solved(load_planet("mars"), (440.0, 550.0, 680.0), "preview"))


@pytest.fixture
def window(device: Device, solver: Solver) -> Iterator[Window]:
    pytest.importorskip("imgui_bundle")
    session = Session("mars")
    session.store_b()
    window = Window(
        session,
        OffscreenCanvas((800, 600)),
        device.device,
        lambda: SideRenderer(device.device, LiveRenderer()),
        cast(Any, solver),
    )
    window.actions.shows_panels = False
    window.panel.compares = True
    yield window
    solver.gate.set()
    window.close()


def until(window: Window, reached: Callable[[], object]) -> np.ndarray:
    """Frames until a condition holds before and after one; median brightness of its sides."""
    canvas = cast(OffscreenCanvas, window._canvas)
    end = time.monotonic() + LONG
    while True:
        before = reached()
        canvas.run(window.draw)
        if before and reached():
            break
        assert time.monotonic() < end
        time.sleep(0.02)
    assert canvas.picture is not None
    place = window.picture_rectangle()
    rows = slice(int(place.top) + 60, int(place.top + place.height) - 60)
    left, right = np.array_split(canvas.picture[rows, :, :3].astype(float), 2, axis=1)
    return np.array([np.median(left), np.median(right)])


@pytest.mark.slow
def test_a_side_is_veiled_while_another_planet_is_solved(window: Window, solver: Solver) -> None:
    sides = window._sides
    before = until(window, lambda: sides.settled and not sides.outdated("A"))
    assert (before > 20.0).all()
    assert sides.outdated("B") == ""
    # the exposure of both follows the edited side's view, which another planet changes
    window.session.set("display.locked", True)

    solver.gate.clear()
    window.session.set(DEPTH, 1.5)
    held = until(window, lambda: sides.outdated("A"))
    assert held == pytest.approx(before, abs=1.0)  # edits do not flash
    window.session.open("titan")
    # the other side is drawn anew, first with fewer pixels
    held = until(window, lambda: sides.outdated("A") and sides._is_settled("B"))
    # the veil takes 55 % of the edited side's light, of the other's none
    assert held[0] == pytest.approx(0.45 * before[0], abs=1.0)
    assert held[1] == pytest.approx(before[1], abs=1.0)

    window.session.undo()
    solver.gate.set()
    after = until(window, lambda: sides.settled and not sides.outdated("A"))
    assert after == pytest.approx(before, abs=1.0)


@pytest.mark.slow
def test_a_picture_of_another_planet_than_the_controls_says_so(
    device: Device, solver: Solver
) -> None:
    # The words are light on a dark ground, in a corner of a bright sky; they go with the new one.
    pytest.importorskip("imgui_bundle")
    window = Window(
        Session("mars"),
        OffscreenCanvas((800, 600)),
        device.device,
        lambda: SideRenderer(device.device, LiveRenderer()),
        cast(Any, solver),
    )
    window.actions.shows_panels = False
    sides = window._sides

    def corner() -> float:
        picture = cast(OffscreenCanvas, window._canvas).picture
        place = window.picture_rectangle()
        assert picture is not None
        top, left = int(place.top) + 10, int(place.left) + 10
        return float(np.median(picture[top : top + 30, left : left + 80, :3]))

    try:
        until(window, lambda: sides.settled and not sides.outdated())
        before = corner()
        solver.gate.clear()
        window.session.set(DEPTH, 1.5)
        until(window, lambda: sides.outdated())
        assert corner() < 0.6 * before
        solver.gate.set()
        until(window, lambda: sides.settled and not sides.outdated())
        assert corner() == pytest.approx(before, abs=1.0)
    finally:
        solver.gate.set()
        window.close()
