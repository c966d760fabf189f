"""Pages of the API: one for each name of ``airlight``, and one for each package below it."""

from __future__ import annotations

import importlib
from importlib.util import find_spec
from pathlib import Path
from types import GenericAlias, ModuleType, UnionType
from typing import Any, get_origin

from api_names import Module, exported, modules
from page_files import write_pages

#: What the names of ``airlight`` are for, in the order in which they are used.
STATIONS = (
    ("Planets", ("load_planet", "planet_names", "import_table", "ImportedPlanet", "Planet",
                 "Constituent", "Ground", "Star", "Medium", "replace")),
    ("Light", ("solve", "Solution", "degree_of_polarisation", "angle_of_polarisation")),
    ("Pictures", ("Scene", "MoonLight", "StarLight", "Camera", "look_at", "local_ground",
                  "lowered_ground", "render", "Frame", "write_picture")),
    ("Observables", ("observe", "irradiance", "Plane")),
    ("Tables", ("bake", "load_tables")),
    ("Composition", ("compose", "Pinhole", "Placement")),
    ("Errors and warnings", ("AirlightError", "ParameterError", "FileError", "ConvergenceError",
                             "Cancelled", "AirlightWarning")),
)  # fmt: skip

HEAD = """
What most programs need are the names of ``airlight`` itself. Below them stand the packages that
they come from, with every function that solvers, renderer and shaders are made of.
"""


def write(folder: Path, package: Path) -> None:
    """Write all of them, and the index."""
    found = list(modules(package))
    public = [name for name in exported(package) if not name.startswith("__")]
    pages = {f"{name}.rst": _name_page(name) for name in public}
    tops = [one for one in found if one.is_package or one.name.count(".") == 1]
    tops = [one for one in tops if one.name != "airlight"]
    for top in tops:
        pages[f"{top.name}.rst"] = _page(top, found, package)
    pages["index.rst"] = _index(public, tops)
    write_pages(folder, pages)


def _title(text: str, line: str) -> str:
    return f"{text}\n{line * len(text)}\n"


def _name_page(name: str) -> str:
    value, full = _public_object(name)
    kind = "class" if isinstance(value, type) else "function"
    body = _directive(kind, full)
    if full != f"airlight.{name}":  # it stands on the page of its module too
        body = body.replace("\n", "\n   :no-index:\n", 1)
    return f"{_title(f'airlight.{name}', '=')}\n.. currentmodule:: airlight\n\n{body}"


def _public_object(name: str) -> tuple[Any, str]:
    """A name of ``airlight`` and how it is imported; ``render`` is a package that can be called."""
    import airlight

    if find_spec(f"airlight.{name}") is not None:  # the package takes the function's place
        importlib.import_module(f"airlight.{name}")
    value = getattr(airlight, name)
    if isinstance(value, ModuleType):
        return getattr(value, name), f"airlight.{name}.{name}.{name}"
    return value, f"airlight.{name}"


def _page(top: Module, found: list[Module], package: Path) -> str:
    inside = [one for one in found if one.name.rpartition(".")[0] == top.name]
    parts = [_title(top.name, "="), f".. automodule:: {top.name}\n   :no-members:\n"]
    if top.is_package:
        folder = package.joinpath(*top.name.split(".")[1:])
        names = [name for name in exported(folder) if name not in top.names]
        if names:
            links = (f":obj:`~{_home(name, top.name, found)}`" for name in names)
            parts.append(f"Exports {', '.join(links)}.\n")
    modules = [one for one in inside if not one.is_package]
    packages = [one for one in inside if one.is_package]
    rows = [f":doc:`{one.name}`" for one in packages] + [f":mod:`~{one.name}`" for one in modules]
    if rows:
        parts.append(_list(zip(rows, [*packages, *modules], strict=True)))
    if packages:
        parts.append(_toctree("", [one.name for one in packages]))
    parts.append(_members(top))
    for module in modules:
        parts.append(_title(module.name.rpartition(".")[2], "-"))
        parts.append(f".. automodule:: {module.name}\n   :no-members:\n")
        parts.append(_members(module))
    return "\n".join(parts)


def _members(module: Module) -> str:
    parts = [f".. currentmodule:: {module.name}\n"]
    kinds = {"class": module.classes, "function": module.functions, "constant": module.constants}
    for kind, names in kinds.items():
        for name in names:
            words = module.constants.get(name, "")
            parts.append(_directive(kind, f"{module.name}.{name}", words))
    return "\n".join(parts)


def _directive(kind: str, name: str, words: str = "") -> str:
    module, _, constant = name.rpartition(".")
    value = getattr(importlib.import_module(module), constant)
    if kind == "class":
        bases = "   :show-inheritance:\n" if public_bases(value) else ""
        return f".. autoclass:: {name}\n   :members:\n{bases}"
    if kind == "function":
        return f".. autofunction:: {name}\n"
    if isinstance(value, GenericAlias | UnionType) or get_origin(value) is not None:
        return f".. py:data:: {constant}\n\n   {words}\n"  # the name of a type
    short = isinstance(value, bool | int | float | str) and len(repr(value)) < 60
    return f".. autodata:: {name}\n" + ("" if short else "   :no-value:\n")


def public_bases(value: type) -> list[type]:
    """Bases of a class that have a place in the reference."""
    return [
        base
        for base in value.__bases__
        if base.__module__.startswith("airlight.") and not base.__name__.startswith("_")
    ]


def _row(name: str) -> str:
    words = (_public_object(name)[0].__doc__ or "").splitlines()[0]
    return f"   * - :doc:`{name}`\n     - {words}\n"


def _list(rows: Any) -> str:
    body = "".join(f"   * - {link}\n     - {module.sentence}\n" for link, module in rows)
    return f".. list-table::\n   :widths: 35 65\n\n{body}"


def _toctree(caption: str, entries: list[str]) -> str:
    head = ".. toctree::\n   :hidden:\n" + (f"   :caption: {caption}\n" if caption else "")
    return head + "\n" + "".join(f"   {entry}\n" for entry in entries)


def _home(name: str, package: str, found: list[Module]) -> str:
    """Where a name that a package exports is documented."""
    value = getattr(importlib.import_module(package), name)
    homes = [one.name for one in found if name in one.names and one.name.startswith(package)]
    return f"{getattr(value, '__module__', None) or homes[0]}.{name}"


def _index(public: list[str], tops: list[Module]) -> str:
    parts = [_title("API", "="), HEAD]
    for heading, names in STATIONS:
        parts.append(_title(heading, "-"))
        rows = [_row(name) for name in names if name in public]
        parts.append(f".. list-table::\n   :widths: 30 70\n\n{''.join(rows)}")
    forgotten = set(public) - {name for _, names in STATIONS for name in names}
    if forgotten:
        raise ValueError(f"docs/_site/api_pages.py: no station for {', '.join(sorted(forgotten))}")
    tops = [one for one in tops if one.name.count(".") == 1]
    parts.append(_title("Packages", "-"))
    parts.append(_list((f":doc:`{one.name}`", one) for one in tops))
    parts.append(_toctree("Names of airlight", public))
    parts.append(_toctree("Packages", [one.name for one in tops]))
    return "\n".join(parts)
