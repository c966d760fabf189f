"""Render thread of the window: always renders the latest request."""

from __future__ import annotations

import threading
from collections.abc import Callable

from airlight.errors import Cancelled
from airlight.viewer.background.error_line import one_line
from airlight.viewer.painting.picture_source import Picture, PictureSource, Request


class PictureThread:
    """Thread that runs a renderer on the latest request.

    Parameters
    ----------
    renderer : PictureSource
        Called on the thread only, and closed there.
    wake : callable
        Function without arguments, called on the thread after each new picture.
    """

    def __init__(self, renderer: PictureSource, wake: Callable[[], None]) -> None:
        self._renderer = renderer
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
        """Set the latest request; returns immediately."""
        with self._news:
            if request.same(self._wanted):
                return
            self._wanted = request
            self._working = True
            self._news.notify()

    @property
    def picture(self) -> Picture | None:
        """Latest picture, possibly of an older request."""
        return self._picture

    @property
    def busy(self) -> bool:
        """Whether a newer or finer picture is pending."""
        with self._news:
            return self._working

    @property
    def error(self) -> str:
        """One-line error of the request; empty if it succeeded."""
        return self._error

    def close(self) -> None:
        """End the thread and wait for it."""
        with self._news:
            self._closing = True
            self._news.notify()
        self._thread.join()

    def _work(self) -> None:
        last: Request | None = None
        while True:
            request = self._next(last)
            if request is None:
                self._renderer.close()
                return
            error = ""
            try:
                self._paint(request)
            except Cancelled:
                pass
            except Exception as failure:
                # The thread must survive any failure of one picture, to render the next.
                error = one_line(failure)
            last = request
            with self._news:
                self._error = error
                self._working = self._wanted is not request
            self._wake()

    def _next(self, last: Request | None) -> Request | None:
        """Wait for a request other than the last; None when the thread is closing."""
        with self._news:
            while not self._closing and (self._wanted is None or self._wanted is last):
                self._news.wait()
            return None if self._closing else self._wanted

    def _paint(self, request: Request) -> None:
        def stale() -> bool:
            return self._closing or self._wanted is not request

        for picture in self._renderer.render(request, stale):
            self._picture = picture
            self._wake()
            if stale():
                return
