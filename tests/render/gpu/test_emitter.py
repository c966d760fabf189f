"""Restricted Python on the GPU: results of every construct, and errors outside the subset."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.geometry.vectors import Vec3, cross, dot, plus, scaled
from airlight.kernel import kernel
from airlight.kernel.cube_root import cube_root
from airlight.kernel.lanes import (
    LANES,
    exponential,
    fourth_root,
    lane_array,
    lane_view,
    load,
    maximum,
    minimum,
    splat,
)
from airlight.render.gpu.emit.emitter import Emitter, SubsetError
from airlight.render.gpu.emit.glsl import GLSL
from airlight.render.gpu.emit.hlsl import HLSL
from airlight.render.gpu.emit.javascript import JAVASCRIPT
from airlight.render.gpu.emit.shader_types import (
    F32,
    I32,
    VEC3,
    VEC4,
    Constant,
    ConstantFunction,
    LocalArray,
    ShaderTable,
    StructValue,
    UniformValue,
    Value,
)
from airlight.render.gpu.emit.wgsl import WGSL

Run = Callable[..., Any]

EPS = 2.0**-23
_SIZE = 6
_HALF = 0.5
_STEP = np.float64(0.25)
_SWITCH = True

X = np.linspace(-3.0, 3.0, 241)
Y = np.random.default_rng(1).uniform(-2.0, 2.0, X.size)
N = np.arange(X.size) % 17


# --- the subset --------------------------------------------------------------------------------


@kernel
def arithmetic(x, y, n):
    whole = 8 - n
    return x + y - x * y / (2.0 + y * y), n + 2 * n, whole // 3, whole % -5, n / 4, -x + (-n)


@kernel
def powers(x, y, n):
    return x**2, x**3, abs(x) ** 1.5, (1.0 + y * y) ** y, 2.0**x


@kernel
def comparisons(x, y, n):
    return x < y, x <= 0.0, y > n, n >= 4, n == 7, n != 7, 0.0 < x < y


@kernel
def logic(x, y, n):
    near = abs(x) < 1.0
    return near and y > 0.0, near or n > 3, not near, not (near and (y > 0.0 or n == 2))


@kernel
def choices(x, y, n):
    big = x if x > y else y
    return (
        big,
        n if n > 3 else 2.5,
        (1 if x > 0.0 else 2) if y > 0.0 else 3,
        (x > y) if n > 2 else (x < y),
    )


@kernel
def extremes(x, y, n):
    return min(x, y), max(x, y, 0.25), min(n, 5), max(n, x), abs(y), abs(-n)


@kernel
def conversions(x, y, n):
    return int(x), int(-y), float(n), np.float32(x) * 2.0, math.floor(x), float(x > 0.0)


@kernel
def mathematics(x, y, n):
    s = abs(x) + 0.1
    return (
        math.sqrt(s), math.exp(y), math.log(s), math.log2(s), math.sin(x), math.cos(x),
        math.tan(0.4 * x), math.atan2(y, x),
    )  # fmt: skip


@kernel
def inverses(x, y, n):
    c = x / 3.0
    return math.acos(c), math.asin(c), math.atan(x), math.atan2(y, -x), math.pi * c


@kernel
def branches(x, y, n):
    """Docstring, which a shader ignores."""
    pass  # noqa: PIE790 - neither does this
    if x < -1.0:
        z = 1.0
    elif x < 1.0:
        if y > 0.0:
            return 10.0
        z = x
    else:
        z = y
        z -= 2.0 * x
    return z


@kernel
def known_branches(x, y, n):
    if _SWITCH and _SIZE > 4:
        z = x
    else:
        z = no_such_function(y)  # noqa: F821 - never compiled: the condition is known
    return z * _HALF + _STEP


@kernel
def counted(x, y, n):
    up = 0.0
    for i in range(n):
        up += x * i
    odd = 0
    for i in range(1, n, 2):
        odd += i
    down = 0.0
    for i in range(n - 1, -1, -1):
        if i == 9:
            continue
        if i < 3:
            break
        down = 0.5 * down + y
    return up, odd, down


@kernel
def while_larger(x, y, n):
    count = 0
    rest = abs(x) + 4.0
    while rest > 0.0973:
        rest *= 0.5
        count += 1
        if count >= n:
            break
    return rest, count


@kernel
def widened(x, y, n):
    total = 0
    if n > 4:
        total = 0.5
    total = total + n
    return total


@kernel
def parameter_changed(x, y, n):
    x = x + 1.0
    n *= 2
    n = n + y
    return x, n


@kernel
def swapped(x, y, n):
    a, b = x, y
    a, b = b, a
    a, b = b + a, a
    return a, b


@kernel
def two(x, y):
    return x + y, x - y


@kernel
def one_of_two(x, y, n):
    first, _ = two(x, y)
    return two(first, y)


@kernel
def shadowing(x, y, n):
    """Names that are reserved in WGSL, and that of a function."""
    var = x
    let = y
    sample = var + let
    two_1 = 2.0
    return sample * two_1, step(var, let)


@kernel
def step(x, y):
    return x - 2.0 * y


@kernel
def fill_squares(out, x, count):
    for i in range(min(count, out.size)):
        out[i] = x * i
        out[i] += 1.0
    out[0], out[1] = out[1], out[0]


@kernel
def with_a_room(x, y, n):
    room = np.empty(_SIZE)
    for i in range(room.shape[0]):
        room[i] = y
    fill_squares(room, x, n)
    total = 0.0
    for i in range(_SIZE):
        total += room[i] * (i + 1)
    return total, room[0]


@kernel
def answer_not_wanted(x, y, n):
    two(x, y)
    return x


class Segment(NamedTuple):
    start: Vec3
    end: Vec3
    count: int
    closed: bool


@kernel
def turned_round(segment):
    if segment.closed:
        return segment
    return Segment(segment.end, segment.start, segment.count + 1, True)


@kernel
def vectors_and_records(x, y, n):
    segment = turned_round(Segment(Vec3(x, y, 1.0), Vec3(y, float(n), x), n, y > 0.0))
    place = plus(segment.start, scaled(segment.end, 0.25))
    if segment.start.z < 1.0:
        place = cross(place, segment.end)
    a, b, _ = place
    return dot(place, segment.end), a, b, place.z, segment.count, segment.closed


class Terms(NamedTuple):
    first: bool
    second: bool


@kernel
def some_terms(x, y, terms):
    if terms.second:
        return math.erf(y)  # no shader has it: the condition is known
    return x + 1.0 if terms.first else y


@kernel
def known_terms(x, y, n):
    terms = Terms(True, not _SWITCH)
    return some_terms(x, y, terms)


CONSTRUCTS = [
    arithmetic, powers, comparisons, logic, choices, extremes, conversions, mathematics, inverses,
    branches, known_branches, counted, while_larger, widened, parameter_changed, swapped,
    one_of_two, shadowing, with_a_room, answer_not_wanted, vectors_and_records, known_terms,
]  # fmt: skip


@pytest.mark.parametrize("function", CONSTRUCTS, ids=lambda one: one.py_func.__name__)
def test_a_construct_computes_what_python_does(on_gpu: Run, function: Any) -> None:
    # Python itself, in double precision; numbers of order 10 in single precision, about 12 steps,
    # and pow by WGSL's table of accuracy 2^-21 of exponents up to 10.
    x, y = np.float32(X).astype(float), np.float32(Y).astype(float)
    seen = on_gpu(function, x, y, N)
    plain = function.py_func
    wanted = [plain(*row) for row in zip(x.tolist(), y.tolist(), N.tolist(), strict=True)]
    if not isinstance(seen, tuple):
        seen, wanted = (seen,), [(one,) for one in wanted]
    for i, one in enumerate(seen):
        expected = np.array([row[i] for row in wanted])
        if one.dtype == np.float32:
            assert_allclose(one, expected, rtol=64 * EPS, atol=64 * EPS, err_msg=f"result {i}")
        else:
            assert one.dtype.kind == expected.dtype.kind
            assert_array_equal(one, expected, err_msg=f"result {i}")


def some_elements(i, j, table, line):
    return table[i, j + 1] * 2.0 + line[i * 3], table.shape[0] + 10 * table.shape[1], line.size


def test_tables_are_read_by_their_indices(on_gpu: Run) -> None:
    # NumPy's own indexing of integers: exact.
    table = np.arange(20.0).reshape(4, 5)
    line = np.arange(5000.0) ** 2 % 1009.0  # several rows of the texture
    i, j = np.indices((4, 4))
    seen = on_gpu(some_elements, i, j, ShaderTable("table", 2), ShaderTable("line"),
                  tables={"table": table, "line": line})  # fmt: skip
    assert_array_equal(seen[0], table[i, j + 1] * 2.0 + line[i * 3])
    assert_array_equal(seen[1], np.full(i.shape, 54))
    assert_array_equal(seen[2], np.full(i.shape, 5000))
    far = on_gpu(
        far_along, np.array([0, 2047, 2048, 4999]), ShaderTable("line"), tables={"line": line}
    )
    assert_array_equal(far, line[[0, 2047, 2048, 4999]])


def far_along(i, line):
    return line[i]


def three_axes(i, cube):
    return cube[i, 2, i + 1]


def test_the_last_axis_of_a_table_runs_fastest(on_gpu: Run) -> None:
    cube = np.random.default_rng(2).integers(0, 999, (3, 4, 5)).astype(float)
    i = np.arange(3)
    seen = on_gpu(three_axes, i, ShaderTable("cube", 3), tables={"cube": cube})
    assert_array_equal(seen, cube[i, 2, i + 1])


class Grid(NamedTuple):
    bottom: float
    count: int
    line: Any


def in_a_bundle(x, grid):
    bottom, count, line = grid
    return x * grid.bottom + bottom, grid.count + count, line[1] + grid.line[2]


def test_a_bundle_s_fields_are_uniforms_constants_and_tables(on_gpu: Run) -> None:
    # By hand: 4 x + 4, 3 + 3 and the table's entries.
    bundle = StructValue(
        {"bottom": UniformValue("(2.0 * 2.0)"), "count": Constant(3), "line": ShaderTable("line")}
    )
    seen = on_gpu(in_a_bundle, X, bundle, tables={"line": np.array([1.0, 2.0, 4.0])})
    assert_allclose(seen[0], 4.0 * X + 4.0, rtol=0.0, atol=8 * EPS)
    assert_array_equal(seen[1], np.full(X.size, 6))
    assert_array_equal(seen[2], np.full(X.size, 6.0))


def four_wavelengths(i, x, field):
    room = lane_view(lane_array(2))
    seen = lane_view(field, 0)
    room[0] = seen[i // 3, i % 3]
    room[1] = exponential(room[0] * (-x))
    room[1] += splat(x)
    value = maximum(minimum(room[1], splat(2.0)), splat(0.5)) - 1.0
    return 3.0 * value / (room[0] + 1.0)


def four_roots(i, x, field):
    return fourth_root(lane_view(field)[i] - splat(x))


def the_first_element(field):
    return field[0, 0]


def handed_over(x, field):
    return the_first_element(lane_view(field, 0)) * np.float32(x)


def two_arrays(field, other):
    one = lane_view(field)
    value = one[0]
    one = lane_view(other)
    return value + one[0]


def test_lanes_are_four_wavelengths(on_gpu: Run) -> None:
    # The same in NumPy; exponentials of at most 1 in size, roots exact to a few EPS.
    field = np.random.default_rng(3).uniform(0.0, 1.0, (9, 4))
    i, x = np.arange(9), np.linspace(0.0, 1.0, 9)
    spectra, square = {"field": field}, {"field": field.reshape(3, 3, 4)}
    value = np.clip(np.exp(-field * x[:, None]) + x[:, None], 0.5, 2.0) - 1.0
    seen = on_gpu(four_wavelengths, i, x, ShaderTable("field", 2, True), spectra=square)
    assert_allclose(seen, 3.0 * value / (field + 1.0), rtol=0.0, atol=16 * EPS)
    seen = on_gpu(handed_over, x, ShaderTable("field", 2, True), spectra=square)
    assert_allclose(seen, field[0] * x[:, None], rtol=0.0, atol=EPS)
    # A difference rounded by EPS before its fourth root: 2e-2 of it below 1e-6, none lies there.
    seen = on_gpu(four_roots, i, x, ShaderTable("field", 1, True), spectra=spectra)
    assert_allclose(seen, np.maximum(field - x[:, None], 0.0) ** 0.25, rtol=1e-4)


def switched(x, which, exact):
    if exact:
        return x
    if which == 0:
        return 2.0 * x
    return 3.0 * x


def test_constants_are_bound_and_their_other_branches_left_out(on_gpu: Run) -> None:
    # One function for each binding, whose text has only the branch taken.
    emitter = Emitter()
    names = {
        emitter.add(switched, F32, Constant(which), Constant(exact)).name
        for which in (0, 1) for exact in (True, False)
    }  # fmt: skip
    assert len(names) == 4
    assert "if" not in emitter.functions_text()
    for which, factor in ((0, 2.0), (1, 3.0)):
        assert_array_equal(on_gpu(switched, X, Constant(which), Constant(False)),
                           np.float32(factor) * np.float32(X))  # fmt: skip
        assert_array_equal(on_gpu(switched, X, which, False), np.float32(factor) * np.float32(X))


@kernel
def tripled(x):
    return 3.0 * x


@kernel
def increased(x):
    return x + 1.0


@kernel
def applied(function, x):
    return function(function(x))


def test_a_function_as_an_argument_is_called(on_gpu: Run) -> None:
    # One function for each argument, which the shader does not pass.
    emitter = Emitter()
    made = [emitter.add(applied, ConstantFunction(one), F32) for one in (tripled, increased)]
    assert made[0].name != made[1].name
    for one in (tripled, increased):
        assert_allclose(
            on_gpu(applied, ConstantFunction(one), X), [applied(one, x) for x in X], rtol=4 * EPS,
            atol=4 * EPS,
        )  # fmt: skip
    assert applied(tripled, 2.0) == 18.0


def test_shading_languages_have_a_type_of_vectors() -> None:
    texts = {}
    for dialect in (WGSL, GLSL, HLSL, JAVASCRIPT):
        emitter = Emitter(dialect)
        emitter.add(scaled, VEC3, F32)
        texts[dialect.name] = emitter.functions_text()
    product = "(factor * a.x), (factor * a.y), (factor * a.z)"
    assert (
        f"fn scaled(a: vec3f, factor: f32) -> vec3f {{\n  return vec3f({product});" in texts["WGSL"]
    )
    assert f"vec3 scaled(vec3 a, float factor) {{\n  return vec3({product});" in texts[GLSL.name]
    assert f"float3 scaled(float3 a, float factor) {{\n  return float3({product});" in texts["HLSL"]
    assert "return [(factor * a[0]), (factor * a[1]), (factor * a[2])];" in texts["JavaScript"]
    assert all("struct" not in text for text in texts.values())


def one_group(i, field):
    total = splat(0.0)
    for at in range(0, LANES, LANES):
        total = total + lane_view(field, at)[i]
    return total


def test_a_name_stands_for_the_view_of_one_array() -> None:
    # two would need a choice at run time
    with pytest.raises(SubsetError, match="one: is assigned views of several arrays"):
        Emitter().add(two_arrays, ShaderTable("field", 1, True), ShaderTable("other", 1, True))


def test_a_loop_over_groups_of_lanes_is_one_turn(on_gpu: Run) -> None:
    # A device has one group of lanes: the loop is gone from the text, its body is not.
    emitter = Emitter()
    emitter.add(one_group, I32, ShaderTable("field", 1, True))
    assert "for" not in emitter.functions_text()
    field = np.random.default_rng(5).uniform(0.0, 1.0, (9, 4))
    seen = on_gpu(one_group, np.arange(9), ShaderTable("field", 1, True), spectra={"field": field})
    assert_array_equal(seen, field.astype(np.float32))


def halved(x, work):
    work.first[0] = 0.5 * x
    return work.first[0]


def from_arrays(x, work):
    work.second[1] = 2.0 * x
    return halved(x, work) + work.second[1]


def test_the_arrays_of_a_bundle_are_handed_over_where_they_are_used() -> None:
    # By hand: each function has the arrays that it or a function called by it uses, no other.
    sizes = {"first": 1, "second": 2, "unused": 3}
    work = StructValue({name: LocalArray(size) for name, size in sizes.items()})
    emitter = Emitter()
    made = emitter.add(from_arrays, F32, work)
    handed = [name for several in made.argument_lists(WGSL) for name, _ in several]
    assert handed == ["x", "work_first", "work_second"]
    text = emitter.functions_text()
    assert "fn halved(x: f32, work_first: ptr<function, array<f32, 1>>) -> f32 {" in text
    assert "(halved(x, work_first) + (*work_second)[1])" in text
    # Arrays of the module are not handed over at all.
    emitter = Emitter(GLSL)
    named = {name: emitter.module_array(name, one) for name, one in work.fields.items()}
    emitter.add(from_arrays, F32, StructValue(named))
    assert "float halved(float x) {" in emitter.functions_text()
    assert "(halved(x) + second[1])" in emitter.functions_text()


def another_name(x, work):
    room = work.first  # here
    return x * room[0]


def test_an_array_has_one_name() -> None:
    assert_refused(another_name, F32, StructValue({"first": LocalArray(1)}))


def test_a_function_is_emitted_once_and_before_its_callers() -> None:
    # WGSL needs no order, GLSL does.
    emitter = Emitter()
    assert emitter.add(one_of_two, F32, F32, I32) is emitter.add(one_of_two, F32, F32, I32)
    text = emitter.functions_text()
    assert text.count("fn two(") == 1
    assert text.index("fn two(") < text.index("fn one_of_two(")


@pytest.mark.parametrize(
    ("function", "exact"),
    [(math.sin, np.sin), (math.cos, np.cos), (math.atan, np.arctan)],
    ids=["sine", "cosine", "arc_tangent"],
)
def test_angles_are_better_than_wgsl_promises(
    on_gpu: Run, function: Callable[[float], float], exact: Any
) -> None:
    # Two units of single precision at 1; WGSL's own sine may err by 5e-4.
    x = np.float32(np.concatenate([np.linspace(-200.0, 200.0, 40001), np.linspace(-4, 4, 4001)]))
    seen = on_gpu({math.sin: sine_of, math.cos: cosine_of, math.atan: arc_tangent_of}[function], x)
    assert_allclose(seen, exact(x.astype(float)), rtol=0.0, atol=2e-7)


def sine_of(x):
    return math.sin(x)


def cosine_of(x):
    return math.cos(x)


def arc_tangent_of(x):
    return math.atan(x)


def arcs(x):
    return math.acos(x), math.asin(x)


def test_arcs_are_good_to_the_ends(on_gpu: Run) -> None:
    # One unit of single precision at π; near ±1 a bare polynomial loses half the digits.
    ends = 1.0 - np.geomspace(1e-7, 1e-2, 500)
    x = np.float32(np.concatenate([np.linspace(-1.0, 1.0, 4001), ends, -ends]))
    seen = on_gpu(arcs, x)
    assert_allclose(seen[0], np.arccos(x.astype(float)), rtol=0.0, atol=4e-7)
    assert_allclose(seen[1], np.arcsin(x.astype(float)), rtol=0.0, atol=4e-7)


def angle(y, x):
    return math.atan2(y, x)


def test_the_angle_of_a_point_is_right_in_every_quadrant(on_gpu: Run) -> None:
    # NumPy; on the axes too, and where both lengths are of a planet's size.
    y, x = np.meshgrid(
        [-6e6, -1.0, -1e-9, 0.0, 1e-9, 1.0, 6e6], [-6e6, -1.0, -1e-6, 1e-6, 1.0, 6e6]
    )
    seen = on_gpu(angle, y, x)
    assert_allclose(seen, np.arctan2(np.float32(y), np.float32(x), dtype=float), rtol=0, atol=4e-7)


def root(x):
    return cube_root(x)


def test_the_cube_root_is_numpy_s(on_gpu: Run) -> None:
    # A power of one third: errors of log₂ and 2ˣ by WGSL's table, 3 units each; 0 and below give 0.
    x = np.float32(np.geomspace(1e-6, 1e6, 1000))
    assert_allclose(on_gpu(root, x), np.cbrt(x.astype(float)), rtol=64 * EPS)
    assert_array_equal(on_gpu(root, np.array([0.0, -1.0, -8.0])), 0.0)


# --- refused constructs ------------------------------------------------------------------------


def a_list(x):
    return [x]  # here


def a_text(x):
    return "x"  # here


def a_lambda(x):
    return (lambda: x)()  # here


def a_comprehension(x):
    return sum([x for _ in range(3)])  # here


def an_assertion(x):
    assert x > 0.0  # here
    return x


def a_raise(x):
    raise ValueError(x)  # here


def a_try(x):
    try:  # here
        return x
    finally:
        pass


def a_with(x):
    with x:  # here
        return x


def a_function_within(x):
    def inside():  # here
        return x

    return inside()


def a_deletion(x):
    del x  # here


def a_bit_operation(n):
    return n & 3  # here


def a_shift(n):
    n = n << 2  # here
    return n


def an_identity(x):
    return x is None  # here


def a_membership(x):
    return x in (1.0, 2.0)  # here


def a_loop_over_a_room(x):
    room = np.empty(_SIZE)
    for one in room:  # here
        x += one
    return x


def a_loop_with_an_else(x):
    for _i in range(3):  # here
        x += 1.0
    else:
        x = 0.0
    return x


def a_while_with_an_else(x):
    while x < 3.0:  # here
        x += 1.0
    else:
        x = 0.0
    return x


def a_named_argument(x):
    return two(x, y=x)  # here


def an_unknown_name(x):
    return x + nowhere  # noqa: F821 # here


def an_unknown_function(x):
    return math.gamma(x)  # here


def a_function_of_numpy(x):
    return np.interp(x, x, x)  # here


def a_fraction_of_whole_numbers(x):
    return x // 2.0  # here


def a_number_for_a_bool(x):
    flag = x > 0.0
    flag = x  # here
    return flag


def a_tuple_in_a_name(x):
    pair = two(x, x)  # here
    return pair[0]


def too_few_names(x):
    (a,) = two(x, x)  # here
    return a


def too_few_components(x):
    v = Vec3(x, x)  # here
    return v.x


def a_choice_of_vectors(x):
    v = Vec3(x, x, x) if x > 0.0 else Vec3(0.0, 0.0, x)  # here
    return v.x


def a_room_of_any_size(x):
    room = np.empty(int(x))  # here
    return room[0]


def a_huge_number(x):
    return x * 1e39  # here


def an_attribute_set(x):
    math.tau = x  # here
    return x


def two_names_that_a_shader_spells_alike(x):
    y = 2.0 * x
    _y = 3.0 * x  # here
    return y + _y


REFUSED = [
    two_names_that_a_shader_spells_alike,
    a_list, a_text, a_lambda, a_comprehension, an_assertion, a_raise, a_try, a_with,
    a_function_within, a_deletion, an_identity, a_membership, a_loop_over_a_room,
    a_loop_with_an_else, a_while_with_an_else, a_named_argument, an_unknown_name,
    an_unknown_function, a_function_of_numpy, a_fraction_of_whole_numbers, a_number_for_a_bool,
    a_tuple_in_a_name, too_few_names, too_few_components, a_choice_of_vectors,
    a_room_of_any_size, a_huge_number, an_attribute_set,
]  # fmt: skip


def assert_refused(function: Any, *values: Value) -> None:
    lines, first = inspect.getsourcelines(function)
    (line,) = [first + i for i, text in enumerate(lines) if text.rstrip().endswith("# here")]
    with pytest.raises(SubsetError) as refused:
        Emitter().add(function, *values)
    message = str(refused.value)
    assert f"test_emitter.py:{line}: " in message
    assert "\n" not in message


@pytest.mark.parametrize("function", REFUSED, ids=lambda one: one.__name__)
def test_what_has_no_wgsl_is_refused_with_file_and_line(function: Any) -> None:
    # The line is marked in the source.
    assert_refused(function, F32)


@pytest.mark.parametrize("function", [a_bit_operation, a_shift], ids=lambda one: one.__name__)
def test_bits_of_whole_numbers_are_refused(function: Any) -> None:
    assert_refused(function, I32)


def a_write_to_a_table(x, table):
    table[0] = x  # here
    return x


def too_few_indices(x, table):
    return table[0] * x  # here


def a_slice(x, table):
    return table[0:2, 1]  # here


@pytest.mark.parametrize(
    ("function", "table"),
    [
        (a_write_to_a_table, ShaderTable("table")),
        (too_few_indices, ShaderTable("table", 2)),
        (a_slice, ShaderTable("table", 2)),
        (too_few_indices, ShaderTable("table", 2, True)),
    ],
    ids=lambda one: getattr(one, "__name__", ""),
)
def test_tables_used_otherwise_are_refused(function: Any, table: ShaderTable) -> None:
    assert_refused(function, F32, table)


def lanes_to_a_number(x, room):
    x = load(room, 0)  # here
    return math.sqrt(x)


def test_four_wavelengths_are_no_number() -> None:
    # A vector has no scalar mathematics.
    with pytest.raises(SubsetError, match=r"test_emitter\.py:\d+: 'x': is not f32"):
        Emitter().add(lanes_to_a_number, F32, LocalArray(2, VEC4))


@kernel
def calls_itself(x):
    return calls_itself(x - 1.0) if x > 0.0 else x


def test_a_function_that_calls_itself_is_refused() -> None:
    # WGSL has no recursion.
    with pytest.raises(SubsetError, match=r"calls_itself: recursion is not supported$"):
        Emitter().add(calls_itself, F32)


def test_another_number_of_arguments_is_refused() -> None:
    with pytest.raises(SubsetError, match=r"two: 1 arguments for 2 parameters$"):
        Emitter().add(two, F32)
