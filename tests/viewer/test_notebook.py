"""Python side of the widget: parameters both ways, without a browser."""

from __future__ import annotations

import asyncio
import io
import json
import threading
import time
from collections.abc import Callable, Iterator
from typing import Any, NoReturn

import numpy as np
import pytest
from numpy.testing import assert_array_equal
from PIL import Image

from airlight import solve
from airlight.image.display import to_display
from airlight.kernel.compiling import Compiling
from airlight.planets import load_planet
from airlight.render import render
from airlight.viewer.background.solver_thread import SolverThread
from airlight.viewer.parameters.view_parameters import scene_of
from airlight.viewer.session.session import Session

pytest.importorskip("anywidget")


@pytest.fixture(scope="module")
def solution() -> Any:
    """Solution shared by all tests, which do not depend on the picture."""
    return solve(load_planet("mars"), (680.0, 550.0, 440.0), "preview", cache=False)


@pytest.fixture
def viewer(solution: Any) -> Iterator[Any]:
    """Viewer whose planet is solved immediately."""
    from airlight.viewer.browser.notebook import Viewer

    def solving(session: Session, **more: Any) -> SolverThread:
        return SolverThread(session, **{**more, "solver": lambda *a, **k: solution})

    def none() -> NoReturn:
        raise RuntimeError  # Playwright, in the same process, keeps a loop that runs no callback

    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(asyncio, "get_running_loop", none)
        made = Viewer("mars", solving=solving)
    assert made.wait(300.0)
    yield made
    made.close()


def test_python_moves_what_the_browser_is_told(viewer: Any) -> None:
    viewer.set("view.altitude", 1234.0)
    assert viewer.values["view.altitude"] == 1234.0
    viewer.session.set("dust.particles.optical_depth", 2.0)
    assert viewer.values["constituents[1].particles.optical_depth"] == 2.0
    assert viewer.can["undo"] is True


def test_browser_moves_what_python_holds(viewer: Any) -> None:
    # all values at once, as a host of widgets sets them
    before = viewer.values["view.sun_zenith"]
    assert before != 75.5
    viewer.set_state({"values": {**viewer.values, "view.sun_zenith": 75.5}})
    assert viewer.session.value("view.sun_zenith") == 75.5
    viewer.set_state({"messages": {"a": [{"command": "undo", "count": 1}]}})
    assert viewer.session.value("view.sun_zenith") == before
    assert viewer.values["view.sun_zenith"] == before


def edit(count: int, path: str, value: float, gesture: str | None = None) -> dict[str, Any]:
    """One message of a browser's view."""
    name = path if gesture is None else gesture
    return {"edit": {path: value}, "gesture": name, "held": False, "count": count}


def test_a_browser_knows_what_has_been_heard(viewer: Any) -> None:
    # each message is acknowledged, also one that changes nothing; of each view by itself
    viewer.set_state({"messages": {"a": [{"command": "rest", "count": 1}]}})
    assert viewer.heard == {"a": 1}
    sun = "view.sun_zenith"
    viewer.set_state({"messages": {"b": [edit(4, sun, 75.5)]}})
    assert viewer.heard == {"a": 1, "b": 4}
    assert viewer.session.value(sun) == 75.5
    viewer.set_state({"messages": {"a": [{"command": "undo", "count": 2}], "b": []}})
    assert viewer.heard == {"a": 2, "b": 4}
    assert viewer.session.value(sun) != 75.5


def test_messages_are_followed_once_and_in_order(viewer: Any) -> None:
    # a host merges updates, of which Python then sees the last, and sends others twice
    sun = "view.sun_zenith"
    first = viewer.session.value(sun)
    early = [edit(1, sun, 20.0), {"command": "rest", "count": 2}]
    viewer.set_state({"messages": {"a": early}})
    late = [*early, edit(3, sun, 40.0), {"command": "rest", "count": 4}, edit(5, sun, 60.0)]
    late += [{"command": "undo", "count": 6}, {"command": "undo", "count": 7}]
    viewer.set_state({"messages": {"a": late}})
    assert viewer.heard == {"a": 7}
    assert viewer.session.value(sun) == 20.0
    # an undo that is sent again with the next message is not done again
    viewer.set_state({"messages": {"a": [late[-1], {"command": "rest", "count": 8}]}})
    assert viewer.heard == {"a": 8}
    assert viewer.session.value(sun) == 20.0
    viewer.session.undo()
    assert viewer.session.value(sun) == first


