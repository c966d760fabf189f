"""Names of classes: one concept, one name in the whole package."""

from __future__ import annotations

import ast
from collections import Counter
from pathlib import Path

import airlight

#: Duplicates that remain within the solvers, the shader emitter and the viewer.
KNOWN = {"Directions", "Grid", "Reading", "Settings", "Table", "Uniform"}


def test_class_names_are_unique() -> None:
    # A reader who searches for a class finds one definition.
    sources = Path(airlight.__file__).parent.rglob("*.py")
    names = Counter(
        node.name
        for source in sources
        for node in ast.walk(ast.parse(source.read_text(encoding="utf-8")))
        if isinstance(node, ast.ClassDef)
    )
    assert {name for name, count in names.items() if count > 1} <= KNOWN
