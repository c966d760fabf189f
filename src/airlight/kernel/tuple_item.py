"""Items of tuples by a variable index in a compiled loop.

Numba copies the whole item to memory: half the time of a march through two cloud fields. Here each
number of the item is selected, and those that are not used cost nothing.
"""

from __future__ import annotations

from typing import Any

from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic


@intrinsic
def tuple_item(typing_context: Any, values: Any, index: Any) -> Any:
    """Item of a tuple of items of one type; the last one beyond its end.

    Parameters
    ----------
    values : tuple
        Tuple without reference counts, see ``without_refcount``.
    index : int
        Index of the item.
    """
    if not isinstance(values, types.UniTuple) or not isinstance(index, types.Integer):
        return None

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        items, number = arguments
        item = builder.extract_value(items, values.count - 1)
        for other in range(values.count - 1):
            chosen = builder.icmp_signed("==", number, ir.Constant(number.type, other))
            item = _selected(builder, chosen, builder.extract_value(items, other), item)
        return item

    return values.dtype(values, index), build


def _selected(builder: Any, chosen: Any, one: Any, other: Any) -> Any:
    """One value or the other, number by number."""
    if not isinstance(one.type, (ir.LiteralStructType, ir.ArrayType)):
        return builder.select(chosen, one, other)
    found = cgutils.get_null_value(one.type)
    for number in range(
        len(one.type.elements) if hasattr(one.type, "elements") else one.type.count
    ):
        parts = (builder.extract_value(value, number) for value in (one, other))
        found = builder.insert_value(found, _selected(builder, chosen, *parts), number)
    return found
