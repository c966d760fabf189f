"""``import airlight`` and the command line's help are quick, because nothing heavy comes along."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

HEAVY = ["numba", "scipy", "xarray", "pint", "PIL", "OpenEXR", "pandas", "matplotlib"]
#: What a picture of a preset does without: half a second and more.
NEEDLESS = [
    "pint", "xarray", "pandas", "matplotlib", "OpenEXR", "wgpu",
    "scipy.interpolate", "scipy.optimize", "scipy.sparse", "scipy.special",
]  # fmt: skip

#: Modules of the standard library, and the CPU time of their import on that machine. [s]
YARDSTICK = ("asyncio", "decimal", "email.message", "http.client", "json", "sqlite3",
             "unittest.mock", "xml.dom.minidom")  # fmt: skip
USUAL = 0.10


def python(*arguments: str) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [sys.executable, *arguments], capture_output=True, text=True, check=True, timeout=600
    )


def cpu_seconds(statement: str) -> float:
    """CPU time of a process that runs one statement, the best of three. [s]"""
    code = f"{statement}; import time; print(time.process_time())"
    return min(float(python("-c", code).stdout) for _ in range(3))


def import_seconds(statement: str) -> float:
    """The same on the machine that the bars were set on: a slower one is given more time. [s]"""
    slowness = cpu_seconds(f"import {', '.join(YARDSTICK)}") / USUAL
    return cpu_seconds(statement) / max(slowness, 1.0)


def test_import_airlight_takes_less_than_half_a_second() -> None:
    # the bar of the architecture: 0.5 s, interpreter's own modules included
    assert import_seconds("import airlight") < 0.5


def test_help_of_the_command_line_takes_less_than_a_second() -> None:
    # 0.2 s on the machine it was written on
    assert import_seconds("import airlight.cli") < 0.8


@pytest.mark.parametrize("statement", ["import airlight", "import airlight.cli"])
def test_nothing_heavy_is_imported_before_it_is_used(statement: str) -> None:
    code = f"{statement}; import sys; print(*[m for m in {HEAVY} if m in sys.modules])"
    assert python("-c", code).stdout.split() == []


def test_a_picture_of_earth_imports_only_what_it_uses(tmp_path: Path) -> None:
    # five wavelengths are the fewest whose colours are a spline's
    words = ["render", "earth", "--size=16x9", "--wavelengths=5", "--quality=preview", "-oe.png"]
    code = (
        f"from airlight.cli import main; import sys; assert main({words}) == 0;"
        f"print('imported', *[m for m in {NEEDLESS} if m in sys.modules])"
    )
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=600
    )
    assert done.returncode == 0, done.stderr
    assert done.stdout.splitlines()[-1] == "imported"


def test_every_public_name_is_found_where_it_is_said_to_live() -> None:
    import airlight

    for name in airlight.__all__:
        assert getattr(airlight, name) is not None
        assert name in dir(airlight)
    with pytest.raises(AttributeError, match="no attribute 'no_such_name'"):
        _ = airlight.no_such_name
