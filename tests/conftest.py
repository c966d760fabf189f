"""What all tests share: markers, order, reference data, a GPU, solutions, error tables."""

from __future__ import annotations

import gc
import os
import pickle
import re
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, NoReturn

import pytest
from _pytest.doctest import DoctestModule

try:
    import fcntl
except ImportError:  # Windows
    fcntl = None  # type: ignore[assignment]

if TYPE_CHECKING:
    from airlight.engines.composition.aerial_perspective import AerialPerspective
    from airlight.planets import Planet
    from airlight.render.gpu.device.device import Device
    from airlight.solver.moments.solution import MomentsSolution

#: Fixtures that bring a browser, and those that bring a GPU or a window.
_BROWSER, _GPU = {"chromium"}, {"device", "gpu", "lacking"}
#: Folders whose files stay on one worker: they share solutions that take long, or a browser.
_TOGETHER = (
    "engines/baking", "engines/environment", "geometry/mappings", "image", "physics/optics",
    "planets", "render", "scene", "studies/plots", "web",
)  # fmt: skip
#: Groups of tests that take longest, each above a minute, the longest first. Files named here stay
#: on a worker of their own.
_LONGEST = (
    "web", "render", "tests/viewer/test_window.py", "tests/render/gpu/test_gpu_renderer.py",
    "tests/web/test_devices.py", "tests/web/test_marimo.py", "tests/web/test_edits.py",
    "tests/web/test_jupyterlab.py", "tests/docs/test_tutorials.py",
    "tests/reliability/test_processes.py",
)  # fmt: skip
#: Files that take most of the time on a CPU, left out with what is marked slow: each test of them
#: takes more than 0.04 s in the mean.
_SLOW_FILES = frozenset((Path(__file__).parent / "slow_files.txt").read_text("utf-8").split())
#: Its tests share nothing, and take long.
_APART = "tests/against/test_solvers_agree.py"


