"""``airlight animate``: a film of a planet or a scene becomes frames, and an MP4."""

from __future__ import annotations

import re
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import distribution_options, options
from airlight.cli.console import note, say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import FileError, ParameterError, WorkerError

if TYPE_CHECKING:
    from airlight.film import Animated

EPILOG = examples(
    "airlight animate earth --frames 90 --key 'view.sun_zenith=84deg,97deg' -o frames/ "
    "-o sunset.mp4",
    "airlight animate earth --start '2026-06-21T19:00Z' --end '2026-06-21T21:00Z' "
    "--set view.latitude=59.33deg --set view.longitude=18.07deg --set view.look_at=NW "
    "-o stockholm/",
    "airlight animate earth --key 'view.altitude=2m,400km smooth-exponential' "
    "--set view.projection=fisheye --size 4096 --bits 16 -o dome/",
    "airlight animate lunar-eclipse --frames 60 --start 2025-03-14T05:00Z --end 2025-03-14T09:00Z "
    "--size 800x600 -o eclipse/",
    "airlight animate my-film.toml --scheduler tcp://host:8786 -o frames/",
)


def animate(
    film: Annotated[
        str,
        typer.Argument(
            metavar="FILM", help="A film file, a scene or a planet: a preset or a TOML file."
        ),
    ],
    output: Annotated[
        list[Path],
        typer.Option(
            "--output",
            "-o",
            metavar="FOLDER|FILM.mp4",
            help="Folder of the frames; a second time, an MP4 of them too.",
        ),
    ],
    frames: Annotated[int | None, typer.Option(metavar="N", help="Number of frames (120).")] = None,
    rate: Annotated[
        float | None, typer.Option(metavar="N", help="Frames per second of the MP4 (30).")
    ] = None,
    start: Annotated[
        str | None,
        typer.Option(
            metavar="TIME", help="Of the first frame, as --time of render; the clock runs to --end."
        ),
    ] = None,
    end: Annotated[str | None, typer.Option(metavar="TIME", help="Of the last frame.")] = None,
    zone: Annotated[
        str | None, typer.Option(metavar="ZONE", help="Of times without one: Europe/Stockholm.")
    ] = None,
    key: Annotated[
        list[str] | None,
        typer.Option(
            metavar="PATH=A,B[,C …] [LAW]",
            help="Key frames of a number: 'view.altitude=2m,400km exponential'. Laws: linear, "
            "smooth, exponential, smooth-exponential. May be given several times.",
        ),
    ] = None,
    set_: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="PATH=VALUE",
            help="Change a key first: view.look_at=W, observer.altitude=2m, ground.albedo=0.3.",
        ),
    ] = None,
    size: Annotated[
        str | None, typer.Option(metavar="WxH", help="1280x720, or one number.")
    ] = None,
    format_: Annotated[
        Literal["png", "exr"], typer.Option("--format", help="Of the frames; EXR is linear.")
    ] = "png",
    bits: Annotated[int, typer.Option(metavar="8|16", help="Bits per channel of a PNG.")] = 8,
    name: Annotated[
        str | None, typer.Option(metavar="NAME", help="In NAME_00001.png; the film's if left out.")
    ] = None,
    exposure: Annotated[
        str,
        typer.Option(
            metavar="EV|auto|locked",
            help="auto follows the light smoothly; locked is the first frame's; or a number.",
        ),
    ] = "auto",
    tone_map: Annotated[
        str, typer.Option(metavar="NAME", help="Tone map: natural, hable, aces, agx …")
    ] = "natural",
    encoding: Annotated[
        Literal["srgb", "gamma"], typer.Option(help="The picture's transfer curve.")
    ] = "srgb",
    primaries: Annotated[
        Literal["srgb", "display-p3"], typer.Option(help="The picture's primaries.")
    ] = "srgb",
    glare: options.Glare = 1.0,
    wavelengths: Annotated[
        str | None, typer.Option(metavar="rgb|N|LIST", help="As for render.")
    ] = None,
    quality: options.Quality = "default",
    exact: Annotated[
        bool, typer.Option("--exact", help="March pixel by pixel; of a planet.")
    ] = False,
    samples: Annotated[
        int | None, typer.Option(metavar="N", help="Samples per side of a pixel, up to 16.")
    ] = None,
    scheduler: distribution_options.Scheduler = None,
    workers: distribution_options.Workers = None,
) -> None:
    """Render the frames of a film: only those that are missing or have changed.

    The clock may run, and any number of the scene or the planet may follow key frames. Processes of
    this machine share the frames, or a Dask cluster does.
    """
    started = time.perf_counter()
    folder, movie = _outputs(output)
    if bits not in (8, 16):
        raise ParameterError("--bits", bits, "8 or 16")
    if movie is not None:
        display = {"--format": format_, "--bits": bits, "--encoding": encoding,
                   "--primaries": primaries}  # fmt: skip
        plain = {"--format": "png", "--bits": 8, "--encoding": "srgb", "--primaries": "srgb"}
        for option, value in display.items():
            if value != plain[option]:
                raise ParameterError(option, value, f"{plain[option]} beside an MP4")
    level = _exposure(exposure)
    changes: dict[str, Any] = _changes(set_)
    plan = {"frames": frames, "rate": rate, "start": start, "end": end, "zone": zone}
    changes |= {f"film.{field}": value for field, value in plan.items() if value is not None}
    from airlight.cli.render import check_glare, check_tone_map
    from airlight.film import Finish, Quality, load_film
    from airlight.film import animate as rendered
    from airlight.film.movie import check_movie

    check_tone_map(tone_map)
    check_glare(glare)
    if movie is not None:
        check_movie(movie, "--output")
    made = load_film(film, {**changes, **_keys(film, key, changes)})
    columns, rows = options.picture_size(size, made.projection)
    nm = None
    if wavelengths is not None:
        if not made.planets:
            raise ParameterError("--wavelengths", wavelengths, "none for a scene without air")
        nm = options.wavelengths(wavelengths, made.planets[0])
        if len(nm) < 3:
            allowed = "rgb, 3 to 99, or three or more wavelengths: a picture has colours"
            raise ParameterError("--wavelengths", wavelengths, allowed)
    count = [0]
    try:
        with shown_progress() as report, distribution_options.named():

            def counted(done: int, total: int, message: str) -> None:
                if message == "frames":
                    count[0] = done
                report(done, total, message)

            result = rendered(
                made, folder, width=columns, height=rows,
                how=Quality(wavelengths=nm, quality=quality, exact=exact, samples=samples),
                finish=Finish(suffix=f".{format_}", tone_map=tone_map, encoding=encoding,
                              primaries=primaries, bits=bits, glare=glare),
                exposure=level, movie=movie, name=name, scheduler=scheduler, workers=workers,
                on_message=note,
                progress=counted,
            )  # fmt: skip
    except (KeyboardInterrupt, WorkerError, FileError):
        if count[0]:
            note(f"{count[0]} frames were rendered; the same command renders the rest")
        raise
    _report(result, movie, columns, rows, time.perf_counter() - started)


