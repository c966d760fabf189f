"""Step of progressive rendering, which the CPU has rendered or a GPU is ready to display."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Protocol

from airlight.image.display_settings import DisplaySettings
from airlight.render.render_scene import CPU
from airlight.scene.picture_size import scaled

if TYPE_CHECKING:
    from airlight.image.white_balance import White
    from airlight.render.gpu.device.device import Device
    from airlight.scene import Scene
    from airlight.scene.frame import Frame

#: Format of the target textures of live frames: encoded sRGB.
LIVE_FORMAT: Final = "rgba8unorm"


class FrameRenderer(Protocol):
    """Renderer on a GPU that is ready to render and display a scene."""

    @property
    def device(self) -> Device:
        """GPU that renders."""

    def render(self, scene: Scene, *, orders: str = "all") -> Frame:
        """See ``GpuRenderer.render``."""

    def display(
        self,
        scene: Scene,
        view: Any,
        target_format: str,
        *,
        orders: str = "all",
        exposure: float,
        settings: DisplaySettings | None = None,
        scene_white: White | None = None,
    ) -> None:
        """See ``GpuRenderer.display``."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LiveFrame:
    """Step of progressive rendering: a frame, or a GPU renderer that is ready to display one.

    Attributes
    ----------
    scene : Scene
        Scene whose camera has the size of this step.
    orders : str
        Orders of scattering.
    finished : bool
        False if a finer step follows.
    seconds : float
        Time to render the frame; 0 on the GPU. [s]
    frame : Frame or None
        Linear sRGB radiance; None if the GPU displays it.
    renderer : FrameRenderer or None
        Renderer with the solution; None on the CPU.
    """

    scene: Scene
    orders: str
    finished: bool
    seconds: float = 0.0
    frame: Frame | None = None
    renderer: FrameRenderer | None = None

    @property
    def by(self) -> str:
        """Short name of the CPU or the kind of GPU."""
        if self.renderer is None:
            return CPU
        return "GPU in software" if self.renderer.device.software else "GPU"

    def metered(self, width: float) -> Frame:
        """Linear frame; the GPU renders it at a width of at most ``width`` pixels."""
        if self.frame is not None:
            return self.frame
        assert self.renderer is not None
        small = scaled(self.scene, min(1.0, width / self.scene.camera.width))
        return self.renderer.render(small, orders=self.orders)

    def display(
        self,
        view: Any,
        *,
        exposure: float,
        settings: DisplaySettings,
        scene_white: White | None = None,
    ) -> None:
        """Display into a texture of ``LIVE_FORMAT`` on the GPU.

        Parameters
        ----------
        view : wgpu.GPUTextureView
            View of the target, of the camera's size.
        exposure, settings, scene_white :
            Arguments of ``GpuRenderer.display``.
        """
        assert self.renderer is not None
        self.renderer.display(
            self.scene,
            view,
            LIVE_FORMAT,
            orders=self.orders,
            exposure=exposure,
            settings=settings,
            scene_white=scene_white,
        )
