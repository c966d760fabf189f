"""Ctrl-C on a real command: it ends soon, says so in a line, and leaves no file."""

from __future__ import annotations

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
        "home = importlib.import_module('airlight.solvers.moments.solution')\n"
        "solve = home.solve\n"
        "def begun(*a, **k):\n"
        "    print('begun', flush=True)\n"
        "    return solve(*a, **k)\n"
        "home.solve = begun\n"
        "from airlight.cli import main\n"
        "sys.exit(main(sys.argv[1:]))\n"
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
    assert err == "airlight: cancelled\n"
    assert [file.name for file in tmp_path.iterdir()] == ["cases.csv"]
