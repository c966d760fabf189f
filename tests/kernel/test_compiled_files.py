"""Compiled code on disk: damaged files are compiled again, not run; a full disk is no error."""

from __future__ import annotations

import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from airlight.kernel.compiled_files import one_process

SCRIPT = """
import sys
sys.path.insert(0, {folder!r})
import formula
print(formula.cubed(3.0))
"""
FORMULA = """
from airlight.kernel import compiled_loop
@compiled_loop
def cubed(x):
    return x * x * x + 0.0
"""


def run(folder: Path) -> str:
    (folder / "formula.py").write_text(FORMULA)
    done = subprocess.run(
        [sys.executable, "-c", SCRIPT.format(folder=str(folder))],
        capture_output=True,
        text=True,
        env={**os.environ, "AIRLIGHT_CACHE": str(folder / "cache")},
        timeout=300,
    )
    assert done.stderr == ""
    return done.stdout


def machine_code(folder: Path) -> list[Path]:
    return sorted((folder / "cache").rglob("*.nbc"))


def flip_each_hundredth(content: bytes) -> bytes:
    return bytes(b ^ 0x10 if k % 100 == 0 else b for k, b in enumerate(content))


@pytest.fixture(scope="module")
def used(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with code that has been compiled, and is again by each test of a damage."""
    folder = tmp_path_factory.mktemp("used")
    assert run(folder) == "27.0\n"
    return folder


@pytest.mark.parametrize(
    "damage", [flip_each_hundredth, lambda content: content[: len(content) // 2]]
)
@pytest.mark.parametrize("suffix", ["nbc", "nbi"])
def test_a_damaged_file_is_compiled_again(
    suffix: str, damage: Callable[[bytes], bytes], used: Path
) -> None:
    files = sorted((used / "cache").rglob(f"*.{suffix}"))
    assert files
    damaged = {file: damage(file.read_bytes()) for file in files}
    for file, content in damaged.items():
        file.write_bytes(content)
    assert run(used) == "27.0\n"
    if suffix == "nbc":  # written again
        assert all(file.read_bytes() != content for file, content in damaged.items())


def test_the_file_of_another_function_is_not_run(tmp_path: Path) -> None:
    # a cache that was copied together wrongly: the same name, sound content, another formula
    assert run(tmp_path) == "27.0\n"
    (file,) = machine_code(tmp_path)
    other = tmp_path / "other"
    other.mkdir()
    assert run(other) == "27.0\n"
    (foreign,) = machine_code(other)
    assert foreign.name != file.name
    file.write_bytes(foreign.read_bytes())
    before = file.stat().st_mtime_ns
    assert run(tmp_path) == "27.0\n"
    assert file.stat().st_mtime_ns > before  # compiled again


@pytest.mark.skipif(sys.platform == "win32", reason="a limit of Unix")
def test_a_full_disk_is_no_error(tmp_path: Path) -> None:
    (tmp_path / "formula.py").write_text(FORMULA)
    script = (
        "import resource, signal\n"
        "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)\n"
        "resource.setrlimit(resource.RLIMIT_FSIZE, (500, 500))\n"
    ) + SCRIPT.format(folder=str(tmp_path))
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=300,
        env={**os.environ, "AIRLIGHT_CACHE": str(tmp_path / "cache")},
    )  # fmt: skip
    assert done.stdout == "27.0\n"
    assert done.stderr == ""
    assert machine_code(tmp_path) == []


@pytest.mark.skipif(sys.platform == "win32", reason="file permissions of Unix")
def test_code_is_read_where_nothing_can_be_written(tmp_path: Path) -> None:
    # a cache of the system, or of an image: its code runs, and nothing is added or lost
    assert run(tmp_path) == "27.0\n"
    before = {file: file.stat().st_mtime_ns for file in machine_code(tmp_path)}
    closed = (
        "import os, tempfile, numba.core.caching as caching\n"
        "def refuse(*a, **k): raise PermissionError('closed')\n"
        "os.mkdir = tempfile.TemporaryFile = refuse\n"
        "caching.IndexDataCacheFile._open_for_write = refuse\n"
    )
    script = (
        closed
        + SCRIPT.format(folder=str(tmp_path))
        + "print(*formula.cubed.stats.cache_hits.values())"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, timeout=300,
        env={**os.environ, "AIRLIGHT_CACHE": str(tmp_path / "cache")},
    )  # fmt: skip
    assert (done.stdout, done.stderr) == ("27.0\n1\n", "")
    assert {file: file.stat().st_mtime_ns for file in machine_code(tmp_path)} == before


@pytest.mark.skipif(sys.platform == "win32", reason="locks of Unix")
def test_processes_on_a_cold_cache_compile_each_function_once(tmp_path: Path) -> None:
    # a tower of three: whoever is first compiles a function, the others wait and load it
    (tmp_path / "tower.py").write_text(
        "from airlight.kernel import compiled_loop, kernel\n"
        "@kernel\n"
        "def squared(x):\n    return x * x\n"
        "@kernel\n"
        "def cubed(x):\n    return squared(x) * x\n"
        "@compiled_loop\n"
        "def total(x):\n    return cubed(x) + squared(x)\n"
    )
    script = (
        "import sys\n"
        f"sys.path.insert(0, {str(tmp_path)!r})\n"
        "import tower\n"
        "from numba.core import event\n"
        "from airlight.kernel.compiling import CompileListener\n"
        "names = []\n"
        "event.register('numba:compile', CompileListener(names.append))\n"
        "sys.stdin.read()\n"  # until all have come so far
        "print(tower.total(3.0), *names)\n"
    )
    processes = [
        subprocess.Popen(
            [sys.executable, "-c", script], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
            text=True, env={**os.environ, "AIRLIGHT_CACHE": str(tmp_path / "cache")},
        )
        for _ in range(4)
    ]  # fmt: skip
    for process in processes:  # all begin now
        assert process.stdin is not None
        process.stdin.close()
        process.stdin = None
    said = [process.communicate(timeout=300)[0].split() for process in processes]
    assert [words[0] for words in said] == ["36.0"] * 4
    compiled = sorted(name for words in said for name in words[1:])
    assert compiled == ["tower.cubed", "tower.squared", "tower.total"]


def test_a_process_does_not_wait_for_itself(tmp_path: Path) -> None:
    # a formula that calls itself for other types is compiled inside its own compilation
    file = tmp_path / "a.lock"
    begun = time.monotonic()
    with one_process(file), one_process(file):
        pass
    assert time.monotonic() - begun < 60.0  # it would be ten minutes


@pytest.mark.skipif(sys.platform == "win32", reason="locks of Unix")
def test_a_lock_ends_with_an_error_in_its_block(tmp_path: Path) -> None:
    file = tmp_path / "a.lock"
    with pytest.raises(ZeroDivisionError), one_process(file):
        raise ZeroDivisionError
    other = "import fcntl, sys; fcntl.flock(open(sys.argv[1], 'a'), fcntl.LOCK_EX | fcntl.LOCK_NB)"
    subprocess.run([sys.executable, "-c", other, str(file)], check=True)
