"""``SideRenderer``: progressive frames of one side of the window, displayed in textures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from time import perf_counter, sleep
from typing import TYPE_CHECKING, Any, Final

from airlight.geometry.ephemeris.world import WORLDS
from airlight.image.exposure import MOST_EXPOSURE, exposure_factor
from airlight.image.white_balance import scene_white
from airlight.render.live_frame import LiveFrame
from airlight.render.live_renderer import LiveRenderer
from airlight.render.live_system_renderer import LiveSystemRenderer
from airlight.render.star_points import add_catalogue
from airlight.scene.metering import METERED
from airlight.scene.projections import PROJECTIONS
from airlight.viewer.painting.picture_source import Picture, Request
from airlight.viewer.painting.picture_texture import Canvases

if TYPE_CHECKING:
    from airlight.render.clouds.lit_clouds import LitClouds

#: Interval between pictures while the exposure adapts. [s]
_PAUSE: Final = 1.0 / 60.0
#: Exposure from which stars are drawn, by eye: that of late civil dusk. [EV]
_STARRY: Final = 3.0


class SideRenderer:
    """``PictureSource`` that displays the steps of a live renderer.

    Parameters
    ----------
    device : wgpu.GPUDevice
        Device of the textures.
    renderer : LiveRenderer or LiveSystemRenderer
        Renderer of a planet or of a scene of several bodies, which this object closes.
    """

    def __init__(self, device: Any, renderer: LiveRenderer | LiveSystemRenderer) -> None:
        self._canvases = Canvases(device)
        self._renderer: Any = renderer
        self._measured: tuple[Request, float] | None = None
        self._exposed: object = None  # solution of the last picture
        self._moved: tuple[Request, LitClouds] | None = None

    def render(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        """See ``PictureSource.render``."""
        picture: Picture | None = None
        more: dict[str, Any] = {}
        if request.clouds is None:
            self._moved = None  # hundreds of megabytes
        if request.system:
            more = {"system": request.system, "body": request.body}
        elif request.clouds is not None:
            more = {"clouds": self._clouds_of(request)}
        for step in self._renderer.live(
            request.solution, request.scene, orders=request.orders, stale=stale, **more
        ):
            picture = self._displayed(request, step)
            yield _before_stars(picture)
        while picture is not None and step.finished and not (picture.finished or stale()):
            # Final radiance, while the exposure still adapts.
            sleep(_PAUSE)
            picture = self._displayed(request, step)
            yield _before_stars(picture)
        if picture is not None and picture.finished and shows_stars(picture) and not stale():
            yield self._starry(step, picture)

    def _clouds_of(self, request: Request) -> LitClouds:
        """Clouds where the wind has moved them; the same object for the same request."""
        assert request.clouds is not None
        if self._moved is None or not request.same_light(self._moved[0]):
            self._moved = request, request.clouds.at(request.scene, request.cloud_time)
        return self._moved[1]

    def close(self) -> None:
        """See ``PictureSource.close``."""
        self._renderer.close()

    def _displayed(self, request: Request, step: LiveFrame) -> Picture:
        started, camera = perf_counter(), step.scene.camera
        metered = self._metered(request, step)
        exposure, settled = self._exposure(request, metered)
        self._exposed = request.solution
        texture = self._canvases.next()
        if step.frame is None:
            texture.resize(camera.width, camera.height)
            white = None
            if request.display.white_balance == "scene":
                white = scene_white(step.metered(METERED).rgb, exposure_factor(exposure))
            step.display(
                texture.view, exposure=exposure, settings=request.display, scene_white=white
            )
            texture.wait()
        else:
            texture.write(request.displayed(step.frame, exposure))
        return Picture(
            view=texture.view,
            width=camera.width,
            height=camera.height,
            request=request,
            exposure=exposure,
            finished=step.finished and settled,
            seconds=step.seconds + perf_counter() - started,
            by=step.by,
            metered=metered,
        )

    def _starry(self, step: LiveFrame, picture: Picture) -> Picture:
        """Final picture with the star catalogue and the Milky Way."""
        started, request = perf_counter(), picture.request
        frame = step.frame
        if frame is None:
            assert step.renderer is not None
            frame = step.renderer.render(step.scene, orders=step.orders)
        frame = replace(frame, rgb=frame.rgb.copy())  # the CPU's is kept by its renderer
        planet = request.solution.planet
        body = None if planet is None else planet.body
        clouds = None if request.clouds is None else self._clouds_of(request)
        add_catalogue(frame.rgb, step.scene, request.solution, body, clouds)
        texture = self._canvases.next()
        texture.write(request.displayed(frame, picture.exposure))
        seconds = picture.seconds + perf_counter() - started
        return replace(picture, view=texture.view, seconds=seconds)

    def _exposure(self, request: Request, metered: float | None) -> tuple[float, bool]:
        """Exposure of a step [EV], and whether it has settled."""
        exposure, settled, adaptation = request.exposure, True, request.adaptation
        if request.automatic and metered is not None:
            if adaptation is None:
                exposure += metered
            else:
                # Eased, an edited planet would be shown too bright or too dark first.
                edited = request.solution is not self._exposed
                exposure += adaptation.towards(metered, held=request.held, at_once=edited)
                settled = request.held or adaptation.reached(metered)
        return min(max(exposure, -MOST_EXPOSURE), MOST_EXPOSURE), settled

    def _metered(self, request: Request, step: LiveFrame) -> float | None:
        """Metered exposure if it is needed, cached as the GPU has to render for it. [EV]"""
        if not (request.automatic or request.meters):
            return None
        if step.frame is not None:
            return step.frame.exposure
        if self._measured is not None:
            before, measured = self._measured
            if request.same_light(before):
                return measured
        measured = step.metered(METERED).exposure
        self._measured = request, measured
        return measured


def shows_stars(picture: Picture) -> bool:
    """Whether a finished picture gets stars: it is dark, and the sky of its planet is known."""
    planet, camera = picture.request.solution.planet, picture.request.scene.camera
    known = planet is not None and planet.body in WORLDS
    return (
        known
        and picture.request.system is None  # which has its own
        and picture.exposure >= _STARRY
        and picture.request.orders == "all"
        and not PROJECTIONS[camera.projection].parallel
    )


def _before_stars(picture: Picture) -> Picture:
    """Picture that is not the last if stars follow."""
    return replace(picture, finished=picture.finished and not shows_stars(picture))
