"""Painter of a side of the window: steps of a live picture, exposed, as textures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from time import perf_counter
from typing import Any, Final

from airlight.color.display import to_display
from airlight.color.exposure import automatic_exposure
from airlight.paint.scene_painter import LivePicture, ScenePainter
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.painting.picture_texture import Canvases

#: Width of the picture on which automatic exposure is measured, where a device draws. [pixel]
_MEASURED: Final = 96.0
#: Largest exposure, either way. [EV]
_MOST: Final = 100.0


class PicturePainter:
    """``Painter`` that asks a ``ScenePainter`` for each step.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Device that holds the pictures.
    painter : ScenePainter
        Policy of who draws; it is closed with this painter.
    """

    def __init__(self, device: Any, painter: ScenePainter) -> None:
        self._canvases = Canvases(device)
        self._painter = painter
        self._measured: tuple[Request, float] | None = None

    def paint(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        """See ``Painter.paint``."""
        for step in self._painter.live(
            request.solution, request.scene, orders=request.orders, stale=stale
        ):
            yield self._shown(request, step)

    def close(self) -> None:
        """See ``Painter.close``."""
        self._painter.close()

    def _shown(self, request: Request, step: LivePicture) -> Picture:
        started, camera = perf_counter(), step.scene.camera
        exposure = self._exposure(request, step)
        texture = self._canvases.next()
        if step.frame is None:
            texture.resize(camera.width, camera.height)
            step.draw(
                texture.view, exposure=exposure, tone_map=request.tone_map,
                uniforms=request.uniforms,
            )  # fmt: skip
            texture.wait()
        else:
            texture.write(to_display(step.frame.rgb, exposure=exposure, tone_map=request.tone_map))
        return Picture(
            view=texture.view,
            width=camera.width,
            height=camera.height,
            request=request,
            exposure=exposure,
            finished=step.finished,
            seconds=step.seconds + perf_counter() - started,
            by=step.by,
        )

    def _exposure(self, request: Request, step: LivePicture) -> float:
        """Exposure of a step, with the automatic one if that is on. [EV]"""
        exposure = request.exposure
        if request.automatic:
            exposure += self._automatic(request, step)
        return min(max(exposure, -_MOST), _MOST)

    def _automatic(self, request: Request, step: LivePicture) -> float:
        """Measured exposure; a device draws for it, so that of the same light is kept. [EV]"""
        if step.frame is not None:
            return automatic_exposure(step.frame.rgb, request.tone_map)
        if self._measured is not None:
            before, measured = self._measured
            if request.same_light(before) and request.tone_map == before.tone_map:
                return measured
        measured = automatic_exposure(step.linear(_MEASURED), request.tone_map)
        self._measured = request, measured
        return measured
