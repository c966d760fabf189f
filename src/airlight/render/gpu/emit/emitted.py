"""``Emitted``: function of a shader and its arguments."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from airlight.render.gpu.emit.dialect import Dialect, Named
from airlight.render.gpu.emit.shader_types import (
    LocalArray,
    Scalar,
    ShaderTable,
    StructValue,
    TupleType,
    Value,
    run_time,
)


@dataclass
class Emitted:
    """Emitted function.

    Attributes
    ----------
    name : str
        Name in the shader.
    function : callable
        Python function.
    parameters : tuple of (str, Value)
        All parameters, including those bound to constants.
    result : Scalar, TupleType or None
        Type of the result; None if the function only fills arrays.
    text : str
        Source in the target language.
    arrays : set of str
        Array fields of struct values in use, by parameter name; only these are passed.
    """

    name: str
    function: Callable[..., Any]
    parameters: tuple[tuple[str, Value], ...]
    result: Scalar | TupleType | None = None
    text: str = ""
    arrays: set[str] = field(default_factory=set)

    def argument_lists(self, dialect: Dialect) -> list[list[Named]]:
        """Run-time arguments of each parameter: names and types.

        Parameters
        ----------
        dialect : Dialect
            Target language.
        """
        handed: list[list[Named]] = []
        for name, value in self.parameters:
            several: list[Named] = []
            if isinstance(value, StructValue):
                for one, kind in value.fields.items():
                    array = f"{name}_{one}"
                    if isinstance(kind, LocalArray) and array in self.arrays:
                        several += [(array, kind)] if dialect.at_run_time(kind) else []
            elif dialect.at_run_time(value):
                several.append((name, value if isinstance(value, ShaderTable) else run_time(value)))
            handed.append(several)
        return handed
