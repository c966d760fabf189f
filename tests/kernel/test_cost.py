"""Long work is announced by a line before it, at the rate that this machine has shown."""

from __future__ import annotations

import time
from collections.abc import Iterator
from pathlib import Path

import pytest

from airlight.kernel import cost
from airlight.kernel.cost import DEVICE, RATES, announce, expected_seconds, timed
from airlight.kernel.disk import cache_folder


@pytest.fixture
def heard(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[list[str]]:
    """Lines that are announced, on a machine that has measured nothing, with one thread."""
    monkeypatch.setattr(cost, "cache_folder", cache_folder)  # not the run's own, of `own_solutions`
    monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path))
    monkeypatch.setenv("AIRLIGHT_THREADS", "1")
    lines: list[str] = []
    before = announce.set(lines.append)
    yield lines
    announce.reset(before)


def test_long_work_is_announced_and_short_work_is_not(heard: list[str]) -> None:
    with timed("solve", 20.0 * RATES["solve"], "the air"):
        pass
    with timed("solve", 5.0 * RATES["solve"], "thin air"):
        pass
    assert heard == ["the air: about 20 s"]


def test_work_inside_work_is_announced_once(heard: list[str]) -> None:
    with timed(DEVICE, 200.0 * RATES[DEVICE], "a film"):
        for _ in range(3):
            with timed("picture", 1e3 * RATES["picture"], "a frame"):
                pass
    assert heard == ["a film: about 3.3 min"]


def test_a_measured_rate_is_that_of_the_next_work(
    heard: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = iter((0.0, 2.0))
    monkeypatch.setattr(time, "process_time", lambda: next(clock))
    with timed("particles", 8.0 * RATES["particles"], "dust"):
        pass
    # four times as fast as it stands in the code
    assert expected_seconds("particles", 100.0 * RATES["particles"]) == pytest.approx(25.0)
    assert heard == []


def test_slower_work_lowers_a_rate_by_a_fifth(
    heard: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = iter((0.0, 100.0))
    monkeypatch.setattr(time, "process_time", lambda: next(clock))
    with timed("picture", RATES["picture"], "a first picture, which compiles"):
        pass
    assert expected_seconds("picture", 8.0 * RATES["picture"]) == pytest.approx(10.0)


def test_small_work_says_nothing_about_large(
    heard: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    # a hundred small pictures, each of which compiled or waited, made rates 60 times too slow
    clock = iter((0.0, 100.0))
    monkeypatch.setattr(time, "process_time", lambda: next(clock))
    with timed("picture", 0.1 * RATES["picture"], "a small picture"):
        pass
    assert expected_seconds("picture", RATES["picture"]) == pytest.approx(1.0)
    assert not cost._file().exists()


def test_work_that_fails_is_not_measured(heard: list[str], monkeypatch: pytest.MonkeyPatch) -> None:
    clock = iter((0.0, 50.0))
    monkeypatch.setattr(time, "process_time", lambda: next(clock))
    with pytest.raises(ValueError, match="stop"), timed("solve", 1.0, "air"):
        raise ValueError("stop")
    assert not cost._file().exists()


@pytest.mark.parametrize("content", ["", "{", "[1]", '{"solve": "x"}', '{"solve": 1e300}', "1"])
def test_a_damaged_file_of_rates_counts_as_absent(content: str, heard: list[str]) -> None:
    cost._file().write_text(content)
    assert expected_seconds("solve", RATES["solve"]) == pytest.approx(1.0)


def test_a_closed_folder_costs_the_rate_alone(
    heard: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("AIRLIGHT_CACHE", str(tmp_path / "file"))
    clock = iter((0.0, 2.0))
    monkeypatch.setattr(time, "process_time", lambda: next(clock))
    with timed("solve", RATES["solve"], "air"):
        pass
    assert expected_seconds("solve", RATES["solve"]) == pytest.approx(1.0)
