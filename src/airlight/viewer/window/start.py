"""Start-up of the window: session, device, canvas."""

from __future__ import annotations

import time
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import numpy as np

from airlight.errors import ConflictError, FileError
from airlight.files.atomic_file import check_target
from airlight.kernel.background_compiler import BackgroundCompiler
from airlight.kernel.memory import share_memory_of_threads
from airlight.planets.reading.reader import read_tables
from airlight.render.gpu.device.device import Device, NoDevice, open_device
from airlight.render.gpu.picture.gpu_renderer import QUICK_SKY_VIEW_SIZE, SKY_VIEW_SIZE
from airlight.render.live_renderer import LiveRenderer
from airlight.render.live_system_renderer import LiveSystemRenderer
from airlight.render.rendering_gpu import Choice
from airlight.render.solve_planet import live_solver
from airlight.scene import look_at
from airlight.scene.system import is_scene_file
from airlight.viewer.background.preparing import Preparing
from airlight.viewer.navigation.viewpoints import view_in
from airlight.viewer.painting.picture_source import PictureSource
from airlight.viewer.painting.side_renderer import SideRenderer
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.session.saved_state import from_fragment
from airlight.viewer.session.scene_around import SceneAround
from airlight.viewer.session.session import Session
from airlight.viewer.window.canvas import DesktopCanvas, OffscreenCanvas, WindowError
from airlight.viewer.window.window import Window

#: Default azimuth from the sun, across the sunlight, if only an altitude is given. [deg]
_ACROSS: Final = -75.0
#: View values that replace the default viewpoint.
_PLACED: Final = frozenset(
    {"view.altitude", "view.sun_zenith", "view.field_of_view", "view.projection"}
)
#: Longest wait for a screenshot. [s]
_PATIENCE: Final = 300.0


@dataclass(frozen=True, kw_only=True)
class Start:
    """Initial state of a window.

    Parameters
    ----------
    planet : str
        Name of a preset, path of a planet or scene file, or URL of a page.
    other : str, optional
        Planet to compare it with.
    changes : tuple of str
        Overrides ``PATH=VALUE``.
    look : (float, float), optional
        Zenith angle, and azimuth from the sun, of the line of sight. [deg]
    look_at : str, optional
        Target instead of ``look``: ``horizon``, ``nadir``, ``zenith`` or ``sun``.
    size : (int, int)
        Size of the window. [logical pixel]
    device : str
        Device that solves and renders: ``auto``, ``gpu`` or ``cpu``.
    screenshot : Path, optional
        File for a screenshot, written instead of opening a window.
    """

    planet: str = "earth"
    other: str | None = None
    changes: tuple[str, ...] = ()
    view: Mapping[str, Value] = field(default_factory=dict)
    look: tuple[float, float] | None = None
    look_at: str | None = None
    size: tuple[int, int] = (1280, 720)
    device: Choice = "auto"
    screenshot: Path | None = None


def show(start: Start) -> None:
    """Open a window and run it until it is closed, or write a screenshot."""
    if start.screenshot is not None:
        if start.screenshot.suffix.lower() != ".png":
            raise FileError(start.screenshot, "the name of a screenshot ends in .png")
        check_target(start.screenshot)
    session = opened(start)
    canvas: DesktopCanvas | OffscreenCanvas
    if start.screenshot is not None:
        canvas = OffscreenCanvas(start.size)
    else:
        canvas = DesktopCanvas(start.size, f"airlight · {session.planet_name}")
    window = window_of(start, session, canvas)
    if start.screenshot is None or isinstance(canvas, DesktopCanvas):
        window.run()
        return
    try:
        _photograph(window, canvas, start.screenshot)
    finally:
        window.close()


def window_of(start: Start, session: Session, canvas: DesktopCanvas | OffscreenCanvas) -> Window:
    """Window of a session; its threads start with its first frame.

    Parameters
    ----------
    session : Session
        Session from ``opened``.
    canvas : DesktopCanvas or OffscreenCanvas
        Canvas, closed if there is an error.
    """
    # Two sides may compile a function together; the second then warns that it is done.
    warnings.filterwarnings("ignore", message="Compilation requested for previously compiled")
    share_memory_of_threads()
    preparing = Preparing(canvas.wake)
    try:
        device = open_device()
        compiler = preparing.compiler
        renderer = renderer_by(start.device, device, compiler, scene=session.around is not None)
        solver = live_solver(start.device, device, lambda: _is_plain(session))
        window = Window(session, canvas, device.device, renderer, solver, preparing)
        if start.other is not None:
            window.panel.compare_with(start.other)
    except BaseException as error:
        preparing.close()
        canvas.close()
        if isinstance(error, NoDevice):
            reason = f"the window needs a GPU: {error.reason}"
            raise WindowError(reason) from error
        raise
    return window


