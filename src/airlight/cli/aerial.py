"""``airlight aerial``: the air around an observer as textures and functions for a shader."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from airlight.cli import options, time_and_place
from airlight.cli.console import say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress

if TYPE_CHECKING:
    from airlight.composition.aerial_perspective import AerialPerspective

EPILOG = examples(
    "airlight aerial earth --altitude 500m --sun-zenith 66deg -o air",
    "airlight aerial earth --at 46.6N,8E,2000m --time '2026-07-01 sunset' -o evening",
    "airlight aerial mars --altitude 20m --sun-zenith 40deg --farthest 50km -o mars-air",
)


def aerial(
    planet: options.Planet_,
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", metavar="DIR", help="A folder: new, empty, or of such tables."
        ),
    ],
    altitude: Annotated[
        str | None, typer.Option(metavar="LENGTH", help="Of the observer (2m).")
    ] = None,
    sun_zenith: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Of the sun there (60deg).")
    ] = None,
    at: time_and_place.At = None,
    time_: time_and_place.Time = None,
    zone: time_and_place.Zone = None,
    season: time_and_place.Season = None,
    latitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Of the place, for its ground (0deg).")
    ] = None,
    longitude: Annotated[
        str | None, typer.Option(metavar="ANGLE", help="Of the place, for its ground (0deg).")
    ] = None,
    nearest: Annotated[
        str, typer.Option(metavar="LENGTH", help="Distance from which on the air is tabled.")
    ] = "10m",
    farthest: Annotated[
        str, typer.Option(metavar="LENGTH", help="Distance up to which the air is tabled.")
    ] = "200km",
    wavelengths: Annotated[
        str | None,
        typer.Option(metavar="rgb|N|LIST", help="As for render; 16 if left out."),
    ] = None,
    quality: options.Quality = "default",
    no_polarisation: options.NoPolarisation = False,
    set_: options.Set = None,
    overwrite: options.Overwrite = False,
    no_cache: options.NoCache = False,
) -> None:
    """Fill textures with the air before every point around an observer, for a shader's pass.

    The folder has half-float textures, functions in WGSL and GLSL that read them, and a manifest
    with their error. The camera may turn, and move as far as the air is the same.
    """
    started = time.perf_counter()
    from airlight.composition.aerial_perspective import AerialPerspective, check_request
    from airlight.exports.aerial_files import FILES, FORMAT, write_aerial
    from airlight.exports.whole_folder import check_folder
    from airlight.paint.solve_planet import solve_planet
    from airlight.scene import Scene
    from airlight.scene.local_ground import local_ground

    check_folder(output, FORMAT, FILES, overwrite=overwrite)
    between = options.length(nearest, "--nearest"), options.length(farthest, "--farthest")
    world = options.planet(planet, set_)
    angles = {
        "--sun-zenith": sun_zenith, "--latitude": latitude, "--longitude": longitude
    }  # fmt: skip
    placed = time_and_place.given(world, at, time_, zone, season, angles, altitude)
    if placed is not None:
        world = time_and_place.lit(world, placed, "true")
    else:
        placed = time_and_place.by_angles(sun_zenith, None, latitude, longitude, altitude)
    nm = None if wavelengths is None else options.wavelengths(wavelengths, world)
    world = local_ground(
        world, latitude=placed.latitude, longitude=placed.longitude, altitude=placed.altitude
    )
    scene = Scene(
        altitude=placed.altitude, sun_zenith=placed.sun_zenith,
        latitude=placed.latitude, longitude=placed.longitude,
    )  # fmt: skip
    check_request(world.thickness, scene, *between)
    with shown_progress() as report:
        solution = solve_planet(
            world, nm, quality, polarisation=not no_polarisation, cache=not no_cache,
            progress=report,
        )  # fmt: skip
        made = AerialPerspective.fill(
            solution, scene, nearest=between[0], farthest=between[1], progress=report
        )
    about = {"planet": world.name, "changes": "; ".join(set_ or [])}
    texts = {key: text for key, text in about.items() if text}
    manifest = write_aerial(output, made, texts, overwrite=overwrite)
    say(f"{manifest}  {time.perf_counter() - started:.1f} s  {_errors(made)}")


def _errors(made: AerialPerspective) -> str:
    errors = made.errors
    pairs = (("air", errors.air_95, errors.air_largest), ("sky", errors.sky_95, errors.sky_largest))
    return ", ".join(
        f"{name}: 95 % within {100.0 * usual:.2f} %, all within {100.0 * most:.1f} %"
        for name, usual, most in pairs
    )
