"""SIMD lanes: a value type of eight wavelengths for compiled loops.

Compilers do not vectorise loops over so few wavelengths (16 ns per path node in scalar code, 3 ns
in lanes). ``lane_view`` is an array of lanes over a float32 array with wavelengths on its last
axis; ``+ - * /``, ``np.floor`` and ``abs`` are lane-wise; the former also with a scalar.
"""

from __future__ import annotations

import operator
from collections.abc import Callable
from math import factorial, log
from typing import Any, ClassVar, Final

import numpy as np
from llvmlite import ir
from numba import njit, types
from numba.core import cgutils
from numba.core.imputils import impl_ret_borrowed
from numba.core.typing import signature
from numba.core.typing.templates import ConcreteTemplate, infer_global
from numba.extending import intrinsic, lower_builtin, models, overload, register_model
from numba.np.arrayobj import populate_array

#: Number of wavelengths in one value.
LANES: Final = 8
#: Number of wavelengths so few that either half of the lanes has all of them.
HALF_LANES: Final = LANES // 2
#: 1/π in float32: a plain literal would turn a product of single precision into double.
INVERSE_PI: Final = np.float32(0.3183098861837907)

_VECTOR = ir.VectorType(ir.FloatType(), LANES)
_INTEGERS = ir.VectorType(ir.IntType(32), LANES)
_FLAGS = ("contract", "reassoc", "nsz", "arcp", "afn")


class LanesType(types.Type):
    """Numba type of eight float32 in a vector register."""

    def __init__(self) -> None:
        super().__init__(name=f"float32x{LANES}")


_LANES = LanesType()
_NUMBERS = (types.float32, types.float64, types.int64)


@register_model(LanesType)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, front_end_type: Any) -> None:
        super().__init__(manager, front_end_type, _VECTOR)


def _splat(builder: Any, scalar: Any) -> Any:
    first = builder.insert_element(
        ir.Constant(_VECTOR, ir.Undefined), scalar, ir.Constant(ir.IntType(32), 0)
    )
    return builder.shuffle_vector(
        first, ir.Constant(_VECTOR, ir.Undefined), ir.Constant(_INTEGERS, [0] * LANES)
    )


def _as_vector(context: Any, builder: Any, value: Any, kind: Any) -> Any:
    if isinstance(kind, LanesType):
        return value
    return _splat(builder, context.cast(builder, value, kind, types.float32))


def _declare_operator(symbol: Callable[..., Any], instruction: str) -> None:
    """Declare an operator to Numba: of two lanes, and of lanes and a scalar in either order."""
    pairs = [(_LANES, _LANES)]
    pairs += [(_LANES, number) for number in _NUMBERS] + [(number, _LANES) for number in _NUMBERS]

    @infer_global(symbol)
    class _Operator(ConcreteTemplate):
        cases: ClassVar = [signature(_LANES, left, right) for left, right in pairs]

    def build(context: Any, builder: Any, types_: Any, arguments: Any) -> Any:
        left, right = (
            _as_vector(context, builder, value, kind)
            for value, kind in zip(arguments, types_.args, strict=True)
        )
        return getattr(builder, instruction)(left, right, flags=_FLAGS)

    for left, right in pairs:
        lower_builtin(symbol, left, right)(build)


_declare_operator(operator.add, "fadd")
_declare_operator(operator.sub, "fsub")
_declare_operator(operator.mul, "fmul")
_declare_operator(operator.truediv, "fdiv")
_declare_operator(operator.iadd, "fadd")
_declare_operator(operator.isub, "fsub")
_declare_operator(operator.imul, "fmul")


def _address(context: Any, builder: Any, array_type: Any, array: Any, index: Any) -> Any:
    data = context.make_array(array_type)(context, builder, value=array).data
    return builder.bitcast(builder.gep(data, [index]), _VECTOR.as_pointer())


