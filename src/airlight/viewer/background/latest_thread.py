"""Thread that always serves the latest request."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Generic, TypeVar

from airlight.errors import Cancelled
from airlight.viewer.background.error_line import one_line

T = TypeVar("T")


class LatestThread(Generic[T]):
    """Thread whose requests supersede older ones; subclasses serve them.

    Parameters
    ----------
    name : str
        Name of the thread.
    wake : callable
        Function without arguments, called on the thread after each result.

    Attributes
    ----------
    error : str
        One-line error of the request served last; empty if it succeeded.
    """

    def __init__(self, name: str, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._news = threading.Condition()
        self._wanted: T | None = None
        self._served: T | None = None
        self._dropped = False
        self._closing = False
        self.error = ""
        self._thread = threading.Thread(target=self._work, name=name, daemon=True)
        self._thread.start()

    def serve(self, request: T, /) -> None:
        """Answer a request, on the thread."""
        raise NotImplementedError

    def end(self) -> None:
        """Release what the thread holds, at its end."""

    def want(self, request: T) -> None:
        """Set the latest request; returns immediately."""
        with self._news:
            self._wanted, self._dropped = request, False
            self._news.notify()

    def drop(self) -> None:
        """End what is served, without another request."""
        with self._news:
            self._dropped |= self._wanted is not self._served

    @property
    def busy(self) -> bool:
        """Whether the latest request is not served yet."""
        with self._news:
            return self._wanted is not self._served

    def is_stale(self, request: T) -> bool:
        """Whether a request is superseded or dropped, or the thread is closing."""
        return self._closing or self._dropped or self._wanted is not request

    def close(self, *, wait: bool = True) -> None:
        """End the thread, and wait for it."""
        with self._news:
            self._closing = True
            self._news.notify()
        if wait:
            self._thread.join()

    def _work(self) -> None:
        while True:
            with self._news:
                self._news.wait_for(lambda: self._closing or self._wanted is not self._served)
                request = self._wanted
                if self._closing or request is None:
                    break
            error = ""
            try:
                self.serve(request)
            except Cancelled:
                pass
            except Exception as failure:
                # The thread must survive any failure of one request, to serve the next.
                error = one_line(failure)
            with self._news:
                self.error, self._served = error, request
            self._wake()
        self.end()
