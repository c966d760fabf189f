"""``airlight render``: picture of a planet or of a scene file."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from airlight.cli import options
from airlight.cli.camera_options import CameraOptions, Window
from airlight.cli.console import examples, say, shown_progress
from airlight.cli.display_options import DisplayOptions
from airlight.cli.light_options import LightOptions
from airlight.cli.option_groups import REQUIRED, OptionGroup, given_options, option
from airlight.cli.place_options import PlaceOptions, on_floor
from airlight.cli.planet_options import GroundOptions
from airlight.cli.scene_file import load_scene
from airlight.cli.solve_options import RenderOptions
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.planets.planet import Planet
    from airlight.render.picture import Written
    from airlight.scene import Scene
    from airlight.scene.frame import Frame

EPILOG = examples(
    "airlight render earth --altitude 400km --latitude 25 --longitude 30 --sun-zenith 72 "
    "--sun-azimuth ESE -o earth.png",
    "airlight render earth --altitude 35km --look-at horizon --fov 90 -o limb.png",
    "airlight render mars --altitude 2m --sun-zenith 80 --look 85,0 -o mars.png",
    "airlight render earth --star-temperature 3000K --sun-zenith 80 --look-at sun -o dwarf.png",
    "airlight render earth --altitude 2m --iso 100 --aperture f/8 --shutter 1/250s -o snap.png",
    "airlight render earth --altitude 0m --projection fisheye --size 2048 -o dome.exr",
    "airlight render my-planet.toml --wavelengths rgb --quality preview -o quick.png",
    "airlight render titan --device gpu --size 3840x2160 -o titan.png",
    "airlight render earth --at 59.33N,18.07E --time 2026-06-21T22:10+02:00 --look-at sun "
    "-o stockholm.png",
    "airlight render earth --at 46.5N,8E,2km --time '2026-12-21 civil-dusk' --look-at W -o a.png",
    "airlight render earth --at 54.5N,11E --time 2026-10-26T15:45Z --look-at moon --fov 10 "
    "-o rise.png",
    "airlight render earth --altitude 2m --sun-zenith 75 --look-at sun "
    "--second-star 80,12,3500K,0.4deg -o two.png",
    "airlight render lunar-eclipse --size 800x600 -o moon.png",
    "airlight render earth-moon --device gpu -o earthrise.png",
    "airlight render solar-eclipse-2017 --at 42.35N,3.7W --time 2026-08-12T18:29:20Z --look-at sun "
    "--fov 40 -o burgos.png",
    "airlight render mars --at 4.59S,137.44E --ls 250 --time sunset --look-at sun -o gale.png",
    "airlight render earth --altitude 2m --look 60,90 --polariser 90deg -o dark.png",
    "airlight render earth --altitude 2m --projection fisheye --show dolp -o degree.png",
    "airlight render earth --projection orthographic --sun-zenith 40 -o globe.png",
    "airlight render earth --at 31.5N,35.5E,-430m --time '2026-03-20 sunset' --look-at W "
    "-o dead-sea.png",
    "airlight render earth --size 16384x9216 --crop 4096,2048,1024,1024 -o tile.exr",
)


@dataclass(frozen=True, kw_only=True)
class PictureOptions(OptionGroup):
    """Options of the contents of a picture."""

    output: Path = option(
        "Output picture: .png, or linear .exr or .hdr.", "FILE", REQUIRED, flags=("--output", "-o")
    )
    show: Literal["dolp", "aolp"] | None = option(
        "Quantity shown instead of colours: degree or angle of linear polarisation, with a "
        "legend; a channel of an .exr.",
        "dolp|aolp",
    )
    stokes: bool = option("Stokes layers Q and U in an .exr.", default=False)
    ground: Literal["plain", "detailed"] = option(
        "Ground: plain (the map) or detailed (with decorative noise below the map's resolution).",
        "plain|detailed",
        "detailed",
    )

    def check_polarised(self, suffix: str, polariser: float | None, scalar: bool) -> None:
        """Raise an error for conflicting options of polarisation."""
        polarised = {"--polariser": polariser, **given_options(self, "show", "stokes")}
        for given in (name for name, value in polarised.items() if value is not None):
            if scalar:
                raise ConflictError(given, "cannot be combined with --no-polarisation")
            if given != "--polariser" and polariser is not None:
                raise ConflictError("--polariser", f"cannot be combined with {given}")
        if self.stokes and suffix != ".exr":
            raise ConflictError("--stokes", "requires an .exr file")
        if self.show is not None and suffix == ".hdr":
            raise ConflictError("--show", "requires a .png or .exr file")


def render(
    planet: GroundOptions,
    picture: PictureOptions,
    place: PlaceOptions,
    camera: CameraOptions,
    lights: LightOptions,
    display: DisplayOptions,
    solve: RenderOptions,
) -> None:
    """Render a planet's atmosphere, or a scene of several bodies and lights.

    Values may have units (400km, 85deg); the defaults are metres and degrees.
    """
    started = time.perf_counter()
    from airlight.render.picture import LINEAR, picture_suffix, write_picture
    from airlight.render.render_scene import render_scene
    from airlight.scene.system import is_scene_file

    suffix = picture_suffix(picture.output)
    display.check(suffix, picture.show is not None)
    picture.check_polarised(suffix, camera.polariser, solve.no_polarisation)
    options.projection(camera.projection)
    linear = suffix in LINEAR or picture.show is not None
    camera = camera.hazy(linear, is_scene_file(planet.planet))
    # The lens spreads light into a window from outside, and metering uses the whole picture.
    whole = suffix == ".png" and picture.show is None
    whole = whole and (display.settings().glare > 0.0 or display.ev == "auto")
    if is_scene_file(planet.planet):
        refused = {
            **given_options(picture, "show", "stokes", "ground"),
            **given_options(camera, "look"),
            **given_options(place, "sun_zenith", "sun_azimuth", "season", "sun_distance"),
            **given_options(planet, "ground_albedo", "star_temperature"),
            **given_options(solve, "exact", "no_polarisation"),
            **given_options(lights),
        }
        for given in refused:
            raise ConflictError(given, "is not available for scene files")
        frame, window = _scene_frame(planet, place, camera, solve, whole)
        metadata, line = frame.metadata, None
    else:
        scene, world, line = _planet_scene(planet, picture, place, camera, lights, whole)
        window = camera.window(scene.camera.width, scene.camera.height)
        nm = solve.picture_nm(world)
        with shown_progress() as report:
            frame = render_scene(
                world,
                scene,
                wavelengths=nm,
                samples=1 if camera.samples is None else camera.samples,
                stokes=picture.stokes or picture.show is not None,
                stars=lights.stars,
                local=planet.ground_albedo is None,
                progress=report,
                **solve.keywords(),
            )
        metadata = {"planet": world.name, **scene.metadata(), **planet.changes()}
    if picture.show is not None:
        written = _shown(picture.output, frame, picture.show, metadata)
    else:
        crop = window if whole else None
        written = write_picture(picture.output, frame, metadata, **display.keywords(), crop=crop)
    if line is not None:
        say(line)
    _report(written, frame, window, started)


def _planet_scene(
    planet: GroundOptions,
    picture: PictureOptions,
    place: PlaceOptions,
    camera: CameraOptions,
    lights: LightOptions,
    whole: bool,
) -> tuple[Scene, Planet, str | None]:
    """Scene, planet at its distance from the sun, and text line about place and time."""
    camera.check_parallel(place)
    world = planet.load()
    scene = place.scene(world)
    lights.check(world, camera.projection)
    size = options.picture_size(camera.size, camera.projection)
    window = camera.window(*size)
    if picture.show is not None and picture.output.suffix.lower() == ".png":
        _check_legend(size[0] if window is None else window[2])
    on_floor(world, scene.altitude)
    lit = place.lit(world, scene)
    line = place.line(lit, scene) if scene.time is not None else None
    scene = replace(lights.added(scene), ground=picture.ground)
    return camera.seen(scene, world, size, None if whole else window), lit, line


def _scene_frame(
    planet: GroundOptions,
    place: PlaceOptions,
    camera: CameraOptions,
    solve: RenderOptions,
    whole: bool,
) -> tuple[Frame, Window]:
    """Frame of a scene file, and its crop window."""
    from airlight.render.system_renderer import SystemRenderer

    system = load_scene(planet, place, camera)
    columns, rows = options.picture_size(camera.size, system.view.projection)
    window = camera.window(columns, rows)
    first = next(iter(system.planets.values()), None)
    if solve.wavelengths is not None and first is None:
        raise ConflictError("--wavelengths", "does not apply to a scene without air")
    renderer = SystemRenderer(
        wavelengths=None if first is None else solve.nm(first),
        samples=camera.samples,
        **{name: solve.keywords()[name] for name in ("device", "quality", "cache", "refused")},
    )
    crop = None if whole else window
    with shown_progress() as report:
        frame = renderer.render(system, width=columns, height=rows, crop=crop, progress=report)
    return frame, window


def _check_legend(width: int) -> None:
    """Raise an error for pictures too small for a legend."""
    from airlight.studies.plots.figure import require_matplotlib
    from airlight.studies.plots.polarised_picture import check_width

    require_matplotlib()
    try:
        check_width(width)
    except ParameterError as error:
        raise error.named("--size") from None


def _shown(
    output: Path, frame: Frame, show: Literal["dolp", "aolp"], metadata: dict[str, str]
) -> Written:
    """Write degree or angle of polarisation: a picture with a legend, or a channel of an EXR."""
    import numpy as np

    from airlight.image.png import write_png
    from airlight.render.picture import Written, write_picture
    from airlight.solver.stokes_frame import angle_of_polarisation, degree_of_polarisation
    from airlight.studies.plots.polarised_picture import COLOR_BARS, polarised_picture

    if output.suffix.lower() == ".exr":
        formula = degree_of_polarisation if show == "dolp" else angle_of_polarisation
        unit = "1" if show == "dolp" else "deg, in the frame of Q and U"
        layer = {str(show): formula(frame.stokes).astype(np.float32)}
        texts = {**metadata, show: f"of the luminance, unit {unit}"}
        return write_picture(output, frame, texts, layers=layer)
    pixels = polarised_picture(frame, show)
    write_png(output, pixels, {**frame.metadata, **metadata, "shown": COLOR_BARS[show].label})
    return Written(path=output, size=output.stat().st_size, exposure=None)


def _report(written: Written, frame: Frame, window: Window, started: float) -> None:
    """Text line about the written picture."""
    light = "linear" if written.exposure is None else f"exposure {written.exposure:+.2f} EV"
    seconds = time.perf_counter() - started
    rows, columns = frame.rgb.shape[:2] if window is None else (window[3], window[2])
    say(f"{written.path}  {columns}x{rows}  {written.size / 1e3:.0f} kB  {seconds:.1f} s  {light}")
