"""Commands killed at random, and on damaged caches: a small budget of ``scripts/soak``."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest
from outputs import FUZZERS
from processes import COMMANDS, References, references, try_caches, try_kills, try_together

from airlight.kernel import cache_folder

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="signals of Unix"),
]


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> tuple[References, Path]:
    """Files of the undisturbed commands, and a cache that has what they need."""
    folder = tmp_path_factory.mktemp("undisturbed")
    cache = folder / "cache"
    shutil.copytree(cache_folder(), cache)
    (folder / "here").mkdir()
    return references(folder / "here", cache), cache


@pytest.fixture
def cache(begun: tuple[References, Path], tmp_path: Path) -> Path:
    """Copy of that cache, so that damage stays here."""
    folder = tmp_path / "cache"
    shutil.copytree(begun[1], folder)
    return folder


@pytest.mark.parametrize("count", [3, pytest.param(60, marks=pytest.mark.validation)])
def test_kills_leave_no_half_written_file(
    count: int, tmp_path: Path, cache: Path, begun: tuple[References, Path]
) -> None:
    (tmp_path / "here").mkdir()
    tally = try_kills(count, 1, tmp_path / "here", cache, whole=begun[0])
    assert tally.broke == []
    assert tally.tried == count


@pytest.mark.parametrize("count", [4, pytest.param(60, marks=pytest.mark.validation)])
def test_damaged_caches_give_the_right_result(
    count: int, tmp_path: Path, cache: Path, begun: tuple[References, Path]
) -> None:
    (tmp_path / "here").mkdir()
    tally = try_caches(count, 2, tmp_path / "here", cache, whole=begun[0])
    assert tally.broke == []
    assert tally.tried == count


@pytest.mark.validation
def test_processes_share_a_cold_cache(tmp_path: Path) -> None:
    tally = try_together(4, tmp_path, tmp_path / "cold")
    assert tally.broke == []
    assert tally.counts["held"] == 4


def test_the_commands_of_the_fuzzers_are_repeatable(begun: tuple[References, Path]) -> None:
    # what differs between two runs could not show a fault: ``references`` makes each file twice
    assert set(begun[0]) == {name for name, _ in COMMANDS}


@pytest.mark.parametrize("fuzzer", FUZZERS)
@pytest.mark.parametrize("count", [3, pytest.param(30, marks=pytest.mark.validation)])
def test_outputs_are_mended_shared_and_apart_from_foreign_modules(
    count: int, fuzzer: str, tmp_path: Path, cache: Path
) -> None:
    tally = FUZZERS[fuzzer](count, 3, tmp_path / "here", cache)
    assert tally.broke == []
    assert tally.tried == count