def pytest_configure(config: pytest.Config) -> None:
    from hypothesis import settings

    # The first call of a kernel compiles, which takes seconds; and a run must be repeatable.
    settings.register_profile("airlight", deadline=None, derandomize=True, database=None)
    settings.load_profile("airlight")
    # Mesa's software GPU compiles shaders for small pictures, which it then draws as fast: without
    # LLVM's optimisation. Notebooks and browsers inherit it; other GPUs do not read it.
    os.environ.setdefault("GALLIVM_PERF", "nopt")
    workers = os.environ.get("PYTEST_XDIST_WORKER_COUNT")
    if workers is not None:  # all workers together have as many threads as there are CPU cores
        threads = str(max(1, (os.cpu_count() or 1) // int(workers)))
        os.environ.setdefault("AIRLIGHT_THREADS", threads)


@pytest.hookimpl(wrapper=True)
def pytest_collection() -> Iterator[None]:
    """Modules and tests stay to the end: the garbage collector never looks through them."""
    gc.disable()
    try:
        return (yield)
    finally:
        gc.enable()
        gc.freeze()


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Files of which no test is asked for take no time of the collection either."""
    if "not slow" not in config.option.markexpr:
        return None
    return collection_path.relative_to(Path(__file__).parent).as_posix() in _SLOW_FILES or None


@pytest.hookimpl(wrapper=True)
def pytest_collect_file() -> Iterator[None]:
    """Doctests are in ``src`` only: looking for them here takes as long as the tests."""
    found: Any = yield
    return [one for one in found if not isinstance(one, DoctestModule)]


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    for item in items:
        fixtures = set(getattr(item, "fixturenames", ()))
        if fixtures & _BROWSER:
            item.add_marker(pytest.mark.browser)
        if fixtures & _GPU:
            item.add_marker(pytest.mark.gpu)
    if "PYTEST_XDIST_WORKER" in os.environ:
        _longest_first(items)


def _longest_first(items: list[pytest.Item]) -> None:
    """Begin with the groups of tests that take longest, so that no worker idles at the end."""
    ranks: dict[str, tuple[int, int]] = {}
    for n, item in enumerate(items):
        marked = [bool(item.get_closest_marker(name)) for name in ("browser", "slow", "gpu")]
        rank = marked.index(True) if any(marked) else len(marked)
        group = _group(item.nodeid)
        if group in _LONGEST:
            rank = _LONGEST.index(group) - len(_LONGEST)
        ranks[group] = min((rank, n), ranks.get(group, (rank, n)))
    items.sort(key=lambda item: ranks[_group(item.nodeid)])


def _group(nodeid: str) -> str:
    """What stays on one worker: a file, some folders, and the doctests of a package."""
    file = nodeid.partition("::")[0]
    if file == _APART:
        return nodeid
    parts = file.split("/")
    if parts[0] == "src":
        return "/".join(parts[:3])
    folder = "/".join(parts[1:-1])
    return folder if folder in _TOGETHER and file not in _LONGEST else file


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    from xdist.scheduler import LoadScopeScheduling

    class Scheduling(LoadScopeScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return _group(nodeid)

    return Scheduling(config, log)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    reports = [one for some in terminalreporter.stats.values() for one in some]
    lines = [
        value
        for report in reports
        if getattr(report, "when", None) == "call"
        for name, value in report.user_properties
        if name == "measured"
    ]
    if lines:
        terminalreporter.section("measured")
        for line in lines:
            terminalreporter.write_line(line)


@pytest.fixture
def tell(request: pytest.FixtureRequest) -> Callable[[str], None]:
    """Puts a line into the section "measured" at the end of the run, passed or failed."""
    return lambda line: request.node.user_properties.append(("measured", line))


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
    from airlight.render.gpu.device.device import NoDevice, open_device

    try:
        return open_device()
    except NoDevice as reason:
        lacking(str(reason))


def _shared_folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Temporary folder of this run, of all its workers."""
    base = tmp_path_factory.getbasetemp()
    return base.parent if "PYTEST_XDIST_WORKER" in os.environ else base


@pytest.fixture(scope="session", autouse=True)
def own_solutions(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """A fresh folder for solutions, particles' optics and rates, which the workers of a run share.

    Compiled code stays where it is, shared between runs.
    """
    from airlight.kernel import cost
    from airlight.kernel import disk as cache

    folder = _shared_folder(tmp_path_factory) / "cache"
    folder.mkdir(exist_ok=True)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(cache, "cache_folder", lambda: folder)
        patch.setattr(cost, "cache_folder", lambda: folder)
        yield folder / "solutions"


@pytest.fixture(scope="session")
def once(tmp_path_factory: pytest.TempPathFactory) -> Callable[[str, Callable[[], Any]], Any]:
    """``once(name, make)``: what ``make`` returns, made by one worker of a run, read by the others.

    Whoever asks while another makes it waits; so nothing that is made asks in its turn.
    """
    folder = _shared_folder(tmp_path_factory) / "once"

    def made(name: str, make: Callable[[], Any]) -> Any:
        folder.mkdir(exist_ok=True)
        file = folder / f"{re.sub(r'[^-.0-9a-z]+', '-', name)}.pickle"
        with file.with_suffix(".lock").open("w") as lock:
            if fcntl is not None:  # elsewhere each worker may make it, with the same result
                fcntl.flock(lock, fcntl.LOCK_EX)  # gone with this process, however it ends
            if not file.is_file():
                part = file.with_suffix(f".{os.getpid()}")
                part.write_bytes(pickle.dumps(make()))
                part.replace(file)
            return pickle.loads(file.read_bytes())

    return made


@pytest.fixture(scope="session")
def reference_earth() -> Callable[..., Planet]:
    """Makes the planet of the reference radiances: AP2's air, a point star of irradiance 1."""
    from airlight.validation import reference_earth

    return reference_earth.reference_earth


@pytest.fixture(scope="session")
def solved() -> Callable[..., MomentsSolution]:
    """``solve``, each planet, wavelengths, quality and polarisation only once in a run."""
    from airlight import solve

    kept: dict[Any, MomentsSolution] = {}

    def solution(
        planet: Planet, wavelengths: tuple[float, ...] | None = None, quality: str = "default",
        *, polarisation: bool = True,
    ) -> MomentsSolution:  # fmt: skip
        key = (planet, wavelengths, quality, polarisation)
        if key not in kept:
            kept[key] = solve(planet, wavelengths, quality, polarisation=polarisation, cache=False)
        return kept[key]

    return solution


@pytest.fixture(scope="session")
def target_folder(
    once: Callable[[str, Callable[[], Any]], Any], tmp_path_factory: pytest.TempPathFactory
) -> Callable[[str, str], Path]:
    """Folder that ``bake --layout`` writes for a preset, of full size, made once in a run."""
    from airlight.cli import main

    def folder(layout: str, name: str) -> Path:
        def make() -> str:
            made = tmp_path_factory.mktemp(layout) / name
            words = ["bake", name, "--layout", layout, "--quality", "preview", "-o", str(made)]
            assert main(words) == 0
            return str(made)

        return Path(once(f"{layout}-{name}", make))

    return folder


@pytest.fixture(scope="session")
def takram_folder(target_folder: Callable[[str, str], Path]) -> Callable[[str], Path]:
    """``target_folder`` of ``--layout takram``."""
    return lambda name: target_folder("takram", name)


@pytest.fixture(scope="session")
def demo_folder(target_folder: Callable[[str, str], Path]) -> Callable[[str], Path]:
    """``target_folder`` of ``--layout bruneton-demo``."""
    return lambda name: target_folder("bruneton-demo", name)


@pytest.fixture(scope="session")
def aerial(once: Callable[[str, Callable[[], Any]], Any]) -> AerialPerspective:
    """Small tables of the air over Earth, sun at 75°, observer at 500 m."""
    from airlight import Scene, load_planet, solve
    from airlight.engines.composition.aerial_perspective import AerialPerspective

    def make() -> AerialPerspective:
        solution = solve(load_planet("earth"), (440, 500, 560, 620), "preview", cache=False)
        scene = Scene(altitude=500.0, sun_zenith=75.0)
        return AerialPerspective.fill(solution, scene, size=(24, 24, 6), sky_size=(48, 48))

    return once("aerial", make)
