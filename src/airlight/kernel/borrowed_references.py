"""Functions that only borrow arrays, and are compiled without reference counts.

Numba counts a reference to every array of a bundle at each use of the bundle: a third of the code
of a kernel. The caller of a function holds what it passes, so a function that neither makes arrays
nor returns any needs no count.
"""

from __future__ import annotations

from typing import Any, Final

from numba.core import ir, types

from airlight.kernel.lanes import lane_view
from airlight.kernel.tuple_item import tuple_item
from airlight.kernel.without_refcount import without_refcount

#: Expressions that take an array out of what is held already.
_BORROWING: Final = frozenset(
    {"getattr", "static_getitem", "build_tuple", "exhaust_iter", "cast", "phi"}
)


def only_borrows(state: Any) -> bool:
    """Whether a function whose types are known makes and returns no arrays, lists or strings.

    Parameters
    ----------
    state : numba.core.compiler.StateDict
        State of the compilation after type inference.
    """
    models, kinds = state.targetctx.data_model_manager, state.typemap

    def holds(kind: Any) -> bool:
        return bool(models[kind].contains_nrt_meminfo())

    def borrows(made: ir.Expr) -> bool:
        if made.op == "call":
            return _lends(kinds[made.func.name])
        if made.op == "getitem":  # an index that is an array makes an array
            return not holds(kinds[made.index.name])
        return made.op in _BORROWING

    if holds(state.return_type) or state.func_id.is_generator:
        return False
    for block in state.func_ir.blocks.values():
        for one in block.body:
            if isinstance(one, (ir.DynamicRaise, ir.DynamicTryRaise)):
                return False
            if isinstance(one, (ir.SetItem, ir.StaticSetItem)) and holds(kinds[one.value.name]):
                return False  # the error of a wrong shape makes a string
            makes = isinstance(one, ir.Assign) and isinstance(one.value, ir.Expr)
            if makes and holds(kinds[one.target.name]) and not borrows(one.value):
                return False
    return True


def _lends(function: Any) -> bool:
    """Whether a function of this type returns only what it is given."""
    if isinstance(function, types.NamedTupleClass):
        return True
    return getattr(function, "typing_key", None) in (lane_view, tuple_item, without_refcount)
