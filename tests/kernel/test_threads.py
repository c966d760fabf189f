"""Blocks of work run once each, whatever the number of threads."""

from __future__ import annotations

import os
import signal
import threading
import time
import warnings

import pytest
from numpy.testing import assert_array_equal

from airlight.errors import Cancelled
from airlight.kernel.threads import run_blocks, thread_count


@pytest.mark.parametrize("threads", [1, 2, 3, 8])
@pytest.mark.parametrize("count", [0, 1, 2, 3, 7, 8, 9, 64, 257])
def test_every_index_runs_exactly_once(
    threads: int, count: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    # By definition of the loop that it replaces.
    monkeypatch.setenv("AIRLIGHT_THREADS", str(threads))
    ran: list[int] = []
    lock = threading.Lock()

    def block(index: int) -> None:
        with lock:
            ran.append(index)

    run_blocks(block, count)
    assert_array_equal(sorted(ran), range(count))


def test_no_more_blocks_run_at_once_than_there_are_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_THREADS", "3")
    now, most, lock = 0, 0, threading.Lock()

    def block(_: int) -> None:
        nonlocal now, most
        with lock:
            now += 1
            most = max(most, now)
        time.sleep(0.002)
        with lock:
            now -= 1

    run_blocks(block, 30)
    assert 1 <= most <= 3


def test_progress_rises_to_the_total_in_the_calling_thread(monkeypatch: pytest.MonkeyPatch) -> None:
    # By definition: done never falls, ends at the total, and a window's toolkit may be called.
    monkeypatch.setenv("AIRLIGHT_THREADS", "3")
    reported: list[tuple[int, int, str]] = []
    callers: set[int] = set()

    def progress(done: int, total: int, message: str) -> None:
        reported.append((done, total, message))
        callers.add(threading.get_ident())

    run_blocks(lambda _: None, 20, progress=progress, message="rows")
    done = [one[0] for one in reported]
    assert done == sorted(done)
    assert reported[-1] == (20, 20, "rows")
    assert callers == {threading.get_ident()}


def test_cancel_stops_soon_and_leaves_no_block_running(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_THREADS", "2")
    started: list[int] = []
    ended: list[int] = []

    def block(index: int) -> None:
        started.append(index)
        time.sleep(0.005)
        ended.append(index)

    with pytest.raises(Cancelled):
        run_blocks(block, 1000, cancel=lambda: len(started) >= 4)
    assert len(started) < 12
    assert sorted(started) == sorted(ended)
    time.sleep(0.02)
    assert len(started) == len(ended)


def test_an_exception_in_a_block_reaches_the_caller(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_THREADS", "2")
    ran: list[int] = []

    def block(index: int) -> None:
        ran.append(index)
        if index == 5:
            raise KeyError("block 5")

    with pytest.raises(KeyError, match="block 5"):
        run_blocks(block, 1000)
    assert len(ran) < 20
    run_blocks(ran.append, 3)  # the threads still work


@pytest.mark.parametrize("named", ["", "0", "-2", "two", "1.5"])
def test_a_number_of_threads_that_is_none_is_ignored(
    named: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("AIRLIGHT_THREADS", raising=False)
    own = thread_count()
    monkeypatch.setenv("AIRLIGHT_THREADS", named)
    assert thread_count() == own >= 1


def test_the_environment_names_the_number_of_threads(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AIRLIGHT_THREADS", "5")
    assert thread_count() == 5


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_process_has_threads_of_its_own() -> None:
    # it inherits the pool, but not the threads: its blocks waited for ever
    done: list[int] = []
    run_blocks(done.append, 8)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DeprecationWarning)  # Python 3.12 warns of forked threads
        child = os.fork()
    if child == 0:
        inside: list[int] = []
        run_blocks(inside.append, 8)
        os._exit(0 if sorted(inside) == list(range(8)) else 1)
    until = time.monotonic() + 60.0
    while time.monotonic() < until:
        ended, status = os.waitpid(child, os.WNOHANG)
        if ended:
            break
        time.sleep(0.01)
    else:
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        pytest.fail("the forked process hangs")
    assert os.waitstatus_to_exitcode(status) == 0
