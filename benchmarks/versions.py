"""Times of this checkout and of another one in turns, on one machine in one run.

    git worktree add ../before COMMIT
    python benchmarks/versions.py ../before                    # all cases, and a table
    python benchmarks/versions.py ../before --only solve --turns 7

Each version runs in two processes of its own that wait while the others work: one started before
and one after the other version's, as the one started later was up to 1.16 times slower with the
same code. A case is made ready in all, with its tables in memory and its loops compiled, before it
is timed; nothing is read from the solutions on disk. The ratio is the median over the turns of this
version's time over the other's just before it, its geometric mean over both orders, with the least
and the largest: a shared machine changes its speed, and neighbours in time change together. Each
version keeps its compiled code in a folder of its own; compiled again, the same source was up to
1.4 times slower where each pixel is marched, so such a ratio needs several runs.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from itertools import chain
from pathlib import Path
from statistics import geometric_mean, median
from time import perf_counter, process_time
from typing import Any

ROOT = Path(__file__).parents[1]
#: Cases: name, function below, and its arguments.
CASES: tuple[tuple[str, str, tuple[Any, ...]], ...] = (
    ("solve earth, preview", "solved", ("earth", 0, "preview")),
    ("solve earth", "solved", ("earth", 0, "default")),
    ("solve earth, fine", "solved", ("earth", 0, "fine")),
    ("solve earth, 16 wavelengths", "solved", ("earth", 16, "default")),
    ("solve earth, 400 wavelengths", "solved", ("earth", 400, "default")),
    ("solve earth-hazy", "solved", ("earth-hazy", 0, "default")),
    ("solve mars", "solved", ("mars", 0, "default")),
    ("solve mars, 64 wavelengths", "solved", ("mars", 64, "default")),
    ("solve titan", "solved", ("titan", 0, "default")),
    ("solve venus", "solved", ("venus", 0, "default")),
    ("20 000 lines of sight, earth", "lines", ("earth",)),
    ("20 000 lines of sight, mars", "lines", ("mars",)),
    ("frame 720p, 16 wavelengths, earth", "frame", ("earth", False, 1280, 720)),
    ("frame 360p, each pixel marched, earth", "frame", ("earth", True, 640, 360)),
    ("frame 360p, each pixel marched, venus", "frame", ("venus", True, 640, 360)),
    ("bake earth, Bruneton's tables", "baked", ("earth",)),
    ("look-ups, a million", "look_ups", ()),
)


def solved(planet: str, count: int, quality: str) -> Any:
    """Call that solves a planet: its own wavelengths, or ``count`` of them."""
    import numpy as np

    import airlight

    one = airlight.load_planet(planet)
    nm = tuple(np.linspace(430.0, 690.0, count)) if count else None
    return lambda: airlight.solve(one, nm, quality, cache=False)


def lines(planet: str) -> Any:
    """Call that finds 16 radiances of each of 20 000 lines of sight, from the ground to space."""
    import numpy as np

    solution = solved(planet, 16, "default")()
    rng, n = np.random.default_rng(0), 20_000
    height = solution.medium.thickness * rng.random(n) ** 2
    sun, view = rng.uniform(0.0, 95.0, n), np.degrees(np.arccos(rng.uniform(-1.0, 1.0, n)))
    azimuth = rng.uniform(0.0, 180.0, n)
    return lambda: solution.radiance(
        altitude=height, sun_zenith=sun, view_zenith=view, azimuth=azimuth
    )


def frame(planet: str, exact: bool, width: int, height: int) -> Any:
    """Call that draws a frame of 16 wavelengths from three times the height of the air."""
    from airlight import Camera, Scene, render

    solution = solved(planet, 16, "default")()
    camera = Camera(width=width, height=height, field_of_view=60.0, look_zenith=110.0)
    scene = Scene(
        camera=camera, altitude=3.0 * float(solution.medium.thickness), sun_zenith=60.0
    )  # fmt: skip
    return lambda: render(solution, scene, exact=exact)


def baked(planet: str) -> Any:
    """Call that fills Bruneton's tables of a planet, of straight light, at their own size."""
    import airlight
    from airlight.planets import replace

    straight = replace(airlight.load_planet(planet), refraction="none")
    solution = airlight.solve(straight, None, "default", cache=False)
    return lambda: airlight.bake(solution, "bruneton")


