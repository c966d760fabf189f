"""``airlight compose``: the air over a picture that another renderer drew."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import options, time_and_place
from airlight.cli.console import note, say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.cli.time_and_place import Placed
    from airlight.composition import Composed, Pinhole, Placement
    from airlight.exports.render_passes import RenderPasses
    from airlight.planets.planet import Planet

EPILOG = examples(
    "airlight compose render.exr --camera camera.json --planet earth -o composed.exr",
    "airlight compose render.exr --depth depth.exr --camera transforms.json --sun-zenith 80 "
    "--sun-azimuth 250 -o composed.exr",
    "airlight compose beauty.exr --depth depth.exr --depth-kind inverse --camera camera.json "
    "--altitude 1500m --metres-per-unit 0.01 -o composed.png",
    "airlight compose render.exr --camera camera.json --at 46.6N,8E --time '2026-07-01 sunset' "
    "-o sunset.png",
    "airlight compose render.exr --albedo render.exr --normals render.exr --camera camera.json "
    "-o lit.exr",
)


def compose(
    color: Annotated[
        Path,
        typer.Argument(
            metavar="COLOR.exr", help="Rendered picture without atmosphere, linear sRGB."
        ),
    ],
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", metavar="FILE", help="Output picture: linear .exr or .hdr, or .png."
        ),
    ],
    depth: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Depth pass, .exr (COLOR.exr)."),
    ] = None,
    depth_kind: Annotated[
        Literal["auto", "planar", "distance", "position", "inverse"],
        typer.Option(
            metavar="auto|planar|distance|position|inverse",
            help="Depth kind: planar (along the camera's axis), distance (along the ray), "
            "position, inverse (1 / planar), or auto (by the channel's name).",
        ),
    ] = "auto",
    depth_channel: Annotated[
        str | None, typer.Option(metavar="NAME", help="Channel of the depth, if it is not found.")
    ] = None,
    layer: Annotated[
        str | None, typer.Option(metavar="NAME", help="Layer of the colour, if there are several.")
    ] = None,
    albedo: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Albedo pass, to relight surfaces by the planet's sun and sky; requires "
            "--normals. An .exr with R, G, B or Blender's Diffuse Color; may be COLOR.exr.",
        ),
    ] = None,
    normals: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Normal pass in scene coordinates, an .exr with Normal; requires --albedo.",
        ),
    ] = None,
    shadow: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Shadow pass, visible fraction of the sun, 0 to 1; an .exr of one channel.",
        ),
    ] = None,
    camera: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE",
            help="Camera file transforms.json (default: worldToCamera and worldToNDC of "
            "COLOR.exr).",
        ),
    ] = None,
    planet: Annotated[
        str | None,
        typer.Option(
            metavar="PLANET",
            help="Planet: preset or TOML file (that of the camera file, or earth).",
        ),
    ] = None,
    at: time_and_place.At = None,
    time_: time_and_place.Time = None,
    zone: time_and_place.Zone = None,
    season: time_and_place.Season = None,
    sun_zenith: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Sun zenith angle at the scene's origin (60deg)."),
    ] = None,
    sun_azimuth: Annotated[
        str | None, typer.Option(metavar="BEARING", help="Compass bearing of the sun (S).")
    ] = None,
    latitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Latitude of the scene's origin (0deg).")
    ] = None,
    longitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Longitude of the scene's origin (0deg).")
    ] = None,
    altitude: Annotated[
        str | None, typer.Option(metavar="LENGTH", help="Altitude of the scene's origin (0m).")
    ] = None,
    heading: Annotated[
        str | None,
        typer.Option(metavar="BEARING", help="Compass bearing of the scene's +Y: NE, 45deg (N)."),
    ] = None,
    metres_per_unit: Annotated[
        float | None,
        typer.Option(metavar="NUMBER", help="Length of the scene's unit in metres (1)."),
    ] = None,
    up: Annotated[
        Literal["z", "y"] | None, typer.Option(metavar="z|y", help="Up axis of the scene (z).")
    ] = None,
    white: Annotated[
        str,
        typer.Option(
            metavar="NUMBER|radiance",
            help="Pixel value of a white surface facing the sun outside the atmosphere; or "
            "radiance, for pixels in W m⁻² sr⁻¹.",
        ),
    ] = "1",
    exact: Annotated[
        bool,
        typer.Option("--exact", help="Ray-march every pixel, without froxels."),
    ] = False,
    disc: Annotated[bool, typer.Option("--disc/--no-disc", help="Solar disc in the sky.")] = True,
    exposure: Annotated[
        str, typer.Option(metavar="EV|auto", help="PNG: exposure compensation, a power of 2.")
    ] = "auto",
    tone_map: Annotated[
        str, typer.Option(metavar="NAME", help="PNG: tone map: {color.tone_maps:TONE_MAPS}.")
    ] = "natural",
    wavelengths: Annotated[
        str | None,
        typer.Option(metavar="rgb|N|LIST", help="Wavelengths, as for render (16)."),
    ] = None,
    quality: options.Quality = "default",
    no_polarisation: options.NoPolarisation = False,
    set_: options.Set = None,
    no_cache: options.NoCache = False,
) -> None:
    """Composite a planet's atmosphere over a rendered picture by its depth pass.

    The picture stays on its own scale of brightness; see docs/compose.md.
    """
    started = time.perf_counter()
    from airlight.exports.picture import picture_suffix
    from airlight.exports.render_passes import read_render_passes

    suffix = picture_suffix(output)
    ev = options.exposure(exposure)
    per_white = _white(white)
    passes = read_render_passes(color)
    holder = passes if depth is None else read_render_passes(depth)
    try:
        rgb, alpha = passes.colors(layer)
        away, kind = holder.depth(depth_kind, depth_channel)
    except ParameterError as error:
        if error.field not in ("layer", "depth_channel"):
            raise
        raise error.named("--" + error.field.replace("_", "-")) from None
    surfaces = _surfaces(albedo, normals, shadow)
    pinhole, block = _camera(camera, color, passes)
    texts = {
        "sun_zenith": sun_zenith, "sun_azimuth": sun_azimuth, "latitude": latitude,
        "longitude": longitude, "heading": heading,
    }  # fmt: skip
    world = options.planet(planet or block.get("planet", "earth"), set_)
    angles = {f"--{name.replace('_', '-')}": text for name, text in texts.items()}
    del angles["--heading"]
    placed = time_and_place.given(world, at, time_, zone, season, angles, altitude)
    if placed is not None:
        world = time_and_place.lit(world, placed, "true")
    place = _placement(block, texts, altitude, metres_per_unit, up, placed, at)
    solution = _solved(
        world, place, wavelengths, quality, polarisation=not no_polarisation, cache=not no_cache
    )
    from airlight.composition import compose as composed_over

    with shown_progress() as report:
        composed = composed_over(
            rgb, away, pinhole, solution, place, alpha=alpha, depth_kind=kind, white=per_white,
            exact=exact, disc=disc, progress=report, **surfaces,
        )  # fmt: skip
    metadata = {
        "planet": solution.planet.name,
        "picture": color.name,
        "depth_kind": kind,
        "white": white,
        "altitude": f"{composed.scene.altitude:.10g} m",
        "sun_zenith": f"{composed.scene.sun_zenith:.10g} deg",
        **({"changes": "; ".join(set_)} if set_ else {}),
    }
    _write(output, suffix, composed, metadata, ev, tone_map)
    seconds = time.perf_counter() - started
    width, height = pinhole.width, pinhole.height
    how = f"{100.0 * composed.marched:.0f} % of the surfaces marched"
    if composed.error > 0.0:
        how += f", others within {100.0 * composed.error:.2f} %"
    say(f"{output}  {width}x{height}  {seconds:.1f} s  depth {kind}  {how}")
    if solution.report.ground:
        note(solution.report.ground)


def _surfaces(albedo: Path | None, normals: Path | None, shadow: Path | None) -> dict[str, Any]:
    """Passes by which surfaces are lit anew, as arguments of ``airlight.compose``."""
    from airlight.exports.render_passes import read_render_passes

    for option, one, other, required in (
        ("--albedo", albedo, normals, "--normals"), ("--normals", normals, albedo, "--albedo"),
        ("--shadow", shadow, albedo, "--albedo and --normals"),
    ):  # fmt: skip
        if one is not None and other is None:
            raise ConflictError(option, f"requires {required}")
    if albedo is None or normals is None:
        return {}
    found: dict[str, Any] = {
        "albedo": read_render_passes(albedo).vectors("RGB", ("Diffuse Color", "DiffCol", "")),
        "normals": read_render_passes(normals).vectors("XYZ", ("Normal", "N", "")),
    }
    if shadow is not None:
        found["shadow"] = read_render_passes(shadow).only()
    return found


def _white(text: str) -> float | None:
    """Parse ``--white``: a number above 0, or None for radiance."""
    if text.strip().lower() == "radiance":
        return None
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 < value < 1e30:
        raise ParameterError("--white", text, "a number above 0, or radiance")
    return value


def _camera(file: Path | None, color: Path, passes: RenderPasses) -> tuple[Pinhole, dict[str, Any]]:
    """Camera of the picture, in its size, and the block that places the scene."""
    from airlight.composition.pinhole import camera_from_json, camera_from_matrices

    width, height = passes.size
    if file is not None:
        found, block = camera_from_json(file, str(color), size=passes.size)
        try:
            return found.sized(width, height), block
        except ParameterError as error:
            raise error.in_file(file) from None
    to_camera, to_ndc = (passes.header.get(name) for name in ("worldToCamera", "worldToNDC"))
    if to_camera is None or to_ndc is None:
        raise ConflictError("--camera", f"is required: {color} lacks worldToCamera and worldToNDC")
    return camera_from_matrices(to_camera, to_ndc, width, height), {}


def _placement(
    block: dict[str, Any],
    texts: dict[str, str | None],
    altitude: str | None,
    metres_per_unit: float | None,
    up: str | None,
    placed: Placed | None,
    at: str | None,
) -> Placement:
    """Placement by the camera's block, with the options in place of what they replace."""
    from airlight.composition import Placement

    given: dict[str, float | str | None] = {"metres_per_unit": metres_per_unit, "up": up}
    for name, text in texts.items():
        option = "--" + name.replace("_", "-")
        parse = options.bearing if name in ("heading", "sun_azimuth") else options.angle
        given[name] = None if text is None else parse(text, option)
    given["altitude"] = None if altitude is None else options.length(altitude, "--altitude")
    if placed is not None:
        for name in ("latitude", "longitude", "sun_zenith", "sun_azimuth"):
            given[name] = getattr(placed, name)
        if at is not None and at.count(",") > 1:  # with an altitude
            given["altitude"] = placed.altitude
    try:
        return Placement.from_block(block, **given)
    except ParameterError as error:
        if given.get(error.field) is None:
            raise
        option = "--" + error.field.replace("_", "-")
        raise error.named(option) from None


