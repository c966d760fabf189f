"""Eight lanes compute the same as eight float32 numbers."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

from airlight.kernel import compiled_loop
from airlight.kernel.lanes import (
    HALF_LANES,
    LANES,
    exponential,
    floored,
    folded,
    lane_array,
    lane_view,
    largest,
    load,
    load_half,
    load_two,
    looked_up,
    maximum,
    pair,
    splat,
    square_root,
    store,
    store_half,
    where_positive,
)


@compiled_loop
def all_exponentials(x, out):
    for at in range(0, x.size, 8):
        store(out, at, exponential(load(x, at)))


@compiled_loop
def arithmetic(x, y, number, whole, out):
    a, b = load(x, 0), load(y, 0)
    store(out, 0, a + b)
    store(out, 8, a - b)
    store(out, 16, a * b)
    store(out, 24, a / b)
    store(out, 32, a + number)
    store(out, 40, number - a)
    store(out, 48, whole * a)
    store(out, 56, a / whole)
    store(out, 64, maximum(a, b))
    store(out, 72, maximum(a, number))
    store(out, 80, splat(number))


@compiled_loop
def copy_from(x, first, out, to):
    store(out, to, load(x, first))


@compiled_loop
def across_lanes(x, y, out):
    a, b = load(x, 0), load(y, 0)
    store(out, 0, pair(a, b))
    store(out, 8, pair(np.float32(2.0), 3.0))
    store(out, 16, folded(a))
    store(out, 24, load_two(x, 1, 4))
    store(out, 32, floored(a))
    store(out, 40, square_root(b))
    store(out, 48, looked_up(y, load(x, 8)))
    store(out, 56, splat(largest(a)))
    store(out, 64, where_positive(a, b, splat(7.0)))


@compiled_loop
def matrix_product(matrix, vectors, out):
    total = lane_view(lane_array(1))
    for at in range(0, vectors.shape[2], LANES):
        given, found = lane_view(vectors, at), lane_view(out, at)
        for i in range(matrix.shape[0]):
            for k in range(vectors.shape[1]):
                total[0] = splat(0.0)
                for j in range(matrix.shape[1]):
                    total[0] += given[j, k] * np.float32(matrix[i, j])
                found[i, k] = total[0]


@compiled_loop
def transposed(x, out):
    given, found = lane_view(x), lane_view(out)
    for i in range(given.shape[0]):
        for j in range(given.shape[1]):
            found[j, i] = given[i, j]


def exponentials(x: np.ndarray) -> np.ndarray:
    """e^x by lanes; the length of x is extended to a multiple of eight."""
    filled = np.resize(np.asarray(x, np.float32), -(-len(x) // LANES) * LANES)
    out = np.empty_like(filled)
    all_exponentials(filled, out)
    return out[: len(x)]


def test_exponential_keeps_the_error_it_promises_over_its_whole_range() -> None:
    # Second method: NumPy's exponential in float64 of the same float32 arguments. The promise is
    # 3e-7 and 1e-7 |x|; the ends are those of the clamped range.
    x = np.concatenate([np.linspace(-86.99, 88.0, 400_001), np.linspace(-1e-3, 1e-3, 1001)])
    x = x.astype(np.float32)
    truth = np.exp(x.astype(np.float64))
    error = np.abs(exponentials(x) / truth - 1.0)
    assert (error <= 3e-7 + 1e-7 * np.abs(x)).all(), error.max()


def test_exponential_of_zero_is_exactly_one() -> None:
    # e^0 = 1: empty air is perfectly clear.
    assert_array_equal(exponentials(np.array([0.0, -0.0])), [1.0, 1.0])


def test_exponential_is_zero_in_the_dark_and_never_overflows() -> None:
    # e^-87 is 1.6e-38, next to the smallest normal float32; e^88 = 1.65e38 is below the largest.
    dark = exponentials(np.array([-87.0, -87.01, -1e3, -1e30, -np.inf]))
    assert_array_equal(dark, np.zeros(5))
    assert_allclose(exponentials(np.array([88.0, 1e3, np.inf])), np.exp(88.0), rtol=1e-5)


def test_exponential_never_falls_with_its_argument_by_more_than_rounding() -> None:
    # A law: e^x rises. Across the seams of the range reduction (x = (k + 1/2) ln 2) it may dip by
    # no more than its error bound.
    seams = (np.arange(-100, 100) + 0.5) * np.log(2.0)
    for seam in seams:
        x = np.linspace(seam - 1e-4, seam + 1e-4, 65)
        y = exponentials(x).astype(float)
        assert (np.diff(y) >= -(6e-7 + 2e-7 * abs(seam)) * y[:-1]).all()


def test_operators_work_lane_by_lane_with_lanes_and_numbers() -> None:
    # Second method: the same float32 arithmetic in NumPy; division may use a reciprocal (2 ulp).
    rng = np.random.default_rng(1)
    x, y = rng.uniform(0.5, 2.0, (2, LANES)).astype(np.float32)
    out = np.zeros(11 * LANES, np.float32)
    arithmetic(x, y, 1.25, 3, out)
    n = np.float32(1.25)
    expected = [
        x + y, x - y, x * y, x / y, x + n, n - x, 3 * x, x / 3, np.maximum(x, y),
        np.maximum(x, n), np.full(LANES, n),
    ]  # fmt: skip
    assert_allclose(out.reshape(11, LANES), expected, rtol=2.5e-7, atol=0)


@pytest.mark.parametrize(("first", "to"), [(0, 0), (3, 5), (8, 16), (11, 1)])
def test_load_and_store_move_eight_neighbours_and_touch_nothing_else(first: int, to: int) -> None:
    # By definition; odd indices check that no alignment is assumed.
    x = np.arange(32, dtype=np.float32)
    out = np.full(32, -1, np.float32)
    copy_from(x, first, out, to)
    expected = np.full(32, -1, np.float32)
    expected[to : to + LANES] = x[first : first + LANES]
    assert_array_equal(out, expected)


def test_lanes_are_paired_folded_and_looked_up() -> None:
    # Second method: NumPy's own slices, sums, floor, root and fancy index.
    rng = np.random.default_rng(5)
    x = rng.uniform(-3.0, 3.0, 16).astype(np.float32)
    which = rng.integers(0, 16, LANES)
    x[LANES:] = which
    y = rng.uniform(0.0, 5.0, 16).astype(np.float32)
    out = np.empty(9 * LANES, np.float32)
    across_lanes(x, y, out)
    a, b = x[:LANES], y[:LANES]
    halves = a[:HALF_LANES] + a[HALF_LANES:]
    expected = [
        np.concatenate([a[:HALF_LANES], b[HALF_LANES:]]), np.repeat([2.0, 3.0], HALF_LANES),
        np.tile(halves, 2), np.concatenate([x[1 : 1 + HALF_LANES], x[4 : 4 + HALF_LANES]]),
        np.floor(a), np.sqrt(b), y[which],
        [a.max()] * LANES, np.where(a > 0.0, b, 7.0),
    ]  # fmt: skip
    assert_allclose(out.reshape(9, LANES), np.array(expected), rtol=2e-7)


def test_views_have_the_axes_of_their_arrays() -> None:
    # Second method: NumPy's product and transposition of the arrays, with wavelengths on the last
    # axis, in two groups and in one; what is read may be read-only.
    rng = np.random.default_rng(7)
    matrix, vectors = rng.random((3, 4)), rng.random((4, 5, 2 * LANES)).astype(np.float32)
    vectors.flags.writeable = False
    out = np.empty((3, 5, 2 * LANES), np.float32)
    matrix_product(matrix, vectors, out)
    assert_allclose(out, np.einsum("ij,jkw->ikw", matrix, vectors), rtol=5e-7)
    few = np.ascontiguousarray(vectors[:, :, :LANES])
    turned = np.empty((5, 4, LANES), np.float32)
    transposed(few, turned)
    assert_array_equal(turned, few.transpose(1, 0, 2))


@compiled_loop
def copy_half(x, first, out, to):
    store(out, 0, load_half(x, first))
    store_half(out, to, load_half(x, first))


def test_four_elements_are_read_into_both_halves_and_written_alone():
    x = np.arange(12, dtype=np.float32)
    out = np.full(16, -1.0, np.float32)
    copy_half(x, 3, out, 9)
    assert_array_equal(out[:8], [3, 4, 5, 6, 3, 4, 5, 6])
    assert_array_equal(out[8:], [-1, 3, 4, 5, 6, -1, -1, -1])
