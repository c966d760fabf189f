"""Array index, texture coordinate and place in memory: there and back, exact at both ends."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from airlight.geometry.mappings.texels import (
    cell,
    coordinate_index,
    flat_index,
    index_coordinate,
    split_index,
    texture_coordinate,
    unit_coordinate,
)
from airlight.kernel import vectorized


@given(n=st.integers(2, 4096))
def test_ends_are_the_centres_of_the_first_and_last_texel(n: int) -> None:
    # By definition of a texture: texel k of n covers [k/n, (k+1)/n]. Powers of two are exact.
    ends = [texture_coordinate(0.0, n), texture_coordinate(1.0, n)]
    assert_allclose(ends, [0.5 / n, 1.0 - 0.5 / n], rtol=0, atol=2e-16)
    assert unit_coordinate(ends[0], n) == 0.0
    assert_allclose(unit_coordinate(ends[1], n), 1.0, rtol=0, atol=3e-16)
    assert (index_coordinate(0, n), index_coordinate(n - 1, n)) == (0.0, 1.0)
    assert (coordinate_index(0.0, n), coordinate_index(1.0, n)) == (0.0, n - 1.0)


@given(n=st.integers(2, 1024), x=st.floats(0.0, 1.0))
def test_coordinates_go_there_and_back(n: int, x: float) -> None:
    # Inverses, to a few roundings.
    assert_allclose(unit_coordinate(texture_coordinate(x, n), n), x, rtol=0, atol=4e-16)
    assert_allclose(index_coordinate(coordinate_index(x, n), n), x, rtol=0, atol=4e-16)


def test_index_and_texture_coordinate_name_the_same_texel() -> None:
    # A card's texel k has its centre at (k + 1/2)/n.
    n = 32
    k = np.arange(n)
    x = vectorized(index_coordinate)(k, n)
    assert_allclose(vectorized(texture_coordinate)(x, n), (k + 0.5) / n, rtol=0, atol=2e-16)


def test_a_table_of_one_value_has_one_place() -> None:
    # A limit: nothing is divided by n - 1 = 0.
    assert (unit_coordinate(0.5, 1), index_coordinate(0, 1)) == (0.0, 0.0)
    assert cell(0.0, 0, 0) == (0, 0, 0.0)


def test_flat_index_runs_through_memory_like_an_array() -> None:
    # x + y·width + z·width·height is NumPy's own order for an array (depth, height, width).
    width, height, depth = 5, 7, 3
    number = np.arange(width * height * depth).reshape(depth, height, width)
    z, y, x = np.indices(number.shape)
    np.testing.assert_array_equal(vectorized(flat_index)(x, y, z, width, height), number)
    for i in (0, 1, 34, 35, 104):
        assert flat_index(*split_index(i, width, height), width, height) == i


@given(place=st.floats(-2.0, 12.0))
def test_a_cell_holds_its_place_and_never_leaves_its_run(place: float) -> None:
    # The run 3..7 of ten values: neighbours stay in it, the shares rebuild the place.
    lower, upper, share = cell(place, 3, 7)
    assert 3 <= lower <= upper <= 7
    assert 0.0 <= share <= 1.0
    assert_allclose(lower + share * (upper - lower), min(max(place, 3.0), 7.0), atol=1e-15)
