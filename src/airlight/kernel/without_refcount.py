"""Arrays in a compiled loop without reference counts.

Numba counts references by atomic instructions on a counter shared by all threads whenever an array
is taken from a tuple: half the time of a loop over pixels. A loop whose caller holds the arrays
needs none.
"""

from __future__ import annotations

from typing import Any

from numba import types
from numba.core import cgutils
from numba.extending import intrinsic


@intrinsic
def without_refcount(typing_context: Any, value: Any) -> Any:
    """Same array, or tuple of arrays, without an owner: valid only within the call.

    Parameters
    ----------
    value : array, number or tuple of them
        Arrays or numbers to which the caller of the compiled loop holds references.
    """

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _without_owner(context, builder, signature.args[0], arguments[0])

    return value(value), build


def _without_owner(context: Any, builder: Any, kind: Any, value: Any) -> Any:
    if isinstance(kind, types.Array):
        array = context.make_array(kind)(context, builder, value=value)
        array.meminfo = cgutils.get_null_value(array.meminfo.type)
        array.parent = cgutils.get_null_value(array.parent.type)
        return array._getvalue()
    if isinstance(kind, types.BaseTuple):
        for index, part in enumerate(kind.types):
            member = builder.extract_value(value, index)
            member = _without_owner(context, builder, part, member)
            value = builder.insert_value(value, member, index)
    return value
