"""``airlight sky``: environment map of an observer's sky for another renderer."""

from __future__ import annotations

import math
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Literal

from airlight.cli import options
from airlight.cli.console import examples, say, shown_progress
from airlight.cli.display_options import DisplayOptions
from airlight.cli.light_options import LightOptions
from airlight.cli.option_groups import (
    REQUIRED,
    OptionGroup,
    given_options,
    named_errors,
    option,
)
from airlight.cli.place_options import PlaceOptions, check_coordinates, on_floor
from airlight.cli.planet_options import GroundOptions
from airlight.cli.solve_options import RenderOptions
from airlight.errors import ConflictError, ParameterError
from airlight.physics.units import quantity

if TYPE_CHECKING:
    from airlight.engines.environment.consumers import Consumer
    from airlight.engines.environment.disc import Disc
    from airlight.engines.environment.environment_map import EnvironmentMap
    from airlight.engines.environment.files import WrittenMap

EPILOG = examples(
    "airlight sky earth --for blender -o sky.exr",
    "airlight sky earth --for mitsuba --sun light --sun-zenith 88 -o evening.exr",
    "airlight sky mars --for usd --up z --sun light --ground black -o mars.exr",
    "airlight sky earth --for unity --sun light -o sky.hdr",
    "airlight sky earth --for godot --precision half --compression dwa -o sky.exr",
    "airlight sky earth --at 59.33N,18.07E --time 2026-06-21T18:10+02:00 --for three -o sky.exr",
    "airlight sky earth --for dome --front 180 --tilt 15 --size 4096 --bits 16 -o dome.png",
)


@dataclass(frozen=True, kw_only=True)
class ProgramOptions(OptionGroup):
    """Options of the program that reads the map."""

    for_: Literal["blender", "mitsuba", "usd", "godot", "three", "unity", "pbrt", "dome"] = option(
        "Target program; sets orientation and axes.", default=REQUIRED
    )
    front: float | None = option("Dome: bearing of its bottom, S or 180.", "BEARING")
    tilt: float | None = option("Dome: tilt towards its front (0deg).", "ANGLE")
    up: Literal["y", "z"] | None = option("USD: up axis of the layer (y).")

    def consumer(self) -> Consumer:
        """Target program of ``--for``, with the front of a dome or the up axis of USD."""
        from airlight.engines.environment.consumers import consumer_named

        consumer = consumer_named(self.for_)
        if self.up is not None:
            if self.for_ != "usd":
                raise ConflictError("--up", "requires --for usd")
            consumer = consumer.with_up(self.up)
        if consumer.tilt is None:
            for given in given_options(self, "front", "tilt"):
                raise ConflictError(given, "requires --for dome")
            return consumer
        with named_errors("front", "tilt"):
            front = consumer.centre if self.front is None else self.front
            return consumer.facing(front, self.tilt or 0.0)


@dataclass(frozen=True, kw_only=True)
class MapOptions(OptionGroup):
    """Options of the map and its file."""

    output: Path = option(
        "Output map: linear .exr or .hdr, or .png.", "FILE", REQUIRED, flags=("--output", "-o")
    )
    sun: Literal["include", "exclude", "light"] = option(
        "Discs of sun and moon: in the map, excluded, or separate lights in the JSON (usd and "
        "mitsuba: in a scene).",
        default="include",
    )
    ground: Literal["neutral", "map", "black"] = option(
        "Lower half of the map: grey of the ground's albedo, the planet's map, or black.",
        default="neutral",
    )
    size: str | None = option("Map width (2048; 1024 if square).", "N")
    precision: Literal["float", "half"] = option("Number format of EXR channels.", default="float")
    compression: Literal["zip", "dwa", "none"] = option(
        "EXR compression; dwa is lossy.", default="zip"
    )
    scale: str = option(
        "Factor of the stored radiances, recorded in the header and the JSON; auto: 1, or a power "
        "of two that fits half floats.",
        "auto|FACTOR",
        "auto",
    )
    overwrite: options.Overwrite = False

    def factor(self) -> float | None:
        """Factor of ``--scale``; None for auto."""
        suffix = self.output.suffix.lower()
        linear = ("precision", "compression", *(["scale"] if suffix == ".png" else []))
        for given in given_options(self, *linear) if suffix != ".exr" else ():
            raise ConflictError(given, f"does not apply to {suffix} files")
        if self.scale.strip().lower() == "auto":
            return None
        value = quantity(self.scale, "1", "--scale")
        if not 0.0 < value < math.inf:
            raise ParameterError("--scale", self.scale, "auto, or a number above 0")
        return value


def sky(
    planet: GroundOptions,
    picture: MapOptions,
    program: ProgramOptions,
    place: PlaceOptions,
    lights: LightOptions,
    display: DisplayOptions,
    solve: RenderOptions,
) -> None:
    """Write an observer's sky as an environment map, with a JSON file of its lights.

    The map follows the program's axes: x east, y north, z up or, where y is up, x east and -z north
    (Unity: z north). By default the observer is 2 m above the ground, and the sun in the south at a
    zenith angle of 60deg.
    """
    started = time.perf_counter()
    from airlight.engines.environment.environment_map import environment_map
    from airlight.engines.environment.files import check_beside, write_map
    from airlight.scene import Camera

    consumer = program.consumer()
    check_beside(picture.output, consumer, overwrite=picture.overwrite)
    display.check(picture.output.suffix.lower())
    factor = picture.factor()
    columns, rows = options.picture_size(picture.size, consumer.projection)
    world = planet.load()
    scene = place.scene(world)
    lights.check(world, consumer.projection)
    check_coordinates(place)
    on_floor(world, scene.altitude)
    camera = Camera(projection=consumer.projection, width=columns, height=rows)
    scene = replace(lights.added(scene), camera=camera)
    world = place.lit(world, scene)
    nm = solve.picture_nm(world)
    with shown_progress() as report:
        made = environment_map(
            world,
            scene,
            consumer,
            sun=picture.sun,
            ground=picture.ground,
            placed=place.timed or place.latitude is not None,
            local=planet.ground_albedo is None,
            wavelengths=nm,
            stars=lights.stars,
            progress=report,
            **solve.keywords(),
        )
    with named_errors("scale"):
        written = write_map(
            picture.output,
            made,
            precision=picture.precision,
            compression=picture.compression,
            scale=factor,
            overwrite=picture.overwrite,
            metadata=made.scene.metadata() | planet.changes(),
            display=display.keywords(),
        )
    if scene.time is not None:
        say(place.line(world, scene))
    _report(made, written, picture.precision, time.perf_counter() - started)


def _report(made: EnvironmentMap, written: WrittenMap, precision: str, seconds: float) -> None:
    """Text lines about the map and its lights."""
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
    """Note on a disc whose colour was outside sRGB."""
    share = disc.gamut_change
    return "" if share == 0.0 else f", mapped into sRGB: a channel by {share:.2g} of its luminance"