def test_what_python_sets_survives_a_message_on_its_way(viewer: Any) -> None:
    viewer.set("view.look_zenith", 30.0)
    viewer.set_state({"messages": {"a": [edit(1, "view.sun_zenith", 75.5)]}})
    assert viewer.values["view.look_zenith"] == 30.0
    assert viewer.values["view.sun_zenith"] == 75.5


def test_an_invalid_edit_is_heard_and_said(viewer: Any) -> None:
    before = viewer.session.value("view.altitude")
    wrong, right = edit(1, "view.altitude", -5e3), edit(2, "view.sun_zenith", 75.5)
    viewer.set_state({"messages": {"a": [wrong, right]}})
    assert viewer.heard == {"a": 2}
    assert "view.altitude is -5000" in viewer.message
    assert viewer.values["view.altitude"] == before
    assert viewer.values["view.sun_zenith"] == 75.5


def test_flight_is_no_step_of_undo(viewer: Any) -> None:
    moved = {"view.altitude": 5e4, "view.heading": 90.0, "view.latitude": 3.0}
    viewer.set_state({"values": {**viewer.values, **moved}})
    assert viewer.session.value("view.latitude") == 3.0
    assert not viewer.session.can_undo


def test_value_that_cannot_be_goes_back_with_a_word(viewer: Any) -> None:
    before = viewer.session.value("view.altitude")
    viewer.set_state({"values": {**viewer.values, "view.altitude": -5e3}})
    assert viewer.values["view.altitude"] == viewer.session.value("view.altitude") == before
    assert "view.altitude is -5000" in viewer.message
    viewer.set("view.altitude", 10.0)
    viewer.set_state({"values": {**viewer.values, "view.altitude": 20.0}})
    assert viewer.message == ""


def test_solution_arrives_as_tables(viewer: Any, solution: Any) -> None:
    # the first table of the spectra is the extinction, of three wavelengths in texels of four
    data = viewer.picture["tables"]["spectra"]["data"]
    numbers = np.frombuffer(data, np.float32).reshape(-1, 4)
    extinction = solution.tables.scaled_extinction.reshape(-1, solution.tables.lanes)[:, :4]
    assert_array_equal(numbers[: len(extinction)], extinction)
    assert viewer.picture["radius"] == solution.medium.bottom_radius
    assert viewer.status.startswith("default, ")


def test_closing_ends_the_thread(solution: Any) -> None:
    from airlight.viewer.browser.notebook import Viewer

    before = set(threading.enumerate())
    viewer = Viewer("mars")
    (thread,) = (one for one in set(threading.enumerate()) - before if "solving" in one.name)
    viewer.close()
    altitude = viewer.values["view.altitude"]
    viewer.session.set("view.altitude", 7.0)  # no observer is left
    assert viewer.values["view.altitude"] == altitude != 7.0
    thread.join(120.0)
    assert not thread.is_alive()


def test_the_kernel_draws_what_a_browser_asks_for(viewer: Any, solution: Any) -> None:
    # The renderer called directly is the second method; the answer repeats the number.
    view = {**viewer.session.view, "view.sun_zenith": 80.0, "display.automatic": False}
    view["display.exposure"] = -2.0
    viewer.set_state({"wanted": {"number": 7, "view": view, "size": [40, 24]}})
    limit = time.monotonic() + 300.0
    while viewer.rendered.get("number") != 7:
        assert time.monotonic() < limit
        time.sleep(0.01)
    rendered = viewer.rendered
    assert rendered["exposure"] == -2.0
    got = np.asarray(Image.open(io.BytesIO(rendered["png"])).convert("RGB"))
    scene = scene_of(view, 40, 24)
    light = render(solution, scene)
    wanted = to_display(
        light.rgb, -2.0, str(view["display.tone_map"]), eye=True,
        glare=float(view["display.glare"]), pixel_angle=light.pixel_angle,
    )  # fmt: skip
    assert_array_equal(got, wanted)
    # what cannot be rendered is said, and the next picture is rendered
    wrong = {**view, "view.projection": "orthographic"}
    viewer.set_state({"wanted": {"number": 8, "view": wrong, "size": [40, 24]}})
    viewer.set_state({"wanted": {"number": 9, "view": view, "size": [24, 40]}})
    seen = {}
    while 9 not in seen:
        assert time.monotonic() < limit
        seen[viewer.rendered["number"]] = dict(viewer.rendered)
        time.sleep(0.001)
    assert "png" in seen[9]
    assert 8 not in seen or "orthographic" in seen[8]["error"]


