"""``airlight animate``: frames and MP4 of a film of a planet or a scene."""

from __future__ import annotations

import re
import time
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import options
from airlight.cli.camera_options import Samples, Size
from airlight.cli.console import examples, note, say, shown_progress
from airlight.cli.display_options import DisplayOptions
from airlight.cli.option_groups import OptionGroup, given_options, given_values, option
from airlight.cli.place_options import Zone
from airlight.cli.planet_options import Clouds, overrides_of, with_clouds
from airlight.cli.solve_options import AccuracyOptions, Device, DistributionOptions, Exact
from airlight.errors import ConflictError, FileError, ParameterError, WorkerError

if TYPE_CHECKING:
    from airlight.studies.film import Film
    from airlight.studies.film import Quality as Accuracy

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
    "airlight animate earth-moon --key 'observer.altitude=110km,30km' --device gpu -o rise/",
    "airlight animate earth --clouds cumulus --set clouds.wind_speed='10 m/s' --frames 90 "
    "-o drift/",
    "airlight animate my-film.toml --scheduler tcp://host:8786 -o frames/",
)


@dataclass(frozen=True, kw_only=True)
class PlanOptions(OptionGroup):
    """Options of the animated quantities."""

    frames: int | None = option("Number of frames (120).", "N")
    rate: float | None = option("Frames per second of the MP4 (30).", "N")
    start: str | None = option(
        "Time of the first frame, as --time of render; requires --end.", "TIME"
    )
    end: str | None = option("Time of the last frame.", "TIME")
    zone: Zone = None
    key: list[str] | None = option(
        "Key frames of a number: 'view.altitude=2m,400km exponential'. Laws: "
        "{studies.film.key_frames:LAWS}. May be repeated.",
        "PATH=A,B[,C …] [LAW]",
    )
    set_: list[str] | None = option(
        "Override a key: view.look_at=W, observer.altitude=2m, ground.albedo=0.3.", "PATH=VALUE"
    )
    clouds: Clouds = None

    def changes(self, film: str) -> dict[str, Any]:
        """Overrides of a film's keys, without key frames."""
        given = given_values(self, "frames", "rate", "start", "end", "zone")
        plan = {f"film.{name}": value for name, value in given.items()}
        body = "" if self.clouds is None else _cloudy_body(film)
        return overrides_of(with_clouds(self.clouds, self.set_, body)) | plan


@dataclass(frozen=True, kw_only=True)
class FrameOptions(DisplayOptions):
    """Options of the frames' files and display."""

    size: Size = None
    format_: Literal["png", "exr"] = option(
        "File format of the frames; EXR is linear.", default="png"
    )
    name: str | None = option("Prefix of NAME_00001.png (the film's name).", "NAME")
    exposure: float | str | None = option(
        "Exposure compensation, a power of 2; default auto, smoothly adapting; or locked, that of "
        "the first frame.",
        "EV|auto|locked",
        read=options.film_exposure,
    )

    def check_movie(self, movie: Path) -> None:
        """Raise an error if an MP4 of these frames cannot be written."""
        from airlight.studies.film.movie import check_movie

        plain = {"--format": "png", "--bits": 8, "--encoding": "srgb", "--primaries": "srgb"}
        for given in given_options(self, "format_", "bits", "encoding", "primaries"):
            raise ConflictError(given, f"must be {plain[given]} for an MP4")
        check_movie(movie, "--output")


@dataclass(frozen=True, kw_only=True)
class FilmAccuracyOptions(AccuracyOptions):
    """Options of the accuracy of the frames."""

    device: Device = "cpu"
    exact: Exact = False
    samples: Samples = None

    def accuracy(self, film: Film, size: tuple[int, int]) -> Accuracy:
        """Settings of the film's frames of a size. [pixel]"""
        from airlight.studies.film import Quality

        if self.wavelengths is not None and not film.planets:
            raise ConflictError("--wavelengths", "does not apply to a scene without air")
        return Quality(
            width=size[0],
            height=size[1],
            wavelengths=self.picture_nm(film.planets[0]) if film.planets else None,
            quality=self.quality,
            device=self.device,
            exact=self.exact,
            samples=self.samples,
        )


