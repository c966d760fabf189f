"""The page of the command line, from the commands themselves."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

from command_pictures import FOLDER, OPTIONS
from page_files import write_pages

HEAD = """# Commands

`airlight COMMAND --help` prints what stands here. `PLANET` is the name of a preset (see `airlight
planets`) or the path of a [planet file](../planet-files.md). Numbers may carry their unit:
`400km`, `85deg`. Every error is one line, and the exit status is then 2.
"""


def write(path: Path) -> None:
    """Write the page."""
    import typer.main

    from airlight.cli.app import app

    root: Any = typer.main.get_command(app)
    parts = [HEAD]
    for name in root.list_commands(None):
        parts.extend(_command(name, root.get_command(None, name)))
    shown = "\n".join(parts)
    lost = [f"{command}{flag}" for command, flag in OPTIONS if f"{command}{flag}.jpg" not in shown]
    if lost:
        raise ValueError(f"docs/_site/command_pictures.py: no such option: {', '.join(lost)}")
    write_pages(path.parent, {path.name: shown})


def _command(name: str, command: Any) -> list[str]:
    arguments = [one for one in command.params if one.param_type_name == "argument"]
    options = [one for one in command.params if one.param_type_name == "option"]
    usage = " ".join(
        ["airlight", name, *(_metavar(one) for one in arguments), "[OPTIONS]" if options else ""]
    ).strip()
    parts = [f"## {name}\n", f"```text\n{usage}\n```\n", _prose(command.help) + "\n"]
    if arguments or options:
        parts.append("| | |\n|---|---|")
        parts.extend(f"| `{_metavar(one)}` | {_cell(one.help)} |" for one in arguments)
        parts.extend(
            f"| {_flags(one)} | {_cell(one.help)}{_default(one)}{_picture(name, one)} |"
            for one in options
        )
        parts.append("")
    lines = re.findall(r"airlight [a-z].*", command.epilog or "")
    if lines:
        parts.append("```text\n" + "\n".join(line.rstrip() for line in lines) + "\n```\n")
    return parts


def _metavar(parameter: Any) -> str:
    from airlight.cli.app import with_words

    return with_words(parameter.metavar or parameter.name or "", "|").upper()


def _flags(option: Any) -> str:
    flags = ", ".join(f"`{flag}`" for flag in [*option.opts, *option.secondary_opts])
    words = _metavar(option).replace("|", "\\|")  # within a table
    return flags if option.is_flag else f"{flags} `{words}`"


def _default(option: Any) -> str:
    if option.default in (None, False, True, "", (), []) or callable(option.default):
        return ""
    return f" (default: `{option.default}`)"


def _picture(command: str, option: Any) -> str:
    """Pair of pictures of an option that changes one."""
    flag = option.opts[-1]
    words = OPTIONS.get((command, flag))
    if words is None:
        return ""
    picture = FOLDER / f"{command}{flag}.jpg"
    if not picture.exists():
        raise ValueError(f"{picture} is missing: builders/option_pictures.py makes it")
    return f"<br>![{flag}](../images/options/{picture.name})<br>Right: `{words}`"


def _prose(text: str | None) -> str:
    return "\n\n".join(" ".join(part.split()) for part in (text or "").split("\n\n"))


def _cell(text: str | None) -> str:
    from airlight.cli.app import with_words

    return " ".join(with_words(text or "").split()).replace("|", "\\|").replace("<", "&lt;")
