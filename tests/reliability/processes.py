"""Commands in processes of their own: killed at random, beside each other, on damaged caches."""

from __future__ import annotations

import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
from outside_text import OBEYED
from PIL import Image
from tally import Tally

from airlight.image.exr import read_exr

#: Words of commands, with the file or folder that each writes.
Commands = tuple[tuple[str, tuple[str, ...]], ...]
#: Content of the file of each command, and the time of the command. [s]
References = dict[str, tuple[bytes, float]]
#: Small commands and the file that each writes.
COMMANDS: Commands = (
    ("a.png", ("render", "earth-openspace", "--size", "64x36", "--quality", "preview",
               "--wavelengths", "rgb", "--device", "cpu", "-o", "a.png")),
    ("a.exr", ("render", "earth-openspace", "--size", "64x36", "--quality", "preview",
               "--wavelengths", "rgb", "--device", "cpu", "-o", "a.exr")),
    ("a.svg", ("plot", "earth-openspace", "density", "-o", "a.svg")),
    ("a.csv", ("radiance", "earth-openspace", "--input", "in.csv", "--output", "a.csv",
               "--quality", "preview", "--wavelengths", "rgb")),
)  # fmt: skip
#: Further commands whose files are compared after a kill, some seconds each: in long runs alone.
SLOWER: Commands = (
    ("baked", ("bake", "earth-openspace", "--layout", "bruneton", "--size", "8x16x8x4",
               "--quality", "preview", "-o", "baked")),
    ("a.html", ("export-page", "earth-openspace", "--quality", "preview", "-o", "a.html")),
    ("p.png", ("plot", "earth-openspace", "sky-profile", "--quality", "preview", "-o", "p.png")),
)  # fmt: skip
#: Commands that take long, all of which one interruption ends within a second.
LONG: tuple[tuple[str, ...], ...] = (
    ("render", "earth", "--size", "1280x720", "--quality", "fine", "--exact", "-o", "a.png"),
    ("render", "titan", "--size", "640x360", "--quality", "fine", "-o", "a.exr"),
    ("radiance", "earth", "--input", "in.csv", "--output", "a.csv", "--quality", "fine"),
    ("radiance", "earth", "--altitude", "0m", "--sun-zenith", "60", "--view-zenith", "30",
     "--azimuth", "90", "--solver", "montecarlo"),
    ("sky", "earth", "--size", "1024", "--quality", "fine", "-o", "a.exr", "--for", "blender",
     "--sun-zenith", "80"),
    ("spectrum", "earth", "--of", "geometric-albedo", "--quality", "fine", "-o", "a.csv"),
    ("sweep", "earth", "--altitude", "0m,10km", "--sun-zenith", "0:90:1", "--view-zenith",
     "0:90:1", "--azimuth", "0", "--quality", "fine", "-o", "sweep.zarr"),
    ("bake", "earth", "--layout", "bruneton", "-o", "baked", "--quality", "fine"),
    ("bake", "mars", "--layout", "takram", "-o", "baked", "--quality", "fine"),
    ("animate", "earth", "-o", "frames", "--frames", "40", "--key",
     "view.altitude=2m,400km exponential", "--size", "640x360"),
    ("export-page", "mars", "-o", "a.html", "--quality", "fine"),
    ("plot", "earth", "sky-profile", "-o", "a.png", "--quality", "fine"),
    ("aerial", "earth", "--altitude", "500m", "--sun-zenith", "66deg", "-o", "air"),
    ("validate", "--suite", "golden", "-o", "a.html"),
    ("validate", "--suite", "energy", "-o", "a.html"),
    ("show", "PLANET"),
)  # fmt: skip
#: Planet whose particles alone take minutes.
_PARTICLES = """name = "Drops"
[shell]
bottom_radius = "6360 km"
top_radius = "6460 km"
[ground]
albedo = 0.1
[star]
spectrum = "astm-g173"
angular_radius = "0.2678 deg"
[[constituents]]
name = "drops"
profile = { kind = "exponential", scale_height = "12.5 km" }
[constituents.particles]
index = { real = 1.33, imaginary = 0.0 }
sizes = { kind = "gamma", effective_radius = "50 um", effective_variance = 0.1 }
optical_depth = 0.1
"""
#: Time of a solve in its report, or that there was none.
_TOOK = re.compile(rb", (?:[\d.]+ s|from the cache) (?=\(degree)")
#: Longest time from an interruption to the end of a command. [s]
PROMPT = 1.0
_CASES = "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg\n" + "0,60,30,90\n" * 50
SIGNALS = (signal.SIGKILL, signal.SIGINT, signal.SIGTERM)


def begin(
    words: tuple[str, ...], folder: Path, cache: Path, prepare: Callable[[], None] | None = None
) -> subprocess.Popen[str]:
    """Start a command in a folder, with a cache of its own, by the installed script."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "in.csv").write_text(_CASES)
    return subprocess.Popen(
        [Path(sys.executable).with_name("airlight"), *words], cwd=folder, text=True,
        preexec_fn=prepare, stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        env={**os.environ, "AIRLIGHT_CACHE": str(cache)},
    )  # fmt: skip


def _listen() -> None:
    """Take SIGINT as a terminal's child does, whatever a shell told this process."""
    signal.signal(signal.SIGINT, signal.default_int_handler)


