"""Options of the camera: direction, field of view, projection, size."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Self

import typer

from airlight.cli import options
from airlight.cli.option_groups import OptionGroup, given_options, named_errors, option
from airlight.errors import ConflictError

if TYPE_CHECKING:
    from collections.abc import Callable

    from airlight.cli.place_options import PlaceOptions
    from airlight.planets.planet import Planet
    from airlight.scene import Scene

Size = Annotated[
    str | None,
    typer.Option(
        metavar="WxH",
        help="Picture size, e.g. 1280x720; one number: side of a square or cube face, or width of "
        "a panorama.",
    ),
]
Samples = Annotated[
    int | None,
    typer.Option(
        metavar="N",
        help="Samples per side of each pixel, up to 16 (1, with an antialiased horizon; 4 at the "
        "edges of a scene).",
    ),
]

#: Left and top edge, width and height of a part of a picture; None for the whole. [pixel]
Window = tuple[int, int, int, int] | None
#: Projection whose field of view is a length, with a distant camera.
_ORTHOGRAPHIC = "orthographic"
#: Default azimuth of the camera: at right angles to the sun, where the atmosphere shows best. [deg]
_ACROSS = -75.0


@dataclass(frozen=True, kw_only=True)
class DirectionOptions(OptionGroup):
    """Options of the direction and the field of view of a camera."""

    look: tuple[float, float] | None = option(
        "Camera direction; azimuth 0 is towards the sun, 90 to its right. Default: the horizon at "
        "azimuth -75; the zenith for a fisheye.",
        "ZENITH,AZIMUTH",
    )
    look_at: str | None = option(
        "Camera target, instead of --look: moon requires --time; a compass bearing is NE or 315, "
        "with an elevation 315/20.",
        "horizon|nadir|zenith|sun|moon|BEARING",
    )
    roll: float | None = option("{scene.scene_fields:ROLL} (0deg).", "ANGLE")
    fov: str | None = option(
        "{scene.scene_fields:FIELD_OF_VIEW} (60deg; 180deg); of orthographic a width, e.g. 14000km "
        "(the whole disc).",
        "ANGLE",
        read=options.unread,
    )
    projection: str = option(
        "Projection: {scene.projections:PROJECTIONS}. orthographic shows the planet's disc, north "
        "up.",
        "NAME",
        "perspective",
    )
    size: Size = None

    def direction(self) -> tuple[float, float] | None:
        """Zenith angle and azimuth of ``--look``; None without it. [deg]"""
        if self.look is not None and self.look_at is not None:
            raise ConflictError("--look", "cannot be combined with --look-at")
        return self.look


@dataclass(frozen=True, kw_only=True)
class CameraOptions(DirectionOptions):
    """Options of the camera, its filter and its frame."""

    polariser: float | None = option(
        "{scene.scene_fields:POLARISER}.",
        "ANGLE",
    )
    dehaze: float | None = option(
        "{scene.scene_fields:DEHAZE} (0.9; 0 in linear files and with --show).", "NUMBER"
    )
    crop: str | None = option(
        "Window of the picture to render, in pixels from the left and top edge. Only it is "
        "computed for an .exr or .hdr, or with --exposure EV and --glare 0.",
        "X,Y,W,H",
    )
    samples: Samples = None

    def hazy(self, linear: bool, own: bool) -> Self:
        """Options with their haze removal: none in a picture of radiance, else by default some.

        Parameters
        ----------
        linear : bool
            Whether the picture holds radiance or its polarisation.
        own : bool
            Whether a scene file has a default of its own.
        """
        from airlight.scene.scene_fields import DEHAZE

        if linear and self.dehaze:
            raise ConflictError("--dehaze", "does not apply to pictures of radiance")
        if self.dehaze is not None or (own and not linear):
            return self
        return replace(self, dehaze=0.0 if linear else DEHAZE.initial)

    @property
    def parallel(self) -> bool:
        """Whether the projection is orthographic."""
        return self.projection == _ORTHOGRAPHIC

    def check_parallel(self, place: PlaceOptions) -> None:
        """Raise an error for options of position or direction of an orthographic camera."""
        if not self.parallel:
            return
        placing = {**given_options(place, "altitude"), **given_options(self, "look", "look_at")}
        for given in [*placing, *(["an altitude in --at"] if place.altitude_in_at else [])]:
            raise ConflictError(f"--projection {self.projection}", f"takes no {given}")

    def window(self, columns: int, rows: int) -> Window:
        """Window of ``--crop``. [pixel]"""
        return options.crop(self.crop, columns, rows)

    def seen(self, scene: Scene, planet: Planet, size: tuple[int, int], window: Window) -> Scene:
        """Scene of a planet, seen by the camera.

        Parameters
        ----------
        scene : Scene
            Observer and lights.
        size : (int, int)
            Width and height of the picture. [pixel]
        window : (int, int, int, int), optional
            Window to render. [pixel]
        """
        from airlight.scene import Camera

        look = self.direction()
        zenith, azimuth = (None, 0.0) if look is None else look
        camera = Camera(
            projection=self.projection,
            width=size[0],
            height=size[1],
            field_of_view=None if self.parallel else self._fov(options.angle),
            extent=self._extent(planet, size) if self.parallel else None,
            crop=window,
            look_zenith=zenith,
            look_azimuth=azimuth,
            roll=self.roll or 0.0,
            polariser=self.polariser,
            dehaze=self.dehaze or 0.0,
        )
        if self.parallel:
            return replace(scene, camera=camera, altitude=0.0).north_up()
        scene = replace(scene, camera=camera)
        if look is not None or (self.look_at is None and self.projection != "perspective"):
            return scene
        with named_errors(look_at="--look-at"):
            scene = scene.aimed(self.look_at or "horizon", planet)
        if self.look_at is not None:
            return scene
        return replace(scene, camera=replace(scene.camera, look_azimuth=_ACROSS))

    def _extent(self, planet: Planet, size: tuple[int, int]) -> float:
        """Length from left to right of the picture; by default the whole disc. [m]"""
        from airlight.scene.projections.orthographic import disc_extent

        extent = self._fov(options.length)
        return disc_extent(planet.top_radius, *size) if extent is None else extent

    def _fov(self, read: Callable[[str, str], float]) -> float | None:
        """Value of ``--fov``; None without it. [deg] or [m]"""
        return None if self.fov is None else read(self.fov, "--fov")
