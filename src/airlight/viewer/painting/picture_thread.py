"""Render thread of the window: always renders the latest request."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial

from airlight.kernel.memory import give_back
from airlight.viewer.background.latest_thread import LatestThread
from airlight.viewer.painting.picture_source import Picture, PictureSource, Request


class PictureThread(LatestThread[Request]):
    """Thread that runs a renderer on the latest request.

    Parameters
    ----------
    renderer : PictureSource
        Called on the thread only, and closed there.
    wake : callable
        Function without arguments, called on the thread after each new picture.

    Attributes
    ----------
    picture : Picture or None
        Latest picture, possibly of an older request.
    """

    def __init__(self, renderer: PictureSource, wake: Callable[[], None]) -> None:
        self._renderer = renderer
        self.picture: Picture | None = None
        super().__init__("airlight-pictures", wake)

    def want(self, request: Request) -> None:
        """Set the latest request, unless it is the same and not dropped; returns immediately."""
        if self._dropped or not request.same(self._wanted):
            super().want(request)

    def serve(self, request: Request) -> None:
        """Render pictures of a request until it is stale."""
        for picture in self._renderer.render(request, partial(self.is_stale, request)):
            self.picture = picture
            self._wake()
            if self.is_stale(request):
                return
        give_back()  # shaders and tables left gaps

    def end(self) -> None:
        """Close the renderer."""
        self._renderer.close()
