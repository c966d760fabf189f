"""Count of the functions that have to be compiled, and compilation by another process."""

from __future__ import annotations

import importlib
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

import pytest

from airlight.kernel.background_compiler import BackgroundCompiler
from airlight.kernel.compiling import Compiling, name_of, on_disk, progress_text

SOURCE = """
from airlight.kernel import compiled_loop, kernel


@kernel
def halved(x):
    return 0.5 * x


@kernel
def shifted(x):
    return halved(x) + 1.0


@kernel
def unused(x):
    return x


@compiled_loop
def total(count):
    sum = 0.0
    for k in range(count):
        sum += shifted(float(k))
    return sum


def compile_total():
    total(0)


def compile_late():
    import time

    time.sleep(60.0)
"""


@pytest.fixture
def module(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[ModuleType]:
    """Module of its own with a loop, a kernel that it calls and one that this calls."""
    monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path / "cache"))
    name = f"loops_{tmp_path.name.replace('-', '_')}"
    (tmp_path / f"{name}.py").write_text(SOURCE, encoding="utf-8")
    monkeypatch.syspath_prepend(tmp_path)
    yield importlib.import_module(name)
    del sys.modules[name]


def test_functions_are_counted_from_none_to_all_and_once(module: ModuleType) -> None:
    compiling, reported = Compiling([module.total]), []
    other = Compiling([module.total], here=False)
    leave = compiling.subscribe(lambda: reported.append(compiling.done))
    assert progress_text([compiling]).startswith("compiling, once: 0 of 3 functions, about ")
    assert (compiling.done, compiling.total) == (0, 3)
    assert module.total(4) == 7.0
    assert (compiling.done, compiling.total) == (3, 3)
    assert reported == [1, 2, 3]
    assert progress_text([compiling]) == ""
    leave()
    compiling.finish(name_of(module.total))
    assert reported == [1, 2, 3]
    compiling.close()
    assert other.done == 3  # what another process has compiled is on disk
    assert Compiling([module.total]).total == 0


def test_another_process_compiles_and_this_one_loads(module: ModuleType) -> None:
    ahead = BackgroundCompiler(f"{module.__name__}:compile_total", [module.total])
    assert ahead.compiling.total == 3
    assert not ahead.ready(module.total)
    assert ahead.wait(module.total, lambda: False)
    assert on_disk(module.total)
    assert ahead.compiling.done == 3
    assert module.total(4) == 7.0
    assert sum(module.total.stats.cache_hits.values()) == 1
    ahead.close()
    # What is on disk needs no process.
    assert BackgroundCompiler(f"{module.__name__}:nothing", [module.total]).ready(module.total)


def test_a_process_that_fails_keeps_nobody_waiting(module: ModuleType) -> None:
    ahead = BackgroundCompiler(f"{module.__name__}:nothing", [module.total])
    assert ahead.wait(module.total, lambda: False)
    assert module.total(4) == 7.0
    ahead.close()


def test_who_waits_for_a_compiler_that_closes_compiles_nothing(module: ModuleType) -> None:
    # A window that closes ends the process before its threads, which wait for loops.
    ahead = BackgroundCompiler(f"{module.__name__}:compile_late", [module.total])
    found: list[bool] = []
    waiting = threading.Thread(target=lambda: found.append(ahead.wait(module.total, lambda: False)))
    waiting.start()
    ahead.close()
    waiting.join(30.0)
    assert found == [False]
    assert not ahead.ready(module.total)
