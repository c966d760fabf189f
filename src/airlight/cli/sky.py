"""``airlight sky``: an observer's sky as an environment map for another renderer."""

from __future__ import annotations

import math
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from airlight.cli import options, second_lights, time_and_place
from airlight.cli.console import note, say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.environment.consumers import Consumer
    from airlight.environment.disc import Disc
    from airlight.environment.environment_map import EnvironmentMap
    from airlight.environment.files import WrittenMap

EPILOG = examples(
    "airlight sky earth --for blender -o sky.exr",
    "airlight sky earth --for mitsuba --sun light --sun-zenith 88 -o evening.exr",
    "airlight sky mars --for usd --up z --sun light --ground black -o mars.exr",
    "airlight sky earth --for unity --sun light -o sky.hdr",
    "airlight sky earth --for godot --precision half --compression dwa -o sky.exr",
    "airlight sky earth --at 59.33N,18.07E --time 2026-06-21T18:10+02:00 --for three -o sky.exr",
    "airlight sky earth --for dome --front 180 --tilt 15 --size 4096 --bits 16 -o dome.png",
)


def sky(
    planet: options.Planet_,
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", metavar="FILE", help="Output map: linear .exr or .hdr, or .png."
        ),
    ],
    for_: Annotated[
        Literal["blender", "mitsuba", "usd", "godot", "three", "unity", "pbrt", "dome"],
        typer.Option("--for", help="Target program; sets orientation and axes."),
    ],
    sun: Annotated[
        Literal["include", "exclude", "light"],
        typer.Option(
            help="Discs of sun and moon: in the map, excluded, or separate lights in the JSON (usd "
            "and mitsuba: in a scene)."
        ),
    ] = "include",
    ground: Annotated[
        Literal["neutral", "map", "black"],
        typer.Option(
            help="Lower half of the map: grey of the ground's albedo, the planet's map, or black."
        ),
    ] = "neutral",
    size: Annotated[
        str | None, typer.Option(metavar="N", help="Map width (2048; 1024 if square).")
    ] = None,
    front: Annotated[
        str | None, typer.Option(metavar="BEARING", help="Dome: bearing at its bottom, S or 180.")
    ] = None,
    tilt: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Dome: tilt towards its front (0deg).")
    ] = None,
    up: Annotated[
        Literal["y", "z"] | None, typer.Option(help="USD: up axis of the layer (y).")
    ] = None,
    precision: Annotated[
        Literal["float", "half"], typer.Option(help="Number format of EXR channels.")
    ] = "float",
    compression: Annotated[
        Literal["zip", "dwa", "none"], typer.Option(help="EXR compression; dwa is lossy.")
    ] = "zip",
    scale: Annotated[
        str,
        typer.Option(
            metavar="auto|FACTOR",
            help="Factor of the stored radiances, recorded in the header and the JSON; auto: 1, or "
            "a power of two that fits half floats.",
        ),
    ] = "auto",
    at: time_and_place.At = None,
    time_: time_and_place.Time = None,
    zone: time_and_place.Zone = None,
    season: time_and_place.Season = None,
    sun_distance: time_and_place.SunDistance = "true",
    altitude: Annotated[
        str | None, typer.Option(metavar="LENGTH", help="Observer altitude above ground (2m).")
    ] = None,
    sun_zenith: options.SunZenith = None,
    sun_azimuth: options.SunAzimuth = None,
    latitude: options.Latitude = None,
    longitude: options.Longitude = None,
    moon: second_lights.Moon = None,
    second_star: second_lights.SecondStar = None,
    stars: second_lights.Stars = False,
    wavelengths: options.Wavelengths = None,
    quality: options.Quality = "default",
    no_polarisation: options.NoPolarisation = False,
    device: options.Device = "cpu",
    exact: options.Exact = False,
    exposure: options.Exposure = None,
    tone_map: options.ToneMap = "natural",
    encoding: options.Encoding = "srgb",
    primaries: options.Primaries = "srgb",
    bits: options.Bits = 8,
    glare: options.Glare = 1.0,
    ground_albedo: options.GroundAlbedo = None,
    set_: options.Set = None,
    overwrite: options.Overwrite = False,
    no_cache: options.NoCache = False,
) -> None:
    """Write an observer's sky as an environment map, with a JSON file of its lights.

    The map shows east, north and zenith where the program looks for them: x east, y north, z up, or
    where y is up, x east and -z north (Unity: z north). Unless said otherwise the observer stands
    2 m above the ground, and the sun in the south, 60deg from the zenith.
    """
    started = time.perf_counter()
    from airlight.cli.render import check_glare, check_tone_map
    from airlight.environment.environment_map import environment_map
    from airlight.environment.files import check_beside, write_map
    from airlight.paint.render_scene import FEWEST
    from airlight.paint.star_points import check_stars
    from airlight.scene import Camera, Scene

    consumer = _consumer(for_, front, tilt, up)
    check_beside(output, consumer, overwrite=overwrite)
    suffix = output.suffix.lower()
    options.only_for_png(
        suffix, exposure, None, None, None, tone_map, encoding, primaries, bits, glare
    )
    ev = options.exposure("auto" if exposure is None else exposure)
    check_tone_map(tone_map)
    check_glare(glare)
    if bits not in (8, 16):
        raise ParameterError("--bits", bits, "8 or 16")
    factor = _scale(scale)
    if suffix != ".exr":
        linear: dict[str, tuple[str, str]] = {
            "--precision": (precision, "float"), "--compression": (compression, "zip"),
        }  # fmt: skip
        linear |= {"--scale": (scale, "auto")} if suffix == ".png" else {}
        for option, (value, left_out) in linear.items():
            if value != left_out:
                raise ConflictError(option, f"does not apply to {suffix} files")
    columns, rows = options.picture_size(size, consumer.projection)
    world = options.planet(planet, set_)
    if ground_albedo is not None:
        world = options.with_ground_albedo(world, ground_albedo)
    placed = time_and_place.given(
        world, at, time_, zone, season,
        {"--sun-zenith": sun_zenith, "--sun-azimuth": sun_azimuth, "--latitude": latitude,
         "--longitude": longitude}, altitude,
    )  # fmt: skip
    if stars:
        check_stars(world.body, consumer.projection, "--stars")
    somewhere = placed is not None or latitude is not None or longitude is not None
    for option, given, missing, other in (
        ("--latitude", latitude, "--longitude", longitude),
        ("--longitude", longitude, "--latitude", latitude),
    ):
        if given is not None and other is None:
            raise ConflictError(option, f"requires {missing}")
    if placed is None:
        placed = time_and_place.by_angles(sun_zenith, sun_azimuth, latitude, longitude, altitude)
    time_and_place.on_floor(world, placed.altitude)
    scene = Scene(
        camera=Camera(projection=consumer.projection, width=columns, height=rows),
        altitude=placed.altitude,
        sun_zenith=placed.sun_zenith,
        sun_azimuth=placed.sun_azimuth,
        latitude=placed.latitude,
        longitude=placed.longitude,
        time=placed.time,
        secondary_lights=second_lights.given(moon, second_star, placed),
    )
    if placed.time is not None:
        world = time_and_place.lit(world, placed, sun_distance)
    nm = None if wavelengths is None else options.wavelengths(wavelengths, world)
    if nm is not None and len(nm) < FEWEST:
        allowed = "rgb, 3 to 99, or three or more wavelengths: a map has colours"
        raise ParameterError("--wavelengths", wavelengths, allowed)

    def refused(reason: str) -> None:
        note(f"falling back to the CPU: {reason}")

    with shown_progress() as report:
        made = environment_map(
            world, scene, consumer, sun=sun, ground=ground, placed=somewhere,
            local=ground_albedo is None, wavelengths=nm, quality=quality,
            polarisation=not no_polarisation, device=device, exact=exact, stars=stars,
            cache=not no_cache, refused=refused, progress=report,
        )  # fmt: skip
    metadata = made.scene.metadata()
    metadata |= {"changes": "; ".join(set_)} if set_ else {}
    metadata |= {"ground_albedo": ground_albedo} if ground_albedo is not None else {}
    try:
        written = write_map(
            output, made, precision=precision, compression=compression, scale=factor,
            overwrite=overwrite,
            metadata=metadata,
            display={"exposure": ev, "tone_map": tone_map, "encoding": encoding,
                     "primaries": primaries, "bits": bits, "glare": glare},
        )  # fmt: skip
    except ParameterError as error:
        if error.field != "scale":
            raise
        raise error.named("--scale") from None
    if placed.time is not None:
        say(time_and_place.line(world, placed, sun_distance))
    _report(made, written, precision, time.perf_counter() - started)


