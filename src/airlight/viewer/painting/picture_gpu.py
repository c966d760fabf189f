"""Pictures rendered by the graphics device.

A software device renders from a coarse sky table while the view changes; after a short time
without changes, the processor renders the exact picture, which, unlike a long pass, leaves the
device free for the window. The processor also renders until the shaders are compiled, and for
solutions that exceed the shaders' capacity.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from time import perf_counter
from typing import Final

from airlight.color.exposure import automatic_exposure
from airlight.errors import Cancelled, ParameterError
from airlight.gpu.device.device import Device
from airlight.gpu.picture.pictures import QUICK_SKY_SHAPE, SKY_SHAPE, Pictures
from airlight.viewer.painting.picture_cpu import CpuPainter
from airlight.viewer.painting.picture_source import Picture, Request, scaled
from airlight.viewer.painting.picture_texture import Canvases

#: Time without a change after which the exact picture is rendered. [s]
_STILL: Final = 0.2
#: Width of the picture on which automatic exposure is measured. [pixel]
_MEASURED: Final = 96.0


class GpuPainter:
    """Painter that calls ``airlight.gpu.picture.pictures.Pictures``.

    Parameters
    ----------
    device : Device
        Hardware or software device that renders the pictures.
    """

    def __init__(self, device: Device) -> None:
        self._device = device
        self._pictures = Pictures(device, QUICK_SKY_SHAPE if device.software else SKY_SHAPE)
        self._canvases = Canvases(device.device)
        self._processor = CpuPainter(device.device)
        self._compiling: threading.Thread | None = None
        self._compiled = False
        self._loaded: object = None
        self._last: Picture | None = None
        self._exact: Request | None = None  # last rendered by the processor

    def paint(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        """See ``Painter.paint``."""
        if not self._compiled:
            yield from self._while_compiling(request, stale)
            if stale() or request is self._exact:
                return
        if not self._load(request):
            yield from self._processor.paint(request, stale)
            return
        if not self._device.software:
            yield self._painted(request, finished=True)
            return
        if self._exact is None or not request.same_light(self._exact):
            yield self._painted(request, finished=False)
            until = perf_counter() + _STILL
            while perf_counter() < until:
                if stale():
                    return
                time.sleep(0.02)
        yield from self._processor.paint(request, stale, coarse=False)
        self._exact = request

    def _while_compiling(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        if self._compiling is None:
            self._compiling = threading.Thread(
                target=self._compile, args=(request,), name="airlight-compiling", daemon=True
            )
            self._compiling.start()
        over = (lambda: False) if self._device.software else (lambda: self._compiled)
        try:
            yield from self._processor.paint(request, lambda: stale() or over())
            if self._device.software:
                self._exact = request
                return
        except Cancelled:
            if stale():
                raise
        while not self._compiled and not stale():
            time.sleep(0.02)

    def _compile(self, request: Request) -> None:
        """Render one very small picture, which compiles the shaders; this takes seconds."""
        try:
            if self._load(request):
                small = scaled(request.scene, 16.0 / request.scene.camera.width)
                texture = self._canvases.next()
                texture.resize(small.camera.width, small.camera.height)
                self._pictures.draw(small, texture.view, texture.form, exposure=0.0)
                self._pictures.frame(small)
        finally:
            self._compiled = True

    def _load(self, request: Request) -> bool:
        """Upload the request's solution; False if it exceeds the device's capacity."""
        if request.solution is self._loaded:
            return True
        try:
            self._pictures.show(request.solution)
        except ParameterError:  # too many wavelengths or constituents
            self._loaded = None
            return False
        self._loaded = request.solution
        return True

    def _painted(self, request: Request, *, finished: bool) -> Picture:
        started = perf_counter()
        pictures, camera = self._pictures, request.scene.camera
        exposure = self._exposure(request)
        texture = self._canvases.next()
        texture.resize(camera.width, camera.height)
        pictures.draw(
            request.scene,
            texture.view,
            texture.form,
            orders=request.orders,
            exposure=exposure,
            tone_map=request.tone_map,
            uniforms=request.uniforms,
        )
        texture.wait()
        self._last = Picture(
            view=texture.view,
            width=camera.width,
            height=camera.height,
            request=request,
            exposure=exposure,
            finished=finished,
            seconds=perf_counter() - started,
            by="GPU in software" if self._device.software else "GPU",
        )
        return self._last

    def _exposure(self, request: Request) -> float:
        if not request.automatic:
            return request.exposure
        last = self._last
        known = last is not None and last.request.automatic and request.same_light(last.request)
        if known and last is not None and last.request.tone_map == request.tone_map:
            return last.exposure - last.request.exposure + request.exposure
        camera = request.scene.camera
        small = scaled(request.scene, min(1.0, _MEASURED / camera.width))
        frame = self._pictures.frame(small, orders=request.orders)
        measured = automatic_exposure(frame.rgb, request.tone_map)
        return min(max(measured + request.exposure, -100.0), 100.0)

    def close(self) -> None:
        """See ``Painter.close``."""
        if self._compiling is not None:
            self._compiling.join()
        self._processor.close()