@intrinsic
def lane_view(typing_context: Any, array: Any, at: Any = None) -> Any:
    """View of a contiguous float32 array (..., w) as an array (...) of lanes.

    ``view[i, j]`` is ``array[i, j, at : at + LANES]``, to read or to assign. Without ``at``, w is
    ``LANES``. Indices are not checked. In a shader the view is the array itself.
    """
    if not (isinstance(array, types.Array) and array.layout == "C" and array.ndim > 1):
        return None
    kind = types.Array(_LANES, array.ndim - 1, "A", readonly=not array.mutable, aligned=False)

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        given = context.make_array(array)(context, builder, value=arguments[0])
        *shape, width = cgutils.unpack_tuple(builder, given.shape)
        data = given.data
        if at is None:
            width = context.get_constant(types.intp, LANES)
        else:
            first = context.cast(builder, arguments[1], signature.args[1], types.intp)
            data = builder.gep(data, [first])
        step = builder.mul(width, context.get_constant(types.intp, 4))
        steps = [step]
        for length in reversed(shape[1:]):
            step = builder.mul(step, length)
            steps.insert(0, step)
        view = context.make_array(kind)(context, builder)
        populate_array(
            view,
            data=builder.bitcast(data, view.data.type),
            shape=shape,
            strides=steps,
            itemsize=context.get_constant(types.intp, 4 * LANES),
            meminfo=given.meminfo,
            parent=given.parent,
        )
        return impl_ret_borrowed(context, builder, kind, view._getvalue())

    return kind(array, types.Omitted(None) if at is None else at), build


@intrinsic
def load(typing_context: Any, array: Any, index: Any) -> Any:
    """Eight adjacent elements of a flat float32 array, from ``index`` on (not checked).

    A scalar is returned unchanged, so that code for lanes also runs at one wavelength.
    """
    if isinstance(array, types.Float):
        return array(array, index), lambda context, builder, signature, arguments: arguments[0]

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        index = context.cast(builder, arguments[1], signature.args[1], types.intp)
        return builder.load(
            _address(context, builder, signature.args[0], arguments[0], index), align=4
        )

    return _LANES(array, index), build


@intrinsic
def store(typing_context: Any, array: Any, index: Any, value: Any) -> Any:
    """Store eight adjacent elements of a flat float32 array (``index`` is not checked)."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        index = context.cast(builder, arguments[1], signature.args[1], types.intp)
        vector = _as_vector(context, builder, arguments[2], signature.args[2])
        builder.store(
            vector,
            _address(context, builder, signature.args[0], arguments[0], index),
            align=4,
        )
        return context.get_dummy_value()

    return types.void(array, index, value), build


@intrinsic
def splat(typing_context: Any, value: Any) -> Any:
    """Broadcast of a number to all eight lanes."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _as_vector(context, builder, arguments[0], signature.args[0])

    return _LANES(value), build


def _call(builder: Any, name: str, *arguments: Any) -> Any:
    kind = ir.FunctionType(_VECTOR, [_VECTOR] * len(arguments))
    function = cgutils.get_or_insert_function(builder.module, kind, f"llvm.{name}.v{LANES}f32")
    return builder.call(function, arguments)


def _pair(operation: str, doc: str) -> Callable[..., Any]:
    def choose(typing_context: Any, a: Any, b: Any) -> Any:
        def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
            left, right = (
                _as_vector(context, builder, value, kind)
                for value, kind in zip(arguments, signature.args, strict=True)
            )
            return _call(builder, operation, left, right)

        return _LANES(a, b), build

    choose.__doc__ = doc
    return intrinsic(choose)  # type: ignore[no-any-return]


maximum = _pair("maxnum", "The larger of two values, lane by lane; the number where one is NaN.")
minimum = _pair("minnum", "The smaller of two values, lane by lane; the number where one is NaN.")


@intrinsic
def fourth_root(typing_context: Any, value: Any) -> Any:
    """Fourth root of each lane; 0 below 0."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        zero = ir.Constant(_VECTOR, [0.0] * LANES)
        positive = _call(builder, "maxnum", arguments[0], zero)
        return _call(builder, "sqrt", _call(builder, "sqrt", positive))

    return _LANES(value), build


@intrinsic
def square_root(typing_context: Any, value: Any) -> Any:
    """Square root of each lane."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _call(builder, "sqrt", arguments[0])

    return _LANES(value), build


