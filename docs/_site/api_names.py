"""Every public name of the package, read from its source without importing it."""

from __future__ import annotations

import ast
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

#: Packages that have no library for others: thin commands, which have a page of their own.
LEFT_OUT = ("cli",)


@dataclass(frozen=True)
class Module:
    """One module and what it defines for others.

    Attributes
    ----------
    name : str
        Dotted, such as ``airlight.physics.optics.rayleigh``.
    sentence : str
        First line of its docstring.
    is_package : bool
    classes, functions : tuple of str
        Public names that are defined here, in the order of the source.
    constants : dict of str to str
        Public constants, with what the comment ``#:`` above them says; without one none is public.
    """

    name: str
    sentence: str
    is_package: bool
    classes: tuple[str, ...]
    functions: tuple[str, ...]
    constants: dict[str, str]

    @property
    def names(self) -> tuple[str, ...]:
        """All of them."""
        return (*self.classes, *self.functions, *self.constants)


def modules(package: Path) -> Iterator[Module]:
    """All modules below a package's folder, packages before what they hold."""
    for path in sorted(package.rglob("*.py"), key=lambda path: _dotted(package, path)):
        parts = _dotted(package, path)
        if (len(parts) > 1 and parts[1] in LEFT_OUT) or any(one.startswith("_") for one in parts):
            continue
        yield _read(path, ".".join(parts))


def _dotted(package: Path, path: Path) -> tuple[str, ...]:
    parts = path.relative_to(package.parent).with_suffix("").parts
    return parts[:-1] if parts[-1] == "__init__" else parts


def _read(path: Path, name: str) -> Module:
    text = path.read_text(encoding="utf-8")
    tree = ast.parse(text)
    lines = text.splitlines()
    classes = [node.name for node in tree.body if isinstance(node, ast.ClassDef)]
    functions = [node.name for node in tree.body if isinstance(node, ast.FunctionDef)]
    constants = {}
    for node in tree.body:
        if isinstance(node, ast.Assign | ast.AnnAssign):
            for target in node.targets if isinstance(node, ast.Assign) else [node.target]:
                if isinstance(target, ast.Name) and (words := _comment_above(lines, node.lineno)):
                    constants[target.id] = words
    sentence = (ast.get_docstring(tree) or "").split("\n\n")[0].replace("\n", " ")
    return Module(
        name,
        sentence,
        path.name == "__init__.py",
        tuple(dict.fromkeys(one for one in classes if not one.startswith("_"))),
        tuple(dict.fromkeys(one for one in functions if not one.startswith("_"))),
        {one: words for one, words in constants.items() if not one.startswith("_")},
    )


def _comment_above(lines: list[str], number: int) -> str:
    """The ``#:`` lines above a line of the source, joined."""
    words: list[str] = []
    while number >= 2 and lines[number - 2].startswith("#:"):
        number -= 1
        words.insert(0, lines[number - 1].removeprefix("#:").strip())
    return " ".join(words)


def exported(package: Path) -> tuple[str, ...]:
    """``__all__`` of a package, in its order; empty without one."""
    tree = ast.parse((package / "__init__.py").read_text(encoding="utf-8"))
    for node in tree.body:
        if isinstance(node, ast.Assign) and any(
            isinstance(target, ast.Name) and target.id == "__all__" for target in node.targets
        ):
            return tuple(ast.literal_eval(node.value))
    return ()
