"""Commands and code of the page on users' own tables run as they stand there."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from airlight import load_planet
from airlight.cli import main

ROOT = Path(__file__).parents[2]
PAGE = (ROOT / "docs" / "own-tables.md").read_text(encoding="utf-8")
COMMANDS = [line for line in PAGE.splitlines() if line.startswith("airlight import ")]


def test_commands_of_the_page_write_planets(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    # The tables are those of the repository; later commands take planets that earlier ones wrote.
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    assert len(COMMANDS) == 9
    for command in COMMANDS:
        assert main(shlex.split(command)[1:]) == 0, capsys.readouterr().err
        assert load_planet(Path(command.rpartition(" -o ")[2].split()[0])).constituents


def test_code_of_the_page_makes_a_planet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # All but the last line, which solves.
    monkeypatch.chdir(tmp_path)
    (code,) = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)
    exec(code[: code.index("solution =")], {})
    assert load_planet(tmp_path / "hazy.toml").name == "Earth, aerosol of Dataset"
