"""``Renderer``: who renders the view of a solution, and in which steps it becomes visible.

The policy of command line, window and saved pictures alike:

* Without a GPU, and where a GPU has too little capacity, the CPU renders.
* A still picture is rendered once, whole.
* A live picture of the CPU is rendered coarsely at once, then finer; a newer request interrupts
  all but the first.
* A live picture of a hardware GPU is rendered once, whole: that takes milliseconds.
* A software GPU renders from a coarse sky-view LUT while the view changes; after a short time
  without changes the CPU renders the finished picture, which, unlike a long pass, leaves the
  device free for the window.
* The CPU also renders until the shaders of live pictures are compiled, which takes seconds;
  unless its own loops are not compiled either, which takes longer (``render.ahead``): then a
  hardware GPU renders first. The first picture of a window is the whole one, which needs no loop
  that marches each pixel: to compile or to load that, which small pictures take, takes longer.

All of them read a sky-view LUT, unless an exact picture is requested.
"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final

from airlight.errors import Cancelled, ParameterError
from airlight.kernel.memory import give_back
from airlight.render import render
from airlight.render.ahead import MARCH_LOOPS, SKY_VIEW_LOOPS
from airlight.scene.picture_size import scaled

if TYPE_CHECKING:
    from collections.abc import Mapping

    import numpy as np
    from numpy.typing import NDArray

    from airlight.gpu.device.device import Device
    from airlight.gpu.picture.gpu_renderer import GpuRenderer
    from airlight.kernel.ahead import CompiledAhead
    from airlight.kernel.threads import Cancel, Progress
    from airlight.scene import Scene
    from airlight.scene.frame import Frame
    from airlight.solvers.moments.solution import MomentsSolution

#: The frame's ``device`` where the CPU renders.
CPU: Final = "CPU"
#: Format of the textures into which a GPU renders live pictures: encoded sRGB.
LIVE_FORMAT: Final = "rgba8unorm"
#: Time for the CPU's first picture of a new view, which limits its size. [s]
_AT_ONCE: Final = 0.05
#: Factor of the pixels per side from one picture to the next. [1]
_STEP: Final = 3.0
#: Scale of the smallest picture, as fewer pixels per side show nothing; and scale above which the
#: next picture is the whole one. [1]
_SMALLEST: Final = 1.0 / 12.0
_NEARLY_WHOLE: Final = 0.7
#: Speed assumed until one has been measured. [pixel s⁻¹]
_FIRST_GUESS: Final = 2e5
#: Time without a change after which a software GPU's picture is finished. [s]
_STILL: Final = 0.2
#: Interval of looking whether that time is over, or the shaders are compiled. [s]
_POLL: Final = 0.02
#: Width of the picture that compiles the shaders. [pixel]
_TINY: Final = 16.0


@dataclass(frozen=True, kw_only=True, eq=False)
class LiveFrame:
    """Step of a live picture: a frame, or a GPU that is ready to render one into a texture.

    Attributes
    ----------
    scene : Scene
        Scene whose camera has the size of this step.
    orders : str
        Orders of scattering.
    finished : bool
        False if a finer step follows.
    seconds : float
        Time to render the frame; 0 for a GPU. [s]
    frame : Frame or None
        Linear sRGB radiance; None where a GPU renders.
    pictures : GpuRenderer or None
        Renderer with the solution, where a GPU renders.
    """

    scene: Scene
    orders: str
    finished: bool
    seconds: float = 0.0
    frame: Frame | None = None
    pictures: GpuRenderer | None = None

    @property
    def by(self) -> str:
        """Short name of what renders it."""
        if self.pictures is None:
            return CPU
        return "GPU in software" if self.pictures.device.software else "GPU"

    def linear(self, width: float) -> NDArray[np.float32]:
        """Linear sRGB radiance of this picture, from a GPU only ``width`` pixels wide."""
        if self.frame is not None:
            return self.frame.rgb
        assert self.pictures is not None
        small = scaled(self.scene, min(1.0, width / self.scene.camera.width))
        return self.pictures.render(small, orders=self.orders).rgb

    def display(
        self, view: Any, *, exposure: float, tone_map: str, uniforms: Mapping[str, float]
    ) -> None:
        """Render into a texture of ``LIVE_FORMAT``, where a GPU renders.

        Parameters
        ----------
        view : wgpu.GPUTextureView
            View of the target, which has the size of the scene's camera.
        exposure, tone_map, uniforms :
            Arguments of ``GpuRenderer.display``.
        """
        assert self.pictures is not None
        self.pictures.display(
            self.scene, view, LIVE_FORMAT, orders=self.orders, exposure=exposure,
            tone_map=tone_map, uniforms=uniforms,
        )  # fmt: skip


class Renderer:
    """Painter of any number of pictures; it keeps its device, shaders and textures between them.

    Parameters
    ----------
    device : Device, optional
        Device that renders, see ``rendering_gpu``; without one the CPU does.
    ahead : CompiledAhead, optional
        Process that compiles the CPU's loops, which pictures wait for.
    """

    def __init__(self, device: Device | None = None, ahead: CompiledAhead | None = None) -> None:
        self._device = device
        self._ahead = ahead
        self._pictures: GpuRenderer | None = None
        self._shown: object = None
        self._compiling: threading.Thread | None = None
        self._compiled = device is None
        self._closing = False
        self._began = False
        self._rate = _FIRST_GUESS
        self._last: tuple[MomentsSolution, LiveFrame] | None = None  # finished by the CPU

    def render(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        exact: bool = False,
        orders: str = "all",
        disc: bool = True,
        samples: int = 1,
        stokes: bool = False,
        weights: NDArray[np.float64] | None = None,
        progress: Progress | None = None,
        cancel: Cancel | None = None,
    ) -> Frame:
        """Render a still picture.

        Parameters
        ----------
        solution : MomentsSolution
            Solution of a planet.
        scene : Scene
            Observer, star and camera.
        exact : bool
            Whether each pixel is marched, instead of read from a sky-view LUT.
        orders : str
            Orders as for ``airlight.render``.
        disc : bool
            Whether the discs of the lights are rendered.
        samples : int
            Samples per side of every pixel, as for ``airlight.render``.
        stokes : bool
            Whether the frame has Q and U, which the CPU alone renders.
        weights : array, shape (nl, 3), optional
            Linear sRGB per radiance, for a GPU; by default ``picture_weights``.
        progress, cancel : callable, optional
            See ``airlight.kernel.threads``.

        Returns
        -------
        Frame
            Linear sRGB radiance [W m⁻² sr⁻¹]; its metadata name the GPU.

        Raises
        ------
        ParameterError
            If the solution or the picture exceeds the capacity of the GPU, or Q and U are
            requested of one.
        Cancelled
            If ``cancel`` requested it.
        """
        if self._device is None:
            if not self._has(SKY_VIEW_LOOPS, cancel or (lambda: False)):
                raise Cancelled("the picture")
            frame = render(
                solution, scene, exact=exact, orders=orders, disc=disc, samples=samples,
                stokes=stokes, progress=progress, cancel=cancel,
            )  # fmt: skip
        else:
            if stokes:
                raise ParameterError("stokes", True, "False where a GPU renders")
            pictures = self._renderer(live=False)
            pictures.set_solution(solution, weights)
            self._shown = None
            frame = pictures.render(
                scene, exact=exact, orders=orders, disc=disc, samples=samples, progress=progress,
                cancel=cancel,
            )  # fmt: skip
        return replace(frame, metadata={"device": CPU, **frame.metadata})

    def live(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        orders: str = "all",
        stale: Callable[[], bool],
    ) -> Iterator[LiveFrame]:
        """Render a picture step by step, each finer than the one before; the last is finished.

        Parameters
        ----------
        solution, scene, orders :
            Arguments of ``frame``.
        stale : callable
            ``stale()`` is True once the request is superseded; the rest may then be skipped.

        Yields
        ------
        LiveFrame

        Raises
        ------
        Cancelled
            If the request became stale while the CPU was rendering.
        """
        picture = LiveFrame(scene=scene, orders=orders, finished=True)
        if self._device is None:
            yield from self._on_cpu(solution, picture, stale)
            return
        if not self._compiled:
            yield from self._while_compiling(solution, picture, stale)
            if stale() or (self._device.software and self._knows(solution, picture)):
                return
        if not self._takes(solution):
            yield from self._on_cpu(solution, picture, stale)
            return
        by_device = replace(picture, pictures=self._pictures, finished=not self._device.software)
        if by_device.finished:
            yield by_device
            return
        if not self._knows(solution, picture):
            yield by_device
            until = perf_counter() + _STILL
            while perf_counter() < until:
                if stale():
                    return
                time.sleep(_POLL)
        yield from self._on_cpu(solution, picture, stale, coarse=False)

    def close(self) -> None:
        """Wait for the thread that compiles, if there is one."""
        self._closing = True
        if self._compiling is not None:
            self._compiling.join()

    # --- by the CPU ---------------------------------------------------------------------

    def _on_cpu(
        self,
        solution: MomentsSolution,
        picture: LiveFrame,
        stale: Callable[[], bool],
        *,
        coarse: bool = True,
    ) -> Iterator[LiveFrame]:
        if self._last is not None and self._knows(solution, picture):
            yield self._last[1]
            return
        if not self._has(SKY_VIEW_LOOPS, stale):
            raise Cancelled("a newer view")
        # To load the loop that marches takes longer than to render the first picture whole.
        coarse = coarse and (self._ahead is None or (self._began and self._has(MARCH_LOOPS)))
        self._began = True
        for step, part in enumerate(self._parts(picture.scene) if coarse else [1.0]):
            started = perf_counter()
            scene = scaled(picture.scene, part)
            # The first, coarse picture is never interrupted: in flight, each is stale quickly.
            stop = None if step == 0 and part < 1.0 else stale
            frame = render(solution, scene, orders=picture.orders, cancel=stop)
            seconds = max(perf_counter() - started, 1e-6)
            self._rate = scene.camera.width * scene.camera.height / seconds
            done = replace(picture, scene=scene, frame=frame, seconds=seconds, finished=part == 1.0)
            if done.finished:
                self._last = solution, replace(done, seconds=0.0)
            yield done

    def _has(self, loops: tuple[Any, ...], stale: Callable[[], bool] = lambda: True) -> bool:
        """Whether loops are compiled, after waiting until they are or the request is stale."""
        ahead = self._ahead
        return ahead is None or all(ahead.wait(loop, stale) for loop in loops)

    def _parts(self, scene: Scene) -> Iterator[float]:
        """Scales of successive pictures."""
        camera = scene.camera
        part = (self._rate * _AT_ONCE / (camera.width * camera.height)) ** 0.5
        part = max(part, _SMALLEST)
        while part < _NEARLY_WHOLE:
            yield part
            part *= _STEP
        yield 1.0

    def _knows(self, solution: MomentsSolution, picture: LiveFrame) -> bool:
        """Whether the CPU's last finished picture shows the same light."""
        if self._last is None:
            return False
        of, last = self._last
        return of is solution and last.orders == picture.orders and last.scene == picture.scene

    # --- by a GPU --------------------------------------------------------------------------

    def _renderer(self, *, live: bool) -> GpuRenderer:
        """Renderer with the sky-view LUT that the GPU fills quickly enough."""
        from airlight.gpu.picture.gpu_renderer import (
            QUICK_SKY_VIEW_SIZE,
            SKY_VIEW_SIZE,
            GpuRenderer,
        )

        assert self._device is not None
        shape = QUICK_SKY_VIEW_SIZE if live and self._device.software else SKY_VIEW_SIZE
        if self._pictures is None:
            self._pictures = GpuRenderer(self._device, shape)
        elif self._pictures.sky_view_size != shape:
            self._pictures.sky_view_size = shape
        return self._pictures

    def _takes(self, solution: MomentsSolution) -> bool:
        """Upload a solution; False if it exceeds the GPU's capacity."""
        pictures = self._renderer(live=True)
        if solution is self._shown:
            return True
        try:
            pictures.set_solution(solution)
        except ParameterError:  # too many wavelengths or constituents
            self._shown = None
            return False
        self._shown = solution
        return True

    def _while_compiling(
        self, solution: MomentsSolution, picture: LiveFrame, stale: Callable[[], bool]
    ) -> Iterator[LiveFrame]:
        assert self._device is not None
        if self._compiling is None:
            self._compiling = threading.Thread(
                target=self._compile, args=(solution, picture), name="airlight-compiling",
                daemon=True,
            )  # fmt: skip
            self._compiling.start()
        if not self._device.software and not self._has(SKY_VIEW_LOOPS):
            while not self._compiled and not stale():
                time.sleep(_POLL)
            return
        over = (lambda: False) if self._device.software else (lambda: self._compiled)
        try:
            yield from self._on_cpu(solution, picture, lambda: stale() or over())
            if self._device.software:
                return
        except Cancelled:
            if stale():
                raise
        while not self._compiled and not stale():
            time.sleep(_POLL)

    def _compile(self, solution: MomentsSolution, picture: LiveFrame) -> None:
        """Render one very small picture, which compiles the shaders.

        A software GPU compiles them in the queue in which the window's frames wait. It therefore
        compiles them first in another queue, without the maps, and finds them then in the driver's
        cache.
        """
        assert self._device is not None
        try:
            if self._device.software:
                self._has((SKY_VIEW_LOOPS[0],), lambda: self._closing)  # fills the sky-view LUT
            if self._takes(solution):
                assert self._pictures is not None
                if self._device.software and not self._closing:
                    apart = type(self._pictures)(self._device.apart(), self._pictures.sky_view_size)
                    apart.set_solution(solution, maps=False)
                    _draw_small(replace(picture, pictures=apart))
                if not self._closing:
                    _draw_small(replace(picture, pictures=self._pictures))
        finally:
            self._compiled = True
            give_back()


def _draw_small(picture: LiveFrame) -> None:
    """Render a picture of a few pixels, by all shaders."""
    import wgpu

    assert picture.pictures is not None
    small = scaled(picture.scene, _TINY / picture.scene.camera.width)
    texture = picture.pictures.device.device.create_texture(
        size=(small.camera.width, small.camera.height, 1),
        format=LIVE_FORMAT,
        usage=wgpu.TextureUsage.RENDER_ATTACHMENT,
    )
    ready = replace(picture, scene=small)
    ready.display(texture.create_view(), exposure=0.0, tone_map="natural", uniforms={})
    ready.linear(_TINY)
