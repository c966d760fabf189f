"""Random edits of declared parameters: no NaN, no crash, no stale picture."""

from __future__ import annotations

import random
import re
import time
from collections.abc import Callable

import numpy as np
import pytest
from sessions import (
    LONG,
    begun_session,
    drawn,
    edit_at_random,
    quick_solving,
    quickly,
    three,
    without_places,
)

from airlight.render import render
from airlight.viewer.background.solver_thread import SolverThread
from airlight.viewer.session.session import Session

#: Number of edits of particles.
EDITS = 24


@pytest.mark.filterwarnings("ignore:energy is not conserved")  # extreme planets are drawn too
@pytest.mark.slow
@pytest.mark.parametrize("edits", [80, pytest.param(1000, marks=pytest.mark.validation)])
def test_random_edits(edits: int, tell: Callable[[str], None]) -> None:
    # After each edit the newest planet is shown or rejected in one line; its light is finite.
    session = begun_session()
    started = time.perf_counter()
    with quick_solving(session) as solving:
        pictures, refused = edit_at_random(session, solving, random.Random(20260), edits)
    seconds = time.perf_counter() - started
    tell(f"random edits: {edits} in {seconds:.0f} s, {pictures} pictures, "
         f"{refused.total()} refused:")  # fmt: skip
    for line, count in refused.most_common():
        tell(f"  {count:4d}  {line}")
    assert pictures > edits // 3


@pytest.mark.slow
def test_random_edits_of_particles(tell: Callable[[str], None]) -> None:
    # As above for exact Mie, whose new sizes and indices take seconds: fewer edits, of those keys.
    chance = random.Random(5)
    clock = iter(range(10**9))
    session = Session("mars-openspace", clock=lambda: float(next(clock)))
    session.resize(6, 4)
    session.set("light.quality", "preview")
    refused: list[str] = []
    pictures = 0
    with SolverThread(
        session, solver=quickly, wavelengths=lambda planet, count: three(planet)
    ) as solving:
        for edit in range(EDITS):
            particles = [one for one in session.parameters if ".particles." in one.path]
            one = chance.choice(particles)
            # Mie of the largest particles takes a minute: the middle of the slider suffices.
            value = "mie" if edit == EDITS // 2 else one.at(chance.random() * 0.7)
            path = "dust.particles.method" if edit == EDITS // 2 else one.path
            if edit != EDITS // 2 and one.kind != "number":
                value = drawn(one, chance)
            session.set(path, value)
            assert solving.wait(10 * LONG), (path, solving.status)
            assert solving.status.version == session.versions.planet
            if solving.status.error:
                assert not re.match(r"[A-Z]\w+: ", solving.status.error), solving.status.error
                refused.append(without_places(solving.status.error))
                session.undo()
                assert solving.wait(10 * LONG), (path, solving.status)
                continue
            assert solving.latest is not None
            assert solving.latest.version == session.versions.planet
            assert np.isfinite(render(solving.latest.solution, session.scene).rgb).all()
            pictures += 1
    tell(f"edits of particles: {pictures} pictures of {EDITS}, refused: {sorted(set(refused))}")
    assert pictures > EDITS // 2
