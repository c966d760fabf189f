"""Commands and scripts of the page about environment maps, run small."""

from __future__ import annotations

import os
import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from airlight.cli import main
from airlight.engines.environment.consumers import CONSUMERS

PAGE = (Path(__file__).parents[2] / "docs" / "environment-maps.md").read_text(encoding="utf-8")
#: What makes a map small: no other part of a command is changed.
SMALL = ["--quality", "preview", "--wavelengths", "rgb"]
_BLOCK = re.compile(r"^```([\w ]+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(kind: str) -> list[str]:
    return [found[2] for found in _BLOCK.finditer(PAGE) if found[1] == kind]


COMMANDS = [
    line.removeprefix("$ airlight ")
    for block in blocks("console")
    for line in block.splitlines()
    if line.startswith("$ airlight sky ")
]


def made(command: str) -> None:
    """Run a command of the page in the working folder, small."""
    words = shlex.split(command)
    if "--size" in words:
        words[words.index("--size") + 1] = "48"
    else:
        words += ["--size", "48"]
    assert main([*words, *SMALL]) == 0


def test_every_program_has_its_commands() -> None:
    assert {shlex.split(line)[shlex.split(line).index("--for") + 1] for line in COMMANDS} == set(
        CONSUMERS
    )


@pytest.mark.slow
@pytest.mark.parametrize("command", sorted(set(COMMANDS)))
def test_each_command_writes_its_map(
    command: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    made(command)
    words = shlex.split(command)
    output = Path(words[words.index("-o") + 1])
    assert output.is_file()
    assert output.with_suffix(".json").is_file()


@pytest.mark.slow
def test_the_command_of_a_sequence_draws_frames_of_a_dome(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (command,) = (
        line.removeprefix("$ airlight ")
        for block in blocks("console")
        for line in block.splitlines()
        if line.startswith("$ airlight animate ")
    )
    words = shlex.split(command)
    words[words.index("--size") + 1] = "32"
    assert main([*words, *SMALL, "--frames", "2", "--workers", "1"]) == 0
    names = sorted(one.name for one in Path("dome").glob("*.png"))
    assert names == ["earth_00001.png", "earth_00002.png"]


@pytest.mark.slow
@pytest.mark.parametrize(("program", "written"), [("mitsuba", "ball.exr"), ("usd", "shot.usda")])
def test_the_script_of_a_program_runs_on_its_map(
    program: str,
    written: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    pytest.importorskip({"mitsuba": "mitsuba", "usd": "pxr"}[program])
    monkeypatch.chdir(tmp_path)
    made(next(one for one in COMMANDS if f"--for {program}" in one))
    (script,) = blocks(f"python {program}")
    Path("script.py").write_text(script, encoding="utf-8")
    run = subprocess.run(
        [sys.executable, "script.py"], env=dict(os.environ), capture_output=True, text=True,
        timeout=120,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    assert Path(written).stat().st_size > 0
