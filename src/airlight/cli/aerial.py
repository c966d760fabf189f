"""``airlight aerial``: aerial perspective as textures and shader functions."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from airlight.cli import options
from airlight.cli.console import examples, say, shown_progress
from airlight.cli.place_options import PlaceOptions
from airlight.cli.planet_options import PlanetOptions
from airlight.cli.solve_options import SolveOptions

if TYPE_CHECKING:
    from airlight.engines.composition.aerial_perspective import AerialPerspective

EPILOG = examples(
    "airlight aerial earth --altitude 500m --sun-zenith 66deg -o air",
    "airlight aerial earth --at 46.6N,8E,2000m --time '2026-07-01 sunset' -o evening",
    "airlight aerial mars --altitude 20m --sun-zenith 40deg --farthest 50km -o mars-air",
)


def aerial(
    planet: PlanetOptions,
    output: Annotated[
        Path, options.output_option("DIR", "Output folder: new, empty, or with such tables.")
    ],
    place: PlaceOptions,
    solve: SolveOptions,
    nearest: Annotated[
        str, typer.Option(metavar="LENGTH", help="Smallest distance in the tables.")
    ] = "10m",
    farthest: Annotated[
        str, typer.Option(metavar="LENGTH", help="Largest distance in the tables.")
    ] = "200km",
    overwrite: options.Overwrite = False,
) -> None:
    """Bake aerial perspective around an observer to textures and shader functions.

    The folder has half-float textures, look-up functions in WGSL and GLSL, and a manifest with
    their error. The camera may rotate, and move a little.
    """
    started = time.perf_counter()
    from airlight.engines.composition.aerial_files import FILES, FORMAT, write_aerial
    from airlight.engines.composition.aerial_perspective import AerialPerspective, check_request
    from airlight.files.atomic_folder import check_folder
    from airlight.render.solve_planet import solve_planet

    check_folder(output, FORMAT, FILES, overwrite=overwrite)
    between = options.length(nearest, "--nearest"), options.length(farthest, "--farthest")
    world = planet.load()
    scene = place.scene(world)
    world = place.lit(world, scene)
    scene = replace(scene, time=None, secondary_lights=())
    nm = solve.nm(world)
    check_request(world.thickness, scene, *between)
    with shown_progress() as report:
        solution = solve_planet(world, nm, around=scene.place, progress=report, **solve.keywords())
        made = AerialPerspective.fill(
            solution, scene, nearest=between[0], farthest=between[1], progress=report
        )
    manifest = write_aerial(
        output, made, {"planet": world.name, **planet.changes()}, overwrite=overwrite
    )
    say(f"{manifest}  {time.perf_counter() - started:.1f} s  {_errors(made)}")


def _errors(made: AerialPerspective) -> str:
    errors = made.errors
    pairs = (
        ("air", errors.air_95, errors.air_largest),
        ("sky", errors.sky_95, errors.sky_largest),
    )
    return ", ".join(
        f"{name}: 95 % within {100.0 * usual:.2f} %, all within {100.0 * most:.1f} %"
        for name, usual, most in pairs
    )
