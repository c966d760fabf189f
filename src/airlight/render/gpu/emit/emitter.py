"""Emitter of Numba kernels to shading languages and JavaScript.

A kernel is specialised for its argument types; tables, constants and NamedTuples are bound at
emission. The Python subset: numbers, ``+ - * / // % **``, comparisons, ``and or not``, ``x if c
else y``, ``if``, ``for … in range(…)``, ``while``, tuples as results, NamedTuples of numbers (of
which ``Vec3`` is a vector of the language), ``math``, other kernels,
tables (``table[i, j]``, ``table.shape[0]``), arrays (``np.empty(CONSTANT)``, ``lane_array``), and
``lane_view`` and the lanes of ``airlight.kernel.lanes``, which are four wavelengths here. Anything
else raises an error with file and line.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import cache
from typing import Any, Final

from airlight.kernel.shader_fields import shader_fields
from airlight.render.gpu.emit import single_precision
from airlight.render.gpu.emit.dialect import Dialect, ShaderDialect
from airlight.render.gpu.emit.emitted import Emitted
from airlight.render.gpu.emit.lane_views import LaneViews
from airlight.render.gpu.emit.scope import SubsetError
from airlight.render.gpu.emit.shader_types import (
    SCALARS,
    VEC3,
    LocalArray,
    Scalar,
    ShaderTable,
    TupleType,
    UniformValue,
    Value,
)
from airlight.render.gpu.emit.statements import FunctionBody
from airlight.render.gpu.emit.wgsl import WGSL

__all__ = ["Emitted", "Emitter", "SubsetError"]

#: Functions whose names are reserved.
_OWN: Final = frozenset(vars(single_precision))


@dataclass
class Emitter:
    """Emitter of kernels to one shader or module of the target language.

    Examples
    --------
    >>> from airlight.geometry.shell import radius_along
    >>> from airlight.render.gpu.emit.shader_types import F32
    >>> emitter = Emitter()
    >>> emitter.add(radius_along, F32, F32, F32).name
    'radius_along'
    >>> print(emitter.functions_text())
    fn radius_along(r: f32, mu: f32, distance_1: f32) -> f32 {
      return sqrt(max(((distance_1 * (distance_1 + ((2.0 * r) * mu))) + (r * r)), 0.0));
    }
    """

    dialect: Dialect = WGSL
    emitted: dict[tuple[Any, ...], Emitted] = field(default_factory=dict)
    arrays: dict[str, LocalArray] = field(default_factory=dict)
    tuples: dict[str, TupleType] = field(default_factory=dict)
    taken: set[str] = field(default_factory=set)
    _in_progress: set[Any] = field(default_factory=set)

    def add(self, function: Callable[..., Any], *arguments: Value, name: str = "") -> Emitted:
        """Emit a function for these argument types, with all its callees.

        Parameters
        ----------
        function : kernel or inlined function
            Kernel, or plain Python function.
        *arguments : Value
            Type or value of each parameter.
        name : str
            Name in the shader; by default that of the function, numbered for further types.

        Returns
        -------
        Emitted
            Emitted function, cached by argument types.
        """
        plain = getattr(function, "py_func", function)
        if isinstance(self.dialect, ShaderDialect):
            plain = getattr(plain, "in_shaders", plain)
        parameters = plain.__code__.co_varnames[: plain.__code__.co_argcount]
        if len(parameters) != len(arguments):
            raise SubsetError(
                f"{plain.__module__}.{plain.__name__}: {len(arguments)} arguments for "
                f"{len(parameters)} parameters"
            )
        bound = tuple(
            _lower_argument(one, parameter, self.dialect)
            for one, parameter in zip(arguments, parameters, strict=True)
        )
        key = (plain, bound)
        if key in self.emitted:
            return self.emitted[key]
        if plain in self._in_progress:
            raise SubsetError(f"{plain.__module__}.{plain.__name__}: recursion is not supported")
        self._in_progress.add(plain)
        tree = _syntax_tree(plain)
        wanted = name or plain.__name__.strip("_")
        if wanted.startswith(("read_", "size_")):  # so are the functions of tables
            wanted = f"{wanted}_here"
        name, copy = wanted, 2
        while name in self.taken or (name in self.dialect.reserved and name not in _OWN):
            name, copy = f"{wanted}_{copy}", copy + 1
        self.taken.add(name)
        made = Emitted(name, plain, tuple(zip(parameters, bound, strict=True)))
        FunctionBody(self, made, tree).write()
        self._in_progress.discard(plain)
        self.emitted[key] = made
        return made

    def tuple_type(self, items: Sequence[Scalar | TupleType]) -> TupleType:
        """Struct that represents a tuple.

        Parameters
        ----------
        items : sequence of Scalar or TupleType
            Types of the members.
        """
        several = TupleType(tuple(items))
        return self.tuples.setdefault(several.name, several)

    def record_type(self, kind: Any) -> TupleType:
        """Struct that represents a NamedTuple of numbers and of NamedTuples of such."""
        items = tuple(
            self.record_type(one.kind) if one.is_group else SCALARS[one.kind]
            for one in shader_fields(kind)
        )
        record = TupleType(items, kind.__name__, kind._fields)
        return record if record == VEC3 else self.tuples.setdefault(record.name, record)

    def module_array(self, name: str, kind: LocalArray) -> LocalArray:
        """Array declared at module scope in languages that require it; otherwise unchanged.

        Parameters
        ----------
        name : str
            Name of the variable.
        """
        if not self.dialect.module_arrays:
            return kind
        self.taken.add(name)
        return self.arrays.setdefault(name, replace(kind, variable=name))

    def functions_text(self) -> str:
        """Structs, module arrays and functions, callees first."""
        structs = [self.dialect.struct(several) for several in self.tuples.values()]
        arrays = [f"{self.dialect.in_module(*one)}\n" for one in self.arrays.items()]
        functions = "\n".join(one.text for one in self.emitted.values())
        return "".join([*structs, *arrays]) + functions

    def module(self) -> str:
        """Complete module: integer functions, then emitted functions."""
        before = self.dialect.integer_functions if isinstance(self.dialect, ShaderDialect) else ""
        return before + self.functions_text()


@cache
def _syntax_tree(function: Callable[..., Any]) -> ast.FunctionDef:
    """Syntax tree of a function, cached for all shaders and languages.

    Generated functions carry their source (``kernel.choice``).
    """
    text = getattr(function, "source_text", None) or inspect.getsource(function)
    tree = ast.parse(textwrap.dedent(text)).body[0]
    assert isinstance(tree, ast.FunctionDef)
    LaneViews(function.__globals__).visit(tree)
    return tree


def _lower_argument(value: Value, parameter: str, dialect: Dialect) -> Value:
    """Argument as a parameter of the callee; uniforms become scalars."""
    if isinstance(value, ShaderTable) and dialect.at_run_time(value):
        return replace(value, name=parameter)
    return value.scalar if isinstance(value, UniformValue) else value
