"""Kernels as the plain functions that they are written as, so that autodoc can read them.

A compiled kernel is an object of Numba's, without a signature. Nothing is computed while the site
is built, so nothing has to be compiled.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import airlight.kernel


def plain(function: Callable[..., Any]) -> Callable[..., Any]:
    """Return the function itself, with the attribute by which others find its source."""
    function.py_func = function  # type: ignore[attr-defined]
    return function


def install() -> None:
    """Replace the decorators of ``airlight.kernel``; call it before anything else is imported."""
    airlight.kernel.kernel = plain
    airlight.kernel.inlined = plain
    airlight.kernel.compiled_loop = plain
