"""Sun and Moon of a page by date and time: the same edits as in a session, the same view."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from airlight.viewer.navigation.flight import Flight
from airlight.viewer.navigation.keys import RATES
from airlight.viewer.session.session import Session

#: Edits one after another, each a step of its own; a number of seconds lets time pass.
EDITS: list[dict[str, float | bool] | float] = [
    {"view.latitude": 59.33},
    {"view.longitude": 18.07},
    {"view.hour": 20.25},
    {"view.day": 365.0},
    10.0,
    {"view.year": 1987.0},
    {"view.latitude": -34.0},
    {"view.sun_zenith": 50.0},
    {"view.longitude": 100.0},
    1.0,
    {"view.clock": True},
    {"view.altitude": 5000.0},
    {"view.second_zenith": 40.0},
    {"view.hour": 3.0},
    {"view.moon_by_date": True},
    {"view.second_light": "none"},
    {"view.second_temperature": 5000.0},
]
NAMES = (
    "clock", "year", "day", "hour", "sun_zenith", "sun_azimuth", "latitude", "longitude",
    "moon_by_date", "second_zenith", "second_azimuth", "moon_phase", "second_radius",
)  # fmt: skip
LIGHTS = ["none", "moon", "second sun"]


def after_each(session: Session) -> list[list[float]]:
    """Values of the view after each edit in Python."""
    seen = []
    for edit in EDITS:
        if isinstance(edit, float):
            Flight(session).pass_time(edit * RATES["time"] / 3600.0)
        else:
            for path, value in edit.items():
                session.set(path, value)
        values = [float(session.view[f"view.{name}"]) for name in NAMES]
        seen.append([*values, LIGHTS.index(str(session.view["view.second_light"]))])
    return seen


@pytest.mark.parametrize(("planet", "fixed"), [("earth", None), ("earth", "earth"), ("mars", None)])
def test_sun_of_the_page_is_that_of_the_session(
    planet: str, fixed: str | None, modules: Callable[..., Any]
) -> None:
    session = Session(planet)
    # a page has its planet's body beside the parameters, of which that is none
    parameters = [one.as_json() for one in session.parameters if not fixed or one.path != "body"]
    values = {one["path"]: session.values[one["path"]] for one in parameters}
    page = modules({"state/state": ("State",), "ui/flight": ("Flight",)})
    seen = page.evaluate(
        """([parameters, values, fixed, edits, names, lights, step]) => {
          const state = new State(parameters, values, fixed);
          const flight = new Flight(state, () => {}, () => 6360000);
          flight.playing = true;
          return edits.map((edit) => {
            if (typeof edit === "number") {
              flight.now = 0;
              for (let s = 1; s * step < edit + step / 2; s++) flight.advance(s * step * 1000);
            } else {
              state.set(edit);
            }
            const light = lights.indexOf(state.get("view.second_light"));
            return [...names.map((name) => Number(state.get(`view.${name}`))), light];
          });
        }""",
        [parameters, values, fixed, EDITS, NAMES, LIGHTS, RATES["longest_step"]],
    )
    for theirs, ours in zip(seen, after_each(session), strict=True):
        assert theirs == pytest.approx(ours, abs=1e-6)
