"""Independent blocks of work on all cores, with progress and cancellation.

Each block writes its own part of the result, so that the result does not depend on the number of
threads.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import FIRST_COMPLETED, ThreadPoolExecutor, wait
from functools import cache
from itertools import islice
from typing import TypeAlias

from airlight.errors import Cancelled

#: Called with the amount done, the total, and a description of the work.
Progress: TypeAlias = Callable[[int, int, str], None]
#: Called between blocks; True stops the work.
Cancel: TypeAlias = Callable[[], bool]


def thread_count() -> int:
    """Number of threads: the processors that this process may use, or AIRLIGHT_THREADS."""
    named = os.environ.get("AIRLIGHT_THREADS", "")
    if named.isdigit() and int(named) > 0:
        return int(named)
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


_here = threading.local()


def _enter_pool() -> None:
    _here.inside = True


@cache
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="airlight", initializer=_enter_pool)


if hasattr(os, "register_at_fork"):
    # A forked process has the pool but none of its threads: its blocks would wait for ever.
    os.register_at_fork(after_in_child=_pool.cache_clear)


def run_blocks(
    block: Callable[[int], object],
    count: int,
    *,
    cancel: Cancel | None = None,
    progress: Progress | None = None,
    message: str = "",
) -> None:
    """Run ``block(0)`` … ``block(count - 1)`` on all cores.

    Parameters
    ----------
    block : callable
        Function of the block's index; it must release the interpreter's lock to gain from threads.
    count : int
        Number of blocks.
    cancel, progress : callable, optional
        See ``Cancel`` and ``Progress``; called from the calling thread.
    message : str
        Message for ``progress``.

    Raises
    ------
    Cancelled
        If ``cancel`` returned True, after the running blocks have ended.
    """
    if getattr(_here, "inside", False):  # a block's own blocks would wait for its own thread
        for index in range(count):
            block(index)
        return
    threads = thread_count()
    pool = _pool(threads)
    waiting = iter(range(count))
    # islice, not zip: zip would swallow one index when the other side ends first.
    under_way = {pool.submit(block, index) for index in islice(waiting, threads)}
    done = 0
    try:
        while under_way:
            finished, under_way = wait(under_way, return_when=FIRST_COMPLETED)
            for one in finished:
                one.result()
                done += 1
            if cancel is not None and cancel():
                raise Cancelled("cancelled")
            if progress is not None:
                progress(done, count, message)
            under_way |= {pool.submit(block, index) for index in islice(waiting, len(finished))}
    finally:
        wait(under_way)