def look_ups() -> Any:
    """Call that looks up a million places of a table of three channels."""
    sys.path.insert(0, str(Path(__file__).parent))
    from baseline import work

    table, at = work.first_order((32, 128, 32, 8)), work.positions(1_000_000)
    return lambda: table.look_up(at.r, at.mu, at.mu_s, at.nu)


def child() -> None:
    """Serve one version: a line in is a case to make ready, or an empty one to run it once."""
    call: Any = None
    for line in sys.stdin:
        if line.strip():
            name, arguments = json.loads(line)
            call = globals()[name](*arguments)
            call()
            answer = [0.0, 0.0]
        else:
            clock, began = perf_counter(), process_time()
            call()
            answer = [perf_counter() - clock, process_time() - began]
        print(json.dumps(answer), flush=True)


class Version:
    """A checkout, and the process that runs it."""

    def __init__(self, root: Path, cache: Path) -> None:
        environment = os.environ | {
            "PYTHONPATH": str(root / "src"), "AIRLIGHT_CACHE": str(cache),
        }  # fmt: skip
        self._process = subprocess.Popen(
            [sys.executable, str(Path(__file__)), "--child"], env=environment, text=True,
            stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )  # fmt: skip

    def ask(self, line: str) -> list[float]:
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        self._process.stdin.write(line + "\n")
        self._process.stdin.flush()
        said = self._process.stdout.readline()
        if not said:
            raise SystemExit(f"versions.py: the process of a version ended with {line}")
        return list(json.loads(said))

    def end(self) -> None:
        assert self._process.stdin is not None
        self._process.stdin.close()
        self._process.wait()


def ratio_of(turns: list[list[list[list[float]]]], kind: int) -> list[float]:
    """Median ratio of the two versions' times, by pair of processes; wall (0) or CPU (1)."""
    pairs = zip(*turns, strict=True)
    return [median(now[kind] / before[kind] for before, now in some) for some in pairs]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("other", type=Path, nargs="?", help="folder of the other checkout")
    parser.add_argument("--only", default="", help="cases whose name has this")
    parser.add_argument("--turns", type=int, default=5, help="of each pair of processes")
    parser.add_argument("--cache", type=Path, help="folder that keeps both versions' compiled code")
    parser.add_argument("--child", action="store_true", help=argparse.SUPPRESS)
    given = parser.parse_args()
    if given.child:
        child()
        return
    if given.other is None or not (given.other / "src" / "airlight").is_dir():
        parser.error("the other checkout: a folder with src/airlight")
    with tempfile.TemporaryDirectory() as temporary:
        cache = given.cache or Path(temporary)
        roots = given.other.resolve(), ROOT
        both = list(zip(roots, "ab", strict=True))
        started = [
            [Version(root, cache / name) for root, name in some] for some in (both, both[::-1])
        ]
        pairs = [started[0], started[1][::-1]]
        print("| case | before [s] | now [s] | ratio, least to largest | processor |")
        print("|---|---|---|---|---|", flush=True)
        for name, function, arguments in CASES:
            if given.only not in name:
                continue
            for pair in pairs:
                for version in pair:
                    version.ask(json.dumps([function, arguments]))
            turns = [[[one.ask("") for one in pair] for pair in pairs] for _ in range(given.turns)]
            before, now = ([pair[k][0] for pair in chain(*turns)] for k in (0, 1))
            ratios = [b / a for a, b in zip(before, now, strict=True)]
            wall, busy = (geometric_mean(ratio_of(turns, kind)) for kind in (0, 1))
            print(
                f"| {name} | {median(before):.3g} | {median(now):.3g} | {wall:.2f} "
                f"({min(ratios):.2f} to {max(ratios):.2f}) | {busy:.2f} |",
                flush=True,
            )
        for pair in pairs:
            for version in pair:
                version.end()


if __name__ == "__main__":
    main()
