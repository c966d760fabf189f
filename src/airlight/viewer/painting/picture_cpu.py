"""Pictures by the processor: coarse at once, finer behind it.

The first is so small that it takes about a twentieth of a second, the next are larger, the last
has all pixels. What is wanted anew interrupts all but the first.
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

#: The first picture of a new view is as large as this allows. [s]
_AT_ONCE: Final = 0.05
#: Each next one has so many times the pixels a side.
_STEP: Final = 3.0
#: Smallest picture: fewer pixels a side show nothing. [1]
_SMALLEST: Final = 1.0 / 12.0
#: Speed assumed before one was measured. [pixel s⁻¹]
_FIRST_GUESS: Final = 2e5


class CpuPainter:
    """Pictures by ``airlight.render.render``.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Shows them.
    """

    def __init__(self, device: Any) -> None:
        self._canvases = Canvases(device)
        self._rate = _FIRST_GUESS
        self._last: tuple[Request, NDArray[np.float32]] | None = None  # finished, with its light

    def paint(
        self, request: Request, stale: Callable[[], bool], *, coarse: bool = True
    ) -> Iterator[Picture]:
        """See ``Painter``; without ``coarse`` only the last picture is made."""
        if self._last is not None and request.same_light(self._last[0]):
            yield self._shown(request, self._last[1], perf_counter(), finished=True)
            self._last = (request, self._last[1])
            return
        for step, part in enumerate(self._parts(request) if coarse else [1.0]):
            started = perf_counter()
            scene = scaled(request.scene, part)
            # The first, coarse picture is never interrupted: in flight every one is soon stale.
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
        """See ``Painter``."""
