"""From restricted Python to WGSL: the same functions that the CPU compiles, for the GPU.

A function is emitted for the types that it is called with, as a compiler would do it: tables,
constants and NamedTuples are bound when the shader is written and take no part at run time. The
subset: numbers, ``+ - * / // % **``, comparisons, ``and or not``, ``x if c else y``, ``if``,
``for … in range(…)``, ``while``, tuples as results, ``math``, other kernels, tables
(``table[i, j]``, ``table.shape[0]``), rooms (``np.empty(CONSTANT)``, ``room_of_lanes``) and the
lanes of ``airlight.kernel.lanes``, which are four wavelengths here. Anything else is refused with
file and line.
"""

from __future__ import annotations

import ast
import inspect
import textwrap
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Final

from airlight.gpu.device.fragment_pass import wgsl
from airlight.gpu.emit.scope import SubsetError
from airlight.gpu.emit.shader_types import Scalar, Several, Uniform, Value
from airlight.gpu.emit.statements import Emitted, FunctionBody

__all__ = ["Emitted", "Emitter", "SubsetError"]

#: Quotients of whole numbers that are rounded down, as Python's are; WGSL's go towards 0.
#: Angles and their functions, good to 1e-7 and 3e-7: WGSL's own sine may err by 5e-4, its arc
#: tangent by 4096 units of the last place; a driver in use errs by 4e-4 in asin. The polynomials
#: of sine, cosine and arc tangent are those of Moshier's Cephes library in single precision.
PRELUDE: Final = wgsl("prelude")


@dataclass
class Emitter:
    """Collects the functions of one shader.

    Examples
    --------
    >>> from airlight.geometry.shell import radius_along
    >>> from airlight.gpu.emit.shader_types import F32
    >>> emitter = Emitter()
    >>> emitter.add(radius_along, F32, F32, F32).name
    'radius_along'
    >>> print(emitter.functions_text())
    fn radius_along(r: f32, mu: f32, distance_1: f32) -> f32 {
      return sqrt(max(((distance_1 * (distance_1 + ((2.0 * r) * mu))) + (r * r)), 0.0));
    }
    """

    emitted: dict[tuple[Any, ...], Emitted] = field(default_factory=dict)
    tuples: dict[str, Several] = field(default_factory=dict)
    taken: set[str] = field(default_factory=set)
    _in_progress: set[Any] = field(default_factory=set)

    def add(self, function: Callable[..., Any], *arguments: Value, name: str = "") -> Emitted:
        """Emit a function for arguments of these types, and all that it calls.

        Parameters
        ----------
        function : kernel or inlined function
            Or a plain Python function.
        *arguments : Value
            One for each parameter.
        name : str
            In the shader; by default the function's own, numbered where it is emitted for several
            types.

        Returns
        -------
        Emitted
            From the last call with these types, if there was one.

        Raises
        ------
        SubsetError
            With file and line, if the function leaves the subset.
        """
        plain = getattr(function, "py_func", function)
        bound = tuple(_handed_over(one) for one in arguments)
        key = (plain, bound)
        if key in self.emitted:
            return self.emitted[key]
        if plain in self._in_progress:
            raise SubsetError(f"{plain.__module__}.{plain.__name__}: calls itself")
        self._in_progress.add(plain)
        source = inspect.getsource(plain)
        tree = ast.parse(textwrap.dedent(source)).body[0]
        assert isinstance(tree, ast.FunctionDef)
        parameters = [one.arg for one in tree.args.args]
        if len(parameters) != len(bound):
            raise SubsetError(
                f"{plain.__module__}.{plain.__name__}: {len(bound)} arguments for "
                f"{len(parameters)} parameters"
            )
        wanted = name or plain.__name__.strip("_")
        if wanted.startswith(("read_", "size_")):  # so are the functions of tables
            wanted = f"{wanted}_here"
        name, copy = wanted, 2
        while name in self.taken:
            name, copy = f"{wanted}_{copy}", copy + 1
        self.taken.add(name)
        made = Emitted(name, plain, tuple(zip(parameters, bound, strict=True)))
        FunctionBody(self, made, tree).write()
        self._in_progress.discard(plain)
        self.emitted[key] = made
        return made

    def tuple_type(self, items: Sequence[Scalar]) -> Several:
        """The struct that stands for a tuple.

        Parameters
        ----------
        items : sequence of Scalar
            Types of its members.
        """
        several = Several(tuple(items))
        return self.tuples.setdefault(several.name, several)

    def functions_text(self) -> str:
        """Structs and functions, callees first."""
        structs = [
            f"struct {name} {{ "
            + ", ".join(f"v{i}: {item.name}" for i, item in enumerate(several.items))
            + " }\n"
            for name, several in self.tuples.items()
        ]
        return "".join(structs) + "\n".join(one.text for one in self.emitted.values())

    def module(self) -> str:
        """The functions after what all of them may need."""
        return PRELUDE + self.functions_text()


def _handed_over(value: Value) -> Value:
    """How a value arrives in the function called: a uniform as a plain number."""
    return value.scalar if isinstance(value, Uniform) else value
