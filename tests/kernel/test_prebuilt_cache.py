"""Compiled code that a package brings along: found on an empty cache, or code is compiled."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Mapping
from pathlib import Path
from types import ModuleType

import pytest

from airlight.kernel.prebuilt_cache import copy_machine_code, target

FORMULA = """
from airlight.kernel import compiled_loop, kernel

@kernel
def squared(x):
    return x * x

@compiled_loop
def cubed(x):
    return squared(x) * x
"""
SCRIPT = """
import sys
from pathlib import Path
from airlight.kernel import prebuilt_cache
prebuilt_cache.PREBUILT = Path({shipped!r})
{before}
sys.path.insert(0, {folder!r})
from airlight.kernel.compiling import on_disk
import formula
print(on_disk(formula.cubed), formula.cubed(3.0), sum(formula.cubed.stats.cache_hits.values()))
"""


def run(
    folder: Path, cache: Path, before: str = "", own: Mapping[str, str] | None = None
) -> list[str]:
    (folder / "formula.py").write_text(FORMULA)
    text = SCRIPT.format(shipped=str(folder / "shipped"), folder=str(folder), before=before)
    done = subprocess.run(
        [sys.executable, "-c", text],
        capture_output=True,
        text=True,
        env={**os.environ, "AIRLIGHT_CACHE": str(cache), **(own or {})},
        timeout=300,
    )
    assert done.stderr == ""
    return done.stdout.split()


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with a formula, and its code for the target that this machine belongs to."""
    made_for = target()
    if made_for is None:
        pytest.skip("no target runs on this CPU")
    folder = tmp_path_factory.mktemp("package")
    own = {"NUMBA_CPU_NAME": made_for.cpu, "NUMBA_CPU_FEATURES": made_for.written}
    assert run(folder, folder / "cache", own=own) == ["False", "27.0", "0"]
    assert len(list((folder / "cache").rglob("*.nbc"))) == 2  # the inner one for its caller
    with pytest.MonkeyPatch.context() as patch:  # code is unpickled, which imports its module
        patch.setitem(sys.modules, "formula", ModuleType("formula"))
        assert copy_machine_code(folder / "cache" / "kernels", folder / "shipped") == 1
    (file,) = (folder / "shipped").rglob("*.nbc")
    assert file.name.startswith("formula.cubed-")
    return folder


def test_prebuilt_cache_runs_on_an_empty_cache(package: Path, tmp_path: Path) -> None:
    assert run(package, tmp_path) == ["True", "27.0", "1"]
    assert not list(tmp_path.rglob("*.nbc"))


def test_code_for_another_processor_is_not_run(package: Path, tmp_path: Path) -> None:
    before = "prebuilt_cache.target = lambda: None"  # a processor without the features
    assert run(package, tmp_path, before) == ["False", "27.0", "0"]
    assert list(tmp_path.rglob("*.nbc"))


def test_damaged_code_is_compiled_anew(package: Path, tmp_path: Path) -> None:
    (file,) = (package / "shipped").rglob("*.nbc")
    whole = file.read_bytes()
    file.write_bytes(whole[:-40] + bytes(40))
    try:
        assert run(package, tmp_path)[1:] == ["27.0", "0"]
    finally:
        file.write_bytes(whole)
