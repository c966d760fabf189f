"""Message about the first compilation, after two seconds.

The loops of a solve have a message of their own. It goes to the listener of
``airlight.kernel.cost`` if there is one, as in the command line, otherwise to the logger
``airlight``.
"""

from __future__ import annotations

import contextlib
import logging
import math
import multiprocessing
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from typing import Any, Final

from numba.core import event

from airlight.kernel.compiling import SECONDS, is_kept, name_of, on_disk, work_left
from airlight.kernel.cost import announce, duration

#: Time of compilation after which a line is reported. [s]
PATIENCE: Final = 2.0
#: Delay of the end over the time left from which on another line is reported. [1]
NEWS: Final = 0.3


class FirstCompilation(event.Listener):
    """Listener of Numba that reports compilation and its estimated time."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._depth = 0
        self._loops: dict[str, Any] = {}
        self._elsewhere: tuple[Any, ...] = ()
        self._finished: set[str] = set()
        self._spent = self._cpu = 0.0
        self._began = (0.0, 0.0)
        self._end = -math.inf  # the monotonic clock may be at 0 when the machine starts
        self._silent = multiprocessing.parent_process() is not None  # whose parent reports it
        self._said = self._silent
        self._timer: threading.Timer | None = None

    def expect(self, loops: Iterable[Any]) -> None:
        """Add loops that will be compiled in this process."""
        with self._lock:
            self._add(loops)

    def _add(self, loops: Iterable[Any]) -> None:
        fresh = {name_of(one): one for one in loops if name_of(one) not in self._loops}
        self._loops |= fresh
        if self._silent or not self._said:
            return
        if SECONDS * work_left(fresh.values(), self._finished) >= PATIENCE:
            self._said, self._spent, self._cpu = False, 0.0, 0.0

    @contextlib.contextmanager
    def elsewhere(self, loops: Iterable[Any]) -> Iterator[None]:
        """Add loops compiled by another process, for which this one waits."""
        waited_for = tuple(one for one in loops if not on_disk(one))
        if self._said or not waited_for:
            yield
            return
        self._elsewhere = waited_for
        timer = threading.Timer(PATIENCE, self._say, (announce.get(),))
        timer.daemon = True
        timer.start()
        try:
            yield
        finally:
            timer.cancel()

    def on_start(self, started: Any) -> None:
        """Start the clock at the outermost compilation."""
        with self._lock:
            self._depth += 1
            if self._depth > 1:
                return
            self._add([started.data["dispatcher"]])
            if self._said:
                return
            self._began = (time.perf_counter(), time.process_time())
            waited = max(PATIENCE - self._spent, 0.0)
            self._timer = threading.Timer(waited, self._say, (announce.get(),))
            self._timer.daemon = True
            self._timer.start()

    def on_end(self, ended: Any) -> None:
        """Add the time of a finished compilation."""
        with self._lock:
            self._finished.add(name_of(ended.data["dispatcher"]))
            self._depth -= 1
            if self._depth == 0 and self._timer is not None:
                self._timer.cancel()
                self._timer = None
                self._spent += time.perf_counter() - self._began[0]
                self._cpu += time.process_time() - self._began[1]

    def _say(self, listener: Callable[[str], None] | None) -> None:
        """Emit the message; the time assumes the CPU load so far."""
        with self._lock:
            if self._said:
                return
            loops, finished = list(self._loops.values()), frozenset(self._finished)
            wall, cpu = self._spent, self._cpu
            if self._depth:
                wall += time.perf_counter() - self._began[0]
                cpu += time.process_time() - self._began[1]
        busy = max(wall / cpu, 1.0) if cpu > 0.0 else 1.0
        work = max(work_left(loops, finished), work_left(self._elsewhere, ()))
        if busy * SECONDS * work < PATIENCE:  # nearly over
            return
        self._said = True
        seconds = max(busy * SECONDS * work, 1.0)
        end = time.monotonic() + seconds
        if end - self._end < NEWS * seconds:  # about as reported
            return
        self._end = end
        kept = "; cached for later runs" if all(map(is_kept, loops)) else ""
        line = f"compiling, about {duration(seconds)}{kept}"
        (listener or logging.getLogger("airlight").warning)(line)


#: Listener of this process.
FIRST_COMPILATION: Final = FirstCompilation()
event.register("numba:compile", FIRST_COMPILATION)