@intrinsic
def floored(typing_context: Any, value: Any) -> Any:
    """Floor of each lane."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _call(builder, "floor", arguments[0])

    return _LANES(value), build


@overload(np.floor, strict=False)
def _floor(value: Any) -> Any:
    return (lambda value: floored(value)) if isinstance(value, LanesType) else None


@overload(abs, strict=False)
def _absolute(value: Any) -> Any:
    return (lambda value: maximum(value, -1.0 * value)) if isinstance(value, LanesType) else None


@intrinsic
def looked_up(typing_context: Any, table: Any, index: Any) -> Any:
    """Gather of a flat float32 array at the integers in the lanes (not checked)."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = context.make_array(signature.args[0])(context, builder, value=arguments[0]).data
        which = builder.fptosi(arguments[1], _INTEGERS)
        found = ir.Constant(_VECTOR, ir.Undefined)
        for lane in range(LANES):
            place = ir.Constant(ir.IntType(32), lane)
            at = builder.sext(builder.extract_element(which, place), ir.IntType(64))
            found = builder.insert_element(found, builder.load(builder.gep(data, [at])), place)
        return found

    return _LANES(table, index), build


@intrinsic
def where_positive(typing_context: Any, sign: Any, first: Any, second: Any) -> Any:
    """Lanes of ``first`` where ``sign`` is positive, else of ``second``."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        zero = ir.Constant(_VECTOR, [0.0] * LANES)
        return builder.select(builder.fcmp_ordered(">", arguments[0], zero), *arguments[1:])

    return _LANES(_LANES, _LANES, _LANES), build


@intrinsic
def any_negative(typing_context: Any, value: Any) -> Any:
    """Whether a lane is below 0."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        zero = ir.Constant(_VECTOR, [0.0] * LANES)
        signs = builder.bitcast(builder.fcmp_ordered("<", arguments[0], zero), ir.IntType(LANES))
        return builder.icmp_unsigned("!=", signs, ir.Constant(ir.IntType(LANES), 0))

    return types.boolean(_LANES), build


@intrinsic
def load_two(typing_context: Any, array: Any, low: Any, high: Any) -> Any:
    """Four adjacent elements from ``low`` on, and four from ``high`` on (not checked)."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        data = context.make_array(signature.args[0])(context, builder, value=arguments[0]).data
        half = ir.VectorType(ir.FloatType(), HALF_LANES)
        parts = []
        for index, kind in zip(arguments[1:], signature.args[1:], strict=True):
            at = context.cast(builder, index, kind, types.intp)
            address = builder.bitcast(builder.gep(data, [at]), half.as_pointer())
            parts.append(builder.load(address, align=4))
        return builder.shuffle_vector(*parts, ir.Constant(_INTEGERS, list(range(LANES))))

    return _LANES(array, low, high), build


@intrinsic
def load_half(typing_context: Any, array: Any, index: Any) -> Any:
    """Four adjacent elements from ``index`` on, in both halves (not checked)."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        index = context.cast(builder, arguments[1], signature.args[1], types.intp)
        part = builder.load(_half(context, builder, signature, arguments, index), align=4)
        order = [*range(HALF_LANES), *range(HALF_LANES)]
        return builder.shuffle_vector(part, part, ir.Constant(_INTEGERS, order))

    return _LANES(array, index), build


@intrinsic
def store_half(typing_context: Any, array: Any, index: Any, value: Any) -> Any:
    """Store the lower four lanes from ``index`` on (not checked)."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        index = context.cast(builder, arguments[1], signature.args[1], types.intp)
        order = ir.Constant(ir.VectorType(ir.IntType(32), HALF_LANES), list(range(HALF_LANES)))
        part = builder.shuffle_vector(arguments[2], arguments[2], order)
        builder.store(part, _half(context, builder, signature, arguments, index), align=4)
        return context.get_dummy_value()

    return types.void(array, index, _LANES), build


def _half(context: Any, builder: Any, signature: Any, arguments: Any, index: Any) -> Any:
    data = context.make_array(signature.args[0])(context, builder, value=arguments[0]).data
    half = ir.VectorType(ir.FloatType(), HALF_LANES)
    return builder.bitcast(builder.gep(data, [index]), half.as_pointer())


@intrinsic
def largest(typing_context: Any, value: Any) -> Any:
    """Maximum of the lanes."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = ir.FunctionType(ir.FloatType(), [_VECTOR])
        name = f"llvm.vector.reduce.fmax.v{LANES}f32"
        function = cgutils.get_or_insert_function(builder.module, kind, name)
        return builder.call(function, arguments)

    return types.float32(value), build


