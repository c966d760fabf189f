"""Independent blocks of work on all cores, with progress and cancellation.

Blocks write disjoint parts of the result, which does not depend on the number of threads. Denormals
are flushed to zero.
"""

from __future__ import annotations

import os
import threading
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor, wait
from functools import cache
from typing import Final, TypeAlias

from airlight.errors import Cancelled
from airlight.kernel.denormals import flush_denormals, restore

#: Called with the amount done, the total, and a description of the work.
Progress: TypeAlias = Callable[[int, int, str], None]
#: Called between blocks; True cancels the work.
Cancel: TypeAlias = Callable[[], bool]


def thread_count() -> int:
    """Number of threads: the CPU cores available to this process, or AIRLIGHT_THREADS."""
    named = os.environ.get("AIRLIGHT_THREADS", "")
    if named.isdigit() and int(named) > 0:
        return int(named)
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1


#: Interval at which a waiting thread checks for cancellation and progress. [s]
_LOOK: Final = 0.02

_here = threading.local()


def _enter_pool() -> None:
    _here.inside = True
    flush_denormals()


@cache
def _pool(threads: int) -> ThreadPoolExecutor:
    return ThreadPoolExecutor(threads, thread_name_prefix="airlight", initializer=_enter_pool)


if hasattr(os, "register_at_fork"):
    # A forked process has the pool but none of its threads: its blocks would wait forever.
    os.register_at_fork(after_in_child=_pool.cache_clear)


class _Blocks:
    """Queue of blocks for the calling thread and its helpers."""

    def __init__(self, block: Callable[[int], object], count: int) -> None:
        self.block, self.count, self.done = block, count, 0
        self._next, self._stopped = 0, False
        self._lock = threading.Lock()

    def run_next(self) -> bool:
        """Run the next block; False if there is none."""
        with self._lock:
            index = self._next
            if self._stopped or index >= self.count:
                return False
            self._next += 1
        try:
            self.block(index)
        except BaseException:
            self.stop()
            raise
        with self._lock:
            self.done += 1
        return True

    def run_all(self) -> None:
        """Run all remaining blocks."""
        while self.run_next():
            pass

    def stop(self) -> None:
        """Stop the queue: no further block begins."""
        self._stopped = True


def _run_here(blocks: _Blocks) -> bool:
    """Run the next block in the calling thread, and restore its floating-point mode."""
    mode = flush_denormals()
    try:
        return blocks.run_next()
    finally:
        restore(mode)


def run_blocks(
    block: Callable[[int], object],
    count: int,
    *,
    cancel: Cancel | None = None,
    progress: Progress | None = None,
    message: str = "",
) -> None:
    """Run ``block(0)`` … ``block(count - 1)`` on all cores, including the calling thread.

    Parameters
    ----------
    block : callable
        Function of the block's index, which should release the interpreter's lock.
    message : str
        Message for ``progress``.
    """
    blocks = _Blocks(block, count)
    if getattr(_here, "inside", False):  # a block's own blocks would wait for its own thread
        blocks.run_all()
        return
    threads = thread_count()
    helpers: list[Future[None]] = []
    reported = 0

    def look_up() -> None:
        nonlocal reported
        if cancel is not None and cancel():
            raise Cancelled("cancelled")
        if progress is not None and blocks.done > reported:
            reported = blocks.done
            progress(reported, count, message)

    try:
        if min(threads, count) > 1:
            pool = _pool(threads - 1)
            helpers = [pool.submit(blocks.run_all) for _ in range(min(threads, count) - 1)]
        _here.inside = True
        while _run_here(blocks):
            look_up()
        while wait(helpers, _LOOK).not_done:
            look_up()
    finally:
        _here.inside = False
        blocks.stop()
        wait(helpers)
    for one in helpers:
        one.result()
    look_up()
