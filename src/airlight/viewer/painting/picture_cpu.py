"""Pictures rendered by the processor: a coarse one at once, then finer ones.

The first is small enough to take about a twentieth of a second, the next are larger, the last has
all pixels. A new request interrupts all but the first.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from time import perf_counter
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from airlight.color.display import to_display
from airlight.color.exposure import automatic_exposure
from airlight.render import render
from airlight.viewer.painting.picture_source import Picture, Request, scaled
from airlight.viewer.painting.picture_texture import Canvases

#: Time for the first picture of a new view, which limits its size. [s]
_AT_ONCE: Final = 0.05
#: Factor of the pixels per side from one picture to the next. [1]
_STEP: Final = 3.0
#: Scale of the smallest picture; fewer pixels per side show nothing. [1]
_SMALLEST: Final = 1.0 / 12.0
#: Speed assumed until one has been measured. [pixel s⁻¹]
_FIRST_GUESS: Final = 2e5


class CpuPainter:
    """Painter that calls ``airlight.render.render``.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Device that holds the pictures.
    """

    def __init__(self, device: Any) -> None:
        self._canvases = Canvases(device)
        self._rate = _FIRST_GUESS
        self._last: tuple[Request, NDArray[np.float32]] | None = None  # finished, with its radiance

    def paint(
        self, request: Request, stale: Callable[[], bool], *, coarse: bool = True
    ) -> Iterator[Picture]:
        """See ``Painter.paint``; without ``coarse``, only the last picture is made."""
        if self._last is not None and request.same_light(self._last[0]):
            yield self._shown(request, self._last[1], perf_counter(), finished=True)
            self._last = (request, self._last[1])
            return
        for step, part in enumerate(self._parts(request) if coarse else [1.0]):
            started = perf_counter()
            scene = scaled(request.scene, part)
            # The first, coarse picture is never interrupted: in flight, each is stale quickly.
            stop = None if step == 0 and part < 1.0 else stale
            light = render(request.solution, scene, orders=request.orders, cancel=stop).rgb
            seconds = max(perf_counter() - started, 1e-6)
            self._rate = scene.camera.width * scene.camera.height / seconds
            yield self._shown(request, light, started, finished=part == 1.0)
        self._last = (request, light)

    def _parts(self, request: Request) -> Iterator[float]:
        camera = request.scene.camera
        part = (self._rate * _AT_ONCE / (camera.width * camera.height)) ** 0.5
        part = max(part, _SMALLEST)
        while part < 0.7:
            yield part
            part *= _STEP
        yield 1.0

    def _shown(
        self, request: Request, light: NDArray[np.float32], started: float, *, finished: bool
    ) -> Picture:
        exposure = request.exposure
        if request.automatic:
            exposure += automatic_exposure(light, request.tone_map)
        exposure = min(max(exposure, -100.0), 100.0)
        pixels = to_display(light, exposure=exposure, tone_map=request.tone_map)
        texture = self._canvases.next()
        texture.write(pixels)
        return Picture(
            view=texture.view,
            width=pixels.shape[1],
            height=pixels.shape[0],
            request=request,
            exposure=exposure,
            finished=finished,
            seconds=perf_counter() - started,
            by="processor",
        )

    def close(self) -> None:
        """See ``Painter.close``."""
