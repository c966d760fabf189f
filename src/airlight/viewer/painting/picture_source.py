"""A picture that is wanted, a picture that was made, and who makes the one of the other."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal, Protocol

from airlight.scene import Scene
from airlight.solvers.moments.solution import MomentsSolution
from airlight.viewer.parameters.view_parameters import fitting

#: Which scattered light is shown.
Orders = Literal["all", "single", "multiple"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Request:
    """A picture that is wanted.

    Parameters
    ----------
    solution : MomentsSolution
        The light of the planet's air.
    scene : Scene
        Its camera has the size of the finished picture in pixels of the display.
    exposure : float
        On top of the automatic one, if that is on. [EV]
    automatic : bool
        Whether the exposure follows the picture.
    tone_map : str
        One of ``airlight.color.tone_maps.TONE_MAPS``.
    orders : str
        ``all``, ``single`` (scattered or reflected once) or ``multiple`` (all but once).
    uniforms : mapping
        Values of the view that are numbers of the shaders, by name; see ``uniforms_of``.
    """

    solution: MomentsSolution
    scene: Scene
    exposure: float = -2.5
    automatic: bool = False
    tone_map: str = "hable"
    orders: Orders = "all"
    uniforms: Mapping[str, float] = field(default_factory=dict)

    def same_light(self, other: Request | None) -> bool:
        """Whether the other's frame would be the same, before exposure and tone map."""
        return (
            other is not None
            and self.solution is other.solution
            and self.orders == other.orders
            and self.scene == other.scene
        )

    def same(self, other: Request | None) -> bool:
        """Whether the other's picture would be the same."""
        return (
            other is not None
            and self.same_light(other)
            and self.exposure == other.exposure
            and self.automatic == other.automatic
            and self.tone_map == other.tone_map
            and self.uniforms == other.uniforms
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """A picture on the graphics device.

    Parameters
    ----------
    view : wgpu.GPUTextureView
        Encoded sRGB, 8 bits a channel.
    width, height : int
        Of the texture. [pixel]
    request : Request
        What it shows.
    exposure : float
        That was used. [EV]
    finished : bool
        False for a coarse picture that a finer one will follow.
    seconds : float
        What it took. [s]
    by : str
        Who computed it, in a few words.
    """

    view: Any
    width: int
    height: int
    request: Request
    exposure: float
    finished: bool
    seconds: float
    by: str


class Painter(Protocol):
    """Makes pictures; everything is called on one thread, which is not the window's."""

    def paint(self, request: Request, stale: Callable[[], bool]) -> Iterator[Picture]:
        """Pictures of what is wanted, each finer than the one before.

        Parameters
        ----------
        request : Request
            What is wanted.
        stale : callable
            Whether it is wanted no longer: then the rest need not be made.

        Raises
        ------
        AirlightError
            If there is no such picture.
        """

    def close(self) -> None:
        """End its threads."""


def scaled(scene: Scene, part: float) -> Scene:
    """The same scene on a picture with so many times the pixels a side.

    Examples
    --------
    >>> small = scaled(Scene(), 0.25).camera
    >>> small.width, small.height
    (320, 180)
    """
    camera = scene.camera
    size = round(camera.width * part), round(camera.height * part)
    width, height = fitting(camera.projection, *size)
    return replace(scene, camera=replace(camera, width=width, height=height))
