"""Values, undo, comparison and links in the browser."""

from __future__ import annotations

import json
from collections.abc import Callable
from typing import Any
from urllib.parse import unquote

import numpy as np
import pytest
from numpy.testing import assert_allclose

from airlight.viewer.session.adaptation import Adaptation

PARAMETERS = [
    {
        "path": "view.altitude", "label": "altitude", "group": "camera", "help": "Above ground.",
        "kind": "number", "unit": "m", "low": 1.0, "high": 1e9, "least": 0.0, "most": 1e12,
        "scale": "log", "step": 1.1, "wraps": False, "options": [], "mode": "standard",
        "part_of": "",
    },
    {
        "path": "view.heading", "label": "heading", "group": "camera", "help": "Bearing.",
        "kind": "number", "unit": "deg", "low": 0.0, "high": 360.0, "least": 0.0, "most": 360.0,
        "scale": "linear", "step": 1.0, "wraps": True, "options": [], "mode": "standard",
        "part_of": "",
    },
    {
        "path": "display.tone_map", "label": "tone map", "group": "display", "help": "How.",
        "kind": "choice", "unit": "1", "low": 0.0, "high": 1.0, "scale": "linear", "step": 0.01,
        "wraps": False, "options": ["hable", "reinhard"], "mode": "standard", "part_of": "",
    },
    {
        "path": "display.automatic", "label": "automatic", "group": "display", "help": "Finds it.",
        "kind": "switch", "unit": "1", "low": 0.0, "high": 1.0, "scale": "linear", "step": 0.01,
        "wraps": False, "options": [], "mode": "advanced", "part_of": "",
    },
]  # fmt: skip
VALUES = {
    "view.altitude": 100.0,
    "view.heading": 350.0,
    "display.tone_map": "hable",
    "display.automatic": True,
}


@pytest.fixture
def page(modules: Callable[..., Any]) -> Any:
    """Page with a state as `state`, and its controls in the body."""
    page = modules(
        {
            "state/state": ("State",),
            "ui/controls": ("Controls",),
            "state/parameters": ("numberAt", "shareOf"),
        }
    )
    page.evaluate(
        """([parameters, values]) => {
          window.state = new State(parameters, values);
          window.said = [];
          const place = document.body.appendChild(document.createElement("div"));
          window.controls = new Controls(place, state, (text) => said.push(text));
        }""",
        [PARAMETERS, VALUES],
    )
    return page


def test_drag_is_one_step_of_undo(page: Any) -> None:
    got = page.evaluate(
        """() => {
          for (const heading of [10, 20, 30]) state.set({ "view.heading": heading }, "drag 1");
          state.rest();
          state.set({ "view.altitude": 5 });
          const seen = [state.values];
          state.undo(); seen.push(state.values);
          state.undo(); seen.push(state.values);
          state.redo(); seen.push(state.values);
          state.reset(); seen.push(state.values);
          state.undo(); seen.push(state.values);
          return seen.map((v) => [v["view.altitude"], v["view.heading"]]);
        }"""
    )
    assert got == [[5, 30], [100, 30], [100, 350], [100, 30], [100, 350], [100, 30]]


def test_values_that_cannot_be_change_nothing(page: Any) -> None:
    got = page.evaluate(
        """() => [
          { "view.altitude": -1 }, { "view.altitude": NaN }, { "display.tone_map": "?" },
          { "display.automatic": 1 }, { "nobody": 1 }, { "view.heading": 5, "view.altitude": 1e13 },
        ].map((changes) => { try { state.set(changes); } catch (e) { return e.message; } })"""
    )
    assert got == [
        "view.altitude is -1; allowed: 0 to 1000000000000 m",
        "view.altitude is NaN; allowed: 0 to 1000000000000 m",
        "display.tone_map is ?; allowed: hable, reinhard",
        "display.automatic is 1; allowed: true or false",
        "there is no parameter nobody",
        "view.altitude is 10000000000000; allowed: 0 to 1000000000000 m",
    ]
    assert page.evaluate("state.values") == VALUES
    assert page.evaluate("state.canUndo") is False


def test_link_carries_what_differs_and_nothing_else(page: Any) -> None:
    got = page.evaluate(
        """() => {
          state.planet = "mars";
          state.set({ "view.altitude": 1e-7, "view.heading": -90, "display.automatic": false });
          const text = state.asFragment();
          const other = new State([...state.parameters.values()], state.initial);
          other.planet = "mars";
          const faults = other.takeFragment(`#${text}`);
          return [text, other.values, state.values, faults];
        }"""
    )
    text, taken, sent, faults = got
    assert json.loads(unquote(text)) == {
        "planet": "mars",
        "view": {"view.altitude": 1e-7, "view.heading": 270, "display.automatic": False},
    }
    assert taken == sent
    assert faults == []


