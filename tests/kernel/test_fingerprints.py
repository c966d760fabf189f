"""Fingerprints follow what a file imports, and nothing else."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from airlight.kernel import fingerprints
from airlight.kernel.compiling import reached
from airlight.kernel.fingerprints import fingerprint

Write = Callable[[str, str], Path]


def forget() -> None:
    for function in (fingerprint, fingerprints._read, fingerprints._files):
        function.cache_clear()


@pytest.fixture
def write(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Write:
    """Write a module of the test's own package."""
    monkeypatch.setattr(fingerprints, "_PACKAGE", tmp_path)
    forget()

    def written(name: str, text: str) -> Path:
        file = tmp_path / name
        file.parent.mkdir(exist_ok=True)
        file.write_text(text)
        forget()
        return file

    yield written
    forget()


@pytest.mark.parametrize(
    "text",
    [
        "from airlight.solver.march import step",
        "from airlight.solver import (\n    other,\n    march,\n)",
        "from airlight.solver import march as m",
        "import airlight.solver.march",
        "def late():\n    from airlight.solver.march import step",
    ],
)
def test_a_change_of_an_imported_file_is_noticed(write: Write, text: str) -> None:
    # All forms in which Python imports; the file between them is imported by the middle one.
    write("geometry.py", "A = 1")
    write("solver/march.py", "from airlight.geometry import A")
    file = write("picture.py", text)
    before = fingerprint(file)
    write("geometry.py", "A = 2")
    assert fingerprint(file) != before


def test_a_change_elsewhere_is_not(write: Write) -> None:
    file = write("geometry.py", "A = 1")
    above = write("picture.py", "from airlight.geometry import A")
    before = fingerprint(file), fingerprint(above)
    write("other.py", "from airlight.picture import A")
    write("picture.py", "from airlight.geometry import A  # again")
    assert fingerprint(file) == before[0]
    assert fingerprint(above) != before[1]
    assert len(before[0]) == 16
    assert int(before[0], 16) >= 0


@pytest.mark.parametrize(
    "text",
    [
        "if TYPE_CHECKING:\n    from airlight.geometry import A",
        "def late():\n    from airlight.geometry import A",
    ],
)
def test_compiled_code_does_not_depend_on_late_imports(write: Write, text: str) -> None:
    write("geometry.py", "A = 1")
    file = write("picture.py", text)
    before = fingerprint(file, late=False), fingerprint(file)
    write("geometry.py", "A = 2")
    assert fingerprint(file, late=False) == before[0]
    assert fingerprint(file) != before[1]


def test_every_function_that_a_loop_inlines_is_in_its_fingerprint() -> None:
    from airlight.render.background_compilation import MARCH_LOOPS, SKY_VIEW_LOOPS, cloudy_loops
    from airlight.solver.eclipsed import eclipsed_march
    from airlight.solver.moments.loops import LOOPS

    eclipsed = [one for one in vars(eclipsed_march).values() if hasattr(one, "py_func")]
    loops = (*SKY_VIEW_LOOPS, *MARCH_LOOPS, *cloudy_loops(), *LOOPS, *eclipsed)
    for loop in loops:
        known = fingerprints._reached(Path(loop.py_func.__code__.co_filename), late=False)
        called = {Path(one.py_func.__code__.co_filename) for one in reached([loop]).values()}
        assert called <= known, loop
