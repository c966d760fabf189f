"""Mutated planets: each is solved in time, its light without a NaN, or refused at once."""

from __future__ import annotations

import math
import random
import re
import time
import warnings
from pathlib import Path

import numpy as np
from planet_files import check_line
from tally import Tally

from airlight import solve
from airlight.errors import AirlightError, AirlightWarning, Cancelled
from airlight.planets import Planet, load_planet

#: CPU time of a solve on all of two cores, by quality. [s]
LIMITS = {"preview": 20.0, "default": 120.0}
#: CPU time of a refusal. [s]
AT_ONCE = 4.0
_NUMBER = re.compile(r"(?<![\w.+-])[-+]?\d+\.?\d*(?:e[-+]?\d+)?(?![\w.])", re.IGNORECASE)


def mutated(text: str, chance: random.Random) -> str:
    """Text of a planet file with one to four of its numbers changed, most by a power of ten."""
    lines = text.split("\n")
    for _ in range(chance.randint(1, 4)):
        places = [
            (at, found)
            for at, line in enumerate(lines)
            if not line.startswith("#") and "csv" not in line
            for found in _NUMBER.finditer(line.partition("=")[2].partition("#")[0])
        ]
        at, found = chance.choice(places)
        head, equals, value = lines[at].partition("=")
        old = float(found[0])
        kind = chance.random()
        if kind < 0.7:
            new = old * 10.0 ** chance.uniform(-3.0, 3.0)
        elif kind < 0.8:
            new = old * chance.choice((0.5, 0.9, 1.1, 2.0))
        else:
            new = chance.choice((0.0, 1.0, -old, 0.999, -0.95, 0.5, 1e-9, 1e4))
        shown = f"{new:.6g}"
        lines[at] = head + equals + value[: found.start()] + shown + value[found.end() :]
    return "\n".join(lines)


class Watch:
    """Watcher of a solve: asks it to end after some CPU time of this process."""

    def __init__(self, seconds: float) -> None:
        self.begun, self.seconds = time.process_time(), seconds

    def __call__(self) -> bool:
        return self.spent > self.seconds

    @property
    def spent(self) -> float:
        """CPU time so far. [s]"""
        return time.process_time() - self.begun


def stopped(watch: Watch, what: str) -> tuple[str, str]:
    """Verdict on work that was asked to end, and the fault if it went on for long."""
    late = watch.spent - watch.seconds
    return "stopped", f"{what}: ended {late:.0f} s late" if late > AT_ONCE else ""


def light_of(planet: Planet, quality: str, watch: Watch) -> None:
    """Solve a planet and look at its light from the ground, the middle of the air and above.

    Warnings, of light that is lost or of rings that are left out, are what a user is owed.

    Raises
    ------
    AirlightError
        If it is refused.
    AssertionError
        If light is not finite or negative.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", AirlightWarning)
        solution = solve(planet, planet.wavelengths, quality, cache=False, cancel=watch)
        thickness = solution.medium.thickness
        for altitude in (0.0, 0.3 * thickness, 3.0 * thickness):
            light = solution.radiance(
                altitude=altitude,
                sun_zenith=[[0.0], [89.0], [97.0]],
                view_zenith=[0.0, 70.0, 90.0, 180.0],
                azimuth=40.0,
            )
            values = np.asarray(light)
            assert np.isfinite(values).all(), f"not finite at {altitude:g} m"
            assert (values >= 0.0).all(), f"negative at {altitude:g} m"


def try_solves(
    count: int,
    seed: int,
    folder: Path,
    texts: tuple[str, ...],
    quality: str = "preview",
    patience: float = 1.0,
) -> Tally:
    """Solve mutated planets; those that are refused by their file are not counted.

    Particles that take longer than a solve may are announced with their time, and end when they are
    asked to: *stopped*. ``patience`` multiplies all limits.
    """
    chance, tally = random.Random(seed), Tally(f"mutated planets solved at {quality}")
    file, times, number = folder / "planet.toml", [0.0], 0
    while tally.tried < count:
        number += 1
        text = mutated(chance.choice(texts), chance)
        file.write_text(text, encoding="utf-8")
        watch = Watch(patience * LIMITS[quality])
        try:
            planet = load_planet(file, cancel=watch)
        except Cancelled:
            tally.add(*stopped(watch, f"{number}: particles"))
            continue
        except AirlightError as error:
            check_line(error)
            continue
        watch = Watch(patience * LIMITS[quality])
        try:
            try:
                light_of(planet, quality, watch)
                times.append(watch.spent)
                assert watch.spent < watch.seconds, f"solved after {watch.spent:.0f} s"
                tally.add("held")
            except Cancelled:
                raise AssertionError(f"not solved within {watch.seconds:g} s") from None
            except AirlightError as error:
                check_line(error)
                assert watch.spent < patience * AT_ONCE, (
                    f"refused after {watch.spent:.0f} s: {error}"
                )
                tally.add("refused")
        except Exception as error:  # whatever it is, it is what is looked for
            kept = folder / f"broke-{seed}-{number}.toml"
            kept.write_text(text, encoding="utf-8")
            tally.add("", f"{kept}: {type(error).__name__}: {ascii(str(error))[:300]}")
    times.sort()
    tally.note = (
        f"CPU time {np.median(times):.1f} s (median), "
        f"{times[math.ceil(0.99 * len(times)) - 1]:.1f} s (99 %), {times[-1]:.1f} s (longest)"
    )
    return tally
