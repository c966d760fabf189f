"""``airlight bake``: a planet's light as tables for engines."""

from __future__ import annotations

import math
import re
import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal

import typer

from airlight.cli import options
from airlight.cli.bake_target import bake_target, check_options
from airlight.cli.console import note, say
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress
from airlight.errors import ConflictError, ParameterError
from airlight.targets import MODULES

if TYPE_CHECKING:
    from airlight.exports.bake import Baked

#: Layouts of tables, and programs.
LAYOUTS = ("bruneton", "atmosphere-plus", *MODULES)
EPILOG = examples(
    "airlight bake earth --layout bruneton -o earth-tables",
    "airlight bake mars --layout bruneton --mie combined --precision half -o mars-tables",
    "airlight bake earth --layout atmosphere-plus --size 32x128x32 -o plus",
    "airlight bake earth --layout atmosphere-plus --packing phase-included --azimuth 0 -o plane",
    "airlight bake earth --layout bruneton --order 1 -o first-order",
)


def bake(
    planet: options.Planet_,
    layout: Annotated[
        str,
        typer.Option(
            metavar="|".join(LAYOUTS),
            help="Table layout: bruneton (altitude, view, sun and the angle between them), "
            "atmosphere-plus (without that angle), or the files of a program.",
        ),
    ],
    output: Annotated[
        Path,
        typer.Option(
            "--output", "-o", metavar="DIR", help="Output folder: new, empty, or of tables."
        ),
    ],
    mapping: Annotated[
        Literal["linear", "power", "weighted-power"] | None,
        typer.Option(help="Atmosphere-plus: mapping of the axes (weighted-power)."),
    ] = None,
    packing: Annotated[
        Literal["rgba", "separate", "phase-included"] | None,
        typer.Option(
            help="Atmosphere-plus: rgba (phase functions at look-up, particles in alpha, grey), "
            "separate (a table of the particles), phase-included (radiance at --azimuth)."
        ),
    ] = None,
    azimuth: Annotated[
        str | None,
        typer.Option(metavar="ANGLE", help="Phase-included: azimuth from the sun (0deg)."),
    ] = None,
    mie: Annotated[
        Literal["separate", "combined"] | None,
        typer.Option(
            help="Bruneton: single scattering of particles in a separate table, or in alpha with "
            "colours restored at look-up."
        ),
    ] = None,
    size: Annotated[
        str | None,
        typer.Option(
            metavar="NxNxN",
            help="Table size: altitude x view x sun x angle (32x128x32x8), or altitude x view x "
            "sun (32x256x32).",
        ),
    ] = None,
    lowest_sun: Annotated[
        str | None,
        typer.Option(
            "--lowest-sun",
            metavar="ANGLE",
            help="Bruneton: largest sun zenith angle in the tables, 90deg to 180deg (the end of "
            "twilight).",
        ),
    ] = None,
    smooth_phase: Annotated[
        Literal["own", "rayleigh"] | None,
        typer.Option(
            help="Bruneton: phase function that divides all but the particles' single scattering: "
            "own (fitted, in phase-functions.npz), or rayleigh (for shaders with Bruneton's "
            "look-up, worse in dusty air) (own)."
        ),
    ] = None,
    precision: Annotated[
        Literal["half", "single"], typer.Option(help="Number format; half is scaled.")
    ] = "single",
    order: Annotated[
        str,
        typer.Option(
            metavar="K|all", help="Scattering order K only, reflections included; or all."
        ),
    ] = "all",
    cumulative: Annotated[
        bool, typer.Option("--cumulative", help="Scattering orders up to K of --order.")
    ] = False,
    wavelengths: Annotated[
        str,
        typer.Option(
            metavar="rgb|N|LIST",
            help="Wavelengths: rgb (680, 550, 440 nm), a number over the visible, or a list in nm.",
        ),
    ] = "rgb",
    solver: Annotated[
        Literal["moments", "direct", "montecarlo"], typer.Option(help="Solver.")
    ] = "moments",
    quality: options.Quality = "default",
    no_polarisation: options.NoPolarisation = False,
    set_: options.Set = None,
    overwrite: options.Overwrite = False,
    no_cache: options.NoCache = False,
) -> None:
    """Bake a planet's radiation to look-up tables: NPZ, EXR and a JSON manifest.

    The tables hold scattered light, transmittance and skylight; the manifest describes the look-ups
    and states the tables' error.
    """
    if layout not in LAYOUTS:
        raise ParameterError("--layout", layout, ", ".join(LAYOUTS))
    if layout in MODULES:
        given: dict[str, Any] = {
            "mapping": mapping,
            "packing": packing,
            "azimuth": azimuth,
            "mie": mie,
            "size": size,
            "lowest_sun": lowest_sun,
            "smooth_phase": smooth_phase,
            "precision": None if precision == "single" else precision,
            "order": None if order == "all" else order,
            "cumulative": cumulative or None,
        }
        chosen = {name: value for name, value in given.items() if value is not None}
        check_options(layout, chosen)
        if size is not None:
            chosen["size"] = _size(size, "bruneton")
        if lowest_sun is not None:
            chosen["lowest_sun"] = options.angle(lowest_sun, "--lowest-sun")
        bake_target(
            layout,
            planet,
            output,
            chosen=chosen,
            wavelengths=None if wavelengths == "rgb" else wavelengths,
            solver=solver,
            quality=quality,
            polarisation=not no_polarisation,
            set_=set_,
            cache=not no_cache,
            overwrite=overwrite,
        )
        return
    started = time.perf_counter()
    from airlight.exports.atomic_folder import check_folder
    from airlight.exports.bake import bake as fill
    from airlight.exports.table_files import FILES, FORMAT, write_tables
    from airlight.planets import replace

    packed = _packing(layout, packing, mie)
    if mapping is not None and layout == "bruneton":
        raise ConflictError("--mapping", "requires --layout atmosphere-plus")
    if smooth_phase is not None and layout != "bruneton":
        raise ConflictError("--smooth-phase", "requires --layout bruneton")
    if azimuth is not None and packed != "phase-included":
        raise ConflictError("--azimuth", "requires --packing phase-included")
    mu_s_min = _lowest(lowest_sun, layout)
    texels = None if size is None else _size(size, layout)
    number = _order(order, cumulative)
    check_folder(output, FORMAT, FILES, overwrite=overwrite)
    world = options.planet(planet, set_)
    if world.refraction != "none":
        note("tables ignore refraction")
        world = replace(world, refraction="none")
    nm = options.wavelengths(wavelengths, world)

    from airlight.solvers import solve

    with shown_progress() as report:
        solution = solve(
            world,
            wavelengths=nm,
            quality=quality,
            solver=solver,
            polarisation=not no_polarisation,
            cache=not no_cache,
            progress=report,
        )
        baked = fill(
            solution,
            layout,
            mapping=mapping or "weighted-power",
            packing=packed,
            azimuth=0.0 if azimuth is None else options.angle(azimuth, "--azimuth"),
            size=texels,
            precision=precision,
            order=number,
            cumulative=cumulative,
            mu_s_min=mu_s_min,
            smooth_phase=smooth_phase or "own",
            progress=report,
        )
        manifest = write_tables(output, baked, overwrite=overwrite)
    _print(manifest, baked)
    say()
    say(f"{manifest}  {time.perf_counter() - started:.1f} s")


