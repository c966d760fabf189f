"""``airlight view``: a planet in a window, every parameter live."""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Annotated, Literal

import typer

from airlight.cli import options
from airlight.cli.console import say
from airlight.cli.examples import examples
from airlight.errors import ConflictError, ParameterError

EPILOG = examples(
    "airlight view earth",
    "airlight view mars --altitude 2m --sun-zenith 88 --look 85,0",
    "airlight view my-planet.toml --compare earth",
    "airlight view earth --altitude 400km --size 1920x1080 --screenshot window.png",
)

#: Sides of a window. [logical pixel]
_SMALLEST, _LARGEST = 320, 8192


def view(
    planet: options.Planet_,
    compare: Annotated[
        str | None,
        typer.Option(metavar="OTHER", help="Second planet, side by side with a draggable divider."),
    ] = None,
    altitude: Annotated[
        str | None,
        typer.Option(metavar="LENGTH", help="Observer altitude above ground, e.g. 400km."),
    ] = None,
    look: Annotated[
        str | None,
        typer.Option(
            metavar="ZENITH,AZIMUTH",
            help="Camera direction; azimuth 0 is towards the sun, 90 to its right.",
        ),
    ] = None,
    look_at: Annotated[
        Literal["horizon", "nadir", "zenith", "sun"] | None,
        typer.Option(metavar="horizon|nadir|zenith|sun", help="Camera target, instead of --look."),
    ] = None,
    roll: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Camera roll, clockwise."),
    ] = None,
    sun_zenith: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Sun zenith angle at the observer.")
    ] = None,
    fov: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Horizontal field of view.")
    ] = None,
    projection: Annotated[
        str | None,
        typer.Option(
            metavar="NAME", help="Projection, except orthographic: {scene.projections:PROJECTIONS}."
        ),
    ] = None,
    size: Annotated[
        str, typer.Option(metavar="WxH", help="Window size, panels included.")
    ] = "1280x720",
    exposure: Annotated[
        str, typer.Option(metavar="EV|auto", help="Exposure compensation, a power of 2.")
    ] = "auto",
    tone_map: Annotated[
        str | None,
        typer.Option(metavar="NAME", help="Tone map: {color.tone_maps:TONE_MAPS}."),
    ] = None,
    glare: options.Glare = 1.0,
    quality: options.Quality = "default",
    latitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Observer latitude, for the ground map.")
    ] = None,
    longitude: Annotated[
        str | None,
        typer.Option(
            metavar="ANGLE", help="Observer longitude, east positive, for the ground map."
        ),
    ] = None,
    sun_azimuth: Annotated[
        str | None,
        typer.Option(metavar="BEARING", help="Compass bearing of the sun, for the ground map."),
    ] = None,
    device: Annotated[
        Literal["auto", "gpu", "cpu"],
        typer.Option(metavar="auto|gpu|cpu", help="Renderer."),
    ] = "auto",
    screenshot: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Write the window's contents to a .png, without opening it."
        ),
    ] = None,
    set_: options.Set = None,
) -> None:
    """Open an interactive viewer: fly, move the sun, edit parameters, probe radiances.

    F1 in the window lists mouse and key bindings. The first start compiles code, with progress.
    """
    started = time.perf_counter()
    from airlight.viewer.window.start import Start, show

    width, height = options.picture_size(size, "perspective")
    if not all(_SMALLEST <= side <= _LARGEST for side in (width, height)):
        allowed = f"sides of {_SMALLEST} to {_LARGEST} pixels"
        raise ParameterError("--size", size, allowed)
    if look is not None and look_at is not None:
        raise ConflictError("--look", "cannot be combined with --look-at")
    view = _view_values(
        numbers={
            "view.altitude": (altitude, options.length, "--altitude"),
            "view.roll": (roll, options.angle, "--roll"),
            "view.sun_zenith": (sun_zenith, options.angle, "--sun-zenith"),
            "view.field_of_view": (fov, options.angle, "--fov"),
            "view.latitude": (latitude, options.angle, "--latitude"),
            "view.longitude": (longitude, options.angle, "--longitude"),
            "view.sun_azimuth": (sun_azimuth, options.bearing, "--sun-azimuth"),
        },
        choices={
            "view.projection": projection and options.projection(projection),
            "display.tone_map": tone_map,
        },
        ev=options.exposure(exposure),
        quality=quality,
    )
    view["display.glare"] = glare
    show(
        Start(
            planet=planet,
            other=compare,
            changes=tuple(set_ or ()),
            view=view,
            look=None if look is None else options.direction(look, "--look"),
            look_at=look_at,
            size=(width, height),
            device=device,
            screenshot=screenshot,
        )
    )
    if screenshot is not None:
        size_kb = screenshot.stat().st_size / 1e3
        seconds = time.perf_counter() - started
        say(f"{screenshot}  {width}x{height}  {size_kb:.0f} kB  {seconds:.1f} s")


def _view_values(
    *,
    numbers: dict[str, tuple[str | None, Callable[[str, str], float], str]],
    choices: dict[str, str | None],
    ev: float | Literal["auto"],
    quality: str,
) -> dict[str, float | str | bool]:
    """Values of the view by path, of the specified options."""
    view: dict[str, float | str | bool] = {
        path: read(text, option)
        for path, (text, read, option) in numbers.items()
        if text is not None
    }
    view.update({path: choice for path, choice in choices.items() if choice is not None})
    view["display.automatic"] = ev == "auto"
    view["display.exposure"] = 0.0 if ev == "auto" else ev
    view["light.quality"] = quality
    return view