def animate(
    film: Annotated[
        str,
        typer.Argument(metavar="FILM", help="Film, scene or planet: a preset or a TOML file."),
    ],
    output: Annotated[
        list[Path],
        options.output_option(
            "FOLDER|FILM.mp4", ("Folder of the frames; if repeated with an .mp4 file, also an MP4.")
        ),
    ],
    plan: PlanOptions,
    frame: FrameOptions,
    accuracy: FilmAccuracyOptions,
    distribution: DistributionOptions,
) -> None:
    """Render the missing or changed frames of a film.

    Time, and any number of the scene or the planet, can be animated by key frames. Frames are
    distributed to processes of this machine or of a Dask cluster.
    """
    started = time.perf_counter()
    folder, movie = _outputs(output)
    from airlight.studies.film import Finish, load_film
    from airlight.studies.film import animate as rendered

    frame.check(f".{frame.format_}")
    if movie is not None:
        frame.check_movie(movie)
    changes = plan.changes(film)
    made = load_film(film, {**changes, **_keys(film, plan.key, changes)})
    made = made if frame.name is None else replace(made, name=frame.name)
    how = accuracy.accuracy(made, options.picture_size(frame.size, made.projection))
    count = [0]
    try:
        with shown_progress() as report, distribution.named():

            def counted(done: int, total: int, message: str) -> None:
                if message == "frames":
                    count[0] = done
                report(done, total, message)

            result = rendered(
                made,
                folder,
                how=how,
                finish=Finish(
                    suffix=f".{frame.format_}",
                    exposure=frame.ev,
                    **{**made.display, **frame.given_settings()},
                ),
                movie=movie,
                on_message=note,
                progress=counted,
                **distribution.keywords(),
            )
    except (KeyboardInterrupt, WorkerError, FileError):
        if count[0]:
            note(f"{count[0]} frames are complete; the same command renders the others")
        raise
    frames, light = result.frames, "linear"
    if result.exposures is not None:
        light = "exposure {:+.2f} to {:+.2f} EV".format(*result.exposures)
    say(
        f"{frames.path(0)} … {frames.path(frames.count - 1).name}  {how.width}x{how.height}  "
        f"{result.rendered} rendered, {result.kept} unchanged  "
        f"{time.perf_counter() - started:.1f} s  {light}"
    )
    if movie is not None:
        say(f"{movie}  {movie.stat().st_size / 1e3:.0f} kB")


def _cloudy_body(film: str) -> str:
    """Name of the planet of ``--clouds`` in a film of a scene; empty in one of a planet."""
    from airlight.cli.scene_file import cloudy_body
    from airlight.studies.film import load_film

    found = load_film(film)
    return cloudy_body(found.tables) if found.view is None else ""


def _outputs(paths: list[Path]) -> tuple[Path, Path | None]:
    """Folder of the frames, and path of the MP4 if requested."""
    movies = [path for path in paths if path.suffix.lower() == ".mp4"]
    folders = [path for path in paths if path not in movies]
    shown = " ".join(map(str, paths))
    if len(folders) != 1 or len(movies) > 1:
        raise ParameterError("--output", shown, "one folder of frames, and at most one .mp4")
    if folders[0].suffix:
        raise ParameterError("--output", str(folders[0]), "a folder without a suffix, or an .mp4")
    return folders[0], movies[0] if movies else None


_KEY = re.compile(r"\s*([^=]+?)\s*=\s*(.*?)\s*(?:\s([a-z]+(?:-[a-z]+)*))?\s*", re.DOTALL)


def _keys(film: str, texts: list[str] | None, changes: dict[str, Any]) -> dict[str, Any]:
    """Key frames of the film's file, then of the options."""
    from airlight.studies.film import load_film
    from airlight.studies.film.key_frames import LAWS

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
