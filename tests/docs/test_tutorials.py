"""Every command and every block of Python in the tutorials, run in the order of the page."""

from __future__ import annotations

import re
import shlex
from functools import partial
from pathlib import Path

import pytest

from airlight.cli import main
from airlight.clouds.planet_clouds import Box
from airlight.render.clouds import clouds_around

ROOT = Path(__file__).parents[2]
OTHERS = ("observables.md", "index.md")
PAGES = [
    *sorted((ROOT / "docs" / "tutorials").glob("*.md")),
    *(ROOT / "docs" / name for name in OTHERS),
]
#: Commands that take long, which are run with the lowest quality unless the page names one.
COSTLY = ("irradiance", "spectrum", "export-page")
_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def _blocks(page: Path) -> list[tuple[str, str, int]]:
    """Language, text and line number of each block of code."""
    text = page.read_text(encoding="utf-8")
    return [
        (found[1], found[2], text.count("\n", 0, found.start()) + 2)
        for found in _BLOCK.finditer(text)
    ]


@pytest.mark.slow
@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_tutorial_runs_from_its_first_to_its_last_block(
    page: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # a reader who copies block after block gets what the page says, or its assertions fail
    monkeypatch.chdir(tmp_path)
    # small fields of clouds: the same code in less time
    monkeypatch.setattr(clouds_around, "Box", partial(Box, size=6400.0))
    names: dict[str, object] = {"__name__": "__main__"}
    for language, text, line in _blocks(page):
        where = f"{page.name}, line {line}"
        if language == "python":
            exec(compile("\n" * (line - 1) + text, str(page), "exec"), names)
        elif language == "console":
            for command in text.replace("\\\n", " ").splitlines():
                program, *arguments = shlex.split(command.removeprefix("$ "))
                assert command.startswith("$ "), where
                assert program == "airlight", where
                if arguments[0] in COSTLY and "--quality" not in arguments:
                    arguments += ["--quality", "preview"]
                assert _status(arguments) == 0, f"{where}: {command}"


def _status(arguments: list[str]) -> int:
    try:
        return main(arguments) or 0
    except SystemExit as end:
        return int(end.code or 0)


def test_commands_of_the_tutorials_write_what_they_name() -> None:
    # a command that is shown as text only is no command that is checked
    for page in PAGES[:-1]:
        for language, text, line in _blocks(page):
            if language in ("bash", "sh", "text") and "airlight render" in text:
                pytest.fail(f"{page.name}, line {line}: use ```console with $")
