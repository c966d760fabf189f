"""Comparison of two planets for ``airlight show PLANET --compare OTHER``."""

from __future__ import annotations

from typing import TYPE_CHECKING

from airlight.cli.console import console
from airlight.errors import ParameterError

if TYPE_CHECKING:
    from rich.table import Table
    from rich.text import Text

    from airlight.planets import Planet
    from airlight.planets.comparison import Difference, Value
    from airlight.render.sky_color import SkyColor

#: Text for a property that a planet does not have.
_NOTHING = "–"
#: Significant digits: the fewest, and the most if needed to distinguish two numbers.
_FEWEST, _MOST = 5, 12
#: Characters per line where the output is not a terminal.
_WIDTH = 120


def print_comparison(first: Planet, second: Planet, *, cache: bool) -> None:
    """Print the differences between two planets.

    Parameters
    ----------
    cache : bool
        Whether to cache solutions on disk.
    """
    from airlight.planets.comparison import compare

    rows = list(compare(first, second))
    skies = [_sky(planet, cache=cache) for planet in (first, second)]
    if skies[0] and skies[1]:
        rows += _sky_rows(skies[0], skies[1])
    out = console(_WIDTH)
    if not rows:
        out.print(f"{first.name} and {second.name} do not differ.")
        return
    out.print(_table(first.name, second.name, rows))
    if skies[0] and skies[1]:
        out.print(_swatches(skies[0], skies[1]))


def _sky(planet: Planet, *, cache: bool) -> tuple[SkyColor, ...]:
    """Colours of the sky; empty if the planet has no data in the visible."""
    from airlight.cli.progress import shown_progress
    from airlight.render.sky_color import sky_colors

    try:
        with shown_progress() as report:
            return sky_colors(planet, cache=cache, progress=report)
    except ParameterError:
        return ()


def _sky_rows(first: tuple[SkyColor, ...], second: tuple[SkyColor, ...]) -> list[Difference]:
    from airlight.planets.comparison import Difference, differs

    rows = []
    for a, b in zip(first, second, strict=True):
        values: list[tuple[str, str, float, float]] = [
            ("luminance", "cd m⁻²", a.luminance, b.luminance),
            ("chromaticity x", "", a.chromaticity[0], b.chromaticity[0]),
            ("chromaticity y", "", a.chromaticity[1], b.chromaticity[1]),
        ]
        for word, unit, x, y in values:
            if differs(x, y):
                quantity = f"{a.look}, {word}"
                rows.append(Difference(part="sky", quantity=quantity, unit=unit, first=x, second=y))
    return rows


def _table(first: str, second: str, rows: list[Difference]) -> Table:
    from rich.table import Table

    table = Table(box=None, pad_edge=False)
    table.add_column("", style="bold", no_wrap=True)
    table.add_column("quantity", no_wrap=True)
    for name in ("nm", first, second, "difference", "%"):
        table.add_column(name, justify="right", overflow="fold")
    part = ""
    before = ("", "")
    for row in rows:
        values = _pair(row)
        absolute, percent = row.absolute, row.percent
        unit = _unit(row)
        label = f"{row.quantity} [{unit}]" if unit else row.quantity
        heading = "" if row.part == part else row.part
        if heading and part:
            table.add_row()
        table.add_row(
            heading,
            "" if (row.part, label) == before else label,
            "" if row.wavelength is None else f"{row.wavelength:.5g}",
            *values,
            "" if absolute is None else f"{absolute * _factor(row):+.3g}",
            "" if percent is None else f"{percent:+.3g}",
        )
        part, before = row.part, (row.part, label)
    return table


def _factor(row: Difference) -> float:
    """Factor of the displayed value; kilometres for long lengths."""
    sizes = [abs(value) for value in (row.first, row.second) if isinstance(value, float)]
    return 1e-3 if row.unit == "m" and sizes and max(sizes) >= 1e3 else 1.0


def _unit(row: Difference) -> str:
    return "km" if _factor(row) != 1.0 else row.unit


def _pair(row: Difference) -> tuple[str, str]:
    """Both values, with as many digits as distinguish them."""
    shown = ("", "")
    for digits in range(_FEWEST, _MOST + 1):
        shown = (_text(row.first, row, digits), _text(row.second, row, digits))
        if shown[0] != shown[1]:
            break
    return shown


def _text(value: Value, row: Difference, digits: int) -> str:
    if value is None:
        return _NOTHING
    return value if isinstance(value, str) else f"{value * _factor(row):.{digits}g}"


def _swatches(first: tuple[SkyColor, ...], second: tuple[SkyColor, ...]) -> Text:
    from rich.text import Text

    from airlight.render.sky_color import SUN_ZENITH

    text = Text(f"\nsky from the ground, sun zenith angle {SUN_ZENITH:.0f} deg, azimuth 90 deg\n")
    for a, b in zip(first, second, strict=True):
        text.append(f"{a.look:>8}  ")
        for color in (a, b):
            text.append("        ", style=f"on {color.code}")
            text.append(f" {color.code}   ")
        text.append("\n")
    return text
