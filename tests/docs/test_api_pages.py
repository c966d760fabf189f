"""Every public name of the package has a place in the reference of the code."""

from __future__ import annotations

import importlib
import inspect
import pkgutil
import re
from collections import Counter
from collections.abc import Iterator
from pathlib import Path

import api_pages
import pytest

import airlight

PACKAGE = Path(airlight.__file__).parent
#: Commands have a page of their own.
_LEFT_OUT = "airlight.cli"


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """The pages of the reference by their names, as the site is built from them."""
    folder = tmp_path_factory.mktemp("api")
    api_pages.write(folder, PACKAGE)
    return {page.stem: page.read_text(encoding="utf-8") for page in folder.iterdir()}


def _directives(page: str) -> list[str]:
    """Names that a page describes and that links lead to."""
    found = re.findall(r"^\.\. auto\w+:: (\S+)\n((?: {3}:.*\n)*)", page, re.MULTILINE)
    return [name for name, options in found if ":no-index:" not in options]


def _public() -> Iterator[str]:
    """Functions and classes that modules define, found by importing them."""
    for found in pkgutil.walk_packages([str(PACKAGE)], "airlight."):
        if found.name.startswith(_LEFT_OUT) or "._" in found.name:
            continue
        module = importlib.import_module(found.name)
        for name, value in vars(module).items():
            function = getattr(value, "py_func", value)  # of a compiled kernel
            if not (inspect.isfunction(function) or inspect.isclass(function)):
                continue
            if function.__module__ == module.__name__ and not name.startswith("_"):
                yield f"{module.__name__}.{name}"


def test_every_name_of_airlight_has_a_page_of_its_own(pages: dict[str, str]) -> None:
    # `__all__` is what the package promises
    names = [name for name in airlight.__all__ if not name.startswith("__")]
    described = [rf"^\.\. auto(class|function):: airlight\.(\w+\.)*{name}$" for name in names]
    missing = [
        name
        for name, directive in zip(names, described, strict=True)
        if not re.search(directive, pages.get(name, ""), re.MULTILINE)
    ]
    assert missing == []


@pytest.mark.parametrize("name", [name for name in airlight.__all__ if name != "__version__"])
def test_every_name_of_airlight_has_an_example(name: str) -> None:
    # each is a doctest, so that it is run
    value = getattr(airlight, name)
    value = getattr(value, name) if inspect.ismodule(value) else value  # render is both
    assert ">>> " in (value.__doc__ or "")


def test_every_public_function_and_class_is_documented_once(pages: dict[str, str]) -> None:
    # the pages are made from the source's text, this list from the imported modules
    counts = Counter(name for page in pages.values() for name in _directives(page))
    assert [name for name in _public() if counts[name] != 1] == []
