"""Python side of the widget: parameters both ways, without a browser."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight import solve
from airlight.planets import load_planet
from airlight.viewer.background.solving import Solving
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

    def solving(session: Session, **more: Any) -> Solving:
        return Solving(session, **{**more, "solver": lambda *a, **k: solution})

    made = Viewer("mars", solving=solving)
    assert made.wait(60.0)
    yield made
    made.close()


def test_python_moves_what_the_browser_is_told(viewer: Any) -> None:
    viewer.set("view.altitude", 1234.0)
    assert viewer.values["view.altitude"] == 1234.0
    viewer.session.set("dust.particles.optical_depth", 2.0)
    assert viewer.values["constituents[1].particles.optical_depth"] == 2.0
    assert viewer.can["undo"] is True


def test_browser_moves_what_python_holds(viewer: Any) -> None:
    # a browser sets the widget's state, all values at once
    viewer.set_state({"values": {**viewer.values, "view.sun_zenith": 75.5}})
    assert viewer.session.value("view.sun_zenith") == 75.5
    viewer.set_state({"command": {"name": "undo", "count": 1}})
    assert viewer.session.value("view.sun_zenith") == 60.0
    assert viewer.values["view.sun_zenith"] == 60.0


def test_flight_is_no_step_of_undo(viewer: Any) -> None:
    moved = {"view.altitude": 5e4, "view.heading": 90.0, "view.latitude": 3.0}
    viewer.set_state({"values": {**viewer.values, **moved}})
    assert viewer.session.value("view.latitude") == 3.0
    assert not viewer.session.can_undo


def test_value_that_cannot_be_goes_back_with_a_word(viewer: Any) -> None:
    viewer.set_state({"values": {**viewer.values, "view.altitude": -5e3}})
    assert viewer.values["view.altitude"] == viewer.session.value("view.altitude") == 2.0
    assert "view.altitude is -5000" in viewer.message
    viewer.set("view.altitude", 10.0)
    viewer.set_state({"values": {**viewer.values, "view.altitude": 20.0}})
    assert viewer.message == ""


def test_solution_arrives_as_tables(viewer: Any, solution: Any) -> None:
    # the first table of the spectra is the extinction, of three wavelengths in texels of four
    data = viewer.picture["tables"]["spectra"]["data"]
    numbers = np.frombuffer(data, np.float32).reshape(-1, 4)
    extinction = solution.light.extinction.reshape(-1, solution.light.lanes)[:, :4]
    assert_array_equal(numbers[: len(extinction)], extinction)
    assert viewer.picture["radius"] == solution.medium.bottom_radius
    assert viewer.status.startswith("default, ")


def test_closing_ends_the_thread(solution: Any) -> None:
    from airlight.viewer.browser.notebook import Viewer

    before = set(threading.enumerate())
    viewer = Viewer("mars")
    (thread,) = (one for one in set(threading.enumerate()) - before if "solving" in one.name)
    viewer.close()
    viewer.session.set("view.altitude", 7.0)  # no follower is left
    assert viewer.values["view.altitude"] == 2.0
    thread.join(120.0)
    assert not thread.is_alive()