def _report(result: Animated, movie: Path | None, columns: int, rows: int, seconds: float) -> None:
    frames = result.frames
    say(f"{frames.path(0)} … {frames.path(frames.count - 1).name}  {columns}x{rows}  "
          f"{result.rendered} rendered, {result.kept} kept  {seconds:.1f} s"
          + ("  linear" if result.exposures is None else
             "  exposure {:+.2f} to {:+.2f} EV".format(*result.exposures)))  # fmt: skip
    if movie is not None:
        say(f"{movie}  {movie.stat().st_size / 1e3:.0f} kB")


def _outputs(paths: list[Path]) -> tuple[Path, Path | None]:
    """Folder of the frames, and the MP4 if one is asked for."""
    movies = [path for path in paths if path.suffix.lower() == ".mp4"]
    folders = [path for path in paths if path not in movies]
    shown = " ".join(map(str, paths))
    if len(folders) != 1 or len(movies) > 1:
        raise ParameterError(
            "--output", shown, "a folder of frames, and at most one .mp4 beside it"
        )
    if folders[0].suffix:
        raise ParameterError("--output", str(folders[0]), "a folder without a suffix, or an .mp4")
    return folders[0], movies[0] if movies else None


def _exposure(text: str) -> Any:
    if text.strip().lower() == "locked":
        return "locked"
    try:
        return options.exposure(text)
    except ParameterError as error:
        raise ParameterError("--exposure", text, "auto, locked, or -100 to 100 EV") from error


def _changes(set_: list[str] | None) -> dict[str, Any]:
    from airlight.planets.reading.overrides import parsed

    try:
        return dict(parsed(change) for change in set_ or [])
    except ParameterError as error:
        raise ParameterError("--set", error.value, error.allowed) from None


_KEY = re.compile(r"\s*([^=]+?)\s*=\s*(.*?)\s*(?:\s([a-z]+(?:-[a-z]+)*))?\s*", re.DOTALL)


def _keys(film: str, texts: list[str] | None, changes: dict[str, Any]) -> dict[str, Any]:
    """Key frames of the options, behind those of the film's file."""
    from airlight.film import load_film
    from airlight.film.laws import LAWS

    if not texts:
        return {}
    given = load_film(film, changes).plan.keys
    tables: list[dict[str, Any]] = [
        {"path": one.path, "values": one.values, "law": one.law}
        | ({} if one.at is None else {"at": list(one.at)})
        for one in given
    ]
    form = "PATH=A,B and maybe a law, such as 'view.altitude=2m,400km exponential'"
    for text in texts:
        match = _KEY.fullmatch(text)
        if match is None or "," not in match[2]:
            raise ParameterError("--key", text, form)
        values, law = match[2], match[3]
        if law is not None and law not in LAWS:  # a unit with a space before it
            if law.isalpha() and values[-1:].isdigit():
                values, law = f"{values} {law}", None
            else:
                raise ParameterError("--key", text, f"a law of {', '.join(LAWS)}")
        tables = [one for one in tables if one["path"] != match[1]]
        tables.append({"path": match[1], "values": values, "law": law or "linear"})
    return {"film.keys": tables}
