"""Random edits of a session, with a solution and a frame after each: no NaN, nothing stale."""

from __future__ import annotations

import collections
import gc
import random
import re
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from tally import Tally

from airlight.errors import ParameterError
from airlight.kernel.memory import give_back
from airlight.planets import Planet
from airlight.planets.medium import Medium
from airlight.render import render
from airlight.solver.moments.settings import MomentsSettings
from airlight.solver.moments.solve import solve
from airlight.viewer.background.solver_thread import SolverThread
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
#: Limits of a single edit, in CPU time of this process and, where that stands still, of the
#: clock: a machine that others keep busy may give seconds of the one in minutes of the other. [s]
LONG, LONG_STILL = 60.0, 1800.0

QUICK = MomentsSettings(
    degree=2,
    thick_degree=2,
    radii=8,
    sun_angles=12,
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
    cut_nodes=(6, 6, 6, 6),
    cut_panels=1,
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


def three(planet: Planet) -> np.ndarray:
    """Three wavelengths within the limits of a planet. [nm]"""
    from airlight.image.spectral import default_wavelengths

    return default_wavelengths(3, *planet.wavelength_limits)


def settled(solving: SolverThread) -> bool:
    """Wait for the solution of an edit; False after ``LONG`` seconds of CPU time."""
    begun, spent = time.monotonic(), time.process_time()
    while not solving.wait(1.0):
        if time.process_time() - spent > LONG or time.monotonic() - begun > LONG_STILL:
            return False
    return True


def edit_at_random(
    session: Session, solving: SolverThread, chance: random.Random, edits: int
) -> tuple[int, collections.Counter[str]]:
    """Edit, solve and draw; check that the newest planet is shown, or refused in one line.

    Returns
    -------
    pictures : int
        Frames that were drawn.
    refused : Counter
        Lines by which edits were refused.
    """
    refused: collections.Counter[str] = collections.Counter()
    pictures = 0
    for edit in range(edits):
        name = ""
        try:
            name = act(session, chance)
        except ParameterError as error:  # the kind of value that the list itself rejects
            assert "\n" not in str(error), (edit, name)
            refused[without_places(str(error))] += 1
            continue
        assert settled(solving), (edit, name, solving.status)
        status = solving.status
        assert status.version == session.versions.planet, (edit, name)
        if status.error:
            assert "\n" not in status.error
            # SolverThread prefixes an unexpected exception with its type.
            assert not re.match(r"[A-Z]\w+: ", status.error), (edit, name, status.error)
            refused[without_places(status.error)] += 1
            # Most users undo an invalid edit; some continue.
            if chance.random() < 0.7:
                session.undo()
                assert settled(solving), (edit, name, solving.status)
            if solving.status.error:
                continue
        assert solving.latest is not None
        assert solving.latest.version == session.versions.planet, (edit, name)
        frame = render(solving.latest.solution, session.scene, orders=session.orders)
        assert np.isfinite(frame.rgb).all(), (edit, name, session.to_state())
        pictures += 1
    return pictures, refused


def begun_session() -> Session:
    """Session with small pictures, whose clock counts."""
    clock = iter(range(10**9))
    session = Session(PLANETS[0], clock=lambda: float(next(clock)))
    session.resize(6, 4)
    session.set("light.quality", "preview")
    return session


def quick_solving(session: Session) -> SolverThread:
    """Background solver with coarse grids."""
    return SolverThread(session, solver=quickly, wavelengths=lambda planet, count: three(planet))


def resident() -> float:
    """Memory in use by this process, without what the allocator keeps for later. [byte]"""
    gc.collect()
    give_back()
    return 1024.0 * float(Path("/proc/self/status").read_text().split("VmRSS:")[1].split()[0])


def soak(seconds: float, seed: int, block: int = 100) -> Tally:
    """Edit in one process for a time; memory stays flat, and no thread is left behind.

    The growth is that from the mean of the second quarter of the time to that of the last: the
    first quarter fills caches of limited size. The limit of an edit begins when the kernels of the
    first solution and its frame are compiled.
    """
    chance, tally = random.Random(seed), Tally("edits, solves and frames in one process")
    before = {one.name for one in threading.enumerate()}
    session = begun_session()
    with quick_solving(session) as solving:
        solving.wait()
        assert solving.latest is not None
        render(solving.latest.solution, session.scene, orders=session.orders)
    begun, sizes = time.monotonic(), []
    while time.monotonic() - begun < seconds:
        session = begun_session()
        try:
            with quick_solving(session) as solving:
                for _ in range(block):
                    if time.monotonic() - begun > seconds:
                        break
                    _, refused = edit_at_random(session, solving, chance, 1)
                    tally.add("refused" if refused else "held")
        except Exception as error:
            tally.add("", f"{type(error).__name__}: {ascii(str(error))[:300]}")
        sizes.append(resident())
    quarter = max(1, len(sizes) // 4)
    first, last = np.mean(sizes[quarter : 2 * quarter]), np.mean(sizes[-quarter:])
    growth = last / first - 1.0
    # the threads of the pool, which all computations share, stay
    left = {one.name for one in threading.enumerate()} - before
    left = {name for name in left if not name.startswith("airlight_")}
    tally.note = (
        f"{time.monotonic() - begun:.0f} s, memory {first / 1e6:.0f} to {last / 1e6:.0f} MB "
        f"({100.0 * growth:+.1f} %), threads left: {sorted(left) or 'none'}"
    )
    if growth > 0.05 and len(sizes) >= 8:
        tally.add("", f"memory grew by {100.0 * growth:.1f} %")
    if left:
        tally.add("", f"threads left behind: {sorted(left)}")
    return tally
