"""Random edits of declared parameters: no NaN, no crash, no stale picture."""

from __future__ import annotations

import collections
import random
import re
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from airlight.errors import ParameterError
from airlight.planets import Planet
from airlight.planets.medium import Medium
from airlight.render import render
from airlight.solvers.moments.settings import Settings
from airlight.solvers.moments.solution import solve
from airlight.viewer.background.solving import Solving
from airlight.viewer.parameters.parameter import Parameter, Value
from airlight.viewer.session.session import Session

#: Standard and advanced forms: coefficients, layers, gases, columns, turbidity, a black body, dust
#: by coefficients. Exact Mie takes seconds per edit and has its own test below.
PLANETS = (
    "earth-atmosphere-plus",
    "earth-bruneton",
    "earth-openspace-advanced",
    "earth-openspace-refractive",
    "exoplanet",
    "mars-rayleigh",
    "mars-standard",
)
#: Time limit of a single edit, generous for a busy machine. [s]
LONG = 60.0

QUICK = Settings(
    degree=2,
    thick_degree=2,
    radii=8,
    suns=12,
    zenith_angles=4,
    horizon_angles=2,
    high_angles=2,
    azimuths=3,
    nodes=6,
    tolerance=5e-2,
    max_sweeps=400,
    column_radii=16,
    column_directions=32,
    march_nodes=6,
    march_panels=1,
)


def quickly(
    planet: Planet,
    wavelengths: np.ndarray,
    quality: str,
    *,
    progress: Callable[[int, int, str], None],
    cancel: Callable[[], bool],
) -> Any:
    """Moments solver with the coarsest grids."""
    medium = Medium.from_planet(planet, wavelengths, progress=progress, cancel=cancel)
    solution = solve(medium, QUICK, cache=False, progress=progress, cancel=cancel)
    solution.planet = planet
    return solution


def drawn(one: Parameter, chance: random.Random) -> Value:
    """Random value: mostly on the slider, sometimes its ends, sometimes within the typed limits."""
    if one.kind == "switch":
        return chance.random() < 0.5
    if one.kind == "choice":
        return chance.choice(one.options)
    if one.kind == "text":
        return chance.choice(["dust", "air", "x" * 61, "", "snow \u2744"])
    where = chance.random()
    if where < 0.8:
        return one.at(chance.random())
    if where < 0.95:
        return chance.choice([one.low, one.high])
    ends = [end for end in (one.least, one.most) if np.isfinite(end)]
    return chance.choice(ends or [one.low])


def act(session: Session, chance: random.Random) -> str:
    """Perform a random user action; returns its name."""
    what = chance.random()
    if what < 0.10:
        session.undo()
        return "undo"
    if what < 0.14:
        session.redo()
        return "redo"
    if what < 0.17:
        session.swap()
        return "swap"
    if what < 0.20:
        session.reset(chance.choice(["", *sorted({one.group for one in session.parameters})]))
        return "reset"
    if what < 0.22:
        session.open(chance.choice(PLANETS))
        return "open"
    if what < 0.24:
        session.from_state(session.to_state())
        return "state"
    one = chance.choice(
        [p for p in session.parameters if p.kind != "text" or chance.random() < 0.1]
    )
    session.set(one.path, drawn(one, chance))
    return one.path


def without_places(line: str) -> str:
    """Error line without its numbers, to count kinds."""
    if " is " not in line:
        return re.sub(r"[-+]?\d[\d.e+-]*", "N", line)
    field, _, allowed = line.partition(" is ")
    allowed = allowed.rpartition("allowed: ")[2]
    return re.sub(r"[-+]?\d[\d.e+-]*", "N", f"{field.rpartition(': ')[2]} … {allowed}")[:90]


@pytest.mark.slow
@pytest.mark.parametrize("edits", [120, pytest.param(1000, marks=pytest.mark.validation)])
def test_random_edits(edits: int, tell: Callable[[str], None]) -> None:
    # After each edit the newest planet is shown or rejected in one line; its light is finite.
    chance = random.Random(20260)
    clock = iter(range(10**9))
    session = Session(PLANETS[0], clock=lambda: float(next(clock)))
    session.resize(6, 4)
    session.set("light.quality", "preview")
    refused: collections.Counter[str] = collections.Counter()
    pictures = 0
    started = time.perf_counter()
    with Solving(
        session, solver=quickly, wavelengths=lambda planet, count: three(planet)
    ) as solving:
        for edit in range(edits):
            name = ""
            try:
                name = act(session, chance)
            except ParameterError as error:  # the kind of value that the list itself rejects
                assert "\n" not in str(error), (edit, name)
                refused[without_places(str(error))] += 1
                continue
            assert solving.wait(LONG), (edit, name, solving.status)
            status = solving.status
            assert status.version == session.versions.planet, (edit, name)
            if status.error:
                assert "\n" not in status.error
                # Solving prefixes an unexpected exception with its type.
                assert not re.match(r"[A-Z]\w+: ", status.error), (edit, name, status.error)
                refused[without_places(status.error)] += 1
                # Most users undo an invalid edit; some continue.
                if chance.random() < 0.7:
                    session.undo()
                    assert solving.wait(LONG), (edit, name, solving.status)
                if solving.status.error:
                    continue
            assert solving.latest is not None
            assert solving.latest.version == session.versions.planet, (edit, name)
            frame = render(solving.latest.solution, session.scene, orders=session.orders)
            assert np.isfinite(frame.rgb).all(), (edit, name, session.to_state())
            pictures += 1
    seconds = time.perf_counter() - started
    count = sum(refused.values())
    tell(f"random edits: {edits} in {seconds:.0f} s, {pictures} pictures, {count} refused:")
    for line, count in refused.most_common():
        tell(f"  {count:4d}  {line}")
    assert pictures > edits // 3


def three(planet: Planet) -> np.ndarray:
    """Three wavelengths within the limits of a planet. [nm]"""
    from airlight.color.spectral import default_wavelengths

    return default_wavelengths(3, *planet.wavelength_limits)


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
    with Solving(
        session, solver=quickly, wavelengths=lambda planet, count: three(planet)
    ) as solving:
        for edit in range(40):
            particles = [one for one in session.parameters if ".particles." in one.path]
            one = chance.choice(particles)
            # Mie of the largest particles takes a minute: the middle of the slider suffices.
            value = "mie" if edit == 20 else one.at(chance.random() * 0.7)
            path = "dust.particles.method" if edit == 20 else one.path
            if edit != 20 and one.kind != "number":
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
    tell(f"random edits of particles: {pictures} pictures of 40, refused: {sorted(set(refused))}")
    assert pictures > 20