def _packing(layout: str, packing: str | None, mie: str | None) -> str:
    if layout == "bruneton":
        if packing is not None:
            raise ConflictError("--packing", "requires --layout atmosphere-plus")
        return mie or "separate"
    if mie is not None:
        raise ConflictError("--mie", "requires --layout bruneton")
    return packing or "rgba"


def _lowest(text: str | None, layout: str) -> float | None:
    if text is None:
        return None
    if layout != "bruneton":
        raise ConflictError("--lowest-sun", "requires --layout bruneton")
    zenith = options.angle(text, "--lowest-sun")
    if not 90.0 <= zenith <= 180.0:
        raise ParameterError("--lowest-sun", text, "90deg to 180deg")
    return min(math.cos(math.radians(zenith)), 0.0)


def _size(text: str, layout: str) -> tuple[int, ...]:
    count, example = (4, "32x128x32x8") if layout == "bruneton" else (3, "32x256x32")
    parts = re.split(r"[xX×]", text.replace(" ", ""))
    if len(parts) != count or not all(part.isdecimal() and len(part) < 7 for part in parts):
        raise ParameterError("--size", text, f"{count} whole numbers such as {example}")
    return tuple(int(part) for part in parts)


def _order(text: str, cumulative: bool) -> int | None:
    if text.strip().lower() == "all":
        if cumulative:
            raise ConflictError("--cumulative", "requires --order K")
        return None
    if not text.strip().isdecimal() or len(text) > 6 or int(text) < 1:
        raise ParameterError("--order", text, "all, or 1, 2, 3 …")
    return int(text)


def _print(manifest: Path, baked: Baked) -> None:
    from airlight.exports.table_files import texture_size

    folder = manifest.parent
    say(f"{'table':<24} {'texture':>14} {'channels':>8} {'stored':>7} {'NPZ':>9} {'EXR':>9}")
    for name, table in baked.tables.items():
        texture = "x".join(str(n) for n in texture_size(table) if n > 1)
        sizes = [
            f"{(folder / f'{name}.{kind}').stat().st_size / 1e3:.0f} kB" for kind in ("npz", "exr")
        ]
        say(
            f"{name:<24} {texture:>14} {len(table.channels):>8} {table.precision:>7} "
            f"{sizes[0]:>9} {sizes[1]:>9}"
        )
    say()
    say(f"{'error against the solver':<30} {'median':>9} {'RMS':>9} {'95 %':>9} {'largest':>9}")
    for name, error in baked.errors.items():
        kind = "absolute" if "absolute" in error.quantity else "relative"
        values = (error.median, error.rms, error.percentile_95, error.maximum)
        say(f"{name:<30} " + " ".join(f"{value:>9.1e}" for value in values) + f"  {kind}")
