"""Dispatch of a kernel by number, for registries of kernels."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

from airlight.kernel import kernel


def chosen_kernel(name: str, choices: Sequence[Any], module: str) -> Any:
    """Kernel that calls the kernel of a number, its first argument, with the other arguments.

    Generated as a chain of ``if``, since shaders have no function pointers; a constant number is
    resolved at compilation.

    Parameters
    ----------
    choices : sequence of kernels
        Kernels with equal signatures, numbered from 0. The last is also called for all larger
        numbers.
    module : str
        ``__name__`` of the module with the list, by which compiled code is cached.

    Examples
    --------
    >>> @kernel
    ... def double(x):
    ...     return 2.0 * x
    >>> @kernel
    ... def half(x):
    ...     return 0.5 * x
    >>> chosen_kernel("scaled", [double, half], __name__)(1, 3.0)
    1.5
    """
    code = choices[0].py_func.__code__
    arguments = ", ".join(code.co_varnames[: code.co_argcount])
    calls = [f"choice_{number}({arguments})" for number in range(len(choices))]
    lines = [f"def {name}(which, {arguments}):"]
    for number, call in enumerate(calls[:-1]):
        lines += [f"    if which == {number}:", f"        return {call}"]
    text = "\n".join([*lines, f"    return {calls[-1]}", ""])
    scope: dict[str, Any] = {f"choice_{number}": one for number, one in enumerate(choices)}
    scope["__name__"] = module
    exec(compile(text, sys.modules[module].__file__ or module, "exec"), scope)
    function = scope[name]
    function.source_text = text
    return kernel(function)
