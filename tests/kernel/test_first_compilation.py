"""The line about the first compilation: after two seconds, once a loop, in a log and in Python."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import pytest

#: Loop whose compilation takes as long as it sleeps, and a listener whose patience is short.
SLOW = """
import time
from numba.core import event
from airlight.kernel import cost, first_compilation, kernel
first_compilation.PATIENCE = {patience}
first_compilation.SECONDS, first_compilation.NEWS = 1e-3, {news}

class Slow(event.Listener):
    def on_start(self, started): time.sleep({sleep})
    def on_end(self, ended): pass

if {listens}:
    cost.announce.set(lambda line: print("told:", line))

@kernel
def one(x):
    return x + 1.0

@kernel
def two(x):
    return one(x) + 1.0

event.register("numba:compile", Slow())
for called in {calls}:
    called(2.0), called(3)
"""


def run(tmp_path: Path, **values: object) -> subprocess.CompletedProcess[str]:
    file = tmp_path / "slow.py"
    usual = {
        "patience": 0.05, "sleep": 0.3, "listens": False, "calls": "[two, one]",
        "news": "-float('inf')",  # another line whenever the end is announced again
    }  # fmt: skip
    file.write_text(SLOW.format(**{**usual, **values}))
    environment = {**os.environ, "AIRLIGHT_CACHE": str(tmp_path / "cache")}
    return subprocess.run(
        [sys.executable, str(file)], env=environment, capture_output=True, text=True, check=True
    )


def test_a_long_compilation_is_said_once_on_the_standard_error_stream(tmp_path: Path) -> None:
    # Python writes the warnings of a logger that nobody listens to
    done = run(tmp_path)
    assert re.fullmatch(r"compiling, about [\d.]+ \w+; cached for later runs\n", done.stderr)
    assert done.stdout == ""
    # what is kept on disk is not compiled again
    assert run(tmp_path).stderr == ""


def test_a_listener_gets_the_line(tmp_path: Path) -> None:
    done = run(tmp_path, listens=True)
    assert done.stdout.startswith("told: compiling, about ")
    assert done.stdout.count("\n") == 1
    assert done.stderr == ""


def test_a_loop_that_was_not_announced_has_a_line_of_its_own(tmp_path: Path) -> None:
    assert run(tmp_path, calls="[one, two]").stderr.count("compiling, about ") == 2


def test_an_end_that_is_about_as_announced_has_no_other_line(tmp_path: Path) -> None:
    assert run(tmp_path, calls="[one, two]", news=1e6).stderr.count("compiling, about ") == 1


def test_a_short_compilation_is_silent(tmp_path: Path) -> None:
    assert run(tmp_path, patience=60.0, sleep=0.0).stderr == ""


@pytest.mark.slow
@pytest.mark.parametrize("whole", [False, pytest.param(True, marks=pytest.mark.validation)])
def test_the_first_radiance_in_a_log_says_that_it_compiles(tmp_path: Path, whole: bool) -> None:
    # without a terminal and without compiled code: after two seconds of a minute
    command = "from airlight.cli import run_process; run_process()"
    words = ["radiance", "earth-atmosphere-plus", "--sun-zenith", "60", "--view-zenith", "0",
             "--quality", "preview"]  # fmt: skip
    line = re.compile(r"airlight: compiling, about [\d.]+ ")
    environment = {**os.environ, "AIRLIGHT_CACHE": str(tmp_path)}
    with subprocess.Popen(
        [sys.executable, "-c", command, *words], env=environment,
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
    ) as process:  # fmt: skip
        assert process.stderr is not None
        said = any(map(line.match, process.stderr))  # reads up to the first of them
        if not whole:
            process.terminate()
        rest = process.stderr.readlines()
    assert said
    assert not any(map(line.match, rest))
    assert process.returncode == 0 or not whole
