"""Examples of the page about films, run small."""

from __future__ import annotations

import re
import shlex
from pathlib import Path

import pytest

from airlight.cli import main
from airlight.studies.film import Quality, load_film

PAGE = (Path(__file__).parents[2] / "docs" / "films.md").read_text(encoding="utf-8")
#: What makes an example small: no other part of it is changed.
SMALL = ["--frames", "2", "--quality", "preview", "--wavelengths", "rgb", "--workers", "1"]
_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def blocks(language: str) -> list[str]:
    return [found[2] for found in _BLOCK.finditer(PAGE) if found[1] == language]


LINES = [line for block in blocks("console") for line in block.splitlines()]
COMMANDS = [line for line in LINES if line.startswith("$ airlight animate ")]


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS, ids=lambda line: line.split()[3])
def test_the_first_and_the_last_frame_of_each_command_can_be_made(command: str) -> None:
    words = shlex.split(command.removeprefix("$ airlight animate "))
    changes: dict[str, object] = {"film.frames": 2}
    keys = []
    for option, value in zip(words[1::2], words[2::2], strict=True):
        if option == "--set":
            path, _, text = value.partition("=")
            changes[path] = text
        elif option in ("--start", "--end"):
            changes[f"film.{option[2:]}"] = value
        elif option == "--key":
            path, _, text = value.partition("=")
            values, _, law = text.partition(" ")
            keys.append({"path": path, "values": values, "law": law or "linear"})
    film = load_film(words[0], {**changes, "film.keys": keys})
    for number in range(2):
        film.frame_spec(number, Quality(width=64, height=64))


@pytest.mark.slow
def test_the_first_command_and_the_film_file_are_drawn(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    words = shlex.split(COMMANDS[0])[2:]
    assert main([*words, *SMALL, "--size", "32x18"]) == 0
    assert Path("sunset.mp4").read_bytes()[4:8] == b"ftyp"
    assert sorted(file.name for file in Path("frames").iterdir()) == [
        "earth_00001.png", "earth_00002.png",
    ]  # fmt: skip
    Path("film.toml").write_text(blocks("toml")[0], encoding="utf-8")
    assert main(["animate", "film.toml", *SMALL, "--size", "32x18", "-o", "climb"]) == 0
    assert len(list(Path("climb").glob("climb-out-of-the-haze_*.png"))) == 2


def test_the_examples_in_python_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    for block in blocks("python"):
        exec(compile(block, "films.md", "exec"), {"__name__": "__main__"})
    assert len(list(Path("frames").glob("*.png"))) == 3


@pytest.mark.slow
def test_the_sweeps_run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    sweeps = [line for line in LINES if line.startswith("$ airlight sweep ")]
    assert len(sweeps) + len(COMMANDS) == len(LINES)
    for line in sweeps:
        words = shlex.split(line.removeprefix("$ airlight "))
        assert main([*words, "--quality", "preview", "--workers", "1"]) == 0
        assert (tmp_path / words[-1] / ".zmetadata").is_file()