def _consumer(name: str, front: str | None, tilt: str | None, up: str | None) -> Consumer:
    """Program of ``--for``, a dome with its front, USD with its axis."""
    from airlight.environment.consumers import consumer_named

    consumer = consumer_named(name)
    if up is not None:
        if name != "usd":
            raise ConflictError("--up", "requires --for usd")
        consumer = consumer.with_up(up)
    if consumer.tilt is None:
        for option, text in (("--front", front), ("--tilt", tilt)):
            if text is not None:
                raise ConflictError(option, "requires --for dome")
        return consumer
    bearing = consumer.centre
    if front is not None:
        bearing = options.bearing(front, "--front")
    try:
        return consumer.facing(bearing, 0.0 if tilt is None else options.angle(tilt, "--tilt"))
    except ParameterError as error:
        raise error.named(f"--{error.field}") from None


def _scale(text: str) -> float | None:
    """Factor of ``--scale``; None for auto."""
    if text.strip().lower() == "auto":
        return None
    from airlight.units import quantity

    value = quantity(text, "1", "--scale")
    if not 0.0 < value < math.inf:
        raise ParameterError("--scale", text, "auto, or a number above 0")
    return value


def _report(made: EnvironmentMap, written: WrittenMap, precision: str, seconds: float) -> None:
    """Lines about the map and its lights."""
    rows, columns = made.rgb.shape[:2]
    kind = f"{precision}, linear, scale {written.scale:g}"
    if written.exposure is not None:
        kind = f"exposure {written.exposure:+.2f} EV"
    size = written.path.stat().st_size / 1e3
    say(f"{written.path}  {columns}x{rows}  {size:.0f} kB  {seconds:.1f} s  {kind}")
    words = {"include": "in the map", "exclude": "excluded", "light": "a separate light"}
    for one in made.discs:
        east, north, up = one.direction
        bearing = math.degrees(math.atan2(east, north)) % 360.0
        say(
            f"{one.name}: bearing {bearing:.2f}°, elevation {math.degrees(math.asin(up)):.2f}°, "
            f"{one.angular_diameter:.3g}° wide, {one.illuminance:.4g} lx, {words[made.sun]}"
            + _moved(one)
        )
    if not made.discs:
        say("no disc of sun or moon is visible")
    if made.gamut.share > 0.0:
        say(
            f"outside sRGB: {100.0 * made.gamut.share:.3g} % of the sky's texels, mapped into it "
            f"at constant luminance, a channel by at most {made.gamut.largest:.3g} of that"
        )
    for path in written.beside:
        say(path)


def _moved(disc: Disc) -> str:
    """Remark on a disc whose colour was outside sRGB."""
    share = disc.gamut_change
    return "" if share == 0.0 else f", mapped into sRGB: a channel by {share:.2g} of its luminance"
