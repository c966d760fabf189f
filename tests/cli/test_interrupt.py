"""Ctrl-C on a real command: it ends soon, says so in a line, and leaves no file."""

from __future__ import annotations

import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to one process")
@pytest.mark.parametrize(
    "words",
    [
        ["render", "earth", "--size", "64x36", "-o", "a.png"],
        ["radiance", "earth", "--input", "cases.csv", "--output", "a.csv"],
    ],
)
def test_an_interrupted_solve_leaves_nothing(words: list[str], tmp_path: Path) -> None:
    header = "altitude_m,sun_zenith_deg,view_zenith_deg,azimuth_deg"
    (tmp_path / "cases.csv").write_text(f"{header}\n0,60,30,90\n")
    # a fine solve takes far longer than the pause; the marker says that the solver has begun
    script = (
        "import sys, importlib\n"
        "home = importlib.import_module('airlight.solver.moments.solve')\n"
        "solve = home.solve\n"
        "def begun(*a, **k):\n"
        "    print('begun', flush=True)\n"
        "    return solve(*a, **k)\n"
        "home.solve = begun\n"
        "from airlight.cli import run_process\n"
        "sys.exit(run_process())\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script, *words, "--quality", "fine", "--no-cache"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        # a test run in the background may have been told to ignore the signal
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "begun\n"
            time.sleep(0.3)
            process.send_signal(signal.SIGINT)
            out, err = process.communicate(timeout=600)
        finally:
            process.kill()
    assert process.returncode == 130
    assert out == ""
    *announced, cancelled = err.splitlines()
    assert cancelled == "airlight: cancelled"
    # a fine solve is long; the signal may come before its length is known
    announcement = re.compile(r"airlight: solving \d+ wavelengths: about .+")
    assert all(announcement.fullmatch(one) for one in announced)
    assert len(announced) < 2
    assert [file.name for file in tmp_path.iterdir()] == ["cases.csv"]


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to one process")
def test_what_cannot_be_interrupted_is_left_within_a_second(tmp_path: Path) -> None:
    # blocks on other threads, as a compiler's, end a minute later: nobody waits for them
    script = (
        "import sys, time, importlib\n"
        "from airlight.kernel.threads import run_blocks\n"
        "from airlight.files.atomic_file import atomic_file\n"
        "home = importlib.import_module('airlight.cli.planets')\n"
        "def stuck():\n"
        "    with atomic_file('a.png') as part:\n"
        "        part.write_text('half')\n"
        "        print('begun', flush=True)\n"
        "        run_blocks(lambda k: time.sleep(60.0), 4)\n"
        "from airlight.cli import run_process\n"
        "home.planets = stuck\n"
        "sys.argv = ['airlight', 'planets']\n"
        "sys.exit(run_process())\n"
    )
    with subprocess.Popen(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    ) as process:
        try:
            assert process.stdout is not None
            assert process.stdout.readline() == "begun\n"
            time.sleep(0.2)
            process.send_signal(signal.SIGINT)
            begun = time.monotonic()
            _, err = process.communicate(timeout=50)
            seconds = time.monotonic() - begun
        finally:
            process.kill()
    assert process.returncode == 130
    assert err == "airlight: cancelled\n"
    assert list(tmp_path.iterdir()) == []
    assert seconds < 2.0  # 0.4 s of patience, and what a busy machine adds


@pytest.mark.skipif(sys.platform == "win32", reason="Windows sends no SIGINT to one process")
def test_a_command_that_is_still_imported_ends_in_a_line() -> None:
    script = (
        "import sys, os, signal\n"
        "class Finder:\n"
        "    def find_spec(self, name, path=None, target=None):\n"
        "        if name == 'airlight.cli.app':\n"
        "            os.kill(os.getpid(), signal.SIGINT)\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "sys.meta_path.insert(0, Finder())\n"
        "from airlight.cli import run_process\n"
        "sys.argv = ['airlight', 'planets']\n"
        "sys.exit(run_process())\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "airlight: cancelled\n")


def test_an_error_after_a_swallowed_interruption_is_a_cancellation() -> None:
    # the compiler swallows Ctrl-C in a callback, and then misses what it has not compiled
    script = (
        "import signal, sys\n"
        "signal.signal(signal.SIGINT, signal.default_int_handler)\n"
        "import airlight.cli.app as app\n"
        "def swallowed(*_, **__):\n"
        "    try:\n"
        "        signal.raise_signal(signal.SIGINT)\n"
        "    except KeyboardInterrupt:\n"
        "        pass\n"
        "    raise RuntimeError('no compiled object yet')\n"
        "app.app = swallowed\n"
        "sys.argv = ['airlight', 'planets']\n"
        "sys.exit(app.run_process())\n"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (130, "", "airlight: cancelled\n")


def test_an_interruption_that_a_callback_swallows_is_no_traceback() -> None:
    # ctypes calls back from the compiler; Python prints what such a callback raises, and goes on
    script = (
        "import ctypes\n"
        "from airlight.cli.interrupt import end_when_interrupted\n"
        "end_when_interrupted()\n"
        "def raised(kind):\n"
        "    raise (KeyboardInterrupt, ValueError)[kind]\n"
        "call = ctypes.CFUNCTYPE(None, ctypes.c_int)(raised)\n"
        "call({})\n"
    )
    for kind, shown in ((0, False), (1, True)):
        words = [sys.executable, "-c", script.format(kind)]
        done = subprocess.run(words, capture_output=True, text=True)
        assert (done.returncode, "Traceback" in done.stderr) == (0, shown)