def test_link_has_the_view_that_a_window_has_by_default(page: Any) -> None:
    # A page begins with a view of its own: its link has all that differs from the declared
    # defaults, which a window begins with, and a window's link leaves these out.
    got = page.evaluate(
        """() => {
          state.planet = "mars";
          state.parameters.get("view.altitude").default = 2;
          state.set({ "view.heading": 5 });
          const text = state.asFragment();
          const faults = state.takeFragment('#{"planet":"mars","view":{"view.heading":7}}');
          return [text, state.values, faults];
        }"""
    )
    view = json.loads(unquote(got[0]))["view"]
    assert view == {"view.altitude": 100.0, "view.heading": 5}
    assert got[1:] == [{**VALUES, "view.altitude": 2.0, "view.heading": 7}, []]


def test_link_that_cannot_be_read_is_said_and_the_rest_is_taken(page: Any) -> None:
    got = page.evaluate(
        """() => ['{"planet":"","view":{"display.tone_map":"none","view.heading":5,"x":1}}', "{",
          '{"planet":"venus"}'].map((text) => [state.takeFragment(`#${text}`), state.values])"""
    )
    assert got[0][0] == [
        "display.tone_map is none; allowed: hable, reinhard",
        "there is no parameter x",
    ]
    assert got[0][1] == {**VALUES, "view.heading": 5}
    assert len(got[1][0]) == 1
    assert got[2] == [["it shows venus, this is "], VALUES]


def test_comparison_swaps_two_states(page: Any) -> None:
    got = page.evaluate(
        """() => {
          state.shareCamera(false);
          state.keepOther();
          state.set({ "view.heading": 1 });
          const seen = [[state.showing, state.get("view.heading")]];
          state.swap(); seen.push([state.showing, state.get("view.heading")]);
          state.swap(); seen.push([state.showing, state.get("view.heading")]);
          return seen;
        }"""
    )
    assert got == [["A", 1], ["B", 350], ["A", 1]]


def test_two_sides_share_the_camera_and_have_steps_of_their_own(page: Any) -> None:
    # as in the session: a swap keeps camera and sun, and undo applies to its side
    got = page.evaluate(
        """() => {
          state.set({ "display.tone_map": "reinhard" });
          state.swap();
          const seen = [[state.showing, state.canUndo, state.get("display.tone_map")]];
          state.set({ "display.tone_map": "hable" });
          state.set({ "view.heading": 5 }, "look"); state.rest();
          state.swap();
          seen.push([state.showing, state.get("view.heading"), state.get("display.tone_map")]);
          state.undo();
          seen.push([state.canUndo, state.get("view.heading"), state.get("display.tone_map")]);
          state.swap();
          state.undo(); state.undo();
          seen.push([state.showing, state.get("view.heading"), state.get("display.tone_map")]);
          return seen;
        }"""
    )
    assert got == [
        ["B", False, "reinhard"],
        ["A", 5, "reinhard"],
        [False, 5, "hable"],
        ["B", 350, "reinhard"],
    ]


def test_slider_of_a_logarithm_reaches_both_ends(page: Any) -> None:
    # low·(high/low)^share
    got = page.evaluate(
        "p => [0, 0.5, 1].map((s) => [numberAt(p, s), shareOf(p, numberAt(p, s))])", PARAMETERS[0]
    )
    assert_allclose(got, [[1.0, 0.0], [10**4.5, 0.5], [1e9, 1.0]], atol=1e-15, rtol=1e-12)
    slider = page.locator("[data-path='view.altitude'] input[type=range]")
    slider.focus()
    slider.press("End")
    assert page.evaluate("state.get('view.altitude')") == 1e9
    slider.press("Home")
    assert page.evaluate("state.get('view.altitude')") == 1


def test_fields_take_numbers_and_refuse_words(page: Any) -> None:
    field = page.locator("[data-path='view.altitude'] input[type=text]")
    field.fill("2500")
    field.press("Enter")
    assert page.evaluate("state.get('view.altitude')") == 2500
    field.fill("high")
    field.press("Enter")
    assert page.evaluate("state.get('view.altitude')") == 2500
    assert page.evaluate("said.at(-1)") == "view.altitude is NaN; allowed: 0 to 1000000000000 m"
    assert page.locator(".airlight-wrong").count() == 1
    page.locator("[data-path='display.tone_map'] select").select_option("reinhard")
    assert page.evaluate("state.get('display.tone_map')") == "reinhard"
    # an advanced parameter is shown on demand
    assert page.locator("[data-path='display.automatic']").count() == 0
    page.evaluate("controls.advanced = true; controls.build();")
    page.locator("[data-path='display.automatic'] input").uncheck()
    assert page.evaluate("state.get('display.automatic')") is False


