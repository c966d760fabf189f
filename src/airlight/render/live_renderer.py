"""``LiveRenderer``: frames of a solution on the CPU or the GPU, progressively.

* The CPU renders where there is no GPU, or where the solution exceeds its capacity.
* Live frames of the CPU start coarse and become finer; a newer request interrupts all but the
  first.
* A live frame of a hardware GPU is rendered once, at full resolution.
* A software GPU renders smaller frames from a small sky-view LUT while the view changes, and still
  smaller ones while the planet is edited; after a short time without changes the CPU renders the
  final frame, which, unlike a long pass, leaves the GPU queue free for the window.
* The CPU renders three-dimensional clouds, beside a software GPU because it is twenty times faster
  there; its coarse frames have coarser tables. The loop that marches every pixel, which takes
  longest to compile, is for planets that are always marched.
* The CPU also renders while shaders are compiled, which takes seconds, unless its own loops are
  not compiled either, which takes longer (``render.background_compilation``): then a hardware GPU
  renders first. The first frame of a window has full resolution, as coarse frames need the loop
  that marches every pixel, which takes longer to compile or load.

All of them interpolate a sky-view LUT, unless an exact frame is requested.
"""

from __future__ import annotations

import gc
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import replace
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import Cancelled, ParameterError
from airlight.image.display_settings import DisplaySettings
from airlight.kernel.memory import give_back
from airlight.render import render
from airlight.render.background_compilation import (
    MARCH_LOOPS,
    SKY_VIEW_LOOPS,
    cloudy_loops,
    live_cloudy_compiler,
)
from airlight.render.live_frame import LIVE_FORMAT, LiveFrame
from airlight.render.pixels.sky_view_window import COARSEST
from airlight.render.pixels.view_uniforms import is_always_marched
from airlight.scene.picture_size import scaled

if TYPE_CHECKING:
    from airlight.kernel.background_compiler import BackgroundCompiler
    from airlight.kernel.threads import Cancel
    from airlight.render.clouds.lit_clouds import LitClouds
    from airlight.render.gpu.device.device import Device
    from airlight.render.gpu.picture.gpu_renderer import GpuRenderer
    from airlight.scene import Scene
    from airlight.scene.frame import Frame
    from airlight.solver.moments.solution import MomentsSolution

#: Time budget of the CPU's first frame of a new view. [s]
_AT_ONCE: Final = 0.05
#: Ratio of the pixels per side of successive frames. [1]
_STEP: Final = 3.0
#: Smallest scale of a coarse frame; and scale above which the next frame has full resolution. [1]
_SMALLEST: Final = 1.0 / 12.0
_NEARLY_WHOLE: Final = 0.7
#: Scale of frames of a software GPU, which the CPU's follows. [1]
_IN_SOFTWARE: Final = 0.6
#: Width of the first frame of an edited planet on a software GPU, which is metered itself. [pixel]
_EDITED: Final = 192
#: Initial estimate of the CPU's rendering speed. [pixel s⁻¹]
_FIRST_GUESS: Final = 2e5
#: Time without a change of view after which the CPU renders the final frame. [s]
_STILL: Final = 0.2
#: Polling interval. [s]
_POLL: Final = 0.02
#: Width of the frame that compiles the shaders: it has the bands of a larger frame. [pixel]
_SMALL: Final = 128.0


