"""A thread that paints what is wanted last, so that the window never waits for a picture."""

from __future__ import annotations

import threading
from collections.abc import Callable

from airlight.errors import Cancelled
from airlight.viewer.background.error_line import one_line
from airlight.viewer.painting.picture_source import Painter, Picture, Request


class PictureThread:
    """Pictures by a painter, on a thread of their own.

    Parameters
    ----------
    painter : Painter
    wake : callable
        Called from the thread whenever there is a new picture.
    """

    def __init__(self, painter: Painter, wake: Callable[[], None]) -> None:
        self._painter = painter
        self._wake = wake
        self._news = threading.Condition()
        self._wanted: Request | None = None
        self._picture: Picture | None = None
        self._closing = False
        self._working = False
        self._error = ""
        self._thread = threading.Thread(target=self._work, name="airlight-pictures", daemon=True)
        self._thread.start()

    def want(self, request: Request) -> None:
        """Say what is to be shown from now on; returns at once."""
        with self._news:
            if request.same(self._wanted):
                return
            self._wanted = request
            self._working = True
            self._news.notify()

    @property
    def picture(self) -> Picture | None:
        """The newest picture, which may lag behind what is wanted."""
        return self._picture

    @property
    def busy(self) -> bool:
        """Whether a newer or finer picture will follow."""
        with self._news:
            return self._working

    @property
    def error(self) -> str:
        """Why there is no picture of what is wanted, in one line; empty if there is."""
        return self._error

    def close(self) -> None:
        """End the thread."""
        with self._news:
            self._closing = True
            self._news.notify()
        self._thread.join()

    def _work(self) -> None:
        last: Request | None = None
        while True:
            request = self._next(last)
            if request is None:
                self._painter.close()
                return
            error = ""
            try:
                self._paint(request)
            except Cancelled:
                pass
            except Exception as failure:
                # Whatever goes wrong with one picture, the next must find the thread alive.
                error = one_line(failure)
            last = request
            with self._news:
                self._error = error
                self._working = self._wanted is not request
            self._wake()

    def _next(self, last: Request | None) -> Request | None:
        """Wait for a request other than the last; None at the end."""
        with self._news:
            while not self._closing and (self._wanted is None or self._wanted is last):
                self._news.wait()
            return None if self._closing else self._wanted

    def _paint(self, request: Request) -> None:
        def stale() -> bool:
            return self._closing or self._wanted is not request

        for picture in self._painter.paint(request, stale):
            self._picture = picture
            self._wake()
            if stale():
                return
