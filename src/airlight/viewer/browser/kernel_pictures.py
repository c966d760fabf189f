"""Rendering in the notebook's kernel, for browsers without a GPU."""

from __future__ import annotations

import io
import queue
import threading
from collections.abc import Callable, Mapping
from typing import Any, Final, NamedTuple

import numpy as np
from numpy.typing import NDArray

from airlight.image.display import to_display
from airlight.render.live_renderer import LiveRenderer
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.background.error_line import one_line
from airlight.viewer.background.preparing import Preparing
from airlight.viewer.parameters.parameter import Value
from airlight.viewer.parameters.view_parameters import scene_of

#: Largest exposure, either way. [EV]
_MOST: Final = 100.0


class Order(NamedTuple):
    """Frame request of a browser.

    Attributes
    ----------
    number : int
        Number of the request, repeated in the answer.
    view : mapping
        View values by path.
    size : (int, int)
        Width and height. [pixel]
    """

    number: int
    solution: MomentsSolution
    view: Mapping[str, Value]
    size: tuple[int, int]


class KernelPictures:
    """Thread that renders requested frames in order.

    Parameters
    ----------
    answer : callable
        ``answer(rendered)``, called on the thread: ``number``, and ``png`` with ``exposure`` [EV],
        or an ``error`` of one line.
    """

    def __init__(self, answer: Callable[[dict[str, Any]], None]) -> None:
        self._answer = answer
        self._orders: queue.SimpleQueue[Order | None] = queue.SimpleQueue()
        self._closing = False
        self._thread: threading.Thread | None = None
        self._drew = False
        self.preparing: Preparing | None = None

    def prepare(self, wake: Callable[[], None]) -> None:
        """Compile the renderer in another process, so that this one remains responsive.

        Parameters
        ----------
        wake : callable
            Called from any thread, a few times a second, while there is progress.
        """
        if self.preparing is None:
            self.preparing = Preparing(wake)

    @property
    def waits(self) -> bool:
        """Whether the first frame waits for compilation."""
        preparing = self.preparing
        return preparing is not None and not self._drew and preparing.share < 1.0

    def ask(self, order: Order) -> None:
        """Queue a frame request; returns immediately."""
        if self._thread is None:
            self._thread = threading.Thread(
                target=self._work, name="airlight-pictures", daemon=True
            )
            self._thread.start()
        self._orders.put(order)

    def close(self) -> None:
        """Cancel the current frame and end the thread."""
        self._closing = True
        self._orders.put(None)
        if self._thread is not None and self._thread is not threading.current_thread():
            self._thread.join()
        if self.preparing is not None:
            self.preparing.close()

    def _work(self) -> None:
        preparing = self.preparing
        renderer = LiveRenderer(compiler=None if preparing is None else preparing.compiler)
        while (order := self._orders.get()) is not None and not self._closing:
            try:
                rendered = self._rendered(renderer, order)
            except Exception as failure:
                # The thread must survive any failure of one picture, to render the next.
                rendered = {"error": one_line(failure)}
            if preparing is not None and not self._drew:
                preparing.finish()
            self._drew = True
            if not self._closing:
                self._answer({"number": order.number, **rendered})
        renderer.close()

    def _rendered(self, renderer: LiveRenderer, order: Order) -> dict[str, Any]:
        view, scene = order.view, scene_of(order.view, *order.size)
        frame = renderer.still(
            order.solution, scene, orders=str(view["light.orders"]), cancel=lambda: self._closing
        )
        exposure = float(view["display.exposure"])
        if view["display.automatic"]:
            exposure += frame.exposure
        exposure = min(max(exposure, -_MOST), _MOST)
        eye, glare = bool(view["display.eye"]), float(view["display.glare"])
        tone_map = str(view["display.tone_map"])
        shown = to_display(frame.rgb, exposure, tone_map, eye=eye, glare=glare, **frame.lens)
        return {"exposure": exposure, "png": _png(shown)}


def _png(pixels: NDArray[np.uint8]) -> bytes:
    """PNG of 8-bit pixels, with fast compression."""
    from PIL import Image

    file = io.BytesIO()
    Image.fromarray(pixels).save(file, "PNG", compress_level=1)
    return file.getvalue()
