"""Random numbers: the published generator, and streams that differ."""

from __future__ import annotations

import numpy as np
from numpy.testing import assert_allclose, assert_array_equal
from scipy.stats import kstest

from airlight.kernel import compiled_loop
from airlight.solver.montecarlo.streams import stream, uniform


@compiled_loop
def draw(state, out):
    for k in range(out.size):
        out[k] = uniform(state)


def numbers(state: np.ndarray, count: int) -> np.ndarray:
    out = np.empty(count)
    draw(state, out)
    return out


def test_numbers_are_those_of_splitmix64() -> None:
    # The test vector that goes round with the generator, for the state 1234567; the upper 53 bits
    # of each word are the number.
    words = [6457827717110365317, 3203168211198807973, 9817491932198370423, 4593380528125082431]
    got = numbers(np.array([1234567], np.uint64), 4)
    assert_allclose(got, [word / 2.0**64 for word in words], rtol=0, atol=2.0**-53)


def test_numbers_are_uniform_and_never_0_or_1() -> None:
    # Kolmogorov-Smirnov; fixed seed, so the bound of p = 0.001 is met or not for good.
    got = numbers(stream(3, 1, 4), 200_000)
    assert got.min() > 0.0
    assert got.max() < 1.0
    assert kstest(got, "uniform").pvalue > 1e-3


def test_streams_of_different_names_do_not_correlate() -> None:
    # The correlation of n independent pairs has a standard deviation of n^-1/2.
    first = numbers(stream(1, 7, 0), 100_000)
    for other in (stream(2, 7, 0), stream(1, 8, 0), stream(1, 7, 1), stream(1, 0, 7)):
        assert abs(np.corrcoef(first, numbers(other, 100_000))[0, 1]) < 4.0 / np.sqrt(100_000)
    assert_array_equal(first, numbers(stream(1, 7, 0), 100_000))
