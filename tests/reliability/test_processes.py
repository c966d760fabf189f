"""Commands killed at random, and on damaged caches: a small budget of ``scripts/soak``."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import pytest
from outputs import FUZZERS, undisturbed
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
    kept = shutil.ignore_patterns("maps", "solutions")  # these commands solve, and need no map
    shutil.copytree(cache_folder(), cache, ignore=kept)
    (folder / "here").mkdir()
    return references(folder / "here", cache), cache


@pytest.fixture(scope="module")
def whole(begun: tuple[References, Path], tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Folder with the undisturbed outputs of the commands that go on."""
    return undisturbed(tmp_path_factory.mktemp("whole"), begun[1])


@pytest.mark.parametrize("count", [2, pytest.param(60, marks=pytest.mark.validation)])
def test_kills_leave_no_half_written_file(
    count: int, tmp_path: Path, begun: tuple[References, Path]
) -> None:
    (tmp_path / "here").mkdir()
    tally = try_kills(count, 1, tmp_path / "here", begun[1], whole=begun[0])
    assert tally.broke == []
    assert tally.tried == count


@pytest.mark.parametrize("count", [3, pytest.param(60, marks=pytest.mark.validation)])
def test_damaged_caches_give_the_right_result(
    count: int, tmp_path: Path, begun: tuple[References, Path]
) -> None:
    (tmp_path / "here").mkdir()
    damaged = shutil.copytree(begun[1], tmp_path / "cache")
    tally = try_caches(count, 6, tmp_path / "here", damaged, whole=begun[0])
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


@pytest.mark.parametrize(
    ("fuzzer", "count", "seed"),
    [
        ("damage", 2, 3),
        ("writers", 2, 6),  # three sweeps, then two films
        # "places" in short: tests/test_child_processes.py
        *(pytest.param(one, 30, 3, marks=pytest.mark.validation) for one in FUZZERS),
    ],
)
def test_outputs_are_mended_shared_and_apart_from_foreign_modules(
    fuzzer: str,
    count: int,
    seed: int,
    tmp_path: Path,
    begun: tuple[References, Path],
    whole: Path,
) -> None:
    tally = FUZZERS[fuzzer](count, seed, tmp_path / "here", begun[1], whole)
    assert tally.broke == []
    assert tally.tried == count
