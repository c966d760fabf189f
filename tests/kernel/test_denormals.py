"""Subnormal numbers count as zero in blocks of work, and nowhere else."""

from __future__ import annotations

import platform
import threading
import time

import numpy as np
import pytest

from airlight.errors import Cancelled
from airlight.kernel.denormals import flush_denormals, restore
from airlight.kernel.threads import run_blocks

pytestmark = pytest.mark.skipif(
    platform.machine().lower() not in ("x86_64", "amd64"), reason="no MXCSR on this CPU"
)

#: Smallest normal float32; its half is subnormal.
LEAST = np.float32(1.17549435e-38)


def product(value: np.float32, factor: float) -> float:
    """Product in single precision, which the interpreter cannot have computed before."""
    return float(np.multiply(np.full(1, value, np.float32), np.float32(factor))[0])


@pytest.mark.parametrize("threads", ["1", "2", "4"])
def test_results_and_operands_are_zero_in_all_threads(
    threads: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    # IEEE 754: half of the least normal number is subnormal, and four times that is normal again.
    monkeypatch.setenv("AIRLIGHT_THREADS", threads)
    half = product(LEAST, 0.5)
    assert 0.0 < half < float(LEAST)
    found: dict[int, tuple[float, float, float]] = {}
    ran = set()

    def block(index: int) -> None:
        time.sleep(0.005)
        ran.add(threading.get_ident())
        found[index] = (product(LEAST, 0.5), product(np.float32(half), 4.0), product(LEAST, 2.0))

    run_blocks(block, 24)
    assert set(found.values()) == {(0.0, 0.0, 2.0 * float(LEAST))}
    assert len(ran) == int(threads)
    assert product(LEAST, 0.5) == half


def test_callers_have_their_own_mode_between_blocks(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_THREADS", "1")
    half = product(LEAST, 0.5)
    seen: list[float] = []

    def cancel() -> bool:
        seen.append(product(LEAST, 0.5))
        return len(seen) == 3

    with pytest.raises(Cancelled):
        run_blocks(lambda _: None, 9, cancel=cancel)
    assert seen == [half] * 3
    assert product(LEAST, 0.5) == half


def test_the_mode_is_given_back_after_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_THREADS", "1")
    half = product(LEAST, 0.5)

    def block(_: int) -> None:
        raise ValueError("a block")

    with pytest.raises(ValueError, match="a block"):
        run_blocks(block, 2)
    assert product(LEAST, 0.5) == half


def test_modes_nest() -> None:
    half = product(LEAST, 0.5)
    first = flush_denormals()
    second = flush_denormals()
    assert product(LEAST, 0.5) == 0.0
    restore(second)
    assert product(LEAST, 0.5) == 0.0
    restore(first)
    assert product(LEAST, 0.5) == half
