"""Compiled functions without reference counts where they only borrow arrays."""

from __future__ import annotations

import sys
from typing import NamedTuple

import numpy as np
import pytest
from numba.core.runtime import _nrt_python, rtsys

from airlight.kernel import compiled_loop, kernel
from airlight.kernel.lanes import LANES, lane_view


class Bundle(NamedTuple):
    """Arrays that a loop is given."""

    one: np.ndarray
    other: np.ndarray


@kernel
def row(bundle, k):
    return bundle.one[k]


@kernel
def doubled(values):
    out = np.empty(values.size)
    for k in range(values.size):
        out[k] = 2.0 * values[k]
    return out


@compiled_loop
def borrowing(bundle):
    _, other = bundle
    again = Bundle(other, bundle.one)
    view = lane_view(again.one)
    total = 0.0
    for k in range(view.size):
        view[k] = view[k] + view[k]
        for n in range(LANES):
            total += bundle.other[k, n] + bundle.one[k][n]
    return total


@compiled_loop
def making(bundle):
    total = 0.0
    for k in range(bundle.one.shape[0]):
        total += doubled(row(bundle, k))[0] + (bundle.one[k] + bundle.one[k])[0]
    return total


@compiled_loop
def picking(bundle, which):
    return bundle.one[which][0, 0]


@compiled_loop
def assigning(bundle):
    bundle.other[0] = bundle.one[1]
    return np.sum(bundle.other[0])


@compiled_loop
def returning(bundle):
    return bundle.one[1]


def bundle() -> Bundle:
    return Bundle(np.ones((3, LANES), np.float32), np.ones((3, LANES), np.float32))


@pytest.fixture
def memory():
    """Numba's counts of arrays made and freed."""
    _nrt_python.memsys_enable_stats()
    yield rtsys.get_allocation_stats
    _nrt_python.memsys_disable_stats()


@pytest.mark.parametrize(
    ("loop", "more", "expected"),
    [
        (borrowing, (), 72.0),  # 24 doubled twos and 24 ones
        (making, (), 12.0),
        (picking, (np.array([1]),), 1.0),
        (assigning, (), LANES),
        (returning, (), np.ones(LANES)),
    ],
)
def test_arrays_live_exactly_as_long_as_they_are_held(loop, more, expected, memory) -> None:
    """Every array made is freed, and the caller's arrays keep their counts."""
    given = bundle()
    np.testing.assert_array_equal(loop(given, *more), expected)  # compiles
    given = bundle()
    counts = [sys.getrefcount(one) for one in given]
    before = memory()
    for _ in range(3):
        found = loop(given, *more)
    del found
    after = memory()
    assert after.mi_alloc - before.mi_alloc == after.mi_free - before.mi_free
    assert [sys.getrefcount(one) for one in given] == counts


def test_a_view_that_is_returned_outlives_its_array() -> None:
    given = bundle()
    view = returning(given)
    counts = sys.getrefcount(given.one)
    del given
    assert counts > 2  # held by the view beside the bundle and the call
    np.testing.assert_array_equal(view, np.ones(LANES))


@pytest.mark.parametrize(("loop", "counts"), [(borrowing, False), (making, True)])
def test_only_a_loop_that_makes_arrays_counts_references(loop, counts) -> None:
    loop(bundle())
    loop.recompile()  # code of a cache has no text
    (compiled,) = loop.overloads.values()
    assert ("NRT_" in compiled.library.get_llvm_str()) == counts
