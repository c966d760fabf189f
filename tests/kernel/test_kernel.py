"""A formula compiled once gives the same for scalars, arrays and other kernels."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from airlight.kernel import (
    cache_folder,
    compiled_loop,
    kernel,
    vectorized,
)


@kernel
def hypotenuse(x, y):
    return math.sqrt(x * x + y * y)


@compiled_loop
def hypotenuses(x, y, out):
    for k in range(x.size):
        out[k] = hypotenuse(x[k], y[k])


def test_scalar_array_function_and_loop_agree_bit_for_bit() -> None:
    # One formula, three ways to call it; 3-4-5 triangles are exact in floating point.
    n = np.arange(1.0, 9.0)
    out = np.empty(8)
    hypotenuses(3.0 * n, 4.0 * n, out)
    assert_array_equal(out, 5.0 * n)
    assert_array_equal(vectorized(hypotenuse)(3.0 * n, 4.0 * n), 5.0 * n)
    assert [hypotenuse(3.0 * x, 4.0 * x) for x in n] == (5.0 * n).tolist()


@kernel
def larger(x, y, bonus):
    return (x + 1 if bonus else x) > y


def test_array_function_broadcasts() -> None:
    # As NumPy's own functions do: numbers, single elements, rows against columns, views, nothing.
    several = vectorized(hypotenuse)
    table = several(np.array([[3.0], [6.0]]), np.array([4.0, 8.0]))
    assert_array_equal(table, [[5.0, math.sqrt(73.0)], [math.sqrt(52.0), 10.0]])
    assert_array_equal(several(np.array([[3.0]]), [4.0, 4.0]), [[5.0, 5.0]])
    assert_array_equal(several(np.arange(0.0, 9.0)[::3], 4.0), [4.0, 5.0, math.sqrt(52.0)])
    assert_array_equal(several(table.T, 0.0), table.T)
    assert isinstance(several(3.0, 4.0), np.float64)
    assert several(np.ones((2, 0)), np.ones((2, 1))).shape == (2, 0)
    with pytest.raises(ValueError, match="shape mismatch"):
        several(np.ones(2), np.ones(3))


def test_array_function_answers_in_the_type_of_the_formula() -> None:
    # By definition: whole numbers stay whole, a comparison is a bool, single precision is kept.
    assert_array_equal(vectorized(larger)([1, 2, 3], 2, True), [False, True, True])
    assert vectorized(larger)(np.ones(0, int), 2, False).dtype == bool
    assert vectorized(hypotenuse)(np.ones(3, np.float32), np.float32(1)).dtype == np.float32


_PROGRAM = """
import sys
import numpy as np
from airlight.kernel import vectorized
from airlight.geometry.shell import distance_to_top
kind = sys.argv[1]
several = vectorized(distance_to_top)(np.array([6400000], kind), 1.0, 6.5e6)
print(several[0], distance_to_top(6.4e6, 1.0, 6.5e6))
"""


def _run_with_cache(folder: Path | str, kind: str = "float64") -> str:
    run = subprocess.run(
        [sys.executable, "-c", _PROGRAM, kind],
        env={**os.environ, "AIRLIGHT_CACHE": str(folder)},
        capture_output=True, text=True, check=False, timeout=600,
    )  # fmt: skip
    assert run.returncode == 0, run.stderr
    return run.stdout


def test_a_kernel_and_its_array_function_share_a_cache_in_peace(tmp_path: Path) -> None:
    # Straight up from 6400 km to 6500 km are 100 km; the second process reads the code that the
    # first compiled. An entry of one kind taken for the other crashes the process.
    first, second = _run_with_cache(tmp_path), _run_with_cache(tmp_path)
    assert first == second == "100000.0 100000.0\n"
    assert list((tmp_path / "kernels").rglob("*.nbi"))


@pytest.mark.slow
def test_processes_do_not_overwrite_each_others_code(tmp_path: Path) -> None:
    # The second process finds no index, as if it had looked just before the first wrote it.
    # Numba alone would give its code, of other types, the first's name.
    assert _run_with_cache(tmp_path) == "100000.0 100000.0\n"
    kept = {file: file.read_bytes() for file in tmp_path.rglob("*.nbc")}
    assert len(kept) >= 2
    for index in tmp_path.rglob("*.nbi"):
        index.unlink()
    assert _run_with_cache(tmp_path, "int64") == "100000.0 100000.0\n"
    assert {file: file.read_bytes() for file in kept} == kept
    assert len(list(tmp_path.rglob("*.nbc"))) > len(kept)


def test_formulas_work_where_nothing_can_be_kept() -> None:
    # A file has the folder's name: nothing can be written below it.
    assert _run_with_cache(os.devnull) == "100000.0 100000.0\n"


def test_the_environment_names_the_cache_folder(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_CACHE", "/somewhere/else")
    assert cache_folder() == Path("/somewhere/else")
