"""Cache in memory: which values are kept."""

from __future__ import annotations

import pickle

import pytest

from airlight.kernel.cache import Cache


def test_values_used_lately_are_kept_beyond_the_number(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr("airlight.kernel.cache.time.monotonic", lambda: now[0])
    kept: Cache[str, int] = Cache(2, 30.0)
    for number, key in enumerate("abcd"):
        kept.put(key, number)
    now[0] = 20.0
    assert kept.get("b") == 1
    kept.put("e", 4)
    assert [key in kept for key in "abcde"] == [True] * 5
    now[0] = 40.0
    kept.put("f", 5)
    assert [key in kept for key in "abcdef"] == [False, True, False, False, True, True]
    now[0] = 100.0
    kept.put("g", 6)
    assert [key in kept for key in "befg"] == [False, False, True, True]
    assert len(pickle.loads(pickle.dumps(kept))) == 0
