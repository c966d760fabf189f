"""Cache in memory: the last values by key, shared by threads."""

from __future__ import annotations

import threading
import time
from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Any, Generic, TypeVar

Key = TypeVar("Key", bound=Hashable)
Value = TypeVar("Value")


class Cache(Generic[Key, Value]):
    """Values of the keys that were used last; pickled and copied empty.

    Parameters
    ----------
    maxsize : int
        Largest number of values.
    seconds : float
        Time since the last use for which values are kept beyond that number. [s]

    Examples
    --------
    >>> squares: Cache[int, int] = Cache(2)
    >>> [squares.of(n, lambda n=n: n * n) for n in (1, 2, 1, 3)]
    [1, 4, 1, 9]
    >>> 1 in squares, 2 in squares, len(squares)
    (True, False, 2)
    """

    def __init__(self, maxsize: int, seconds: float = 0.0) -> None:
        self._maxsize = maxsize
        self._seconds = seconds
        self._values: OrderedDict[Key, Value] = OrderedDict()
        self._used: dict[Key, float] = {}
        self._lock = threading.Lock()

    def __reduce__(self) -> tuple[Any, ...]:
        return Cache, (self._maxsize, self._seconds)

    def __len__(self) -> int:
        return len(self._values)

    def __contains__(self, key: Key) -> bool:
        return key in self._values

    def get(self, key: Key) -> Value | None:
        """Value of a key, which counts as used; None if it is not there."""
        with self._lock:
            if key in self._values:
                self._use(key)
            return self._values.get(key)

    def put(self, key: Key, value: Value) -> Value:
        """Keep a value, and forget those that were not used for longest."""
        with self._lock:
            self._values[key] = value
            self._use(key)
            while len(self._values) > self._maxsize:
                oldest = next(iter(self._values))
                if self._used[oldest] > self._used[key] - self._seconds:
                    break
                del self._values[oldest], self._used[oldest]
        return value

    def _use(self, key: Key) -> None:
        self._values.move_to_end(key)
        self._used[key] = time.monotonic()

    def of(self, key: Key, make: Callable[[], Value]) -> Value:
        """Value of a key, made outside the lock if it is not there."""
        found = self.get(key)
        return self.put(key, make()) if found is None else found

    def clear(self) -> None:
        """Forget every value."""
        with self._lock:
            self._values.clear()
            self._used.clear()
