"""A kernel is compiled as far as its callers need it, and to the end when Python calls it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numba.core.caching import NullCache
from numpy.testing import assert_allclose

from airlight.kernel import compiled_loop, kernel
from airlight.kernel.lowering import CompiledKernel, IntermediateCode


def libraries(function: object) -> list[type]:
    return [type(one.library) for one in function.overloads.values()]  # type: ignore[attr-defined]


@kernel
def cubed(x):
    return x * x * x


@kernel
def root_of_cube(x):
    return cubed(x) ** 0.5


@compiled_loop
def sum_of_roots(x):
    total = 0.0
    for k in range(x.size):
        total += root_of_cube(x[k])
    return total


def test_kernels_stay_intermediate_code_until_python_calls_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    # a loop that an earlier run left on the disk has its kernels within and compiles none
    for function in (cubed, root_of_cube, sum_of_roots):
        monkeypatch.setattr(function, "_cache", NullCache())
    # x³ to the power 1/2 of 1 and 4 are 1 and 8
    assert sum_of_roots(np.array([1.0, 4.0])) == 9.0
    assert libraries(root_of_cube) == libraries(cubed) == [IntermediateCode]
    assert IntermediateCode not in libraries(sum_of_roots)
    assert root_of_cube(4.0) == 8.0
    assert IntermediateCode not in libraries(root_of_cube)
    assert libraries(cubed) == [IntermediateCode]
    assert cubed(2.0) == 8.0
    assert sum_of_roots(np.array([4.0])) == 8.0


@kernel
def growth(x, steps):
    for _ in range(steps):
        if x > 1e9:
            raise ValueError("too large")
        x *= 10.0
    return x


@compiled_loop
def growths(x, steps):
    return growth(x, steps)


def test_an_error_in_a_kernel_reaches_python_through_its_caller() -> None:
    assert growths(1.0, 3) == 1000.0
    with pytest.raises(ValueError, match="too large"):
        growths(1.0, 20)


SOURCE = """
import sys
import numpy as np
from airlight.kernel import compiled_loop, kernel
from numba.core import event

class Compiled(event.Listener):
    def on_start(self, started): pass
    def on_end(self, ended): names.append(ended.data["dispatcher"].py_func.__name__)

names = []
event.register("numba:compile", Compiled())

@kernel
def inner(x):
    return np.exp(x) + 1.0

@compiled_loop
def one(x):
    return 2.0 * inner(x)

@compiled_loop
def other(x):
    return 3.0 * inner(x)

print(globals()[sys.argv[1]](0.0), *[name for name in names if name in ("inner", "one", "other")])
"""


@pytest.mark.slow
def test_the_disk_has_both_forms(tmp_path: Path) -> None:
    # exp(0) + 1 is 2; each process compiles only what no other has compiled as far as it needs it
    script = tmp_path / "kernels.py"
    script.write_text(SOURCE, encoding="utf-8")

    def run(name: str) -> list[str]:
        done = subprocess.run(
            [sys.executable, script, name], check=True, capture_output=True, text=True,
            env={**os.environ, "AIRLIGHT_CACHE": str(tmp_path / "cache")},
        )  # fmt: skip
        return done.stdout.split()

    assert run("one") == ["4.0", "inner", "one"]
    assert run("other") == ["6.0", "other"]
    assert run("inner") == ["2.0", "inner"]
    assert [run("inner"), run("one"), run("other")] == [["2.0"], ["4.0"], ["6.0"]]


def test_arithmetic_is_as_accurate_as_in_python() -> None:
    x = np.linspace(0.1, 9.0, 50)
    assert_allclose(sum_of_roots(x), np.sum(x**1.5), rtol=1e-14)


@compiled_loop
def ends_and_sums(a, b, i):
    a[-1] = 2.0
    b[i, -1] = 3.0
    b[-2, i] += 4.0
    total = 0.0
    for k in range(a.size):
        total += a[k] + b[k % 2, k % 3]
    return a[-1], b[i, -1], b[-1][i], a[1:-1].sum(), a[np.int32(1)], total


def test_negative_numbers_as_indices_count_from_the_end() -> None:
    results = []
    for function in (ends_and_sums, ends_and_sums.py_func):
        a, b = np.arange(5.0), np.ones((2, 3))
        results.append((*function(a, b, 1), *a, *b.ravel()))
    assert results[0] == results[1]


@pytest.mark.parametrize("place", [(-1,), (0, -1), (-1, 0)])
def test_a_variable_as_an_index_counts_from_the_start(place: tuple[int, ...]) -> None:
    # Numba's own functions would test each index, and read the last element
    def element(a, i):
        return a[i]

    def put(a, i):
        a[i] = 1.0

    array = np.zeros((3,) * len(place))
    at = place if len(place) > 1 else place[0]
    for function in (element, put):
        with pytest.raises(IndexError):
            CompiledKernel(function, boundscheck=True)(array, at)