def ended(process: subprocess.Popen[str], seconds: float = 3000.0) -> tuple[int, str]:
    """Exit status and messages of a command that says nothing it should not."""
    try:
        out, err = process.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        process.kill()
        process.communicate()
        raise
    assert not OBEYED.search(out + err), ascii(out + err)
    # while Python itself begins, its own answer to a signal holds
    if not err.rstrip().endswith("KeyboardInterrupt") or "in run_process" in err:
        assert "Traceback" not in err, err
    assert "internal error" not in err, err
    return process.returncode, err


def written(file: Path) -> bytes:
    """Content of a file; of a picture its pixels, as its words say how long the solve took.

    Of a folder the names and contents of its files, without what a report says of that time.
    """
    if file.is_dir():
        contents = (one.name.encode() + one.read_bytes() for one in sorted(file.iterdir()))
        return _TOOK.sub(b"", b"".join(contents))
    if file.suffix == ".png":
        with Image.open(file) as image:
            return np.asarray(image).tobytes()
    return read_exr(file)[0].tobytes() if file.suffix == ".exr" else file.read_bytes()


def _remove(file: Path) -> None:
    """Remove a file or a folder."""
    if file.is_dir():
        shutil.rmtree(file)
    else:
        file.unlink()


def _left(folder: Path) -> list[str]:
    """Names of what commands left: not their input, nor the rows from which one goes on."""
    names = (one.name for one in folder.iterdir())
    return [one for one in names if one != "in.csv" and not one.endswith((".rows", ".index"))]


def references(folder: Path, cache: Path, commands: Commands = COMMANDS) -> References:
    """Files of commands, undisturbed, and the time of each [s]; the cache is warm then.

    All are made twice: what differs between two runs could not be compared.
    """
    found: References = {}
    for _ in range(2):
        for name, words in commands:
            begun = time.monotonic()
            status, err = ended(begin(words, folder, cache))
            took = time.monotonic() - begun
            assert status == 0, err
            content = written(folder / name)
            assert found.get(name, (content,))[0] == content, name
            found[name] = content, took
            _remove(folder / name)
    return found


def try_kills(
    count: int,
    seed: int,
    folder: Path,
    cache: Path,
    commands: Commands = COMMANDS,
    whole: References | None = None,
) -> Tally:
    """Kill commands at random moments; no file is half-written, and the next run is right.

    ``whole`` is what ``references`` of the commands gave, with this cache or one that was copied.
    """
    chance, tally = random.Random(seed), Tally("kills at random moments")
    whole = references(folder, cache, commands) if whole is None else whole
    late: list[float] = []
    for number in range(count):
        name, words = chance.choice(commands)
        expected, usual = whole[name]
        how = chance.choice(SIGNALS)
        if chance.random() < 0.5:  # half of them solve again
            shutil.rmtree(cache / "solutions", ignore_errors=True)
        process = begin(words, folder, cache, _listen)
        time.sleep(chance.uniform(0.0, 1.1 * usual))
        process.send_signal(how)
        begun = time.monotonic()
        try:
            status, err = ended(process)
            late.append(time.monotonic() - begun)
            held = status == 0
            if not held:
                usually = {signal.SIGKILL: -9, signal.SIGINT: 130, signal.SIGTERM: 143}[how]
                # before the command watches, Python's own answer to SIGINT and SIGTERM holds
                assert status in (usually, -how, 1), (status, err)
            left = [one for one in _left(folder) if one != name]
            assert how == signal.SIGKILL or not left, left
            for one in left:
                assert one.startswith("."), left
                _remove(folder / one)
            if (folder / name).exists():
                assert written(folder / name) == expected, f"half-written {name}"
                _remove(folder / name)
            again, err = ended(begin(words, folder, cache))
            assert again == 0, err
            assert written(folder / name) == expected, f"another {name} after the kill"
            _remove(folder / name)
            tally.add("held" if held else "killed")
        except Exception as error:
            tally.add("", f"{number}: {how.name} {words[:2]} {name}: {ascii(str(error))[:300]}")
            for one in _left(folder):  # what is left is counted once
                _remove(folder / one)
    if late:
        tally.note = f"longest end after a signal {max(late):.2f} s"
    return tally