@intrinsic
def lane_sum(typing_context: Any, value: Any) -> Any:
    """Sum of the lanes."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        kind = ir.FunctionType(ir.FloatType(), [ir.FloatType(), _VECTOR])
        name = f"llvm.vector.reduce.fadd.v{LANES}f32"
        function = cgutils.get_or_insert_function(builder.module, kind, name)
        start = ir.Constant(ir.FloatType(), 0.0)
        return builder.call(function, [start, *arguments], fastmath=_FLAGS)

    return types.float32(value), build


@intrinsic
def pair(typing_context: Any, low: Any, high: Any) -> Any:
    """Lower four lanes of one value or number, upper four of another."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        left, right = (
            _as_vector(context, builder, value, kind)
            for value, kind in zip(arguments, signature.args, strict=True)
        )
        half = LANES // 2
        order = [*range(half), *range(LANES + half, 2 * LANES)]
        return builder.shuffle_vector(left, right, ir.Constant(_INTEGERS, order))

    return _LANES(low, high), build


@intrinsic
def folded(typing_context: Any, value: Any) -> Any:
    """Sum of the lower and the upper four lanes, in both."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        half = LANES // 2
        order = [*range(half, LANES), *range(half)]
        other = builder.shuffle_vector(
            arguments[0], ir.Constant(_VECTOR, ir.Undefined), ir.Constant(_INTEGERS, order)
        )
        return builder.fadd(arguments[0], other)

    return _LANES(value), build


#: Taylor coefficients of 2^x about 0, for |x| <= 1/2: the first omitted term is below 2e-7.
_EXP2 = tuple(log(2.0) ** k / factorial(k) for k in range(7))


@intrinsic
def exponential(typing_context: Any, value: Any) -> Any:
    """Exponential of each lane, relative error 3e-7; 0 below -87, no overflow above 88."""

    def build(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        def constant(x: float) -> Any:
            return ir.Constant(_VECTOR, [x] * LANES)

        x = _call(builder, "maxnum", arguments[0], constant(-87.0))
        x = _call(builder, "minnum", x, constant(88.0))
        exponent = builder.fmul(x, constant(1.4426950408889634))
        whole = _call(builder, "rint", exponent)
        # The fraction from x itself, with ln 2 in two parts, keeps the digits lost by x·log2(e).
        rest = builder.fsub(x, builder.fmul(whole, constant(0.693359375)))
        rest = builder.fsub(rest, builder.fmul(whole, constant(-2.12194440e-4)))
        fraction = builder.fmul(rest, constant(1.4426950408889634))
        result = constant(_EXP2[-1])
        for coefficient in reversed(_EXP2[:-1]):
            result = builder.fadd(
                builder.fmul(result, fraction, flags=("contract",)),
                constant(coefficient),
                flags=("contract",),
            )
        biased = builder.add(
            builder.fptosi(whole, _INTEGERS), ir.Constant(_INTEGERS, [127] * LANES)
        )
        scale = builder.bitcast(builder.shl(biased, ir.Constant(_INTEGERS, [23] * LANES)), _VECTOR)
        tiny = builder.fcmp_ordered("<=", arguments[0], constant(-87.0))
        return builder.select(tiny, constant(0.0), builder.fmul(result, scale))

    return _LANES(value), build


@njit(nogil=True)
def lane_array(count: int) -> Any:
    """Workspace of ``count`` values of eight lanes, shape (count, 8)."""
    return np.empty((count, LANES), np.float32)
