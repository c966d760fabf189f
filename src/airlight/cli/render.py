"""``airlight render``: a planet file, or a scene file, becomes a picture."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from airlight.cli import options, scene_file, second_lights, time_and_place, whole_disc
from airlight.cli.console import note, say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import ConflictError, ParameterError

if TYPE_CHECKING:
    from airlight.cli.time_and_place import Placed
    from airlight.exports.picture import Written
    from airlight.paint.rendering_gpu import Choice
    from airlight.planets.planet import Planet
    from airlight.scene import Scene
    from airlight.scene.frame import Frame

EPILOG = examples(
    "airlight render earth --altitude 400km --latitude 25 --longitude 30 --sun-zenith 72 "
    "--sun-azimuth ESE -o earth.png",
    "airlight render earth --altitude 35km --look-at horizon --fov 90 -o limb.png",
    "airlight render mars --altitude 2m --sun-zenith 80 --look 85,0 -o mars.png",
    "airlight render earth --altitude 2m --iso 100 --aperture f/8 --shutter 1/250s -o snap.png",
    "airlight render earth --altitude 0m --projection fisheye --size 2048 -o dome.exr",
    "airlight render my-planet.toml --wavelengths rgb --quality preview -o quick.png",
    "airlight render titan --device gpu --size 3840x2160 -o titan.png",
    "airlight render earth --at 59.33N,18.07E --time 2026-06-21T22:10+02:00 --look-at sun "
    "-o stockholm.png",
    "airlight render earth --at 46.5N,8E,2km --time '2026-12-21 civil-dusk' --look-at W -o a.png",
    "airlight render earth --at 54.5N,11E --time 2026-10-26T16:00Z --look-at moon --fov 20 "
    "-o rise.png",
    "airlight render earth --altitude 2m --sun-zenith 75 --look-at sun "
    "--second-star 80,12,3500K,0.4deg -o two.png",
    "airlight render lunar-eclipse --size 800x600 -o moon.png",
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

#: Default azimuth of the camera: across the sunlight, which shows the atmosphere best. [deg]
_ACROSS = -75.0


def render(
    planet: options.Planet_,
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", metavar="FILE", help="Output picture: .png, or linear .exr or .hdr."
        ),
    ],
    at: time_and_place.At = None,
    time_: time_and_place.Time = None,
    zone: time_and_place.Zone = None,
    season: time_and_place.Season = None,
    sun_distance: time_and_place.SunDistance = "true",
    altitude: Annotated[
        str | None,
        typer.Option(
            metavar="LENGTH",
            help="Observer altitude above ground, e.g. 10m (2m).",
        ),
    ] = None,
    look: Annotated[
        str | None,
        typer.Option(
            metavar="ZENITH,AZIMUTH",
            help="Camera direction; azimuth 0 is towards the sun, 90 to its right. Default: the "
            "horizon at azimuth -75; the zenith for a fisheye.",
        ),
    ] = None,
    look_at: Annotated[
        str | None,
        typer.Option(
            metavar="horizon|nadir|zenith|sun|moon|BEARING",
            help="Camera target, instead of --look: moon requires --time; a compass bearing is NE "
            "or 315, with an elevation 315/20.",
        ),
    ] = None,
    roll: Annotated[str, typer.Option(metavar="ANGLE", help="Camera roll, clockwise.")] = "0deg",
    polariser: Annotated[
        str | None,
        typer.Option(
            metavar="ANGLE",
            help="Axis of an ideal polarising filter in front of the camera, counterclockwise "
            "from the camera's up.",
        ),
    ] = None,
    show: Annotated[
        Literal["dolp", "aolp"] | None,
        typer.Option(
            metavar="dolp|aolp",
            help="Quantity shown instead of colours: degree or angle of linear polarisation, "
            "with a legend; a channel of an .exr.",
        ),
    ] = None,
    stokes: Annotated[
        bool,
        typer.Option("--stokes", help="Stokes layers Q and U in an .exr."),
    ] = False,
    sun_zenith: options.SunZenith = None,
    moon: second_lights.Moon = None,
    second_star: second_lights.SecondStar = None,
    stars: second_lights.Stars = False,
    fov: Annotated[
        str | None,
        typer.Option(
            metavar="ANGLE",
            help="Field of view: horizontal (60deg); of a fisheye across the circle (180deg); of "
            "orthographic a width, e.g. 14000km (the whole disc).",
        ),
    ] = None,
    projection: Annotated[
        str,
        typer.Option(
            metavar="NAME",
            help="Projection: {scene.projections:PROJECTIONS}. orthographic shows the planet's "
            "disc, north up.",
        ),
    ] = "perspective",
    size: Annotated[
        str | None,
        typer.Option(
            metavar="WxH",
            help="Picture size, e.g. 1280x720; one number: side of a square or cube face, or "
            "width of a panorama.",
        ),
    ] = None,
    crop: Annotated[
        str | None,
        typer.Option(
            metavar="X,Y,W,H",
            help="Window of the picture to render, in pixels from the left and top edge. Only it "
            "is computed for an .exr or .hdr, or with --exposure EV and --glare 0.",
        ),
    ] = None,
    exposure: options.Exposure = None,
    iso: Annotated[
        float | None,
        typer.Option(
            metavar="ISO", help="Camera sensitivity, e.g. 100; requires --aperture and --shutter."
        ),
    ] = None,
    aperture: Annotated[
        str | None, typer.Option(metavar="F", help="Camera aperture, e.g. f/8.")
    ] = None,
    shutter: Annotated[
        str | None, typer.Option(metavar="TIME", help="Camera shutter time, e.g. 1/250s.")
    ] = None,
    tone_map: options.ToneMap = "natural",
    encoding: options.Encoding = "srgb",
    primaries: options.Primaries = "srgb",
    bits: options.Bits = 8,
    glare: options.Glare = 1.0,
    wavelengths: options.Wavelengths = None,
    quality: options.Quality = "default",
    no_polarisation: options.NoPolarisation = False,
    device: options.Device = "cpu",
    exact: options.Exact = False,
    samples: Annotated[
        int,
        typer.Option(
            metavar="N",
            help="Samples per side of each pixel, up to 16; the horizon is antialiased anyway.",
        ),
    ] = 1,
    latitude: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Observer latitude, for the ground map, e.g. 25deg."),
    ] = None,
    longitude: Annotated[
        str | None,
        typer.Option(
            metavar="ANGLE",
            help="Observer longitude, east positive, for the ground map, e.g. 30deg.",
        ),
    ] = None,
    sun_azimuth: options.SunAzimuth = None,
    ground: Annotated[
        Literal["plain", "detailed"],
        typer.Option(
            metavar="plain|detailed",
            help="Ground: plain (the map) or detailed (with decorative noise below the map's "
            "resolution).",
        ),
    ] = "detailed",
    ground_albedo: options.GroundAlbedo = None,
    set_: options.Set = None,
    no_cache: options.NoCache = False,
) -> None:
    """Render a planet's atmosphere, or a scene of several bodies and lights.

    Numbers carry their units (400km, 85deg); without one they are metres and degrees.
    """
    started = time.perf_counter()
    from airlight.exports.picture import picture_suffix, write_picture
    from airlight.system import is_scene_file

    suffix = picture_suffix(output)
    options.only_for_png(
        suffix, exposure, iso, aperture, shutter, tone_map, encoding, primaries, bits, glare,
        show is not None,
    )  # fmt: skip
    _check_polarised(suffix, polariser, show, stokes, no_polarisation)
    legend = show is not None and suffix == ".png"
    ev = options.camera(exposure, iso, aperture, shutter)
    check_tone_map(tone_map)
    check_glare(glare)
    projection = options.projection(projection)
    # A lens spreads light into a window from outside, and the meter reads the whole picture.
    whole = suffix == ".png" and show is None and (glare > 0.0 or ev == "auto")
    if is_scene_file(planet):
        for option, value in (("--show", show), ("--stokes", stokes or None)):
            if value is not None:
                raise ConflictError(option, "is not available for scene files")
        given = scene_file.SceneOptions(
            at=at, time=time_, zone=zone, altitude=altitude, latitude=latitude,
            longitude=longitude, look_at=look_at, fov=fov, polariser=polariser, changes=set_,
            roll=roll if roll != "0deg" else None,
            projection=projection if projection != "perspective" else None,
        )  # fmt: skip
        frame, window = scene_file.rendered(
            planet, given, size, crop, wavelengths, quality, samples if samples > 1 else None,
            whole=whole, cache=not no_cache,
            excluded={
                "--look": look, "--sun-zenith": sun_zenith, "--sun-azimuth": sun_azimuth,
                "--ground-albedo": ground_albedo, "--ls": season, "--exact": exact,
                "--no-polarisation": no_polarisation,
                "--device": device if device == "gpu" else None,
                "--ground": ground if ground != "detailed" else None,
                "--moon": moon, "--second-star": second_star,
                "--stars": True if stars else None,
                "--sun-distance": sun_distance if sun_distance != "true" else None,
            },
        )  # fmt: skip
        written = write_picture(
            output, frame, frame.metadata, exposure=ev, tone_map=tone_map, encoding=encoding,
            primaries=primaries, bits=bits, glare=glare, crop=window if whole else None,
        )  # fmt: skip
        _report(written, frame, window, started)
        return
    world = options.planet(planet, set_)
    if ground_albedo is not None:
        world = options.with_ground_albedo(world, ground_albedo)
    placed = time_and_place.given(
        world, at, time_, zone, season,
        {"--sun-zenith": sun_zenith, "--sun-azimuth": sun_azimuth, "--latitude": latitude,
         "--longitude": longitude}, altitude,
    )  # fmt: skip
    parallel = whole_disc.check(
        projection, {"--altitude": altitude, "--look": look, "--look-at": look_at}, at
    )
    if stars:
        from airlight.paint.star_points import check_stars

        check_stars(world.body, projection, "--stars")
    if placed is None:
        placed = time_and_place.by_angles(sun_zenith, sun_azimuth, latitude, longitude, altitude)
    columns, rows = options.picture_size(size, projection)
    window = options.crop(crop, columns, rows)
    if legend:
        _check_legend(columns if window is None else window[2])
    zenith, azimuth = _target(look, look_at, projection, placed, world)
    from airlight.scene import Camera, Scene

    time_and_place.on_floor(world, placed.altitude)
    scene = Scene(
        camera=Camera(
            projection=projection,
            width=columns,
            height=rows,
            field_of_view=None if fov is None or parallel else options.angle(fov, "--fov"),
            extent=whole_disc.extent(fov, world, columns, rows) if parallel else None,
            crop=None if whole else window,
            look_zenith=zenith,
            look_azimuth=azimuth,
            roll=options.angle(roll, "--roll"),
            polariser=None if polariser is None else options.angle(polariser, "--polariser"),
        ),
        altitude=0.0 if parallel else placed.altitude,
        sun_zenith=placed.sun_zenith,
        latitude=placed.latitude,
        longitude=placed.longitude,
        sun_azimuth=placed.sun_azimuth,
        ground=ground,
        time=placed.time,
        secondary_lights=second_lights.given(moon, second_star, placed),
    )
    if parallel:
        scene = scene.north_up()
    if placed.time is not None:
        world = time_and_place.lit(world, placed, sun_distance)
    frame = _rendered(
        world, scene, wavelengths, quality, device, polarisation=not no_polarisation, exact=exact,
        samples=samples, stokes=stokes or show is not None, stars=stars, cache=not no_cache,
        local=ground_albedo is None,
    )  # fmt: skip
    changes = {"changes": "; ".join(set_)} if set_ else {}
    if ground_albedo is not None:
        changes["ground_albedo"] = ground_albedo
    metadata = {"planet": world.name, **scene.metadata(), **changes}
    if show is not None:
        written = _shown(output, frame, show, metadata)
    else:
        written = write_picture(
            output, frame, metadata, exposure=ev, tone_map=tone_map, encoding=encoding,
            primaries=primaries, bits=bits, glare=glare, crop=window if whole else None,
        )  # fmt: skip
    if placed.time is not None:
        say(time_and_place.line(world, placed, sun_distance))
    _report(written, frame, window, started)


def _check_polarised(
    suffix: str, polariser: str | None, show: str | None, stokes: bool, scalar: bool
) -> None:
    """Refuse options of polarised light that contradict each other, or the file."""
    given = {"--polariser": polariser, "--show": show, "--stokes": stokes or None}
    for option in (option for option, value in given.items() if value is not None):
        if scalar:
            raise ConflictError(option, "cannot be combined with --no-polarisation")
        if option != "--polariser" and polariser is not None:
            raise ConflictError("--polariser", f"cannot be combined with {option}")
    if stokes and suffix != ".exr":
        raise ConflictError("--stokes", "requires an .exr file")
    if show is not None and suffix == ".hdr":
        raise ConflictError("--show", "requires a .png or .exr file")


def _check_legend(width: int) -> None:
    """Refuse pictures without room for a legend, before any long work."""
    from airlight.plots.figure import require_matplotlib
    from airlight.plots.polarised_picture import check_width

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

    from airlight.exports.picture import Written, write_picture
    from airlight.exports.png import write_png
    from airlight.plots.polarised_picture import COLOR_BARS, polarised_picture
    from airlight.solvers.stokes_frame import angle_of_polarisation, degree_of_polarisation

    if output.suffix.lower() == ".exr":
        formula = degree_of_polarisation if show == "dolp" else angle_of_polarisation
        unit = "1" if show == "dolp" else "deg, in the frame of Q and U"
        layer = {str(show): formula(frame.stokes).astype(np.float32)}
        texts = {**metadata, show: f"of the luminance, unit {unit}"}
        return write_picture(output, frame, texts, layers=layer)
    pixels = polarised_picture(frame, show)
    write_png(output, pixels, {**frame.metadata, **metadata, "shown": COLOR_BARS[show].label})
    return Written(path=output, size=output.stat().st_size, exposure=None)


def _report(
    written: Written, frame: Frame, window: tuple[int, int, int, int] | None, started: float
) -> None:
    """Line about the picture that was written."""
    light = "linear" if written.exposure is None else f"exposure {written.exposure:+.2f} EV"
    seconds = time.perf_counter() - started
    rows, columns = frame.rgb.shape[:2] if window is None else (window[3], window[2])
    say(f"{written.path}  {columns}x{rows}  {written.size / 1e3:.0f} kB  {seconds:.1f} s  {light}")


def _target(
    look: str | None,
    look_at: str | None,
    projection: str,
    placed: Placed,
    planet: Planet,
) -> tuple[float | None, float]:
    """Direction of the camera: zenith angle, None for the projection's own, and azimuth. [deg]"""
    from airlight.scene import look_at as looking_at

    if look is not None and look_at is not None:
        raise ConflictError("--look", "cannot be combined with --look-at")
    if look is not None:
        return options.direction(look, "--look")
    if look_at is None and projection != "perspective":
        return None, 0.0
    try:
        zenith, azimuth = looking_at(
            look_at or "horizon",
            altitude=max(placed.altitude, 0.0),
            sun_zenith=placed.sun_zenith,
            bottom_radius=planet.bottom_radius,
            sun_azimuth=placed.sun_azimuth,
            moon=None if placed.moon is None else (placed.moon.zenith, placed.moon.azimuth),
            planet=planet,
        )
    except ParameterError as error:
        raise error.named("--look-at") from None
    return zenith, azimuth if look_at is not None else _ACROSS


