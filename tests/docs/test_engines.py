"""Commands of the page about engines, run where the program is not needed."""

from __future__ import annotations

import re
import shlex
from collections.abc import Callable
from pathlib import Path

import pytest

from airlight.cli import main
from airlight.engines.targets import MODULES

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "engines.md").read_text(encoding="utf-8")
README = (ROOT / "README.md").read_text(encoding="utf-8")
_BLOCK = re.compile(r"^```console\n(.*?)^```$", re.MULTILINE | re.DOTALL)
LINES = [line for found in _BLOCK.finditer(PAGE) for line in found[1].splitlines()]
BAKES = [line.removeprefix("$ airlight ") for line in LINES if line.startswith("$ airlight bake ")]
#: What makes an export of tables small.
SMALL = {"cosmoscout": ["--size", "4x8x4x4", "--wavelengths", "rgb"]}
#: Programs that fix the sizes of their tables.
LARGE = ("takram", "bruneton-demo")


def test_each_program_has_a_row_and_three_commands():
    for name in MODULES:
        assert f"`{name}`" in README
        assert f"| `{name}` |" in PAGE
        assert sum(f"--layout {name} " in line for line in BAKES) == 1
    for block in _BLOCK.finditer(PAGE):
        assert block[1].count("$ ") == 3


def check_files(folder: str, made: Path) -> None:
    """The files that the page's commands name in a folder are in the one that was made."""
    for line in LINES:
        for name in re.findall(rf"(?<![\w/]){re.escape(folder)}/([\w.-]+)", line):
            assert (made / name).is_file(), name


@pytest.mark.slow
@pytest.mark.parametrize("layout", LARGE)
def test_the_command_of_large_tables_writes_the_files_that_the_next_ones_take(
    layout: str, target_folder: Callable[[str, str], Path]
) -> None:
    (command,) = (line for line in BAKES if f"--layout {layout} " in line)
    bake, planet, *options, folder = shlex.split(command)
    assert (bake, options) == ("bake", ["--layout", layout, "-o"])
    check_files(folder, target_folder(layout, planet))


@pytest.mark.parametrize(
    "command", [line for line in BAKES if line.split()[3] not in LARGE],
    ids=lambda line: line.split()[3],
)  # fmt: skip
def test_the_command_writes_the_files_that_the_next_ones_take(
    command: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    words = shlex.split(command)
    layout = words[words.index("--layout") + 1]
    assert main([*words, "--quality", "preview", *SMALL.get(layout, [])]) == 0
    folder = words[words.index("-o") + 1]
    assert f"{folder}  " in capsys.readouterr().out
    check_files(folder, Path(folder))