def opened(start: Start) -> Session:
    """Session in the initial state, with an empty history."""
    scene = is_scene_file(start.planet)
    session = _scene_session(start) if scene else _session_of(start.planet)
    if start.changes and not scene:
        from airlight.planets.reading.overrides import overridden, parsed

        changed = overridden(session.planet.tables, dict(parsed(one) for one in start.changes))
        session.replace_tables("overrides", changed)
    for path, value in start.view.items():
        session.set(path, value)
    placed = scene or "#" in start.planet or bool(set(start.view) & _PLACED)
    if start.look is None and start.look_at is None and not placed:
        session.move(view_in(session))
    view = session.view
    target, word, aside = start.look, start.look_at, 0.0
    if target is None and word is None and "view.altitude" in start.view:
        word, aside = "horizon", _ACROSS
    if word is not None:
        target = look_at(
            word,
            altitude=float(view["view.altitude"]),
            sun_zenith=float(view["view.sun_zenith"]),
            bottom_radius=1e3 * float(session.value("shell.bottom_radius")),
            sun_azimuth=float(view["view.sun_azimuth"]),
            planet=read_tables(session.planet.tables, session.planet.source),
        )
    if target is not None:
        bearing = float(view["view.sun_azimuth"])
        heading = (bearing + target[1] + aside) % 360.0
        session.move({"view.look_zenith": target[0], "view.heading": heading})
    session.forget_steps()
    return session


def _is_plain(session: Session) -> bool:
    """Whether the planet has no edits, so that its solution is cached for the next start.

    Solutions do not depend on three-dimensional clouds.
    """
    edits = (one for one, _, _ in session.planet.changes if not one.startswith("clouds"))
    return not any(edits) and not session.planet.off


def _session_of(planet: str) -> Session:
    """Session on a planet by its name or file, or in the state of a page's URL."""
    _, sign, fragment = planet.partition("#")
    if not sign:
        return Session(planet)
    state = from_fragment(fragment)
    name = str(state.get("planet", ""))
    if is_scene_file(name):
        raise ConflictError(name, "is a scene, whose links open in its page alone")
    session = Session(name)
    session.from_state(state)
    return session


def _scene_session(start: Start) -> Session:
    """Session in a scene of several bodies, with the view of its file."""
    from airlight.planets.reading.overrides import overridden, parsed

    around = SceneAround.opened(start.planet, dict(parsed(one) for one in start.changes))
    session = Session(around.planet)
    changes = around.system.changes.get(around.body)
    if changes:
        session.replace_tables("overrides", overridden(session.planet.tables, changes))
    session.around = around
    session.change_view("scene", around.view())
    return session


def renderer_by(
    choice: Choice,
    device: Device,
    compiler: BackgroundCompiler | None = None,
    *,
    scene: bool = False,
) -> Callable[[], PictureSource]:
    """Factory of picture sources on the GPU or the CPU, of a planet or a scene of bodies."""

    def make() -> PictureSource:
        if scene:
            size = QUICK_SKY_VIEW_SIZE if device.software else SKY_VIEW_SIZE
            return SideRenderer(device.device, LiveSystemRenderer(device, size))
        gpu = None if choice == "cpu" else device
        return SideRenderer(device.device, LiveRenderer(gpu, compiler))

    return make


def _photograph(window: Window, canvas: OffscreenCanvas, path: Path) -> None:
    """Draw frames until all requests are displayed, and write a screenshot."""
    from airlight.image.png import write_png

    until = time.monotonic() + _PATIENCE
    canvas.run(window.draw)
    while not (window.settled and window.shown() is not None and not canvas.wanted):
        if window.problem:
            raise WindowError(window.problem)
        if time.monotonic() > until:
            raise WindowError(f"the picture was not finished after {_PATIENCE:.0f} s")
        time.sleep(0.02)
        canvas.run(window.draw)
    for _ in range(2):  # panels reach their final sizes one frame later
        canvas.run(window.draw)
    assert canvas.picture is not None
    write_png(path, np.ascontiguousarray(canvas.picture), {"software": "airlight view"})
