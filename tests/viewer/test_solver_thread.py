"""Solving thread that follows a session."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from airlight.errors import Cancelled
from airlight.planets import Planet, load_planet
from airlight.viewer.background.solver_thread import SolverThread
from airlight.viewer.session.session import Session

PLANET = "earth-atmosphere-plus"
#: Time limit of any wait here, generous for a busy machine. [s]
LONG = 60.0


@dataclass
class Fake:
    """Solver that records its calls and can be blocked."""

    asked: list[tuple[float, str]]
    gate: threading.Event
    running: threading.Event
    held: tuple[str, ...] = ()

    def __call__(
        self,
        planet: Planet,
        wavelengths: np.ndarray,
        quality: str,
        *,
        progress: Callable[[int, int, str], None],
        cancel: Callable[[], bool],
    ) -> Any:
        self.asked.append((planet.ground.albedo, quality))
        progress(0, 2, "")
        if quality in self.held:
            self.running.set()
            while not self.gate.wait(0.001):
                if cancel():
                    raise Cancelled("cancelled")
        return (planet.ground.albedo, quality)


@pytest.fixture
def fake() -> Fake:
    return Fake([], threading.Event(), threading.Event())


def test_preview_comes_first_and_the_wanted_quality_follows(fake: Fake) -> None:
    # By contract; the solver records the order.
    with SolverThread(Session(PLANET), solver=fake) as solving:
        assert solving.wait(LONG)
        assert fake.asked == [(0.1, "preview"), (0.1, "default")]
        assert solving.latest is not None
        assert solving.latest.quality == "default"
        assert solving.status.error == ""
        assert not solving.status.busy


def test_an_edit_of_clouds_solves_no_air(fake: Fake) -> None:
    # Solutions do not depend on three-dimensional clouds; a host without them refuses the planet.
    session = Session(PLANET)
    with SolverThread(session, solver=fake, draws_clouds=True) as solving:
        assert solving.wait(LONG)
        session.set("clouds[0].kind", "cumulus")
        session.set("clouds[0].cover", 0.7)
        assert solving.wait(LONG)
        assert solving.latest is not None
        assert [one.cover for one in solving.latest.cloudy.clouds] == [0.7]
        assert solving.latest.planet.clouds == ()
        assert len(fake.asked) == 2
    with SolverThread(session, solver=fake) as solving:
        assert solving.wait(LONG)
        assert "clouds cannot be used" in solving.status.error


def test_the_newest_edit_stops_what_runs_for_an_older_one(fake: Fake) -> None:
    # The gate stays shut: only cancelling lets the next solve begin.
    fake.held = ("default",)
    session = Session(PLANET)
    with SolverThread(session, solver=fake) as solving:
        assert fake.running.wait(LONG)
        session.set("ground.albedo", 0.5)
        fake.held = ()
        assert solving.wait(LONG)
        assert solving.latest is not None
        assert solving.latest.solution == (0.5, "default")
        assert solving.latest.version == session.versions.planet


def test_edits_faster_than_previews_do_not_starve_the_picture(fake: Fake) -> None:
    # A running preview is finished and shown, although there is a newer request.
    fake.held = ("preview",)
    session = Session(PLANET)
    shown: list[int] = []

    def note() -> None:
        if solving.latest is not None:
            shown.append(solving.latest.version)

    with SolverThread(session, solver=fake) as solving:
        assert fake.running.wait(LONG)
        solving._on_change = note
        first = session.versions.planet
        for albedo in (0.2, 0.3, 0.4):
            session.set("ground.albedo", albedo)
        fake.gate.set()
        assert solving.wait(LONG)
    assert first in shown
    assert shown[-1] == session.versions.planet
    assert [albedo for albedo, _ in fake.asked] == [0.1, 0.4, 0.4]


def test_a_preview_that_takes_too_long_is_given_up_for_a_newer_edit(
    fake: Fake, monkeypatch: pytest.MonkeyPatch
) -> None:
    # The gate stays shut: only patience ends the preview of the first planet.
    monkeypatch.setattr("airlight.viewer.background.solver_thread.PATIENCE", 0.05)
    fake.held = ("preview",)
    session = Session(PLANET)
    with SolverThread(session, solver=fake) as solving:
        assert fake.running.wait(LONG)
        session.set("ground.albedo", 0.5)
        fake.held = ()
        assert solving.wait(LONG)
        assert solving.latest is not None
        assert solving.latest.solution == (0.5, "default")


def test_view_and_display_need_no_solution(fake: Fake) -> None:
    # Only the planet, its switches, wavelengths and quality are solved.
    session = Session(PLANET)
    with SolverThread(session, solver=fake) as solving:
        assert solving.wait(LONG)
        asked = len(fake.asked)
        session.set("view.altitude", 1e6)
        session.set("display.exposure", 2.0)
        session.set("light.orders", "single")
        assert solving.idle
        assert len(fake.asked) == asked


def test_undo_and_the_other_side_come_from_what_is_kept(fake: Fake) -> None:
    # The same planet was solved just before.
    session = Session(PLANET)
    with SolverThread(session, solver=fake) as solving:
        assert solving.wait(LONG)
        session.swap()
        session.set("ground.albedo", 0.5)
        assert solving.wait(LONG)
        asked = len(fake.asked)
        for back in (session.swap, session.swap, session.undo, session.redo):
            back()
            assert solving.wait(LONG)
            assert solving.latest is not None
            assert solving.latest.version == session.versions.planet
            albedo = session.value("ground.albedo")
            assert solving.latest.solution == (albedo, "default")
        assert len(fake.asked) == asked


def test_tables_of_a_solution_are_kept_only_while_it_is_shown(fake: Fake) -> None:
    # They take up to 60 MB; whoever asks for the same planet again gets the same solution.
    session, made = Session(PLANET), SimpleNamespace
    with SolverThread(session, solver=lambda *_, **__: made(), draws_clouds=True) as solving:
        assert solving.wait(LONG)
        shown: Any = solving.latest
        shown.solution.tables = "large"
        session.set("clouds[0].kind", "cumulus")
        assert solving.wait(LONG)
        assert solving.latest is not None
        assert solving.latest.solution is shown.solution
        session.set("ground.albedo", 0.5)
        assert solving.wait(LONG)
        for _ in range(2):  # once more, after what came back has got tables
            session.undo()
            assert solving.wait(LONG)
            assert vars(solving.latest.solution) == {}
            solving.latest.solution.tables = "large"
            session.redo()
            assert solving.wait(LONG)


def test_an_impossible_planet_is_one_line_and_leaves_the_picture(fake: Fake) -> None:
    # Air cannot end below the ground: the reader says so.
    session = Session(PLANET)
    with SolverThread(session, solver=fake) as solving:
        assert solving.wait(LONG)
        before = solving.latest
        session.set("shell.top_radius", 6000.0)
        assert solving.wait(LONG)
        assert solving.latest is before
        assert "shell.top_radius is 6000000.0" in solving.status.error
        assert "\n" not in solving.status.error
        assert solving.status.version == session.versions.planet
        session.undo()
        assert solving.wait(LONG)
        assert solving.status.error == ""


def test_a_star_without_light_has_no_picture_and_says_so(fake: Fake) -> None:
    # The reader allows an irradiance of 0, which cannot serve as a weight.
    session = Session("earth-bruneton")
    with SolverThread(session, solver=fake) as solving:
        session.set("light.wavelengths", "three")  # those of the file, 550 nm among them
        session.set("star.irradiance[1]", 0.0)
        assert solving.wait(LONG)
        assert solving.status.error == "irradiance is 0.0; allowed: above 0 at every wavelength"


def test_a_solver_that_breaks_does_not_end_the_thread(fake: Fake) -> None:
    # The next edit is solved.
    session = Session(PLANET)

    def breaks(planet: Planet, *arguments: Any, **named: Any) -> Any:
        if planet.ground.albedo == 0.5:
            raise RuntimeError("two\nlines")
        return fake(planet, *arguments, **named)

    with SolverThread(session, solver=breaks) as solving:
        session.set("ground.albedo", 0.5)
        assert solving.wait(LONG)
        assert solving.status.error == "RuntimeError: two lines"
        session.set("ground.albedo", 0.6)
        assert solving.wait(LONG)
        assert solving.status.error == ""


def test_idle_costs_no_cpu_time_and_close_ends_the_thread(fake: Fake) -> None:
    # A thread waiting on a condition uses no time; the clock counts this process's threads.
    solving = SolverThread(Session(PLANET), solver=fake)
    assert solving.wait(LONG)
    spent, until = 1.0, time.monotonic() + LONG
    while spent >= 0.02:  # what the last solve leaves behind may take a moment to end
        assert time.monotonic() < until
        before = time.process_time()
        time.sleep(0.5)
        # the sleep itself, and the clock's resolution
        spent = time.process_time() - before
    solving.close()
    assert not solving._thread.is_alive()


def test_a_switched_off_constituent_is_gone_from_what_is_solved() -> None:
    # Its coefficients are 0; the others are the planet's.
    planets: list[Planet] = []

    def note(planet: Planet, *arguments: Any, **named: Any) -> None:
        planets.append(planet)

    session = Session(PLANET)
    with SolverThread(session, solver=note) as solving:
        session.set("light.constituents[0]", False)
        assert solving.wait(LONG)
    own = load_planet(PLANET)
    assert planets[-1].constituents[0].scattering == 0.0
    assert planets[-1].constituents[0].profile == own.constituents[0].profile
    assert planets[-1].constituents[1:] == own.constituents[1:]
