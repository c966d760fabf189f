"""``LiveSystemRenderer``: live frames of scenes of several bodies on the GPU."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from time import perf_counter
from typing import TYPE_CHECKING, Any, Final

from airlight.render.gpu_system_renderer import GpuSystemRenderer
from airlight.render.live_renderer import LiveFrame
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
#: Time without a change of view after which the final frame is rendered, and its polling. [s]
_STILL: Final = 0.2
_POLL: Final = 0.02


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
    rests.

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
        self._solved: dict[str, tuple[Planet, MomentsSolution]] = {}

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
        self._renderer.set_solutions(self._solutions(solution, system, body))
        software = self._device.software
        if software or system.stars:
            size = scaled(scene, _MOVING) if software else scene
            moving = SystemFrames(self._renderer, system, False)
            yield LiveFrame(scene=size, orders=orders, finished=False, renderer=moving)
            until = perf_counter() + _STILL
            while perf_counter() < until:
                if stale():
                    return
                time.sleep(_POLL)
        still = SystemFrames(self._renderer, system, True)
        yield LiveFrame(scene=scene, orders=orders, finished=True, renderer=still)

    def _solutions(
        self, solution: MomentsSolution, system: System, body: str
    ) -> dict[str, MomentsSolution]:
        """Solutions of all planets; the others than the edited one are solved once."""
        found = {}
        for name, planet in system.planets.items():
            if name == body:
                found[name] = solution
                continue
            known = self._solved.get(name)
            nm = solution.wavelengths
            if known is None or known[0] != planet or known[1].wavelengths.size != nm.size:
                self._solved[name] = planet, solve_planet(planet.without_clouds, nm)
            found[name] = self._solved[name][1]
        return found

    def close(self) -> None:
        """See ``LiveRenderer.close``."""
