"""Pictures by the graphics device: drawn anew in every frame that needs it, as they are shown.

A device in software draws with a coarse table of the sky while something moves, and with the fine
one when all has been still for a moment. What the shaders have no room for is left to the
processor.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from time import perf_counter
from typing import Final

from airlight.color.exposure import automatic_exposure
from airlight.errors import AirlightError
from airlight.gpu.device import Device
from airlight.gpu.pictures import QUICK_SKY_SHAPE, SKY_SHAPE, Pictures
from airlight.viewer.picture_cpu import CpuPictures
from airlight.viewer.picture_source import Picture, Request, scaled
from airlight.viewer.picture_texture import PictureTexture

#: After so long without a change the fine table is drawn. [s]
_STILL: Final = 0.2
#: Automatic exposure is measured on a picture of so many pixels a side.
_MEASURED: Final = 96.0


class GpuPictures:
    """Pictures by ``airlight.gpu.pictures.Pictures``.

    Parameters
    ----------
    device : Device
    wake : callable
        Called from any thread when there is something new to draw.
    """

    def __init__(self, device: Device, wake: Callable[[], None]) -> None:
        self._device = device
        self._wake = wake
        self._pictures = Pictures(device, QUICK_SKY_SHAPE if device.software else SKY_SHAPE)
        self._texture = PictureTexture(device.device)
        self._wanted: Request | None = None
        self._changed = 0.0
        self._shown: Picture | None = None
        self._loaded: object = None
        self._refused: object = None
        self._fallback: CpuPictures | None = None
        self._error = ""

    @property
    def name(self) -> str:
        """Who computes, in a few words."""
        if self._leaves_it:
            return "processor"
        return "GPU in software" if self._device.software else "GPU"

    @property
    def _leaves_it(self) -> bool:
        """Whether the processor draws what is wanted."""
        return self._wanted is not None and self._wanted.solution is self._refused

    def want(self, request: Request) -> None:
        """See ``PictureSource``."""
        if request.same(self._wanted):
            return
        if self._wanted is None or request.solution is not self._wanted.solution:
            self._prepare(request)
        self._wanted = request
        self._changed = perf_counter()
        if self._leaves_it:
            self._processor().want(request)

    def _prepare(self, request: Request) -> None:
        """Begin to pack a solution's tables on another thread: the window does not wait."""
        solution = request.solution

        def pack() -> None:
            try:
                _ = solution.light
            finally:
                self._wake()

        if "light" not in solution.__dict__:
            threading.Thread(target=pack, name="airlight-packing", daemon=True).start()

    def picture(self) -> Picture | None:
        """See ``PictureSource``."""
        request = self._wanted
        if request is None:
            return None
        if self._leaves_it:
            return self._processor().picture()
        if "light" not in request.solution.__dict__:
            return self._shown
        fine = not self._device.software or perf_counter() - self._changed > _STILL
        done = self._shown is not None and request.same(self._shown.request)
        if done and self._shown is not None and (self._shown.finished or not fine):
            return self._shown
        try:
            self._draw(request, fine)
            self._error = ""
        except AirlightError as error:
            if request.solution is self._loaded:
                self._error = str(error)
                return self._shown
            # The solution has no room on the device: too many wavelengths or constituents.
            self._refused = request.solution
            self._processor().want(request)
        return self._shown

    def _draw(self, request: Request, fine: bool) -> None:
        started = perf_counter()
        pictures = self._pictures
        if request.solution is not self._loaded:
            pictures.show(request.solution)
            self._loaded = request.solution
        shape = SKY_SHAPE if fine else QUICK_SKY_SHAPE
        if pictures.sky_shape != shape:
            pictures.sky_shape = shape
        exposure = self._exposure(request)
        camera = request.scene.camera
        self._texture.resize(camera.width, camera.height)
        pictures.draw(
            request.scene,
            self._texture.view,
            self._texture.form,
            orders=request.orders,
            exposure=exposure,
            tone_map=request.tone_map,
        )
        self._shown = Picture(
            view=self._texture.view,
            width=camera.width,
            height=camera.height,
            request=request,
            exposure=exposure,
            finished=fine,
            seconds=perf_counter() - started,
        )

    def _exposure(self, request: Request) -> float:
        exposure = request.exposure
        if request.automatic:
            old = self._shown
            if old is not None and request.same_light(old.request) and old.request.automatic:
                exposure += old.exposure - old.request.exposure
            else:
                camera = request.scene.camera
                small = scaled(request.scene, min(1.0, _MEASURED / camera.width))
                frame = self._pictures.frame(small, orders=request.orders)
                exposure += automatic_exposure(frame.rgb, request.tone_map)
        return min(max(exposure, -100.0), 100.0)

    def _processor(self) -> CpuPictures:
        if self._fallback is None:
            self._fallback = CpuPictures(self._device.device, self._wake)
        return self._fallback

    @property
    def busy(self) -> bool:
        """See ``PictureSource``."""
        if self._leaves_it:
            return self._processor().busy
        shown, wanted = self._shown, self._wanted
        if wanted is None or self._error:
            return False
        return shown is None or not shown.finished or not wanted.same(shown.request)

    @property
    def needs_frames(self) -> bool:
        """See ``PictureSource``."""
        return self.busy and not self._leaves_it

    @property
    def error(self) -> str:
        """See ``PictureSource``."""
        if self._leaves_it:
            return self._processor().error
        return self._error

    def close(self) -> None:
        """See ``PictureSource``."""
        if self._fallback is not None:
            self._fallback.close()
