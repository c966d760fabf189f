"""``airlight view``: interactive viewer of a planet or a scene of several bodies."""

from __future__ import annotations

import time
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal

import typer

from airlight.cli import options
from airlight.cli.camera_options import DirectionOptions
from airlight.cli.console import examples, say
from airlight.cli.display_options import ToneOptions
from airlight.cli.option_groups import given_options, given_values, option
from airlight.cli.place_options import AngleOptions
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.solve_options import Device, Quality
from airlight.errors import ConflictError, ParameterError

EPILOG = examples(
    "airlight view earth",
    "airlight view mars --altitude 2m --sun-zenith 88 --look 85,0",
    "airlight view my-planet.toml --compare earth",
    "airlight view earth-moon",
    "airlight view earth --altitude 400km --size 1920x1080 --screenshot window.png",
)

#: Allowed widths and heights of a window. [logical pixel]
_SMALLEST, _LARGEST = 320, 8192


@dataclass(frozen=True, kw_only=True)
class ViewOptions(DirectionOptions):
    """Options of the camera and the size of the window."""

    look_at: Literal["horizon", "nadir", "zenith", "sun"] | None = option(
        "Camera target, instead of --look.", "horizon|nadir|zenith|sun"
    )

    def numbers(self) -> dict[str, float]:
        """Given roll and field of view by path. [deg]"""
        given = given_values(self, "roll")
        if self.fov is not None:
            given["field_of_view"] = options.angle(self.fov, "--fov")
        return {f"view.{name}": angle for name, angle in given.items()}


def view(
    planet: PlanetOptions,
    place: AngleOptions,
    camera: ViewOptions,
    display: ToneOptions,
    compare: Annotated[
        str | None,
        typer.Option(metavar="OTHER", help="Second planet, side by side with a draggable divider."),
    ] = None,
    quality: Quality = "default",
    device: Device = "auto",
    screenshot: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Write the window's contents to a .png, without opening it."
        ),
    ] = None,
) -> None:
    """Open an interactive viewer: fly, move the sun, edit parameters, probe radiances.

    F1 in the window lists mouse and key bindings. The first start compiles code, with progress.
    """
    started = time.perf_counter()
    from airlight.scene.system import is_scene_file
    from airlight.viewer.window.start import Start, show

    width, height = options.picture_size(camera.size, "perspective")
    if not all(_SMALLEST <= side <= _LARGEST for side in (width, height)):
        allowed = f"sides of {_SMALLEST} to {_LARGEST} pixels"
        raise ParameterError("--size", camera.size, allowed)
    if device == "cpu" and is_scene_file(planet.planet):
        raise ConflictError("--device", "must be gpu for scene files")
    look, ev = camera.direction(), display.ev
    view = {f"view.{name}": number for name, number in place.numbers().items()}
    words = {}
    if given_options(camera, "projection"):
        words["view.projection"] = options.projection(camera.projection)
    show(
        Start(
            planet=planet.planet,
            other=compare,
            changes=tuple(planet.overrides),
            view={
                **view,
                **camera.numbers(),
                **words,
                "display.automatic": ev == "auto",
                "display.exposure": 0.0 if ev == "auto" else ev,
                **{f"display.{name}": one for name, one in display.given_settings().items()},
                "light.quality": quality,
            },
            look=look,
            look_at=camera.look_at,
            size=(width, height),
            device=device,
            screenshot=screenshot,
        )
    )
    if screenshot is not None:
        size_kb = screenshot.stat().st_size / 1e3
        seconds = time.perf_counter() - started
        say(f"{screenshot}  {width}x{height}  {size_kb:.0f} kB  {seconds:.1f} s")
