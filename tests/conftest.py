"""What all tests share: reference data, a GPU, a room of their own for solutions, error tables."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import pytest

if TYPE_CHECKING:
    from airlight.gpu.device.device import Device
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


@pytest.fixture(scope="session")
def lacking() -> Callable[[str], NoReturn]:
    """What a test calls that cannot run here: it skips with the reason, in CI it fails.

    For programs and devices that ``scripts/test`` installs where it may.
    """

    def stop(reason: str) -> NoReturn:
        if os.environ.get("CI") or os.environ.get("AIRLIGHT_REQUIRE_GPU"):
            pytest.fail(f"{reason} (CI or AIRLIGHT_REQUIRE_GPU is set: a skip is a failure)")
        pytest.skip(reason)

    return stop


@pytest.fixture(scope="session")
def device(lacking: Callable[[str], NoReturn]) -> Device:
    """A GPU, or one in software."""
    from airlight.gpu.device.device import NoDevice, open_device

    try:
        return open_device()
    except NoDevice as reason:
        lacking(str(reason))


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
