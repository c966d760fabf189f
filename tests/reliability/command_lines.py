"""Odd command lines: each ends with its result, or with one line that steers no terminal."""

from __future__ import annotations

import contextlib
import os
import random
import signal
import sys
import tempfile
import time
from pathlib import Path
from typing import NoReturn

from outside_text import NAMES, OBEYED, VALUES
from tally import Tally

from airlight.cli import main
from airlight.cli.interrupt import end_when_interrupted

#: Time after an interruption from which a command counts as deaf. [s]
DEAF = 10.0

#: Command lines that end well and soon, from which odd ones are made.
GOOD: tuple[tuple[str, ...], ...] = (
    ("show", "PLANET"),
    ("show", "PLANET", "--compare", "earth-openspace"),
    ("plot", "PLANET", "density", "-o", "a.png"),
    ("plot", "PLANET", "optical-depth", "-o", "a.svg"),
    ("plot", "PLANET", "phase", "-o", "a.png", "--dpi", "50"),
    ("radiance", "PLANET", "--altitude", "2m", "--sun-zenith", "60", "--view-zenith", "30",
     "--azimuth", "90", "--quality", "preview", "--wavelengths", "550"),
    ("render", "PLANET", "--size", "8x6", "--quality", "preview", "-o", "a.png", "--device", "cpu",
     "--exposure", "-3", "--wavelengths", "rgb"),
    ("render", "PLANET", "--size", "8x6", "--quality", "preview", "-o", "a.exr", "--altitude",
     "400km", "--look-at", "horizon", "--fov", "60", "--wavelengths", "rgb", "--device", "cpu"),
    ("sky", "PLANET", "--size", "16", "--quality", "preview", "-o", "a.exr", "--for", "blender",
     "--sun-zenith", "50", "--wavelengths", "rgb", "--device", "cpu"),
    ("aerial", "PLANET", "--altitude", "500m", "--sun-zenith", "66deg", "-o", "air"),
    ("spectrum", "PLANET", "--of", "transmission", "--quality", "preview", "--wavelengths", "550"),
    ("sweep", "PLANET", "--altitude", "0m,10km", "--sun-zenith", "0:90:45", "--view-zenith", "30",
     "--azimuth", "0", "--quality", "preview", "-o", "sweep.zarr"),
    ("bake", "PLANET", "--layout", "bruneton", "-o", "baked", "--quality", "preview"),
    ("compose", "PLANET", "no.png", "--depth", "no.exr", "-o", "a.png"),
    ("animate", "film.toml", "-o", "frames"),
    ("export-page", "PLANET", "-o", "a.html", "--quality", "preview"),
    ("fit", "PLANET", "data.csv", "--free", "ground.albedo"),
    ("view", "PLANET", "--screenshot", "no/such/a.png"),
)  # fmt: skip
_PLANETS = ("earth-openspace", "mars-rayleigh", "earth-openspace", "planet.toml", "named.toml")

PLANET = """name = {name}
[shell]
bottom_radius = "6360 km"
top_radius = "6460 km"
[ground]
albedo = 0.1
[star]
spectrum = "astm-g173"
angular_radius = "0.2678 deg"
[[constituents]]
name = {constituent}
profile = {{ kind = "exponential", scale_height = "8 km" }}
wavelengths = "680, 550, 440 nm"
scattering = "5.8e-6, 13.6e-6, 33.1e-6 /m"
phase_function = {{ kind = "rayleigh" }}
"""


def _quoted(text: str) -> str:
    shown = "".join(c if c.isprintable() and c not in '"\\' else f"\\U{ord(c):08x}" for c in text)
    return f'"{shown}"'


def make_folder(folder: Path, chance: random.Random) -> None:
    """Files that the command lines name: planets, loops of links, a folder, damaged files."""
    for file, names in (("planet.toml", ("Dust", "air")), ("named.toml", chance.sample(NAMES, 2))):
        text = PLANET.format(name=_quoted(names[0]), constituent=_quoted(names[1]))
        (folder / file).write_text(text, encoding="utf-8")
    (folder / "broken.toml").write_bytes(b"name = \xff")
    (folder / "data.csv").write_text("altitude_m,radiance\n0,nan\n")
    (folder / "film.toml").write_text('planet = "earth"\nseconds = "x"\n')
    (folder / "folder").mkdir(exist_ok=True)
    for one, other in (("loop", "pool"), ("pool", "loop")):
        if not (folder / one).is_symlink():
            (folder / one).symlink_to(folder / other)


