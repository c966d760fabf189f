"""``airlight export-page``: interactive page of a planet or a scene in one HTML file."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Annotated, Literal

import typer

from airlight.cli.console import examples, say, shown_progress
from airlight.cli.options import output_option
from airlight.cli.planet_options import PlanetOptions, overrides_of
from airlight.cli.solve_options import NoCache, Quality
from airlight.errors import ParameterError

EPILOG = examples(
    "airlight export-page earth -o earth.html",
    "airlight export-page mars --view altitude=2 --view sun_zenith=88 -o mars.html",
    "airlight export-page my-planet.toml --set ground.albedo=0.5 -o page.html",
    "airlight export-page lunar-eclipse -o eclipse.html",
)


def export_page(
    planet: PlanetOptions,
    output: Annotated[Path, output_option("FILE", "Output page, .html.")],
    view: Annotated[
        list[str] | None,
        typer.Option(
            "--view",
            metavar="NAME=VALUE",
            help="Initial view: altitude=400e3 (m), sun_zenith=85 (deg), heading, look_zenith, "
            "field_of_view, projection … May be repeated.",
        ),
    ] = None,
    wavelengths: Annotated[
        Literal["three", "four"],
        typer.Option(help="Number of wavelengths; four have better colours."),
    ] = "four",
    quality: Quality = "default",
    no_cache: NoCache = False,
) -> None:
    """Write an interactive page of a planet or a scene: one HTML file, below 5 MB.

    The page renders with WebGPU or WebGL2, and loads nothing from a network.
    """
    started = time.perf_counter()
    from airlight.viewer.browser.page import export_page as export

    if output.suffix.lower() not in (".html", ".htm"):
        raise ParameterError("--output", str(output), "a name that ends with .html")
    values = dict(_view_value(text) for text in view or [])
    changes = overrides_of(planet.overrides)
    with shown_progress() as report:
        page = export(
            planet.planet,
            output,
            changes=changes,
            view=values,
            quality=quality,
            wavelengths=wavelengths,
            cache=not no_cache,
            progress=report,
        )
    seconds = time.perf_counter() - started
    size = f"{page.size / 1e6:.2f} MB"
    kind = f"quality {page.quality}  {page.wavelengths} wavelengths"
    say(f"{page.path}  {size}  {kind}  {seconds:.1f} s")


def _view_value(text: str) -> tuple[str, float | str | bool]:
    """Path and value of a ``--view``."""
    from airlight.viewer.browser.page_data import page_parameters
    from airlight.viewer.browser.scene_package import HOURS

    name, equals, word = text.partition("=")
    found = {one.path: one for one in (*page_parameters(), HOURS)}
    short = {path.split(".", 1)[1]: path for path in found}
    path = short.get(name.strip(), name.strip())
    if not equals or path not in found:
        raise ParameterError("--view", text, f"NAME=VALUE, with a name of {', '.join(short)}")
    word = word.strip()
    if found[path].kind == "switch":
        if word not in ("on", "off"):
            raise ParameterError("--view", text, "on or off")
        return path, word == "on"
    if found[path].kind == "number":
        try:
            return path, float(word)
        except ValueError:
            unit = found[path].unit
            raise ParameterError("--view", text, f"a number, in {unit}") from None
    return path, word