def _rendered(
    planet: Planet,
    scene: Scene,
    wavelengths: str | None,
    quality: str,
    device: Choice,
    *,
    polarisation: bool,
    exact: bool,
    samples: int,
    stokes: bool,
    stars: bool,
    cache: bool,
    local: bool,
) -> Frame:
    """The frame, with progress on the standard error stream."""
    from airlight.paint.render_scene import FEWEST, render_scene

    nm = None if wavelengths is None else options.wavelengths(wavelengths, planet)
    if nm is not None and len(nm) < FEWEST:
        allowed = "rgb, 3 to 99, or three or more wavelengths: a picture has colours"
        raise ParameterError("--wavelengths", wavelengths, allowed)

    def refused(reason: str) -> None:
        note(f"falling back to the CPU: {reason}")

    with shown_progress() as report:
        return render_scene(
            planet, scene, wavelengths=nm, quality=quality, polarisation=polarisation,
            device=device, exact=exact, samples=samples, stokes=stokes, cache=cache, local=local,
            stars=stars, refused=refused, progress=report,
        )  # fmt: skip


def check_tone_map(name: str) -> None:
    """Refuse a tone map that does not exist."""
    from airlight.color.tone_maps import TONE_MAPS

    if name not in TONE_MAPS:
        raise ParameterError("--tone-map", name, ", ".join(TONE_MAPS))


def check_glare(amount: float) -> None:
    """Refuse an amount of glare out of range."""
    from airlight.color.glare import checked_amount

    checked_amount(amount, "--glare")