def try_interrupts(count: int, seed: int, folder: Path, cache: Path) -> Tally:
    """Interrupt all commands that take long at random moments: each ends at once, in a line.

    A third of them on an empty cache, where kernels are compiled.
    """
    chance, tally = random.Random(seed), Tally("interruptions of long commands")
    late: list[float] = []
    for number in range(count):
        words = LONG[number % len(LONG)]
        place = folder / f"at-{number}"
        place.mkdir(exist_ok=True)
        (place / "drops.toml").write_text(_PARTICLES)
        words = tuple("drops.toml" if one == "PLANET" else one for one in words)
        here = place / "cold" if chance.random() < 0.33 else cache
        process = begin(words, place, here, _listen)
        time.sleep(chance.uniform(0.2, 20.0))
        process.send_signal(signal.SIGINT)
        begun = time.monotonic()
        try:
            status, err = ended(process)
            late.append(time.monotonic() - begun)
            assert late[-1] <= PROMPT, f"ended {late[-1]:.2f} s after the signal"
            if status in (130, -signal.SIGINT) or "KeyboardInterrupt" in err:
                tally.add("stopped")
            else:
                assert status == 0 or err.splitlines()[-1].startswith("airlight: "), (status, err)
                tally.add("held" if status == 0 else "refused")
            parts = [str(one) for one in place.rglob("*.part") if "cold" not in one.parts]
            assert not parts, parts
        except Exception as error:
            tally.add("", f"{number}: {words[:4]}: {ascii(str(error))[:300]}")
        shutil.rmtree(place, ignore_errors=True)
    if late:
        late.sort()
        tally.note = (
            f"end after the signal {late[len(late) // 2]:.2f} s (median), {late[-1]:.2f} s (latest)"
        )
    return tally


def _truncated(file: Path, chance: random.Random) -> None:
    file.write_bytes(file.read_bytes()[: chance.randrange(file.stat().st_size + 1)])


def _flipped(file: Path, chance: random.Random) -> None:
    content = bytearray(file.read_bytes())
    for _ in range(chance.randint(1, 20)):
        if content:
            content[chance.randrange(len(content))] ^= 1 << chance.randrange(8)
    file.write_bytes(content)


def _emptied(file: Path, _: random.Random) -> None:
    file.write_bytes(b"")


def _replaced(file: Path, chance: random.Random) -> None:
    others = sorted(
        one for one in file.parent.iterdir() if one.is_file() and one.suffix == file.suffix
    )
    file.write_bytes(chance.choice(others).read_bytes())


def _folder(file: Path, _: random.Random) -> None:
    file.unlink()
    file.mkdir()


DAMAGES = (_truncated, _flipped, _emptied, _replaced, _folder)


def _no_space() -> None:
    """Let no file grow, as on a full disk: writing fails and the process goes on."""
    import resource

    signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    resource.setrlimit(resource.RLIMIT_FSIZE, (2000, 2000))


def try_caches(
    count: int, seed: int, folder: Path, cache: Path, whole: References | None = None
) -> Tally:
    """Damage the cache, close it or fill its disk: the result is right, or a line says why not."""
    chance, tally = random.Random(seed), Tally("damaged caches")
    whole = references(folder, cache) if whole is None else whole
    for number in range(count):
        name, words = chance.choice(COMMANDS)
        damage = chance.choice((*DAMAGES, "full disk", "closed"))
        files = sorted(file for file in cache.rglob("*") if file.is_file())
        solutions = [file for file in files if file.suffix == ".npz"]
        try:
            if damage == "full disk":
                shutil.rmtree(cache / "solutions", ignore_errors=True)
                status, err = ended(begin(words, folder, cache, _no_space))
                if status == 2:
                    assert err.splitlines()[-1].startswith("airlight: "), err
                else:
                    assert status == 0, err
            elif damage == "closed":
                elsewhere = folder.parent / "closed"
                elsewhere.write_text("a file where the folder would be")
                status, err = ended(begin(words, folder, elsewhere))
                assert status == 0, err
            else:
                assert callable(damage)
                chosen = solutions if solutions and chance.random() < 0.5 else files
                for file in chance.sample(chosen, min(len(chosen), chance.choice((1, 5, 40)))):
                    damage(file, chance)
                status, err = ended(begin(words, folder, cache))
                assert status == 0, err
            if status == 0:
                assert written(folder / name) == whole[name][0], "another result"
                (folder / name).unlink()
            assert _left(folder) == []
            tally.add("held" if status == 0 else "refused")
        except Exception as error:
            word = damage if isinstance(damage, str) else damage.__name__
            tally.add("", f"{number}: {word} {words[:2]} {name}: {ascii(str(error))[:300]}")
        for file in cache.rglob("*.n??"):
            if file.is_dir():
                shutil.rmtree(file, ignore_errors=True)
    return tally


def try_together(count: int, folder: Path, cache: Path) -> Tally:
    """Processes that all begin on one cold cache: all are right, and equal."""
    tally = Tally(f"{count} processes on one cold cache")
    name, words = COMMANDS[0]
    begun = [begin(words, folder / f"at-{k}", cache) for k in range(count)]
    contents = set()
    for k, process in enumerate(begun):
        try:
            status, err = ended(process, 3000.0)
            assert status == 0, err
            contents.add(written(folder / f"at-{k}" / name))
            assert len(contents) == 1, "another result"
            tally.add("held")
        except Exception as error:
            tally.add("", f"{k}: {ascii(str(error))[:300]}")
    return tally
