"""Options of the camera: direction, field of view, projection, size."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import typer

from airlight.cli import options
from airlight.cli.option_groups import given_options
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.cli.place_options import Placed, PlaceOptions
    from airlight.planets.planet import Planet
    from airlight.scene import Camera

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

#: Projection whose field of view is a length, with a distant camera.
_ORTHOGRAPHIC = "orthographic"
#: Default azimuth of the camera: at right angles to the sun, where the atmosphere shows best. [deg]
_ACROSS = -75.0


@dataclass(frozen=True, kw_only=True)
class DirectionOptions:
    """Options of the direction and the field of view of a camera."""

    look: Annotated[
        str | None,
        typer.Option(
            metavar="ZENITH,AZIMUTH",
            help="Camera direction; azimuth 0 is towards the sun, 90 to its right. Default: the "
            "horizon at azimuth -75; the zenith for a fisheye.",
        ),
    ] = None
    look_at: Annotated[
        str | None,
        typer.Option(
            metavar="horizon|nadir|zenith|sun|moon|BEARING",
            help="Camera target, instead of --look: moon requires --time; a compass bearing is NE "
            "or 315, with an elevation 315/20.",
        ),
    ] = None
    roll: Annotated[str, typer.Option(metavar="ANGLE", help="Camera roll, clockwise.")] = "0deg"
    fov: Annotated[
        str | None,
        typer.Option(
            metavar="ANGLE",
            help="Field of view: horizontal (60deg); of a fisheye across the circle (180deg); of "
            "orthographic a width, e.g. 14000km (the whole disc).",
        ),
    ] = None
    projection: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Projection: {scene.projections:PROJECTIONS}. orthographic shows the planet's "
            "disc, north up.",
        ),
    ] = "perspective"
    size: Size = None

    def direction(self) -> tuple[float, float] | None:
        """Zenith angle and azimuth of ``--look``; None without it. [deg]"""
        if self.look is None:
            return None
        if self.look_at is not None:
            raise ConflictError("--look", "cannot be combined with --look-at")
        return options.direction(self.look, "--look")


@dataclass(frozen=True, kw_only=True)
class CameraOptions(DirectionOptions):
    """Options of the camera, its filter and its frame."""

    polariser: Annotated[
        str | None,
        typer.Option(
            metavar="ANGLE",
            help="Axis of an ideal polarising filter in front of the camera, counterclockwise "
            "from the camera's up.",
        ),
    ] = None
    crop: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y,W,H",
            help="Window of the picture to render, in pixels from the left and top edge. Only it "
            "is computed for an .exr or .hdr, or with --exposure EV and --glare 0.",
        ),
    ] = None
    samples: Samples = None

    @property
    def parallel(self) -> bool:
        """Whether the projection is orthographic."""
        return self.projection == _ORTHOGRAPHIC

    def check_parallel(self, place: PlaceOptions) -> None:
        """Raise an error for options of position or direction of an orthographic camera."""
        if not self.parallel:
            return
        placing = {**given_options(place, "altitude"), **given_options(self, "look", "look_at")}
        for option in [*placing, *(["an altitude in --at"] if place.altitude_in_at else [])]:
            raise ConflictError(f"--projection {self.projection}", f"takes no {option}")

    def window(self, columns: int, rows: int) -> tuple[int, int, int, int] | None:
        """Window of ``--crop``. [pixel]"""
        return options.crop(self.crop, columns, rows)

    def camera(
        self, planet: Planet, placed: Placed, size: tuple[int, int],
        window: tuple[int, int, int, int] | None,
    ) -> Camera:  # fmt: skip
        """Camera of a scene of a planet.

        Parameters
        ----------
        placed : Placed
            Observer and sun.
        size : (int, int)
            Width and height of the picture. [pixel]
        window : (int, int, int, int), optional
            Window to render. [pixel]
        """
        from airlight.scene import Camera

        zenith, azimuth = self._target(planet, placed)
        fov = None if self.fov is None or self.parallel else options.angle(self.fov, "--fov")
        polariser = self.polariser
        return Camera(
            projection=self.projection,
            width=size[0],
            height=size[1],
            field_of_view=fov,
            extent=self._extent(planet, size) if self.parallel else None,
            crop=window,
            look_zenith=zenith,
            look_azimuth=azimuth,
            roll=options.angle(self.roll, "--roll"),
            polariser=None if polariser is None else options.angle(polariser, "--polariser"),
        )

    def _extent(self, planet: Planet, size: tuple[int, int]) -> float:
        """Length from left to right of the picture; by default the whole disc. [m]"""
        from airlight.scene.projections.orthographic import disc_extent

        if self.fov is None:
            return disc_extent(planet.top_radius, *size)
        return options.length(self.fov, "--fov")

    def _target(self, planet: Planet, placed: Placed) -> tuple[float | None, float]:
        """Direction of the camera: zenith angle, None for the projection's own, and azimuth. [deg]

        Notes
        -----
        Default of a perspective: the horizon.
        """
        from airlight.scene import look_at

        given = self.direction()
        if given is not None:
            return given
        if self.look_at is None and self.projection != "perspective":
            return None, 0.0
        try:
            zenith, azimuth = look_at(
                self.look_at or "horizon",
                altitude=max(placed.altitude, 0.0),
                sun_zenith=placed.sun_zenith,
                bottom_radius=planet.bottom_radius,
                sun_azimuth=placed.sun_azimuth,
                moon=None if placed.moon is None else (placed.moon.zenith, placed.moon.azimuth),
                planet=planet,
            )
        except ParameterError as error:
            raise error.named("--look-at") from None
        return zenith, azimuth if self.look_at is not None else _ACROSS
