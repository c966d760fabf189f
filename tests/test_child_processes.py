"""Child processes: none imports from the working directory, and Ctrl-C ends all of them at once."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

psutil: Any = pytest.importorskip("psutil")  # which Dask brings
#: Modules that Python, Dask or airlight import early in a child.
NAMES = (
    "signal", "types", "struct", "socket", "pickle", "selectors", "threading", "multiprocessing",
    "ctypes", "numba", "numpy", "distributed", "airlight",
)  # fmt: skip
COMMAND = """
import sys
from airlight.cli import run_process
if __name__ == "__main__":
    sys.exit(run_process())
"""
FILM = (
    "animate", "earth-openspace", "-o", "frames", "--frames", "2", "--size", "32x18",
    "--key", "view.altitude=2m,400km exponential", "--quality", "preview", "--workers", "2",
)  # fmt: skip
GRID = (
    "sweep", "earth-openspace", "--altitude", "0m,10km", "--sun-zenith", "60", "--view-zenith",
    "30", "--azimuth", "0", "--quality", "preview", "-o", "grid.zarr", "--workers", "2",
)  # fmt: skip
#: Such work for minutes.
LONG_FILM = (*FILM[:5], "4000", "--size", "640x360", *FILM[8:])
LONG_GRID = (*GRID[:5], "0:89.5:0.5", "--view-zenith", "0:89.5:0.5", "--azimuth", "0:180:5",
             *GRID[10:])  # fmt: skip


@pytest.fixture
def command(tmp_path: Path) -> Path:
    """Console script as an installer makes it; what it is for lies elsewhere."""
    file = tmp_path / "bin" / "airlight"
    file.parent.mkdir()
    file.write_text(COMMAND)
    return file


@pytest.fixture
def hostile(tmp_path: Path) -> Path:
    """Working directory with modules that leave a witness and fail."""
    folder = tmp_path / "received"
    folder.mkdir()
    for name in NAMES:
        witness = f"open({str(tmp_path / 'witness')!r}, 'a').write(__name__ + ' ')"
        (folder / f"{name}.py").write_text(f"{witness}\nraise SystemExit('hostile')\n")
    return folder


def witness(folder: Path) -> str:
    file = folder.parent / "witness"
    return file.read_text() if file.exists() else ""


def test_python_would_import_from_there(hostile: Path) -> None:
    # the test's own test: without -P the witness is there
    words = [sys.executable, "-c", "from multiprocessing.spawn import spawn_main"]
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONSAFEPATH"}
    subprocess.run(words, cwd=hostile, env=environment, capture_output=True, check=False)
    assert witness(hostile) == "multiprocessing "


@pytest.mark.slow
@pytest.mark.parametrize(
    "words", [FILM, pytest.param(GRID, marks=pytest.mark.validation)], ids=["film", "grid"]
)
def test_workers_do_not_import_from_the_working_directory(
    words: tuple[str, ...], command: Path, hostile: Path
) -> None:
    done = subprocess.run(
        [sys.executable, str(command), *words], cwd=hostile, capture_output=True, text=True,
        timeout=600, check=False,
    )  # fmt: skip
    assert witness(hostile) == ""
    assert done.returncode == 0, done.stderr
    assert "Traceback" not in done.stderr


def test_compilation_ahead_does_not_import_from_the_working_directory(
    hostile: Path, tmp_path: Path
) -> None:
    # a process that fails counts as ready: that its code is on disk shows that it ran
    own = tmp_path / "own"
    own.mkdir()
    (own / "formula.py").write_text(
        "from airlight.kernel import compiled_loop\n"
        "@compiled_loop\n"
        "def cubed(x):\n    return x * x * x\n"
        "def compile_cubed():\n    cubed(1.0)\n"
    )
    script = own / "script.py"  # whose folder Python puts first on the path, as a user wants it
    script.write_text(
        "import formula\n"
        "from airlight.kernel.background_compiler import BackgroundCompiler\n"
        "from airlight.kernel.compiling import on_disk\n"
        "ahead = BackgroundCompiler('formula:compile_cubed', [formula.cubed])\n"
        "ahead.wait(formula.cubed, lambda: False)\n"
        "ahead.close()\n"
        "print(on_disk(formula.cubed))\n"
    )
    done = subprocess.run(
        [sys.executable, str(script)], cwd=hostile, capture_output=True, text=True, timeout=300,
        env={**os.environ, "AIRLIGHT_CACHE": str(tmp_path / "cache")}, check=False,
    )  # fmt: skip
    assert witness(hostile) == ""
    assert (done.stdout, done.stderr) == ("True\n", "")


def test_what_libraries_start_for_a_command_does_not_either(hostile: Path) -> None:
    # as GLFW's package asks a process of its own for the library's version
    script = (
        "import importlib, subprocess, sys\n"
        "from airlight.cli import run_process\n"
        "home = importlib.import_module('airlight.cli.planets')\n"
        "def library():\n"
        "    subprocess.run([sys.executable, '-c', 'import signal; print(signal.SIGINT)'])\n"
        "home.planets = library\n"
        "sys.argv = ['airlight', 'planets']\n"
        "sys.exit(run_process())\n"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-c", script], cwd=hostile, capture_output=True, text=True,
        timeout=300, check=False,
    )  # fmt: skip
    assert witness(hostile) == ""
    assert (done.returncode, done.stdout, done.stderr) == (0, "2\n", "")


def children(process: subprocess.Popen[str]) -> Any:
    return psutil.Process(process.pid).children(recursive=True)


def wait_until(condition: Callable[[], bool]) -> None:
    deadline = time.monotonic() + 120.0
    while not condition():
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="groups of processes of Unix")
@pytest.mark.parametrize(
    ("words", "moment", "times"),
    [
        (LONG_FILM, "first child", 1),
        (LONG_FILM, "all children", 2),
        # of a film that is computing: tests/studies/film/test_animate.py
        pytest.param(LONG_FILM, "computing", 1, marks=pytest.mark.validation),
        pytest.param(LONG_GRID, "first child", 2, marks=pytest.mark.validation),
        (LONG_GRID, "computing", 2),
    ],
)
def test_ctrl_c_ends_a_command_with_workers_in_one_line(
    words: tuple[str, ...], moment: str, times: int, command: Path, tmp_path: Path
) -> None:
    # a terminal sends it to all processes of the command
    (tmp_path / "tmp").mkdir()
    with subprocess.Popen(
        [sys.executable, str(command), *words], cwd=tmp_path, text=True, start_new_session=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        env={**os.environ, "TMPDIR": str(tmp_path / "tmp")},
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.default_int_handler),
    ) as process:  # fmt: skip
        try:
            # the helper of multiprocessing and two workers
            wait_until(lambda: len(children(process)) >= (1 if moment == "first child" else 3))
            if moment == "computing":
                time.sleep(6.0)
            begun = children(process)
            for _ in range(times):
                os.killpg(process.pid, signal.SIGINT)
                time.sleep(0.1)
            start = time.monotonic()
            out, err = process.communicate(timeout=60)
            seconds = time.monotonic() - start
        finally:
            process.kill()
    assert process.returncode == 130
    assert out == ""
    *announced, last = err.splitlines()
    assert last == "airlight: cancelled"
    assert all(line.startswith("airlight: ") for line in announced), err
    assert seconds < 3.0
    _, running = psutil.wait_procs(begun, timeout=10.0)
    assert [one for one in running if one.status() != psutil.STATUS_ZOMBIE] == []
    assert list((tmp_path / "tmp").iterdir()) == []
