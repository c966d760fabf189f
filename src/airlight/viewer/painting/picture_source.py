"""``Request``, ``Picture`` and the protocol ``PictureSource`` of the window's renderers."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Literal, Protocol

import numpy as np
from numpy.typing import NDArray

from airlight.image.display import to_display
from airlight.image.display_settings import DisplaySettings
from airlight.image.exposure import DEFAULT_EXPOSURE
from airlight.scene import Scene
from airlight.scene.frame import Frame
from airlight.scene.system import System
from airlight.solver.moments.solution import MomentsSolution
from airlight.viewer.session.adaptation import Adaptation

if TYPE_CHECKING:
    from airlight.render.clouds.lit_clouds import LitClouds

#: Options for the displayed orders of scattering.
Orders = Literal["all", "single", "multiple"]
#: Default display of a request.
_BY_DAY: Final = DisplaySettings(eye=False)


@dataclass(frozen=True, kw_only=True, eq=False)
class Request:
    """Request for a displayed picture.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet's atmosphere.
    scene : Scene
        Scene with the size of the final picture, in physical pixels.
    clouds : LitClouds, optional
        Three-dimensional clouds, possibly of an older planet or light.
    cloud_time : float
        Time for which the wind has moved them. [s]
    exposure : float
        Exposure, relative to the automatic exposure if ``automatic``. [EV]
    automatic : bool
        Whether the exposure is automatic.
    adaptation : Adaptation, optional
        Exposure that eases towards the metered exposure; by default the metered exposure itself.
    held : bool
        Whether the automatic exposure is locked.
    meters : bool
        Whether the picture is metered though its exposure is given.
    display : DisplaySettings
        Display settings.
    orders : str
        ``all``, ``single`` (scattered or reflected once) or ``multiple`` (all but once).
    system : System, optional
        Scene of several bodies, whose observer and camera are those of ``scene``.
    body : str
        Name of the planet of ``solution`` in it.
    """

    solution: MomentsSolution
    scene: Scene
    clouds: LitClouds | None = None
    cloud_time: float = 0.0
    exposure: float = DEFAULT_EXPOSURE
    automatic: bool = False
    adaptation: Adaptation | None = None
    held: bool = False
    meters: bool = False
    display: DisplaySettings = _BY_DAY
    orders: Orders = "all"
    system: System | None = None
    body: str = ""

    def displayed(self, frame: Frame, exposure: float) -> NDArray[np.uint8]:
        """Pixels of a frame of the request at an exposure [EV], shape (height, width, 3)."""
        return to_display(frame.rgb, exposure, settings=self.display, **frame.lens)

    def same_light(self, other: Request | None) -> bool:
        """Whether both requests have the same radiance."""
        return (
            other is not None
            and self.solution is other.solution
            and self.clouds is other.clouds
            and self.cloud_time == other.cloud_time
            and self.orders == other.orders
            and self.scene == other.scene
            and self.system == other.system
        )

    def same(self, other: Request | None) -> bool:
        """Whether both requests have the same displayed picture."""
        return (
            other is not None
            and self.same_light(other)
            and self.exposure == other.exposure
            and self.automatic == other.automatic
            and self.adaptation is other.adaptation
            and self.held == other.held
            and self.meters == other.meters
            and self.display == other.display
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """Displayed picture in a texture, coarse or final.

    Parameters
    ----------
    view : wgpu.GPUTextureView
        Encoded sRGB, 8 bits per channel.
    width, height : int
        Size of the texture. [pixel]
    request : Request
        Request that the picture answers.
    exposure : float
        Exposure applied, including the automatic one. [EV]
    metered : float or None
        Metered exposure; None if the picture was not metered. [EV]
    seconds : float
        Time to compute it. [s]
    by : str
        Short name of the CPU or kind of GPU.
    """

    view: Any
    width: int
    height: int
    request: Request
    exposure: float
    finished: bool
    seconds: float
    by: str
    metered: float | None = None


class PictureSource(Protocol):
    """Progressive renderer of requests, used on a single thread."""

    def render(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        """Yield pictures of a request, each finer than the last.

        Parameters
        ----------
        stale : callable
            ``stale()`` is True once the request is superseded; rendering may then stop.

        Yields
        ------
        Picture
        """

    def close(self) -> None:
        """End the renderer's threads."""
