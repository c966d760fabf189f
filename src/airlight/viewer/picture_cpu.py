"""Pictures by the processor: coarse at once, finer behind it, never in the way of the window.

A thread renders what is wanted last: first so small that it takes about a twentieth of a second,
then larger, at last pixel by pixel. What is wanted anew interrupts it.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from dataclasses import replace
from time import perf_counter
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.color.display import to_display
from airlight.color.exposure import automatic_exposure
from airlight.errors import AirlightError, Cancelled
from airlight.render import render
from airlight.viewer.picture_source import Picture, Request, scaled
from airlight.viewer.picture_texture import PictureTexture

#: The first picture of a new view is as large as this allows. [s]
_AT_ONCE: Final = 0.05
#: Each next one has so many times the pixels a side.
_STEP: Final = 3.0
#: Smallest picture: fewer pixels a side show nothing. [1]
_SMALLEST: Final = 1.0 / 12.0
#: Speed assumed before one was measured. [pixel s⁻¹]
_FIRST_GUESS: Final = 2e5


class CpuPictures:
    """Pictures by ``airlight.render.render`` in a thread of their own.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Shows them.
    wake : callable
        Called from the thread whenever there is a new picture.
    """

    name = "processor"

    def __init__(self, device: Any, wake: Callable[[], None]) -> None:
        self._wake = wake
        self._texture = PictureTexture(device)
        self._news = threading.Condition()
        self._wanted: Request | None = None
        self._made: tuple[NDArray[np.uint8], Picture] | None = None
        self._shown: Picture | None = None
        self._closing = False
        self._working = False
        self._error = ""
        self._rate = _FIRST_GUESS
        self._thread = threading.Thread(target=self._work, name="airlight-pictures", daemon=True)
        self._thread.start()

    def want(self, request: Request) -> None:
        """See ``PictureSource``."""
        with self._news:
            if request.same(self._wanted):
                return
            self._wanted = request
            self._working = True
            self._news.notify()

    def picture(self) -> Picture | None:
        """See ``PictureSource``."""
        with self._news:
            made, self._made = self._made, None
        if made is not None:
            pixels, picture = made
            self._texture.write(pixels)
            self._shown = replace(picture, view=self._texture.view)
        return self._shown

    @property
    def busy(self) -> bool:
        """See ``PictureSource``."""
        with self._news:
            return self._working

    @property
    def needs_frames(self) -> bool:
        """See ``PictureSource``: the thread wakes the window."""
        return False

    @property
    def error(self) -> str:
        """See ``PictureSource``."""
        return self._error

    def close(self) -> None:
        """See ``PictureSource``."""
        with self._news:
            self._closing = True
            self._news.notify()
        self._thread.join()

    def _work(self) -> None:
        last: Request | None = None
        light: NDArray[np.float32] | None = None  # the frame of ``last``, of full size
        while True:
            request = self._next(last)
            if request is None:
                return
            try:
                if light is not None and request.same_light(last):
                    self._hand_over(request, light, finished=True, seconds=0.0)
                else:
                    light = self._refine(request)
                self._error = ""
            except Cancelled:
                light = None
            except AirlightError as error:
                self._error, light = str(error), None
            except Exception as error:
                self._error, light = f"{type(error).__name__}: {error}", None
            last = request
            with self._news:
                self._working = self._wanted is not request
            self._wake()

    def _next(self, last: Request | None) -> Request | None:
        """Wait for a request other than the last; None at the end."""
        with self._news:
            while not self._closing and (self._wanted is None or self._wanted is last):
                self._news.wait()
            return None if self._closing else self._wanted

    def _stale(self, request: Request) -> bool:
        return self._closing or self._wanted is not request

    def _refine(self, request: Request) -> NDArray[np.float32]:
        """Hand over finer and finer pictures; the finest one's light."""
        for step, part in enumerate(self._parts(request)):
            started = perf_counter()
            scene = scaled(request.scene, part)
            # The first, coarse picture is never interrupted: in flight every one is soon stale.
            stop = None if step == 0 and part < 1.0 else (lambda: self._stale(request))
            frame = render(request.solution, scene, orders=request.orders, cancel=stop).rgb
            seconds = perf_counter() - started
            self._rate = scene.camera.width * scene.camera.height / max(seconds, 1e-6)
            self._hand_over(request, frame, finished=part == 1.0, seconds=seconds)
        return frame

    def _parts(self, request: Request) -> Iterator[float]:
        camera = request.scene.camera
        part = (self._rate * _AT_ONCE / (camera.width * camera.height)) ** 0.5
        part = max(part, _SMALLEST)
        while part < 0.7:
            yield part
            part *= _STEP
        yield 1.0

    def _hand_over(
        self, request: Request, light: NDArray[np.float32], *, finished: bool, seconds: float
    ) -> None:
        exposure = request.exposure
        if request.automatic:
            exposure += automatic_exposure(light, request.tone_map)
        exposure = min(max(exposure, -100.0), 100.0)
        pixels = to_display(light, exposure=exposure, tone_map=request.tone_map)
        height, width = pixels.shape[:2]
        picture = Picture(
            view=None,
            width=width,
            height=height,
            request=request,
            exposure=exposure,
            finished=finished,
            seconds=seconds,
        )
        with self._news:
            self._made = (pixels, picture)
        self._wake()