def _solved(
    world: Planet,
    place: Placement,
    wavelengths: str | None,
    quality: str,
    *,
    polarisation: bool,
    cache: bool,
) -> Any:
    """Solution of the planet for the ground around the scene."""
    from airlight.paint.render_scene import FEWEST
    from airlight.paint.solve_planet import solve_planet
    from airlight.scene.local_ground import local_ground

    nm = None if wavelengths is None else options.wavelengths(wavelengths, world)
    if nm is not None and len(nm) < FEWEST:
        allowed = "rgb, 3 to 99, or three or more wavelengths: a picture has colours"
        raise ParameterError("--wavelengths", wavelengths, allowed)
    world = local_ground(
        world, latitude=place.latitude, longitude=place.longitude,
        altitude=max(place.altitude, 0.0),
    )  # fmt: skip
    with shown_progress() as report:
        return solve_planet(
            world, nm, quality, polarisation=polarisation, cache=cache, progress=report
        )


def _write(
    output: Path,
    suffix: str,
    composed: Composed,
    metadata: dict[str, str],
    exposure: float | str,
    tone_map: str,
) -> None:
    """Write the picture: linear on the scale of the given one, or exposed."""
    from airlight.exports.picture import LINEAR

    if suffix in LINEAR:
        from airlight.color.xyz import luminance
        from airlight.constants import LUMINOUS_EFFICACY
        from airlight.exports.exr import write_exr
        from airlight.exports.hdr import write_hdr

        scale = ", ".join(f"{one:.6g}" for one in composed.scale)
        note = {"radiance_of_1": f"{scale} W m-2 sr-1, linear sRGB"}
        if suffix == ".hdr":
            write_hdr(output, composed.rgb, metadata | note)
            return
        white = LUMINOUS_EFFICACY * float(luminance(composed.scale))
        write_exr(output, composed.rgb, metadata | note, attributes={"whiteLuminance": white})
        return
    from airlight.exports.picture import write_picture

    write_picture(output, composed.frame, metadata, exposure=exposure, tone_map=tone_map)
