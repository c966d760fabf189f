"""What all tests share: reference data, a room of their own for solutions, and error tables."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from airlight.planets import Planet
    from airlight.solvers.moments.solution import MomentsSolution

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
    """Puts a line into the section "measured" at the end of the run, passed or failed."""
    return pytestconfig.stash[_LINES].append


@pytest.fixture(scope="session")
def reference_data() -> Path:
    """The folder of reference data that is not part of the repository."""
    named = os.environ.get("AIRLIGHT_DATA")
    folder = Path(named) if named else Path(__file__).parents[2] / "shared" / "data"
    if not folder.is_dir():
        pytest.skip("no reference data: AIRLIGHT_DATA names no folder, and ../shared/data is none")
    return folder


@pytest.fixture(scope="session", autouse=True)
def own_solutions(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A fresh folder for solutions; compiled code stays where it is, shared between runs."""
    from airlight.kernel import disk as cache

    folder = tmp_path_factory.mktemp("cache")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cache, "cache_folder", lambda: folder)
        yield folder / "solutions"


@pytest.fixture(scope="session")
def reference_earth() -> Callable[..., Planet]:
    """Makes the planet of the reference radiances: AP2's air, a point star of irradiance 1."""
    from airlight.validation import reference_earth

    return reference_earth.reference_earth


@pytest.fixture(scope="session")
def solved() -> Callable[..., MomentsSolution]:
    """``solve``, each planet, wavelengths and quality only once in a run."""
    from airlight import solve

    kept: dict[Any, MomentsSolution] = {}

    def solution(
        planet: Planet, wavelengths: tuple[float, ...] | None = None, quality: str = "default"
    ) -> MomentsSolution:
        key = (repr(planet), wavelengths, quality)
        if key not in kept:
            kept[key] = solve(planet, wavelengths, quality, cache=False)
        return kept[key]

    return solution