def test_the_exposure_eases_as_in_python(modules: Callable[..., Any]) -> None:
    page = modules({"state/adaptation": ("Adaptation",)})
    got = page.evaluate(
        """() => {
          let now = 100;
          const adaptation = new Adaptation(() => now);
          const steps = [[-3, false], [1, true], ...Array(12).fill([1, false]), [-2, false, true]];
          return steps.map((step) => {
            now += 0.05;
            return adaptation.towards(...step);
          });
        }"""
    )
    times = iter(100.0 + 0.05 * (1 + np.arange(15)))
    adaptation = Adaptation(lambda: next(times))
    steps = [(-3.0, False), (1.0, True), *[(1.0, False)] * 12]
    expected = [adaptation.towards(to, held=held) for to, held in steps]
    assert_allclose(got[:-1], expected, rtol=1e-12)
    assert got[-1] == adaptation.towards(-2.0, held=False, at_once=True) == -2.0


#: A model like a host's, whose kernel hears when told; its last message as `sent()`.
_REMOTE = """([parameters, values]) => {
  const traits = { parameters, values, can: {}, heard: {}, messages: {} };
  window.model = {
    get: (name) => traits[name],
    set: (name, value) => { traits[name] = value; },
    save_changes: () => {},
  };
  window.state = new RemoteState(model);
  window.unheard = () => Object.values(traits.messages)[0] ?? [];
  window.sent = () => unheard().at(-1);
  window.answer = (message, values) => {
    traits.heard = message ? { [state.name]: message.count } : { other: 9 };
    traits.values = { ...traits.values, ...values };
    state.hear();
  };
}"""


@pytest.fixture
def remote(modules: Callable[..., Any]) -> Any:
    """Page with a state in Python as `state`."""
    page = modules({"state/remote_state": ("RemoteState",)})
    page.evaluate(_REMOTE, [PARAMETERS, VALUES])
    return page


def test_a_late_answer_does_not_undo_an_edit(remote: Any) -> None:
    # A busy kernel answers to the first of two edits after the second was made.
    got = remote.evaluate(
        """() => {
          const seen = [], messages = [];
          for (const altitude of [5, 7]) {
            state.set({ "view.altitude": altitude });
            state.send();
            messages.push(sent());
          }
          answer(null, { "view.altitude": 50 }); // another view's edit, before this one's arrived
          seen.push(state.values["view.altitude"]);
          answer(messages[0], { "view.altitude": 5 });
          seen.push(state.values["view.altitude"]);
          answer(messages[1], { "view.altitude": 7.5 }); // adjusted by Python
          seen.push(state.values["view.altitude"]);
          answer(messages[1], { "view.altitude": 9 }); // set by Python
          seen.push(state.values["view.altitude"]);
          state.set({ "view.altitude": 11 }); // not sent yet
          answer(messages[1], { "view.altitude": 10 });
          seen.push(state.values["view.altitude"]);
          return seen;
        }"""
    )
    assert got == [7, 7, 7.5, 9, 11]


def test_messages_are_sent_until_they_are_heard(remote: Any) -> None:
    got = remote.evaluate(
        """() => {
          state.set({ "view.altitude": 5 }, "view.altitude", true);
          state.rest();
          state.undo();
          const all = unheard();
          answer(all[1], {});
          state.redo();
          return [all, unheard()];
        }"""
    )
    first = {"edit": {"view.altitude": 5}, "gesture": "view.altitude", "held": True, "count": 1}
    rest, undo = {"command": "rest", "count": 2}, {"command": "undo", "count": 3}
    assert got == [[first, rest, undo], [undo, {"command": "redo", "count": 4}]]


def test_a_busy_kernel_gets_one_edit_of_many_frames(remote: Any) -> None:
    got = remote.evaluate(
        """async () => {
          const frame = () => new Promise((done) => requestAnimationFrame(done));
          for (let altitude = 10; altitude < 20; altitude++) {
            state.set({ "view.altitude": altitude }, "drag");
            await frame();
          }
          const before = unheard().map((one) => one.edit["view.altitude"]);
          answer(unheard()[0], {});
          await frame();
          await frame();
          return [before, unheard().map((one) => [one.count, one.edit["view.altitude"]])];
        }"""
    )
    assert got == [[10], [[2, 19]]]
