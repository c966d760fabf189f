"""What all benchmarks share: no solution from the disk, and lines at the end of the run."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import pytest

from airlight import load_planet, solve

RGB = (680.0, 550.0, 440.0)

_LINES = pytest.StashKey[list[str]]()


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", "slow: takes more than ten seconds")
    config.stash[_LINES] = []


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    lines = terminalreporter.config.stash[_LINES]
    if lines:
        terminalreporter.section("measured")
        for line in lines:
            terminalreporter.write_line(line)


@pytest.fixture
def tell(pytestconfig: pytest.Config) -> Callable[[str], None]:
    """Puts a line into the section "measured" at the end of the run."""
    return pytestconfig.stash[_LINES].append


@pytest.fixture(scope="session", autouse=True)
def own_solutions(tmp_path_factory: pytest.TempPathFactory) -> Iterator[None]:
    """A fresh folder for solutions; compiled code stays where it is, shared between runs."""
    from airlight.kernel import disk as cache

    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cache, "cache_folder", lambda: folder)
        yield


@pytest.fixture(scope="session")
def earth() -> Any:
    return load_planet("earth")


@pytest.fixture(scope="session")
def rgb_solution(earth: Any) -> Any:
    return solve(earth, RGB, cache=False)
