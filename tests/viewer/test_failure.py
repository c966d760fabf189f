"""Failures within a frame of the window: it reports them, draws the rest, and recovers."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.errors import AirlightError, ParameterError
from airlight.render.gpu.device.device import Device
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.painting.probe import Contribution, Probe
from airlight.viewer.painting.probing import ProbeResult
from airlight.viewer.session.session import Session
from airlight.viewer.window import overlay_help
from airlight.viewer.window.canvas import OffscreenCanvas
from airlight.viewer.window.panels import parameters as panel_parameters
from airlight.viewer.window.panels import probe as panel_probe
from airlight.viewer.window.panels import side as panel_side
from airlight.viewer.window.panels import status as panel_status
from airlight.viewer.window.panels.save import SaveDialog
from airlight.viewer.window.window import Window

SIZE = (1280, 720)
STATUS = 690  # the line with times, different in each frame, begins below
LONG = 60.0  # time limit, generous for a busy machine [s]

Breaks = Callable[[Window, pytest.MonkeyPatch, BaseException], None]


class Idle:
    """PictureSource that is never called, since nothing is ever solved."""

    def render(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        raise AssertionError("nothing was solved")

    def close(self) -> None:
        pass


def unsolved(*_: Any, **__: Any) -> Any:
    raise AirlightError("not solved here")


#: No picture is finished here, so that nothing reads it.
REQUEST: Any = None


class Read:
    """Probe with a result."""

    def __init__(self) -> None:
        nm, light = (440.0, 550.0, 680.0), (0.1, 0.2, 0.1)
        probe = Probe(
            view_zenith=90.0, azimuth=0.0, wavelengths=nm, radiance=light, luminance=10.0,
            chromaticity=(0.3, 0.3), rgb=(1.0, 1.0, 1.0), polarised=(0.4, 30.0), names=("air",),
            optical_depth=((0.2, 0.1, 0.05),), transmittance=(0.8, 0.9, 0.95), distance=np.inf,
            latitude=None, longitude=None,
            parts=(Contribution(name="single scattering", radiance=light, luminance=10.0),),
        )  # fmt: skip
        self.reading = ProbeResult(
            probe=probe, spectrum=probe, quality="all", place=(0.5, 0.5), request=REQUEST
        )
        self.working = self.error = ""
        self.busy = False

    def close(self) -> None:
        pass


@pytest.fixture
def canvas() -> OffscreenCanvas:
    pytest.importorskip("imgui_bundle")
    return OffscreenCanvas(SIZE)


@pytest.fixture
def window(canvas: OffscreenCanvas, device: Device) -> Iterator[Window]:
    session = Session("earth")
    session.store_b()
    session.set("shell.top_radius", 6500.0)
    window = Window(session, canvas, device.device, Idle, unsolved)
    window._probing.close()
    window._probing = Read()  # type: ignore[assignment]
    yield window
    window.close()


def failing(fault: BaseException) -> Callable[..., Any]:
    def fail(*_: Any, **__: Any) -> Any:
        raise fault

    return fail


def breaks(where: Any, name: str) -> Breaks:
    """Make a function of a module or of a class fail."""
    return lambda window, patch, fault: patch.setattr(where, name, failing(fault))


def breaks_plot(window: Window, patch: pytest.MonkeyPatch, fault: BaseException) -> None:
    from imgui_bundle import implot

    patch.setattr(implot, "plot_line", failing(fault))


def breaks_dialog(window: Window, patch: pytest.MonkeyPatch, fault: BaseException) -> None:
    class Broken(SaveDialog):
        planet_path = property(failing(fault))  # type: ignore[assignment]

    dialog = Broken.__new__(Broken)
    dialog.asks, dialog._fresh = "planet", False
    patch.setattr(window, "_dialog", dialog)


def breaks_disabled(window: Window, patch: pytest.MonkeyPatch, fault: BaseException) -> None:
    from imgui_bundle import imgui

    patch.setattr(imgui, "checkbox", failing(fault))


#: Contribution, tab, and function that fails, each between a begin and an end.
PARTS: tuple[tuple[str, str, Breaks], ...] = (
    ("flight", "Planet", lambda w, patch, fault: patch.setattr(w, "_step", failing(fault))),
    ("request", "Planet", lambda w, patch, fault: patch.setattr(w, "_follow", failing(fault))),
    (
        "picture",
        "Planet",
        lambda w, patch, fault: patch.setattr(w, "_draw_first_picture", failing(fault)),
    ),
    ("side panel", "Planet", breaks(panel_parameters, "parameter_row")),
    ("side panel", "Planet", breaks_disabled),
    ("side panel", "View", breaks(panel_side, "_speed")),
    ("side panel", "Compare", breaks(panel_side, "_text")),
    ("probe", "Planet", breaks(panel_probe, "_row")),
    ("probe", "Planet", breaks_plot),
    ("help", "Planet", breaks(overlay_help.style, "colored")),
    ("save dialog", "Planet", breaks_dialog),
    ("status line", "Planet", breaks(panel_status, "_fitting")),
)

#: Faults that parts raise in turn: one of the package, and one of the code.
FAULTS = (ParameterError("albedo", 2, "0 to 1"), KeyError("no row"))


def drawn(window: Window, canvas: OffscreenCanvas, frames: int) -> np.ndarray:
    """Pixels of the window above its status line, after some frames."""
    for _ in range(frames):
        canvas.run(window.draw)
    assert canvas.picture is not None
    return canvas.picture[:STATUS].copy()


def opened(window: Window, canvas: OffscreenCanvas, part: str, tab: str) -> np.ndarray:
    """Window with a part and a tab open, at rest: its solver has said that it does not solve."""
    window.panel.opens, window.panel.probes = tab, part == "probe"
    if part == "help":
        window.do("help")
    if part == "save dialog":
        window.do("save planet")
    drawn(window, canvas, 4)
    limit = time.monotonic() + LONG
    while not window._sides.error:
        assert time.monotonic() < limit
        time.sleep(0.01)
    return drawn(window, canvas, 1)


@pytest.mark.parametrize(
    ("part", "tab", "broken", "fault"),
    [(*one, FAULTS[i % 2]) for i, one in enumerate(PARTS)],
    ids=[f"{one[0]} {i}" for i, one in enumerate(PARTS)],
)
def test_a_part_that_fails_is_named_and_drawn_again_once_it_can_be(
    window: Window,
    canvas: OffscreenCanvas,
    caplog: pytest.LogCaptureFixture,
    part: str,
    tab: str,
    broken: Breaks,
    fault: Exception,
) -> None:
    # A missing end or a style left pushed would change the window.
    before, frames = opened(window, canvas, part, tab), window.frames
    with pytest.MonkeyPatch.context() as patch:
        broken(window, patch, fault)
        with caplog.at_level(logging.WARNING):
            drawn(window, canvas, 3)
        assert window.problem.startswith(f"{part}: ")
        assert window.problem.endswith(str(fault))
    assert window.frames == frames + 3
    assert [(one.name, one.exc_info is not None) for one in caplog.records] == [
        ("airlight.viewer.background.error_line", True)
    ]
    after = drawn(window, canvas, 3)
    assert part not in window.problem
    assert_array_equal(after, before)


def test_an_interrupt_ends_the_frame_and_leaves_the_window_whole(
    window: Window, canvas: OffscreenCanvas, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = opened(window, canvas, "side panel", "Planet")
    with monkeypatch.context() as patch:
        patch.setattr(panel_parameters, "parameter_row", failing(KeyboardInterrupt()))
        with pytest.raises(KeyboardInterrupt):
            canvas.run(window.draw)
    assert_array_equal(drawn(window, canvas, 3), before)