class LiveRenderer:
    """Renderer of successive frames, which reuses its GPU, shaders and textures.

    Parameters
    ----------
    device : Device, optional
        GPU, see ``rendering_gpu``; by default the CPU renders.
    compiler : BackgroundCompiler, optional
        Process that compiles the loops of the CPU; frames wait for it.
    """

    def __init__(
        self, device: Device | None = None, compiler: BackgroundCompiler | None = None
    ) -> None:
        self._device = device
        self._compiler = compiler
        self._gpu: GpuRenderer | None = None
        self._loaded: object = None
        self._compiling: threading.Thread | None = None
        self._compiled = device is None
        self._closing = False
        self._has_rendered = False
        self._rate = _FIRST_GUESS
        self._last: tuple[tuple[object, ...], LiveFrame] | None = None  # finished by the CPU
        self._cloudy_rate = _FIRST_GUESS

    def still(
        self, solution: MomentsSolution, scene: Scene, *, orders: str = "all", cancel: Cancel
    ) -> Frame:
        """Render a still frame on the CPU, once its loops are compiled.

        Parameters
        ----------
        solution, scene, orders, cancel :
            Arguments of ``airlight.render``.

        Raises
        ------
        Cancelled
            If ``cancel`` requested it.
        """
        if not self._are_compiled(SKY_VIEW_LOOPS, cancel):
            raise Cancelled("the frame")
        return render(solution, scene, orders=orders, cancel=cancel)

    def live(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        orders: str = "all",
        clouds: LitClouds | None = None,
        stale: Callable[[], bool],
    ) -> Iterator[LiveFrame]:
        """Render progressively, each frame finer than the last.

        Parameters
        ----------
        solution : MomentsSolution
            Solution of a planet.
        scene : Scene
            Observer, star and camera.
        orders : str
            Orders of scattering as for ``airlight.render``.
        clouds : LitClouds, optional
            Three-dimensional clouds.
        stale : callable
            ``stale()`` is True once the request is superseded; rendering may then stop.

        Yields
        ------
        LiveFrame
        """
        step = LiveFrame(scene=scene, orders=orders, finished=True)
        if clouds is not None:
            yield from self._cloudy(solution, clouds, step, stale)
            return
        if self._device is None:
            yield from self._on_cpu(solution, step, stale)
            return
        if not self._compiled:
            yield from self._while_compiling(solution, step, stale)
            if stale() or (self._device.software and self._is_rendered(solution, step)):
                return
        edited = self._loaded is not None and self._loaded is not solution
        if not self._upload(solution):
            yield from self._on_cpu(solution, step, stale)
            return
        software = self._device.software
        size = scaled(scene, _IN_SOFTWARE) if software else scene
        on_gpu = replace(step, scene=size, renderer=self._gpu, finished=not software)
        if on_gpu.finished:
            yield on_gpu
            return
        if not self._is_rendered(solution, step):
            yield self._small(on_gpu) if edited else on_gpu
            until = perf_counter() + _STILL
            while perf_counter() < until:
                if stale():
                    return
                time.sleep(_POLL)
        yield from self._on_cpu(solution, step, stale, coarse=False)

    def close(self) -> None:
        """Wait for the thread that compiles, if there is one."""
        self._closing = True
        if self._compiling is not None:
            self._compiling.join()

    # --- on the CPU ---------------------------------------------------------------------------

    def _on_cpu(
        self,
        solution: MomentsSolution,
        step: LiveFrame,
        stale: Callable[[], bool],
        *,
        coarse: bool = True,
    ) -> Iterator[LiveFrame]:
        if self._last is not None and self._is_rendered(solution, step):
            yield self._last[1]
            return
        if not self._are_compiled(SKY_VIEW_LOOPS, stale):
            raise Cancelled("a newer view")
        # Loading the loop that marches takes longer than the first frame at full resolution.
        coarse = coarse and (
            self._compiler is None or (self._has_rendered and self._are_compiled(MARCH_LOOPS))
        )
        self._has_rendered = True
        for number, part in enumerate(self._scales(step.scene, self._rate) if coarse else [1.0]):
            started = perf_counter()
            scene = scaled(step.scene, part)
            # The first, coarse frame is never interrupted: in flight every request is soon stale.
            stop = None if number == 0 and part < 1.0 else stale
            frame = render(solution, scene, orders=step.orders, cancel=stop)
            seconds = max(perf_counter() - started, 1e-6)
            self._rate = scene.camera.width * scene.camera.height / seconds
            done = replace(step, scene=scene, frame=frame, seconds=seconds, finished=part == 1.0)
            if done.finished:
                self._last = (solution, None), replace(done, seconds=0.0)
            yield done

    def _cloudy(
        self,
        solution: MomentsSolution,
        clouds: LitClouds,
        step: LiveFrame,
        stale: Callable[[], bool],
    ) -> Iterator[LiveFrame]:
        """Frames with clouds, each finer than the last; coarse ones are never interrupted."""
        if self._last is not None and self._is_rendered(solution, step, clouds):
            yield self._last[1]
            return
        from airlight.render.clouds.lit_clouds import QUICK, QUICK_SKY_VIEW

        kinds, marched = len(clouds.decks), is_always_marched(step.scene, solution)
        compiler = live_cloudy_compiler(kinds, marched=marched)
        if not all(compiler.wait(loop, stale) for loop in cloudy_loops(kinds, marched=marched)):
            raise Cancelled("a newer view")
        fine = replace(clouds, sky_view=COARSEST)
        quick = replace(clouds, directions=QUICK, sky_view=QUICK_SKY_VIEW)
        for part in self._scales(step.scene, self._cloudy_rate):
            started, finished = perf_counter(), part == 1.0
            scene = scaled(step.scene, part)
            frame = render(
                solution,
                scene,
                orders=step.orders,
                clouds=fine if finished else quick,
                cancel=stale if finished else None,
            )
            seconds = max(perf_counter() - started, 1e-6)
            if not finished:
                self._cloudy_rate = scene.camera.width * scene.camera.height / seconds
            done = replace(step, scene=scene, frame=frame, seconds=seconds, finished=finished)
            if finished:
                self._last = (solution, clouds), replace(done, seconds=0.0)
            yield done

    def _are_compiled(
        self, loops: tuple[Any, ...], stale: Callable[[], bool] = lambda: True
    ) -> bool:
        """Whether loops are compiled; waits until they are or the request is stale."""
        compiler = self._compiler
        return compiler is None or all(compiler.wait(loop, stale) for loop in loops)

    def _scales(self, scene: Scene, rate: float) -> Iterator[float]:
        """Scales of successive frames, at a rate. [pixel s⁻¹]"""
        camera = scene.camera
        part = (rate * _AT_ONCE / (camera.width * camera.height)) ** 0.5
        part = max(part, _SMALLEST)
        while part < _NEARLY_WHOLE:
            yield part
            part *= _STEP
        yield 1.0

    def _is_rendered(
        self, solution: MomentsSolution, step: LiveFrame, clouds: LitClouds | None = None
    ) -> bool:
        """Whether the CPU's last final frame has the same solution, clouds, scene and orders."""
        if self._last is None:
            return False
        (of, cloudy), last = self._last
        same = of is solution and cloudy is clouds
        return same and last.orders == step.orders and last.scene == step.scene

    # --- on the GPU ---------------------------------------------------------------------------

    @staticmethod
    def _small(step: LiveFrame) -> LiveFrame:
        """Frame of an edited planet, rendered for both meter and display."""
        assert step.renderer is not None
        started, width = perf_counter(), step.scene.camera.width
        scene = scaled(step.scene, min(1.0, _EDITED / width))
        frame = step.renderer.render(scene, orders=step.orders)
        return replace(step, scene=scene, frame=frame, seconds=perf_counter() - started)

    def _upload(self, solution: MomentsSolution) -> bool:
        """Upload a solution; False if it exceeds the GPU's capacity."""
        if solution is self._loaded:
            return True
        if self._gpu is None:
            from airlight.render.gpu.picture.gpu_renderer import (
                QUICK_SKY_VIEW_SIZE,
                SKY_VIEW_SIZE,
                GpuRenderer,
            )

            assert self._device is not None
            size = QUICK_SKY_VIEW_SIZE if self._device.software else SKY_VIEW_SIZE
            self._gpu = GpuRenderer(self._device, size)
        try:
            self._gpu.set_solution(solution)
        except ParameterError:  # too many wavelengths or constituents
            self._loaded = None
            return False
        self._loaded = solution
        return True

    def _while_compiling(
        self, solution: MomentsSolution, step: LiveFrame, stale: Callable[[], bool]
    ) -> Iterator[LiveFrame]:
        assert self._device is not None
        if self._compiling is None:
            self._compiling = threading.Thread(
                target=self._compile, args=(solution, step), name="airlight-compiling", daemon=True
            )
            self._compiling.start()
        if not self._device.software and not self._are_compiled(SKY_VIEW_LOOPS):
            while not self._compiled and not stale():
                time.sleep(_POLL)
            return
        over = (lambda: False) if self._device.software else (lambda: self._compiled)
        try:
            yield from self._on_cpu(solution, step, lambda: stale() or over())
            if self._device.software:
                return
        except Cancelled:
            if stale():
                raise
        while not self._compiled and not stale():
            time.sleep(_POLL)

    def _compile(self, solution: MomentsSolution, step: LiveFrame) -> None:
        """Compile the shaders by rendering a few pixels.

        A software GPU compiles in the queue of the window's frames. Shaders are therefore compiled
        in a separate queue first, without maps, and are then in the driver's cache.
        """
        assert self._device is not None
        try:
            # a software GPU's sky-view LUT is filled by the CPU's loops
            loops = SKY_VIEW_LOOPS[:-1] if self._device.software else ()
            if self._are_compiled(loops, lambda: self._closing) and self._upload(solution):
                assert self._gpu is not None
                if self._device.software and not self._closing:
                    self._compile_apart(solution, step)
                    gc.collect()  # a device of wgpu refers to itself
                if not self._closing:
                    render_small(replace(step, renderer=self._gpu))
        finally:
            self._compiled = True
            give_back()

    def _compile_apart(self, solution: MomentsSolution, step: LiveFrame) -> None:
        assert self._device is not None
        assert self._gpu is not None
        renderer = type(self._gpu)(self._device.duplicate(), self._gpu.sky_view_size)
        renderer.set_solution(solution, maps=False)
        render_small(replace(step, renderer=renderer))


def render_small(step: LiveFrame) -> None:
    """Render a few pixels with all shaders."""
    import wgpu

    assert step.renderer is not None
    small = scaled(step.scene, _SMALL / step.scene.camera.width)
    texture = step.renderer.device.device.create_texture(
        size=(small.camera.width, small.camera.height, 1),
        format=LIVE_FORMAT,
        usage=wgpu.TextureUsage.RENDER_ATTACHMENT,
    )
    ready = replace(step, scene=small)
    ready.display(texture.create_view(), exposure=0.0, settings=DisplaySettings())
    ready.metered(_SMALL)
