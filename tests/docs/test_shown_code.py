"""Code that the pages show is where they say (the whole site is built late in the check)."""

from __future__ import annotations

import ast
import re
from pathlib import Path

import pytest

_PAGES = Path(__file__).parents[2] / "docs"
_SHOWN = [
    (page, named, shown)
    for page in sorted(_PAGES.rglob("*.md"))
    for named, shown in re.findall(
        r"^```\{literalinclude\} (\S+)\n(?::pyobject: (\S+))?", page.read_text(), re.MULTILINE
    )
]


def test_pages_show_code() -> None:
    assert len([shown for *_, shown in _SHOWN if shown]) > 10


@pytest.mark.parametrize(
    ("page", "named", "shown"),
    _SHOWN,
    ids=[f"{page.stem}-{Path(n).stem}-{s}" for page, n, s in _SHOWN],
)
def test_shown_code_exists(page: Path, named: str, shown: str) -> None:
    file = page.parent / named
    assert file.is_file(), f"{page.name} shows {named}"
    if shown:
        tree = ast.parse(file.read_text())
        names = [
            node.name for node in tree.body if isinstance(node, ast.FunctionDef | ast.ClassDef)
        ]
        assert shown in names, f"{page.name} shows {shown}, which {named} does not define"