def odd_line(chance: random.Random) -> list[str]:
    """Good command line with up to three changes."""
    words = [chance.choice(_PLANETS) if word == "PLANET" else word for word in chance.choice(GOOD)]
    for _ in range(chance.choice((0, 1, 1, 1, 2, 3))):
        at = chance.randrange(1, len(words)) if len(words) > 1 else 0
        kind = chance.choice(("value", "value", "value", "value", "drop", "set", "again", "swap"))
        if kind == "value":
            values = [k for k, word in enumerate(words) if k > 0 and not word.startswith("-")]
            if values:
                words[chance.choice(values)] = chance.choice(VALUES)
        elif kind == "drop" and len(words) > 1:
            del words[at]
        elif kind == "set":
            path = chance.choice(("name", "ground.albedo", "shell.top_radius", "air.name", "x.y"))
            words += ["--set", f"{path}={chance.choice(VALUES)}"]
        elif kind == "again":
            words.append(words[at])
        else:
            other = chance.randrange(0, len(words))
            words[at], words[other] = words[other], words[at]
    return words


def run_line(words: list[str], seconds: float) -> tuple[int, str, str, float]:
    """Run a command line in a fork of this process, as in one of its own; interrupted after a time.

    Returns
    -------
    status : int
    out, err : str
        What it wrote.
    late : float
        Seconds from the interruption to the end; negative if it was not interrupted.
    """
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = os.fork()
        if process == 0:
            _become(words, out.fileno(), err.fileno())
        begun = time.monotonic()
        status = _ended(process, seconds)
        late = -1.0
        if status is None:
            os.kill(process, signal.SIGINT)
            begun = time.monotonic()
            status = _ended(process, DEAF)
            late = time.monotonic() - begun
        if status is None:
            os.kill(process, signal.SIGKILL)
            os.waitpid(process, 0)
            raise AssertionError(f"not ended {DEAF:g} s after an interruption")
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode(errors="surrogateescape"))
    return status, *texts, late


def _become(words: list[str], out: int, err: int) -> NoReturn:
    """Be the process of a command, in a child; it never returns."""
    status = 1
    try:
        for number, target in ((out, 1), (err, 2)):
            os.dup2(number, target)
        sys.stdout, sys.stderr = (
            os.fdopen(one, "w", encoding="utf-8", errors="replace", closefd=False) for one in (1, 2)
        )
        signal.signal(signal.SIGINT, signal.default_int_handler)
        end_when_interrupted()
        status = main(words)
    except BaseException as error:  # main ends by its status
        sys.stderr.write(f"Traceback: {type(error).__name__}: {error}\n")
    finally:
        with contextlib.suppress(Exception):
            sys.stdout.flush()
            sys.stderr.flush()
        os._exit(status)


def _ended(process: int, seconds: float) -> int | None:
    """Exit status of a child; None if it has not ended within a time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        found, status = os.waitpid(process, os.WNOHANG)
        if found:
            return os.waitstatus_to_exitcode(status)
        time.sleep(0.02)
    return None


def check_line(words: list[str], seconds: float) -> tuple[str, float]:
    """Run a command line.

    Returns
    -------
    verdict : str
        ``held``, ``refused`` or ``stopped``.
    late : float
        Seconds from an interruption to the end; negative if there was none.

    Raises
    ------
    AssertionError, Exception
        If it ends otherwise.
    """
    status, out, err, late = run_line(words, seconds)
    for text in (out, err):
        assert not OBEYED.search(text), f"control characters: {ascii(text)[:300]}"
    assert "Traceback" not in err, err
    assert "internal error" not in err, err
    lines = err.splitlines()
    if status == 2:
        assert lines, "no line says why"
        assert lines[-1].startswith("airlight: "), err
        return "refused", late
    if late >= 0.0:
        assert status == 130, (status, err)
        return "stopped", late
    assert status == 0, (status, err)
    return "held", late


def try_lines(count: int, seed: int, folder: Path, seconds: float = 20.0) -> Tally:
    """Make odd command lines and run them in a folder."""
    chance, tally, latest = random.Random(seed), Tally("odd command lines"), 0.0
    with contextlib.chdir(folder):
        for number in range(count):
            make_folder(folder, chance)
            words = odd_line(chance)
            try:
                verdict, late = check_line(words, seconds)
                tally.add(verdict)
                latest = max(latest, late)
            except Exception as error:
                print(f"broke: {words!a}: {type(error).__name__}: {ascii(str(error))[:400]}",
                      file=sys.stderr)  # fmt: skip
                tally.add("", f"{number}: {words!a}: {type(error).__name__}")
    tally.note = f"longest end after an interruption {latest:.2f} s" if latest > 0.0 else ""
    return tally
