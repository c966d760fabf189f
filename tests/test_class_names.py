"""Words of the source: class names are unique, and the library does not name options."""

from __future__ import annotations

import ast
import re
from collections import Counter
from functools import cache
from pathlib import Path

import airlight

PACKAGE = Path(airlight.__file__).parent


@cache
def nodes() -> list[tuple[Path, ast.AST]]:
    return [
        (source.relative_to(PACKAGE), node)
        for source in PACKAGE.rglob("*.py")
        for node in ast.walk(ast.parse(source.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef | ast.Call)
    ]


def test_class_names_are_unique() -> None:
    # A reader who searches for a class finds one definition.
    names = Counter(node.name for _, node in nodes() if isinstance(node, ast.ClassDef))
    assert [name for name, count in names.items() if count > 1] == []


def test_errors_of_the_library_name_no_option() -> None:
    # They reach Python users too; the command line puts the option's name in.
    found = [
        f"{source}:{node.lineno}"
        for source, node in nodes()
        if source.parts[0] != "cli" and isinstance(node, ast.Call)
        if ast.unparse(node.func).endswith(("Error", "warn"))
        if re.search(r"(?<![\w-])--[a-z]", ast.unparse(node))
    ]
    assert found == []
