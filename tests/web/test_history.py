"""Undo in the browser and in Python: the same edits give the same steps."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from airlight.viewer.parameters.view_parameters import DEFAULTS, view_parameters
from airlight.viewer.session.history import MOST_STEPS
from airlight.viewer.session.session import Session

#: Actions: ("set", path, value), ("hold", path, value), ("move", gesture, held, values),
#: ("wait", seconds), or a word.
EDITS = {
    "two drags of one parameter": [
        ("hold", "view.roll", 10.0), ("wait", 3.0), ("hold", "view.roll", 20.0), "rest",
        ("hold", "view.roll", 30.0), "rest", "undo", "undo", "redo",
    ],
    "quick and slow edits": [
        ("set", "view.roll", 1.0), ("wait", 0.3), ("set", "view.roll", 2.0), ("wait", 0.3),
        ("set", "view.roll", 3.0), ("wait", 2.0), ("set", "view.roll", 4.0), "undo", "undo",
    ],
    "another parameter between": [
        ("set", "view.roll", 1.0), ("set", "display.exposure", 1.0), ("set", "view.roll", 2.0),
        "undo", "undo", "redo", "undo", "undo",
    ],
    "a drag, the wheel and keys": [
        ("move", "look", True, {"view.heading": 10.0, "view.look_zenith": 80.0}), ("wait", 2.0),
        ("move", "look", True, {"view.heading": 20.0, "view.look_zenith": 80.0}), "rest",
        ("move", "wheel", False, {"view.altitude": 10.0}), ("wait", 0.2),
        ("move", "wheel", False, {"view.altitude": 20.0}), ("wait", 0.8),
        ("move", "wheel", False, {"view.altitude": 40.0}),
        ("move", "keys", True, {"view.altitude": 50.0}), ("wait", 9.0),
        ("move", "keys", True, {"view.altitude": 60.0, "view.latitude": 5.0}), "rest",
        "undo", "undo", "undo", "undo", "redo", "redo",
    ],
    "time that passes is no step": [
        ("set", "display.exposure", 2.0), ("move", "", False, {"view.sun_zenith": 20.0}), "undo",
    ],
    "an edit after undo": [
        ("set", "view.roll", 1.0), "undo", ("set", "view.roll", 7.0), "redo", "undo", "redo",
    ],
    "reset is one step": [
        ("set", "view.roll", 1.0), ("set", "display.tone_map", "agx"), "reset", "undo", "undo",
    ],
}  # fmt: skip


class Clock:
    now = 100.0


def by_python(edits: list[Any]) -> list[Any]:
    """View, and whether undo and redo are possible, after each edit."""
    clock = Clock()
    session = Session("earth-atmosphere-plus", clock=lambda: clock.now)
    seen = []
    for edit in edits:
        match edit:
            case ("wait", float(seconds)):
                clock.now += seconds
            case ("set", path, value):
                session.set(path, value)
            case ("hold", path, value):
                if session.dragged != path:
                    session.begin_drag(path)
                session.set(path, value)
            case ("move", gesture, held, values):
                session.move(values, gesture=gesture, held=held)
            case "rest":
                session.end_drag()
            case _:
                getattr(session, edit)()
        seen.append([dict(session.view), session.can_undo, session.can_redo])
    return seen


_BY_BROWSER = """([parameters, values, edits]) => {
  let now = 100;
  const state = new State(parameters, values);
  state.history = new History(() => now);
  return edits.map((edit) => {
    const [word, name, second, third] = typeof edit === "string" ? [edit] : edit;
    if (word === "wait") now += name;
    else if (word === "set") state.set({ [name]: second });
    else if (word === "hold") state.set({ [name]: second }, name);
    else if (word === "move" && name === "") state.move(third);
    else if (word === "move") state.set(third, name, second);
    else state[word]();
    return [state.values, state.canUndo, state.canRedo];
  });
}"""


@pytest.fixture
def page(modules: Callable[..., Any]) -> Any:
    return modules({"state/state": ("State",), "state/history": ("History",)})


@pytest.mark.parametrize("name", EDITS)
def test_the_same_edits_leave_the_same_steps(name: str, page: Any) -> None:
    # a second method: the session's history
    parameters = [one.as_json() for one in view_parameters()]
    got = page.evaluate(_BY_BROWSER, [parameters, dict(DEFAULTS), EDITS[name]])
    assert got == by_python(EDITS[name])


def test_as_many_steps_are_kept(page: Any) -> None:
    # one step more than are kept: the first is discarded
    rolls = [float(n % 100) for n in range(1, MOST_STEPS + 2)]
    edits = [one for roll in rolls for one in (("set", "view.roll", roll), "rest")]
    undone = ["undo"] * (MOST_STEPS + 1)
    parameters = [one.as_json() for one in view_parameters()]
    got = page.evaluate(_BY_BROWSER, [parameters, dict(DEFAULTS), edits + undone])[-1]
    assert got == by_python(edits + undone)[-1]
    assert got[0]["view.roll"] == 1.0