def test_a_kernel_that_draws_sends_no_tables(viewer: Any) -> None:
    viewer.set_state({"drawer": "kernel"})
    viewer.session.set("light.orders", "single")  # the picture alone
    viewer.session.set("dust.particles.optical_depth", 0.7)
    assert viewer.wait(300.0)
    assert viewer.picture["tables"] == {}
    assert viewer.picture["viewpoints"]
    assert viewer.stale is False


class _Compiler:
    """Other process, which has compiled what draws once the test says so."""

    def __init__(self) -> None:
        self.compiling = Compiling([], here=False)
        self.compiling.total = 1
        self.done = threading.Event()

    def wait(self, loop: Any, stale: Callable[[], bool]) -> bool:
        while not self.done.wait(0.01):
            if stale():
                return False
        return True

    def close(self) -> None:
        pass


def test_the_kernel_leaves_compilation_to_another_process(
    viewer: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from airlight.viewer.background import preparing

    compiler = _Compiler()
    monkeypatch.setattr(preparing, "start_render_compiler", lambda: compiler)
    monkeypatch.setattr(preparing.Preparing, "share", property(lambda one: float(ready.is_set())))
    ready = compiler.done
    viewer.set_state({"drawer": "kernel"})
    assert viewer._pictures.preparing.compiler is compiler
    order = {"number": 1, "view": dict(viewer.session.view), "size": [40, 24]}
    viewer.set_state({"wanted": order})
    viewer._wake()
    assert viewer._pictures.waits
    assert "default" not in viewer.status
    time.sleep(0.3)
    assert viewer.rendered == {}
    compiler.done.set()
    limit = time.monotonic() + 300.0
    while viewer.rendered.get("number") != 1:
        assert time.monotonic() < limit
        time.sleep(0.01)
    assert "png" in viewer.rendered
    assert viewer.status.startswith("default, ")


def test_closing_ends_a_picture_that_waits(viewer: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    from airlight.viewer.background import preparing

    monkeypatch.setattr(preparing, "start_render_compiler", _Compiler)
    viewer.set_state({"drawer": "kernel"})
    order = {"number": 1, "view": dict(viewer.session.view), "size": [40, 24]}
    viewer.set_state({"wanted": order})
    viewer.close()
    assert viewer.rendered == {}
    assert not viewer._pictures._thread.is_alive()


@pytest.mark.parametrize("name", ["</script><b>", "[/x] $x_{$", "<img src=x onerror=hit()>", "-->"])
def test_a_name_is_what_it_is_in_the_widget(viewer: Any, name: str) -> None:
    for path in ("name", "constituents[0].name"):
        viewer.set(path, name)
        assert viewer.values[path] == name
    assert name in json.dumps(viewer.get_state("values"), ensure_ascii=False)
    assert viewer.message == ""


@pytest.mark.parametrize("text", ["a\x1b[31m", "a\x00b", "\udc80", "a\u202eb"])
def test_a_browser_cannot_give_a_name_that_steers_a_terminal(viewer: Any, text: str) -> None:
    path = "constituents[0].name"
    before = viewer.values[path]
    viewer.set_state({"messages": {"a": [{**edit(1, path, 0.0), "edit": {path: text}}]}})
    assert viewer.heard == {"a": 1}
    assert viewer.values[path] == viewer.session.value(path) == before
    assert "letters without control characters" in viewer.message
    assert text not in viewer.message
    json.dumps(viewer.get_state(["values", "message"]), ensure_ascii=False).encode()
