"""Request for a picture, the picture, and the protocol of renderers that turn one into the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any, Literal, Protocol

from airlight.color.exposure import DEFAULT_EXPOSURE
from airlight.scene import Scene
from airlight.solvers.moments.solution import MomentsSolution
from airlight.viewer.session.adaptation import Adaptation

#: Orders of scattering that are shown.
Orders = Literal["all", "single", "multiple"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Request:
    """Request for a picture.

    Parameters
    ----------
    solution : MomentsSolution
        Solution of the planet's atmosphere.
    scene : Scene
        Scene whose camera has the size of the finished picture, in physical pixels.
    exposure : float
        Exposure, added to the automatic one if that is on. [EV]
    automatic : bool
        Whether the exposure adapts to the picture.
    adaptation : Adaptation, optional
        Exposure of the session, which eases towards the measured one; without it that is used.
    held : bool
        Whether the automatic exposure stays as it is.
    tone_map : str
        Name from ``airlight.color.tone_maps.TONE_MAPS``.
    glare : float
        Amount of glare, 1 for that of a lens. [1]
    orders : str
        ``all``, ``single`` (scattered or reflected once) or ``multiple`` (all but once).
    uniforms : mapping
        View values that the shaders take as uniforms, by name; see ``uniforms_of``.
    """

    solution: MomentsSolution
    scene: Scene
    exposure: float = DEFAULT_EXPOSURE
    automatic: bool = False
    adaptation: Adaptation | None = None
    held: bool = False
    tone_map: str = "natural"
    glare: float = 1.0
    orders: Orders = "all"
    uniforms: Mapping[str, float] = field(default_factory=dict)

    def same_light(self, other: Request | None) -> bool:
        """Whether the other request has the same frame, before exposure and tone map."""
        return (
            other is not None
            and self.solution is other.solution
            and self.orders == other.orders
            and self.scene == other.scene
        )

    def same(self, other: Request | None) -> bool:
        """Whether the other request has the same picture."""
        return (
            other is not None
            and self.same_light(other)
            and self.exposure == other.exposure
            and self.automatic == other.automatic
            and self.held == other.held
            and self.tone_map == other.tone_map
            and self.glare == other.glare
            and self.uniforms == other.uniforms
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """Finished or coarse picture on the GPU.

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
    finished : bool
        False for a coarse picture that a finer one will follow.
    seconds : float
        Time to compute it. [s]
    by : str
        Short name of the CPU or GPU that computed it.
    """

    view: Any
    width: int
    height: int
    request: Request
    exposure: float
    finished: bool
    seconds: float
    by: str


class PictureSource(Protocol):
    """Renderer of pictures; all methods are called on one thread, which is not the window's."""

    def render(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        """Yield pictures of a request, each finer than the one before.

        Parameters
        ----------
        request : Request
            Request to render.
        stale : callable
            ``stale()`` is True once the request is superseded; the rest may then be skipped.

        Yields
        ------
        Picture

        Raises
        ------
        AirlightError
            If the request cannot be rendered.
        """

    def close(self) -> None:
        """End the renderer's threads."""
