"""``airlight planets``: list of presets."""

from __future__ import annotations

from airlight.cli.console import console
from airlight.cli.examples import examples
from airlight.cli.progress import shown_progress

EPILOG = examples("airlight planets", "airlight show earth")


def planets() -> None:
    """List the planets that ship with airlight."""
    from rich.table import Table

    from airlight.planets import load_planet, planet_names

    table = Table(box=None, pad_edge=False)
    table.add_column("planet", style="bold", no_wrap=True)
    table.add_column("radius", justify="right", no_wrap=True)
    table.add_column("air up to", justify="right", no_wrap=True)
    table.add_column("constituents")
    for name in planet_names():
        with shown_progress() as report:
            planet = load_planet(name, progress=report)
        table.add_row(
            name,
            f"{planet.bottom_radius / 1e3:.0f} km",
            f"{(planet.top_radius - planet.bottom_radius) / 1e3:.0f} km",
            ", ".join(constituent.name for constituent in planet.constituents),
        )
    console().print(table)
