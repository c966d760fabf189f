"""``LiveSystemRenderer``: live frames of scenes of several bodies on the GPU."""

from __future__ import annotations

import gc
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final, TypeAlias

from airlight.kernel.memory import give_back
from airlight.render.gpu_system_renderer import GpuSystemRenderer
from airlight.render.live_frame import LiveFrame
from airlight.render.live_renderer import render_small
from airlight.render.render_system import render_solved_system
from airlight.render.scene_lights import SceneLights
from airlight.render.solve_planet import solve_planet
from airlight.scene.picture_size import scaled

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.render.gpu.device.device import Device
    from airlight.scene import Scene
    from airlight.scene.frame import Frame
    from airlight.scene.system import System
    from airlight.solver.moments.solution import MomentsSolution

#: Scale of frames of a software GPU while the view changes. [1]
_MOVING: Final = 0.5
#: Width of the CPU's frames while shaders are compiled. [pixel]
_COMPILING: Final = 128.0
#: Time without a change of view after which the final frame is rendered, and its polling. [s]
_STILL: Final = 0.2
_POLL: Final = 0.02


#: Planets of a scene with their solutions, by name.
Solved: TypeAlias = "dict[str, tuple[Planet, MomentsSolution]]"


def solutions_around(
    solution: MomentsSolution, system: System, body: str, solved: Solved
) -> dict[str, MomentsSolution]:
    """Solutions of all planets of a scene around an edited one.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the edited planet.
    body : str
        Its name.
    solved : dict
        Solutions of the others, which are solved once and added.
    """
    found, nm = {}, solution.wavelengths
    for name, planet in system.planets.items():
        if name == body:
            found[name] = solution
            continue
        known = solved.get(name)
        if known is None or known[0] != planet or known[1].wavelengths.size != nm.size:
            solved[name] = planet, solve_planet(planet.without_clouds, nm)
        found[name] = solved[name][1]
    return found


@dataclass(frozen=True)
class SystemFrames:
    """Frames of one scene, as ``LiveFrame`` asks a renderer for them.

    Attributes
    ----------
    renderer : GpuSystemRenderer
        Renderer with the solutions.
    system : System
        Scene, of which a ``Scene`` gives only the size of a frame.
    sky : bool
        Whether the star catalogue is displayed.
    """

    renderer: GpuSystemRenderer
    system: System
    sky: bool

    @property
    def device(self) -> Device:
        """GPU that renders."""
        return self.renderer.device

    def render(self, scene: Scene, *, orders: str = "all") -> Frame:
        """See ``GpuRenderer.render``."""
        width, height = scene.camera.width, scene.camera.height
        return self.renderer.render(self.system, width=width, height=height, orders=orders)

    def display(
        self, scene: Scene, view: Any, target_format: str, *, orders: str = "all", **options: Any
    ) -> None:
        """See ``GpuRenderer.display``."""
        size = scene.camera.width, scene.camera.height
        self.renderer.display(
            self.system, view, target_format, size, orders=orders, sky=self.sky, **options
        )


class LiveSystemRenderer:
    """Renderer of successive frames of a scene of which one planet is edited.

    A software GPU renders smaller frames while the view changes. The star catalogue appears when it
    rests. Small frames of the CPU are shown while its shaders are compiled, which takes 10 to 60 s
    for the first frame of a device.

    Parameters
    ----------
    device : Device
        GPU from ``open_device``.
    size : (int, int)
        Size of the sky-view LUTs, see ``GpuRenderer``.
    """

    def __init__(self, device: Device, size: tuple[int, int]) -> None:
        self._device = device
        self._renderer = GpuSystemRenderer(device, size)
        self._solved: Solved = {}
        self._compiling: threading.Thread | None = None
        self._compiled, self._closing = not device.software, False

    def live(
        self,
        solution: MomentsSolution,
        scene: Scene,
        *,
        orders: str = "all",
        stale: Callable[[], bool],
        system: System,
        body: str,
    ) -> Iterator[LiveFrame]:
        """Render progressively, see ``LiveRenderer.live``.

        Parameters
        ----------
        solution : MomentsSolution
            Solution of the edited planet.
        scene : Scene
            Its camera has the size of the frame.
        orders, stale :
            See ``LiveRenderer.live``.
        system : System
            Bodies, lights, observer and camera.
        body : str
            Name of the edited planet.
        """
        solutions = solutions_around(solution, system, body, self._solved)
        step = LiveFrame(scene=scene, orders=orders, finished=False)
        if not self._compiled:
            yield from self._while_compiling(solutions, system, step, stale)
            if stale():
                return
        self._renderer.set_solutions(solutions)
        software = self._device.software
        if software or system.stars:
            size = scaled(scene, _MOVING) if software else scene
            moving = SystemFrames(self._renderer, system, False)
            yield replace(step, scene=size, renderer=moving)
            until = perf_counter() + _STILL
            while perf_counter() < until:
                if stale():
                    return
                time.sleep(_POLL)
        still = SystemFrames(self._renderer, system, True)
        yield replace(step, finished=True, renderer=still)

    def _while_compiling(
        self,
        solutions: dict[str, MomentsSolution],
        system: System,
        step: LiveFrame,
        stale: Callable[[], bool],
    ) -> Iterator[LiveFrame]:
        """Small frame of the CPU; ends when the shaders are compiled, or the request is stale."""
        if self._compiling is None:
            self._compiling = threading.Thread(
                target=self._compile,
                args=(solutions, system, step),
                name="airlight-compiling",
                daemon=True,
            )
            self._compiling.start()
        if step.orders == "all":
            started = perf_counter()
            small = scaled(step.scene, min(1.0, _COMPILING / step.scene.camera.width))
            nm = next(iter(solutions.values())).wavelengths
            lights = SceneLights(system, nm, solutions)
            size = small.camera.width, small.camera.height, None
            frame = render_solved_system(lights, size, 2)
            yield replace(step, scene=small, frame=frame, seconds=perf_counter() - started)
        while not (self._compiled or stale()):
            time.sleep(_POLL)

    def _compile(
        self, solutions: dict[str, MomentsSolution], system: System, step: LiveFrame
    ) -> None:
        """Compile the shaders in a queue beside the window's; the driver then knows them."""

        def compile_by(renderer: GpuSystemRenderer) -> None:
            if not self._closing:
                renderer.set_solutions(solutions)
                render_small(replace(step, renderer=SystemFrames(renderer, system, False)))

        try:
            size = self._renderer.sky_view_size
            compile_by(GpuSystemRenderer(self._device.duplicate(), size))
            gc.collect()  # a device of wgpu refers to itself
            compile_by(self._renderer)
        finally:
            self._compiled = True
            give_back()

    def close(self) -> None:
        """See ``LiveRenderer.close``."""
        self._closing = True
        if self._compiling is not None:
            self._compiling.join()
